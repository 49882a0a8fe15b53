"""Judges what a fault left, and what the next command made of it."""

import re
import signal
from contextlib import suppress
from pathlib import Path

import h5py
import numpy as np
from faulty_commands import Command, Ended
from injector import Fault

#: Difference of a resumed march from one that was not stopped, over the largest value of each array: CVODE
#: starts anew. Against relative_tolerance = 1e-8 each errs by up to 1e-3, in the tilt rates.
RESUMED = 1e-2
#: Groups of a result that two runs of one case need not have in common.
OWN_GROUPS = ("statistics",)
#: Such columns of a study.
OWN_COLUMNS = re.compile(
    r".*_seconds|steps|resumes|.*_evaluations|.*_failures|film_(cells|fourier|nodes|passes|profiles|table|volumes)"
)
#: Statuses of rows that a study has not yet, or that are to be run again.
NOT_RUN = (-2, 3)
#: What h5py raises.
UNREADABLE = (OSError, KeyError, RuntimeError)
#: Of files that are more than parts and locks.
ENDINGS = (".nml", ".h5", ".html", ".png")


class Result:
    """A result or study as it is in a file: its arrays by name, whether it is complete; raises OSError."""

    def __init__(self, path: Path):
        self.values: dict[str, np.ndarray] = {}
        with h5py.File(path) as file:
            self.complete = bool(file.attrs.get("complete", file.attrs.get("finished", 1)))
            file.visititems(self.note)
        self.complete &= not np.isin(self.values.get("status", 0), NOT_RUN).any()

    def note(self, name: str, each: h5py.Dataset | h5py.Group) -> None:
        own = name.partition("/")[0] in OWN_GROUPS or OWN_COLUMNS.fullmatch(name)
        if isinstance(each, h5py.Dataset) and not own:
            self.values[name] = each[()]

    def differences(self, other: "Result", exact: int | None = None) -> list[str]:
        """Arrays that are not those of the other; behind `exact` samples they may differ as RESUMED says."""
        if self.values.keys() != other.values.keys():
            return [f"other arrays: {sorted(self.values.keys() ^ other.values.keys())[:3]}"]
        found = []
        for name, values in self.values.items():
            series = "/" not in name and len(values.shape) > 0 and len(values) == self.samples
            own = exact if exact is None or series else 0
            found += [name] * (not same(values, other.values[name], own))
        return found

    def beginning(self, whole: "Result") -> list[str]:
        """Arrays of a checkpoint that are not the beginning of the whole result's; of a study its rows."""
        found = []
        status = self.values.get("status", np.zeros(0))
        for name, values in self.values.items():
            expected = whole.values.get(name)
            series = "/" not in name and expected is not None and values.ndim
            there = (
                ~np.isin(status, NOT_RUN)
                if len(status) and series and len(values) == len(status)
                else slice(None)
            )
            if series and not same(values[there], expected[: len(values)][there], None):
                found.append(name)
        return found

    @property
    def samples(self) -> int:
        return len(self.values.get("time", ()))


def same(values: np.ndarray, expected: np.ndarray, exact: int | None) -> bool:
    """Whether two arrays are the same bit for bit, or, behind this number of samples, close."""
    if values.shape != expected.shape or values.dtype != expected.dtype:
        return False
    if values.dtype.kind != "f":
        return np.array_equal(values, expected)
    if exact is None:
        return np.array_equal(values, expected, equal_nan=True)
    first = min(exact, len(values)) if values.ndim else 0
    if values.ndim and not np.array_equal(values[:first], expected[:first], equal_nan=True):
        return False
    room = RESUMED * np.abs(np.nan_to_num(expected)).max(initial=0)
    return np.allclose(values, expected, rtol=0, atol=room, equal_nan=True)


class Undisturbed:
    """The files that a command leaves without a fault."""

    def __init__(self, command: Command, folder: Path):
        paths = results(command, folder)
        self.names = names(folder)
        self.files = {path.relative_to(folder): path.read_bytes() for path in paths}
        self.results = {path.relative_to(folder): Result(path) for path in paths if path.suffix == ".h5"}


