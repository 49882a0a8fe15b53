"""Machines that are stopped and go on, and marches that start from other results.

They end as those that were not disturbed, and what no longer fits is refused in one line.
"""

import shutil
import signal

import h5py
import numpy as np
import pytest
from conftest import EVERY_STEP, TIMEOUT, arrays, one_error, shorten, wait_for, wait_for_checkpoint
from test_machine_input import beam, write

MACHINE = """
&shaft length=0.05, 0.05, 4*0.25, 0.05, 0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=5, mass=800, polar_inertia=60, diametral_inertia=35 /
&unbalance station=5, moment=0.01 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
&support bearing='right', mass=200, stiffness=2*5e8, damping=2*1e5 /
"""
MARCHES = {
    "friction": "&operation speed_rpm=3000, duration=0.3 /\n&friction model='lugre' /\n",
    "run-up": "&operation speed_rpm=2000, final_speed_rpm=4000, duration=0.5 /\n",
    "warm films": "&operation speed_rpm=3000, duration=0.2 /\n&oil grade=46 /\n&thermal model='film' /\n",
    "element": "&operation speed_rpm=3000, duration=0.2 /\n"
    "&element station=4, stiffness=2e7, 1e6, -1e6, 2e7, static=.false. /\n",
    "pads that pitch": "&operation speed_rpm=3000, duration=0.1 /\n&friction model='lugre' /\n"
    "&pads motion='tilting_radial_pitch_yaw' /\n",
    "last revolutions": "&operation speed_rpm=3000, duration=0.3 /\n&output keep='last_revolutions' /\n",
}
BRANCH = """&case task='branch' /
&operation speed_rpm=3000 /
&output samples_per_revolution=60 /
&branch of='equilibrium', parameter='operation%speed_rpm', last=3400, step=50, max_step=50 /
"""
#: What each stretch of a run has of its own, and the input, where the time between checkpoints may change.
OWN = {"created", "ended", "history", "resumes", "input"}


def stop(start, folder, number=signal.SIGTERM, *, resume=False, after=0.0):
    """Stops case.nml at a checkpoint, of a march one behind this time."""
    path = folder / "case.h5"
    words = ("--resume", "case.h5") if resume else ()
    process = start(folder, *words, "case.nml", "-q", *EVERY_STEP)
    wait_for_checkpoint(path, process)
    wait_for(lambda: reached(path) > after, process)
    process.send_signal(number)
    process.wait(TIMEOUT)
    return path


def reached(path):
    with h5py.File(path) as file:
        return file["checkpoint/time"][()]


@pytest.mark.parametrize("what", MARCHES)
def test_a_march_ends_as_the_undisturbed_one(run, start, tiltpad, tmp_path, what):
    """Stopped once, killed once: the same samples, within the errors of both."""
    run(MARCHES[what] + MACHINE, name="whole")
    (tmp_path / "case.nml").write_text(MARCHES[what] + MACHINE)
    stop(start, tmp_path)
    stop(start, tmp_path, signal.SIGKILL, resume=True, after=0.01)
    tiltpad("--resume", "case.h5", "case.nml", "-q", cwd=tmp_path, status=0)
    own, whole = (arrays(tmp_path / name, "statistics") for name in ("case.h5", "whole.h5"))
    assert own.keys() == whole.keys()
    for name, bearing in (("station_y", ""), ("station_z", ""), ("pad_tilt", "bearings/left/")):
        size = np.ptp(whole[bearing + name], axis=0).max()
        assert abs(own[bearing + name] - whole[bearing + name]).max() < 2e-3 * size
    np.testing.assert_array_equal(own["time"], whole["time"])
    assert own["rotor/turned_time"] == whole["rotor/turned_time"]


def test_a_branch_goes_on_to_the_bit(run, start, tiltpad, tmp_path):
    run(BRANCH + MACHINE, name="whole")
    (tmp_path / "case.nml").write_text(BRANCH + MACHINE)
    process = start(tmp_path, "case.nml", "-q", *EVERY_STEP)
    wait_for_checkpoint(tmp_path / "case.h5", process)
    process.terminate()
    one_error(process, 4)
    tiltpad("--resume", "case.h5", "case.nml", "-q", cwd=tmp_path, status=0)
    own, whole = (arrays(tmp_path / name, "statistics") for name in ("case.h5", "whole.h5"))
    assert own.keys() == whole.keys()
    for name, values in whole.items():
        np.testing.assert_array_equal(own[name], values, err_msg=name)
    with h5py.File(tmp_path / "case.h5") as one, h5py.File(tmp_path / "whole.h5") as other:
        assert one.attrs["resumes"] == 1
        for name in set(one.attrs) - OWN:
            assert one.attrs[name] == other.attrs[name], name


