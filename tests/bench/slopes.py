"""Pads that pitch on an inclined journal: a march over that of the same pads that only tilt."""

from collections.abc import Iterator

from runner import Row, Runner
from settings import Case
from tables import short, table, verdict

#: Laws of friction, their cases, and conditions of cavitation.
FRICTION = {"Bengisu-Akay": "steady_ba_10_05", "LuGre": "steady_lugre"}
CAVITATION = "none", "reynolds"
TILTING, PADS = "tilting_radial", ("tilting_radial_pitch", "tilting_radial_pitch_yaw")
#: Slopes of the journal, urad, and what the time over that of pads that only tilt is to stay below.
SLOPES, MOST = (100, 200, 400), 4
DURATION = "operation%duration=0.2"


def slopes(runner: Runner) -> Iterator[Row]:
    """Each law and condition with pads that only tilt, which stand first."""
    for law, name in FRICTION.items():
        for condition in CAVITATION:
            for pads, slope in [(TILTING, 0), *((pads, slope) for pads in PADS for slope in SLOPES)]:
                words = f"pads%motion={pads}", f"film%cavitation={condition}", DURATION
                case = Case(f"{law}, {condition}", law, f"input/paper/{name}.nml", words)
                inclined = (f"bearing%slope={slope}e-6, 0",) if slope else ()
                row, path = runner.run(case, f"{slope}", pads, inclined)
                path.unlink(missing_ok=True)
                yield row


def compared(rows: list[Row]) -> str:
    """Processor times, and those over the times of pads that only tilt."""
    lines = []
    for row in rows:
        law, condition = row.case.split(", ")
        tilting = next(each for each in rows if each.case == row.case)
        ends = "", "", ""
        if row is not tilting:
            ratio = row.work_seconds / tilting.work_seconds
            ends = short(ratio), f"{MOST}", verdict(ratio, MOST)
        words = law, condition, f"`{row.setting}`", row.group
        lines.append((*words, row.note or short(row.work_seconds), row.steps, *ends))
    return table("friction | cavitation | pads | slope, urad | s | steps | over tilting | to reach | ", lines)
