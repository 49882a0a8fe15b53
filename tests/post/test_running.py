"""Running the program from Python, and the first calls of somebody who does not know the package yet."""

import copy
import gc
import os
from pathlib import Path

import numpy as np
import pytest
import tiltpad
from tiltpad import command, figures, plots
from tiltpad.files import namelist

pytestmark = pytest.mark.usefixtures("closed_figures")

SHORT = {"operation": {"duration": 0.01}, "friction": {"model": "lugre"}}


@pytest.fixture(autouse=True)
def under_test(program, monkeypatch):
    monkeypatch.setenv("TILTPAD", program)


def test_a_case_of_groups_and_what_is_changed_in_it():
    with tiltpad.run(SHORT, operation={"speed_rpm": 4000}, case={"title": "it's mine"}) as run:
        assert (run.title, run.input["friction"]["model"]) == ("it's mine", "lugre")
        assert run.input["operation"]["speed_rpm"] == 4000
        assert run.time[-1] == 0.01


def test_a_case_in_a_file_and_a_result_in_a_file(tmp_path):
    case = tiltpad.write_case(tmp_path / "mine.nml", SHORT)
    with tiltpad.run(case, tmp_path / "mine.h5") as run:
        assert Path(run.path) == tmp_path / "mine.h5"
    with pytest.raises(tiltpad.RunError, match="another case.*overwrite=True replaces it, and output"):
        tiltpad.run(case, tmp_path / "mine.h5", operation={"speed_rpm": 4000})
    with tiltpad.run(case, tmp_path / "mine.h5", overwrite=True, operation={"speed_rpm": 4000}) as run:
        assert run.speed[0] == pytest.approx(4000 * np.pi / 30)


def test_a_result_is_told_from_another_of_its_name(tmp_path):
    """That of a run without an ending and that of a study, also where the clock was wrong."""
    cases = {tiltpad.Run: {}, tiltpad.Study: {"sweep": {"rotor%mass": [1000.0, 1001.0]}}}
    for kind, own in (*cases.items(), *reversed(cases.items()), *cases.items()):
        with tiltpad.run({"case": {"task": "equilibrium"}} | own, tmp_path / "x") as found:
            assert type(found) is kind
        os.utime(tmp_path / ("x" if kind is tiltpad.Run else "x.h5"), (4e9, 4e9))


def test_the_name_of_a_case_is_no_option(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tiltpad.write_case(tmp_path / "--quiet", SHORT)
    with tiltpad.run("--quiet", "-d.h5") as run:
        assert run.time[-1] == 0.01
    assert {each.name for each in tmp_path.iterdir()} == {"--quiet", "-d.h5"}
    assert command.main(["bearing", "-o", "bearing.svg", "--", "--quiet"]) == 3
    tiltpad.write_case(tmp_path / "-d.nml", SHORT)
    assert command.main(["bearing", "-o", "bearing.svg", "--", "-d.nml"]) == 0


def test_a_result_runs_again_from_its_input():
    with tiltpad.run(SHORT) as run, tiltpad.run(run.input) as again:
        np.testing.assert_array_equal(run.journal_y, again.journal_y)


def test_a_result_without_a_name_is_removed_with_the_last_use_of_it():
    run = tiltpad.run({"case": {"task": "equilibrium"}})
    folder = Path(run.path).parent
    assert folder.exists()
    run.close()
    del run
    gc.collect()
    assert not folder.exists()


@pytest.mark.parametrize("speeds", ["3000:5000:1000", [3000, 4000, 5000], np.array([3e3, 4e3, 5e3])])
def test_varied_values_make_a_study(speeds):
    with tiltpad.run({"case": {"task": "equilibrium"}}, sweep={"operation%speed_rpm": speeds}) as study:
        np.testing.assert_array_equal(study.speed_rpm, [3000, 4000, 5000])
        assert np.isfinite(study.equilibrium_journal_y).all()


def test_varied_words_need_no_quotes():
    with tiltpad.run({"case": {"task": "equilibrium"}}, sweep={"friction%model": "none, lugre"}) as study:
        assert list(study.model) == ["none", "lugre"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"operation": {"speed_rpm": -1}}, "operation%speed_rpm = -1"),
        ({"operation": {"sped_rpm": 1}}, r"did you mean speed_rpm\?"),
        ({"opertion": {"speed_rpm": 1}}, r"did you mean operation\?"),
        ({"overwrit": True}, r"run has no option overwrit \(did you mean overwrite\?\)"),
        ({"operation": 3000}, "operation = 3000: a group has variables"),
        ({"operation": {"speed_rpm": None}}, "None is neither a number nor a text"),
        ({"friction": {"model": 3}}, "friction%model"),
    ],
)
def test_a_wrong_case_is_said_by_the_program(arguments, message):
    with pytest.raises(ValueError, match=message):
        tiltpad.run(**arguments)


