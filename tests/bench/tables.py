"""The tables of run time against error, and the sentences that follow from them."""

from collections.abc import Iterable

from diagram import LAST, WHOLE
from paper.tables import table as markdown
from runner import Row
from settings import (
    ALLOWED,
    DIAGRAM,
    FIGURES,
    FILM_CASES,
    FILM_MICROSECONDS,
    FILM_RATIO,
    FINE,
    FINE_ALLOWED,
    FULL_FILM,
    LADDERS,
    MAIN,
    MEMORY,
    ONE_FILMS,
    ONE_SOLVER,
    VISITS,
)

LABELS = {case.name: case.label for case in (*MAIN, *FULL_FILM, *FILM_CASES, *VISITS)}
SIGNALS = "journal y | journal z | tilt | friction moment"
NOT_RUN = "Not run."


def table(head: str, rows: Iterable[Iterable]) -> str:
    """A Markdown table under a head whose columns are separated by bars; without rows it was not run."""
    rows = list(rows)
    return markdown([each.strip() for each in head.split("|")], rows) if rows else NOT_RUN


def short(value: float | None, digits: int = 3) -> str:
    """A number of this many digits; '-' where there is none."""
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
    """Runs with the default settings, by case."""
    return {row.case: row for row in rows if row.group == "defaults"}


def figures(rows: list[Row], film_rows: list[Row], kernels: list[Row]) -> str:
    """Figures to reach against what was measured."""
    if not rows:
        return NOT_RUN
    found, lines = defaults(rows), []
    for case in MAIN:
        row, limit = found[case.name], FIGURES[case.name]
        name = f"{row.rotor_seconds:g} s of `{case.name}` ({case.label})"
        wall = f"{limit:g} s", f"{short(row.wall_seconds)} s", verdict(row.wall_seconds, limit)
        lines.append((name, *wall, small(row.error), verdict(row.error, ALLOWED)))
    memory = max(row.memory_mb for row in found.values())
    lines.append(
        ("maximum memory of these runs", f"{MEMORY} MB", f"{memory:.0f} MB", verdict(memory, MEMORY), "", "")
    )
    for case in FILM_CASES[: 2 if film_rows else 0]:
        ratio = film_ratio(film_rows, case.name)
        reached = verdict(ratio, FILM_RATIO, least=True)
        words = f"film time of a pad, sor 60 x 15 over the table ({case.label})"
        lines.append((words, FILM_RATIO, f"{ratio:.0f}", reached, "", ""))
    for name in ONE_FILMS:
        place = (name, ONE_SOLVER)
        for row in (row for row in kernels if (row.case, row.group) == place and row.setting != "force"):
            time = 1e6 * row.film_seconds
            figure = f"{FILM_MICROSECONDS:g} us", f"{short(time)} us", verdict(time, FILM_MICROSECONDS)
            words = f"one film with derivatives from the table ({name})"
            lines.append((words, *figure, small(row.error), ""))
    why = [
        f"`{case.name}`{REASONS[case.name]}."
        for case in MAIN
        if case.name in REASONS and (found[case.name].error or 0) > ALLOWED
    ]
    head = f"default settings | to reach | measured | | error | error below {ALLOWED:g}"
    return "\n\n".join([table(head, lines), *why])


def film_time(row: Row) -> float:
    """Time of one pad's film, s, without that of building tables."""
    return (row.film_seconds - row.building_seconds) / row.film_evaluations


def film_ratio(rows: list[Row], case: str) -> float:
    """Film time of `sor` on 60 x 15 over that of the table."""
    times = {row.setting: film_time(row) for row in rows if row.case == case and row.wall_seconds}
    return times["sor 60 x 15"] / times["table (default)"]


def fine(rows: list[Row]) -> str:
    """The setting that is to reach a hundredth of the error allowed."""
    lines = []
    for row in rows:
        if row.setting == FINE[0]:
            reached = verdict(row.error, FINE_ALLOWED)
            lines.append((LABELS[row.case], short(row.wall_seconds), *signals(row), reached))
    return table(f"case | wall s | {SIGNALS} | {FINE_ALLOWED:g} or better", lines)


def ladder(rows: list[Row]) -> str:
    """Deviation of every rung from the finest."""
    lines = []
    for row in rows:
        errors = [row.note or "reference", "", "", ""] if row.error is None else signals(row)
        lines.append((LABELS[row.case], row.setting, row.group, row.steps or "", *errors))
    return table(f"case | film and tolerance | over | steps | {SIGNALS}", lines)


