"""Whole pictures of one run, or of several laid over each other, as tiltpad-plot makes them.

Every function takes the runs, the number of revolutions at the end (None: its own default) and a pad
(None: all of them), and returns the figure.
"""

import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import ConnectionPatch, Rectangle

from tiltpad import namelist, pivots, plots, signals
from tiltpad.read import Run
from tiltpad.units import SHOWN

COLUMN, PAGE = 3.35, 6.9  # widths in a paper, inches
LONGEST_LABEL = 90  # characters
DASHES = ("-", "--", ":", "-.")


def orbit(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Orbits in the clearance circle and enlarged, with the equilibrium."""
    fig = plt.figure(figsize=(PAGE, 3.6))
    whole, enlarged = fig.subplots(1, 2)
    plots.clearance(max(runs, key=lambda run: run.clearance), whole)
    for i, run in enumerate(runs):
        plots.orbit(run, whole, last or 1, direction=False, **look(i, 0, runs))
        plots.orbit(run, enlarged, last or 1, **look(i, 0, runs))
    enlarged.yaxis.tick_right()  # out of the way of the lines that lead there
    enlarged.yaxis.set_label_position("right")
    enlarged.yaxis.set_ticks_position("both")
    enlarged.tick_params(labelleft=False, labelright=True)
    enlarged.set(box_aspect=1, adjustable="datalim")
    enlarged.margins(0.1)
    color = {"color": "0.3" if len(runs) > 1 else "C0"}
    marks = [("orbit", color), ("equilibrium", color | {"linestyle": "", "marker": "+"})]
    legend(fig, runs, marks if any(signals.steady(run) for run in runs) else [])
    mark_enlarged(whole, enlarged)
    return fig


def spectrum(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Amplitudes of the journal: one-sided of y and z, and full of y + i z."""
    fig = plt.figure(figsize=(COLUMN, 4.6))
    upper, lower = fig.subplots(2, 1)
    for i, run in enumerate(runs):
        plots.spectrum(run, upper, "journal_y", **look(i, 0, runs), linewidth=2 if len(runs) == 1 else 1)
        plots.spectrum(run, upper, "journal_z", **look(i, 1, runs))
        plots.full_spectrum(run, lower, **look(i, 0, runs))
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


def hysteresis(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Friction moment over tilt, a panel a pad, with the work lost in a revolution."""
    last = last or 1
    pads = shown_pads(runs, pad)
    columns = min(2, len(pads))
    rows = -(-len(pads) // columns)
    fig = plt.figure(figsize=(COLUMN if columns == 1 else PAGE, 2.8 * rows))
    panels = fig.subplots(rows, columns, squeeze=False).ravel()
    for ax, k in zip(panels, pads, strict=False):
        work = []
        for i, run in enumerate(runs):
            plots.hysteresis(run, ax, k, last, **look(i, 0, runs))
            work.append(pivots.loop_area(*pivots.hysteresis(run, k, 1)))
        ax.margins(y=0.1)
        ax.locator_params(axis="x", nbins=6)
        text = ", ".join(f"{SHOWN['work'].factor * each:#.3g}" for each in work)
        ax.set_title(f"pad {k}: {text} {SHOWN['work'].unit} per revolution")
    for ax in panels[len(pads) :]:
        ax.remove()
    legend(fig, runs, [])
    return fig


def waveform(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal, tilt and tilt rate over the last revolutions."""
    last = last or 5
    pads = shown_pads(runs, pad)
    fig, panels = stacked(["journal_y", "journal_z", "pad_tilt", "pad_tilt_rate"])
    for i, run in enumerate(runs):
        for name, ax in panels.items():
            for k, p in drawn(name, pads):
                plots.waveform(run, ax, name, last, pad=p, **look(i, k, runs))
    longest = max(np.ptp(signals.revolutions(run, signals.last_revolutions(run, last))) for run in runs)
    for ax in panels.values():
        ax.set_xlim(0, longest)
    if len(runs) == 1:
        part = signals.last_revolutions(runs[0], last)
        turns = signals.revolutions(runs[0], part)
        top_axis(panels["journal_y"], turns - turns[0], runs[0].values("time", part), SHOWN["time"].label)
    legend(fig, runs, parts([f"pad {p}" for p in pads], runs))
    return fig


def runup(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Journal and tilt over the whole run, with the speed along the top where it changes."""
    pads = shown_pads(runs, pad)
    fig, panels = stacked(["journal_y", "journal_z", "pad_tilt"])
    for i, run in enumerate(runs):
        for name, ax in panels.items():
            for k, p in drawn(name, pads):
                plots.history(run, ax, name, pad=p, **look(i, k, runs))
    ends = {tuple(run.values("time")[[0, -1]]) + tuple(run.values("speed")[[0, -1]]) for run in runs}
    for ax in panels.values():
        ax.set_xlim(min(end[0] for end in ends), max(end[1] for end in ends))
    if len(ends) == 1:
        start, stop, first, final = ends.pop()
        if first != final:
            speed = SHOWN["speed"].factor * np.array([first, final])
            top_axis(panels["journal_y"], np.array([start, stop]), speed, SHOWN["speed"].label)
    legend(fig, runs, parts([f"pad {p}" for p in pads], runs))
    return fig


FIGURES = {each.__name__: each for each in (orbit, spectrum, hysteresis, waveform, runup)}


def labels(runs: Sequence[Run]) -> list[str]:
    """Names to tell runs apart: their titles, else what differs in their inputs, else their files."""
    titles = [run.title for run in runs]
    stems = [Path(run.path).stem for run in runs]
    for texts in (titles, namelist.differences([run.input for run in runs]), stems):
        if all(0 < len(text) <= LONGEST_LABEL for text in texts) and len(set(texts)) == len(runs):
            return texts
    return [run.path for run in runs]


def look(run: int, part: int | None, runs: Sequence[Run]) -> dict[str, Any]:
    """Colour and dashes of a line: colours tell parts (y, z; pads) of one run apart, or else runs."""
    if len(runs) == 1:
        return {"color": "0.2" if part is None else f"C{part}"}
    return {"color": f"C{run}", "linestyle": DASHES[(part or 0) % len(DASHES)]}


def parts(texts: Sequence[str], runs: Sequence[Run]) -> list[tuple[str, dict[str, Any]]]:
    """Legend entries of the parts of every run; none where there is one part."""
    neutral = {"color": "0.3"} if len(runs) > 1 else {}
    return [(text, look(0, k, runs) | neutral) for k, text in enumerate(texts) if len(texts) > 1]


def legend(fig: Figure, runs: Sequence[Run], marks: Sequence[tuple[str, dict[str, Any]]]) -> None:
    """Above the panels: the runs (of one run its title), and what the lines and marks are."""
    names = labels(runs) if len(runs) > 1 else [runs[0].title]
    # a dollar sign is one, not the start of a formula
    names = [textwrap.fill(name.replace("$", r"\$"), width(fig)) for name in names]
    entries, title = [*marks], names[0]
    if len(runs) > 1:
        entries, title = [*((name, {"color": f"C{i}"}) for i, name in enumerate(names)), *marks], ""
    if not entries:
        fig.suptitle(title)
        return
    handles = [Line2D([], [], label=text, **style) for text, style in entries]
    longest = max(len(line) for text, _ in entries for line in text.splitlines())
    columns = max(1, width(fig) // (longest + 6))
    fig.legend(handles=handles, title=title or None, loc="outside upper center", ncols=columns)
    lines = len(title.splitlines()) + sum(len(text.splitlines()) for text, _ in entries) / columns
    fig.set_figheight(fig.get_figheight() + 0.15 * max(0, lines - 1))


def width(fig: Figure) -> int:
    """Characters that fit beside each other."""
    return int(15 * fig.get_figwidth())


def shown_pads(runs: Sequence[Run], pad: int | None) -> list[int]:
    """The pad asked for, or all pads that every run has."""
    if pad is None:
        return list(range(1, min(run.pads for run in runs) + 1))
    for run in runs:
        signals.pad_column(run, pad)
    return [pad]


def drawn(name: str, pads: Sequence[int]) -> Iterable[tuple[int | None, int | None]]:
    """Number among the parts and pad of every line of a dataset; nothing of both for the journal."""
    return enumerate(pads) if name.startswith("pad") else [(None, None)]


def stacked(names: Sequence[str]) -> tuple[Figure, dict[str, Axes]]:
    """Panels above each other that share the horizontal axis, one a dataset."""
    fig = plt.figure(figsize=(COLUMN, 0.6 + 1.2 * len(names)))
    panels = fig.subplots(len(names), 1, sharex=True)
    fig.align_ylabels(panels)
    for ax in panels[:-1]:
        ax.xaxis.label.set_visible(False)
    panels[-1].locator_params(axis="x", nbins=6)
    return fig, dict(zip(names, panels, strict=True))


def mark_enlarged(whole: Axes, part: Axes) -> None:
    """Frames in `whole` what `part`, to its right, enlarges, and leads from one to the other."""
    part.figure.draw_without_rendering()  # equal axes settle their limits when drawn
    (left, right), (low, high) = part.get_xlim(), part.get_ylim()
    line = {"edgecolor": "0.65", "linewidth": 0.6, "in_layout": False}
    whole.add_patch(Rectangle((left, low), right - left, high - low, facecolor="none", **line))
    for y, corner in ((low, (0, 0)), (high, (0, 1))):
        whole.add_artist(ConnectionPatch((right, y), corner, whole.transData, part.transAxes, **line))


def order_axis(ax: Axes, frequency: float, step: int) -> None:
    """Along the top: frequency over shaft frequency."""
    top = ax.secondary_xaxis("top", functions=(lambda x: x / frequency, lambda x: x * frequency))
    top.set_xlabel("order (multiples of shaft speed)")
    top.xaxis.set_major_locator(plt.MultipleLocator(step))


def top_axis(ax: Axes, x: np.ndarray, value: np.ndarray, label: str) -> None:
    """Along the top: what `value` is at x, straight on beyond the ends; both rise or fall throughout."""
    x, value = (np.concatenate([[2 * a[0] - a[1]], a, [2 * a[-1] - a[-2]]]) for a in (x, value))
    order = np.argsort(value)
    functions = (lambda at: np.interp(at, x, value), lambda at: np.interp(at, value[order], x[order]))
    ax.secondary_xaxis("top", functions=functions).set_xlabel(label)
