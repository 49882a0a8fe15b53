"""The five pads of verify_warm.py by ROSS's own tilting pads; runs in ROSS's environment.

usage: peer_ross_warm.py KIND, one of none, adiabatic, full

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


def main() -> None:
    kind = sys.argv[1]
    found = ross.TiltingPad(
        n=0,
        speed=[9000 * np.pi / 30],
        equilibrium_type="match_load",
        thermal_type=None if kind == "none" else kind,
        journal_diameter=0.1016,
        radial_clearance=76e-6,
        pad_thickness=14e-3,
        pivot_angle=np.radians([234, 162, 90, 18, -54]),
        pad_arc=np.radians([60] * 5),
        pad_axial_length=[0.0508] * 5,
        preload=[0.3] * 5,
        offset=[0.5] * 5,
        lubricant={
            **{"liquid_viscosity1": 0.02733, "temperature1": ZERO_CELSIUS + 40},
            **{"liquid_viscosity2": 0.02733 * np.exp(-0.0305 * 60), "temperature2": ZERO_CELSIUS + 100},
            **{"liquid_density": 860, "liquid_specific_heat": 1950, "liquid_thermal_conductivity": 0.13},
        },
        oil_supply_temperature=ZERO_CELSIUS + 40,
        oil_flow_v=1e-2,
        hot_oil_lambda=0.8,
        pad_conductivity=50,
        pad_convection=[100] * 5,
        edges_convection=100,
        fys_load=-10000,
        total_ex_film=20,
        total_ez_film=20,
        re_laminar=1e6,
        re_turbulent=2e6,
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
