"""Pictures of the benchmark."""

from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from films import CHECK, UNEQUAL
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from peers import OCTAVE, OWN, SCALED, SCIPY, SHORT, TILTPAD
from runner import Row
from settings import ALLOWED, DIAGRAM, FIGURES, FILM_CASES, FILM_TOLERANCE, MAIN
from tables import film_time
from tiltpad.draw.layout import COLUMN, PAGE
from tiltpad.draw.plots import STYLE

#: Colour, mark and words of the diagram's groups.
LOOKS = {
    "tolerance": ("C2", "^", "relative tolerance, table with it"),
    "table": ("C0", "o", f"tolerance of the table, march {FILM_TOLERANCE}"),
    "together": ("C3", "D", "both"),
    "direct": ("C1", "s", "direct instead of the table"),
    "defaults": ("black", "*", "default settings"),
}
TARGET = {"color": "0.4", "linestyle": "--", "linewidth": 0.8}


def draw(rows: dict[str, list[Row]], folder: Path) -> None:
    """All pictures for which there are rows."""
    mpl.use("agg")
    folder.mkdir(parents=True, exist_ok=True)
    pictures = {"diagram": diagram, "films": films, "pads": pads, "peers": peers}
    for name, picture in pictures.items():
        if rows[name]:
            with plt.style.context(STYLE):
                picture(rows[name])
                plt.savefig(folder / f"bench_{name}.png", dpi=200)
                plt.close()


def diagram(rows: list[Row]) -> None:
    """Run time against error, a panel a case."""
    fig, axes = plt.subplots(4, 2, figsize=(PAGE, 11.2))
    for case, ax in zip(MAIN, axes.flat, strict=False):
        mine = [row for row in rows if row.case == case.name and row.error]
        front(mine, ax)
        for group in DIAGRAM:
            colour, mark, _ = LOOKS[group]
            points = [row for row in mine if row.group == group]
            size = 11 if group == "defaults" else 4
            line = "none" if group in ("defaults", "together", "direct") else "-"
            ax.plot(*xy(points), mark, color=colour, markersize=size, linestyle=line, linewidth=0.6)
            for row in points:
                label(ax, row)
        ax.axhline(ALLOWED, **TARGET)
        ax.axvline(FIGURES[case.name], **(TARGET | {"linestyle": ":"}))
        ax.set(xscale="log", yscale="log", title=case.label, xlabel="run time, s", ylabel="error")
        ax.margins(0.1)
        plain_numbers(ax.xaxis)
        ax.tick_params(axis="x", which="minor", labelsize=6)
    legend = axes.flat[-1]
    legend.axis("off")
    for colour, mark, words in LOOKS.values():
        legend.plot([], [], mark, color=colour, label=words, markersize=9 if mark == "*" else 5)
    legend.plot([], [], color="0.8", linewidth=4, label="fastest at each error")
    legend.plot([], [], label=f"error allowed, {ALLOWED:g}", **TARGET)
    legend.plot([], [], label="run time to reach", **(TARGET | {"linestyle": ":"}))
    legend.legend(loc="center", fontsize=8)


def front(rows: list[Row], ax: Axes) -> None:
    """The runs that none beats in both time and error."""
    best = []
    for row in sorted(rows, key=lambda row: row.wall_seconds):
        if not best or row.error < best[-1].error:
            best.append(row)
    ax.plot(*xy(best), color="0.8", linewidth=4, drawstyle="steps-post", zorder=0)


def xy(rows: list[Row]) -> tuple[list[float], list[float]]:
    """Run times and errors."""
    return [row.wall_seconds for row in rows], [row.error for row in rows]


def label(ax: Axes, row: Row) -> None:
    """The number that a group varies, beside its point."""
    if row.group in ("table", "tolerance"):
        varied = row.setting.split()[0]
        # the loosest tables often are the same one
        side = {"tolerance": (-3, 4), "table": (-4, 4) if varied == "1e-3" else (4, -2)}[row.group]
        place = {"textcoords": "offset points", "xytext": side, "fontsize": 5, "color": LOOKS[row.group][0]}
        ax.annotate(varied, (row.wall_seconds, row.error), **place)


