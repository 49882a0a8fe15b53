"""Whole pictures of one run, or of several laid over each other, as tiltpad-plot makes them.

Every function takes the runs, the number of revolutions at the end (None: its own default) and a pad
(None: all of them), and returns the figure.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tiltpad.calculate import differences, pivots, signals
from tiltpad.draw import diagrams, plots
from tiltpad.draw.branches import response
from tiltpad.draw.layout import (
    COLUMN,
    PAGE,
    drawn,
    heading,
    labels,
    legend,
    look,
    mark_enlarged,
    of_several,
    order_axis,
    panel_a_pad,
    parts,
    plain,
    shown_pads,
    stacked,
    top_axis,
    width,
)
from tiltpad.draw.vibrations import campbell, coefficients, stability
from tiltpad.draw.warm import temperatures
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN


def all_tilt(runs: Sequence[Run]) -> bool:
    """False where a run has fixed pads."""
    return all(run.input["pads"]["motion"] != "fixed" for run in runs)


def label_films(panels: Mapping[str, Axes]) -> None:
    """Labels in two lines, as long as a panel is high."""
    for name, text in zip(plots.FILM, ("minimum film\nthickness", "maximum\npressure"), strict=True):
        if name in panels:
            panels[name].set_ylabel(f"{text} ({SHOWN[name].unit})")


@of_several
def orbit(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Orbits in the clearance circle and enlarged, with the equilibrium."""
    fig = plt.figure(figsize=(PAGE, 3.6))
    whole, enlarged = fig.subplots(1, 2)
    plots.clearance(max(runs, key=lambda run: run.clearance), whole, marks=len(runs) == 1)
    for i, run in enumerate(runs):
        plots.orbit(run, whole, last or 1, direction=False, **look(i, 0, runs))
        plots.orbit(run, enlarged, last or 1, **look(i, 0, runs))
    enlarged.yaxis.tick_right()  # the lines between the panels are on the left
    enlarged.yaxis.set_label_position("right")
    enlarged.yaxis.set_ticks_position("both")
    enlarged.tick_params(labelleft=False, labelright=True)
    enlarged.set(box_aspect=1, adjustable="datalim")
    enlarged.margins(0.1)
    color = {"color": "0.3" if len(runs) > 1 else "C0"}
    marks = [("orbit", color), ("equilibrium", color | {"linestyle": "", "marker": "+"})]
    legend(fig, runs, marks if any(map(plots.marks_equilibrium, runs)) else [])
    mark_enlarged(whole, enlarged)
    return fig


