"""Every scene of input/ with the default settings: wall time, and error against a refined run of its own."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import tiltpad
from runner import Row, Runner, deviations
from settings import REFINED, ROOT, RUPTURED_DURATION, RUPTURED_REFINED, RUPTURED_SHARE, Scene


def scenes() -> list[Scene]:
    """All cases of the project."""
    paths = [*sorted(ROOT.glob("input/paper/*.nml")), *sorted(ROOT.glob("input/examples/*.nml"))]
    return [Scene(path.stem, path.stem, str(path.relative_to(ROOT))) for path in paths]


def cases(runner: Runner) -> Iterator[Row]:
    """First the timed runs, alone; then the references, side by side."""
    rows, cuts = [], {}
    for scene in scenes():
        row, path = runner.run(scene, "defaults", "defaults")
        if not row.note:
            with tiltpad.read(path) as run:
                cuts[scene] = cut(run.input["operation"])
        path.unlink(missing_ok=True)
        rows.append((scene, row))
    # the slowest first
    waiting = sorted(rows, key=lambda each: -each[1].wall_seconds)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda job: judge(runner, *job[1], cuts.get(job[1][0]), job[0]), enumerate(waiting)))
    yield from (row for _, row in rows)


def cut(operation: dict[str, float]) -> tuple[str, ...]:
    """The first part of a march, with the same speed at the same time."""
    first, last = operation["speed_rpm"], operation["final_speed_rpm"]
    last = first + (last - first) * RUPTURED_DURATION / operation["duration"]
    return f"operation%duration={RUPTURED_DURATION}", f"operation%final_speed_rpm={last:.9g}"


def ruptured(row: Row) -> bool:
    """Whether so much of the film is ruptured that the finite volumes decide."""
    return row.finite_volumes > RUPTURED_SHARE * row.film_evaluations


def judge(runner: Runner, scene: Scene, row: Row, shorter: tuple[str, ...], core: int) -> None:
    """Enters the error of the defaults, and how far the reference still moves."""
    if row.note:
        return

    def run(label: str, overrides: tuple[str, ...], more: tuple[str, ...] = ()) -> tuple[Row, Path]:
        return runner.run(scene, "", label, overrides + more, timed=False, core=core)

    more = ()
    runs = [run(*each) for each in REFINED[:2]]
    if ruptured(runs[-1][0]):
        remove(runs)
        more = shorter
        runs = [run(*each, more) for each in RUPTURED_REFINED]
    else:
        runs.append(run(*REFINED[2]))
    good = [each for each in runs if not each[0].note]
    again, path = run("defaults", (), more)
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
