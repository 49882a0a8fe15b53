"""A rotor by ROSS on stiffness and damping of its bearings; runs in ROSS's environment.

usage: peer_ross_machine.py QUESTION.json RESULT.npz

QUESTION: length and diameter of the sections, discs (node, mass, diametral and polar inertia), unbalance
(node, moment), nodes of the bearings, speeds (rad/s) with stiffness and damping of each bearing, (bearing,
speed, 2, 2) in the axes of ROSS; speed, samples a revolution and duration of a march; node that is watched.
RESULT: seconds of the march and its last revolution along x and y, (time, 2); seconds of the modes at all
speeds.
"""

import json
import sys
import time
import warnings
from pathlib import Path

import numpy as np

warnings.simplefilter("ignore")
import ross  # noqa: E402


def rotor(asked: dict) -> ross.Rotor:
    """The rotor with bearings tabulated over the speed."""
    steel = ross.Material("steel", rho=7850, E=2.1e11, Poisson=0.3)
    sections = zip(asked["length"], asked["diameter"], strict=True)
    shaft = [ross.ShaftElement(L=each, idl=0, odl=thick, material=steel) for each, thick in sections]
    discs = [ross.DiskElement(n=n, m=m, Id=diametral, Ip=polar) for n, m, diametral, polar in asked["discs"]]
    bearings = []
    for node, *matrices in zip(asked["nodes"], asked["stiffness"], asked["damping"], strict=True):
        tables = {
            f"{letter}{a}{b}": [each[i][j] for each in table]
            for letter, table in zip("kc", matrices, strict=True)
            for i, a in enumerate("xy")
            for j, b in enumerate("xy")
        }
        bearings.append(ross.BearingElement(n=node, speed=asked["speeds"], kzz=1e6, **tables))
    return ross.Rotor(shaft, discs, bearings)


def main() -> None:
    question, result = sys.argv[1:]
    asked = json.loads(Path(question).read_text())
    machine = rotor(asked)
    speed = asked["speed"]
    times = np.arange(0, asked["duration"], 2 * np.pi / speed / asked["samples"])
    force = np.zeros((len(times), machine.ndof))
    node, moment = asked["unbalance"]
    # along y at first, which is a quarter turn ahead of x
    force[:, machine.number_dof * node] = -moment * speed**2 * np.sin(speed * times)
    force[:, machine.number_dof * node + 1] = moment * speed**2 * np.cos(speed * times)
    started = time.perf_counter()
    found = machine.run_time_response(speed, force, times)
    march = time.perf_counter() - started
    at = machine.number_dof * asked["watched"]
    started = time.perf_counter()
    machine.run_campbell(np.array(asked["speeds"]), frequencies=8)
    modes = time.perf_counter() - started
    moved = found.yout[-asked["samples"] :, at : at + 2]
    np.savez(result, march=march, modes=modes, moved=moved, times=times[-asked["samples"] :])


if __name__ == "__main__":
    main()
