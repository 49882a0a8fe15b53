"""Studies: the results of many runs in one file.

The runs are those of a parameter study, or any runs. The study has the parameters, results of the last
revolution, Poincare points and the cost of each run, and says where its file is; it does not have their
series over time.
"""

import os
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from tiltpad.collect.runs import DONE, UNENDED, StudyRun, one_run, planned
from tiltpad.collect.study_log import ranges, write_study
from tiltpad.files.archive import RunError, opened, plain, reading
from tiltpad.files.processes import side_by_side
from tiltpad.files.read import IncompleteRunWarning

PathLike = str | os.PathLike


#: Number of files from which on a further process saves time.
WORTH_A_PROCESS = 100


class RunWarning(UserWarning):
    """A run is missing, or its file cannot be read."""


class Collected(NamedTuple):
    """The numbers of runs by the way they ended, the missing runs, and the file of the study."""

    runs: int
    done: int
    failed: int
    incomplete: int
    unreadable: int
    missing: list[int]
    output: Path

    def __str__(self) -> str:
        parts = [f"{self.done} done, {self.failed} failed, {self.incomplete} incomplete"]
        parts += [f"{self.unreadable} unreadable"] if self.unreadable else []
        parts += [f"{len(self.missing)} missing"] if self.missing else []
        return f"{self.runs} runs: {', '.join(parts)}; written: {plain(f'{self.output}')}"


def collect(
    paths: str | os.PathLike | Sequence[str | os.PathLike], output: str | os.PathLike | None = None
) -> Collected:
    """Writes the study of a folder of results, or of result files, into one HDF5 file.

    `output` is by default the folder's name with .h5, in the working directory. A file that cannot be read
    becomes a run without values, with a RunWarning. Raises ValueError for runs of different studies
    and for an output that would replace anything but a study, and RunError if no file can be read.
    """
    given = [Path(each) for each in ([paths] if isinstance(paths, str | os.PathLike) else paths)]
    target = Path(output) if output is not None else default_output(given)
    # every file once, even if it is named twice
    files = list({file.resolve(): file for path in given for file in results(path, target)}.values())
    if not files:
        raise RunError(f"{given[0] if given else 'nothing'}: no result files (*.h5) in it")
    if any(file.resolve() == target.resolve() for file in files):
        raise ValueError(f"{target}: it is one of the results, and would be replaced by the study")
    check_replaceable(target)
    runs = gathered(files)
    for each in runs:
        if np.isnan(each.status):
            warnings.warn(each.reason, RunWarning, stacklevel=2)
    if not any(each.input for each in runs):
        raise RunError(f"{given[0]}: none of {len(runs)} files can be read")
    check_one_study(runs)
    runs = numbered(runs)
    missing = sorted(set(range(1, planned(runs) + 1)) - {each.number for each in runs})
    if missing:
        warnings.warn(f"{given[0]}: missing runs: {ranges(missing)}", RunWarning, stacklevel=2)
    write_study(target, runs, missing)
    done = sum(each.status == DONE for each in runs)
    unended = sum(each.status in UNENDED for each in runs)
    lost = sum(bool(np.isnan(each.status)) for each in runs)
    return Collected(len(runs), done, len(runs) - done - unended - lost, unended, lost, missing, target)


