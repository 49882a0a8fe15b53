"""Files of format_version 2: they are read with today's names; what they do not have is missing."""

import shutil

import h5py
import numpy as np
import pytest
import tiltpad
from tiltpad import command
from tiltpad.files import archive, former_names

#: Renamings as later versions may have them: of a group, of what is in one, and of series.
RENAMED = {
    "statistics": "cost",
    "cost/steps": "cost/time_steps",
    "spectrum/frequency": "spectrum/hertz",
    "journal_y": "journal_vertical",
    "equilibrium/pad_tilt": "equilibrium/tilt",
}


@pytest.fixture
def former(result, tmp_path):
    """former(names): a result as version 2 had it, when those names are the former ones."""
    path = tmp_path / "version2.h5"
    shutil.copy(result("lugre"), path)
    with h5py.File(path, "r+") as file:
        file.attrs["format_version"] = 2
        for name, today in former_names.FORMER_NAMES.items():
            if today in file:
                file.move(today, name)
        del file["summary"]
    return path


def test_today_s_names_of_a_former_file(former, run, monkeypatch):
    for module in (archive, former_names):
        monkeypatch.setattr(module, "FORMER_NAMES", RENAMED)
    monkeypatch.setattr(archive.Archive, "GROUPS", (*archive.Archive.GROUPS, "cost"))
    with tiltpad.read(former) as old, h5py.File(former) as file:
        assert {"journal_vertical", "cost"} <= set(old.names())
        assert not {"journal_y", "statistics"} & set(old.names())
        assert {"time_steps", "rhs_evaluations"} <= set(old.names("cost"))
        assert old["cost/time_steps"] == file["statistics/steps"][()]
        np.testing.assert_array_equal(old.journal_vertical, file["journal_y"])
        assert old.about("journal_vertical", "units") == "m"
        assert old.scales("spectrum/journal_z") == ("spectrum/hertz",)
        assert old.scales("equilibrium/tilt") == ("pad",)
        # scripts of before go on
        np.testing.assert_array_equal(old["journal_y"], old["journal_vertical"])
        assert old["statistics/steps"] == old["cost/time_steps"]


def test_a_former_run_has_no_summary(former, tmp_path, capsys):
    with tiltpad.read(former) as run:
        assert run.remarks == []
        assert tiltpad.friction_work(run, 1) > 0
        with pytest.raises(tiltpad.NotInRunError, match="no summary in this run: version 2 of the format"):
            tiltpad.stick_fraction(run, 1)
    assert command.report([str(former), "-o", str(tmp_path / "page.html")]) == 0
    assert command.collect([str(former), "-o", str(tmp_path / "study.h5")]) == 0
    with tiltpad.read_study(tmp_path / "study.h5") as study:
        assert study.status == 0
        assert study.equilibrium_total_power_loss > 0
        assert "orbit_y" not in study


def test_a_former_study(runs_of, tmp_path, capsys):
    values = {"operation%speed_rpm": [3000, 5000]}
    tiltpad.collect(runs_of(tmp_path / "speeds", "&case task='equilibrium' /", values), tmp_path / "study.h5")
    shutil.copy(tmp_path / "study.h5", tmp_path / "former.h5")
    with h5py.File(tmp_path / "former.h5", "r+") as file:
        file.attrs["format_version"] = 2
        for name, today in former_names.FORMER_NAMES.items():
            if today in file:
                file.move(today, name)
        for name, today in former_names.FORMER_NAMES.items():
            if today in file:
                file.move(today, name)
        assert "equilibrium_y" in file
    with (
        tiltpad.read_study(tmp_path / "study.h5") as today,
        tiltpad.read_study(tmp_path / "former.h5") as former,
    ):
        assert former.names() == today.names()
        for name in ("equilibrium_journal_y", "equilibrium_total_power_loss"):
            np.testing.assert_array_equal(former[name], today[name])
        np.testing.assert_array_equal(today["equilibrium_y"], today["equilibrium_journal_y"])
    words = ["study", f"{tmp_path}/former.h5", "--show", "equilibrium_journal_y", "-o", f"{tmp_path}/a.png"]
    assert command.main(words) == 0, capsys.readouterr().err
