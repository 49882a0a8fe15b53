"""Runs the commands of docs/whirl.md, draws its pictures and compares the figures in its text.

usage: whirl.py TILTPAD FOLDER-FOR-RUNS
"""

import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import tiltpad
from tiltpad import command
from tiltpad.calculate.basins import basin
from tiltpad.calculate.branches import bifurcations

DOCS = Path(__file__).resolve().parent


def run(page: str, program: str, folder: Path) -> None:
    """The commands of the page in their order; files of results stay in the folder."""
    for line in re.findall(r"```sh\n(.*?)```", page, re.DOTALL):
        for each in line.splitlines():
            first, *words = shlex.split(each)
            if first == "tiltpad":
                case = DOCS.parent / words[0]
                subprocess.run([program, case, *words[1:], "--overwrite"], cwd=folder, check=True)
                continue
            own = [str(folder / word) if word.endswith((".h5", ".png")) else word for word in words]
            if command.main(own):
                sys.exit(f"docs/whirl.md: {each}")
            shutil.copy(own[-1], DOCS / "images")


def figures(folder: Path) -> Iterator[str]:
    """The words of the page with figures, as the runs have them now."""
    with tiltpad.read(folder / "cycles.h5") as cycles, tiltpad.read_study(folder / "starts.h5") as study:
        found, special = basin(study, cycles), bifurcations(cycles)
    hopf, fold = ([each for each in special if each.kind == kind][0] for kind in ("hopf", "fold"))
    yield f"threshold speed, {hopf.parameter:.0f} rpm"
    yield f"a fold at {fold.parameter:.0f} rpm"
    yield f"The unstable cycle is {1e6 * found.cycle.max():.1f} um large"
    yield f"whirls is {1e6 * found.nearest:.1f} um away"
    yield f"{found.whirls.sum()} of {found.done.sum()} whirl, with {1e6 * found.amplitude.max():.0f} um"
    with tiltpad.read(folder / "five.h5") as five:
        special = [(each.kind, each.branch, f"{each.parameter:.5f} kg m") for each in bifurcations(five)]
    places = {each[:2]: each[2] for each in reversed(special)}
    yield f"up to an unbalance of {places['period_doubling', 1]}"
    yield f"at a fold at {places['fold', 2]}"
    yield f"doubles again at {places['period_doubling', 2]}"
    yield f"to a torus at {places['neimark_sacker', 4]}"
    yield f"period doubling at {[each[2] for each in special if each[:2] == ('period_doubling', 1)][1]}"
    yield f"follows at {places['neimark_sacker', 1]}"
    with tiltpad.read(folder / "torus.h5") as torus, tiltpad.read(folder / "doubled.h5") as doubled:
        yield f"(`R2`) at {torus['second_parameter'][-1]:.0f} rpm"
        yield f"turns back at about {round(doubled['second_parameter'].min(), -1):.0f} rpm"
        lowest = torus["second_parameter"][np.argmin(torus["parameter"])]
        yield f"at about {round(lowest, -3):.0f} rpm"


def main() -> None:
    program, folder = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    page = (DOCS / "whirl.md").read_text()
    run(page, program, folder)
    if wrong := [words for words in figures(folder) if words not in page]:
        sys.exit(f"docs/whirl.md: other figures now: {wrong}")


if __name__ == "__main__":
    main()