GIVEN = """&operation speed_rpm=600, duration=1000 /
&rotor file='rotor.h5' /
&unbalance station=3, moment=1e-3 /
&bearing name='a', station=1 /
&bearing name='b', station=5 /
"""
TABLE = "&operation speed_rpm=600, duration=1000 /\n&excitation kind='table', file='force.csv' /\n"


def write_rotor(folder, more):
    matrices = beam()
    matrices["stiffness"] = matrices["stiffness"] * (1 + more)
    write(folder / "rotor.h5", matrices)


def write_force(folder, more):
    (folder / "force.csv").write_text(f"time,force_y,force_z\n0,0,0\n0.1,{1 + more!r},0\n9,0,0\n")


@pytest.mark.parametrize(
    ("case", "make", "variable"),
    [(GIVEN, write_rotor, "rotor%file"), (TABLE, write_force, "excitation(1)%file")],
    ids=["rotor", "table"],
)
def test_a_file_that_has_changed_is_no_way_on(start, tiltpad, tmp_path, case, make, variable):
    """A part in 1e15 more is another case; the same numbers, written anew, are the same."""
    make(tmp_path, 0.0)
    (tmp_path / "case.nml").write_text(case)
    path = stop(start, tmp_path)
    (tmp_path / "case.nml").write_text(case.replace("1000", repr(shorten(path))))
    make(tmp_path, 1e-15)
    line = tiltpad("--resume", "case.h5", "-q", cwd=tmp_path, status=3).stderr
    why = f"is the result of another case; the file that {variable} names has changed since"
    assert line == f"tiltpad: error: case.h5: {why}\n"
    line = tiltpad("case.nml", "-q", cwd=tmp_path, status=3).stderr
    assert f"{why}; --overwrite replaces it" in line
    make(tmp_path, 0.0)
    tiltpad("--resume", "case.h5", "-q", cwd=tmp_path, status=0)
    with h5py.File(path) as file:
        assert file.attrs["complete"] == 1


@pytest.mark.parametrize(
    ("case", "make", "varied"),
    [
        (GIVEN, write_rotor, "sweep%operation%speed_rpm=600,700"),
        (TABLE, write_force, "sweep%operation%speed_rpm=600,700"),
        (TABLE, write_force, "sweep%excitation(1)%file='other.csv','force.csv'"),
    ],
    ids=["rotor", "table", "second table"],
)
def test_a_study_does_not_go_on_with_other_files(tiltpad, tmp_path, case, make, varied):
    """Its rows would be of two rotors; the same numbers, written anew, are the same."""
    make(tmp_path, 0.5)
    if (tmp_path / "force.csv").exists():
        (tmp_path / "force.csv").rename(tmp_path / "other.csv")
    make(tmp_path, 0.0)
    (tmp_path / "case.nml").write_text(case.replace("1000", "0.01"))
    tiltpad("case.nml", "-q", overrides=[varied], cwd=tmp_path, status=0)
    make(tmp_path, 1e-15)
    line = tiltpad("case.nml", "-q", overrides=[varied], cwd=tmp_path, status=3).stderr
    assert "case.h5: is the study of another case, or of files that have changed since" in line
    make(tmp_path, 0.0)
    tiltpad("case.nml", "-q", overrides=[varied], cwd=tmp_path, status=0)


@pytest.fixture(scope="module")
def orbit(tiltpad, tmp_path_factory):
    """A folder with first.h5, a march that has come to its orbit."""
    folder = tmp_path_factory.mktemp("orbit")
    (folder / "first.nml").write_text("&operation speed_rpm=3000, duration=0.6 /\n" + MACHINE)
    tiltpad("first.nml", "-q", cwd=folder, status=0)
    return folder


def begun(tiltpad, folder, text, *overrides, status=0):
    """A march from first.h5."""
    own = "&operation duration=0.1 /\n&start from='file', file='first.h5' /\n"
    (folder / "next.nml").write_text(own + text)
    return tiltpad("next.nml", "--overwrite", overrides=overrides, cwd=folder, status=status)