def gathered(files: Sequence[Path]) -> list[StudyRun]:
    """The runs of the files, read by as many processes as there are processors."""
    jobs = min(len(os.sched_getaffinity(0)), len(files) // WORTH_A_PROCESS)
    if jobs < 2:
        return silent_runs(files)
    try:
        parts = side_by_side(silent_runs, [files[k::jobs] for k in range(jobs)])
    except EOFError as error:
        raise RunError(f"{files[0].parent}: reading its files ended a process") from error
    return [parts[k % jobs][k // jobs] for k in range(len(files))]


def silent_runs(paths: Sequence[Path]) -> list[StudyRun]:
    """The runs of files, without the warning for an incomplete run, which its status shows."""
    with warnings.catch_warnings(action="ignore", category=IncompleteRunWarning):
        return [one_run(path) for path in paths]


def default_output(given: Sequence[Path]) -> Path:
    """The folder's name with .h5, in the working directory."""
    for path in given:
        if not path.exists():
            raise RunError(f"{path}: no such file or folder")
    folder = next((path for path in given if path.is_dir()), None)
    if folder is None:
        raise ValueError("a study of single files needs a name: give its output (-o)")
    return Path(f"{folder.resolve().name}.h5")


def results(path: Path, target: Path) -> list[Path]:
    """The result files of a folder in order, without the study itself; a file as it is."""
    if not path.is_dir():
        return [path]
    return sorted(file for file in path.glob("*.h5") if file.resolve() != target.resolve())


def check_replaceable(target: Path) -> None:
    """Refuses to replace a file that is not a study, such as the result of a run, or that cannot be read."""
    if target.suffix != ".h5":
        raise ValueError(f"{target}: the name must end in .h5")
    if target.exists():
        try:
            with opened(os.fspath(target)) as file, reading(os.fspath(target), "attribute 'task'"):
                # get() would take one that cannot be read for one that is not there
                study = "task" in file.attrs and file.attrs["task"] == "study"
        except RunError as error:
            raise RunError(f"{error}; it is not replaced") from error
        if not study:
            raise ValueError(
                f"{target}: it exists and is not a study; remove it, or give the study another name"
            )


def check_one_study(runs: Sequence[StudyRun]) -> None:
    """Raises ValueError for runs of two studies, and for two files of one run.

    The study may have got more runs since the first ones were run.
    """
    readable = [each for each in runs if each.input]
    first = readable[0]
    for each in readable[1:]:
        if (each.runs is None, *each.varied) != (first.runs is None, *first.varied):
            raise ValueError(
                f"{first.path} and {each.path}: not of one study: {kind(first)}, and {kind(each)}"
            )
    check_marks(readable)
    seen: dict[int, Path] = {}
    for each in readable:
        if each.number is not None and seen.setdefault(each.number, each.path) != each.path:
            raise ValueError(f"{seen[each.number]} and {each.path}: both are run {each.number}")


def check_marks(readable: Sequence[StudyRun]) -> None:
    """Raises ValueError where the checksums of the runs show that they are of two studies.

    Runs of studies of one size have the checksum of all runs in common. A study that has grown has the
    checksum of the smaller one at its last run.
    """
    marked = [(each, each.number or 0, each.runs or 0, each.marks) for each in readable if each.marks]
    marks = {number: (each, own) for each, number, _, own in marked}
    whole: dict[int, tuple[StudyRun, str]] = {}
    for each, number, runs, (before, _, of_all) in marked:
        others = [(*whole.setdefault(runs, (each, of_all)), of_all)]
        for beside, expected in ((number - 1, before), (runs, of_all)):
            if beside in marks:
                others.append((marks[beside][0], marks[beside][1][1], expected))
        for other, found, expected in others:
            if found != expected:
                raise ValueError(
                    f"{other.path} and {each.path}: runs of two studies; run one of them into another "
                    "folder, or with --overwrite"
                )


def kind(one: StudyRun) -> str:
    """The study that a run is from, in words."""
    return f"a run of a study over {', '.join(one.varied)}" if one.runs else "a run of its own"


def numbered(runs: Sequence[StudyRun]) -> list[StudyRun]:
    """The runs in the order of their numbers; runs without a number get the next free ones."""
    if not any(each.runs for each in runs):
        return [each._replace(number=k) for k, each in enumerate(runs, 1)]
    known = {each.number for each in runs if each.input}
    free = max(each.number or 0 for each in runs if each.input) + 1
    found = []
    for each in runs:
        if not each.input and (each.number is None or each.number in known):
            each, free = each._replace(number=free), free + 1
        found.append(each)
    return sorted(found, key=lambda each: each.number or 0)
