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
    "double_hopf": ("HH", "double Hopf"),
    "fold_hopf": ("ZH", "fold and Hopf"),
    "bogdanov_takens": ("BT", "Bogdanov-Takens"),
    "cusp": ("CP", "cusp"),
    "resonance_1_1": ("R1", "1:1 resonance"),
    "resonance_1_2": ("R2", "1:2 resonance"),
    "generalised_hopf": ("GH", "generalised Hopf"),
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


def stable_sides(run: Run, sizes: np.ndarray) -> np.ndarray:
    """Unit vectors to the stable side of a curve over (second, first) parameter, both over their sizes.

    Of folds it is the side where the two solutions are that meet.
    """
    needs_curve(run)
    places = np.stack([run["second_parameter"], run["parameter"]], axis=1) / sizes
    along = np.gradient(places, run["arc_length"], axis=0)
    normal = np.stack([-along[:, 1], along[:, 0]], axis=1)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    # where the curve runs along the first parameter, its neighbours know better
    towards = run["stable_side"] * normal[:, 1]
    near = np.convolve(towards, np.ones(3), "same")
    return normal * np.sign(np.where(np.abs(towards) < 0.1, near, towards))[:, None]


def multipliers(run: Run) -> np.ndarray:
    """Floquet multipliers along branches, complex, (point, multiplier), those of largest modulus first."""
    needs_branch(run)
    if "multiplier_real" not in run:
        raise not_in_run(run, "multipliers", "its branch is one of equilibria")
    return run["multiplier_real"] + 1j * run["multiplier_imag"]


def needs_branch(run: Run) -> None:
    if not run.is_branch:
        raise not_in_run(run, "branch", f"its task is '{run.task}'")


def needs_one_parameter(run: Run) -> None:
    needs_branch(run)
    if "stable_side" in run:
        raise not_in_run(
            run, "branch over one parameter", "it has a curve over two, which tiltpad-plot chart draws"
        )


def needs_curve(run: Run) -> None:
    why = "branch%of = 'curve' follows one"
    if run.is_branch:
        why = "it has a branch over one, which tiltpad-plot branch draws"
    if not run.is_branch or "stable_side" not in run:
        raise not_in_run(run, "curve over two parameters", why)
