"""Branches of equilibria and thresholds with temperatures along and across films."""

import re
import shlex

import h5py
import numpy as np
import pytest

FILM = "&oil grade=46 /\n&thermal model='film' /\n"
#: Of the paper's bearing with full films.
FULL = "&rotor mass=200 /\n&film cavitation='none' /\n" + FILM
#: Five pads whose films cavitate, three of them without load; with few cells, as all that is compared.
FIVE = (
    "&rotor mass=1500 /\n&operation speed_rpm=5000 /\n"
    "&bearing journal_radius=63.5e-3, axial_length=63.5e-3, assembled_clearance=0.2e-3, preload=0.3 /\n"
    "&pads pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=60, pivot_ratio=0.5, density=7850,\n"
    "  thickness=20e-3, pivot_distance=20e-3 /\n&film circumferential_cells=40, axial_cells=6 /\n" + FILM
)
#: A heavy rotor on thin oil. Where a pad has one temperature its equilibrium ends at 6242 kg, in a fold.
THIN = (
    "&rotor mass=5000 /\n&operation speed_rpm=3000 /\n&pads motion='tilting_only' /\n"
    "&film cavitation='none' /\n&oil grade=10 /\n&thermal model='film' /\n"
)


def branch_over(parameter, first, last, step):
    """Overrides for a branch of equilibria."""
    return (
        "case%task='branch'",
        "branch%of='equilibrium'",
        f"branch%parameter='{parameter}'",
        f"{parameter}={first}",
        f"branch%last={last}",
        f"branch%step={step}",
    )


@pytest.mark.parametrize(
    ("text", "parameter", "low", "high", "step"),
    [
        (FULL, "operation%speed_rpm", 4000, 13500, 500),
        (FIVE, "operation%speed_rpm", 3000, 9000, 500),
        (FIVE, "rotor%mass", 800, 2500, 200),
        (FIVE, "oil%supply_temperature", 40, 50, 1),
    ],
    ids=["full films over speed", "speed", "load", "supply"],
)
def test_the_last_point_is_the_equilibrium_there(run, tmp_path, text, parameter, low, high, step):
    """Up and down: the first point of either is the equilibrium that is sought there, with the same films.

    Temperatures agree to 1e-6 K in a round; how much the sum of all further rounds would change was below
    ten times as much in these.
    """
    run(text, *branch_over(parameter, low, high, step), name="up")
    run(text, *branch_over(parameter, high, low, -step), name="down")
    with h5py.File(tmp_path / "up.h5") as up, h5py.File(tmp_path / "down.h5") as down:
        for here, there in ((0, -1), (-1, 0)):
            assert up["parameter"][here] == down["parameter"][there]
            for name in ("inlet", "mean", "outlet", "maximum"):
                name = f"{name}_temperature"
                np.testing.assert_allclose(up[name][here], down[name][there], atol=1e-5, err_msg=name)
            for name in ("min_film_thickness", "viscosity", "journal_y_max", "shaft_temperature"):
                np.testing.assert_allclose(up[name][here], down[name][there], rtol=1e-6, err_msg=name)
        # a branch leads somewhere
        assert np.abs(up["mean_temperature"][0] - up["mean_temperature"][-1]).max() > 1
        # and its points do not wander
        assert (np.diff(up["parameter"][:]) > 0).all()


def test_a_branch_goes_on_behind_the_fold_of_an_unloaded_pad(run, tmp_path):
    """Pad 2 tips: the branch turns back, wherever it began.

    A fold is located to 1e-7 of the temperature. Another part of the branch is warmer than the fold; a long
    step must not leap to it.
    """
    folds = []
    for first in (50, 54):
        name = f"from {first}"
        run(FIVE, *branch_over("oil%supply_temperature", first, 80, 1), "branch%max_points=24", name=name)
        with h5py.File(tmp_path / f"{name}.h5") as file:
            kinds = [kind.decode() for kind in file["bifurcations/kind"]]
            assert kinds.count("fold") == 1
            folds.append(file["bifurcations/parameter"][kinds.index("fold")])
            parameter = file["parameter"][:]
        assert parameter.max() <= folds[-1] * (1 + 2e-7)
        # behind the fold, where points before it were colder
        assert parameter.argmax() < parameter.size - 1
        assert parameter[-1] < folds[-1] - 1e-4
    assert folds[0] == pytest.approx(folds[1], rel=2e-7)


def test_oil_that_does_not_thin_has_the_branch_of_cold_oil(run, tmp_path):
    steady = FULL.replace("grade=46", "reference_viscosity=0.02, temperature_exponent=0")
    over = branch_over("operation%speed_rpm", 13500, 15500, 250)
    run(steady, *over, name="film")
    run(steady, *over, "thermal%model='none'", "film%solver='direct'", name="none")
    with h5py.File(tmp_path / "film.h5") as warm, h5py.File(tmp_path / "none.h5") as cold:
        assert warm["mean_temperature"][-1].max() > warm["mean_temperature"][0].max() + 1
        for name in ("parameter", "journal_y_max", "min_film_thickness", "eigenvalue_real"):
            # differences of the way to a point of the branch; it is the same branch
            scale = np.abs(cold[name]).max()
            np.testing.assert_allclose(warm[name], cold[name], atol=1e-6 * scale, err_msg=name)


