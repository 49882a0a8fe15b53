"""A page about a run."""

from collections.abc import Iterable
from functools import partial
from html import escape

import numpy as np

from tiltpad.calculate import rotation, signals, summary
from tiltpad.calculate.coefficients import coefficients, of_pivots
from tiltpad.calculate.library import MissingLibraryError
from tiltpad.calculate.modes import modes, of_journal
from tiltpad.calculate.response import response
from tiltpad.calculate.tables import ELEMENTS
from tiltpad.draw import figures, machine_report
from tiltpad.draw.bearing import bearing
from tiltpad.draw.branches import in_words as critical
from tiltpad.draw.machine_report import VIBRATION, threshold, vibration
from tiltpad.draw.overview import further_remarks, overview, sentence
from tiltpad.draw.page import PICTURES, folded, given, page, paragraph, picture, row, table
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Bearing, Run
from tiltpad.files.units import SHOWN, digits, in_words


def report(run: Run) -> str:
    """The page as text; tables and pictures that the run cannot have are left out."""
    by = run.attributes
    parts = [
        f"written by {by['program']} {by['version']} ({by['commit']}), {by['created']}",
        overview(run),
        folded("Further remarks", further_remarks(run)),
        *(of_machine(run) if run.is_machine else of_bearing(run)),
        given("Input", run),
        folded("Cost", statistics(run)),
    ]
    return page(run, parts)


def of_bearing(run: Run) -> Iterable[str]:
    """What the page about one bearing has."""
    rows = [row(shown, list(np.atleast_1d(value))) for _, shown, value in summary.journal(run)]
    yield paragraph(peaks(run))
    yield folded("Key figures", table(("journal and film", "value", "unit"), rows))
    yield folded("Pads", pad_figures(run))
    yield folded("Films, solved closely", verification(run))
    yield folded("Spectrum", spectrum_peaks(run))
    yield folded("Stiffness and damping", coefficient_table(run))
    yield folded("Modes", mode_table(run))
    yield folded("Pictures", "".join(pictures(run)))


def of_machine(run: Run) -> Iterable[str]:
    """What the page about a machine has: the whole of it, then each of its bearings."""
    yield folded("Rotor", machine_report.rotor_figures(run))
    yield folded("Bearings", machine_report.bearing_figures(run))
    yield folded("Stations", machine_report.station_figures(run))
    yield folded("Films, solved closely", verification(run))
    yield folded("Modes", machine_report.mode_table(run))
    yield folded("Pictures", "".join(machine_report.pictures(run)))
    for name, own in run.bearings.items():
        tables = (pad_figures(own), spectrum_peaks(own), coefficient_table(own))
        yield folded(escape(f"Bearing {name}"), "".join([*tables, *pictures(own)]))


def peaks(run: Run) -> str:
    """The peaks of the first order in a run-up, in words."""
    if "speed" not in run:
        return ""
    try:
        found = response(run).peaks
    except NotInRunError:
        return ""
    words = [f"{each.direction} {in_words('size', [each.amplitude])} at {critical(each)}" for each in found]
    speeds = " to ".join(f"{SHOWN['speed'].factor * each:.0f}" for each in signals.ends(run, "speed"))
    if not words:
        return f"No critical speed between {speeds} rpm."
    return f"Peaks of the first order, {speeds} rpm (AF: amplification factor): {'; '.join(words)}."


def pad_figures(run: Run) -> str:
    head = ("pad", *(f"{pad}" for pad in range(1, run.pads + 1)), "unit")
    angles = ("pivot angle", *(f"{angle:g}" for angle in np.round(np.degrees(run.pivot_angle), 6)), "deg")
    own = [figure for figure in summary.pads(run) if "film_error" not in figure.name]
    rows = [row(shown, list(np.atleast_1d(values))) for _, shown, values in own]
    note = ""
    if "summary/last_revolutions" in run:
        over = f"lifting, rubbing and dominant order over the last {run['summary/last_revolutions']:.0f}"
        note = f"<p>Last revolution; {over}.</p>"
    return table(head, [angles, *rows]) + note


def verification(run: Run) -> str:
    """How far the films of the run are from closely solved ones, as its file says it in words."""
    lines = f"{run.attributes.get('verification', '')}".splitlines()
    return "".join(paragraph(sentence(line)) for line in lines)


