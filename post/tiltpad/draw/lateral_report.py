"""The page of a lateral analysis after API 617, to be printed and handed on, and its tables."""

from collections.abc import Iterator, Sequence
from functools import partial
from html import escape
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from tiltpad.calculate import lateral_limits as limits
from tiltpad.calculate.coefficients import coefficients
from tiltpad.calculate.lateral_limits import FULL, SYNCHRONOUS, Column, Lateral, LevelOne, Vibration
from tiltpad.calculate.modes import modes, of_journal
from tiltpad.calculate.remarks import by_weight
from tiltpad.calculate.stations import positions, station_modes
from tiltpad.draw import layout
from tiltpad.draw.machines import machine, shapes
from tiltpad.draw.overview import sentence
from tiltpad.draw.page import folded, paragraph, picture, section, table, whole_page
from tiltpad.draw.vibrations import campbell
from tiltpad.files.namelist import bearing_names
from tiltpad.files.units import digits

MET, NOT_MET = "met", "not met"
SOURCES = (
    "The requirements are those of API 617 and API RP 684 as public sources quote them (reports of ROSS), "
    "not as the standards' text has them; the clauses are those that these sources name. The unbalance has "
    f"the factor {limits.UNBALANCE_FACTOR} of earlier editions; the 9th is quoted with 2. Scaled vibration "
    f"does not depend on it, unless the scale factor reaches its limit of {limits.LARGEST_SCALE}."
)
#: Modes of the table of level II up to this multiple of the speed.
SLOW = 2


class Table(NamedTuple):
    """A table of the report: the end of its CSV file's name, heads, rows of texts."""

    name: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    words: bool = False

    @property
    def html(self) -> str:
        return table(self.head, self.rows, self.words)


class Found(NamedTuple):
    """A lateral analysis and what follows from it: of each column the vibrations by mode, and both levels."""

    lateral: Lateral
    vibrations: list[list[Vibration]]
    one: list[LevelOne]
    two: list[LevelOne]


def found_in(lateral: Lateral) -> Found:
    modes_of = range(len(lateral.placed))
    vibrations = [[limits.vibration(lateral, each, k) for k in modes_of] for each in lateral.columns]
    one = [limits.level_one(each.level_1) for each in lateral.columns]
    return Found(lateral, vibrations, one, [limits.level_one(each.level_2) for each in lateral.columns])


def lateral_report(lateral: Lateral) -> tuple[str, list[Table]]:
    """The page as text, and all of its tables."""
    found = found_in(lateral)
    run = lateral.columns[0].level_2
    by, title = run.attributes, run.title or lateral.case
    origin = f"{lateral.case}: {by['program']} {by['version']} ({by['commit']}), {by['created']}"
    tables: list[Table] = []
    parts = []
    for heading, content in (
        ("Summary", summary),
        ("Machine", machine_part),
        ("Undamped critical speeds", undamped),
        ("Damped natural frequencies", damped),
        ("Unbalance response", response),
        ("Stability, level I", level_1),
        ("Stability, level II", level_2),
        ("Remarks and sources", remarks),
    ):
        texts = []
        for each in content(found):
            texts.append(each.html if isinstance(each, Table) else each)
            tables += [each] if isinstance(each, Table) else []
        parts.append(section(heading, "".join(texts)))
    parts.append(folded("Input", f"<pre>{escape(by.get('input', '').strip())}</pre>"))
    return whole_page(title, origin, parts), tables


Parts = Iterator[str | Table]


