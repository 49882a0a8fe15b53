"""The response to unbalance: critical speeds, amplification factors and margins against known curves."""

import numpy as np
import pytest
import tiltpad
from tiltpad.calculate.response import aligned, peaks_of
from tiltpad.draw import branches

#: A bearing with a resonance in the range: its pivots are soft, so that the film damps little.
SOFT = {"law": "hertz", "radius_difference": 1e-3}
CASE = (
    "&case task='periodic' / &rotor unbalance=1e-4 / &output samples_per_revolution=60 / "
    "&pivot law='hertz', radius_difference=1e-3 /"
)
SPEEDS = [1500, 3000, 3600, 4200, 5000, 6500]


def rotor(ratio, damping):
    """First harmonic of a rotor of one degree of freedom under its unbalance, complex."""
    return ratio**2 / (1 - ratio**2 + 2j * damping * ratio)


def peak_of(damping, count):
    speed = np.linspace(500, 12000, count)
    (found,) = peaks_of("y", speed, speed, np.abs(rotor(speed / 4000, damping)))
    return found


@pytest.mark.parametrize("damping", [0.05, 0.15, 0.26])
def test_critical_speed_and_amplification_of_a_linear_rotor(damping):
    # over the inverse of the speed ratio the response is that to a constant force: all in closed form
    wide = 2 * damping * np.sqrt(1 - damping**2)
    critical = 4000 / np.sqrt(1 - 2 * damping**2)
    below, above = (4000 / np.sqrt(1 - 2 * damping**2 + side) for side in (wide, -wide))
    found = peak_of(damping, 461)
    # the curve is looked at every 1.25 rpm
    assert found.speed_rpm == pytest.approx(critical, abs=0.7)
    assert (found.below_rpm, found.above_rpm) == pytest.approx((below, above), abs=0.1)
    assert found.amplitude == pytest.approx(1 / wide, rel=1e-4)
    assert found.amplification_factor == pytest.approx(critical / (above - below), rel=1e-3)
    # the book's 1/(2 zeta) is that for little damping
    assert found.amplification_factor == pytest.approx(1 / (2 * damping), rel=10 * damping**2)


def test_margins_are_those_of_the_standard():
    light, heavy = (tiltpad.Peak("y", 1000, 1, 1000 - width, 1000 + width) for width in (50, 250))
    assert light.amplification_factor == 10
    assert light.margin_below == pytest.approx(15) == light.margin_above - 10
    assert (heavy.margin_below, heavy.margin_above) == (0, 0)
    # never more than 16 and 26 percent
    sharp = tiltpad.Peak("y", 1000, 1, 999.5, 1000.5)
    assert (sharp.margin_below, sharp.margin_above) == (16, 26)


def test_a_curve_that_ends_on_a_flank_has_no_amplification_factor():
    speed = np.linspace(500, 4200, 100)
    (found,) = peaks_of("y", speed, speed, np.abs(rotor(speed / 4000, 0.1)))
    assert np.isnan(found.above_rpm)
    assert np.isnan([found.amplification_factor, found.margin_below, found.margin_above]).all()
    assert not peaks_of("y", speed[:50], speed[:50], np.abs(rotor(speed[:50] / 4000, 0.1)))


def test_a_ripple_on_a_flank_is_no_peak():
    speed = np.linspace(500, 12000, 461)
    curve = np.abs(rotor(speed / 4000, 0.1)) * (1 + 0.02 * np.sin(speed / 100))
    assert len(peaks_of("y", speed, speed, curve)) == 1
    assert len(peaks_of("y", speed, speed, np.abs(rotor(speed / 2000, 0.05)) + 4 * curve)) == 2


@pytest.fixture(scope="module")
def study(runs_of, tmp_path_factory):
    """Periodic orbits under a small unbalance, over the speed."""
    folder = tmp_path_factory.mktemp("response")
    collected = tiltpad.collect(
        runs_of(folder / "runs", CASE, {"operation%speed_rpm": SPEEDS}), folder / "study.h5"
    )
    with tiltpad.read_study(collected.output) as opened:
        yield opened


