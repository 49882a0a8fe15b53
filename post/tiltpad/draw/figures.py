"""Whole pictures of one run, or of several laid over each other, as tiltpad-plot makes them.

Every function takes the runs, the number of revolutions at the end (None: its own default) and a pad
(None: all of them), and returns the figure.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tiltpad.calculate import pivots, signals
from tiltpad.calculate.selection import ArgumentError
from tiltpad.draw import diagrams, layout, plots
from tiltpad.draw.basins import basin
from tiltpad.draw.branches import branch, chart, multipliers, response
from tiltpad.draw.films import film, pressure
from tiltpad.draw.machines import shaft, shapes, stations
from tiltpad.draw.orbits import equilibrium, orbit
from tiltpad.draw.runups import orders, runup, size, waterfall
from tiltpad.draw.samples import distribution, scatter, tornado
from tiltpad.draw.turbulence import turbulence
from tiltpad.draw.vibrations import campbell, coefficients, stability
from tiltpad.draw.warm import temperatures
from tiltpad.files.read import Run
from tiltpad.files.station import Station
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN, in_words, literal


@layout.of_several
def spectrum(runs: Sequence[Run], last: float | None = None, orders: float | None = None) -> Figure:
    """Amplitudes of the journal up to an order: one-sided of y and of z, and full of y + i z."""
    orders = orders or 10
    fig, panels = plt.subplots(3, 1, figsize=(layout.COLUMN, 5.6))
    *single, full = panels
    for i, run in enumerate(runs):
        for ax, name in zip(single, ("journal_y", "journal_z"), strict=True):
            plots.spectrum(run, ax, name, orders, last, **layout.look(i, 0, runs))
        plots.full_spectrum(run, full, orders / 2, last, **layout.look(i, 0, runs))
    frequency = {plots.shaft_frequency(run) for run in runs}
    span = orders * max(frequency)
    for ax, whose in zip(panels, ("y", "z", "y + \\mathrm{i}z"), strict=True):
        ax.set(xlim=(0, span), ylabel=f"amplitude of ${whose}$ ({SHOWN['amplitude'].unit})")
    full.set_xlim(-span / 2, span / 2)
    if len(frequency) == 1:
        for ax, reach in ((panels[0], orders), (full, orders / 2)):
            layout.order_axis(ax, frequency.copy().pop(), max(1, round(reach / 5)))
    for x, text in ((0.03, "backward"), (0.97, "forward")):
        side = "left" if x < 0.5 else "right"
        full.text(x, 0.95, text, transform=full.transAxes, ha=side, va="top", fontsize="small")
    panels[0].xaxis.label.set_visible(False)
    fig.align_ylabels(panels)
    layout.legend(fig, runs, [])
    return fig


def panel_a_pad(
    runs: Sequence[Run], pad: int | None, last: float | None, draw: Callable[..., Axes]
) -> tuple[Figure, list[tuple[Axes, int, list[Run]]]]:
    """A panel for each of the shown pads, two in a row: its axes, the pad, and the runs that have it."""
    pads = layout.shown_pads(runs, pad)
    fig, panels = layout.grid(len(pads), 2.8)
    for k, ax in zip(pads, panels, strict=True):
        ax.locator_params(axis="x", nbins=6)
        for i, run in enumerate(runs):
            if k <= run.pads:
                draw(run, ax, k, last, **layout.look(i, 0, runs))
    return fig, [(ax, k, [run for run in runs if k <= run.pads]) for k, ax in zip(pads, panels, strict=True)]


@layout.of_several
def hysteresis(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Friction moment over tilt, a panel for each pad, with the work dissipated in a revolution."""
    fig, panels = panel_a_pad(runs, pad, last, plots.hysteresis)
    for ax, k, those in panels:
        ax.margins(y=0.1)
        work = [pivots.friction_work(run, k, last) for run in those]
        ax.set_title(f"pad {k}: {in_words('work', work)} per revolution")
    layout.legend(fig, runs, [])
    return fig


