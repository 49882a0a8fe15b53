"""Pictures of what orbits do over a parameter.

Every function takes results and studies, and returns the figure.
"""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tiltpad.calculate import branches, signals
from tiltpad.calculate.coefficients import of_pivots
from tiltpad.calculate.critical_speeds import operating_range
from tiltpad.calculate.response import DIRECTIONS, Peak
from tiltpad.calculate.response import response as response_of
from tiltpad.calculate.selection import SPEED, ArgumentError, Where, needs
from tiltpad.draw import layout, plots
from tiltpad.draw.vibrations import parts
from tiltpad.files import units
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN, literal

#: Lines of what is unstable, marks of bifurcation points, and marches below.
UNSTABLE = {"linestyle": (0, (4, 2)), "linewidth": 0.9}
MARK = {"linestyle": "", "marker": "o", "markersize": 4, "markerfacecolor": "white", "zorder": 4}
MARCHED = {"linestyle": "", "marker": ".", "markersize": 2, "color": "0.65", "zorder": 0}
#: Parameters of a curve, what its points are, and how wide its band is, of the picture.
CHARTED = ("branch_parameter", "branch_second_parameter")
POINTS = {
    "hopf": "Hopf points",
    "fold": "folds",
    "period_doubling": "period doublings",
    "neimark_sacker": "Neimark-Sacker points",
    "cycle_fold": "folds of limit cycles",
}
BAND = 0.03
#: Multipliers farther away are not shown.
FARTHEST = 2


@layout.of_several
def response(
    runs: Sequence[Run | Study],
    over: str | None = None,
    where: Where = None,
    station: int | None = None,
    pivot: str | None = None,
    operating: Sequence[float] | None = None,
) -> Figure:
    """Amplitude and phase of the first harmonic over the speed, with critical and operating speeds.

    It is that of the journal; of machines that of a station, linear with pivots of a kind or of marches.
    """
    found = parts(runs, pivot, over, where)
    fig, panels = layout.stacked(["amplitude", "phase"])
    fig.set_figheight(4.2)
    size, entries = SHOWN["amplitude"], list[tuple[str, dict[str, Any]]]()
    for color, one in enumerate(found):
        own = response_of(one.source, one.where or None, one.over, station, pivot)
        for k, direction in enumerate(DIRECTIONS):
            line: dict[str, Any] = {"color": f"C{k}"}
            if len(found) > 1:
                line = {"color": layout.part_color(color, len(found)), "linestyle": layout.DASHES[k]}
            drawn = {"amplitude": size.factor * own.amplitude, "phase": np.degrees(own.phase)}
            for name, values in drawn.items():
                panels[name].plot(own.values, values[:, k], **line | layout.dots(len(own.values)))
            peaks = [each for each in own.peaks if each.direction == direction]
            for each in peaks:
                for ax in panels.values():
                    ax.axvline(each.speed_rpm, color=line["color"], linestyle=":", linewidth=0.8)
            words = f"${direction}$" + (f": {'; '.join(map(in_words, peaks))}" if peaks else "")
            entries.append((f"{literal(one.text)}, {words}" if one.text else words, line))
    if operating is not None and own.parameter == SPEED:
        for ax in panels.values():
            ax.axvspan(*operating_range(operating), color="C2", alpha=0.15, linewidth=0.8, zorder=0)
        entries.append(("operating speeds", {"color": "C2", "alpha": 0.3, "linewidth": 6}))
    text, unit = units.named(own.parameter)
    panels["amplitude"].set(ylabel=f"{size.text}, order 1 ({size.unit})", ylim=(0, None))
    panels["phase"].set(ylabel="phase lag, order 1 (deg)", xlabel=units.Shown(text, 1, unit).label)
    whose = [f"station {own.station}"] if own.station else []
    whose.append(of_pivots(one.source, one.pivot) if one.pivot else "")
    layout.heading(fig, entries, ", ".join(each for each in (layout.title(runs), *whose) if each))
    return fig


def in_words(peak: Peak) -> str:
    """Critical speed and amplification factor; of a peak that is open the least that it may be."""
    factor, more = peak.amplification_factor, "> " * peak.open
    return f"{peak.speed_rpm:.0f} rpm" + (f", AF {more}{factor:.2f}" if np.isfinite(factor) else "")


