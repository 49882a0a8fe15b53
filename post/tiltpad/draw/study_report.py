"""A page about a study: its runs, those that failed, and curves of its key results."""

from collections.abc import Iterator
from functools import partial
from html import escape

import numpy as np

from tiltpad.calculate.critical_speeds import CriticalSpeed, critical_speeds
from tiltpad.calculate.results import key_results, result
from tiltpad.calculate.selection import distinct, sampled, written
from tiltpad.calculate.statistics import common_remarks, instability
from tiltpad.draw import figures
from tiltpad.draw.diagrams import label
from tiltpad.draw.layout import not_run_yet
from tiltpad.draw.page import folded, given, page, paragraph, picture, section, table
from tiltpad.draw.sample_report import sample
from tiltpad.files.archive import NotInRunError
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN, digits

#: Columns of the table, and its rows.
COLUMNS, ROWS = 6, 300
#: Columns of the table of operating points.
POINT = {
    "equilibrium_eccentricity_ratio": "eccentricity ratio",
    "equilibrium_min_film_thickness": "minimum film",
    "equilibrium_maximum_temperature": "highest temperature",
    "equilibrium_total_power_loss": "power loss",
    "rotor_damping_ratio": "damping ratio of the rotor",
    "threshold_rpm": "threshold",
}
#: What holds of several bearings: the least film, the loss of all, else the largest.
OF_BEARINGS: dict[str, np.ufunc] = {
    "equilibrium_min_film_thickness": np.fmin,
    "equilibrium_total_power_loss": np.add,
}
#: Further ones where the journal is held, for comparison with tables.
HELD = {
    "equilibrium_attitude_angle": "attitude angle",
    "equilibrium_sommerfeld_number": "Sommerfeld number",
    "equilibrium_specific_load": "specific load",
}
#: What is told of each pad with turbulence.
TURBULENCE = ("reynolds_number", "largest_reynolds_number", "turbulent_share")
#: Pictures of whole studies.
PICTURES = ("response", "coefficients", "stability", "campbell", "temperatures")


def study_report(study: Study, operating: tuple[float, float] | None = None) -> str:
    """The page as text; `operating` are the lowest and the highest operating speed, rpm."""
    by = study.attributes
    whole = np.ones(len(study.done), dtype=bool)
    parts = [
        f"{by['program']} {by['version']}, {by['created']}",
        summary(study),
        section("Operating points", operating_points(study)),
        section("Turbulent films", turbulent_films(study)),
        *(
            section(escape(f"Turbulent films, bearing {name}"), turbulent_films(each))
            for name, each in study.bearings.items()
        ),
        section("Critical speeds", critical(study, operating)),
        section("Runs that were not done", failures(study)),
        section("Remarks", remarks(study)),
        *(sample(study) if sampled(study, whole) else [folded("Curves", "".join(curves(study)))]),
        folded("Runs", runs(study)),
        given("Input of the first run", study),
    ]
    return page(study, parts)


def summary(study: Study) -> str:
    """How many runs there are and were done, and what they differ in."""
    count, done, pending = len(study.done), int(study.done.sum()), int(study.pending.sum())
    missing = study.attributes.get("missing", "")
    text = f"{count} runs, {done} of them done." + f" {not_run_yet(pending)}.".capitalize() * (pending > 0)
    for name in study.parameters:
        values = distinct(study[name])
        if values:
            several = f"{written(values[0])} to {written(values[-1])}, {len(values)} values"
            own = several if len(values) > 4 else ", ".join(map(written, values))
            text += f" {study.about(name, 'long_name') or name}: {own}."
    lost = paragraph(f"Runs without a file: {missing}.", warning=True) if missing else ""
    return paragraph(text) + lost


