"""Statistics of the runs of a study: percentiles, shares with their intervals, refused runs by cause."""

import re
from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tiltpad.calculate.coefficients import SOUGHT as THRESHOLD
from tiltpad.calculate.results import Result, key_results, result
from tiltpad.calculate.selection import Where, matching, selected
from tiltpad.files.study import Study

#: Percentiles, in percent, and the quantile of the normal distribution that 95 % intervals reach to.
LEVELS, NORMAL = (5, 25, 50, 75, 95), 1.959963984540054
#: Status of runs that came to their end, with results and without; nan is a file that cannot be read.
DONE, REFUSED = 0, (2, 3)
#: The highest speed at which a threshold speed was looked for.
SOUGHT = "threshold_sought_rpm"
#: Where a reason names a file or another name, and where it has a number.
FILES = re.compile(r"(?<!\S)[^\s:]*\.(?:h5|nml|csv|part)\b|(?<!\S)\.{0,2}/[^\s:,;]+")
NAMES = re.compile(r"'[^']*'|\"[^\"]*\"")
NUMBERS = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?", re.IGNORECASE)


class Percentiles(NamedTuple):
    """What the results of a study's runs are like; its fields:

        results      names of the results
        runs         number of runs that have a value of each, (result,)
        mean         (result,), in SI units
        deviation    standard deviation, (result,)
        levels       5, 25, 50, 75, 95 %
        values       percentiles, (result, level)

    A threshold speed that a run has not got below the highest that was looked at counts as infinite: its
    percentiles are right, and it has no mean.
    """

    results: list[str]
    runs: np.ndarray
    mean: np.ndarray
    deviation: np.ndarray
    levels: tuple[int, ...]
    values: np.ndarray


class Share(NamedTuple):
    """A share: of how many runs how many, the share itself, and the ends of its 95 % interval."""

    runs: int
    of: int
    share: float
    low: float
    high: float


class Outcomes(NamedTuple):
    """How the runs of a study ended; its fields:

    runs          their number
    unfinished    those that have not been run yet, or not to their end
    done          those with results
    refused       share that ended without, of all that ended: without an equilibrium, ...
    causes        the same for each cause, the most frequent first; numbers in a reason are #, names ...
    unstable      share of unstable equilibria among those done; None where no result tells
    """

    runs: int
    unfinished: int
    done: int
    refused: Share
    causes: dict[str, Share]
    unstable: Share | None


def percentiles(
    study: Study,
    show: str | Sequence[str] | None = None,
    pad: int | None = None,
    pivot: str | None = None,
    where: Where = None,
) -> Percentiles:
    """Mean, standard deviation and percentiles of results of the runs that were done.

    `show` names them, by default the key results that the study has; `pad` and `pivot` choose as for
    `tiltpad.diagrams.diagram`; `where` keeps the runs with these values of parameters.
    """
    chosen = selected(study, where or {}) & study.done
    if show is None:
        found = key_results(study, pivot)
    else:
        found = [result(study, each, pad, pivot) for each in ([show] if isinstance(show, str) else show)]
    columns = [with_infinite(study, each)[chosen] for each in found]
    columns = [each[~np.isnan(each)] for each in columns]
    with np.errstate(invalid="ignore"):
        means = np.array([each.mean() if len(each) else np.nan for each in columns])
        deviations = np.array([each.std(ddof=1) if len(each) > 1 else np.nan for each in columns])
    values = np.array([quantiles(each, LEVELS) for each in columns]).reshape(len(columns), len(LEVELS))
    names, runs = [each.name for each in found], np.array([len(each) for each in columns])
    return Percentiles(names, runs, np.where(np.isfinite(means), means, np.nan), deviations, LEVELS, values)


def with_infinite(study: Study, own: Result) -> np.ndarray:
    """Values of a result, (run,); a threshold speed that was looked for and is not there is infinite."""
    if own.name != THRESHOLD or SOUGHT not in study:
        return own.values
    return np.where(np.isnan(own.values) & np.isfinite(study[SOUGHT]), np.inf, own.values)


def beyond(study: Study, values: np.ndarray) -> str:
    """The words for a threshold speed that is infinite: it is higher than the highest that was looked at."""
    return f"> {np.nanmax(study[SOUGHT]):.0f}" if np.isinf(values).any() else ""


