"""Reading result files, with a reason if a file cannot be read."""

import os
import textwrap
import warnings
from bisect import bisect_left
from collections.abc import Callable, Sequence
from functools import cached_property, wraps
from typing import Any

import numpy as np

from tiltpad.files import namelist
from tiltpad.files.archive import Archive, NotInRunError, RunError, damaged, meant, plain, reading, shown
from tiltpad.files.writing import replacing

#: Datasets over which the others are drawn and integrated; they must be finite.
AXES = ("time", "shaft_angle", "speed", "pivot_angle")
#: Groups of a file, and the tasks that write them.
TASKS = {"coefficients": "coefficients", "modes": "coefficients", "periodic": "periodic"}
#: What only pads that tilt have.
OF_TILTING = ("pad_tilt", "pivot_load", "friction_moment")
#: Series of branches, by which a run without them is told that it is none.
OF_BRANCHES = ("point", "branch", "parameter", "multiplier_real", "eigenvalue_real")


class IncompleteRunWarning(UserWarning):
    """The run did not reach its end; the file has the samples up to the time at which it stopped."""


class StudyError(RunError):
    """The file is a study, and not the result of one run."""


def read(path: str | os.PathLike) -> "Run":
    """Opens a result file. Raises RunError; warns with IncompleteRunWarning."""
    return Run(path)