def summary(found: Found) -> Parts:
    """Each requirement with what was found, and whether it is met."""
    low, high = found.lateral.speeds
    yield paragraph(
        f"Operating speeds {low:g} to {high:g} rpm. Logarithmic decrements are judged with the full "
        "matrices of the bearings, the pads' own equations; those with synchronously reduced "
        "coefficients stand beside them."
    )
    rows: list[Sequence[str]] = []

    def add(what: str, clause: str, asked: str, values: Sequence[str], met: bool) -> None:
        rows.append((what, limits.CLAUSES[clause], asked, *values, MET if met else NOT_MET))

    short = [shortest(own) for own in found.vibrations]
    margins = [text for text, _ in short]
    add("separation of critical speeds", "margin", "the required margin", margins, all(ok for _, ok in short))
    worst = [max(own, key=lambda each: each.largest) for own in found.vibrations]
    asked, kept = f"at most {micro(worst[0].limit)} µm p-p", all(each.largest <= each.limit for each in worst)
    add("vibration at the probes", "vibration", asked, [micro(each.largest) for each in worst], kept)
    if worst[0].close.size:
        shares = [max(share_of_clearance(found, each) for each in own) for own in found.vibrations]
        most = limits.SHARE_OF_CLEARANCE
        asked = f"scaled vibration at most {most:.0%} of it"
        add("close clearances", "clearance", asked, [f"{each:.0%}" for each in shares], max(shares) <= most)
    asked = "decrement with QA, Q0/QA, region"
    texts = [f"{digits(e.decrement[FULL], 3)}, {multiple(e, FULL)}, {e.region}" for e in found.one]
    add("stability, level I", "level_1", asked, texts, not reasons(found))
    decrements = [each.log_decrement[FULL, 0] for each in found.two]
    asked, stable = (
        f"decrement at least {limits.LEAST_DECREMENT:g}",
        min(decrements) >= limits.LEAST_DECREMENT,
    )
    add("stability, level II", "level_2", asked, [digits(each, 3) for each in decrements], stable)
    yield Table("summary", ("requirement", "clause", "asked for", *names(found), "result"), rows, words=True)
    # where level I is not enough, level II decides
    failed = [row[0] for row in rows if row[-1] == NOT_MET and row[0] != "stability, level I"]
    if reasons(found):
        yield paragraph(f"Level I is not enough ({'; '.join(reasons(found))}): level II decides.")
    told = f"Not met: {', '.join(failed)}." if failed else "All requirements are met."
    yield paragraph(told, warning=bool(failed))


def reasons(found: Found) -> list[str]:
    return list(dict.fromkeys(reason for each in found.one for reason in each.reasons))


def shortest(own: Sequence[Vibration]) -> tuple[str, bool]:
    """The critical speed that has the least to spare, in words, and whether all are far enough."""
    criticals = [each for vibration in own for _, each in vibration.criticals if each.required > 0]
    if not criticals:
        return "none with AF of 2.5 or more", True
    least = min(criticals, key=lambda each: each.margin - each.required)
    words = f"{least.peak.speed_rpm:.0f} rpm: {least.margin:.1f} %, required {least.required:.1f} %"
    return words, least.margin >= least.required


def share_of_clearance(found: Found, vibration: Vibration) -> float:
    """The largest part of a close clearance that scaled vibration takes."""
    clearances = 2 * np.array(limits.numbers_of(found.lateral.groups["lateral"]["close_clearance"]))
    return float((vibration.scale * vibration.close.max(axis=0) / clearances).max())


def machine_part(found: Found) -> Parts:
    """The machine, its rotor, bearings, and what acts on it beside."""
    run, groups = found.lateral.columns[0].level_2, found.lateral.groups
    if "length" in groups.get("shaft", {}):
        yield picture("machine", partial(machine, groups | {"unbalance": []}), "The machine to scale.")
    low, high = found.lateral.speeds
    journals = run["rotor/bearing_station"].astype(int)
    x = positions(run)
    rows: list[Sequence[str]] = [("mass of the rotor", digits(float(run["rotor/total_mass"])), "kg")]
    if "rotor/station_position" in run:
        rows += [("length", f"{x[-1] - x[0]:.4g}", "m")]
        rows += [("span between the outer bearings", f"{np.ptp(x[journals - 1]):.4g}", "m")]
    rows += [("operating speeds", f"{low:g} to {high:g}", "rpm")]
    rows += [("speeds of the diagrams", "{first_rpm:g} to {last_rpm:g}".format(**groups["lateral"]), "rpm")]
    yield Table("rotor", ("rotor", "value", "unit"), rows)
    yield Table("bearings", ("bearing", *bearing_names(groups), "unit"), list(bearing_rows(found)))
    if groups.get("impeller"):
        yield Table("impellers", *impellers(found))
    if groups.get("element"):
        yield Table("elements", *elements(groups["element"]))


