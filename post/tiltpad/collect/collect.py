"""Studies: the results of many runs in one file.

The members of a sweep, or any runs; of each its parameters, its last revolution in numbers, its Poincare
points and its cost. A study holds links to the members' files, not their series.
"""

import os
import warnings
from collections.abc import Iterator, Sequence
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np

from tiltpad.collect.members import DONE, UNENDED, Member, member
from tiltpad.collect.parameters import differing, parameters
from tiltpad.files.archive import FORMAT_VERSION, RunError, opened
from tiltpad.files.read import IncompleteRunWarning, read
from tiltpad.files.study import MEMBER, QUANTITIES, Quantity

PathLike = str | os.PathLike


#: Files for which a further process is worth its start, and files handed to one at a time.
WORTH_A_PROCESS, CHUNK = 100, 20


class MemberWarning(UserWarning):
    """A member is missing, or its file cannot be read."""


class Collected(NamedTuple):
    """How many members a study has, what became of them, which numbers are missing, and its file."""

    members: int
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
        return f"{self.members} members: {', '.join(parts)}; written: {self.output}"


def collect(
    paths: str | os.PathLike | Sequence[str | os.PathLike], output: str | os.PathLike | None = None
) -> Collected:
    """Writes the study of a folder of results, or of result files, into one HDF5 file.

    `output` is by default the folder's name with .h5, in the working directory. A file that cannot be read is
    a member without values, and a MemberWarning. Raises ValueError for members of different sweeps and for an
    output that would replace anything but a study, RunError where there is nothing to read.
    """
    given = [Path(each) for each in ([paths] if isinstance(paths, str | os.PathLike) else paths)]
    target = Path(output) if output is not None else default_output(given)
    # each once, however often it is named
    files = list({file.resolve(): file for path in given for file in results(path, target)}.values())
    if not files:
        raise RunError(f"{given[0] if given else 'nothing'}: no result files (*.h5) in it")
    if any(file.resolve() == target.resolve() for file in files):
        raise ValueError(f"{target}: it is one of the results, and would be replaced by the study")
    check_replaceable(target)
    members = gathered(files)
    for each in members:
        if np.isnan(each.status):
            warnings.warn(each.reason, MemberWarning, stacklevel=2)
    if not any(each.input for each in members):
        raise RunError(f"{given[0]}: none of {len(members)} files can be read")
    check_one_study(members)
    members = numbered(members)
    missing = sorted(set(range(1, planned(members) + 1)) - {each.number for each in members})
    if missing:
        warnings.warn(f"{given[0]}: missing members: {ranges(missing)}", MemberWarning, stacklevel=2)
    write(target, members, missing)
    done = sum(each.status == DONE for each in members)
    unended = sum(each.status in UNENDED for each in members)
    lost = sum(bool(np.isnan(each.status)) for each in members)
    return Collected(len(members), done, len(members) - done - unended - lost, unended, lost, missing, target)


