"""Whole runs under forces over time: marches over jumps, tables, orbits, machines, and bad tables."""

import h5py
import numpy as np
import pytest

#: Without unbalance and friction a march that starts at the equilibrium stays there.
STILL = "&rotor unbalance=0 / &operation speed_rpm=6000, duration=0.3 / &output samples_per_revolution=40 /\n"
STEP = STILL + "&excitation kind='step', amplitude=3000, direction_deg=-120, start=0.05 /\n"
MACHINE = """&shaft length=0.05, 0.05, 8*0.2, 0.05, 0.05, diameter=0.0998, 0.0998, 8*0.34, 0.0998, 0.0998 /
&disc station=7, mass=2800, polar_inertia=500, diametral_inertia=280 /
&bearing name='left', station=2 / &bearing name='right', station=12 /
&operation speed_rpm=3000, duration=0.3 / &output samples_per_revolution=40 /
"""


def journal(path):
    """Time and displacements, (time,) and (2, time)."""
    with h5py.File(path) as file:
        return file["time"][:], np.array([file["journal_y"][:], file["journal_z"][:]])


def test_a_step_leads_from_one_equilibrium_to_the_other(run, tmp_path):
    """Until the step the journal stays; long after it, it is where a static load of this size has it."""
    run(STEP, name="step")
    load = 3000 * np.array([np.cos(np.radians(120)), -np.sin(np.radians(120))])
    run(STILL, "case%task='equilibrium'", f"rotor%static_load={load[0]:.17g},{load[1]:.17g}", name="loaded")
    time, motion = journal(tmp_path / "step.h5")
    with h5py.File(tmp_path / "loaded.h5") as file:
        loaded = [file[f"equilibrium/journal_{axis}"][()] for axis in "yz"]
    clearance = 80e-6
    assert np.abs(motion[:, time < 0.05].T - motion[:, 0]).max() < 1e-5 * clearance
    # the tolerance of the march is 1e-5 of the states, that of films from its tables not much more
    assert np.abs(motion[:, -1] - loaded).max() < 3e-4 * clearance
    assert np.abs(motion[:, -1] - motion[:, 0]).max() > 0.01 * clearance
    with h5py.File(tmp_path / "step.h5") as file:
        force = np.stack([file["excitation_y"][:, 0], file["excitation_z"][:, 0]])
        assert file["excitation_y"].dims[1][0][:] == [1]
        np.testing.assert_allclose(force, load[:, None] * (time >= 0.05), atol=1e-9)


def test_a_table_is_what_it_samples(run, tmp_path):
    """A ramp as a table of two lines, with a byte order mark, gives the ramp's motion but for the end of the
    table; a table of many rows of the same does so, too."""
    rows = "\r\n".join(f"{0.01 * k!r},0,{50.0 * k!r}" for k in range(21))
    (tmp_path / "two.csv").write_bytes(b"\xef\xbb\xbftime,force_y,force_z\n0,0,0\n0.2,0,1000\n")
    (tmp_path / "many.csv").write_text(f"time, force_y, force_z\r\n{rows}\r\n", newline="")
    ramp = "&excitation kind='ramp', amplitude=1000, direction_deg=90, start=0.05, end=0.25 /\n"
    run(STILL + ramp, name="ramp")
    time, expected = journal(tmp_path / "ramp.h5")
    for name in ("two", "many"):
        run(STILL + f"&excitation kind='table', file='{tmp_path}/{name}.csv', start=0.05 /\n", name=name)
        _, found = journal(tmp_path / f"{name}.h5")
        during = time < 0.25
        assert np.abs(found - expected)[:, during].max() < 1e-4 * 80e-6
        assert np.ptp(found[1, during]) > 0.01 * 80e-6


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "has 0 rows of numbers"),
        ("time,force_y,force_z\n0,1,2\n", "has 1 rows of numbers; it needs"),
        ("0,1,2\n1,1,2\n", "line 1: 0,1,2: must name the columns, time, force_y, force_z"),
        ("time,force_y,force_z\n0,1,2\n0,1,3\n", "line 3: time = 0: must be 1e-9 s or more above that of"),
        ("time,force_y,force_z\n0,1,2\n1,x,3\n", "line 3: force_y = x: must be a finite number"),
        ("time,force_y,force_z\n0,1,2\n1,1\n", "line 3: force_z = : must be a finite number"),
        ("time,force_y,force_z\n0,1,2\n1,1,nan\n", "line 3: force_z = nan: must be a finite number"),
        ("time,force_y,force_z\n0,1,2\n1,1e13,2\n", "line 3: force_y = 1e13: must be -1e12 to 1e12 N"),
        ("time,force_y,force_z\n0,1,2\n1e-320,1,2\n", "must be 1e-9 s or more above"),
        ("time,force_y,force_z\n0,1,2\n1,1,2,3\n", "line 3: has more than 3 numbers"),
        ("time;force_y;force_z\n0;1;2\n", "line 1: time;force_y;force_z: must name the columns"),
        ("time,force_y,force_z\n-1,1,2\n1,1,2\n", "line 2: time = -1: must be 0 to 1e6 s"),
        ("time,force_y,force_z\n0,1,2\n1,\x01,2\n", "not a text file"),
        (None, "no such file"),
    ],
)
def test_bad_tables_are_refused_by_one_line_and_by_check(run, tmp_path, content, words):
    if content is not None:
        (tmp_path / "force.csv").write_text(content, newline="")
    done = run(STILL + f"&excitation kind='table', file='{tmp_path}/force.csv' /\n", status=1)
    assert "excitation(1)%file" in done.stderr
    assert words in done.stderr
    assert not (tmp_path / "case.h5").exists()
    case = (tmp_path / "case.nml").read_text()
    assert run(case, status=1, more=("--check",)).stderr == done.stderr


