"""The tables of films, pads, production and peers, and the sentences that follow from them."""

import os

from figures import compared
from films import CHECK, UNEQUAL, exponent
from peers import DIFFERENCED, OWN, SCALAR, SCALED, SCIPY, TILTPAD
from production import CHECKPOINTS, COLLECT, LONG, SHORT, START, STUDY
from runner import Row
from settings import (
    CHECKPOINT_SHARE,
    COLLECT_SECONDS,
    MAIN,
    ONE_FILMS,
    ONE_SOLVER,
    RUN_MILLISECONDS,
    RUNS,
    START_MILLISECONDS,
    TOLERANCE_SPAN,
)
from skips import SAMPLE, TABLE
from tables import LABELS, NOT_RUN, SIGNALS, film_time, short, signals, small, table, verdict

#: Seconds of the case's whole march, and its pads.
OF, PADS = 2, 2


def films(rows: list[Row]) -> str:
    """Film solvers."""
    lines = []
    for row in (row for row in rows if row.group != CHECK):
        first = next(other for other in rows if other.case == row.case)
        over = f"{film_time(row) / film_time(first):.0f}"
        build = f"{row.film_nodes}", short(1e3 * row.building_seconds) if row.building_seconds else ""
        times = short(row.wall_seconds), short(1e6 * film_time(row)), over, *build
        lines.append((LABELS[row.case], row.setting, *times, small(row.error)))
    return table("case | film | wall s | film, us per pad | over table | nodes | building ms | error", lines)


def film_checks(rows: list[Row]) -> str:
    """Errors of films alone."""
    lines = [(LABELS[row.case], row.setting, *signals(row)) for row in rows if row.group == CHECK]
    return table(f"case | film | {SIGNALS}", lines)


def visits(rows: list[Row]) -> str:
    """Cells and nodes that runs built, and what that took of them."""
    lines = []
    for row in rows:
        counts = f"{row.rotor_seconds:g}", row.film_evaluations, row.film_cells, row.film_nodes
        share = f"{row.building_seconds / row.wall_seconds:.0%}"
        solved = f"{row.film_solved / row.film_evaluations:.1%}"
        lines.append((LABELS[row.case], *counts, short(1e3 * row.building_seconds), share, solved))
    counts = "rotor s | films | cells | nodes"
    return table(f"case | {counts} | building ms | of the run | films left to `direct`", lines)


def kernels(rows: list[Row]) -> str:
    """One evaluation of a film."""
    rows = [row for row in rows if row.group != TABLE]
    forces = [row for row in rows if row.setting == "force"]
    derivatives = {(row.case, row.group): row for row in rows if row.setting != "force"}
    lines = []
    for row in forces:
        both = row.film_seconds, derivatives[row.case, row.group].film_seconds
        lines.append((row.case, row.group, *(short(1e6 * each) for each in both), small(row.error)))
    head = "film, cavitation | solver, cells along the arc | force, us | force and derivatives, us | error"
    return table(head, lines)


def skips(rows: list[Row]) -> str:
    """What is left out, and what that saves."""
    lines = []
    for without, kept in zip(rows[::2], rows[1::2], strict=True):
        saved = 1 - without.wall_seconds / kept.wall_seconds
        times = short(without.wall_seconds), short(kept.wall_seconds)
        lines.append((without.case, *times, f"{saved:.0%}", f"{without.steps}, {kept.steps}"))
    return table("omitted work | wall s | wall s with it | saved | steps without, with", lines)


def skips_words(runs: list[Row], kernels: list[Row]) -> str:
    """What is left out of a right-hand side and of a sample, from the times of one film."""
    run = next((row for row in runs if row.group == "defaults" and row.case == MAIN[1].name), None)
    film = {
        row.setting: row.film_seconds
        for row in kernels
        if (row.case, row.group) == (ONE_FILMS[1], ONE_SOLVER)
    }
    contact = next((row for row in kernels if row.group == TABLE), None)
    if not (run and film and contact):
        return ""
    derivatives = PADS * (run.rhs - run.jacobians) * (film["with derivatives"] - film["force"])
    samples = round(run.rotor_seconds / SAMPLE)
    evaluated = PADS * samples * film["force"]
    return (
        f"In {run.rotor_seconds:g} s of `{run.case}` the program computes the derivatives of the film for "
        f"{run.jacobians} Jacobians; computing them with each of the {run.rhs} right-hand sides would take "
        f"{short(derivatives, 2)} s more. Its {samples} samples use the film at the ends of the steps; "
        f"evaluating the film at each sample would take {short(evaluated, 2)} s more (with the times of a "
        "film from the table in *One film*). A tilting-only case needs no contact table, which takes "
        f"{short(1e3 * contact.film_seconds, 2)} ms."
    )


def tolerances(rows: list[Row]) -> str:
    """Scaled and scalar absolute tolerances."""
    found = [row for row in rows if row.group == SCIPY and row.rotor_seconds == TOLERANCE_SPAN]
    lines = [(row.setting, short(row.wall_seconds), row.rhs, small(row.error_same_film)) for row in found]
    return table("absolute tolerances | wall s | right-hand sides | error", lines)


def tolerances_words(rows: list[Row]) -> str:
    """What the scalar tolerance costs and loses."""
    found = {row.setting: row for row in rows if row.group == SCIPY and row.rotor_seconds == TOLERANCE_SPAN}
    scaled, scalar = found.get(SCALED), found.get(SCALAR)
    if not (scaled and scalar and scaled.wall_seconds and scalar.wall_seconds):
        return ""
    longer = short(scalar.wall_seconds / scaled.wall_seconds, 2)
    larger = short(scalar.error_same_film / scaled.error_same_film, 2)
    return (
        f"With one scalar for all states the march takes {longer} times as long and has {larger} times "
        "the error."
    )


