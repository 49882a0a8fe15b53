"""Warm oil: equilibria with temperatures against those with one viscosity, maps of speeds, and marches."""

import os
import shutil
from collections.abc import Iterator

from runner import Row, Runner, launch
from settings import ROOT, Case, tolerance
from settings import table as film_table
from tables import short, table, verdict

#: The examples with warm oil, and their tasks.
CASES = tuple(
    Case(name, label, f"input/examples/{name}.nml", (f"case%task={task}",))
    for name, label in (("warm_paper", "paper's pads"), ("warm_five_pads", "five pads"))
    for task in ("equilibrium", "coefficients")
)
WARM, COLD = ("temperatures", ()), ("one viscosity", ("thermal%model=none",))
FILM = ("temperatures along the films", ("thermal%model=film",))
#: Speeds of a map: equilibria on all cores. The maps: example, oil, and seconds to reach.
MAP, SPEEDS, MAP_SPEEDS = "map", "1000:8000:7", 1001
MAPS = (("warm_paper", WARM, 5.0), ("warm_five_pads", WARM, 5.0), ("warm_five_pads", FILM, 45.0))
#: Marches of the paper's pads with an oil whose viscosity does not fall (the same motion with and without
#: temperatures), and with VG 46; of five pads, most of which cavitate: oil, and what the time of a step over
#: that of the first is to stay below. What the others are measured from has close tolerances.
PAPER = Case("march", "steady_lugre", "input/paper/steady_lugre.nml")
FIVE = Case(
    *("march", "five pads, 5 s", "input/examples/warm_five_pads.nml"),
    ("case%task=march", "operation%duration=5"),
)
SAME_OIL = ("oil%reference_viscosity=0.019", "oil%temperature_exponent=0")
DIRECT = ("temperatures along the films, films by `direct`", (*FILM[1], "film%solver=direct"))
MARCHES = (
    (PAPER, COLD[0], SAME_OIL, None),
    (PAPER, "temperatures, the same viscosity", (*SAME_OIL, "thermal%model=pad"), 1.05),
    (PAPER, "temperatures, VG 46", ("oil%grade=46", "thermal%model=pad"), 1.05),
    (PAPER, f"{FILM[0]}, VG 46", ("oil%grade=46", *FILM[1]), 1.3),
    (PAPER, f"{DIRECT[0]}, VG 46", ("oil%grade=46", *DIRECT[1]), None),
    (FIVE, *COLD, None),
    (FIVE, *WARM, None),
    (FIVE, *FILM, 1.3),
    (FIVE, *DIRECT, None),
)
CLOSE = (*tolerance("1e-8"), *film_table("1.6e-6"))
#: Time of an equilibrium with temperatures over that of one without, and what temperatures along the films
#: may add to that of one without, s.
RATIO, FILM_SECONDS = 3.0, 0.04


def warm(runner: Runner) -> Iterator[Row]:
    """Single runs, the maps, and the marches."""
    for case in CASES:
        for setting, overrides in (COLD, WARM, FILM):
            yield single(runner, case, setting, overrides)
    for name, oil, _ in MAPS:
        yield over_speeds(runner, name, *oil)
    for case, setting, overrides, _ in MARCHES:
        close, reference = runner.run(case, case.label, setting, (*overrides, *CLOSE), timed=False)
        if close.note:
            raise RuntimeError(f"{case.label}, {setting}: {close.note}")
        yield runner.judged(reference, case, case.label, setting, overrides)
        reference.unlink()


def single(runner: Runner, case: Case, setting: str, overrides: tuple[str, ...]) -> Row:
    """One timed run."""
    row, path = runner.run(case, case.label, setting, overrides)
    path.unlink(missing_ok=True)
    return row


def over_speeds(runner: Runner, name: str, setting: str, overrides: tuple[str, ...]) -> Row:
    """A map of equilibria with temperatures."""
    folder = runner.folder / "speeds"
    words = ("case%task=equilibrium", f"sweep%operation%speed_rpm={SPEEDS}", *overrides)
    options = [word for each in words for word in ("--set", each)]
    input_file = ROOT / f"input/examples/{name}.nml"
    done = launch(
        [runner.program, input_file, "--quiet", "--overwrite", "--output", folder, *options], core=None
    )
    shutil.rmtree(folder, ignore_errors=True)
    row = Row(runner.part, MAP, name, setting, " ".join(words), done.seconds, MAP_SPEEDS)
    row.memory_mb = done.memory
    row.note = f"failed with status {done.status}: {done.said[-200:]}" if done.status else ""
    return row


def compared(rows: list[Row]) -> str:
    """Times, and the figures to reach."""
    lines = []
    for row in rows:
        if row.case == MAP:
            seconds = next(each for name, oil, each in MAPS if (name, oil[0]) == (row.group, row.setting))
            figure = f"{seconds:g} s", verdict(row.wall_seconds, seconds)
            words = f"{MAP_SPEEDS} speeds of `{row.group}`, {os.cpu_count()} cores", "equilibrium"
            lines.append((*words, row.setting, short(row.wall_seconds), "", *figure, ""))
        elif row.case == PAPER.name:
            lines.append(of_march(row, next(other for other in rows if march(other) == march(row))))
        else:
            cold = next(each for each in rows if (each.case, each.overrides.split()[0]) == key(row))
            lines.append(of_single(row, cold))
    return table(" | task | oil | wall s | over one viscosity | to reach |  | error", lines)


def key(row: Row) -> tuple[str, str]:
    """What a run with temperatures shares with the one without, which stands first."""
    return row.case, row.overrides.split()[0]


def of_single(row: Row, cold: Row) -> tuple:
    """A run of its own."""
    words = row.group, row.overrides.split()[0].partition("=")[2], row.setting, short(row.wall_seconds)
    if row is cold:
        return (*words, "", "", "", "")
    if row.setting == FILM[0]:
        more = row.wall_seconds - cold.wall_seconds
        return (*words, f"{short(more)} s more", f"{FILM_SECONDS:g} s more", verdict(more, FILM_SECONDS), "")
    ratio = row.wall_seconds / cold.wall_seconds
    return (*words, short(ratio), f"{RATIO:g}", verdict(ratio, RATIO), "")


def march(row: Row) -> tuple[str, str]:
    """What marches of one bearing share."""
    return row.case, row.group


def of_march(row: Row, cold: Row) -> tuple:
    """A march: its time of a step over that with one viscosity, and its error."""
    words = f"{row.group}, {row.steps} steps", "march", row.setting, short(row.march_seconds)
    if row is cold:
        return (*words, "", "", "", short(row.error))
    ratio = row.march_seconds / row.steps / (cold.march_seconds / cold.steps)
    known = {(case.label, setting): most for case, setting, _, most in MARCHES}
    most = known[row.group, row.setting]
    figure = (f"{most:g}", verdict(ratio, most)) if most else ("", "")
    return (*words, f"{short(ratio)} a step", *figure, short(row.error))