def operating_points(study: Study) -> str:
    """A row for each run that was done: place, film, stiffness, damping, temperature, loss, stability.

    Coefficients are those of the first pivots at the first whirl frequency, of the bearing of a case.
    """
    varied = [name for name in study.parameters if np.ndim(study[name]) == 1]
    columns = {label(study, name): list(map(written, study.values(name, slice(ROWS)))) for name in varied}
    if "speed_rpm" not in varied and "speed" in study:
        columns["speed (rpm)"] = cells(SHOWN["speed"].factor * study.speed[:ROWS])
    held = "equilibrium_bearing_load_y" in study and "station" not in study
    bearings = list(study.bearings.values())
    for name, head in (POINT | HELD if held else POINT).items():
        found = [result(each, name) for each in ([study] if name in study else bearings) if name in each]
        if found:
            shown, values = found[0].shown, np.stack([each.values[:ROWS] for each in found])
            unit = f" ({shown.unit})" if shown.unit else ""
            columns[head + unit] = cells(shown.factor * OF_BEARINGS.get(name, np.fmax).reduce(values))
    for letter, name in (("K", "stiffness"), ("C", "damping")):
        for k, axis in enumerate("yz") if name in study else ():
            values = SHOWN[name].factor * study[name][:ROWS, 0, 0, k, k]
            columns[f"{letter} {axis}{axis} ({SHOWN[name].unit})"] = cells(values)
    grows = instability(study, None)
    if grows is None:
        return ""
    words = {0: "stable", 1: "unstable"}
    rotor = "shaft" if "station" in study else "journal"
    columns[f"the {rotor} is"] = [words.get(each, "–") for each in grows[:ROWS]]
    rows = [row for row, done in zip(zip(*columns.values(), strict=True), study.done, strict=False) if done]
    pivots = [str(each) for each in study["pivot"]] if "pivot" in study else []
    of = f"Pivots {pivots[0]}; the others are in the table of runs. " if len(pivots) > 1 else ""
    worst = "Figures are those of the worst of the bearings, the loss is that of all. " * bool(bearings)
    flutter = "; pads without load may flutter while it is stable"
    note = f"{of}{worst}Stability is that of the {rotor}{flutter}."
    return table(tuple(columns), rows) + paragraph(note) + more(len(study.done)) if rows else ""


def turbulent_films(study: Study) -> str:
    """A row for each run with turbulence: Reynolds numbers of the pads, and how much of them is turbulent."""
    if any(f"pad_equilibrium_{name}" not in study for name in TURBULENCE):
        return ""
    found = np.stack([study[f"pad_equilibrium_{name}"][:ROWS] for name in TURBULENCE], axis=-1)
    columns = [study.values(name, slice(ROWS)) for name in ("run", *study.parameters)]
    rows = []
    for own, (number, *values) in zip(found, zip(*columns, strict=True), strict=True):
        if np.isfinite(own[:, -1]).any():
            pads = (f"{mean:.0f}, {most:.0f}, {100 * share:.0f} %" for mean, most, share in own)
            rows.append((f"{number}", *map(written, values), *pads))
    heads = ("run", *named(study), *(f"pad {k + 1}" for k in range(found.shape[1])))
    note = "Reynolds number with the mean film thickness, largest local one, and turbulent share of the arc."
    return table(heads, rows) + paragraph(note) + more(len(study.done)) if rows else ""


def cells(values: np.ndarray) -> list[str]:
    """Numbers of a column; a dash where there is none."""
    return [digits(each) if np.isfinite(each) else "–" for each in values]