def test_a_case_that_is_not_there():
    with pytest.raises(ValueError, match="nowhere.nml: no such file"):
        tiltpad.run("nowhere.nml")


def test_a_run_without_result_says_why():
    """The load points to where no pad is."""
    with pytest.raises(tiltpad.RunError, match="no equilibrium found at 6500 rpm"):
        tiltpad.run({"rotor": {"static_load": (0, 5e7)}})


def test_no_program(monkeypatch):
    monkeypatch.setenv("TILTPAD", "/nowhere/tiltpad")
    with pytest.raises(tiltpad.MissingProgramError, match="/nowhere/tiltpad"):
        tiltpad.run(SHORT)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (3, "3"), (0.1, "0.1"), (np.float64(1e-7), "1e-07"), (np.int64(5), "5"), (True, ".true."),
        ("it's", "'it''s'"), ([1, 2.5], "1, 2.5"), (np.ones(2), "1.0, 1.0"), (("a", "b"), "'a', 'b'"),
    ],
)  # fmt: skip
def test_values_as_a_namelist_has_them(value, text):
    assert namelist.written(value) == text


def test_a_result_describes_itself(run):
    said = repr(run("lugre"))
    for words in ("Steady, it's LuGre", "march, complete, 0.06 s, 2 pads", "lugre", "6500 rpm", "journal_y"):
        assert words in said
    assert "equilibrium/: " in said
    assert "1500 to 6500 rpm" in repr(run("runup"))
    assert list(run("lugre")) == run("lugre").names()
    offered = dir(run("lugre"))
    assert {"journal_y", "title", "to_csv", "values"} <= set(offered)
    assert not {"check_whole", "sound", "scales", "KINDS", "found"} & set(offered)
    assert set(tiltpad.__all__) <= set(dir(tiltpad))
    assert tiltpad.__version__


@pytest.mark.parametrize(
    ("call", "kind", "message"),
    [
        (lambda run: tiltpad.orbit("own.h5"), TypeError, r"tiltpad.read\('own.h5'\) opens it"),
        (lambda run: plots.orbit("own.h5"), TypeError, "opens it"),
        (lambda run: figures.orbit("own.h5"), TypeError, "opens it"),
        (
            lambda run: figures.orbit([run, 3]),
            TypeError,
            "opens it is needed, not int",
        ),
        (lambda run: figures.orbit([]), ValueError, "no result to draw"),
        (lambda run: tiltpad.orbit(run, last=-1), ValueError, "last = -1: must be a number of revolutions"),
        (lambda run: tiltpad.pressure(3), TypeError, "not int"),
    ],
)
def test_wrong_first_calls_are_answered(run, call, kind, message):
    with pytest.raises(kind, match=message):
        call(run("lugre"))


def test_one_result_is_enough_for_a_figure(run):
    assert len(figures.orbit(run("lugre")).axes) == 2


