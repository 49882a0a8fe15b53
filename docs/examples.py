"""Runs the commands of docs/examples.md, writes its pictures and compares the figures in its text.

usage: examples.py TILTPAD FOLDER-FOR-RUNS
"""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import tiltpad

DOCS = Path(__file__).resolve().parent
#: Inputs of the tolerances that the page speaks of.
NAMES = ("assembled_clearance", "preload", "bristle_stiffness")


def commands(page: str) -> list[str]:
    """The commands of a page, a line each."""
    return [line for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL) for line in block.splitlines()]


def figures(folder: Path) -> Iterator[str]:
    """What the page says of its results, with the figures that they have."""
    with tiltpad.read(folder / "speeds/0002.h5") as run:
        cross = 1e-6 * tiltpad.coefficients(run, "free").stiffness[0, 0, 1]
        yield f"its cross-coupled stiffness is {cross:.0f} MN/m"
    with tiltpad.read(folder / "up.h5") as run:
        yield f"near {100 * round(tiltpad.response(run).peaks[0].speed_rpm / 100)} rpm"
    with tiltpad.read_study(folder / "lobes.h5") as study:
        found = tiltpad.modes(study, "locked")
    growth = np.nanmax(found.eigenvalue.real, axis=1)
    for preload, words in (
        (0, "unstable from {} rpm on"),
        (0.3, "adds little ({} rpm)"),
        (0.5, "holds to {} rpm"),
    ):
        lobes = found.parameters["preload"] == preload
        yield words.format(100 * round(np.interp(0, growth[lobes], found.speed_rpm[lobes]) / 100))
    with tiltpad.read_study(folder / "tolerances.h5") as study:
        low, *_, high = 100 * tiltpad.percentiles(study, "least_damping_ratio", pivot="stuck").values[0]
        yield f"the damping ratio is {low:.0f} to {high:.0f} % in nine of ten"
        yield f"{100 * tiltpad.outcomes(study, 'stuck').unstable.share:.0f} % of them are unstable"
        locked, stuck = (
            tiltpad.sensitivity(study, "threshold_rpm", pivot=own) for own in ("locked", "stuck")
        )
    clearance, preload = (100 * locked.first[locked.inputs.index(name)] for name in NAMES[:2])
    yield f"clearance ({clearance:.0f} % of the variance) and preload ({preload:.0f} %)"
    yield f"its stiffness comes first ({100 * stuck.first[stuck.inputs.index(NAMES[2])]:.0f} %)"
    yield f"{100 * locked.explained:.0f} % here, and {100 * stuck.explained:.0f} % with pivots that stick"
    yield f"of {stuck.runs} bearings that have a threshold speed"


def main() -> None:
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "input").symlink_to(DOCS.parent / "input")
    path = os.pathsep.join([str(program.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    page = (DOCS / "examples.md").read_text()
    for line in commands(page):
        subprocess.run(["sh", "-c", line], check=True, cwd=folder, env=os.environ | {"PATH": path})
    wrong = [words for words in figures(folder) if words not in page]
    if wrong:
        sys.exit(f"docs/examples.md: other figures now: {wrong}")
    for picture in folder.glob("example_*.png"):
        shutil.copy(picture, DOCS / "images")


if __name__ == "__main__":
    main()
