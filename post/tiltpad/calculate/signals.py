"""Parts of a run, and quantities of its motion.

Everything is in SI units; `last` is a number of shaft revolutions at the end of the run, `pad` is 1, 2, ...
"""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from tiltpad.files.archive import damaged, not_in_run
from tiltpad.files.read import Run

#: Samples that are read at once where a whole run is read.
BLOCK = 1 << 16
#: Revolutions in which a motion of about half the order shows its whole extent.
COVER = 3
#: States of the motion that the case has.
STATES = (
    *("journal_y", "journal_z", "journal_vy", "journal_vz", "pad_tilt", "pad_tilt_rate"),
    *("pivot_deflection", "pivot_deflection_rate", "bristle_deflection"),
)


def last_revolutions(run: Run, count: float | None = None) -> slice:
    """Samples of the last `count` shaft revolutions, both ends included; all where there are fewer.

    Without `count` they are those of the last revolution, and of a periodic orbit those of its period.
    At constant speed and n samples a revolution these are count * n + 1 samples. They are searched for
    in the file; the shaft angle is not loaded.
    """
    if count is None:
        count = run.input["periodic"]["revolutions"] if run.task == "periodic" else 1
    if not count > 0:
        raise ValueError(f"last = {count:g}: must be a number of revolutions above 0")
    if run.samples < 2:
        reason = "it has one sample" if run.samples else run.why_not("time")
        raise not_in_run(run, "revolution", reason)
    before, end = run.values("shaft_angle", slice(-2, None))
    # half a sample more, so that rounding loses none
    start = run.first("shaft_angle", end - 2 * np.pi * count - (end - before) / 2)
    return slice(start, run.samples)


def revolutions(run: Run, part: slice = slice(None)) -> np.ndarray:
    """Shaft revolutions since the start of the run, (time,)."""
    return run.values("shaft_angle", part) / (2 * np.pi)


def ends(run: Run, name: str, part: slice = slice(None)) -> np.ndarray:
    """First and last value of a dataset, or of the samples `part` of it: (2,) or (2, pad)."""
    start, stop, _ = part.indices(run.samples)
    if start >= stop:
        raise not_in_run(run, name, run.why_not(name))
    return np.stack([run.values(name, i) for i in (start, stop - 1)])


def lasted(run: Run, part: slice = slice(None)) -> float:
    """Time from the first to the last of the samples `part`, s; it is positive."""
    start, end = ends(run, "time", part)
    if not end > start:
        raise damaged(run.path, "time", "it does not rise")
    return float(end - start)


def turned(run: Run, part: slice = slice(None)) -> float:
    """Shaft revolutions from the first to the last of the samples `part`."""
    return float(np.ptp(ends(run, "shaft_angle", part))) / (2 * np.pi)


def needs_revolutions(run: Run, what: str, count: float = 1) -> None:
    """Raises NotInRunError where the run has fewer than `count` revolutions, less a sample."""
    last_revolutions(run)
    if (there := turned(run)) < count * (1 - 1e-9):
        raise not_in_run(run, what, f"it has {there:.3g} shaft revolutions, and {count:g} are needed")


def steady(run: Run) -> bool:
    """True where the speed stays the same."""
    operation = run.input["operation"]
    return operation["speed_rpm"] == operation["final_speed_rpm"]


def pad_column(run: Run, pad: int) -> int:
    """Column of a pad (1, 2, ...) in (time, pad) arrays."""
    if not 1 <= pad <= run.pads:
        raise not_in_run(run, f"pad {pad}", f"pads are 1 to {run.pads}")
    return pad - 1


def series(run: Run, name: str, part: slice = slice(None), pad: int | None = None) -> np.ndarray:
    """The samples `part` of a dataset, (time,) or (time, pad); of one pad, (time,), where `pad` is given.

    Of a dataset of the stations of a machine, `pad` is the station.
    """
    if pad is None:
        return run.values(name, part)
    return run.values(name, part)[:, pad - 1 if name.startswith("station") else pad_column(run, pad)]


