"""Parts of pictures: names of runs, colours, legends, panels, further axes."""

import textwrap
from collections.abc import Callable, Hashable, Iterable, Sequence
from functools import cached_property, wraps
from inspect import Parameter, signature
from pathlib import Path
from typing import IO, Any, TypeVar

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backend_bases import get_registered_canvas_class
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import ConnectionPatch, FancyArrowPatch, Rectangle
from matplotlib.transforms import BboxTransformTo

from tiltpad.calculate import differences, signals
from tiltpad.files.read import Bearing, Run, needs_run
from tiltpad.files.station import Station
from tiltpad.files.study import Study
from tiltpad.files.units import literal

Name = TypeVar("Name", bound=Hashable)
COLUMN, PAGE = 3.35, 6.9  # widths in a paper, inches
LONGEST_LABEL = 90  # characters
#: Options of every picture: the revolutions at the end of a run, and the pad that are shown.
COMMON = ("last", "pad")
#: Colours of temperatures.
WARMTH = "YlOrRd"
#: Dashes of the parts of runs; no bearing of practice has more pads.
DASHES = (
    *("-", "--", ":", "-.", (0, (7, 1.5, 1, 1.5, 1, 1.5)), (0, (9, 3)), (0, (1, 4))),
    *((0, (3, 1, 1, 1, 1, 1, 1, 1)), (0, (12, 2, 3, 2))),
)
#: From this number of points on, a line has no marks.
DENSE = 60
#: From this number of runs on, their points are small.
CLOUD = 500
#: More runs or parts than this have colours along a scale.
FEW = 7
SCALE = "viridis"
#: An axis reaches over this share of its largest number at least: what does not move is a flat line.
SHORTEST_AXIS = 2e-4
#: A picture file has this number of remarks under it; the report has all.
MOST_REMARKS = 3
#: Of more runs of a study that were not done, a picture has only the number.
FEW_FAILURES = 20


class Several(list):
    """The results of a picture, with what is found from all their inputs once."""

    @cached_property
    def scale(self) -> tuple[str, list[float]] | None:
        """Label and values of the number in which many results differ, if it is one."""
        return differences.varied([run.input for run in self]) if len(self) > FEW else None

    @cached_property
    def colors(self) -> list[str]:
        """A colour for each result; of many along a scale, over the number in which they differ."""
        if len(self) <= FEW:
            return [f"C{i}" for i in range(len(self))]
        values = self.scale[1] if self.scale else list(range(len(self)))
        norm = Normalize(min(values), max(values))
        return [to_hex(mpl.colormaps[SCALE](0.93 * norm(value))) for value in values]


def together(runs: Sequence[Run | Study]) -> Several:
    return runs if isinstance(runs, Several) else Several(runs)


def of_several(draw: Callable[..., Figure]) -> Callable[..., Figure]:
    """Lets `draw`, a picture of results, be called with one, and say what is wrong with anything else.

    Every picture takes `last` and `pad` behind the results, also one that does not use them.
    """
    first, *own = signature(draw).parameters.values()
    common = [Parameter(name, first.kind, default=None, annotation=float | None) for name in COMMON]
    others = [each for each in own if each.name not in COMMON]
    whole = signature(draw).replace(parameters=[first, *common, *others])

    @wraps(draw)
    def drawn(runs: Run | Study | Sequence[Run | Study], *arguments: Any, **options: Any) -> Figure:
        given = whole.bind(runs, *arguments, **options).arguments
        several = Several([runs] if isinstance(runs, Run | Study | str) else runs)
        if not several:
            raise ValueError("no result to draw")
        for each in several:
            if not isinstance(each, Study):
                needs_run(each)
        fig = draw(several, **{each.name: given[each.name] for each in own if each.name in given})
        if all(isinstance(each, Station) for each in several):
            say_shaft(fig)
        for each in several:
            remark_unfinished(fig, each, Path(each.path).stem if len(several) > 1 else "")
        spread(fig)
        return fig

    vars(drawn)["__signature__"] = whole
    return drawn


