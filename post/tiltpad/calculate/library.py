"""Calculations by the solver's own library: film pressure, contact, friction; all in SI units.

The Fortran library of the program is compiled into this package. Without this part the functions raise
MissingLibraryError, and the rest of the package works.

`case` is a run, of which the resolved input counts, or the text of a namelist ("&pivot law='hertz' /"). The
text is read and checked as by the program; a variable that it leaves out has its default. Where the library
refuses the input, LibraryError has the message of the program.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate import signals
from tiltpad.files import namelist
from tiltpad.files.archive import not_in_run, reading
from tiltpad.files.read import Run

try:
    from tiltpad._library import tiltpad_library as compiled
except ImportError as failure:
    compiled, missing = None, str(failure)

#: The paper's bearing: every variable has its default.
PAPER = "&case /"


#: Position and velocity of the journal.
JOURNAL = ("journal_y", "journal_z", "journal_vy", "journal_vz")
#: Slopes of an elastic shaft in the bearing.
SLOPES = ("journal_slope_y", "journal_slope_z")
#: What pads do, as the library takes it.
OF_PADS = ("pad_tilt", "pivot_deflection", "pad_pitch", "pad_yaw")


class MissingLibraryError(ImportError):
    """The package has no compiled part, or its compiled part does not work on this machine or Python."""


class LibraryError(RuntimeError):
    """The library refused its input (status 1) or its numerics failed (status 2); the message says why."""

    def __init__(self, message: str, status: int):
        super().__init__(message)
        self.status = status


class Pressure(NamedTuple):
    """Film pressure of all pads at one instant.

    Its fields:

        time                  s; None for the equilibrium
        pressure              (pad, phi, z), Pa
        phi                   angle from the pivot, (pad, phi), rad, from the trailing to the leading edge
        z                     axial position from the middle plane, (pad, z), m
        force                 on the journal along y' and z' of each pad, (pad, 2), N
        max_pressure          maximum pressure at the solver's own points, (pad,), Pa
        min_film_thickness    (pad,), m
    """

    time: float | None
    pressure: np.ndarray
    phi: np.ndarray
    z: np.ndarray
    force: np.ndarray
    max_pressure: np.ndarray
    min_film_thickness: np.ndarray


class Losses(NamedTuple):
    """Loads, power losses and oil flows of the pads over time.

    Its fields; all but the first are (time, pad):

        time                      s, (time,)
        load                      force of film and asperities on the journal, N
        power                     heat made, W: the sum of the three below
        couette, pressure         by shear of sliding, and of the flow that pressure drives, W
        boundary                  by friction of touching asperities, W
        journal_drag              moment of the film's shear on the journal, against its rotation, N m
        pad_drag                  the same on the pad, about the centre of its arc, N m
        inlet_flow, outlet_flow   in at the leading edge, out at the trailing edge, m^3/s
        side_flow                 out at both sides, m^3/s
    """

    time: np.ndarray
    load: np.ndarray
    power: np.ndarray
    couette: np.ndarray
    pressure: np.ndarray
    boundary: np.ndarray
    journal_drag: np.ndarray
    pad_drag: np.ndarray
    inlet_flow: np.ndarray
    outlet_flow: np.ndarray
    side_flow: np.ndarray


class Contact(NamedTuple):
    """Contact of ball and socket, arrays of the shape of the pivot deflections.

    Its fields:

        force, slope              normal force, N, and its derivative by the pivot deflection, N/m
        radius                    projected radius of the contact, m
        exponent, peak_pressure   of the contact pressure, eq (11), 1 and Pa
    """

    force: np.ndarray
    slope: np.ndarray
    radius: np.ndarray
    exponent: np.ndarray
    peak_pressure: np.ndarray


def pressure(
    run: Run, time: float | None = None, along: int | np.ndarray = 121, across: int | np.ndarray = 41
) -> Pressure:
    """Film pressure and force of every pad at the sample next to `time`, s; None: at the equilibrium.

    `along` and `across` are numbers of points, evenly spread from edge to edge, or the points themselves: as
    shares of the arc, 0 at the trailing edge to 1 at the leading edge, and of half the width, -1 to 1.
    Raises NotInRunError for a time that the run does not reach, LibraryError where a film is closed.
    """
    at, journal, pads = state(run, time)
    points = shares(along, 0, "the arc"), shares(across, -1, "half the width")
    when = 0.0 if at is None else at
    known = (*oil(run, at), when, journal, np.stack(pads, axis=1))
    phi, z, field, force, max_pressure, min_film_thickness = called(
        "film_pressure", run, *known, *points, slope=journal_slope(run, at)
    )
    return Pressure(at, field.T, phi.T, z.T, force.T, max_pressure, min_film_thickness)


def losses(run: Run, last: float | None = None) -> Losses:
    """Load, power loss and oil flow of every pad over the last revolutions, from the archived states.

    The film of each sample is solved anew, whatever solver the run had: some microseconds for a pad with a
    full film, a millisecond where it cavitates. A sample whose film is closed has no numbers. An elastic
    shaft has its mean slopes. Raises NotInRunError for a run that was not marched.
    """
    part = signals.last_revolutions(run, last)
    time = run.values("time", part)
    journal = [run.values(name, part) for name in JOURNAL]
    still = np.zeros((len(time), run.pads))

    def motion(name: str) -> np.ndarray:
        values = [run.values(each, part) if each in run else still for each in (name, f"{name}_rate")]
        # the library counts samples last
        return np.moveaxis(np.array(values), 1, -1)

    states = np.stack([motion(name) for name in OF_PADS], axis=1)
    known, slope = oil(run, time.mean()), journal_slopes(run, part).mean(axis=0)
    (found,) = called("power_losses", run, *known, time, np.array(journal), states, slope=slope)
    load, couette, pressure, boundary, *others = np.moveaxis(found, -1, 1)
    return Losses(time, load, couette + pressure + boundary, couette, pressure, boundary, *others)


def oil(run: Run, time: float | None) -> tuple[np.ndarray, np.ndarray]:
    """The oil of each pad at a time, s (None: equilibrium): its viscosity, Pa s, (pad,), 0: the input's; the
    coefficients of what it is along the arc where it is uneven, (5, 3, pad).
    """
    even = np.zeros((5, 3, run.pads))
    if time is not None and "oil/viscosity" in run:
        return np.exp([np.interp(time, run["oil/time"], pad) for pad in np.log(run["oil/viscosity"].T)]), even
    # of a branch `viscosity` is that of its points
    names = ("equilibrium/viscosity",) if run.is_branch else ("viscosity", "equilibrium/viscosity")
    warm = next((name for name in names if name in run), None)
    if warm is None:
        return np.zeros(run.pads), even
    group = warm.removesuffix("viscosity")
    if f"{group}flow_weights" not in run:
        return run[warm], even
    along = [run[f"{group}{each}_weights"] for each in ("flow", "sliding", "shear")]
    return run[warm], np.array(along).transpose(2, 0, 1)


def state(run: Run, time: float | None) -> tuple[float | None, np.ndarray, tuple[np.ndarray, ...]]:
    """Time of the nearest sample, journal (4,), and tilt, deflection, pitch and yaw with rates (2, pad)."""
    if time is None:
        rest = run["equilibrium"]
        still = np.zeros(run.pads)
        own = [rest.get(name, still) for name in OF_PADS]
        with reading(run.path, "equilibrium"):
            journal = np.array([rest["journal_y"], rest["journal_z"], 0, 0], float)
        return None, journal, tuple(np.array([each, still]) for each in own)
    start, end = signals.ends(run, "time")
    step = run.values("time", slice(0, 2))[-1] - start
    if not start - step <= time <= end + step:
        raise not_in_run(run, f"time {time:g} s", f"sampled from {start:g} to {end:g} s")
    after = run.first("time", time)
    near = range(max(0, after - 1), min(after + 1, run.samples))
    k = min(near, key=lambda i: abs(run.values("time", i) - time))

    def sample(*names: str) -> np.ndarray:
        with reading(run.path, " and ".join(names)):
            return np.array([run.values(name, k) for name in names])

    def pads(name: str) -> np.ndarray:
        return sample(name, f"{name}_rate") if name in run else np.zeros((2, run.pads))

    return float(run.values("time", k)), sample(*JOURNAL), tuple(pads(name) for name in OF_PADS)


def given_slope(groups: Mapping[str, Any]) -> np.ndarray:
    """The slopes dy/dx and dz/dx that the input gives the journal, (2,)."""
    return np.array(groups["bearing"].get("slope", (0.0, 0.0)), float)


def journal_slope(run: Run, time: float | None) -> np.ndarray:
    """Slopes of the journal that count in films, (2,), at the time of a sample, s (None: equilibrium)."""
    if time is not None:
        at = run.first("time", time)
        return journal_slopes(run, slice(at, at + 1))[0]
    return given_slope(run.input) + [run["equilibrium"].get(name, 0.0) for name in SLOPES]


def journal_slopes(run: Run, part: slice) -> np.ndarray:
    """The same of the samples `part`, (time, 2)."""
    still = np.zeros(len(run.values("time", part)))
    shaft = [run.values(name, part) if name in run else still for name in SLOPES]
    return given_slope(run.input) + np.column_stack(shaft)


def shares(points: int | np.ndarray, first: float, of: str) -> np.ndarray:
    """Shares `of` something as they are given, or a number of them, evenly spaced from `first` to 1."""
    if isinstance(points, int | np.integer):
        return np.linspace(first, 1, points)
    given = np.atleast_1d(np.asarray(points, dtype=float))
    if not np.all((given >= first) & (given <= 1)):
        raise ValueError(f"shares of {of} must be between {first:g} and 1")
    return given


def contact(pivot_deflection: float | np.ndarray, case: Run | str = PAPER, pad: int = 1) -> Contact:
    """Contact of a pad's pivot at pivot deflections, m; it is zero where these are not positive."""
    return Contact(*elementwise("contact", case, pad, pivot_deflection))


