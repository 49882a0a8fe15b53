"""A page about a study: its runs, those that failed, and curves of its key results."""

from collections.abc import Iterator
from functools import partial
from html import escape
from pathlib import Path

import numpy as np

from tiltpad.calculate.selection import distinct, written
from tiltpad.draw import figures
from tiltpad.draw.diagrams import label
from tiltpad.draw.page import page, paragraph, picture, section, table
from tiltpad.files.archive import NotInRunError
from tiltpad.files.study import Study
from tiltpad.files.units import described, digits

#: Results of the table and of the curves, those that the study has.
KEYS = (
    *("orbit_size", "min_film_thickness", "max_pressure", "friction_work", "stick_fraction"),
    *("equilibrium_eccentricity_ratio", "equilibrium_min_film_thickness", "equilibrium_max_pressure"),
    *("equilibrium_total_power_loss", "least_damping_ratio", "threshold_rpm"),
)
#: Columns of the table, and its rows.
COLUMNS, ROWS = 6, 300
#: Pictures of whole studies.
PICTURES = ("response", "coefficients", "stability", "campbell", "temperatures")


def study_report(study: Study) -> str:
    """The page as text."""
    title = study.title or Path(study.path).stem
    by = study.attributes
    origin = f"{Path(study.path).name}: {by['program']} {by['version']}, {by['created']}"
    parts = [
        f"<p class=origin>{escape(origin)}</p>",
        summary(study),
        section("Runs that were not done", failures(study)),
        section("Curves", "".join(curves(study))),
        section("Runs", runs(study)),
        section("Input of the first run", f"<pre>{escape(by.get('input', '').strip())}</pre>"),
    ]
    return page(title, parts)


def summary(study: Study) -> str:
    """How many runs there are and were done, and what they differ in."""
    count, done = len(study.done), int(study.done.sum())
    missing = study.attributes.get("missing", "")
    text = f"{count} runs, {done} of them done."
    for name in study.parameters:
        values = distinct(study[name])
        if values:
            several = f"{written(values[0])} to {written(values[-1])}, {len(values)} values"
            own = several if len(values) > 4 else ", ".join(map(written, values))
            text += f" {study.about(name, 'long_name') or name}: {own}."
    lost = paragraph(f"Runs without a file: {missing}.", warning=True) if missing else ""
    return paragraph(text) + lost


def failures(study: Study) -> str:
    """A row for each run that was not done, with the recorded reason."""
    rows = [
        (f"{each.run}", *(written(value) for value in each.values.values()), each.how, each.reason)
        for each in study.failures()[:ROWS]
    ]
    return table(("run", *named(study), "end", "reason"), rows, words=True)


def named(study: Study) -> list[str]:
    """The parameters with their units, as heads of columns."""
    return [label(study, name) for name in study.parameters]


def runs(study: Study) -> str:
    """Parameters and key results of every run."""
    keys = [name for name in KEYS if name in study and np.isfinite(values(study, name)).any()][:COLUMNS]
    shown = [described(study, name) for name in keys]
    columns = [values(study, name) for name in keys]
    rows = [
        (
            f"{study.run[k]}",
            *(written(study[name][k]) for name in study.parameters),
            "yes" if study.done[k] else "no",
            *(digits(own.factor * column[k]) for own, column in zip(shown, columns, strict=True)),
        )
        for k in range(min(len(study.done), ROWS))
    ]
    rest = len(study.done) - ROWS
    heads = ("run", *named(study), "done", *(each.label for each in shown))
    return table(heads, rows) + paragraph(f"and {rest} more, in the file." if rest > 0 else "")


def values(study: Study, name: str) -> np.ndarray:
    """A result of each run; of pivots, of the first ones."""
    found = study[name]
    return found if found.ndim == 1 else found[:, 0]


def curves(study: Study) -> Iterator[str]:
    """The key results over the parameters, and the pictures that only some studies have."""
    for name in KEYS:
        if name in study and study.parameters and np.isfinite(values(study, name)).any():
            try:
                caption = f"{described(study, name).text.replace('$', '')}.".capitalize()
                yield picture(name, partial(figures.study, study, name), caption, remarks=False)
            except ValueError:
                continue
    for name in PICTURES:
        try:
            yield picture(name, partial(figures.FIGURES[name], [study]), remarks=False)
        except (ValueError, NotInRunError):
            continue
