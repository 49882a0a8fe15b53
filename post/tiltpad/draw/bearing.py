"""A picture of the bearing itself, and a film of its motion: clearances are enlarged.

The journal is drawn with radius 1; distances from it, films and its own displacement, are as much larger as
makes the bearing clearance CLEARANCE.
"""

import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon

from tiltpad.calculate import geometry, signals
from tiltpad.calculate.geometry import Case, State
from tiltpad.calculate.rotation import sense
from tiltpad.calculate.selection import ArgumentError
from tiltpad.draw.layout import PAGE, WARMTH, plain, polar, turning_arrow, width
from tiltpad.draw.plots import STYLE
from tiltpad.files.archive import RunError
from tiltpad.files.archive import plain as printable
from tiltpad.files.read import Run, needs_run
from tiltpad.files.units import SHOWN, Shown, digits, fitted
from tiltpad.files.writing import replacing

#: Bearing clearance and thickness of the pads in the picture, over the journal's radius.
CLEARANCE, BACK = 0.16, 0.22
#: Points along the surface of a pad.
POINTS = 91
#: Frames of a movie in a second, and in a revolution of the shaft.
RATE, FRAMES = 25, 50
#: Farther from the middle than anything that is seen.
FAR = 10.0
#: An arc in degrees beside whose pivot angle the names of its edges find room.
ROOM = 30
#: What pads can do, in words.
MOTIONS = {
    **{"tilting_radial": "tilting, radially elastic", "tilting_only": "tilting", "fixed": "fixed"},
    **{"tilting_pitch": "tilting, pitching", "tilting_pitch_yaw": "tilting, pitching, yawing"},
    "tilting_radial_pitch": "tilting, pitching, radially elastic",
    "tilting_radial_pitch_yaw": "tilting, pitching, yawing, radially elastic",
}
#: How shaft and angles turn, by the sense of the shaft.
TURNING = {
    1: (
        "The shaft turns clockwise, from $+y$ to $+z$.",
        "Angles count the other way, from $+z$ to $+y$:",
        "oil enters a pad at its larger angle (leading edge).",
    ),
    -1: (
        "The shaft turns anticlockwise, from $+y$ to $-z$.",
        "Angles count the same way, from $+z$ to $+y$:",
        "oil enters a pad at its smaller angle (leading edge).",
    ),
}
#: Views of pads from the side in a row, and their height, inches; what is said of them.
SIDES, SIDE_HEIGHT = 4, 1.1
FROM_THE_SIDE = (
    "Below: the pads from the side, cut along the shaft",
    "at their pivots, with the film at both ends. Slopes",
    "and pitch are enlarged as the clearances are.",
)
NOTE = {"fontsize": "small", "color": "0.2", "ha": "center", "va": "center"}