def spectrum_peaks(run: Run) -> str:
    try:
        found = summary.peaks(run)
    except NotInRunError:
        return ""
    shown = SHOWN["amplitude"]
    head = ("order", "frequency (Hz)", f"amplitude of y ({shown.unit})", f"amplitude of z ({shown.unit})")
    rows = []
    for order, frequency, *sizes in found:
        rows.append((f"{order:.3g}", f"{frequency:.5g}", *(digits(shown.factor * each) for each in sizes)))
    note = f"Highest peaks of the last {run['spectrum/revolutions']} revolutions."
    return table(head, rows) + paragraph(note) if rows else ""


def coefficient_table(run: Run) -> str:
    """The coefficients of all pivots at all whirl frequencies."""
    if "coefficients" not in run:
        return ""
    rows = []
    several = run.length("pivot") > 1
    for pivot in run["pivot"]:
        found = coefficients(run, pivot)
        for ratio, *both in zip(found.frequency_ratio, found.stiffness, found.damping, strict=True):
            named = zip(("stiffness", "damping"), both, strict=True)
            values = [digits(SHOWN[name].factor * each) for name, matrix in named for each in matrix.ravel()]
            rows.append((f"{pivot}, " * several + f"{ratio:g}", *values))
    units = {"K": SHOWN["stiffness"].unit, "C": SHOWN["damping"].unit}
    heads = [f"{letter} {element} ({unit})" for letter, unit in units.items() for element in ELEMENTS]
    note = "The frequency is that of the whirl over the shaft's; y is up, the shaft turns "
    note += f"{rotation.ends(rotation.sense(run.input))}."
    if "equilibrium/viscosity" in run:
        note += " The viscosities are those of the equilibrium."
    return table(("pivots, " * several + "frequency", *heads), rows) + f"<p>{note}</p>"


def mode_table(run: Run) -> str:
    """The modes of all pivots, and the threshold speeds of stability where they were looked for."""
    if "modes" not in run:
        return ""
    rows, thresholds, verdicts = [], [], []
    several = run.length("pivot") > 1
    for pivot in run["pivot"]:
        found = modes(run, pivot)
        whose = of_pivots(run, pivot)
        journal, listed = of_journal(found.name), (found.frequency > 0) | (found.damping_ratio < 0)
        for k in (*np.flatnonzero(journal & listed), *np.flatnonzero(~journal & listed)):
            rows.append((f"{pivot}", f"{found.name[k]}", *vibration(found, k))[not several :])
        for who, kind in (("The journal is", journal), ("The pads are", ~journal & (found.name != ""))):
            if kind.any():
                how = "unstable" if (found.damping_ratio[kind] < 0).any() else "stable"
                verdicts.append(f"{who} {how}" + f", {whose}" * several + ".")
        if np.isfinite(found.threshold_rpm):
            thresholds.append(f"{whose}: " * several + f"{found.threshold_rpm:.1f} rpm")
    verdict = paragraph(f"{' '.join(verdicts)} Modes without vibration that decay are not listed.")
    return table(("pivots", "mode", *VIBRATION)[not several :], rows) + verdict + threshold(thresholds)


def pictures(run: Run) -> Iterable[str]:
    """The pictures that this run can have, with their captions."""
    yield picture("bearing", lambda: bearing(run), "The bearing, with clearances enlarged.")
    for name in PICTURES:
        if (name == "size" and signals.steady(run)) or (name == "equilibrium" and run.samples):
            continue
        if isinstance(run, Bearing) and name in machine_report.WHOLE:
            continue
        pad = liveliest(run) if name == "poincare" else None
        try:
            yield picture(name, partial(figures.FIGURES[name], [run], None, pad))
        except (NotInRunError, MissingLibraryError):
            continue


def liveliest(run: Run) -> int | None:
    """The pad whose tilt moves most in the last revolutions."""
    if "pad_tilt" not in run or run.samples < 2:
        return None
    return 1 + int(np.argmax(np.ptp(signals.waveform(run, "pad_tilt")[1], axis=0)))


def statistics(run: Run) -> str:
    """Every number of the group `statistics`, with its meaning and unit."""
    rows = []
    for name, value in run["statistics"].items():
        words, unit = (run.about(f"statistics/{name}", each) for each in ("long_name", "units"))
        number = f"{value:.4g}" if isinstance(value, float) else f"{value}"
        rows.append((words or name, number, unit.replace("1", "")))
    return table(("cost of the computation", "value", "unit"), rows)
