"""Pictures of what orbits do over a parameter.

Every function takes results and studies, and returns the figure.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from tiltpad.calculate.response import DIRECTIONS, Peak
from tiltpad.calculate.response import response as response_of
from tiltpad.draw.layout import DASHES, heading, of_several, part_color, stacked
from tiltpad.draw.vibrations import parts, title
from tiltpad.files import units
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN


@of_several
def response(
    runs: Sequence[Run | Study],
    last: float | None = None,
    pad: int | None = None,
    over: str | None = None,
    where: Mapping[str, Any] | None = None,
) -> Figure:
    """Amplitude and phase of the journal's first harmonic over the speed, with the critical speeds."""
    found = parts(runs, None, over, where)
    fig, panels = stacked(["amplitude", "phase"])
    fig.set_figheight(4.2)
    entries, size = [], SHOWN["amplitude"]
    for color, one in enumerate(found):
        own = response_of(one.source, one.where or None, one.over)
        dots = {"marker": "o", "markersize": 3} if len(own.values) < 30 else {}
        for k, direction in enumerate(DIRECTIONS):
            line = (
                {"color": f"C{k}"}
                if len(found) == 1
                else {"color": part_color(color, len(found)), "linestyle": DASHES[k]}
            )
            for name, values in (
                ("amplitude", size.factor * own.amplitude),
                ("phase", np.degrees(own.phase)),
            ):
                panels[name].plot(own.values, values[:, k], **line | dots)
            peaks = [each for each in own.peaks if each.direction == direction]
            for each in peaks:
                for ax in panels.values():
                    ax.axvline(each.speed_rpm, color=line["color"], linestyle=":", linewidth=0.8)
            words = f"${direction}$" + (f": {'; '.join(map(in_words, peaks))}" if peaks else "")
            entries.append((f"{one.text}, {words}" if one.text else words, line))
    text, unit = units.named(own.parameter)
    panels["amplitude"].set(ylabel=f"{size.text}, order 1 ({size.unit})", ylim=(0, None))
    panels["phase"].set(ylabel="phase lag, order 1 (deg)", xlabel=units.Shown(text, 1, unit).label)
    heading(fig, entries, title(runs))
    return fig


def in_words(peak: Peak) -> str:
    """Critical speed and amplification factor."""
    factor = peak.amplification_factor
    return f"{peak.speed_rpm:.0f} rpm" + (f", AF {factor:.2f}" if np.isfinite(factor) else "")
