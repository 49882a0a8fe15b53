"""Whole runs in which pads touch the journal."""

import h5py
import numpy as np
import pytest

#: The top pad of the five-pad bearing with light pads flutters until its edge strikes the journal.
FIVE_PADS = (
    "title='five pads' / &rotor mass=1500, balance_grade=2.5 / &operation speed_rpm=7000, duration=0.3 / "
    "&bearing journal_radius=63.5e-3, preload=0.3, assembled_clearance=2e-4, axial_length=63.5e-3, "
    "viscosity=0.022 / &pads pivot_angle_deg=-54,18,90,162,234, arc_deg=60, mass=0.8108, inertia=4.055e-4, "
    "centre_radial=-10.1e-3, centre_tangential=0"
)
#: A pad above a slow journal, pushed down with its leading edge ahead.
DROPPED = (
    "title='dropped' / &rotor unbalance=0 / &operation speed_rpm=600, duration=3 / "
    "&pads pivot_angle_deg=-45,225,90 / "
    "&start pad_tilt_rate=0,0,-40, pivot_deflection=0,0,80e-6, pivot_deflection_rate=0,0,-0.05"
)
ROUGHNESS = 0.5e-6


@pytest.fixture
def run(tiltpad, tmp_path):
    """Runs a case and returns what it said and its file."""
    files = []

    def run(case, *overrides):
        (tmp_path / "case.nml").write_text(f"&case {case} /\n")
        options = [word for override in overrides for word in ("--set", override)]
        done = tiltpad("case.nml", *options, "--overwrite", cwd=tmp_path)
        files.append(h5py.File(tmp_path / "case.h5"))
        return done, files[-1]

    yield run
    for file in files:
        file.close()


def test_an_edge_that_strikes_the_journal(run):
    """It bounces, and the run goes on; the top pad alone touches, below 4 roughness heights alone."""
    done, file = run(FIVE_PADS)
    assert done.returncode == 0, done.stderr
    force, film = file["asperity_force"][:], file["min_film_thickness"][:]
    touching = force > 0
    assert touching.any(axis=0).tolist() == [False, False, True, False, False]
    strikes = (touching[1:, 2] & ~touching[:-1, 2]).sum()
    assert strikes > 3
    assert np.array_equal(touching, film < 4 * ROUGHNESS)
    assert film.min() > -4 * ROUGHNESS
    assert "pad 3 touched the journal for" in done.stdout
    assert "pad 2 touched" not in done.stdout


def test_what_the_file_says_of_contact(run):
    _, file = run(FIVE_PADS)
    force = file["asperity_force"][:]
    np.testing.assert_array_equal(file["summary/pad_asperity_force"], force.max(axis=0))
    share = force.max(axis=0) / (1500 * 9.81)
    np.testing.assert_allclose(file["summary/pad_asperity_share"], share, rtol=1e-12)
    step = file["time"][1] - file["time"][0]
    np.testing.assert_allclose(file["summary/pad_asperity_time"], step * (force > 0).sum(axis=0), rtol=1e-9)


def test_without_asperities_a_film_that_closes_ends_the_run(run):
    done, file = run(FIVE_PADS, "asperity%model='none'")
    assert done.returncode == 2
    assert "the film of pad 3" in done.stderr
    assert "asperity_force" not in file
    assert "asperities" not in file


def test_a_pad_dropped_on_a_rotating_journal(run):
    """Its edge rubs, and asperities and film bear its weight; then it takes off, and the film bears it."""
    done, file = run(DROPPED)
    assert done.returncode == 0, done.stderr
    weight = 0.8108 * 9.81
    asperities, film = file["asperity_force"][:, 2], file["film_force_radial"][:, 2]
    rubbing = np.flatnonzero(asperities > 0)
    assert 0.03 < file["summary/pad_asperity_time"][2] < 0.2
    assert asperities[rubbing].mean() > 0.2 * weight
    middle = slice(rubbing[len(rubbing) // 4], rubbing[3 * len(rubbing) // 4])
    # the asperities push along the radius at the edge, 34.65 degrees from the pivot, and friction 0.1 across
    leading = np.cos(np.radians(34.65)) + 0.1 * np.sin(np.radians(34.65))
    carried = -film[middle] + leading * asperities[middle]
    assert carried.mean() == pytest.approx(weight, rel=0.05)
    assert (asperities[-1000:] == 0).all()
    assert -film[-360:].mean() == pytest.approx(weight, rel=1e-3)


@pytest.mark.parametrize("mass", [10, 20, 42.8])
def test_asperities_that_touch_nowhere_find_no_equilibrium_that_is_none_without(tiltpad, tmp_path, mass):
    """Without preload one pad has no film where the journal starts, and its weight closes it: it waits at the
    journal until this has moved to where it has one."""
    (tmp_path / "case.nml").write_text(
        f"""&case task='equilibrium' /
&rotor mass={mass} /
&operation speed_rpm=3000 /
&bearing journal_radius=0.05, axial_length=0.1, assembled_clearance=100e-6, preload=0, viscosity=0.02 /
&pads motion='tilting_only', pivot_angle_deg=-90,0,90,180, arc_deg=80, thickness=0.02, pivot_distance=0.02,
  density=7850 /
"""
    )
    found = {}
    for model in ("none", "greenwood_tripp"):
        overrides = (f"asperity%model={model}",)
        tiltpad("case.nml", "-q", "-o", f"{model}.h5", overrides=overrides, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / f"{model}.h5") as file:
            found[model] = np.array([file[f"equilibrium/{name}"][()] for name in ("journal_y", "journal_z")])
    np.testing.assert_allclose(found["none"], found["greenwood_tripp"], rtol=0, atol=1e-6 * 100e-6)


def test_a_light_vibration_of_a_pad_is_none_of_the_integrator(run):
    """An unloaded pad leans on the journal, on a rigid pivot: its vibration of 1496 Hz loses a factor e in
    1600 revolutions, and steps that excite it would let it grow from 1.7 N of the asperities to 5.7."""
    case = (
        "title='light' / &rotor mass=1451.9886, balance_grade=1 / "
        "&operation speed_rpm=8942.476, duration=0.5 / "
        "&bearing journal_radius=0.04930860, axial_length=0.07543974, assembled_clearance=6.806701e-05, "
        "preload=0, viscosity=0.05436422 / &pads pivot_angle_deg=-90,-18,54,126,-162, arc_deg=61.04297, "
        "pivot_ratio=0.5120576, motion='tilting_only', density=7850, thickness=0.01836587, "
        "pivot_distance=0.01836587 / "
        "&pivot socket_radius=0.008869698, radius_difference=0 / &film cavitation='gumbel' / "
        "&friction model='none' / &asperity roughness=2.285961e-07"
    )
    found = []
    for tolerance in ("1e-5", "1e-6"):
        done, file = run(case, f"integration%relative_tolerance={tolerance}")
        assert done.returncode == 0, done.stderr
        tilt = file["pad_tilt"][:, 2]
        # the force goes with the power 6.8 of how deep the asperities lie
        found.append((np.ptp(tilt[len(tilt) // 2 :]), file["asperity_force"][:, 2].max() ** (1 / 6.8)))
    np.testing.assert_allclose(*found, rtol=0.01)
