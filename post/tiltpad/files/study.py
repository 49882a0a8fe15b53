"""Studies: the file that tiltpad-collect writes, results of many runs over their parameters."""

import csv
import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tiltpad.files.archive import Archive, RunError, damaged, plain, reading
from tiltpad.files.read import COEFFICIENTS, MODES, WARM, Run, StudyError, read

#: Dimensions of the arrays.
MEMBER, PADS, PIVOTS = ("member",), ("member", "pad"), ("member", "pivot")
#: All dimensions but the members, with their meaning.
DIMENSIONS = {
    "pad": "number of the pad",
    "revolution": "revolutions before the last Poincare point",
    "pivot": "pivots in small vibrations",
    "frequency_ratio": "whirl frequency over shaft speed",
    "row": "direction of the force on the journal",
    "column": "direction of the journal's motion",
    "position_row": "position that the force belongs to",
    "position_column": "position that moves",
    "mode": "number of the mode",
}
#: Maximum number of revolutions of which Poincare points are kept.
REVOLUTIONS = 50


class Quantity(NamedTuple):
    """A result of every member in a study: dimensions, unit, meaning.

    Where unit and meaning are empty, they are those in the members' files.
    """

    dimensions: tuple[str, ...]
    units: str
    long_name: str


#: Results of a member, beside its cost. Motion, film and friction are those of the last revolution.
QUANTITIES = {
    "status": Quantity(MEMBER, "1", "exit status: 0 done, nan if the file cannot be read"),
    "complete": Quantity(MEMBER, "1", "1 where the run reached its end"),
    "time_reached": Quantity(MEMBER, "s", "time reached"),
    "resumes": Quantity(MEMBER, "1", "times that the run was resumed"),
    "speed": Quantity(MEMBER, "rad/s", "shaft speed at the end"),
    "orbit_y": Quantity(MEMBER, "m", "orbit in y, peak to peak"),
    "orbit_z": Quantity(MEMBER, "m", "orbit in z, peak to peak"),
    "orbit_size": Quantity(MEMBER, "m", "orbit, the larger of both peak to peak"),
    "mean_y": Quantity(MEMBER, "m", "mean of journal y"),
    "mean_z": Quantity(MEMBER, "m", "mean of journal z"),
    "journal_y_amplitude": Quantity(MEMBER, "m", "amplitude of journal y, first harmonic"),
    "journal_z_amplitude": Quantity(MEMBER, "m", "amplitude of journal z, first harmonic"),
    "journal_y_phase": Quantity(MEMBER, "rad", "angle by which it comes after the unbalance"),
    "journal_z_phase": Quantity(MEMBER, "rad", "angle by which it comes after the unbalance"),
    "min_film_thickness": Quantity(MEMBER, "m", "minimum film thickness"),
    "max_pressure": Quantity(MEMBER, "Pa", "maximum pressure"),
    "friction_work": Quantity(MEMBER, "J", "friction work a revolution, all pads"),
    "stick_fraction": Quantity(MEMBER, "1", "share of time that pivots stick, mean of the pads"),
    "pad_tilt_size": Quantity(PADS, "rad", "tilt, peak to peak"),
    "pad_min_film_thickness": Quantity(PADS, "m", "minimum film thickness of the pad"),
    "pad_max_pressure": Quantity(PADS, "Pa", "maximum pressure of the pad"),
    "pad_friction_work": Quantity(PADS, "J", "friction work a revolution"),
    "pad_stick_fraction": Quantity(PADS, "1", "share of time that the pivot sticks"),
    "equilibrium_y": Quantity(MEMBER, "m", "journal y at the equilibrium"),
    "equilibrium_z": Quantity(MEMBER, "m", "journal z at the equilibrium"),
    "equilibrium_min_film_thickness": Quantity(MEMBER, "m", "minimum film thickness at the equilibrium"),
    "equilibrium_max_pressure": Quantity(MEMBER, "Pa", "maximum pressure at the equilibrium"),
    "sommerfeld_number": Quantity(MEMBER, "1", "Sommerfeld number"),
    "specific_load": Quantity(MEMBER, "Pa", "specific load"),
    "equilibrium_eccentricity_ratio": Quantity(MEMBER, "1", "eccentricity ratio at the equilibrium"),
    "equilibrium_attitude_angle": Quantity(MEMBER, "rad", "attitude angle at the equilibrium"),
    "equilibrium_power_loss": Quantity(MEMBER, "W", "power loss of all pads at the equilibrium"),
    "equilibrium_inlet_flow": Quantity(MEMBER, "m^3/s", "flow in at all leading edges at the equilibrium"),
    "equilibrium_side_flow": Quantity(MEMBER, "m^3/s", "flow out at all sides at the equilibrium"),
    "equilibrium_temperature_rise_fresh": Quantity(
        MEMBER, "K", "warming of the oil if every pad draws fresh oil alone"
    ),
    "equilibrium_temperature_rise_side": Quantity(
        MEMBER, "K", "warming of the oil if fresh oil replaces only what leaves at the sides"
    ),
    "pad_equilibrium_load": Quantity(PADS, "N", "force of film and asperities at the equilibrium"),
    "pad_equilibrium_power_loss": Quantity(PADS, "W", "power loss at the equilibrium"),
    "pad_equilibrium_inlet_flow": Quantity(PADS, "m^3/s", "flow in at the leading edge at the equilibrium"),
    "pad_equilibrium_side_flow": Quantity(PADS, "m^3/s", "flow out at both sides at the equilibrium"),
    "pad_equilibrium_inlet_temperature": Quantity(PADS, "degC", "temperature at the leading edge"),
    "pad_equilibrium_mean_temperature": Quantity(PADS, "degC", "mean temperature of the film"),
    "pad_equilibrium_outlet_temperature": Quantity(PADS, "degC", "temperature at the trailing edge"),
    "pad_equilibrium_maximum_temperature": Quantity(PADS, "degC", "maximum temperature of the pad"),
    "pad_equilibrium_viscosity": Quantity(PADS, "Pa s", "viscosity of the film"),
    "equilibrium_maximum_temperature": Quantity(MEMBER, "degC", "maximum temperature of all pads"),
    "equilibrium_shaft_temperature": Quantity(MEMBER, "degC", "temperature of the shaft"),
    "equilibrium_drain_temperature": Quantity(MEMBER, "degC", "temperature of the oil that leaves"),
    "poincare_y": Quantity(("member", "revolution"), "m", "journal y once a revolution"),
    "poincare_z": Quantity(("member", "revolution"), "m", "journal z once a revolution"),
    "poincare_tilt": Quantity(("member", "revolution", "pad"), "rad", "tilt once a revolution"),
    "lowest_y": Quantity(("member", "revolution"), "m", "lowest journal y in a revolution"),
    "lowest_z": Quantity(("member", "revolution"), "m", "lowest journal z in a revolution"),
    "lowest_tilt": Quantity(("member", "revolution", "pad"), "rad", "lowest tilt in a revolution"),
    "highest_y": Quantity(("member", "revolution"), "m", "highest journal y in a revolution"),
    "highest_z": Quantity(("member", "revolution"), "m", "highest journal z in a revolution"),
    "highest_tilt": Quantity(("member", "revolution", "pad"), "rad", "highest tilt in a revolution"),
    **{name: Quantity(("member", *each), "", "") for name, each in (COEFFICIENTS | MODES).items()},
    "least_damping_ratio": Quantity(PIVOTS, "1", "least damping ratio of all modes"),
}
#: Those that a run has in its group `equilibrium`, by their names there; files of earlier programs lack them.
FIGURES = {
    **{name: name for name in ("sommerfeld_number", "specific_load")},
    **{
        f"equilibrium_{name}": name
        for name in (
            *("eccentricity_ratio", "attitude_angle"),
            *("temperature_rise_fresh", "temperature_rise_side"),
        )
    },
    **{f"equilibrium_{name}": f"total_{name}" for name in ("power_loss", "inlet_flow", "side_flow")},
    **{f"{'pad_' if each else ''}equilibrium_{name}": name for name, each in WARM.items()},
    **{f"pad_equilibrium_{name}": name for name in ("load", "power_loss", "inlet_flow", "side_flow")},
}
#: States that Poincare points are kept of.
POINTS = {"poincare_y": "journal_y", "poincare_z": "journal_z", "poincare_tilt": "pad_tilt"}


