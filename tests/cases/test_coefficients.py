"""Whole runs of the task coefficients: what the file says, and studies."""

import re

import h5py
import numpy as np
import pytest

TASK = "case%task=coefficients"


def test_file_fits_its_own_matrices(tiltpad, root, tmp_path):
    """Modes follow from the full matrices: the same by numpy, to rounding. Coefficients are in tests/post."""
    case, overrides = root / "input/paper/steady_lugre.nml", (TASK, "coefficients%cross_stiffness=2e7")
    tiltpad(case, "-q", "-o", "found.h5", overrides=overrides, cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "found.h5") as file:
        assert list(file["pivot"].asstr()) == ["free", "stuck", "locked"]
        names = ["y", "z", "tilt_1", "pivot_deflection_1", "tilt_2", "pivot_deflection_2"]
        assert list(file["position_row"].asstr()) == list(file["position_column"].asstr()) == names
        group, modes = file["coefficients"], file["modes"]
        for pivot in range(3):
            check_modes(group, modes, pivot)
        tilts = np.ix_([2, 4], range(6))
        assert np.isnan(group["full_stiffness"][2][tilts]).all()
        assert np.isfinite(group["full_stiffness"][1]).all()
        assert (modes["shape_real"][2, 0][[2, 4]] == 0).all()


def test_the_console_has_five_digits_of_the_largest_element(tiltpad, root, tmp_path):
    case = root / "input/paper/steady_lugre.nml"
    said = tiltpad(case, "-o", "found.h5", overrides=(TASK,), cwd=tmp_path, status=0).stdout
    told = re.search(r"pivots free:\n  whirl at 1 of the speed: K (.*) MN/m, C (.*) MN s/m \(", said)
    with h5py.File(tmp_path / "found.h5") as file:
        for text, name in zip(told.groups(), ("stiffness", "damping"), strict=True):
            values = 1e-6 * np.ravel(file["coefficients"][name][0, 0])
            last = 10.0 ** (np.floor(np.log10(np.abs(values).max())) - 4)
            assert [float(each) for each in text.split(", ")] == pytest.approx(values, rel=0, abs=0.51 * last)
            assert {len(each.partition(".")[2]) for each in text.split(", ")} == {round(-np.log10(last))}


def check_modes(group, modes, pivot):
    """Eigenvalues, their order and shapes against numpy."""
    stiffness, damping, mass = (group[f"full_{name}"][:] for name in ("stiffness", "damping", "mass"))
    moves = np.isfinite(np.diag(stiffness[pivot]))
    kept = np.ix_(moves, moves)
    m, c, k = (mass + np.diag([2000, 2000, 0, 0, 0, 0]))[kept], damping[pivot][kept], stiffness[pivot][kept]
    k = k.copy()
    k[0, 1] += 2e7
    k[1, 0] -= 2e7
    n = len(m)
    matrix = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]])
    expected = np.linalg.eigvals(matrix)
    expected = expected[expected.imag >= 0]
    found = modes["eigenvalue_real"][pivot] + 1j * modes["eigenvalue_imag"][pivot]
    found = found[np.isfinite(found)]
    assert len(found) == len(expected)
    apart = np.abs(found[:, None] - expected).min(axis=1)
    assert (apart <= 1e-8 * np.abs(found)).all()
    ratio = modes["damping_ratio"][pivot][: len(found)]
    assert (np.diff(ratio) >= 0).all()
    np.testing.assert_allclose(ratio, -found.real / np.abs(found), rtol=1e-12)
    shape = (modes["shape_real"][pivot] + 1j * modes["shape_imag"][pivot])[: len(found), moves]
    for value, form in zip(found, shape, strict=True):
        left = (m * value**2 + c * value + k) @ form
        assert np.abs(left).max() <= 1e-6 * np.abs(k @ form).max()


#: Five fixed pads with the load between two of them, whose films are three quarters cavitated.
FIXED = """&rotor mass=2487.674 /
&operation speed_rpm=11809.48 /
&bearing journal_radius=0.06088811, axial_length=0.05360372, assembled_clearance=8.969680e-05,
  preload=0.1503714, viscosity=0.008041341 /
&pads motion='fixed', pivot_angle_deg=-54, 18, 90, 162, -126, arc_deg=51.54564 /
"""
CLEARANCE = 8.969680e-05


