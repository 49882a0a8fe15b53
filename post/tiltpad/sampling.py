"""Samples of uncertain inputs: a table of values for a parameter study."""

import math
import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.files import namelist
from tiltpad.files.writing import write
from tiltpad.running import Groups, case_file, checked

#: The numbers that each distribution takes.
DISTRIBUTIONS = {
    "normal": ("mean", "deviation"),
    "truncated normal": ("mean", "deviation", "low", "high"),
    "lognormal": ("median", "deviation"),
    "uniform": ("low", "high"),
}
#: The design for Sobol indices, and all ways to draw points.
SALTELLI = "saltelli"
METHODS = ("sobol", "lhs", "halton", SALTELLI)
#: Most runs of a study.
MOST = 1_000_000
#: Half a step of Sobol's points, which have 30 bits: 0 and 1, where a normal value is infinite, stay away.
HALF_STEP = 2.0**-31


def sample(
    case: "str | os.PathLike | Groups | None",
    variables: Mapping[str, Any],
    n: int,
    *,
    method: str = "sobol",
    seed: int = 1,
    file: str | os.PathLike = "members.csv",
) -> Path:
    """Draws n values of uncertain inputs and writes them as the table of a study; gives its path.

        tiltpad.sample(
            "mine.nml",
            {
                "bearing%assembled_clearance": ("normal", 80e-6, 3e-6),
                "bearing%preload": ("truncated normal", 0.3, 0.05, 0.0, 0.6),
                "pads%arc_deg(2)": ("uniform", 69.0, 69.6),
                "friction%static_coefficient": ("lognormal", 0.15, 0.2),
            },
            1024,
        )
        study = tiltpad.run("mine.nml", sweep={"file": "members.csv"})
        data = study.to_xarray()

    Distributions are ("normal", mean, deviation), ("truncated normal", mean, deviation, low, high), where
    mean and deviation are those before the ends are cut, ("lognormal", median, deviation of the natural
    logarithm), ("uniform", low, high), or any of scipy.stats with its numbers, such as
    scipy.stats.triang(0.5, 70e-6, 20e-6). Points are drawn by `method`, "sobol" (scrambled, best where n is
    a power of 2), "lhs" (Latin hypercube) or "halton" (scrambled); the same seed gives the same table. With
    "saltelli" n is the number of points of a design for Sobol indices: each has variables + 2 rows, A, B, and
    A with each variable from B in turn. Any of these samples has first-order indices from `sensitivity`;
    the design needs many more runs, and gives total indices of what no polynomial follows, too. The program
    checks the case, a file or groups as for `run`, with every row. What is wrong is a ValueError,
    and the file is then left as it was. Needs scipy from 1.15 on.
    """
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 1 <= n <= MOST:
        raise ValueError(f"n = {n!r}: must be a whole number, 1 to {MOST}")
    if method not in METHODS:
        raise ValueError(f"method = {method!r}: must be one of {', '.join(map(repr, METHODS))}")
    rows = n * (len(variables) + 2) if method == SALTELLI and isinstance(variables, Mapping) else n
    if rows > MOST:
        raise ValueError(f"n = {n!r}: {rows} runs, and a study has at most {MOST}")
    if not isinstance(variables, Mapping) or not variables:
        raise ValueError(f"variables = {variables!r}: must be distributions by name, {{'group%name': ...}}")
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
        raise ValueError(f"seed = {seed!r}: must be a whole number from 0 on")
    distributions = {name: distribution(name, given) for name, given in variables.items()}
    drawn = points(len(variables), n, method, seed)
    own = zip(distributions.values(), drawn, strict=True)
    values = np.column_stack([each.ppf(shares) for each, shares in own])
    for name, column in zip(distributions, values.T, strict=True):
        if not np.isfinite(column).all():
            raise ValueError(f"{name}: {variables[name]!r} has values that are no finite numbers")
    target = Path(file)
    with tempfile.TemporaryDirectory(prefix="tiltpad-") as folder:
        table = Path(folder, "table.csv")
        content = lines(list(distributions), values)
        write(table, content)
        option = f"{namelist.STUDY}%{namelist.TABLE}"
        try:
            checked(case_file(case, Path(folder)), "--set", f"{option}={namelist.written(table)}")
        except ValueError as error:
            said = f"{error}".removeprefix(f"--set: {option}: ")
            raise ValueError(said.replace(f"{table}", f"{target}")) from None
        write(target, content)
    return target


def points(dimensions: int, n: int, method: str, seed: int) -> np.ndarray:
    """Points of the unit cube, (dimension, point), less its faces."""
    from scipy.stats import qmc

    if method == SALTELLI:
        return saltelli(points(2 * dimensions, n, "sobol", seed))
    kinds = {"sobol": qmc.Sobol, "lhs": qmc.LatinHypercube, "halton": qmc.Halton}
    drawn = kinds[method](dimensions, rng=seed).random(n)
    return np.clip(drawn, HALF_STEP, 1 - HALF_STEP).T


def saltelli(drawn: np.ndarray) -> np.ndarray:
    """The design of Saltelli et al. (2010) from points of twice its dimensions, (dimension, point)."""
    a, b = np.split(drawn, 2)
    found = np.repeat(a[:, :, None], len(a) + 2, axis=2)
    found[:, :, 1] = b
    for own in range(len(a)):
        found[own, :, 2 + own] = b[own]
    return found.reshape(len(a), -1)


def distribution(name: str, given: Any) -> Any:
    """A distribution of scipy.stats; ValueError with the variable where there is none."""
    from scipy import stats

    namelist.needs_variable(name)
    if callable(getattr(given, "ppf", None)):
        return given
    kind, numbers = parts(name, given)
    mean, deviation, low, high = (numbers.get(each, math.nan) for each in DISTRIBUTIONS["truncated normal"])
    median = numbers.get("median", math.nan)
    for wrong, rule in (
        (deviation <= 0, "the deviation must be > 0"),
        (low >= high, "low must be less than high"),
        (median <= 0, "the median must be > 0"),
    ):
        if wrong:
            raise ValueError(f"{name}: {given!r}: {rule}")
    if kind == "normal":
        return stats.norm(mean, deviation)
    if kind == "uniform":
        return stats.uniform(low, high - low)
    if kind == "truncated normal":
        return stats.truncnorm((low - mean) / deviation, (high - mean) / deviation, mean, deviation)
    return stats.lognorm(deviation, scale=median)


def parts(name: str, given: Any) -> tuple[str, dict[str, float]]:
    """The kind of a distribution, and its numbers by name."""
    kind = given[0] if isinstance(given, Sequence) and not isinstance(given, str) and len(given) else given
    if not isinstance(kind, str) or kind not in DISTRIBUTIONS:
        known = ", ".join(f"({', '.join((repr(each), *names))})" for each, names in DISTRIBUTIONS.items())
        raise ValueError(f"{name}: {given!r} is no distribution; known: {known}")
    names, numbers = DISTRIBUTIONS[kind], given[1:]
    good = all(isinstance(each, int | float | np.number) and math.isfinite(each) for each in numbers)
    if isinstance(given, str) or len(numbers) != len(names) or not good:
        raise ValueError(f"{name}: {given!r}: must be ({', '.join((repr(kind), *names))})")
    return kind, dict(zip(names, map(float, numbers), strict=True))


def lines(names: Sequence[str], values: np.ndarray) -> str:
    """The table as text, every number with all its bits."""
    rows = (",".join(map(repr, row)) for row in values.tolist())
    return "\n".join([",".join(names), *rows, ""])
