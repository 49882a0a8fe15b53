"""Branches of equilibria or orbits over a parameter: stable and unstable parts, bifurcation points."""

from typing import NamedTuple

import numpy as np

from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Run

#: Kinds of bifurcation points: letters in a picture, and words.
KINDS = {
    "fold": ("LP", "fold"),
    "period_doubling": ("PD", "period doubling"),
    "neimark_sacker": ("NS", "torus bifurcation"),
    "hopf": ("HB", "Hopf"),
    "branch_point": ("BP", "branch point"),
    "divergence": ("DV", "divergence"),
}


class Stretch(NamedTuple):
    """A part of a branch whose stability stays the same: number of the branch, whether stable, its points."""

    branch: int
    stable: bool
    points: np.ndarray


class SpecialPoint(NamedTuple):
    """Where a branch turns or its stability changes.

    Its kind, branch, index among the points, value of the parameter, and the multiplier or eigenvalue that
    crosses (1/s).
    """

    kind: str
    branch: int
    point: int
    parameter: float
    value: complex

    @property
    def letters(self) -> str:
        return KINDS.get(self.kind, (self.kind, ""))[0]


def stretches(run: Run) -> list[Stretch]:
    """The stable and unstable parts of all branches in their order; neighbours share a point."""
    needs_branch(run)
    number, stable = run["branch"], run["stable"] > 0
    # the last point before a change belongs to neither
    special = np.zeros(len(number), bool)
    special[[each.point for each in bifurcations(run)]] = True
    found = []
    for branch in np.unique(number):
        own = np.flatnonzero(number == branch)
        is_stable = (stable | special)[own]
        pieces = is_stable[:-1] & is_stable[1:] & (stable[own][:-1] | stable[own][1:])
        ends = np.flatnonzero(np.diff(pieces)) + 1
        for first, after in zip([0, *ends], [*ends, len(pieces)], strict=True):
            if len(own) > 1:
                found.append(Stretch(int(branch), bool(pieces[first]), own[first : after + 1]))
    return found


def bifurcations(run: Run) -> list[SpecialPoint]:
    """Folds, period doublings, Hopf points, ... in the order of the points."""
    needs_branch(run)
    if "bifurcations" not in run:
        return []
    own = run["bifurcations"]
    value = own["value_real"] + 1j * own["value_imag"]
    places = zip(own["kind"], own["branch"], own["point"], own["parameter"], value, strict=True)
    return [
        SpecialPoint(str(kind), int(branch), int(point) - 1, float(parameter), complex(each))
        for kind, branch, point, parameter, each in places
    ]


def multipliers(run: Run) -> np.ndarray:
    """Floquet multipliers along branches, complex, (point, multiplier), those of largest modulus first."""
    needs_branch(run)
    if "multiplier_real" not in run:
        raise not_in_run(run, "multipliers", "its branch is one of equilibria")
    return run["multiplier_real"] + 1j * run["multiplier_imag"]


def needs_branch(run: Run) -> None:
    if not run.is_branch:
        raise not_in_run(run, "branch", f"its task is '{run.task}'")
