"""The response to unbalance over the speed: first harmonic, critical speeds, amplification.

It is that of the journal, or of a station of a machine's shaft. A critical speed, its amplification factor
and the separation that it needs are those of API RP 684 (2nd edition, 2005) and API 617 (7th edition, 2002,
2.6.2).
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate.branches import needs_one_parameter
from tiltpad.calculate.coefficients import place_of_pivot
from tiltpad.calculate.rotation import senses
from tiltpad.calculate.selection import SPEED, Where, axis_of, selected, varying
from tiltpad.calculate.signals import at_angle, steady
from tiltpad.calculate.spectra import order_track
from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Bearing, Run, needs_run
from tiltpad.files.study import Study

#: Directions of the journal, in the order of the columns.
DIRECTIONS = ("y", "z")
#: Amplitude at half the power.
HALF_POWER = np.sqrt(0.5)
#: Points between two of a curve at which it is looked at.
BETWEEN = 20
#: The scale of a machine's stations.
STATION = "station"
#: Below this amplification factor a critical speed is damped so well that it needs no separation.
DAMPED = 2.5
#: Fewer points of a curve in a peak leave its height and its width open: it is higher, and sharper.
FEWEST = 3


class Peak(NamedTuple):
    """A peak of the response over the speed; its fields:

        direction        y or z
        speed_rpm        critical speed
        amplitude        there, m
        below_rpm        speeds below and above it at which the amplitude is 0.707 of that; nan where the
        above_rpm        curve ends before
        points           of the curve between these two; None where it is not known

    A peak is `open` that has fewer than three points: the curve has too few for its height and its width, so
    that amplitude and amplification factor may be far larger; a study of closer speeds finds them.
    `margin_below` and `margin_above` are the least distances of the critical speed that API 617 asks for, in
    percent of the lowest operating speed where the critical speed is below the operating speeds, and of the
    highest where it is above them.
    """

    direction: str
    speed_rpm: float
    amplitude: float
    below_rpm: float
    above_rpm: float
    points: int | None = None

    @property
    def open(self) -> bool:
        """Whether the curve has too few points for the height and the width of the peak."""
        return self.points is not None and self.points < FEWEST

    @property
    def amplification_factor(self) -> float:
        """Critical speed over the width of the peak at half power; nan where the curve ends before."""
        return self.speed_rpm / (self.above_rpm - self.below_rpm)

    @property
    def margin_below(self) -> float:
        return float(np.minimum(self.excess, 16))

    @property
    def margin_above(self) -> float:
        return float(np.minimum(self.excess + 10, 26)) if self.excess != 0 else 0.0

    @property
    def excess(self) -> float:
        """What the margins have in common, 17 (1 - 1/(AF - 1.5)) percent; 0 where none is asked for."""
        factor = self.amplification_factor
        return 0.0 if factor < DAMPED else 17 * (1 - 1 / (factor - 1.5))


class Response(NamedTuple):
    """First harmonic of the journal, or of a station, along a curve; its fields:

        parameter    name of what changes: speed_rpm
        values       of it, (n,), in the unit of the input
        amplitude    m, (n, 2): of y and z
        phase        rad, (n, 2), by which it comes after the unbalance: it is
                     amplitude * cos(shaft angle - phase); without jumps of 2 pi, z next to y + pi/2
        peaks        critical speeds, those of y first; none over another parameter than the speed
        station      of a machine's shaft, from 1; None for the journal of one bearing

    Runs of a study that have no motion are nan.
    """

    parameter: str
    values: np.ndarray
    amplitude: np.ndarray
    phase: np.ndarray
    peaks: list[Peak]
    station: int | None = None


def response(
    source: Run | Study,
    where: Where = None,
    over: str | None = None,
    station: int | None = None,
    pivot: str | None = None,
) -> Response:
    """Response of a study over the speed, of a run-up, or of a branch of periodic orbits.

    The runs of a study are marches, or periodic orbits; `where` keeps those with these values of
    parameters, `over` is a parameter in place of the speed. Of a machine it is that of a station of the shaft
    (1, 2, ..., by default the one that moves most), and the runs of its study may be of the task
    coefficients, too: their response is the linear one, with pivots as `pivot` says (by default the first).
    Peaks are looked for on a cubic through the points; one from which the curve climbs higher before it falls
    to half power is part of another.
    """
    if not isinstance(source, Study):
        needs_run(source)
        if where or over:
            raise ValueError(f"{source.path}: where, over: for a study, this is one run")
        if pivot is not None:
            raise ValueError(f"{source.path}: pivot: for the study of a machine")
    of = STATION if STATION in source and not isinstance(source, Bearing) else "journal"
    if of != STATION and (station is not None or pivot is not None):
        raise ValueError(f"{source.path}: station, pivot: for a machine")
    if isinstance(source, Run) and not source.is_branch:
        parameter, values, amplitude, phase = of_runup(source, of)
    else:
        parameter, values, place = curve(source, of, where or {}, over)
        amplitude, phase = harmonics(source, of, place, pivot)
    if of == STATION:
        station = station or busiest(amplitude)
        if not 1 <= station <= amplitude.shape[1]:
            raise ValueError(f"{source.path}: station {station}: must be 1 to {amplitude.shape[1]}")
    amplitude, phase = (each[:, (station or 1) - 1] for each in (amplitude, phase))
    there = np.isfinite(amplitude).all(axis=1)
    phase[there] = aligned(phase[there], int(senses(source)[0]))
    peaks = []
    if parameter == SPEED and there.sum() > 2:
        way = values[there]
        if isinstance(source, Run) and source.is_branch:
            # it may turn back: only its length rises all along
            way = source["arc_length"][source["branch"] == 1]
        for direction, each in zip(DIRECTIONS, amplitude[there].T, strict=True):
            peaks += peaks_of(direction, way, values[there], each)
    return Response(parameter, values, amplitude, phase, peaks, station)


def curve(
    source: Run | Study, of: str, where: Mapping[str, Any], over: str | None
) -> tuple[str, np.ndarray, np.ndarray]:
    """Parameter, its values along a curve, and the runs or points on it.

    Those are runs of a study in the rising order of the parameter, or the first branch of periodic orbits.
    """
    if isinstance(source, Study):
        chosen = selected(source, where)
        over = axis_of(source, over, chosen)
        if others := [name for name in varying(source, chosen) if name != over]:
            raise ValueError(f"{source.path}: runs differ in {', '.join(others)}, too: choose by where")
        place = np.flatnonzero(chosen)
        place = place[np.argsort(source[over][place], kind="stable")]
        return over, source[over][place], place
    needs_one_parameter(source)
    if f"{of}_y_phase" not in source:
        whose = "limit cycles" if f"{of}_y_amplitude" in source else "equilibria"
        raise not_in_run(source, "response", f"its branch is one of {whose}")
    first = source["branch"] == 1
    return f"{source.attributes['branch_parameter']}".rpartition("%")[2], source["parameter"][first], first


def harmonics(
    source: Run | Study, of: str, place: np.ndarray, pivot: str | None
) -> tuple[np.ndarray, np.ndarray]:
    """Amplitudes and phases of the journal or of the stations there, (n, station, direction) each."""
    if of == STATION and "response_y_real" in source:
        k = place_of_pivot(source, pivot)[1]
        parts = ([source[f"response_{each}_{part}"] for each in DIRECTIONS] for part in ("real", "imag"))
        real, imaginary = (np.stack(part, axis=-1)[place, k] for part in parts)
        whirl = real + 1j * imaginary
        return np.abs(whirl), -np.angle(whirl)
    if pivot is not None:
        raise ValueError(f"{source.path}: pivot: for a study of the task coefficients")
    amplitude, phase = (
        np.stack([source[f"{of}_{each}_{what}"][place] for each in DIRECTIONS], axis=-1)
        for what in ("amplitude", "phase")
    )
    return amplitude.reshape(len(amplitude), -1, 2), phase.reshape(len(phase), -1, 2)


def of_runup(run: Run, of: str) -> tuple[str, np.ndarray, np.ndarray, np.ndarray]:
    """Parameter, speeds, amplitudes and phases along a run-up or run-down, as those of `harmonics`."""
    if steady(run):
        needed = "a study over the speed, a run-up or a branch is needed"
        raise not_in_run(run, "response", f"its speed stays the same; {needed}")
    pads = range(1, run.length(STATION) + 1) if of == STATION else [None]
    tracks = [[order_track(run, f"{of}_{each}", pad=k) for k in pads] for each in DIRECTIONS]
    speed, amplitude, phase = np.array(tracks).T.transpose(1, 0, 2, 3)
    order = np.argsort(speed[:, 0, 0], kind="stable")
    return SPEED, speed[order, 0, 0] * 30 / np.pi, amplitude[order], -phase[order]


def busiest(amplitude: np.ndarray) -> int:
    """The station that moves most, from 1; amplitudes are (run, station, direction)."""
    largest = np.nanmax(amplitude, axis=(0, 2)) if np.isfinite(amplitude).any() else np.zeros(1)
    return int(np.argmax(largest)) + 1


def aligned(phase: np.ndarray, sense: int = 1) -> np.ndarray:
    """Phases of y and z, (n, 2), without jumps: z next to where a forward whirl has it, y + pi/2.

    Of a shaft that turns anticlockwise, sense -1, that is y - pi/2.
    """
    whole = np.unwrap(phase, axis=0)
    for k in range(min(1, len(whole)) * whole.shape[1]):
        near = np.pi / 2 if k == 0 else whole[0, 0] + sense * np.pi / 2
        whole[:, k] -= 2 * np.pi * np.round((whole[0, k] - near) / (2 * np.pi))
    return whole


def peaks_of(direction: str, way: np.ndarray, speed: np.ndarray, amplitude: np.ndarray) -> list[Peak]:
    """The peaks of a curve, (n,) each; `way` rises along it."""
    steps, own = np.arange(BETWEEN * (len(way) - 1) + 1) / BETWEEN, speed
    dense = np.interp(steps, np.arange(len(way)), way)
    speed, amplitude = (at_angle(way, each, dense) for each in (speed, amplitude))
    found = []
    tops = np.flatnonzero((amplitude[1:-1] > amplitude[:-2]) & (amplitude[1:-1] >= amplitude[2:])) + 1
    for top in tops:
        sides = (slice(top, None, -1), slice(top, None))
        edges = [half_power(speed[side], amplitude[side]) for side in sides]
        known = [each for each in edges if each is not None]
        if len(known) == len(edges):
            below, above = sorted(map(float, known))
            # of an end that the curve does not reach nothing is known
            inside = int(((own > below) & (own < above)).sum()) if np.isfinite(below + above) else None
            at, most = vertex(speed, amplitude, top), float(amplitude[top])
            found.append(Peak(direction, at, most, below, above, inside))
    return found


def vertex(speed: np.ndarray, amplitude: np.ndarray, top: np.signedinteger | int) -> float:
    """Speed at the top of the parabola through the highest point of a dense curve and those next to it."""
    below, own, above = amplitude[top - 1 : top + 2]
    shift = 0.5 * (below - above) / (below - 2 * own + above)
    return float(speed[top] + shift * (speed[top + 1] - speed[top - 1]) / 2)


def half_power(speed: np.ndarray, amplitude: np.ndarray) -> float | None:
    """Speed at which the amplitude has fallen from its first value to half power.

    nan where the curve ends before, None where it climbs above its first value before.
    """
    limit = HALF_POWER * amplitude[0]
    crossed = (amplitude > amplitude[0], amplitude < limit)
    higher, lower = (np.append(np.flatnonzero(each), len(amplitude))[0] for each in crossed)
    if higher < lower:
        return None
    if lower == len(amplitude):
        return np.nan
    share = (amplitude[lower - 1] - limit) / (amplitude[lower - 1] - amplitude[lower])
    return float(speed[lower - 1] + share * (speed[lower] - speed[lower - 1]))
