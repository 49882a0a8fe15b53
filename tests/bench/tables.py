"""The tables of run time against error, and the sentences that follow from them."""

from collections.abc import Iterable

from diagram import LAST, WHOLE
from runner import Row
from settings import (
    ALLOWED,
    FIGURES,
    FILM_RATIO,
    FILM_SCENES,
    FINE,
    FINE_ALLOWED,
    LADDER,
    MAIN,
    MEMORY,
    RUPTURED_DURATION,
)

LABELS = {scene.name: scene.label for scene in (*MAIN, *FILM_SCENES)}
SIGNALS = ("journal y", "journal z", "tilt", "friction moment")
NOT_RUN = "Not run."


def table(head: Iterable, rows: Iterable[Iterable]) -> str:
    """A Markdown table."""
    head = list(head)
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def short(value: float | None, digits: int = 3) -> str:
    """A number of so many digits; '-' where there is none."""
    return "-" if value is None else f"{value:#.{digits}g}".rstrip(".")


def small(value: float | None) -> str:
    """An error."""
    return "-" if value is None else f"{value:.1e}"


def signals(row: Row) -> tuple[str, ...]:
    """Errors of the four signals."""
    return tuple(
        small(value)
        for value in (row.error_journal_y, row.error_journal_z, row.error_pad_tilt, row.error_friction_moment)
    )


def verdict(value: float | None, limit: float, least: bool = False) -> str:
    """Whether a figure is reached, and by how much it is not."""
    if value is None:
        return "failed"
    beyond = limit / value if least else value / limit
    if beyond <= 1:
        return "reached"
    return (
        f"**missed by {100 * (beyond - 1):.0f} %**" if beyond < 2 else f"**missed by a factor {beyond:.1f}**"
    )


def defaults(rows: list[Row]) -> dict[str, Row]:
    """Runs with the default settings, by scene."""
    return {row.scene: row for row in rows if row.group == "defaults"}


def figures(rows: list[Row], film_rows: list[Row]) -> str:
    """Figures to reach against what was measured."""
    if not rows:
        return NOT_RUN
    found, lines = defaults(rows), []
    for scene in MAIN:
        row, limit = found[scene.name], FIGURES[scene.name]
        seconds = f"{row.rotor_seconds:g} s of `{scene.name}` ({scene.label})"
        lines.append(
            (
                seconds,
                f"{limit:g} s",
                f"{short(row.wall_seconds)} s",
                verdict(row.wall_seconds, limit),
                small(row.error),
                verdict(row.error, ALLOWED),
            )
        )
    memory = max(row.memory_mb for row in found.values())
    lines.append(
        ("peak memory of these", f"{MEMORY} MB", f"{memory:.0f} MB", verdict(memory, MEMORY), "", "")
    )
    if film_rows:
        ratio = film_ratio(film_rows, FILM_SCENES[0].name)
        lines.append(
            (
                "film time of a pad, sor 60 x 15 over auto",
                f"{FILM_RATIO}",
                f"{ratio:.0f}",
                verdict(ratio, FILM_RATIO, least=True),
                "",
                "",
            )
        )
    head = "default settings", "to reach", "measured", "", "error", f"error below {ALLOWED:g}"
    return table(head, lines)


def film_time(row: Row) -> float:
    """Time of one pad's film, s."""
    return row.film_seconds / row.film_evaluations


def film_ratio(rows: list[Row], scene: str) -> float:
    """Film time of `sor` on 60 x 15 over that of `auto`."""
    times = {row.setting: film_time(row) for row in rows if row.scene == scene}
    return times["sor 60 x 15"] / times["auto (default)"]


def fine(rows: list[Row]) -> str:
    """The setting that is to reach a hundredth of the error allowed."""
    found = [row for row in rows if row.setting == FINE[0]]
    lines = [
        (
            LABELS[row.scene],
            short(row.wall_seconds),
            *signals(row),
            small(row.error),
            verdict(row.error, FINE_ALLOWED),
        )
        for row in found
    ]
    head = "scene", "wall s", *SIGNALS, "error", f"{FINE_ALLOWED:g} or better"
    return table(head, lines) if lines else NOT_RUN


def ladder(rows: list[Row]) -> str:
    """Deviation of every rung from the finest."""
    lines = [
        (
            LABELS[row.scene],
            row.setting,
            row.group,
            row.steps or "",
            *(signals(row) if row.error else ["0"] * 4),
        )
        for row in rows
    ]
    return table(("scene", "film and tolerance", "over", "steps", *SIGNALS), lines) if lines else NOT_RUN


