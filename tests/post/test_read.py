"""Opening a result, and the messages about one that cannot be opened."""

import os
import re
import sys

import h5py
import numpy as np
import pytest
import tiltpad
from tiltpad.calculate import differences


def test_items_and_attributes_are_the_datasets(run, result):
    case = run("lugre")
    with h5py.File(result("lugre"), "r") as file:
        np.testing.assert_array_equal(case.journal_y, file["journal_y"][()])
        np.testing.assert_array_equal(case["pad_tilt"], file["pad_tilt"][()])
        np.testing.assert_array_equal(case.values("pad_tilt", slice(5, 9)), file["pad_tilt"][5:9])
        np.testing.assert_array_equal(case["equilibrium/pad_tilt"], file["equilibrium/pad_tilt"][()])
        assert case.equilibrium["journal_y"] == file["equilibrium/journal_y"][()]
        assert set(case.spectrum) == set(file["spectrum"])
    assert (case.title, case.task, case.complete) == ("Steady, it's LuGre", "march", 1)
    assert "bristle_deflection" in case
    assert "bristle_deflection" in dir(case)
    assert "LuGre" in repr(case)


def test_input(run):
    case = run("lugre")
    assert case.clearance == 80e-6
    assert case.pads == 2
    assert case.input["case"]["title"] == "Steady, it's LuGre"
    assert case.input["pads"]["pivot_angle_deg"] == (-45, 225)
    assert case.input["friction"]["model"] == "lugre"
    assert case.input["friction"]["bristle_stiffness"] == 1e6
    assert case.input["output"]["samples_per_revolution"] == 360


def test_nothing_is_loaded_before_it_is_asked_for(run, monkeypatch):
    read = []
    original = h5py.Dataset.__getitem__
    monkeypatch.setattr(
        h5py.Dataset, "__getitem__", lambda self, key: read.append(self.name) or original(self, key)
    )
    case = run("lugre")
    assert read == []
    assert len(case.time) > 0
    assert read == ["/time"]


def test_a_closed_file_can_be_overwritten(run):
    with run("none") as case:
        pass
    assert not case.file


@pytest.mark.parametrize(
    ("case_name", "name", "reason"),
    [
        ("none", "bristle_deflection", "no bristle_deflection in this run: friction model is 'none'"),
        (
            "bengisu",
            "bristle_deflection",
            "no bristle_deflection in this run: friction model is 'bengisu_akay'",
        ),
        ("tilting", "pivot_deflection", "no pivot_deflection in this run: pad motion is 'tilting_only'"),
        ("tilting", "equilibrium/pivot_deflection", "pad motion is 'tilting_only'"),
        ("fixed", "pad_tilt", "no pad_tilt in this run: pad motion is 'fixed'"),
        ("fixed", "equilibrium/pivot_load", "pad motion is 'fixed'"),
        ("fixed", "spectrum/pad_tilt", "pad motion is 'fixed'"),
        ("runup", "spectrum/journal_y", "no spectrum in this run: the speed changes"),
        ("equilibrium", "journal_y", "no journal_y in this run: its task is 'equilibrium'"),
        ("lugre", "nonsense", "no nonsense in this run: there are asperity_force, "),
        ("lugre", "pivot_loads", "no pivot_loads in this run (did you mean pivot_load?)"),
        ("equilibrium", "jounal_y", "no jounal_y in this run (did you mean equilibrium/journal_y?)"),
        (
            "equilibrium",
            "equilibrium_y",
            "no equilibrium_y in this run (did you mean equilibrium/journal_y?)",
        ),
        ("equilibrium", "journal_y", "nothing was marched in time (did you mean equilibrium/journal_y?)"),
    ],
)
def test_a_dataset_that_the_case_lacks(run, result, case_name, name, reason):
    with pytest.raises(tiltpad.RunError, match=re.escape(reason)) as raised:
        run(case_name)[name]
    assert str(raised.value).startswith(str(result(case_name)) + ": ")
    if "/" not in name:
        assert not hasattr(run(case_name), name)


def test_no_such_file(tmp_path):
    with pytest.raises(tiltpad.RunError, match="no such file"):
        tiltpad.read(tmp_path / "missing.h5")
    with pytest.raises(tiltpad.RunError, match="is a folder"):
        tiltpad.read(tmp_path)


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="permissions do not bind here")
def test_no_permission(tmp_path):
    path = tmp_path / "closed.h5"
    path.touch(mode=0)
    with pytest.raises(tiltpad.RunError, match="no permission"):
        tiltpad.read(path)


def test_an_incomplete_run_is_read_with_a_warning(changed):
    path = changed("none", lambda file: file.attrs.modify("complete", 0))
    with pytest.warns(tiltpad.IncompleteRunWarning, match=r"incomplete run, ended at 0\.06 s of 0\.06 s"):
        case = tiltpad.read(path)
    assert len(case.journal_y) > 1000


def test_what_tells_runs_apart(run):
    inputs = [run(case_name).input for case_name in ("lugre", "bengisu", "none")]
    assert differences.differences(inputs) == ["LuGre", "Bengisu-Akay", "no friction"]
    inputs = [run(case_name).input for case_name in ("lugre", "tilting")]
    assert differences.differences(inputs) == ["tilting radial", "tilting only"]
    inputs = [run(case_name).input for case_name in ("four", "runup")]
    assert differences.differences(inputs) == [
        "6500 rpm, 4 pads, duration = 0.02 s",
        "1500 to 6500 rpm, 2 pads, duration = 0.1 s",
    ]
    assert differences.differences([inputs[0], inputs[0]]) == ["", ""]


def test_a_notebook_shows_a_table(run):
    case = run("lugre")
    page = case._repr_html_()
    for name in ("journal_y", "pivot_load"):
        about = [case.about(name, which) for which in ("units", "long_name")]
        cells = "</td><td>".join([name, str(case[name].shape), *about])
        assert f"<td>{cells}</td>" in page
    assert "<summary>equilibrium</summary>" in page
    case.attributes["title"] = "<b>"
    assert "&lt;b&gt;: march" in case._repr_html_()
