"""Marches a case of an archived run with SciPy's BDF, from the run's first sample to its last.

usage: peer_scipy.py ARCHIVE RESULT.npz --relative R --film-tolerance T (--absolute A | --scaled)
       [--own-jacobian]

RESULT.npz: seconds of the march, right-hand sides, and at the archive's times the state and friction moments.
"""

import argparse
import time

import numpy as np
import tiltpad
from peer_model import STATES, Bearing
from scipy.integrate import solve_ivp

#: Steps of the differences for the Jacobian, over the states' scales.
DIFFERENCE = 1e-4


def first_state(run: tiltpad.Run) -> np.ndarray:
    """The state of the first sample."""
    journal = [run[name][0] for name in ("journal_y", "journal_z", "journal_vy", "journal_vz")]
    names = ("pad_tilt", "pad_tilt_rate", "pivot_deflection", "pivot_deflection_rate", "bristle_deflection")
    return np.concatenate([journal, np.column_stack([run[name][0] for name in names]).ravel()])


def marched(bearing: Bearing, first: np.ndarray, times: np.ndarray, scales: np.ndarray, options) -> dict:
    """The solution at the times, and its cost."""
    evaluations = 0

    def rates(t, y):
        nonlocal evaluations
        evaluations += 1
        return bearing(t, y)

    def jacobian(t, y):
        now, columns = rates(t, y), []
        for i in range(len(y)):
            moved = y.copy()
            moved[i] += DIFFERENCE * scales[i]
            columns.append((rates(t, moved) - now) / (moved[i] - y[i]))
        return np.column_stack(columns)

    absolute = options.relative * scales if options.scaled else options.absolute
    started = time.perf_counter()
    found = solve_ivp(
        rates, (0, times[-1]), first, method="BDF", t_eval=times, rtol=options.relative, atol=absolute,
        jac=jacobian if options.own_jacobian else None,
    )  # fmt: skip
    seconds = time.perf_counter() - started
    if not found.success:
        raise SystemExit(found.message)
    moments = []
    for t, y in zip(found.t, found.y.T, strict=True):
        bearing(t, y)
        moments.append(bearing.moments.copy())
    return {
        "seconds": seconds,
        "evaluations": evaluations,
        "journal_y": found.y[0],
        "journal_z": found.y[1],
        "pad_tilt": found.y[4::STATES].T,
        "friction_moment": np.array(moments),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("archive")
    parser.add_argument("result")
    parser.add_argument("--relative", type=float, required=True)
    parser.add_argument("--film-tolerance", type=float, required=True)
    parser.add_argument("--absolute", type=float)
    parser.add_argument("--scaled", action="store_true")
    parser.add_argument("--own-jacobian", action="store_true")
    options = parser.parse_args()
    with tiltpad.read(options.archive) as run:
        bearing = Bearing(run.input, options.film_tolerance)
        first, times = first_state(run), run.time
        scales = bearing.scales(run.clearance, run.pivot_deflection[0].max())
    # compiles, and gives the film its first field
    bearing(0.0, first)
    np.savez(options.result, **marched(bearing, first, times, scales, options))


main()
