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

#: Datasets over which the others are drawn and integrated; they must be finite.
AXES = ("time", "shaft_angle", "speed", "pivot_angle")
#: Dimensions whose values are texts.
LABELS = ("pivot", "row", "column", "position_row", "position_column")
#: All arrays of texts.
TEXTS = (*LABELS, "special_points/kind")
#: Dimensions of the groups coefficients and modes.
COEFFICIENTS = {
    **dict.fromkeys(("stiffness", "damping"), ("pivot", "frequency_ratio", "row", "column")),
    **dict.fromkeys(("full_stiffness", "full_damping"), ("pivot", "position_row", "position_column")),
    "full_mass": ("position_row", "position_column"),
}
MODES = {
    **dict.fromkeys(("eigenvalue_real", "eigenvalue_imag"), ("pivot", "mode")),
    **dict.fromkeys(("frequency", "damping_ratio", "log_decrement"), ("pivot", "mode")),
    **dict.fromkeys(("shape_real", "shape_imag"), ("pivot", "mode", "position_row")),
    "threshold_rpm": ("pivot",),
}
#: Dimensions of what a heat balance adds to the group equilibrium.
WARM = {
    **dict.fromkeys(("inlet_temperature", "mean_temperature", "outlet_temperature"), ("pad",)),
    **dict.fromkeys(("maximum_temperature", "viscosity"), ("pad",)),
    **dict.fromkeys(("shaft_temperature", "drain_temperature"), ()),
}
#: Dimensions of what the task branch writes; some names are those of series over the time.
BRANCH = {
    **dict.fromkeys(("point", "branch", "parameter", "arc_length", "stable", "iterations"), ("point",)),
    **dict.fromkeys(("journal_y_max", "journal_y_min", "journal_z_max", "journal_z_min"), ("point",)),
    **dict.fromkeys(("journal_y_amplitude", "journal_z_amplitude"), ("point",)),
    **dict.fromkeys(("journal_y_phase", "journal_z_phase"), ("point",)),
    **dict.fromkeys(("period", "revolutions", "intervals"), ("point",)),
    **dict.fromkeys(("pad_tilt_max", "pad_tilt_min", "min_film_thickness"), ("point", "pad")),
    **{name: ("point", *dimensions) for name, dimensions in WARM.items()},
    **dict.fromkeys(("multiplier_real", "multiplier_imag"), ("point", "mode")),
    **dict.fromkeys(("eigenvalue_real", "eigenvalue_imag"), ("point", "mode")),
    **dict.fromkeys(
        (
            *("special_points/point", "special_points/branch", "special_points/parameter"),
            *("special_points/value_real", "special_points/value_imag"),
        ),
        ("special_points/point",),
    ),
    "special_points/kind": ("special_points/kind",),
}
#: Single numbers of the group periodic.
PERIODIC = (
    *("period", "revolutions", "residual", "iterations", "intervals", "evaluations", "marched_periods"),
    "stable",
)
#: Dimensions of the known datasets; those of a later program are read as they are.
DIMENSIONS = {
    **dict.fromkeys(
        ("time", "shaft_angle", "speed", "journal_y", "journal_z", "journal_vy", "journal_vz"), ("time",)
    ),
    **dict.fromkeys(
        (
            *("pad_tilt", "pad_tilt_rate", "pad_penetration", "pad_penetration_rate", "bristle_deflection"),
            *("contact_force", "friction_moment", "film_force_tangential", "film_force_radial"),
            *("min_film_thickness", "max_pressure", "asperity_force"),
        ),
        ("time", "pad"),
    ),
    **dict.fromkeys(("pad", "pivot_angle", "viscosity"), ("pad",)),
    **dict.fromkeys(("equilibrium/journal_y", "equilibrium/journal_z", "equilibrium/residual"), ()),
    **dict.fromkeys(("equilibrium/eigenvalue_real", "equilibrium/eigenvalue_imag"), ()),
    **dict.fromkeys(
        (
            *("equilibrium/eccentricity_ratio", "equilibrium/attitude_angle", "equilibrium/specific_load"),
            *("equilibrium/sommerfeld_number", "equilibrium/total_power_loss"),
            *("equilibrium/total_inlet_flow", "equilibrium/total_outlet_flow", "equilibrium/total_side_flow"),
            *("equilibrium/temperature_rise_fresh", "equilibrium/temperature_rise_side"),
        ),
        (),
    ),
    **dict.fromkeys(
        (
            *("equilibrium/pad_tilt", "equilibrium/pad_penetration", "equilibrium/contact_force"),
            *("equilibrium/min_film_thickness", "equilibrium/max_pressure", "equilibrium/load"),
            *("equilibrium/power_loss", "equilibrium/couette_loss", "equilibrium/pressure_loss"),
            *("equilibrium/boundary_loss", "equilibrium/journal_drag", "equilibrium/pad_drag"),
            *("equilibrium/inlet_flow", "equilibrium/outlet_flow", "equilibrium/side_flow"),
            *("equilibrium/temperature_rise",),
            *("asperities/highest_force", "asperities/highest_share", "asperities/contact_time"),
        ),
        ("pad",),
    ),
    **{f"equilibrium/{name}": dimensions for name, dimensions in WARM.items()},
    **dict.fromkeys(
        ("spectrum/frequency", "spectrum/order", "spectrum/journal_y", "spectrum/journal_z"),
        ("spectrum/frequency",),
    ),
    "spectrum/pad_tilt": ("pad", "spectrum/frequency"),
    "oil/time": ("oil/time",),
    "oil/viscosity": ("oil/time", "pad"),
    **dict.fromkeys(("spectrum/full_frequency", "spectrum/journal_full"), ("spectrum/full_frequency",)),
    **dict.fromkeys(("spectrum/revolutions", "checkpoint/time"), ()),
    **{f"coefficients/{name}": dimensions for name, dimensions in COEFFICIENTS.items()},
    **{f"modes/{name}": dimensions for name, dimensions in MODES.items()},
    **dict.fromkeys((f"periodic/{name}" for name in PERIODIC), ()),
    **dict.fromkeys(("periodic/multiplier_real", "periodic/multiplier_imag"), ("multiplier",)),
    **{name: (name,) for name in (*LABELS, "frequency_ratio", "mode", "multiplier")},
}
#: Groups of a file, and the tasks that write them.
TASKS = {"coefficients": "coefficients", "modes": "coefficients", "periodic": "periodic"}
#: What only pads that tilt have.
OF_TILTING = ("pad_tilt", "contact_force", "friction_moment")
#: A group of single numbers.
NUMBERS = "statistics"


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
        np.savetxt(path, np.column_stack(columns), "%.17g", ",", header=",".join(head), comments="")

    def is_series(self, name: str) -> bool:
        """True for datasets over the time."""
        return DIMENSIONS.get(name, ())[:1] == ("time",)

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
        """Assembled clearance c_r, m."""
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

    def scales(self, name: str) -> Sequence[str] | None:
        if name.startswith(f"{NUMBERS}/"):
            return ()
        return BRANCH[name] if self.is_branch and name in BRANCH else DIMENSIONS.get(name)

    def sound(self, name: str, values: Any) -> Any:
        if (np.asarray(values).dtype.kind == "S") != (name in TEXTS):
            raise ValueError("not an array of texts" if name in TEXTS else "not an array of numbers")
        if name in TEXTS:
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
        if "pad_penetration" in name and motion != "tilting_radial":
            return f"pad motion is '{motion}'"
        if motion == "fixed" and any(each in name for each in OF_TILTING):
            return "pad motion is 'fixed'"
        thermal = self.input.get("thermal", {}).get("model", "none")
        if name.removeprefix("equilibrium/") in WARM and thermal == "none":
            return "it has no heat balance (thermal%model = 'none')"
        if name.startswith("equilibrium") and (start := self.input.get("start", {}).get("from")):
            return f"it did not start at one (start%from = '{start}')"
        if (needed := TASKS.get(name.partition("/")[0])) and needed != self.task:
            return f"its task is '{self.task}', not '{needed}'"
        if name in TASKS:
            return f"{self.attributes.get('reason', '')}" or "it did not come to its end"
        if name in BRANCH and not self.is_branch and name not in DIMENSIONS:
            return f"its task is '{self.task}'"
        if self.task in ("equilibrium", "coefficients", "branch"):
            return f"its task is '{self.task}', nothing was marched in time"
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