def critical(study: Study, operating: tuple[float, float] | None) -> str:
    """A table of the critical speeds at all stations, for each kind of pivots; empty where there are none."""
    linear = "response_y_real" in study
    rows = []
    pivots: list[str | None] = [str(each) for each in study["pivot"]] if linear else [None]
    # kinds of pivots that are one, as without pads that tilt, are not told
    first = int(len(pivots) < 2)
    for pivot in pivots:
        try:
            found = critical_speeds(study, pivot=pivot, operating=operating)
        except (ValueError, NotInRunError):
            continue
        rows += [critical_row(f"{pivot}", each)[first:] for each in found]
    text = (
        "N1, N2: speeds at half power; AF: amplification factor N/(N2 - N1); SM: separation margin; API 617."
    )
    if operating:
        text += f" Operating speeds: {written(operating[0])} to {written(operating[1])} rpm."
    heads: tuple[str, ...]
    heads = ("pivots", "station", "direction", "N (rpm)", "amplitude (µm)", "N1 (rpm)", "N2 (rpm)", "AF")
    heads = heads[first:]
    margins = ("required SM below, above (%)", *(("SM (%)", "required SM (%)") if operating else ()))
    wanted = len(heads) + len(margins)
    if any(">" in row[heads.index("AF")] for row in rows):
        text += " >: fewer than three of the speeds lie between N1 and N2, so that the peak is higher and "
        text += "sharper than this; a study of closer speeds finds its factor and its margins."
    return table((*heads, *margins), [row[:wanted] for row in rows]) + paragraph(text) if rows else ""


def critical_row(pivot: str, own: CriticalSpeed) -> tuple[str, ...]:
    """Cells of a critical speed."""
    peak = own.peak
    size = digits(SHOWN["amplitude"].factor * peak.amplitude)
    edges = (peak.below_rpm, peak.above_rpm, peak.amplification_factor)
    place = (pivot, f"{own.station or '–'}", peak.direction, digits(peak.speed_rpm))
    numbers, margin = (digits(each) for each in edges), digits(own.margin, 3)
    if peak.open:
        first, second, factor = numbers
        return (*place, f"> {size}", first, second, f"> {factor}", "–", margin, "–")
    sides = ", ".join(digits(each, 3) for each in (peak.margin_below, peak.margin_above))
    return (*place, size, *numbers, sides, margin, digits(own.required, 3))


def failures(study: Study) -> str:
    """A row for each run that was not done, with the recorded reason."""
    rows = [
        (f"{each.run}", *(written(value) for value in each.values.values()), each.how, each.reason)
        for each in study.failures(ROWS)
    ]
    return table(("run", *named(study), "end", "reason"), rows, words=True) + more(int(study.failed.sum()))


def remarks(study: Study) -> str:
    """A row for each remark, in the words of the first run that has it."""
    rows = [(f"{each.runs}", f"{each.first}", each.words) for each in common_remarks(study)[:ROWS]]
    return table(("runs", "first run", "remark on it"), rows, words=True)


def more(rows: int) -> str:
    """That a table has not all of these rows."""
    return paragraph(f"and {rows - ROWS} more, in the file." if rows > ROWS else "")


def named(study: Study) -> list[str]:
    """The parameters with their units, as heads of columns."""
    return [label(study, name) for name in study.parameters]


def runs(study: Study) -> str:
    """Parameters and key results of every run."""
    keys = key_results(study)[:COLUMNS]
    columns = [study.values(name, slice(ROWS)) for name in ("run", *study.parameters)]
    rows = []
    for k, (number, *own) in enumerate(zip(*columns, strict=True)):
        results = (digits(key.shown.factor * key.values[k]) for key in keys)
        rows.append((f"{number}", *map(written, own), "yes" if study.done[k] else "no", *results))
    heads = ("run", *named(study), "done", *(key.shown.label for key in keys))
    return table(heads, rows) + more(len(study.done))


def curves(study: Study) -> Iterator[str]:
    """The key results over the parameters, and the pictures that only some studies have."""
    for each in key_results(study) if study.parameters else []:
        try:
            caption = f"{each.shown.text.replace('$', '')}.".capitalize()
            yield picture(each.name, partial(figures.study, study, each.name), caption, remarks=False)
        except ValueError:
            continue
    for name in PICTURES:
        try:
            yield picture(name, partial(figures.FIGURES[name], [study]), remarks=False)
        except (ValueError, NotInRunError):
            continue