@layout.of_several
def friction(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Friction coefficient over sliding velocity, a panel for each pad."""
    fig, panels = panel_a_pad(runs, pad, last, plots.friction_coefficient)
    for ax, k, _ in panels:
        ax.set_title(f"pad {k}")
    layout.legend(fig, runs, [])
    return fig


@layout.of_several
def sticking(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Tilt rate, bold where the pivot sticks, a panel for each pad, with the share of time that it sticks."""
    fig, panels = panel_a_pad(runs, pad, last or 2, plots.sticking)
    for ax, k, those in panels:
        share = [pivots.stick_fraction(run, k, last or 2) for run in those]
        ax.set_title(f"pad {k}: sticks {in_words('share', share)} of the time")
    neutral = layout.look(0, 0, runs) | ({"color": "0.3"} if len(runs) > 1 else {})
    layout.legend(fig, runs, [("slides", neutral), ("sticks", neutral | plots.STUCK)])
    return fig


@layout.of_several
def poincare(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal, and tilt rate over tilt of a pad, once a revolution, on the path of the last ones.

    Where pads are fixed, the velocity of the journal stands in for the tilt; stations have the first alone.
    """
    tilting = plots.all_tilt(runs)
    shown = [plots.ORBIT, plots.PHASE if tilting else plots.RISE]
    if any(isinstance(run, Station) for run in runs):
        del shown[1]
    width = layout.PAGE if len(shown) > 1 else layout.COLUMN
    fig, panels = plt.subplots(1, len(shown), squeeze=False, figsize=(width, 3.4))
    left, *others = panels[0]
    for i, run in enumerate(runs):
        for ax, names in zip((left, *others), shown, strict=True):
            count = last or (max(50, run.length("revolution")) if signals.is_torus(run) else 50)
            plots.poincare(run, ax, count, names, pad or 1, **layout.look(i, 0, runs))
    left.set(box_aspect=1, adjustable="datalim")
    left.margins(0.1)
    for right in others:
        right.set(box_aspect=1)
        right.locator_params(axis="x", nbins=6)
        right.set_title(f"pad {pad or 1}" if tilting else "journal")
    left.set_title(("journal" if others else "shaft") + (turning_of(runs[0]) if len(runs) == 1 else ""))
    points = {"color": "0.3" if len(runs) > 1 else "C0", "linestyle": "", "marker": ".", "markersize": 5}
    path = (f"last {plots.PATH} revolutions", {"color": "0.7"})
    layout.legend(fig, runs, [("once a revolution", points), path])
    return fig


def turning_of(run: Run) -> str:
    """The rotation number of a quasi-periodic motion, and the size of the ring of its points."""
    if not signals.is_torus(run):
        return ""
    shown = SHOWN["size"]
    wide, high = (shown.factor * run[f"summary/ring_{axis}"] for axis in "zy")
    number = run["summary/rotation_number"]
    return f": rotation number {number:.6f},\nring of {wide:.3g} by {high:.3g} {shown.unit}"


@layout.of_several
def waveform(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal, tilt and tilt rate over the last revolutions; of fixed pads film and pressure.

    Where slopes count, the pitch of pads that have it and the films at both ends, too.
    """
    last = last or 5
    pads = layout.shown_pads(runs, pad)
    of_pads = plots.PHASE if plots.all_tilt(runs) else plots.FILM
    fig, panels = layout.stacked(["journal_y", "journal_z", *of_pads, *plots.of_slopes(runs)])
    for i, run in enumerate(runs):
        for name, ax in panels.items():
            for k, p in layout.drawn(run, name, pads):
                plots.waveform(run, ax, name, last, pad=p, **layout.look(i, k, runs))
    longest = max(signals.turned(run, signals.last_revolutions(run, last)) for run in runs)
    plots.label_films(panels)
    for ax in panels.values():
        ax.set_xlim(0, longest)
    if len(runs) == 1:
        part = signals.last_revolutions(runs[0], last)
        turns, time = signals.revolutions(runs[0], part), runs[0].values("time", part)
        layout.top_axis(panels["journal_y"], turns - turns[0], time, SHOWN["time"].label)
    layout.legend(fig, runs, layout.parts([f"pad {p}" for p in pads], runs))
    return fig


def study(
    studies: Study | Sequence[Study],
    show: str | None = None,
    over: str | None = None,
    kind: str | None = None,
    where: Mapping[str, str] | None = None,
    pad: int | None = None,
    pivot: str | None = None,
) -> Figure:
    """A diagram of a study, or the lines of several in one; arguments as for tiltpad.diagrams.diagram."""
    several = [studies] if isinstance(studies, Study) else list(studies)
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 2.6))
    if len(several) == 1:
        diagrams.diagram(several[0], ax, show, over, kind, where, pad, pivot)
    else:
        over_each_other(several, layout.labels(several), ax, show, over, kind or "lines", where, pad, pivot)
    titles = {each.title for each in several}
    kept = ", ".join(f"{name} = {value}" for name, value in (where or {}).items())
    title = titles.pop() if len(titles) == 1 else ""
    fig.suptitle(layout.plain(", ".join(text for text in (title, kept) if text), layout.width(fig)))
    for each in several:
        layout.remark_unfinished(fig, each, Path(each.path).stem if len(several) > 1 else "")
    return fig


def over_each_other(studies: Sequence[Study], names: Sequence[str], ax: Axes, *arguments: Any) -> None:
    """Diagrams of studies on the same axes: a colour for each study, dashes for the lines within one."""
    seen, handles = set(), []
    for k, (each, name) in enumerate(zip(studies, names, strict=True)):
        before = len(ax.get_lines())
        diagrams.diagram(each, ax, *arguments)
        seen.add((ax.get_xlabel(), ax.get_ylabel()))
        if ax.collections or len(seen) > 1:
            one = "several studies are lines of one result over one parameter"
            raise ArgumentError(f"{one}: choose by {{show}} and {{over}}")
        mine = ax.get_lines()[before:]
        results = (line for line in mine if line.get_gid() != diagrams.NOT_DONE["gid"])
        for part, line in enumerate(results):
            own = f"{line.get_label()}"
            line.set_label(literal(name) + ("" if own.startswith("_") or not own else f", {own}"))
            handles.append(line)
            if line.get_linestyle() != "None":
                line.set_linestyle(layout.DASHES[part % len(layout.DASHES)])
        for line in mine:
            line.set_color(f"C{k}")
    ax.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0))


FIGURES = {
    each.__name__: each
    for each in (
        *(orbit, equilibrium, size, poincare, waveform, multipliers, spectrum),
        *(hysteresis, friction, sticking, runup, orders, waterfall, pressure, film, turbulence),
        *(coefficients, stability, campbell, response, branch, chart, basin, temperatures),
        *(tornado, distribution, scatter),
        *(stations, shaft, shapes),
    )
}
