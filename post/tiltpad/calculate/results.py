"""Results of a study by name: a value of each run, and how it is shown."""

from typing import NamedTuple

import numpy as np

from tiltpad.calculate.coefficients import place_of_pivot
from tiltpad.calculate.selection import ArgumentError, needs
from tiltpad.files.study import PIVOTS, POINTS, Study
from tiltpad.files.units import Shown, described, literal

#: Results that are drawn where none is asked for.
DEFAULTS = ("orbit_size", "rotor_damping_ratio", "least_damping_ratio", "equilibrium_min_film_thickness")
#: Key results of a study, of which it has some.
KEYS = (
    *("orbit_size", "min_film_thickness", "max_pressure", "friction_work", "stick_fraction"),
    *("equilibrium_eccentricity_ratio", "equilibrium_min_film_thickness", "equilibrium_max_pressure"),
    *("equilibrium_maximum_temperature", "equilibrium_total_power_loss"),
    *("rotor_damping_ratio", "pads_damping_ratio", "least_damping_ratio", "threshold_rpm"),
)


#: Elements of the coefficients of the journal, by the names of these results: quantity, row, column.
ELEMENTS = {
    f"{name}_{row}{column}": (name, i, j)
    for name in ("stiffness", "damping")
    for i, row in enumerate("yz")
    for j, column in enumerate("yz")
}
#: The logarithmic decrement of the rotor's least damped mode, and what it follows from.
DECREMENT, RATIO = "log_decrement", "rotor_damping_ratio"


class Result(NamedTuple):
    """A result: values of the runs, (run,) or (run, revolution), how they are shown, dataset, its pivots."""

    values: np.ndarray
    shown: Shown
    name: str
    pivot: str | None = None


def result(
    study: Study, name: str, pad: int | None = None, pivot: str | None = None, revolutions: bool = False
) -> Result:
    """A result, (run,) or with `revolutions` (run, revolution); with `pad` (1, 2, ...) that of a pad.

    One of small vibrations is of the given pivots, by default of the first, and says so where there are
    several, which fixed pads have not. Raises ValueError where the study has no such result.
    """
    if is_of_vibrations(study, name):
        return of_vibrations(study, name, pivot)
    if name in (*DEFAULTS, *POINTS) and name not in study:
        raise ValueError(f"{study.path}: no {name} in this study: no run has it")
    wanted = ("run", *(["revolution"] if revolutions else []), *(["pad"] if pad is not None else []))
    if not all(each in study for each in wanted):
        raise ValueError(f"{study.path}: no Poincare points in this study: no run has them")
    has = study.scales(name) if name in study and is_result(study, name) else ()
    if "pad" in has and pad is None:
        raise ArgumentError("{show}: {own} has a value for each pad: choose one by {pad}", own=name)
    if "revolution" in has and not revolutions:
        raise ArgumentError("{show}: {own} is once a revolution: {kind} bifurcation", own=name)
    if has != wanted:
        what = f"{'Poincare points' if revolutions else 'a result'}{' of a pad' if pad is not None else ''}"
        there = [each for each in study.names() if is_result(study, each) and study.scales(each) == wanted]
        every = () if len(wanted) > 1 else (*study.names(), *ELEMENTS, DECREMENT)
        there += [each for each in every if is_of_vibrations(study, each)]
        needs(name, there, "show", what)
    shown = described(study, name, POINTS.get(name, name.removeprefix("pad_")))
    if pad is None:
        return Result(study[name], shown, name)
    if not 1 <= pad <= (last := study.length("pad")):
        raise ArgumentError("{pad} {own}: must be 1 to {last}, the pads of this study", own=pad, last=last)
    text = f"{shown.text}, pad {pad}"
    return Result(study[name][..., pad - 1], shown._replace(text=text), name)


def is_of_vibrations(study: Study, name: str) -> bool:
    """Whether a study has this result of small vibrations, of each of its pivots."""
    if name in study and study.scales(name) == PIVOTS:
        return True
    return name in ELEMENTS and ELEMENTS[name][0] in study or name == DECREMENT and RATIO in study


def of_vibrations(study: Study, name: str, pivot: str | None) -> Result:
    """One of them: a dataset, an element of the coefficients of the journal, or the logarithmic decrement.

    Elements are those at the whirl frequency of the study that is nearest to the speed.
    """
    own, k = place_of_pivot(study, pivot)
    if name in ELEMENTS:
        of, row, column = ELEMENTS[name]
        ratios = study["frequency_ratio"]
        nearest = int(np.argmin(np.abs(ratios - 1)))
        values, shown = study[of][:, k, nearest, row, column], described(study, of)
        whirl = "" if ratios[nearest] == 1 else f" at {ratios[nearest]:g} × shaft speed"
        shown = shown._replace(text=f"{name.replace('_', ' ')}{whirl}")
    elif name == DECREMENT:
        ratio = study[RATIO][:, k]
        with np.errstate(invalid="ignore"):
            values = 2 * np.pi * ratio / np.sqrt(1 - ratio**2)
        shown = Shown("logarithmic decrement of the rotor", 1, "")
    else:
        values, shown = study[name][:, k], described(study, name)
    text = shown.text + (f", pivots {literal(own)}" if study.length("pivot") > 1 else "")
    return Result(values, shown._replace(text=text), name, own)


def is_result(study: Study, name: str) -> bool:
    """True for a dataset of the runs' results, which have a unit."""
    others = ("run", "file", "reason", *study.parameters, *study.GROUPS)
    return name not in others and bool(study.about(name, "units"))


def key_results(study: Study, pivot: str | None = None) -> list[Result]:
    """The key results that runs of the study have; without `pivot` of the first pivots that have them.

    Damping ratios are those of the rotor and of the pads; in studies of older programs that of all modes.
    """
    found = []
    for name in (name for name in KEYS if name in study):
        # the least of both, which says nothing of the rotor where pads without load flutter
        if name == "least_damping_ratio" and "rotor_damping_ratio" in study:
            continue
        several = study.scales(name) == PIVOTS and pivot is None
        pivots = [str(each) for each in study["pivot"]] if several else [pivot]
        every = (result(study, name, pivot=own) for own in pivots)
        found.append(next((one for one in every if np.isfinite(one.values).any()), None))
    return [each for each in found if each is not None]