def test_to_xarray_and_csv(run, tmp_path):
    case = run("lugre")
    data = case.to_xarray()
    np.testing.assert_array_equal(data.pad_tilt.sel(pad=2), case.pad_tilt[:, 1])
    assert case.to_xarray("equilibrium").pad_tilt.dims == ("pad",)
    case.to_csv(tmp_path / "some.csv", ["pad_tilt", "journal_y"])
    head = (tmp_path / "some.csv").read_text().split("\n", 1)[0]
    assert head == "time,pad_tilt_1,pad_tilt_2,journal_y"
    values = np.loadtxt(tmp_path / "some.csv", delimiter=",", skiprows=1)
    np.testing.assert_array_equal(values, np.column_stack([case.time, case.pad_tilt, case.journal_y]))
    table = case.to_pandas(["pad_tilt", "journal_y"])
    assert [table.index.name, *table.columns] == head.split(",")
    np.testing.assert_array_equal(table.reset_index().to_numpy(), values)
    case.to_csv(tmp_path / "all.csv")
    assert "friction_moment_2" in (tmp_path / "all.csv").read_text().split("\n", 1)[0]
    with pytest.raises(ValueError, match="nix is no series of this run: "):
        case.to_csv(tmp_path / "no.csv", ["nix"])
    with pytest.raises(tiltpad.NotInRunError, match="nothing was marched"):
        run("equilibrium").to_csv(tmp_path / "no.csv")


def test_what_is_in_a_group_stands_behind_a_point_too(run):
    case = run("lugre")
    assert case.equilibrium.journal_y == case["equilibrium/journal_y"] == case.equilibrium["journal_y"]
    assert "journal_y" in dir(case.equilibrium)
    said = r"no jurnal_y in equilibrium \(did you mean journal_y\?\): there are "
    with pytest.raises(AttributeError, match=said):
        _ = case.equilibrium.jurnal_y
    assert copy.deepcopy(case.equilibrium).journal_y == case.equilibrium.journal_y


def test_a_study_as_csv(result, tmp_path):
    tiltpad.collect([result("lugre"), result("none")], tmp_path / "a.h5")
    with tiltpad.read_study(tmp_path / "a.h5") as study:
        study.to_csv(tmp_path / "a.csv")
        head, *rows = (tmp_path / "a.csv").read_text().splitlines()
        place = head.split(",").index("orbit_y")
        assert [float(row.split(",")[place]) for row in rows] == list(study.orbit_y)
        assert study.to_xarray().orbit_y.dims == ("run",)
        table = study.to_pandas()
        assert [table.index.name, *table.columns] == head.split(",")
        np.testing.assert_array_equal(table.orbit_y, study.orbit_y)


def test_brute_force_goes_up_and_down_from_the_end_of_each_march(tmp_path):
    lengths = {"settle": 1, "revolutions": 3, "output": {"samples_per_revolution": 20}}
    study = tiltpad.brute_force(None, "operation%speed_rpm", [6000, 5000], tmp_path / "up", **lengths)
    with study:
        assert study.parameters == ["speed_rpm", "direction"]
        np.testing.assert_array_equal(study.speed_rpm, [5000, 6000, 6000, 5000])
        assert list(study.direction) == ["upwards", "upwards", "downwards", "downwards"]
        assert study.poincare_y.shape == (4, 4)
    ends = []
    for number in range(1, 5):
        with tiltpad.read(tmp_path / f"up/{number:04d}.h5") as run:
            assert run.time[0] == pytest.approx(60 / run.input["operation"]["speed_rpm"])
            assert (number > 1) == run.input["start"]["from"].startswith("file")
            if number > 1:
                assert Path(run.input["start"]["file"]).name == f"{number - 1:04d}.h5"
            ends.append(run.journal_y[-1])
    # at the same speed it goes on as if it had not stopped
    case = {
        "operation": {"speed_rpm": 6000, "duration": 4 * 60 / 6000},
        "output": {"samples_per_revolution": 20},
    }
    start = {"from": "file", "file": str(tmp_path / "up/0002.h5")}
    with tiltpad.run(case, start=start) as run:
        assert run.journal_y[-1] == pytest.approx(ends[2], abs=1e-9)
    with pytest.raises(ValueError, match="it needs values"):
        tiltpad.brute_force(None, "rotor%unbalance", [])
