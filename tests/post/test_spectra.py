"""Spectra over any part of a run, order tracks and waterfalls: of made signals, and beside the file's own."""

import numpy as np
import pytest
import tiltpad


def test_over_the_same_part_they_are_those_of_the_file(run):
    case = run("lugre")
    count = int(case["spectrum/revolutions"])
    for name in ("journal_y", "journal_z", "pad_tilt"):
        frequency, amplitude = tiltpad.one_sided(case, name, count)
        np.testing.assert_allclose(frequency, case["spectrum/frequency"], rtol=1e-12)
        expected = case["spectrum/" + name]
        # the file's part begins a sample later
        np.testing.assert_allclose(amplitude, expected, atol=2e-3 * expected.max())
    frequency, amplitude = tiltpad.full(case, count)
    expected = case["spectrum/journal_full"]
    order = np.argsort(np.round(case["spectrum/full_frequency"]))
    np.testing.assert_allclose(np.sort(frequency)[1:], case["spectrum/full_frequency"][order][:-1], atol=1e-6)
    np.testing.assert_allclose(amplitude[1:], expected[order][:-1], atol=2e-3 * expected.max())


def test_amplitudes_of_a_known_signal(made):
    frequency = 6500 / 60
    case = made(
        "lugre",
        0.2,
        interval=1 / frequency / 360,
        journal_y=lambda time, angle: 3e-6 + 5e-6 * np.cos(angle) + 1e-6 * np.sin(3 * angle),
        journal_z=lambda time, angle: 5e-6 * np.sin(angle),
        pivot_deflection=lambda time, angle: np.stack([1e-6 * np.cos(2 * angle), 0 * time], axis=1),
    )
    at, amplitude = tiltpad.one_sided(case, "journal_y", 10)
    assert at[10] == pytest.approx(frequency)
    np.testing.assert_allclose(amplitude[[0, 10, 20, 30]], [3e-6, 5e-6, 0, 1e-6], atol=1e-15)
    at, amplitude = tiltpad.one_sided(case, "pivot_deflection", 4)
    np.testing.assert_allclose(amplitude[:, 8], [1e-6, 0], atol=1e-15)
    np.testing.assert_array_equal(tiltpad.one_sided(case, "pivot_deflection", 4, pad=1)[1], amplitude[0])
    at, amplitude = tiltpad.full(case, 4)
    assert at[np.argmax(amplitude)] == pytest.approx(frequency)
    assert amplitude.max() == pytest.approx(5e-6)


def chirp(time, angle):
    """Order 1 grows with the speed and turns its phase, order 3 stays."""
    return 40e-6 + 1e-9 * angle * np.cos(angle + 0.5) + 2e-6 * np.cos(3 * angle - 1)


def test_a_waterfall_follows_the_orders_of_a_chirp(made):
    case = made("runup", 2, journal_y=chirp)
    speed, order, amplitude = tiltpad.waterfall(case, "journal_y", orders=5)
    assert amplitude.shape == (len(speed), len(order))
    np.testing.assert_allclose(order, np.arange(41) / 8)
    assert (np.diff(speed) > 0).all()
    assert 1500 < speed[0] * 30 / np.pi < 2200
    assert 6300 < speed[-1] * 30 / np.pi < 6500
    np.testing.assert_allclose(amplitude[:, 24], 2e-6, rtol=1e-3)
    # shaft angle in the middle of a window, from its speed: the speed rises evenly
    rate = np.pi / 30 * (6500 - 1500) / 2
    angle = (speed**2 - (1500 * np.pi / 30) ** 2) / (2 * rate)
    np.testing.assert_allclose(amplitude[:, 8], 1e-9 * angle, rtol=1e-3)
    np.testing.assert_allclose(amplitude[:, 0], 40e-6, rtol=1e-3)
    assert amplitude[:, 12:20].max() < 2e-9


def test_a_drift_of_the_mean_is_no_band_near_0_hz(made):
    """It is left out to its slope in a window; beside the orders nothing is left."""
    case = made("runup", 2, journal_y=lambda time, angle: 20e-6 * time + 1e-6 * np.cos(angle))
    _, order, amplitude = tiltpad.waterfall(case, "journal_y", orders=5)
    assert order[2:5].tolist() == [0.25, 0.375, 0.5]
    # the mean itself is in the orders 0 and 0.125, which the window makes of one
    assert amplitude[:, 2:5].max() < 1e-7
    np.testing.assert_allclose(amplitude[:, 8], 1e-6, rtol=1e-2)


def test_an_order_track_has_amplitude_and_phase(made):
    case = made("runup", 2, journal_y=chirp)
    speed, amplitude, phase = tiltpad.order_track(case, "journal_y", 3)
    np.testing.assert_allclose(amplitude, 2e-6, rtol=1e-3)
    np.testing.assert_allclose(phase, -1, atol=2e-3)
    speed, amplitude, phase = tiltpad.order_track(case, "journal_y", 1)
    np.testing.assert_allclose(phase, 0.5, atol=2e-3)
    assert (np.diff(amplitude) > 0).all()
    table = tiltpad.waterfall(case, "journal_y", spans=400)
    np.testing.assert_array_equal(table[0], speed)
    np.testing.assert_allclose(table[2][:, 8], amplitude, rtol=1e-9)


def test_one_pad_of_a_runup(run):
    case = run("runup")
    speed, order, amplitude = tiltpad.waterfall(case, "pad_tilt", pad=2, revolutions=2)
    assert np.isfinite(amplitude).all()
    assert len(speed) > 3
    with pytest.raises(ValueError, match="pad_tilt: pad must be given"):
        tiltpad.waterfall(case, "pad_tilt")
    with pytest.raises(ValueError, match="journal_y: has no pads"):
        tiltpad.order_track(case, "journal_y", pad=1)


def test_what_a_run_is_not_for(run):
    with pytest.raises(tiltpad.NotInRunError, match="no waterfall in this run: its speed stays the same"):
        tiltpad.waterfall(run("lugre"))
    with pytest.raises(tiltpad.NotInRunError, match="no order track in this run: its speed stays the same"):
        tiltpad.order_track(run("lugre"))
    with pytest.raises(tiltpad.NotInRunError, match="no spectrum in this run: the speed changes"):
        tiltpad.one_sided(run("runup"))
    with pytest.raises(tiltpad.NotInRunError, match=r"it has 6\.67 shaft rev.*, and 50 are needed"):
        tiltpad.waterfall(run("runup"), revolutions=50)