def bearing_rows(found: Found) -> Iterator[Sequence[str]]:
    groups, columns = found.lateral.groups, found.lateral.columns
    own = groups["bearing"]
    pads = groups["pads"]
    yield ("station", *(f"{each['station']}" for each in own), "")
    yield ("journal diameter", *(f"{2e3 * each['journal_radius']:.5g}" for each in own), "mm")
    yield ("pad length", *(f"{1e3 * np.max(each['axial_length']):.4g}" for each in own), "mm")
    yield ("pads", *(f"{len(limits.numbers_of(each['pivot_angle_deg']))}" for each in pads), "")
    yield ("arc of a pad", *(f"{np.max(each['arc_deg']):.4g}" for each in pads), "deg")
    yield ("pivot offset", *(f"{np.max(each['pivot_ratio']):.3g}" for each in pads), "")
    for column in columns:
        there = column.level_2.bearings
        short = column.name.partition(" ")[0]
        inputs = [there[name].input["bearing"] for name in bearing_names(groups)]
        assembled, pad = (
            [float(np.min(each[f"{kind}_clearance"])) for each in inputs]
            for kind in ("assembled", "machined")
        )
        yield (f"{short}: diametral bearing clearance", *(micro(2 * each) for each in assembled), "µm")
        yield (f"{short}: preload", *(f"{1 - c / p:.2f}" for c, p in zip(assembled, pad, strict=True)), "")
        loads = np.hypot(*(column.level_2[f"equilibrium/bearing_load_{axis}"] for axis in "yz"))
        yield (f"{short}: load", *(digits(1e-3 * each) for each in loads), "kN")
        for words, name, factor, unit in (
            ("specific load", "specific_load", 1e-6, "MPa"),
            ("minimum film thickness", "min_film_thickness", 1e6, "µm"),
            ("power loss", "total_power_loss", 1e-3, "kW"),
        ):
            values = [np.nanmin(each[f"equilibrium/{name}"]) for each in there.values()]
            yield (f"{short}: {words}", *(digits(factor * each, 3) for each in values), unit)


def impellers(found: Found) -> tuple[Sequence[str], list[Sequence[str]]]:
    """Input and anticipated cross-coupled stiffness of the impellers."""
    run = found.lateral.columns[0].level_1
    rows: list[Sequence[str]] = []
    for k, (each, q) in enumerate(
        zip(found.lateral.groups["impeller"], run["stability/impeller_cross_stiffness"], strict=True), 1
    ):
        densities = [
            f"{each[name]:g}" if name in each else "-" for name in ("suction_density", "discharge_density")
        ]
        sizes = (f"{1e-3 * each['power']:g}", f"{1e3 * each['diameter']:g}", f"{1e3 * each['width']:g}")
        rows.append((f"{k}", f"{each['station']}", each["kind"], *sizes, *densities, f"{1e-6 * q:.4f}"))
    rows.append(("sum: QA", *[""] * 7, f"{1e-6 * found.one[0].anticipated:.4f}"))
    head = ("impeller", "station", "kind", "power (kW)", "diameter (mm)", "width (mm)", "suction (kg/m³)")
    return (*head, "discharge (kg/m³)", "q (MN/m)"), rows


def elements(own: Sequence[dict[str, Any]]) -> tuple[Sequence[str], list[Sequence[str]]]:
    """Elements with their coefficients, or the file of them."""
    rows: list[Sequence[str]] = []
    for k, each in enumerate(own, 1):
        other = each.get("to_station") or each.get("housing") or "ground"
        if each.get("file"):
            kinds = (f"table {each['file']}", f"at the {each.get('frequency', 'own')} frequency")
        else:
            q = np.array([0, 1, -1, 0]) * each.get("cross_stiffness", 0)
            kinds = (
                ", ".join(digits(v, 3) for v in 1e-6 * (np.array(each["stiffness"]) + q)),
                ", ".join(digits(v, 3) for v in 1e-3 * np.array(each["damping"])),
            )
        rows.append((f"{k}", f"{each['station']}", f"{other}", f"{each['level']}", *kinds))
    head = ("element", "station", "to", "level", "stiffness yy, yz, zy, zz (MN/m)")
    return (*head, "damping yy, yz, zy, zz (kN s/m)"), rows