@layout.of_several
def branch(runs: Sequence[Run | Study], pad: int | None = None) -> Figure:
    """Highest and lowest values along branches, unstable parts dashed, bifurcation points by their letters.

    They are those of the journal, or of its y and, with `pad`, of its tilt. Studies of marches over the same
    parameter, as tiltpad.brute_force makes them, lie below: highest and lowest values of each revolution.
    """
    found = [each for each in runs if isinstance(each, Run)]
    if not found:
        raise NotInRunError(f"{runs[0].path}: no branch in this study: its marches are drawn below one")
    for run in found:
        branches.needs_one_parameter(run)
    layout.shown_pads(found, pad)
    fig, panels = layout.stacked([("journal_y", None), ("pad_tilt", pad) if pad else ("journal_z", None)])
    fig.set_figheight(4.4)
    several = len(found) > 1
    for (name, own), ax in panels.items():
        for study in (each for each in runs if isinstance(each, Study)):
            draw_marches(study, ax, found[0], name, own)
        for k, run in enumerate(found):
            draw_branches(run, ax, name, own, f"C{k}" if several else None)
        whose = f", pad {own}" if own else ""
        ends = f"{SHOWN[name].label}{whose}\nhighest and lowest"
        ax.set(ylabel=ends, xlabel=parameter_of(found[0]).label)
        ax.margins(y=0.1)
    if several:
        names = [(literal(text), {"color": f"C{k}"}) for k, text in enumerate(layout.labels(found))]
    else:
        numbers = np.unique(found[0]["branch"]).astype(int)
        names = [(f"branch {each}", {"color": color_of(each)}) for each in numbers if len(numbers) > 1]
    kinds = dict.fromkeys(each.kind for run in found for each in branches.bifurcations(run))
    marks: list[tuple[str, dict[str, Any]]]
    frozen = " at frozen viscosity" if any("viscosity" in run for run in found) else ""
    marks = [(f"stable{frozen}", {"color": "0.3"}), ("unstable", {"color": "0.3"} | UNSTABLE)]
    words = [literal(": ".join(branches.KINDS.get(each, (each, "")))) for each in kinds]
    marks += [(each, MARK | {"color": "0.3"}) for each in words]
    marks += [("marches", MARCHED | {"markersize": 5})] if len(found) < len(runs) else []
    layout.heading(fig, [*names, *marks], layout.title(found))
    return fig


@layout.of_several
def chart(runs: Sequence[Run]) -> Figure:
    """Curves of bifurcation points over two parameters, each with a band on its stable side.

    Of folds the band is where the two solutions are that meet. Dashed: on neither side is anything stable.
    """
    for run in runs:
        branches.needs_curve(run)
    if len({tuple(f"{run.attributes[name]}" for name in CHARTED) for run in runs}) > 1:
        raise ArgumentError("the curves are over different parameters: a chart has those over the same two")
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 3.4))
    places = zip(*((run["second_parameter"], run["parameter"]) for run in runs), strict=True)
    sizes = np.array([np.ptp(np.concatenate(each)) or 1.0 for each in places])
    entries, marked = list[tuple[str, dict[str, Any]]](), list[tuple[float, float, str]]()
    kinds = [POINTS.get(f"{run.attributes['branch_point']}", "") for run in runs]
    labels = [layout.plain(each, layout.width(fig)) for each in layout.labels(runs)]
    for color, run, name, kind in zip(layout.colors(runs), runs, labels, kinds, strict=True):
        sides = BAND * sizes * branches.stable_sides(run, sizes)
        x, y = run["second_parameter"], run["parameter"]
        for each in branches.stretches(run):
            own = each.points
            ax.plot(x[own], y[own], color=color, **({} if each.stable else UNSTABLE))
            if each.stable:
                edge = np.stack([x[own], y[own]], axis=1) + sides[own]
                ax.fill(
                    [*x[own], *edge[::-1, 0]], [*y[own], *edge[::-1, 1]], color=color, alpha=0.2, linewidth=0
                )
        special = branches.bifurcations(run)
        ax.plot(
            *np.array([(x[each.point], y[each.point]) for each in special]).reshape(-1, 2).T,
            **MARK,
            color=color,
        )
        marked += [(x[each.point], y[each.point], literal(each.letters)) for each in special]
        entries.append((name if len(set(kinds)) < len(runs) else kind, {"color": color}))
    band = {"color": "0.3", "alpha": 0.3, "linewidth": 6}
    entries += [("stable side", band)] if any("fold" not in each for each in kinds) else []
    entries += [("side of the solutions", band)] if all("fold" in each for each in kinds) else []
    for place, height, letters in apart(marked, ax):
        where = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center"}
        ax.annotate(letters, (place, height), **where, size="x-small")
    ax.set(ylabel=parameter_of(runs[0]).label, xlabel=parameter_of(runs[0], CHARTED[1]).label)
    ax.margins(0.06)
    layout.heading(fig, entries, layout.title(runs))
    return fig


