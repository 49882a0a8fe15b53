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
GEOMETRY = {
    "bearing": ("assembled_clearance", "machined_clearance"),
    "pads": ("pivot_angle_deg", "arc_deg", "pivot_ratio"),
}
#: An equilibrium, where nothing else is drawn.
CROSS = {"linestyle": "", "marker": "+", "markersize": 8, "markeredgewidth": 1.5}
#: More bearings than this share one picture, without their pads.
MOST_BEARINGS = 4


@layout.of_several
def orbit(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Orbits in the clearance circle and enlarged, with the equilibrium; a row for each bearing."""
    found = bearings(runs)
    rows = len(found) if len(found) <= MOST_BEARINGS else 1
    fig = plt.figure(figsize=(layout.PAGE, 3.6 * rows))
    panels = fig.subplots(rows, 2, squeeze=False)
    groups = found if rows == len(found) else [range(len(runs))]
    for (whole, enlarged), group in zip(panels, groups, strict=True):
        surroundings(whole, runs, group, len(found) if rows == 1 else 1)
        for i in group:
            plots.orbit(runs[i], whole, last or 1, direction=False, **layout.look(i, 0, runs))
            plots.orbit(runs[i], enlarged, last or 1, **layout.look(i, 0, runs))
        enlarged.yaxis.tick_right()  # the lines between the panels are on the left
        enlarged.yaxis.set_label_position("right")
        enlarged.yaxis.set_ticks_position("both")
        enlarged.tick_params(labelleft=False, labelright=True)
        enlarged.set(box_aspect=1, adjustable="datalim")
        enlarged.margins(0.1)
    color = {"color": "0.3" if len(runs) > 1 else "C0"}
    marks = [("orbit", color), ("equilibrium", color | {"linestyle": "", "marker": "+"})]
    layout.legend(fig, runs, marks if any(map(plots.marks_equilibrium, runs)) else [])
    if rows < len(found):
        layout.remark(fig, crowded(len(found)))
    for whole, enlarged in panels:
        layout.mark_enlarged(whole, enlarged)
    return fig


@layout.of_several
def equilibrium(runs: Sequence[Run], last: float | None = None, pad: int | None = None) -> Figure:
    """Equilibria of the journal in the clearance circle; a panel for each bearing."""
    found = bearings(runs)
    groups = found if len(found) <= MOST_BEARINGS else [range(len(runs))]
    fig, panels = layout.grid(len(groups), 3.4)
    for ax, group in zip(panels, groups, strict=True):
        surroundings(ax, runs, group, len(found) if len(groups) == 1 else 1)
        for i in group:
            plots.equilibrium(runs[i], ax, color=layout.colors(runs)[i], **CROSS)
    layout.legend(fig, runs, [], **CROSS)
    if len(groups) < len(found):
        layout.remark(fig, crowded(len(found)))
    return fig


def crowded(bearings: int) -> str:
    return f"{bearings} bearings: each run has its own clearance circle, in its colour; pads are left out"


def surroundings(ax: Axes, runs: Sequence[Run], group: Sequence[int], bearings: int) -> None:
    """Circle and pads of the one bearing of these runs; of several bearings the circles of the runs."""
    if bearings == 1:
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
        key = tuple(
            of_pads(run.in_operation, f"{group}%{name}")
            for group, names in GEOMETRY.items()
            for name in names
        )
        found.setdefault((run.input["pads"]["motion"] == "fixed", *key), []).append(i)
    return list(found.values())
