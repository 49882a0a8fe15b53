"""Parts of the page about a machine that the page about one bearing has not."""

from collections.abc import Iterable, Sequence
from functools import partial
from typing import SupportsIndex

import numpy as np

from tiltpad.calculate import summary
from tiltpad.calculate.modes import Modes
from tiltpad.calculate.stations import StationModes, attached, positions, station_modes
from tiltpad.draw import figures
from tiltpad.draw.machines import machine
from tiltpad.draw.page import paragraph, picture, row, table
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN, Shown, described, digits, fitted, numbers

#: Pictures of the machine as a whole; those of the bearings are beside them.
WHOLE = ("shaft", "stations", "shapes", "multipliers", "stability")
#: What the rotor is, in the order of the table.
ROTOR = (
    *("total_mass", "left_out_frequency", "truncation_error", "station_error"),
    *("damped_above", "damping_error"),
)
#: Loads of the bearings along y and z.
LOADS = ("equilibrium/bearing_load_y", "equilibrium/bearing_load_z")
#: Heads of the columns of a mode.
VIBRATION = ("frequency (Hz)", "damping ratio (%)", "logarithmic decrement")
#: Figures of the stations, and their words at the head of the table.
STATIONS = {
    "equilibrium/station_{}": "equilibrium",
    "summary/station_{}_size": "peak to peak",
    "summary/station_{}_amplitude": "1x amplitude",
}


def rotor_figures(run: Run) -> str:
    """Mass and modes of the rotor, the errors of its reduction, and what the file has of the whole run."""
    rows: list[Sequence[str]] = []
    if "rotor/mode_frequency" in run:
        kept = run["rotor/mode_frequency"]
        words = "modes of the shaft that are kept, and the highest frequency of them"
        rows.append((words, f"{len(kept)}, {digits(max(kept, default=0.0))}", "Hz"))
    for name in (f"rotor/{each}" for each in ROTOR if f"rotor/{each}" in run):
        own = Shown(run.about(name, "long_name"), 1, run.about(name, "units").replace("1", ""))
        rows.append((own.text, digits(float(run[name])), own.unit))
    rows += [row(shown, list(np.atleast_1d(value))) for _, shown, value in summary.journal(run)]
    return table(("rotor and run", "value", "unit"), rows)


def bearing_figures(run: Run) -> str:
    """Stations, loads and key figures of the bearings, a column for each."""
    names = list(run.bearings)
    if not names:
        return ""
    rows = []
    if "rotor/bearing_station" in run:
        rows.append(("station", *(f"{each:.0f}" for each in run["rotor/bearing_station"]), ""))
    loads = [run[name] for name in LOADS if name in run]
    shown = fitted(Shown("load of the rotor", 1e-3, "kN"), np.ravel(loads))
    texts = iter(numbers(shown, np.ravel(loads)))
    for way in ("vertical", "horizontal")[: len(loads)]:
        rows.append((f"{shown.text}, {way}", *(next(texts) for _ in names), shown.unit))
    whole = {each.name for each in summary.journal(run)}
    found = [{each.name: each for each in summary.journal(own)} for own in run.bearings.values()]
    for name in dict.fromkeys(name for own in found for name in own if name not in whole):
        shown = next(own[name].shown for own in found if name in own)
        values = [float(own[name].value) if name in own else np.nan for own in found]
        rows.append(row(shown, values))
    return table(("bearing", *names, "unit"), rows)


def station_figures(run: Run) -> str:
    """Where the shaft is at the stations, and how far they move in the last revolution."""
    there = {name: words for name, words in STATIONS.items() if name.format("y") in run}
    if not there:
        return ""
    columns, heads = [], []
    for name, words in there.items():
        both = np.concatenate([run[name.format(axis)] for axis in "yz"])
        shown = fitted(described(run, name.format("y"), "journal_y"), both)
        texts = numbers(shown, both)
        half = len(texts) // 2
        columns.append([f"{y}, {z}" for y, z in zip(texts[:half], texts[half:], strict=True)])
        heads.append(f"{words} y, z ({shown.unit})")
    what, x = attached(run.input), positions(run)
    known = "rotor/station_position" in run
    rows: list[Sequence[str]] = []
    for k, values in enumerate(zip(*columns, strict=True)):
        label = ", ".join([f"{k + 1}", *what.get(k + 1, [])])
        rows.append((label, f"{x[k]:.4g}" if known else "", *values))
    return table(("station", "position (m)", *heads), rows)


def mode_table(run: Run) -> str:
    """The modes that vibrate, for all pivots, with the sense of their whirl.

    Those whose damping is mostly that of the reduction are left out, as on the console.
    """
    if "modes" not in run:
        return ""
    rows: list[Sequence[str]] = []
    notes: list[str] = []
    left_out = 0
    pivots = [str(each) for each in run["pivot"]]
    several = len(pivots) > 1
    for number, pivot in enumerate(pivots):
        found = station_modes(run, pivot)
        for k in np.flatnonzero(found.own & ((found.frequency > 0) | (found.damping_ratio < 0))):
            word = f"{pivot}, {found.word[k]}" if several else str(found.word[k])
            rows.append((word, *vibration(found, k)))
        if "modes/threshold_rpm" in run and np.isfinite(speed := run["modes/threshold_rpm"][number]):
            notes.append(f"{pivot} pivots: {speed:.1f} rpm" if several else f"{speed:.1f} rpm")
        left_out += int((~found.own).sum())
    why = "which a march damps (reduction%damp_above)"
    note = paragraph(f"Not listed: high modes of the shaft, {left_out}, {why}." if left_out else "")
    head = "pivots, whirl of the shaft" if several else "whirl of the shaft"
    return table((head, *VIBRATION), rows) + threshold(notes) + note


def vibration(found: Modes | StationModes, k: SupportsIndex) -> tuple[str, ...]:
    """Cells of a mode: frequency and damping."""
    ratio, decrement = SHOWN["damping_ratio"].factor * found.damping_ratio[k], found.log_decrement[k]
    return f"{found.frequency[k]:.5g}", digits(ratio), digits(decrement)


def threshold(speeds: Sequence[str]) -> str:
    """The threshold speeds of pivots, where there are any."""
    return paragraph(f"Threshold speed of stability: {'; '.join(speeds)}." if speeds else "")


def pictures(run: Run) -> Iterable[str]:
    """The pictures of the machine as a whole that this run can have."""
    if "length" in run.input.get("shaft", {}):
        yield picture("machine", lambda: machine(run), "The machine to scale.")
    for name in WHOLE:
        source = run.bearings.whole() if name == "multipliers" else run
        try:
            yield picture(name, partial(figures.FIGURES[name], [source]))
        except NotInRunError:
            continue
