"""The file of a study: parameters and results of the members with dimensions and units, links to files."""

import os
import warnings
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tiltpad.collect.members import Member, planned
from tiltpad.collect.parameters import differing, parameters
from tiltpad.files.archive import FORMAT_VERSION, RunError, plain
from tiltpad.files.namelist import count
from tiltpad.files.read import COEFFICIENTS, LABELS, read
from tiltpad.files.study import DIMENSIONS, MEMBER, QUANTITIES, Quantity

#: Texts of a member with their meaning.
TEXTS = {"reason": "reason of the failure", "file": "result file, relative to the folder of this file"}


def write(target: Path, members: Sequence[Member], missing: Sequence[int]) -> None:
    """Writes the file under a temporary name, which nothing had before, and renames it when it is whole."""
    if not target.parent.is_dir():
        raise RunError(f"{target.parent}: no such folder")
    temporary = target.with_name(f"{target.name}.part{os.getpid()}")
    try:
        temporary.open("xb").close()
    except FileExistsError:
        raise RunError(f"{temporary}: is in the way; remove or rename it") from None
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
    taken = {*MEMBER, *DIMENSIONS, *TEXTS, "members", *QUANTITIES}.union(*(each.cost for each in members))
    found = parameters([known.get(each.path) for each in members], taken)
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
    labels = scales(file, members)
    coordinates = " ".join(each.name for each in found)
    for one in found:
        put(file, one.name, one.values, MEMBER, one.units, one.long_name)
    paths = [os.path.relpath(each.path.resolve(), folder) for each in members]
    for name, texts in (("reason", [each.reason for each in members]), ("file", paths)):
        put(file, name, texts, MEMBER, "", TEXTS[name], coordinates)
    for name, quantity, values in tables(members, labels):
        put(file, name, values, quantity.dimensions, quantity.units, quantity.long_name, coordinates)
    links = file.create_group("members")
    digits = max(4, len(str(members[-1].number)))
    for each, path in zip(members, paths, strict=True):
        links[f"{each.number:0{digits}d}"] = h5py.ExternalLink(path, "/")


def scales(file: h5py.File, members: Sequence[Member]) -> dict[str, list[Any]]:
    """Writes the dimensions; gives the values of each: those that any of the members has.

    Members have their numbers, revolutions are counted from the last one, which is 0.
    """
    labels: dict[str, dict[Any, None]] = {name: {} for name in DIMENSIONS}
    for each in members:
        for name, values in each.values.items():
            for dimension, size in zip(QUANTITIES[name].dimensions[1:], np.shape(values), strict=True):
                labels[dimension].update(dict.fromkeys(own_labels(each, dimension, size)))
        if each.input:
            labels["pad"].update(dict.fromkeys(range(1, count(each.input["pads"]["pivot_angle_deg"]) + 1)))
    found = {name: in_order(name, list(values)) for name, values in labels.items() if values}
    numbers = [each.number for each in members]
    for name, own in ({"member": numbers} | found).items():
        if isinstance(own[0], str):
            file.create_dataset(name, data=own, dtype=h5py.string_dtype())
        else:
            file[name] = np.array(own)
        file[name].make_scale(name)
        meaning = DIMENSIONS.get(name, "number of the member")
        file[name].attrs.update({"units": "1", "long_name": meaning})
    return found


def own_labels(one: Member, dimension: str, size: int) -> Sequence[Any]:
    """What a member's values along a dimension belong to; numbers from 1 where it has no labels."""
    return one.labels.get(dimension, range(1, size + 1))


def in_order(name: str, values: list[Any]) -> list[Any]:
    """Numbers rise; texts stay in the order of the members."""
    return values if name in LABELS else sorted(values)


def tables(
    members: Sequence[Member], labels: dict[str, list[Any]]
) -> Iterator[tuple[str, Quantity, np.ndarray]]:
    """Name, meaning and array of every quantity that a member has; nan for members that do not have it."""
    yield "status", QUANTITIES["status"], np.array([each.status for each in members], dtype=float)
    for name, quantity in QUANTITIES.items():
        having = [each for each in members if name in each.values]
        if having:
            group = "coefficients" if name in COEFFICIENTS else "modes"
            about = quantity if quantity.units else meaning(having[0].path, f"{group}/{name}")
            values = placed(name, quantity.dimensions[1:], members, labels)
            yield name, about._replace(dimensions=quantity.dimensions), values
    measured = [each for each in members if each.cost]
    for name in dict.fromkeys(name for each in measured for name in each.cost):
        first = next(each for each in measured if name in each.cost)
        values = np.array([each.cost.get(name, np.nan) for each in members])
        yield name, meaning(first.path, f"statistics/{name}"), values


def meaning(path: Path, name: str) -> Quantity:
    """Unit and meaning of a number for each member, from a file that has it."""
    with warnings.catch_warnings(action="ignore"), read(path) as run:
        units, long_name = (run.about(name, each) for each in ("units", "long_name"))
    return Quantity(MEMBER, units, long_name)


def placed(
    name: str, dimensions: Sequence[str], members: Sequence[Member], labels: dict[str, list[Any]]
) -> np.ndarray:
    """One array of the members' own, each value at the place of its labels; nan where there is none."""
    places = {each: {label: k for k, label in enumerate(labels[each])} for each in dimensions}
    table = np.full((len(members), *map(len, places.values())), np.nan)
    for k, each in enumerate(members):
        if name in each.values:
            values = np.asarray(each.values[name], dtype=float)
            part = [
                [places[dimension][label] for label in own_labels(each, dimension, size)]
                for dimension, size in zip(dimensions, values.shape, strict=True)
            ]
            place: Any = (k, *np.ix_(*part))
            table[place] = values
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