def orbit(run: Run, last: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Journal centre y (up) and z over the last revolutions, each (time,), m."""
    part = last_revolutions(run, last)
    return run.values("journal_y", part), run.values("journal_z", part)


def orbit_size(run: Run, last: float | None = None) -> tuple[float, float]:
    """Peak-to-peak of the journal's y and z over the last revolutions, m."""
    y, z = orbit(run, last)
    return float(np.ptp(y)), float(np.ptp(z))


def waveform(run: Run, name: str, last: float | None = 5) -> tuple[np.ndarray, np.ndarray]:
    """Time (time,), s, and a dataset, (time,) or (time, pad), over the last revolutions."""
    part = last_revolutions(run, last)
    return run.values("time", part), run.values(name, part)


def at_angle(angle: np.ndarray, values: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Values, (time,) or (time, pad), where the rising `angle` (time,) has the `wanted` values (n,).

    Interpolates by the cubic through the four nearest samples.
    """
    count = min(4, len(angle))
    first = np.clip(np.searchsorted(angle, wanted) - count // 2, 0, len(angle) - count)
    nodes = [first + k for k in range(count)]
    result = np.zeros((len(wanted), *values.shape[1:]))
    for k in nodes:
        weight = np.ones(len(wanted))
        for other in nodes:
            if other is not k:
                weight *= (wanted - angle[other]) / (angle[k] - angle[other])
        result += (weight * values[k].T).T
    return result


def poincare(
    run: Run, last: float = 50, phase: float = 0.0, states: Sequence[str] | None = None
) -> dict[str, np.ndarray]:
    """States once a revolution, where the shaft has turned by whole revolutions and `phase`, rad.

    A dictionary of arrays, (n,) or (n, pad), in SI units: "revolution" (whole revolutions since the start),
    "time" and of `states` (None: all, journal_y to bristle_deflection) those the case has. A periodic
    motion is one point, one that repeats after k revolutions is k points.
    """
    needs_revolutions(run, "Poincare section")
    part = last_revolutions(run, last)
    angle = run.values("shaft_angle", part)
    turns = (angle[[0, -1]] - phase) / (2 * np.pi)
    # a point at an end counts in spite of rounding; where both ends have one, the last points are taken
    final = np.floor(turns[1] + 1e-9)
    first = max(np.ceil(turns[0] - 1e-9), final + 1 - max(1, int(min(last, len(angle)))))
    whole = np.arange(first, final + 1)
    wanted = 2 * np.pi * whole + phase
    names = ["time", *(name for name in states or STATES if name in run)]
    return {"revolution": whole} | {name: at_angle(angle, run.values(name, part), wanted) for name in names}


def is_torus(run: Run) -> bool:
    """Whether a motion is quasi-periodic: its points once a revolution fill a ring."""
    return "summary/quasi_periodic" in run and bool(run["summary/quasi_periodic"] > 0)


def extremes(run: Run, name: str, last: float = 50) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest value of a dataset in each of the last revolutions, (n,) or (n, pad) each."""
    needs_revolutions(run, "whole revolution")
    part = last_revolutions(run, last)
    angle = run.values("shaft_angle", part)
    count = int((angle[-1] - angle[0]) / (2 * np.pi) + 1e-9)
    starts = np.searchsorted(angle, angle[-1] - 2 * np.pi * np.arange(count, 0, -1) - 1e-9)
    values = run.values(name, part)
    return np.minimum.reduceat(values, starts, axis=0), np.maximum.reduceat(values, starts, axis=0)


def edges(run: Run, angles: np.ndarray) -> np.ndarray:
    """For each shaft angle (n,), rad, the first sample at or beyond it, (n,); the file is read in blocks."""
    blocks = (slice(start, start + BLOCK) for start in range(0, run.samples, BLOCK))
    found = [np.searchsorted(run.values("shaft_angle", block), angles) for block in blocks]
    return np.sum(found, axis=0)


def envelope(
    run: Run, name: str, spans: int = 800, cover: float = COVER
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time (k,), s, and minimum and maximum of a dataset, (k,) or (k, pad), in each of k spans.

    The spans turn the shaft by equal angles of at least one revolution, so that the band is that of the
    vibration; there are at most `spans` of them. Of spans that are shorter than `cover` revolutions the
    extremes are those of their neighbours, too: a motion of half the order would make a sawtooth. The run is
    read in blocks of spans.
    """
    found = []
    for block in blocks_of(spans_of(run, spans)):
        whole = slice(block[0].start, block[-1].stop)
        starts = [span.start - whole.start for span in block]
        times, values = run.values("time", whole), run.values(name, whole)
        middles = (times[starts] + times[[span.stop - 1 - whole.start for span in block]]) / 2
        found.append((middles, *(least.reduceat(values, starts) for least in (np.minimum, np.maximum))))
    time, low, high = (np.concatenate(each) for each in zip(*found, strict=True))
    beside = round(cover / (turned(run) / len(time))) // 2
    around = [slice(max(0, k - beside), k + beside + 1) for k in range(len(time))]
    lowest, highest = (
        [low[near].min(axis=0) for near in around],
        [high[near].max(axis=0) for near in around],
    )
    return time, np.array(lowest), np.array(highest)


def swing(run: Run, name: str, spans: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """Speed (k,), rad/s, and peak to peak of a dataset, (k,) or (k, pad), in each of k spans of a run-up.

    The drift of the mean is not in it: of every sample the mean over a revolution around it is taken off.
    The spans turn the shaft by equal angles of COVER revolutions or more, or by one in a short run.
    """
    needs_revolutions(run, "orbit over the speed", 2)
    first, final = ends(run, "shaft_angle")
    count = max(1, min(spans, int((final - first) / (2 * np.pi * COVER)), int(turned(run)) - 1))
    borders = np.linspace(first + np.pi, final - np.pi, max(count, 2) + 1)
    outer = edges(run, borders - np.pi) - 1, edges(run, borders + np.pi) + 1
    found = []
    for low, high, start, end in zip(outer[0][:-1], outer[1][1:], borders[:-1], borders[1:], strict=True):
        part = slice(max(0, low), high)
        angle, values = run.values("shaft_angle", part), run.values(name, part)
        moving = values - revolution_mean(angle, values)
        inside = moving[(angle >= start) & (angle <= end)]
        speed = np.interp((start + end) / 2, angle, run.values("speed", part))
        found.append((speed, np.ptp(inside, axis=0)))
    speed, size = (np.array(each) for each in zip(*found, strict=True))
    return speed, size


def revolution_mean(angle: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The mean of values, (time,) or (time, pad), over a revolution of the shaft around every sample.

    Nearer than half a revolution to an end it is that of the first or last whole revolution.
    """
    area = np.zeros_like(values)
    area[1:] = np.cumsum((np.diff(angle) * (values[1:] + values[:-1]).T / 2).T, axis=0)
    middle = np.clip(angle, angle[0] + np.pi, max(angle[0] + np.pi, angle[-1] - np.pi))
    before, after = (at_angle(angle, area, np.clip(middle + d, *angle[[0, -1]])) for d in (-np.pi, np.pi))
    return (after - before) / (2 * np.pi)


def spans_of(run: Run, spans: int) -> Iterator[slice]:
    """Samples of at most this number of spans, which turn the shaft by equal angles of at least a revolution.

    A span without samples is left out.
    """
    last_revolutions(run)
    first, final = ends(run, "shaft_angle")
    count = max(1, min(spans, int((final - first) / (2 * np.pi) + 1e-9)))
    starts = edges(run, np.linspace(first, final, count + 1)[:-1])
    borders = zip(starts, [*starts[1:], run.samples], strict=True)
    return (slice(start, end) for start, end in borders if start < end)


def blocks_of(spans: Iterable[slice]) -> Iterator[list[slice]]:
    """Spans that follow one another, as many together as have BLOCK samples, or a longer one alone."""
    block: list[slice] = []
    for span in spans:
        if block and span.stop - block[0].start > BLOCK:
            yield block
            block = []
        block.append(span)
    yield block


def multipliers(run: Run) -> np.ndarray:
    """Floquet multipliers of a periodic orbit, complex, (multiplier,), that of largest modulus first."""
    return run["periodic/multiplier_real"] + 1j * run["periodic/multiplier_imag"]
