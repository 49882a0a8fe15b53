"""Studies: one file with the results of many runs over their parameters."""

import os
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np

from tiltpad.files.archive import Archive, RunError, damaged, few_enough, plain, reading, shown
from tiltpad.files.notebook import html_of
from tiltpad.files.processes import write_table
from tiltpad.files.read import IncompleteRunWarning, Run, StudyError, read
from tiltpad.files.writing import write_csv

#: The dimension of all arrays, and of what has a value for each of the pivots in small vibrations.
RUN, PIVOTS = ("run",), ("run", "pivot")
#: Maximum number of revolutions of which Poincare points are kept.
REVOLUTIONS = 50
#: States that Poincare points are kept of.
POINTS = {"poincare_y": "journal_y", "poincare_z": "journal_z", "poincare_tilt": "pad_tilt"}

#: The group of the groups of a machine's bearings; how names begin that are of a machine as a whole alone,
#: also behind EQUILIBRIUM.
BEARINGS, OF_MACHINES = "bearings", ("station", "bearing", "response", "synchronous")
EQUILIBRIUM = "equilibrium_"

#: Most bytes of a column of a study that is still being run: a thousand values of a hundred thousand runs.
UNWRITTEN = 800_000_000


class Failure(NamedTuple):
    """A run that was not done: its number, its values of the parameters, how and why it ended."""

    run: int
    values: dict[str, Any]
    how: str
    reason: str

    def __str__(self) -> str:
        texts = {k: v if isinstance(v, str) else f"{v:g}" for k, v in self.values.items()}
        own = ", ".join(f"{k} = {v}" for k, v in texts.items())
        why = f": {self.reason}" if self.reason else ""
        return f"run {self.run}{f' ({own})' if own else ''} {self.how}{why}"


#: How a run ended, by its status, and the status of one that is still to be run.
PENDING = -2
ENDS = {
    2: "failed in its numerics",
    3: "failed at a file or the system",
    4: "was stopped",
    -1: "has not ended",
    PENDING: "has not been run yet",
}


def read_study(path: str | os.PathLike) -> "Study":
    """Opens a study, the file that `tiltpad study.nml` or tiltpad-collect writes. Raises RunError."""
    return Study(path)


def read_either(path: str | os.PathLike) -> "Run | Study":
    """Opens the result of a run or a study, whichever it is. Raises RunError."""
    try:
        return read_study(path) if os.path.exists(log_of(path)) else read(path)
    except StudyError:
        return read_study(path)


def log_of(path: str | os.PathLike) -> str:
    """The log of a study that is being performed, or whose program was killed: it has all rows."""
    return f"{os.path.realpath(path)}.rows"


@contextmanager
def with_all_rows(path: str | os.PathLike) -> Iterator[str | os.PathLike]:
    """The file of a study, or, where it has a log, one that the program makes of it, to be opened at once."""
    if not os.path.exists(log := log_of(path)):
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="tiltpad-") as folder:
        table: str | os.PathLike = os.path.join(folder, os.path.basename(path))
        try:
            write_table(log, table)
        except RunError as error:
            if not os.path.exists(path):
                raise
            table = path
            if os.path.exists(log):
                warnings.warn(
                    f"{path}: without the rows since its last checkpoint: {error}",
                    IncompleteRunWarning,
                    stacklevel=4,
                )
        yield table