def say_shaft(fig: Figure) -> None:
    """Calls what stations do by the shaft, and not by a journal, at the axes."""
    for ax in fig.axes:
        ax.set_xlabel(ax.get_xlabel().replace("journal", "shaft"))
        ax.set_ylabel(ax.get_ylabel().replace("journal", "shaft"))
        ax.set_title(ax.get_title().replace("journal", "shaft"), fontsize=ax.title.get_fontsize())


def remark_unfinished(fig: Figure, source: Run | Study, name: str = "") -> None:
    """Says below the picture that a run did not come to its end, or which runs of a study, and why.

    Of a study also how many of its runs have remarks.
    """
    name = name and f"{name}: "
    if isinstance(source, Run):
        if not source.complete:
            remark(fig, f"{name}incomplete{source.end()}", "C1")
        return
    failed, pending, remarked = (int(each.sum()) for each in (source.failed, source.pending, source.remarked))
    if pending:
        remark(fig, f"{name}{not_run_yet(pending)}", "C1")
    if remarked:
        known = f"remarks on {remarked} of {len(source.status)} runs"
        remark(fig, f"{name}{known}; the report of the study counts them")
    # where the reason stands comes first, its numbers are in the report
    for each in source.failures(MOST_REMARKS) if failed <= FEW_FAILURES else []:
        remark(fig, name + textwrap.shorten(str(each), 3 * width(fig), placeholder=" ..."), "C1")
    if failed > FEW_FAILURES:
        remark(fig, f"{failed} runs were not done; the report of the study has the reasons", "C1")
    elif failed > MOST_REMARKS:
        remark(fig, f"and {failed - MOST_REMARKS} more; the report of the study has all", "C1")


def not_run_yet(pending: int) -> str:
    """That runs are still to be run, in words."""
    return "1 run has not been run yet" if pending == 1 else f"{pending} runs have not been run yet"


def remark(fig: Figure, text: str, color: str = "0.3") -> None:
    """A line below the picture, under those that are there."""
    before, added = fig.get_supxlabel(), plain(text, int(1.25 * width(fig)))
    look = {"x": 0.01, "ha": "left", "fontsize": "x-small", "color": color}
    fig.supxlabel("\n".join(line for line in (before, added) if line), **look)
    fig.set_figheight(fig.get_figheight() + 0.1 * len(added.splitlines()))


def write(fig: Figure, stream: IO[bytes], form: str, **more: Any) -> None:
    """Writes a picture in a format, as Figure.savefig does, which draws it all twice: once for the layout."""
    fig.set_dpi(mpl.rcParams["savefig.dpi"])
    canvas = get_registered_canvas_class(form)(fig)
    getattr(canvas, f"print_{form}")(stream, **more)


def spread(fig: Figure) -> None:
    """Lets no linear axis be so short that its ticks would need an offset."""
    for ax in fig.axes:
        for axis, limits in ((ax.xaxis, ax.set_xlim), (ax.yaxis, ax.set_ylim)):
            low, high = axis.get_view_interval()
            least = SHORTEST_AXIS * max(abs(low), abs(high))
            if axis.get_scale() == "linear" and abs(high - low) < least:
                limits((low + high - least) / 2, (low + high + least) / 2)


def labels(runs: Sequence[Run | Study]) -> list[str]:
    """Different names for runs: their titles, else the differences of their inputs, else their files.

    Bearings and stations of one machine have their own names; its title stands above the picture.
    """
    if machine_of(runs):
        return [run.label for run in runs if isinstance(run, Bearing)]
    titles = [run.title for run in runs]
    stems = [Path(run.path).stem for run in runs]
    inputs = [run.input for run in runs if isinstance(run, Run)]
    for texts in (titles, differences.differences(inputs) if inputs else [], stems):
        if len(set(texts)) == len(runs) and all(0 < len(text) <= LONGEST_LABEL for text in texts):
            return texts
    return [run.path for run in runs]


