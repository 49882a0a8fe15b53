"""Every scene of input/ with the default settings: wall time, and error against a refined run of its own."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from runner import Row, Runner, deviations
from settings import REFINED, ROOT, RUPTURED_DURATION, RUPTURED_REFINED, RUPTURED_SHARE, Scene


def scenes() -> list[Scene]:
    """All cases of the project."""
    paths = [*sorted(ROOT.glob("input/paper/*.nml")), *sorted(ROOT.glob("input/examples/*.nml"))]
    return [Scene(path.stem, path.stem, str(path.relative_to(ROOT))) for path in paths]


def cases(runner: Runner) -> Iterator[Row]:
    """First the timed runs, alone; then the references, side by side."""
    rows = []
    for scene in scenes():
        row, path = runner.run(scene, "defaults", "defaults")
        path.unlink(missing_ok=True)
        rows.append((scene, row))
    # the slowest first
    waiting = sorted(rows, key=lambda each: -each[1].wall_seconds)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda job: judge(runner, *job[1], core=job[0]), enumerate(waiting)))
    yield from (row for _, row in rows)


def ruptured(row: Row) -> bool:
    """Whether so much of the film is ruptured that the finite volumes decide."""
    return row.finite_volumes > RUPTURED_SHARE * row.film_evaluations


def judge(runner: Runner, scene: Scene, row: Row, core: int) -> None:
    """Enters the error of the defaults, and how far the reference still moves."""
    if row.note:
        return

    def run(setting: tuple, *more: str) -> tuple[Row, Path]:
        label, overrides = setting
        return runner.run(scene, "", label, overrides + more, timed=False, core=core)

    duration = ()
    runs = [run(each) for each in REFINED[:2]]
    if ruptured(runs[-1][0]):
        remove(runs)
        duration = (f"operation%duration={RUPTURED_DURATION}",)
        runs = [run(each, *duration) for each in RUPTURED_REFINED]
    else:
        runs.append(run(REFINED[2]))
    good = [each for each in runs if not each[0].note]
    again, path = run(("defaults", ()), *duration)
    if len(good) > 1 and not again.note:
        row.compare(deviations(path, good[-1][1]))
        row.reference_moved = max(deviations(good[-2][1], good[-1][1]).values())
        fine = good[-1][0]
        row.reference_finite_volumes = fine.finite_volumes / max(1, fine.film_evaluations)
        row.rotor_seconds = again.rotor_seconds
    failed = [f"{each.setting}: {each.note}" for each, _ in (*runs, (again, path)) if each.note]
    row.note = "; ".join((f"reference: {good[-1][0].setting}" if good else "no reference", *failed))
    remove([*runs, (again, path)])


def remove(runs: list[tuple[Row, Path]]) -> None:
    """Result files that are no longer needed."""
    for _, path in runs:
        path.unlink(missing_ok=True)
