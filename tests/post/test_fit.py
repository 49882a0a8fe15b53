"""Fits: parameters come back from what was measured, their intervals are honest, wrong input is one line."""

import numpy as np
import pytest
import tiltpad
from scipy import stats
from tiltpad import Measured
from tiltpad.calculate.estimation import Parameter, estimate
from tiltpad.draw import fits

FRICTION = ("friction%static_coefficient", "friction%dynamic_coefficient")
BRISTLES, CLEARANCE, VISCOSITY = (
    "friction%bristle_stiffness",
    "bearing%assembled_clearance",
    "bearing%viscosity",
)
#: The machine, and its numbers that are sought.
TRUE = {"static_coefficient": 0.1, "bristle_stiffness": 1e6, "assembled_clearance": 80e-6}
CASE = {
    "case": {"task": "periodic"},
    "friction": {
        "model": "lugre",
        "static_coefficient": 0.1,
        "dynamic_coefficient": 0.1,
        "bristle_stiffness": 1e6,
    },
    "output": {"samples_per_revolution": 60},
}
FREE = {FRICTION: (0.02, 0.5), BRISTLES: (1e4, 1e8), CLEARANCE: (70e-6, 95e-6)}
MASS = {"rotor%mass": (1900.0, 2100.0)}


@pytest.fixture(autouse=True)
def under_test(program, monkeypatch):
    monkeypatch.setenv("TILTPAD", program)


