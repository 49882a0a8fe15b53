"""The bearing of the maps of coefficients: what this program and ROSS both can describe."""

from typing import NamedTuple


class PadBearing(NamedTuple):
    """Five equal pads of little mass on rigid pivots, the load between two of them; SI units, deg."""

    radius: float = 63.5e-3
    length: float = 63.5e-3
    clearance: float = 0.2e-3
    preload: float = 0.5
    viscosity: float = 0.022
    angles: tuple[float, ...] = (-54, 18, 90, 162, 234)
    arc: float = 60
    thickness: float = 20e-3
    mass: float = 1500
    gravity: float = 9.81


BEARING = PadBearing()
