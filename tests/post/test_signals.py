"""What the package calculates, on signals whose answer is known."""

import numpy as np
import pytest
import tiltpad
from tiltpad.calculate import deviations, signals


@pytest.mark.parametrize(("count", "samples"), [(1, 361), (2, 721), (0.5, 181), (100, 2341)])
def test_last_revolutions_at_constant_speed(run, count, samples):
    case = run("lugre")
    part = tiltpad.last_revolutions(case, count)
    assert part.stop == case.samples == 2341
    assert part.stop - part.start == samples


def test_last_revolutions_of_a_runup(run):
    case = run("runup")
    part = tiltpad.last_revolutions(case, 3)
    turned = np.ptp(case.shaft_angle[part]) / (2 * np.pi)
    assert 3 - 1e-9 < turned < 3 + 1.6 / 360
    assert part.stop - part.start > 3 * 360 + 1


def test_orbit_and_waveform_are_those_samples(run):
    case = run("lugre")
    y, z = tiltpad.orbit(case, 2)
    np.testing.assert_array_equal(y, case.journal_y[-721:])
    np.testing.assert_array_equal(z, case.journal_z[-721:])
    time, tilt = tiltpad.waveform(case, "pad_tilt", 1)
    np.testing.assert_array_equal(time, case.time[-361:])
    np.testing.assert_array_equal(tilt, case.pad_tilt[-361:])


def test_spectra_are_those_of_the_file(run):
    case = run("lugre")
    frequency, amplitude = tiltpad.spectrum(case, "journal_z")
    np.testing.assert_array_equal(amplitude, case["spectrum/journal_z"])
    assert frequency[np.argmax(amplitude[1:]) + 1] == pytest.approx(6500 / 60)
    frequency, amplitude = tiltpad.full_spectrum(case)
    assert frequency[0] < 0 < frequency[-1]
    assert len(frequency) == len(amplitude)


def test_hysteresis(run):
    case = run("four")
    tilt, moment = tiltpad.hysteresis(case, 2)
    np.testing.assert_array_equal(tilt, case.pad_tilt[-361:, 1])
    np.testing.assert_array_equal(moment, case.friction_moment[-361:, 1])
    with pytest.raises(tiltpad.NotInRunError, match="no pad 5 in this run: pads are 1 to 4"):
        tiltpad.hysteresis(case, 5)
    with pytest.raises(tiltpad.NotInRunError, match="no friction in this run: friction model is 'none'"):
        tiltpad.hysteresis(run("none"))


def test_loop_area():
    turn = np.linspace(0, 2 * np.pi, 1000, endpoint=False)
    clockwise = tiltpad.loop_area(3 * np.sin(turn) + 7, 2 * np.cos(turn) - 5)
    assert clockwise == pytest.approx(6 * np.pi, rel=1e-4)
    assert tiltpad.loop_area(3 * np.cos(turn), 2 * np.sin(turn)) == pytest.approx(-6 * np.pi, rel=1e-4)


def test_envelope_holds_every_sample(run):
    case = run("lugre")
    time, low, high = tiltpad.envelope(case, "pad_tilt", spans=3)
    assert low.shape == high.shape == (3, 2)
    np.testing.assert_array_equal(low.min(axis=0), case.pad_tilt.min(axis=0))
    np.testing.assert_array_equal(high.max(axis=0), case.pad_tilt.max(axis=0))
    assert (np.diff(time) > 0).all()
    # no span is shorter than a revolution, so a periodic signal has a smooth band
    assert len(tiltpad.envelope(case, "journal_y")[0]) == 6


def test_a_run_does_not_deviate_from_itself(run):
    assert tiltpad.deviations(run("lugre"), run("lugre")) == dict.fromkeys(deviations.SIGNALS, 0.0)


def test_deviations_are_over_peak_to_peak_or_natural_scale(run):
    case, other = run("lugre"), run("none")
    part = tiltpad.last_revolutions(other)
    found = tiltpad.deviations(case, other)
    gap = np.abs(case.journal_y[part] - other.journal_y[part]).max()
    assert found["journal_y"] == pytest.approx(gap / np.ptp(other.journal_y[part]))
    # without friction there is no moment, and nothing to measure it by
    assert "friction_moment" not in found
    # between two samples nothing moves
    still = tiltpad.deviations(case, other, slice(part.stop - 1, part.stop))
    last = abs(case.journal_y[-1] - other.journal_y[-1])
    assert still["journal_y"] == pytest.approx(last / (0.05 * other.clearance))
    # a socket of 13 mm, 15 um larger than its ball, and f_s = 0.1
    sliding = 0.1 * (13e-3 - 15e-6) * case.pivot_load[tiltpad.last_revolutions(case)].max()
    assert deviations.characteristic_scale(case, "friction_moment") == pytest.approx(sliding)


def test_deviations_need_the_same_samples(run):
    with pytest.raises(tiltpad.RunError, match="not the same samples"):
        tiltpad.deviations(run("runup"), run("lugre"), slice(0, None))


def test_orbit_size(run):
    case = run("lugre")
    assert tiltpad.orbit_size(case, 2) == (np.ptp(case.journal_y[-721:]), np.ptp(case.journal_z[-721:]))


def test_the_poincare_section_of_a_periodic_motion_is_a_point(made):
    """Order 1 meets every section at one point, order 1/2 at two; the samples lie between the sections."""
    case = made(
        "lugre",
        1,
        journal_y=lambda time, angle: 1e-6 * np.cos(angle),
        journal_z=lambda time, angle: 1e-6 * np.cos(angle / 2),
        pad_tilt=lambda time, angle: np.stack([np.sin(angle), angle], axis=1),
    )
    section = tiltpad.poincare(case, 20, phase=0.3)
    assert len(section["revolution"]) == 20
    turns = 2 * np.pi * section["revolution"] + 0.3
    np.testing.assert_allclose(section["time"] * 6500 * np.pi / 30, turns, rtol=1e-12)
    np.testing.assert_allclose(section["journal_y"], 1e-6 * np.cos(0.3), rtol=1e-5)
    np.testing.assert_allclose(section["journal_z"][::2], section["journal_z"][0], rtol=1e-5)
    assert section["journal_z"][0] == pytest.approx(-section["journal_z"][1], rel=1e-4)
    np.testing.assert_allclose(section["pad_tilt"][:, 1], turns, rtol=1e-12)
    assert set(section) == {"revolution", "time", *signals.STATES}
    with pytest.raises(tiltpad.NotInRunError, match="no Poincare section in this run: it has 0.542 shaft"):
        tiltpad.poincare(made("lugre", 0.005))


def test_the_poincare_section_of_a_run(run):
    section = tiltpad.poincare(run("tilting"), 5)
    assert len(section["revolution"]) == 5
    assert "pivot_deflection" not in section
    case = run("tilting")
    np.testing.assert_allclose(section["journal_y"], case.journal_y[720:-1:360], rtol=1e-12)


def test_nothing_was_marched(run):
    for calculate in (tiltpad.orbit, tiltpad.orbit_size, tiltpad.poincare):
        with pytest.raises(tiltpad.NotInRunError, match="task is 'equilibrium', nothing was marched"):
            calculate(run("equilibrium"))
