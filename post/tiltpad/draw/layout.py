"""Parts of pictures: names of runs, colours, legends, panels, further axes."""

import textwrap
from collections.abc import Callable, Hashable, Iterable, Sequence
from functools import wraps
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import ConnectionPatch, Rectangle

from tiltpad.calculate import differences, signals
from tiltpad.files.read import Run, needs_run
from tiltpad.files.study import Study

COLUMN, PAGE = 3.35, 6.9  # widths in a paper, inches
LONGEST_LABEL = 90  # characters
DASHES = ("-", "--", ":", "-.")


def of_several(draw: Callable[..., Figure]) -> Callable[..., Figure]:
    """Lets `draw`, a picture of results, be called with one, and say what is wrong with anything else."""

    @wraps(draw)
    def drawn(runs: Run | Study | Sequence[Run | Study], *arguments: Any, **options: Any) -> Figure:
        several = [runs] if isinstance(runs, Run | Study | str) else list(runs)
        if not several:
            raise ValueError("no result to draw")
        for each in several:
            if not isinstance(each, Study):
                needs_run(each)
        return draw(several, *arguments, **options)

    return drawn


def labels(runs: Sequence[Run | Study]) -> list[str]:
    """Different names for runs: their titles, else the differences of their inputs, else their files."""
    titles = [run.title for run in runs]
    stems = [Path(run.path).stem for run in runs]
    inputs = [run.input for run in runs if isinstance(run, Run)]
    for texts in (titles, differences.differences(inputs) if inputs else [], stems):
        if len(set(texts)) == len(runs) and all(0 < len(text) <= LONGEST_LABEL for text in texts):
            return texts
    return [run.path for run in runs]


def look(run: int, part: int | None, runs: Sequence[Run]) -> dict[str, Any]:
    """Colour and dashes of a line: colours are for the parts (y, z; pads) of one run, or for several runs."""
    if len(runs) == 1:
        return {"color": "0.2" if part is None else f"C{part}"}
    return {"color": f"C{run}", "linestyle": DASHES[(part or 0) % len(DASHES)]}


def parts(texts: Sequence[str], runs: Sequence[Run]) -> list[tuple[str, dict[str, Any]]]:
    """Legend entries of the parts of every run; none for a single part."""
    neutral = {"color": "0.3"} if len(runs) > 1 else {}
    return [(text, look(0, k, runs) | neutral) for k, text in enumerate(texts) if len(texts) > 1]


def legend(fig: Figure, runs: Sequence[Run], marks: Sequence[tuple[str, dict[str, Any]]]) -> None:
    """Above the panels: the runs (for one run its title), and the meaning of lines and marks."""
    names = labels(runs) if len(runs) > 1 else [runs[0].title]
    names = [plain(name, width(fig)) for name in names]
    if len(runs) > 1:
        heading(fig, [*((name, {"color": f"C{i}"}) for i, name in enumerate(names)), *marks], "")
    else:
        heading(fig, marks, names[0])


def heading(fig: Figure, entries: Sequence[tuple[str, dict[str, Any]]], title: str) -> None:
    """Above the panels: a title (may be empty), and lines and marks with their meaning."""
    if not entries:
        fig.suptitle(title)
        return
    handles = [Line2D([], [], label=text, **style) for text, style in entries]
    longest = max(len(line) for text, _ in entries for line in text.splitlines())
    columns = max(1, width(fig) // (longest + 6))
    fig.legend(handles=handles, title=title or None, loc="outside upper center", ncols=columns)
    lines = len(title.splitlines()) + sum(len(text.splitlines()) for text, _ in entries) / columns
    fig.set_figheight(fig.get_figheight() + 0.15 * max(0, lines - 1))


def plain(text: str, characters: int) -> str:
    """A text in lines of a number of characters, in which a dollar sign does not start a formula."""
    return textwrap.fill(text.replace("$", r"\$"), characters)


def width(fig: Figure) -> int:
    """Number of characters that fit on a line."""
    return int(15 * fig.get_figwidth())


def shown_pads(runs: Sequence[Run], pad: int | None) -> list[int]:
    """The given pad, or all pads that every run has."""
    if pad is None:
        return list(range(1, min(run.pads for run in runs) + 1))
    for run in runs:
        signals.pad_column(run, pad)
    return [pad]


def drawn(name: str, pads: Sequence[int]) -> Iterable[tuple[int | None, int | None]]:
    """Number of the part and pad of every line of a dataset; (None, None) for the journal."""
    return [(None, None)] if name.startswith("journal") else enumerate(pads)


def stacked(names: Sequence[Hashable]) -> tuple[Figure, dict[Hashable, Axes]]:
    """Panels above each other, one for each dataset, with one horizontal axis."""
    fig = plt.figure(figsize=(COLUMN, 0.6 + 1.2 * len(names)))
    panels = fig.subplots(len(names), 1, sharex=True)
    fig.align_ylabels(panels)
    for ax in panels[:-1]:
        ax.xaxis.label.set_visible(False)
    panels[-1].locator_params(axis="x", nbins=6)
    return fig, dict(zip(names, panels, strict=True))


def panel_a_pad(runs: Sequence[Run], pad: int | None) -> tuple[Figure, dict[int, Axes]]:
    """A panel for each of the shown pads, two in a row."""
    pads = shown_pads(runs, pad)
    columns = min(2, len(pads))
    rows = -(-len(pads) // columns)
    fig = plt.figure(figsize=(COLUMN if columns == 1 else PAGE, 2.8 * rows))
    panels = fig.subplots(rows, columns, squeeze=False).ravel()
    for ax in panels[len(pads) :]:
        ax.remove()
    for ax in panels[: len(pads)]:
        ax.locator_params(axis="x", nbins=6)
    return fig, dict(zip(pads, panels, strict=False))


def mark_enlarged(whole: Axes, part: Axes) -> None:
    """Draws a frame in `whole` around the limits of `part`, to its right, and lines from one to the other."""
    part.figure.draw_without_rendering()  # equal axes get their limits when they are drawn
    (left, right), (low, high) = part.get_xlim(), part.get_ylim()
    line = {"edgecolor": "0.65", "linewidth": 0.6, "in_layout": False}
    whole.add_patch(Rectangle((left, low), right - left, high - low, facecolor="none", **line))
    for y, corner in ((low, (0, 0)), (high, (0, 1))):
        whole.add_artist(ConnectionPatch((right, y), corner, whole.transData, part.transAxes, **line))


def order_axis(ax: Axes, frequency: float, step: int) -> None:
    """Along the top: frequency over shaft frequency."""
    top = ax.secondary_xaxis("top", functions=(lambda x: x / frequency, lambda x: x * frequency))
    top.set_xlabel("order (multiples of shaft speed)")
    top.xaxis.set_major_locator(plt.MultipleLocator(step))


def top_axis(ax: Axes, x: np.ndarray, value: np.ndarray, label: str) -> None:
    """Along the top: `value` at x, extrapolated beyond the ends; both rise or fall throughout."""
    x, value = (np.concatenate([[2 * a[0] - a[1]], a, [2 * a[-1] - a[-2]]]) for a in (x, value))
    order = np.argsort(value)
    functions = (lambda at: np.interp(at, x, value), lambda at: np.interp(at, value[order], x[order]))
    ax.secondary_xaxis("top", functions=functions).set_xlabel(label)