def machine_of(runs: Sequence[Run | Study]) -> Run | None:
    """The machine of which several runs are the bearings; None where they are not."""
    machines = [run.machine if isinstance(run, Bearing) else None for run in runs]
    return machines[0] if len(runs) > 1 and all(each is machines[0] for each in machines) else None


def title(runs: Sequence[Run | Study]) -> str:
    """Of one run its own; of the bearings of a machine that of the machine; else empty."""
    if len(runs) == 1:
        return runs[0].title or Path(runs[0].path).stem
    machine = machine_of(runs)
    return machine.title if machine else ""


def colors(runs: Sequence[Run]) -> list[str]:
    """A colour for each run, as Several has them."""
    return together(runs).colors


def part_color(part: int, parts: int = FEW) -> str:
    """A colour for a part of a run; of many parts along a scale."""
    return f"C{part}" if parts <= FEW else to_hex(mpl.colormaps[SCALE](0.93 * part / (parts - 1)))


def look(run: int, part: int | None, runs: Sequence[Run]) -> dict[str, Any]:
    """Colour and dashes of a line: colours are for the parts (y, z; pads) of one run, or for several runs."""
    if len(runs) == 1:
        return {"color": "0.2" if part is None else part_color(part, max(FEW, runs[0].pads))}
    return {"color": colors(runs)[run], "linestyle": DASHES[(part or 0) % len(DASHES)]}


def parts(texts: Sequence[str], runs: Sequence[Run]) -> list[tuple[str, dict[str, Any]]]:
    """Legend entries of the parts of every run; none for a single part."""
    neutral = {"color": "0.3"} if len(runs) > 1 else {}
    return [(text, look(0, k, runs) | neutral) for k, text in enumerate(texts) if len(texts) > 1]


def orbit_marks(runs: Sequence[Run]) -> list[tuple[str, dict[str, Any]]]:
    """Legend entries of orbits and of their equilibria."""
    color = {"color": "0.3" if len(runs) > 1 else "C0"}
    return [("orbit", color), ("equilibrium", color | {"linestyle": "", "marker": "+"})]


def dots(points: int) -> dict[str, Any]:
    """Marks of the points of a line, unless they would hide it."""
    return {"marker": "o", "markersize": 3} if points < DENSE else {}


def cloud(runs: int) -> dict[str, Any]:
    """Points of this number of runs, small where they are many."""
    size = 3.5 if runs < CLOUD else 2
    return {"linestyle": "", "marker": ".", "markersize": size, "markeredgewidth": 0, "rasterized": True}


def legend(fig: Figure, runs: Sequence[Run], marks: Sequence[tuple[str, dict[str, Any]]], **own: Any) -> None:
    """Above the panels: the runs (for one run its title), and the meaning of lines and marks.

    Runs are lines, with the look `own`. Many runs that differ in one number have a scale of its values.
    """
    if scale := together(runs).scale:
        label, values = scale
        bar = ScalarMappable(Normalize(min(values), max(values) + 0.07 * np.ptp(values)), SCALE)
        drawn = fig.colorbar(bar, ax=fig.axes, label=label, aspect=40, fraction=0.05)
        drawn.ax.set_ylim(min(values), max(values))
        heading(fig, marks, "")
    elif len(runs) > 1:
        names = [plain(name, width(fig)) for name in labels(runs)]
        looks = [own | {"color": color} for color in colors(runs)]
        heading(fig, [*zip(names, looks, strict=True), *marks], title(runs))
    else:
        heading(fig, marks, runs[0].title)


def heading(fig: Figure, entries: Sequence[tuple[str, dict[str, Any]]], title: str) -> None:
    """Above the panels: a title of the user (may be empty), and lines and marks with their meaning."""
    title = plain(title, width(fig))
    if not entries:
        fig.suptitle(title)
        return
    handles = [Line2D([], [], label=text, **style) for text, style in entries]
    columns = columns_of([text for text, _ in entries], width(fig))
    # long enough to tell dashes from one another
    look = {"loc": "outside upper center", "ncols": columns, "handlelength": 3}
    fig.legend(handles=handles, title=title or None, **look)
    lines = len(title.splitlines()) + sum(len(text.splitlines()) for text, _ in entries) / columns
    fig.set_figheight(fig.get_figheight() + 0.15 * max(0, lines - 1))


