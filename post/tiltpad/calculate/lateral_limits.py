"""What a lateral analysis after API 617 judges, from results of the program.

The standard's numbers are quoted through public sources, not from its text: the reports of ROSS (`api_report`
of early versions, `api617_unbalance` and `run_clearance_analysis` of version 3.1) name the clauses of API RP
684 and API 617 that stand in CLAUSES.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate.critical_speeds import CriticalSpeed, margins
from tiltpad.calculate.response import Peak, peaks_of
from tiltpad.calculate.stations import station_modes
from tiltpad.calculate.vibration_limits import of_api_617
from tiltpad.files.read import Run
from tiltpad.files.study import Study

CLAUSES = {
    "unbalance": "API 617 6.8.2.7 (9th edition)",
    "amplification": "RP 684 SP6.8.2.1",
    "margin": "RP 684 SP6.8.2.10",
    "vibration": "RP 684 SP6.8.2.11, API 617 4.8.2.11 (8th edition)",
    "clearance": "API 617 6.8.2.11 (9th edition)",
    "level_1": "RP 684 SP6.8.5.6 to SP6.8.5.10",
    "level_2": "API 617, level II stability analysis",
}
#: Of the residual unbalance, 6350 W/N or, above 25000 rpm, 0.254 W g mm, with the load W in kg, N in rpm.
UNBALANCE_FACTOR, RESIDUAL, LEAST_RESIDUAL = 4, 6350, 0.254
#: The scale factor is this at most; what scaled vibration may take of a close clearance.
LARGEST_SCALE, SHARE_OF_CLEARANCE = 6, 0.75
#: What a level asks for: logarithmic decrement, and Q_0 over Q_A in any case and in region B.
LEAST_DECREMENT, LEAST_RATIO, LEAST_RATIO_B = 0.1, 2, 10
#: Modes above this damping ratio do not resonate; modes that unbalance is placed for.
DAMPED, MOST_MODES = 0.5, 3
#: Antinodes count from these shares of the largest deflection, between the bearings and outside.
INBOARD, OUTBOARD, NODE = 0.1, 0.5, 0.02
GRAVITY = 9.81
FULL, SYNCHRONOUS = 0, 1


class Unbalance(NamedTuple):
    """An unbalance of the analysis, kg m; the load or mass, kg, that it follows from."""

    station: int
    moment: float
    angle_deg: float
    load: float


class Placed(NamedTuple):
    """The unbalances for a mode: its frequency, Hz, and logarithmic decrement at the highest speed."""

    frequency: float
    log_decrement: float
    unbalances: list[Unbalance]


class Column(NamedTuple):
    """The runs with one clearance of the bearings: both levels, and a study over the speed for each mode."""

    name: str
    level_1: Run
    level_2: Run
    studies: list[Study]


class Lateral(NamedTuple):
    """A lateral analysis; its fields:

    case        what its file is called
    groups      the resolved input
    placed      unbalances, for each mode that may resonate
    columns     runs with the minimum and the maximum clearance, or with that of the case
    """

    case: str
    groups: dict[str, Any]
    placed: list[Placed]
    columns: list[Column]

    @property
    def speeds(self) -> tuple[float, float]:
        """The lowest and the highest operating speed, rpm."""
        return self.groups["lateral"]["lowest_rpm"], self.groups["operation"]["speed_rpm"]


class Vibration(NamedTuple):
    """The response of a study to its unbalance, peak to peak, m; its fields:

    speed_rpm       (run,)
    probes          (run, probe), in the order of the labels
    labels          "station 3, -45°"
    close           (run, place): major axis at the close clearances
    criticals       critical speeds at the probes, with their margins
    largest         at any probe among the operating speeds, and its limit
    scale           what `largest` may grow by
    """

    speed_rpm: np.ndarray
    probes: np.ndarray
    labels: list[str]
    close: np.ndarray
    criticals: list[tuple[str, CriticalSpeed]]
    largest: float
    limit: float
    scale: float


class LevelOne(NamedTuple):
    """What level I finds with one clearance; numbers with full and with synchronous matrices.

    cross_stiffness, log_decrement      the curve, N/m and (matrices, Q)
    anticipated, zero                   Q_A and Q_0, N/m; Q_0 nan above the last Q
    decrement                           with Q_A, (matrices,)
    speed_ratio, density, region        critical speed ratio, mean density in kg/m^3, A or B
    reasons                             why level II is needed, by the full matrices; empty: it is not
    """

    cross_stiffness: np.ndarray
    log_decrement: np.ndarray
    anticipated: float
    zero: np.ndarray
    decrement: np.ndarray
    speed_ratio: float
    density: float
    region: str
    reasons: list[str]


def placed_unbalances(run: Run, groups: dict[str, Any]) -> list[Placed]:
    """Unbalances at the antinodes of the slowest forward modes that may resonate up to the last speed."""
    found = station_modes(run)
    slow = found.frequency <= groups["lateral"]["last_rpm"] / 60
    forward = found.own & (found.frequency > 0) & (found.word == "forward")
    chosen = np.flatnonzero(forward & slow & (found.damping_ratio < DAMPED))
    if not len(chosen):
        chosen = np.flatnonzero(forward)
        chosen = chosen[np.argsort(found.damping_ratio[chosen])][:1]
    chosen = chosen[np.argsort(found.frequency[chosen])][:MOST_MODES]
    return [
        Placed(found.frequency[k], found.log_decrement[k], list(at_antinodes(run, groups, found.shape[k])))
        for k in chosen
    ]


def at_antinodes(run: Run, groups: dict[str, Any], shape: np.ndarray) -> Iterator[Unbalance]:
    """One of the whole load between the bearings, or several of the nearest journal's; of overhung masses."""
    speed = groups["operation"]["speed_rpm"]
    loads = np.hypot(*(run[f"equilibrium/bearing_load_{axis}"] for axis in "yz"))
    loads = loads / (groups["rotor"]["gravity"] or GRAVITY)
    journals = run["rotor/bearing_station"].astype(int)
    nodes, size, sign = antinodes(shape)
    inboard = (nodes >= journals.min()) & (nodes <= journals.max())
    largest = size == size.max()
    counts = np.where(inboard, size >= INBOARD * size.max(), largest | (size >= OUTBOARD * size.max()))
    alone = (inboard & counts).sum() == 1
    for node, inside, way in zip(nodes[counts], inboard[counts], sign[counts], strict=True):
        nearest = int(np.argmin(abs(journals - node)))
        load = float(loads.sum() if alone else loads[nearest]) if inside else float(loads[nearest])
        if not inside and "length" in groups.get("shaft", {}):
            load = overhung_mass(groups, int(journals[nearest]), int(node))
        residual = max(RESIDUAL * load / speed, LEAST_RESIDUAL * load)
        yield Unbalance(int(node), 1e-6 * UNBALANCE_FACTOR * residual, 0.0 if way > 0 else 180.0, load)


