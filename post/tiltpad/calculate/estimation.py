"""Parameters of a model from measurements: least squares of scaled residuals, and how well they are known."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

#: Part of the value by which a parameter is changed for a difference; of one that may be 0, of its range.
STEP = 0.01
#: Relative change of the sum of squares, and of the parameters over their ranges, at which a fit ends.
CLOSE = 1e-7
#: A parameter has no influence where the whole of its range changes the residuals by less than this, in
#: standard deviations.
NO_INFLUENCE = 1e-3
#: What keeps the inverse finite where two parameters have one and the same effect.
SINGULAR = 1e-12

Model = Callable[[np.ndarray], np.ndarray]


class Parameter(NamedTuple):
    """A parameter between two bounds; where both are above 0 its logarithm is what is fitted."""

    name: str
    low: float
    high: float

    @property
    def by_logarithm(self) -> bool:
        return self.low > 0

    def scaled(self, value: float) -> float:
        """Its place between the bounds, 0 to 1."""
        low, high, own = np.log([self.low, self.high, value]) if self.by_logarithm else (*self[1:], value)
        return float((own - low) / (high - low))

    def value(self, place: np.ndarray | float) -> np.ndarray:
        """The value at a place."""
        if self.by_logarithm:
            return self.low * (self.high / self.low) ** np.asarray(place)
        return self.low + (self.high - self.low) * np.asarray(place)

    def slope(self, place: float) -> float:
        """How the value changes with its place."""
        if self.by_logarithm:
            return float(self.value(place) * np.log(self.high / self.low))
        return self.high - self.low

    @property
    def step(self) -> float:
        """Change of the place for a difference."""
        return min(0.25, STEP / np.log(self.high / self.low)) if self.by_logarithm else STEP


class Estimate(NamedTuple):
    """Fitted parameters."""

    place: np.ndarray  # between the bounds, 0 to 1, (parameter,)
    covariance: np.ndarray  # of the places, (parameter, parameter)
    residuals: np.ndarray  # over their standard deviations, (value,)


class NoInfluenceError(ValueError):
    """No residual depends on a parameter."""


def estimate(model: Model, parameters: Sequence[Parameter], start: np.ndarray) -> Estimate:
    """The parameters of the least sum of squares (scipy.optimize.least_squares, within their bounds).

    `model` gives residuals over their standard deviations, (point, value), of points in the parameters,
    (point, parameter); nan where it has none. `start` are the values to start from. The covariance is that of
    the linearised model, (J^T J)^-1: residuals are independent and normal of deviation 1 where the model is
    true. Raises NoInfluenceError for a parameter without influence at the start, and ArithmeticError where
    there are no residuals or no minimum is found.
    """
    from scipy.optimize import least_squares

    steps = np.array([each.step for each in parameters])
    last: dict[bytes, np.ndarray] = {}

    def at(places: np.ndarray) -> np.ndarray:
        points = [each.value(own) for each, own in zip(parameters, places.T, strict=True)]
        return model(np.column_stack(points))

    def residuals(place: np.ndarray) -> np.ndarray:
        if place.tobytes() not in last:
            last.clear()
            last[place.tobytes()] = at(place[None])[0]
        return last[place.tobytes()]

    def jacobian(place: np.ndarray) -> np.ndarray:
        own = np.where(place + steps > 1, -steps, steps)
        slopes = (at(place + np.diag(own)) - residuals(place)) / own[:, None]
        if not np.isfinite(slopes).all():
            raise ArithmeticError("the model has no result beside a point at which it has one")
        size = np.linalg.norm(slopes, axis=1)
        if not first and (size < NO_INFLUENCE).any():
            raise NoInfluenceError(parameters[int(np.argmin(size))].name)
        first.append(place)
        return slopes.T

    first: list[np.ndarray] = []
    begin = np.array([each.scaled(value) for each, value in zip(parameters, start, strict=True)])
    if not np.isfinite(residuals(begin)).all():
        raise ArithmeticError("the model has no result at the start")
    found = least_squares(
        residuals, begin, jacobian, (0, 1), x_scale="jac", ftol=CLOSE, xtol=CLOSE, gtol=CLOSE, max_nfev=100
    )
    if not found.success:
        raise ArithmeticError("no minimum is found in 100 steps")
    return Estimate(found.x, covariance(found.jac), found.fun)


def covariance(jacobian: np.ndarray) -> np.ndarray:
    """Covariance of the parameters by the derivatives of the residuals, (value, parameter)."""
    size = np.maximum(np.linalg.norm(jacobian, axis=0), np.finfo(float).tiny)
    products = (jacobian / size).T @ (jacobian / size)
    return np.linalg.inv(products + SINGULAR * np.eye(len(size))) / np.outer(size, size)