def test_a_march_goes_on_from_the_orbit_of_another(tiltpad, orbit):
    """It begins where the shaft had turned whole revolutions, in that very state, and keeps the orbit."""
    said = begun(tiltpad, orbit, MACHINE, "operation%speed_rpm=3000").stdout
    assert said.count("start from 'file': bearing '") == 2
    first, after = (arrays(orbit / name) for name in ("first.h5", "next.h5"))
    at = np.searchsorted(first["time"], first["rotor/turned_time"])
    assert first["shaft_angle"][at] % (2 * np.pi) == pytest.approx(0, abs=1e-9) or 2 * np.pi
    for name in ("station_y", "station_z", "bearings/left/pad_tilt", "bearings/right/journal_vz"):
        np.testing.assert_allclose(after[name][0], first[name][at], rtol=0, atol=1e-12)
        change = abs(after[name][:361] - first[name][at - 360 : at + 1]).max()
        assert change < 1e-3 * np.ptp(first[name][-361:], axis=0).max(), name


def test_a_start_with_other_modes(tiltpad, orbit):
    """A higher speed keeps more modes, a lower frequency fewer: journals and pads begin where they were."""
    first = arrays(orbit / "first.h5")
    at = np.searchsorted(first["time"], first["rotor/turned_time"])
    sizes = set()
    for override in ("reduction%frequency=3000", "reduction%frequency=100"):
        begun(tiltpad, orbit, MACHINE, override)
        after = arrays(orbit / "next.h5")
        sizes.add(after["rotor/turned_state"].size)
        for name in ("journal_y", "journal_vz", "pad_tilt"):
            for bearing in ("left", "right"):
                own = f"bearings/{bearing}/{name}"
                np.testing.assert_allclose(after[own][0], first[own][at], rtol=0, atol=1e-12)
    assert len(sizes) == 2


#: What starts from the result of the machine, and what the line says.
REFUSED = {
    "one bearing": ("", (), "has a shaft in 2 bearings, and this case a rigid journal"),
    "more bearings": (
        MACHINE + "&bearing name='third', station=6 /\n", (),
        "has a shaft in 2 bearings, and this case a shaft in 3 bearings",
    ),
    "other names": (MACHINE.replace("left", "free"), (), "has the bearing left where this case has free"),
    "no support": (MACHINE[: MACHINE.index("&support")], (), "bearing right stands on a support there or in"),
    "pads": (MACHINE, ("pads:left%pivot_angle_deg=-90",), "has 2 pads, and this case 1"),
    "bristles": (MACHINE, ("friction:right%model='lugre'",), "has no bristle deflections"),
}  # fmt: skip


@pytest.mark.parametrize("why", REFUSED)
def test_a_start_that_does_not_fit(tiltpad, orbit, why):
    case, overrides, words = REFUSED[why]
    line = begun(tiltpad, orbit, case, *overrides, status=3).stderr
    assert words in line


def test_a_damaged_state_is_no_start(tiltpad, orbit, tmp_path):
    for name, value in (("rotor/turned_state", np.array([1.0])), ("rotor/turned_time", None)):
        shutil.copy(orbit / "first.h5", tmp_path / "first.h5")
        with h5py.File(tmp_path / "first.h5", "r+") as file:
            del file[name]
            if value is not None:
                file[name] = value
        assert "damaged" in begun(tiltpad, tmp_path, MACHINE, status=3).stderr


def test_states_of_modes_with_other_signs(start, tiltpad, orbit, tmp_path):
    """A result that does not tell the signs of its modes neither goes on nor is a start."""
    shutil.copy(orbit / "first.h5", tmp_path / "first.h5")
    (tmp_path / "case.nml").write_text(MARCHES["friction"] + MACHINE)
    stop(start, tmp_path, after=0.01)
    for path in (tmp_path / "first.h5", tmp_path / "case.h5"):
        with h5py.File(path, "r+") as file:
            assert file["rotor/mode_signs"][()] == 1
            del file["rotor/mode_signs"]
    assert "had other signs" in begun(tiltpad, tmp_path, MACHINE, status=3).stderr
    assert "had other signs" in tiltpad("--resume", "case.h5", cwd=tmp_path, status=3).stderr


def test_the_result_of_the_largest_machine_is_read_again(tiltpad, tmp_path):
    """Twenty bearings, each with all its variables in the resolved input, which has 1600 values."""
    bearings = "".join(f"&bearing name='b{k}', station={4 * k + 2} /\n" for k in range(20))
    text = f"&operation duration=0.005 /\n&shaft length=78*0.5, diameter=78*0.3 /\n{bearings}"
    (tmp_path / "case.nml").write_text(text)
    for _ in range(2):
        tiltpad("case.nml", "-q", "--overwrite", cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file.attrs["input"].count("=") > 1500
        assert len(file["bearings"]) == 20
