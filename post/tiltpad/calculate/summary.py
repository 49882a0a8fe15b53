"""The key figures of a run, as tiltpad-report shows them.

Values are in SI units.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from tiltpad.calculate import behaviour, pivots, signals, spectra
from tiltpad.calculate.heat import heat_balance
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run

#: Revolutions at the end over which friction and sticking are averaged and spectra are taken.
LAST = 20


class Figure(NamedTuple):
    """A number, or one for each pad: meaning, quantity in tiltpad.units.SHOWN, value or values."""

    text: str
    quantity: str
    value: float | np.ndarray


class Peak(NamedTuple):
    """A peak of the journal's spectrum: order, frequency in Hz, amplitudes of y and z in m."""

    order: float
    frequency: float
    y: float
    z: float


def journal(run: Run) -> list[Figure]:
    """Key figures of the whole run; those that it does not have are left out."""
    return list(those_there(run, JOURNAL))


def pads(run: Run) -> list[Figure]:
    """Key figures of the pads, (pad,) each; those that the run does not have are left out."""
    return list(those_there(run, PADS))


def peaks(run: Run, count: int = 8) -> list[Peak]:
    """The highest peaks in the spectrum of the journal at constant speed, above 0.1 % of the first."""
    frequency, y = spectra.one_sided(run, "journal_y", LAST)
    z = spectra.one_sided(run, "journal_z", LAST)[1]
    size = np.hypot(y, z)
    size[0] = 0
    inner = size[1:-1]
    top = 1 + np.flatnonzero((inner > size[:-2]) & (inner >= size[2:]) & (inner > 1e-3 * size.max()))
    highest = top[np.argsort(size[top])[::-1][:count]]
    shaft = float(run.values("speed", -1)) / (2 * np.pi)
    return [Peak(*map(float, (frequency[k] / shaft, frequency[k], y[k], z[k]))) for k in highest]


