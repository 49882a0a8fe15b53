"""The file of a study: parameters and results of the runs with dimensions and units, their files."""

import os
import warnings
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np

from tiltpad.collect.parameters import differing, parameters
from tiltpad.collect.runs import StudyRun, part, planned
from tiltpad.files.archive import FORMAT_VERSION, MACHINE_VERSION, RunError, plain
from tiltpad.files.namelist import is_machine
from tiltpad.files.read import read
from tiltpad.files.study import RUN
from tiltpad.files.writing import hdf5


class Column(NamedTuple):
    """An array over the runs: further dimensions, unit, meaning."""

    dimensions: tuple[str, ...]
    units: str
    long_name: str


REVOLUTION, OF_PADS = ("revolution",), ("revolution", "pad")
#: As the program says it, too.
STATUS = (
    "exit status: 0 done, 2 numerics, 3 system, 4 stopped, -1 not ended, -2 not run yet; "
    "nan: its file cannot be read"
)
#: Columns that are no datasets of the runs' files.
OWN = {
    "status": Column((), "1", STATUS),
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
COUNTED = {"run": "number of the run", "revolution": "revolutions before the last Poincare point"}
#: Texts of a run with their meaning.
TEXTS = {
    "reason": "reason of the failure",
    "remarks": "what is unusual in the run, or leaves the range of the model, a line each",
    "file": "result file, relative to the folder of this file",
}


def write(target: Path, runs: Sequence[StudyRun], missing: Sequence[int]) -> None:
    """Writes the file."""
    if not target.parent.is_dir():
        raise RunError(f"{target.parent}: no such folder")
    with hdf5(target) as file:
        fill(file, runs, missing, target.resolve().parent)


def fill(file: h5py.File, runs: Sequence[StudyRun], missing: Sequence[int], folder: Path) -> None:
    """Attributes, dimension scales, parameters and results of a study."""
    readable = [each for each in runs if each.input]
    first = readable[0]
    if first.runs:
        known = {each.path: each.varied for each in readable}
    else:
        own = differing([each.input for each in readable])
        known = {each.path: values for each, values in zip(readable, own, strict=True)}
    columns = described(runs)
    wanted = {dimension for each in columns.values() for dimension in each.dimensions}
    taken = {*COUNTED, *TEXTS, "runs", *OWN, *wanted, *columns}
    found = parameters([known.get(each.path) for each in runs], taken)
    titles = {each.origin["title"] for each in readable}
    file.attrs.update(
        {
            "format_version": MACHINE_VERSION if is_machine(first.input) else FORMAT_VERSION,
            "program": "tiltpad",
            "version": first.origin["version"],
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "title": titles.pop() if len(titles) == 1 else "",
            "task": "study",
            "input": first.origin["input"],
            "parameters": " ".join(each.name for each in found),
            "variables": "\n".join(each.variable for each in found),
            "runs": planned(runs) or len(runs),
            "missing": ranges(missing),
        }
    )
    labels = scales(file, runs, columns)
    coordinates = " ".join(each.name for each in found)
    for one in found:
        put(file, one.name, one.values, RUN, one.units, one.long_name)
    paths = [os.path.relpath(each.path.resolve(), folder) for each in runs]
    columns_of_texts = {"reason": [each.reason for each in runs], "file": paths}
    if any(each.remarks for each in runs):
        columns_of_texts["remarks"] = ["\n".join(each.remarks) for each in runs]
    for name, texts in columns_of_texts.items():
        put(file, name, texts, RUN, "", TEXTS[name], coordinates)
    put(file, "status", [each.status for each in runs], RUN, *OWN["status"][1:], coordinates)
    for name, (dimensions, unit, meant) in columns.items():
        values = placed(name, dimensions, runs, labels)
        put(file, name, values, (*RUN, *dimensions), unit, meant, coordinates)


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


def scales(
    file: h5py.File, runs: Sequence[StudyRun], columns: dict[str, Column]
) -> dict[str, dict[Any, int]]:
    """Writes the dimensions; gives the places of the values of each: those that any of the runs has.

    Runs have their numbers, revolutions are counted from the last one, which is 0. Numbers rise; a text
    comes behind the one that it follows in a run.
    """
    wanted = {dimension for each in columns.values() for dimension in each.dimensions} | {"pad"}
    found: dict[str, list[Any]] = {"run": [each.number for each in runs]}
    for name in sorted(wanted):
        values = joined([each.labels.get(name, ()) for each in runs])
        found[name] = values if any(isinstance(value, str) for value in values) else sorted(values)
    for name, own in ((name, own) for name, own in found.items() if own):
        if isinstance(own[0], str):
            file.create_dataset(name, data=own, dtype=h5py.string_dtype())
        else:
            file[name] = np.array(own)
        file[name].make_scale(name)
        counted = COUNTED.get(name.rpartition("/")[2])
        file[name].attrs.update({"units": "1", "long_name": counted or meaning(runs, name)})
    return {name: {label: k for k, label in enumerate(own)} for name, own in found.items()}


def joined(lists: Sequence[Sequence[Any]]) -> list[Any]:
    """All labels, each new one behind the one before it in its list."""
    found: list[Any] = []
    known: set[Any] = set()
    for labels in lists:
        for k, label in enumerate(labels):
            if label not in known:
                known.add(label)
                found.insert(found.index(labels[k - 1]) + 1 if k else 0, label)
    return found


def meaning(runs: Sequence[StudyRun], dimension: str) -> str:
    """What a dimension is, from the file of a run that has it."""
    path = next(each.path for each in runs if dimension in each.labels)
    with warnings.catch_warnings(action="ignore"), read(path) as run:
        own, name = part(run, dimension)
        return own.about(name, "long_name")


def placed(
    name: str, dimensions: Sequence[str], runs: Sequence[StudyRun], labels: dict[str, dict[Any, int]]
) -> np.ndarray:
    """One array of the runs' own, each value at the place of its labels; nan where there is none."""
    table = np.full((len(runs), *(len(labels[each]) for each in dimensions)), np.nan)
    for k, each in enumerate(runs):
        if name in each.values and each.found.get(name, ("", dimensions))[1] == dimensions:
            part = [[labels[own][label] for label in each.labels[own]] for own in dimensions]
            place: Any = (k, *np.ix_(*part))
            table[place] = each.values[name]
    return table


def ranges(numbers: Sequence[int]) -> str:
    """Rising numbers in few words: "3, 7-9"."""
    ends: list[list[int]] = []
    for number in numbers:
        if ends and number == ends[-1][1] + 1:
            ends[-1][1] = number
        else:
            ends.append([number, number])
    return ", ".join(f"{low}" if low == high else f"{low}-{high}" for low, high in ends)


def put(
    file: h5py.File,
    name: str,
    values: Sequence[Any] | np.ndarray,
    dimensions: Sequence[str],
    units: str,
    long_name: str,
    coordinates: str = "",
) -> None:
    """A dataset along its dimension scales, with the attributes of the CF conventions."""
    if isinstance(values[0], str):
        texts = np.array([plain(each) for each in values], dtype=h5py.string_dtype())
    dataset = file.create_dataset(name, data=texts if isinstance(values[0], str) else values)
    for axis, dimension in enumerate(dimensions):
        dataset.dims[axis].attach_scale(file[dimension])
    attributes = {"units": units, "long_name": long_name, "coordinates": coordinates}
    dataset.attrs.update({key: text for key, text in attributes.items() if text})
