"""The error of a run: one rule for all cases.

A signal that jumps is compared by two numbers. Where the reference changes by more than JUMP of its span
from one sample to the next, on either side, a deviation tells when the signal jumps, not how far it errs:
there the shift in time counts, the deviation over the change per sample. Everywhere else the deviation
counts, over the span.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tiltpad
from tiltpad.calculate.deviations import SIGNALS, STEADY, characteristic_scale

#: Change from sample to sample, over the span, from which a signal jumps: six times that of a sine at the
#: usual 360 samples a revolution.
JUMP = 0.05


@dataclass
class Deviation:
    """Deviation of each signal over its span, apart from jumps; largest shift of a jump, degrees."""

    signals: dict[str, float]
    jump_degrees: float = 0.0

    @property
    def largest(self) -> float:
        return max(self.signals.values())


def deviations(path: Path, reference: Path, whole: bool = False) -> Deviation:
    """Deviations of one result file from another over the last revolution, or over the whole run."""
    with tiltpad.read(path) as run, tiltpad.read(reference) as true:
        if "time" not in true:
            return of_equilibrium(run.equilibrium, true)
        part = slice(0, None) if whole else tiltpad.last_revolutions(true)
        found = Deviation({})
        for name in (name for name in SIGNALS if name in true):
            values, exact = (each.values(name, part).reshape(-1, pads(true, name)) for each in (run, true))
            span = max(float(np.ptp(exact, axis=0).max()), STEADY * characteristic_scale(true, name))
            if span > 0:
                jump, left = compared(values / span, exact / span)
                found.signals[name] = left
                degrees = 360 * jump / true.input["output"]["samples_per_revolution"]
                found.jump_degrees = max(found.jump_degrees, degrees)
        return found


def pads(run: tiltpad.Run, name: str) -> int:
    """Columns of a signal."""
    return 1 if name.startswith("journal") else len(run.input["pads"]["pivot_angle_deg"])


def compared(values: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Largest shift of a jump, in samples, and largest deviation elsewhere; (time, pad), of span 1."""
    change = np.abs(np.diff(exact, axis=0))
    edge = np.zeros_like(exact[:1])
    change = np.maximum(np.concatenate([edge, change]), np.concatenate([change, edge]))
    off, jumps = np.abs(values - exact), change > JUMP
    shift = np.where(jumps, off / np.where(jumps, change, 1), 0)
    return float(shift.max()), float(np.where(jumps, 0, off).max())


def of_equilibrium(found: dict, true: tiltpad.Run) -> Deviation:
    """Deviations of an equilibrium, over 5 % of the characteristic scales."""
    return Deviation(
        {
            name: float(abs(found[name] - true.equilibrium[name]).max())
            / (STEADY * characteristic_scale(true, name))
            for name in ("journal_y", "journal_z", "pad_tilt")
            if name in true.equilibrium
        }
    )