def names(folder: Path) -> set[str]:
    """All files and folders below a folder."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def results(command: Command, folder: Path) -> list[Path]:
    """The files that a command makes."""
    return [path for pattern in command.results for path in sorted(folder.glob(pattern))]


def contents(folder: Path) -> dict[Path, bytes]:
    """All files below a folder, but those that are being made."""
    found = (path for path in sorted(folder.rglob("*")) if path.is_file() and path.suffix in ENDINGS)
    return {path.relative_to(folder): path.read_bytes() for path in found}


def ending(command: Command, fault: Fault | None, ended: Ended) -> list[str]:
    """What is wrong with how a command ended."""
    found = [f"processes that did not end: {ended.orphans}"] if ended.orphans else []
    if ended.status == -99:
        return [*found, "hung"]
    lines = ended.said.splitlines()
    warnings = [line for line in lines if line.startswith(f"{command.speaker}: warning: ")]
    errors = [line for line in lines if line.startswith(f"{command.speaker}: error: ")]
    told = f"status {ended.status}: {ended.said[:500]!r}"
    if ended.status == -signal.SIGKILL and fault and fault.kills:
        return found
    if fault and fault.kind == "memory" and command.speaker != "tiltpad":
        # Python's libraries end in many ways without memory
        return found
    if ended.status not in (0, 3) or (ended.status == 3 and not fault):
        return [*found, told]
    # of a study each run that failed has a line, too
    wanted = 0 if ended.status == 0 else 1 + command.name.startswith("study") * (len(lines) - 1)
    if len(errors) != wanted or len(lines) != len(errors) + len(warnings) or "report this" in ended.said:
        found.append(told)
    if warnings and not fault:
        found.append(told)
    return found


def what_is_left(
    command: Command, ended: Ended, folder: Path, before: dict[Path, bytes], undisturbed: Undisturbed
) -> list[str]:
    """What is wrong with the files behind a fault: each is as before, whole, or a checkpoint."""
    made = {path.relative_to(folder) for path in results(command, folder)}
    now = contents(folder)
    found = [f"{path}: lost" for path in before if path not in now]
    found += [f"{path}: changed" for path in before if path not in made and now.get(path) != before[path]]
    warned = "warning: " in ended.said
    for path in sorted(made):
        if path not in now or now[path] == before.get(path):
            continue
        if path not in undisturbed.files:
            found.append(f"{path}: nobody asked for it")
        elif path.suffix != ".h5":
            found += [f"{path}: neither the former nor the new"] * (now[path] != undisturbed.files[path])
        elif not warned:
            found += result_left(folder / path, undisturbed.results[path], before.get(path), command.marches)
    if ended.status == 0 and not warned:
        absent = [path for path in undisturbed.files if path not in now]
        found += [f"{path}: missing, though all went well" for path in absent]
        for path in undisturbed.results:
            if path not in absent and not Result(folder / path).complete:
                found.append(f"{path}: incomplete, though all went well")
    return found


def result_left(path: Path, whole: Result, before: bytes | None, marches: bool) -> list[str]:
    """What is wrong with a result that a disturbed command left."""
    try:
        result = Result(path)
    except UNREADABLE as error:
        return [f"{path.name}: cannot be read: {error}"]
    if result.complete:
        wrong = result.differences(whole)
        return [f"{path.name}: other values: {wrong[:3]}"] * bool(wrong)
    wrong = result.beginning(whole)
    return [f"{path.name}: a checkpoint with other values: {wrong[:3]}"] * bool(wrong)


def after_next(
    command: Command, ended: Ended, folder: Path, kept: dict[Path, int | None], undisturbed: Undisturbed
) -> list[str]:
    """What is wrong behind the next command, which had no fault; `kept`: samples that it found."""
    found = ending(command, None, ended)
    there = names(folder)
    found += [f"not there: {sorted(undisturbed.names - there)}"] * (not undisturbed.names <= there)
    found += [f"left: {sorted(there - undisturbed.names)}"] * (not there <= undisturbed.names)
    for path, content in undisturbed.files.items():
        if not (folder / path).exists():
            continue
        if path.suffix != ".h5":
            found += [f"{path}: another page"] * ((folder / path).read_bytes() != content)
            continue
        result = Result(folder / path)
        # the rows of a study may be those of marches that went on
        samples = 0 if "status" in result.values else kept.get(path)
        wrong = result.differences(undisturbed.results[path], samples if command.marches else None)
        found += [f"{path}: other values: {wrong[:3]}"] * bool(wrong)
        found += [f"{path}: incomplete"] * (not result.complete)
    return found


def samples_kept(folder: Path, undisturbed: Undisturbed) -> dict[Path, int | None]:
    """Of each checkpoint, from which a march goes on, its samples; None for what is complete or not there."""
    found: dict[Path, int | None] = {}
    for path in undisturbed.results:
        with suppress(*UNREADABLE):
            result = Result(folder / path)
            found[path] = None if result.complete else result.samples
    return found
