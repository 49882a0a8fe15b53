"""Draws the films of a run over the cells of the film table that they visit (docs/theory/film.md).

usage: cells.py RESULT.h5 PICTURE.png
"""

import sys

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from tiltpad.draw.layout import PAGE
from tiltpad.draw.plots import STYLE

#: Size of an uncut cell: each doubling of film thickness is cut into this number of parts, in the table of
#: full films and of cavitated ones, and T into these, or half of them up to a quarter.
FULL_PARTS, CAVITATED_PARTS, T_PARTS, LOADED = 2, 8, 16, 0.25


def films(run: tiltpad.Run) -> tuple[np.ndarray, np.ndarray]:
    """Film thicknesses at the leading and trailing edge over the clearance, (time, pad, edge), and T, (time,
    pad), in the last revolution; by docs/theory/film.md. T is over 1 or below 0
    where a film has gone or is whole.
    """
    bearing, pads = run.input["bearing"], run.input["pads"]
    part = tiltpad.last_revolutions(run)
    time, speed = run.values("time", part), run.values("speed", part)
    journal_radius, clearance = bearing["journal_radius"], np.array(bearing["machined_clearance"])
    pad_radius = journal_radius + clearance
    angle, distance = (np.array(pads[name]) for name in ("pivot_angle_deg", "pivot_distance"))
    angle, half_arc = np.radians(angle), 0.5 * np.radians(pads["arc_deg"])
    tilt = run.values("pad_tilt", part)
    out = journal_radius + run.clearance + distance + run.values("pivot_deflection", part)
    y = run.values("journal_y", part)[:, None] - out * np.sin(angle)
    z = run.values("journal_z", part)[:, None] - out * np.cos(angle)
    frame = angle - tilt
    first = y * np.cos(frame) - z * np.sin(frame)
    second = y * np.sin(frame) + z * np.cos(frame) + pad_radius + distance
    # to the middle
    lean = half_arc * (2 * np.array(pads["pivot_ratio"]) - 1)
    first, second = (
        first * np.cos(lean) - second * np.sin(lean),
        first * np.sin(lean) + second * np.cos(lean),
    )
    rate = journal_radius / (2 * pad_radius) * speed[:, None]
    along = np.gradient(first, time, axis=0) + rate * second
    outward = np.gradient(second, time, axis=0) - rate * first
    edges = [1 - (second * np.cos(half_arc) + s * first * np.sin(half_arc)) / clearance for s in (1, -1)]
    return np.stack(edges, -1), 0.5 * (1 - outward / (np.abs(along) * np.tan(half_arc)))


def cell(thickness: np.ndarray, parts: int) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper end of the cells in which thicknesses lie."""
    octave = 2.0 ** np.floor(np.log2(thickness))
    lower = octave * (1 + np.floor(parts * (thickness / octave - 1)) / parts)
    return lower, lower + octave / parts


def cell_of_share(share: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same for T."""
    number = np.floor(T_PARTS * (share + np.minimum(share, LOADED)))
    return tuple(np.maximum(t / 2, t - LOADED) for t in (number / T_PARTS, (number + 1) / T_PARTS))


def boxes(ax: Axes, x: tuple[np.ndarray, np.ndarray], y: tuple[np.ndarray, np.ndarray], **look) -> None:
    """Rectangles from lower and upper ends, each once."""
    for left, right, low, high in {*zip(*map(np.ravel, (*x, *y)), strict=True)}:
        ax.add_patch(Rectangle((left, low), right - left, high - low, edgecolor="0.6", **look))


def draw(run: tiltpad.Run) -> None:
    """Both thicknesses on the left; on the right the trailing one and T, of films that cavitate."""
    edges, share = films(run)
    lower, upper = cell(edges, FULL_PARTS)
    _, (left, right) = plt.subplots(1, 2, figsize=(PAGE, 3.2))
    cavitated = (share > 0) & (share < 1)
    boxes(left, (lower[..., 0], upper[..., 0]), (lower[..., 1], upper[..., 1]), facecolor="0.93")
    trailing_ends = cell(edges[cavitated, 1], CAVITATED_PARTS)
    boxes(right, trailing_ends, cell_of_share(share[cavitated]), facecolor="0.93")
    for i in range(share.shape[1]):
        left.plot(*edges[:, i].T, color=f"C{i}", label=f"pad {i + 1}")
        right.plot(edges[:, i, 1], share[:, i], color=f"C{i}")
    right.axhline(0, color="black", linewidth=0.8)
    trailing = "film thickness at the trailing edge / $c_m$"
    left.set(xlabel="film thickness at the leading edge / $c_m$", ylabel=trailing, title="full film")
    right.set(xlabel=trailing, ylabel="T, part of the film that diverges", title="cavitated film, T > 0")
    left.legend(loc="upper left", frameon=True)


if __name__ == "__main__":
    mpl.use("agg")
    with tiltpad.read(sys.argv[1]) as found, plt.style.context(STYLE):
        draw(found)
        plt.savefig(sys.argv[2], dpi=200)