def columns_of(texts: Sequence[str], characters: int) -> int:
    """Number of columns of a legend that is this number of characters wide; it is filled column by column."""
    long = np.array([max(map(len, text.splitlines() or [""])) for text in texts])
    for columns in range(len(texts), 1, -1):
        if sum(each.max() + 8 for each in np.array_split(long, columns)) <= characters:
            return columns
    return 1


def plain(text: str, characters: int) -> str:
    """A text that is not the package's own, in lines of a number of characters."""
    return literal(textwrap.fill(text, characters))


def width(fig: Figure) -> int:
    """Number of characters that fit on a line."""
    return int(15 * fig.get_figwidth())


def shown_pads(runs: Sequence[Run], pad: int | None) -> list[int]:
    """The given pad, which every run must have, or all pads that any of them has."""
    if pad is None:
        return list(range(1, max(run.pads for run in runs) + 1))
    for run in runs:
        signals.pad_column(run, pad)
    return [pad]


def drawn(run: Run, name: str, pads: Sequence[int]) -> Iterable[tuple[int | None, int | None]]:
    """Number of the part and pad of every line of a dataset of a run; (None, None) for the journal."""
    if name.startswith("journal"):
        return [(None, None)]
    return [(k, pad) for k, pad in enumerate(pads) if pad <= run.pads]


def stacked(names: Sequence[Name]) -> tuple[Figure, dict[Name, Axes]]:
    """Panels above each other, one for each dataset, with one horizontal axis."""
    fig, panels = plt.subplots(len(names), 1, sharex=True, figsize=(COLUMN, 0.6 + 1.2 * len(names)))
    fig.align_ylabels(panels)
    for ax in panels[:-1]:
        ax.xaxis.label.set_visible(False)
    panels[-1].locator_params(axis="x", nbins=6)
    return fig, dict(zip(names, panels, strict=True))


def grid(count: int, height: float) -> tuple[Figure, list[Axes]]:
    """Panels of this height, two in a row."""
    columns = min(2, count)
    rows = -(-count // columns)
    size = (COLUMN if columns == 1 else PAGE, height * rows)
    fig, panels = plt.subplots(rows, columns, squeeze=False, figsize=size)
    for ax in panels.flat[count:]:
        ax.remove()
    return fig, list(panels.flat[:count])


def mark_enlarged(whole: Axes, part: Axes) -> None:
    """Draws a frame in `whole` around the limits of `part`, to its right, and lines from one to the other."""
    whole.set_zorder(part.get_zorder() + 0.5)  # drawn after it, as the lines end at its box
    limits = BboxTransformTo(part.viewLim) + whole.transData  # equal axes get theirs when their box is known
    line = {"edgecolor": "0.65", "linewidth": 0.6, "in_layout": False}
    whole.add_artist(Rectangle((0, 0), 1, 1, facecolor="none", transform=limits, **line))
    for corner in (0, 0), (0, 1):
        whole.add_artist(ConnectionPatch((1, corner[1]), corner, limits, part.transAxes, **line))


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


def polar(radius: float, degrees: float) -> tuple[float, float]:
    """Coordinates in the picture of a point at an angle from +z towards +y."""
    return radius * np.cos(np.radians(degrees)), radius * np.sin(np.radians(degrees))


def turning_arrow(ax: Axes, radius: float, degrees: tuple[float, float], bend: float, **look: Any) -> None:
    """The sense of rotation: an arrow between two angles, back where its `bend` is negative."""
    ends = degrees if bend > 0 else degrees[::-1]
    look |= {"connectionstyle": f"arc3,rad={-bend}", "arrowstyle": "-|>"}
    ax.add_patch(FancyArrowPatch(*(polar(radius, each) for each in ends), **look))
