"""Pictures of one run on one pair of axes.

Every function takes the axes to draw on, or makes a figure in the package's own style, and returns the
axes. Further keywords go to the line, so that runs can be laid over each other.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from inspect import signature
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.patches import Arc, Circle
from matplotlib.ticker import MaxNLocator

from tiltpad.calculate import behaviour, geometry, library, pivots, signals, spectra
from tiltpad.calculate.rotation import sense
from tiltpad.draw.layout import polar, turning_arrow
from tiltpad.files.read import Run, needs_run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN

#: Speed, amplitude and phase of an order.
Track = tuple[np.ndarray, np.ndarray, np.ndarray]
#: Name of the package's own style, for matplotlib.style.use and .context.
STYLE = "tiltpad.draw.tiltpad"
#: A history of more revolutions is drawn as a band.
BAND_FROM = 60
#: Axes of a Poincare section: y over z of the journal, tilt rate over tilt of a pad, rate of y over y.
ORBIT, PHASE, RISE = ("journal_z", "journal_y"), ("pad_tilt", "pad_tilt_rate"), ("journal_y", "journal_vy")
#: What is drawn of pads that do not tilt.
FILM = ("min_film_thickness", "max_pressure")
#: What is drawn where slopes count: films at both ends.
EDGES = ("start_film_thickness", "end_film_thickness")
#: Revolutions of the path that is drawn under a Poincare section.
PATH = 4
#: Fewest and most revolutions of a window of a waterfall; more make sharper bands.
WINDOW = 8, 24
#: Line of a pivot that sticks.
STUCK = {"linewidth": 3, "linestyle": "-", "solid_capstyle": "butt"}


def on_axes(draw: Callable[..., Axes]) -> Callable[..., Axes]:
    """Lets `draw` be called without axes; it then gets new ones in the style of the package."""

    @wraps(draw)
    def drawn(run: Run, ax: Axes | None = None, *arguments: Any, **options: Any) -> Axes:
        if not isinstance(run, Study):
            needs_run(run)
        if ax is not None:
            return draw(run, ax, *arguments, **options)
        with plt.style.context(STYLE):
            return draw(run, plt.subplots()[1], *arguments, **options)

    parameters = signature(draw).parameters.values()
    optional = [each.replace(default=None) if each.name == "ax" else each for each in parameters]
    vars(drawn)["__signature__"] = signature(draw).replace(parameters=optional)
    return drawn


@on_axes
def orbit(run: Run, ax: Axes, last: float | None = None, direction: bool = True, **line: Any) -> Axes:
    """Path of the journal centre, z to the right and y up, with its direction.

    A cross marks the equilibrium if the speed is constant and the run started there.
    """
    shown = SHOWN["journal_y"]
    y, z = (shown.factor * each for each in signals.orbit(run, last))
    (path,) = ax.plot(z, y, **line)
    if marks_equilibrium(run):
        equilibrium(run, ax, color=path.get_color())
    if direction:
        direction_arrow(ax, z, y, path.get_color())
    ax.set(xlabel=SHOWN["journal_z"].label, ylabel=shown.label, aspect="equal")
    return ax


def marks_equilibrium(run: Run) -> bool:
    """True where the equilibrium is part of the picture of an orbit."""
    return signals.steady(run) and "equilibrium" in run


@on_axes
def equilibrium(run: Run, ax: Axes, **line: Any) -> Axes:
    """The journal's equilibrium, a cross; z to the right and y up."""
    z, y = (SHOWN[name].factor * run["equilibrium/" + name] for name in ORBIT)
    ax.plot(z, y, **{"linestyle": "", "marker": "+"} | line)
    ax.set(xlabel=SHOWN["journal_z"].label, ylabel=SHOWN["journal_y"].label, aspect="equal")
    return ax


@on_axes
def multipliers(run: Run, ax: Axes, **line: Any) -> Axes:
    """Floquet multipliers of a periodic orbit in the complex plane: inside the unit circle it is stable."""
    values = signals.multipliers(run)
    ax.plot(values.real, values.imag, **{"linestyle": "", "marker": "o", "markersize": 4} | line)
    ax.set(xlabel=SHOWN["multiplier_real"].label, ylabel=SHOWN["multiplier_imag"].label, aspect="equal")
    return ax


