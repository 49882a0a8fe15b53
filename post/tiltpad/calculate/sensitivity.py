"""Which input matters: Sobol indices of a result of a sampled study, with their intervals.

A first-order index is the share of the variance of the result that goes when the input is known; the total
index the share that stays when only the input is unknown. They are of independent inputs.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tiltpad.calculate.expansion import Expansion, expansion, groups
from tiltpad.calculate.results import result
from tiltpad.calculate.selection import Where, is_number, matching, varying
from tiltpad.calculate.statistics import NORMAL
from tiltpad.files.study import Study

#: Least number of runs, or of points of a design, that indices are calculated of, and most: of more runs,
#: chosen without regard to their order, an index is known to 0.01 at worst.
LEAST, MOST = 16, 4096
#: Draws for an interval.
DRAWS = 100
#: Part of the runs with the lowest and with the highest values of an input: on average 5 and 95 %.
TENTH = 0.1
#: First-order indices, low and high ends, and the same of the total indices.
Indices = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]
#: How indices are calculated.
SALTELLI, REGRESSION = "saltelli", "regression"
#: Seed of what is chosen at random.
SEED = 1


class Sensitivity(NamedTuple):
    """How the inputs of a sampled study influence a result, (input,) each; its fields:

    result         name of the result
    inputs         names of the parameters that differ
    runs           number of runs that the figures are of
    method         "saltelli" for that design, otherwise "regression"
    explained      share of the variance that the regression foretells of a run it has not seen (Q²)
    first          first-order indices
    first_low, first_high     their 95 % intervals
    total          total indices; of a regression those of what it explains
    total_low, total_high     their 95 % intervals; of a regression up to what it does not explain, too
    rank           Spearman's rank correlation: its sign is that of the influence; nan of a text
    mean           mean result of these runs, in SI units, ()
    low, high      the same with the input in its lowest and its highest tenth; of a text with the values
                   that give the lowest and the highest
    """

    result: str
    inputs: list[str]
    runs: int
    method: str
    explained: float
    first: np.ndarray
    first_low: np.ndarray
    first_high: np.ndarray
    total: np.ndarray
    total_low: np.ndarray
    total_high: np.ndarray
    rank: np.ndarray
    mean: float
    low: np.ndarray
    high: np.ndarray


def sensitivity(
    study: Study, show: str, pad: int | None = None, pivot: str | None = None, where: Where = None
) -> Sensitivity:
    """Sobol indices of a result: which of the sampled inputs it depends on, and how much.

        tiltpad.sensitivity(study, "least_damping_ratio").first

    A study of `tiltpad.sample(method="saltelli")` has the estimators of scipy.stats.sobol_indices (Saltelli
    et al., Computer Physics Communications 181 (2010) 259-270). Any other sample of independent inputs has a
    regression on polynomials, and bins of each input for what that leaves of first order: 256 runs that a
    regression explains give indices to 0.02. Intervals are those of a bootstrap; they do not cover what a
    regression of few runs has not seen, which `explained` tells. `show`, `pad` and `pivot` choose the result
    as for `tiltpad.diagrams.diagram`; `where` keeps the runs with these values of parameters. Raises
    ValueError for a result of too few runs or without variance, and for inputs that vary together.
    """
    chosen = matching(study, where or {})
    inputs = varying(study, chosen)
    if not inputs:
        raise ValueError(f"{study.path}: its runs differ in no parameter")
    own = result(study, show, pad, pivot)
    values = np.where(study.done & chosen, own.values, np.nan)[chosen]
    columns = [study[name][chosen] for name in inputs]
    design = saltelli_design(columns)
    if design is not None:
        whole = design[np.isfinite(values[design]).all(axis=1)]
        least(study, show, len(whole), "points of the design whose runs all have a value")
        drawn = whole[:, :2].ravel()
    else:
        known = np.isfinite(values)
        for name, each in zip(inputs, columns, strict=True):
            known &= np.isfinite(each) if is_number(study, name) else each != ""
        drawn = some(np.flatnonzero(known), MOST)
        least(study, show, len(drawn), "runs that have a value")
    mine, sampled = values[drawn], [each[drawn] for each in columns]
    if np.ptp(mine) <= 1e-12 * np.abs(mine).max():
        raise ValueError(f"{study.path}: {show} is the same in all runs: no input matters")
    ranks = [ranked(each) if each.dtype.kind != "O" else None for each in sampled]
    independent(study, inputs, ranks)
    fit = expansion(sampled, mine)
    indices = saltelli(values[whole]) if design is not None else regression(fit, sampled, mine)
    ends = conditional_means(fit, sampled, mine)
    ours = ranked(mine)
    rank = [np.nan if each is None else correlation(each, ours) for each in ranks]
    runs = whole.size if design is not None else len(drawn)
    explained = np.nan if design is not None else fit.explained
    method = REGRESSION if design is None else SALTELLI
    middle = float(mine.mean())
    return Sensitivity(show, inputs, runs, method, explained, *indices, np.array(rank), middle, *ends)


def least(study: Study, show: str, count: int, what: str) -> None:
    """Raises ValueError for too few values."""
    if count < LEAST:
        raise ValueError(f"{study.path}: {show}: indices need {LEAST} {what}, here are {count}")


def some(places: np.ndarray, most: int) -> np.ndarray:
    """At most this number of the places, in their order, without regard to it: a study may have periods."""
    if len(places) <= most:
        return places
    return np.sort(np.random.default_rng(SEED).choice(places, most, replace=False))


def saltelli_design(columns: Sequence[np.ndarray]) -> np.ndarray | None:
    """Places of the runs of each point of a Saltelli design, (point, 2 + inputs); None of another sample.

    A point has the runs A, B, and A with each of the inputs from B in turn, as tiltpad.sample writes them.
    Runs of a last point that is not whole are left out.
    """
    size = len(columns) + 2
    points = len(columns[0]) // size
    if points == 0:
        return None
    for own, column in enumerate(columns):
        table = column[: points * size].reshape(points, size)
        expected = np.repeat(table[:, :1], size, axis=1)
        expected[:, 1] = expected[:, 2 + own] = table[:, 1]
        if not (table == expected).all() or (table[:, 0] == table[:, 1]).all():
            return None
    return np.arange(points * size).reshape(points, size)


def saltelli(values: np.ndarray) -> Indices:
    """First-order and total indices with their intervals, of values at (point, run of the point)."""
    group = groups(len(values))
    a, b, *ab = (values - values[:, :2].mean()).T
    own = np.column_stack([b * (each - a) for each in ab])
    steps = np.column_stack([each - a for each in ab])

    def indices(weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        shares = weights[:, group] / weights[:, group].sum(axis=1, keepdims=True)
        mean = shares @ (a + b) / 2
        variance = (shares @ (a**2 + b**2) / 2 - mean**2)[:, None]
        first = shares @ own - mean[:, None] * (shares @ steps)
        return first / variance, shares @ steps**2 / 2 / variance

    return with_intervals(indices, group.max() + 1)


def regression(fit: Expansion, inputs: Sequence[np.ndarray], values: np.ndarray) -> Indices:
    """The same of an expansion: variances of its parts, and of the means of the rest over each input.

    What it does not explain may belong to the total index of any input.
    """
    parts = [fit.of(own) for own in range(len(inputs))]
    with_it = [fit.terms[:, own] > 0 for own in range(len(inputs))]
    several = (fit.terms > 0).sum(axis=1) > 1
    bins = [binned(each) for each in inputs]
    mean = int(np.flatnonzero(~fit.terms.any(axis=1))[0])

    def indices(weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        factors, squares, inverse = fit.fit(weights)
        own = weights[:, fit.group]
        of = own.sum(axis=1)
        rest = values - factors @ fit.products.T
        noise = (own * rest**2).sum(axis=1) / np.maximum(of - len(fit.terms), 1)
        means = squares[:, mean] / of[:, None]
        spread = squares / of[:, None, None] - means[:, :, None] * means[:, None, :]

        def variance(part: np.ndarray) -> np.ndarray:
            """Of a part of the expansion, less what the noise of its factors adds, (draw,)."""
            its = spread[:, part][:, :, part]
            whole = np.einsum("di,dij,dj->d", factors[:, part], its, factors[:, part])
            return whole - noise * np.einsum("dij,dij->d", inverse[:, part][:, :, part], its)

        main = np.column_stack([variance(part) for part in parts])
        left = np.column_stack([np.subtract(*of_means(each, rest, own)) for each in bins])
        total = np.maximum(main + left, np.column_stack([variance(part) for part in with_it]))
        whole = (main.sum(axis=1) + variance(several) + noise)[:, None]
        return (main + left) / whole, total / whole

    found = with_intervals(indices, len(fit.squares))
    return *found[:-1], np.minimum(found[-1] + 1 - fit.explained, 1)


def with_intervals(indices: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]], count: int) -> Indices:
    """Indices of first order and total, each with low and high end.

    `indices` gives them, (draw, input), by weights of the groups of runs, (draw, group). The ends are 1.96
    standard deviations away, those of draws of the groups with replacement.
    """
    random = np.random.default_rng(SEED)
    own = np.array(indices(np.ones((1, count))))[:, 0]
    draws = random.multinomial(count, [1 / count] * count, DRAWS).astype(float)
    half = NORMAL * np.std(indices(draws), axis=1)
    first, total = np.clip([own, own - half, own + half], 0, 1).transpose(1, 0, 2)
    return *first, *total


def binned(values: np.ndarray) -> np.ndarray:
    """Number of the bin of each value: the values of a text, bins of equally many runs of a number."""
    distinct, place = np.unique(values, return_inverse=True)
    bins = max(3, round(len(values) ** 0.4))
    if values.dtype.kind == "O" or len(distinct) <= bins:
        return place
    order = np.argsort(np.argsort(values, kind="stable"), kind="stable")
    return order * bins // len(values)


def of_means(bins: np.ndarray, values: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Variance of the means of bins, (draw,), and how much of it the noise of so few values adds.

    Values and weights are (draw, run).
    """
    order = np.argsort(bins, kind="stable")
    starts = np.flatnonzero(np.diff(bins[order], prepend=-1))
    size, sums = (np.add.reduceat(each[:, order], starts, axis=1) for each in (weights, weights * values))
    of = weights.sum(axis=1)
    there = size > 0
    between = (sums**2 / np.where(there, size, 1)).sum(axis=1)
    free = there.sum(axis=1) - 1
    within = ((weights * values**2).sum(axis=1) - between) / np.maximum(of - free - 1, 1)
    return between / of - (sums.sum(axis=1) / of) ** 2, free * within / of


