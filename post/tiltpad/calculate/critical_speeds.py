"""Critical speeds at all stations, their amplification factors and separation margins, as a table.

Amplification factors and margins are those of API RP 684 (2nd edition, 2005) and API 617 (7th edition, 2002,
2.6.2).
"""

import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate.response import STATION, Peak, response
from tiltpad.calculate.selection import Where
from tiltpad.files.read import Bearing, Run
from tiltpad.files.study import Study
from tiltpad.files.writing import write_csv

#: Columns of the table of critical speeds; required margins are those below and above the operating speeds,
#: and that of the side on which the critical speed is.
COLUMNS = (
    *("station", "direction", "critical_speed_rpm", "amplitude_m", "half_power_1_rpm", "half_power_2_rpm"),
    *("amplification_factor", "required_margin_below_percent", "required_margin_above_percent"),
    *("separation_margin_percent", "required_margin_percent"),
)


class CriticalSpeed(NamedTuple):
    """A peak of the response with its distance from the operating speeds; its fields:

    station     of a machine's shaft, from 1; None for the journal of one bearing
    peak        direction, speed_rpm, amplitude, amplification_factor, ...
    margin      distance from the operating speeds in percent of the nearest of them, 0 among them; nan where
                these are not known
    required    least distance that API 617 asks for on this side of the operating speeds, percent
    """

    station: int | None
    peak: Peak
    margin: float
    required: float


def critical_speeds(
    source: Run | Study,
    where: Where = None,
    pivot: str | None = None,
    operating: Sequence[float] | float | None = None,
) -> list[CriticalSpeed]:
    """Critical speeds of a response over the speed, of a machine at all its stations.

    `operating` is the operating speed, or the lowest and the highest of them, rpm. Other arguments are those
    of `response`.
    """
    ends = (np.nan, np.nan) if operating is None else operating_range(operating)
    stations: list[int | None] = [None]
    if STATION in source and not isinstance(source, Bearing):
        stations = list(range(1, source.length(STATION) + 1))
    return [
        CriticalSpeed(station, peak, *margins(peak, *ends))
        for station in stations
        for peak in response(source, where, station=station, pivot=pivot).peaks
    ]


def operating_range(operating: Sequence[float] | float) -> tuple[float, float]:
    """The lowest and the highest operating speed, rpm, of one or both. Raises ValueError."""
    ends = np.atleast_1d(np.asarray(operating, dtype=float))
    if not (ends.ndim == 1 and 1 <= len(ends) <= 2 and (ends > 0).all() and ends[0] <= ends[-1]):
        raise ValueError(f"operating = {operating}: must be a speed in rpm, or the lowest and the highest")
    return float(ends[0]), float(ends[-1])


def margins(peak: Peak, lowest: float, highest: float) -> tuple[float, float]:
    """Distance of a critical speed from the operating speeds, rpm, and the required one, percent."""
    below, above = (lowest - peak.speed_rpm) / lowest, (peak.speed_rpm - highest) / highest
    required = peak.margin_below if below > above else peak.margin_above
    return 100 * float(np.maximum(0, np.maximum(below, above))), required if np.isfinite(lowest) else np.nan


def write_critical_speeds(found: Sequence[CriticalSpeed], path: str | os.PathLike) -> None:
    """Writes critical speeds to a table, .csv, a row each."""
    rows: list[Sequence[Any]] = [COLUMNS]
    for station, peak, margin, required in found:
        edges = (peak.below_rpm, peak.above_rpm, peak.amplification_factor)
        sides = (peak.margin_below, peak.margin_above)
        if peak.open:
            # its factor is a bound, which asks for no margin
            sides, required = (np.nan, np.nan), np.nan
        own = "" if station is None else station
        rows.append([own, peak.direction, peak.speed_rpm, peak.amplitude, *edges, *sides, margin, required])
    write_csv(path, rows)
