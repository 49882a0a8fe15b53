"""Results of tiltpad: reading, calculating, drawing.

    import tiltpad
    run = tiltpad.read("case.h5")
    y, z = tiltpad.orbit(run)                     # m
    ax = tiltpad.plots.orbit(run)                 # matplotlib axes

`tiltpad.plots` (one run on one pair of axes) and `tiltpad.figures` (whole pictures) load matplotlib, and
are loaded when first used.
"""

from importlib import import_module
from typing import Any

from tiltpad.errors import deviations
from tiltpad.pivots import (
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
from tiltpad.read import IncompleteRunWarning, NotInRunError, Run, RunError, read
from tiltpad.signals import (
    envelope,
    last_revolutions,
    orbit,
    orbit_size,
    poincare,
    revolutions,
    waveform,
)
from tiltpad.spectra import full, full_spectrum, one_sided, order_track, spectrum, waterfall

__all__ = [
    "IncompleteRunWarning",
    "NotInRunError",
    "Run",
    "RunError",
    "deviations",
    "envelope",
    "friction_coefficient",
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
    "read",
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


def __getattr__(name: str) -> Any:
    if name in ("figures", "plots"):
        return import_module(f"tiltpad.{name}")
    raise AttributeError(f"module 'tiltpad' has no attribute {name!r}")
