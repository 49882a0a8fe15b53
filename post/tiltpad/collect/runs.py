"""Runs of a study: how a run ended, the figures in its file, Poincare points."""

import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate import signals
from tiltpad.collect.parameters import varied_values
from tiltpad.files import namelist
from tiltpad.files.archive import NotInRunError, RunError, damaged, reading
from tiltpad.files.read import TEXTS, Run, read
from tiltpad.files.study import POINTS, REVOLUTIONS

#: Exit status of a run that was done, and those of one that did not end: running or killed, stopped.
DONE, UNENDED = 0, (-1, 4)
#: Most runs of a study.
MOST = 1_000_000
#: Name of a dataset as the program writes it.
DATASET = re.compile(r"[a-z]\w*", re.ASCII)
#: Groups of a run's file that are columns of a study, and what stands before the names in them.
GROUPS = {
    **dict.fromkeys(("summary", "by_revolution", "coefficients", "modes", "statistics"), ""),
    **{group: f"{group}_" for group in ("equilibrium", "periodic", "response", "synchronous")},
}
#: Groups that a run has not which was not done, and the figures in them that it has.
OF_MOTION = ("summary", "by_revolution")
OF_ANY = ("speed", "time_reached", "equilibrium_")


class StudyRun(NamedTuple):
    """A run as a study has it."""

    path: Path
    number: int | None  # in the study; None of a run of its own
    status: float  # with which the program ended; nan: the file cannot be read
    reason: str  # where it failed
    runs: int | None = None  # of the whole study
    varied: dict[str, Any] = {}  # its own values by variable
    # checksums of the study: up to the run before, up to this one, of all; None where they are not known
    marks: tuple[str, str, str] | None = None
    input: dict[str, dict[str, Any]] = {}  # resolved namelist, empty where the file cannot be read
    origin: dict[str, str] = {}  # build, title and input text
    values: dict[str, Any] = {}  # its columns of the study, with their dimensions less the run
    # of those that are datasets of its file: their names there, and these dimensions; of a bearing of a
    # machine both stand in its group
    found: dict[str, tuple[str, tuple[str, ...]]] = {}
    labels: dict[str, Sequence[Any]] = {}  # values of its dimensions
    remarks: Sequence[str] = ()  # those on it


def one_run(path: Path) -> StudyRun:
    """The run of a file; only with the reason where the file cannot be read."""
    try:
        with read(path) as run:
            return measured(path, run)
    except RunError as error:
        return unreadable(path, f"{error}")
    except Exception as error:
        # whatever a damaged file brings about, the other runs are to be collected
        return unreadable(path, f"{damaged(f'{path}', 'it', error)}")


def unreadable(path: Path, reason: str) -> StudyRun:
    """The run of a file that cannot be read; its number is that in its name, if any."""
    stem = path.stem
    number = int(stem) if stem.isascii() and stem.isdecimal() and len(stem) <= len(f"{MOST}") else 0
    return StudyRun(path, number if 1 <= number <= MOST else None, np.nan, reason)


def measured(path: Path, run: Run) -> StudyRun:
    """The run of a run that can be read."""
    attributes = run.attributes
    complete = bool(run.complete)
    with reading(run.path, "its place in a study"):
        number, runs, varied, marks = place(attributes)
    status = int(attributes.get("exit_status", DONE if complete else 2))
    if not complete and status == DONE:
        status = UNENDED[0]
    reason = f"{attributes.get('reason', '')}" if status != DONE else ""
    values: dict[str, Any] = {"complete": float(complete)}
    if "resumes" in attributes:
        values["resumes"] = float(attributes["resumes"])
    there = columns(run, complete and status == DONE)
    own = {name: (*each, value(run, each[0])) for name, each in there.items()}
    # what is not a number anywhere is nothing that the run has
    found = {name: (path, over) for name, (path, over, numbers) in own.items() if not np.isnan(numbers).all()}
    values |= {name: own[name][2] for name in found}
    if complete and status == DONE and "by_revolution" not in run and not run.is_machine:
        # the file is of an earlier version
        with suppress(NotInRunError):
            points = signals.poincare(run, REVOLUTIONS, states=tuple(POINTS.values()))
            values |= {name: points[state] for name, state in POINTS.items() if state in points}
            values |= ends_of_revolutions(run, len(points["time"]))
    known = dict.fromkeys(each for _, dimensions in found.values() for each in dimensions)
    labels = {name: value(run, name).tolist() for name in known}
    if twice := [name for name, own in labels.items() if len(set(own)) < len(own)]:
        raise damaged(f"{path}", twice[0], "a label is there twice")
    groups = [each.group for each in run.bearings.values()] or [""]
    counts = {group: len(values.get(f"{group}poincare_y", ())) for group in groups}
    return StudyRun(
        path,
        number,
        status,
        reason,
        runs,
        varied,
        marks,
        run.input,
        {name: attributes[name] for name in ("title", "input")} | {"build": build_of(attributes)},
        values,
        found,
        labels
        | {f"{group}pad": value(run, f"{group}pad").tolist() for group in groups}
        | {f"{group}revolution": range(1 - count, 1) for group, count in counts.items()},
        run.remarks,
    )