def undamped(found: Found) -> Parts:
    """The undamped critical speed map with the stiffness of the bearings."""
    run = found.lateral.columns[0].level_1
    if "stability/undamped_rpm" not in run:
        yield paragraph("There is none of a rotor from a file whose planes may differ.")
        return
    words = "Undamped forward critical speeds over a stiffness that all bearings have along y and z, without "
    words += "the seals, and synchronous stiffness of the bearings over the speed."
    yield picture("map", partial(speed_map, found), words)
    stiffness, speeds = run["stability/bearing_stiffness"], run["stability/undamped_rpm"]
    rigid = run["stability/rigid_rpm"]
    shown = [k for k in range(speeds.shape[1]) if speeds[0, k] < 2 * found.lateral.speeds[1]]
    rows = [
        (digits(1e-6 * k), *(f"{own[i]:.0f}" for i in shown))
        for k, own in zip(stiffness[::5], speeds[::5], strict=True)
    ]
    rows.append(("rigid", *(f"{rigid[i]:.0f}" for i in shown)))
    heads = (f"critical speed {i + 1} (rpm)" for i in shown)
    yield Table("undamped", ("bearing stiffness (MN/m)", *heads), rows)


def speed_map(found: Found) -> Figure:
    run = found.lateral.columns[0].level_1
    stiffness, speeds = run["stability/bearing_stiffness"], run["stability/undamped_rpm"]
    fig, ax = plt.subplots(figsize=(layout.PAGE, 3.6))
    top = 4 * found.lateral.speeds[1]
    for each in speeds.T[np.nanmin(speeds, axis=0) < top]:
        ax.loglog(1e-6 * stiffness, each, color="0.2")
    marks: list[tuple[str, dict[str, Any]]] = [("undamped critical speed", {"color": "0.2"})]
    for number, column in enumerate(found.lateral.columns):
        color = f"C{number}"
        for own in column.studies[0].bearings.values():
            at = coefficients(own)
            for i, dashes in ((0, "-"), (1, "--")):
                ax.plot(1e-6 * at.stiffness[:, 0, i, i], at.speed_rpm, dashes, color=color, linewidth=1)
        short = column.name.partition(" ")[0]
        marks.append((f"bearings, {short} clearance: yy", {"color": color}))
        marks.append((f"{short}: zz", {"color": color, "linestyle": "--"}))
    ax.axhspan(*found.lateral.speeds, color="C2", alpha=0.15, linewidth=0)
    marks.append(("operating speeds", {"color": "C2", "alpha": 0.4, "linewidth": 5}))
    ax.set(xlabel="stiffness (MN/m)", ylabel="speed (rpm)", ylim=(0.5 * np.nanmin(speeds), top))
    ax.set_xlim(1e-6 * stiffness[0], 1e-6 * stiffness[-1])
    layout.heading(fig, marks, "")
    return fig


def damped(found: Found) -> Parts:
    """Campbell diagrams, crossings with the speed, mode shapes."""
    head = ("clearance", "mode", "crossing (rpm)", "logarithmic decrement", "amplification 1/(2 zeta)")
    rows: list[Sequence[str]] = []
    for column in found.lateral.columns:
        own = column.studies[0]
        words = f"Campbell diagram, {column.name}."
        yield picture("campbell", partial(campbell, [own]), words, remarks=False)
        rows += crossing_rows(column)
    yield Table("crossings", head, rows)
    high = found.lateral.speeds[1]
    for column in found.lateral.columns:
        words = f"Mode shapes at {high:g} rpm, {column.name}."
        yield picture("shapes", partial(shapes, [column.level_2], None), words)


def crossing_rows(column: Column) -> Iterator[Sequence[str]]:
    """Modes of the shaft whose frequency is that of the speed, linear between the runs."""
    own = modes(column.studies[0])
    away = own.frequency - own.speed_rpm[:, None] / 60
    rows = []
    for run, mode in zip(*np.nonzero(away[:-1] * away[1:] < 0), strict=True):
        if own.of_reduction[run, mode] or not of_journal(own.name[run : run + 1, mode])[0]:
            continue
        part = away[run, mode] / (away[run, mode] - away[run + 1, mode])
        speed, decrement = (
            float(each[run] + part * (each[run + 1] - each[run]))
            for each in (own.speed_rpm, own.log_decrement[:, mode])
        )
        factor = np.sqrt(4 * np.pi**2 + decrement**2) / (2 * decrement)
        numbers = (f"{speed:.0f}", digits(decrement, 3), digits(factor, 3))
        rows.append((speed, (column.name, str(own.name[run, mode]), *numbers)))
    yield from (each for _, each in sorted(rows))


