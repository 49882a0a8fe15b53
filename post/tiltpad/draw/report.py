"""A page about a run."""

from collections.abc import Iterable
from functools import partial
from html import escape
from pathlib import Path

import numpy as np

from tiltpad.calculate import rotation, signals, summary
from tiltpad.calculate.coefficients import coefficients
from tiltpad.calculate.library import MissingLibraryError
from tiltpad.calculate.modes import modes, of_journal
from tiltpad.calculate.response import response
from tiltpad.draw import figures, machine_report
from tiltpad.draw.bearing import bearing
from tiltpad.draw.branches import in_words as critical
from tiltpad.draw.page import PICTURES, page, paragraph, picture, row, section, table
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Bearing, Run
from tiltpad.files.units import SHOWN, digits, in_words


def report(run: Run) -> str:
    """The page as text; tables and pictures that the run cannot have are left out."""
    title = run.title or Path(run.path).stem
    if run.bearings:
        return page(title, of_machine(run))
    parts = [
        f"<p class=origin>{escape(origin(run))}</p>",
        incomplete(run),
        orbit_stability(run),
        section("Remarks", remarks(run)),
        paragraph(peaks(run)),
        section("Key figures", key_figures(run)),
        section("Pads", pad_figures(run)),
        section("Films, solved closely", verification(run)),
        section("Spectrum", spectrum_peaks(run)),
        section("Stiffness and damping", coefficient_table(run)),
        section("Modes", mode_table(run)),
        section("Pictures", "".join(pictures(run))),
        section("Input", f"<pre>{escape(run.attributes['input'].strip())}</pre>"),
        section("Cost", statistics(run)),
    ]
    return page(title, parts)


def of_machine(run: Run) -> Iterable[str]:
    """The parts of the page about a machine: the whole of it, then each of its bearings."""
    yield f"<p class=origin>{escape(origin(run))}</p>"
    yield incomplete(run)
    yield orbit_stability(run)
    yield section("Remarks", remarks(run))
    yield section("Rotor", machine_report.rotor_figures(run))
    yield section("Bearings", machine_report.bearing_figures(run))
    yield section("Stations", machine_report.station_figures(run))
    yield section("Films, solved closely", verification(run))
    yield section("Modes", machine_report.mode_table(run))
    yield section("Pictures", "".join(machine_report.pictures(run)))
    for name, own in run.bearings.items():
        tables = (pad_figures(own), spectrum_peaks(own), coefficient_table(own))
        yield section(escape(f"Bearing {name}"), "".join([*tables, *pictures(own)]))
    yield section("Input", f"<pre>{escape(run.attributes['input'].strip())}</pre>")
    yield section("Cost", statistics(run))


def origin(run: Run) -> str:
    """File, program and time."""
    by = run.attributes
    written = f"written by {by['program']} {by['version']} ({by['commit']}), {by['created']}"
    return f"{Path(run.path).name}: {written}"


def incomplete(run: Run) -> str:
    return "" if run.complete else paragraph(f"Incomplete run{run.end()}.", warning=True)


def orbit_stability(run: Run) -> str:
    """Whether a periodic orbit is stable; a warning where it is not."""
    if "periodic" not in run:
        return ""
    if run["periodic/stable"]:
        return paragraph("The periodic orbit is stable: small disturbances die out.")
    return paragraph("The periodic orbit is unstable: no motion stays on it.", warning=True)


def remarks(run: Run) -> str:
    """What is unusual, or leaves the range of the model."""
    return "".join(paragraph(f"{each[0].upper()}{each[1:]}.", warning=True) for each in run.remarks)


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


def key_figures(run: Run) -> str:
    rows = [row(shown, list(np.atleast_1d(value))) for _, shown, value in summary.journal(run)]
    return table(("journal and film", "value", "unit"), rows)


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
    return "".join(paragraph(f"{line[0].upper()}{line[1:]}.") for line in lines)


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
            digits(SHOWN["amplitude"].factor * each.y),
            digits(SHOWN["amplitude"].factor * each.z),
        )
        for each in found
    ]
    note = f"Highest peaks of the last {run['spectrum/revolutions']} revolutions."
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
            values = [digits(SHOWN[name].factor * each) for name, matrix in named for each in matrix.ravel()]
            rows.append((f"{of_pivots(run, pivot)}, {ratio:g}", *values))
    heads = [
        f"{letter} {element} ({SHOWN[name].unit})"
        for letter, name in (("K", "stiffness"), ("C", "damping"))
        for element in ("yy", "yz", "zy", "zz")
    ]
    note = "The frequency is that of the whirl over the shaft's; y is up, the shaft turns "
    note += f"{rotation.ends(rotation.sense(run.input))}."
    if "equilibrium/viscosity" in run:
        note += " The viscosities are those of the equilibrium."
    return table(("pivots, frequency", *heads), rows) + f"<p>{note}</p>"


def mode_table(run: Run) -> str:
    """The modes of all pivots, and the threshold speeds of stability where they were looked for."""
    if "modes" not in run:
        return ""
    rows, thresholds, verdicts = [], [], []
    for pivot in run["pivot"]:
        found = modes(run, pivot)
        own = list(zip(found.name, found.frequency, found.damping_ratio, found.log_decrement, strict=True))
        journal = of_journal(found.name)
        rows += [
            (
                of_pivots(run, pivot),
                f"{name}",
                f"{hertz:.5g}",
                digits(SHOWN["damping_ratio"].factor * ratio),
                digits(SHOWN["log_decrement"].factor * decrement),
            )
            for kind in (journal, ~journal)
            for (name, hertz, ratio, decrement), here in zip(own, kind, strict=True)
            if here and (hertz > 0 or ratio < 0)
        ]
        for who, kind in (("The journal is", journal), ("The pads are", ~journal & (found.name != ""))):
            if kind.any():
                how = "unstable" if (found.damping_ratio[kind] < 0).any() else "stable"
                verdicts.append(f"{who} {how}, pivots {of_pivots(run, pivot)}.")
        if np.isfinite(found.threshold_rpm):
            thresholds.append(f"pivots {of_pivots(run, pivot)}: {found.threshold_rpm:.1f} rpm")
    note = f"<p>Threshold speed of stability: {'; '.join(thresholds)}.</p>" if thresholds else ""
    head = ("pivots", "mode", "frequency (Hz)", "damping ratio (%)", "logarithmic decrement")
    return (
        table(head, rows)
        + f"<p>{' '.join(verdicts)} Modes without vibration that decay are not listed.</p>"
        + note
    )


def of_pivots(run: Run, pivot: str) -> str:
    """What the pivots do in coefficients and modes; fixed pads have none."""
    return "none" if run.input["pads"]["motion"] == "fixed" else pivot


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
    rows = [
        (
            run.about(f"statistics/{name}", "long_name") or name,
            f"{value:.4g}" if isinstance(value, float) else f"{value}",
            run.about(f"statistics/{name}", "units").replace("1", ""),
        )
        for name, value in run["statistics"].items()
    ]
    return table(("cost of the computation", "value", "unit"), rows)
