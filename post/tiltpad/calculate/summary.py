"""The key figures of a run, as its file has them and tiltpad-report shows them.

Values are in SI units.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tiltpad.calculate import spectra
from tiltpad.calculate.heat import heat_balance
from tiltpad.files.read import Run
from tiltpad.files.units import SHOWN, Shown, described

#: Groups of figures, and what is said of those that have not the meaning of the run's end.
GROUPS = {"summary": "", "periodic": "", "equilibrium": "equilibrium: "}


class Figure(NamedTuple):
    """A number, or one for each pad: its name in the file, how it is shown, value or values."""

    name: str
    shown: Shown
    value: float | np.ndarray


class Peak(NamedTuple):
    """A peak of the journal's spectrum: order, frequency in Hz, amplitudes of y and z in m."""

    order: float
    frequency: float
    y: float
    z: float


def journal(run: Run) -> list[Figure]:
    """Key figures of the whole run."""
    return list(figures(run, ()))


def pads(run: Run) -> list[Figure]:
    """Key figures of the pads, (pad,) each, and where their heat goes."""
    found = list(figures(run, ("pad",)))
    if "equilibrium/viscosity" in run:
        heat, shown = heat_balance(run), SHOWN["power_loss"]
        # what goes to shaft and pad the file says itself where the heat of the pads is known
        places = {"to the oil": heat.to_oil}
        places |= {} if run.has_film_temperatures else {"to the shaft": heat.to_shaft}
        for to, values in places.items():
            found.append(Figure(f"heat {to}", shown._replace(text=f"equilibrium: heat {to}"), values))
    return found


def figures(run: Run, dimensions: tuple[str, ...]) -> Iterator[Figure]:
    """Those that the file has with these dimensions."""
    for group, before in GROUPS.items():
        for name in (f"{group}/{own}" for own in run.names(group)) if group in run else ():
            if run.scales(name) == dimensions:
                shown = described(run, name)
                text = f"{before}{run.about(name, 'long_name') or shown.text}"
                yield Figure(name, shown._replace(text=text), run[name])


def peaks(run: Run, count: int = 8) -> list[Peak]:
    """The highest peaks in the spectrum of the journal, which its file has, above 0.1 % of the first."""
    frequency, y = spectra.spectrum(run, "journal_y")
    z = spectra.spectrum(run, "journal_z")[1]
    size = np.hypot(y, z)
    size[0] = 0
    top = spectra.highest_lines(size)
    top = top[size[top] > 1e-3 * size.max()]
    highest = top[np.argsort(size[top])[::-1][:count]]
    place, height = spectra.restored(size, highest) if spectra.is_windowed(run) else (highest, size[highest])
    known = (run["spectrum/order"], frequency)
    at = (np.interp(place, np.arange(len(size)), each) for each in known)
    rows = zip(*at, *(each[highest] * height / size[highest] for each in (y, z)), strict=True)
    return [Peak(*map(float, row)) for row in rows]