def response(found: Found) -> Parts:
    """For each mode: unbalance, response, critical speeds, scale, close clearances."""
    high = found.lateral.speeds[1]
    yield paragraph(
        f"Unbalances of {limits.UNBALANCE_FACTOR} max(6350 W/N, 0.254 W) g mm with the highest operating "
        f"speed N in rpm ({limits.CLAUSES['unbalance']}) at the antinodes of the forward modes at this "
        "speed: W in kg is the load on both journals, that on the nearest one where there are several "
        "antinodes between them, or the overhung mass."
    )
    if not found.lateral.placed:
        yield paragraph(f"No forward mode vibrates at {high:g} rpm.")
    for number, placed in enumerate(found.lateral.placed):
        key = f"mode_{number + 1}"
        words = f"{digits(placed.frequency)} Hz, logarithmic decrement {digits(placed.log_decrement, 3)}"
        where = f"at {high:g} rpm, {found.lateral.columns[0].name}"
        yield f"<h3>Mode {number + 1}: forward, {words} ({escape(where)})</h3>"
        rows: list[Sequence[str]] = [
            (f"{u.station}", f"{1e6 * u.moment:.4g}", f"{u.angle_deg:g}", f"{u.load:.4g}")
            for u in placed.unbalances
        ]
        yield Table(f"{key}_unbalance", ("station", "unbalance (g mm)", "angle (deg)", "W (kg)"), rows)
        own = [each[number] for each in found.vibrations]
        yield picture(
            "response", partial(response_picture, found, own), "Vibration at the probes, peak to peak."
        )
        yield Table(f"{key}_critical_speeds", *critical_table(found, own))
        rows = [
            ("largest at operating speeds (µm)", *(micro(each.largest) for each in own)),
            ("limit, 25.4 √(12000/N), at most 25.4 (µm)", *(micro(each.limit) for each in own)),
            (f"scale factor, at most {limits.LARGEST_SCALE}", *(f"{each.scale:.2f}" for each in own)),
        ]
        yield Table(f"{key}_vibration", ("vibration at the probes, peak to peak", *names(found)), rows)
        if own[0].close.size:
            yield Table(f"{key}_clearances", *clearance_table(found, own))


def critical_table(found: Found, own: Sequence[Vibration]) -> tuple[Sequence[str], list[Sequence[str]]]:
    rows: list[Sequence[str]] = []
    for column, vibration in zip(found.lateral.columns, own, strict=True):
        for label, each in vibration.criticals:
            peak = each.peak
            judged = MET if each.margin >= each.required else NOT_MET
            factor = peak.amplification_factor
            numbers = (
                f"{peak.speed_rpm:.0f}",
                micro(peak.amplitude),
                digits(factor, 3) if factor > 0 else "flat",
            )
            margins = (
                (f"{each.required:.1f}", f"{each.margin:.1f}") if each.required else ("none (AF < 2.5)", "")
            )
            rows.append((column.name, label, *numbers, *margins, judged))
        if not vibration.criticals:
            rows.append((column.name, "no critical speed", *[""] * 6))
    head = ("clearance", "probe", "critical speed (rpm)", "peak to peak (µm)", "AF", "required margin (%)")
    return (*head, "margin (%)", "result"), rows


def clearance_table(found: Found, own: Sequence[Vibration]) -> tuple[Sequence[str], list[Sequence[str]]]:
    wanted = found.lateral.groups["lateral"]
    places = zip(
        *(limits.numbers_of(wanted[f"close_{each}"]) for each in ("station", "clearance")), strict=True
    )
    rows: list[Sequence[str]] = []
    for k, (station, clearance) in enumerate(places):
        allowed = limits.SHARE_OF_CLEARANCE * 2 * clearance
        scaled = [each.scale * float(each.close[:, k].max()) for each in own]
        judged = MET if max(scaled) <= allowed else NOT_MET
        rows.append((f"{station:g}", micro(2 * clearance), micro(allowed), *map(micro, scaled), judged))
    head = ("close clearance at station", "diametral (µm)", f"{limits.SHARE_OF_CLEARANCE:.0%} of it (µm)")
    return (*head, *(f"scaled vibration, {each} (µm)" for each in names(found)), "result"), rows