def extremes(run: Run, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Minimum and maximum of a dataset over the whole run, () or (pad,); it is read in blocks."""
    signals.last_revolutions(run)
    starts = range(0, run.samples, signals.BLOCK)
    found = [run.values(name, slice(start, start + signals.BLOCK)) for start in starts]
    low, high = ([pick(each, axis=0) for each in found] for pick in (np.min, np.max))
    return np.min(low, axis=0), np.max(high, axis=0)


def those_there(
    run: Run, wanted: list[tuple[str, str, Callable[[Run], float | np.ndarray]]]
) -> Iterator[Figure]:
    """The figures that this run has."""
    for text, quantity, calculate in wanted:
        try:
            yield Figure(text, quantity, calculate(run))
        except NotInRunError:
            continue


def each_pad(calculate: Callable[..., float]) -> Callable[[Run], np.ndarray]:
    """Makes a function of a run, for all pads, of one of a run, a pad and revolutions."""
    return lambda run: np.array([calculate(run, pad, LAST) for pad in range(1, run.pads + 1)])


def min_film(run: Run) -> np.ndarray:
    """Minimum film thickness over the last revolution, (time, pad), m."""
    return last_one(run, "min_film_thickness")


def last_one(run: Run, name: str) -> np.ndarray:
    """A dataset over the last revolution."""
    return run.values(name, signals.last_revolutions(run))


def behaves(run: Run, name: str) -> np.ndarray:
    """A number of what each pad does in the last revolutions, (pad,)."""
    values = np.array([getattr(each, name) for each in behaviour.of_pads(run)])
    if np.isnan(values).all() or (name == "rubbing" and "asperity_force" not in run):
        raise NotInRunError(f"{run.path}: no {name} in this run")
    return values


JOURNAL = [
    ("speed at the end", "speed", lambda run: signals.ends(run, "speed")[1]),
    ("time sampled", "time", lambda run: np.ptp(signals.ends(run, "time"))),
    ("shaft revolutions", "number", signals.turned),
    ("orbit, peak to peak of y", "size", lambda run: signals.orbit_size(run)[0]),
    ("orbit, peak to peak of z", "size", lambda run: signals.orbit_size(run)[1]),
    ("orbit, mean y", "size", lambda run: last_one(run, "journal_y").mean()),
    ("orbit, mean z", "size", lambda run: last_one(run, "journal_z").mean()),
    (
        "minimum film thickness, last revolution",
        "size",
        lambda run: last_one(run, "min_film_thickness").min(),
    ),
    ("minimum film thickness, whole run", "size", lambda run: extremes(run, "min_film_thickness")[0].min()),
    ("maximum pressure, last revolution", "max_pressure", lambda run: last_one(run, "max_pressure").max()),
    ("maximum pressure, whole run", "max_pressure", lambda run: extremes(run, "max_pressure")[1].max()),
    ("period of the orbit", "period", lambda run: run["periodic/period"]),
    ("revolutions in a period", "number", lambda run: run["periodic/revolutions"]),
    ("leading multiplier, real part", "multiplier_real", lambda run: signals.multipliers(run)[0].real),
    ("leading multiplier, imaginary part", "multiplier_imag", lambda run: signals.multipliers(run)[0].imag),
    ("leading multiplier, modulus", "number", lambda run: abs(signals.multipliers(run)[0])),
    ("equilibrium, speed", "speed", lambda run: run.input["operation"]["speed_rpm"] * np.pi / 30),
    ("equilibrium y", "size", lambda run: run["equilibrium/journal_y"]),
    ("equilibrium z", "size", lambda run: run["equilibrium/journal_z"]),
    ("eccentricity ratio", "number", lambda run: run["equilibrium/eccentricity_ratio"]),
    ("attitude angle", "attitude_angle", lambda run: run["equilibrium/attitude_angle"]),
    ("specific load", "specific_load", lambda run: run["equilibrium/specific_load"]),
    ("Sommerfeld number", "number", lambda run: run["equilibrium/sommerfeld_number"]),
    ("equilibrium power loss", "power_loss", lambda run: run["equilibrium/total_power_loss"]),
    ("equilibrium inlet flow, all pads", "oil_flow", lambda run: run["equilibrium/total_inlet_flow"]),
    ("equilibrium side flow, all pads", "oil_flow", lambda run: run["equilibrium/total_side_flow"]),
    (
        "oil warmer by, if every pad draws fresh oil alone",
        "temperature_rise",
        lambda run: run["equilibrium/temperature_rise_fresh"],
    ),
    (
        "oil warmer by, if fresh oil replaces only what leaves at the sides",
        "temperature_rise",
        lambda run: run["equilibrium/temperature_rise_side"],
    ),
    ("shaft temperature", "temperature", lambda run: run["equilibrium/shaft_temperature"]),
    ("drain temperature", "temperature", lambda run: run["equilibrium/drain_temperature"]),
]

PADS = [
    ("tilt, peak to peak", "pad_tilt", lambda run: np.ptp(last_one(run, "pad_tilt"), axis=0)),
    ("mean tilt", "pad_tilt", lambda run: last_one(run, "pad_tilt").mean(axis=0)),
    ("minimum film thickness", "size", lambda run: min_film(run).min(axis=0)),
    ("maximum pressure", "max_pressure", lambda run: last_one(run, "max_pressure").max(axis=0)),
    ("mean contact force", "contact_force", lambda run: last_one(run, "contact_force").mean(axis=0)),
    ("share of the time lifted off its pivot", "share", lambda run: behaves(run, "lifted")),
    ("share of the time rubbing", "share", lambda run: behaves(run, "rubbing")),
    ("maximum asperity force, whole run", "asperity_force", lambda run: run["asperities/highest_force"]),
    ("the same over the load", "share", lambda run: run["asperities/highest_share"]),
    ("dominant order of the tilt", "number", lambda run: behaves(run, "order")),
    ("amplitude at this order", "pad_tilt", lambda run: behaves(run, "amplitude")),
    ("maximum friction moment", "friction_moment", lambda run: max_moment(run)),
    ("friction work per revolution", "work", each_pad(pivots.friction_work)),
    ("mean friction power", "power", each_pad(pivots.friction_power)),
    ("share of the time in which it sticks", "share", each_pad(pivots.stick_fraction)),
    ("equilibrium tilt", "pad_tilt", lambda run: run["equilibrium/pad_tilt"]),
    ("equilibrium penetration", "pad_penetration", lambda run: run["equilibrium/pad_penetration"]),
    ("equilibrium contact force", "contact_force", lambda run: run["equilibrium/contact_force"]),
    ("equilibrium minimum film thickness", "size", lambda run: run["equilibrium/min_film_thickness"]),
    ("equilibrium maximum pressure", "max_pressure", lambda run: run["equilibrium/max_pressure"]),
    ("equilibrium load", "contact_force", lambda run: run["equilibrium/load"]),
    ("equilibrium power loss", "power_loss", lambda run: run["equilibrium/power_loss"]),
    ("by shear of sliding", "power_loss", lambda run: run["equilibrium/couette_loss"]),
    ("by shear of the pressure's flow", "power_loss", lambda run: run["equilibrium/pressure_loss"]),
    ("by boundary friction", "power_loss", lambda run: run["equilibrium/boundary_loss"]),
    ("equilibrium inlet flow", "oil_flow", lambda run: run["equilibrium/inlet_flow"]),
    ("equilibrium outlet flow", "oil_flow", lambda run: run["equilibrium/outlet_flow"]),
    ("equilibrium side flow", "oil_flow", lambda run: run["equilibrium/side_flow"]),
    (
        "oil warmer by, leading to trailing edge",
        "temperature_rise",
        lambda run: run["equilibrium/temperature_rise"],
    ),
    ("inlet temperature", "temperature", lambda run: run["equilibrium/inlet_temperature"]),
    ("mean temperature of the film", "temperature", lambda run: run["equilibrium/mean_temperature"]),
    ("outlet temperature", "temperature", lambda run: run["equilibrium/outlet_temperature"]),
    ("maximum temperature of the pad", "temperature", lambda run: run["equilibrium/maximum_temperature"]),
    ("viscosity of the film", "viscosity", lambda run: run["equilibrium/viscosity"]),
    ("heat to the oil", "power_loss", lambda run: heat_balance(run).to_oil),
    ("heat to the shaft", "power_loss", lambda run: heat_balance(run).to_shaft),
]


def max_moment(run: Run) -> np.ndarray:
    """Maximum friction moment over the last revolution, (pad,), N m."""
    pivots.friction_model(run)
    return np.abs(last_one(run, "friction_moment")).max(axis=0)