def ladder_words(rows: list[Row]) -> str:
    """How good the references are."""
    second = {case.name: rungs[-2][0] for case, rungs in LADDERS.items()}
    last = [row for row in rows if row.setting == second[row.case] and row.error is not None]
    if not last:
        return ""

    def errors(over: str) -> str:
        return ", ".join(f"{small(row.error)} ({LABELS[row.case]})" for row in last if row.group == over)

    return (
        "So the error of the references is about the deviation of the last step but one, or smaller: "
        f"{errors(LAST)}; over the whole run, {errors(WHOLE)}."
    )


def totals(rows: list[Row]) -> list[tuple[str, str, float | None, float | None, dict[str, Row]]]:
    """Group, setting, run time and worst error over the cases (None: one failed), and the runs."""
    found: dict[tuple[str, str], dict[str, Row]] = {}
    for row in rows:
        if row.group in DIAGRAM:
            found.setdefault((row.group, row.setting), {})[row.case] = row
    lines = []
    for (group, setting), runs in found.items():
        whole = len(runs) == len(MAIN) and all(row.error is not None for row in runs.values())
        time = sum(row.wall_seconds for row in runs.values()) if whole else None
        lines.append((group, setting, time, max(row.error for row in runs.values()) if whole else None, runs))
    return sorted(lines, key=lambda line: line[2] if line[2] is not None else float("inf"))


def choice(rows: list[Row]) -> str:
    """The fastest setting below the error allowed."""
    lines = [line for line in totals(rows) if line[3] is not None]
    if not lines:
        return "Not run."
    good = [line for line in lines if line[3] < ALLOWED]
    own = next(line for line in lines if line[0] == "defaults")
    words = f"The defaults take {short(own[2])} s in total and have a maximum error of {small(own[3])}"
    if not good:
        return f"{words}; no setting is below {ALLOWED:g} on all of them."
    if good[0] is own:
        return f"{words}; they are the fastest setting below {ALLOWED:g} on all of them."
    group, setting, time, error, _ = good[0]
    fastest = f"{described(group, setting)} with {short(time)} s and {small(error)}"
    return f"{words}. The fastest setting below {ALLOWED:g} on all of them is {fastest}."


def described(group: str, setting: str) -> str:
    """A setting with what it varies."""
    return {"tolerance": f"tolerance {setting}", "table": f"table {setting}"}.get(group, setting)


def settings(rows: list[Row]) -> str:
    """Every setting of the diagram."""
    lines = []
    for group, setting, time, error, runs in totals(rows):
        each = (small(runs[case.name].error) if case.name in runs else "" for case in MAIN)
        mark = "**" if error is not None and error < ALLOWED else ""
        lines.append((described(group, setting), short(time), f"{mark}{small(error)}{mark}", *each))
    cases = " | ".join(case.label for case in MAIN)
    return table(f"setting | wall s, all | maximum error | {cases}", lines)


def cases(rows: list[Row]) -> str:
    """Every case with the defaults."""
    lines = []
    for row in rows:
        cost = short(row.wall_seconds), row.steps or "", short(row.memory_mb, 2)
        jump = f"{row.jump_degrees:.1e}" if row.jump_degrees else "-"
        errors = *signals(row), bold(row.error), jump, small(row.reference_moved)
        lines.append((f"`{row.case}`", *cost, row.film_cells, row.film_nodes, *errors))
    counts = "wall s | steps | MB | cells | nodes"
    return table(f"case | {counts} | {SIGNALS} | error | jumps, deg | reference change", lines)


def bold(error: float | None) -> str:
    """An error, bold where it is too large."""
    return f"**{small(error)}**" if error is not None and error > ALLOWED else small(error)


def cases_notes(rows: list[Row]) -> str:
    """Runs that stopped, and why."""
    found = [f"- `{row.case}`: {row.note}" for row in rows if row.note]
    return "\n".join(["Runs that stopped:", "", *found]) if found else ""


#: Why cases err by more.
REASONS = {
    "five_pads": ": pad 3 flutters at a frequency of its own, and its phase drifts, which the measure of "
    "[realistic.md](realistic.md) leaves out",
    "four_pads_reynolds": ": pad 4 carries nothing and moves at half the speed of the shaft; the size of "
    "this motion errs",
    "inclined": ": still, it starts with closer films than tables have, and bristles hold the difference",
}


def cases_words(rows: list[Row]) -> str:
    """How many cases stay below the error allowed."""
    if not rows:
        return ""
    good = [row for row in rows if row.error is not None and row.error <= ALLOWED]
    words = f"{len(good)} of {len(rows)} cases are below {ALLOWED:g}"
    bad = [f"`{row.case}` ({small(row.error)}{REASONS.get(row.case, '')})" for row in rows if row not in good]
    return f"{words}; these are above it: {', '.join(bad)}." if bad else f"{words}."