@of_several
def equilibrium(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Equilibria of the journal in the clearance circle."""
    fig = plt.figure(figsize=(COLUMN, 3.4))
    ax = plots.clearance(max(runs, key=lambda run: run.clearance), fig.subplots(), marks=len(runs) == 1)
    for i, run in enumerate(runs):
        plots.equilibrium(run, ax, color=f"C{i}")
    legend(fig, runs, [])
    return fig


@of_several
def multipliers(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Floquet multipliers of periodic orbits, in and around the unit circle."""
    fig = plt.figure(figsize=(COLUMN, 3.4))
    ax = fig.subplots()
    ax.add_patch(Circle((0, 0), 1, fill=False, linewidth=0.8, color="0.3"))
    for i, run in enumerate(runs):
        plots.multipliers(run, ax, color=f"C{i}")
    reach = 1.1 * max(1.0, *(float(abs(signals.multipliers(run)).max()) for run in runs))
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    legend(fig, runs, [])
    return fig


@of_several
def spectrum(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Amplitudes of the journal: one-sided of y and z, and full of y + i z."""
    fig = plt.figure(figsize=(COLUMN, 4.6))
    upper, lower = fig.subplots(2, 1)
    for i, run in enumerate(runs):
        wide = {"linewidth": 2 if len(runs) == 1 else 1}
        plots.spectrum(run, upper, "journal_y", last=last, **look(i, 0, runs), **wide)
        plots.spectrum(run, upper, "journal_z", last=last, **look(i, 1, runs))
        plots.full_spectrum(run, lower, last=last, **look(i, 0, runs))
    frequency = {plots.shaft_frequency(run) for run in runs}
    upper.set_xlim(0, 10 * max(frequency))
    lower.set_xlim(-5 * max(frequency), 5 * max(frequency))
    if len(frequency) == 1:
        for ax, step in ((upper, 2), (lower, 1)):
            order_axis(ax, frequency.copy().pop(), step)
    for x, text in ((0.03, "backward"), (0.97, "forward")):
        side = "left" if x < 0.5 else "right"
        lower.text(x, 0.95, text, transform=lower.transAxes, ha=side, va="top", fontsize="small")
    lower.set_ylabel(f"amplitude of $y + \\mathrm{{i}}z$ ({SHOWN['amplitude'].unit})")
    legend(fig, runs, parts(["$y$", "$z$"], runs))
    return fig


@of_several
def hysteresis(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Friction moment over tilt, a panel for each pad, with the work dissipated in a revolution."""
    fig, panels = panel_a_pad(runs, pad)
    for k, ax in panels.items():
        work = []
        for i, run in enumerate(runs):
            plots.hysteresis(run, ax, k, last or 1, **look(i, 0, runs))
            work.append(pivots.friction_work(run, k))
        ax.margins(y=0.1)
        text = ", ".join(f"{SHOWN['work'].factor * each:#.3g}" for each in work)
        ax.set_title(f"pad {k}: {text} {SHOWN['work'].unit} per revolution")
    legend(fig, runs, [])
    return fig


@of_several
def friction(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Friction coefficient over sliding velocity, a panel for each pad."""
    fig, panels = panel_a_pad(runs, pad)
    for k, ax in panels.items():
        for i, run in enumerate(runs):
            plots.friction_coefficient(run, ax, k, last or 1, **look(i, 0, runs))
        ax.set_title(f"pad {k}")
    legend(fig, runs, [])
    return fig


@of_several
def sticking(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Tilt rate, bold where the pivot sticks, a panel for each pad, with the share of time that it sticks."""
    last = last or 2
    fig, panels = panel_a_pad(runs, pad)
    for k, ax in panels.items():
        share = []
        for i, run in enumerate(runs):
            plots.sticking(run, ax, k, last, **look(i, 0, runs))
            share.append(100 * pivots.stick_fraction(run, k, last))
        ax.set_title(f"pad {k}: sticks {', '.join(f'{each:.1f}' for each in share)} % of the time")
    neutral = look(0, 0, runs) | ({"color": "0.3"} if len(runs) > 1 else {})
    legend(fig, runs, [("slides", neutral), ("sticks", neutral | plots.STUCK)])
    return fig


@of_several
def poincare(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal, and tilt rate over tilt of a pad, once a revolution, on the path of the last ones.

    Where pads are fixed, the velocity of the journal stands in for the tilt.
    """
    fig = plt.figure(figsize=(PAGE, 3.4))
    left, right = fig.subplots(1, 2)
    tilting = all_tilt(runs)
    for i, run in enumerate(runs):
        for ax, names in ((left, plots.ORBIT), (right, plots.PHASE if tilting else plots.RISE)):
            plots.poincare(run, ax, last or 50, names, pad or 1, **look(i, 0, runs))
    left.set(box_aspect=1, adjustable="datalim")
    left.margins(0.1)
    right.set(box_aspect=1)
    right.set_title(f"pad {pad or 1}" if tilting else "journal")
    left.set_title("journal")
    points = {"color": "0.3" if len(runs) > 1 else "C0", "linestyle": "", "marker": ".", "markersize": 5}
    legend(fig, runs, [("once a revolution", points), (f"last {plots.PATH} revolutions", {"color": "0.7"})])
    return fig


@of_several
def waveform(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal, tilt and tilt rate over the last revolutions; of fixed pads film and pressure."""
    last = last or 5
    pads = shown_pads(runs, pad)
    of_pads = plots.PHASE if all_tilt(runs) else plots.FILM
    fig, panels = stacked(["journal_y", "journal_z", *of_pads])
    for i, run in enumerate(runs):
        for name, ax in panels.items():
            for k, p in drawn(name, pads):
                plots.waveform(run, ax, name, last, pad=p, **look(i, k, runs))
    longest = max(signals.turned(run, signals.last_revolutions(run, last)) for run in runs)
    if of_pads == plots.FILM:
        label_films(panels)
    for ax in panels.values():
        ax.set_xlim(0, longest)
    if len(runs) == 1:
        part = signals.last_revolutions(runs[0], last)
        turns = signals.revolutions(runs[0], part)
        top_axis(panels["journal_y"], turns - turns[0], runs[0].values("time", part), SHOWN["time"].label)
    legend(fig, runs, parts([f"pad {p}" for p in pads], runs))
    return fig


@of_several
def runup(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal, tilt (unless pads are fixed) and film over the whole run, with the speed where it changes.

    Marks along the bottom say where asperities touch the journal.
    """
    pads = shown_pads(runs, pad)
    tilts = ["pad_tilt"] if all_tilt(runs) else []
    fig, panels = stacked(["journal_y", "journal_z", *tilts, "min_film_thickness"])
    for i, run in enumerate(runs):
        for name, ax in panels.items():
            for k, p in drawn(name, pads):
                plots.history(run, ax, name, pad=p, **look(i, k, runs))
    ends = {(*signals.ends(run, "time"), *signals.ends(run, "speed")) for run in runs}
    label_films(panels)
    for ax in panels.values():
        ax.set_xlim(min(end[0] for end in ends), max(end[1] for end in ends))
    if len(ends) == 1:
        start, stop, first, final = ends.pop()
        if first != final:
            speed = SHOWN["speed"].factor * np.array([first, final])
            top_axis(panels["journal_y"], np.array([start, stop]), speed, SHOWN["speed"].label)
    legend(fig, runs, parts([f"pad {p}" for p in pads], runs))
    return fig


@of_several
def pressure(
    runs: Sequence[Run], last: float | None = None, pad: int | None = None, time: float | None = None
) -> Figure:
    """Film pressure over the unrolled pads, a panel each, at one instant (None: at the equilibrium)."""
    pads = shown_pads(runs, pad)
    columns = min(2, len(pads))
    rows = -(-len(pads) // columns) * len(runs)
    fig = plt.figure(figsize=(COLUMN if columns == 1 else PAGE, 0.3 + 2.5 * rows))
    panels = fig.subplots(rows, columns, squeeze=False).reshape(len(runs), -1)
    for run, name, axes in zip(runs, labels(runs), panels, strict=True):
        for ax, k in zip(axes, pads, strict=False):
            plots.pressure(run, ax, time, k)
            ax.set_title(f"pad {k}" if len(runs) == 1 else f"pad {k}: {name}")
        for ax in axes[len(pads) :]:
            ax.remove()
    title = runs[0].title if len(runs) == 1 else ""
    instant = "the equilibrium" if time is None else f"{time:g} s"
    fig.suptitle(plain(f"{title} at {instant}".lstrip(), width(fig)))
    return fig


@of_several
def orders(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Amplitudes of the first three orders over the speed, and the phase of the first, of a run-up."""
    names = [("journal_y", None), ("journal_z", None), *([("pad_tilt", pad)] if pad else [])]
    fig, panels = stacked([*names, "phase"])
    shown = (1, 2, 3)
    for i, run in enumerate(runs):
        for k, order in enumerate(shown):
            for name, column in names:
                plots.order_track(run, panels[name, column], name, order, column, **look(i, k, runs))
        plots.order_phase(run, panels["phase"], **look(i, 0, runs))
    for name, column in names:
        panels[name, column].set_ylabel(SHOWN[name].label + (f", pad {pad}" if column else ""))
    panels["phase"].set_ylabel("phase of $y$,\norder 1 (deg)")
    legend(fig, runs, parts([f"order {order}" for order in shown], runs))
    return fig


@of_several
def waterfall(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Amplitudes over speed and order of run-ups: for each run a column of y and z (with a pad: its tilt)."""
    names = ["pad_tilt"] if pad else ["journal_y", "journal_z"]
    fig = plt.figure(figsize=(COLUMN if len(runs) == 1 else PAGE, 0.5 + 2.1 * len(names)))
    panels = fig.subplots(len(names), len(runs), squeeze=False, sharex=len(runs) == 1)
    for column, run, label in zip(panels.T, runs, labels(runs), strict=True):
        for ax, name in zip(column, names, strict=True):
            plots.waterfall(run, ax, name, pad)
        if len(runs) > 1:
            column[0].set_title(label, wrap=True)
    if len(runs) == 1:
        legend(fig, runs, [])
        for ax in panels[:-1, 0]:
            ax.xaxis.label.set_visible(False)
    return fig


@of_several
def size(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Peak-to-peak of y and z of the journal.

    They are drawn over the speed if a run is a run-up, over a number of the input if runs differ in it alone,
    and otherwise as bars.
    """
    fig = plt.figure(figsize=(COLUMN, 2.6))
    ax = fig.subplots()
    coordinates = ("journal_y", "journal_z")
    if not all(signals.steady(run) for run in runs):
        for i, run in enumerate(runs):
            for k, name in enumerate(coordinates):
                plots.orbit_size(run, ax, name, last or 1, **look(i, k, runs))
        ax.set_ylim(bottom=0)
        legend(fig, runs, parts(["$y$", "$z$"], runs))
        return fig
    sizes = SHOWN["size"].factor * np.array([signals.orbit_size(run, last or 1) for run in runs]).T
    varied = differences.varied([run.input for run in runs])
    if varied:
        label, values = varied
        order = np.argsort(values)
        for each, dashes in zip(sizes, ("-", "--"), strict=True):
            ax.plot(np.array(values)[order], each[order], dashes, marker="o", markersize=3)
        ax.set(xlabel=label, ylabel=SHOWN["size"].label, ylim=(0, 1.1 * sizes.max()))
    else:
        place = np.arange(len(runs))
        names = labels(runs) if len(runs) > 1 else [runs[0].title or Path(runs[0].path).stem]
        for k, each in enumerate(sizes):
            ax.barh(place + 0.4 * k, each, 0.38)
        ax.set_yticks(place + 0.2, [plain(name, 24) for name in names])
        ax.grid(visible=False, axis="y")
        ax.invert_yaxis()
        ax.set(xlabel=SHOWN["size"].label)
        fig.set_figheight(1.2 + 0.4 * len(runs))
    heading(fig, [("$y$", {"color": "C0"}), ("$z$", {"color": "C1"})], "")
    return fig


def study(
    study: Study,
    show: str | None = None,
    over: str | None = None,
    kind: str | None = None,
    where: Mapping[str, str] | None = None,
    pad: int | None = None,
    pivot: str | None = None,
) -> Figure:
    """A diagram of a study; the arguments are those of tiltpad.diagrams.diagram."""
    fig = plt.figure(figsize=(COLUMN, 2.6))
    diagrams.diagram(study, fig.subplots(), show, over, kind, where, pad, pivot)
    kept = ", ".join(f"{name} = {value}" for name, value in (where or {}).items())
    fig.suptitle(plain(", ".join(text for text in (study.title, kept) if text), width(fig)))
    return fig


FIGURES = {
    each.__name__: each
    for each in (
        *(orbit, equilibrium, size, poincare, waveform, multipliers, spectrum),
        *(hysteresis, friction, sticking, runup, orders, waterfall, pressure),
        *(coefficients, stability, campbell, response, temperatures),
    )
}
