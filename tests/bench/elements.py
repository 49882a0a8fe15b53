"""What shafts have beside bearings: a compressor with seals, its stability levels, a rotor in dampers."""

import re
from collections.abc import Iterator

import numpy as np
from runner import Row, Runner
from settings import ROOT, Case
from tables import short, table, verdict

EXAMPLES = ROOT / "input/examples"
SPEEDS = np.linspace(2000, 12000, 100)
#: Changes of the bearing clearances with which level I is found, m.
CLEARANCES = (-10e-6, 10e-6)
TILTPAD, MAP, LEVEL, MARCH, WITHOUT = "tiltpad", "map", "level", "dampers", "without"
LABELS = {
    MAP: f"modes of the compressor with its seals at {len(SPEEDS)} speeds, a core",
    LEVEL: "level I of the compressor, two clearances",
    MARCH: "march of the aero rotor in two dampers, 2 s",
    WITHOUT: "the same without the dampers",
}
#: Processor seconds to stay below; of the march over that without dampers.
LIMITS = {MAP: 1.5, LEVEL: 0.5, MARCH: 1.2}


def elements(runner: Runner) -> Iterator[Row]:
    """The map, the level and the marches."""
    # the table of the piston stands beside the example
    compressor = (EXAMPLES / "compressor.nml").read_text().replace("input/examples", str(EXAMPLES))
    bare = without(compressor, "impeller", "lateral")
    speeds = ", ".join(f"{each:.10g}" for each in SPEEDS)
    yield timed(runner, MAP, f"{bare}\n&sweep operation%speed_rpm = {speeds} /\n")
    # seals are of level 2
    level_i = without(compressor, "element")
    rows = [
        timed(runner, LEVEL, level_i, f"bearing%assembled_clearance={78e-6 + each!r}") for each in CLEARANCES
    ]
    rows[0].work_seconds = sum(row.work_seconds or 0 for row in rows)
    rows[0].note = rows[0].note or rows[1].note
    yield rows[0]
    aero = without((EXAMPLES / "aero.nml").read_text(), "branch")
    march = "case%task=march", "operation%duration=2"
    yield timed(runner, MARCH, aero, *march)
    yield timed(runner, WITHOUT, without(aero, "damper"), *march)


def without(text: str, *groups: str) -> str:
    """The text of a case without some of its groups."""
    return re.sub(rf"^&({'|'.join(groups)})\b.*?/\n", "", text, flags=re.MULTILINE | re.DOTALL)


def timed(runner: Runner, name: str, text: str, *overrides: str) -> Row:
    """A run of a case whose file stands in the runner's folder; its result is removed."""
    path = runner.folder / f"elements_{name}.nml"
    path.write_text(text)
    row, result = runner.run(Case(name, LABELS[name], str(path), overrides), TILTPAD, "defaults")
    result.unlink(missing_ok=True)
    return row


def compared(rows: list[Row]) -> str:
    """Processor times, steps, and the figures to reach."""
    seconds = {row.case: row.work_seconds for row in rows if not row.note}
    lines = []
    for row in rows:
        if row.note:
            lines.append((LABELS[row.case], row.note, *[""] * 3))
            continue
        found, limit, unit = row.work_seconds, LIMITS.get(row.case), " s"
        if row.case == MARCH and WITHOUT in seconds:
            found, unit = found / seconds[WITHOUT], " times that without"
        ends = (f"{limit:g}{unit}", verdict(found, limit)) if limit else ("", "")
        lines.append((LABELS[row.case], short(row.work_seconds), row.steps or "-", *ends))
    return table(" | s | steps | to reach | ", lines)
