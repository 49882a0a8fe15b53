"""Draws the model with its symbols: frames, angles, geometry of a pad, clearances.

usage: model_picture.py PICTURE.png
"""

import sys
from math import cos, radians, sin

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrowPatch, Polygon
from tiltpad.draw.layout import PAGE
from tiltpad.draw.plots import STYLE

#: The bearing that is drawn: lengths over the journal's radius, clearances many times as large as they are.
JOURNAL, ASSEMBLED, MACHINED, DISTANCE, THICKNESS, BALL = 1.0, 0.22, 0.42, 0.30, 0.30, 0.16
THETA, BEFORE, AFTER = -48.0, 40.0, 28.0  # degrees: pivot, leading and trailing part of the arc
PAD, PIVOT, INK, DIMENSION = "#d9e2ec", "0.55", "0.15", "C3"


def outward(angle: float) -> np.ndarray:
    """The direction at an angle in degrees from +z towards +y, as (z, y) of the picture."""
    return np.array([cos(radians(angle)), sin(radians(angle))])


def arc(centre: np.ndarray, radius: float, first: float, last: float) -> np.ndarray:
    """Points of an arc, (n, 2), from one angle to another."""
    return centre + radius * np.array([outward(angle) for angle in np.linspace(first, last, 90)])


def pad(ax: Axes, theta: float) -> tuple[np.ndarray, np.ndarray]:
    """A pad at rest on its pivot; gives the pivot and the centre of its bore."""
    pivot = (JOURNAL + ASSEMBLED + DISTANCE) * outward(theta)
    bore = JOURNAL + MACHINED
    centre = pivot - (bore + DISTANCE) * outward(theta)
    inner = arc(centre, bore, theta + BEFORE, theta - AFTER)
    outer = arc(centre, bore + THICKNESS, theta - AFTER, theta + BEFORE)
    ax.add_patch(Polygon(np.concatenate([inner, outer]), facecolor=PAD, edgecolor=INK, linewidth=1))
    ax.add_patch(Circle(pivot + BALL * outward(theta), BALL, facecolor=PIVOT, edgecolor=INK, linewidth=0.8))
    return pivot, centre


def arrow(ax: Axes, start: np.ndarray, end: np.ndarray, color: str = INK, ends: str = "-|>") -> None:
    style = {"arrowstyle": ends, "mutation_scale": 8, "shrinkA": 0, "shrinkB": 0, "linewidth": 0.9}
    ax.add_patch(FancyArrowPatch(start, end, color=color, zorder=6, **style))


def turning(ax: Axes, points: np.ndarray, color: str = DIMENSION, both: bool = False) -> None:
    """An arc with an arrow at its end, or at both."""
    ax.plot(*points.T, color=color, linewidth=0.9, zorder=6)
    arrow(ax, points[-4], points[-1], color)
    if both:
        arrow(ax, points[3], points[0], color)


def write(ax: Axes, at: np.ndarray, text: str, color: str = INK, **options) -> None:
    look = {"ha": "center", "va": "center", "fontsize": 9, "zorder": 7} | options
    ax.text(*at, text, color=color, **look)


def whole(ax: Axes) -> None:
    """The bearing: frame, rotation, load, pivot angle, arcs."""
    for theta in (THETA, THETA + 120, THETA + 240):
        pivot, _ = pad(ax, theta)
    pivot = (JOURNAL + ASSEMBLED + DISTANCE) * outward(THETA)
    ax.add_patch(Circle((0, 0), JOURNAL, facecolor="white", edgecolor=INK, linewidth=1.2))
    arrow(ax, np.zeros(2), np.array([0, 0.66]))
    arrow(ax, np.zeros(2), np.array([0.66, 0]))
    write(ax, np.array([0.12, 0.62]), "$y$")
    write(ax, np.array([0.66, 0.11]), "$z$")
    turning(ax, arc(np.zeros(2), 0.84, 140, 100), INK)
    write(ax, 0.62 * outward(138), "$\\omega$")
    arrow(ax, np.array([-0.5, 0.15]), np.array([-0.5, -0.6]), "C0")
    write(ax, np.array([-0.62, -0.2]), "$W$", "C0")
    line = {"color": "0.5", "linewidth": 0.7, "linestyle": "--"}
    ax.plot(*np.array([np.zeros(2), 1.28 * pivot]).T, **line)
    turning(ax, arc(np.zeros(2), 0.36, 0, THETA))
    write(ax, 0.52 * outward(THETA / 2), "$\\theta$", DIMENSION)
    write(ax, 2.1 * outward(THETA), "pivot", fontsize=8)
    write(
        ax,
        np.array([0, -2.1]),
        "clockwise rotation, from $+y$ to $+z$;\n$\\theta$ counts from $+z$ towards $+y$: here $\\theta < 0$",
        fontsize=8,
    )