@on_axes
def clearance(run: Run, ax: Axes, marks: bool = True) -> Axes:
    """Clearance circle of radius c_r, pads around it (outlines only, not to scale), sense of rotation.

    Fixed pads leave the journal the room within their bores, which is drawn instead of the circle.
    With `marks`, pads that carry no load are pale, and words say so, or that they flutter or rub.
    """
    factor = SHOWN["journal_y"].factor
    radius = reach = factor * run.clearance
    assembled, machined = (
        factor * geometry.of_pads(run.in_operation, f"bearing%{name}_clearance")
        for name in ("assembled", "machined")
    )
    tilting = run.tilts
    if tilting:
        ax.add_patch(Circle((0, 0), radius, fill=False, linewidth=0.8, color="0.3"))
    note = {"ha": "center", "fontsize": "small", "color": "0.3"}
    arc, ratio = (geometry.of_pads(run.input, f"pads%{name}") for name in ("arc_deg", "pivot_ratio"))
    found, turning = behaviour.marks(run) if marks else {}, sense(run.input)
    for pad, angle in enumerate(np.degrees(run.pivot_angle)):
        mark = found.get(pad + 1, "")
        below = 1 - ratio[pad] if turning > 0 else ratio[pad]
        ends = {"theta1": angle - below * arc[pad], "theta2": angle + (1 - below) * arc[pad]}
        inner = assembled[pad] if tilting else machined[pad]
        middle = polar(assembled[pad] - inner, angle)
        if not tilting:
            ax.add_patch(Arc(middle, 2 * inner, 2 * inner, **ends, linewidth=0.8, color="0.3"))
            corners = [np.add(middle, polar(inner, end)) for end in ends.values()]
            reach = max(reach, np.abs(corners).max())
        color = "0.93" if "no load" in mark else "0.85"
        # backs of lobes, which their clearance bends, would lie on each other
        away, thick = (0.15, 8) if tilting else (0.07, 4)
        back = 2 * (inner + away * radius)
        ax.add_patch(Arc(middle, back, back, **ends, linewidth=thick, color=color))
        ax.text(*polar(1.15 * radius, angle), str(pad + 1), **note, va="center_baseline")
        if mark:
            small = note | {"fontsize": "x-small", "color": "C3" if "rubs" in mark else "0.3"}
            ax.text(*polar(0.86 * radius, angle), mark, **small, va="center")
    turning_arrow(ax, 0.72 * radius, (125, 55), 0.32 * turning, mutation_scale=9, color="0.3")
    ax.text(0, 0.5 * radius, "rotation", **note, va="center")
    ax.plot([-radius, 0], [0, 0], linewidth=0.6, color="0.3")
    ax.text(-0.5 * radius, 0.02 * radius, f"$c_r$ = {radius:g} µm", **note, va="bottom")
    reach += 0.3 * radius
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    ax.set(xlabel=SHOWN["journal_z"].label, ylabel=SHOWN["journal_y"].label, aspect="equal")
    return ax


@on_axes
def poincare(
    run: Run,
    ax: Axes,
    last: float = 50,
    names: tuple[str, str] = ORBIT,
    pad: int = 1,
    phase: float = 0.0,
    **line: Any,
) -> Axes:
    """One state over another once a revolution, at a phase of the shaft, on the path of the last revolutions.

    ORBIT is y over z of the journal, PHASE the tilt rate over the tilt of a pad. The points of a
    quasi-periodic motion are joined to the ring that they fill.
    """
    column = {
        name: () if name.startswith("journal") else (..., signals.pad_column(run, pad)) for name in names
    }
    section, part = signals.poincare(run, last, phase), signals.last_revolutions(run, PATH)
    path = [SHOWN[name].factor * run.values(name, part)[column[name]] for name in names]
    ax.plot(*path, **{**line, "linewidth": 0.6, "alpha": 0.4})
    points = [SHOWN[name].factor * section[name][column[name]] for name in names]
    ax.plot(*points, **{**line, "linestyle": "", "marker": ".", "markersize": 5})
    if signals.is_torus(run):
        y, z = (section[name] - section[name].mean() for name in ("journal_y", "journal_z"))
        ring = np.argsort(np.arctan2(z, y))
        ring = np.append(ring, ring[0])
        ax.plot(*(each[ring] for each in points), **{**line, "linewidth": 0.8})
    ax.set(xlabel=SHOWN[names[0]].label, ylabel=SHOWN[names[1]].label)
    if names == ORBIT:
        ax.set_aspect("equal")
    return ax


