"""Numbers in the file against each other: kinematics, Newton's law, friction bounds, spectra."""

import numpy as np
import pytest
from tiltpad.calculate.pivots import ball_radius

RPM = np.pi / 30
MARCHED = ["lugre", "bengisu", "none", "tilting", "fixed", "four", "runup"]


@pytest.mark.parametrize("case_name", MARCHED)
def test_samples_are_360_a_revolution_of_the_highest_speed(run, case_name):
    time = run(case_name).time
    duration = run(case_name).input["operation"]["duration"]
    step = 2 * np.pi / (6500 * RPM * 360)
    np.testing.assert_allclose(time, step * np.arange(len(time)), rtol=1e-13)
    assert duration - step < time[-1] <= duration * (1 + 1e-12)


def test_shaft_angle_is_the_integral_of_the_speed(run):
    for case_name, ends in (("lugre", (6500, 6500)), ("runup", (1500, 6500))):
        time, speed, angle = (run(case_name)[name] for name in ("time", "speed", "shaft_angle"))
        duration = run(case_name).input["operation"]["duration"]
        expected = RPM * (ends[0] + (ends[1] - ends[0]) * time / duration)
        np.testing.assert_allclose(speed, expected, rtol=1e-13)
        # the trapezoidal rule is exact for a speed that is linear in time
        integral = np.concatenate([[0], np.cumsum(np.diff(time) * (speed[1:] + speed[:-1]) / 2)])
        np.testing.assert_allclose(angle, integral, rtol=1e-11)


@pytest.mark.parametrize("case_name", MARCHED)
def test_positions_are_integrals_of_rates(run, case_name):
    case = run(case_name)
    rates = {"journal_y": "journal_vy", "journal_z": "journal_vz"}
    rates |= {name: f"{name}_rate" for name in ("pad_tilt", "pivot_deflection") if name in case}
    for name, rate in rates.items():
        steps = (
            np.diff(case.time)[:, None] * (case[rate][1:] + case[rate][:-1]).reshape(case.samples - 1, -1) / 2
        )
        moved = (case[name][1:] - case[name][0]).reshape(steps.shape)
        np.testing.assert_allclose(
            np.cumsum(steps, axis=0), moved, atol=2e-3 * np.ptp(case[name]), err_msg=name
        )


@pytest.mark.parametrize("case_name", MARCHED)
def test_a_run_starts_at_rest_in_its_equilibrium(run, case_name):
    case = run(case_name)
    tilting = case_name != "fixed"
    for name in ("journal_y", "journal_z", *(["pad_tilt"] if tilting else [])):
        np.testing.assert_array_equal(case[name][0], case.equilibrium[name])
    assert case.journal_vy[0] == case.journal_vz[0] == 0
    assert not tilting or not case.pad_tilt_rate[0].any()
    assert case.equilibrium["residual"] < 1e-6


@pytest.mark.parametrize("case_name", MARCHED)
def test_newton_s_law_of_the_journal(run, case_name):
    """Mass times acceleration is film forces, weight and unbalance: the signs of the pad frames and all."""
    case = run(case_name)
    rotor = case.input["rotor"]
    angle = case.pivot_angle - (0 if case_name == "fixed" else case.pad_tilt)
    tangential, radial = case.film_force_tangential, case.film_force_radial
    film_y = (tangential * np.cos(angle) + radial * np.sin(angle)).sum(axis=1)
    film_z = (-tangential * np.sin(angle) + radial * np.cos(angle)).sum(axis=1)
    operation = case.input["operation"]
    rise = RPM * (operation["final_speed_rpm"] - operation["speed_rpm"]) / operation["duration"]
    cos, sin = np.cos(case.shaft_angle), np.sin(case.shaft_angle)
    unbalance_y = rotor["unbalance"] * (case.speed**2 * cos + rise * sin)
    unbalance_z = rotor["unbalance"] * (case.speed**2 * sin - rise * cos)
    weight = rotor["mass"] * rotor["gravity"]
    for force, velocity in (
        (film_y + unbalance_y - weight, case.journal_vy),
        (film_z + unbalance_z, case.journal_vz),
    ):
        acceleration = np.gradient(velocity, case.time)[1:-1]
        np.testing.assert_allclose(rotor["mass"] * acceleration, force[1:-1], atol=2e-3 * weight)


