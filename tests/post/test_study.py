"""Studies: writing them with tiltpad-collect, and reading them."""

import os
import re
import shutil
import subprocess
import sys
import warnings

import h5py
import numpy as np
import pytest
import tiltpad
import tiltpad as package
import xarray
from tiltpad import command
from tiltpad.collect import parameters
from tiltpad.files import units

CASE = "&case title='Grid' / &operation duration=0.06 / &output samples_per_revolution=60 /"
SPEEDS, MODELS = [4000, 5000, 6500], ["none", "lugre"]


@pytest.fixture(scope="module")
def folder(runs_of, tmp_path_factory):
    """Runs of three speeds times two models; the fourth, 5000 rpm with LuGre, failed."""
    values = {"operation%speed_rpm": SPEEDS, "friction%model": MODELS}
    return runs_of(tmp_path_factory.mktemp("studies") / "grid", CASE, values, failed=(4,))


@pytest.fixture
def copy(folder, tmp_path):
    """That folder, to be changed."""
    return shutil.copytree(folder, tmp_path / "grid")


@pytest.fixture
def study(copy, tmp_path):
    """Its study, opened."""
    tiltpad.collect(copy, tmp_path / "grid.h5")
    with tiltpad.read_study(tmp_path / "grid.h5") as opened:
        yield opened


def edited(path, edit):
    with h5py.File(path, "r+") as file:
        edit(file)


def test_parameters_and_results_are_those_of_the_members(study, copy):
    assert study.parameters == ["speed_rpm", "model"]
    np.testing.assert_array_equal(study.run, range(1, 7))
    np.testing.assert_array_equal(study.speed_rpm, np.repeat(SPEEDS, 2))
    assert list(study["model"]) == MODELS * 3
    assert (study.title, study.task, study.format_version, study.runs) == ("Grid", "study", 3, 6)
    for k in (0, 5):
        with tiltpad.read(copy / f"{k + 1:04d}.h5") as run:
            y, z = tiltpad.orbit_size(run)
            assert (study.orbit_y[k], study.orbit_z[k], study.orbit_size[k]) == (y, z, max(y, z))
            last = tiltpad.last_revolutions(run)
            np.testing.assert_array_equal(
                study.pad_max_pressure[k], run.values("max_pressure", last).max(axis=0)
            )
            assert study.min_film_thickness[k] == run.values("min_film_thickness", last).min()
            assert study.steps[k] == run["statistics/steps"]
            assert study.equilibrium_total_power_loss[k] == run["equilibrium/total_power_loss"]
            assert study.equilibrium_sommerfeld_number[k] == run["equilibrium/sommerfeld_number"]
            np.testing.assert_array_equal(study.pad_equilibrium_side_flow[k], run["equilibrium/side_flow"])
            points = tiltpad.poincare(run)
            kept = study.poincare_y[k][np.isfinite(study.poincare_y[k])]
            # the same cubic, whose terms are added in another order
            for own, point in ((kept, "journal_y"), (study.poincare_tilt[k][-len(kept) :], "pad_tilt")):
                np.testing.assert_allclose(
                    own, points[point], rtol=1e-14, atol=1e-14 * abs(points[point]).max()
                )
    with tiltpad.read(copy / "0006.h5") as run:
        work = [tiltpad.friction_work(run, pad) for pad in (1, 2)]
        stuck = [tiltpad.stick_fraction(run, pad) for pad in (1, 2)]
    np.testing.assert_allclose(study.pad_friction_work[5], work, rtol=1e-12)
    np.testing.assert_allclose(study.pad_stick_fraction[5], stuck, rtol=1e-12)
    assert study.friction_work[5] == pytest.approx(sum(work))
    assert np.isnan(study.friction_work[0])


def test_what_failed_is_nan_with_its_reason(study):
    np.testing.assert_array_equal(study.status, [0, 0, 0, 2, 0, 0])
    assert list(study.reason) == ["", "", "", "no equilibrium found", "", ""]
    assert list(study.done) == [True, True, True, False, True, True]
    for name in ("orbit_y", "max_pressure", "equilibrium_journal_y", "poincare_y", "pad_tilt_size"):
        bad = np.isnan(study[name]).reshape(6, -1).all(axis=1)
        assert list(bad) == [False, False, False, True, False, False], name


