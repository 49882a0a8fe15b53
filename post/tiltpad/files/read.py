"""Reading result files, with a reason if a file cannot be read."""

import os
import textwrap
import warnings
from bisect import bisect_left
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from functools import cached_property, wraps
from typing import Any, NoReturn

import h5py
import numpy as np

from tiltpad.files import namelist
from tiltpad.files.archive import Archive, NotInRunError, RunError, damaged, meant, plain, reading, shown
from tiltpad.files.notebook import html_of
from tiltpad.files.units import SHOWN
from tiltpad.files.writing import replacing

#: Datasets over which the others are drawn and integrated; they must be finite.
AXES = ("time", "shaft_angle", "speed", "pivot_angle")
#: Datasets of texts that are no scale of others.
TEXTS = ("modes/name", "summary/remarks")
#: What turbulent films have.
TURBULENT = ("largest_reynolds_number", "turbulent_share")
#: Groups of a file, and the tasks that write them.
TASKS = {"coefficients": "coefficients", "modes": "coefficients", "periodic": "periodic"}
#: How names begin that are of a machine as a whole, and what a result of one bearing has not.
OF_MACHINES = ("station", "bearing", "rotor", "response", "synchronous", "stability")
#: What a run of one bearing has as attributes.
OF_EACH = ("pads", "clearance")
#: Variables of the input that bending and expansion change, and that the group `shape` has in operation.
OF_SHAPE = ("journal_radius", "machined_clearance", "assembled_clearance", "pivot_distance")
#: How names of datasets end that only bearings have in whose films slopes of the journal count.
OF_SLOPES = (
    *("journal_moment_y", "journal_moment_z", "start_film_thickness", "end_film_thickness"),
    *("max_pressure_angle", "max_pressure_axial", "slope_stiffness", "slope_damping", "journal_slope_y"),
    "journal_slope_z",
)
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
        run.equilibrium                      group as a dictionary of arrays; run.equilibrium.journal_y
        run["equilibrium/journal_y"]         one of them
        run.title, run.complete, ...         attributes of the file; run.attributes has all of them
        run.input["bearing"]                 resolved namelist, a dictionary a group
        run.bearings["left"].journal_y       of a machine: what it has of one of its bearings
        run.remarks                          what is unusual, or leaves the range of the model: texts

    The input of a machine has lists of the groups that are there several times: run.input["disc"][0]["mass"].
    """

    KINDS = "fiuS"
    #: What stands before names in the file: the group of a bearing of a machine, with a slash at its end.
    group = ""

    title: str
    task: str
    version: str
    created: str
    format_version: int
    complete: int

    def __init__(self, path: str | os.PathLike):
        super().__init__(path)
        if not self.attributes["complete"]:
            warnings.warn(f"{self.path}: incomplete run{self.end()}", IncompleteRunWarning, stacklevel=3)

    def __repr__(self) -> str:
        lines = [f"<tiltpad run {self.path!r}: {self.title or 'no title'}", f"  {self.in_words()}"]
        lines += [f"  remark: {each}" for each in self.remarks]
        single, groups = self.single_and_groups()
        for own in (", ".join(single), *(f"{group}/: {', '.join(self.names(group))}" for group in groups)):
            lines += textwrap.wrap(own, 100, initial_indent="  ", subsequent_indent="    ")
        return "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        return html_of(self, f"{self.title or self.path}: {self.in_words()}")

    def in_words(self) -> str:
        """Task, whether it is complete, duration, pads and friction or bearings, and speed."""
        first, final = (self.input["operation"][name] for name in ("speed_rpm", "final_speed_rpm"))
        words = [self.task, "complete" if self.complete else f"incomplete{self.end()}"]
        if self.samples and self.complete:
            words.append(f"{self.values('time', -1):g} s")
        if self.is_machine:
            groups: dict[str, Any] = self.input
            names = [f"{each['name']}" for each in groups["bearing"]]
            words.append(f"{len(names)} bearings ({', '.join(names)})")
        else:
            pads, friction = self.input["pads"]["motion"], self.input["friction"]["model"]
            words.append(f"{self.pads} pad{'s' if self.pads > 1 else ''} ({pads})")
            words.append("no friction" if friction == "none" else f"friction {friction}")
        constant = first == final or self.task != "march"
        return ", ".join([*words, f"{first:g} rpm" if constant else f"{first:g} to {final:g} rpm"])

    def to_xarray(self, group: str | None = None) -> Any:
        """The datasets, or those of a group, as an xarray.Dataset in memory; needs xarray and h5netcdf."""
        import xarray

        with reading(self.path, group or "it"):
            where = f"{self.group}{group or ''}".rstrip("/") or None
            data = xarray.load_dataset(self.path, engine="h5netcdf", group=where)
        scales = {name: self[name] for name in data.dims if name in self and name not in data.coords}
        return data.assign_coords(scales)

    def to_csv(self, path: str | os.PathLike, names: Sequence[str] | None = None) -> None:
        """Writes series over the time, by default all, a column each; of pads pad_tilt_1, pad_tilt_2, ..."""
        columns = self._columns(names)
        with replacing(path) as file:
            table = np.column_stack(list(columns.values()))
            np.savetxt(file, table, "%.17g", ",", header=",".join(columns), comments="")

    def to_pandas(self, names: Sequence[str] | None = None) -> Any:
        """The table of `to_csv` as a pandas.DataFrame over the time; needs pandas."""
        import pandas as pd

        return pd.DataFrame(self._columns(names)).set_index("time")

    def _columns(self, names: Sequence[str] | None) -> dict[str, np.ndarray]:
        """The time and series, by default all, a column each."""
        if not self.samples:
            raise NotInRunError(f"{self.path}: no series in this run: {self.why_not('time')}")
        there = [name for name in self.names() if self.is_series(name)]
        for name in names or ():
            if name not in there:
                raise ValueError(f"{self.path}: {name} is no series of this run: {', '.join(there)}")
        columns = {"time": self.time}
        for name in (name for name in names or there if name != "time"):
            values = self[name]
            several = {f"{name}_{k + 1}": each for k, each in enumerate(values.T)} if values.ndim > 1 else {}
            columns |= several or {name: values}
        return columns

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
        """The resolved namelist: {"bearing": {"journal_radius": 0.0499, ...}, ...}."""
        with reading(self.path, "attribute 'input'"):
            return namelist.resolved(self.attributes["input"])

    @cached_property
    def operating_text(self) -> str:
        """The text of the namelist with the radius and clearances in operation, where the run has such."""
        text = str(self.attributes["input"])
        if "shape" not in self.names():
            return text
        shape = self["shape"]
        with reading(self.path, "shape"):
            return namelist.with_values(text, {name: shape[name] for name in OF_SHAPE})

    @cached_property
    def in_operation(self) -> dict[str, dict[str, Any]]:
        """The resolved namelist with the radius and clearances in operation: bent pads, warm parts."""
        with reading(self.path, "attribute 'input'"):
            return namelist.resolved(self.operating_text)

    @cached_property
    def bearings(self) -> "Bearings":
        """The bearings of a machine by their names, each as the run of one bearing; else empty."""
        return Bearings(self)

    @property
    def is_machine(self) -> bool:
        """True for an elastic shaft in bearings, with films or without."""
        return namelist.is_machine(self.input)

    @property
    def tilts(self) -> bool:
        """Whether the pads of its bearing tilt; of a machine its bearings know."""
        return not self.is_machine and self.input["pads"]["motion"] != "fixed"

    @property
    def has_pivots(self) -> bool:
        """Whether pads tilt; of a machine those of any of its bearings."""
        return any(each.tilts for each in self.bearings.values()) if self.is_machine else self.tilts

    @property
    def remarks(self) -> list[str]:
        """What is unusual, or leaves the range of the model; of a machine behind the name of the bearing."""
        return list(self["summary/remarks"]) if "summary/remarks" in self else []

    @property
    def clearance(self) -> float:
        """Bearing clearance c_r in operation, m; of pads that differ the smallest."""
        self.needs_one_bearing("clearance")
        return min(namelist.of_pads(self.in_operation, "bearing%assembled_clearance"))

    @property
    def pads(self) -> int:
        """Number of pads."""
        self.needs_one_bearing("pads")
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
            see = "see tiltpad-plot study, or read_study"
            raise StudyError(f"{self.path}: a study, not the result of one run: {see}")
        if "complete" not in self.attributes:
            raise damaged(self.path, "attribute 'complete'", "it is missing")
        if self.is_machine:
            self.check_bearings()
            return
        if "pad" in self and (there := self.length("pad")) != self.pads:
            raise damaged(self.path, "pad", f"{there} pads, and {self.pads} in the input")

    def check_bearings(self) -> None:
        """Refuses a machine whose input has other bearings than its datasets, or others of their pads."""
        names = namelist.bearing_names(self.input)
        if not names:
            return
        with reading(self.path, "bearings"):
            there = self.inside(self.own("bearings"), "bearings")
        if sorted(there) != sorted(names) or self.length("bearing") != len(names):
            text = f"there are {', '.join(there)}, and {', '.join(names)} in the input"
            raise damaged(self.path, "bearings", text)
        for each in self.bearings.values():
            each.check_whole()

    def needs_one_bearing(self, name: str) -> None:
        """Raises NotInRunError for an attribute that a machine has of each bearing."""
        if self.is_machine:
            raise NotInRunError(self.without(name))

    def names(self, group: str = "") -> list[str]:
        """Names of the datasets and groups in the file or in a group of it, in alphabetical order."""
        return [name for name in super().names(group) if group or name != "bearings"]

    def sound(self, name: str, values: Any) -> Any:
        if np.asarray(values).dtype.kind == "S":
            if self.scales(name) != (name,) and name not in TEXTS:
                raise ValueError("not an array of numbers")
            texts = [plain(each).rstrip() for each in np.ravel(values)]
            return np.array(texts).reshape(np.shape(values))
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
        missing, likely = f"{self.path}: no {shown(name)} in this run", self.likely(name)
        words = f" (did you mean {' or '.join(likely)}?)" if likely else ""
        # what other runs have has its own reason
        of_others = {*SHOWN, *OF_BRANCHES, *TURBULENT, *self.GROUPS}
        known = name.rpartition("/")[2] in of_others or self.is_cold(name)
        if likely and not known:
            return missing + words
        return f"{missing}: {self.why_not(name)}" + words * any(each.endswith(f"/{name}") for each in likely)

    def likely(self, name: str) -> list[str]:
        """What a name that is missing may stand for, in the file or in its groups: equilibrium/journal_y."""
        inside = [(group, own) for group in self.single_and_groups()[1] for own in self.names(group)]
        parts = [f"{group}/{own}" for group, own in inside if name.startswith(f"{group}_")]
        parts = [each for each in parts if each.endswith(name[name.find("_") :])]
        if 0 < len(parts) <= 3:
            return parts
        paths = {own: f"{group}/{own}" for group, own in reversed(inside)}
        paths |= {own: own for own in self.names()}
        return [paths[each] for each in get_close_matches(name.rpartition("/")[2], paths, 1)]

    @property
    def has_film_temperatures(self) -> bool:
        """True where films have temperatures along and across (thermal%model = 'film')."""
        return self.input.get("thermal", {}).get("model") == "film"

    @property
    def is_turbulent(self) -> bool:
        """True where films may be turbulent (film%turbulence)."""
        return self.input["film"].get("turbulence", "none") != "none"

    @property
    def has_slopes(self) -> bool:
        """True where slopes of journal or shaft count in the films, as where pads pitch."""
        asked = self.task == "coefficients" and self.input["coefficients"].get("slopes", False)
        shaft = any(f"{group}journal_slope_y" in self for group in ("", "equilibrium/"))
        inclined = any(self.input["bearing"].get("slope", ())) or shaft
        return bool("pitch" in self.input["pads"]["motion"] or inclined or asked)

    def is_cold(self, name: str) -> bool:
        """True for what a heat balance tells, of a run without one."""
        thermal = self.input.get("thermal", {}).get("model", "none")
        return name.endswith(("_temperature", "viscosity")) and thermal == "none"

    def why_not(self, name: str) -> str:
        """The reason why the run has no such dataset."""
        if self.is_machine:
            return self.bearings.why_not(name)
        friction, motion = self.input["friction"]["model"], self.input["pads"]["motion"]
        start = self.input.get("start", {}).get("from")
        keep = self.input.get("output", {}).get("keep")
        needed, version = TASKS.get(name.partition("/")[0]), f"version {self.format_version} of the format"
        first, final = (self.input["operation"][each] for each in ("speed_rpm", "final_speed_rpm"))
        task, unmarched = f"its task is '{self.task}'", ("equilibrium", "coefficients", "branch")
        kept = f"it kept no samples (output%keep = '{keep}')"
        unended = f"{self.attributes.get('reason', '')}" or "it did not come to its end"
        # the first one that is true
        reasons = (
            (name == "bristle_deflection" and friction != "lugre", f"friction model is '{friction}'"),
            ("pivot_deflection" in name and "radial" not in motion, f"pad motion is '{motion}'"),
            ("pitch" in name and "pitch" not in motion, f"pad motion is '{motion}'"),
            ("yaw" in name and "yaw" not in motion, f"pad motion is '{motion}'"),
            (name.endswith(OF_SLOPES) and not self.has_slopes, "no slopes of the journal count in it"),
            (motion == "fixed" and any(each in name for each in OF_TILTING), "pad motion is 'fixed'"),
            (name.endswith(TURBULENT) and not self.is_turbulent, "film%turbulence is 'none'"),
            (self.is_cold(name), "it has no heat balance (thermal%model = 'none')"),
            (name.startswith("equilibrium") and start, f"it did not start at one (start%from = '{start}')"),
            (needed and needed != self.task, f"{task}, not '{needed}'"),
            (name == "summary", f"{version}, or it ended before its first sample"),
            (name in TASKS, unended),
            (name in OF_BRANCHES and not self.is_branch, task),
            (self.task in unmarched, f"{task}, nothing was marched in time"),
            (not self.samples and self.complete and keep == "summary", kept),
            (not self.samples, "it ended before its first sample"),
            (name == "spectrum" and first != final, "the speed changes"),
            (name == "spectrum", "less than one revolution was sampled, or the run is incomplete"),
            (True, f"there are {', '.join(self.names())}"),
        )
        return next(reason for holds, reason in reasons if holds)


class Bearings(dict[str, "Bearing"]):
    """The bearings of a machine by their names, in the order of its input; empty for any other run."""

    def __init__(self, machine: Run):
        self.machine = machine
        names = namelist.bearing_names(machine.input) if namelist.is_machine(machine.input) else []
        super().__init__({name: Bearing(machine, name) for name in names})

    def __missing__(self, name: str) -> NoReturn:
        why = self.in_words() if self else "it is a run of one bearing"
        named = f"{shown(f'{name}')}{meant(f'{name}', self)}"
        raise NotInRunError(f"{self.machine.path}: no bearing {named}: {why}")

    def whole(self) -> Run:
        """One of them, called as the machine, for what this has as a whole; without films the machine."""
        if not self:
            return self.machine
        own = Bearing(self.machine, next(iter(self)))
        own.attributes["title"] = self.machine.attributes["title"]
        return own

    def in_words(self) -> str:
        """Their names, in words."""
        return f"its bearings are {', '.join(self)}" if self else "none of its bearings has a film"

    def why_not(self, name: str) -> str:
        """The reason why the machine as a whole has no such dataset."""
        there = next((each for each, own in self.items() if name in own or name in OF_EACH), None)
        if there is not None:
            own = f".{name}" if name in OF_EACH else f"[{name!r}]"
            return f"its bearings have it, as run.bearings[{there!r}]{own}; {self.in_words()}"
        if name.startswith(OF_MACHINES):
            known = self.machine.names()
            task = f"its task is '{self.machine.task}'"
            return f"{task}, and there are {', '.join(known)}{meant(name, known)}"
        return next(iter(self.values())).why_not(name) if self else self.in_words()


class Bearing(Run):
    """A bearing of a machine as the run of one bearing: every calculation and picture of a run takes it.

    It has what its group of the file has, and under their own names what the machine has as a whole: time,
    speed, frequencies and damping of modes, Floquet multipliers. Its load is that of the equilibrium.
    """

    def __init__(self, machine: Run, name: str):
        self.machine, self.name, self.group = machine, name, f"bearings/{name}/"
        self.path, self.file, self.size = machine.path, machine.file, machine.size
        self.found, self.listed, self.over, self.former = {}, {}, {}, machine.former
        own = {key.removeprefix(self.group): value for key, value in machine.attributes.items()}
        title = f"{machine.attributes['title']}, bearing {name}".removeprefix(", ")
        with reading(self.path, "attribute 'input'"):
            text = namelist.of_bearing(machine.attributes["input"], name, load_of(machine, name))
        self.attributes = own | {"title": title, "input": text}

    @cached_property
    def input(self) -> dict[str, dict[str, Any]]:
        """The resolved namelist of the bearing: {"bearing": {"journal_radius": 0.0499, ...}, ...}."""
        with reading(self.path, f"attribute 'input' of {self.group}"):
            return namelist.resolved(self.attributes["input"])

    @property
    def label(self) -> str:
        """What it is called beside others of the same machine."""
        return f"bearing {self.name}"

    @property
    def remarks(self) -> list[str]:
        """Those on the bearing."""
        before = f"bearing '{self.name}': "
        every = self.machine.remarks
        return [each.removeprefix(before) for each in every if each.startswith(before)]

    def own_names(self, group: str = "") -> list[str]:
        """Names of what is in its group of the file, or in a group there."""
        if group and group not in self.own_names():
            return []
        where = f"{self.group}{group}".rstrip("/")
        with reading(self.path, where):
            found = super().own(where)
        return self.inside(found, where)

    def names(self, group: str = "") -> list[str]:
        """Names of the datasets and groups of the bearing, and of the machine as a whole, or in a group."""
        if group not in self.listed:
            shared = self.machine.names(group) if group in ("", *self.machine.names()) else []
            found = {name for name in shared if not name.startswith(OF_MACHINES)}
            self.listed[group] = sorted(found.union(self.own_names(group)))
        return self.listed[group]

    def own(self, path: str) -> h5py.Dataset | h5py.Group:
        """The object of this path: that of the bearing, or else that of the machine."""
        group, _, name = path.rpartition("/")
        return super().own(self.group + path if name in self.own_names(group) else path)

    def close(self) -> None:
        """Closes the file of the machine."""
        self.found.clear()
        self.machine.close()


def load_of(machine: Run, name: str) -> list[float]:
    """The load of the rotor on a bearing at the equilibrium (y, z), N; none where there is no equilibrium."""
    place = namelist.bearing_names(machine.input).index(name)
    loads = [f"equilibrium/bearing_load_{axis}" for axis in "yz"]
    return [float(machine[each][place]) if each in machine else 0.0 for each in loads]


def needs_run(given: object) -> None:
    """Raises TypeError where something else was given than an opened result."""
    if isinstance(given, str | os.PathLike):
        opens = f"tiltpad.read({os.fspath(given)!r}) opens it"
        raise TypeError(f"a result is needed, and {given!r} is a file: {opens}")
    if not isinstance(given, Run):
        raise TypeError(f"a result as tiltpad.read opens it is needed, not {type(given).__name__}")


def of_run(function: Callable[..., Any]) -> Callable[..., Any]:
    """Lets a function of a run say what is wrong with anything else."""

    @wraps(function)
    def checked(run: Run, *arguments: Any, **options: Any) -> Any:
        needs_run(run)
        return function(run, *arguments, **options)

    return checked
