"""How many bearings each search of an equilibrium serves."""

import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import ordinary_bearings
import stress_cases
from limited import limited
from report import table
from stress_judge import LOST

#: Cases of the stress test, of each of its seeds, and bearings as they are built.
CASES, SEEDS, BEARINGS = 500, (1, 2), 400
#: CPU time, s, of one.
LIMIT = 60
#: The searches in their order, and what they are.
SEARCHES = {
    "first": "pseudo-transient continuation from a start along the load",
    "full films": "the same with full films, and from there with films that cavitate",
    "pads": "every pad in its equilibrium, then the journal, from six starts",
    "newton": "pseudo-transient continuation from these",
    "none": "no equilibrium found",
}

SECTION = """
## Searches of an equilibrium

The searches follow each other until one finds an equilibrium that is stable; the table counts those that
found what was kept, in {cases} cases (seeds {seeds}) and {bearings} bearings as they are built
(`tests/stress/ordinary_bearings.py`: three to six pads, 30 to 500 mm, 0.1 to 4 MPa, 10 to 90 m/s).

{rows}

A search stays in the program if it finds more than one in 200 that none before it finds. Newton's method in
parts of its steps, the motion itself, pads tilted so that full films pull the journal, and pads balanced
along all their tilts did not: what they cost, and the program is without, are the lost cases {lost},
which are refused, and none of the bearings. A dozen others whose instability grew less there, or that
have several equilibria, now start elsewhere. `stress.py --searches` counts again.
"""


def searches(program: Path, jobs: int) -> str:
    """The section of the page."""
    cases = [stress_cases.draw(seed, n) for seed in SEEDS for n in range(1, CASES + 1)]
    bearings = [ordinary_bearings.draw(1, n) for n in range(1, BEARINGS + 1)]
    with ThreadPoolExecutor(jobs) as pool:
        counts = [
            Counter(pool.map(lambda case: search_of(program, case), each)) for each in (cases, bearings)
        ]
    return section(*counts)


def section(cases: Counter, bearings: Counter) -> str:
    """The section with these counts."""
    rows = [(words, cases[name], bearings[name]) for name, words in SEARCHES.items()]
    return SECTION.format(
        cases=cases.total(), seeds=" and ".join(map(str, SEEDS)), bearings=bearings.total(),
        rows=table(("", "cases", "bearings"), rows),
        lost="; ".join(f"{', '.join(map(str, own))} of seed {seed}" for seed, own in LOST.items()),
    )  # fmt: skip


def search_of(program: Path, case: stress_cases.Case) -> str:
    """Which search finds the equilibrium of a case."""
    case["case"]["task"] = "equilibrium"
    with tempfile.TemporaryDirectory(prefix="tiltpad-searches-") as folder:
        (Path(folder) / "case.nml").write_text(stress_cases.text(case))
        if limited([program, "case.nml", "--quiet"], Path(folder), LIMIT).returncode != 0:
            return "none"
        with h5py.File(Path(folder) / "case.h5") as file:
            return file.attrs["equilibrium_search"]
