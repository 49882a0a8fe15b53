"""Run time against error of the main cases, and the ladders of refinement that their references stand on."""

from collections.abc import Iterator

from errors import deviations
from runner import Row, Runner
from settings import DIAGRAM, FINE, FULL_FILM, LADDERS, MAIN, Case

#: Groups of the ladder's rows: what the deviations are taken over.
LAST, WHOLE = "last revolution", "whole run"


def ladder(runner: Runner) -> Iterator[Row]:
    """Every refinement against the finest, which stays as the reference; the finest, slowest, start first."""
    runs = [(case, LAST, *rung) for case, rungs in LADDERS.items() for rung in rungs]
    runs.sort(key=march_tolerance)
    found = {(row.case, row.setting): (row, path) for row, path in runner.many(runs)}
    for case, rungs in LADDERS.items():
        rows = [found[case.name, label] for label, _ in rungs]
        finest, reference = rows[-1]
        if finest.note:
            raise RuntimeError(f"no reference for {case.label}: {finest.note}")
        runner.references[case.name] = reference
        for row, path in rows[:-1]:
            if not row.note:
                row.compare(deviations(path, reference))
            yield row
            if not row.note and varies(case):
                again = Row(row.part, row.case, WHOLE, row.setting, row.overrides)
                again.compare(deviations(path, reference, whole=True))
                yield again
            path.unlink(missing_ok=True)
        yield finest


def march_tolerance(run: tuple) -> float:
    """Tolerance of the march of a run of the ladder."""
    return float(run[2].split()[1].rstrip(","))


def varies(case: Case) -> bool:
    """Whether a case runs through different speeds, so that its last revolution does not stand for all."""
    return "runup" in case.name


def diagram(runner: Runner) -> Iterator[Row]:
    """Timed runs of every group and case."""
    if not runner.references:
        list(ladder(runner))
    for group, settings in DIAGRAM.items():
        for setting in settings:
            for case in MAIN:
                yield runner.judged(runner.references[case.name], case, group, *setting)
    for case in FULL_FILM:
        yield runner.judged(runner.references[case.name], case, "cavitation 'none'", *FINE)
