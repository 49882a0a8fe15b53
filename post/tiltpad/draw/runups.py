"""Pictures of run-ups: the whole run, orders, waterfall, and the size of the orbit over speed or a number."""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tiltpad.calculate import differences, signals, spectra
from tiltpad.calculate.response import Peak, aligned, peaks_of
from tiltpad.calculate.rotation import sense
from tiltpad.draw import layout, plots
from tiltpad.draw.branches import in_words as critical
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN, in_words, literal

#: Orders whose amplitudes are drawn.
ORDERS = (1, 2, 3)
#: From where the phase is counted.
PHASE = (
    "Phase lag: the shaft turns by this angle from where the unbalance points along +y to where the journal "
    "is farthest along the axis. Forward whirl has z a quarter turn behind y, or ahead of y where the shaft "
    "turns anticlockwise."
)


def highest(speed: np.ndarray, values: np.ndarray) -> Peak | None:
    """The highest peak of values, (n,), over the speed, (n,), rad/s; None where they only rise or fall."""
    order = np.argsort(speed)
    speed, values = SHOWN["speed"].factor * speed[order], values[order]
    found = peaks_of("", speed, speed, values) if len(speed) > 2 else []
    return max(found, key=lambda peak: peak.amplitude, default=None)


def mark_peak(ax: Axes, speed: np.ndarray, values: np.ndarray, quantity: str, color: str) -> str:
    """Draws a ring around the highest peak; gives its height, speed and amplification factor in words."""
    peak = highest(speed, values)
    if peak is None:
        return "no peak inside the range of the speed"
    ring = {"marker": "o", "markersize": 4, "markerfacecolor": "none", "linestyle": ""}
    ax.plot(peak.speed_rpm, SHOWN[quantity].factor * peak.amplitude, color=color, **ring)
    return f"peak {in_words(quantity, [peak.amplitude])} at {critical(peak)}"


@layout.of_several
def runup(runs: Sequence[Run], pad: int | None = None) -> Figure:
    """Journal, tilt (unless pads are fixed) and film over the whole run, with the speed where it changes.

    Where slopes count, the films at both ends stand for the film, and pads that pitch have their pitch.
    Marks along the bottom say where asperities touch the journal.
    """
    pads = layout.shown_pads(runs, pad)
    tilts = ["pad_tilt"] if plots.all_tilt(runs) else []
    films = plots.of_slopes(runs) or ("min_film_thickness",)
    fig, panels = layout.stacked(["journal_y", "journal_z", *tilts, *films])
    for i, run in enumerate(runs):
        for name, ax in panels.items():
            for k, p in layout.drawn(run, name, pads):
                plots.history(run, ax, name, pad=p, **layout.look(i, k, runs))
    ends = {(*signals.ends(run, "time"), *signals.ends(run, "speed")) for run in runs}
    plots.label_films(panels)
    for ax in panels.values():
        ax.set_xlim(min(end[0] for end in ends), max(end[1] for end in ends))
    if len(ends) == 1:
        start, stop, first, final = ends.pop()
        if first != final:
            speed = SHOWN["speed"].factor * np.array([first, final])
            layout.top_axis(panels["journal_y"], np.array([start, stop]), speed, SHOWN["speed"].label)
    layout.legend(fig, runs, layout.parts([f"pad {p}" for p in pads], runs))
    return fig


@layout.of_several
def orders(runs: Sequence[Run], pad: int | None = None, scale: str = "linear") -> Figure:
    """Amplitudes of the first three orders over the speed of run-ups, with the peak and phase of the first.

    `scale` of the amplitudes is linear or log.
    """
    names = [("journal_y", None), ("journal_z", None), *([("pad_tilt", pad)] if pad else [])]
    fig, panels = layout.stacked([*names, "phase"])
    words: dict[Any, list[str]] = {each: [] for each in names}
    for i, run in enumerate(runs):
        lags = []
        for name, column in names:
            ax = panels[name, column]
            speed, amplitudes, phases = spectra.order_tracks(run, name, ORDERS, column)
            tracks = [(speed, *own) for own in zip(amplitudes.T, phases.T, strict=True)]
            for k, track in enumerate(tracks):
                plots.order_track(run, ax, name, ORDERS[k], column, scale, track, **layout.look(i, k, runs))
            words[name, column].append(mark_peak(ax, *tracks[0][:2], name, layout.look(i, 0, runs)["color"]))
            lags.append(-tracks[0][2])
        lag = aligned(np.column_stack(lags[:2]), sense(run.input))
        for k, (name, _) in enumerate(names[:2]):
            own = layout.look(i, 0, runs) | {"linestyle": layout.DASHES[k]}
            plots.order_phase(run, panels["phase"], name, track=(speed, lag[:, k], -lag[:, k]), **own)
    for name, column in names:
        ax = panels[name, column]
        if len(runs) <= 2:
            ax.set_title("; ".join(words[name, column]), fontsize="x-small", loc="right")
        ax.set_ylabel(SHOWN[name].label + (f", pad {column}" if column else ""))
    panels["phase"].set_ylabel("phase lag,\norder 1 (deg)")
    dashes = {"y": layout.DASHES[0], "z": layout.DASHES[1]}
    dashed = [(f"phase of ${y}$", {"color": "0.3", "linestyle": each}) for y, each in dashes.items()]
    layout.legend(fig, runs, [*layout.parts([f"order {order}" for order in ORDERS], runs), *dashed])
    layout.remark(fig, PHASE)
    return fig