def test_an_orbit_has_the_period_of_its_excitation(run, tmp_path):
    """Two revolutions under a force of half the order; a march from there repeats it."""
    force = "&excitation amplitude=500, frequency_ratio=0.5, direction_deg=90 /\n"
    case = "&operation speed_rpm=6000, duration=0.2 / &output samples_per_revolution=40 /\n" + force
    done = run(case, "case%task='periodic'", "periodic%tolerance=1e-10", name="orbit")
    assert "(2 revolutions), stable" in done.stdout
    with h5py.File(tmp_path / "orbit.h5") as file:
        assert file["periodic/period"][()] == pytest.approx(0.02, rel=1e-12)
        half = [file[f"journal_{axis}"][40] - file[f"journal_{axis}"][0] for axis in "yz"]
        assert np.abs(half).max() > 1e-3 * 80e-6
    _, orbit = journal(tmp_path / "orbit.h5")
    run(case, "integration%relative_tolerance=1e-8", name="march")
    _, march = journal(tmp_path / "march.h5")
    # the last two revolutions of ten, where the start is forgotten
    assert np.abs(march[:, -81:] - orbit).max() < 2e-4 * 80e-6


def test_a_machine_under_a_force_at_a_station(run, tmp_path):
    """A slow ramp at a station ends where a static load there has the shaft; without one it is refused."""
    force = "&excitation kind='ramp', amplitude=2000, direction_deg=90, end=0.1, station=7 /\n"
    run(MACHINE + force, name="ramp")
    load = "&load station=7, force=0, 2000 /\n"
    run(MACHINE + load, "case%task='equilibrium'", name="loaded")
    with h5py.File(tmp_path / "ramp.h5") as ramp, h5py.File(tmp_path / "loaded.h5") as loaded:
        for name in ("left", "right"):
            found = ramp[f"bearings/{name}/journal_z"][-40:].mean()
            start = ramp[f"bearings/{name}/equilibrium/journal_z"][()]
            expected = loaded[f"bearings/{name}/equilibrium/journal_z"][()]
            assert abs(found - expected) < 0.02 * abs(expected - start)
        assert ramp["excitation_z"][-1, 0] == 2000
    assert (
        "excitation(1)%station: must be given"
        in run(MACHINE + force.replace(", station=7", ""), status=1).stderr
    )


def test_statics_say_that_they_know_no_excitation(run):
    for task in ("equilibrium", "coefficients"):
        assert (
            f"excitation: has no effect with case%task = '{task}'"
            in run(STEP, f"case%task='{task}'", name=task).stdout
        )


def test_a_study_varies_an_excitation(run, tmp_path):
    """The mean of the last revolution follows the force."""
    run(STEP, "sweep%excitation(1)%amplitude=0,1000,2000", "output%keep='summary'", name="study")
    with h5py.File(tmp_path / "study.h5") as file:
        assert list(file["excitation_1_amplitude"][:]) == [0, 1000, 2000]
        mean = file["mean_z"][:]
    assert mean[2] < mean[1] < mean[0]