class Failure(NamedTuple):
    """A member that was not done: its number, its values of the parameters, how and why it ended."""

    member: int
    values: dict[str, Any]
    how: str
    reason: str

    def __str__(self) -> str:
        own = ", ".join(
            f"{k} = {v if isinstance(v, str) else format(v, 'g')}" for k, v in self.values.items()
        )
        why = f": {self.reason}" if self.reason else ""
        return f"member {self.member}{f' ({own})' if own else ''} {self.how}{why}"


#: How a member ended, by its status.
ENDS = {2: "failed in its numerics", 3: "failed at a file", 4: "was stopped", -1: "has not ended"}


def read_study(path: str | os.PathLike) -> "Study":
    """Opens a study, the file that tiltpad-collect writes. Raises RunError."""
    return Study(path)


def read_either(path: str | os.PathLike) -> "Run | Study":
    """Opens the result of a run or a study, whichever it is. Raises RunError."""
    try:
        return read(path)
    except StudyError:
        return read_study(path)


class Study(Archive):
    """One study, open for reading; a dataset is loaded when it is used.

    Everything in the file has its name here:

        study.orbit_y, study["orbit_y"]      a result, (member,), in SI units; nan of a member that failed
        study.speed_rpm                      a parameter, (member,), as in the input
        study.poincare_y                     Poincare points, (member, revolution)
        study.parameters                     names of the parameters
        study.title, study.created, ...      attributes of the file; study.attributes has all of them
        study.file["members/0003/journal_y"] a dataset of a member's own file, as h5py gives it
    """

    KINDS = "fiuO"

    def __repr__(self) -> str:
        members, over = self.length("member"), ", ".join(self.parameters)
        return f"<tiltpad study {self.path!r}: {members} members over {over}>"

    def to_xarray(self) -> Any:
        """The datasets as an xarray.Dataset in memory, over the members; needs xarray and h5netcdf."""
        import xarray

        with reading(self.path, "it"):
            return xarray.load_dataset(self.path, engine="h5netcdf")

    def to_csv(self, path: str | os.PathLike) -> None:
        """Writes parameters and results of one number, a row for each member."""
        others = {*MEMBER, *DIMENSIONS, *self.parameters, *self.GROUPS}
        single = [name for name in self.names() if name not in others and self.item(name).ndim == 1]
        names = ["member", *self.parameters, *single]
        with open(path, "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow(names)
            rows.writerows(zip(*(self[name] for name in names), strict=True))

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, the slowest one first."""
        return self.attributes["parameters"].split()

    @property
    def done(self) -> np.ndarray:
        """True for the members that were done, (member,)."""
        return self.status == 0

    def failures(self) -> list[Failure]:
        """The members that were not done, with their recorded reasons."""
        reasons = self.reason if "reason" in self else np.full(len(self.done), "", dtype=object)
        return [
            Failure(
                int(self.member[k]),
                {name: self[name][k] for name in self.parameters},
                ENDS.get(self.status[k], "cannot be read"),
                reasons[k],
            )
            for k in np.flatnonzero(~self.done)
        ]

    def check_whole(self) -> None:
        """Refuses the result of one run, and a study without its parameters."""
        if self.attributes["task"] != "study":
            raise RunError(f"{self.path}: the result of one run, not a study: see tiltpad-collect")
        if not isinstance(self.attributes.get("parameters"), str):
            raise damaged(self.path, "attribute 'parameters'", "it is missing")
        for name in ("member", "status", *self.parameters):
            if name not in self:
                raise damaged(self.path, name, "it is missing")

    def scales(self, name: str) -> Sequence[str] | None:
        if name in MEMBER or name in DIMENSIONS:
            return (name,)
        if name in QUANTITIES:
            return QUANTITIES[name].dimensions
        return MEMBER if name in self.parameters or name in ("file", "reason") else None

    def sound(self, name: str, values: Any) -> Any:
        if np.asarray(values).dtype.kind != "O":
            return values
        texts = [plain(each) for each in np.atleast_1d(values)]
        if not all(isinstance(each, str) for each in texts):
            raise ValueError("not an array of texts")
        return np.array(texts, dtype=object).reshape(np.shape(values))
