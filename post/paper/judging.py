"""What a claim is, and what decides it: one number from the runs, and its limit.

A claim is a function of the runs that returns a Verdict; its docstring says what is measured.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise

from paper.runs import Runs
from paper.settings import RESOLUTION


@dataclass(frozen=True)
class Verdict:
    """The number that decides, and what it must stay below or above."""

    value: float
    sense: str
    limit: float

    @property
    def holds(self) -> bool:
        return self.value < self.limit if self.sense == "<" else self.value > self.limit


@dataclass(frozen=True)
class Claim:
    """A statement of the paper."""

    name: str
    where: str
    statement: str
    measure: str
    judge: Callable[[Runs], Verdict]


class Claims(list[Claim]):
    """Claims in the order of the page."""

    def add(self, where: str, statement: str) -> Callable:
        """A decorator that adds a function; `where` is a figure or section of the paper."""

        def entered(judge: Callable[[Runs], Verdict]) -> Callable[[Runs], Verdict]:
            measure = " ".join(judge.__doc__.split())
            self.append(Claim(judge.__name__, where, statement, measure, judge))
            return judge

        return entered


def below(value: float, limit: float) -> Verdict:
    """What must stay below a limit."""
    return Verdict(value, "<", limit)


def above(value: float, limit: float) -> Verdict:
    """What must stay above a limit."""
    return Verdict(value, ">", limit)


def smaller(value: float) -> Verdict:
    """A ratio clearly below 1."""
    return below(value, 1 - RESOLUTION)


def larger(value: float) -> Verdict:
    """A ratio clearly above 1."""
    return above(value, 1 + RESOLUTION)


def growth(values: Iterable[float]) -> float:
    """Minimum ratio of a value to the one before it."""
    return min(after / before for before, after in pairwise(values))


def fall(values: Iterable[float]) -> float:
    """Maximum ratio of a value to the one before it."""
    return max(after / before for before, after in pairwise(values))


@dataclass(frozen=True)
class Checked:
    """A claim with its verdict from the runs, from the refined ones, and from those by rule (26)."""

    claim: Claim
    verdict: Verdict
    refined: Verdict
    rule: Verdict
