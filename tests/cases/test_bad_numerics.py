"""Runs that cannot go on: exit status 2, one line that says why, where and when; what was computed stays."""

import re

import h5py
import numpy as np
import pytest

NUMBER = r"-?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?"
SAMPLED = ("journal_y", "journal_z", "pad_tilt", "pivot_load", "min_film_thickness", "max_pressure")


def fails(tiltpad, folder, *values, options=()):
    """Runs a case with some values and checks that it fails as a run of numbers fails; gives the message."""
    (folder / "case.nml").write_text("&operation duration=0.05 / &output samples_per_revolution=60 /\n")
    run = tiltpad("case.nml", "--quiet", *options, overrides=values, cwd=folder, status=2)
    assert run.stdout == ""
    assert run.stderr.startswith("tiltpad: error: ")
    assert run.stderr.count("\n") == 1, run.stderr
    for word in ("At line", "Fortran runtime", "Backtrace", "HDF5-DIAG", "CVODE ERROR", "NaN"):
        assert word not in run.stderr
    return run.stderr


def stopped_in_the_march(folder, message):
    """Checks the kept file of a march that stopped and gives its times."""
    assert sorted(path.name for path in folder.iterdir()) == ["case.h5", "case.nml"]
    assert "case.h5" in message
    when = re.search(rf"t = ({NUMBER}) s", message)
    assert when, message
    with h5py.File(folder / "case.h5") as file:
        assert file.attrs["complete"] == 0
        assert file["equilibrium/residual"][()] < 1e-6
        assert "statistics" in file
        time = file["time"][:]
        assert len(time) > 0
        assert time[0] == 0
        assert np.all(np.diff(time) > 0)
        assert time[-1] <= float(when[1]) * (1 + 1e-5)
        for name in SAMPLED:
            assert len(file[name]) == len(time)
            assert np.all(np.isfinite(file[name][:]))
        assert np.all(file["min_film_thickness"][:] > 0)
    return time


def no_file_left(folder):
    assert [path.name for path in folder.iterdir()] == ["case.nml"]


CLOSING = {
    "unbalance": ["rotor%unbalance=1e4"],
    "unbalance, tilting only": ["rotor%unbalance=10", "pads%motion='tilting_only'"],
    "unbalance, friction": ["rotor%unbalance=10", "friction%model='lugre'"],
    "unbalance without weight": ["rotor%unbalance=10", "rotor%gravity=0"],
    "grade": ["rotor%balance_grade=1e5"],
}


@pytest.mark.parametrize("key", CLOSING)
def test_film_that_closes(tiltpad, tmp_path, key):
    message = fails(tiltpad, tmp_path, *CLOSING[key])
    assert re.search(rf"film of pad [12] (closed|is closing): thickness {NUMBER} m", message), message
    assert re.search(rf"step size {NUMBER} s", message), message
    stopped_in_the_march(tmp_path, message)


def test_closing_takes_no_steps_without_time(tiltpad, tmp_path):
    """Steps too short to move the clock lead nowhere: the march ends before it has done thousands of them."""
    message = fails(tiltpad, tmp_path, "rotor%unbalance=10")
    time = stopped_in_the_march(tmp_path, message)
    steps = int(re.search(r"after ([0-9]+) steps", message)[1])
    assert steps < 5000
    size = float(re.search(rf"step size ({NUMBER}) s", message)[1])
    assert size > 1e-20 * time[-1]


@pytest.mark.parametrize("steps", [1, 50])
def test_step_budget(tiltpad, tmp_path, steps):
    message = fails(tiltpad, tmp_path, f"integration%max_steps={steps}")
    assert f"after {steps} steps" in message
    assert "integration%max_steps" in message
    stopped_in_the_march(tmp_path, message)


def test_cap_at_the_start(tiltpad, tmp_path):
    """The equilibrium has SOR sweeps of its own, so that the first sample is what fails."""
    message = fails(tiltpad, tmp_path, "film%solver='sor'", "film%max_sweeps=1")
    assert re.search(
        rf"film of pad 1 did not converge: residual {NUMBER} after film%max_sweeps = 1\b", message
    )
    assert "t = 0 s" in message
    assert sorted(path.name for path in tmp_path.iterdir()) == ["case.h5", "case.nml"]
    with h5py.File(tmp_path / "case.h5") as file:
        assert file.attrs["complete"] == 0
        assert file["equilibrium/residual"][()] < 1e-6


