"""Opening HDF5 files of tiltpad, with a message of one line if a file is wrong.

Any error of the HDF5 library over a damaged file becomes a RunError that names the file. Sizes that a file
claims are compared with its own size before memory is allocated. Nothing outside the file is read on its
behalf: links, external storage, virtual datasets and filters of others are refused.
"""

import math
import os
import re
from collections.abc import Iterable, Iterator, Sequence, Sized
from contextlib import contextmanager, suppress
from difflib import get_close_matches
from typing import Any, Self

import h5py
import numpy as np
from h5py import h5d, h5l, h5t, h5z

from tiltpad.files import heaps
from tiltpad.files.former_names import FORMER_NAMES, renamed

#: Oldest format_version that this reader knows, today's of results and of studies, and that of machines.
OLDEST_VERSION, FORMAT_VERSION, MACHINE_VERSION = 2, 3, 4
#: Attributes of every file, and those that are numbers.
REQUIRED = ("version", "created", "title", "task", "input")
NUMBERS = ("format_version", "complete", "exit_status", "resumes", "run", "runs")
#: Characters that no page and no picture can show: control characters, halves of characters.
UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f\ud800-\udfff]")
#: The library's own filters; it would look for others on the machine.
FILTERS = (h5z.FILTER_DEFLATE, h5z.FILTER_SHUFFLE, h5z.FILTER_FLETCHER32, h5z.FILTER_LZF)
#: A compressed array may be this many times as large as the whole file, or have this number of bytes.
#: Deflated zeros reach a ratio of 1000, results hardly 2.
COMPRESSION, SMALL = 20, 1 << 24
#: Type of the list of a dataset's scales, as files have it.
SCALES = h5t.vlen_create(h5t.STD_REF_OBJ).encode()
#: Longest attribute in the list of attributes itself, bytes; texts of variable length stand elsewhere.
LONGEST = 1 << 16
#: Most attributes of a file, and most datasets of a group: many times what results and studies have, which is
#: up to 30 and 130. A study of an earlier version has as many links to its runs as it has runs.
MOST_NAMES, UNLIMITED = 1000, ("runs",)


class RunError(Exception):
    """The file does not exist, or is not a readable result of tiltpad."""


class NotInRunError(RunError, AttributeError):
    """The run has no such dataset; the message gives the reason."""


def not_in_run(run: "Archive", what: str, why: str) -> NotInRunError:
    """The error of what a run has not, and why."""
    return NotInRunError(f"{run.path}: no {what} in this run: {why}")


