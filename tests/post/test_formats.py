"""Files of format_version 1: they are read with today's names, alone and beside files of version 2."""

import shutil

import h5py
import numpy as np
import pytest
import tiltpad
from tiltpad import command, report

#: Names that changed with format_version 2: those of 1, and today's.
RENAMED = {"film_sor": "film_volumes", "sor_sweeps": "film_passes"}


def rewritten(file: h5py.File, version: int, group: str = "statistics/") -> None:
    """Gives a file the names of a format_version."""
    for former, today in RENAMED.items():
        there, wanted = (former, today) if version == 2 else (today, former)
        if group + there in file:
            file.move(group + there, group + wanted)
    file.attrs["format_version"] = version


@pytest.fixture
def versions(result, tmp_path):
    """The same result, whose pads are solved on finite volumes, in both versions."""
    (tmp_path / "runs").mkdir()
    paths = {version: tmp_path / f"runs/version{version}.h5" for version in (1, 2)}
    for version, path in paths.items():
        shutil.copy(result("sor"), path)
        with h5py.File(path, "r+") as file:
            rewritten(file, version)
            assert ("statistics/film_sor" in file) == (version == 1)
            assert ("statistics/film_volumes" in file) == (version == 2)
    return paths


def test_counts_have_today_s_names(versions):
    with tiltpad.read(versions[1]) as former, tiltpad.read(versions[2]) as today:
        assert former.names("statistics") == today.names("statistics")
        assert set(RENAMED.values()) <= set(former.statistics)
        assert former.statistics == today.statistics
        for name, now in RENAMED.items():
            with h5py.File(versions[1]) as file:
                assert former[f"statistics/{now}"] == file[f"statistics/{name}"][()]
            assert former["statistics/film_volumes"] > 0
            assert f"statistics/{name}" not in former
            assert former.about(f"statistics/{now}", "units") == "1"
            with pytest.raises(tiltpad.NotInRunError, match=f"no statistics/{name} in this run"):
                former[f"statistics/{name}"]


def test_the_report_shows_them(versions):
    pages = []
    for path in versions.values():
        with tiltpad.read(path) as run:
            pages.append(report.statistics(run))
    assert pages[0] == pages[1]


def test_a_folder_of_both_versions_is_one_study(versions, tmp_path, capsys):
    folder = versions[1].parent
    tiltpad.collect(folder, tmp_path / "study.h5")
    with tiltpad.read_study(tmp_path / "study.h5") as study:
        assert study.format_version == 2
        assert study.film_volumes[0] == study.film_volumes[1] > 0
        assert study.film_passes[0] == study.film_passes[1] > 0
        assert not set(RENAMED) & set(study.names())


def test_a_study_of_version_1(sweep, tmp_path, capsys):
    values = {"operation%speed_rpm": [3000, 5000]}
    scene = "&operation duration=0.05 / &output samples_per_revolution=40 / &film solver='sor' /"
    tiltpad.collect(sweep(tmp_path / "speeds", scene, values), tmp_path / "study.h5")
    shutil.copy(tmp_path / "study.h5", tmp_path / "former.h5")
    with h5py.File(tmp_path / "former.h5", "r+") as file:
        rewritten(file, 1, "")
    with (
        tiltpad.read_study(tmp_path / "study.h5") as today,
        tiltpad.read_study(tmp_path / "former.h5") as former,
    ):
        assert former.names() == today.names()
        for name in RENAMED.values():
            assert (former[name] > 0).all()
            np.testing.assert_array_equal(former[name], today[name])
    words = ["study", str(tmp_path / "former.h5"), "--show", "film_passes", "-o", str(tmp_path / "a.png")]
    assert command.main(words) == 0, capsys.readouterr().err