def gathered(files: Sequence[Path]) -> list[Member]:
    """What is kept of each file, by as many processes as there are processors."""
    jobs = min(len(os.sched_getaffinity(0)), len(files) // WORTH_A_PROCESS)
    if jobs < 2:
        return [silent_member(file) for file in files]
    try:
        with ProcessPoolExecutor(jobs) as pool:
            return list(pool.map(silent_member, files, chunksize=CHUNK))
    except BrokenExecutor as error:
        raise RunError(f"{files[0].parent}: reading its files ended a process: {error}") from error


def silent_member(path: Path) -> Member:
    """What is kept of a file; that its run is incomplete is in its status."""
    with warnings.catch_warnings(action="ignore", category=IncompleteRunWarning):
        return member(path)


def default_output(given: Sequence[Path]) -> Path:
    """The folder's name with .h5, in the working directory."""
    for path in given:
        if not path.exists():
            raise RunError(f"{path}: no such file or folder")
    folder = next((path for path in given if path.is_dir()), None)
    if folder is None:
        raise ValueError("of single files the study needs a name: give its output")
    return Path(f"{folder.resolve().name}.h5")


def results(path: Path, target: Path) -> list[Path]:
    """The result files of a folder in order, without the study itself; a file as it is."""
    if not path.is_dir():
        return [path]
    return sorted(file for file in path.glob("*.h5") if file.resolve() != target.resolve())


def check_replaceable(target: Path) -> None:
    """Refuses to replace what is no study, such as the result of a run."""
    if target.suffix != ".h5":
        raise ValueError(f"{target}: the name must end in .h5")
    if target.exists():
        with suppress(RunError), opened(os.fspath(target)) as file:
            if file.attrs.get("task") == "study":
                return
        raise ValueError(f"{target}: it is there and no study; remove it, or give the study another name")


def check_one_study(members: Sequence[Member]) -> None:
    """Raises ValueError for members of two sweeps, and for a member that is there twice.

    A sweep may have grown since its first members were run.
    """
    readable = [each for each in members if each.input]
    first = readable[0]
    for each in readable[1:]:
        if (each.members is None, *each.sweep) != (first.members is None, *first.sweep):
            raise ValueError(f"{first.path} and {each.path}: not of one study: {kin(first)}, and {kin(each)}")
    seen: dict[int, Path] = {}
    for each in readable:
        if each.number is not None and seen.setdefault(each.number, each.path) != each.path:
            raise ValueError(f"{seen[each.number]} and {each.path}: both are member {each.number}")


def kin(one: Member) -> str:
    """Which study a member is from, in words."""
    return f"a member of a sweep over {', '.join(one.sweep)}" if one.members else "a run of its own"


def planned(members: Sequence[Member]) -> int:
    """How many members the sweep has, by the last that was run; 0 for runs of their own."""
    return max(each.members or 0 for each in members)


def numbered(members: Sequence[Member]) -> list[Member]:
    """The members in the order of their numbers; those without one get the next free ones."""
    if not any(each.members for each in members):
        return [each._replace(number=k) for k, each in enumerate(members, 1)]
    known = {each.number for each in members if each.input}
    free = max(known) + 1
    found = []
    for each in members:
        if not each.input and (each.number is None or each.number in known):
            each, free = each._replace(number=free), free + 1
        found.append(each)
    return sorted(found, key=lambda each: each.number)


def ranges(numbers: Sequence[int]) -> str:
    """Rising numbers in few words: "3, 7-9"."""
    ends: list[list[int]] = []
    for number in numbers:
        if ends and number == ends[-1][1] + 1:
            ends[-1][1] = number
        else:
            ends.append([number, number])
    return ", ".join(f"{low}" if low == high else f"{low}-{high}" for low, high in ends)


def write(target: Path, members: Sequence[Member], missing: Sequence[int]) -> None:
    """Writes the file under a temporary name, and renames it when it is whole."""
    if not target.parent.is_dir():
        raise RunError(f"{target.parent}: no such folder")
    temporary = target.with_name(f"{target.name}.part{os.getpid()}")
    try:
        with h5py.File(temporary, "w") as file:
            fill(file, members, missing, target.resolve().parent)
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)


def fill(file: h5py.File, members: Sequence[Member], missing: Sequence[int], folder: Path) -> None:
    """Attributes, dimension scales, parameters, results and links of a study."""
    readable = [each for each in members if each.input]
    first = readable[0]
    if first.members:
        known = {each.path: each.sweep for each in readable}
    else:
        own = differing([each.input for each in readable])
        known = {each.path: values for each, values in zip(readable, own, strict=True)}
    found = parameters([known.get(each.path) for each in members])
    titles = {each.origin["title"] for each in readable}
    file.attrs.update(
        {
            "format_version": FORMAT_VERSION,
            "program": "tiltpad",
            "version": first.origin["version"],
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "title": titles.pop() if len(titles) == 1 else "",
            "task": "study",
            "input": first.origin["input"],
            "parameters": " ".join(each.name for each in found),
            "variables": "\n".join(each.variable for each in found),
            "members": planned(members) or len(members),
            "missing": ranges(missing),
        }
    )
    scales(file, members)
    coordinates = " ".join(each.name for each in found)
    for each in found:
        put(file, each.name, each.values, MEMBER, each.units, each.long_name)
    paths = [os.path.relpath(each.path.resolve(), folder) for each in members]
    texts = {"reason": ("why it failed", [each.reason for each in members])}
    texts["file"] = ("its result, from the folder of this file", paths)
    for name, (long_name, values) in texts.items():
        put(file, name, values, MEMBER, "", long_name, coordinates)
    for name, quantity, values in tables(members):
        put(file, name, values, quantity.dimensions, quantity.units, quantity.long_name, coordinates)
    links = file.create_group("members")
    digits = max(4, len(str(members[-1].number)))
    for each, path in zip(members, paths, strict=True):
        links[f"{each.number:0{digits}d}"] = h5py.ExternalLink(path, "/")


