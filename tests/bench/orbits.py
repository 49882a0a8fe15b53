"""Periodic orbits: the task `periodic` against the march that settles on the same motion."""

from collections.abc import Iterator

from errors import deviations
from runner import Row, Runner
from settings import LADDER, MAIN
from tables import short, small, table, verdict

#: Friction: none, LuGre, Bengisu-Akay.
CASES = MAIN[:3]
ORBIT = ("case%task=periodic",)
SETTINGS = (("march", ()), ("periodic", ORBIT))
REFERENCE, FINEST = LADDER[-1]
#: March and orbit are timed in turn so often; the best of each counts.
ROUNDS = 7
#: Time of the orbit over that of the march, and its error.
RATIO, ERROR = 0.1, 1e-4


def orbits(runner: Runner) -> Iterator[Row]:
    """The march and the orbit of each case, whole processes, and the orbit's error."""
    for case in CASES:
        row, reference = runner.run(case, case.label, REFERENCE, (*ORBIT, *FINEST), timed=False)
        yield row
        best: dict[str, Row] = {}
        for _ in range(ROUNDS):
            for setting, overrides in SETTINGS:
                row, path = runner.run(case, case.label, setting, overrides, repeat=False)
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
    for case in CASES:
        found = {row.setting: row for row in rows if row.case == case.name}
        if not found:
            continue
        march, orbit = found["march"], found["periodic"]
        ratio = orbit.wall_seconds / march.wall_seconds
        words = f"`{case.name}` ({case.label})", short(march.wall_seconds), short(orbit.wall_seconds)
        errors = map(small, (orbit.error_pad_tilt, orbit.error_friction_moment, orbit.error))
        reached = verdict(ratio, RATIO), *errors, verdict(orbit.error, ERROR)
        lines.append((*words, short(ratio), *reached))
    errors = f"tilt | friction moment | error | to reach: {ERROR:.0e}"
    return table(f" | march, s | orbit, s | ratio | to reach: {RATIO:g} | {errors}", lines)
