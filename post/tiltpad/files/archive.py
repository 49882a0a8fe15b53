"""HDF5 files of tiltpad: opening them, and one line about what is wrong with them.

What the HDF5 library says of a damaged file becomes a RunError that names it, and sizes that such a file
claims are compared with its own before anything is allocated.
"""

import math
import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Self

import h5py
import numpy as np
from h5py import h5t

from tiltpad.files import heaps

#: Newest format_version that this reader knows, of results and of studies.
FORMAT_VERSION = 2
#: Names in files of format_version 1 that are others today: today's name, and the one in the file.
NAMES_OF_1 = {"film_volumes": "film_sor", "film_passes": "sor_sweeps"}
#: Attributes of every file, and those that are numbers.
REQUIRED = ("version", "created", "title", "task", "input")
NUMBERS = ("format_version", "complete", "exit_status", "resumes", "member", "members")
#: What no text of a page or a picture can hold: control characters, halves of characters.
UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f\ud800-\udfff]")
#: The highest ratio that the filters of HDF5 (deflate) reach.
COMPRESSION = 1100


class RunError(Exception):
    """The file is missing, or is no result of tiltpad that can be read."""


class NotInRunError(RunError, AttributeError):
    """The run has no such dataset; the message says why."""


class Archive:
    """An HDF5 file of tiltpad, open for reading; nothing is loaded before it is asked for."""

    #: Kinds of numpy's types that its datasets may have.
    KINDS = "fiu"
    #: What it sets itself: where such an attribute is missing, it is not looked for in the file.
    OWN = ("file", "path", "attributes", "former", "found", "listed", "size")

    def __init__(self, path: str | os.PathLike):
        self.path = os.fspath(path)
        self.file = opened(self.path)
        self.size = os.path.getsize(self.path)
        self.found: dict[str, h5py.Dataset | h5py.Group] = {}
        self.listed: dict[str, list[str]] = {}
        try:
            with reading(self.path, "attributes"):
                attrs = self.file.attrs
                self.attributes: dict[str, Any] = {
                    name: plain(attrs[name]) for name in attrs if simple(attrs, name)
                }
            check_origin(self.path, self.attributes)
            self.former = NAMES_OF_1 if self.attributes["format_version"] == 1 else {}
            self.check_whole()
        except BaseException:
            self.file.close()
            raise

    def __getitem__(self, name: str) -> Any:
        return self.values(name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name in (
            "file",
            "path",
            "attributes",
            "former",
            "found",
            "listed",
            "size",
        ):
            raise AttributeError(name)
        return self.attributes[name] if name in self.attributes else self.values(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.names(), *self.attributes]

    def __contains__(self, name: str) -> bool:
        group, _, own = name.rpartition("/")
        return own in self.names(group) if not group or group in self else False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file; `with` does it at its end."""
        self.found.clear()
        self.file.close()

    def names(self, group: str = "") -> list[str]:
        """Names of the datasets and groups in the file or in a group of it, in alphabetical order."""
        if group not in self.listed:
            found = self.item(group) if group else self.file
            today = {own: name for name, own in self.former.items()}
            with reading(self.path, group or "the list of datasets"):
                there = [plain(name) for name in found] if isinstance(found, h5py.Group) else []
            self.listed[group] = sorted(today.get(own, own) for own in there)
        return self.listed[group]

    def values(self, name: str, part: slice | int = slice(None)) -> Any:
        """A dataset as an array, or the samples `part` of it; a group as a dictionary of arrays."""
        found = self.item(name)
        if isinstance(found, h5py.Group):
            return {each: self.values(f"{name}/{each}") for each in self.names(name)}
        with reading(self.path, name):
            return self.sound(name, found[part if found.shape else ()])

    def item(self, name: str) -> h5py.Dataset | h5py.Group:
        """A dataset or group, its type and size checked; nothing of it is read yet."""
        if name not in self.found:
            if name not in self:
                group = name.split("/")[0]
                missing = name if group in self else group
                raise NotInRunError(self.without(missing))
            with reading(self.path, name):
                group, slash, own = name.rpartition("/")
                found = self.file[group + slash + self.former.get(own, own)]
                if not isinstance(found, h5py.Group):
                    self.check_dataset(name, found)
            self.found[name] = found
        return self.found[name]

    def length(self, name: str) -> int:
        """Number of values along a dimension, by the name of its scale."""
        return self.item(name).shape[0]

    def about(self, name: str, which: str) -> str:
        """An attribute of a dataset, `units` or `long_name`; empty where it has none."""
        found = self.item(name)
        with reading(self.path, name):
            attrs = found.attrs
            return f"{plain(attrs[which])}" if which in attrs and simple(attrs, which) else ""

    def without(self, name: str) -> str:
        """What to say where a dataset is missing."""
        return f"{self.path}: no {name} in this file: there are {', '.join(self.names())}"

    def check_whole(self) -> None:
        """Refuses a file whose parts do not fit together; what a kind of file has to check."""

    def check_dataset(self, name: str, found: h5py.Dataset) -> None:
        """Raises ValueError for what is no array of numbers, greater than the file can hold, or of another
        shape than the others ask for.
        """
        if not isinstance(found, h5py.Dataset) or (kind := found.dtype).kind not in self.KINDS:
            raise ValueError("not an array of numbers")
        if kind.kind == "O" and h5py.check_string_dtype(kind) is None:
            raise ValueError("neither numbers nor texts")
        # chunks are allocated whole, and of deflated data more than the file holds is possible
        claimed = kind.itemsize * max(math.prod(found.shape), math.prod(found.chunks or (0,)))
        if claimed > self.size and (
            claimed > COMPRESSION * self.size or not found.id.get_create_plist().get_nfilters()
        ):
            raise ValueError(f"it claims {claimed} bytes, more than the file holds")
        scales = self.scales(name)
        if scales == (name,):
            fits(found.shape[1:], ())
            found.shape[0]  # a scalar has none
        elif scales is not None:
            fits(found.shape, [self.length(each) for each in scales])

    def scales(self, name: str) -> Sequence[str] | None:
        """Dimensions that a dataset must have, of a scale itself; None of one that is not known."""

    def sound(self, name: str, values: Any) -> Any:
        """The values that were read; ValueError where they cannot be."""
        return values


@contextmanager
def reading(path: str, what: str) -> Iterator[None]:
    """Makes whatever goes wrong while h5py reads a RunError; it may be any exception in a damaged file."""
    try:
        yield
    except RunError:
        raise
    except Exception as error:
        raise damaged(path, what, error) from error


def damaged(path: str, what: str, why: object) -> RunError:
    """The error of a damaged file, in one line."""
    reason = why.args[0] if isinstance(why, KeyError) and why.args else why
    return RunError(
        f"{path}: {what} cannot be read, the file is damaged ({' '.join(plain(f'{reason}').split())})"
    )


def simple(attrs: h5py.AttributeManager, name: str) -> bool:
    """True where an attribute is a text or a number; the library can crash over others that are damaged."""
    return attrs.get_id(name).get_type().get_class() in (h5t.STRING, h5t.INTEGER, h5t.FLOAT)


def plain(value: Any) -> Any:
    """A text in which what cannot be printed is replaced; other values as they are."""
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    if not isinstance(value, str):
        return value
    # bytes that are no UTF-8 come from h5py as surrogates
    return UNPRINTABLE.sub("\ufffd", value)


def opened(path: str) -> h5py.File:
    """The HDF5 file of that name."""
    if not os.path.exists(path):
        raise RunError(f"{path}: no such file")
    if os.path.isdir(path):
        raise RunError(f"{path}: is a folder, not a result file")
    if not os.path.isfile(path):
        raise RunError(f"{path}: a device or pipe, not an ordinary file")
    if not os.access(path, os.R_OK):
        raise RunError(f"{path}: no permission to read it")
    try:
        if not h5py.is_hdf5(path):
            raise RunError(f"{path}: not an HDF5 file")
        if heaps.endless(path):
            raise damaged(path, "attributes", "an object without length in their heap")
        return h5py.File(path, "r")
    except OSError as error:
        told = " ".join(str(error).split())
        raise RunError(f"{path}: cannot be opened, damaged or still being written ({told})") from error
    except (ValueError, RuntimeError, MemoryError) as error:
        raise damaged(path, "it", error) from error


def check_origin(path: str, attributes: dict[str, Any]) -> None:
    """Refuses files of other programs, of a later format, and without what every file has."""
    if attributes.get("program") != "tiltpad" or "input" not in attributes:
        raise RunError(f"{path}: not a result of tiltpad (attribute 'program' is not 'tiltpad')")
    for name in ("format_version", *REQUIRED):
        if name not in attributes:
            raise damaged(path, f"attribute '{name}'", "it is missing")
    for name, value in attributes.items():
        if name in NUMBERS and not isinstance(value, int | np.integer):
            raise damaged(path, f"attribute '{name}'", "not a whole number")
        if name in REQUIRED and not isinstance(value, str):
            raise damaged(path, f"attribute '{name}'", "not a text")
    version = int(attributes["format_version"])
    if version > FORMAT_VERSION:
        raise RunError(
            f"{path}: format_version {version} is newer than {FORMAT_VERSION}, the newest this reader knows; "
            "update the Python package tiltpad"
        )


def fits(shape: Sequence[int], wanted: Sequence[int]) -> None:
    """Raises ValueError where a dataset's shape is not the one that the others ask for."""
    if tuple(shape) != tuple(wanted):
        raise ValueError(f"its shape is {tuple(shape)}, {tuple(wanted)} fits the others")
