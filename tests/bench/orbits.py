"""Periodic orbits: the task `periodic` against the march that settles on the same motion."""

from collections.abc import Iterator

from errors import deviations
from runner import Row, Runner
from settings import LADDER, MAIN
from tables import short, small, table, verdict

#: Friction: none, LuGre, Bengisu-Akay.
SCENES = MAIN[:3]
ORBIT = ("case%task=periodic",)
SETTINGS = (("march", ()), ("periodic", ORBIT))
REFERENCE, FINEST = LADDER[-1]
#: March and orbit are timed in turn so often; the best of each counts.
ROUNDS = 7
#: Time of the orbit over that of the march, and its error.
RATIO, ERROR = 0.1, 1e-4


def orbits(runner: Runner) -> Iterator[Row]:
    """The march and the orbit of each scene, whole processes, and the orbit's error."""
    for scene in SCENES:
        row, reference = runner.run(scene, scene.label, REFERENCE, (*ORBIT, *FINEST), timed=False)
        yield row
        best: dict[str, Row] = {}
        for _ in range(ROUNDS):
            for setting, overrides in SETTINGS:
                row, path = runner.run(scene, scene.label, setting, overrides, repeat=False)
                if setting == "periodic" and not row.note:
                    row.compare(deviations(path, reference))
                path.unlink(missing_ok=True)
                if setting not in best or row.wall_seconds < best[setting].wall_seconds:
                    best[setting] = row
        reference.unlink(missing_ok=True)
        yield from best.values()


def compared(rows: list[Row]) -> str:
    """Times and errors, and the figures to reach."""
    lines = []
    for scene in SCENES:
        found = {row.setting: row for row in rows if row.scene == scene.name}
        if not found:
            continue
        march, orbit = found["march"], found["periodic"]
        ratio = orbit.wall_seconds / march.wall_seconds
        words = f"`{scene.name}` ({scene.label})", short(march.wall_seconds), short(orbit.wall_seconds)
        errors = map(small, (orbit.error_pad_tilt, orbit.error_friction_moment, orbit.error))
        reached = verdict(ratio, RATIO), *errors, verdict(orbit.error, ERROR)
        lines.append((*words, short(ratio), *reached))
    errors = f"tilt | friction moment | error | to reach: {ERROR:.0e}"
    return table(f" | march, s | orbit, s | ratio | to reach: {RATIO:g} | {errors}", lines)
