"""Stations of the shaft of a machine: where they are, their orbits, their shapes in the modes."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate import signals
from tiltpad.calculate.coefficients import place_of_pivot
from tiltpad.calculate.modes import MOSTLY, whirl_words
from tiltpad.calculate.rotation import sense
from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Run


class StationModes(NamedTuple):
    """Modes of a machine at the stations of its shaft; its fields:

    pivot            of which they are: free, stuck or locked
    eigenvalue       1/s, complex, (mode,)
    frequency        Hz, (mode,)
    damping_ratio, log_decrement     (mode,)
    whirl            sense of the whirl of the shaft, (mode,): 1 forward to -1 backward
    word             the same in a word, (mode,): forward, backward, planar or mixed
    shape            displacement of the stations, complex, (mode, station, 2): y (up) and z; any scale
    own              False for modes whose damping is mostly that of the reduction of the shaft, (mode,)
    """

    pivot: str
    eigenvalue: np.ndarray
    frequency: np.ndarray
    damping_ratio: np.ndarray
    log_decrement: np.ndarray
    whirl: np.ndarray
    word: np.ndarray
    shape: np.ndarray
    own: np.ndarray


def station_modes(run: Run, pivot: str | None = None) -> StationModes:
    """Modes of a machine of the task coefficients; `pivot` is one of those in the file, by default the first.

    Raises NotInRunError for any other run.
    """
    needs_machine(run)
    _, k = place_of_pivot(run, pivot) if "modes" in run else (run["modes"], 0)
    names = ("frequency", "damping_ratio", "log_decrement", "whirl")
    frequency, damping_ratio, log_decrement, whirl = (run[f"modes/{name}"][k] for name in names)
    eigenvalue, y, z = (
        run[f"modes/{name}_real"][k] + 1j * run[f"modes/{name}_imag"][k]
        for name in ("eigenvalue", "station_y", "station_z")
    )
    part = run["modes/part_of_reduction"][k] if "modes/part_of_reduction" in run else np.zeros(len(y))
    shape = np.stack([y, z], axis=-1)
    word = whirl_words(shape, sense(run.input))
    figures = (eigenvalue, frequency, damping_ratio, log_decrement, whirl, word, shape)
    return StationModes(str(run["pivot"][k]), *figures, ~(part > MOSTLY))


def station_orbit(run: Run, station: int, last: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Displacement y (up) and z of a station (1, 2, ...) over the last revolutions, each (time,), m."""
    needs_machine(run)
    part, k = signals.last_revolutions(run, last), column(run, station)
    return run.values("station_y", part)[:, k], run.values("station_z", part)[:, k]


def column(run: Run, station: int) -> int:
    """Column of a station (1, 2, ...) in (time, station) arrays."""
    if not 1 <= station <= (there := run.length("station")):
        raise not_in_run(run, f"station {station}", f"stations are 1 to {there}")
    return station - 1


def positions(run: Run) -> np.ndarray:
    """Distances of the stations from the first one, (station,), m; where not known, their numbers."""
    needs_machine(run)
    return run["rotor/station_position"] if "rotor/station_position" in run else run["station"]


def attached(groups: dict[str, Any]) -> dict[int, list[str]]:
    """What is at the stations of a machine with this input, in words, in the order of the stations."""
    found: dict[int, list[str]] = {}
    for station, word in sorted(named(groups)):
        found.setdefault(station, []).append(word)
    return found


def named(groups: dict[str, Any]) -> Iterator[tuple[int, str]]:
    """Stations of bearings, discs, unbalances and loads, with their names."""
    for each in groups["bearing"]:
        yield int(each["station"]), f"bearing {each['name']}"
    for name in ("disc", "unbalance", "load"):
        own = groups.get(name, [])
        for number, each in enumerate(own, 1):
            yield int(each["station"]), name if len(own) == 1 else f"{name} {number}"


def bearings(run: Run) -> np.ndarray:
    """Stations of the bearings of a machine, those by coefficients too, from 0."""
    groups: dict[str, Any] = run.input
    return np.array([int(each["station"]) - 1 for each in groups["bearing"]])


def needs_machine(run: Run) -> None:
    """Raises NotInRunError for the run of one bearing."""
    if not run.is_machine:
        raise not_in_run(run, "stations", "it is of one bearing and not of a machine")