def one_pad(ax: Axes) -> None:
    """One pad, its pivot below: geometry and the frame of the pad."""
    theta = -90.0
    pivot, centre = pad(ax, theta)
    down = outward(theta)
    line = {"color": "0.5", "linewidth": 0.7, "linestyle": "--", "zorder": 1}
    ax.add_patch(Circle((0, 0), JOURNAL, facecolor="white", edgecolor=INK, linewidth=1.2))
    ax.plot(
        *arc(np.zeros(2), JOURNAL + ASSEMBLED, theta - 75, theta + 75).T,
        color="0.6",
        linewidth=0.7,
        linestyle=":",
    )
    for at, text, side in ((np.zeros(2), "$O$", 0.1), (centre, "centre of\nthe bore", 0.3)):
        ax.plot(*at, "o", color=INK, markersize=3, zorder=7)
        write(ax, at + [-side, 0.05], text, fontsize=8)
    bore = JOURNAL + MACHINED
    for angle in (theta + BEFORE, theta - AFTER):
        ax.plot(*np.array([centre, centre + (bore + 0.1) * outward(angle)]).T, **line)
    ax.plot(*np.array([centre, pivot]).T, **line)
    # the arc, which is counted from the pivot against the motion of the journal's surface
    turning(ax, arc(centre, 0.62, theta, theta + BEFORE))
    write(ax, centre + 0.75 * outward(theta + 0.5 * BEFORE), "$\\theta_1$", DIMENSION)
    turning(ax, arc(centre, 0.5, theta, theta - AFTER))
    write(ax, centre + 0.64 * outward(theta - 0.5 * AFTER), "$\\theta_2$", DIMENSION)
    write(ax, centre + (bore + 0.56) * outward(theta + BEFORE + 4), "leading\nedge", fontsize=8)
    write(ax, centre + (bore + 0.56) * outward(theta - AFTER - 4), "trailing\nedge", fontsize=8)
    # radii and clearances
    arrow(ax, np.zeros(2), JOURNAL * outward(195), DIMENSION)
    write(ax, 0.6 * outward(207), "$R_J$", DIMENSION)
    arrow(ax, centre, centre + bore * outward(theta + 24), DIMENSION)
    write(ax, centre + 1.12 * outward(theta + 32), "$R$", DIMENSION)
    arrow(ax, JOURNAL * down, (JOURNAL + ASSEMBLED) * down, DIMENSION, "<|-|>")
    write(ax, (JOURNAL + 0.5 * ASSEMBLED) * down + [-0.14, 0], "$c_r$", DIMENSION)
    arrow(ax, (JOURNAL + ASSEMBLED) * down, pivot, DIMENSION, "<|-|>")
    write(ax, pivot + [-0.12, 0.5 * DISTANCE], "$\\kappa$", DIMENSION)
    write(ax, pivot + [0.66, -0.42], "pivot deflection $\\eta$:\nthe pad moves out", fontsize=8)
    # the frame of the pad, and its tilt
    arrow(ax, pivot, pivot + [0.62, 0])
    write(ax, pivot + [0.62, -0.12], "$y'$")
    arrow(ax, pivot, pivot + [0, -0.55])
    write(ax, pivot + [-0.12, -0.52], "$z'$")
    turning(ax, arc(pivot, 0.42, -102, -128), "C2")
    write(ax, pivot + 0.52 * outward(-118), "$\\delta$", "C2")
    turning(ax, arc(np.zeros(2), 0.84, 100, 60), INK)
    write(ax, 0.66 * outward(82), "$\\omega$")


def clearances(ax: Axes) -> None:
    """The gap along the arc, and what the clearances and the preload do to it."""
    phi = np.linspace(-AFTER, BEFORE, 200)
    offset = MACHINED - ASSEMBLED
    gap = MACHINED - offset * np.cos(np.radians(phi))
    ax.plot(phi, np.zeros_like(phi), color=INK, linewidth=1.2)
    ax.plot(phi, gap, color=INK, linewidth=1.2)
    ax.fill_between(phi, gap, 0.36, facecolor=PAD)
    tilted = gap + 0.0012 * phi
    ax.plot(phi, tilted, color="C2", linewidth=1, linestyle="--")
    write(ax, np.array([26, 0.305]), "tilt $\\delta > 0$", "C2", fontsize=8)
    arrow(ax, np.array([0, 0]), np.array([0, ASSEMBLED]), DIMENSION, "<|-|>")
    write(ax, np.array([2, 0.1]), "$c_r$", DIMENSION)
    arrow(ax, np.array([-16, 0]), np.array([-16, gap[np.argmin(abs(phi + 16))]]), DIMENSION, "<|-|>")
    write(ax, np.array([-13, 0.1]), "$h(\\varphi)$", DIMENSION)
    arrow(ax, np.array([32, 0.035]), np.array([12, 0.035]))
    write(ax, np.array([22, 0.06]), "journal surface", fontsize=8)
    ax.set(xlim=(-AFTER - 3, BEFORE + 3), ylim=(-0.03, 0.38), yticks=[], xticks=[-AFTER, 0, BEFORE])
    ax.set_xticklabels(
        ["trailing edge\n$\\varphi=-\\theta_2$", "pivot\n$\\varphi=0$", "leading edge\n$\\varphi=\\theta_1$"]
    )
    ax.invert_xaxis()
    ax.grid(visible=False)
    ax.set_title("gap along the pad: $c_m = R - R_J$, preload $m = 1 - c_r/c_m$", fontsize=9)


def main(picture: str) -> None:
    fig = plt.figure(figsize=(PAGE, 5.2))
    upper, lower = fig.subfigures(2, 1, height_ratios=(2.7, 1))
    panels = upper.subplots(1, 2)
    for ax, draw, limits in zip(panels, (whole, one_pad), ((-2.35, 1.95), (-2.1, 1.05)), strict=True):
        draw(ax)
        ax.set_aspect("equal")
        ax.set_axis_off()
        ax.set(ylim=limits, xlim=(-2.2, 2.2) if draw is whole else (-1.7, 1.7))
    clearances(lower.subplots())
    fig.savefig(picture, dpi=200)


if __name__ == "__main__":
    mpl.use("agg")
    with plt.style.context(STYLE):
        main(sys.argv[1])