class Study(Archive):
    """One study, open for reading; a dataset is loaded when it is used.

    Everything in the file has its name here:

        study.orbit_y, study["orbit_y"]      a result, (run,), in SI units; nan of a run that failed
        study.speed_rpm                      a parameter, (run,), as in the input
        study.poincare_y                     Poincare points, (run, revolution)
        study.parameters                     names of the parameters
        study.title, study.created, ...      attributes of the file; study.attributes has all of them
        study.result(3).journal_y            the samples of a run that has a file of its own
        study.bearings["left"].orbit_y       of machines: what a study of this bearing alone would have
    """

    KINDS = "fiuO"

    def __init__(self, path: str | os.PathLike):
        with with_all_rows(path) as table:
            super().__init__(table)
        self.path = os.fspath(path)

    title: str
    version: str
    created: str
    format_version: int

    def __repr__(self) -> str:
        runs, over = self.length("run"), ", ".join(self.parameters)
        return f"<tiltpad study {self.path!r}: {runs} runs over {over}>"

    def _repr_html_(self) -> str:
        heading = f"{self.title or self.path}: {self.length('run')} runs over {', '.join(self.parameters)}"
        return html_of(self, heading)

    def to_xarray(self) -> Any:
        """The datasets as an xarray.Dataset in memory, over the runs; needs xarray and h5netcdf."""
        import xarray

        with reading(self.path, "it"), with_all_rows(self.path) as table:
            return xarray.load_dataset(table, engine="h5netcdf")

    def to_csv(self, path: str | os.PathLike) -> None:
        """Writes parameters and results of one number, a row for each run.

        Results of a bearing of a machine have the bearing's name before their own: left/orbit_y.
        """
        columns = self._columns()
        write_csv(path, [columns, *zip(*columns.values(), strict=True)])

    def to_pandas(self) -> Any:
        """The table of `to_csv` as a pandas.DataFrame over the runs; needs pandas."""
        import pandas as pd

        return pd.DataFrame(self._columns()).set_index("run")

    def _columns(self) -> dict[str, np.ndarray]:
        """Parameters and results of one number, a column each."""
        others = {*RUN, *self.parameters, *self.GROUPS}
        there = [name for name in self.names() if name not in others]
        columns = {name: self[name] for name in ("run", *self.parameters)}
        columns |= {name: self[name] for name in there if self.scales(name) == RUN}
        for bearing, own in self.bearings.items():
            mine = (name for name in own.inner(own.group) if own.scales(name) == RUN)
            columns |= {f"{bearing}/{name}": own[name] for name in mine}
        return columns

    @cached_property
    def bearings(self) -> "dict[str, BearingStudy]":
        """The bearings of a machine by their names, each as a study of its own; empty for any other study."""
        there = self.inner(BEARINGS) if BEARINGS in super().names() else []
        return {name: BearingStudy(self, name) for name in there}

    def inner(self, path: str) -> list[str]:
        """Names of what is in a group of the file."""
        with reading(self.path, path):
            if not isinstance(found := super().own(path), h5py.Group):
                raise ValueError("not a group")
            few_enough(found)
            return sorted(plain(name) for name in found)

    def names(self, group: str = "") -> list[str]:
        """Names of the datasets and groups in the file or in a group of it, in alphabetical order."""
        return [name for name in super().names(group) if group or name != BEARINGS]

    def without(self, name: str) -> str:
        """The message for a dataset that is missing."""
        if there := [bearing for bearing, own in self.bearings.items() if name in own]:
            known = " and ".join(f"study.bearings[{each!r}]" for each in there)
            return f"{self.path}: no {shown(name)} of the whole machine: its bearings have it, as {known}"
        return super().without(name)

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, the slowest one first."""
        return self.attributes["parameters"].split()

    @property
    def done(self) -> np.ndarray:
        """True for the runs that were done, (run,)."""
        return self.status == 0

    @property
    def pending(self) -> np.ndarray:
        """True for the runs that have not been run yet, (run,)."""
        return self.status == PENDING

    @property
    def failed(self) -> np.ndarray:
        """True for the runs that were run and not done, (run,)."""
        return ~self.done & ~self.pending

    @property
    def remarked(self) -> np.ndarray:
        """True for the runs that have remarks, (run,)."""
        if "remarks" not in self:
            return np.zeros(len(self.status), bool)
        return np.array([bool(each) for each in self["remarks"]])

    def failures(self, most: int | None = None) -> list[Failure]:
        """The runs that were run and not done, with their recorded reasons; the first `most` of them."""
        status, failed = self.status, np.flatnonzero(self.failed)[:most]
        if not len(failed):
            return []
        parameters = {name: self[name][failed] for name in self.parameters}
        reasons = self.reason[failed] if "reason" in self else [""] * len(failed)
        found = []
        for k, (number, own, reason) in enumerate(
            zip(self.run[failed], status[failed], reasons, strict=True)
        ):
            there = {name: values[k] for name, values in parameters.items()}
            found.append(Failure(int(number), there, ENDS.get(own, "cannot be read"), reason))
        return found

    def result(self, run: int) -> Run:
        """The result of a run of the study, opened from its own file.

        The file is found as long as study and files are moved together. Raises ValueError for a number that
        the study does not have, and RunError where the run has no file.
        """
        places = np.flatnonzero(self.run == run)
        if not places.size:
            raise ValueError(f"{self.path}: no run {run}; there are {self.run[0]:g} to {self.run[-1]:g}")
        name = self["file"][places[0]] if "file" in self else ""
        if not name:
            keeps = "output%keep = 'all' keeps its samples"
            raise RunError(f"{self.path}: run {run} has no file of its own; {keeps}")
        # the study, or a link to it, may be beside its files
        paths = [path.parent / name for path in (Path(self.path), Path(self.path).resolve())]
        return read(next((path for path in paths if path.exists()), paths[0]))

    def check_whole(self) -> None:
        """Refuses the result of one run, and a study without its parameters."""
        if self.attributes["task"] != "study":
            raise RunError(f"{self.path}: the result of one run, not a study")
        if not isinstance(self.attributes.get("parameters"), str):
            raise damaged(self.path, "attribute 'parameters'", "it is missing")
        for name in ("run", "status", *self.parameters):
            if name not in self:
                raise damaged(self.path, name, "it is missing")

    def most(self, name: str, found: h5py.Dataset) -> int:
        # runs that have not been run take no room; their numbers, in `run`, do
        rows = found.ndim and found.chunks is not None and name != "run"
        return max(super().most(name, found), UNWRITTEN if rows else 0)

    def sound(self, name: str, values: Any) -> Any:
        if np.asarray(values).dtype.kind != "O":
            return values
        texts = [plain(each) if each else "" for each in np.atleast_1d(values)]
        if not all(isinstance(each, str) for each in texts):
            raise ValueError("not an array of texts")
        return np.array(texts, dtype=object).reshape(np.shape(values))


class BearingStudy(Study):
    """A bearing of a machine as the study of one bearing: every calculation and picture of a study takes it.

    It has what is in its group of the file, and under their own names what the whole machine has: parameters,
    ends of the runs, frequencies and damping of modes.
    """

    def __init__(self, machine: Study, name: str):
        self.machine, self.group = machine, f"{BEARINGS}/{name}"
        self.path, self.file, self.size = machine.path, machine.file, machine.size
        self.found, self.listed, self.over, self.former = {}, {}, {}, {}
        title = f"{machine.attributes['title']}, bearing {name}".removeprefix(", ")
        self.attributes = machine.attributes | {"title": title}

    def names(self, group: str = "") -> list[str]:
        """Names of the datasets of the bearing, and of the machine as a whole."""
        if group not in self.listed:
            every = self.machine.names()
            shared = {each for each in every if not each.removeprefix(EQUILIBRIUM).startswith(OF_MACHINES)}
            self.listed[group] = [] if group else sorted(shared.union(self.inner(self.group)))
        return self.listed[group]

    def own(self, path: str) -> h5py.Dataset | h5py.Group:
        """The object of this path: that of the bearing, or else that of the machine."""
        return super().own(f"{self.group}/{path}" if path in self.inner(self.group) else path)

    def close(self) -> None:
        """Closes the file of the machine."""
        self.machine.close()
