"""Pictures of one run on one pair of axes.

Every function takes the axes to draw on, or makes a figure in the package's own style, and returns the
axes. Further keywords go to the line, so that runs can be laid over each other.
"""

from collections.abc import Callable
from functools import wraps
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, FancyArrowPatch

from tiltpad import pivots, signals, spectra
from tiltpad.read import Run
from tiltpad.units import SHOWN

#: Name of the package's own style, for matplotlib.style.use and .context.
STYLE = "tiltpad.tiltpad"
#: A history of more revolutions is drawn as a band.
BAND_FROM = 60


def on_axes(draw: Callable[..., Axes]) -> Callable[..., Axes]:
    """Lets `draw` be called without axes: it then gets new ones in the package's style."""

    @wraps(draw)
    def drawn(run: Run, ax: Axes | None = None, *arguments: Any, **options: Any) -> Axes:
        if ax is not None:
            return draw(run, ax, *arguments, **options)
        with plt.style.context(STYLE):
            return draw(run, plt.subplots()[1], *arguments, **options)

    return drawn


@on_axes
def orbit(run: Run, ax: Axes, last: float = 1, direction: bool = True, **line: Any) -> Axes:
    """Path of the journal centre, z to the right and y up, with its direction.

    A cross marks the equilibrium, where the speed stays the same.
    """
    shown = SHOWN["journal_y"]
    y, z = (shown.factor * each for each in signals.orbit(run, last))
    (path,) = ax.plot(z, y, **line)
    if signals.steady(run):
        rest = [shown.factor * run["equilibrium/" + name] for name in ("journal_z", "journal_y")]
        ax.plot(*rest, "+", color=path.get_color())
    if direction:
        direction_arrow(ax, z, y, path.get_color())
    ax.set(xlabel=SHOWN["journal_z"].label, ylabel=shown.label, aspect="equal")
    return ax


@on_axes
def clearance(run: Run, ax: Axes) -> Axes:
    """Clearance circle of radius c_r, pads around it (outlines only, not to scale), sense of rotation."""
    radius = SHOWN["journal_y"].factor * run.clearance
    ax.add_patch(Circle((0, 0), radius, fill=False, linewidth=0.8, color="0.3"))
    note = {"ha": "center", "fontsize": "small", "color": "0.3"}
    arc, ratio = (np.atleast_1d(run.input["pads"][name]) for name in ("arc_deg", "pivot_ratio"))
    for pad, angle in enumerate(np.degrees(run.pivot_angle)):
        ends = {"theta1": angle - (1 - ratio[pad]) * arc[pad], "theta2": angle + ratio[pad] * arc[pad]}
        ax.add_patch(Arc((0, 0), 2.3 * radius, 2.3 * radius, **ends, linewidth=8, color="0.85"))
        ax.text(*polar(1.15 * radius, angle), str(pad + 1), **note, va="center_baseline")
    turn = {"connectionstyle": "arc3,rad=-0.32", "arrowstyle": "-|>", "mutation_scale": 9, "color": "0.3"}
    ax.add_patch(FancyArrowPatch(polar(0.72 * radius, 125), polar(0.72 * radius, 55), **turn))
    ax.text(0, 0.5 * radius, "rotation", **note, va="center")
    ax.plot([-radius, 0], [0, 0], linewidth=0.6, color="0.3")
    ax.text(-0.5 * radius, 0.02 * radius, f"$c_r$ = {radius:g} µm", **note, va="bottom")
    ax.set(xlim=(-1.3 * radius, 1.3 * radius), ylim=(-1.3 * radius, 1.3 * radius))
    ax.set(xlabel=SHOWN["journal_z"].label, ylabel=SHOWN["journal_y"].label, aspect="equal")
    return ax


@on_axes
def spectrum(run: Run, ax: Axes, name: str = "journal_y", orders: float = 10, **line: Any) -> Axes:
    """One-sided amplitudes of journal_y or journal_z, without the mean, up to `orders` times the speed."""
    frequency, amplitude = spectra.spectrum(run, name)
    draw_amplitude(ax, frequency, amplitude, (0, orders * shaft_frequency(run)), line)
    return ax


@on_axes
def full_spectrum(run: Run, ax: Axes, orders: float = 5, **line: Any) -> Axes:
    """Spectrum of y + i z, without the mean: forward whirl to the right, backward whirl to the left."""
    frequency, amplitude = spectra.full_spectrum(run)
    span = orders * shaft_frequency(run)
    draw_amplitude(ax, frequency, amplitude, (-span, span), line)
    return ax


