"""Runs the commands of docs/misalignment.md, draws its pictures and compares the figures in its text.

usage: misalignment.py TILTPAD FOLDER-FOR-RUNS
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import tiltpad
from page_commands import follow

#: Studies of the slope, and what the page calls their pads.
PADS = {"tilting": "tilt only", "pitching": "pitch freely", "held": "held by friction"}
#: Runs of the slender rotor, and what the page says of their films.
FILMS = {
    "ignored": "ignore slopes",
    "bent": "know slopes, pads cannot pitch",
    "pitch": "pads pitch",
    "yaw": "pads pitch and yaw",
}
#: Pitch from which the pads start, and what counts as released, rad.
START, RELEASED = 40e-6, 2e-6


def over_slopes(folder: Path) -> Iterator[str]:
    """Rows of the table of the first section."""
    for slope in (0, 200, 400, 600):
        for name, words in PADS.items():
            with tiltpad.read_study(folder / f"{name}.h5") as study:
                k = int(np.argmin(np.abs(study["slope_1"] - 1e-6 * slope)))
                film, pressure = 1e6 * study["min_film_thickness"][k], 1e-6 * study["max_pressure"][k]
                moment = np.hypot(*(study[f"mean_moment_{axis}"][k] for axis in "yz"))
            # without slopes no film knows a moment
            shown = f"{np.nan_to_num(moment):.0f}"
            yield f"| {slope} urad | {words} | {film:.1f} | {pressure:.2f} | {shown} |"


def thresholds(folder: Path) -> Iterator[str]:
    """Rows of the table of thresholds."""
    for name, words in FILMS.items():
        with tiltpad.read(folder / f"{name}.h5") as run:
            free, stuck = (tiltpad.modes(run, pivots).threshold_rpm for pivots in ("free", "stuck"))
        found = f"{free:.0f}" if np.isfinite(free) else "above 10000"
        yield f"| {words} | {found} | {stuck:.0f} |"


def figures(folder: Path) -> Iterator[str]:
    """The words of the page with figures, as the runs have them now."""
    yield from over_slopes(folder)
    with tiltpad.read(folder / "edge.h5") as edge:
        moment = np.hypot(*(edge[f"equilibrium/journal_moment_{axis}"] for axis in "yz"))
        yield f"with {1e-6 * moment / 400e-6:.2f} N m for each urad"
    with tiltpad.read(folder / "follow.h5") as free, tiltpad.read(folder / "rub.h5") as held:
        pitch = 1e6 * np.abs(free["equilibrium/pad_pitch"] - held["pad_pitch"][-1])
        moments = np.abs(held["friction_moment_pitch"][-1])
    bears = f"{moments[0]:.1f} and {moments[1]:.1f} N m"
    yield f"{bears}, which is {pitch[0]:.0f} and {pitch[1]:.0f} urad of pitch"
    with tiltpad.read(folder / "still.h5") as still:
        yield f"stays at {1e6 * still['pad_pitch'][-1, 0]:.1f} urad"
    for name in ("slow", "paper", "fast"):
        with tiltpad.read(folder / f"{name}.h5") as run:
            above = np.flatnonzero(np.abs(run["pad_pitch"]).max(axis=1) > RELEASED)
            unbalance = run.input["rotor"]["unbalance"]
            yield f"{1e3 * run.time[above[-1]]:.0f} ms with {unbalance:g} kg m"
    with tiltpad.read_study(folder / "grooves.h5") as study:
        at = int(np.argmin(np.abs(study["slope_1"] - 600e-6)))
        film = 1e6 * study["equilibrium_min_film_thickness"][[0, at]]
        pressure = 1e-6 * study["equilibrium_max_pressure"][[0, at]]
    yield f"from {film[0]:.1f} to {film[1]:.1f} um"
    yield f"from {pressure[0]:.1f} to {pressure[1]:.1f} MPa"
    with tiltpad.read(folder / "groove.h5") as run:
        end = run.input["bearing"]["axial_length"][0] / 2
        yield f"{1e3 * (end + run['equilibrium/max_pressure_axial'][0]):.0f} mm from the end"
    yield from thresholds(folder)


if __name__ == "__main__":
    follow("misalignment.md", figures)
