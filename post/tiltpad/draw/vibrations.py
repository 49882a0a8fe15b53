"""Pictures of coefficients and modes: of studies over a parameter, of single results.

Every function takes results of the task coefficients or studies of them, and returns the figure.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tiltpad.calculate.coefficients import Coefficients
from tiltpad.calculate.coefficients import coefficients as coefficients_of
from tiltpad.calculate.modes import Modes, modes, of_journal
from tiltpad.calculate.response import STATION
from tiltpad.calculate.selection import Where, axis_of, needs, selected, varying, written
from tiltpad.draw.diagrams import mark_failed
from tiltpad.draw.layout import (
    COLUMN,
    DASHES,
    DENSE,
    PAGE,
    dots,
    heading,
    labels,
    of_several,
    part_color,
    title,
)
from tiltpad.files import units
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN, digits, literal

#: Elements of the matrices, and the columns of the panels in which they are.
DIRECT, CROSS = {"yy": (0, 0), "zz": (1, 1)}, {"yz": (0, 1), "zy": (1, 0)}
#: Most lines of one kind in a picture.
MOST = 10
#: Axes reach up to modes of this damping ratio.
DAMPED = 0.6
#: Frequencies of a Campbell diagram reach up to this multiple of the shaft's.
ORDERS = 2
#: Colours of the rings of unstable modes, of the journal and of pads.
UNSTABLE = ("C1", "C3")
#: Modes of pads in legends, and the part of the height above 0 that they take below it at most.
PADS, SHARE_OF_PADS = "pads", 0.25
#: Where a mode of the rotor has the frequency of the shaft.
CROSSING: dict[str, Any] = {"linestyle": "", "marker": "x", "color": "0.1", "markersize": 6, "zorder": 5}
#: Marks of the whirl of the rotor.
WHIRLS = {"forward": "^", "backward": "v", "planar": "D", "mixed": "s"}
#: Points of modes of the journal, and of pads.
POINTS: tuple[dict[str, Any], ...] = ({}, {"markerfacecolor": "none"})
#: Lines of modes of the journal, and of pads, which lie above them where both are equal.
LOOKS: tuple[dict[str, Any], ...] = (
    {},
    {"linestyle": DASHES[1], "markerfacecolor": "white", "zorder": 3},
)


class Part(NamedTuple):
    """Results that are drawn in one colour."""

    text: str  # its name in the legend
    source: Run | Study
    pivot: str | None  # of which pivots
    where: dict[str, Any]  # values of the study's parameters
    over: str  # parameter along the axis; empty for a result


@of_several
def coefficients(
    runs: Sequence[Run | Study], pivot: str | None = None, over: str | None = None, where: Where = None
) -> Figure:
    """Stiffness and damping of studies over a parameter (the speed), of results over the whirl frequency."""
    found = parts(runs, pivot, over, where)
    lines = list(coefficient_lines(found))
    fig, panels = plt.subplots(2, 2, sharex=True, figsize=(PAGE, 4.6))
    colors = [part_color(k, len(lines)) for k in range(len(lines))]
    for row, name in zip(panels, ("stiffness", "damping"), strict=True):
        for ax, elements in zip(row, (DIRECT, CROSS), strict=True):
            for color, (_, x, own) in zip(colors, lines, strict=True):
                for dashes, (i, j) in zip(DASHES, elements.values(), strict=False):
                    values = SHOWN[name].factor * getattr(own, name)[..., i, j]
                    ax.plot(x, values, dashes, color=color, **dots(len(x)) | POINTS[dashes != DASHES[0]])
                mark_failed(ax, x[np.isnan(values)], color if len(lines) > 1 else None)
            ax.set_ylabel(f"{SHOWN[name].text} {', '.join(elements)} ({SHOWN[name].unit})")
    for ax in panels[-1]:
        ax.set_xlabel(axis_label(found))
    marks = dots(max((len(x) for _, x, _ in lines), default=DENSE)) | {"color": "0.3"}
    dashed = [("yy or yz", marks), ("zz or zy", marks | POINTS[1] | {"linestyle": DASHES[1]})]
    heading(fig, [*names([text for text, *_ in lines]), *dashed], title(runs))
    return fig


def coefficient_lines(found: Sequence[Part]) -> Iterator[tuple[str, np.ndarray, Coefficients]]:
    """Name, places along the axis and coefficients of each line; of studies one for each frequency ratio."""
    for one in found:
        own = coefficients_of(one.source, one.pivot, where=one.where or None)
        if isinstance(one.source, Run):
            yield one.text, own.frequency_ratio, own
            continue
        order = np.argsort(own.parameters[one.over], kind="stable")
        ratios = list(range(len(own.frequency_ratio)))
        if len(found) > 1 or len(ratios) > MOST:
            ratios = [int(np.argmin(np.abs(own.frequency_ratio - 1)))]
        for k in ratios:
            many = len(own.frequency_ratio) > 1 and len(found) == 1
            text = f"{own.frequency_ratio[k]:g} × shaft speed" if many else one.text
            matrices = {name: getattr(own, name)[order, k] for name in ("stiffness", "damping")}
            yield text, own.parameters[one.over][order], own._replace(**matrices)


@of_several
def stability(
    runs: Sequence[Run | Study], pivot: str | None = None, over: str | None = None, where: Where = None
) -> Figure:
    """Damping ratio and logarithmic decrement of the modes, of results over their frequency.

    Modes of pads are hollow points; so is a line whose mode is one of pads at the last of its runs. The axes
    are for the modes of the rotor: pads below them are told in words. What the reduction of a shaft damps is
    left out.
    """
    found = parts(runs, pivot, over, where)
    named: list[tuple[str, dict[str, Any]]] = []
    fig, panels = plt.subplots(2, 1, sharex=True, figsize=(COLUMN, 4.2))
    for number, one in enumerate(found):
        own_color = part_color(number, len(found))
        own = modes(one.source, one.pivot, one.where or None, one.over or None)
        single = isinstance(one.source, Run)
        x = own.frequency if single else own.parameters[one.over]
        alone = not single and len(found) == 1
        shades = mode_colors(own) if alone else [own_color] * own.damping_ratio.shape[-1]
        last = own.name if single else last_names(own)
        journal, looks = of_journal(last), POINTS if single else LOOKS
        for ax, name in zip(panels, ("damping_ratio", "log_decrement"), strict=True):
            values = np.where(own.of_reduction, np.nan, SHOWN[name].factor * getattr(own, name))
            for k, shade in enumerate(shades):
                place = x[k] if single else x
                look = dots(np.size(place)) | looks[not journal[k]] | {"label": "" if journal[k] else PADS}
                ax.plot(place, values[..., k], color=shade, **look)
        if alone:
            named = mode_marks(own, last, shades)
        if not single:
            missing = x[np.isnan(own.frequency).all(axis=1)]
            mark_failed(panels[1], missing, own_color if len(found) > 1 else None)
        if one.over == "speed_rpm":
            mark_thresholds(panels, own, own_color if len(found) > 1 else "0.3")
    # every unstable mode is in sight in the upper panel
    decrement = 2 * np.pi * DAMPED / np.sqrt(1 - DAMPED**2)
    ends = {"damping_ratio": (-1, DAMPED), "log_decrement": (-decrement, decrement)}
    for ax, (name, end) in zip(panels, ends.items(), strict=True):
        show_from_zero(ax, *(SHOWN[name].factor * each for each in end))
        ax.set_ylabel(SHOWN[name].label)
    panels[1].set_xlabel(SHOWN["frequency"].label if isinstance(runs[0], Run) else axis_label(found))
    kind_looks = [{"marker": "o", "linestyle": ""} | look for look in POINTS]
    if not isinstance(runs[0], Run):
        kind_looks = [dots(2) | look for look in LOOKS]
    rotor = "shaft" if any(STATION in one.source for one in found) else "journal"
    kinds = [(name, {"color": "0.3"} | look) for name, look in zip((rotor, PADS), kind_looks, strict=True)]
    heading(fig, [*names([one.text for one in found]), *(named or kinds)], title(runs))
    return fig


def last_names(own: Modes) -> np.ndarray:
    """Of each mode of a study its name in the last run that has it, (mode,)."""
    there = own.name != ""
    last = len(there) - 1 - there[::-1].argmax(axis=0)
    return own.name[last, np.arange(there.shape[1])]


def mode_marks(own: Modes, last: np.ndarray, shades: Sequence[str]) -> list[tuple[str, dict[str, Any]]]:
    """The legend of the least damped modes in sight, (text, look): what moves, its last frequency."""
    marks, least = [], np.where(in_sight(own), np.nanmin(own.damping_ratio, axis=0), np.inf)
    for k in sorted(k for k in np.argsort(least)[:MOST] if np.isfinite(least[k])):
        frequency = own.frequency[own.name[:, k] != "", k][-1]
        look = dots(2) | LOOKS[not of_journal(last[k : k + 1])[0]] | {"color": shades[k]}
        marks.append((f"{last[k]}, {frequency:.0f} Hz", look))
    return marks


def in_sight(own: Modes) -> np.ndarray:
    """The modes of a study that the axes reach, but for those of the reduction of a shaft, (mode,)."""
    there = ~np.isnan(own.damping_ratio) & ~own.of_reduction
    return np.where(there, own.damping_ratio, np.inf).min(axis=0) < DAMPED


def mode_colors(own: Modes) -> list[str]:
    """A colour for each mode of a study; those that are in sight have different ones."""
    order = np.cumsum(in_sight(own))
    return [part_color(max(0, k - 1), order.max(initial=1)) for k in order]


def mark_thresholds(panels: Sequence[Axes], own: Modes, color: str) -> None:
    """Dotted lines at the speeds at which a mode turns unstable."""
    place = {"xycoords": ("data", "axes fraction"), "xytext": (-2, -2), "textcoords": "offset points"}
    look = {"ha": "right", "va": "top", "fontsize": "x-small", "rotation": 90}
    for speed in np.unique(np.round(own.threshold_rpm[np.isfinite(own.threshold_rpm)], 3)):
        for ax in panels:
            ax.axvline(speed, color=color, linestyle=":", linewidth=0.8)
        panels[0].annotate(f"{speed:.0f} rpm", (speed, 1), color=color, **place, **look)


def show_from_zero(ax: Axes, bottom: float, top: float) -> None:
    """Lets the axis reach from 0 or the lowest value to the highest, within these; marks what is unstable.

    Lines of pads take at most a share of it below 0; how far they go there is said.
    """
    of_pads, of_rotor = [np.zeros(1)], [np.zeros(1)]
    for line in ax.get_lines():
        (of_pads if line.get_label() == PADS else of_rotor).append(np.asarray(line.get_ydata(), float))
    rotor, pads = np.concatenate(of_rotor), np.concatenate(of_pads)
    high = np.nanmax(np.concatenate([rotor, pads]))
    end = 1.05 * high if high < top else top
    least = np.nanmin(pads)
    low = max(min(np.nanmin(rotor), max(least, -SHARE_OF_PADS * end)), bottom)
    if least < 1.05 * low:
        look = {"ha": "right", "va": "bottom", "fontsize": "x-small", "color": "0.3"}
        words = f"pads to \N{MINUS SIGN}{digits(-least, 2)}"
        ax.text(0.99, 0.01, words, transform=ax.transAxes, **look)
    ax.axhline(0, color="0.3", linewidth=0.8)
    if low < 0:
        ax.axhspan(1.05 * low, 0, color="C1", alpha=0.12, linewidth=0)
    ax.set_ylim(1.05 * low, end if end > 0 else None)


@of_several
def campbell(
    runs: Sequence[Run | Study], pivot: str | None = None, over: str | None = None, where: Where = None
) -> Figure:
    """Frequencies of the modes over the speed of studies, with the whirl of the journal and the damping.

    Modes of the journal and those of pads have marks of their own, also where they are unstable.
    """
    for each in runs:
        if isinstance(each, Run):
            needed = "a study over the speed, not of one speed"
            raise NotInRunError(f"{each.path}: a Campbell diagram is of {needed}")
    needs(over or "speed_rpm", ("speed_rpm",), "over", "the parameter of a Campbell diagram")
    found = parts(runs, pivot, "speed_rpm", where)
    fig, ax = plt.subplots(figsize=(COLUMN, 3.2))
    top = 0.0
    # what the picture has, and its legend names
    told: set[str] = set()
    for number, one in enumerate(found):
        own_color = part_color(number, len(found))
        own = modes(one.source, one.pivot, one.where or None)
        shown = (own.frequency > 0) & ~own.of_reduction
        own = own._replace(frequency=np.where(shown, own.frequency, np.nan))
        told |= kinds(own)
        shade = own_color if len(found) > 1 else "0.8"
        # modes of pads leap from run to run: they are points alone
        of_rotor = np.where(of_journal(own.name), own.frequency, np.nan)
        ax.plot(own.speed_rpm, of_rotor, color=shade, linewidth=0.8, zorder=1)
        crossed = crossings(own.speed_rpm, of_rotor)
        told |= {"crossing"} if len(crossed[0]) else set()
        ax.plot(*crossed, **CROSSING)
        points = campbell_points(ax, own, own_color if len(found) > 1 else None)
        mark_failed(ax, own.speed_rpm[np.isnan(own.frequency).all(axis=1)], None)
        top = max(top, ORDERS * own.speed_rpm.max() / 60)
    if len(found) == 1:
        fig.colorbar(points, ax=ax, label=SHOWN["log_decrement"].label, extend="max")
    ends = np.array(ax.get_xlim())
    for order, dashes in ((1, "-"), (0.5, "--")):
        ax.plot(ends, order * ends / 60, dashes, color="0.3", linewidth=0.8, zorder=0)
    ax.set(xlim=ends, ylim=(0, top), xlabel=SHOWN["speed"].label, ylabel=SHOWN["frequency"].label)
    mark: dict[str, Any] = {"linestyle": "", "color": "0.3", "markersize": 4}
    ring = mark | {"marker": "o", "markerfacecolor": "none", "markersize": 7}
    rotor = "shaft" if any(STATION in one.source for one in found) else "journal"
    whirls = [(word, each) for word, each in WHIRLS.items() if word in told]
    marks = [(f"{rotor} {word}", mark | {"marker": each}) for word, each in whirls]
    marks += [("pads", mark | {"marker": "o", "markersize": 2})] if "pads" in told else []
    rings = zip(("unstable", "pads unstable"), (f"{rotor} unstable", "pad unstable"), UNSTABLE, strict=True)
    marks += [(text, ring | {"markeredgecolor": color}) for kind, text, color in rings if kind in told]
    marks += [("crossing", CROSSING)] if "crossing" in told else []
    marks += [("shaft speed", {"color": "0.3"}), ("0.5x", {"color": "0.3", "linestyle": "--"})]
    heading(fig, [*names([one.text for one in found]), *marks], title(runs))
    return fig


def kinds(own: Modes) -> set[str]:
    """The kinds of modes, with a frequency, that the points of a Campbell diagram are of."""
    seen = np.isfinite(own.frequency)
    journal, growing = of_journal(own.name) & seen, (own.log_decrement < 0) & seen
    found = {str(each).rpartition(", ")[-1] for each in np.unique(own.name[journal])}
    held = {"pads": seen & ~journal, "unstable": growing & journal, "pads unstable": growing & ~journal}
    return found | {kind for kind, where in held.items() if where.any()}


def crossings(speed_rpm: np.ndarray, frequency: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Speeds, rpm, and frequencies where modes, (run, mode), have that of the shaft; linear between runs."""
    away = frequency - speed_rpm[:, None] / 60
    run, mode = np.nonzero(away[:-1] * away[1:] < 0)
    before, after = away[run, mode], away[run + 1, mode]
    speed = speed_rpm[run] + before / (before - after) * (speed_rpm[run + 1] - speed_rpm[run])
    return speed, speed / 60


