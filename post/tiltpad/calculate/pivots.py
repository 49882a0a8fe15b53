"""Friction of the pivots: sliding, sticking, work.

Everything is in SI units; `last` is a number of shaft revolutions at the end of the run, by default one, of a
periodic orbit its period; `pad` is 1, 2, ...
Without friction in the case all but `sliding_velocity` raise NotInRunError.
"""

import numpy as np

from tiltpad.calculate.signals import last_revolutions, lasted, needs_revolutions, pad_column, series, turned
from tiltpad.files.archive import not_in_run
from tiltpad.files.namelist import of_pads
from tiltpad.files.read import Run


def ball_radius(run: Run, pad: int = 1) -> float:
    """R1 of a pad's pivot, m: socket radius less the radius difference."""
    radius, difference = (
        of_pads(run.input, f"pivot%{name}") for name in ("socket_radius", "radius_difference")
    )
    column = pad_column(run, pad)
    return radius[column] - difference[column]


def friction_model(run: Run) -> str:
    """'bengisu_akay' or 'lugre'. Raises NotInRunError where there is no friction."""
    model = run.input["friction"]["model"]
    if model == "none":
        raise not_in_run(run, "friction", "friction model is 'none'")
    return model


def hysteresis(run: Run, pad: int = 1, last: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Tilt, rad, and friction moment, N m, of a pad over the last revolutions, each (time,)."""
    friction_model(run)
    part = last_revolutions(run, last)
    return series(run, "pad_tilt", part, pad), series(run, "friction_moment", part, pad)


def loop_area(x: np.ndarray, y: np.ndarray) -> float:
    """Area of the closed loop through the points, positive when it runs clockwise.

    For friction moment over tilt it is the work that the loop dissipates, J.
    """
    return path_integral(np.append(x, x[0]), np.append(y, y[0]))


def path_integral(x: np.ndarray, y: np.ndarray) -> float:
    """Integral of y over x along the path through the points (trapezoidal rule)."""
    return float(0.5 * np.sum(np.diff(x) * (y[1:] + y[:-1])))


def friction_work(run: Run, pad: int = 1, last: float | None = None) -> float:
    """Mean work that friction in the pivot of a pad dissipates in each of the last revolutions, J.

    It is the integral of the friction moment over the tilt. At least one revolution is needed.
    """
    tilt, moment = hysteresis(run, pad, last)
    needs_revolutions(run, "friction work per revolution")
    return path_integral(tilt, moment) / turned(run, last_revolutions(run, last))


def friction_power(run: Run, pad: int = 1, last: float | None = None) -> float:
    """Mean power that friction in the pivot of a pad dissipates over the last revolutions, W."""
    return path_integral(*hysteresis(run, pad, last)) / lasted(run, last_revolutions(run, last))


def sliding_velocity(run: Run, pad: int = 1, last: float | None = None) -> np.ndarray:
    """Velocity of the ball's surface in the socket, eq (21): R1 times the tilt rate, (time,), m/s."""
    return ball_radius(run, pad) * series(run, "pad_tilt_rate", last_revolutions(run, last), pad)


def friction_coefficient(run: Run, pad: int = 1, last: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Sliding velocity, m/s, and friction coefficient of a pivot, each (time,).

    The coefficient is the friction moment over pivot load and R1, with the sign of the moment; nan where
    the pivot carries no load.
    """
    moment, part = hysteresis(run, pad, last)[1], last_revolutions(run, last)
    limit = ball_radius(run, pad) * series(run, "pivot_load", part, pad)
    coefficient = np.divide(moment, limit, out=np.full_like(moment, np.nan), where=limit > 0)
    return sliding_velocity(run, pad, last), coefficient


def stick_velocity(run: Run) -> float:
    """Sliding velocity below which a pivot counts as sticking, m/s.

    It is 5 % of the velocity over which friction falls from static to dynamic: v_s of LuGre, 1/chi of
    Bengisu-Akay (v_c where chi is 0). The values of the paper give 5e-5 m/s for both. It is not v_c, which
    only smooths the law, and not a share of the motion, which a pad at rest would have too.
    """
    friction_model(run)
    return float(run["summary/stick_velocity"])


def sticking(run: Run, pad: int = 1, last: float | None = None, below: float | None = None) -> np.ndarray:
    """True in the samples where a pivot sticks, (time,): it slides slower than `below`, m/s.

    Without `below` the limit is stick_velocity(run).
    """
    limit = stick_velocity(run) if below is None else below
    return np.abs(sliding_velocity(run, pad, last)) < limit


def stick_intervals(
    run: Run, pad: int = 1, last: float | None = None, below: float | None = None
) -> np.ndarray:
    """Times between which a pivot sticks, (k, 2), s, cut off at the ends of the last revolutions.

    Between samples the velocity is a straight line, so that the times do not depend on the sampling: a pad
    that only changes its direction has a short interval too. `below` as in sticking.
    """
    limit = stick_velocity(run) if below is None else below
    time = run.values("time", last_revolutions(run, last))
    return slow_intervals(time, sliding_velocity(run, pad, last), limit)


def slow_intervals(time: np.ndarray, velocity: np.ndarray, limit: float) -> np.ndarray:
    """Times between which a velocity (time,), straight between samples, stays within +-limit: (k, 2)."""
    start, stop = velocity[:-1], velocity[1:]
    with np.errstate(divide="ignore", invalid="ignore"):
        # the straight line from 0 to 1 meets the two limits here; a constant velocity is slow always or never
        meets = (np.array([[-limit], [limit]]) - start) / (stop - start)
    low, high = np.clip(np.sort(meets, axis=0), 0, 1)
    constant = start == stop
    low = np.where(constant, 0.0, low)
    high = np.where(constant, np.where(np.abs(start) < limit, 1.0, 0.0), high)
    slow = high > low
    step = np.diff(time)
    begin, end = time[:-1] + low * step, time[:-1] + high * step
    # an interval continues where a line ends slow and the next one begins slow
    goes_on = slow[:-1] & slow[1:] & (high[:-1] == 1) & (low[1:] == 0)
    first = slow & ~np.append(False, goes_on)
    final = slow & ~np.append(goes_on, False)
    return np.column_stack([begin[first], end[final]])


def stick_fraction(run: Run, pad: int = 1, last: float | None = None, below: float | None = None) -> float:
    """Share of the time of the last revolutions in which a pivot sticks; `below` as in sticking."""
    duration = lasted(run, last_revolutions(run, last))
    return float(np.diff(stick_intervals(run, pad, last, below)).sum() / duration)