def pads(rows: list[Row]) -> str:
    """Cost over the number of pads."""
    lines = []
    for row in rows:
        side = 1e6 * row.march_seconds / row.rhs if row.rhs else None
        times = short(side), short(side / int(row.setting) if side else None)
        name = row.setting + (f", {UNEQUAL}" if row.group == UNEQUAL else "")
        counts = name, short(row.wall_seconds), row.steps, row.rhs
        tables = row.film_cells, short(1e3 * row.building_seconds), f"{row.memory_mb:.0f}"
        lines.append((*counts, *times, *tables, row.note))
    return table(
        "pads | wall s | steps | right-hand sides | us per right-hand side | us per pad | cells "
        "| building ms | MB | ",
        lines,
    )


def pads_words(rows: list[Row]) -> str:
    """The exponent."""
    good = [row for row in rows if row.rhs and row.group != UNEQUAL]
    if len(good) < 2:
        return ""
    power = exponent([int(row.setting) for row in good], [row.march_seconds / row.rhs for row in good])
    return f"By a fit, the time grows with the number of pads to the power {power:.2f}; 1 is linear."


def peers(rows: list[Row]) -> str:
    """Wall seconds a second of rotor time."""
    lines = []
    base = rate(next((row for row in rows if row.group == TILTPAD), None))
    shown = compared(rows)
    for row in rows:
        if not (row in shown or row.note or row.setting == SCALED + DIFFERENCED):
            continue
        name = f"{row.group.partition(',')[0]}, {row.setting}"
        if row.note:
            lines.append((name, row.note, *[""] * 7))
            continue
        each = rate(row)
        times = short(row.wall_seconds), short(each), short(OF * each), short(each / base)
        errors = small(error_of(row, rows)), small(row.error_same_film)
        lines.append((name, f"{row.rotor_seconds:g} s", *times, *errors, f"{row.memory_mb:.0f}"))
    times = f"wall s | wall s per second | {OF} s would take"
    return table(f" | marched | {times} | over tiltpad | error | same film | MB", lines)


def rate(row: Row | None) -> float | None:
    """Wall seconds a second of rotor time."""
    return row.wall_seconds / row.rotor_seconds if row and row.wall_seconds else None


def error_of(row: Row, rows: list[Row]) -> float | None:
    """Error of a row; of tiltpad's whole run that of its run as short as the peers'."""
    if row.group != TILTPAD:
        return row.error
    return next(
        (other.error for other in rows if other.group != TILTPAD and other.setting == row.setting), None
    )


def peers_words(rows: list[Row]) -> str:
    """What SciPy's own Jacobian costs; what the ratios are."""
    own = next((row for row in rows if row.group == SCIPY and row.setting == SCALED + OWN), None)
    other = next((row for row in rows if row.setting == SCALED + DIFFERENCED), None)
    base = next((row for row in rows if row.group == TILTPAD), None)
    if not (rate(own) and rate(other) and rate(base)):
        return ""
    longer = short(rate(other) / rate(own), 2)
    return (
        f"If SciPy computes the Jacobian itself by differences, it takes {longer} times as long again "
        f"(measured over {other.rotor_seconds:g} s): its differences are near rounding, and the change of "
        "the film's pressure by them is not larger than the error of the iterative film solution."
    )


def checkpoints(rows: list[Row]) -> str:
    """What checkpoints took of runs."""
    lines = []
    for row in (row for row in rows if row.group == CHECKPOINTS):
        share = row.checkpoint_seconds / row.wall_seconds
        rate = float(row.note.split()[0]) / row.wall_seconds
        times = short(row.wall_seconds), short(row.checkpoint_seconds, 2), short(row.copy_seconds, 2)
        lines.append((row.case, f"{rate:.1f}", *times, f"{share:.1%}", verdict(share, CHECKPOINT_SHARE)))
    times = "wall s | checkpoints s | copy of the file s"
    return table(f"case | MB/s written | {times} | share | below {CHECKPOINT_SHARE:.0%}", lines)


def study(rows: list[Row]) -> str:
    """A study of short runs and its collection."""
    walls = {(row.group, row.setting): row.wall_seconds for row in rows}
    if (STUDY, "all") not in walls:
        return NOT_RUN
    brief, long = walls[STUDY, f"{SHORT:g}"], walls[STUDY, f"{LONG:g}"]
    march = (long - brief) / (LONG - SHORT) * SHORT
    cores = os.cpu_count()
    beyond = 1e3 * (cores * walls[STUDY, "all"] / RUNS - march)
    again, collected = walls[STUDY, "again"], walls[COLLECT, "all"]
    started = 1e3 * walls[START, "--version"]
    lines = [
        ("start of the program, which prints its version", f"{short(started)} ms", f"{START_MILLISECONDS} ms",
         verdict(started, START_MILLISECONDS)),
        (f"all runs, {cores} at a time", f"{short(walls[STUDY, 'all'])} s", "", ""),
        ("a run beyond its march", f"{short(beyond)} ms", f"{RUN_MILLISECONDS} ms",
         verdict(beyond, RUN_MILLISECONDS)),
        ("the march of a run", f"{short(1e3 * march)} ms", "", ""),
        ("a run in a process of its own", f"{short(1e3 * brief)} ms", "", ""),
        ("a second call, with all runs complete", f"{short(again)} s", "", ""),
        ("collecting into one file", f"{short(collected)} s", f"{COLLECT_SECONDS} s",
         verdict(collected, COLLECT_SECONDS)),
    ]  # fmt: skip
    return table("quantity | measured | to reach | ", lines)
