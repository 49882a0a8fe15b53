"""Diagrams of a study on one pair of axes.

They are drawn from the arrays of the study alone. Runs that failed are marked.
"""

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from tiltpad.calculate import selection
from tiltpad.calculate.results import DEFAULTS, Result, result
from tiltpad.calculate.sensitivity import some
from tiltpad.draw.layout import DENSE, cloud, dots, part_color
from tiltpad.draw.plots import on_axes
from tiltpad.files import units
from tiltpad.files.study import POINTS, Study
from tiltpad.files.units import Shown, literal

#: Kinds of diagrams.
KINDS = ("lines", "map", "bifurcation", "points")
#: Maximum number of lines in one diagram.
MOST_LINES = 10
#: Up to this number of values of a second parameter there is a line for each, beyond it a map.
LINES_UP_TO = 6
#: An axis is logarithmic if its values rise by equal factors, over this ratio at least.
LOG_FROM = 9.9
#: Most points of a sample, and most marks of runs that were not done, across a panel and at its edge.
MOST_POINTS, MOST_MARKS, EDGE = 20000, 300, 150
#: Characters on a line of the vertical axis' label.
LABEL = 38
#: A run that was not done: in a cell of a map, and over an axis.
MARK = {"linestyle": "", "markersize": 5}
FAILED = MARK | {"marker": "x", "color": "0.4", "zorder": 4}
AT_EDGE = MARK | {"marker": "|", "color": "C1", "markeredgewidth": 0.7, "rasterized": True}
NOT_DONE = {"linestyle": (0, (1, 2)), "color": "0.5", "linewidth": 1.2, "zorder": 0.5, "gid": "not done"}


@on_axes
def diagram(
    study: Study,
    ax: Axes,
    show: str | None = None,
    over: str | None = None,
    kind: str | None = None,
    where: Mapping[str, str] | None = None,
    pad: int | None = None,
    pivot: str | None = None,
) -> Axes:
    """A result of the runs over a parameter: lines, a map over two of them, a bifurcation diagram, or points.

    `show` is a result, by default the first of DEFAULTS that the study has (poincare_y for a bifurcation
    diagram); with `pad` (1, 2, ...) it is a result of the pads; `pivot` chooses of which pivots results of
    small vibrations are (the first ones by default); `over` is a parameter, by default the number with the
    most values; `kind` is one of KINDS; `where` keeps the runs with these values of parameters. Raises
    ValueError for arguments that do not fit the study.
    """
    chosen = selection.selected(study, where or {})
    several = selection.varying(study, chosen)
    over = over or selection.default_over(study, several, chosen)
    selection.needs(over, study.parameters, "over", "a parameter")
    others = [name for name in several if name != over]
    kind = kind or default_kind(study, show, over, others, chosen)
    selection.needs(kind, KINDS, "kind", "a kind of diagram")
    draw = {"lines": lines, "map": field, "bifurcation": bifurcation, "points": points}[kind]
    revolutions = draw is bifurcation
    if show is None:
        first = next((name for name in DEFAULTS if name in study), DEFAULTS[0])
        show = "poincare_y" if revolutions else first
    return draw(study, ax, result(study, show, pad, pivot, revolutions), over, others, chosen)


def lines(study: Study, ax: Axes, show: Result, over: str, others: Sequence[str], chosen: np.ndarray) -> Axes:
    """A line for every combination of the other parameters; a dotted line across where a run failed."""
    values, shown = show[:2]
    at, place = axis(study, over, ax, "x")
    groups = grouped(study, others, chosen)
    for number, (text, part) in enumerate(groups):
        order = part[np.argsort(place[part], kind="stable")]
        whole = study.done[order]
        text = text if np.isfinite(values[order][whole]).any() else f"{text}: none"
        color = part_color(number, len(groups))
        line = {"color": color, "label": literal(text)} | dots(len(order))
        if not selection.is_number(study, over):
            # there are no values between texts
            line |= {"linestyle": "", "marker": "o", "markersize": 3}
        ax.plot(place[order], np.where(whole, shown.factor * values[order], np.nan), **line)
        mark_failed(ax, place[order][~whole], color if len(groups) > 1 else None)
    ax.set(xlabel=at.label, ylabel=fill(shown.label, LABEL))
    explain(study, ax, others, chosen)
    return ax


