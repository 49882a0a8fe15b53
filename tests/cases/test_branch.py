"""Whole runs of the task branch: the file, thresholds, agreement with single orbits, going on, refusals."""

import h5py
import numpy as np
import pytest

#: Its journal loses its stability at the threshold speed that the task coefficients finds.
LIGHT = "&rotor mass=200 /\n&operation speed_rpm=14000 /\n"
LUGRE = "&friction model='lugre' /\n&operation speed_rpm=3000 /\n&output samples_per_revolution=90 /\n"
BENGISU_AKAY = (
    "&friction model='bengisu_akay' /\n&operation speed_rpm=6500 /\n&output samples_per_revolution=90 /\n"
)
SPEED = ("case%task='branch'", "branch%parameter='operation%speed_rpm'")
EQUILIBRIA = (*SPEED, "branch%of='equilibrium'", "branch%last=16000", "branch%step=200")
ORBITS = (*SPEED, "branch%last=3300", "branch%step=50", "branch%max_step=100")


def test_equilibria_lose_their_stability_at_the_threshold(run, tmp_path):
    """Two codes for one value, both with converged films: the task coefficients takes steps of the speed."""
    done = run(LIGHT, *EQUILIBRIA)
    assert "hopf at operation%speed_rpm = 14945.84" in done.stdout
    threshold = ("case%task='coefficients'", "coefficients%threshold_up_to_rpm=16000")
    run(LIGHT, *threshold, name="coefficients")
    with h5py.File(tmp_path / "case.h5") as branch, h5py.File(tmp_path / "coefficients.h5") as coefficients:
        special = branch["bifurcations"]
        assert list(special["kind"]) == [b"hopf", b"hopf"]
        assert special["parameter"][0] == pytest.approx(coefficients["modes/threshold_rpm"][0], rel=1e-7)
        at = int(special["point"][0]) - 1
        assert branch["parameter"][at] == special["parameter"][0]
        assert abs(branch["eigenvalue_real"][at, 0]) < 1e-3
        assert branch["eigenvalue_imag"][at, 0] / (2 * np.pi) == pytest.approx(109.546, abs=1e-3)
        assert branch["parameter"][-1] == 16000
        assert (branch["stable"][:at] == 1).all()
        assert (branch["stable"][at + 1 :] == 0).all()
        np.testing.assert_array_equal(branch["journal_y_max"][:], branch["journal_y_min"][:])
        assert (
            branch.attrs["branch_ends"]
            == "branch 1 ends at operation%speed_rpm = 16000.00000: the last value"
        )


@pytest.mark.parametrize(("text", "last", "step"), [(LUGRE, 3300, 50), (BENGISU_AKAY, 8000, 100)])
def test_the_last_orbit_is_that_of_its_speed(run, tmp_path, text, last, step):
    """As close as the meshes of both, some 1e-4 of the tolerance 1e-5 of the states in position."""
    run(text, *SPEED, f"branch%last={last}", f"branch%step={step}", f"branch%max_step={2 * step}")
    run(text, "case%task='periodic'", f"operation%speed_rpm={last}", name="orbit")
    with h5py.File(tmp_path / "case.h5") as branch, h5py.File(tmp_path / "orbit.h5") as orbit:
        assert branch.attrs["complete"] == 1
        assert list(branch["point"]) == list(range(1, len(branch["point"]) + 1))
        assert branch["parameter"][-1] == last
        assert branch["period"][-1] == pytest.approx(60 / last, rel=1e-12)
        for name, series in (("journal_y", orbit["journal_y"]), ("journal_z", orbit["journal_z"])):
            assert branch[name + "_max"][-1] == pytest.approx(max(series), abs=1e-9)
            assert branch[name + "_min"][-1] == pytest.approx(min(series), abs=1e-9)
        angle = orbit["shaft_angle"][:-1]
        first = 2 * np.mean(orbit["journal_y"][:-1] * np.exp(1j * angle))
        assert branch["journal_y_amplitude"][-1] == pytest.approx(abs(first), abs=1e-9)
        assert branch["journal_y_phase"][-1] == pytest.approx(np.angle(first), abs=1e-3)
        np.testing.assert_allclose(
            branch["min_film_thickness"][-1], np.min(orbit["min_film_thickness"], axis=0), rtol=1e-3
        )
        assert branch["multiplier_real"][-1, 0] == pytest.approx(
            orbit["periodic/multiplier_real"][0], abs=1e-3
        )


def test_the_end_of_what_is_allowed_is_the_end_of_the_branch(run, tmp_path):
    """A dynamic coefficient cannot exceed the static one, 0.1."""
    over = (
        "case%task='branch'",
        "branch%parameter='friction%dynamic_coefficient'",
        "branch%last=0.2",
        "branch%step=0.02",
    )
    run(LUGRE, *over)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file.attrs["complete"] == 1
        assert "the branch ends here: friction%dynamic_coefficient = " in file.attrs["branch_ends"]
        assert file["parameter"][-1] == pytest.approx(0.1, abs=1e-4)


@pytest.mark.parametrize(
    ("overrides", "names"),
    [
        ((*ORBITS, "branch%parameter='operation%speed'"), ("branch%parameter", "no such variable")),
        ((*ORBITS, "branch%parameter='speed'"), ("branch%parameter", "group%name")),
        ((*ORBITS, "branch%parameter='friction%model'"), ("branch%parameter", "real number")),
        ((*ORBITS, "branch%parameter='operation%duration'"), ("branch%parameter", "operation%speed_rpm")),
        ((*ORBITS, "branch%parameter='rotor%static_load'"), ("branch%parameter", "static_load(1) to (2)")),
        ((*ORBITS, "branch%parameter='rotor%static_load(3)'"), ("branch%parameter", "2 elements")),
        ((*ORBITS, "branch%step=0"), ("branch%step = 0", "> 0")),
        ((*ORBITS, "branch%step=-10"), ("branch%step = -10", "> 0", "3300")),
        ((*ORBITS, "branch%last=1e9"), ("branch%last = 1e9", "to 1e6")),
        ((*ORBITS, "branch%last=3000"), ("branch%last = 3000", "where the branch starts")),
        ((*ORBITS, "branch%max_step=1"), ("branch%max_step = 1", "branch%step = 50")),
        ((*ORBITS, "operation%final_speed_rpm=4000"), ("operation%final_speed_rpm", "branch")),
        (("case%task='branch'",), ("branch%parameter", "must name")),
        ((*EQUILIBRIA, "branch%parameter='rotor%unbalance'"), ("branch%parameter", "no effect")),
    ],
)
def test_what_is_refused(run, tmp_path, overrides, names):
    done = run(LUGRE, *overrides, status=1)
    for name in names:
        assert name in done.stderr
    assert not (tmp_path / "case.h5").exists()