def bearing(case: Run | Case) -> Figure:
    """Pads, pivots, load, sense of rotation and angles of a case or result, with enlarged clearances.

    A result shows the journal and the tilt of the pads at its equilibrium, or its last sample. Where films
    have slopes there, each pad is seen from the side, too.
    """
    run = case if isinstance(case, Run) else None
    groups = case.in_operation if isinstance(case, Run) else case
    if isinstance(groups["bearing"], list):
        names = ", ".join(str(each["name"]) for each in groups["bearing"])
        raise ArgumentError("a machine: choose one of its bearings by {bearing}: {names}", names=names)
    state = geometry.at_rest(run) if run else geometry.centred(groups)
    sides = side_views(groups, state)
    rows = -(-len(sides) // SIDES)
    fig = plt.figure(figsize=(PAGE, 4.4 + SIDE_HEIGHT * rows))
    upper, *lower = fig.add_gridspec(1 + min(1, rows), 1, height_ratios=(4.4, SIDE_HEIGHT * rows)[: 1 + rows])
    ax, beside = (fig.add_subplot(each) for each in upper.subgridspec(1, 2, width_ratios=(1.45, 1)))
    if sides:
        places = lower[0].subgridspec(rows, min(SIDES, len(sides)))
        for side, place in zip(sides, places, strict=False):
            side.draw(fig.add_subplot(place))
    drawing = Drawing(ax, groups, state)
    mark_angles(ax, groups)
    mark_edges(ax, drawing)
    mark_rotation(ax, sense(groups))
    mark_load(ax, groups)
    if run and run.has_film_temperatures and "equilibrium/surface_temperature" in run:
        shown = drawing.show_temperatures(run)
        fig.colorbar(shown, ax=ax, location="bottom", label="pad surfaces and shaft (°C)", shrink=0.7)
    beside.axis("off")
    text = figures_of(groups, state) + ("\n\n" + "\n".join(FROM_THE_SIDE) if sides else "")
    beside.text(0, 1, text, va="top", fontsize="small", linespacing=1.5)
    fig.suptitle(plain(str(groups["case"].get("title", "")), width(fig)))
    return fig


class SideView(NamedTuple):
    """A pad and the journal, cut along the shaft at the pivot; lengths over the journal's radius."""

    name: str
    half: float  # of the width
    films: np.ndarray  # thickness at the ends of lower and of higher x, m
    scale: float  # 1/m: that of the films
    journal: np.ndarray  # heights of its surface at both ends, outward
    pivot: float | None  # its place along the shaft; fixed pads have none
    outward: int  # 1 where this is up

    def draw(self, ax: Axes) -> None:
        """Draws it, up as in the bearing."""
        x, way = np.array([-self.half, self.half]), self.outward
        surface = way * self.journal
        inner = surface + way * self.scale * self.films
        outer = inner + way * BACK
        ax.fill_between(x, surface - way * BACK, surface, facecolor="#dbe9f6", edgecolor="C0", linewidth=0.8)
        ax.fill_between(x, inner, outer, facecolor="0.82", edgecolor="0.25", linewidth=0.8)
        if self.pivot is not None:
            back = np.interp(self.pivot, x, outer) + way * 0.045
            ax.add_patch(Circle((self.pivot, back), 0.045, facecolor="0.25", linewidth=0))
        ax.plot(x, np.zeros(2), color="0.45", linestyle=":", linewidth=0.7)
        shown = SHOWN["min_film_thickness"]
        for end, side, film in zip((-1, 1), ("right", "left"), self.films, strict=True):
            height = np.mean([surface[(end + 1) // 2], inner[(end + 1) // 2]])
            text = f"{digits(shown.factor * film, 3)} {shown.unit}"
            ax.text(1.06 * end * self.half, height, text, **NOTE | {"ha": side, "fontsize": "x-small"})
        low, high = sorted((-way * 1.5 * BACK, way * (2 * BACK + CLEARANCE)))
        ax.set(xlim=(-1.75 * self.half, 1.75 * self.half), ylim=(low, high), aspect="equal")
        axis = {"arrowprops": {"arrowstyle": "-|>", "color": "0.45", "linewidth": 0.7}}
        ax.annotate("", (1.6 * self.half, low), (1.1 * self.half, low), annotation_clip=False, **axis)
        ax.text(1.7 * self.half, low, "$x$", **NOTE)
        ax.set_title(self.name, fontsize="small")
        ax.axis("off")


def side_views(case: Case, state: State) -> list[SideView]:
    """The pads from the side where films have slopes; else none."""
    found = geometry.surfaces(case, state, POINTS)
    if not found.slope.any():
        return []
    radius, ratio = case["bearing"]["journal_radius"], geometry.of_pads(case, "pads%pivot_ratio")
    scale = CLEARANCE / geometry.of_pads(case, "bearing%assembled_clearance").min()
    outward, pitches = geometry.seen_by_pads(case, state)[1], "pitch" in case["pads"]["motion"]
    offset = geometry.of_pads(case, "pads%pivot_axial_offset") if pitches else np.zeros(len(ratio))
    fixed, views = case["pads"]["motion"] == "fixed", []
    for k, half in enumerate(geometry.half_widths(case)):
        x = np.array([-half, half])
        middle, slope = (np.interp(1 - ratio[k], np.linspace(0, 1, POINTS), each[k])
                         for each in (found.thickness, found.slope))  # fmt: skip
        name = f"pad {k + 1}: slope {1e6 * outward[k]:.0f}"
        name += f", pitch {1e6 * state.pitch[k]:.0f} µrad" if pitches else " µrad"
        up = 1 if np.sin(found.pivot[k]) > 1e-9 else -1
        films, journal = middle + slope * x, scale * outward[k] * x
        pivot = None if fixed else offset[k] / radius
        views.append(SideView(name, half / radius, films, scale, journal, pivot, up))
    return views


class Drawing:
    """Journal and pads on axes, which can be moved."""

    def __init__(self, ax: Axes, case: Case, state: State):
        self.assembled = geometry.of_pads(case, "bearing%assembled_clearance")
        self.ax = ax
        self.case, self.scale = case, CLEARANCE / self.assembled.min()
        fixed = case["pads"]["motion"] == "fixed"
        count = len(geometry.of_pads(case, "pads%pivot_angle_deg"))
        self.middles = [np.zeros((1, 2))] * count
        self.outlines = [np.zeros((2, POINTS, 2))] * count
        look = {"closed": True, "facecolor": "0.82", "edgecolor": "0.25", "linewidth": 0.8}
        self.pads = [ax.add_patch(Polygon(np.zeros((3, 2)), **look)) for _ in range(count)]
        pivots = {"radius": 0.045, "facecolor": "0.25", "linewidth": 0}
        self.pivots = [ax.add_patch(Circle((0, 0), **pivots)) for _ in range(0 if fixed else count)]
        self.journal = ax.add_patch(Circle((0, 0), 1, facecolor="#dbe9f6", edgecolor="C0", zorder=2))
        (self.centre,) = ax.plot([], [], "+", color="C0", zorder=3)
        self.numbers = [ax.text(0, 0, f"{k + 1}", **NOTE, zorder=3) for k in range(count)]
        ax.plot(0, 0, ".", color="0.4", markersize=3, zorder=3)
        reach = 1.32 + CLEARANCE + BACK
        ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
        ax.axis("off")
        self.move(state)

    def move(self, state: State) -> None:
        """Puts journal and pads where they are in a state."""
        found = geometry.surfaces(self.case, state, POINTS)
        middle = self.scale * state.journal[::-1]
        self.journal.center = middle
        self.centre.set_data(*np.reshape(middle, (2, 1)))
        for k, pad in enumerate(self.pads):
            direction = np.column_stack([np.cos(found.angle[k]), np.sin(found.angle[k])])
            inner = middle + (1 + self.scale * found.thickness[k][:, None]) * direction
            outer = inner + BACK * direction
            pad.set_xy(np.concatenate([inner, outer[::-1]]))
            # a text far away cannot be drawn
            self.middles[k] = np.clip((inner + outer) / 2, -FAR, FAR)
            self.outlines[k] = np.clip(np.stack([inner, outer]), -FAR, FAR)
            self.numbers[k].set_position(self.middles[k][len(inner) // 2])
        for k, pivot in enumerate(self.pivots):
            away = 1 + BACK + 0.045 + self.scale * (self.assembled[k] + state.pivot_deflection[k])
            pivot.center = polar(away, np.degrees(found.pivot[k]))

    def show_temperatures(self, run: Run) -> PolyCollection:
        """Colours the pads by the temperatures of their surfaces, and the journal by its own."""
        surfaces, shaft = run["equilibrium/surface_temperature"], float(run["equilibrium/shaft_temperature"])
        between = (np.arange(POINTS - 1) + 0.5) / (POINTS - 1)
        parts, warmth = [], []
        for (inner, outer), surface in zip(self.outlines, surfaces, strict=True):
            parts.append(np.stack([inner[:-1], inner[1:], outer[1:], outer[:-1]], axis=1))
            # points go from the trailing to the leading edge
            warmth.append(np.interp(between, 1 - run["film_arc"][::-1], surface[::-1]))
        look = {"cmap": WARMTH, "edgecolors": "face", "zorder": 1.5}
        shown = PolyCollection(np.concatenate(parts), array=np.concatenate(warmth), **look)
        shown.set_clim(min(shaft, surfaces.min()), max(shaft, surfaces.max()))
        self.ax.add_collection(shown)
        self.journal.set_facecolor(shown.to_rgba(shaft))
        for pad in self.pads:
            pad.set(facecolor="none", zorder=1.6)
        return shown


def mark_angles(ax: Axes, case: Case) -> None:
    """The axes, the angle of every pivot, and how angles are counted."""
    edge = 1.05 + CLEARANCE + BACK
    axis = {"arrowstyle": "-|>", "color": "0.45", "linewidth": 0.7}
    for end, name in (((0.45, 0), "$z$"), ((0, 0.45), "$y$")):
        ax.annotate("", end, (0, 0), arrowprops=axis, zorder=3)
        ax.text(*(1.2 * np.array(end)), name, **NOTE, zorder=3)
    for angle in geometry.of_pads(case, "pads%pivot_angle_deg"):
        ends = np.array([polar(edge, angle), polar(edge + 0.08, angle)]).T
        ax.plot(*ends, color="0.25", linewidth=0.8)
        ax.text(*polar(edge + 0.2, angle), f"{angle:g}°", **NOTE)
    ax.add_patch(Arc((0, 0), 0.56, 0.56, theta1=0, theta2=55, color="0.45", linewidth=0.7, zorder=3))
    ax.annotate("", polar(0.28, 62), polar(0.28, 52), arrowprops=axis, zorder=3)
    ax.text(*polar(0.43, 38), "angles", **NOTE | {"fontsize": "x-small"}, zorder=3)


def mark_edges(ax: Axes, drawing: Drawing) -> None:
    """Which edges of the first pad are the leading and the trailing one, where its angle leaves room."""
    if geometry.of_pads(drawing.case, "pads%arc_deg")[0] < ROOM:
        return
    for inside, name in ((drawing.middles[0][-5], "leading edge"), (drawing.middles[0][4], "trailing edge")):
        out = 1.32 * inside
        line = {"arrowstyle": "-", "color": "0.45", "linewidth": 0.5, "relpos": (0.5, 0.5), "shrinkA": 7}
        ax.annotate(name.replace(" ", "\n"), inside, out, arrowprops=line, **NOTE | {"fontsize": "x-small"})


def mark_rotation(ax: Axes, sense: int) -> None:
    """Clockwise (sense 1), from +y towards +z, or anticlockwise."""
    turning_arrow(ax, 0.7, (140, 102), 0.3 * sense, mutation_scale=11, color="C0", zorder=3)
    ax.text(*polar(0.47, 132), "rotation", **NOTE | {"color": "C0"}, zorder=3)


def mark_load(ax: Axes, case: Case) -> None:
    """An arrow of the force on the journal: weight and static load."""
    force = load(case)
    if (size := float(np.hypot(*force))) == 0:
        return
    way = force[::-1] / size
    arrow = {"arrowstyle": "-|>", "color": "C1", "linewidth": 1.4, "mutation_scale": 12}
    ax.annotate("", 0.8 * way, 0.25 * way, arrowprops=arrow, zorder=3)
    # beside the arrow, on the side away from the words of rotation
    side = 0.24 * np.array([-way[1], way[0]]) * (-1 if way[0] > 0.7 else 1)
    shown = fitted(Shown("load", 1e-3, "kN"), [size])
    text = f"load\n{digits(shown.factor * size, 3)} {shown.unit}"
    ax.text(*(0.52 * way + side), text, **NOTE | {"color": "C1"}, zorder=3)


def load(case: Case) -> np.ndarray:
    """The force on the journal (y, z), N: weight and static load."""
    rotor = case["rotor"]
    extra = np.asarray(rotor.get("static_load", (0, 0)), float)
    return extra - np.array([rotor["mass"] * rotor["gravity"], 0.0])


def figures_of(case: Case, state: State) -> str:
    """Sizes of the bearing, a line each, and what the picture enlarges."""
    own, pads = case["bearing"], case["pads"]
    first, last = (case["operation"][name] for name in ("speed_rpm", "final_speed_rpm"))
    sizes = ("bearing%assembled_clearance", "bearing%machined_clearance", "bearing%axial_length")
    assembled, machined, length = (geometry.of_pads(case, name) for name in sizes)
    arc, ratio = (geometry.of_pads(case, name) for name in ("pads%arc_deg", "pads%pivot_ratio"))
    fixed, count = pads["motion"] == "fixed", len(arc)
    motion = MOTIONS.get(pads["motion"], pads["motion"])
    # the surface is where 1 + CLEARANCE is, not 1 + the true ratio
    times = CLEARANCE * own["journal_radius"] / assembled.min()
    where = "the journal in the middle, pads without tilt"
    if state.time is not None or state.journal.any():
        where = "the equilibrium" if state.time is None else f"{state.time:g} s"
    lines = [
        f"{count} pad{'s' * (count > 1)}, {motion}, arc {different(arc)}°",
        f"{'anchored' if fixed else 'pivot'} at {different(ratio)} of the arc from the leading edge",
        f"speed {first:g} rpm" if first == last else f"speed {first:g} to {last:g} rpm",
        f"journal radius {1e3 * own['journal_radius']:g} mm, length {different(1e3 * length)} mm",
        f"bearing clearance $c_r$ = {different(1e6 * assembled, 4)} µm",
        f"pad clearance $c_m$ = {different(1e6 * machined, 4)} µm",
        f"preload $1 - c_r/c_m$ = {different(1 - assembled / machined, 3)}",
        "",
        f"Clearances are {times:.0f} times larger than the journal",
        f"has them. Shown: {where}.",
        "",
        *TURNING[sense(case)],
    ]
    return "\n".join(lines)


def different(values: np.ndarray, places: int | None = None) -> str:
    """The values that pads have, with as many digits: "80/90"."""
    shown = (f"{each:g}" if places is None else digits(each, places) for each in np.unique(values).tolist())
    return "/".join(dict.fromkeys(shown))


def movie(run: Run, path: str | Path, last: float | None = None) -> None:
    """Writes an animation of journal and pads over the last revolutions (2), .gif or .mp4.

    An MP4 needs the program ffmpeg. A frame turns the shaft by 1/FRAMES of a revolution.
    """
    from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter  # no other picture needs it

    needs_run(run)
    path = Path(path)
    mp4 = path.suffix.lower() == ".mp4"
    if mp4 and not FFMpegWriter.isAvailable():
        raise ValueError(
            f"{path}: an MP4 needs the program ffmpeg, which is not on PATH: install it "
            "(apt install ffmpeg), or take a name that ends in .gif"
        )
    writer = (FFMpegWriter if mp4 else PillowWriter)(fps=RATE)
    with plt.style.context(STYLE):
        fig, frame, states = moving(run, last or 2)
        fig.draw_without_rendering()
        fig.set_layout_engine("none")  # it would lay out every frame
        try:
            with replacing(path) as file:
                FuncAnimation(fig, frame, frames=len(states), blit=False).save(file.name, writer, dpi=110)
        except subprocess.CalledProcessError as error:
            said = f"{error.stderr}".strip().splitlines() or [f"status {error.returncode}"]
            raise RunError(f"{path}: cannot be written: ffmpeg: {printable(said[-1])}") from error
        finally:
            plt.close(fig)


def moving(run: Run, last: float) -> tuple[Figure, Any, Sequence[State]]:
    """The picture of a movie, the function that draws a frame of it by its number, and the states."""
    part = signals.last_revolutions(run, last)
    turns = signals.turned(run, part)
    every = max(1, round((part.stop - part.start - 1) / max(1.0, turns * FRAMES)))
    whole = geometry.samples(run, part)
    states = whole[:-1:every]
    fig, (left, right) = plt.subplots(1, 2, width_ratios=(1.15, 1), figsize=(PAGE, 3.7))
    drawing = Drawing(left, run.in_operation, states[0])
    mark_rotation(left, sense(run.input))
    y, z = SHOWN["journal_y"].factor * np.array([state.journal for state in whole]).T
    right.plot(z, y, color="0.75", linewidth=0.8)
    (trail,) = right.plot([], [], color="C0")
    (dot,) = right.plot([], [], "o", color="C0", markersize=4)
    right.set(xlabel=SHOWN["journal_z"].label, ylabel=SHOWN["journal_y"].label, aspect="equal")
    right.set(box_aspect=1, adjustable="datalim")
    right.margins(0.1)
    fig.suptitle(plain(run.title or Path(run.path).stem, width(fig)))
    clock = right.set_title("")

    def frame(number: int) -> None:
        drawing.move(states[number])
        at = number * every
        trail.set_data(z[: at + 1], y[: at + 1])
        dot.set_data(z[at : at + 1], y[at : at + 1])
        clock.set_text(f"{states[number].time:.4f} s")

    return fig, frame, states