@pytest.mark.parametrize("case_name", [case_name for case_name in MARCHED if case_name != "fixed"])
def test_contact_carries_the_load(run, case_name):
    case = run(case_name)
    rotor, pads = case.input["rotor"], case.input["pads"]
    force = case.equilibrium["pivot_load"]
    load = rotor["gravity"] * (rotor["mass"] + np.sum(np.asarray(pads["mass"])[force > 0]))
    assert -(force * np.sin(case.pivot_angle)).sum() == pytest.approx(load, rel=1e-3)
    assert (case.pivot_load >= 0).all()
    assert (case.min_film_thickness > 0).all()
    assert (case.min_film_thickness < 1e-3).all()
    assert (case.max_pressure[:, :2] > 1e5).all()


def test_friction_moment_stays_below_its_law_s_bound(run):
    for case_name in ("bengisu", "lugre"):
        case = run(case_name)
        radius = ball_radius(case)
        friction = case.input["friction"]
        static, dynamic = (max(friction[name]) for name in ("static_coefficient", "dynamic_coefficient"))
        ratio = np.abs(case.friction_moment) / (radius * case.pivot_load)
        if case_name == "bengisu":
            assert ratio.max() <= static * (1 + 1e-12)
        assert dynamic < ratio.max() < 1.5 * static
    bristle = np.abs(run("lugre").bristle_deflection).max() * friction["bristle_stiffness"]
    assert dynamic < bristle <= static * (1 + 1e-6)


def test_no_friction_no_moment(run):
    assert not run("none").friction_moment.any()


@pytest.mark.parametrize("case_name", ["lugre", "bengisu", "tilting"])
def test_friction_takes_work_out(run, case_name):
    import tiltpad

    for pad in (1, 2):
        tilt, moment = tiltpad.hysteresis(run(case_name), pad)
        box = np.ptp(tilt) * np.ptp(moment)
        assert 0.3 * box < tiltpad.loop_area(tilt, moment) < box


@pytest.mark.parametrize("case_name", ["lugre", "four"])
def test_spectra_are_those_of_the_last_samples(run, case_name):
    case = run(case_name)
    n = 360 * int(case["spectrum/revolutions"])
    assert n == 360 * int((case.samples - 1) / 360)
    frequency = np.fft.rfftfreq(n, case.time[1])
    np.testing.assert_allclose(case["spectrum/frequency"], frequency, rtol=1e-12)
    np.testing.assert_allclose(case["spectrum/order"], frequency * 60 / 6500, rtol=1e-12)

    window = 1 - (n >= 8 * 360) * np.cos(2 * np.pi * np.arange(n) / n)
    assert case["spectrum/window"] == (n >= 8 * 360)

    def amplitude(signal):
        mean = signal.mean(axis=0)
        each = 2 * np.abs(np.fft.rfft(((signal - mean).T * window).T, axis=0)) / n
        each[0] = np.abs(mean)
        each[-1] /= 2
        return each

    for name in ("journal_y", "journal_z"):
        expected = amplitude(case[name][-n:])
        np.testing.assert_allclose(case["spectrum/" + name], expected, atol=1e-13 * expected.max() * n)
    expected = amplitude(case.pad_tilt[-n:]).T
    np.testing.assert_allclose(case["spectrum/pad_tilt"], expected, atol=1e-13 * expected.max() * n)

    motion = case.journal_y[-n:] + 1j * case.journal_z[-n:]
    full = np.abs(np.fft.fft((motion - motion.mean()) * window)) / n
    full[0] = np.abs(motion.mean())
    # numpy puts the Nyquist frequency first, the file puts it last
    order = np.arange(-(n // 2) + 1, n // 2 + 1)
    np.testing.assert_allclose(case["spectrum/full_frequency"], order / (n * case.time[1]), rtol=1e-12)
    np.testing.assert_allclose(case["spectrum/journal_full"], full[order], atol=1e-13 * full.max() * n)


def test_the_unbalance_response_whirls_forward(run):
    frequency, amplitude = run("lugre")["spectrum/full_frequency"], run("lugre")["spectrum/journal_full"]
    moving = np.where(frequency == 0, 0, amplitude)
    assert frequency[np.argmax(moving)] == pytest.approx(6500 / 60, rel=1e-9)