def test_the_equilibrium_is_that_of_converged_films(tiltpad, tmp_path):
    """As coefficients have it, to the last bit; and it lies where that of volumes lies that are four times as
    fine as those with which the search ends, which err by 1.2e-4: by 1.6e-5 of the clearance, in which the
    volumes have a part of 1.2e-4/4^2."""
    (tmp_path / "case.nml").write_text(FIXED)

    def journal(task, *overrides):
        overrides = (f"case%task={task}", *overrides)
        words = ("case.nml", "-q", "--overwrite", "-o", "found.h5")
        tiltpad(*words, overrides=overrides, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "found.h5") as file:
            return np.array([file["equilibrium/journal_y"][()], file["equilibrium/journal_z"][()]])

    found = journal("equilibrium")
    assert (found == journal("coefficients")).all()
    volumes = ("film%solver=direct", "film%circumferential_cells=320", "film%axial_cells=32")
    assert np.linalg.norm(found - journal("equilibrium", *volumes)) <= 4e-5 * CLEARANCE


#: Four pads with the load on one, whose neighbours lie in films of even thickness.
EVEN = """&rotor mass=180, unbalance=0 /
&operation speed_rpm=3000 /
&bearing journal_radius=0.05, axial_length=0.1, assembled_clearance=100e-6, preload=0, viscosity=0.02 /
&pads motion='tilting_only', pivot_angle_deg=-90,0,90,180, arc_deg=80, {} /
"""


def test_a_film_that_only_just_begins_to_carry_is_told(tiltpad, tmp_path):
    """Pads without weight lie beside the journal without pressure, where C_zz is half of that of steel pads,
    whose weight the films carry: one side counts, the other does not."""
    light = "mass=1e-3, inertia=1e-7, centre_tangential=0, centre_radial=0"
    steel = "density=7850, thickness=0.02, pivot_distance=0.02"
    damping = {}
    for name, pads, told in (("light", light, True), ("steel", steel, False)):
        (tmp_path / f"{name}.nml").write_text(EVEN.format(pads))
        said = tiltpad(f"{name}.nml", overrides=(TASK,), cwd=tmp_path, status=0).stdout
        assert ("the film of pad 2 only just begins to carry" in said) == told
        with h5py.File(tmp_path / f"{name}.h5") as file:
            assert file["coefficients/one_sided"][:].any() == told
            damping[name] = file["coefficients/damping"][0, 0, 1, 1]
    assert damping["light"] == pytest.approx(0.5 * damping["steel"], rel=0.01)


def test_study_goes_on_without_equilibrium(tiltpad, root, tmp_path):
    """A load between pads that nothing carries: its run is marked, the others are whole."""
    loads = "sweep%rotor%static_load(2)=0,1e5,1000"
    arguments = (
        "--output",
        tmp_path / "map",
        "--quiet",
        "--set",
        TASK,
        "--set",
        loads,
        "--set",
        "output%keep='all'",
    )
    done = tiltpad(root / "input/paper/steady_tr.nml", *arguments)
    assert done.returncode == 2
    assert "run 2 (rotor%static_load(2) = 1e5): no equilibrium found" in done.stderr
    for number, complete in ((1, 1), (2, 0), (3, 1)):
        with h5py.File(tmp_path / "map" / f"{number:04d}.h5") as file:
            assert file.attrs["complete"] == complete
            assert ("coefficients" in file) == bool(complete)


#: Four pads on flexure pivots; the upper right one of them carries nothing, so that only its pivot holds it.
FLEXURES = """
&case task='coefficients' / &rotor mass=450 / &operation speed_rpm=8000 /
&bearing journal_radius=58.4e-3, axial_length=76.2e-3, machined_clearance=254e-6,
  assembled_clearance=190.5e-6, viscosity=0.019 /
&pads pivot_angle_deg=-45, 45, 135, 225, arc_deg=72, mass=1.226, inertia=7.448e-4, motion='tilting_only' /
&pivot rotational_stiffness=1770 / &coefficients threshold_up_to_rpm=12000 /
"""


def test_what_neither_film_nor_damper_holds_has_no_growth_of_rounding(tiltpad, tmp_path):
    """A pad without load on a flexure pivot is not damped: no instability, and no threshold speed."""
    (tmp_path / "case.nml").write_text(FLEXURES)
    done = tiltpad("case.nml", cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "case.h5") as file:
        modes = file["modes"]
        pads, rotor = (file[f"summary/{who}_damping_ratio"][0] for who in ("pads", "rotor"))
        undamped = modes["damping_ratio"][0] == 0
        assert undamped.sum() == 1
        # its pivot turns it back, and to a few 1e-5 its weight
        alone = np.sqrt(1770 / 7.448e-4) / (2 * np.pi)
        np.testing.assert_allclose(modes["frequency"][0][undamped], alone, rtol=1e-4)
        assert pads == 0 < rotor
        assert np.isnan(modes["threshold_rpm"][0])
    assert "the pads are stable:" in done.stdout
    assert "pads are unstable" not in done.stdout
    assert not re.search(r"-0\.0*\b(?!\d)", done.stdout)