def build_of(attributes: dict[str, Any]) -> str:
    """Version and commit of the program that wrote a file: "0.1.0 (4ff53e12)"."""
    return f"{attributes['version']} ({attributes.get('commit', 'unknown')})"


def place(attributes: dict[str, Any]) -> tuple[int | None, int | None, dict[str, Any], Any]:
    """Number, runs, values and marks of a run of a study; None, None, {} and None of another run.

    Raises ValueError where they are not those of a study that the program makes.
    """
    if "run" not in attributes:
        return None, None, {}, None
    number, runs = (int(attributes.get(name, 0)) for name in ("run", "runs"))
    if not 1 <= number <= runs <= MOST:
        raise ValueError(f"run {number} of {runs}")
    varied = varied_values(attributes.get("sweep", ""))
    if strange := [name for name in varied if not namelist.VARIABLE.fullmatch(name)]:
        raise ValueError(f"{strange[0]!r} is no variable")
    marks = tuple(f"{attributes.get('study_marks', '')}".split())
    return number, runs, varied, marks if len(marks) == len(("before", "own", "all")) else None


def columns(run: Run, done: bool) -> dict[str, tuple[str, tuple[str, ...]]]:
    """Names and dimensions of the datasets that are columns of a study, by the columns' names.

    What pads have a value of is called so, where it is not already; of a run that was not done only what
    it had before. Those of a bearing of a machine are in its group.
    """
    found = own_columns(run, run.names, done)
    for bearing in run.bearings.values():
        own = set(bearing.own_names())
        for name, (path, dimensions) in own_columns(bearing, bearing.own_names, done).items():
            over = tuple(f"{bearing.group}{each}" if each in own else each for each in dimensions)
            found[bearing.group + name] = bearing.group + path, over
    return found


def own_columns(
    run: Run, names: Callable[[str], list[str]], done: bool
) -> dict[str, tuple[str, tuple[str, ...]]]:
    """The columns of a run, or of a bearing of a machine, that has datasets of these names in its groups."""
    found: dict[str, tuple[str, tuple[str, ...]]] = {}
    for group, before in GROUPS.items():
        for own in names(group) if group in run else ():
            if not DATASET.fullmatch(own) or f"{group}/{own}" in TEXTS:
                continue
            dimensions = run.scales(f"{group}/{own}")
            pads = "pad_" if dimensions == ("pad",) and not own.startswith("pad_") else ""
            if dimensions is not None and (done or group not in OF_MOTION or own.startswith(OF_ANY)):
                found[f"{pads}{before}{own}"] = f"{group}/{own}", dimensions
    return found


def part(run: Run, name: str) -> tuple[Run, str]:
    """The run, or its bearing, of which a dataset of the file is a result, and what it is called there."""
    for bearing in run.bearings.values():
        if name.startswith(bearing.group):
            return bearing, name.removeprefix(bearing.group)
    return run, name


def value(run: Run, name: str) -> Any:
    """The values of a dataset of the file, also of one in the group of a bearing."""
    own, name = part(run, name)
    return own[name]


def ends_of_revolutions(run: Run, count: int) -> dict[str, Any]:
    """Lowest and highest states of the revolutions that end at the last `count` Poincare points.

    They are nan for the first of these where no whole revolution is before it.
    """
    values = {}
    for state in (each for each in POINTS.values() if each in run):
        for way, each in zip(("lowest", "highest"), signals.extremes(run, state, count), strict=True):
            own = np.full((count, *each.shape[1:]), np.nan)
            own[count - len(each) :] = each
            values[f"{way}_{state.rpartition('_')[2]}"] = own
    return values


def planned(runs: Sequence[StudyRun]) -> int:
    """Number of runs that the study has, by the file that says most; 0 for single runs."""
    return max(each.runs or 0 for each in runs)