def field(study: Study, ax: Axes, show: Result, over: str, others: Sequence[str], chosen: np.ndarray) -> Axes:
    """Colours over two parameters; a cross where a run failed, white where there is no run."""
    numeric = [name for name in others if selection.is_number(study, name)]
    if not selection.is_number(study, over) or not numeric:
        known = f"its parameters are {', '.join(study.parameters) or 'none'}"
        raise ValueError(f"{study.path}: a map needs two parameters that are numbers: {known}")
    second = max(numeric, key=lambda name: len(selection.distinct(study[name][chosen])))
    values, shown = show[:2]
    (at, x), (beside, y) = (axis(study, name, ax, which) for name, which in ((over, "x"), (second, "y")))
    columns, rows = (np.unique(each[chosen & np.isfinite(each)]) for each in (x, y))
    table = np.full((len(rows), len(columns)), np.nan)
    placed = chosen & np.isfinite(x) & np.isfinite(y)
    cells = np.searchsorted(rows, y[placed]), np.searchsorted(columns, x[placed])
    if len(np.unique(np.ravel_multi_index(cells, table.shape))) < placed.sum():
        rest = ", ".join(name for name in others if name != second) or "nothing"
        text = "{path}: a map has one run in each cell, here are several that differ in {rest}"
        raise selection.ArgumentError(f"{text}: choose by {{where}}", path=study.path, rest=rest)
    done = study.done[placed]
    table[cells] = np.where(done, shown.factor * values[placed], np.nan)
    ax.plot(x[placed][~done], y[placed][~done], **FAILED)
    if not np.isfinite(table).any():
        raise ValueError(f"{study.path}: no finite {shown.label} to draw")
    borders = edges(columns, ax.get_xscale()), edges(rows, ax.get_yscale())
    image = ax.pcolormesh(*borders, np.ma.masked_invalid(table), rasterized=True)
    ax.figure.colorbar(image, ax=ax, label=shown.label)
    ax.grid(visible=False)
    ax.set(xlabel=at.label, ylabel=beside.label)
    explain(study, ax, (), chosen, FAILED)
    return ax


def points(
    study: Study, ax: Axes, show: Result, over: str, others: Sequence[str], chosen: np.ndarray
) -> Axes:
    """A point for each run of a sample, whatever the other parameters; those that failed along the edge."""
    values, shown = show[:2]
    at, place = axis(study, over, ax, "x")
    drawn = some(np.flatnonzero(chosen & study.done), MOST_POINTS)
    failed = some(np.flatnonzero(chosen & study.failed), EDGE)
    ax.plot(place[drawn], shown.factor * values[drawn], **cloud(len(drawn)))
    ax.plot(place[failed], np.zeros(len(failed)), transform=ax.get_xaxis_transform(), **AT_EDGE)
    ax.set(xlabel=at.label, ylabel=fill(shown.label, LABEL))
    explain(study, ax, (), chosen, AT_EDGE)
    return ax


def bifurcation(
    study: Study, ax: Axes, show: Result, over: str, others: Sequence[str], chosen: np.ndarray
) -> Axes:
    """A state once a revolution over a parameter: one point if the motion repeats every revolution."""
    values, shown = show[:2]
    at, place = axis(study, over, ax, "x")
    groups = grouped(study, others, chosen)
    size = 3 if len(selection.distinct(study[over][chosen])) < DENSE else 1.5
    for number, (text, part) in enumerate(groups):
        points = np.where(study.done[part, None], shown.factor * values[part], np.nan)
        x = np.broadcast_to(place[part, None], points.shape)
        color = part_color(number, len(groups))
        dots = {"linestyle": "", "marker": "o", "markersize": size, "markeredgewidth": 0}
        ax.plot(x.ravel(), points.ravel(), label=literal(text), color=color, **dots)
        mark_failed(ax, place[part][~study.done[part]], color if len(groups) > 1 else None)
    ax.set(xlabel=at.label, ylabel=fill(f"{shown.label} once a revolution", LABEL))
    explain(study, ax, others, chosen)
    return ax


def default_kind(study: Study, show: str | None, over: str, others: Sequence[str], chosen: np.ndarray) -> str:
    """A bifurcation diagram for Poincare points, points of a sample, a map over two numbers, else lines."""
    if show in POINTS:
        return "bifurcation"
    if selection.sampled(study, chosen):
        return "points"
    if len(others) == 1 and selection.is_number(study, over) and selection.is_number(study, others[0]):
        return "map" if len(selection.distinct(study[others[0]][chosen])) > LINES_UP_TO else "lines"
    return "lines"


