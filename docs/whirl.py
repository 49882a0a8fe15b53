"""Runs the commands of docs/whirl.md, draws its pictures and compares the figures in its text.

usage: whirl.py TILTPAD FOLDER-FOR-RUNS
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import tiltpad
from page_commands import follow
from tiltpad.calculate.basins import basin
from tiltpad.calculate.branches import bifurcations


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


if __name__ == "__main__":
    follow("whirl.md", figures)