class Run(Archive):
    """One result file, open for reading; a dataset is loaded when it is used.

    Everything in the file has its name here:

        run.journal_y, run["journal_y"]      dataset as an array, (time,) or (time, pad), SI units
        run.values("journal_y", part)        the same, only the samples of the slice `part`
        run.equilibrium                      group as a dictionary of arrays
        run["equilibrium/journal_y"]         one of them
        run.title, run.complete, ...         attributes of the file; run.attributes has all of them
        run.input["bearing"]                 resolved namelist, a dictionary a group
    """

    KINDS = "fiuS"

    def __init__(self, path: str | os.PathLike):
        super().__init__(path)
        if not self.attributes["complete"]:
            warnings.warn(f"{self.path}: incomplete run{self.end()}", IncompleteRunWarning, stacklevel=3)

    def __repr__(self) -> str:
        lines = [f"<tiltpad run {self.path!r}: {self.title or 'no title'}", f"  {self.in_words()}"]
        single = [name for name in self.names() if name not in self.GROUPS]
        lines += textwrap.wrap(", ".join(single), 100, initial_indent="  ", subsequent_indent="    ")
        for group in (name for name in self.names() if name in self.GROUPS and name != "checkpoint"):
            own = f"{group}/: {', '.join(self.names(group))}"
            lines += textwrap.wrap(own, 100, initial_indent="  ", subsequent_indent="    ")
        return "\n".join(lines) + ">"

    def in_words(self) -> str:
        """Task, whether it is complete, duration, pads, friction and speed."""
        pads, friction = self.input["pads"]["motion"], self.input["friction"]["model"]
        first, final = (self.input["operation"][name] for name in ("speed_rpm", "final_speed_rpm"))
        words = [self.task, "complete" if self.complete else f"incomplete{self.end()}"]
        if self.samples and self.complete:
            words.append(f"{self.values('time', -1):g} s")
        words.append(f"{self.pads} pad{'s' if self.pads > 1 else ''} ({pads})")
        words.append("no friction" if friction == "none" else f"friction {friction}")
        words.append(
            f"{first:g} rpm" if first == final or self.task != "march" else f"{first:g} to {final:g} rpm"
        )
        return ", ".join(words)

    def to_xarray(self, group: str | None = None) -> Any:
        """The datasets, or those of a group, as an xarray.Dataset in memory; needs xarray and h5netcdf."""
        import xarray

        with reading(self.path, group or "it"):
            data = xarray.load_dataset(self.path, engine="h5netcdf", group=group)
        scales = {name: self[name] for name in data.dims if name in self and name not in data.coords}
        return data.assign_coords(scales)

    def to_csv(self, path: str | os.PathLike, names: Sequence[str] | None = None) -> None:
        """Writes series over the time, by default all, a column each; of pads pad_tilt_1, pad_tilt_2, ..."""
        if not self.samples:
            raise NotInRunError(f"{self.path}: no series in this run: {self.why_not('time')}")
        there = [name for name in self.names() if self.is_series(name)]
        for name in names or ():
            if name not in there:
                raise ValueError(f"{self.path}: {name} is no series of this run: {', '.join(there)}")
        head, columns = ["time"], [self.time]
        for name in names or there:
            values = self[name]
            if name != "time":
                head += [name] if values.ndim == 1 else [f"{name}_{k + 1}" for k in range(values.shape[1])]
                columns += [values] if values.ndim == 1 else list(values.T)
        with replacing(path) as file:
            np.savetxt(file, np.column_stack(columns), "%.17g", ",", header=",".join(head), comments="")

    def is_series(self, name: str) -> bool:
        """True for datasets over the time."""
        return name not in self.GROUPS and self.scales(name)[:1] == ("time",)

    def values(self, name: str, part: slice | int = slice(None)) -> Any:
        if part != slice(None) and not self.is_series(name):
            raise damaged(self.path, name, "it is not over the time")
        return super().values(name, part)

    def first(self, name: str, value: float) -> int:
        """Index of the first sample at or above a value in a rising dataset; reads only a few of them."""
        return bisect_left(range(self.samples), value, key=lambda i: self.values(name, i))

    def dimensions(self, name: str) -> int:
        """Number of dimensions of a dataset: 1 (time,), 2 (time, pad)."""
        return self.item(name).ndim

    @cached_property
    def input(self) -> dict[str, dict[str, Any]]:
        """The resolved namelist: {"bearing": {"assembled_clearance": 8e-5, ...}, ...}."""
        with reading(self.path, "attribute 'input'"):
            return namelist.resolved(self.attributes["input"])

    @property
    def clearance(self) -> float:
        """Bearing clearance c_r, m."""
        return self.input["bearing"]["assembled_clearance"]

    @property
    def pads(self) -> int:
        """Number of pads."""
        return namelist.count(self.input["pads"]["pivot_angle_deg"])

    @property
    def is_branch(self) -> bool:
        """True for branches of equilibria or orbits over a parameter."""
        return self.attributes["task"] == "branch"

    @property
    def samples(self) -> int:
        """Number of samples in time; 0 for an equilibrium."""
        return self.length("time") if "time" in self else 0

    def check_whole(self) -> None:
        """Refuses a study, and a file whose input has another number of pads than its datasets."""
        if self.attributes["task"] == "study":
            raise StudyError(
                f"{self.path}: a study, not the result of one run: see tiltpad-plot study, or read_study"
            )
        if "complete" not in self.attributes:
            raise damaged(self.path, "attribute 'complete'", "it is missing")
        if "pad" in self and (there := self.length("pad")) != self.pads:
            raise damaged(self.path, "pad", f"{there} pads, and {self.pads} in the input")

    def sound(self, name: str, values: Any) -> Any:
        if np.asarray(values).dtype.kind == "S":
            if self.scales(name) != (name,):
                raise ValueError("not an array of numbers")
            return np.array([plain(each).rstrip() for each in values])
        if name in AXES and not np.isfinite(values).all():
            raise ValueError("it is not finite")
        if np.any(np.abs(values) > namelist.LARGEST):
            raise ValueError("values beyond all ranges")
        return values

    def end(self) -> str:
        """Where an incomplete run ended, and the recorded reason, as words for the end of a sentence."""
        reason = f"{self.attributes.get('reason', '')}"
        why = f"{': ' if reason else ''}{reason}"
        if not self.samples:
            return why if self.is_branch else f" without samples in time{why}"
        duration = self.input["operation"]["duration"]
        return f", ended at {self.values('time', -1):g} s of {duration:g} s{why}"

    def without(self, name: str) -> str:
        """The message for a dataset that is missing."""
        return f"{self.path}: no {shown(name)} in this run: {self.why_not(name)}"

    def why_not(self, name: str) -> str:
        """The reason why the run has no such dataset."""
        friction, motion = self.input["friction"]["model"], self.input["pads"]["motion"]
        if name == "bristle_deflection" and friction != "lugre":
            return f"friction model is '{friction}'"
        if "pivot_deflection" in name and motion != "tilting_radial":
            return f"pad motion is '{motion}'"
        if motion == "fixed" and any(each in name for each in OF_TILTING):
            return "pad motion is 'fixed'"
        thermal = self.input.get("thermal", {}).get("model", "none")
        if name.endswith(("_temperature", "viscosity")) and thermal == "none":
            return "it has no heat balance (thermal%model = 'none')"
        if name.startswith("equilibrium") and (start := self.input.get("start", {}).get("from")):
            return f"it did not start at one (start%from = '{start}')"
        if (needed := TASKS.get(name.partition("/")[0])) and needed != self.task:
            return f"its task is '{self.task}', not '{needed}'"
        if name == "summary":
            return f"version {self.format_version} of the format, or it ended before its first sample"
        if name in TASKS:
            return f"{self.attributes.get('reason', '')}" or "it did not come to its end"
        if name in OF_BRANCHES and not self.is_branch:
            return f"its task is '{self.task}'"
        if self.task in ("equilibrium", "coefficients", "branch"):
            return f"its task is '{self.task}', nothing was marched in time"
        if not self.samples and self.complete and (keep := self.input["output"].get("keep")) == "summary":
            return f"it kept no samples (output%keep = '{keep}')"
        if not self.samples:
            return "it ended before its first sample"
        operation = self.input["operation"]
        if name == "spectrum" and operation["speed_rpm"] != operation["final_speed_rpm"]:
            return "the speed changes"
        if name == "spectrum":
            return "less than one revolution was sampled, or the run is incomplete"
        return f"there are {', '.join(self.names())}{meant(name, self.names())}"


def needs_run(given: object) -> None:
    """Raises TypeError where something else was given than an opened result."""
    if not isinstance(given, Run):
        if isinstance(given, str | os.PathLike):
            opens = f"tiltpad.read({os.fspath(given)!r}) opens it"
            raise TypeError(f"a result is needed, and {given!r} is a file: {opens}")
        raise TypeError(f"a result as tiltpad.read opens it is needed, not {type(given).__name__}")


def of_run(function: Callable[..., Any]) -> Callable[..., Any]:
    """Lets a function of a run say what is wrong with anything else."""

    @wraps(function)
    def checked(run: Run, *arguments: Any, **options: Any) -> Any:
        needs_run(run)
        return function(run, *arguments, **options)

    return checked
