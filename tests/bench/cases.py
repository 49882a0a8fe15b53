"""Every case of input/ with the default settings: wall time, and error against a refined run of its own."""

import os
import re
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from errors import deviations
from runner import Row, Runner
from settings import REFINED, ROOT, Case


def single_runs() -> list[Case]:
    """All cases of the project that are one run of one bearing."""
    paths = [*sorted(ROOT.glob("input/paper/*.nml")), *sorted(ROOT.glob("input/examples/*.nml"))]
    single = [path for path in paths if not re.search("&sweep|&shaft", path.read_text())]
    return [Case(path.stem, path.stem, str(path.relative_to(ROOT))) for path in single]


def cases(runner: Runner) -> Iterator[Row]:
    """First the timed runs, alone; then the references, side by side."""
    jobs = [(case, *runner.run(case, "defaults", "defaults")) for case in single_runs()]
    # the slowest first
    waiting = sorted(jobs, key=lambda job: -job[1].wall_seconds)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda job: compare(runner, *job[1], job[0]), enumerate(waiting)))
    yield from (row for _, row, _ in jobs)


def compare(runner: Runner, case: Case, row: Row, path: Path, core: int) -> None:
    """Enters the error of the defaults, and how far the reference still moves; removes the result files.

    Where the load moves no revolution stands for the others: the whole run counts.
    """
    runs = [runner.run(case, "", *each, timed=False, core=core) for each in REFINED]
    failed = [f"{each.setting}: {each.note}" for each, _ in runs if each.note]
    if not (row.note or failed):
        (_, coarse), (_, reference) = runs
        whole = "&excitation" in (ROOT / case.input_file).read_text()
        row.compare(deviations(path, reference, whole))
        row.reference_moved = deviations(coarse, reference, whole).largest
    row.note = "; ".join(filter(None, (row.note, *failed)))
    for each in (path, *(path for _, path in runs)):
        each.unlink(missing_ok=True)