class Group(dict[str, Any]):
    """The values of a group by their names, in brackets or behind a point."""

    def __init__(self, name: str, values: dict[str, Any]):
        super().__init__(values)
        self._name = name  # the group, for messages

    def __getattr__(self, name: str) -> Any:
        if name in self:
            return self[name]
        there = f"there are {', '.join(self)}"
        raise AttributeError(f"no {shown(name)} in {self.__dict__.get('_name')}{meant(name, self)}: {there}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]


class Archive:
    """An HDF5 file of tiltpad, open for reading; a dataset is loaded when it is used."""

    #: Names that are groups.
    GROUPS = (
        "equilibrium",
        "spectrum",
        "statistics",
        "checkpoint",
        "coefficients",
        "modes",
        "runs",
        "bifurcations",
        "asperities",
        "oil",
        "periodic",
        "summary",
        "by_revolution",
        "rotor",
        "response",
        "synchronous",
        "stability",
        "shape",
    )
    #: Kinds of numpy's types that its datasets may have.
    KINDS = "fiu"
    #: Names that are of no use outside.
    INTERNAL = (
        *("check_whole", "check_dataset", "scales", "sound", "without", "item", "own", "found", "listed"),
        *("former", "size", "why_not", "end", "in_words", "is_series", "KINDS", "OWN", "GROUPS", "INTERNAL"),
        *("scale", "today", "most", "inside", "check_bearings", "needs_one_bearing", "own_names"),
        *("machine", "group", "likely", "is_cold", "single_and_groups"),
    )
    #: Its own attributes: where one is not set yet, no dataset of that name is looked for.
    OWN = ("file", "path", "attributes", "former", "found", "listed", "over", "size", "machine", "group")

    def __init__(self, path: str | os.PathLike):
        self.path = os.fspath(path)
        self.file = opened(self.path)
        self.size = os.path.getsize(self.path)
        self.found: dict[str, h5py.Dataset | h5py.Group] = {}
        self.listed: dict[str, list[str]] = {}
        self.over: dict[str, tuple[str, ...]] = {}
        try:
            with reading(self.path, "attributes"):
                attrs = self.file.attrs
                few_enough(attrs)
                self.attributes: dict[str, Any] = {
                    plain(name): plain(attrs[name]) for name in attrs if simple(attrs, name)
                }
            check_origin(self.path, self.attributes)
            former = FORMER_NAMES if self.attributes["format_version"] < FORMAT_VERSION else {}
            self.former = {today: old for old, today in former.items()}
            self.check_whole()
        except BaseException:
            self.file.close()
            raise

    def __getitem__(self, name: str) -> Any:
        return self.values(name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name in self.OWN:
            raise AttributeError(name)
        return self.attributes[name] if name in self.attributes else self.values(name)

    def __dir__(self) -> list[str]:
        own = [name for name in super().__dir__() if name not in self.INTERNAL]
        return list(dict.fromkeys([*own, *self.names(), *self.attributes]))

    def __iter__(self) -> Iterator[str]:
        return iter(self.names())

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
            there = self.inside(self.item(group) if group else self.file, group)
            self.listed[group] = sorted(self.today(f"{group}/{own}".lstrip("/")) for own in there)
        return self.listed[group]

    def single_and_groups(self) -> tuple[list[str], list[str]]:
        """Names of the datasets in the file, and of its groups that are of use outside."""
        single = [name for name in self.names() if name not in self.GROUPS]
        return single, [name for name in self.names() if name not in (*single, "checkpoint", "runs")]

    def inside(self, found: h5py.Dataset | h5py.Group, group: str) -> list[str]:
        """Names of what is in the group `found`, called `group` in messages; none of an array."""
        with reading(self.path, group or "the list of datasets"):
            if group not in UNLIMITED:
                few_enough(found)
            return [plain(name) for name in found] if isinstance(found, h5py.Group) else []

    def values(self, name: str, part: slice | int = slice(None)) -> Any:
        """A dataset as an array, or the samples `part` of it; a group as a dictionary of arrays."""
        found = self.item(name)
        if isinstance(found, h5py.Group):
            if "/" in name:
                raise damaged(self.path, name, "a group in a group")
            return Group(name, {each: self.values(f"{name}/{each}") for each in self.names(name)})
        with reading(self.path, name):
            return self.sound(name, found[part if found.shape else ()])

    def item(self, name: str) -> h5py.Dataset | h5py.Group:
        """A dataset or group, its type and size checked; nothing of it is read yet."""
        if name not in self.found:
            if name not in self:
                if (today := renamed(name)) in self:
                    return self.item(today)
                group = name.split("/")[0]
                missing = name if group in self else group
                raise NotInRunError(self.without(missing))
            with reading(self.path, name):
                group, slash, _ = name.rpartition("/")
                own = self.former.get(name, name).rpartition("/")[2]
                found = self.own(self.former.get(group, group) + slash + own)
                if not isinstance(found, h5py.Group):
                    self.check_dataset(name, found)
                elif name not in self.GROUPS:
                    raise ValueError("a group and not an array of numbers")
            self.found[name] = found
        return self.found[name]

    def own(self, path: str) -> h5py.Dataset | h5py.Group:
        """The object of this path; ValueError for links, which may lead out of the file."""
        found = self.file
        for part in path.split("/"):
            if found.id.links.get_info(part.encode()).type != h5l.TYPE_HARD:
                raise ValueError(f"{part} is a link and not in this file")
            found = found[part]
        return found

    def today(self, path: str) -> str:
        """What a dataset of this file is called today in its group."""
        return (renamed(path) if self.former else path).rpartition("/")[2]

    def scales(self, name: str) -> tuple[str, ...]:
        """Dimensions of a dataset by the names of their scales; a scale is its own."""
        found = self.item(name)
        if name not in self.over:
            self.over[name] = self._scales(name, found)
        return self.over[name]

    def _scales(self, name: str, found: h5py.Dataset) -> tuple[str, ...]:
        """The same, read from the file."""
        if found.shape == ():
            return ()
        attrs = found.attrs
        if "DIMENSION_LIST" not in attrs:
            # h5py's is_scale ends the process where HDF5 1.14 finds another text here
            its_class = plain(attrs["CLASS"]) if "CLASS" in attrs and simple(attrs, "CLASS") else ""
            if its_class != "DIMENSION_SCALE":
                raise ValueError("its dimensions are missing")
            return (name,)
        kept = attrs.get_id("DIMENSION_LIST")
        # the library can crash over any other list
        if kept.get_type().encode() != SCALES or kept.shape != (found.ndim,):
            raise ValueError("its dimensions are none")
        group = name.rpartition("/")[0]
        return tuple(self.scale(group, self.file[each[0]]) for each in attrs["DIMENSION_LIST"])

    def scale(self, group: str, found: h5py.Dataset) -> str:
        """Name of a scale that a dataset of this group refers to."""
        own = plain(found.attrs["NAME"]) if simple(found.attrs, "NAME") else ""
        inner = self.today(f"{group}/{own}")
        return f"{group}/{inner}" if group and inner in self.names(group) else self.today(own)

    def length(self, name: str) -> int:
        """Number of values along a dimension, by the name of its scale."""
        found = self.item(name)
        with reading(self.path, name):
            return found.shape[0]

    def about(self, name: str, which: str) -> str:
        """An attribute of a dataset, `units` or `long_name`; empty where the dataset has none."""
        found = self.item(name)
        with reading(self.path, name):
            attrs = found.attrs
            return f"{plain(attrs[which])}" if which in attrs and simple(attrs, which) else ""

    def without(self, name: str) -> str:
        """The message for a dataset that is missing."""
        there = self.names()
        return f"{self.path}: no {shown(name)} in this file{meant(name, there)}: there are {', '.join(there)}"

    def check_whole(self) -> None:
        """Refuses a file whose parts do not fit together; each kind of file has its own checks."""

    def check_dataset(self, name: str, found: h5py.Dataset) -> None:
        """Raises ValueError for anything but an array of numbers, for an array larger than the file can hold,
        and for a shape that does not fit the other datasets.
        """
        if not isinstance(found, h5py.Dataset):
            raise ValueError("not an array of numbers")
        if name in self.GROUPS:
            raise ValueError("not a group")
        # first, as even the shape of a virtual dataset may be looked for in other files
        check_storage(found.id.get_create_plist())
        if (kind := found.dtype).kind not in self.KINDS:
            raise ValueError("not an array of numbers")
        if kind.kind == "O" and h5py.check_string_dtype(kind) is None:
            raise ValueError("neither numbers nor texts")
        # HDF5 allocates whole chunks; deflated data may be larger than the file
        claimed = kind.itemsize * max(math.prod(found.shape), math.prod(found.chunks or (0,)))
        if claimed > self.most(name, found):
            raise ValueError(f"it claims {claimed} bytes, more than the file holds")
        scales = self.over[name] = self._scales(name, found)
        if scales == (name,):
            fits(found.shape[1:], ())
        else:
            fits(found.shape, [self.length(each) for each in scales])

    def most(self, name: str, found: h5py.Dataset) -> int:
        """Most bytes that the values of a dataset may take."""
        compressed = found.id.get_create_plist().get_nfilters() > 0
        return max(COMPRESSION * self.size, SMALL) if compressed else self.size

    def sound(self, name: str, values: Any) -> Any:
        """The values that were read; ValueError where they are impossible."""
        return values


def few_enough(names: Sized) -> None:
    """Raises ValueError for attributes or datasets that are more than a file of the program has."""
    if len(names) > MOST_NAMES:
        raise ValueError(f"{len(names)} names")


def check_storage(creation: h5py.h5p.PropDCID) -> None:
    """Raises ValueError for values that are not in the file, or that need the filter of another library."""
    if creation.get_layout() == h5d.VIRTUAL or creation.get_external_count():
        raise ValueError("its values are in other files")
    if any(creation.get_filter(k)[0] not in FILTERS for k in range(creation.get_nfilters())):
        raise ValueError("compressed by an unknown filter")


@contextmanager
def reading(path: str, what: str) -> Iterator[None]:
    """Turns every exception of h5py into a RunError; a damaged file can raise any of them."""
    try:
        yield
    except RunError:
        raise
    except Exception as error:
        raise damaged(path, what, error) from error


def damaged(path: str, what: str, why: object) -> RunError:
    """The error of a damaged file, in one line."""
    reason = why.args[0] if isinstance(why, KeyError) and why.args else why
    words = " ".join(plain(f"{reason}").split())
    return RunError(f"{path}: {shown(what)} cannot be read, the file is damaged ({words})")


def simple(attrs: h5py.AttributeManager, name: str) -> bool:
    """True where an attribute is one text or number; the library can crash over other, damaged types."""
    found = attrs.get_id(name)
    known = found.get_type().get_class() in (h5t.STRING, h5t.INTEGER, h5t.FLOAT)
    return known and found.shape == () and found.get_storage_size() <= LONGEST


def plain(value: Any) -> Any:
    """A text with every character replaced that cannot be printed; other values as they are."""
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    if not isinstance(value, str):
        return value
    # h5py gives bytes that are not UTF-8 as surrogates
    return UNPRINTABLE.sub("\ufffd", value)


def shown(name: str) -> str:
    """A name as messages show it: on one line, and not too long."""
    return " ".join(plain(name).split())[:80]


class FileToRead(h5py.File):
    """An HDF5 file that is only read: what the system says at its close tells nothing of what was read."""

    def close(self) -> None:
        with suppress(OSError, RuntimeError):
            super().close()


def opened(path: str) -> h5py.File:
    """The HDF5 file of that name."""
    if not os.path.exists(path):
        raise RunError(f"{path}: no such file")
    if os.path.isdir(path):
        makes = "tiltpad-collect makes a study of its results"
        raise RunError(f"{path}: is a folder, not a result file; {makes}")
    if not os.path.isfile(path):
        raise RunError(f"{path}: a device or pipe, not an ordinary file")
    if not os.access(path, os.R_OK):
        raise RunError(f"{path}: no permission to read it")
    try:
        if not h5py.is_hdf5(path):
            raise RunError(f"{path}: not an HDF5 file{'; a case: tiltpad runs it' if is_case(path) else ''}")
        if heaps.endless(path):
            raise damaged(path, "attributes", "an object without length in their heap")
        return FileToRead(path, "r")
    except OSError as error:
        told = " ".join(str(error).split())
        raise RunError(f"{path}: cannot be opened, damaged or still being written ({told})") from error
    except (ValueError, RuntimeError, MemoryError) as error:
        raise damaged(path, "it", error) from error


def is_case(path: str) -> bool:
    """True for a file that starts as a namelist does, with a group or a comment."""
    with open(path, "rb") as file:
        return file.read(200).lstrip()[:1] in (b"&", b"!")


def meant(word: str, known: Iterable[str]) -> str:
    """What a wrong word may stand for, as words for the end of a clause: " (did you mean orbit?)"."""
    among = list(known)
    found = get_close_matches(word, among, 1) or [each for each in among if word and word in each]
    return f" (did you mean {' or '.join(found)}?)" if 0 < len(found) <= 3 else ""


def check_origin(path: str, attributes: dict[str, Any]) -> None:
    """Refuses files of other programs, of a later format, and files without the attributes of every file."""
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
    if version > MACHINE_VERSION:
        known = f"{MACHINE_VERSION}, the newest this reader knows; update the Python package tiltpad"
        raise RunError(f"{path}: format_version {version} is newer than {known}")
    if version < OLDEST_VERSION:
        known = f"versions {OLDEST_VERSION} to {MACHINE_VERSION} can be read"
        raise RunError(f"{path}: format_version {version} is unknown; {known}")


def fits(shape: Sequence[int], wanted: Sequence[int]) -> None:
    """Raises ValueError where the shape of a dataset does not fit the other datasets."""
    if tuple(shape) != tuple(wanted):
        raise ValueError(f"its shape is {tuple(shape)}, {tuple(wanted)} fits the others")
