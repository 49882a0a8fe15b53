"""Remarks on runs: beside the figures on the console, in the file, and on the list of Python."""

import sys
from pathlib import Path

import h5py
import pytest
from conftest import ENDLESS, shorten, wait_for_checkpoint

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "tests/stress"), str(ROOT / "tests/realistic")]
from bearings import draw  # noqa: E402
from stress_cases import text  # noqa: E402

#: A plain bearing whose groove can be turned, warm oil, and remarks by what a case adds to the paper's.
BORE = ("bearing%preload=0", "pads%motion=fixed", "pads%arc_deg=360", "rotor%mass=500")
WARM = ("thermal%model=pad", "oil%grade=46")
REMARKS = {
    "none": ((), []),
    "groove": ((*BORE, "pads%pivot_angle_deg=90"), ["the load points to -90.0 deg", "ml/s enter"]),
    "groove away": ((*BORE, "pads%pivot_angle_deg=-90"), ["ml/s enter"]),
    "units": (
        ("bearing%viscosity=19e-6",),
        [
            "bearing%viscosity = 1.9e-5: seldom so in Pa s; 1.9e-5 reyn are 0.131",
            "film of pads 1, 2 is",
            "eccentricity ratio 1.531: at pads 1, 2",
            "the oil warms by",
            "Reynolds number",
        ],
    ),
    "loaded": (("rotor%mass=6000",), ["specific load 5.90 MPa", "pads 1, 2 give way by"]),
    "small pivots": (
        ("pivot%socket_radius=0.004",),
        ["is pivot%socket_radius = 0.004 m that of this bearing?"],
    ),
    "unloaded": (
        ("pads%pivot_angle_deg=-90,0,90,180", "pads%arc_deg=70", "bearing%preload=0"),
        ["at the equilibrium pads 2, 3, 4 carry no load"],
    ),
    "fast": ((*WARM, "operation%speed_rpm=8000"), ["surface speed 41.8 m/s"]),
}


#: Words of the remarks on numbers that are seldom so in their unit.
OF_UNITS = ("seldom so", "are nothing beside", "its largest", "more than a pad", "more than a disc", " rad/s")


def lines(told):
    return [line.removeprefix("remark: ") for line in told.splitlines() if line.startswith("remark: ")]


def listed(path):
    with h5py.File(path) as file:
        return [each.decode() for each in file["summary/remarks"]] if "remarks" in file["summary"] else []


@pytest.fixture
def run(tiltpad, tmp_path):
    """run(settings, task): what is printed of the paper's bearing with these settings; writes here.h5."""
    (tmp_path / "case.nml").write_text("&case /")

    def made(settings, task="equilibrium", status=0):
        given = (f"case%task={task}", *settings)
        output = ("--output", "here.h5", "--overwrite")
        return tiltpad("case.nml", *output, cwd=tmp_path, overrides=given, status=status).stdout

    return made


@pytest.mark.parametrize("name", REMARKS)
def test_remarks(run, tmp_path, name):
    settings, expected = REMARKS[name]
    said = lines(run(settings))
    assert len(said) == len(expected)
    assert all(words in line for words, line in zip(expected, said, strict=True))
    assert listed(tmp_path / "here.h5") == said


def test_no_usual_bearing_is_taken_for_one_in_other_units(tiltpad, tmp_path):
    """The examples of this repository, and bearings as designers draw them."""
    cases = sorted((ROOT / "input").glob("*/*.nml"))
    assert len(cases) > 30
    (tmp_path / "input").symlink_to(ROOT / "input")
    for number in range(40):
        cases.append(tmp_path / f"{number}.nml")
        cases[-1].write_text(text(draw(11, number)))
    for case in cases:
        checked = tiltpad("--check", case, cwd=tmp_path, status=0).stdout
        remarks = [line for line in checked.splitlines() if line.startswith("! remark: ")]
        assert not [line for line in remarks for words in OF_UNITS if words in line], case


