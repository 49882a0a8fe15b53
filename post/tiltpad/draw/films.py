"""Pictures of the films at one instant: pressure over the unrolled pads, thickness and pressure around."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tiltpad.calculate import geometry, library
from tiltpad.calculate.rotation import sense
from tiltpad.draw import layout, plots
from tiltpad.draw.orbits import bearings
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN, digits

#: Of more pads around a bearing only the first has a word beside its number.
MOST_NAMED = 12
#: Places over half the width at which thicknesses are drawn where slopes count, and their dashes.
MIDDLE = (0, "-")
ENDS = {"end of lower $x$": (-1, "--"), "middle of the width": MIDDLE, "end of higher $x$": (1, ":")}
#: Points across the width among which the highest pressure is.
ACROSS = 41


@layout.of_several
def pressure(runs: Sequence[Run], pad: int | None = None, time: float | None = None) -> Figure:
    """Film pressure over the unrolled pads, a panel each, at one instant (None: at the equilibrium).

    All have one scale of colours; the highest pressure of each pad is a number above it. Where slopes count,
    dashed lines are those of one film thickness.
    """
    pads = layout.shown_pads(runs, pad)
    columns = min(2, len(pads))
    own = [[k for k in pads if k <= run.pads] for run in runs]
    heights = [-(-len(each) // columns) for each in own]
    rows = sum(heights)
    figsize = (layout.COLUMN if columns == 1 else layout.PAGE, 0.3 + 2.3 * rows)
    fig, axes = plt.subplots(rows, columns, squeeze=False, figsize=figsize)
    panels = np.split(axes, np.cumsum(heights)[:-1])
    films = [library.pressure(run, time) for run in runs]
    fields = [SHOWN["pressure"].factor * film.pressure[np.array(each) - 1]
              for each, film in zip(own, films, strict=True)]  # fmt: skip
    low, high = min(each.min() for each in fields), max(each.max() for each in fields)
    levels = MaxNLocator(12).tick_values(low, max(high, low + 1e-6))
    used = []
    for i, (run, film, name) in enumerate(zip(runs, films, layout.labels(runs), strict=True)):
        axes = panels[i].ravel()
        for ax, k in zip(axes, own[i], strict=False):
            plots.pressure(run, ax, time, k, film, levels=levels)
            peak = SHOWN["pressure"].factor * film.pressure[k - 1].max()
            words = f"pad {k}: at most {digits(peak, 3)} {SHOWN['pressure'].unit}"
            ax.set_title(words if len(runs) == 1 else f"{layout.plain(name, 50)}\n{words}")
            used.append(ax)
        for ax in axes[len(own[i]) :]:
            ax.remove()
    alike = all(np.ptp(each, axis=0).max() == 0 for each in (films[0].phi, films[0].z))
    for ax in used:
        # labels of inner axes repeat those of the outer ones
        ax.label_outer() if len(runs) == 1 and len(pads) % columns == 0 and alike else None
    bar = {"label": SHOWN["pressure"].label, "aspect": 14 * rows, "fraction": 0.06}
    fig.colorbar(used[0].collections[0], ax=used, **bar)
    lines = "; dashed lines: film thickness" if any(run.has_slopes for run in runs) else ""
    fig.suptitle(layout.plain(instant(runs, time) + lines, layout.width(fig)))
    return fig


@layout.of_several
def film(runs: Sequence[Run], pad: int | None = None, time: float | None = None) -> Figure:
    """Thickness and pressure of the films around the bearing at one instant (None: at the equilibrium).

    The pressure is that in the middle of the width. Pads of one bearing have their numbers. Where slopes
    count, the thickness at both ends has lines, too, and the pressure is the highest over the width.
    """
    pads = layout.shown_pads(runs, pad)
    fig, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(layout.PAGE, 3.8))
    sloped = any(run.has_slopes for run in runs)
    across = np.linspace(-1, 1, ACROSS) if sloped else np.zeros(1)
    for i, run in enumerate(runs):
        angle = geometry.surfaces(run.in_operation, geometry.at_time(run, time)).angle
        around = library.pressure(run, time, along=angle.shape[1], across=across)
        ends = ENDS.values() if run.has_slopes else [MIDDLE]
        films = geometry.film_thickness(run, time, angle.shape[1], np.array([end for end, _ in ends]))
        for k in (k for k in pads if k <= run.pads):
            line = layout.look(i, 0, runs)
            x = np.degrees(angle[k - 1])
            for (_, dashes), thickness in zip(ends, films[k - 1].T, strict=True):
                y = SHOWN["min_film_thickness"].factor * thickness
                upper.plot(x, y, **line | {"linestyle": dashes})
            highest = around.pressure[k - 1].max(axis=1)
            lower.plot(x, SHOWN["pressure"].factor * highest, **line | {"linestyle": layout.DASHES[0]})
    for k in (k for k in pads if len(bearings(runs)) == 1):
        place = {"xycoords": ("data", "axes fraction"), "ha": "center", "fontsize": "small", "color": "0.3"}
        name = f"pad {k}" if k == 1 or len(pads) <= MOST_NAMED else f"{k}"
        upper.annotate(name, (geometry.of_pads(runs[0].input, "pads%pivot_angle_deg")[k - 1], 1.03), **place)
    upper.set(ylabel="film thickness (µm)", ylim=(0, None))
    for side, height in (("journal", 0.03), ("pads: the lines", 0.97)):
        place = {"ha": "left", "va": "bottom" if height < 0.5 else "top", "fontsize": "small", "color": "0.3"}
        upper.annotate(side, (0.01, height), xycoords="axes fraction", **place)
    senses = {sense(run.input) for run in runs}
    moves = f"; the surface of the journal moves to the {'left' if senses == {1} else 'right'}"
    label = f"angle from $+z$ towards $+y$ (deg){moves if len(senses) == 1 else ''}"
    pressed = "highest pressure\nover the width" if sloped else "pressure in the\nmiddle"
    lower.set(xlabel=label, ylabel=f"{pressed} (MPa)")
    lower.xaxis.set_major_locator(plt.MaxNLocator(12, steps=[1, 1.5, 3, 5, 10]))
    marks = [(name, {"color": "0.3", "linestyle": dashes}) for name, (_, dashes) in ENDS.items() if sloped]
    if len(runs) > 1:
        layout.legend(fig, runs, marks)
    else:
        layout.heading(fig, marks, instant(runs, time))
    return fig


def instant(runs: Sequence[Run], time: float | None) -> str:
    """The title: of one run its own, and the time."""
    title = runs[0].title if len(runs) == 1 else ""
    return f"{title} at {'the equilibrium' if time is None else f'{time:g} s'}".lstrip()
