"""Results of tiltpad: reading, calculating, drawing.

    import tiltpad
    run = tiltpad.read("case.h5")
    y, z = tiltpad.orbit(run)                     # m
    ax = tiltpad.plots.orbit(run)                 # matplotlib axes

`tiltpad.plots` (one run on one pair of axes), `tiltpad.figures` (whole pictures) and the other modules of
MODULES are loaded when they are first used, most of them with matplotlib.
"""

from importlib import import_module
from typing import Any

from tiltpad.calculate.coefficients import Coefficients, coefficients
from tiltpad.calculate.critical_speeds import CriticalSpeed, critical_speeds, write_critical_speeds
from tiltpad.calculate.deviations import deviations
from tiltpad.calculate.geometry import film_thickness
from tiltpad.calculate.heat import HeatBalance, heat_balance
from tiltpad.calculate.impedance import impedance
from tiltpad.calculate.library import (
    Contact,
    LibraryError,
    Losses,
    MissingLibraryError,
    Pressure,
    bristle_rate,
    contact,
    contact_pressure,
    friction_force,
    losses,
    pivot_load,
    pressure,
)
from tiltpad.calculate.measured import Measured
from tiltpad.calculate.modes import Modes, modes
from tiltpad.calculate.pivots import (
    friction_coefficient,
    friction_power,
    friction_work,
    hysteresis,
    loop_area,
    sliding_velocity,
    stick_fraction,
    stick_intervals,
    stick_velocity,
    sticking,
)
from tiltpad.calculate.response import Peak, Response, response
from tiltpad.calculate.ross import to_ross
from tiltpad.calculate.ross_rotor import from_ross
from tiltpad.calculate.sensitivity import Sensitivity, sensitivity
from tiltpad.calculate.signals import (
    envelope,
    last_revolutions,
    orbit,
    orbit_size,
    poincare,
    revolutions,
    waveform,
)
from tiltpad.calculate.spectra import full, full_spectrum, one_sided, order_track, spectrum, waterfall
from tiltpad.calculate.statistics import Outcomes, Percentiles, Share, outcomes, percentiles
from tiltpad.calculate.tables import write_coefficients
from tiltpad.collect.collect import Collected, RunWarning, collect
from tiltpad.files.archive import NotInRunError, RunError
from tiltpad.files.namelist import write_case
from tiltpad.files.processes import MissingProgramError
from tiltpad.files.read import IncompleteRunWarning, Run, of_run, read
from tiltpad.files.study import Study, read_study
from tiltpad.fitting import Fit, fit
from tiltpad.lateral_runs import lateral
from tiltpad.running import run
from tiltpad.sampling import sample
from tiltpad.up_and_down import brute_force

__all__ = [
    "Coefficients",
    "Collected",
    "Contact",
    "CriticalSpeed",
    "Fit",
    "HeatBalance",
    "IncompleteRunWarning",
    "LibraryError",
    "Losses",
    "RunWarning",
    "Measured",
    "MissingLibraryError",
    "MissingProgramError",
    "Modes",
    "NotInRunError",
    "Outcomes",
    "Peak",
    "Percentiles",
    "Pressure",
    "Response",
    "Run",
    "RunError",
    "Sensitivity",
    "Share",
    "Study",
    "bristle_rate",
    "brute_force",
    "coefficients",
    "collect",
    "contact",
    "pivot_load",
    "contact_pressure",
    "critical_speeds",
    "deviations",
    "envelope",
    "film_thickness",
    "fit",
    "friction_coefficient",
    "friction_force",
    "friction_power",
    "friction_work",
    "from_ross",
    "full",
    "full_spectrum",
    "heat_balance",
    "hysteresis",
    "impedance",
    "last_revolutions",
    "lateral",
    "loop_area",
    "losses",
    "modes",
    "one_sided",
    "orbit",
    "orbit_size",
    "order_track",
    "outcomes",
    "percentiles",
    "poincare",
    "pressure",
    "read",
    "read_study",
    "response",
    "revolutions",
    "run",
    "sample",
    "sensitivity",
    "sliding_velocity",
    "spectrum",
    "stick_fraction",
    "stick_intervals",
    "stick_velocity",
    "sticking",
    "to_ross",
    "waterfall",
    "waveform",
    "write_case",
    "write_coefficients",
    "write_critical_speeds",
]


__version__: str

#: Modules with a name of their own here, and the floors that they are on.
MODULES = {
    **dict.fromkeys(
        ("bearing", "diagrams", "figures", "machines", "plots", "report", "study_report"), "draw"
    ),
    **dict.fromkeys(("behaviour", "stations", "summary"), "calculate"),
    "units": "files",
}


def __getattr__(name: str) -> Any:
    if name in MODULES:
        return import_module(f"tiltpad.{MODULES[name]}.{name}")
    if name == "__version__":
        # only then, as it takes a tenth of the time of all imports
        return import_module("importlib.metadata").version("tiltpad")
    raise AttributeError(f"module 'tiltpad' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, *MODULES, "__version__"]


# a file's name or a study where a result is needed is answered by a sentence
for _name in __all__:
    if next(iter(getattr(globals()[_name], "__annotations__", {})), "") == "run":
        globals()[_name] = of_run(globals()[_name])