def response_picture(found: Found, own: Sequence[Vibration]) -> Figure:
    """A panel for each probe, with a line for each clearance."""
    fig, panels = layout.grid(len(own[0].labels), 2.3)
    low, high = found.lateral.speeds
    for k, ax in enumerate(panels):
        for i, each in enumerate(own):
            ax.plot(each.speed_rpm, 1e6 * each.probes[:, k], color=f"C{i}")
        ax.plot([low, high], [1e6 * own[0].limit] * 2, color="C3", linestyle="--", linewidth=1)
        ax.axvspan(low, high, color="C2", alpha=0.12, linewidth=0)
        ax.set(title=own[0].labels[k], xlabel="speed (rpm)", ylabel="peak to peak (µm)")
        ax.set_ylim(0, None)
    marks: list[tuple[str, dict[str, Any]]]
    marks = [(name, {"color": f"C{i}"}) for i, name in enumerate(names(found))]
    marks += [
        ("limit", {"color": "C3", "linestyle": "--"}),
        ("operating speeds", {"color": "C2", "alpha": 0.4, "linewidth": 5}),
    ]
    layout.heading(fig, marks, "")
    return fig


def level_1(found: Found) -> Parts:
    """Decrement over the cross-coupled stiffness, region, and whether level II is needed."""
    station = int(found.lateral.columns[0].level_1["stability/cross_station"])
    at = f"station {station}" if station else "the impellers"
    yield paragraph(
        "The first forward mode with the bearings alone, followed back from where the anticipated "
        f"cross-coupled stiffness QA acts, at {at}. Level II is needed where Q0/QA is below "
        f"{limits.LEAST_RATIO}, the decrement with QA below {limits.LEAST_DECREMENT}, or Q0/QA below "
        f"{limits.LEAST_RATIO_B} in region B ({limits.CLAUSES['level_1']})."
    )
    yield picture(
        "level I", partial(decrement_picture, found, found.one), "Logarithmic decrement of level I."
    )
    if np.isfinite([found.one[0].density, found.one[0].speed_ratio]).all():
        yield picture(
            "region", partial(region_picture, found.one[0]), "Critical speed ratio and gas density."
        )
    rows = level_rows(found, found.one)
    rows += [
        (
            "critical speed ratio (CSR), mean gas density (kg/m³)",
            *both(f"{e.speed_ratio:.3f}, {e.density:.4g}" for e in found.one),
        ),
        ("region", *both(each.region for each in found.one)),
        ("level II", *both("needed" if each.reasons else "not needed" for each in found.one)),
    ]
    yield Table("level_1", ("level I", *level_heads(found)), rows)
    yield paragraph(
        f"Level II is needed: {'; '.join(reasons(found))}." if reasons(found) else "Level II is not needed."
    )


def both(texts: Iterator[str]) -> Iterator[str]:
    """A text under the full matrices, and none under the synchronous ones."""
    for each in texts:
        yield from (each, "")


def level_heads(found: Found) -> list[str]:
    return [f"{name}, {kind}" for name in names(found) for kind in ("full", "synchronous")]


def level_rows(found: Found, levels: Sequence[LevelOne]) -> list[Sequence[str]]:
    kinds = (FULL, SYNCHRONOUS)
    return [
        ("decrement without Q", *(digits(each.log_decrement[k, 0], 4) for each in levels for k in kinds)),
        ("decrement with QA", *(digits(each.decrement[k], 4) for each in levels for k in kinds)),
        ("QA (MN/m)", *both(f"{1e-6 * each.anticipated:.4g}" for each in levels)),
        ("Q0 (MN/m)", *(q0(each, k) for each in levels for k in kinds)),
        ("Q0/QA", *(multiple(each, k) for each in levels for k in kinds)),
    ]


def q0(level: LevelOne, kind: int) -> str:
    if np.isnan(level.zero[kind]):
        return f"> {1e-6 * level.cross_stiffness[-1]:.4g}"
    return f"{1e-6 * level.zero[kind]:.4g}"


def multiple(level: LevelOne, kind: int) -> str:
    """Q_0 over Q_A."""
    if np.isnan(level.zero[kind]):
        return f"> {level.cross_stiffness[-1] / level.anticipated:.0f}"
    return f"{level.zero[kind] / level.anticipated:.2f}"


