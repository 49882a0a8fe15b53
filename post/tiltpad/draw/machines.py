"""Pictures of a machine as a whole: drawn to scale, orbits of its shaft, its static deflection, its modes."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from tiltpad.calculate import stations as of_stations
from tiltpad.draw import layout
from tiltpad.files.archive import NotInRunError, RunError
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN, Shown, digits, literal, numbers

#: Modes of a damping ratio above this are not drawn, and this number of modes is.
DAMPED, MOST_MODES = 0.6, 6
#: How loads of bearings are shown.
LOAD = Shown("load", 1e-3, "kN")
#: Points of the ellipse on which a station moves.
ELLIPSE = 73
#: Height of the picture of a machine over its length: at least and at most.
LOWEST, HIGHEST = 0.3, 0.75
#: Stations have their numbers beside each other from this distance on, over the length of the machine.
NEXT = 0.032
SENSE = {"forward": "C0", "backward": "C1", "mixed": "C2", "planar": "C3"}
NOTE = {"fontsize": "small", "ha": "center"}


def machine(case: Run | Mapping[str, Any]) -> Figure:
    """A machine to scale: sections of the shaft, discs, bearings and supports, unbalances and loads.

    `case` is a result or the resolved input of a machine. Discs are drawn as cylinders of steel of their mass
    and polar inertia.
    """
    groups: Mapping[str, Any] = case.input if isinstance(case, Run) else case
    where = f"{case.path}: " if isinstance(case, Run) else ""
    if not isinstance(groups.get("bearing"), list):
        raise ValueError(f"{where}a case of one bearing, and not of a machine: tiltpad-plot bearing draws it")
    if "length" not in groups.get("shaft", {}):
        matrices = "the rotor of this machine is of matrices"
        raise ValueError(f"{where}{matrices}, without sections of a shaft to draw")
    sizes = (groups["shaft"][name] for name in ("length", "diameter", "bore"))
    length, diameter, bore = (np.atleast_1d(np.asarray(each, float)) for each in sizes)
    x = np.concatenate([[0], np.cumsum(length)])
    fig, ax = plt.subplots(figsize=(layout.PAGE, 3.4))
    for section in zip(x[:-1], length, diameter, bore, strict=True):
        draw_section(ax, *section)
    radius = np.maximum(np.append(diameter, 0), np.append(0, diameter)) / 2
    tallest = max(radius.max(), *(draw_disc(ax, x, each) for each in groups.get("disc", [])), 0.0)
    reach = max(tallest, LOWEST / 2 * x[-1])
    supported = [each["bearing"] for each in groups.get("support", [])]
    for each in groups["bearing"]:
        draw_bearing(ax, x, radius, each, reach, each["name"] in supported)
    draw_forces(ax, x, radius, groups, reach)
    number_stations(ax, x, reach)
    ax.axhline(0, color="0.5", linewidth=0.6, linestyle=(0, (12, 3, 2, 3)), zorder=3)
    edge = 0.09 * x[-1]
    ax.set(xlim=(-edge, x[-1] + edge), ylim=(-1.68 * reach, 1.35 * reach), aspect="equal")
    ax.set_xlabel("distance from station 1 (m)")
    ax.yaxis.set_visible(False)
    ax.grid(False)
    for side in ("left", "right", "top"):
        ax.spines[side].set_visible(False)
    ax.tick_params(top=False, which="both")
    height = np.clip(3 * reach / (x[-1] + 2 * edge), LOWEST, HIGHEST) * layout.PAGE
    fig.set_figheight(0.8 + height)
    fig.suptitle(layout.plain(str(groups["case"].get("title", "")), layout.width(fig)))
    return fig


def number_stations(ax: Axes, x: np.ndarray, reach: float) -> None:
    """The numbers of the stations below the machine; where they are close, every other one lower."""
    low, before = False, -np.inf
    note = {"fontsize": "x-small", "va": "top", "color": "0.4"}
    for k, at in enumerate(x, 1):
        low = not low and at - before < NEXT * x[-1]
        ax.text(at, -1.47 * reach, "\n" * bool(low) + f"{k}", ha="center", **note)
        ax.plot([at, at], [-1.45 * reach, -1.4 * reach], color="0.6", linewidth=0.6)
        before = at
    ax.text(x[0] - 0.03 * x[-1], -1.47 * reach, "station", ha="right", **note)


def draw_section(ax: Axes, start: float, length: float, diameter: float, bore: float) -> None:
    """A section of the shaft, with its bore."""
    for high, color in ((diameter, "0.85"), (bore, "white")):
        if high > 0:
            look = {"facecolor": color, "edgecolor": "0.25", "linewidth": 0.7, "zorder": 2}
            ax.add_patch(Rectangle((start, -high / 2), length, high, **look))


def draw_disc(ax: Axes, x: np.ndarray, disc: Mapping[str, Any]) -> float:
    """A disc as the cylinder of steel that has its mass and polar inertia; gives its radius, m.

    Where its diametral inertia tells its width, that one is taken; steel has 7850 kg/m^3.
    """
    mass, polar, diametral = (float(disc[name]) for name in ("mass", "polar_inertia", "diametral_inertia"))
    if mass <= 0:
        return 0.0
    radius = np.sqrt(2 * polar / mass) if polar > 0 else 0.05 * x[-1]
    width = np.sqrt(max(0.0, 12 / mass * (diametral - polar / 2)))
    width = width or mass / (7850 * np.pi * radius**2)
    width = float(np.clip(width, 0.008 * x[-1], 0.5 * x[-1]))
    at = station(x, disc)
    look = {"facecolor": "#dbe9f6", "edgecolor": "C0", "linewidth": 0.8, "zorder": 1}
    ax.add_patch(Rectangle((at - width / 2, -radius), width, 2 * radius, **look))
    return float(radius)


def draw_bearing(
    ax: Axes, x: np.ndarray, radii: np.ndarray, bearing: Mapping[str, Any], reach: float, support: bool
) -> None:
    """Its pads or, by coefficients, a ball above and below the journal, the name, and what it stands on."""
    at, thick = station(x, bearing), 0.09 * reach
    film = bearing.get("kind", "film") == "film"
    radius = float(bearing["journal_radius"] if film else radii[int(bearing["station"]) - 1])
    length = float(np.max(bearing["axial_length"])) if film else thick
    for low in (radius, -radius - thick):
        look = {"facecolor": "0.55" if film else "white", "edgecolor": "0.2", "linewidth": 0.7, "zorder": 4}
        if film:
            ax.add_patch(Rectangle((at - length / 2, low), length, thick, **look))
        else:
            ax.add_patch(Circle((at, low + thick / 2), thick / 2, **look))
    top, ground, half = -radius - thick, -1.1 * reach, max(length / 2, 0.018 * reach)
    if support:
        y = np.linspace(top, ground, 12)
        sway = 0.05 * reach * np.array([0, 0, *[1, -1] * 4, 0, 0])
        ax.plot(at + sway, y, color="0.2", linewidth=0.9, zorder=0)
    else:
        corners = [(at - 0.3 * half, top), (at + 0.3 * half, top), (at + half, ground), (at - half, ground)]
        look = {"facecolor": "0.93", "edgecolor": "0.2", "linewidth": 0.7, "zorder": 0}
        ax.add_patch(Polygon(corners, closed=True, **look))
    wide = 1.6 * max(half, 0.06 * reach)
    ax.plot([at - wide, at + wide], [ground, ground], color="0.2", linewidth=1.2)
    words = literal(f"{bearing['name']}") + ("\n(on a support)" if support else "")
    ax.text(at, -1.14 * reach, words, **NOTE, va="top", linespacing=0.95)


def draw_forces(ax: Axes, x: np.ndarray, radius: np.ndarray, groups: Mapping[str, Any], reach: float) -> None:
    """Unbalances as dots with their moments, loads as arrows."""
    height, beside = 1.22 * reach, {"va": "center", "linespacing": 1.0}
    for each in groups.get("unbalance", []):
        at = station(x, each)
        ax.plot([at, at], [0, height - 0.12 * reach], color="C3", linewidth=0.7, linestyle=":", zorder=5)
        ax.plot(at, 0, "o", color="C3", markersize=4, zorder=6)
        angle = f" at {each['angle_deg']:g}°" if each.get("angle_deg") else ""
        ax.text(at, height, f"unbalance\n{each['moment']:g} kg m{angle}", **NOTE, **beside, color="C3")
    for each in groups.get("load", []):
        at, force = station(x, each), np.asarray(each["force"], float)
        tail, tip = (0.5 * reach, 1.05 * reach)[:: 1 if force[0] > 0 else -1]
        arrow = {"arrowstyle": "-|>", "color": "C2", "linewidth": 1.2}
        ax.annotate("", (at, tip), (at, tail), arrowprops=arrow, zorder=5)
        words = ", ".join(f"{digits(1e-3 * part, 3)}" for part in force)
        ax.text(at, height, f"load $y$, $z$\n{words} kN", **NOTE, **beside, color="C2")


def station(x: np.ndarray, of: Mapping[str, Any]) -> float:
    """Where the station of something is on a shaft, m."""
    if not 1 <= int(of["station"]) <= len(x):
        raise RunError(f"station {of['station']} is not on the shaft")
    return float(x[int(of["station"]) - 1])


@layout.of_several
def stations(runs: Sequence[Run], last: float | None = None, station: Sequence[int] | None = None) -> Figure:
    """Orbits of the shaft of machines at stations: those given, or all with a bearing, disc or unbalance."""
    for run in runs:
        of_stations.needs_machine(run)
    known = of_stations.attached(runs[0].input)
    chosen = list(dict.fromkeys(station or known))
    fig, panels = layout.grid(len(chosen), 3.1)
    for ax, number in zip(panels, chosen, strict=True):
        sizes = []
        for i, run in enumerate(runs):
            color, path = layout.colors(runs)[i], of_stations.station_orbit(run, number, last)
            y, z = (SHOWN["journal_y"].factor * each for each in path)
            ax.plot(z, y, color=color)
            sizes.append(max(np.ptp(y), np.ptp(z)))
            if "equilibrium/station_y" in run:
                place = (run[f"equilibrium/station_{axis}"][number - 1] for axis in "zy")
                ax.plot(*(SHOWN["journal_y"].factor * each for each in place), "+", color=color)
        words = f": {', '.join(known[number])}" if number in known and len(runs) == 1 else ""
        ax.set_title(layout.plain(f"station {number}{words}", 45))
        ax.set(xlabel="$z$ (µm)", ylabel="$y$ (µm)", box_aspect=1, adjustable="datalim", aspect="equal")
        ax.margins(0.12)
        size = f"{', '.join(digits(each, 3) for each in sizes)} µm peak to peak" if len(sizes) < 4 else ""
        note = {"ha": "right", "va": "bottom", "fontsize": "small", "color": "0.3"}
        ax.text(0.97, 0.03, size, transform=ax.transAxes, **note)
    layout.legend(fig, runs, layout.orbit_marks(runs))
    return fig


@layout.of_several
def shaft(runs: Sequence[Run]) -> Figure:
    """The shaft of machines at the equilibrium: its deflection, and the loads of its bearings."""
    for run in runs:
        of_stations.needs_machine(run)
        if "equilibrium/station_y" not in run:
            raise NotInRunError(run.without("equilibrium/station_y"))
    fig, panels = plt.subplots(2, 1, sharex=True, figsize=(layout.PAGE, 4.0))
    for ax, axis in zip(panels, "yz", strict=True):
        for i, run in enumerate(runs):
            x = of_stations.positions(run)
            values = SHOWN["journal_y"].factor * run[f"equilibrium/station_{axis}"]
            color = layout.colors(runs)[i]
            ax.plot(x, values, color=color, marker="o", markersize=3)
            at = of_stations.bearings(run)
            ax.plot(x[at], values[at], "^", color=color, markersize=8, markerfacecolor="white")
            if "bearing" not in run:
                continue
            at = run["rotor/bearing_station"].astype(int) - 1
            both = [run[f"equilibrium/bearing_load_{each}"] for each in "yz"]
            loads = numbers(LOAD, np.ravel(both))["yz".index(axis) * len(at) :]
            for k, name in enumerate(run["bearing"] if len(runs) == 1 else []):
                share = (x[at[k]] - x[0]) / (x[-1] - x[0])
                side = {"ha": "left" if share < 0.15 else "right" if share > 0.85 else "center"}
                words = f"{literal(str(name))}: {loads[k]} {LOAD.unit}"
                place = {"xycoords": ("data", "axes fraction"), "va": "top", **NOTE, **side}
                ax.annotate(words, (x[at[k]], 0.96), **place)
        ax.set_ylabel(f"${axis}$ (µm)")
        ax.axhline(0, color="0.6", linewidth=0.6, zorder=0)
        ax.margins(x=0.06, y=0.25)
    known = all("rotor/station_position" in run for run in runs)
    panels[1].set_xlabel("distance from station 1 (m)" if known else "station")
    fig.align_ylabels(panels)
    neutral = {"color": "0.3" if len(runs) > 1 else "C0"}
    bearing = neutral | {"linestyle": "", "marker": "^", "markersize": 8, "markerfacecolor": "white"}
    stations = neutral | {"marker": "o", "markersize": 3}
    marks = [("shaft and its stations", stations), ("bearing, with the load of the shaft on it", bearing)]
    layout.legend(fig, runs, marks)
    return fig


@layout.of_several
def shapes(runs: Sequence[Run], pivot: str | None = None) -> Figure:
    """Mode shapes of the shaft of a machine: ellipses of its stations, and the shaft at one instant."""
    if len(runs) > 1:
        raise ValueError(f"shapes: of one result, not of {len(runs)}")
    run = runs[0]
    found = of_stations.station_modes(run, pivot)
    order = np.argsort(np.where(found.frequency > 0, found.frequency, np.inf), kind="stable")
    drawn = found.own & (found.frequency > 0) & (found.damping_ratio < DAMPED)
    slow = [k for k in order if drawn[k]][:MOST_MODES]
    if not slow:
        raise NotInRunError(f"{run.path}: no mode with a damping ratio below {DAMPED:g} in this run")
    x = of_stations.positions(run)
    columns = min(3, len(slow))
    rows = -(-len(slow) // columns)
    fig = plt.figure(figsize=(layout.PAGE, 2.35 * rows + 0.3))
    senses = [str(found.word[k]) for k in slow]
    for place, (k, sense) in enumerate(zip(slow, senses, strict=True), 1):
        ax = fig.add_subplot(rows, columns, place, projection="3d")
        draw_shape(ax, x, found.shape[k], of_stations.bearings(run), SENSE[sense])
        decrement = f"log. decrement {digits(found.log_decrement[k], 3)}"
        ax.set_title(f"{digits(found.frequency[k])} Hz, {sense}\n{decrement}", fontsize="small")
    marks = [(word, {"color": color}) for word, color in SENSE.items() if word in senses]
    bearing = ("bearing", {"color": "0.2", "linestyle": "", "marker": "^", "markersize": 5})
    pivots = f", pivots {found.pivot}" * run.has_pivots
    layout.heading(fig, [*marks, bearing], f"{run.title}{pivots}".removeprefix(", "))
    return fig


def draw_shape(ax: Any, x: np.ndarray, shape: np.ndarray, bearings: np.ndarray, color: str) -> None:
    """A mode in space, (station, 2): the ellipse of each station, and the shaft at one instant."""
    turn = np.exp(1j * np.linspace(0, 2 * np.pi, ELLIPSE))
    paths = (shape[:, :, None] * turn).real
    largest = np.abs(paths).max()
    paths = paths / (largest if largest > 0 else 1)
    ax.plot(x, 0 * x, 0 * x, color="0.5", linewidth=0.7, linestyle=(0, (12, 3, 2, 3)))
    for at, (y, z) in zip(x, paths, strict=True):
        ax.plot(np.full(ELLIPSE, at), z, y, color=color, linewidth=0.6, alpha=0.6, clip_on=False)
    now = np.array([x, paths[:, 1, 0], paths[:, 0, 0]])
    ax.plot(*now, color=color, linewidth=1.5, marker="o", markersize=2, clip_on=False)
    ax.plot(*now[:, bearings], "^", color="0.2", markersize=5, zorder=5)
    ax.set(xlim=(x[0], x[-1]), ylim=(-1, 1), zlim=(-1, 1))
    ax.set(yticks=[-1, 0, 1], zticks=[-1, 0, 1], yticklabels=[], zticklabels=[])
    ax.set_box_aspect((2, 1, 1), zoom=1.1)
    ax.view_init(elev=22, azim=-60)
    ax.tick_params(labelsize="x-small", pad=-3)
    ax.locator_params(axis="x", nbins=4)
    ax.set_xlabel("distance (m)", fontsize="x-small", labelpad=-6)
    for place, name in (((x[-1], 1.2, -1.1), "$z$"), ((x[-1], 1, 1.15), "$y$")):
        ax.text(*place, name, fontsize="small")
