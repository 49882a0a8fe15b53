"""Table of docs/verification.md on fits: how often their intervals hold the truth.

usage: verify_fits.py TILTPAD [SEEDS]    prints its rows, of any number of fits
"""

import os
import sys
import tempfile

import numpy as np
import tiltpad
from scipy import stats
from verify_runs import CASES, row, run

CASE, TASK = CASES / "steady_lugre_10_10.nml", {"task": "periodic"}
FREE = {
    ("friction%static_coefficient", "friction%dynamic_coefficient"): (0.02, 0.5),
    "friction%bristle_stiffness": (1e4, 1e8),
    "bearing%assembled_clearance": (70e-6, 95e-6),
}
SEEDS, NOISE = 60, 0.01
#: Share of normal errors within two standard deviations, and how surely counts and sums lie in their ranges.
WITHIN, SURE = 0.9545, 0.999


def fits(program, folder, seeds=SEEDS):
    """Rows of the parameters; the errors of all fits over their covariance are chi-squared."""
    os.environ["TILTPAD"] = program
    with run(program, CASE, folder, "case%task=periodic") as found:
        y, z = (each[:-1] for each in tiltpad.orbit(found))
        # the pads are alike
        true = np.array([np.ravel(found.input[group][name])[0] for group, name in map(split, FREE)])
    deviation = NOISE * np.ptp(y)
    errors, deviations, total = [], [], 0.0
    for seed in range(seeds):
        random = np.random.default_rng(seed)
        noisy = {
            name: each + deviation * random.normal(size=each.shape)
            for name, each in (("journal_y", y), ("journal_z", z))
        }
        fit = tiltpad.fit(CASE, tiltpad.Measured(noisy, deviation, {"case": TASK}), FREE)
        errors.append(fit.values - true)
        deviations.append(fit.deviations)
        total += errors[-1] @ np.linalg.inv(fit.covariance) @ errors[-1]
    yield from rows(true, np.array(errors), np.array(deviations), total)


def rows(true, errors, deviations, total):
    """The rows, from errors and deviations, (fit, parameter), and the sum of squares over covariances."""
    fewest, _ = expected(len(errors))
    for k, names in enumerate(FREE):
        inside = (np.abs(errors[:, k]) < 2 * deviations[:, k]).sum()
        spread = np.sqrt((errors[:, k] ** 2).mean())
        numbers = (f"{each / true[k]:.2e}" for each in (deviations[:, k].mean(), spread))
        name = "%".join(split(names))
        if inside < fewest:
            sys.exit(
                f"fits: {name}: {inside} of {len(errors)} within two standard deviations: they are too small"
            )
        yield row(f"`{name}`", f"{true[k]:g}", *numbers, f"{inside} of {len(errors)}")
    freedom = errors.size
    low, high = stats.chi2(freedom).interval(SURE)
    if not low < total < high:
        sys.exit(f"fits: {total:.1f} is no chi-squared of {freedom}: their intervals are wrong")
    yield row("all, with their correlations", "", "", "", f"{total:.0f}, chi-squared of {freedom}")


def expected(seeds=SEEDS):
    """From how many to how many of these fits hold the truth, as surely as SURE."""
    low, high = stats.binom(seeds, WITHIN).interval(SURE)
    return int(low), int(high)


def split(names):
    """Group and name of the first variable of a parameter."""
    return (names if isinstance(names, str) else names[0]).split("%")


TABLES = (fits,)

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        for each in fits(sys.argv[1], place, *map(int, sys.argv[2:])):
            print(each)
