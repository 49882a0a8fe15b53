"""The picture of a basin: from which starts a journal comes back to its equilibrium."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from tiltpad.calculate import basins
from tiltpad.draw import layout
from tiltpad.draw.branches import parameter_of
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN

#: Marks of starts by where they end; each with its label.
RETURNS = {"linestyle": "", "marker": "o", "markersize": 3.5, "markerfacecolor": "white", "color": "C0"}
WHIRLS = {"linestyle": "", "marker": "o", "markersize": 3.5, "color": "C1"}
CYCLE = {"color": "0.3", "linestyle": (0, (4, 2)), "linewidth": 0.9}


@layout.of_several
def basin(runs: Sequence[Run | Study]) -> Figure:
    """Starts of a study, z to the right and y up, by whether they lead to whirl, and the unstable cycle.

    The results are a study over start%journal(1) and (2) and a branch of limit cycles. The dashed ellipse has
    the amplitudes of the unstable cycle, about the equilibrium.
    """
    studies = [each for each in runs if isinstance(each, Study)]
    followed = [each for each in runs if isinstance(each, Run)]
    if len(studies) != 1 or len(followed) != 1:
        given = ", ".join(str(each.path) for each in runs)
        raise NotInRunError(f"{given}: a basin is of one study of starts and one branch of limit cycles")
    found, factor = basins.basin(studies[0], followed[0]), SHOWN["journal_y"].factor
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 3.4))
    y, z = factor * found.start.T
    for ends, look in ((~found.whirls & found.done, RETURNS), (found.whirls, WHIRLS)):
        ax.plot(z[ends], y[ends], **look)
    around = np.linspace(0, 2 * np.pi, 181)
    high, wide = factor * found.cycle
    ax.plot(wide * np.cos(around), high * np.sin(around), **CYCLE)
    ax.set(xlabel="start, $z$ from the equilibrium (µm)", ylabel="start, $y$ (µm)", aspect="equal")
    shown = parameter_of(followed[0])
    where = f"{shown.text} {found.parameter:g} {shown.unit}".strip()
    if np.isfinite(found.nearest):
        where += f"; nearest start that whirls: {factor * found.nearest:.3g} µm"
    cycle = f"unstable cycle, y {high:.3g}, z {wide:.3g} µm"
    layout.heading(fig, [("returns", RETURNS), ("whirls", WHIRLS), (cycle, CYCLE)], where)
    return fig