def draw_branches(run: Run, ax: Axes, name: str, pad: int | None, color: str | None) -> None:
    """The highest and lowest values of a dataset along all branches of a run, with the bifurcation points."""
    part = slice(None) if pad is None else (slice(None), pad - 1)
    parameter, special = run["parameter"], branches.bifurcations(run)
    marked: list[tuple[float, float, str]] = []
    for values in (SHOWN[name].factor * run[f"{name}_{end}"][part] for end in ("max", "min")):
        for each in branches.stretches(run):
            line = {"color": color or color_of(each.branch)} | ({} if each.stable else UNSTABLE)
            ax.plot(parameter[each.points], values[each.points], **line)
        for point in special:
            at = (point.parameter, values[point.point])
            ax.plot(*at, **MARK | {"color": color or color_of(point.branch)})
            marked.append((*at, literal(point.letters)))
    for place, y, letters in apart(marked, ax):
        where = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center"}
        ax.annotate(letters, (place, y), **where, size="x-small")


def apart(marked: Sequence[tuple[float, float, str]], ax: Axes) -> list[tuple[float, float, str]]:
    """Points with their letters (x, y, letters): one label for points whose labels would overlap."""
    wide, high = (np.ptp(each) or 1.0 for each in (ax.dataLim.intervalx, ax.dataLim.intervaly))
    found: list[tuple[float, float, str]] = []
    for x, y, letters in sorted(marked):
        for k, (near, height, words) in enumerate(found):
            if abs(x - near) < 0.08 * wide and abs(y - height) < 0.06 * high:
                words = words if letters in words.split(", ") else f"{words}, {letters}"
                found[k] = (near, max(y, height), words)
                break
        else:
            found.append((x, y, letters))
    return found


def draw_marches(study: Study, ax: Axes, run: Run, name: str, pad: int | None) -> None:
    """Highest and lowest values of each revolution of the marches of a study."""
    variable = f"{run.attributes['branch_parameter']}".rpartition("%")[2].replace("(", "_").rstrip(")")
    needs(variable, study.parameters, "over", "a parameter")
    for end in ("lowest", "highest"):
        values = study[f"{end}_{name.rpartition('_')[2]}"]
        values = values if pad is None else values[..., pad - 1]
        places = np.broadcast_to(study[variable][:, None], values.shape)
        ax.plot(places.ravel(), SHOWN[name].factor * values.ravel(), **MARCHED)


def parameter_of(run: Run, name: str = "branch_parameter") -> units.Shown:
    """The parameter of branches, or another of a curve, in words, with its unit."""
    text, unit = units.named(f"{run.attributes[name]}".partition("(")[0])
    return units.Shown(literal(text), 1, unit)


def color_of(branch: int) -> str:
    return f"C{(branch - 1) % 8}"


@layout.of_several
def multipliers(runs: Sequence[Run]) -> Figure:
    """Floquet multipliers of periodic orbits, or along branches, in and around the unit circle."""
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 3.4))
    ax.add_patch(Circle((0, 0), 1, fill=False, linewidth=0.8, color="0.3"))
    reach = 1.0
    for color, run in zip(layout.colors(runs), runs, strict=True):
        if run.is_branch:
            values = branches.multipliers(run)
            parameter = np.broadcast_to(run["parameter"][:, None], values.shape)
            look = {"c": parameter} if len(runs) == 1 else {"color": color}
            dots = ax.scatter(values.real, values.imag, s=6, linewidths=0, **look)
            if len(runs) == 1:
                fig.colorbar(dots, ax=ax, label=parameter_of(run).label)
        else:
            plots.multipliers(run, ax, color=color)
            values = signals.multipliers(run)
        reach = max(reach, float(np.abs(values).max()))
    ax.set(xlabel=SHOWN["multiplier_real"].label, ylabel=SHOWN["multiplier_imag"].label, aspect="equal")
    reach = 1.1 * min(reach, FARTHEST)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    layout.legend(fig, runs, [])
    return fig