def pivot_load(pivot_deflection: float | np.ndarray, case: Run | str = PAPER, pad: int = 1) -> np.ndarray:
    """Normal force, N, of a pad's pivot at pivot deflections, m."""
    return contact(pivot_deflection, case, pad).force


def contact_pressure(
    pivot_deflection: float | np.ndarray, r: float | np.ndarray, case: Run | str = PAPER, pad: int = 1
) -> np.ndarray:
    """Contact pressure (11), Pa, at pivot deflections, m, and distances r from the contact's axis, m.

    The two broadcast. r is projected along the axis, as the radius of the contact is; beyond it the pressure
    is zero.
    """
    return elementwise("contact_pressure", case, pad, pivot_deflection, r)[0]


def friction_force(
    velocity: float | np.ndarray,
    normal_force: float | np.ndarray,
    deflection: float | np.ndarray = 0.0,
    case: Run | str = PAPER,
    pad: int = 1,
) -> np.ndarray:
    """Friction force, N, at sliding velocities, m/s, normal forces, N, and bristle deflections, m (LuGre).

    The arguments broadcast. Times the ball's radius it is the moment on the pad, eq (20).
    """
    return elementwise("friction_force", case, pad, velocity, deflection, normal_force)[0]


def bristle_rate(
    velocity: float | np.ndarray, deflection: float | np.ndarray, case: Run | str = PAPER, pad: int = 1
) -> np.ndarray:
    """Rate of the bristle deflection, m/s, eq (24); zero if the friction has no bristles."""
    return elementwise("friction_force", case, pad, velocity, deflection, 0.0)[1]


def elementwise(name: str, case: Run | str, pad: int, *arguments: float | np.ndarray) -> list[np.ndarray]:
    """The results of a routine that takes a pad and arrays of one length, in the arguments' common shape."""
    arrays = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in arguments))
    if not arrays[0].size:
        raise ValueError(f"{name}: empty arrays")
    results = called(name, case, pad, *(each.ravel() for each in arrays))
    return [each.reshape(arrays[0].shape) for each in results]


def called(name: str, case: Run | str, *arguments: Any, slope: np.ndarray | None = None) -> list[Any]:
    """The results of a routine of the library for a case; an error of the library is raised.

    With `slope` the journal has these slopes instead of those of the case.
    """
    text, source = (case.operating_text, case.path) if isinstance(case, Run) else (case, "case")
    if slope is not None:
        text = namelist.with_values(text, {"slope": slope})
    if compiled is None:
        built = "`make python` builds it, and `make wheel` packs it"
        raise MissingLibraryError(f"the compiled part of the package tiltpad is missing ({missing}): {built}")
    *results, status, message = getattr(compiled, name)(text.encode(), source.encode(), *arguments)
    if status:
        raise LibraryError(message.decode(errors="replace").strip(), int(status))
    return results