def conditional_means(
    fit: Expansion, inputs: Sequence[np.ndarray], values: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Mean result with each input low and high, the influences of the others taken out.

    What the expansion leaves counts by the share of its means over the input that is no noise.
    """
    factors = fit.fit(np.ones((1, len(fit.squares))))[0][0]
    rest = values - fit.products @ factors
    found = []
    for own, each in enumerate(inputs):
        part, bins = fit.of(own), binned(each)
        (means,), (noise,) = of_means(bins, rest[None], np.ones((1, len(rest))))
        true = max(0.0, 1 - noise / means) if means > 0 else 0.0
        alone = values.mean() + fit.products[:, part] @ factors[part] + true * rest
        if each.dtype.kind == "O":
            sizes = np.bincount(bins)
            ends = np.bincount(bins, alone) / sizes
            found.append((ends.min(), ends.max()))
        else:
            order = np.argsort(each, kind="stable")
            few = max(1, round(TENTH * len(each)))
            low, high = each[order[few - 1]], each[order[-few]]
            found.append((alone[each <= low].mean(), alone[each >= high].mean()))
    low, high = np.array(found).T
    return low, high


def ranked(values: np.ndarray) -> np.ndarray:
    """Ranks of numbers from 0; equal ones share their mean."""
    _, place, count = np.unique(values, return_inverse=True, return_counts=True)
    return (np.cumsum(count) - (count + 1) / 2)[place]


def correlation(a: np.ndarray, b: np.ndarray) -> float:
    return float(np.corrcoef(a, b)[0, 1])


def independent(study: Study, inputs: Sequence[str], ranks: Sequence[np.ndarray | None]) -> None:
    """Raises ValueError for inputs that vary together: more than three deviations of independent ones do."""
    numbers = [(name, each) for name, each in zip(inputs, ranks, strict=True) if each is not None]
    if len(numbers) < 2:
        return
    found = np.abs(np.corrcoef([each for _, each in numbers]) - np.eye(len(numbers)))
    one, other = np.unravel_index(np.argmax(found), found.shape)
    if found[one, other] > 0.3 + 3 / np.sqrt(len(numbers[0][1])):
        both = f"{numbers[one][0]} and {numbers[other][0]} vary together"
        how = f"(rank correlation {found[one, other]:.2f})"
        raise ValueError(f"{study.path}: {both} {how}: what each of them does cannot be told apart")
