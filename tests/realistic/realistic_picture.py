"""The picture of the realistic bearings: distribution of the errors, and error against time of the tables."""

from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from bearing_runs import Bearing
from error_tables import TILTS, curve_names, curve_points, on_curve, unsensitive
from tiltpad.draw.layout import PAGE
from tiltpad.draw.plots import STYLE

#: What is drawn, and how.
LOOKS = {
    "journal": ("C0", "journal"),
    TILTS[0]: ("C2", "tilt, loaded pads"),
    TILTS[1]: ("C3", "tilt, unloaded pads"),
}
#: Other settings of the curve, and their marks.
MARKS = {"default": "*", "direct": "s", "both 3e-06": "D", "march 1e-06": "^"}


def draw(bearings: list[Bearing], path: Path) -> None:
    """Writes the picture."""
    mpl.use("agg")
    kept = unsensitive(bearings)
    with plt.style.context(STYLE):
        fig, (left, right) = plt.subplots(1, 2, figsize=(PAGE, 3.4))
        distributions(kept, left)
        tolerances([bearing for bearing in kept if on_curve(bearing)], right)
        path.parent.mkdir(parents=True, exist_ok=True)
        fig.savefig(path, dpi=200)
        plt.close(fig)


def distributions(bearings: list[Bearing], ax) -> None:
    """Share of the bearings above an error: default settings, and thin without tables."""
    for name, (colour, label) in LOOKS.items():
        for run, width in (("default", 1.5), ("direct", 0.6)):
            found = [each.runs[run].errors for each in bearings]
            values = np.sort([each[name] for each in found if name in each])[::-1]
            shown = label if run == "default" else None
            ax.plot(
                values,
                np.arange(1, len(values) + 1) / len(values),
                color=colour,
                linewidth=width,
                label=shown,
            )
    ax.set(
        xscale="log", yscale="log", xlabel="error", ylabel="share of bearings with more", xlim=(1e-6, None)
    )
    ax.set_title("default settings (thin: direct)")
    ax.legend(fontsize=7)


def tolerances(bearings: list[Bearing], ax) -> None:
    """95 % and largest errors of journal and tilts over the time of all marches."""
    if not bearings:
        return
    for index, (colour, label) in enumerate((("C0", "journal"), ("C3", "tilt"))):
        points = {name: curve_points(bearings, name) for name in curve_names()}
        tables = [points[name] for name in curve_names() if name.startswith("tables")]
        seconds = [each.seconds for each in tables]
        for part, style in ((1, "-"), (2, "--")):
            errors = [(each.journal, each.tilt)[index][part] for each in tables]
            ax.plot(seconds, errors, style, marker="o", markersize=3, color=colour, linewidth=0.8)
            for name, mark in MARKS.items():
                own = points[name]
                size = 10 if mark == "*" else 4
                ax.plot(
                    own.seconds, (own.journal, own.tilt)[index][part], mark, color=colour, markersize=size
                )
        ax.plot([], [], color=colour, label=f"{label}: 95 %, dashed: largest")
    for words, mark in MARKS.items():
        ax.plot([], [], mark, color="black", linestyle="none", label=words)
    ax.set(yscale="log", xlabel="CPU time of all marches, s", ylabel="error")
    ax.set_title("tables of 1e-3 to 4e-6, and other settings")
    ax.legend(fontsize=7)
