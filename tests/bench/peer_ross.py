"""The bearing of maps.py by ROSS's own tilting pads; runs in ROSS's environment.

usage: peer_ross.py RESULT RATIO ELEMENTS RPM...

Writes stiffness and damping, (speed, row, column) in the axes of ROSS, and the seconds of all speeds; before
that it solves the first one, with which everything is compiled and read.
"""

import sys
import time
import warnings

import numpy as np
from bearing import BEARING as B

warnings.simplefilter("ignore")
import ross  # noqa: E402

#: The oil keeps its viscosity: it hardly changes over the temperature, which is not calculated.
OIL = {
    **{"liquid_viscosity1": B.viscosity, "temperature1": 313.15},
    **{"liquid_viscosity2": B.viscosity * (1 - 1e-6), "temperature2": 373.15},
    **{"liquid_density": 870.0, "liquid_specific_heat": 1950.0, "liquid_thermal_conductivity": 0.13},
}


def bearing(rpm: list[float], ratio: float, elements: int) -> ross.TiltingPad:
    """The bearing at some speeds; ROSS solves when it makes it."""
    pads = len(B.angles)
    return ross.TiltingPad(
        n=0,
        speed=np.array(rpm) * np.pi / 30,
        excitation_ratio=ratio,
        equilibrium_type="match_load",
        thermal_type=None,
        journal_diameter=2 * B.radius,
        radial_clearance=B.clearance,
        pad_thickness=B.thickness,
        pivot_angle=np.radians(180 - np.array(B.angles)),
        pad_arc=np.radians([B.arc] * pads),
        pad_axial_length=[B.length] * pads,
        preload=[B.preload] * pads,
        offset=[0.5] * pads,
        lubricant=OIL,
        oil_supply_temperature=313.15,
        oil_flow_v=1e-2,
        fys_load=-B.mass * B.gravity,
        total_ex_film=elements,
        total_ez_film=elements,
        re_laminar=1e6,
        re_turbulent=2e6,
        num_processes=1,
    )


def main() -> None:
    result, ratio, elements, *rpm = sys.argv[1:]
    speeds = [float(each) for each in rpm]
    bearing(speeds[:1], float(ratio), int(elements))
    started = time.perf_counter()
    found = bearing(speeds, float(ratio), int(elements))
    seconds = time.perf_counter() - started
    matrices = {
        name: np.moveaxis([[getattr(found, f"{letter}{i}{j}") for j in "xy"] for i in "xy"], -1, 0)
        for name, letter in (("stiffness", "k"), ("damping", "c"))
    }
    np.savez(result, seconds=seconds, **matrices)


if __name__ == "__main__":
    main()
