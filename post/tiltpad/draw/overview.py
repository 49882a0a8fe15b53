"""The top of the page about a run, a screen to be handed on: stability, loads, films, vibration, remarks."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tiltpad.calculate.coefficients import coefficients, of_pivots
from tiltpad.calculate.modes import Modes, modes, of_journal
from tiltpad.calculate.remarks import by_weight
from tiltpad.calculate.stations import attached
from tiltpad.calculate.vibration_limits import of_api_617, zone
from tiltpad.draw.machines import LOAD
from tiltpad.draw.page import facts_table, paragraph, section, table
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN, Shown, digits, fitted, numbers

STABLE, UNSTABLE = "stable", "unstable"
#: Modes of journal or shaft up to this multiple of its speed are told of; pads below this damping ratio, too.
SLOW, PADS_DAMPED = 2, 0.1
#: Remarks that stand there; the others stand below, folded.
REMARKS = 5
ENDS = ("highest", "lowest")
VIBRATION = "vibration, peak to peak"
#: Facts that the table of a machine has of each bearing.
OF_BEARINGS = (
    *("load", "specific load", "eccentricity ratio", "minimum film thickness", "maximum pressure"),
    *("highest temperature", "power loss", VIBRATION),
)


class Fact(NamedTuple):
    """A number of a bearing: how it is shown, value in SI units, what belongs to it in words."""

    shown: Shown
    value: float
    note: str = ""


def overview(run: Run) -> str:
    """The section."""
    said = [*ended(run), *stability(run)]
    lines = "".join(paragraph(text, warning=warning) for text, warning in said)
    heaviest = by_weight(run.remarks)[:REMARKS]
    told = "".join(paragraph(sentence(each), warning=True) for each in heaviest)
    facts = of_machine(run) if run.is_machine else of_bearing(run)
    return section("In short", f"<div class=short>{lines}{facts}{told}</div>")


def further_remarks(run: Run) -> str:
    """The remarks that the overview has no room for."""
    return "".join(paragraph(sentence(each), warning=True) for each in by_weight(run.remarks)[REMARKS:])


def sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}."


def ended(run: Run) -> Iterator[tuple[str, bool]]:
    if not run.complete:
        yield f"Incomplete run{run.end()}.", True


def stability(run: Run) -> Iterator[tuple[str, bool]]:
    """Whether journal or shaft, pads and orbit are stable, and by which margin; True with what is not."""
    if "periodic" in run:
        stable = bool(run["periodic/stable"])
        fate = "stable: small disturbances die out" if stable else "unstable: no motion stays on it"
        yield f"The periodic orbit is {fate}.", not stable
    if run.is_branch and "stable" in run and "stable_side" not in run:
        count, points = int((run["stable"] > 0).sum()), run.length("point")
        told = f"Of {points} points of the branches {count} are stable."
        yield f"{told} Below is the equilibrium at the first of them.", count < points
    elif "modes" in run:
        for pivot in run["pivot"]:
            yield from of_modes(run, str(pivot))
    elif "equilibrium/eigenvalue_real" in run:
        yield of_equilibrium(run)


def of_modes(run: Run, pivot: str) -> Iterator[tuple[str, bool]]:
    """What the modes of these pivots tell of journal or shaft, and of the pads."""
    found = modes(run, pivot)
    pivots = f" with {words}" if (words := of_pivots(run, pivot)) else ""
    listed = (found.name != "") & ((found.frequency > 0) | (found.eigenvalue.real > 0)) & ~found.of_reduction
    journal, pads = listed & of_journal(found.name), listed & ~of_journal(found.name)
    if journal.any():
        state, told = least_damped(found, journal)
        text = f"The {'shaft' if run.is_machine else 'journal'} is {state}{pivots}: {told}."
        slow = journal & (found.frequency <= SLOW * rpm(run) / 60)
        if slow.any() and not slow[np.argmin(np.where(journal, found.damping_ratio, np.inf))]:
            text += f" Up to {SLOW:g} times the speed of the shaft: {least_damped(found, slow)[1]}."
        if np.isfinite(found.threshold_rpm):
            above = 100 * (found.threshold_rpm / rpm(run) - 1)
            text += f" Threshold speed of stability: {found.threshold_rpm:.0f} rpm, {above:.0f} % above this."
        yield text, state != STABLE
    if pads.any() and (found.damping_ratio[pads] < PADS_DAMPED).any():
        state, told = least_damped(found, pads)
        yield f"The pads are {state}{pivots}: {told}.", state != STABLE


def least_damped(found: Modes, moves: np.ndarray) -> tuple[str, str]:
    """Whether these modes die out, and the one of them that is damped least, in words."""
    k = int(np.flatnonzero(moves)[np.argmin(found.damping_ratio[moves])])
    if found.frequency[k] == 0:
        return UNSTABLE, f"{found.name[k]}, grows by {digits(found.eigenvalue[k].real)} 1/s without vibration"
    numbers_of = (100 * found.damping_ratio, found.log_decrement, found.frequency)
    ratio, decrement, frequency = (digits(each[k], 3) for each in numbers_of)
    words = (
        f"least logarithmic decrement {decrement} (damping ratio {ratio} %), {found.name[k]}, {frequency} Hz"
    )
    return STABLE if found.damping_ratio[k] >= 0 else UNSTABLE, words


def of_equilibrium(run: Run) -> tuple[str, bool]:
    """The small motion that grows most, or dies out last, of an equilibrium whose modes are not known."""
    growth, turning = (float(run[f"equilibrium/eigenvalue_{part}"]) for part in ("real", "imag"))
    stable = growth < 0
    how = f"by {digits(abs(growth))} 1/s without vibration"
    if turning > 0:
        decrement = digits(-2 * np.pi * growth / turning)
        how = f"at {digits(turning / (2 * np.pi))} Hz with a logarithmic decrement of {decrement}"
    if stable:
        return f"The equilibrium is stable: small motions die out, the last one {how}.", False
    rotor = "shaft" if run.is_machine else "journal"
    who = f"{rotor} or pads" if run.has_pivots else f"the {rotor}"
    return f"The equilibrium is unstable: a small motion of {who} grows {how}.", True


def of_bearing(run: Run) -> str:
    """The table of one bearing, a row for each fact."""
    rows = []
    for shown, value, note in facts(run):
        own = fitted(shown, [value])
        rows.append((own.text, *numbers(own, [value]), own.unit, note))
    return facts_table(rows)


def of_machine(run: Run) -> str:
    """The table of the bearings of a machine, a row for each, and where its shaft moves most."""
    found = {name: {each.shown.text: each for each in facts(own)} for name, own in run.bearings.items()}
    heads, columns = [], []
    for text in (each for each in OF_BEARINGS if any(each in own for own in found.values())):
        values = [own[text].value if text in own else np.nan for own in found.values()]
        shown = fitted(next(own[text].shown for own in found.values() if text in own), values)
        heads.append(shown.label)
        columns.append(numbers(shown, values))
    rows = [(name, *own) for name, *own in zip(found, *columns, strict=True)]
    sizes = [own[VIBRATION].value for own in found.values() if VIBRATION in own]
    limits = f"Largest vibration in a bearing: {against_limits(max(sizes), rpm(run))}." if sizes else ""
    losses = [own["power loss"].value for own in found.values() if "power loss" in own]
    whole = fitted(SHOWN["power_loss"], [sum(losses)])
    loss = f"All bearings lose {digits(whole.factor * sum(losses))} {whole.unit}." if losses else ""
    told = " ".join(filter(None, (f"{rpm(run):.0f} rpm.", moves_most(run), limits, loss)))
    return table(("bearing", *heads), rows) + paragraph(told)


def moves_most(run: Run) -> str:
    """The station whose vibration is the largest, in words."""
    sizes = [run[f"summary/station_{axis}_size"] for axis in "yz" if f"summary/station_{axis}_size" in run]
    words = "peak to peak"
    if not sizes and "response/amplitude" in run:
        sizes = [2 * run["response/amplitude"][0]]
        words = ", ".join(filter(None, ("peak to peak under its unbalance", of_pivots(run))))
    if not sizes:
        return ""
    size = np.max(sizes, axis=0)
    k = int(np.argmax(size))
    there = ", ".join(attached(run.input).get(k + 1, []))
    shown = fitted(SHOWN["size"], [size[k]])
    where = f"station {k + 1}{' (' * bool(there)}{there}{')' * bool(there)}"
    return f"The shaft moves most at {where}: {digits(shown.factor * size[k])} {shown.unit} {words}."


def facts(run: Run) -> Iterator[Fact]:
    """What an engineer asks of a bearing, of what its file has."""
    if "summary/speed" in run or "speed" in run:
        yield Fact(SHOWN["speed"], rpm(run) / SHOWN["speed"].factor)
    yield from loads(run)
    yield from films(run)
    yield from heat(run)
    yield from stiffness(run)
    yield from vibration(run)


def rpm(run: Run) -> float:
    """Speed of the shaft at the end of the run, rpm."""
    if "summary/speed" in run:
        return SHOWN["speed"].factor * float(run["summary/speed"])
    return float(run.input["operation"]["speed_rpm"])


def loads(run: Run) -> Iterator[Fact]:
    if "equilibrium/specific_load" in run:
        pressure, own = float(run["equilibrium/specific_load"]), run.input["bearing"]
        length = float(np.max(own["axial_length"]))
        yield Fact(LOAD, pressure * 2 * own["journal_radius"] * length)
        yield Fact(Shown("specific load", 1e-6, "MPa"), pressure)
    if "equilibrium/eccentricity_ratio" in run:
        note = ""
        if "equilibrium/attitude_angle" in run:
            note = f"attitude angle {round(np.degrees(run['equilibrium/attitude_angle']), 1) + 0:.1f} deg"
        yield Fact(Shown("eccentricity ratio", 1, ""), float(run["equilibrium/eccentricity_ratio"]), note)


def films(run: Run) -> Iterator[Fact]:
    """Thinnest film and highest pressure of the end of a motion, or of the equilibrium, with their pads."""
    for name, pick in (("min_film_thickness", np.nanargmin), ("max_pressure", np.nanargmax)):
        moving, still = f"summary/pad_{name}", f"equilibrium/{name}"
        if (there := moving if moving in run else still) in run and np.isfinite(run[there]).any():
            k = int(pick(run[there]))
            pad = f"pad {k + 1}" if run.pads > 1 else ""
            when = f", {span(run)}" if there == moving else ""
            yield Fact(SHOWN[name], float(run[there][k]), f"{pad}{when}".removeprefix(", "))


def heat(run: Run) -> Iterator[Fact]:
    if "equilibrium/maximum_temperature" in run:
        hottest = run["equilibrium/maximum_temperature"]
        k = int(np.nanargmax(hottest))
        yield Fact(Shown("highest temperature", 1, "°C"), float(hottest[k]), f"pad {k + 1}")
    elif "equilibrium/temperature_rise_fresh" in run:
        rise, side = (float(run[f"equilibrium/temperature_rise_{each}"]) for each in ("fresh", "side"))
        note = f"every pad with fresh oil; {digits(side)} K with as much of it as leaves at the sides"
        if np.isfinite(rise):
            yield Fact(Shown("oil warms by", 1, "K"), rise, note)
    if "equilibrium/total_power_loss" in run:
        yield Fact(SHOWN["power_loss"], float(run["equilibrium/total_power_loss"]))
    if "equilibrium/total_inlet_flow" in run:
        side = 6e4 * float(run["equilibrium/total_side_flow"])
        note = f"at the leading edges; {digits(side)} l/min leave at the sides"
        yield Fact(Shown("oil flow", 6e4, "l/min"), float(run["equilibrium/total_inlet_flow"]), note)


def stiffness(run: Run) -> Iterator[Fact]:
    """Stiffness and damping of the first pivots, at the first whirl frequency, without the cross terms."""
    if "coefficients" not in run:
        return
    found = coefficients(run, str(run["pivot"][0]))
    place = f"at {found.frequency_ratio[0]:g} of the shaft speed"
    note = ", ".join(filter(None, (of_pivots(run), place)))
    for name, letter, both in (("stiffness", "K", found.stiffness[0]), ("damping", "C", found.damping[0])):
        for k, axis in enumerate("yz"):
            own = SHOWN[name]._replace(text=f"{name} {letter} {axis}{axis}")
            yield Fact(own, float(both[k, k]), note)


def span(run: Run) -> str:
    """What the figures of a motion are of."""
    return "period" if run.task == "periodic" else "last revolution"


def vibration(run: Run) -> Iterator[Fact]:
    """Peak to peak of the journal against standards, and its part with the shaft, or that of a whirl."""
    if "summary/orbit_size" not in run:
        return
    whirls = "summary/whirls" in run and bool(run["summary/whirls"])
    size, when = float(run["summary/orbit_size"]), span(run)
    if whirls:
        count = round(float(run["summary/last_revolutions"]))
        highest, lowest = ([run[f"by_revolution/{end}_{axis}"][-count:] for axis in "yz"] for end in ENDS)
        size = max(float(high.max() - low.min()) for high, low in zip(highest, lowest, strict=True))
        when = f"last {count} revolutions"
    note = f"{when}, {100 * size / run.clearance:.0f} % of the clearance; "
    yield Fact(SHOWN["size"]._replace(text=VIBRATION), size, note + against_limits(size, rpm(run)))
    parts = [f"summary/journal_{axis}_amplitude" for axis in "yz"]
    if whirls:
        note = f"amplitude, at {digits(float(run['summary/whirl_order']), 3)} of the shaft speed"
        yield Fact(SHOWN["size"]._replace(text="of it whirl"), float(run["summary/whirl_amplitude"]), note)
    elif all(each in run for each in parts):
        largest = 2 * max(float(run[each]) for each in parts)
        yield Fact(SHOWN["size"]._replace(text="of it with the shaft (1x)"), largest, "peak to peak")


def against_limits(size: float, speed_rpm: float) -> str:
    """Where a vibration, peak to peak, lies between the limits of standards, in words."""
    limit, allows = of_api_617(speed_rpm), SHOWN["size"]
    judged = "kept" if size <= limit else "exceeded"
    words = f"API 617 allows {digits(allows.factor * limit)} {allows.unit} ({judged})"
    return f"{words}, zone {zone(size, speed_rpm)} of ISO 7919-3"
