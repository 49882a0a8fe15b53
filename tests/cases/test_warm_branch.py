"""Branches with warm oil: temperatures, thresholds, agreement with single runs, runaway heat."""

import re
import shlex

import h5py
import numpy as np
import pytest

WARM = "&film cavitation='none' /\n&oil grade=46 /\n&thermal model='pad' /\n"
LIGHT = "&rotor mass=200 /\n&operation speed_rpm=13500 /\n" + WARM
HEAVY = "&operation speed_rpm=4000 /\n&output samples_per_revolution=90 /\n" + WARM
OF_EQUILIBRIA = ("case%task='branch'", "branch%of='equilibrium'", "branch%parameter='operation%speed_rpm'")
EQUILIBRIA = (*OF_EQUILIBRIA, "branch%last=15000", "branch%step=100")
ORBITS = (
    "case%task='branch'",
    "branch%parameter='oil%supply_temperature'",
    "branch%last=46",
    "branch%step=2",
)
#: Thin films of thin oil, whose heat soon runs away.
THIN = (
    "&rotor mass=5000 /\n&operation speed_rpm=3000 /\n&pads motion='tilting_only' /\n"
    "&film cavitation='none' /\n&oil grade=10 /\n&thermal model='pad' /\n"
)


def test_equilibria_have_their_temperatures_and_thresholds(run, tmp_path):
    """Two codes for one threshold; with derivatives without heat Newton's method would take more rounds."""
    said = run(LIGHT, *EQUILIBRIA).stdout
    run(LIGHT, "case%task='coefficients'", "coefficients%threshold_up_to_rpm=15000", name="threshold")
    run(LIGHT, "case%task='equilibrium'", "operation%speed_rpm=15000", name="rest")
    with (
        h5py.File(tmp_path / "case.h5") as branch,
        h5py.File(tmp_path / "threshold.h5") as other,
        h5py.File(tmp_path / "rest.h5") as rest,
    ):
        assert list(branch["bifurcations/kind"]) == [b"hopf"]
        found = branch["bifurcations/parameter"][0]
        assert found == pytest.approx(other["modes/threshold_rpm"][0], rel=1e-7)
        assert max(branch["iterations"]) <= 4
        # as close as the films of both
        for name in ("inlet", "mean", "outlet", "maximum"):
            own = branch[f"{name}_temperature"]
            assert own.attrs["units"] == "degC"
            np.testing.assert_allclose(own[-1], rest[f"equilibrium/{name}_temperature"], atol=1e-3)
        for name in ("shaft_temperature", "drain_temperature"):
            assert branch[name][-1] == pytest.approx(rest[f"equilibrium/{name}"][()], abs=1e-3)
        np.testing.assert_allclose(branch["viscosity"][-1], rest["equilibrium/viscosity"], rtol=1e-4)
        for name in ("stable", "eigenvalue_real", "eigenvalue_imag"):
            assert branch[name].attrs["long_name"].endswith(", at frozen viscosity")
        mean, oil = branch["mean_temperature"][:, 1], 1e3 * branch["viscosity"][:, 1]
    assert f"at operation%speed_rpm = {found:.5f}" in said
    assert said.count("at frozen viscosity") == 2
    assert f"pad 2: mean {mean[0]:.1f} to {mean[-1]:.1f} C, {oil[-1]:.2f} to {oil[0]:.2f} mPa s" in said


def test_oil_that_does_not_thin_has_the_branch_of_cold_oil(run, tmp_path):
    steady = LIGHT.replace("grade=46", "reference_viscosity=0.02, temperature_exponent=0")
    for name in ("pad", "none"):
        run(steady, *EQUILIBRIA, f"thermal%model='{name}'", name=name)
    with h5py.File(tmp_path / "pad.h5") as warm, h5py.File(tmp_path / "none.h5") as cold:
        assert "viscosity" not in cold
        for name in ("parameter", "journal_y_max", "eigenvalue_real", "bifurcations/parameter"):
            np.testing.assert_allclose(warm[name][:], cold[name][:], rtol=1e-9, err_msg=name)


def test_the_last_orbit_is_that_of_its_temperature(run, tmp_path):
    """Its oil has the viscosities that a march keeps: those of the equilibrium, known to 1e-8."""
    run(HEAVY, *ORBITS)
    run(HEAVY, "case%task='periodic'", "oil%supply_temperature=46", name="orbit")
    with h5py.File(tmp_path / "case.h5") as branch, h5py.File(tmp_path / "orbit.h5") as orbit:
        assert branch.attrs["complete"] == 1
        assert branch["parameter"][-1] == 46
        np.testing.assert_allclose(branch["viscosity"][-1], orbit["viscosity"][:], rtol=1e-7)
        for name in ("mean_temperature", "drain_temperature"):
            np.testing.assert_allclose(branch[name][-1], orbit[f"equilibrium/{name}"][()], atol=1e-5)
        for name in ("journal_y", "journal_z"):
            assert branch[name + "_max"][-1] == pytest.approx(max(orbit[name]), abs=1e-10)
            assert branch[name + "_min"][-1] == pytest.approx(min(orbit[name]), abs=1e-10)
        # the oil moves the orbit much farther than this
        assert abs(branch["journal_y_max"][-1] - branch["journal_y_max"][0]) > 1e-7
        own = np.hypot(branch["multiplier_real"][-1], branch["multiplier_imag"][-1])
        single = np.hypot(orbit["periodic/multiplier_real"], orbit["periodic/multiplier_imag"])
        np.testing.assert_allclose(own[:2], single[:2], rtol=1e-4)


def test_heat_that_runs_away_turns_the_branch_back(run, tiltpad, tmp_path):
    """Beyond the fold the oil has no balance, and the search of an equilibrium says so."""
    run(
        THIN,
        *OF_EQUILIBRIA,
        "branch%parameter='rotor%mass'",
        "branch%last=10000",
        "branch%step=1000",
    )
    with h5py.File(tmp_path / "case.h5") as branch:
        assert list(branch["bifurcations/kind"]) == [b"fold"]
        fold, at = branch["bifurcations/parameter"][0], int(branch["bifurcations/point"][0]) - 1
        assert branch["parameter"][-1] == 5000
        assert (branch["mean_temperature"][at + 1 :] > branch["mean_temperature"][at]).all()
    run(THIN, "case%task='equilibrium'", f"rotor%mass={0.998 * fold}", name="before")
    done = run(THIN, "case%task='equilibrium'", f"rotor%mass={1.002 * fold}", name="beyond", status=2)
    assert "where mineral oil boils" in done.stderr
    # what the refusal gives for the next run finds the fold
    _, hint = done.stderr.split("a branch of equilibria shows how far there are some: ")
    told = tiltpad("beyond.nml", *shlex.split(hint), "--output", "told.h5", cwd=tmp_path, status=0).stdout
    assert float(re.search(r"fold at rotor%mass = (\S+),", told)[1]) == pytest.approx(fold, rel=1e-6)
