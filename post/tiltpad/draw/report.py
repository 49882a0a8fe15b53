"""A page about a run.

It is one file, without scripts and links.
"""

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from tiltpad.calculate import behaviour, signals, summary
from tiltpad.calculate.coefficients import coefficients
from tiltpad.calculate.library import MissingLibraryError
from tiltpad.calculate.modes import modes
from tiltpad.draw import figures, plots
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN

#: Pictures and their captions; those that a run cannot have are left out.
PICTURES = {
    "orbit": "Journal in its clearance circle and enlarged, last revolution.",
    "equilibrium": "Equilibrium of the journal in its clearance circle.",
    "waveform": "The last revolutions.",
    "multipliers": "Floquet multipliers: inside the circle, the orbit is stable.",
    "spectrum": "Amplitudes of the journal: one-sided, and full with backward and forward whirl.",
    "runup": "The whole run; many revolutions are drawn as the band that they fill.",
    "size": "Peak to peak of the journal over the speed.",
    "orders": "Amplitude of the first orders over the speed, and the phase of the first.",
    "waterfall": "Amplitudes over speed and order.",
    "response": "First harmonic of the journal over the speed: critical speeds and amplification factors.",
    "hysteresis": "Friction moment over tilt: the area is the work dissipated in the last revolution.",
    "friction": "Friction coefficient over sliding velocity, last revolution.",
    "sticking": "Tilt rate, bold where the pivot sticks, over the last two revolutions.",
    "poincare": "States once a revolution, on the path of the last revolutions.",
    "pressure": "Film pressure over the unrolled pads at the equilibrium.",
    "temperatures": "Temperatures of the pads, and where the heat of their films goes.",
    "coefficients": "Stiffness and damping over the whirl frequency.",
    "stability": "Damping ratio and logarithmic decrement of the modes over their frequency.",
    "campbell": "Frequencies of the modes over the speed.",
}


def report(run: Run) -> str:
    """The page as text; tables and pictures that the run cannot have are left out."""
    title = run.title or Path(run.path).stem
    parts = [
        f"<h1>{escape(title)}</h1>",
        f"<p class=origin>{escape(origin(run))}</p>",
        incomplete(run),
        orbit_stability(run),
        pad_remarks(run),
        section("Key figures", key_figures(run)),
        section("Pads", pad_figures(run)),
        section("Spectrum", spectrum_peaks(run)),
        section("Stiffness and damping", coefficient_table(run)),
        section("Modes", mode_table(run)),
        section("Pictures", "".join(pictures(run))),
        section("Input", f"<pre>{escape(run.attributes['input'].strip())}</pre>"),
        section("Cost", statistics(run)),
    ]
    style = files("tiltpad.draw").joinpath("report.css").read_text(encoding="utf-8")
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{style}</style>'
    page = "\n".join(part for part in parts if part)
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{page}\n</body></html>\n'


def origin(run: Run) -> str:
    """File, program and time."""
    by = run.attributes
    written = f"written by {by['program']} {by['version']} ({by['commit']}), {by['created']}"
    return f"{Path(run.path).name}: {written}"


def incomplete(run: Run) -> str:
    return "" if run.complete else f"<p class=warning>Incomplete run{escape(run.end())}.</p>"


def orbit_stability(run: Run) -> str:
    """Whether a periodic orbit is stable; a warning where it is not."""
    if "periodic" not in run:
        return ""
    if run["periodic/stable"]:
        return "<p>The periodic orbit is stable: small disturbances die out.</p>"
    return "<p class=warning>The periodic orbit is unstable: no motion stays on it.</p>"


def pad_remarks(run: Run) -> str:
    """What the pads do that loaded ones do not; a warning where one rubs."""
    try:
        found = behaviour.of_pads(run)
    except NotInRunError:
        return ""
    classes = {True: " class=warning", False: ""}
    return "".join(
        f"<p{classes[each.rubbing > 0]}>{escape(each.words())}</p>" for each in found if each.words()
    )