def test_an_incomplete_run_has_its_time_and_no_results(copy, tmp_path):
    def stop(file):
        file.attrs.update({"complete": 0, "exit_status": 4})
        file.create_group("checkpoint")

    edited(copy / "0002.h5", stop)
    found = tiltpad.collect(copy, tmp_path / "a.h5")
    assert (found.done, found.failed, found.incomplete) == (4, 1, 1)
    with tiltpad.read_study(tmp_path / "a.h5") as study:
        assert study.status[1] == 4
        assert study.time_reached[1] == 0.06
        assert np.isnan(study.orbit_y[1])


def test_xarray_sees_parameters_as_coordinates(study):
    with xarray.open_dataset(study.path, engine="h5netcdf") as data:
        assert {"run", "speed_rpm", "model", "pad", "revolution"} == set(data.coords)
        assert data.orbit_y.dims == ("run",)
        assert data.poincare_tilt.dims == ("run", "revolution", "pad")
        assert data.speed_rpm.attrs["units"] == "rpm"
        assert data.orbit_y.attrs["units"] == "m"
        assert data.revolution.values[-1] == 0
        grid = data.set_index(run=["speed_rpm", "model"]).unstack()
        assert dict(grid.orbit_y.sizes) == {"speed_rpm": 3, "model": 2}
        assert grid.orbit_y.sel(speed_rpm=6500, model="lugre") == study.orbit_y[5]
        assert np.isnan(grid.orbit_y.sel(speed_rpm=5000, model="lugre"))
        assert all(
            len(each.attrs["long_name"]) > 3 and "units" in each.attrs
            for name, each in data.variables.items()
            if name not in ("model", "reason", "file")
        )


def test_the_members_are_reached_also_after_a_move(study, tmp_path):
    moved = tmp_path / "elsewhere"
    moved.mkdir()
    study.close()
    for name in ("grid", "grid.h5"):
        shutil.move(tmp_path / name, moved / name)
    (tmp_path / "link.h5").symlink_to(moved / "grid.h5")
    for name in (moved / "grid.h5", tmp_path / "link.h5"):
        with tiltpad.read_study(name) as found, tiltpad.read(moved / "grid/0003.h5") as run:
            with found.result(3) as own:
                np.testing.assert_array_equal(own.journal_y, run.journal_y)
            assert list(found["file"]) == [f"grid/{k:04d}.h5" for k in range(1, 7)]


def test_runs_that_cannot_be_opened(tiltpad, study, copy, tmp_path):
    with pytest.raises(ValueError, match="no run 7; there are 1 to 6"):
        study.result(7)
    (copy / "0002.h5").unlink()
    with pytest.raises(package.RunError, match=r"0002\.h5: no such file"):
        study.result(2)
    (tmp_path / "case.nml").write_text("&case task='equilibrium' /\n&sweep rotor%mass=1000,2000 /\n")
    tiltpad("case.nml", cwd=tmp_path, status=0)
    with (
        package.read_study(tmp_path / "case.h5") as rows,
        pytest.raises(package.RunError, match="run 2 has no file of its own; output%keep = 'all' keeps"),
    ):
        rows.result(2)


def test_the_members_of_a_study_elsewhere(copy, tmp_path):
    (tmp_path / "studies").mkdir()
    tiltpad.collect(copy, tmp_path / "studies/a.h5")
    with tiltpad.read_study(tmp_path / "studies/a.h5") as study, study.result(1) as run:
        assert study["file"][0] == "../grid/0001.h5"
        assert "journal_y" in run


def test_a_damaged_and_a_missing_run(copy, tmp_path, capsys):
    (copy / "0002.h5").write_text("nothing")
    (copy / "0005.h5").unlink()
    assert command.collect([str(copy), "-o", str(tmp_path / "a.h5")]) == 0
    said = capsys.readouterr()
    assert said.out == (
        f"5 runs: 3 done, 1 failed, 0 incomplete, 1 unreadable, 1 missing; written: {tmp_path / 'a.h5'}\n"
    )
    assert said.err.splitlines() == [
        f"tiltpad-collect: warning: {copy / '0002.h5'}: not an HDF5 file",
        f"tiltpad-collect: warning: {copy}: missing runs: 5",
    ]
    with tiltpad.read_study(tmp_path / "a.h5") as study:
        np.testing.assert_array_equal(study.run, [1, 2, 3, 4, 6])
        assert np.isnan([study.status[1], study.speed_rpm[1], study.orbit_y[1]]).all()
        assert study["model"][1] == ""
        assert "not an HDF5 file" in study.reason[1]
        assert study.missing == "5"


