"""What ROSS makes of a bearing that tiltpad wrote; test_ross.py runs it in ROSS's own environment.

Each line of standard input is a question in JSON: bearing (file), points (pairs of whirl frequency and
speed, rad/s), mass (kg), unbalance (kg m), phase (rad, from x), speeds (rad/s);
or turbine, a speed for a rotor of its own. A line of its output that
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
    if "turbine" in asked:
        return turbine(asked["turbine"])
    bearing = ross.BearingElement.load(asked["bearing"])
    found = {
        name: [matrix(frequency, speed)[:2, :2].tolist() for frequency, speed in asked["points"]]
        for name, matrix in (("stiffness", bearing.K), ("damping", bearing.C))
    }
    if asked["speeds"]:
        found |= response(bearing, asked)
    return found


def turbine(speed: float) -> dict:
    """A rotor with an overhung disk on springs: ROSS's matrices, and its whirl at a speed."""
    shaft = [ross.ShaftElement(L=0.2, idl=0, odl=0.1, material=ross.materials.steel) for _ in range(6)]
    disks = [
        ross.DiskElement.from_geometry(n=n, material=ross.materials.steel, width=0.1, i_d=0.1, o_d=0.5)
        for n in (2, 6)
    ]
    bearings = [ross.BearingElement(n=n, kxx=3e7, kyy=5e7, cxx=0, cyy=0, kzz=1e6) for n in (0, 4)]
    rotor = ross.Rotor(shaft, disks, bearings)
    names = ("M0", "C0", "G0", "K0")
    found = {name: getattr(rotor, name).tolist() for name in names}
    found |= {"dof": rotor.number_dof, "nodes": len(rotor.nodes), "mass": rotor.m}
    places = rotor.shaft_elements[0].dof_mapping()
    found |= {"places": [places[f"{each}_0"] for each in ("x", "y", "alpha", "beta")]}
    # synchronously to the unbalance at node 6: its motion along x and y
    moved = rotor.run_unbalance_response(
        node=6, unbalance_magnitude=1e-3, unbalance_phase=0, speed_range=np.array([speed])
    ).forced_resp
    rows = [rotor.number_dof * 6 + each for each in (0, 1)]
    return found | {"moved": [[moved[k][0].real, moved[k][0].imag] for k in rows]}


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