@layout.of_several
def waterfall(
    runs: Sequence[Run],
    pad: int | None = None,
    orders: float | None = None,
    by: str = "frequency",
    decades: float = 3,
) -> Figure:
    """Amplitudes over speed and frequency of run-ups: a column of y and z each (with a pad: its tilt).

    `by` is frequency or order, `orders` the highest order, `decades` how far down the colours reach.
    """
    names = ["pad_tilt"] if pad else ["journal_y", "journal_z"]
    alone = len(runs) == 1
    figsize = (layout.COLUMN if alone else layout.PAGE, 0.5 + 2.1 * len(names))
    fig, panels = plt.subplots(len(names), len(runs), squeeze=False, sharex=alone, figsize=figsize)
    for column, run, label in zip(panels.T, runs, layout.labels(runs), strict=True):
        for ax, name in zip(column, names, strict=True):
            plots.waterfall(run, ax, name, pad, orders or 5, by, decades)
        if len(runs) > 1:
            column[0].set_title(literal(label), wrap=True)
    if len(runs) == 1:
        layout.legend(fig, runs, [])
        for ax in panels[:-1, 0]:
            ax.xaxis.label.set_visible(False)
    return fig


@layout.of_several
def size(runs: Sequence[Run], last: float | None = None) -> Figure:
    """Peak-to-peak of y and z of the journal.

    They are drawn over the speed if a run is a run-up (without the drift of the mean), over a number of the
    input if runs differ in it alone, and otherwise as bars.
    """
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 2.6))
    coordinates = ("journal_y", "journal_z")
    if not all(signals.steady(run) for run in runs):
        found = []
        for i, run in enumerate(runs):
            for k, name in enumerate(coordinates):
                plots.orbit_size(run, ax, name, last, **layout.look(i, k, runs))
                if not signals.steady(run):
                    color = layout.look(i, k, runs)["color"]
                    found.append(mark_peak(ax, *signals.swing(run, name), "size", color))
        ax.set_ylim(bottom=0)
        for axis, each in zip("yz", found if len(runs) == 1 else (), strict=False):
            layout.remark(fig, f"{axis}: {each}")
        layout.legend(fig, runs, layout.parts(["$y$", "$z$"], runs))
        return fig
    sizes = SHOWN["size"].factor * np.array([signals.orbit_size(run, last) for run in runs]).T
    varied = differences.varied([run.input for run in runs])
    dashes = ["-", "--" if varied else "-"]
    if varied:
        label, values = varied
        order = np.argsort(values)
        for each, own in zip(sizes, dashes, strict=True):
            ax.plot(np.array(values)[order], each[order], own, **layout.dots(len(order)))
        ax.set(xlabel=label, ylabel=SHOWN["size"].label, ylim=(0, 1.1 * sizes.max()))
        ax.locator_params(axis="x", nbins=6)
    else:
        place = np.arange(len(runs))
        names = layout.labels(runs) if len(runs) > 1 else [layout.title(runs)]
        for k, each in enumerate(sizes):
            ax.barh(place + 0.4 * k, each, 0.38)
        few = slice(None, None, 1 + len(runs) // 40)  # names of all would lie on each other
        ax.set_yticks(place[few] + 0.2, [layout.plain(name, 24) for name in names[few]])
        ax.grid(visible=False, axis="y")
        ax.invert_yaxis()
        ax.set(xlabel=SHOWN["size"].label)
        fig.set_figheight(1.2 + min(0.4 * len(runs), 9))
    entries = [{"color": f"C{k}", "linestyle": each} for k, each in enumerate(dashes)]
    layout.heading(fig, [*zip(("$y$", "$z$"), entries, strict=True)], "")
    return fig
