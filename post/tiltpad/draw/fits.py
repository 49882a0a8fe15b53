"""Pictures of fits: what was measured, and the same of the model before and after."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tiltpad.calculate.measured import MATRICES, STATIC, TIME, Measured
from tiltpad.calculate.tables import ELEMENTS
from tiltpad.draw import layout, plots
from tiltpad.files import units
from tiltpad.files.units import SHOWN

#: Positions of the journal, z to the right.
ORBIT, POSITION = ("journal_z", "journal_y"), (f"{STATIC}journal_z", f"{STATIC}journal_y")
LABELS = (SHOWN["journal_z"].label, SHOWN["journal_y"].label)
#: How measured, start and fitted are drawn.
POINTS: dict[str, Any] = {"color": "0.45", "linestyle": "", "marker": ".", "markersize": 3}
START: dict[str, Any] = {"color": "C1", "linestyle": "--", "linewidth": 0.8}
FITTED: dict[str, Any] = {"color": "C0"}
LOOKS = (POINTS, START, FITTED)
#: Marks of points that are no line.
MARKS = tuple({"marker": each, "markersize": 5} for each in ".+x")
Values = Mapping[str, Any]


class Panel(NamedTuple):
    """One pair of axes of a picture."""

    title: str
    labels: tuple[str, str]  # of both axes
    parts: Sequence[tuple[np.ndarray, ...]]  # points of measured, start and fitted, (x, y) each
    joined: bool = True  # whether they are a line
    names: tuple[str, ...] = ()  # of the points along x, where they have names


def comparison(
    measured: Sequence[Measured], started: Sequence[Values], fitted: Sequence[Values], told: Sequence[str]
) -> Figure:
    """What was measured, and the same of the model at the start of a fit and fitted; below it what is told.

    A panel for each orbit, waveform and matrix of a test, and one for all static positions.
    """
    found = [*panels(measured, started, fitted)]
    with plt.style.context(plots.STYLE):
        fig, axes = layout.grid(len(found), 2.7)
        for ax, panel in zip(axes, found, strict=True):
            draw(ax, panel)
        layout.heading(fig, legend(found), "")
        for text in told:
            layout.remark(fig, text)
        layout.spread(fig)
    return fig


def legend(found: Sequence[Panel]) -> list[tuple[str, dict[str, Any]]]:
    """Measured, start and fitted as the panels have them: lines, marks, or both where panels differ."""
    joined, alone = (any(panel.joined is each for panel in found) for each in (True, False))
    both = {} if joined else {"linestyle": ""}
    looks = [look | (mark | both if alone else {}) for look, mark in zip(LOOKS, MARKS, strict=True)]
    return [*zip(("measured", "start", "fitted"), looks, strict=True)]


def draw(ax: Axes, panel: Panel) -> None:
    """Measured as points, start and fitted as lines or marks."""
    for (x, y), look, mark in zip(panel.parts, LOOKS, MARKS, strict=True):
        ax.plot(x, y, **look if panel.joined else look | mark | {"linestyle": ""})
    ax.set(title=panel.title, xlabel=panel.labels[0], ylabel=panel.labels[1])
    if panel.names:
        ax.set_xticks(range(len(panel.names)), panel.names)
        ax.margins(x=0.15)
    if panel.labels == LABELS:
        ax.set(box_aspect=1, aspect="equal", adjustable="datalim")


def panels(
    measured: Sequence[Measured], started: Sequence[Values], fitted: Sequence[Values]
) -> Iterator[Panel]:
    """The panels of all tests."""
    tests = [*zip(measured, started, fitted, strict=True)]
    static = [each for each in tests if all(name in each[0].values for name in POSITION)]
    if static:
        parts = [tuple(of_all(static, k, name) for name in POSITION) for k in range(3)]
        yield Panel("static positions", LABELS, parts, joined=False)
    for number, test in enumerate(tests, 1):
        where = f"test {number}: " if len(tests) > 1 else ""
        own = test[0]
        if TIME not in own.values and all(name in own.values for name in ORBIT):
            parts = [tuple(centred(own, each, name) for name in ORBIT) for each in values_of(test)]
            yield Panel(f"{where}orbit", LABELS, [parts[0], *map(closed, parts[1:])])
        for name in own.names:
            yield from single(own, test, name, where)


def single(own: Measured, test: tuple[Measured, Values, Values], name: str, where: str) -> Iterator[Panel]:
    """The panels of what has panels of its own: a series, a matrix, other values."""
    several = [np.asarray(each[name]) for each in values_of(test)]
    if name in MATRICES:
        shown = units.fitted(SHOWN[name], several[2])
        flat = [(np.arange(each.size), shown.factor * each.ravel()) for each in several]
        names = ELEMENTS if several[0].size == len(ELEMENTS) else ()
        yield Panel(f"{where}{name}", ("", shown.label), flat, False, names)
    elif several[0].ndim and (TIME in own.values or name not in ORBIT):
        shown = units.fitted(SHOWN[name], several[2]) if name in SHOWN else units.Shown(name, 1, "")
        x = own.values.get(TIME, np.arange(len(several[0])) / len(several[0]) * own.revolutions)
        columns = several[0].shape[1] if several[0].ndim > 1 else 1
        for k in range(columns):
            pad = f", pad {k + 1}" if columns > 1 else ""
            values = (shown.factor * own.centred(each).reshape(len(x), -1)[:, k] for each in several)
            over = SHOWN[TIME].label if TIME in own.values else "revolutions"
            yield Panel(f"{where}{shown.text}{pad}", (over, shown.label), [(x, each) for each in values])


def values_of(test: tuple[Measured, Values, Values]) -> tuple[Values, Values, Values]:
    """Values of measured, start and fitted."""
    return test[0].values, test[1], test[2]


def of_all(tests: list[tuple[Measured, Values, Values]], part: int, name: str) -> np.ndarray:
    """A single value of all tests in the units of pictures."""
    shown = SHOWN[name.removeprefix(STATIC)]
    return shown.factor * np.array([float(values_of(each)[part][name]) for each in tests])


def centred(own: Measured, values: Values, name: str) -> np.ndarray:
    """A position over a revolution in the units of pictures."""
    return SHOWN[name].factor * own.centred(np.asarray(values[name]))


def closed(part: tuple[np.ndarray, ...]) -> tuple[np.ndarray, ...]:
    """An orbit with its first point at its end again."""
    return tuple(np.append(each, each[0]) for each in part)