def test_a_small_orbit_is_that_of_the_coefficients(study):
    found = tiltpad.response(study)
    assert found.parameter == "speed_rpm"
    np.testing.assert_array_equal(found.values, SPEEDS)
    # it is no longer damped as it is with stiff pivots
    assert [each.direction for each in found.peaks] == ["y", "z"]
    assert all(each.amplification_factor > 2.5 for each in found.peaks)
    for k in (0, 3):
        case = {"case": {"task": "coefficients"}, "operation": {"speed_rpm": SPEEDS[k]}, "pivot": SOFT}
        with tiltpad.run(case) as run:
            own = tiltpad.coefficients(run, "free", 1.0)
            mass = run.input["rotor"]["mass"]
        turning = own.frequency[0]
        dynamic = own.stiffness[0] + 1j * turning * own.damping[0] - turning**2 * mass * np.eye(2)
        linear = np.linalg.solve(dynamic, 1e-4 * turning**2 * np.array([1, -1j]))
        orbit = found.amplitude[k] * np.exp(-1j * found.phase[k])
        # the unbalance moves the journal by some 1e-3 of the clearance: what is not linear is of this order
        np.testing.assert_allclose(orbit, linear, rtol=5e-3)


def test_the_picture_shows_both_directions(study, closed_figures):
    figure = branches.response(study)
    found = tiltpad.response(study)
    upper, lower = figure.axes
    for ax, values in ((upper, 1e6 * found.amplitude), (lower, np.degrees(found.phase))):
        curves = [line.get_ydata() for line in ax.get_lines() if len(line.get_xdata()) == len(SPEEDS)]
        np.testing.assert_allclose(np.transpose(curves), values)
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == [f"${each.direction}$: {branches.in_words(each)}" for each in found.peaks]


def test_a_runup_has_a_response_and_one_speed_has_none(made, run):
    angle_of = lambda ratio: np.angle(rotor(ratio, 0.1))  # noqa: E731

    def turning(time, angle):
        ratio = np.linspace(1500, 6500, len(time)) / 4000
        return 1e-6 * np.abs(rotor(ratio, 0.1)) * np.cos(angle + angle_of(ratio))

    found = tiltpad.response(made("runup", seconds=10, interval=4e-4, journal_y=turning))
    assert found.peaks[0].speed_rpm == pytest.approx(4041, rel=0.01)
    assert found.peaks[0].amplification_factor == pytest.approx(4.85, rel=0.05)
    with pytest.raises(tiltpad.NotInRunError, match="its speed stays the same"):
        tiltpad.response(run("lugre"))
    with pytest.raises(TypeError, match=r"tiltpad\.read\('mine.h5'\)"):
        tiltpad.response("mine.h5")


@pytest.mark.parametrize(
    ("phase", "wanted"), [((128, -100), (128, 260)), ((-200, 20), (160, 380)), ((20, -170), (20, 190))]
)
def test_the_phase_of_z_is_next_to_that_of_forward_whirl(phase, wanted):
    """Of many turns that are all the same, pictures show those that can be compared."""
    found = aligned(np.radians([phase, np.add(phase, 300)]))
    np.testing.assert_allclose(np.degrees(found), [wanted, np.subtract(wanted, 60)])


def test_a_peak_of_too_few_speeds_is_told_as_open():
    """Its amplification factor is far too small: a study of closer speeds finds it."""
    close, far = (np.linspace(500, 9500, count) for count in (901, 19))
    found, told = [], []
    for speed in (close, far):
        # a cubic through few points swings beside a sharp peak, too
        every = peaks_of("y", speed, speed, np.abs(rotor(speed / 4000, 0.02)))
        peak = max(every, key=lambda each: each.amplitude)
        found.append(peak)
        told.append(branches.in_words(peak))
    assert [peak.open for peak in found] == [False, True]
    assert found[1].amplification_factor < 0.7 * found[0].amplification_factor
    assert ["AF > " in each for each in told] == [False, True]
