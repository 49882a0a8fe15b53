"""What is calculated from a run: functions that take a run and return arrays, all in SI units."""

import numpy as np

from tiltpad.read import NotInRunError, Run


def last_revolutions(run: Run, count: float = 1) -> slice:
    """Samples of the last `count` shaft revolutions, both ends included; all where there are fewer.

    At constant speed and n samples a revolution these are count * n + 1 samples.
    """
    angle = run.shaft_angle
    if len(angle) < 2:
        raise NotInRunError(f"{run.path}: no revolution in this run: it has {len(angle)} samples")
    # half a sample more, so that rounding loses none
    step = (angle[-1] - angle[-2]) / 2
    return slice(int(np.searchsorted(angle, angle[-1] - 2 * np.pi * count - step)), len(angle))


def revolutions(run: Run, part: slice = slice(None)) -> np.ndarray:
    """Shaft revolutions since the start of the run, (time,)."""
    return run.values("shaft_angle", part) / (2 * np.pi)


def steady(run: Run) -> bool:
    """True where the speed stays the same."""
    operation = run.input["operation"]
    return operation["speed_rpm"] == operation["final_speed_rpm"]


def orbit(run: Run, last: float = 1) -> tuple[np.ndarray, np.ndarray]:
    """Journal centre y (up) and z over the last revolutions, each (time,), m."""
    part = last_revolutions(run, last)
    return run.values("journal_y", part), run.values("journal_z", part)


def waveform(run: Run, name: str, last: float = 5) -> tuple[np.ndarray, np.ndarray]:
    """Time (time,), s, and a dataset, (time,) or (time, pad), over the last revolutions."""
    part = last_revolutions(run, last)
    return run.values("time", part), run.values(name, part)


def spectrum(run: Run, name: str = "journal_y") -> tuple[np.ndarray, np.ndarray]:
    """Frequency (k,), Hz, and one-sided amplitude of journal_y, journal_z (k,), m, or pad_tilt (pad, k), rad.

    At frequency 0 stands the magnitude of the mean.
    """
    return run["spectrum/frequency"], run["spectrum/" + name]


def full_spectrum(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Frequency (k,), Hz, and amplitude (k,), m, of y + i z: forward whirl at positive frequencies."""
    return run["spectrum/full_frequency"], run["spectrum/journal_full"]


def hysteresis(run: Run, pad: int = 1, last: float = 1) -> tuple[np.ndarray, np.ndarray]:
    """Tilt, rad, and friction moment, N m, of a pad (1, 2, ...) over the last revolutions, each (time,)."""
    if run.input["friction"]["model"] == "none":
        raise NotInRunError(f"{run.path}: no hysteresis in this run: friction model is 'none'")
    column = pad_column(run, pad)
    part = last_revolutions(run, last)
    return run.values("pad_tilt", part)[:, column], run.values("friction_moment", part)[:, column]


def pad_column(run: Run, pad: int) -> int:
    """Column of a pad (1, 2, ...) in (time, pad) arrays."""
    if not 1 <= pad <= run.pads:
        raise NotInRunError(f"{run.path}: no pad {pad} in this run: pads are 1 to {run.pads}")
    return pad - 1


def loop_area(x: np.ndarray, y: np.ndarray) -> float:
    """Area of the closed loop through the points, positive when it runs clockwise.

    Of friction moment over tilt: the work lost in the loop, J.
    """
    return float(0.5 * np.sum((np.roll(x, -1) - x) * (np.roll(y, -1) + y)))


def envelope(run: Run, name: str, spans: int = 800) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time (k,), s, and least and greatest value of a dataset, (k,) or (k, pad), in each of k spans.

    The spans turn the shaft by equal angles of at least one revolution, so that the band is that of the
    vibration; there are at most `spans` of them.
    """
    turns, values, time = revolutions(run), run[name], run.time
    count = max(1, min(spans, int(turns[-1] - turns[0])))
    edges = np.searchsorted(turns, np.linspace(turns[0], turns[-1], count + 1)[:-1])
    last = np.append(edges[1:], len(turns)) - 1
    low, high = (pick.reduceat(values, edges, axis=0) for pick in (np.minimum, np.maximum))
    return (time[edges] + time[last]) / 2, low, high
