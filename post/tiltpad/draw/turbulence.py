"""A picture of turbulent films: local Reynolds numbers over the arc of the pads."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from tiltpad.calculate.turbulence import local_reynolds
from tiltpad.draw import layout
from tiltpad.files.read import Run

#: The limits of the transition, from which films begin to be turbulent and from which they are.
LIMITS = {"laminar_below": ("laminar below", ":"), "turbulent_above": ("turbulent above", "--")}


@layout.of_several
def turbulence(runs: Sequence[Run], pad: int | None = None) -> Figure:
    """Local Reynolds number over the arc of each pad at the equilibrium, and the limits of the transition.

    Where all results have the same transition, its range is shaded pale, and what is turbulent darker.
    """
    pads = layout.shown_pads(runs, pad)
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 2.8))
    highest = 0.0
    for i, run in enumerate(runs):
        place, numbers = local_reynolds(run)
        for k in (k for k in pads if k <= run.pads):
            ax.plot(place, numbers[k - 1], **layout.look(i, pads.index(k), runs))
            highest = max(highest, numbers[k - 1].max())
    transitions = {tuple(run.input["film"][name] for name in LIMITS) for run in runs}
    marks = [(text, {"color": "0.3", "linestyle": dashes}) for text, dashes in LIMITS.values()]
    top = 1.1 * max(highest, *(above for _, above in transitions))
    alike = len(transitions) == 1
    colors = ["0.3"] if alike else layout.colors(runs)
    for run, color in zip(runs, colors, strict=False):
        for name, (_, dashes) in LIMITS.items():
            ax.axhline(run.input["film"][name], color=color, linestyle=dashes, linewidth=0.8, zorder=1)
    if alike:
        below, above = transitions.pop()
        ax.axhspan(below, above, color="0.95", zorder=0)
        ax.axhspan(above, top, color="0.88", zorder=0)
    ax.set(xlim=(0, 1), ylim=(0, top), xlabel="place on the arc, from the leading to the trailing edge")
    ax.set_ylabel("local Reynolds number")
    layout.legend(fig, runs, [*layout.parts([f"pad {k}" for k in pads], runs), *marks])
    return fig
