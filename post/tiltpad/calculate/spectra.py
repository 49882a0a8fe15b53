"""Amplitudes over frequency and over order.

Everything is in SI units; `last` is a number of shaft revolutions at the end of the run, `pad` is 1, 2, ...
"""

from collections.abc import Iterator, Sequence

import numpy as np

from tiltpad.calculate import signals
from tiltpad.calculate.rotation import sense
from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Run

#: As in the program: the spectrum of a march over this number of revolutions, or more, is under a Hann
#: window, whose amplitudes are restored; others are not, as that of a periodic orbit, whose period it covers.
FEWEST = 8
#: Tops are drawn that are as far off a line, over the distance of two.
OFF = 0.01


def spectrum(run: Run, name: str = "journal_y") -> tuple[np.ndarray, np.ndarray]:
    """Frequency (k,), Hz, and one-sided amplitude of journal_y, journal_z (k,), m, or pad_tilt (pad, k), rad.

    The spectrum is that in the file. The value at frequency 0 is the magnitude of the mean.
    """
    return run["spectrum/frequency"], run["spectrum/" + name]


def full_spectrum(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Frequency (k,), Hz, and amplitude (k,), m, of y + i z: forward whirl at positive frequencies.

    The spectrum is that in the file.
    """
    return run["spectrum/full_frequency"], run["spectrum/journal_full"]


def one_sided(
    run: Run, name: str = "journal_y", last: float = 10, pad: int | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Frequency (k,), Hz, and one-sided amplitude of any dataset over the last revolutions.

    The speed must be constant. Amplitudes, in the unit of the dataset, are (k,), or (pad, k) for a dataset of
    all pads without `pad`. The value at frequency 0 is the magnitude of the mean.
    """
    part, interval, weights = sampled_evenly(run, last)
    values = np.ascontiguousarray(signals.series(run, name, part, pad).T)
    count, mean = values.shape[-1], values.mean(axis=-1, keepdims=True)
    amplitude = 2 / count * np.abs(np.fft.rfft((values - mean) * weights))
    amplitude[..., 0] = np.abs(mean[..., 0])
    if count % 2 == 0:
        amplitude[..., -1] /= 2
    return np.fft.rfftfreq(count, interval), amplitude


def full(run: Run, last: float = 10) -> tuple[np.ndarray, np.ndarray]:
    """Frequency (k,), Hz, rising, and amplitude (k,), m, of y + i z over the last revolutions.

    The speed must be constant. Forward whirl is at positive frequencies, backward whirl at negative ones: of
    shafts that turn anticlockwise it is y - i z.
    """
    part, interval, weights = sampled_evenly(run, last)
    turning = 1j * sense(run.input)
    values = run.values("journal_y", part) + turning * run.values("journal_z", part)
    amplitude = np.abs(np.fft.fft((values - values.mean()) * weights)) / len(values)
    amplitude[0] = np.abs(values.mean())
    return np.fft.fftshift(np.fft.fftfreq(len(values), interval)), np.fft.fftshift(amplitude)


def is_windowed(run: Run, last: float | None = None) -> bool:
    """Whether the spectrum of the last revolutions, or that in the file, is under a window."""
    if last is None:
        return "spectrum/window" in run and bool(run["spectrum/window"])
    return run.task == "march" and signals.turned(run, signals.last_revolutions(run, last)) > FEWEST - 0.5


def restored(amplitude: np.ndarray, line: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places, in lines, and amplitudes of sines under a Hann window, by their highest lines, (k,)."""
    below, own, above = (amplitude[line + k] for k in (-1, 0, 1))
    ratio = np.maximum(below, above) / own
    beside = np.maximum(0, (2 * ratio - 1) / (ratio + 1))
    return line + np.where(above >= below, beside, -beside), own * (1 - beside**2) / np.sinc(beside)


def highest_lines(amplitude: np.ndarray) -> np.ndarray:
    """The lines that are higher than those beside them, (k,)."""
    inner = amplitude[1:-1]
    return 1 + np.flatnonzero((inner > amplitude[:-2]) & (inner >= amplitude[2:]))


def with_tops(frequency: np.ndarray, amplitude: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A spectrum under a Hann window with the tops between its lines."""
    line = highest_lines(amplitude)
    place, height = restored(amplitude, line)
    off = np.abs(place - line) > OFF
    at = np.interp(place[off], np.arange(len(frequency)), frequency)
    order = np.argsort(np.concatenate([frequency, at]))
    return np.concatenate([frequency, at])[order], np.concatenate([amplitude, height[off]])[order]


def sampled_evenly(run: Run, last: float) -> tuple[slice, float, np.ndarray]:
    """Samples of the last revolutions but the one that begins the next, their interval, s, and weights."""
    if not signals.steady(run):
        raise not_in_run(run, "spectrum", "the speed changes; see waterfall")
    signals.needs_revolutions(run, "spectrum")
    part = signals.last_revolutions(run, last)
    time, count = signals.ends(run, "time", part), part.stop - part.start - 1
    weights = np.ones(count)
    if is_windowed(run, last):
        weights -= np.cos(2 * np.pi * np.arange(count) / count)
    return slice(part.start, part.stop - 1), float(np.ptp(time)) / count, weights


def waterfall(
    run: Run,
    name: str = "journal_y",
    pad: int | None = None,
    orders: float = 5,
    revolutions: int = 8,
    spans: int = 200,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Speed (n,), rad/s, order (k,), and amplitudes (n, k) of a run whose speed changes.

    Short spectra over the shaft angle, of `revolutions` revolutions each, up to `orders` times the speed and
    at most `spans` of them along the run; amplitudes in the unit of the dataset. Order 0 is the
    mean. A dataset of all pads needs `pad`. The windows are Hann windows, read one at a time.
    """
    needs_pad(run, name, pad)
    found = windows(run, name, pad, revolutions, spans, "waterfall")
    most = int(orders * revolutions) + 1
    speed, amplitudes = zip(*((at, 2 * np.abs(np.fft.rfft(own))[:most]) for at, _, own in found), strict=True)
    shortest = min(map(len, amplitudes))
    table = np.array([each[:shortest] for each in amplitudes])
    table[:, 0] /= 2
    return np.array(speed), np.arange(shortest) / revolutions, table


def order_track(
    run: Run,
    name: str = "journal_y",
    order: float = 1,
    pad: int | None = None,
    revolutions: int = 8,
    spans: int = 400,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Speed (n,), rad/s, amplitude (n,) and phase (n,), rad, of one order of a run whose speed changes.

    Amplitudes have the unit of the dataset. The signal is amplitude * cos(order * shaft angle + phase), the
    phase between -pi and pi. The windows are those of waterfall.
    """
    speed, amplitude, phase = order_tracks(run, name, (order,), pad, revolutions, spans)
    return speed, amplitude[:, 0], phase[:, 0]


def order_tracks(
    run: Run,
    name: str,
    orders: Sequence[float],
    pad: int | None = None,
    revolutions: int = 8,
    spans: int = 400,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Speed (n,), and amplitude and phase (n, order) of several orders, whose windows are read once."""
    needs_pad(run, name, pad)
    turning = -1j * np.asarray(orders)[:, None]
    found = windows(run, name, pad, revolutions, spans, "order track")
    whole = [(speed, 2 * np.sum(own * np.exp(turning * angle), axis=1)) for speed, angle, own in found]
    speed, amplitude = (np.array(each) for each in zip(*whole, strict=True))
    return speed, np.abs(amplitude), np.angle(amplitude)


def windows(
    run: Run, name: str, pad: int | None, revolutions: int, spans: int, what: str
) -> Iterator[tuple[float, np.ndarray, np.ndarray]]:
    """Windows along a run whose speed changes: speed in the middle, shaft angles, values times weights.

    The values are at equal steps of the shaft angle over whole revolutions; the weights (Hann) sum to 1. The
    slope of the values over a window is left out, as a slow drift would spread over the lowest orders. It is
    fitted with the weights, and so takes nothing from whole orders.
    """
    if signals.steady(run):
        raise not_in_run(run, what, "its speed stays the same, a run-up is needed")
    signals.needs_revolutions(run, what, revolutions)
    first, final = signals.ends(run, "shaft_angle")
    length = 2 * np.pi * revolutions
    count = max(1, min(spans, int((final - first) / length * 2)))
    starts = np.linspace(first, final - length, count)
    parts = zip(signals.edges(run, starts) - 2, signals.edges(run, starts + length) + 2, strict=True)
    for start, part in zip(starts, (slice(max(0, i), j) for i, j in parts), strict=True):
        angle = run.values("shaft_angle", part)
        steps = len(angle) - 4
        even = start + length * np.arange(steps) / steps
        weight = np.sin(np.pi * np.arange(steps) / steps) ** 2
        weight /= weight.sum()
        values = signals.at_angle(angle, signals.series(run, name, part, pad), even)
        away = even - start - length / 2
        values = values - away * (weight @ (away * values)) / (weight @ away**2)
        speed = signals.at_angle(angle, run.values("speed", part), np.array([start + length / 2]))[0]
        yield speed, even, weight * values


def needs_pad(run: Run, name: str, pad: int | None) -> None:
    """Raises ValueError for a dataset of all pads without a pad, and for another dataset with one."""
    if (run.dimensions(name) == 2) != (pad is not None):
        raise ValueError(f"{name}: {'pad must be given' if pad is None else 'has no pads'}")
