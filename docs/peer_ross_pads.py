"""Bearings of verify_warm.py by ROSS's own tilting pads; runs in ROSS's environment.

usage: peer_ross_pads.py BEARING KIND RE_LAMINAR RE_TURBULENT: five or turbine; none, adiabatic or full

Prints a line of JSON, in the units of verify_warm.py: thinnest film, highest temperature of the pads (0 where
there is none), temperature of the shaft, loss, stiffness and damping along and across the load.
"""

import json
import sys
import warnings

import numpy as np

warnings.simplefilter("ignore")
import ross  # noqa: E402

ZERO_CELSIUS = 273.15
#: Speed, rpm; diameter, clearance, thickness and length of the pads, m; their arcs, deg, and preload;
#: viscosities at 40 and 100 C, Pa s, which ROSS wants to differ; load, N.
BEARINGS = {
    "five": (9000, 0.1016, 76e-6, 14e-3, 0.0508, 60, 0.3, 0.02733, 0.02733 * np.exp(-0.0305 * 60), 10000),
    "turbine": (3000, 0.479, 306e-6, 80e-3, 0.3, 56, 0.4, 0.012, 0.01199, 180003.69),
}


def main() -> None:
    bearing, kind, laminar, turbulent = sys.argv[1:]
    speed, diameter, clearance, thickness, length, arc, preload, cold, hot, load = BEARINGS[bearing]
    found = ross.TiltingPad(
        n=0,
        speed=[speed * np.pi / 30],
        equilibrium_type="match_load",
        thermal_type=None if kind == "none" else kind,
        journal_diameter=diameter,
        radial_clearance=clearance,
        pad_thickness=thickness,
        pivot_angle=np.radians([234, 162, 90, 18, -54]),
        pad_arc=np.radians([arc] * 5),
        pad_axial_length=[length] * 5,
        preload=[preload] * 5,
        offset=[0.5] * 5,
        lubricant={
            **{"liquid_viscosity1": cold, "temperature1": ZERO_CELSIUS + 40},
            **{"liquid_viscosity2": hot, "temperature2": ZERO_CELSIUS + 100},
            **{"liquid_density": 860, "liquid_specific_heat": 1950, "liquid_thermal_conductivity": 0.13},
        },
        oil_supply_temperature=ZERO_CELSIUS + 40,
        oil_flow_v=1e-2,
        hot_oil_lambda=0.8,
        pad_conductivity=50,
        pad_convection=[100] * 5,
        edges_convection=100,
        fys_load=-load,
        total_ex_film=20,
        total_ez_film=20,
        re_laminar=float(laminar),
        re_turbulent=float(turbulent),
        num_processes=1,
    )
    said = found._results.outputs[0] if isinstance(found._results.outputs, list) else found._results.outputs
    shaft, hottest = (
        float(np.max(said[each])) - ZERO_CELSIUS for each in ("journal_temperature_output", "tpad_max")
    )
    warm = kind != "none"
    print(
        json.dumps(
            [
                1e6 * float(np.min(said["h_min"])),
                hottest if warm else None,
                shaft if warm else None,
                float(said["power_loss"][0]),
                *(1e-6 * float(getattr(found, each)[0]) for each in ("kyy", "kxx", "cyy", "cxx")),
            ]
        )
    )


if __name__ == "__main__":
    main()