@on_axes
def orbit_size(run: Run, ax: Axes, name: str = "journal_y", last: float | None = None, **line: Any) -> Axes:
    """Peak-to-peak of journal_y or journal_z over the speed; a run at constant speed is a point.

    The drift of the mean in a run-up is not in it.
    """
    shown, speed = SHOWN["size"], SHOWN["speed"]
    if signals.steady(run):
        at, size = run.values("speed", slice(-1, None)), np.ptp(signals.waveform(run, name, last)[1])
        line |= {"marker": "o", "markersize": 3}
    else:
        at, size = signals.swing(run, name)
    ax.plot(speed.factor * at, shown.factor * size, **line)
    ax.set(xlabel=speed.label, ylabel=shown.label)
    return ax


@on_axes
def spectrum(
    run: Run, ax: Axes, name: str = "journal_y", orders: float = 10, last: float | None = None, **line: Any
) -> Axes:
    """One-sided amplitudes of journal_y or journal_z, without the mean, up to `orders` times the speed.

    It is the spectrum in the file; with `last`, or if the file has none, that of the last revolutions.
    """
    last = last or (None if "spectrum" in run else 10)
    found = spectra.one_sided(run, name, last) if last else spectra.spectrum(run, name)
    if spectra.is_windowed(run, last):
        found = spectra.with_tops(*found)
    return draw_amplitude(ax, *found, (0, orders * shaft_frequency(run)), line)


@on_axes
def full_spectrum(run: Run, ax: Axes, orders: float = 5, last: float | None = None, **line: Any) -> Axes:
    """Spectrum of y + i z, without the mean: forward whirl to the right, backward whirl to the left.

    It is the spectrum in the file; with `last`, or if the file has none, that of the last revolutions.
    """
    last = last or (None if "spectrum" in run else 10)
    found = spectra.full(run, last) if last else spectra.full_spectrum(run)
    if spectra.is_windowed(run, last):
        found = spectra.with_tops(*found)
    span = orders * shaft_frequency(run)
    return draw_amplitude(ax, *found, (-span, span), line)


@on_axes
def order_track(
    run: Run,
    ax: Axes,
    name: str = "journal_y",
    order: float = 1,
    pad: int | None = None,
    scale: str = "linear",
    track: Track | None = None,
    **line: Any,
) -> Axes:
    """Amplitude of one order of a dataset over the speed of a run-up, on a linear or log `scale`.

    A `track` that is known already (speed, amplitude, phase) is not calculated again.
    """
    speed, amplitude, _ = track or spectra.order_track(run, name, order, pad)
    ax.plot(SHOWN["speed"].factor * speed, SHOWN[name].factor * amplitude, **line)
    ax.set(xlabel=SHOWN["speed"].label, ylabel=SHOWN[name].label, yscale=scale)
    if scale == "linear":
        from_zero(ax)
    return ax


@on_axes
def order_phase(
    run: Run,
    ax: Axes,
    name: str = "journal_y",
    order: float = 1,
    pad: int | None = None,
    track: Track | None = None,
    **line: Any,
) -> Axes:
    """Phase lag of one order of a dataset over the speed of a run-up, behind the unbalance.

    It is the angle of the shaft from where the unbalance points along +y to the maximum of the dataset. A
    `track` is as for order_track.
    """
    speed, _, phase = track or spectra.order_track(run, name, order, pad)
    ax.plot(SHOWN["speed"].factor * speed, -np.degrees(np.unwrap(phase)), **line)
    ax.set(xlabel=SHOWN["speed"].label, ylabel="phase lag (deg)")
    return ax


