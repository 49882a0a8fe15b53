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
from tiltpad.calculate.coefficients import chosen_pivot
from tiltpad.draw.layout import DENSE, dots, part_color
from tiltpad.draw.plots import on_axes
from tiltpad.files import units
from tiltpad.files.study import PIVOTS, POINTS, Study
from tiltpad.files.units import Shown, described, literal

#: Kinds of diagrams.
KINDS = ("lines", "map", "bifurcation")
#: Results that are drawn where none is asked for.
DEFAULTS = ("orbit_size", "least_damping_ratio", "equilibrium_min_film_thickness")
#: Maximum number of lines in one diagram.
MOST_LINES = 10
#: Up to this number of values of a second parameter there is a line for each, beyond it a map.
LINES_UP_TO = 6
#: Values of the runs, and the unit in which they are shown.
Result = tuple[np.ndarray, Shown]
#: An axis is logarithmic if its values rise by equal factors, over this ratio at least.
LOG_FROM = 9.9
#: Characters on a line of the vertical axis' label.
LABEL = 38
#: A run that was not done: in a cell of a map, and over an axis.
FAILED = {"linestyle": "", "marker": "x", "color": "0.4", "markersize": 5, "zorder": 4}
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
    """A result of the runs over a parameter: lines, a map over two of them, or a bifurcation diagram.

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
    draw = {"lines": lines, "map": field, "bifurcation": bifurcation}[kind]
    revolutions = draw is bifurcation
    if show is None:
        first = next((name for name in DEFAULTS if name in study), DEFAULTS[0])
        show = "poincare_y" if revolutions else first
    if show in study and study.scales(show) == PIVOTS:
        shown = of_pivot(study, show, pivot)
    else:
        shown = result(study, show, revolutions, pad)
    return draw(study, ax, shown, over, others, chosen)


def of_pivot(study: Study, name: str, pivot: str | None) -> Result:
    """A result of pivots, (run,): of the ones that are asked for, or of the first."""
    own, k = chosen_pivot(study, pivot)
    shown = described(study, name)
    return study[name][:, k], shown._replace(text=f"{shown.text}, pivots {literal(own)}")


def lines(study: Study, ax: Axes, show: Result, over: str, others: Sequence[str], chosen: np.ndarray) -> Axes:
    """A line for every combination of the other parameters; a dotted line across where a run failed."""
    values, shown = show
    at, place = axis(study, over, ax, "x")
    groups = grouped(study, others, chosen)
    too_many(groups, others)
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
        raise ValueError(
            f"{study.path}: a map needs two parameters that are numbers: {parameters_in_words(study)}"
        )
    second = max(numeric, key=lambda name: len(selection.distinct(study[name][chosen])))
    values, shown = show
    (at, x), (beside, y) = (axis(study, name, ax, which) for name, which in ((over, "x"), (second, "y")))
    columns, rows = (np.unique(each[chosen & np.isfinite(each)]) for each in (x, y))
    table = np.full((len(rows), len(columns)), np.nan)
    taken = np.zeros(table.shape, dtype=bool)
    for k in np.flatnonzero(chosen & np.isfinite(x) & np.isfinite(y)):
        cell = np.searchsorted(rows, y[k]), np.searchsorted(columns, x[k])
        if taken[cell]:
            rest = ", ".join(name for name in others if name != second) or "nothing"
            raise selection.ArgumentError(
                "{path}: a map has one run in each cell, here are several that differ in {rest}: "
                "choose by {where}",
                path=study.path,
                rest=rest,
            )
        taken[cell] = True
        if study.done[k]:
            table[cell] = shown.factor * values[k]
        else:
            ax.plot(x[k], y[k], **FAILED)
    if not np.isfinite(table).any():
        raise ValueError(f"{study.path}: no finite {shown.label} to draw")
    image = ax.pcolormesh(
        edges(columns, ax.get_xscale()),
        edges(rows, ax.get_yscale()),
        np.ma.masked_invalid(table),
        rasterized=True,
    )
    ax.figure.colorbar(image, ax=ax, label=shown.label)
    ax.grid(visible=False)
    ax.set(xlabel=at.label, ylabel=beside.label)
    explain(study, ax, (), chosen, FAILED)
    return ax


def bifurcation(
    study: Study, ax: Axes, show: Result, over: str, others: Sequence[str], chosen: np.ndarray
) -> Axes:
    """A state once a revolution over a parameter: one point if the motion repeats every revolution."""
    values, shown = show
    at, place = axis(study, over, ax, "x")
    groups = grouped(study, others, chosen)
    too_many(groups, others)
    size = 3 if len(selection.distinct(study[over][chosen])) < DENSE else 1.5
    for number, (text, part) in enumerate(groups):
        points = np.where(study.done[part, None], shown.factor * values[part], np.nan)
        x = np.broadcast_to(place[part, None], points.shape)
        color = part_color(number, len(groups))
        dots = {
            "linestyle": "",
            "marker": "o",
            "markersize": size,
            "markeredgewidth": 0,
            "color": color,
        }
        ax.plot(x.ravel(), points.ravel(), label=literal(text), **dots)
        mark_failed(ax, place[part][~study.done[part]], color if len(groups) > 1 else None)
    ax.set(xlabel=at.label, ylabel=fill(f"{shown.label} once a revolution", LABEL))
    explain(study, ax, others, chosen)
    return ax


def default_kind(study: Study, show: str | None, over: str, others: Sequence[str], chosen: np.ndarray) -> str:
    """A bifurcation diagram for Poincare points, a map over two numbers of many values, otherwise lines."""
    if show in POINTS:
        return "bifurcation"
    if len(others) == 1 and selection.is_number(study, over) and selection.is_number(study, others[0]):
        return "map" if len(selection.distinct(study[others[0]][chosen])) > LINES_UP_TO else "lines"
    return "lines"


def result(study: Study, name: str, revolutions: bool, pad: int | None) -> Result:
    """A result, (run,) or with `revolutions` (run, revolution); with `pad` that of a pad."""
    if name in (*DEFAULTS, *POINTS) and name not in study:
        raise ValueError(f"{study.path}: no {name} in this study: no run has it")
    results = [
        each
        for each in study.names()
        if each not in ("run", "file", "reason", *study.parameters) and study.about(each, "units")
    ]
    wanted = ("run", *(["revolution"] if revolutions else []), *(["pad"] if pad is not None else []))
    if not all(each in study for each in wanted):
        raise ValueError(f"{study.path}: no Poincare points in this study: no run has them")
    what = f"{'Poincare points' if revolutions else 'a result'}{' of a pad' if pad is not None else ''}"
    has = study.scales(name) if name in results else ()
    if "pad" in has and pad is None:
        raise selection.ArgumentError("{show}: {own} has a value for each pad: choose one by {pad}", own=name)
    if "revolution" in has and not revolutions:
        raise selection.ArgumentError("{show}: {own} is once a revolution: {kind} bifurcation", own=name)
    selection.needs(name, [each for each in results if study.scales(each) == wanted], "show", what)
    values, shown = study[name], described(study, name, POINTS.get(name, name.removeprefix("pad_")))
    if pad is None:
        return values, shown
    if not 1 <= pad <= (last := study.length("pad")):
        raise selection.ArgumentError(
            "{pad} {own}: must be 1 to {last}, the pads of this study", own=pad, last=last
        )
    return values[..., pad - 1], shown._replace(text=f"{shown.text}, pad {pad}")


def axis(study: Study, name: str, ax: Axes, which: str) -> tuple[Shown, np.ndarray]:
    """Unit of a parameter, positions of the runs along its axis, (run,); sets scale and ticks."""
    values = study[name]
    text = literal(study.about(name, "long_name") or name)
    if not selection.is_number(study, name):
        names = selection.distinct(values)
        place = np.array([names.index(value) if value in names else np.nan for value in values], dtype=float)
        ax.set(
            **{
                f"{which}ticks": range(len(names)),
                f"{which}ticklabels": [literal(selection.written(each)) for each in names],
            }
        )
        ax.set(**{f"{which}lim": (-0.5, len(names) - 0.5)})
        return Shown(text, 1, ""), place
    shown = units.shown(text, literal(study.about(name, "units")), values)
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
    """Name and runs of every combination of the other parameters; without runs of unknown values."""
    keys = list(zip(*(study[name] for name in others), strict=True)) if others else [()] * len(chosen)
    found: dict[tuple, list[int]] = {}
    for k in np.flatnonzero(chosen):
        if all(value == value and value != "" for value in keys[k]):
            found.setdefault(keys[k], []).append(int(k))
    rank = {name: selection.distinct(study[name]) for name in others}
    keys = sorted(found, key=lambda key: [rank[name].index(v) for name, v in zip(others, key, strict=True)])
    return [(", ".join(map(selection.written, key)), np.array(found[key])) for key in keys]


def too_many(groups: Sequence[tuple[str, np.ndarray]], others: Sequence[str]) -> None:
    if len(groups) > MOST_LINES:
        raise selection.ArgumentError(
            "{lines} lines, one for each {others}, are more than {most}: choose by {where}, or {kind} map",
            lines=len(groups),
            others=" and ".join(others),
            most=MOST_LINES,
        )


def mark_failed(ax: Axes, place: np.ndarray, color: str | None) -> None:
    """Lines across the axes, which no one takes for points."""
    style = NOT_DONE if color is None else NOT_DONE | {"color": color}
    for at in place[np.isfinite(place)]:
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
        title = ", ".join(label(study, name) for name in others)
        place = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "ncols": columns}
        ax.legend(handles, texts, title=literal(title) or None, **place)


def label(study: Study, name: str) -> str:
    """A parameter in words, with its unit."""
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


def parameters_in_words(study: Study) -> str:
    return f"its parameters are {', '.join(study.parameters) or 'none'}"