def scales(file: h5py.File, members: Sequence[Member]) -> None:
    """The dimensions: members by their numbers, pads, revolutions counted from the last one, which is 0."""
    read = [each for each in members if each.input]
    pads = max(len(np.atleast_1d(each.input["pads"]["pivot_angle_deg"])) for each in read)
    points = max((len(each.values["poincare_y"]) for each in read if "poincare_y" in each.values), default=0)
    for name, values, long_name in (
        ("member", [each.number for each in members], "number of the member"),
        ("pad", range(1, pads + 1), "number of the pad"),
        ("revolution", range(1 - points, 1), "revolutions before the last Poincare point"),
    ):
        if len(values):
            file[name] = np.array(values, dtype=np.int64)
            file[name].make_scale(name)
            file[name].attrs.update({"units": "1", "long_name": long_name})


def tables(members: Sequence[Member]) -> Iterator[tuple[str, Quantity, np.ndarray]]:
    """Name, kind and array of every quantity that at least one member has; nan where a member has none."""
    yield "status", QUANTITIES["status"], np.array([each.status for each in members], dtype=float)
    for name, quantity in QUANTITIES.items():
        values = [(each.values or {}).get(name) for each in members]
        if any(each is not None for each in values):
            yield name, quantity, padded(values, from_end=name.startswith("poincare"))
    measured = [each for each in members if each.cost]
    for name in dict.fromkeys(name for each in measured for name in each.cost):
        first = next(each for each in measured if name in each.cost)
        values = np.array([(each.cost or {}).get(name, np.nan) for each in members])
        yield name, meaning(first.path, name), values


def meaning(path: Path, name: str) -> Quantity:
    """What a number of the cost is, by a file that has it."""
    with warnings.catch_warnings(action="ignore"), read(path) as run:
        units, long_name = (run.about(f"statistics/{name}", each) for each in ("units", "long_name"))
    return Quantity(MEMBER, units, long_name)


def padded(values: Sequence[Any], from_end: bool) -> np.ndarray:
    """Arrays of several sizes, or none, as one: nan behind the shorter ones, or along axis 1 before them."""
    sizes = [np.shape(each) for each in values if each is not None]
    table = np.full((len(values), *np.max(sizes, axis=0).astype(int)), np.nan)
    for k, each in enumerate(values):
        if each is not None:
            place = [slice(0, size) for size in np.shape(each)]
            if from_end:
                place[0] = slice(table.shape[1] - len(each), None)
            table[k, *place] = each
    return table


def put(
    file: h5py.File,
    name: str,
    values: Sequence[Any],
    dimensions: Sequence[str],
    units: str,
    long_name: str,
    coordinates: str = "",
) -> None:
    """A dataset along its dimension scales, with what CF readers look for."""
    if isinstance(values[0], str):
        values = np.array(values, dtype=h5py.string_dtype())
    dataset = file.create_dataset(name, data=values)
    for axis, dimension in enumerate(dimensions):
        dataset.dims[axis].attach_scale(file[dimension])
    told = {"units": units, "long_name": long_name, "coordinates": coordinates}
    dataset.attrs.update({key: text for key, text in told.items() if text})