def axis(study: Study, name: str, ax: Axes, which: str) -> tuple[Shown, np.ndarray]:
    """Unit of a parameter, positions of the runs along its axis, (run,); sets scale and ticks."""
    values, shown = study[name], shown_as(study, name)
    if not selection.is_number(study, name):
        names = selection.distinct(values)
        place = np.array([names.index(value) if value in names else np.nan for value in values], dtype=float)
        texts = [literal(selection.written(each)) for each in names]
        ax.set(**{f"{which}ticks": range(len(names)), f"{which}ticklabels": texts})
        ax.set(**{f"{which}lim": (-0.5, len(names) - 0.5)})
        return shown, place
    if spread_in_ratio(selection.distinct(values)):
        ax.set(**{f"{which}scale": "log"})
    else:
        ax.locator_params(axis=which, nbins=6)
    return shown, shown.factor * values


def spread_in_ratio(values: Sequence[float]) -> bool:
    """True for values that rise by nearly equal factors, over LOG_FROM or more."""
    if len(values) < 3 or values[0] <= 0 or values[-1] / values[0] < LOG_FROM:
        return False
    steps = np.diff(np.log(values))
    return bool(np.ptp(steps) < 0.1 * steps.mean() * len(steps)) and not np.allclose(np.diff(values, 2), 0)


def grouped(study: Study, others: Sequence[str], chosen: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """Name and runs of every combination of the other parameters; without runs of unknown values.

    Raises ArgumentError for more of them than a diagram has lines.
    """
    keys = list(zip(*(study[name] for name in others), strict=True)) if others else [()] * len(chosen)
    found: dict[tuple, list[int]] = {}
    for k in np.flatnonzero(chosen):
        if all(value == value and value != "" for value in keys[k]):
            found.setdefault(keys[k], []).append(int(k))
    rank = {name: {v: k for k, v in enumerate(selection.distinct(study[name]))} for name in others}
    keys = sorted(found, key=lambda key: [rank[name][v] for name, v in zip(others, key, strict=True)])
    if len(keys) > MOST_LINES:
        raise selection.ArgumentError(
            f"{len(keys)} lines, one for each {' and '.join(others)}, are more than {MOST_LINES}: "
            "choose by {where}, or {kind} map"
        )
    factors = [shown_as(study, name).factor for name in others]
    texts = [
        ", ".join(
            selection.written(value if isinstance(value, str) else factor * value)
            for factor, value in zip(factors, key, strict=True)
        )
        for key in keys
    ]
    return [(text, np.array(found[key])) for text, key in zip(texts, keys, strict=True)]


def mark_failed(ax: Axes, place: np.ndarray, color: str | None) -> None:
    """Lines across the axes, which no one takes for points."""
    style = NOT_DONE if color is None else NOT_DONE | {"color": color}
    for at in some(place[np.isfinite(place)], MOST_MARKS):
        ax.axvline(at, **style)


def explain(
    study: Study, ax: Axes, others: Sequence[str], chosen: np.ndarray, mark: Mapping[str, Any] = NOT_DONE
) -> None:
    """The legend above the axes: the meaning of the lines, and the number of runs that were not done."""
    handles, texts = ax.get_legend_handles_labels() if others else ([], [])
    if failed := int((~study.done[chosen]).sum()):
        handles = [*handles, plt.Line2D([], [], **mark)]
        texts = [*texts, f"not done ({failed})"]
    if handles:
        columns = max(1, 45 // (max(map(len, texts)) + 6))
        title = ", ".join(shown_as(study, name).label for name in others)
        place = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "ncols": columns}
        ax.legend(handles, texts, title=title or None, **place)


def shown_as(study: Study, name: str) -> Shown:
    """How a parameter is shown: a number in the unit that suits its values."""
    text = literal(study.about(name, "long_name") or name)
    if not selection.is_number(study, name):
        return Shown(text, 1, "")
    return units.shown(text, literal(study.about(name, "units")), study[name])


def label(study: Study, name: str) -> str:
    """A parameter in words, with its unit in the study."""
    text, unit = study.about(name, "long_name") or name, study.about(name, "units")
    return f"{text} ({unit})" if unit not in ("", "1") else text


def edges(values: np.ndarray, scale: str) -> np.ndarray:
    """Borders of the cells around rising values: half way, in ratio on a logarithmic axis."""
    x = np.log(values) if scale == "log" else values
    if len(x) == 1:
        found = x[0] + np.array([-0.5, 0.5])
    else:
        middle = (x[1:] + x[:-1]) / 2
        found = np.array([2 * x[0] - middle[0], *middle, 2 * x[-1] - middle[-1]])
    return np.exp(found) if scale == "log" else found
