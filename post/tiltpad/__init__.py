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

from tiltpad.calculate.deviations import deviations
from tiltpad.calculate.library import (
    Contact,
    LibraryError,
    MissingLibraryError,
    Pressure,
    bristle_rate,
    contact,
    contact_force,
    contact_pressure,
    friction_force,
    pressure,
)
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
from tiltpad.collect.collect import Collected, MemberWarning, collect
from tiltpad.files.archive import NotInRunError, RunError
from tiltpad.files.read import IncompleteRunWarning, Run, read
from tiltpad.files.study import Study, read_study

__all__ = [
    "Collected",
    "Contact",
    "IncompleteRunWarning",
    "LibraryError",
    "MemberWarning",
    "MissingLibraryError",
    "NotInRunError",
    "Pressure",
    "Run",
    "RunError",
    "Study",
    "bristle_rate",
    "collect",
    "contact",
    "contact_force",
    "contact_pressure",
    "deviations",
    "envelope",
    "friction_coefficient",
    "friction_force",
    "friction_power",
    "friction_work",
    "full",
    "full_spectrum",
    "hysteresis",
    "last_revolutions",
    "loop_area",
    "one_sided",
    "orbit",
    "orbit_size",
    "order_track",
    "poincare",
    "pressure",
    "read",
    "read_study",
    "revolutions",
    "sliding_velocity",
    "spectrum",
    "stick_fraction",
    "stick_intervals",
    "stick_velocity",
    "sticking",
    "waterfall",
    "waveform",
]


#: Modules with a name of their own here, and the floors that they are on.
MODULES = {
    **dict.fromkeys(("diagrams", "figures", "plots", "report"), "draw"),
    **dict.fromkeys(("behaviour", "summary"), "calculate"),
    "units": "files",
}


def __getattr__(name: str) -> Any:
    if name in MODULES:
        return import_module(f"tiltpad.{MODULES[name]}.{name}")
    raise AttributeError(f"module 'tiltpad' has no attribute {name!r}")
