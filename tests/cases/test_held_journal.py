"""Runs of a journal that is held at a place (group held)."""

import h5py
import numpy as np
import pytest

CASE = """&rotor mass = 2000, unbalance = 0, static_load = {load} /
&operation speed_rpm = 3000, rotation = '{rotation}' /
&bearing journal_radius = 0.1, axial_length = 0.1, assembled_clearance = 150e-6, preload = 0.3{viscosity} /
{pads}
"""
LEMON = "&pads motion = 'fixed', pivot_angle_deg = -90, 90, arc_deg = 160 /"
WARM = """&pads pivot_angle_deg = -54, 18, 90, 162, 234, arc_deg = 60 /
&oil grade = 46, supply_temperature = 45 / &thermal model = 'pad' /"""
LOAD = np.array([-2000 * 9.81, 8000])


@pytest.fixture
def found(tiltpad, tmp_path):
    """Equilibrium and coefficients of a case with these settings."""

    def run(case, *overrides):
        (tmp_path / "case.nml").write_text(case)
        words = ("case.nml", "-q", "--overwrite", "-o", "found.h5")
        tiltpad(*words, overrides=("case%task=coefficients", *overrides), cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "found.h5") as file:
            values = {name: file["equilibrium"][name][()] for name in file["equilibrium"]}
            return values | {name: file[f"coefficients/{name}"][0, 0] for name in ("stiffness", "damping")}

    return run


@pytest.mark.parametrize(
    "names",
    [
        {"rotation": "anticlockwise", "viscosity": ", viscosity = 0.02", "pads": LEMON},
        {"rotation": "clockwise", "viscosity": "", "pads": WARM},
    ],
    ids=("lemon", "warm"),
)
def test_a_journal_is_held_by_the_load_under_which_it_lies_there(found, names):
    """The journal of warm oil ends within 1e-7 of the clearance from its place, and K c/W is at most 10."""
    case = CASE.format(load="0, 8000", **names)
    free = found(case)
    assert "bearing_load_y" not in free
    ratio = f"held%eccentricity_ratio={free['eccentricity_ratio']:.17g}"
    attitude = f"held%attitude_deg={np.degrees(free['attitude_angle']):.17g}"
    position = f"held%position={free['journal_y']:.17g},{free['journal_z']:.17g}"
    for overrides in ((position, "rotor%static_load=0,0"), (ratio,), (ratio, attitude)):
        held = found(case, *overrides)
        load = np.array([held["bearing_load_y"], held["bearing_load_z"]])
        assert np.linalg.norm(load - LOAD) <= 1e-6 * np.linalg.norm(LOAD)
        for name in ("sommerfeld_number", "attitude_angle", "stiffness", "damping", "total_power_loss"):
            np.testing.assert_allclose(held[name], free[name], rtol=0, atol=2e-6 * np.abs(free[name]).max())


SHORT = """&rotor mass = 100, unbalance = 0 /
&operation speed_rpm = 3000 /
&bearing journal_radius = 0.05, axial_length = {length}, assembled_clearance = 50e-6, preload = 0,
  viscosity = 0.02 /
&film cavitation = 'gumbel' /
&asperity model = 'none' /
&pads motion = 'fixed', pivot_angle_deg = -90, arc_deg = 358 /
"""


@pytest.mark.parametrize("e", [0.2, 0.8])
def test_the_load_of_a_short_bearing_is_that_of_ocvirk(found, e):
    """Which it approaches with the square of the length: so does load over load - 1, and the attitude."""
    distances = []
    for length in (5e-3, 2.5e-3):
        held = found(SHORT.format(length=length), f"held%eccentricity_ratio={e}")
        root = np.sqrt(16 * e**2 + np.pi**2 * (1 - e**2))
        load = 0.02 * 100 * np.pi * 0.05 * length**3 / (4 * 50e-6**2) * e / (1 - e**2) ** 2 * root
        attitude = np.arctan(np.pi * np.sqrt(1 - e**2) / (4 * e))
        assert abs(held["bearing_load_z"]) <= 1e-7 * load
        distances.append((-held["bearing_load_y"] / load - 1, held["attitude_angle"] / attitude - 1))
    assert np.abs(distances[0]).max() <= 0.02
    np.testing.assert_allclose(np.divide(*distances), 4, rtol=0.05)


def test_a_centred_journal_needs_no_load(found):
    held = found(SHORT.format(length=0.05), "held%eccentricity_ratio=0")
    assert held["journal_y"] == held["journal_z"] == 0
    assert held["total_power_loss"] > 0
    assert abs(held["stiffness"][0, 1]) > 0


def test_a_study_over_the_eccentricity_is_a_table(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text(SHORT.format(length=0.05))
    settings = ("case%task=equilibrium", "sweep%held%eccentricity_ratio=0.2:0.8:0.2")
    tiltpad("case.nml", "-q", overrides=settings, cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "case.h5") as study:
        np.testing.assert_allclose(study["equilibrium_eccentricity_ratio"], [0.2, 0.4, 0.6, 0.8], rtol=1e-9)
        assert (np.diff(study["equilibrium_bearing_load_y"]) < 0).all()
        assert (np.diff(study["equilibrium_sommerfeld_number"]) < 0).all()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("held%eccentricity_ratio=0.5", "case%task=march"), "is for case%task = 'equilibrium' and "),
        (("held%eccentricity_ratio=0.5", "held%position=1e-5,0"), "give one of them"),
        (("held%attitude_deg=20",), "held%attitude_deg = 20: needs held%eccentricity_ratio"),
        (("held%position(1)=1e-5",), "both y and z must be given"),
        (("held%position=1e-5,0", "rotor%static_load=10,0"), "rotor%static_load is given too"),
        (("held%eccentricity_ratio=0.5", "rotor%gravity=0"), "needs a load, from whose direction"),
        (("held%eccentricity_ratio=0.5", "pads%bending=elastic"), "give the clearances in operation"),
    ],
)
def test_what_is_refused(tiltpad, tmp_path, settings, words):
    (tmp_path / "case.nml").write_text("&rotor unbalance = 0 /")
    done = tiltpad("case.nml", overrides=("case%task=equilibrium", *settings), cwd=tmp_path, status=1)
    assert words in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_place_in_a_pad_is_refused(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text(SHORT.format(length=0.05))
    settings = ("case%task=equilibrium", "held%position=-60e-6,0")
    done = tiltpad("case.nml", overrides=settings, cwd=tmp_path, status=2)
    assert "the journal held at y -60.000, z 0.000 um: the film of pad 1 closed" in done.stderr


def test_the_shaft_of_a_machine_is_not_held(tiltpad, root, tmp_path):
    settings = ("case%task=equilibrium", "held%eccentricity_ratio=0.5")
    done = tiltpad(root / "input/examples/overhung.nml", overrides=settings, cwd=tmp_path, status=1)
    assert "run each bearing alone" in done.stderr
