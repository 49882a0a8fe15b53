"""Stiffness and damping coefficients of the bearing, of a run or over the runs of a study."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tiltpad.calculate import rotation
from tiltpad.calculate.selection import Where, selected
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study

#: What only some results have: what was asked for; shapes of a bearing's modes, and of a machine's.
SOUGHT = "threshold_rpm"
SOME = (
    *(SOUGHT, "shape_real", "shape_imag", "whirl", "part_of_reduction"),
    *("station_y_real", "station_y_imag", "station_z_real", "station_z_imag"),
)
#: What is used of the groups of a result.
GROUPS = {
    "coefficients": ("stiffness", "damping", "full_stiffness", "full_damping", "full_mass"),
    "modes": ("eigenvalue_real", "eigenvalue_imag", "frequency", "damping_ratio", "log_decrement", *SOME),
}
#: The two positions of the journal come first.
JOURNAL = 2


class Coefficients(NamedTuple):
    """Stiffness and damping of the bearing at the journal, pads condensed; its fields:

        pivot              of which they are: free, stuck or locked
        speed_rpm          shaft speed, (); of a study (run,), rising
        frequency_ratio    whirl frequency over shaft speed, (frequency_ratio,)
        stiffness          N/m, (frequency_ratio, row, column); of a study (run, ...) before these
        damping            N s/m, likewise
        parameters         of a study: values of its parameters by name, (run,) each

    Rows are directions of the force on the journal, columns directions of its motion: y (up), z. The shaft
    turns from +y to +z, or to -z (operation%rotation). Runs of a study that have no equilibrium are nan.
    """

    pivot: str
    speed_rpm: np.ndarray
    frequency_ratio: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    parameters: dict[str, np.ndarray]

    @property
    def frequency(self) -> np.ndarray:
        """Whirl frequency, rad/s, (frequency_ratio,); of a study (run, frequency_ratio)."""
        return np.multiply.outer(np.pi / 30 * np.asarray(self.speed_rpm), self.frequency_ratio)


class Series(NamedTuple):
    """Datasets of some runs, (run, ...) each; a run is one run."""

    pivot: str  # that they are of
    speed_rpm: np.ndarray  # shaft speed, (run,), rising
    values: dict[str, np.ndarray]  # by the names that the datasets have in a study
    parameters: dict[str, np.ndarray]  # of the study, (run,) each


def coefficients(
    source: Run | Study,
    pivot: str | None = None,
    frequency_ratio: Sequence[float] | float | None = None,
    where: Where = None,
) -> Coefficients:
    """Stiffness and damping of a run of the task coefficients, or of a study of such runs.

    `pivot` is one of those in the file, by default the first; `where` keeps the runs of a study with these
    values of parameters. With `frequency_ratio` (whirl frequency over shaft speed, from 0 on) the pads are
    condensed at these frequencies; without it they are the program's own coefficients.
    """
    found = series(source, "coefficients", pivot, where)
    if frequency_ratio is None:
        ratios = source["frequency_ratio"]
        stiffness, damping = found.values["stiffness"], found.values["damping"]
    else:
        ratios = np.atleast_1d(np.asarray(frequency_ratio, dtype=float))
        if not (np.isfinite(ratios) & (ratios >= 0)).all():
            raise ValueError(f"frequency_ratio = {frequency_ratio}: must be numbers from 0 on")
        frequency = np.multiply.outer(np.pi / 30 * found.speed_rpm, ratios)
        stiffness, damping = at_frequencies(found, frequency)
    if isinstance(source, Run):
        return Coefficients(found.pivot, found.speed_rpm[0], ratios, stiffness[0], damping[0], {})
    return Coefficients(found.pivot, found.speed_rpm, ratios, stiffness, damping, found.parameters)


def at_frequencies(found: Series, frequency: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients at whirl frequencies in rad/s, (run, frequency): (run, frequency, row, column)."""
    matrices = (found.values[name] for name in ("full_stiffness", "full_damping", "full_mass"))
    each = [condensed(k, c, m, at) for k, c, m, at in zip(*matrices, frequency, strict=True)]
    stiffness, damping = map(np.stack, zip(*each, strict=True))
    return stiffness, damping


def condensed(
    stiffness: np.ndarray, damping: np.ndarray, mass: np.ndarray, frequency: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and damping at the journal at frequencies in rad/s, (frequency, row, column) each.

    The matrices are those of all positions; those without numbers (a locked tilt) are left out.
    """
    there = np.isfinite(np.diagonal(stiffness))
    if not there[:JOURNAL].all():
        return (np.full((len(frequency), JOURNAL, JOURNAL), np.nan),) * 2
    stiffness, damping, mass = (each[np.ix_(there, there)] for each in (stiffness, damping, mass))
    # where the frequency is 0, damping is the derivative of the imaginary part
    own = np.where(frequency == 0, 1e-6, frequency)[:, None, None]
    dynamic = stiffness + 1j * own * damping - own**2 * mass
    j, p = slice(None, JOURNAL), slice(JOURNAL, None)
    pads = np.linalg.solve(dynamic[:, p, p], dynamic[:, p, j])
    whole = dynamic[:, j, j] - dynamic[:, j, p] @ pads
    return whole.real, whole.imag / own


def series(
    source: Run | Study, group: str, pivot: str | None = None, where: Where = None, over: str | None = None
) -> Series:
    """A group of a run, or of the chosen runs of a study at rising speed or parameter."""
    own, k = chosen_pivot(source, group, pivot)
    if single := isinstance(source, Run):
        if where:
            raise ValueError(f"{source.path}: where: for a study, this is one run")
        speed = np.array([source.input["operation"]["speed_rpm"]], float)
        place, parameters = np.array([0]), {}
    else:
        chosen = np.flatnonzero(selected(source, where or {}) & np.isfinite(source.speed))
        speed = np.round(source.speed * 30 / np.pi, 9)
        place = chosen[np.argsort((source[over] if over else speed)[chosen], kind="stable")]
        speed, parameters = speed[place], {name: source[name][place] for name in source.parameters}
    values = {"sense": rotation.senses(source)[place]}
    for name in GROUPS[group]:
        path = f"{group}/{name}" if single else name
        if name in SOME and path not in source:
            continue
        each = source[path][None] if single else source[path][place]
        values[name] = each[:, k] if "pivot" in (source.scales(path) or ()) else each
    return Series(own, speed, values, parameters)


def chosen_pivot(source: Run | Study, group: str, pivot: str | None) -> tuple[str, int]:
    """Name of the pivots that are chosen, and their place; the first ones by default."""
    if not isinstance(source, Run | Study):
        opens = "as tiltpad.read and tiltpad.read_study open them"
        raise TypeError(f"{source!r}: not a result or study, {opens}")
    if (missing := group if isinstance(source, Run) else GROUPS[group][0]) not in source:
        raise NotInRunError(source.without(missing))
    return place_of_pivot(source, pivot)


def of_pivots(source: Run | Study, pivot: str | None = None) -> str:
    """Of which pivots results are, "pivots free"; empty where there is one kind alone."""
    if "pivot" not in source or source.length("pivot") < 2:
        return ""
    return f"pivots {place_of_pivot(source, pivot)[0]}"


def place_of_pivot(source: Run | Study, pivot: str | None) -> tuple[str, int]:
    """The same of any result that has values for each of the pivots."""
    there = [str(each) for each in source["pivot"]]
    if pivot is None:
        return there[0], 0
    if pivot not in there:
        raise ValueError(f"{source.path}: pivot {pivot}: there are {', '.join(there)}")
    return pivot, there.index(pivot)
