"""What ROSS makes of a bearing that tiltpad wrote; test_ross.py runs it in ROSS's own environment.

Each line of standard input is a question in JSON: bearing (file), points (pairs of whirl frequency and
speed, rad/s), mass (kg), unbalance (kg m), phase (rad, from x), speeds (rad/s);
or script, lines of Python to be run where the file of the bearing is; or turbine, a speed for a rotor of
its own; or machine, a rotor in bearings; or damper, a squeeze film damper on a centred circle; or version.
A line of its output that begins with { answers one in JSON: stiffness and damping at the points, and the
synchronous motion of the journal along x and y, real and imaginary parts.
One process answers all, as ROSS takes seconds to start.
The rotor is a mass in the middle of a stiff shaft without weight, which two such bearings carry; each bears
half of it.
"""

import json
import os
import sys
import warnings
from contextlib import redirect_stdout
from importlib.metadata import version
from io import StringIO

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
    if "version" in asked:
        return {"version": f"ROSS {version('ross-rotordynamics')}, NumPy {np.__version__}"}
    if "script" in asked:
        return printed(asked["script"], os.path.dirname(asked["bearing"]))
    if "turbine" in asked:
        return turbine(asked["turbine"])
    if "machine" in asked:
        return machine(**asked["machine"])
    if "damper" in asked:
        damper = ross.SqueezeFilmDamper(n=0, lubricant="ISOVG32", **asked["damper"])
        return {"stiffness": damper.kxx[0], "damping": damper.cxx[0], "viscosity": damper.lubricant}
    bearing = ross.BearingElement.load(asked["bearing"])
    found = {
        name: [matrix(frequency, speed)[:2, :2].tolist() for frequency, speed in asked["points"]]
        for name, matrix in (("stiffness", bearing.K), ("damping", bearing.C))
    }
    if asked["speeds"]:
        found |= response(bearing, asked)
    return found


def printed(script: str, folder: str) -> dict:
    """What lines of Python print in a folder."""
    os.chdir(folder)
    with redirect_stdout(StringIO()) as said:
        exec(script, {})
    return {"printed": said.getvalue()}


def turbine(speed: float) -> dict:
    """A rotor with an overhung disk on springs: ROSS's matrices, and its whirl at a speed."""
    shaft = [ross.ShaftElement(L=0.2, idl=0, odl=0.1, material=ross.materials.steel) for _ in range(6)]
    disks = [
        ross.DiskElement.from_geometry(n=n, material=ross.materials.steel, width=0.1, i_d=0.1, o_d=0.5)
        for n in (2, 6)
    ]
    bearings = [ross.BearingElement(n=n, kxx=3e7, kyy=5e7, cxx=0, cyy=0, kzz=1e6) for n in (0, 4)]
    rotor = ross.Rotor(shaft, disks, bearings)
    found = description(rotor)
    # synchronously to the unbalance at node 6: its motion along x and y
    moved = rotor.run_unbalance_response(
        node=6, unbalance_magnitude=1e-3, unbalance_phase=0, speed_range=np.array([speed])
    ).forced_resp
    rows = [rotor.number_dof * 6 + each for each in (0, 1)]
    return found | {"moved": [[moved[k][0].real, moved[k][0].imag] for k in rows]}


def description(rotor: ross.Rotor) -> dict:
    """Matrices without bearings, and how their rows are counted."""
    found = {name: getattr(rotor, name).tolist() for name in ("M0", "C0", "G0", "K0")}
    found |= {"dof": rotor.number_dof, "nodes": len(rotor.nodes), "mass": rotor.m}
    places = rotor.shaft_elements[0].dof_mapping()
    return found | {"places": [places[f"{each}_0"] for each in ("x", "y", "alpha", "beta")]}


def machine(
    length: list, diameter: list, discs: list, nodes: list, stiffness: list, damping: list, speed: float,
    unbalance: list, seal: str, described: bool,
) -> dict:  # fmt: skip
    """A shaft of steel with discs (node, mass, diametral and polar inertia) in bearings, each with matrices
    at a speed: ROSS's matrices where they are to be described, its eigenvalues without those of torsion and
    axial vibration, and its whirl, x and y of each node, under an unbalance (node, moment, phase). A seal is
    read from a file.
    """
    steel = ross.Material("steel", rho=7850, E=2.1e11, Poisson=0.3)
    shaft = [
        ross.ShaftElement(L=each, idl=0, odl=thick, material=steel)
        for each, thick in zip(length, diameter, strict=True)
    ]
    disks = [ross.DiskElement(n=n, m=m, Id=diametral, Ip=polar) for n, m, diametral, polar in discs]
    names = ("xx", "xy", "yx", "yy")
    bearings = [
        ross.BearingElement(
            n=n,
            **{f"k{name}": value for name, value in zip(names, np.ravel(k), strict=True)},
            **{f"c{name}": value for name, value in zip(names, np.ravel(c), strict=True)},
            kzz=1e6,
        )
        for n, k, c in zip(nodes, stiffness, damping, strict=True)
    ]
    if seal:
        bearings.append(ross.SealElement.load(seal))
    rotor = ross.Rotor(shaft, disks, bearings)
    # bending is coupled with neither torsion nor axial vibration
    places = description(rotor)["places"]
    bending = [rotor.number_dof * n + each for n in range(len(rotor.nodes)) for each in places]
    bending = [*bending, *(rotor.ndof + each for each in bending)]
    values = np.linalg.eigvals(rotor.A(speed)[np.ix_(bending, bending)])
    node, moment, phase = unbalance
    moved = rotor.run_unbalance_response(
        node=node, unbalance_magnitude=moment, unbalance_phase=phase, speed_range=np.array([speed])
    ).forced_resp[:, 0]
    rows = [[rotor.number_dof * n + each for each in (0, 1)] for n in range(len(rotor.nodes))]
    return (description(rotor) if described else {}) | {
        "eigenvalues": [[z.real, z.imag] for z in values],
        "moved": [[[moved[k].real, moved[k].imag] for k in row] for row in rows],
    }


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
