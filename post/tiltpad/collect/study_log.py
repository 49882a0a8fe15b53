"""The log of a study: parameters and results of the runs, of which the program makes the study's file.

`src_f90/storage/frame_log.f90`, `packet.f90` and `src_f90/results/study_log.f90` say what a log consists of.
"""

import os
import struct
import tempfile
import warnings
import zlib
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tiltpad.collect.parameters import differing, parameters
from tiltpad.collect.runs import StudyRun, part, planned
from tiltpad.files.archive import FORMAT_VERSION, MACHINE_VERSION, RunError, plain
from tiltpad.files.namelist import is_machine
from tiltpad.files.processes import write_table
from tiltpad.files.read import read
from tiltpad.files.writing import write


class Column(NamedTuple):
    """An array over the runs: further dimensions, unit, meaning."""

    dimensions: tuple[str, ...]
    units: str
    long_name: str


REVOLUTION, OF_PADS = ("revolution",), ("revolution", "pad")
#: Columns that are no datasets of the runs' files.
OWN = {
    "complete": Column((), "1", "1 where the run reached its end"),
    "resumes": Column((), "1", "times that the run was resumed"),
    **{
        f"{kind}_{state}": Column(OF_PADS if state == "tilt" else REVOLUTION, unit, f"{name} {words}")
        for state, unit, name in (("y", "m", "journal y"), ("z", "m", "journal z"), ("tilt", "rad", "tilt"))
        for kind, words in (
            ("poincare", "once a revolution"),
            ("lowest", "at its lowest in a revolution"),
            ("highest", "at its highest in a revolution"),
        )
    },
}
#: Meanings of the dimensions that the runs' files do not have.
COUNTED = {"revolution": "revolutions before the last Poincare point"}
#: Names that no parameter may have.
TAKEN = ("run", "runs", "status", "reason", "remarks", "file", *OWN, *COUNTED)
#: What a log begins with; the status of a run whose file cannot be read.
BEGINNING, UNREADABLE = b"tiltpad log 1\n", -9


def write_study(target: Path, runs: Sequence[StudyRun], missing: Sequence[int]) -> None:
    """Writes the file of a study, which the program makes of its log."""
    if not target.parent.is_dir():
        raise RunError(f"{target.parent}: no such folder")
    with tempfile.TemporaryDirectory(prefix="tiltpad-") as folder:
        log, table = Path(folder, "study.h5.rows"), Path(folder, "study.h5")
        with open(log, "wb") as file:
            file.write(BEGINNING)
            for kind, contents in frames(runs, missing, target.resolve().parent):
                check = zlib.crc32(contents, zlib.crc32(kind))
                file.write(kind + b"   " + struct.pack("<Iq", check, len(contents)) + contents)
        write_table(log, table)
        write(target, table.read_bytes())


def frames(runs: Sequence[StudyRun], missing: Sequence[int], folder: Path) -> Iterator[tuple[bytes, bytes]]:
    """Kinds and contents: what the study says of itself, then the row of each run behind what it has."""
    columns = described(runs)
    meanings = {name: meaning(runs, name) for name in sorted(dimensions_of(columns))}
    yield b"S", header(runs, missing, {*TAKEN, *meanings, *columns})
    numbers: dict[bytes, int] = {}
    for k, each in enumerate(runs, 1):
        names = [name for name, own in columns.items() if has(each, name, own)]
        layout = layout_of(each, {name: columns[name] for name in names}, meanings)
        if layout not in numbers:
            numbers[layout] = len(numbers) + 1
            yield b"D", whole(numbers[layout]) + whole(len(layout)) + layout
        values = [np.ravel(each.values[name]) for name in names]
        status = UNREADABLE if np.isnan(each.status) else int(each.status)
        texts = (each.reason, "\n".join(each.remarks), os.path.relpath(each.path.resolve(), folder))
        row = [*map(whole, (k, status, numbers[layout])), *(text(each) for each in texts)]
        yield b"R", b"".join([*row, reals(np.concatenate([[], *values]))])


