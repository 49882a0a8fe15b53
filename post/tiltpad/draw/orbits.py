"""Pictures of the journal in its clearance: orbits and equilibria, a row or a panel for each bearing."""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from tiltpad.draw import layout, plots
from tiltpad.files.namelist import of_pads
from tiltpad.files.read import Run

#: What makes another bearing in a picture of its clearance.
GEOMETRY = (
    *("bearing%assembled_clearance", "bearing%machined_clearance"),
    *("pads%pivot_angle_deg", "pads%arc_deg", "pads%pivot_ratio"),
)
#: An equilibrium, where nothing else is drawn.
CROSS = {"linestyle": "", "marker": "+", "markersize": 8, "markeredgewidth": 1.5}
#: More bearings than this share one picture, without their pads.
MOST_BEARINGS = 4


@layout.of_several
def orbit(runs: Sequence[Run], last: float | None = None) -> Figure:
    """Orbits in the clearance circle and enlarged, with the equilibrium; a row for each bearing."""
    groups = shown_together(runs)
    fig, panels = plt.subplots(len(groups), 2, squeeze=False, figsize=(layout.PAGE, 3.6 * len(groups)))
    for (whole, enlarged), group in zip(panels, groups, strict=True):
        surroundings(whole, runs, group)
        for i in group:
            plots.orbit(runs[i], whole, last, direction=False, **layout.look(i, 0, runs))
            plots.orbit(runs[i], enlarged, last, **layout.look(i, 0, runs))
        enlarged.yaxis.tick_right()  # the lines between the panels are on the left
        enlarged.yaxis.set_label_position("right")
        enlarged.yaxis.set_ticks_position("both")
        enlarged.tick_params(labelleft=False, labelright=True)
        enlarged.set(box_aspect=1, adjustable="datalim")
        enlarged.margins(0.1)
    layout.legend(fig, runs, layout.orbit_marks(runs) if any(map(plots.marks_equilibrium, runs)) else [])
    remark_crowded(fig, runs)
    for whole, enlarged in panels:
        layout.mark_enlarged(whole, enlarged)
    return fig


@layout.of_several
def equilibrium(runs: Sequence[Run]) -> Figure:
    """Equilibria of the journal in the clearance circle; a panel for each bearing."""
    groups = shown_together(runs)
    fig, panels = layout.grid(len(groups), 3.4)
    for ax, group in zip(panels, groups, strict=True):
        surroundings(ax, runs, group)
        for i in group:
            plots.equilibrium(runs[i], ax, color=layout.colors(runs)[i], **CROSS)
    layout.legend(fig, runs, [], **CROSS)
    remark_crowded(fig, runs)
    return fig


def shown_together(runs: Sequence[Run]) -> list[Sequence[int]]:
    """Numbers of the runs of each panel: those of a bearing, or all of them where there are many bearings."""
    found = bearings(runs)
    return [*found] if len(found) <= MOST_BEARINGS else [range(len(runs))]


def remark_crowded(fig: Figure, runs: Sequence[Run]) -> None:
    """Says below the picture why pads are left out."""
    if (found := len(bearings(runs))) > MOST_BEARINGS:
        own = "each run has its own clearance circle, in its colour"
        layout.remark(fig, f"{found} bearings: {own}; pads are left out")


def surroundings(ax: Axes, runs: Sequence[Run], group: Sequence[int]) -> None:
    """Circle and pads of the one bearing of these runs; of many bearings the circles of the runs."""
    if len(bearings(runs)) <= MOST_BEARINGS:
        plots.clearance(runs[group[0]], ax, marks=len(runs) == 1)
        if len(group) < len(runs):
            ax.set_title(layout.plain(", ".join(layout.labels(runs)[i] for i in group), 45))
        return
    radius = [plots.SHOWN["journal_y"].factor * run.clearance for run in runs]
    for each, color in zip(radius, layout.colors(runs), strict=True):
        ax.add_patch(Circle((0, 0), each, fill=False, linewidth=0.8, edgecolor=color))
    reach = 1.1 * max(radius)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))


def bearings(runs: Sequence[Run]) -> list[list[int]]:
    """Numbers of the runs, those of one bearing together."""
    found: dict[Any, list[int]] = {}
    for i, run in enumerate(runs):
        key = (of_pads(run.in_operation, name) for name in GEOMETRY)
        found.setdefault((not run.tilts, *key), []).append(i)
    return list(found.values())