@on_axes
def hysteresis(run: Run, ax: Axes, pad: int = 1, last: float = 1, **line: Any) -> Axes:
    """Friction moment over the tilt of a pad; the loop's area is the work lost."""
    tilt, moment = pivots.hysteresis(run, pad, last)
    x, y = SHOWN["pad_tilt"].factor * tilt, SHOWN["friction_moment"].factor * moment
    (path,) = ax.plot(x, y, **line)
    direction_arrow(ax, x, y, path.get_color())
    ax.set(xlabel=SHOWN["pad_tilt"].label, ylabel=SHOWN["friction_moment"].label)
    return ax


@on_axes
def waveform(
    run: Run, ax: Axes, name: str = "journal_y", last: float = 5, pad: int | None = None, **line: Any
) -> Axes:
    """A dataset over the last revolutions, counted from their start; of one pad where it has pads."""
    part = signals.last_revolutions(run, last)
    turns, values = signals.revolutions(run, part), run.values(name, part)
    if pad is not None:
        values = values[:, signals.pad_column(run, pad)]
    ax.plot(turns - turns[0], SHOWN[name].factor * values, **line)
    ax.set(xlabel="shaft revolutions", ylabel=SHOWN[name].label, xlim=(0, turns[-1] - turns[0]))
    return ax


@on_axes
def history(run: Run, ax: Axes, name: str = "journal_y", pad: int | None = None, **line: Any) -> Axes:
    """A dataset over the time of the whole run; of many revolutions, the band that they fill."""
    shown, time = SHOWN[name], run.time
    column = () if pad is None else (slice(None), signals.pad_column(run, pad))
    if np.ptp(run.shaft_angle) <= 2 * np.pi * BAND_FROM:
        part = slice(None, None, max(1, len(time) // (64 * BAND_FROM)))
        ax.plot(time[part], shown.factor * run[name][column][part], **line)
    else:
        middle, *band = signals.envelope(run, name)
        low, high = (np.atleast_2d((shown.factor * each[column]).T) for each in band)
        for least, most in zip(low, high, strict=True):
            (edge,) = ax.plot(middle, least, **{**line, "linewidth": 0.6})
            ax.plot(middle, most, **{**line, "color": edge.get_color(), "linewidth": 0.6})
            ax.fill_between(middle, least, most, facecolor=edge.get_color(), alpha=0.35, linewidth=0)
    ax.set(xlabel=SHOWN["time"].label, ylabel=shown.label, xlim=(time[0], time[-1]))
    return ax


def polar(radius: float, degrees: float) -> tuple[float, float]:
    """Place in the picture of a point at an angle from +z towards +y."""
    return radius * np.cos(np.radians(degrees)), radius * np.sin(np.radians(degrees))


def shaft_frequency(run: Run) -> float:
    """Shaft frequency at the end of the run, Hz."""
    return float(run.values("speed", slice(-1, None))[0]) / (2 * np.pi)


def draw_amplitude(
    ax: Axes, frequency: np.ndarray, amplitude: np.ndarray, span: tuple[float, float], line: dict[str, Any]
) -> None:
    """Amplitudes within `span` on a logarithmic axis, six decades at most; nothing at frequency 0."""
    inside = (frequency >= span[0]) & (frequency <= span[1])
    x, y = frequency[inside], np.where(frequency == 0, np.nan, SHOWN["amplitude"].factor * amplitude)[inside]
    ax.semilogy(x, y, **line)
    ax.set(xlabel=SHOWN["frequency"].label, ylabel=SHOWN["amplitude"].label, xlim=span)
    drawn = np.concatenate([np.asarray(each.get_ydata()) for each in ax.get_lines()])
    peak = np.nanmax(drawn, initial=1e-12)
    ax.set_ylim(max(1e-6 * peak, 0.5 * np.nanmin(drawn[drawn > 0], initial=peak)), 3 * peak)


def direction_arrow(ax: Axes, x: np.ndarray, y: np.ndarray, color: str) -> None:
    """An arrow head on a path where it runs fastest along x."""
    reach = max(1, len(x) // 90)
    if len(x) <= reach:
        return
    start = int(np.argmax(np.abs(x[reach:] - x[:-reach])))
    ends = (x[start + reach], y[start + reach]), (x[start], y[start])
    ax.annotate("", *ends, arrowprops={"arrowstyle": "-|>", "color": color, "shrinkA": 0, "shrinkB": 0})