def test_a_threshold_is_where_coefficients_change_their_sign(run, tmp_path):
    """Two runs beside it, of which each finds its own temperatures, have it between them; so has a branch."""
    run(
        FULL,
        "case%task='coefficients'",
        "operation%speed_rpm=15000",
        "coefficients%threshold_up_to_rpm=18000",
        name="threshold",
    )
    with h5py.File(tmp_path / "threshold.h5") as file:
        found = file["modes/threshold_rpm"][0]
    assert 15000 < found < 18000
    growth, speeds = [], found * np.array([0.998, 1.002])
    for speed in speeds:
        run(FULL, "case%task='coefficients'", f"operation%speed_rpm={speed}", name="beside")
        with h5py.File(tmp_path / "beside.h5") as file:
            growth.append(np.nanmax(file["modes/eigenvalue_real"][0]))
        (tmp_path / "beside.h5").unlink()
    assert growth[0] < 0 < growth[1]
    # what a straight line through both misses
    assert np.interp(0, growth, speeds) == pytest.approx(found, rel=1e-5)
    run(FULL, *branch_over("operation%speed_rpm", 16800, 17400, 100), name="branch")
    with h5py.File(tmp_path / "branch.h5") as file:
        assert list(file["bifurcations/kind"]) == [b"hopf"]
        assert file["bifurcations/parameter"][0] == pytest.approx(found, rel=1e-6)


def test_heat_that_ends_a_branch(run, tmp_path):
    """Films alone, without asperities, come to the load at which their oil boils."""
    said = run(THIN + "&asperity model='none' /\n", *branch_over("rotor%mass", 5000, 60000, 2000)).stdout
    with h5py.File(tmp_path / "case.h5") as file:
        assert file.attrs["complete"] == 1
        last = file["parameter"][-1]
        assert b"fold" not in file["bifurcations/kind"][()]
        # within a shortest step, 1e-4 of the first, of the last load without boiling; oil is hotter than pads
        assert 299 < file["maximum_temperature"][-1].max() < 300
    assert 20000 < last < 60000
    assert f"branch 1 ends at rotor%mass = {last:.5f}" in said
    # under a load between the pads both are as hot
    assert re.search(r"in the hottest place of the film of pad [12] would have 301 C, above 300 C", said)


def test_heat_of_asperities_that_folds_a_branch(run, tiltpad, tmp_path):
    """Beyond the load at which one temperature a pad has no balance; a refusal names the branch to there."""
    run(THIN, *branch_over("rotor%mass", 5000, 60000, 2000), "branch%max_points=16")
    with h5py.File(tmp_path / "case.h5") as file:
        assert list(file["bifurcations/kind"]) == [b"fold"]
        fold = file["bifurcations/parameter"][0]
        assert fold > 8000
        # behind the fold less load is hotter
        assert file["parameter"][-1] < fold - 10
        hottest = file["maximum_temperature"][()].max(axis=1)
        assert (hottest[1:] > hottest[:-1]).all()
    refusal = run(THIN, "case%task='equilibrium'", "rotor%mass=8000", name="alone", status=2).stderr
    assert "where mineral oil boils" in refusal
    assert "one temperature a pad, with which the search begins" in refusal
    # the branch that it names leads to this load all the same
    _, hint = refusal.split("a branch of equilibria shows how far there are some: ")
    told = tiltpad("alone.nml", *shlex.split(hint), "--output", "told.h5", cwd=tmp_path, status=0).stdout
    assert "branch 1 ends at rotor%mass = 8000.000000: the last value" in told


def test_the_hottest_oil_boils_in_runs_studies_and_branches(run, tiltpad, tmp_path):
    """Viscous oil on a fast shaft: that of the hottest place boils far above what leaves the pad."""
    viscous = (
        "&pads motion='tilting_only' /\n&oil grade=220 /\n&thermal model='film' /\n&film axial_cells=5 /\n"
    )
    rest = viscous + "&case task='equilibrium' /\n"
    boils = r"the oil in the hottest place of the film of pad 1 would have 3\d\d C, above 300 C"
    said = run(viscous, *branch_over("operation%speed_rpm", 31000, 40000, 1000), name="branch").stdout
    assert re.search(boils, said)
    with h5py.File(tmp_path / "branch.h5") as file:
        last = file["parameter"][-1]
    # the speed at which its table of films and that of a single run boil differs by less than 1e-3
    below, above = 0.998 * last, 1.002 * last
    assert re.search(boils, run(rest, f"operation%speed_rpm={above}", name="beyond", status=2).stderr)
    run(rest, f"operation%speed_rpm={below}", name="below")
    with h5py.File(tmp_path / "below.h5") as file:
        assert 299 < file["equilibrium/film_temperature"][()].max() < 300
        assert file["equilibrium/outlet_temperature"][()].max() < 120
    speeds = f"sweep%operation%speed_rpm={below}, {above}"
    study = tiltpad("below.nml", "--output", "study", overrides=(speeds,), cwd=tmp_path)
    assert study.returncode == 2
    assert re.search(rf"run 2 .*{boils}", study.stderr)