def test_a_film_that_re_forms_says_what_its_balance_lacks(run, tmp_path):
    """A full bore under load, whose film cavitates in the middle of its arc."""
    said = lines(run((*BORE[:3], "pads%pivot_angle_deg=-90")))
    with h5py.File(tmp_path / "here.h5") as file:
        enters, taken, leaves, beside = (
            file[f"equilibrium/{name}_flow"][0] for name in ("inlet", "reformation", "outlet", "side")
        )
    assert enters + taken == pytest.approx(leaves + beside, rel=1e-9)
    assert taken > 0.1 * enters
    assert [f"takes up {1e6 * taken:.3f} ml/s beyond" in line for line in said] == [True]


def test_a_march_adds_those_of_its_motion(run, tmp_path, tiltpad):
    """Pads that start without equilibrium, and what the case leaves to the paper's bearing."""
    four = (
        "pads%pivot_angle_deg=-90,0,90,180",
        "pads%arc_deg=70",
        "bearing%preload=0",
        "bearing%axial_length=0.11",
    )
    short = ("start%from=partial", "operation%duration=0.02", "output%checkpoint_seconds=0")
    said = lines(run((*four, *short), "march"))
    assert said == listed(tmp_path / "here.h5")
    assert said[0].startswith("not given, and so as in the paper's bearing: rotor%mass = 2000 kg")
    assert any("without equilibrium; the march starts without tilt" in line for line in said)


def test_the_sommerfeld_number_says_its_viscosity_and_clearance(run, tmp_path):
    assert "(19.00 mPa s, c_r 80 um as assembled)" in run(())
    assert "(19.00 mPa s)" in run(("bearing%preload=0",))
    assert "mPa s of the supply at 40 C, c_r " in run(WARM)
    with h5py.File(tmp_path / "here.h5") as file:
        # the same words in every run, as it is one column of a study
        about = file["equilibrium/sommerfeld_number"].attrs["long_name"]
    assert about.endswith("mu of the oil as supplied")


def test_a_run_that_goes_on_keeps_what_its_case_leaves_to_the_paper(tiltpad, start, tmp_path):
    """The resolved input of a result gives every value, so that the remark cannot be made of it again."""
    (tmp_path / "case.nml").write_text(
        "&bearing axial_length=0.11 / &output checkpoint_seconds=0.01, keep='last_revolutions' /"
    )
    process = start(tmp_path, "-q", "case.nml", *ENDLESS)
    wait_for_checkpoint(tmp_path / "case.h5", process)
    process.kill()
    process.wait()
    before = listed(tmp_path / "case.h5")
    assert before[0].startswith("not given, and so as in the paper's bearing: rotor%mass = 2000 kg")
    shorten(tmp_path / "case.h5")
    done = tiltpad("--resume", "case.h5", cwd=tmp_path, status=0)
    assert before[0] in lines(done.stdout)
    assert listed(tmp_path / "case.h5")[0] == before[0]


def test_rows_of_a_study_have_the_remarks_of_its_runs(tiltpad, tmp_path):
    """Each its own, also where runs without any lie between, and where one is performed anew with a file."""
    (tmp_path / "case.nml").write_text("&case task='equilibrium' / &sweep rotor%mass=6000,1000,9000,1500 /")
    for jobs in (1, 3):
        done = tiltpad("case.nml", "--jobs", jobs, "-o", f"by{jobs}", cwd=tmp_path, status=0)
        assert "\nremarks on 2 of the runs" in done.stdout
        with h5py.File(tmp_path / f"by{jobs}.h5") as file:
            rows = [each.splitlines() for each in file["remarks"].asstr()]
        assert [bool(each) for each in rows] == [True, False, True, False]
        for number in (1, 3):
            tiltpad("case.nml", "--run", number, "--overwrite", cwd=tmp_path, status=0)
            assert rows[number - 1] == listed(tmp_path / f"case/000{number}.h5")
    assert rows[0] != rows[2]
    done = tiltpad(
        "case.nml", "-o", "none", overrides=("sweep%rotor%mass=1000,1500",), cwd=tmp_path, status=0
    )
    assert "remarks" not in done.stdout
    with h5py.File(tmp_path / "none.h5") as file:
        assert "remarks" not in file