def test_two_studies_are_not_mixed(copy, runs_of, tmp_path, capsys):
    other = runs_of(tmp_path / "other", CASE, {"rotor%unbalance": [0.01, 0.02]})
    assert command.collect([str(copy), str(other), "-o", str(tmp_path / "a.h5")]) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    both = "over operation%speed_rpm, friction%model, and a run of a study over rotor%unbalance"
    assert f"not of one study: a run of a study {both}" in said
    assert not (tmp_path / "a.h5").exists()
    edited(copy / "0006.h5", lambda file: file.attrs.update({"run": 1}))
    with pytest.raises(ValueError, match="both are run 1"):
        tiltpad.collect(copy, tmp_path / "a.h5")


def test_a_study_that_grew_is_one_study(copy, tmp_path):
    """Its first runs know of fewer."""
    for k in (1, 2, 3):
        edited(copy / f"000{k}.h5", lambda file: file.attrs.update({"runs": 3}))
    (copy / "0006.h5").unlink()
    with pytest.warns(tiltpad.RunWarning, match="missing runs: 6"):
        found = tiltpad.collect(copy, tmp_path / "a.h5")
    assert (found.runs, found.missing) == (5, [6])
    with tiltpad.read_study(tmp_path / "a.h5") as study:
        assert (study.runs, study.missing) == (6, "6")


def test_a_folder_of_two_studies(tiltpad, tmp_path, monkeypatch, capsys):
    """Files of another study over the same variable are seen, of any size; a study that grew is one."""
    monkeypatch.chdir(tmp_path)
    keep = "&output keep='all' /"
    (tmp_path / "case.nml").write_text(
        f"&case task='equilibrium' /\n{keep}\n&sweep operation%speed_rpm=1:2:1 /\n"
    )

    def ran(name, values, folder=None):
        varied = ["--set", f"sweep%operation%speed_rpm={values}"]
        tiltpad("--quiet", "case.nml", *varied, "--output", folder or name, status=0)
        return tmp_path / name

    three, other, two = ran("three", "3e3:5e3:1e3"), ran("other", "3e3:6e3:15e2"), ran("two", "25e2,26e2")
    for source, numbers in ((other, (2,)), (other, (1,)), (two, (1, 2)), (two, (1,)), (two, (2,))):
        mixed = tmp_path / "mixed"
        shutil.copytree(three, mixed)
        for number in numbers:
            shutil.copy(source / f"000{number}.h5", mixed)
        assert command.collect(["mixed"]) == 1
        said = capsys.readouterr().err
        assert "runs of two studies; run one of them into another folder, or with --overwrite" in said
        assert not (tmp_path / "mixed.h5").exists()
        shutil.rmtree(mixed)
    ran("three", "3e3:7e3:1e3")
    assert command.collect(["three"]) == 0
    (three / "0002.h5").unlink()
    (three / "0004.h5").unlink()
    assert command.collect(["three"]) == 0


def test_a_file_named_twice_is_one_run(copy, tmp_path, monkeypatch, result):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "link.h5").symlink_to(copy / "0002.h5")
    assert tiltpad.collect(["grid", copy, "grid/0001.h5", "link.h5"], "a.h5").runs == 6
    assert tiltpad.collect([result("lugre"), result("lugre")], "b.h5").runs == 1


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
def test_the_summary_cannot_be_printed(copy, tmp_path):
    code = "import sys; from tiltpad import command; sys.exit(command.collect(sys.argv[1:]))"
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-c", code, copy, "-o", tmp_path / "a.h5"],
            stdout=full, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
    assert done.returncode == 3
    assert done.stderr == (
        "tiltpad-collect: error: standard output cannot be written: No space left on device\n"
    )
    assert (tmp_path / "a.h5").exists()