def antinodes(shape: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Stations where a shape, (station, 2), is largest between its nodes, how large, and its sign there."""
    y, z = shape.T
    size = (abs(y + 1j * z) + abs(y - 1j * z)) / 2
    reference = int(np.argmax(size))
    # along the major axis of the largest ellipse
    axis = np.linalg.eigh(np.outer(shape[reference], shape[reference].conj()).real)[1][:, 1]
    along = shape @ axis
    sign = np.where((along * along[reference].conj()).real < 0, -1, 1)
    there = np.flatnonzero(size >= NODE * size.max())
    parts = np.split(there, np.flatnonzero(np.diff(sign[there])) + 1)
    tops = np.array([part[np.argmax(size[part])] for part in parts])
    return tops + 1, size[tops], sign[tops]


def overhung_mass(groups: dict[str, Any], journal: int, beyond: int) -> float:
    """Mass of the shaft and its discs on the side of a journal's station where another station is, kg."""
    shaft, way = groups["shaft"], np.sign(beyond - journal)
    length, diameter, bore = (
        np.atleast_1d(np.asarray(shaft[name])) for name in ("length", "diameter", "bore")
    )
    sections = np.arange(len(length)) + 1.5
    mass = shaft["density"] * np.pi / 4 * (diameter**2 - bore**2) * length
    discs = [each["mass"] for each in groups.get("disc", []) if way * (each["station"] - journal) > 0]
    return float(mass[way * (sections - journal) > 0].sum() + sum(discs))


def vibration(found: Lateral, column: Column, number: int) -> Vibration:
    """The response to the unbalances of a mode, by its number."""
    study, wanted = column.studies[number], found.groups["lateral"]
    y, z = (study[f"response_{a}_real"][:, 0] + 1j * study[f"response_{a}_imag"][:, 0] for a in "yz")
    order = np.argsort(study["speed_rpm"])
    order = order[np.isfinite(y[order, 0])]
    speed, y, z = study["speed_rpm"][order], y[order], z[order]
    labels, probes = [], []
    stations = wanted.get("probe_station", [each["station"] for each in found.groups["bearing"]])
    for station in numbers_of(stations):
        for degrees in wanted["probe_direction_deg"]:
            angle = np.radians(degrees)
            labels.append(f"station {station:g}, {degrees:g}°")
            probes.append(2 * abs(y[:, station - 1] * np.cos(angle) + z[:, station - 1] * np.sin(angle)))
    at = np.array(numbers_of(wanted.get("close_station", ())), dtype=int) - 1
    close = abs(y[:, at] + 1j * z[:, at]) + abs(y[:, at] - 1j * z[:, at])
    low, high = found.speeds
    criticals = [
        (label, judged(peak, low, high))
        for label, each in zip(labels, probes, strict=True)
        for peak in peaks_of(label, speed, speed, each)
    ]
    runs = np.transpose(probes)
    largest, limit = float(runs[(speed >= low) & (speed <= high)].max()), of_api_617(high)
    return Vibration(
        speed, runs, labels, close, criticals, largest, limit, min(LARGEST_SCALE, limit / largest)
    )


def judged(peak: Peak, low: float, high: float) -> CriticalSpeed:
    """A peak with its margins; where the curve ends above half power, it is as wide as on the other side.

    Where it does so on both sides no margin is asked for: the peak is wider than the diagram.
    """
    top, below, above = peak.speed_rpm, peak.below_rpm, peak.above_rpm
    if np.isnan(below) != np.isnan(above):
        peak = peak._replace(
            below_rpm=float(2 * top - above if np.isnan(below) else below),
            above_rpm=float(2 * top - below if np.isnan(above) else above),
        )
    margin, required = margins(peak, low, high)
    return CriticalSpeed(None, peak, margin, required if np.isfinite(required) else 0.0)


def numbers_of(value: Any) -> list[Any]:
    """Numbers of the input, of which one stands alone."""
    return list(value) if isinstance(value, Sequence) else [value]


def level_one(run: Run) -> LevelOne:
    """Level I, or what its curve is with the seals of level II, of a run with impellers."""
    stiffness, decrement = run["stability/cross_stiffness"], run["stability/log_decrement"][0]
    anticipated = float(run["stability/anticipated_cross_stiffness"])
    with_it = decrement[:, int(np.argmin(abs(stiffness - anticipated)))]
    zero = run["stability/zero_cross_stiffness"][0]
    density, ratio = float(run["stability/mean_density"]), float("nan")
    if "stability/rigid_rpm" in run:
        ratio = run.input["operation"]["speed_rpm"] / float(run["stability/rigid_rpm"][0])
    region = "B" if ratio > boundary(density) else "A"
    reasons = []
    if zero[FULL] / anticipated < LEAST_RATIO:
        reasons.append(f"Q0/QA is below {LEAST_RATIO}")
    if not with_it[FULL] >= LEAST_DECREMENT:
        reasons.append(f"the logarithmic decrement with QA is below {LEAST_DECREMENT}")
    if region == "B" and zero[FULL] / anticipated < LEAST_RATIO_B:
        reasons.append(f"region B and Q0/QA is below {LEAST_RATIO_B}")
    return LevelOne(stiffness, decrement, anticipated, zero, with_it, ratio, density, region, reasons)


def boundary(density: float) -> float:
    """Critical speed ratio above which region B begins, over the mean density, kg/m^3."""
    return 2.5 if density <= 16.53 else 2.69 - 0.0115 * density if density <= 60 else 0.0
