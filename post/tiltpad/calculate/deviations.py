"""The deviation of a run from a more accurate one.

docs/benchmarks.md and docs/verification.md quote it as the error.
"""

import numpy as np

from tiltpad.calculate.signals import last_revolutions
from tiltpad.files.archive import RunError
from tiltpad.files.namelist import of_pads
from tiltpad.files.read import Run

#: Journal orbit, pad tilts and friction moments.
SIGNALS = ("journal_y", "journal_z", "pad_tilt", "friction_moment")
#: The deviation of a signal that hardly moves is taken over this share of its characteristic scale.
STEADY = 0.05


def characteristic_scale(run: Run, name: str) -> float:
    """Bearing clearance for journal positions, clearance over pad radius for tilts, and for friction moments
    that at which the pivot with the highest load of the last revolution slides; 0 for others.
    """
    case = run.in_operation
    if name == "friction_moment" and case["friction"]["model"] != "none":
        ball = np.subtract(of_pads(case, "pivot%socket_radius"), of_pads(case, "pivot%radius_difference"))
        load = run.values("pivot_load", last_revolutions(run)).max(axis=0)
        return float((of_pads(case, "friction%static_coefficient") * ball * load).max())
    radius = case["bearing"]["journal_radius"] + min(of_pads(case, "bearing%machined_clearance"))
    return {"journal": run.clearance, "pad": run.clearance / radius}.get(name.split("_")[0], 0.0)


def deviation(values: np.ndarray, true: np.ndarray, scale: float = 0.0) -> float | None:
    """Largest deviation of a signal, (time,) or (time, pad), from the true one, over the peak-to-peak of the
    latter (of the pad that moves most), or over 5 % of its characteristic scale where it moves less; None
    where there is neither.
    """
    span = max(float(np.ptp(true, axis=0).max()), STEADY * scale)
    return float(np.abs(values - true).max()) / span if span > 0 else None


def deviations(run: Run, reference: Run, part: slice | None = None) -> dict[str, float]:
    """The deviation of each of SIGNALS from a reference run of the same case, over the samples `part` of the
    reference (default: its last revolution). A signal that the reference does not have, as the tilts of
    fixed pads, or without a scale, as the friction moment of a run without friction, is left out.
    """
    part = last_revolutions(reference) if part is None else part
    found = {}
    for name in (name for name in SIGNALS if name in reference):
        values, true = run.values(name, part), reference.values(name, part)
        if values.shape != true.shape:
            both = f"{run.path} and {reference.path}"
            raise RunError(f"{both}: not the same samples, {name} cannot be compared")
        found[name] = deviation(values, true, characteristic_scale(reference, name))
    return {name: value for name, value in found.items() if value is not None}
