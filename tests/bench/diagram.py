"""Run time against error of the main scenes, and the ladders of refinement that their references stand on."""

from collections.abc import Iterator

from errors import deviations
from runner import Row, Runner
from settings import DIAGRAM, FINE, LADDERS, MAIN, UNRUPTURED, Scene

#: Groups of the ladder's rows: what the deviations are taken over.
LAST, WHOLE = "last revolution", "whole run"


def ladder(runner: Runner) -> Iterator[Row]:
    """Every refinement against the finest, which stays as the reference; the finest, slowest, start first."""
    runs = [(scene, LAST, *rung) for scene, rungs in LADDERS.items() for rung in rungs]
    runs.sort(key=march_tolerance)
    found = {(row.scene, row.setting): (row, path) for row, path in runner.many(runs)}
    for scene, rungs in LADDERS.items():
        rows = [found[scene.name, label] for label, _ in rungs]
        finest, reference = rows[-1]
        if finest.note:
            raise RuntimeError(f"no reference for {scene.label}: {finest.note}")
        runner.references[scene.name] = reference
        for row, path in rows[:-1]:
            if not row.note:
                row.compare(deviations(path, reference))
            yield row
            if not row.note and varies(scene):
                again = Row(row.part, row.scene, WHOLE, row.setting, row.overrides)
                again.compare(deviations(path, reference, whole=True))
                yield again
            path.unlink(missing_ok=True)
        yield finest


def march_tolerance(run: tuple) -> float:
    """Tolerance of the march of a run of the ladder."""
    return float(run[2].split()[1].rstrip(","))


def varies(scene: Scene) -> bool:
    """Whether a scene runs through different speeds, so that its last revolution does not stand for all."""
    return "runup" in scene.name


def diagram(runner: Runner) -> Iterator[Row]:
    """Timed runs of every group and scene."""
    if not runner.references:
        list(ladder(runner))
    for group, settings in DIAGRAM.items():
        for setting in settings:
            for scene in MAIN:
                yield runner.judged(runner.references[scene.name], scene, group, *setting)
    for scene in UNRUPTURED:
        yield runner.judged(runner.references[scene.name], scene, "cavitation 'none'", *FINE)