def decrement_picture(found: Found, levels: Sequence[LevelOne]) -> Figure:
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 3.0))
    for i, each in enumerate(levels):
        for kind, dashes in ((FULL, "-"), (SYNCHRONOUS, "--")):
            ax.plot(1e-6 * each.cross_stiffness, each.log_decrement[kind], dashes, color=f"C{i}")
    ax.axvline(1e-6 * levels[0].anticipated, color="0.4", linestyle=":")
    ax.annotate("$Q_A$", (1e-6 * levels[0].anticipated, 0.97), xycoords=("data", "axes fraction"), va="top")
    ax.axhline(0, color="0.3", linewidth=0.8)
    ax.axhline(limits.LEAST_DECREMENT, color="C3", linewidth=0.8, linestyle="-.")
    ax.set(xlabel="cross-coupled stiffness $Q$ (MN/m)", ylabel="logarithmic decrement")
    ax.set_xlim(0, 1e-6 * levels[0].cross_stiffness[-1])
    marks = [(name, {"color": f"C{i}"}) for i, name in enumerate(names(found))]
    marks += [("full", {"color": "0.3"}), ("synchronous", {"color": "0.3", "linestyle": "--"})]
    marks += [(f"{limits.LEAST_DECREMENT:g}", {"color": "C3", "linestyle": "-."})]
    layout.heading(fig, marks, "")
    return fig


def region_picture(level: LevelOne) -> Figure:
    fig, ax = plt.subplots(figsize=(layout.COLUMN, 3.0))
    density = np.linspace(0, max(80.0, 1.2 * level.density), 400)
    ax.plot(density, [limits.boundary(each) for each in density], color="0.2")
    ax.plot(level.density, level.speed_ratio, "o", color="C3")
    place: dict[str, Any] = {"color": "0.4", "ha": "center"}
    ax.text(20, 0.6, "region A", **place)
    ax.text(40, 2.9, "region B", **place)
    ax.set(
        xlabel="mean gas density (kg/m³)",
        ylabel="critical speed ratio",
        ylim=(0, max(3.5, 1.2 * level.speed_ratio)),
    )
    ax.set_xlim(0, density[-1])
    layout.heading(fig, [("this machine", {"color": "C3", "marker": "o", "linestyle": ""})], "")
    return fig


def level_2(found: Found) -> Parts:
    """The same with all elements, and all slow modes of the shaft."""
    least = f"{limits.LEAST_DECREMENT:g}"
    yield paragraph(
        "All elements of the case are in, those over the whirl frequency at the mode's own (full) or at "
        "that of the speed (synchronous). The first forward mode must have a decrement of at least "
        f"{least}; QA beside the elements is for information."
    )
    yield picture(
        "level II", partial(decrement_picture, found, found.two), "Logarithmic decrement of level II."
    )
    rows = level_rows(found, found.two)
    verdicts = (MET if e.log_decrement[FULL, 0] >= limits.LEAST_DECREMENT else NOT_MET for e in found.two)
    rows.append((f"decrement without Q at least {limits.LEAST_DECREMENT:g}", *both(verdicts)))
    yield Table("level_2", ("level II", *level_heads(found)), rows)
    rows = []
    for column in found.lateral.columns:
        own = station_modes(column.level_2)
        slow = own.own & (own.frequency > 0) & (own.frequency <= SLOW * found.lateral.speeds[1] / 60)
        slow &= own.damping_ratio < limits.DAMPED
        for k in np.flatnonzero(slow)[np.argsort(own.frequency[slow])]:
            rows.append(
                (column.name, str(own.word[k]), digits(own.frequency[k]), digits(own.log_decrement[k], 4))
            )
    yield Table("level_2_modes", ("modes with all elements", "whirl", "frequency (Hz)", "decrement"), rows)


def remarks(found: Found) -> Parts:
    """What the runs remark, and where the requirements are from."""
    lines = dict.fromkeys(
        each for column in found.lateral.columns for each in by_weight(column.level_2.remarks)
    )
    yield from (paragraph(sentence(each), warning=True) for each in lines)
    yield paragraph(SOURCES)


def names(found: Found) -> list[str]:
    return [each.name for each in found.lateral.columns]


def micro(metres: float) -> str:
    return digits(1e6 * metres, 3)
