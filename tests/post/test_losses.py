"""Losses and flows: those of the equilibrium, and of marched runs, against each other and the motion."""

import h5py
import numpy as np
import pytest
import tiltpad as package

FLOWS = ("inlet_flow", "outlet_flow", "side_flow")


@pytest.mark.parametrize("case_name", ["none", "four", "gumbel", "flooded", "fixed"])
def test_a_march_starts_with_those_of_its_equilibrium(run, case_name):
    case = run(case_name)
    series, rest = package.losses(case, last=100), case["equilibrium"]
    names = {"power": "power_loss", "couette": "couette_loss", "pressure": "poiseuille_loss"}
    for name in ("load", "journal_drag", "pad_drag", *FLOWS, *names):
        expected = rest[names.get(name, name)]
        np.testing.assert_allclose(
            getattr(series, name)[0], expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max()
        )


@pytest.mark.parametrize("case_name", ["none", "four", "runup", "fixed"])
def test_forces_are_those_of_the_samples(run, case_name):
    """A sample is as accurate as the march (test_library.py has the reasons); a table of cavitated films has
    an error of 4e-5 of the force of a film that is just whole, and half of a fixed pad's film is cavitated.
    """
    case = run(case_name)
    part = package.last_revolutions(case)
    series = package.losses(case)
    assert series.time.tolist() == case.values("time", part).tolist()
    force = np.hypot(case.values("film_force_tangential", part), case.values("film_force_radial", part))
    error = np.abs(series.load - force).max() / np.ptp(force, axis=0).max()
    assert error < (1.5e-3 if case_name == "fixed" else 3e-4)


def test_totals(run):
    rest = run("four")["equilibrium"]
    for name in ("power_loss", *FLOWS):
        assert rest[f"total_{name}"] == pytest.approx(rest[name].sum(), rel=1e-12)
    parts = sum(rest[f"{name}_loss"] for name in ("couette", "poiseuille", "boundary"))
    np.testing.assert_allclose(rest["power_loss"], parts, rtol=1e-12)
    # at rest the shaft brings all heat
    drag = rest["journal_drag"] * 6500 * np.pi / 30
    np.testing.assert_allclose(drag, rest["power_loss"], rtol=1e-9)
    heat = 860 * 1950
    assert rest["temperature_rise_fresh"] == pytest.approx(
        rest["total_power_loss"] / heat / rest["total_inlet_flow"]
    )
    assert rest["temperature_rise_side"] == pytest.approx(
        rest["total_power_loss"] / heat / rest["total_side_flow"]
    )
    mean = (rest["inlet_flow"] + rest["outlet_flow"]) / 2
    np.testing.assert_allclose(rest["temperature_rise"], rest["power_loss"] / heat / mean)


def test_the_power_of_an_orbit(tiltpad, opened, tmp_path):
    """Over a period the shaft's drive and the unbalance bring what films and pivots turn into heat.

    The orbit repeats within 1e-6 of its size; the trapezoidal rule over whole periods is as good.
    """
    (tmp_path / "case.nml").write_text(
        "&operation duration=0.3 /\n&friction model='bengisu_akay', critical_velocity=1e-3 /\n"
    )
    tiltpad("--quiet", "case.nml", cwd=tmp_path, status=0)
    case = opened(tmp_path / "case.h5")
    part, speed = package.last_revolutions(case), 6500 * np.pi / 30
    series = package.losses(case)
    angle, vy, vz, rate, moment = (
        case.values(name, part)
        for name in ("shaft_angle", "journal_vy", "journal_vz", "pad_tilt_rate", "friction_moment")
    )
    unbalance = 0.010 * speed**2 * (np.cos(angle) * vy + np.sin(angle) * vz)
    pivots = (moment * rate).sum(axis=1)
    heat = series.power.sum(axis=1) + pivots
    brought = series.journal_drag.sum(axis=1) * speed + unbalance
    mean = [np.trapezoid(each, series.time) / np.ptp(series.time) for each in (heat, brought, unbalance)]
    assert mean[2] > 10, "the unbalance has to work"
    assert np.ptp(heat - brought) > 1e2 * abs(mean[0] - mean[1]), "not at every instant"
    assert mean[0] == pytest.approx(mean[1], abs=2e-3 * mean[2])


def test_a_run_that_was_not_marched(run):
    with pytest.raises(package.NotInRunError, match="nothing was marched in time"):
        package.losses(run("equilibrium"))


def test_no_load(tiltpad, tmp_path):
    """Without a load there is no direction and no Sommerfeld number; the journal lies in the middle."""
    (tmp_path / "free.nml").write_text(
        "&case task='equilibrium' /\n&rotor gravity=0 /\n"
        "&pads pivot_angle_deg=0,90,180,270, centre_radial=0 /\n"
    )
    done = tiltpad("free.nml", cwd=tmp_path, status=0)
    assert "Sommerfeld" not in done.stdout
    with h5py.File(tmp_path / "free.h5") as file:
        assert file["equilibrium/eccentricity_ratio"][()] < 1e-6
        assert not {"attitude_angle", "sommerfeld_number"} & set(file["equilibrium"])
        np.testing.assert_allclose(file["equilibrium/power_loss"], file["equilibrium/power_loss"][0])