def quantiles(values: np.ndarray, levels: Sequence[float]) -> np.ndarray:
    """Percentiles of values, which may be infinite, linear between two of them; nan without values."""
    if not len(values):
        return np.full(len(levels), np.nan)
    rising = np.sort(values)
    place = np.asarray(levels) / 100 * (len(values) - 1)
    below = np.floor(place).astype(int)
    low, high = rising[below], rising[np.ceil(place).astype(int)]
    with np.errstate(invalid="ignore"):
        return np.where(np.isinf(high), high, low + (place - below) * (high - low))


def share(count: int, of: int) -> Share:
    """A share with its 95 % interval by Wilson (1927), which holds for few runs and for none.

    E. B. Wilson: Probable inference, the law of succession, and statistical inference. Journal of the
    American Statistical Association 22 (1927) 209-212.
    """
    if of == 0:
        return Share(0, 0, np.nan, 0.0, 1.0)
    own, square = count / of, NORMAL**2
    middle = (own + square / (2 * of)) / (1 + square / of)
    half = NORMAL / (1 + square / of) * np.sqrt(own * (1 - own) / of + square / (2 * of) ** 2)
    low = middle - half if count else 0.0
    high = middle + half if count < of else 1.0
    return Share(int(count), int(of), own, float(low), float(high))


def outcomes(study: Study, pivot: str | None = None, where: Where = None) -> Outcomes:
    """How many runs of a study have no equilibrium or failed otherwise, and why, and how many are unstable.

    Unstable is an equilibrium at which a vibration of journal or shaft grows, also one of the pivots
    `pivot` (by default the first). `where` keeps the runs with these values of parameters.
    """
    chosen = matching(study, where or {})
    status = study.status
    done = chosen & (status == DONE)
    refused = np.flatnonzero(chosen & (np.isin(status, REFUSED) | np.isnan(status)))
    ended = int(done.sum()) + len(refused)
    reasons = study.reason[refused] if len(refused) and "reason" in study else [""] * len(refused)
    causes = Counter(map(cause, reasons)).most_common()
    unstable, runs = instability(study, pivot), int(chosen.sum())
    if unstable is not None:
        known = unstable[done][~np.isnan(unstable[done])]
    shares = {text: share(count, ended) for text, count in causes}
    grows = None if unstable is None else share(int(known.sum()), len(known))
    return Outcomes(runs, runs - ended, int(done.sum()), share(len(refused), ended), shares, grows)


class CommonRemark(NamedTuple):
    """A remark on runs of a study, numbers and names left aside: how many runs, the first, its own words."""

    runs: int
    first: int
    words: str


def common_remarks(study: Study) -> list[CommonRemark]:
    """The remarks on the runs of a study, the most frequent first; empty where there are none."""
    found: dict[str, CommonRemark] = {}
    for number, text in zip(study["run"], study["remarks"], strict=True) if "remarks" in study else ():
        for kind, line in {cause(line): line for line in text.splitlines()}.items():
            known = found.get(kind, CommonRemark(0, int(number), line))
            found[kind] = known._replace(runs=known.runs + 1)
    return sorted(found.values(), key=lambda each: -each.runs)


def instability(study: Study, pivot: str | None) -> np.ndarray | None:
    """1 where journal or shaft is unstable at the equilibrium of a run, 0 where it is stable; nan: not known.

    In studies of older programs pads count, too.
    """
    found = []
    for name in [name for name in ("equilibrium_rotor_stable", "equilibrium_stable") if name in study][:1]:
        found.append(1 - study[name])
    for name in [name for name in ("rotor_damping_ratio", "least_damping_ratio") if name in study][:1]:
        least = result(study, name, pivot=pivot).values
        found.append(np.where(np.isnan(least), np.nan, least < 0))
    return np.fmax.reduce(found) if found else None


def cause(reason: str) -> str:
    """A reason without its numbers and names, so that equal causes are one."""
    text = NUMBERS.sub("#", NAMES.sub("'...'", FILES.sub("...", reason)))
    return " ".join(text.split()) or "no reason recorded"