def section(title: str, content: str) -> str:
    return f"<section><h2>{title}</h2>{content}</section>" if content else ""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table whose first column is text and whose others are numbers."""
    lines = ["<tr>" + "".join(f"<th>{escape(each)}</th>" for each in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{escape(each)}</td>" for each in row) + "</tr>" for row in rows]
    return f"<table>{''.join(lines)}</table>" if len(lines) > 1 else ""


def number(value: float, quantity: str) -> str:
    """A value in its unit for pictures, four digits."""
    value = SHOWN[quantity].factor * float(value)
    if value == 0:
        return "0"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:#.4g}".rstrip(".")


def key_figures(run: Run) -> str:
    rows = [(text, number(value, q), SHOWN[q].unit) for text, q, value in summary.journal(run)]
    return table(("journal and film", "value", "unit"), rows)


def pad_figures(run: Run) -> str:
    head = ("pad", *(f"{pad}" for pad in range(1, run.pads + 1)), "unit")
    angles = ("pivot angle", *(f"{angle:g}" for angle in np.round(np.degrees(run.pivot_angle), 6)), "deg")
    rows = [
        (text, *(number(each, q) for each in values), SHOWN[q].unit) for text, q, values in summary.pads(run)
    ]
    note = (
        f"Last revolution; friction and sticking over the last {summary.LAST}; lifting, rubbing and dominant "
        f"order over the last {behaviour.LAST}; or over all if there are fewer."
    )
    return table(head, [angles, *rows]) + (f"<p>{note}</p>" if run.samples else "")


def spectrum_peaks(run: Run) -> str:
    try:
        found = summary.peaks(run)
    except NotInRunError:
        return ""
    unit = SHOWN["amplitude"].unit
    head = ("order", "frequency (Hz)", f"amplitude of y ({unit})", f"amplitude of z ({unit})")
    rows = [
        (
            f"{each.order:.3g}",
            f"{each.frequency:.5g}",
            number(each.y, "amplitude"),
            number(each.z, "amplitude"),
        )
        for each in found
    ]
    note = f"Highest peaks of the last {summary.LAST} revolutions, or of all if there are fewer."
    return table(head, rows) + f"<p>{note}</p>" if rows else ""


def coefficient_table(run: Run) -> str:
    """The coefficients of all pivots at all whirl frequencies."""
    if "coefficients" not in run:
        return ""
    rows = []
    for pivot in run["pivot"]:
        found = coefficients(run, pivot)
        for ratio, *both in zip(found.frequency_ratio, found.stiffness, found.damping, strict=True):
            named = zip(("stiffness", "damping"), both, strict=True)
            values = [number(each, name) for name, matrix in named for each in matrix.ravel()]
            rows.append((f"{pivot}, {ratio:g}", *values))
    heads = [
        f"{letter} {element} ({SHOWN[name].unit})"
        for letter, name in (("K", "stiffness"), ("C", "damping"))
        for element in ("yy", "yz", "zy", "zz")
    ]
    note = "The frequency is that of the whirl over the shaft's; y is up, the shaft turns from +y to +z."
    return table(("pivots, frequency", *heads), rows) + f"<p>{note}</p>"


def mode_table(run: Run) -> str:
    """The modes of all pivots, and the thresholds of stability where they were looked for."""
    if "modes" not in run:
        return ""
    rows, thresholds = [], []
    for pivot in run["pivot"]:
        found = modes(run, pivot)
        own = zip(found.frequency, found.damping_ratio, found.log_decrement, strict=True)
        rows += [
            (f"{pivot}", f"{hertz:.5g}", number(ratio, "damping_ratio"), number(decrement, "log_decrement"))
            for hertz, ratio, decrement in own
            if np.isfinite(hertz)
        ]
        if np.isfinite(found.threshold_rpm):
            thresholds.append(f"{pivot} pivots: {found.threshold_rpm:.1f} rpm")
    note = f"<p>Threshold of stability: {'; '.join(thresholds)}.</p>" if thresholds else ""
    return table(("pivots", "frequency (Hz)", "damping ratio (%)", "logarithmic decrement"), rows) + note


def pictures(run: Run) -> Iterable[str]:
    """The pictures that this run can have, with their captions."""
    for name, caption in PICTURES.items():
        if (name == "size" and signals.steady(run)) or (name == "equilibrium" and run.samples):
            continue
        try:
            yield f"<figure>{image(run, name)}<figcaption>{escape(caption)}</figcaption></figure>"
        except (NotInRunError, MissingLibraryError):
            continue


def image(run: Run, name: str) -> str:
    """A picture inside the page, without the run's title."""
    with plt.style.context(plots.STYLE):
        figure = figures.FIGURES[name]([run])
        try:
            stream = io.BytesIO()
            figure.savefig(stream, format="svg", metadata={"Date": None})
        finally:
            plt.close(figure)
    data = base64.b64encode(stream.getvalue()).decode("ascii")
    inches = figure.get_figwidth()
    return f'<img alt="{name}" style="width: {inches}in" src="data:image/svg+xml;base64,{data}">'


def statistics(run: Run) -> str:
    """Every number of the group `statistics`, with its meaning and unit."""
    rows = [
        (
            run.about(f"statistics/{name}", "long_name") or name,
            f"{value:.4g}" if isinstance(value, float) else f"{value}",
            run.about(f"statistics/{name}", "units").replace("1", ""),
        )
        for name, value in run["statistics"].items()
    ]
    return table(("cost of the computation", "value", "unit"), rows)