@pytest.fixture(scope="module")
def orbit(program):
    """The journal's orbit without noise, and the noise: 1 % of its size."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TILTPAD", program)
        with tiltpad.run(CASE) as run:
            y, z = (each[:-1] for each in tiltpad.orbit(run))
    return y, z, 0.01 * np.ptp(y)


def noisy(orbit, seed=1, **options):
    y, z, deviation = orbit
    random = np.random.default_rng(seed)
    found = {
        name: each + deviation * random.normal(size=each.shape)
        for name, each in zip("yz", (y, z), strict=True)
    }
    return Measured({f"journal_{name}": each for name, each in found.items()}, deviation, **options)


def test_intervals_hold_the_truth_as_often_as_they_say():
    """Of a known function: errors over their covariance, summed over 200 fits of three parameters, are
    chi-squared of 600; outside the middle 99.9 % of it intervals are too narrow or too wide."""
    parameters = [Parameter("size", 0.1, 10.0), Parameter("rate", 0.1, 10.0), Parameter("offset", -1.0, 1.0)]
    true, time, noise = np.array([2.0, 1.5, 0.1]), np.linspace(0, 2, 50), 0.02
    random = np.random.default_rng(0)
    total, inside = 0.0, np.zeros(3)
    for _ in range(200):
        measured = true[0] * np.exp(-true[1] * time) + true[2] + noise * random.normal(size=time.shape)

        def model(points, measured=measured):
            size, rate, offset = points.T[:, :, None]
            return (size * np.exp(-rate * time) + offset - measured) / noise

        found = estimate(model, parameters, np.array([1.0, 1.0, 0.0]))
        error = found.place - [each.scaled(value) for each, value in zip(parameters, true, strict=True)]
        total += error @ np.linalg.inv(found.covariance) @ error
        inside += np.abs(error) < 2 * np.sqrt(np.diag(found.covariance))
    low, high = stats.chi2(600).interval(0.999)
    assert low < total < high
    assert (inside >= stats.binom(200, 0.9545).ppf(5e-4)).all()


def test_three_parameters_come_back_from_a_noisy_orbit(orbit):
    """From far away; errors over their covariance are chi-squared of 3 (docs/verify_fits.py: 60 seeds)."""
    fit = tiltpad.fit(CASE, noisy(orbit), FREE)
    error = fit.values - list(TRUE.values())
    assert error @ np.linalg.inv(fit.covariance) @ error < stats.chi2(3).ppf(0.999)
    # what 120 values of 1 % can tell
    assert (fit.deviations < [0.003, 0.2e6, 0.05e-6]).all()
    assert 0.6 < fit.misfit < 1.4
    assert fit.remarks == []
    assert set(fit.groups["friction"]) == {"static_coefficient", "dynamic_coefficient", "bristle_stiffness"}
    assert fit.groups["friction"]["dynamic_coefficient"] == fit.values[0]
    assert (fit.interval[:, 0] < fit.values).all()
    assert (fit.values < fit.interval[:, 1]).all()


def test_parameters_of_one_effect_are_told_to_be_known_together_only(orbit):
    fit = tiltpad.fit(CASE, noisy(orbit), {CLEARANCE: FREE[CLEARANCE], VISCOSITY: (0.01, 0.03)})
    assert fit.correlation[0, 1] > 0.95
    told = f"{CLEARANCE} and {VISCOSITY} are known together only (correlation {fit.correlation[0, 1]:.3f})"
    assert fit.remarks == [told]


def test_a_static_locus_coefficients_and_a_waveform_give_clearance_and_viscosity():
    """Without noise, with the deviations that they could have: what is left is that of the iteration."""
    case = {"operation": {"duration": 0.01}, "bearing": {"viscosity": 0.019}}
    beside = {"start": {"journal": (5e-6, 0.0)}}
    speeds, static = (2000.0, 6000.0), []
    for speed in speeds:
        own = {"operation": {"speed_rpm": speed}}
        with tiltpad.run(case, case={"task": "equilibrium"}, operation={"speed_rpm": speed}) as run:
            values = {name: run[name] for name in ("equilibrium/journal_y", "equilibrium/journal_z")}
            static.append(Measured(values, 0.1e-6, own))
    with tiltpad.run(case, case={"task": "coefficients"}) as run:
        found = tiltpad.coefficients(run)
    deviation = {"stiffness": 1e6, "damping": 1e3}
    matrices = Measured({"stiffness": found.stiffness[0], "damping": found.damping[0]}, deviation)
    with tiltpad.run(case, **beside) as run:
        wave = Measured({"time": run.time[:90], "journal_y": run.journal_y[:90]}, 0.1e-6, beside)
    free = {CLEARANCE: (70e-6, 95e-6), VISCOSITY: (0.01, 0.03)}
    for tests in (static, [matrices], [wave]):
        fit = tiltpad.fit(case, tests, free)
        assert (np.abs(fit.values - [80e-6, 0.019]) < 0.02 * fit.deviations).all(), fit
        assert fit.misfit < 1e-3


def test_coefficients_of_a_rig_give_the_friction():
    """K and C from forced vibrations at an amplitude at which pads stick and slide in turn."""
    case = CASE | {
        "rotor": {"unbalance": 0.0},
        "excitation": {"amplitude": 3000.0, "frequency_ratio": 0.5},
    }
    runs = [tiltpad.run(case, **{"excitation(1)": {"direction_deg": each}}) for each in (0.0, 90.0)]
    found = tiltpad.impedance(runs)
    measured = Measured({"stiffness": found.stiffness[0]}, 1e6, pivot="identified")
    fit = tiltpad.fit(case, measured, {FRICTION: (0.05, 0.2)}, {FRICTION[0]: 0.08})
    assert abs(fit.values[0] - 0.1) < 0.02 * fit.deviations[0]
    assert fit.runs % 2 == 0


def test_without_means_the_orbit_does_not_tell_the_clearance(orbit):
    """Two pads further out carry the journal lower, and nothing else changes: the fit says so."""
    fit = tiltpad.fit(CASE, noisy(orbit, mean=False), {CLEARANCE: FREE[CLEARANCE]})
    assert fit.remarks == [f"{CLEARANCE}: what was measured tells no more of it than its bounds"]
    assert 0.6 < fit.misfit < 1.4


@pytest.mark.usefixtures("closed_figures")
def test_missing_values_do_not_count_and_the_picture_has_the_others(orbit):
    measured = noisy(orbit)
    measured.values["journal_y"][:30] = np.nan
    fit = tiltpad.fit(CASE, measured, {CLEARANCE: FREE[CLEARANCE]})
    assert len(fit.residuals) == 90
    assert 0.5 < fit.misfit < 1.5
    assert repr(fit).startswith("<tiltpad fit: 90 values")
    (ax,) = fit.plot().axes
    points, start, fitted = ax.get_lines()
    np.testing.assert_allclose(points.get_ydata(), 1e6 * measured.values["journal_y"])
    np.testing.assert_allclose(fitted.get_ydata()[:-1], 1e6 * fit.fitted[0]["journal_y"])
    np.testing.assert_allclose(start.get_xdata()[:-1], 1e6 * fit.started[0]["journal_z"])
    assert ax.figure.get_supxlabel().startswith(f"{CLEARANCE} = {fit.in_words(0)}")


@pytest.mark.usefixtures("closed_figures")
@pytest.mark.parametrize("others", [{}, {"journal_y": np.zeros(60), "journal_z": np.ones(60)}])
def test_the_legend_of_a_fit_has_the_symbols_of_its_panels(others):
    values = {"stiffness": 1e8 * np.eye(2), **others}
    fig = fits.comparison([Measured(values, 1e-6)], [values], [values], [])
    shown = {line.get_label(): line for line in fig.legends[0].get_lines()}
    for k, name in enumerate(("measured", "start", "fitted")):
        drawn = [ax.get_lines()[k] for ax in fig.axes]
        assert {line.get_marker() for line in drawn} - {"None"} == {shown[name].get_marker()}
        assert {line.get_linestyle() for line in drawn} - {"None"} == {shown[name].get_linestyle()} - {"None"}


ORBIT = Measured({"journal_y": np.zeros(60)}, 1e-6)
WRONG = {
    "no data": (CASE, [], MASS, None, "measured: there are no values to fit"),
    "no values": (CASE, Measured({}, 1e-6), MASS, None, "measured: there are no values to fit"),
    "too few": (
        *(CASE, Measured({"journal_y": [0.0]}, 1e-6), MASS | {VISCOSITY: (0.01, 0.02)}, None),
        "measured: 1 values, and 2 free parameters",
    ),
    "nothing free": (CASE, ORBIT, {}, None, "free = {}: must be bounds by name"),
    "no variable": (CASE, ORBIT, {"mass": (1, 2)}, None, "free: 'mass': must be a variable, group%name"),
    "bounds": (CASE, ORBIT, {"rotor%mass": (2, 1)}, None, "free: rotor%mass: (2, 1): low must be less than"),
    "bounds too far": (
        CASE,
        ORBIT,
        {"rotor%mass": (1e-300, 1e300)},
        None,
        "free: rotor%mass: (1e-300, 1e+300)",
    ),
    "bounds too near": (
        *(CASE, ORBIT, {"rotor%mass": (2000.0, np.nextafter(2000, 3000))}, None),
        "free: rotor%mass: (2000.0, ",
    ),
    "too long a bound": (CASE, ORBIT, {"rotor%mass": (1, 10**400)}, None, "free: rotor%mass: (1, 1000"),
    "no name": (CASE, ORBIT, {3: (1, 2)}, None, "free: 3: must be a variable"),
    "no names": (CASE, ORBIT, {(): (1, 2)}, None, "free: (): must be a variable"),
    "start by no name": (CASE, ORBIT, MASS, ["rotor%mass"], "start = ['rotor%mass']: must be values by name"),
    "start of no number": (
        CASE,
        ORBIT,
        MASS,
        {"rotor%mass": "x"},
        "start: rotor%mass: 'x': must be a number",
    ),
    "one number": (CASE, Measured({"journal_y": 1.0}, 1.0), MASS, None, "journal_y: one number was measured"),
    "one bound": (
        CASE,
        ORBIT,
        {"rotor%mass": 1},
        None,
        "free: rotor%mass: 1: must be two numbers, (low, high)",
    ),
    "unknown": (
        *(CASE, ORBIT, {"friction%statik_coefficient": (0.1, 0.2)}, None),
        "unknown variable friction%statik_coefficient (did you mean static_coefficient?)",
    ),
    "unknown group": (
        *(CASE, ORBIT, {"frction%static_coefficient": (0.1, 0.2)}, None),
        "unknown group frction (did you mean friction?)",
    ),
    "range": (CASE, ORBIT, {"rotor%mass": (-1, 1)}, None, "rotor%mass = 0.0: must be 1e-6 to 1e9"),
    "a bound that does not fit": (
        *(CASE, ORBIT, {FRICTION[0]: (0.02, 0.5)}, None),
        "friction%dynamic_coefficient = 0.1: must not exceed friction%static_coefficient = 0.02",
    ),
    "start outside": (
        *(CASE, ORBIT, MASS, {"rotor%mass": 2200}),
        "start: rotor%mass = 2200: must be between its bounds 1900 and 2100",
    ),
    "start of another": (CASE, ORBIT, MASS, {"rotor%mess": 2e3}, "start: rotor%mess is no free parameter"),
    "no influence": (
        *({"case": {"task": "periodic"}}, ORBIT, {"friction%static_coefficient": (0.1, 0.2)} | MASS, None),
        "friction%static_coefficient: nothing that was measured depends on it at 0.141421",
    ),
    "a study": (
        *(CASE | {"sweep": {"rotor%mass": [1.0, 2.0]}}, ORBIT, MASS, None),
        "a fit needs a case of one run",
    ),
    "shape": (
        *(CASE, Measured({"pad_tilt": np.zeros(60)}, 1e-6), MASS, None),
        "pad_tilt: measured (60,), the model has (60, 2)",
    ),
    "too long": (
        *(CASE, Measured({"time": [0.0, 9.0], "journal_y": [0.0, 0.0]}, 1e-6), MASS, None),
        "time: measured up to 9 s, the run ends at ",
    ),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_what_is_wrong_is_one_line(wrong):
    case, measured, free, start, message = WRONG[wrong]
    with pytest.raises(ValueError) as caught:  # noqa: PT011
        tiltpad.fit(case, measured, free, start)
    said = str(caught.value)
    assert said.startswith(message)
    assert "\n" not in said


def test_what_no_run_has_and_runs_that_fail_are_told():
    with pytest.raises(tiltpad.NotInRunError, match=r"^journal_x: no result of this case \(did you mean"):
        tiltpad.fit(CASE, Measured({"journal_x": np.zeros(60)}, 1e-6), MASS)
    with pytest.raises(tiltpad.RunError, match=r"^at rotor%mass = 3.16\S+: no equilibrium found"):
        tiltpad.fit(CASE, ORBIT, {"rotor%mass": (1e7, 1e8)})
    for deviation in (0.0, np.nan, {"journal_z": 1.0}):
        with pytest.raises(ValueError, match=r"^journal_y: deviation = .*: a standard deviation above 0"):
            Measured({"journal_y": np.zeros(60)}, deviation)
    with pytest.raises(tiltpad.NotInRunError, match=r"^equilibrium: no result of this case"):
        tiltpad.fit(CASE, Measured({"equilibrium": 1.0}, 1.0), MASS)
    for case, measured in ((CASE, None), (CASE, 3), (CASE, "orbit"), (3, ORBIT), ([1], ORBIT)):
        with pytest.raises(TypeError, match="must be"):
            tiltpad.fit(case, measured, MASS)


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        *(({"values": own}, "values: must be arrays by name") for own in (None, [1.0], {3: 1.0})),
        *(
            ({"values": {"journal_y": own}}, "journal_y: must be a number, or")
            for own in ("x", 1j, [[1], [1, 2]])
        ),
        *(
            ({"values": {"time": own, "journal_y": [0.0, 0.0]}}, "time: must rise, numbers in a list")
            for own in ([1.0, 0.0], [0.0, np.nan], [0.0, np.inf], 3.0, [], [[0.0, 1.0]])
        ),
        *(
            ({"deviation": own}, "journal_y: deviation = ")
            for own in (None, "x", 1j, [1.0, 2.0], {"journal_y": "x"}, {"journal_y": [1, 2]}, np.inf, -1)
        ),
        *(({"revolutions": own}, "revolutions = ") for own in (0, -1, 1.5, np.nan, "x", None)),
        *(({"case": own}, "case = ") for own in (3, "abc", None)),
    ],
)
def test_wrong_fields_of_a_measurement_are_one_line(fields, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        Measured(**{"values": {"journal_y": [0.0, 1.0]}, "deviation": 1.0} | fields)