def films(rows: list[Row]) -> None:
    """Time of a film against error, a colour a case."""
    _, ax = plt.subplots(figsize=(PAGE, 2.8))
    for i, case in enumerate(FILM_CASES):
        mine = [row for row in rows if row.case == case.name and row.error and row.group != CHECK]
        points = [(1e6 * film_time(row), row) for row in mine]
        sor = [(time, row.error) for time, row in points if row.setting.startswith("sor")]
        direct = [(time, row.error) for time, row in points if row.setting.startswith("direct")]
        tables = [(time, row.error) for time, row in points if row.setting.startswith("table")]
        ax.plot(*zip(*sor, strict=True), "o-", markersize=4, color=f"C{i}", label=case.label)
        ax.plot(*zip(*direct, strict=True), "s", markersize=5, color=f"C{i}")
        ax.plot(*zip(*tables, strict=True), "*", markersize=9, color=f"C{i}")
    # the lines lie close: the grids once, at the lowest
    for time, row in points:
        if row.setting.startswith("sor"):
            place = {"textcoords": "offset points", "xytext": (-4, -9), "ha": "right", "fontsize": 7}
            ax.annotate(row.setting.removeprefix("sor "), (time, row.error), **place)
    ax.plot([], [], "o-", markersize=4, color="0.3", label="sor, three grids")
    ax.plot([], [], "*", markersize=9, color="0.3", label="table, default and 4e-6")
    ax.plot([], [], "s", markersize=5, color="0.3", label="direct, default")
    ax.axhline(ALLOWED, **TARGET)
    ax.margins(0.08)
    ax.set(xscale="log", yscale="log", xlabel="time of a pad's film, µs", ylabel="error of the run")
    ax.legend(loc="center left", bbox_to_anchor=(1, 0.5))


def pads(rows: list[Row]) -> None:
    """Time of a right-hand side over the number of pads."""
    _, ax = plt.subplots(figsize=(COLUMN, 2.6))
    counts, times = times_of([row for row in rows if row.rhs and row.group != UNEQUAL])
    ax.plot(counts, times, "o-", markersize=4, label="measured")
    ax.plot(
        *times_of([row for row in rows if row.rhs and row.group == UNEQUAL]),
        "s:",
        markersize=4,
        label=UNEQUAL,
    )
    ax.plot(counts, times[-1] * counts / counts[-1], label="linear", **TARGET)
    ax.set(xscale="log", yscale="log", xlabel="pads", ylabel="march time, us a right-hand side")
    ax.set_xticks(counts, map(str, counts), minor=False)
    ax.set_xticks([], minor=True)
    plain_numbers(ax.yaxis)
    ax.legend()


def plain_numbers(axis: Axis) -> None:
    """Writes the numbers of a logarithmic axis in full, those between the powers of ten among them."""
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(lambda x, _: f"{x:g}" if f"{x:e}"[0] in "235" else "")


def times_of(rows: list[Row]) -> tuple[np.ndarray, np.ndarray]:
    """Pads, and the time of a right-hand side, us."""
    return np.array([int(row.setting) for row in rows]), np.array(
        [1e6 * row.march_seconds / row.rhs for row in rows]
    )


def peers(rows: list[Row]) -> None:
    """Wall seconds a second of rotor time."""
    _, ax = plt.subplots(figsize=(PAGE, 1.7))
    shown = compared(rows)
    rates = [row.wall_seconds / row.rotor_seconds for row in shown]
    names = [f"{row.group.partition(',')[0]}, {row.setting}" for row in shown]
    bars = ax.barh(names, rates, color=["C0" if row.group in (TILTPAD, SHORT) else "C1" for row in shown])
    ax.bar_label(bars, [f"{rate:.3g}" for rate in rates], padding=3, fontsize=7)
    ax.set(xscale="log", xlabel="wall seconds a second of rotor time", xlim=(min(rates) / 3, max(rates) * 5))
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)


def compared(rows: list[Row]) -> list[Row]:
    """The rows of the ratio table: whole runs, and the peers' recipes at their best."""
    names = {(TILTPAD, "defaults"), (SHORT, "the peers' film"), (SCIPY, SCALED + OWN)}
    found = {}
    for row in rows:
        if ((row.group, row.setting) in names or row.group == OCTAVE) and row.wall_seconds:
            found.setdefault((row.group, row.setting), row)
    return list(found.values())