def campbell_points(ax: Axes, own: Modes, color: str | None) -> Any:
    """Points of all modes, those of the journal by its whirl; without a colour by their damping."""
    speed = np.broadcast_to(own.speed_rpm[:, None], own.frequency.shape)
    look: dict[str, Any] = {"zorder": 3, "linewidths": 0}
    if color is None:
        look |= {"vmin": 0, "vmax": 3, "cmap": "viridis"}
    journal = of_journal(own.name)
    whirls = [(journal & np.char.endswith(own.name, word), marker, 14) for word, marker in WHIRLS.items()]
    for part, marker, size in ((~journal, "o", 6), *whirls):
        colours = {"c": own.log_decrement[part]} if color is None else {"color": color}
        points = ax.scatter(speed[part], own.frequency[part], marker=marker, s=size, **look, **colours)
    ring = {"s": 45, "facecolors": "none", "zorder": 4}
    for part, shade in zip((journal, ~journal), UNSTABLE, strict=True):
        growing = part & (own.log_decrement < 0)
        ax.scatter(speed[growing], own.frequency[growing], edgecolors=shade, **ring)
    return points


def parts(sources: Sequence[Run | Study], pivot: str | None, over: str | None, where: Where) -> list[Part]:
    """What is drawn in a colour of its own: files, pivots (of results all), values of other parameters."""
    if len({isinstance(each, Run) for each in sources}) > 1:
        raise ValueError("results and studies do not go into one picture")
    found = []
    for source, name in zip(sources, labels(sources) if len(sources) > 1 else [""], strict=True):
        pivots: Sequence[str | None] = [pivot]
        if pivot is None and "pivot" in source:
            every = [str(each) for each in source["pivot"]]
            pivots = every if isinstance(source, Run) else every[:1]
        for own, (text, kept, along) in product(pivots, groups(source, over, dict(where or {}))):
            words = (name, own if len(pivots) > 1 else "", text)
            found.append(Part(", ".join(word for word in words if word), source, own, kept, along))
    if not found:
        raise NotInRunError(f"{sources[0].path}: no run in this study whose parameters are known")
    if len(found) > MOST:
        many = f"{len(found)} kinds of lines are more than {MOST}"
        raise ValueError(f"{many}: choose by where; a sample is drawn by scatter")
    return found


