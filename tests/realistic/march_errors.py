"""The error of a march: how far what a user reads of its last revolutions lies from that of another.

Of each signal these are the mean value, the sizes of its motion above and below the mean, and the part at
the speed of the shaft, in size and phase. The phase of a pad that flutters drifts from run to run without
any error of its motion; it is in none of these figures. Highest and lowest values themselves would depend
on it, by what a finite number of revolutions shows of a motion with two frequencies; so the sizes are means
of a high power, and all means are weighted with a smooth window. Where two runs agree at every instant the
figures agree as well.
"""

from pathlib import Path

import h5py
import numpy as np
from stress_cases import Case
from tiltpad.calculate.deviations import STEADY

#: Revolutions at the end of a march that are compared.
LAST = 20
#: Mean force at its pivot, over the load of the bearing, below which a pad is unloaded.
UNLOADED = 0.02
#: Least scale of highest pressures and pivot forces, over the largest of all pads. That of positions and
#: tilts is STEADY of the clearance, and of the clearance over the radius, as in docs/benchmarks.md.
LARGEST = 0.01
#: Power of the means that stand for the highest and lowest values.
POWER = 8
#: Difference of a revolution from an earlier one, over the characteristic scales, that repeats it.
REPEATS = 1e-3
#: What is compared, and how the page calls it.
QUANTITIES = {
    "journal": "journal",
    "journal_clearance": "journal, over the clearance",
    "tilt_loaded": "tilt, loaded pads",
    "tilt_unloaded": "tilt, unloaded pads",
    "film": "minimum film thickness",
    "pressure": "highest pressure",
    "force": "pivot force",
}


class Window:
    """The last revolutions of a result file."""

    def __init__(self, path: Path, revolutions: int = LAST):
        with h5py.File(path) as file:
            turns = file["shaft_angle"][()] / (2 * np.pi)
            self.samples = turns > turns[-1] - revolutions + 1e-9
            # one or (time, pad)
            self.values = {
                name: file[name][()][self.samples].reshape(self.samples.sum(), -1)
                for name in file
                if isinstance(file[name], h5py.Dataset) and len(file[name]) == len(turns)
            }
        self.turns = turns[self.samples]

    def figures(self, name: str) -> np.ndarray:
        """Mean value, sizes above and below it and synchronous part of a signal, for each of its columns."""
        values = self.values[name]
        weight = np.sin(np.pi * (np.arange(len(values)) + 0.5) / len(values))[:, None] ** 4
        weight /= weight.sum()
        mean = np.sum(weight * values, axis=0)
        above, below = (
            np.sum(weight * np.maximum(side * (values - mean), 0) ** POWER, axis=0) ** (1 / POWER)
            for side in (1, -1)
        )
        part = 2 * np.sum(weight * np.exp(-2j * np.pi * self.turns)[:, None] * (values - mean), axis=0)
        return np.array((mean, above, below, part.real, part.imag))

    def size(self, name: str) -> np.ndarray:
        """Peak-to-peak values."""
        return np.ptp(self.values[name], axis=0)


def errors(path: Path, reference: Path, case: Case) -> dict[str, float]:
    """Errors of a march by quantity; nothing of unloaded pads or of tilts where there are none."""
    run, true = Window(path), Window(reference)
    moved, size = journal(run, true)
    clearance = case["bearing"]["assembled_clearance"]
    found = {"journal": moved / max(size, STEADY * clearance), "journal_clearance": moved / clearance}
    thickness, right = (each.values["min_film_thickness"].min(axis=0) for each in (run, true))
    found["film"] = float(np.max(abs(thickness / right - 1)))
    pressure, right = (each.values["max_pressure"].max(axis=0) for each in (run, true))
    found["pressure"] = float(np.max(abs(pressure - right) / np.maximum(right, LARGEST * right.max())))
    if "pad_tilt" in true.values:
        found |= of_tilting(run, true, case)
    return found


def of_tilting(run: Window, true: Window, case: Case) -> dict[str, float]:
    """Errors of tilts and forces at pivots."""
    found = {}
    forces = true.values["pivot_load"]
    unloaded = forces.mean(axis=0) < UNLOADED * load(case)
    tilts = tilt(run, true, case)
    for name, pads in (("tilt_loaded", ~unloaded), ("tilt_unloaded", unloaded)):
        if pads.any():
            found[name] = float(tilts[pads].max())
    scale = np.maximum(forces.max(axis=0), LARGEST * forces.max())
    found["force"] = float(np.max(gap(run, true, "pivot_load") / scale))
    return found


def gap(run: Window, true: Window, name: str) -> np.ndarray:
    """Largest difference of the figures of a signal, for each of its columns."""
    return abs(run.figures(name) - true.figures(name)).max(axis=0)


def journal(run: Window, true: Window) -> tuple[float, float]:
    """Error of the orbit, and its size (the larger peak-to-peak value), m."""
    names = "journal_y", "journal_z"
    size = max(true.size(name)[0] for name in names)
    return float(max(gap(run, true, name)[0] for name in names)), float(size)


def tilt(run: Window, true: Window, case: Case) -> np.ndarray:
    """Error of each pad's tilt, over its peak-to-peak value."""
    return gap(run, true, "pad_tilt") / np.maximum(true.size("pad_tilt"), STEADY * tilt_scale(case))


def tilt_scale(case: Case) -> float:
    """Characteristic scale of a tilt, rad."""
    bearing = case["bearing"]
    machined = bearing["assembled_clearance"] / (1 - bearing["preload"])
    return bearing["assembled_clearance"] / (bearing["journal_radius"] + machined)


def load(case: Case) -> float:
    """Static load, N."""
    rotor = case["rotor"]
    return rotor["mass"] * 9.81 - rotor.get("static_load", [0.0])[0]


def period(path: Path, case: Case, most: int = 4) -> int:
    """Revolutions after which the end of a march repeats; 0: it does not."""
    end = Window(path, 2 * most)
    clearance = case["bearing"]["assembled_clearance"]
    scales = {"journal_y": clearance, "journal_z": clearance, "pad_tilt": tilt_scale(case)}
    count = len(end.turns) // (2 * most)
    for revolutions in range(1, most + 1):
        shift = revolutions * count
        moved = (
            np.max(abs(end.values[name][shift:] - end.values[name][:-shift])) / scale
            for name, scale in scales.items()
            if name in end.values
        )
        if max(moved) < REPEATS:
            return revolutions
    return 0
