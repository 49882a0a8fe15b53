"""Fitting: the numbers of a case that make its results those that were measured."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from tiltpad.calculate import estimation
from tiltpad.calculate.estimation import NoInfluenceError, Parameter
from tiltpad.calculate.measured import Measured
from tiltpad.files import namelist, units
from tiltpad.files.archive import RunError
from tiltpad.fitted_model import Bounds, Case, FittedModel, Values

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: From this correlation on two parameters are told to be known together only.
TOGETHER = 0.95
#: Standard deviation over the range from which on a parameter is told to be unknown: an even distribution's.
EVEN = 12**-0.5
#: Standard deviations in a 95 % interval.
NORMAL = 1.96
Free = Mapping[str | tuple[str, ...], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Fit:
    """Parameters of a case that fit what was measured, and how well they are known; its fields:

        names          names of the parameters, the first variable of each
        values         their values, (parameter,), in the units of the input
        deviations     their standard deviations, (parameter,)
        interval       their 95 % intervals, (parameter, 2); beyond a bound where it lies that near
        covariance     of the values, (parameter, parameter)
        correlation    likewise; near 1 or -1 two parameters are known together only
        residuals      measured less fitted, over the standard deviation of the noise, (value,)
        misfit         sum of their squares over values less parameters: near 1 where the model is true and
                       the deviations of the noise are right
        runs           number of runs that it took
        measured       what was measured, a Measured for each test
        started        the same of the model at the start, for each test values by name
        fitted         the same of the fitted model
        groups         groups of the fitted values: tiltpad.run(case, **fit.groups)

    Intervals, deviations and correlations are those of the model linearised at the values, over the logarithm
    of a parameter whose bounds are above 0.
    """

    names: list[str]
    values: np.ndarray
    deviations: np.ndarray
    interval: np.ndarray
    covariance: np.ndarray
    residuals: np.ndarray
    runs: int
    measured: list[Measured]
    started: list[Values]
    fitted: list[Values]
    groups: dict[str, dict[str, float]]
    bounds: np.ndarray

    @cached_property
    def correlation(self) -> np.ndarray:
        return self.covariance / np.outer(self.deviations, self.deviations)

    @cached_property
    def misfit(self) -> float:
        return float(self.residuals @ self.residuals / max(1, len(self.residuals) - len(self.values)))

    @property
    def remarks(self) -> list[str]:
        """What the measurements cannot tell, and whether the model describes them, in sentences."""
        found = []
        known = zip(self.names, self.values, self.deviations, self.bounds, strict=True)
        for name, value, deviation, (low, high) in known:
            width = value * np.log(high / low) if low > 0 else high - low
            if deviation > EVEN * width:
                found.append(f"{name}: what was measured tells no more of it than its bounds")
            elif min(value - low, high - value) < 1e-3 * (high - low):
                found.append(f"{name}: is at its bound {value:.4g}")
        pairs = np.argwhere(np.triu(np.abs(self.correlation) > TOGETHER, 1))
        for i, j in pairs:
            how = f"(correlation {self.correlation[i, j]:.3f})"
            found.append(f"{self.names[i]} and {self.names[j]} are known together only {how}")
        free = len(self.residuals) - len(self.values)
        if free > 0 and self.misfit > 1 + 5 * np.sqrt(2 / free):
            times = f"{np.sqrt(self.misfit):.2g} times the noise"
            found.append(f"the residuals are {times}: the model misses something")
        return found

    def __repr__(self) -> str:
        width = max(map(len, self.names))
        told = [f"{name:<{width}}  {self.in_words(k)}" for k, name in enumerate(self.names)]
        size = f"{len(self.residuals)} values, {self.runs} runs, misfit {self.misfit:.3g}"
        return "\n".join([f"<tiltpad fit: {size}", *(f"  {each}" for each in (*told, *self.remarks))]) + ">"

    def in_words(self, parameter: int) -> str:
        """A value with its standard deviation and unit: "0.1012 ± 0.0006"."""
        value, deviation = self.values[parameter], self.deviations[parameter]
        shown = units.shown(*units.named(self.names[parameter]), [value])
        value, deviation = shown.factor * value, shown.factor * deviation
        unit = f" {shown.unit}" if shown.unit else ""
        places = max(2, 2 + int(np.floor(np.log10(abs(value) or 1)) - np.floor(np.log10(deviation))))
        return f"{value:.{places}g} ± {deviation:.2g}{unit}"

    def plot(self) -> "Figure":
        """A picture of what was measured, of the model at the start, and of the fitted one; the figure."""
        from tiltpad.draw.fits import comparison

        values = [f"{name} = {self.in_words(k)}" for k, name in enumerate(self.names)]
        return comparison(self.measured, self.started, self.fitted, ["; ".join(values), *self.remarks])


def fit(
    case: Case, measured: Measured | Sequence[Measured], free: Free, start: Mapping[str, float] | None = None
) -> Fit:
    """Fits numbers of a case to what was measured, by least squares.

        orbit = tiltpad.Measured({"journal_y": y, "journal_z": z}, deviation=0.2e-6)
        fit = tiltpad.fit(
            "mine.nml",
            orbit,
            free={
                "friction%static_coefficient": (0.02, 0.5),
                "friction%bristle_stiffness": (1e4, 1e8),
                ("pads%arc_deg(1)", "pads%arc_deg(2)"): (60, 75),
            },
        )
        print(fit)
        fit.plot().savefig("fitted.png")

    `case` is a file or groups as for `tiltpad.run`, `measured` one test or several of the same machine. The
    bounds of each parameter are in the units of the input; variables in a tuple share one value. A fit starts
    from the values of `start`, by the first name of each, and otherwise in the middle of the bounds, by their
    ratio where both are above 0. It finds a minimum near the start: try others where the residuals stay
    large. Orbits are best fitted with case%task = 'periodic'; a march must have settled in its last
    revolutions. The runs for the derivatives are those of a study, on all processors. Needs scipy from 1.15
    on. What is wrong is a ValueError of one line, and so is a parameter on which nothing depends; runs that
    fail at the start, and fits that find no minimum, are a RunError.
    """
    tests = list(measured) if isinstance(measured, Iterable) else [measured]
    if not all(isinstance(each, Measured) for each in tests):
        raise TypeError("measured: must be tiltpad.Measured, or a list of them")
    model = FittedModel(case, tests, variables(free))
    if not isinstance(start or {}, Mapping):
        raise ValueError(f"start = {start!r}: must be values by name, {{'group%name': value}}")
    begin = np.array([start_of(each, start or {}) for each in model.parameters])
    unknown = [name for name in start or {} if name not in model.names]
    if unknown:
        raise ValueError(f"start: {unknown[0]} is no free parameter: {', '.join(model.names)}")
    if len(model.target) < len(begin):
        raise ValueError(f"measured: {len(model.target)} values, and {len(begin)} free parameters")
    model.check(begin)
    started = model.single(begin)
    try:
        found = estimation.estimate(model, model.parameters, begin)
    except NoInfluenceError as name:
        value = begin[model.names.index(f"{name}")]
        start_there = f"at {value:.6g}, where the fit starts"
        raise ValueError(f"{name}: nothing that was measured depends on it {start_there}") from None
    except ArithmeticError as error:
        raise RunError(f"{error}{model.why and f': {model.why}'}") from None
    pairs = list(zip(model.parameters, found.place, strict=True))
    values = np.array([float(each.value(place)) for each, place in pairs])
    slopes = np.array([each.slope(place) for each, place in pairs])
    half = NORMAL * np.sqrt(np.diag(found.covariance))
    interval = np.column_stack([found.place - half, found.place + half])
    return Fit(
        names=model.names,
        values=values,
        deviations=slopes * half / NORMAL,
        interval=np.array([each.value(ends) for each, ends in zip(model.parameters, interval, strict=True)]),
        covariance=found.covariance * np.outer(slopes, slopes),
        residuals=-found.residuals,
        runs=model.runs,
        measured=tests,
        started=started,
        fitted=model.single(values),
        groups=model.groups(values),
        bounds=np.array([each[1:] for each in model.parameters]),
    )


def variables(free: Free) -> Bounds:
    """The bounds by the variables of each parameter; ValueError where they are none."""
    if not isinstance(free, Mapping) or not free:
        raise ValueError(f"free = {free!r}: must be bounds by name, {{'group%name': (low, high)}}")
    found = {}
    for names, bounds in free.items():
        own: tuple[Any, ...] = names if isinstance(names, tuple) and names else (names,)
        for name in own:
            namelist.needs_variable(name, "free: ")
        try:
            low, high = (float(each) for each in bounds)
        except (TypeError, ValueError, OverflowError):
            raise ValueError(f"free: {own[0]}: {bounds!r}: must be two numbers, (low, high)") from None
        # no number where they are too far from each other, and one of them where they are too near
        if not low < Parameter(own[0], low, high).value(0.5) < high:
            raise ValueError(
                f"free: {own[0]}: {bounds!r}: low must be less than high, and both of usual size"
            )
        found[own] = (low, high)
    return found


def start_of(parameter: Parameter, start: Mapping[str, float]) -> float:
    """The value from which a parameter starts."""
    try:
        value = float(start.get(parameter.name, parameter.value(0.5)))
    except (TypeError, ValueError):
        raise ValueError(f"start: {parameter.name}: {start[parameter.name]!r}: must be a number") from None
    if not parameter.low <= value <= parameter.high:
        bounds = f"its bounds {parameter.low:.6g} and {parameter.high:.6g}"
        raise ValueError(f"start: {parameter.name} = {value:.6g}: must be between {bounds}")
    return value
