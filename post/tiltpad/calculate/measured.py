"""What was measured in a test, and the same of runs of its model."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tiltpad.calculate.coefficients import coefficients
from tiltpad.calculate.impedance import impedance
from tiltpad.calculate.signals import at_angle, last_revolutions, needs_revolutions
from tiltpad.files.archive import NotInRunError, meant
from tiltpad.files.read import Run

#: The times of series that do not repeat.
TIME = "time"
#: Matrices of the bearing, and the pivots of those that are identified from forced vibrations.
MATRICES, IDENTIFIED = ("stiffness", "damping"), "identified"
#: Values of a static equilibrium begin so.
STATIC = "equilibrium/"


@dataclass(frozen=True, eq=False)
class Measured:
    """What was measured in one test, for `tiltpad.fit`; its fields:

        values         arrays in SI units, by the names that results have; nan where a value is missing
        deviation      standard deviation of their noise, in the same units; a number, or one for each name
        case           groups of the case in which this test differs: {"operation": {"speed_rpm": 4500}}
        pivot          of coefficients: which pivots they are of, as for `tiltpad.coefficients`; "identified":
                       as by a test rig, from orbits under the harmonic excitation of the case along y
                       and along z
        revolutions    of series without times: over how many revolutions of the shaft they reach
        mean           False: of series only what varies about their means counts, as of probes whose zero
                       is not known

    Values are, of one kind or several:

        an orbit             {"journal_y": y, "journal_z": z}, (n,) each, at n even angles of the shaft from a
                             whole revolution on, the end left out; of the last revolutions of a run
        waveforms            {"time": t, "journal_y": y}, at times since the start of a march, (n,); series
                             of pads, as pad_tilt, are (n, pad)
        coefficients         {"stiffness": K, "damping": C}, (2, 2), or (frequency_ratio, 2, 2)
        a static position    {"equilibrium/journal_y": y, "equilibrium/journal_z": z}; a static locus is a
                             test for each of its points

    Errors are independent of one another and normal. Wrong fields are a ValueError.
    """

    values: Mapping[str, Any]
    deviation: float | Mapping[str, float]
    case: Mapping[str, Any] = field(default_factory=dict)
    pivot: str | None = None
    revolutions: int = 1
    mean: bool = True

    def __post_init__(self) -> None:
        if not isinstance(self.values, Mapping) or not all(isinstance(name, str) for name in self.values):
            raise ValueError("values: must be arrays by name, {'journal_y': y}")
        own = {name: numbers(name, each) for name, each in self.values.items()}
        object.__setattr__(self, "values", own)
        for name in self.names:
            if not 0 < (self.deviation_of(name) or np.nan) < np.inf:
                given = f"deviation = {self.deviation!r}"
                raise ValueError(f"{name}: {given}: a standard deviation above 0 is needed, in its unit")
        time = own.get(TIME, np.zeros(1))
        if time.ndim != 1 or not time.size or not np.isfinite(time).all() or not (np.diff(time) > 0).all():
            raise ValueError("time: must rise, numbers in a list")
        if not isinstance(self.revolutions, int | np.integer) or self.revolutions < 1:
            raise ValueError(f"revolutions = {self.revolutions!r}: must be a whole number above 0")
        if not isinstance(self.case, Mapping):
            raise ValueError(f"case = {self.case!r}: must be groups, {{'operation': {{'speed_rpm': 4500}}}}")

    @property
    def names(self) -> list[str]:
        """Names of what was measured."""
        return [name for name in self.values if name != TIME]

    @property
    def task(self) -> str | None:
        """The task that its values need; None for that of the case."""
        kinds = {name in MATRICES or (name.startswith(STATIC) and STATIC) for name in self.names}
        if not kinds or not kinds <= {True, STATIC}:
            return None
        if self.is_identified:
            return "periodic"
        return "coefficients" if True in kinds else "equilibrium"

    @property
    def is_identified(self) -> bool:
        """Whether its coefficients come from forced vibrations."""
        return self.pivot == IDENTIFIED and any(name in MATRICES for name in self.names)

    def deviation_of(self, name: str) -> float | None:
        """Standard deviation of the values of this name."""
        given: Any = self.deviation
        given = given.get(name) if isinstance(given, Mapping) else given
        try:
            return float(given)
        except (TypeError, ValueError):
            return None

    @property
    def size(self) -> int:
        """Number of values."""
        return sum(self.values[name].size for name in self.names)

    def compared(self, values: Mapping[str, Any]) -> np.ndarray:
        """Values by name as one array, over their standard deviations."""
        parts = [np.ravel(self.centred(values[name])) / self.deviation_of(name) for name in self.names]
        return np.concatenate([*parts, []])

    def centred(self, values: np.ndarray) -> np.ndarray:
        """Values of a series without their mean, where this does not count."""
        return values if self.mean or not values.ndim else values - np.nanmean(values, axis=0)

    def of(self, runs: Sequence[Run]) -> dict[str, np.ndarray]:
        """The same of its model, by name, from a run, or from two with excitations along y and along z.

        Raises ValueError where the measured values have another shape.
        """
        found = {}
        if any(name in MATRICES for name in self.names):
            matrices = impedance(runs) if self.is_identified else coefficients(runs[0], self.pivot)
        for name, there in self.values.items():
            if name in MATRICES:
                own = getattr(matrices, name)
                found[name] = own[0] if len(own) == 1 and there.ndim == 2 else own
            elif name != TIME:
                found[name] = self.series(runs[0], name)
            if name in found and found[name].shape != there.shape:
                raise ValueError(f"{name}: measured {there.shape}, the model has {found[name].shape}")
        return found

    def series(self, run: Run, name: str) -> np.ndarray:
        """A series of a run at the measured times or angles; of any other dataset its values."""
        known = (*run.names(), *(f"{STATIC}{each}" for each in run.names("equilibrium")))
        if name not in run or name in run.GROUPS:
            raise NotInRunError(f"{name}: no result of this case{meant(name, known)}")
        if not run.is_series(name):
            return np.asarray(run[name])
        if TIME in self.values:
            times, wanted = run.time, self.values[TIME]
            if wanted[0] < times[0] or wanted[-1] > times[-1]:
                raise ValueError(f"time: measured up to {wanted[-1]:g} s, the run ends at {times[-1]:g} s")
            return at_angle(times, run[name], wanted)
        if not self.values[name].ndim:
            raise ValueError(f"{name}: one number was measured, and a series is needed")
        needs_revolutions(run, name, self.revolutions)
        part = last_revolutions(run, self.revolutions + 1)
        angle = run.values("shaft_angle", part)
        end = np.floor(angle[-1] / (2 * np.pi) + 1e-9)
        turns = end - self.revolutions * (1 - np.arange(count := len(self.values[name])) / count)
        return at_angle(angle, run.values(name, part), 2 * np.pi * turns)


def numbers(name: str, values: Any) -> np.ndarray:
    """The values of this name as an array; ValueError where they are none."""
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: must be a number, or an array of numbers") from None
