"""Parts of the pages that tiltpad-report writes: one file each, without scripts and links."""

import base64
import io
from collections.abc import Callable, Iterable, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from tiltpad.draw import layout, plots
from tiltpad.files.archive import Archive
from tiltpad.files.units import Shown, fitted, numbers

#: Pictures of runs and studies and their captions.
PICTURES = {
    "orbit": "Journal in its clearance circle and enlarged, last revolution.",
    "equilibrium": "Equilibrium of the journal in its clearance circle.",
    "waveform": "The last revolutions.",
    "multipliers": "Floquet multipliers: inside the circle, the orbit is stable.",
    "spectrum": "Amplitudes of the journal: one-sided, and full with backward and forward whirl.",
    "runup": "The whole run; many revolutions are drawn as the band that they fill.",
    "size": "Peak to peak of the journal over the speed.",
    "orders": "Amplitude of the first orders over the speed, and the phase of the first.",
    "waterfall": "Amplitudes over speed and frequency.",
    "branch": "Highest and lowest values along the branches; bifurcation points by their letters.",
    "basin": "Starts that lead to whirl or back to the equilibrium; the unstable cycle dashed.",
    "chart": "Bifurcation points over two parameters, each curve with its stable side.",
    "response": "First harmonic of the journal: critical speeds, and their amplification factors (AF).",
    "hysteresis": "Friction moment over tilt: the area is the work dissipated, last revolution or period.",
    "friction": "Friction coefficient over sliding velocity, last revolution.",
    "sticking": "Tilt rate, bold where the pivot sticks, over the last two revolutions.",
    "poincare": "Once a revolution, on the path of the last ones; of the pads, the one that moves most.",
    "pressure": "Film pressure over the unrolled pads at the equilibrium.",
    "temperatures": "Temperatures of the pads, and the viscosities or the heat that belongs to them.",
    "film": "Thickness and pressure of the films around the bearing at the equilibrium.",
    "turbulence": "Local Reynolds numbers over the arc: pale the transition, darker what is turbulent.",
    "coefficients": "Stiffness and damping at the journal.",
    "stability": "Damping ratio and logarithmic decrement of the modes.",
    "campbell": "Frequencies of the modes over the speed.",
    "shaft": "The shaft at the equilibrium, and the loads of the bearings.",
    "stations": "Orbits of the shaft at its stations, last revolution.",
    "shapes": "Mode shapes of the shaft: ellipses of its stations, and the shaft at one instant.",
    "tornado": "What the inputs do to the result, and their shares of its variance.",
    "distribution": "Results of the runs with their 5, 50 and 95 % percentiles.",
    "scatter": "Results over the inputs, a point for each run.",
}

#: How the meaning of a number begins that is 1 where something holds, and 0 elsewhere.
FLAG = "1 where "


def page(of: Archive, parts: Iterable[str]) -> str:
    """The whole page about a file; the first of the parts tells its origin, empty ones are left out."""
    origin, *others = parts
    return whole_page(of.title or Path(of.path).stem, f"{Path(of.path).name}: {origin}", others)


def whole_page(title: str, origin: str, parts: Iterable[str]) -> str:
    """A page with this title and a line below it; empty parts are left out."""
    style = files("tiltpad.draw").joinpath("report.css").read_text(encoding="utf-8")
    narrow = '<meta name="viewport" content="width=device-width, initial-scale=1">'
    head = f'<meta charset="utf-8">{narrow}<title>{escape(title)}</title><style>{style}</style>'
    start = f"<h1>{escape(title)}</h1>\n<p class=origin>{escape(origin)}</p>"
    body = "\n".join(part for part in (start, *parts) if part)
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n'


def section(title: str, content: str) -> str:
    return f"<section><h2>{title}</h2>{content}</section>" if content else ""


def folded(title: str, content: str) -> str:
    """A section of which a reader sees the title, and the content where it is clicked."""
    head = f"<summary><h2>{title}</h2></summary>"
    return f"<details>{head}<section>{content}</section></details>" if content else ""


def given(title: str, of: Archive) -> str:
    """The input of a run, or of the first run of a study."""
    return folded(title, f"<pre>{escape(of.attributes.get('input', '').strip())}</pre>")


def paragraph(text: str, warning: bool = False) -> str:
    """A paragraph, or nothing for an empty text."""
    return f"<p{' class=warning' if warning else ''}>{escape(text)}</p>" if text else ""


def table(head: Sequence[str], rows: Iterable[Sequence[str]], words: bool = False) -> str:
    """A table whose first column is text and whose others are numbers, or with `words` texts."""
    first = "<tr>" + "".join(f"<th>{escape(each)}</th>" for each in head) + "</tr>"
    lines = ["<tr>" + "".join(f"<td>{escape(each)}</td>" for each in row) + "</tr>" for row in rows]
    whole = f"<div class=wide><table{' class=words' * words}>{first}{''.join(lines)}</table></div>"
    return whole if lines else ""


def facts_table(rows: Iterable[Sequence[str]]) -> str:
    """A table of a few facts, without heads: name, number, unit, and what belongs to it in words."""
    lines = ["<tr>" + "".join(f"<td>{escape(each)}</td>" for each in row) + "</tr>" for row in rows]
    return f"<table class=facts>{''.join(lines)}</table>" if lines else ""


def row(quantity: Shown, values: Sequence[float]) -> tuple[str, ...]:
    """Numbers of a quantity between its name and its unit, which suits the largest of them.

    Yes and no stand for what is 1 where something holds.
    """
    if quantity.text.partition(FLAG)[1]:
        return (quantity.text.replace(FLAG, ""), *("yes" if each else "no" for each in values), "")
    shown = fitted(quantity, values)
    return (shown.text, *numbers(shown, values), shown.unit)


def picture(name: str, draw: Callable[[], Figure], caption: str | None = None, remarks: bool = True) -> str:
    """A picture inside the page, with its caption (by default that of its kind).

    Without `remarks` it leaves out those that stand in the page already.
    """
    with plt.style.context(plots.STYLE):
        figure = draw()
        try:
            figure.suptitle("")
            if not remarks and figure.get_supxlabel():
                figure.set_figheight(figure.get_figheight() - 0.1 * len(figure.get_supxlabel().splitlines()))
                figure.supxlabel("")
            stream = io.BytesIO()
            layout.write(figure, stream, "svg", metadata={"Date": None})
        finally:
            plt.close(figure)
    data = base64.b64encode(stream.getvalue()).decode("ascii")
    look = f'alt="{name}" style="width: {figure.get_figwidth()}in"'
    image = f'<img {look} src="data:image/svg+xml;base64,{data}">'
    return f"<figure>{image}<figcaption>{escape(caption or PICTURES[name])}</figcaption></figure>"