def header(runs: Sequence[StudyRun], missing: Sequence[int], taken: set[str]) -> bytes:
    """What the study says of itself, and its parameters, none of which has a name that is taken."""
    readable = [each for each in runs if each.input]
    first = readable[0]
    if first.runs:
        known = {each.path: each.varied for each in readable}
    else:
        own = differing([each.input for each in readable])
        known = {each.path: values for each, values in zip(readable, own, strict=True)}
    found = parameters([known.get(each.path) for each in runs], taken)
    titles = {each.origin["title"] for each in readable}
    return b"".join(
        (
            whole(MACHINE_VERSION if is_machine(first.input) else FORMAT_VERSION),
            text(", ".join(dict.fromkeys(each.origin["build"] for each in readable))),
            text(datetime.now(UTC).isoformat(timespec="seconds")),
            text(titles.pop() if len(titles) == 1 else ""),
            text(first.origin["input"]),
            whole(planned(runs) or len(runs)),
            reals([each.number for each in runs]),
            whole(1),
            text(""),
            text(ranges(missing)),
            whole(len(found)),
            *(
                b"".join(map(text, (one.name, one.variable, one.long_name, one.units)))
                + (
                    whole(0) + reals(one.values)
                    if one.units
                    else whole(1) + b"".join(text(f"{own}") for own in one.values)
                )
                for one in found
            ),
        )
    )


def layout_of(one: StudyRun, columns: dict[str, Column], meanings: dict[str, str]) -> bytes:
    """What the row of a run has: its dimensions with their labels, and its columns."""
    dimensions = [name for name in meanings if name in one.labels and len(one.labels[name])]
    parts = [whole(len(dimensions))]
    for name in dimensions:
        labels = one.labels[name]
        parts += [text(name), text("1"), text(meanings[name])]
        if isinstance(labels[0], str):
            parts += [whole(len(labels)), *map(text, labels)]
        else:
            parts += [whole(-1), reals(labels)]
    parts.append(whole(len(columns)))
    for name, own in columns.items():
        parts += [text(name), text(own.units), text(own.long_name), whole(len(own.dimensions))]
        parts += [whole(dimensions.index(each) + 1) for each in own.dimensions]
    return b"".join(parts)


def has(one: StudyRun, name: str, own: Column) -> bool:
    """Whether a run has a column over these dimensions."""
    return name in one.values and one.found.get(name, ("", own.dimensions))[1] == own.dimensions


def dimensions_of(columns: dict[str, Column]) -> set[str]:
    """The dimensions of columns, and the pads."""
    return {dimension for each in columns.values() for dimension in each.dimensions} | {"pad"}


def whole(number: int) -> bytes:
    return struct.pack("<i", number)


def text(words: str) -> bytes:
    own = plain(words).encode()
    return whole(len(own)) + own


def reals(numbers: Any) -> bytes:
    own = np.asarray(numbers, "<f8")
    return whole(own.size) + own.tobytes()


def described(runs: Sequence[StudyRun]) -> dict[str, Column]:
    """The columns that any run has, as the file of the first run that has one describes it."""
    found = {name: OWN[name] for name in OWN if any(name in each.values for each in runs)}
    for each in runs:
        new = {name: own for name, own in each.found.items() if name not in found}
        if new:
            with warnings.catch_warnings(action="ignore"), read(each.path) as run:
                for name, (path, dimensions) in new.items():
                    own, there = part(run, path)
                    texts = (own.about(there, kind) for kind in ("units", "long_name"))
                    found[name] = Column(dimensions, *texts)
    return found


def meaning(runs: Sequence[StudyRun], dimension: str) -> str:
    """What a dimension is, from the file of a run that has it."""
    if counted := COUNTED.get(dimension.rpartition("/")[2]):
        return counted
    path = next((each.path for each in runs if dimension in each.labels), None)
    if path is None:
        return ""
    with warnings.catch_warnings(action="ignore"), read(path) as run:
        own, name = part(run, dimension)
        return own.about(name, "long_name")


def ranges(numbers: Sequence[int]) -> str:
    """Rising numbers in few words: "3, 7-9"."""
    ends: list[list[int]] = []
    for number in numbers:
        if ends and number == ends[-1][1] + 1:
            ends[-1][1] = number
        else:
            ends.append([number, number])
    return ", ".join(f"{low}" if low == high else f"{low}-{high}" for low, high in ends)
