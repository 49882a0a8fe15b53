"""Where pads and journal are in a bearing, and the film between them.

Lengths are in m, angles in rad, counted from +z towards +y; a shaft that turns clockwise turns towards
smaller angles. A `case` is the resolved input: groups of variables, as run.input.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate import library
from tiltpad.calculate.rotation import sense
from tiltpad.files import namelist
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run

Case = Mapping[str, Mapping[str, Any]]


class State(NamedTuple):
    """Journal (y, z) and its slopes, and what pads do, (pad,) each, at a time, s (None: at rest)."""

    time: float | None
    journal: np.ndarray
    tilt: np.ndarray
    pivot_deflection: np.ndarray
    pitch: np.ndarray
    yaw: np.ndarray
    slope: np.ndarray


class Surfaces(NamedTuple):
    """The surfaces of the pads."""

    angle: np.ndarray  # of points on the surface, from the centre of the bearing, (pad, phi)
    thickness: np.ndarray  # film thickness there in the middle plane, (pad, phi)
    slope: np.ndarray  # of the thickness along the shaft, (pad, phi)
    pivot: np.ndarray  # angles of the pivots, (pad,)


def of_pads(case: Case, name: str) -> np.ndarray:
    """A variable with a value for each pad, as "pads%arc_deg" or "bearing%axial_length", (pad,)."""
    return np.array(namelist.of_pads(case, name), dtype=float)


def centred(case: Case) -> State:
    """The journal in the middle of the bearing, pads without tilt and pivot deflection."""
    none = np.zeros(len(of_pads(case, "pads%pivot_angle_deg")))
    return State(None, np.zeros(2), none, none, none, none, library.given_slope(case))


def at_rest(run: Run) -> State:
    """The equilibrium of a run, or its last sample where it has none."""
    try:
        return at_time(run, None)
    except NotInRunError:
        return at_time(run, float(run.values("time", -1))) if run.samples else centred(run.in_operation)


def at_time(run: Run, time: float | None) -> State:
    """The sample next to `time`, s; None: the equilibrium."""
    at, journal, pads = library.state(run, time)
    tilt, pivot_deflection, pitch, yaw = (each[0] for each in pads)
    return State(at, journal[:2], tilt, pivot_deflection, pitch, yaw, library.journal_slope(run, at))


def samples(run: Run, part: slice) -> list[State]:
    """The states of the samples `part`."""
    times = run.values("time", part)
    none = np.zeros((len(times), run.pads))
    own = (run.values(name, part) if name in run else none for name in library.OF_PADS)
    journal = np.column_stack([run.values(name, part) for name in ("journal_y", "journal_z")])
    slopes = library.journal_slopes(run, part)
    return [State(*each) for each in zip(times.tolist(), journal, *own, slopes, strict=True)]


def film_thickness(
    run: Run, time: float | None = None, along: int | np.ndarray = 121, across: int | np.ndarray = 41
) -> np.ndarray:
    """Film thickness of every pad where `tiltpad.pressure` has the pressure, (pad, phi, z), m.

    It follows from the state at the sample next to `time`, s (None: at the equilibrium), with the slopes of
    journal and pads; `along` and `across` are as for `tiltpad.pressure`.
    """
    case = run.in_operation
    found = surfaces(case, at_time(run, time), along)
    x = np.outer(half_widths(case), library.shares(across, -1, "half the width"))
    return found.thickness[:, :, None] + found.slope[:, :, None] * x[:, None, :]


def surfaces(case: Case, state: State, points: int | np.ndarray = 91) -> Surfaces:
    """The surfaces of the pads from the trailing to the leading edge, and the film on them.

    `points` is their number along the arc, or the points themselves as shares of the arc.
    """
    radius, pivot = case["bearing"]["journal_radius"], np.radians(of_pads(case, "pads%pivot_angle_deg"))
    arc, ratio = np.radians(of_pads(case, "pads%arc_deg")), of_pads(case, "pads%pivot_ratio")
    assembled, machined = (of_pads(case, f"bearing%{name}_clearance") for name in ("assembled", "machined"))
    back = of_pads(case, "pads%pivot_distance")
    turning = sense(case)
    phi = np.outer(arc, library.shares(points, 0, "the arc")) - ((1 - ratio) * arc)[:, None]
    # the journal from the pivot, in the pad's own directions (docs/theory/film.md), or in a mirror
    own, reach = pivot - turning * state.tilt, radius + assembled + back + state.pivot_deflection
    y = state.journal[0] - reach * np.sin(pivot)
    z = state.journal[1] - reach * np.cos(pivot)
    along = turning * (y * np.cos(own) - z * np.sin(own))
    outward = y * np.sin(own) + z * np.cos(own) + radius + machined + back
    # a pad turns about a pivot that may stand off the middle plane (docs/theory/pitch_and_yaw.md)
    offset = of_pads(case, "pads%pivot_axial_offset") if "pitch" in case["pads"]["motion"] else 0.0
    along, outward = along + offset * state.yaw, outward + offset * state.pitch
    slopes = np.array(seen_by_pads(case, state)) - [state.yaw, state.pitch]
    thickness = machined[:, None] - along[:, None] * np.sin(phi) - outward[:, None] * np.cos(phi)
    slope = -slopes[0][:, None] * np.sin(phi) - slopes[1][:, None] * np.cos(phi)
    return Surfaces(own[:, None] + turning * phi, thickness, slope, pivot)


def seen_by_pads(case: Case, state: State) -> tuple[np.ndarray, np.ndarray]:
    """Slopes of the journal along each pad and outward, (pad,)."""
    own = np.radians(of_pads(case, "pads%pivot_angle_deg")) - sense(case) * state.tilt
    y, z = state.slope
    return sense(case) * (y * np.cos(own) - z * np.sin(own)), y * np.sin(own) + z * np.cos(own)


def half_widths(case: Case) -> np.ndarray:
    """Half the width of each pad: where its ends are, (pad,)."""
    return of_pads(case, "bearing%axial_length") / 2