def in_unit(name: str, value: Any, among: np.ndarray) -> str:
    """A value of a parameter with its name, in the unit of all its values: "radius difference 100 µm"."""
    if isinstance(value, str):
        return f"{name} {written(value)}"
    shown = units.shown(*units.named(name), among)
    return f"{shown.text} {shown.factor * value:g} {shown.unit}".rstrip()


def groups(
    source: Run | Study, over: str | None, where: dict[str, Any]
) -> list[tuple[str, dict[str, Any], str]]:
    """Name and values of every combination of the parameters that are not along the axis, and that one."""
    if isinstance(source, Run):
        return [("", where, "")]
    chosen = selected(source, where)
    along = axis_of(source, over, chosen)
    others = [name for name in varying(source, chosen) if name != along]
    keys = dict.fromkeys(zip(*(source[name][chosen] for name in others), strict=True) if others else [()])
    known = [key for key in keys if all(value == value and value != "" for value in key)]
    found = [dict(zip(others, key, strict=True)) for key in known]
    words = [", ".join(in_unit(name, value, source[name]) for name, value in own.items()) for own in found]
    return [(text, where | own, along) for text, own in zip(words, found, strict=True)]


def axis_label(found: Sequence[Part]) -> str:
    """What is along the axis of coefficients."""
    source = found[0].source
    if isinstance(source, Run):
        return "whirl frequency over shaft speed"
    text, unit = (literal(source.about(found[0].over, each)) for each in ("long_name", "units"))
    return units.Shown(text or literal(found[0].over), 1, "" if unit == "1" else unit).label


def names(texts: Sequence[str]) -> list[tuple[str, dict[str, Any]]]:
    """Entries of the legend, with the colours of the parts; none for a part without a name."""
    colors = [{"color": part_color(k, len(texts))} for k in range(len(texts))]
    return [(literal(text), color) for text, color in zip(texts, colors, strict=True) if text]
