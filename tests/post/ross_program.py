"""What ROSS makes of a bearing that tiltpad wrote; test_ross.py runs it in ROSS's own environment.

Each line of standard input is a question in JSON: bearing (file), points (pairs of whirl frequency and
speed, rad/s), mass (kg), unbalance (kg m), phase (rad, from x), speeds (rad/s). A line of its output that
begins with { answers one in JSON: stiffness and damping at the points, and the synchronous motion of the
journal along x and y, real and imaginary parts. One process answers all, as ROSS takes seconds to start.
The rotor is a mass in the middle of a stiff shaft without weight, which two such bearings carry; each bears
half of it.
"""

import json
import sys
import warnings

import numpy as np

warnings.simplefilter("ignore")
import ross  # noqa: E402

#: Moduli, Pa, so high that the shaft does not bend.
STIFF = {"E": 2e15, "G_s": 8e14}
LENGTH, DIAMETER = 0.1, 1.0


def main() -> None:
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))), flush=True)


def answer(asked: dict) -> dict:
    """The answer to a question."""
    bearing = ross.BearingElement.load(asked["bearing"])
    found = {
        name: [matrix(frequency, speed)[:2, :2].tolist() for frequency, speed in asked["points"]]
        for name, matrix in (("stiffness", bearing.K), ("damping", bearing.C))
    }
    if asked["speeds"]:
        found |= response(bearing, asked)
    return found


def response(bearing: ross.BearingElement, asked: dict) -> dict:
    """Complex amplitudes of the first bearing's node over the speeds."""
    material = ross.Material("light", rho=1e-3, **STIFF)
    shaft = [ross.ShaftElement(L=LENGTH, idl=0, odl=DIAMETER, material=material) for _ in range(2)]
    disk = ross.DiskElement(n=1, m=2 * asked["mass"], Id=asked["mass"], Ip=asked["mass"] / 10)
    tables = {
        name: getattr(bearing, name) for name in ("kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy")
    }
    axes = {"speed": bearing.speed, "frequency": bearing.frequency}
    ends = [ross.BearingElement(n=node, **tables, **axes) for node in (0, 2)]
    rotor = ross.Rotor(shaft, [disk], ends)
    moved = rotor.run_unbalance_response(
        node=1,
        unbalance_magnitude=2 * asked["unbalance"],
        unbalance_phase=asked["phase"],
        speed_range=np.array(asked["speeds"]),
    ).forced_resp
    return {name: [[z.real, z.imag] for z in moved[k]] for k, name in enumerate("xy")}


if __name__ == "__main__":
    main()