def ladder_words(rows: list[Row]) -> str:
    """How good the references are."""
    last = {(row.scene, row.group): row.error for row in rows if row.setting == LADDER[-2][0]}
    if not last:
        return ""
    words = ", ".join(
        f"{LABELS[scene]} {small(error)}" for (scene, over), error in last.items() if over == LAST
    )
    whole = [f"{LABELS[scene]} {small(error)}" for (scene, over), error in last.items() if over == WHOLE]
    return f"So the references are good to about the deviation of the rung before the last: {words}" + (
        f"; over the whole run, {', '.join(whole)}." if whole else "."
    )


def totals(rows: list[Row]) -> list[tuple[str, str, float | None, float | None, dict[str, Row]]]:
    """Group, setting, run time and worst error over the scenes (None: one failed), and the runs."""
    found: dict[tuple[str, str], dict[str, Row]] = {}
    for row in rows:
        found.setdefault((row.group, row.setting), {})[row.scene] = row
    lines = []
    for (group, setting), runs in found.items():
        whole = len(runs) == len(MAIN) and all(row.error is not None for row in runs.values())
        time = sum(row.wall_seconds for row in runs.values()) if whole else None
        lines.append((group, setting, time, max(row.error for row in runs.values()) if whole else None, runs))
    return sorted(lines, key=lambda line: line[2] if line[2] is not None else float("inf"))


def choice(rows: list[Row]) -> str:
    """The cheapest setting below the error allowed."""
    lines = [line for line in totals(rows) if line[3] is not None]
    if not lines:
        return "not run."
    good = [line for line in lines if line[3] < ALLOWED]
    own = next(line for line in lines if line[0] == "defaults")
    words = f"the defaults take {short(own[2])} s in sum with a worst error of {small(own[3])}"
    if not good:
        return f"{words}; no setting is below {ALLOWED:g} on all of them."
    if good[0] is own:
        return f"{words}, and are the cheapest below {ALLOWED:g} on all of them."
    group, setting, time, error, _ = good[0]
    return (
        f"{words}. The cheapest below {ALLOWED:g} on all of them: {described(group, setting)}, "
        f"{short(time)} s, {small(error)}."
    )


def described(group: str, setting: str) -> str:
    """A setting with what it varies."""
    return f"tolerance {setting}" if group == "tolerance" else setting


def settings(rows: list[Row]) -> str:
    """Every setting of the diagram."""
    lines = []
    for group, setting, time, error, runs in totals(rows):
        each = (small(runs[scene.name].error) if scene.name in runs else "" for scene in MAIN)
        mark = "**" if error is not None and error < ALLOWED else ""
        lines.append((described(group, setting), short(time), f"{mark}{small(error)}{mark}", *each))
    head = "setting", "wall s, all five", "worst error", *(scene.label for scene in MAIN)
    return table(head, lines) if lines else NOT_RUN


def cases(rows: list[Row]) -> str:
    """Every scene with the defaults."""
    lines = []
    for row in rows:
        mark = "\\*" if row.rotor_seconds == RUPTURED_DURATION else ""
        share = row.finite_volumes / max(1, row.film_evaluations)
        both = f"{share:.1%}, {row.reference_finite_volumes or 0:.1%}"
        lines.append(
            (
                f"`{row.scene}`{mark}",
                short(row.wall_seconds),
                row.steps or "",
                short(row.memory_mb, 2),
                *signals(row),
                bold(row.error),
                small(row.reference_moved),
                both,
            )
        )
    head = "scene", "wall s", "steps", "MB", *SIGNALS, "error", "reference moves", "ruptured"
    return table(head, lines) if lines else NOT_RUN


def bold(error: float | None) -> str:
    """An error, bold where it is too large."""
    return f"**{small(error)}**" if error is not None and error > ALLOWED else small(error)


def cases_notes(rows: list[Row]) -> str:
    """References that are not what they were meant to be, and why."""
    found = [f"- `{row.scene}`: {row.note}" for row in rows if row.note.count(":") > 1]
    return "\n".join(["References that stopped, and what was taken instead:", "", *found]) if found else ""


def cases_words(rows: list[Row]) -> str:
    """How many scenes stay below the error allowed."""
    if not rows:
        return ""
    good = [row for row in rows if row.error is not None and row.error <= ALLOWED]
    words = f"{len(good)} of {len(rows)} scenes are below {ALLOWED:g}"
    bad = [f"`{row.scene}` ({small(row.error)})" for row in rows if row not in good]
    return f"{words}; above it: {', '.join(bad)}." if bad else f"{words}."
