"""Marches a machine of an archived run with SciPy, over the samples of the run.

usage: peer_machine.py QUESTION.json RESULT.npz

QUESTION: archive (the machine's run), bearing (a run of its bearing alone), rotor (arguments of
peer_rotor.Rotor), method, relative, film_tolerance. RESULT: seconds of the march, right-hand sides, and y
and z of the stations at the archive's times, (time, 2 x station).
"""

import json
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import tiltpad
from peer_model import STATES, Bearing
from peer_rotor import Rotor
from scipy.integrate import solve_ivp

PAD = ("pad_tilt", "pad_tilt_rate", "pivot_deflection", "pivot_deflection_rate", "bristle_deflection")
#: Steps of the differences for the Jacobian, over the states' scales.
DIFFERENCE = 1e-4


class Machine:
    """A rotor in several bearings that are alike; machine(t, y) is the right-hand side."""

    def __init__(self, rotor: Rotor, bearings: list[Bearing], speed: float):
        self.rotor, self.bearings, self.speed = rotor, bearings, speed
        self.inverse = np.linalg.inv(rotor.mass)
        self.damping = rotor.damping + speed * rotor.gyroscopic
        self.n, self.pads = len(rotor.load), STATES * bearings[0].count
        self.evaluations = 0

    def __call__(self, t: float, y: np.ndarray) -> np.ndarray:
        self.evaluations += 1
        n, dydt = self.n, np.empty_like(y)
        q, rates = y[:n], y[n : 2 * n]
        force = self.rotor.load - self.rotor.stiffness @ q - self.damping @ rates
        force += self.speed**2 * (self.rotor.unbalance * np.exp(1j * self.speed * t)).real
        for k, bearing in enumerate(self.bearings):
            at, own = slice(2 * k, 2 * k + 2), slice(2 * n + k * self.pads, 2 * n + (k + 1) * self.pads)
            force[at] += bearing.force(np.concatenate([q[at], rates[at]]), y[own], dydt[own])
        dydt[:n], dydt[n : 2 * n] = rates, self.inverse @ force
        return dydt

    def first(self, file: h5py.File) -> np.ndarray:
        """The state of the first sample, where the shaft is at rest."""
        own = [file["bearings"][name] for name in sorted(file["bearings"])]
        journals = [each[f"journal_{axis}"][0] for each in own for axis in "yz"]
        k = len(journals)
        inner = self.rotor.load[k:] - self.rotor.stiffness[k:, :k] @ journals
        bent = np.linalg.solve(self.rotor.stiffness[k:, k:], inner)
        pads = [np.column_stack([each[name][0] for name in PAD]).ravel() for each in own]
        return np.concatenate([journals, bent, np.zeros(self.n), *pads])

    def scales(self, clearance: float, depth: float) -> np.ndarray:
        """Characteristic scale of each state, as tiltpad has it."""
        of_rotor = clearance / abs(self.rotor.stations).max(axis=0)
        of_pads = [bearing.scales(clearance, depth)[4:] for bearing in self.bearings]
        return np.concatenate([of_rotor, of_rotor * self.speed, *of_pads])

    def jacobian(self, scales: np.ndarray):
        """Differences over these scales."""

        def matrix(t: float, y: np.ndarray) -> np.ndarray:
            now, columns = self(t, y), []
            for i in range(len(y)):
                moved = y.copy()
                moved[i] += DIFFERENCE * scales[i]
                columns.append((self(t, moved) - now) / (moved[i] - y[i]))
            return np.column_stack(columns)

        return matrix


def main() -> None:
    question, result = sys.argv[1:]
    asked = json.loads(Path(question).read_text())
    rotor = Rotor(**asked["rotor"])
    with tiltpad.read(asked["bearing"]) as run:
        bearings = [Bearing(run.input, asked["film_tolerance"]) for _ in range(rotor.journals // 2)]
        clearance, depth = run.clearance, float(run.equilibrium["pivot_deflection"].max())
    machine = Machine(rotor, bearings, bearings[0].speed)
    with h5py.File(asked["archive"]) as file:
        first, times = machine.first(file), file["time"][()]
    # compiles, and gives the films their first fields
    machine(0.0, first)
    machine.evaluations = 0
    scales = machine.scales(clearance, depth)
    started = time.perf_counter()
    found = solve_ivp(
        machine, (0, times[-1]), first, method=asked["method"], t_eval=times, rtol=asked["relative"],
        atol=asked["relative"] * scales, jac=machine.jacobian(scales),
    )  # fmt: skip
    seconds = time.perf_counter() - started
    if not found.success:
        raise SystemExit(found.message)
    moved = found.y[: machine.n].T @ rotor.stations.T
    np.savez(result, seconds=seconds, evaluations=machine.evaluations, stations=moved)


main()
