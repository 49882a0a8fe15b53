"""Friction of the pivots, on made signals whose answer is known and on real runs."""

import numpy as np
import pytest
import tiltpad
from tiltpad.calculate import pivots

R1 = 13e-3 - 15e-6


def test_sliding_velocity_is_that_of_the_ball(run):
    case = run("lugre")
    velocity = tiltpad.sliding_velocity(case, 2, 2)
    np.testing.assert_allclose(velocity, R1 * case.pad_tilt_rate[-721:, 1], rtol=1e-14)


def test_bengisu_akay_lies_on_its_stribeck_curve(run):
    case = run("bengisu")
    velocity, coefficient = tiltpad.friction_coefficient(case, 1, 3)
    v, v_c = np.abs(velocity), 1e-5
    curve = np.where(v < v_c, 0.1 * (1 - (v / v_c - 1) ** 2), 0.05 + 0.05 * np.exp(-1000 * (v - v_c)))
    assert (v < v_c).any()
    assert (v > 10 * v_c).any()
    np.testing.assert_allclose(coefficient, np.sign(velocity) * curve, atol=1e-12)


def test_lugre_is_a_loop_around_the_stribeck_curve(run):
    velocity, coefficient = tiltpad.friction_coefficient(run("lugre"), 1, 1)
    assert tiltpad.loop_area(velocity, coefficient) ** 2 > 1e-12
    assert 0.05 < np.abs(coefficient).max() < 0.15


def test_a_pivot_that_carries_nothing_has_no_coefficient(made):
    def force(time, angle):
        return np.stack([1e3 * (time > 0.05), 1e3 + 0 * time], axis=1)

    case = made("bengisu", 0.1, pivot_load=force, friction_moment=2.0)
    coefficient = tiltpad.friction_coefficient(case, 1, 100)[1]
    np.testing.assert_array_equal(np.isnan(coefficient), case.time <= 0.05)
    assert coefficient[-1] == pytest.approx(2 / (1e3 * R1))


@pytest.mark.parametrize("case_name", ["lugre", "bengisu", "four", "runup"])
def test_friction_work_is_the_integral_of_moment_over_tilt(run, case_name):
    case = run(case_name)
    for pad in (1, 2):
        tilt, moment = tiltpad.hysteresis(case, pad, 2)
        work = sum(np.diff(tilt) * (moment[1:] + moment[:-1]) / 2)
        turns = np.ptp(case.shaft_angle[tiltpad.last_revolutions(case, 2)]) / (2 * np.pi)
        assert tiltpad.friction_work(case, pad, 2) == pytest.approx(work / turns, rel=1e-12)
        time = case.time[tiltpad.last_revolutions(case, 2)]
        assert tiltpad.friction_power(case, pad, 2) == pytest.approx(work / np.ptp(time), rel=1e-12)


def test_friction_work_of_a_closed_loop_is_its_area(run):
    """The last revolution of a steady run closes but for a little."""
    case = run("bengisu")
    area = tiltpad.loop_area(*tiltpad.hysteresis(case, 1))
    assert tiltpad.friction_work(case, 1) == pytest.approx(area, rel=2e-3)
    power = tiltpad.friction_power(case, 1)
    assert power == pytest.approx(tiltpad.friction_work(case, 1) * 6500 / 60, rel=1e-9)


def test_friction_work_of_an_ellipse(made):
    """Tilt A sin, moment B cos: pi A B a revolution."""
    case = made(
        "lugre",
        0.1,
        interval=1e-5,
        pad_tilt=lambda time, angle: np.stack([2e-4 * np.sin(angle), 0 * time], axis=1),
        friction_moment=lambda time, angle: np.stack([3 * np.cos(angle), 1 + 0 * time], axis=1),
    )
    assert tiltpad.friction_work(case, 1, 5) == pytest.approx(np.pi * 2e-4 * 3, rel=1e-3)
    assert tiltpad.friction_work(case, 2, 5) == 0
    with pytest.raises(tiltpad.NotInRunError, match="it has 0.217 shaft revolutions, and 1 are needed"):
        tiltpad.friction_work(made("lugre", 0.002), 1)


def test_stick_velocity(run):
    assert tiltpad.stick_velocity(run("lugre")) == pytest.approx(5e-5)
    assert tiltpad.stick_velocity(run("bengisu")) == pytest.approx(5e-5)


@pytest.mark.parametrize("interval", [1e-5, 7e-5, 3e-4])
def test_stick_intervals_do_not_hang_on_the_sampling(made, interval):
    """A velocity of straight lines: up to 1e-3 m/s, down to -1e-3, at rest for half the time."""
    period = 4e-2

    def rate(time, angle):
        corners = np.array([0, 0.1, 0.2, 0.3, 0.4, 0.5, 1]) * period
        heights = np.array([0, 1, 0, 0, -1, 0, 0]) * 1e-3 / R1
        one = np.interp(np.mod(time, period), corners, heights)
        return np.stack([one, 0 * one + 1e-3 / R1], axis=1)

    case = made("lugre", 0.2, interval=interval, pad_tilt_rate=rate)
    # at rest 0.1 + 0.5 of a period, and 5 % of each of the four lines
    assert tiltpad.stick_fraction(case, 1, 100) == pytest.approx(0.6 + 4 * 0.05 * 0.1, abs=3e-3)
    assert tiltpad.stick_fraction(case, 2, 100) == 0
    intervals = tiltpad.stick_intervals(case, 1, 100)
    assert intervals[0, 0] == 0
    assert len(intervals) == 11
    expected = (np.array([0.2, 0.3, 0.5, 1]) + [-0.005, 0.005, -0.005, 0.005]) * period
    np.testing.assert_allclose(intervals[1:3].ravel(), expected, atol=interval)
    share = tiltpad.sticking(case, 1, 100).mean()
    assert share == pytest.approx(0.62, abs=0.02)
    assert tiltpad.stick_fraction(case, 1, 100, below=2e-3) == pytest.approx(1)
    assert tiltpad.stick_intervals(case, 2, 100).shape == (0, 2)


def test_a_quick_turn_is_seen_between_samples():
    time, velocity = np.array([0.0, 1.0, 2.0]), np.array([-10.0, 10.0, 10.0])
    np.testing.assert_allclose(pivots.slow_intervals(time, velocity, 1), [[0.45, 0.55]])
    np.testing.assert_allclose(pivots.slow_intervals(time, 0 * velocity, 1), [[0, 2]])
    np.testing.assert_allclose(pivots.slow_intervals(time, np.array([5.0, 0.0, 5.0]), 1), [[0.8, 1.2]])


def test_stiff_bristles_and_small_critical_velocities_stick_more(run):
    """Bengisu-Akay with v_c far below the stick velocity sticks longest, LuGre creeps on its bristles."""
    assert tiltpad.stick_fraction(run("bengisu")) > tiltpad.stick_fraction(run("lugre")) > 0.1


@pytest.mark.parametrize(
    "calculate",
    [
        tiltpad.friction_coefficient,
        tiltpad.friction_work,
        tiltpad.friction_power,
        tiltpad.sticking,
        tiltpad.stick_intervals,
        tiltpad.stick_fraction,
        tiltpad.stick_velocity,
    ],
)
def test_without_friction_there_is_nothing_of_it(run, calculate):
    with pytest.raises(tiltpad.NotInRunError, match="no friction in this run: friction model is 'none'"):
        calculate(run("none"))
    assert tiltpad.sliding_velocity(run("none"), 1).shape == (361,)
