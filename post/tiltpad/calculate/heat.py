"""Where the heat of the films goes, by the heat balance of each pad."""

from typing import NamedTuple

import numpy as np

from tiltpad.files.read import Run, of_run


class HeatBalance(NamedTuple):
    """The heat of each pad's film at the equilibrium, W, (pad,); its fields:

    made        by shear, and where asperities touch: it goes to the oil, the shaft and the pad
    to_oil      what the oil carries away: with one temperature for each pad the mean of its flows at both
                edges, warmed from one to the other; else what goes neither into the shaft nor into the pad
    to_shaft    what goes into the shaft; negative where the shaft warms the film
    to_pad      what the pad takes and gives off behind; 0 with one temperature for each pad
    """

    made: np.ndarray
    to_oil: np.ndarray
    to_shaft: np.ndarray
    to_pad: np.ndarray


@of_run
def heat_balance(run: Run) -> HeatBalance:
    """Heat that the films make, and where it goes. Raises NotInRunError for a run without a heat balance."""
    made = run["equilibrium/power_loss"]
    if run.has_film_temperatures:
        to_shaft, to_pad = (run[f"equilibrium/heat_to_{each}"] for each in ("shaft", "pad"))
        return HeatBalance(made, made - to_shaft - to_pad, to_shaft, to_pad)
    inlet, outlet = (run[f"equilibrium/{name}_temperature"] for name in ("inlet", "outlet"))
    flow = (run["equilibrium/inlet_flow"] + run["equilibrium/outlet_flow"]) / 2
    oil = run.input["oil"]
    to_oil = oil["density"] * oil["specific_heat"] * flow * (outlet - inlet)
    return HeatBalance(made, to_oil, made - to_oil, np.zeros_like(made))