def test_films_that_do_not_converge(tiltpad, tmp_path):
    message = fails(tiltpad, tmp_path, "film%solver='sor'", "film%tolerance=1e-13", "film%relaxation=1.999",
                    "film%max_sweeps=100")  # fmt: skip
    assert re.search(rf"film of pad [12] did not converge: residual {NUMBER} after film%max_sweeps", message)


ASTRAY = {
    "up": ["rotor%static_load=1e6,0"],
    "sideways": ["rotor%static_load=0,1e6"],
    "weightless, sideways": ["rotor%gravity=0", "rotor%static_load=0,100"],
    "pad on top only": ["pads%pivot_angle_deg=90"],
    "too heavy": ["rotor%mass=1e9"],
    "far too heavy": ["rotor%static_load=-1e12,0"],
    "pads that fall over": [
        "pads%mass=100",
        "pads%inertia=100",
        "pads%centre_tangential=0.5",
        "asperity%model='none'",
    ],
}


# what stands where nothing carries the load, and what may help
CAUSE = (
    "where no pad is|past the only pad|one pad: |push.* away|ha(s|ve) no equilibrium|"
    "leaves every equilibrium|did not (end|come to equilibrium)"
)


@pytest.mark.parametrize("key", ASTRAY)
def test_no_equilibrium(tiltpad, tmp_path, key):
    message = fails(tiltpad, tmp_path, *ASTRAY[key])
    assert "no equilibrium found" in message
    assert re.search(CAUSE, message), message
    no_file_left(tmp_path)


def test_no_equilibrium_keeps_the_earlier_result(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text("&case task='equilibrium' /\n")
    tiltpad("case.nml", cwd=tmp_path, status=0)
    earlier = (tmp_path / "case.h5").read_bytes()
    fails(tiltpad, tmp_path, "rotor%static_load=1e6,0", options=["--overwrite"])
    assert (tmp_path / "case.h5").read_bytes() == earlier
    assert sorted(path.name for path in tmp_path.iterdir()) == ["case.h5", "case.nml"]


# allowed or not, such values end with a message within the time of a test
EXTREMES = {
    "featherweight": ["rotor%mass=1e-300", "rotor%unbalance=0"],
    "pads of nothing": ["pads%mass=1e-300", "pads%inertia=1e-300"],
    "socket of nothing": ["pivot%socket_radius=1e-300", "pivot%radius_difference=0"],
    "almost at rest": ["operation%speed_rpm=1e-300"],
    "no clearance": ["bearing%assembled_clearance=1e-300"],
    "no time": ["operation%duration=1e-300"],
    "balanced almost at rest": ["rotor%balance_grade=2.5", "rotor%balance_speed_rpm=1e-300"],
}


@pytest.mark.parametrize("key", EXTREMES)
def test_extremes_end(tiltpad, tmp_path, key):
    (tmp_path / "case.nml").write_text("&operation duration=0.001 / &integration max_steps=2000 /\n")
    run = tiltpad("case.nml", "--quiet", overrides=EXTREMES[key], cwd=tmp_path)
    assert run.returncode in (1, 2)
    assert run.stderr.startswith("tiltpad: error: ")
    assert run.stderr.count("\n") == 1
    assert "NaN" not in run.stderr
    assert "with code" not in run.stderr


SYMMETRIC = {
    pads: (",".join(str(-90 + 360 * (i + 0.5) / pads) for i in range(pads)), 288 / pads)
    for pads in (3, 4, 5, 6)
}


@pytest.mark.parametrize("pads", SYMMETRIC)
def test_ordinary_bearings_have_an_equilibrium(tiltpad, tmp_path, pads):
    """Load between pads, light and heavy: no failure of the numerics where there is an equilibrium."""
    angles, arc = SYMMETRIC[pads]
    for mass in (200, 2000):
        (tmp_path / "case.nml").write_text(
            f"&case task='equilibrium' / &rotor mass={mass} /\n"
            f"&pads pivot_angle_deg={angles}, arc_deg={arc} /\n"
        )
        tiltpad("case.nml", "--quiet", "--overwrite", cwd=tmp_path, status=0)
