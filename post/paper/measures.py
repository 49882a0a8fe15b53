"""Numbers that are measured in the runs, over the last revolutions unless a part is given."""

import numpy as np
import tiltpad
from tiltpad import Run

from paper.settings import LAST, PAD


def size(run: Run) -> float:
    """Size of the orbit: the mean of its peak-to-peaks in y and z, m."""
    return float(np.mean(tiltpad.orbit_size(run, LAST)))


def height(run: Run) -> float:
    """Mean height y of the journal, m."""
    return float(tiltpad.orbit(run, LAST)[0].mean())


def peak_to_peak(run: Run, name: str) -> float:
    """Peak-to-peak of a dataset of the first pad."""
    return float(np.ptp(of_pad(run, name, tiltpad.last_revolutions(run, LAST))))


def of_pad(run: Run, name: str, part: slice) -> np.ndarray:
    """The samples `part` of a dataset of the first pad, (time,)."""
    return run.values(name, part)[:, PAD - 1]


def sticking(run: Run) -> float:
    """Time for which the first pad is slower than tiltpad calls sticking, over the time for which a
    sinusoid of the same amplitude is: 1 where the pad swings freely, more where it comes to rest.
    """
    velocity = np.abs(tiltpad.sliding_velocity(run, PAD, LAST)).max()
    harmonic = 2 / np.pi * np.arcsin(min(1.0, tiltpad.stick_velocity(run) / velocity))
    return tiltpad.stick_fraction(run, PAD, LAST) / harmonic


def static_coefficient(run: Run) -> float:
    """f_s, of all pivots alike."""
    return float(np.max(run.input["friction"]["static_coefficient"]))


def breakaway(run: Run) -> float:
    """Largest part of the static friction that either pad's pivot uses; a pivot that stays below 1 never
    slides.
    """
    parts = [tiltpad.friction_coefficient(run, pad, LAST)[1] for pad in (1, 2)]
    return float(np.nanmax(np.abs(parts)) / static_coefficient(run))


def distance(run: Run, other: Run, part: slice | None = None) -> float:
    """Maximum distance of the journal's paths at the same shaft angle, over the orbit's size in `other`."""
    part = tiltpad.last_revolutions(other, LAST) if part is None else part
    gap, sizes = [], []
    for name in ("journal_y", "journal_z"):
        gap.append(run.values(name, part) - other.values(name, part))
        sizes.append(np.ptp(other.values(name, part)))
    return float(np.hypot(*gap).max() / np.mean(sizes))


def rms_deviation(run: Run, other: Run, name: str) -> float:
    """Root mean square of the deviation of a signal of the first pad, over that of `other`."""
    part = tiltpad.last_revolutions(other, LAST)
    values, true = of_pad(run, name, part), of_pad(other, name, part)
    return float(np.sqrt(np.mean((values - true) ** 2) / np.mean((true - true.mean()) ** 2)))


def acceleration(run: Run) -> float:
    """Highest angular acceleration of the first pad between two samples, rad/s^2."""
    part = tiltpad.last_revolutions(run, LAST)
    steps = np.diff(of_pad(run, "pad_tilt_rate", part)) / np.diff(run.values("time", part))
    return float(np.abs(steps).max())


def stribeck_curve(run: Run, velocity: np.ndarray) -> np.ndarray:
    """Friction coefficient of the steady law at sliding velocities: (22), or (25)."""
    law, speed = run.input["friction"], np.abs(velocity)
    static, dynamic = (np.max(law[name]) for name in ("static_coefficient", "dynamic_coefficient"))
    if law["model"] == "lugre":
        exponent = -((speed / law["stribeck_velocity"]) ** law["stribeck_exponent"])
        return (dynamic + (static - dynamic) * np.exp(exponent)) * np.sign(velocity)
    critical = law["critical_velocity"]
    rising = static - static * (speed / critical - 1) ** 2
    falling = dynamic + (static - dynamic) * np.exp(-law["decay"] * np.maximum(0, speed - critical))
    return np.where(speed < critical, rising, falling) * np.sign(velocity)


def off_curve(run: Run) -> float:
    """Maximum distance of the friction coefficient of the first pad from the steady law, over f_s."""
    velocity, coefficient = tiltpad.friction_coefficient(run, PAD, LAST)
    gap = np.abs(coefficient - stribeck_curve(run, velocity)).max()
    return float(gap) / static_coefficient(run)


def loop_width(run: Run) -> float:
    """Maximum difference of the friction coefficient at the same sliding velocity, speeding up and slowing
    down, over f_s; of the first pad, both directions of sliding, from the stick velocity to 95 % of the
    maximum.
    """
    velocity, coefficient = tiltpad.friction_coefficient(run, PAD, 1)
    widest = 0.0
    for sense in (1, -1):
        speed, share = sense * velocity, sense * coefficient
        top = int(np.argmax(speed))
        speed, share = np.roll(speed[:-1], -top), np.roll(share[:-1], -top)
        slow = np.flatnonzero(speed <= tiltpad.stick_velocity(run))
        if not len(slow):
            continue
        levels = np.linspace(tiltpad.stick_velocity(run), 0.95 * speed.max(), 200)
        falling = np.interp(levels, speed[: slow[0] + 1][::-1], share[: slow[0] + 1][::-1])
        rising = np.interp(levels, speed[slow[-1] :], share[slow[-1] :])
        widest = max(widest, float(np.abs(rising - falling).max()))
    return widest / static_coefficient(run)


def speed_window(run: Run, rpm: float, turns: float) -> slice:
    """Samples of the revolutions from the instant at which a run-up reaches a speed; the last ones at its
    end.
    """
    speed = run.values("speed") * 30 / np.pi
    angle = run.shaft_angle
    if rpm >= speed[-1]:
        return tiltpad.last_revolutions(run, turns)
    start = int(np.searchsorted(speed, rpm))
    return slice(start, int(np.searchsorted(angle, angle[start] + 2 * np.pi * turns)) + 1)
