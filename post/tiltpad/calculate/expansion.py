"""Regression of a result on polynomials of independent inputs: a polynomial chaos expansion.

The polynomials of an input are orthonormal over its own values, whatever their distribution (Oladyshkin and
Nowak, Reliability Engineering and System Safety 106 (2012) 179-190); a text has the differences of its values
in their place. Products of them are fitted by least squares; which, is chosen by the error at runs that are
left out (Blatman and Sudret, Probabilistic Engineering Mechanics 25 (2010) 183-197).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

#: Highest degrees of polynomials; most products of them, and least number of runs for each.
DEGREE, MOST_TERMS, RUNS_PER_TERM = 12, 150, 2.5
#: Norms of the degrees of a product, which are at most the degree: the lower, the fewer inputs together.
NORMS = (1.0, 0.75, 0.5)
#: Groups of runs, which are drawn for an interval, and parts of these that are left out in turn.
GROUPS, FOLDS = 50, 10
#: Share of their number that is added to the squares of products: what is alike to rounding has no factor.
RIDGE = 1e-9


class Input(NamedTuple):
    """Functions of an input at the runs, (run, function), of mean 0 and variance 1, and their degrees."""

    functions: np.ndarray
    degrees: np.ndarray


class Expansion(NamedTuple):
    """A fitted expansion."""

    terms: np.ndarray  # function of each input in each product, (term, input), from 1; 0 where it has none
    products: np.ndarray  # their values, (run, term)
    group: np.ndarray  # number of the group of each run, (run,)
    squares: np.ndarray  # products times products, summed over the runs of each group, (group, term, term)
    moments: np.ndarray  # products times values likewise, (group, term)
    explained: float  # share of the variance that it foretells of runs left out (Q²)

    def of(self, own: int) -> np.ndarray:
        """True for the products of this input alone, (term,)."""
        return (self.terms[:, own] > 0) & ((self.terms > 0).sum(axis=1) == 1)

    def part(self, columns: Sequence[int]) -> "Expansion":
        """The same with these products alone."""
        squares, moments = self.squares[:, columns][:, :, columns], self.moments[:, columns]
        terms, products = self.terms[columns], self.products[:, columns]
        return self._replace(terms=terms, products=products, squares=squares, moments=moments)

    def fit(self, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Factors, (draw, term), by weights of the groups, (draw, group); weighted squares, their inverse."""
        squares = np.tensordot(weights, self.squares, 1)
        inverse = np.linalg.inv(squares + RIDGE * squares[:, :1, :1] * np.eye(len(self.terms)))
        return np.einsum("dij,dj->di", inverse, weights @ self.moments), squares, inverse


def expansion(inputs: Sequence[np.ndarray], values: np.ndarray) -> Expansion:
    """The expansion that foretells best; inputs are (run,) each, numbers or texts."""
    bases = [basis(each) for each in inputs]
    sets = list(candidates([each.degrees for each in bases], len(values)))
    place: dict[tuple[int, ...], int] = {}
    columns = [[place.setdefault(tuple(term), len(place)) for term in each] for each in sets]
    terms = np.array(list(place))
    products, group = multiplied(bases, terms), groups(len(values))
    own = [(products[group == k], values[group == k]) for k in range(group.max() + 1)]
    squares, moments = np.stack([p.T @ p for p, _ in own]), np.stack([p.T @ v for p, v in own])
    whole = Expansion(terms, products, group, squares, moments, 0.0)
    errors = [error_of_runs_left_out(whole.part(each), values) for each in columns]
    best = int(np.argmin(errors))
    return whole.part(columns[best])._replace(explained=float(max(0, 1 - errors[best] / values.var())))


def groups(runs: int) -> np.ndarray:
    """Number of the group of each run, without regard to their order."""
    return np.random.default_rng(1).permutation(runs) % min(GROUPS, runs)


def basis(values: np.ndarray) -> Input:
    """The functions of an input."""
    distinct, place = np.unique(values, return_inverse=True)
    if values.dtype.kind == "O":
        powers = np.eye(len(distinct))[place]
        powers[:, 0] = 1
        degrees = np.ones(len(distinct) - 1, dtype=int)
    else:
        degrees = np.arange(1, min(DEGREE, len(distinct) - 1) + 1)
        from_mean = values - values.mean()
        powers = np.vander(from_mean / np.abs(from_mean).max(), len(degrees) + 1, increasing=True)
    orthogonal, triangle = np.linalg.qr(powers)
    # what rounding alone tells apart is no function of its own
    known = np.abs(np.diag(triangle)) > 1e-10 * np.abs(triangle[0, 0])
    known[0] = False
    return Input(np.sqrt(len(values)) * orthogonal[:, known], degrees[known[1:]])


def candidates(degrees: Sequence[np.ndarray], runs: int) -> Iterator[np.ndarray]:
    """Products that are tried, (term, input) each: the mean alone, and up to rising degrees."""
    most = min(MOST_TERMS, runs / RUNS_PER_TERM)
    yield np.zeros((1, len(degrees)), dtype=int)
    highest = max((each.max(initial=0) for each in degrees), default=0)
    for norm in NORMS:
        size = 1
        for degree in range(1, highest + 1):
            found = products_up_to(degrees, degree, norm, most)
            if found is None:
                break
            # of degree 1 there is one set, and a higher degree may add nothing
            if len(found) > size and (degree > 1 or norm == NORMS[0]):
                yield found
            size = len(found)


def products_up_to(degrees: Sequence[np.ndarray], degree: int, norm: float, most: float) -> np.ndarray | None:
    """All products whose degrees have at most this norm; None where they are more than `most`."""
    found: list[tuple[tuple[int, ...], float]] = [((), 0.0)]
    reach = degree**norm + 1e-9
    for own in degrees:
        steps = [0.0, *(own**norm)]
        longer = [((*term, k), length + step) for term, length in found for k, step in enumerate(steps)]
        found = [each for each in longer if each[1] <= reach]
        if len(found) > most:
            return None
    return np.array([term for term, _ in found])


def multiplied(bases: Sequence[Input], terms: np.ndarray) -> np.ndarray:
    """Values of products, (run, term)."""
    found = np.ones((len(bases[0].functions), len(terms)))
    for column, term in enumerate(terms):
        for own, each in enumerate(bases):
            if term[own]:
                found[:, column] *= each.functions[:, term[own] - 1]
    return found


def error_of_runs_left_out(fit: Expansion, values: np.ndarray) -> float:
    """Mean square error at the runs of groups that the fit has not seen, each group in its turn."""
    count = len(fit.squares)
    fold = np.arange(count) % min(FOLDS, count)
    factors = fit.fit((fold != np.arange(fold.max() + 1)[:, None]).astype(float))[0]
    rest = values - np.einsum("ij,ij->i", fit.products, factors[fold[fit.group]])
    return float(np.mean(rest**2))
