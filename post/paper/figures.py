"""Counterparts of the paper's figures that are drawn from runs."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tiltpad.draw.layout import PAGE, top_axis
from tiltpad.files.units import SHOWN

from paper import settings
from paper.measures import of_pad, speed_window, stribeck_curve
from paper.runs import Runs

#: Words of the legend, the run, and what its line looks like.
Line = tuple[str, tiltpad.Run, dict[str, Any]]
VELOCITY = "sliding velocity (mm/s)"
TILTS = ("pad_tilt", "pad_tilt_rate")


def figure_7(runs: Runs) -> Figure:
    """Tilt rate for several critical velocities."""
    lines = [(f"$v_c$ = {scientific(text)} m/s", runs[name]) for text, name in settings.VELOCITIES.items()]
    return tilt_rates(lines)


def figure_8(runs: Runs) -> Figure:
    """Tilt rate for several bristle stiffnesses."""
    named = ((f"$\\sigma_0$ = {scientific(text)} 1/m", name) for text, name in settings.STIFFNESSES.items())
    return tilt_rates([(text, runs[name]) for text, name in named])


def figure_9(runs: Runs) -> Figure:
    """Tilting-only against tilting-radial pads, without and with friction."""
    lines = []
    for color, motion in enumerate(("TO", "TR")):
        for dashes, friction, end in (("--", "frictionless", ""), ("-", "friction", "_ba")):
            run = runs[f"steady_{motion.lower()}{end}"]
            lines.append((f"{motion}, {friction}", run, {"color": f"C{color}", "linestyle": dashes}))
    fig, axes = panels(1)
    orbit_tilt_rate(axes[0], lines)
    return legend(fig, lines)


def figure_10(runs: Runs) -> Figure:
    """Radius differences, without friction above and with it below."""
    fig, axes = panels(2)
    for row, title in enumerate(("frictionless", "Bengisu-Akay, $f$ = 0.1")):
        lines = [("TO", runs[settings.TILTING_ONLY[row]], {"color": "0.5", "linestyle": "--"})]
        for color, (text, names) in enumerate(settings.DIFFERENCES.items()):
            lines.append((f"$\\Delta R$ = {text} µm", runs[names[row]], {"color": f"C{color}"}))
        orbit_tilt_rate(axes[row], lines)
        axes[row][1].set_title(title)
    return legend(fig, lines)


def friction_pairs(runs: Runs, model: str) -> Figure:
    """Orbit, tilt rate and hysteresis for the friction pairs of one model."""
    fig, (axes,) = panels(1)
    pairs = enumerate(zip(settings.PAIRS, settings.MODELS[model], strict=True))
    lines = [(f"$f_s/f_d$ = {pair}", runs[name], {"color": f"C{color}"}) for color, (pair, name) in pairs]
    for _, run, look in lines:
        part = tiltpad.last_revolutions(run, 1)
        trajectory(run, axes[0], part, **look)
        tiltpad.plots.waveform(run, axes[1], "pad_tilt_rate", 1, settings.PAD, **look)
        tilt, moment = of_pad(run, "pad_tilt", part), of_pad(run, "friction_moment", part)
        axes[2].plot(SHOWN["pad_tilt"].factor * tilt, moment, **look)
    axes[2].set(xlabel=SHOWN["pad_tilt"].label, ylabel=SHOWN["friction_moment"].label)
    return legend(fig, lines)


def figure_14(runs: Runs) -> Figure:
    """Friction coefficient over sliding velocity, a panel a model."""
    fig, (axes,) = panels(1)
    for (model, names), ax in zip(settings.MODELS.items(), axes, strict=True):
        for color, (pair, name) in enumerate(zip(settings.PAIRS, names, strict=True)):
            run = runs[name]
            velocity, coefficient = tiltpad.friction_coefficient(run, settings.PAD, 1)
            ax.plot(1e3 * velocity, coefficient, color=f"C{color}", label=f"$f_s/f_d$ = {pair}")
            span = np.abs(velocity).max()
            steady = np.concatenate([-np.geomspace(span, 1e-9, 300), np.geomspace(1e-9, span, 300)])
            look = {"color": "black", "linestyle": ":", "linewidth": 0.7}
            (line,) = ax.plot(1e3 * steady, stribeck_curve(run, steady), **look)
        line.set_label("steady law")
        ax.set(title=named(model), xlabel=VELOCITY)
        ax.locator_params(axis="x", nbins=5)
        ax.sharey(axes[0])
    axes[0].set_ylabel(r"friction coefficient $M_f/(F_{bs} R_1)$")
    fig.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=5)
    return fig


def figure_15(runs: Runs) -> Figure:
    """Run-up: the whole of it, and revolutions at low and at high speed."""
    fig, axes = panels(3)
    runups = enumerate(settings.RUNUPS.items())
    lines = [(named(model), runs[name], {"color": f"C{i}"}) for i, (model, name) in runups]
    for ax, name in zip(axes[0][1:], TILTS, strict=True):
        for _, run, look in lines:
            tiltpad.plots.history(run, ax, name, settings.PAD, **look)
        speed = SHOWN["speed"].factor * run.values("speed")[[0, -1]]
        top_axis(ax, run.time[[0, -1]], speed, SHOWN["speed"].label)
    trajectory(lines[0][1], axes[0][0], slice(None, None, 4), linewidth=0.2, color="0.85")
    for _, run, look in lines:
        axes[0][0].plot(*(SHOWN["journal_y"].factor * each for each in orbit_centres(run)), **look)
    axes[0][0].set_title("centres of the orbits")
    for row, rpm in ((1, settings.LOW_SPEED), (2, settings.HIGH_SPEED)):
        for _, run, look in lines:
            part = speed_window(run, rpm, settings.DETAIL)
            trajectory(run, axes[row][0], part, **look)
            turns = tiltpad.revolutions(run, part)
            for ax, name in zip(axes[row][1:], TILTS, strict=True):
                ax.plot(turns - turns[0], SHOWN[name].factor * of_pad(run, name, part), **look)
                ax.set(xlabel="shaft revolutions", ylabel=SHOWN[name].label, xlim=(0, settings.DETAIL))
        axes[row][1].set_title(f"from {rpm} rpm" if rpm < settings.HIGH_SPEED else f"up to {rpm} rpm")
    return legend(fig, lines)


def figure_pads(runs: Runs) -> Figure:
    """Four pads against two: orbit, tilt of the upper pads, and their pivot load."""
    fig, (axes,) = panels(1)
    two, four = runs["two_pads"], runs["four_pads"]
    lines = [("two pads", two, {"color": "C0"}), ("four pads", four, {"color": "C1", "linestyle": "--"})]
    for _, run, look in lines:
        # two revolutions, as the flutter repeats after two
        trajectory(run, axes[0], tiltpad.last_revolutions(run, 2), **look)
    for pad, color in ((1, "C1"), (3, "C2"), (4, "C3")):
        look = {"color": color}
        for ax, name in zip(axes[1:], ("pad_tilt", "pivot_load"), strict=True):
            tiltpad.plots.waveform(four, ax, name, 5, pad, **look)
        lines.append((f"pad {pad} of four" + (" (upper)" if pad > 2 else ""), four, look))
    return legend(fig, lines, 5)


#: Pictures of this module by the paper's numbers.
FIGURES = {
    name.partition("_")[2]: draw for name, draw in list(globals().items()) if name.startswith("figure_")
} | {str(11 + k): partial(friction_pairs, model=model) for k, model in enumerate(settings.MODELS)}


def tilt_rates(lines: Sequence[tuple[str, tiltpad.Run]]) -> Figure:
    """Tilt rates of the first pad over a revolution, the frictionless amplitude told by the runs alone."""
    fig, ax = plt.subplots(figsize=(PAGE / 2 + 1, 2.7))
    for color, (text, run) in enumerate(lines):
        tiltpad.plots.waveform(run, ax, "pad_tilt_rate", 1, settings.PAD, color=f"C{color}", label=text)
    ax.set_ylabel(f"{SHOWN['pad_tilt_rate'].text} of pad {settings.PAD} ({SHOWN['pad_tilt_rate'].unit})")
    fig.legend(loc="outside upper center", ncols=3)
    return fig


def orbit_tilt_rate(axes: Sequence[Axes], lines: Sequence[Line]) -> None:
    """Orbit, tilt and tilt rate of the first pad over a revolution."""
    for _, run, look in lines:
        trajectory(run, axes[0], tiltpad.last_revolutions(run, 1), **look)
        for ax, name in zip(axes[1:], TILTS, strict=True):
            tiltpad.plots.waveform(run, ax, name, 1, settings.PAD, **look)


def trajectory(run: tiltpad.Run, ax: Axes, part: slice, **look: Any) -> None:
    """Path of the journal, axes equal."""
    shown = SHOWN["journal_y"]
    ax.plot(*(shown.factor * run.values(f"journal_{axis}", part) for axis in "zy"), **look)
    ax.set(xlabel=SHOWN["journal_z"].label, ylabel=shown.label, box_aspect=1)
    ax.set_aspect("equal", adjustable="datalim")


def orbit_centres(run: tiltpad.Run) -> tuple[np.ndarray, np.ndarray]:
    """Mean z and y of every revolution, each (revolution,), m."""
    turns = tiltpad.revolutions(run)
    starts = np.searchsorted(turns, np.arange(np.floor(turns[-1]) + 1))
    means = (np.add.reduceat(run["journal_" + axis], starts)[:-1] / np.diff(starts) for axis in "zy")
    return tuple(means)


def panels(rows: int) -> tuple[Figure, Any]:
    """Rows of three panels across a page."""
    return plt.subplots(rows, 3, squeeze=False, figsize=(PAGE, 0.4 + 2.2 * rows))


def legend(fig: Figure, lines: Sequence[Line], columns: int = 4) -> Figure:
    """The lines above the panels."""
    handles = [plt.Line2D([], [], label=text, **look) for text, _, look in lines]
    fig.legend(handles=handles, loc="outside upper center", ncols=columns)
    return fig


def named(model: str) -> str:
    """A model's name, with the bristles' stiffness in full."""
    name, _, stiffness = model.partition(" ")
    return f"{name}, $\\sigma_0$ = {scientific(stiffness)} 1/m" if stiffness else name


def scientific(text: str) -> str:
    """5e-6 as in print."""
    digits, _, power = text.partition("e")
    times = "" if digits == "1" else rf"{digits} \cdot "
    return rf"${times}10^{{{int(power)}}}$"
