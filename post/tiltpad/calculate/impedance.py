"""Stiffness and damping as a test rig identifies them: from the vibration under forces on the journal."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from tiltpad.calculate.coefficients import Coefficients
from tiltpad.calculate.rotation import sense
from tiltpad.calculate.signals import last_revolutions, needs_revolutions
from tiltpad.files.archive import NotInRunError, not_in_run
from tiltpad.files.read import Run, needs_run

#: Most revolutions of the shaft in which an excitation repeats, as in the task periodic.
MOST_REVOLUTIONS = 100
#: Sine of the angle between two motions below which they do not tell one column from the other.
INDEPENDENT = 1e-3


def impedance(runs: Sequence[Run]) -> Coefficients:
    """Stiffness and damping of a bearing at the frequency of an excitation, identified from two runs.

    The runs are of one case under two independent harmonic excitations of one frequency, such as two
    directions or a forward and a backward force: periodic orbits, or marches that have become periodic. Of
    the journal's displacement X and of the excitation F, complex amplitudes at this frequency w, both have

        (K + i w C) X = F + F_unbalance + w^2 m X

    with the mass m of the journal. The result has one frequency and the pivot "identified". With friction
    K and C depend on the amplitude. Without it a small force gives those of the task coefficients within 1e-4
    of their largest element if film%table_tolerance is 1e-6; default tables add up to 2e-4. Raises ValueError
    where runs do not fit each other, and NotInRunError where a run has no harmonic excitation.
    """
    if len(runs) != 2:
        raise ValueError(f"{len(runs)} runs: two are needed, with independent excitations")
    for run in runs:
        needs_run(run)
    ratio, *others = (frequency_ratio(run) for run in runs)
    speed, *speeds = (run.input["operation"]["speed_rpm"] for run in runs)
    if not np.allclose([*others, *speeds], [ratio, speed], rtol=1e-9):
        raise ValueError("the runs have different frequencies or speeds")
    frequency = ratio * speed * np.pi / 30
    found = [amplitudes(run, ratio) for run in runs]
    motion, force = (np.column_stack(each) for each in zip(*found, strict=True))
    if not abs(np.linalg.det(motion)) > INDEPENDENT * np.prod(np.linalg.norm(motion, axis=0)):
        raise ValueError("the motions of the two runs are not independent; excite in two directions")
    dynamic = force @ np.linalg.inv(motion)
    stiffness, damping = dynamic.real[None], dynamic.imag[None] / frequency
    return Coefficients("identified", np.asarray(speed, float), np.array([ratio]), stiffness, damping, {})


def frequency_ratio(run: Run) -> float:
    """Frequency of the harmonic excitation of a run over the speed of the shaft."""
    given: Any = [] if run.is_machine else run.input.get("excitation", [])
    kinds = {each.get("kind") for each in given}
    if kinds != {"harmonic"} or "journal_y" not in run or "excitation_y" not in run:
        raise NotInRunError(f"{run.path}: no harmonic excitation of a journal in this run")
    speed = run.input["operation"]["speed_rpm"]
    if speed != run.input["operation"]["final_speed_rpm"]:
        raise not_in_run(run, "constant frequency", "the speed changes")
    ratios = [each.get("frequency_ratio", 60 * each.get("frequency_hz", np.nan) / speed) for each in given]
    if not np.allclose(ratios, ratios[0], rtol=1e-9):
        raise NotInRunError(f"{run.path}: the excitations of this run have different frequencies")
    return float(ratios[0])


def amplitudes(run: Run, ratio: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacement of the journal, m, and force of its bearing on what moves it, N: (y, z), complex.

    Of the last revolutions of the shaft in which the excitation repeats. The values over the time are the
    real parts of these times exp(i w t), their means, and vibrations of other frequencies.
    """
    revolutions = Fraction(ratio).limit_denominator(MOST_REVOLUTIONS).denominator
    needs_revolutions(run, "period of the excitation", revolutions)
    part = last_revolutions(run, revolutions)
    frequency = ratio * run.input["operation"]["speed_rpm"] * np.pi / 30
    turning = 2 * np.exp(-1j * frequency * run.values("time", part)[:-1])
    motion = np.array([np.mean(turning * run.values(f"journal_{axis}", part)[:-1]) for axis in "yz"])
    given = [run.values(f"excitation_{axis}", part)[:-1].sum(axis=1) for axis in "yz"]
    force = np.array([np.mean(turning * each) for each in given])
    if ratio == 1:
        force = force + unbalance(run) * np.array([1, -1j * sense(run.input)])
    return motion, force + run.input["rotor"]["mass"] * frequency**2 * motion


def unbalance(run: Run) -> float:
    """Force of the unbalance of a run, N."""
    rotor, speed = run.input["rotor"], run.input["operation"]["speed_rpm"]
    if "balance_grade" in rotor:
        needed = "give rotor%unbalance at the speed of the shaft"
        raise NotInRunError(f"{run.path}: rotor%balance_grade: {needed}")
    return float(rotor["unbalance"] * (speed * np.pi / 30) ** 2)