@on_axes
def waterfall(
    run: Run,
    ax: Axes,
    name: str = "journal_y",
    pad: int | None = None,
    orders: float = 5,
    by: str = "frequency",
    decades: float = 3,
    **mesh: Any,
) -> Axes:
    """Amplitudes of a dataset over the speed of a run-up and the frequency, or `by` order, up to an order.

    The colours reach down by this number of decades. Lines mark the orders on an axis of frequencies.
    """
    revolutions = int(np.clip(signals.turned(run) / 20, *WINDOW))
    speed, order, amplitude = spectra.waterfall(run, name, pad, orders, revolutions)
    shown = SHOWN[name]
    # without the mean, which the Hann window spreads over the next orders: it would hide the motion
    moving = order >= 2 * order[1]
    order, table = order[moving], shown.factor * amplitude[:, moving].T
    peak = max(table.max(), 1e-12)
    x, y = np.meshgrid(SHOWN["speed"].factor * speed, order)
    hertz = by == "frequency"
    if hertz:
        y = y * x / 60
    least = 10**-decades * peak
    colours = {"norm": LogNorm(least, peak), "shading": "gouraud", "cmap": "viridis", "rasterized": True}
    image = ax.pcolormesh(x, y, np.maximum(table, least), **colours | mesh)
    ax.figure.colorbar(image, ax=ax, label=shown.label)
    ax.set(xlabel=SHOWN["speed"].label, ylabel=SHOWN["frequency"].label if hertz else "order")
    ax.set(xlim=(x.min(), x.max()), ylim=(0 if hertz else order[0], y.max()))
    ax.grid(visible=False)
    ax.set_facecolor(image.cmap(0.0))
    if hertz:
        mark_orders(ax, x[0], orders)
    return ax


def mark_orders(ax: Axes, speed: np.ndarray, orders: float) -> None:
    """Thin lines of half the speed and its multiples over a speed in rpm, with their names at the right."""
    ends = np.array([speed.min(), speed.max()])
    note = {"color": "white", "fontsize": "xx-small", "ha": "right", "va": "bottom"}
    for order in (0.5, *range(1, int(orders) + 1)):
        hertz = order * ends / 60
        ax.plot(ends, hertz, color="white", linewidth=0.4, linestyle=":", alpha=0.7)
        beside = {"xytext": (-2, -1.5 if order < 1 else -6), "textcoords": "offset points"}
        ax.annotate(f"{order:g}×", (ends[1], hertz[1]), **beside, **note)


@on_axes
def hysteresis(run: Run, ax: Axes, pad: int = 1, last: float | None = None, **line: Any) -> Axes:
    """Friction moment over the tilt of a pad; the area of the loop is the work that friction dissipates."""
    tilt, moment = pivots.hysteresis(run, pad, last)
    x, y = SHOWN["pad_tilt"].factor * tilt, SHOWN["friction_moment"].factor * moment
    (path,) = ax.plot(x, y, **line)
    direction_arrow(ax, x, y, path.get_color())
    ax.set(xlabel=SHOWN["pad_tilt"].label, ylabel=SHOWN["friction_moment"].label)
    return ax


@on_axes
def friction_coefficient(run: Run, ax: Axes, pad: int = 1, last: float | None = None, **line: Any) -> Axes:
    """Friction coefficient of a pivot over its sliding velocity, where it carries load."""
    velocity, coefficient = pivots.friction_coefficient(run, pad, last)
    ax.plot(SHOWN["sliding_velocity"].factor * velocity, coefficient, **line)
    if np.isnan(coefficient).all():
        ax.text(0.5, 0.5, "carries no load", transform=ax.transAxes, ha="center", va="center", color="0.3")
    ax.set(xlabel=SHOWN["sliding_velocity"].label, ylabel=SHOWN["friction_coefficient"].label)
    return ax


@on_axes
def sticking(run: Run, ax: Axes, pad: int = 1, last: float = 2, **line: Any) -> Axes:
    """Tilt rate of a pad over the last revolutions, bold where its pivot sticks."""
    waveform(run, ax, "pad_tilt_rate", last, pad, **line)
    (path,) = ax.get_lines()[-1:]
    stuck = np.where(pivots.sticking(run, pad, last), path.get_ydata(), np.nan)
    ax.plot(path.get_xdata(), stuck, **{**line, "color": path.get_color(), **STUCK})
    return ax


