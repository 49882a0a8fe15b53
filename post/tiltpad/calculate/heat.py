"""Where the heat of the films goes, by the heat balance of each pad."""

from typing import NamedTuple

import numpy as np

from tiltpad.files.read import Run, of_run


class HeatBalance(NamedTuple):
    """The heat of each pad's film at the equilibrium, W, (pad,); its fields:

    made        by shear, and where asperities touch: it goes to the oil and to the shaft
    to_oil      what the oil carries away: the mean of its flows at both edges, warmed from one to the other
    to_shaft    what goes into the shaft; negative where the shaft warms the film
    """

    made: np.ndarray
    to_oil: np.ndarray
    to_shaft: np.ndarray


@of_run
def heat_balance(run: Run) -> HeatBalance:
    """Heat that the films make, and where it goes. Raises NotInRunError for a run without a heat balance.

    It is for films with one temperature each; those with temperatures along and across also heat their pads.
    """
    run.needs_even_oil()
    inlet, outlet = (run[f"equilibrium/{name}_temperature"] for name in ("inlet", "outlet"))
    flow = (run["equilibrium/inlet_flow"] + run["equilibrium/outlet_flow"]) / 2
    oil = run.input["oil"]
    to_oil = oil["density"] * oil["specific_heat"] * flow * (outlet - inlet)
    made = run["equilibrium/power_loss"]
    return HeatBalance(made, to_oil, made - to_oil)
