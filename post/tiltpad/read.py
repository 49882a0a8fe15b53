"""Result files: opening them, and saying what is wrong with them."""

import os
import warnings
from bisect import bisect_left
from functools import cached_property
from typing import Any

import h5py
import numpy as np

from tiltpad import namelist

#: Newest format_version that this reader knows.
FORMAT_VERSION = 1


class RunError(Exception):
    """The file is missing, or is no result of tiltpad that can be read."""


class NotInRunError(RunError, AttributeError):
    """The run has no such dataset; the message says why."""


class IncompleteRunWarning(UserWarning):
    """The run ended before its time; what was computed is there."""


def read(path: str | os.PathLike) -> "Run":
    """Opens a result file. Raises RunError; warns with IncompleteRunWarning."""
    return Run(path)


class Run:
    """One result file, open for reading; nothing is loaded before it is asked for.

    run.journal_y, run["journal_y"]      dataset as an array, (time,) or (time, pad), SI units
    run.values("journal_y", part)        the same, only the samples of the slice `part`
    run.equilibrium                      group as a dictionary of arrays
    run["equilibrium/journal_y"]         one of them
    run.title, run.complete, ...         attributes of the file; run.attributes has all of them
    run.input["bearing"]                 resolved namelist, a dictionary a group
    """

    def __init__(self, path: str | os.PathLike):
        self.path = os.fspath(path)
        self.file = opened(self.path)
        try:
            self.attributes: dict[str, Any] = dict(self.file.attrs)
            check(self.path, self.attributes)
        except BaseException:
            self.file.close()
            raise
        if not self.attributes.get("complete", 0):
            warnings.warn(f"{self.path}: incomplete run{self._end()}", IncompleteRunWarning, stacklevel=3)

    def __getitem__(self, name: str) -> Any:
        return self.values(name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name in ("file", "path", "attributes"):
            raise AttributeError(name)
        return self.attributes[name] if name in self.attributes else self.values(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.file, *self.attributes]

    def __contains__(self, name: str) -> bool:
        return name in self.file

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<tiltpad run {self.path!r}: {self.title or self.task}, {', '.join(self.file)}>"

    def close(self) -> None:
        self.file.close()

    def values(self, name: str, part: slice | int = slice(None)) -> Any:
        """A dataset as an array, or the samples `part` of it; a group as a dictionary of arrays."""
        if name not in self.file:
            group = name.split("/")[0]
            missing = name if group in self.file else group
            raise NotInRunError(f"{self.path}: no {missing} in this run: {self.why_not(missing)}")
        found = self.file[name]
        try:
            if isinstance(found, h5py.Group):
                return {key: item[()] for key, item in found.items()}
            return found[()] if found.ndim == 0 else found[part]
        except OSError as error:
            raise RunError(f"{self.path}: {name} cannot be read, the file is damaged ({error})") from error

    def first(self, name: str, value: float) -> int:
        """Index of the first sample at or above a value in a rising dataset; reads only a few of them."""
        return bisect_left(range(self.samples), value, key=lambda i: self.values(name, i))

    def dimensions(self, name: str) -> int:
        """Number of dimensions of a dataset: 1 (time,), 2 (time, pad)."""
        return np.ndim(self.values(name, slice(0, 1)))

    @cached_property
    def input(self) -> dict[str, dict[str, Any]]:
        """The resolved namelist: {"bearing": {"assembled_clearance": 8e-5, ...}, ...}."""
        return namelist.parse(self.attributes["input"])

    @property
    def clearance(self) -> float:
        """Assembled clearance c_r, m."""
        return self.input["bearing"]["assembled_clearance"]

    @property
    def pads(self) -> int:
        """Number of pads."""
        return len(self.file["pad"])

    @property
    def samples(self) -> int:
        """Number of samples in time; 0 where nothing was marched."""
        return len(self.file["time"]) if "time" in self.file else 0

    def _end(self) -> str:
        if not self.samples:
            return " without samples in time"
        duration = self.input["operation"]["duration"]
        return f", ended at {self.file['time'][-1]:g} s of {duration:g} s"

    def why_not(self, name: str) -> str:
        """Why the scene has no such dataset."""
        friction, motion = self.input["friction"]["model"], self.input["pads"]["motion"]
        if name == "bristle_deflection" and friction != "lugre":
            return f"friction model is '{friction}'"
        if "pad_penetration" in name and motion != "tilting_radial":
            return f"pad motion is '{motion}'"
        if self.task == "equilibrium":
            return "its task is 'equilibrium', nothing was marched in time"
        if not self.samples:
            return "it ended before its first sample"
        operation = self.input["operation"]
        if name == "spectrum" and operation["speed_rpm"] != operation["final_speed_rpm"]:
            return "the speed changes"
        if name == "spectrum":
            return "less than one revolution was sampled, or the run is incomplete"
        return f"there are {', '.join(self.file)}"


def opened(path: str) -> h5py.File:
    """The HDF5 file of that name."""
    if not os.path.exists(path):
        raise RunError(f"{path}: no such file")
    if os.path.isdir(path):
        raise RunError(f"{path}: is a folder, not a result file")
    if not os.access(path, os.R_OK):
        raise RunError(f"{path}: no permission to read it")
    if not h5py.is_hdf5(path):
        raise RunError(f"{path}: not an HDF5 file")
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise RunError(f"{path}: cannot be opened, damaged or still being written ({error})") from error


def check(path: str, attributes: dict[str, Any]) -> None:
    """Refuses files of other programs, and of a later format."""
    if attributes.get("program") != "tiltpad" or "input" not in attributes:
        raise RunError(f"{path}: not a result of tiltpad (attribute 'program' is not 'tiltpad')")
    version = int(attributes.get("format_version", 0))
    if version > FORMAT_VERSION:
        raise RunError(
            f"{path}: format_version {version} is newer than {FORMAT_VERSION}, the newest this reader knows; "
            "update the Python package tiltpad"
        )