@on_axes
def waveform(
    run: Run, ax: Axes, name: str = "journal_y", last: float = 5, pad: int | None = None, **line: Any
) -> Axes:
    """A dataset over the last revolutions, counted from their start; of one pad if it has pads."""
    part = signals.last_revolutions(run, last)
    turns, values = signals.revolutions(run, part), signals.series(run, name, part, pad)
    ax.plot(turns - turns[0], SHOWN[name].factor * values, **line)
    if tells_contact(run, name):
        mark_contact(ax, turns - turns[0], signals.series(run, "asperity_force", part, pad))
    ax.set(xlabel="shaft revolutions", ylabel=SHOWN[name].label, xlim=(0, turns[-1] - turns[0]))
    return ax


@on_axes
def history(run: Run, ax: Axes, name: str = "journal_y", pad: int | None = None, **line: Any) -> Axes:
    """A dataset over the time of the whole run; many revolutions are drawn as the band that they fill."""
    shown = SHOWN[name]
    column = () if pad is None else (slice(None), signals.pad_column(run, pad))
    signals.last_revolutions(run)
    if signals.turned(run) <= BAND_FROM:
        part = slice(None, None, max(1, run.samples // (64 * BAND_FROM)))
        ax.plot(run.values("time", part), shown.factor * run.values(name, part)[column], **line)
    else:
        middle, *band = signals.envelope(run, name)
        low, high = (np.atleast_2d((shown.factor * each[column]).T) for each in band)
        for lower, upper in zip(low, high, strict=True):
            (edge,) = ax.plot(middle, lower, **{**line, "linewidth": 0.6})
            ax.plot(middle, upper, **{**line, "color": edge.get_color(), "linewidth": 0.6})
            ax.fill_between(middle, lower, upper, facecolor=edge.get_color(), alpha=0.35, linewidth=0)
    if tells_contact(run, name):
        middle, _, highest = signals.envelope(run, "asperity_force", cover=1)
        mark_contact(ax, middle, highest[column])
    ax.set(xlabel=SHOWN["time"].label, ylabel=shown.label, xlim=signals.ends(run, "time"))
    return ax


@on_axes
def pressure(
    run: Run,
    ax: Axes,
    time: float | None = None,
    pad: int = 1,
    film: library.Pressure | None = None,
    **contours: Any,
) -> Axes:
    """Film pressure over an unrolled pad at the sample next to `time`, s, with its colour bar.

    Without `time` it is that of the equilibrium. The surface of the journal moves from right to left, from
    the leading to the trailing edge. Where slopes count, dashed lines are those of one film thickness. A
    `film` that is known already is not calculated again; with `levels` there is no colour bar, as several
    pads share them.
    """
    column, film, shown = signals.pad_column(run, pad), film or library.pressure(run, time), SHOWN["pressure"]
    field = shown.factor * film.pressure[column].T
    levels = MaxNLocator(12).tick_values(field.min(), max(field.max(), field.min() + 1e-6))
    x, y = SHOWN["phi"].factor * film.phi[column], SHOWN["axial"].factor * film.z[column]
    filled = ax.contourf(x, y, field, **{"levels": levels, **contours})
    if "levels" not in contours:
        ax.figure.colorbar(filled, ax=ax, label=shown.label)
    for place, edge in ((0.025, "trailing edge"), (0.975, "leading edge")):
        note = {"rotation": 90, "ha": "center", "va": "center", "fontsize": "x-small", "color": "white"}
        ax.text(place, 0.5, edge, transform=ax.transAxes, **note)
    if run.has_slopes:
        sizes = ("pads%arc_deg", "pads%pivot_ratio", "bearing%axial_length")
        arc, ratio, length = (geometry.of_pads(run.input, name)[column] for name in sizes)
        shares = np.clip(x / arc + 1 - ratio, 0, 1), np.clip(2 * film.z[column] / length, -1, 1)
        thickness = geometry.film_thickness(run, time, *shares)[column].T
        look = {"colors": "white", "linewidths": 0.6, "linestyles": "--"}
        # beside the words at the edges
        part, height = slice(len(x) // 14, -(len(x) // 14)), SHOWN["min_film_thickness"].factor * thickness
        lines = ax.contour(x[part], y, height[:, part], levels=6, **look)
        ax.clabel(lines, fmt="%g µm", fontsize="x-small")
    ax.set(xlabel=SHOWN["phi"].label, ylabel=SHOWN["axial"].label)
    return ax


def tells_contact(run: Run, name: str) -> bool:
    """Whether contact of asperities is marked at this film: of both ends at the one that comes closer."""
    if name in EDGES and "asperity_force" in run:
        return name == min(EDGES, key=lambda each: run.values(each).min())
    return name == "min_film_thickness" and "asperity_force" in run


def mark_contact(ax: Axes, x: np.ndarray, force: np.ndarray) -> None:
    """Marks along the bottom where asperities of a pad, or of any, touch the journal."""
    touching = force > 0 if force.ndim == 1 else (force > 0).any(axis=1)
    if not touching.any():
        return
    where = {"transform": ax.get_xaxis_transform(), "color": "red", "marker": "|", "linestyle": ""}
    ax.plot(x[touching], np.full(touching.sum(), 0.03), **where)
    note = {"transform": ax.transAxes, "color": "red", "fontsize": "x-small"}
    ax.text(0.01, 0.13, "asperities touch", **note)


def from_zero(ax: Axes) -> None:
    """Lets the vertical axis reach from 0 over all that is drawn, now and before."""
    values = np.concatenate([np.asarray(each.get_ydata(), float) for each in ax.get_lines()])
    if (top := np.nanmax(values, initial=0)) > 0:
        ax.set_ylim(0, 1.05 * top)


def all_tilt(runs: Sequence[Run]) -> bool:
    """False where a run has fixed pads."""
    return all(run.tilts for run in runs)


def of_slopes(runs: Sequence[Run]) -> tuple[str, ...]:
    """What is drawn, too, where slopes count in all runs: pitch of pads that have it, films at both ends."""
    if not all(run.has_slopes for run in runs):
        return ()
    pitching = all("pitch" in run.input["pads"]["motion"] for run in runs)
    return (*(("pad_pitch",) if pitching else ()), *EDGES)


def label_films(panels: Mapping[str, Axes]) -> None:
    """Labels in two lines, as long as a panel is high; films at both ends have one scale."""
    edges = ("film, end of\nlower $x$", "film, end of\nhigher $x$")
    texts = ("minimum film\nthickness", "maximum\npressure", *edges)
    for name, text in zip((*FILM, *EDGES), texts, strict=True):
        if name in panels:
            panels[name].set_ylabel(f"{text} ({SHOWN[name].unit})")
    if EDGES[0] in panels:
        panels[EDGES[0]].sharey(panels[EDGES[1]])
        panels[EDGES[0]].autoscale(axis="y")


def shaft_frequency(run: Run) -> float:
    """Shaft frequency at the end of the run, Hz."""
    return float(run.values("speed", slice(-1, None))[0]) / (2 * np.pi)


def draw_amplitude(
    ax: Axes, frequency: np.ndarray, amplitude: np.ndarray, span: tuple[float, float], line: dict[str, Any]
) -> Axes:
    """Amplitudes within `span` on a logarithmic axis, six decades at most, without frequency 0."""
    line = {"linewidth": 0.6} | line
    inside = (frequency >= span[0]) & (frequency <= span[1])
    x, y = frequency[inside], np.where(frequency == 0, np.nan, SHOWN["amplitude"].factor * amplitude)[inside]
    ax.semilogy(x, y, **line)
    ax.set(xlabel=SHOWN["frequency"].label, ylabel=SHOWN["amplitude"].label, xlim=span)
    drawn = np.concatenate([np.asarray(each.get_ydata()) for each in ax.get_lines()])
    peak = np.nanmax(drawn, initial=1e-12)
    ax.set_ylim(max(1e-6 * peak, 0.5 * np.nanmin(drawn[drawn > 0], initial=peak)), 3 * peak)
    return ax


def direction_arrow(ax: Axes, x: np.ndarray, y: np.ndarray, color: str) -> None:
    """An arrow head on a path, at the point where x changes fastest."""
    reach = max(1, len(x) // 90)
    if len(x) <= reach:
        return
    start = int(np.argmax(np.abs(x[reach:] - x[:-reach])))
    ends = (x[start + reach], y[start + reach]), (x[start], y[start])
    ax.annotate("", *ends, arrowprops={"arrowstyle": "-|>", "color": color, "shrinkA": 0, "shrinkB": 0})