def test_the_output(copy, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert command.collect(["grid"]) == 0
    assert "6 runs: 5 done, 1 failed, 0 incomplete; written: grid.h5\n" in capsys.readouterr().out
    assert command.collect(["grid"]) == 0
    assert (
        command.collect(["grid", "-o", "grid/all.h5"]) == command.collect(["grid", "-o", "grid/all.h5"]) == 0
    )
    capsys.readouterr()
    for arguments, status, message in (
        (["grid", "-o", "grid/0001.h5"], 1, "grid/0001.h5: it exists and is not a study"),
        (["grid", "-o", "a.nc"], 1, "a.nc: the name must end in .h5"),
        (["grid", "-o", "no/a.h5"], 3, "no: no such folder"),
        (["grid/0001.h5"], 1, "give its output"),
        (["nowhere", "-o", "a.h5"], 3, "nowhere: none of 1 files can be read"),
        ([str(copy.parent / "empty"), "-o", "a.h5"], 3, "empty: no result files"),
    ):
        (tmp_path / "empty").mkdir(exist_ok=True)
        assert command.collect(arguments) == status, arguments
        said = capsys.readouterr().err.splitlines()
        assert message in said[-1]
        assert said[-1].startswith("tiltpad-collect: error: ")
    assert not list(tmp_path.glob("**/*.part*"))


def test_a_study_that_cannot_be_read_is_not_replaced(copy, tmp_path, monkeypatch, capsys):
    """The attribute that tells what it is gives a KeyError where the disk fails, as where there is none."""
    monkeypatch.chdir(tmp_path)
    assert command.collect(["grid"]) == 0
    before = (tmp_path / "grid.h5").read_bytes()
    whole = h5py.AttributeManager.__getitem__

    def failing(self, name):
        if name == "task" and self._id.name == b"/" and self._id.file.name.endswith(b"/grid.h5"):
            raise KeyError("Unable to synchronously open attribute (file read failed)")
        return whole(self, name)

    monkeypatch.setattr(h5py.AttributeManager, "__getitem__", failing)
    assert command.collect(["grid"]) == 3
    said = capsys.readouterr().err
    assert "grid.h5: attribute 'task' cannot be read" in said
    assert said.endswith("it is not replaced\n")
    assert (tmp_path / "grid.h5").read_bytes() == before


def test_runs_that_are_no_members(result, tmp_path):
    """Their parameters are the variables in which their inputs differ."""
    output = tmp_path / "runs.h5"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tiltpad.collect([result(case_name) for case_name in ("none", "lugre", "tilting", "runup")], output)
    with tiltpad.read_study(output) as study:
        names = ["speed_rpm", "duration", "motion", "model"]
        assert sorted(study.parameters) == sorted(names)
        assert list(study["model"]) == ["none", "lugre", "lugre", "lugre"]
        assert list(study.motion) == ["tilting_radial", "tilting_radial", "tilting_only", "tilting_radial"]
        assert list(study.run) == [1, 2, 3, 4]
    tiltpad.collect([result("lugre"), result("four"), result("equilibrium")], output)
    with tiltpad.read_study(output) as study:
        assert list(study.pads) == [2, 4, 2]
        assert np.isnan(study.pad_max_pressure[0, 2:]).all()
        assert np.isfinite(study.pad_max_pressure[1]).all()
        assert np.isnan(study.orbit_y[2])
        # a march starts with films of the usual error, 1e-4
        assert study.equilibrium_journal_y[2] == pytest.approx(study.equilibrium_journal_y[0], rel=1e-4)


def test_names_of_parameters():
    texts = [
        f"pads%arc_deg(1) = 6{k}\nrotor%mass = {k}\npads%mass = 1\nfriction%model = 'no ''{k}'''"
        for k in (1, 2)
    ]
    found = parameters.parameters([*map(parameters.varied_values, texts), None])
    assert [each.name for each in found] == ["arc_deg_1", "rotor_mass", "pads_mass", "model"]
    assert [each.units for each in found] == ["deg", "kg", "kg", ""]
    assert [each.long_name for each in found] == ["arc, 1", "mass (rotor)", "mass (pads)", "friction model"]
    assert found[3].values == ["no '1'", "no '2'", ""]
    np.testing.assert_array_equal(found[0].values, [61, 62, np.nan])


def test_units_are_those_of_the_input_reference(tiltpad):
    """Every number of the input has the unit that the program says."""
    group, said = "", []
    for line in tiltpad("--reference").stdout.splitlines():
        group = line.removeprefix("## &") if line.startswith("## &") else group
        if row := re.match(r"\| `(\w+)` \| ([^|]*) \| ([^|]*) \|", line):
            said.append((f"{group}%{row[1]}", row[2], row[3]))
    assert len(said) > 40
    for name, default, unit in said:
        if not default.startswith("`"):
            unit = {"1": "", "C": "°C"}.get(unit.strip(), unit.strip()).replace("^2", "²").replace("^3", "³")
            assert units.named(name)[1] == unit, name
