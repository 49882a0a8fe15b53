"""Files that are not the program's: beside a result, under its name, behind links. They stay as they are."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import h5py
import pytest
from conftest import ENDLESS, EVERY_STEP, one_error, wait_for, wait_for_checkpoint

#: A machine whose rotor is in a file that may not be read.
ROTOR = "&rotor file='case.h5' /\n&bearing name='a', station=1 /\n&bearing name='b', station=2 /\n"
CASE = "&operation duration=0.02 / &output checkpoint_seconds=0.005 /\n"


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.nml").write_text(CASE)
    return tmp_path


def contents(folder):
    """What every file, link and pipe of a folder is and contains."""
    found = {}
    for path in sorted(folder.iterdir()):
        if path.is_symlink():
            found[path.name] = "to " + os.readlink(path)
        elif path.is_file():
            found[path.name] = path.read_bytes()
        else:
            found[path.name] = "no file"
    return found


@pytest.fixture
def refused(tiltpad, case):
    """refused(arguments, words): a run that must be refused, with these words."""

    def run(arguments, *words):
        done = tiltpad(*arguments, cwd=case, status=3)
        assert done.stdout == ""
        for word in words:
            assert word in done.stderr

    return run


@pytest.fixture
def running(start, case):
    """running("case.h5"): a run that does not end by itself, and has made these files."""

    def begin(*names):
        process = start(case, "case.nml", "-q", *ENDLESS)
        wait_for(lambda: all((case / name).exists() for name in names), process)
        return process

    return begin


@pytest.mark.parametrize(
    "arguments", [["case.nml"], ["--resume", "case.h5"], ["--resume", "case.h5", "case.nml"]]
)
def test_copies_beside_a_result(tiltpad, case, arguments):
    """Of the names that the program uses and has used."""
    tiltpad("case.nml", "-q", cwd=case, status=0)
    for name in ("case.h5.old", "case.h5.part", "case.h5.part2"):
        shutil.copy(case / "case.h5", case / name)
    before = contents(case)
    tiltpad(*arguments, cwd=case, status=0)
    after = contents(case)
    assert after.keys() == before.keys()
    assert all(after[name] == before[name] for name in before if name != "case.h5")


def test_copies_beside_a_result_when_the_run_fails(tiltpad, case):
    for name in ("case.h5.old", "case.h5.part"):
        (case / name).write_bytes(b"precious")
    before = contents(case)
    tiltpad("case.nml", "-q", "--set", "rotor%static_load=1e7,0", cwd=case, status=2)
    assert contents(case) == before


@pytest.mark.parametrize(
    ("name", "output", "status"), [("c.h5.lock", "c.h5", 3), ("c.old", "c", 0), ("c.h5.part", "c.h5", 0)]
)
def test_a_case_with_the_name_of_a_side_file(tiltpad, case, name, output, status):
    (case / name).write_text(CASE)
    done = tiltpad(name, "-q", "--output", output, cwd=case, status=status)
    assert not status or "c.h5.lock is no lock file of tiltpad; remove or rename it" in done.stderr
    assert (case / name).read_text() == CASE


@pytest.mark.parametrize("kind", ["symbolic", "hard", "dangling", "pipe", "folder"])
def test_links_with_the_name_of_a_part(tiltpad, case, kind):
    """Their targets keep every byte, and nothing waits for a pipe. Of locks: test_working_file.f90."""
    (case / "target").write_bytes(b"precious" * 100)
    place = case / "case.h5.part"
    if kind == "symbolic":
        place.symlink_to("target")
    elif kind == "hard":
        place.hardlink_to(case / "target")
    elif kind == "dangling":
        place.symlink_to("nothing")
    elif kind == "pipe":
        os.mkfifo(place)
    else:
        place.mkdir()
    before = contents(case)
    tiltpad("case.nml", "-q", cwd=case, status=0)
    with h5py.File(case / "case.h5") as file:
        assert file.attrs["complete"] == 1
    after = contents(case)
    del after["case.h5"]
    assert after == before


def test_a_result_that_names_a_file(start, tiltpad, case):
    """A resumed run reads the table of its own input alone, and says nothing of what is in another file."""
    (case / "force.csv").write_text("time,force_y,force_z\n0,1,0\n20000,2,0\n")
    with (case / "case.nml").open("a") as file:
        file.write("&excitation kind='table', file='force.csv' /\n")
    process = start(case, "case.nml", "-q", *ENDLESS, *EVERY_STEP)
    wait_for_checkpoint(case / "case.h5", process)
    process.kill()
    process.wait()
    (case / "secret").write_text("the secret, is written, here\n")
    with h5py.File(case / "case.h5", "r+") as file:
        file.attrs["input"] = file.attrs["input"].replace("force.csv", "secret")
    done = tiltpad("--resume", "case.h5", cwd=case, status=3)
    assert (
        "case.h5: its input names a file that is not there, or not what the run has read; name "
        in done.stderr
    )
    assert done.stderr.count("\n") == 1
    assert "secret" not in done.stderr + done.stdout


def test_what_is_no_result_is_not_replaced(refused, case):
    """Whatever it is, and also with --overwrite."""
    (case / "other.nml").write_text("&case title='precious' /\n")
    (case / "empty").touch()
    with h5py.File(case / "other.h5", "w") as file:
        file["x"] = 1
    with h5py.File(case / "study.h5", "w") as file:
        file.attrs.update({"program": "tiltpad", "format_version": 3, "task": "study", "input": "&case /"})
    before = contents(case)
    for name in ("other.nml", "empty", "other.h5", "study.h5"):
        for options in ([], ["--overwrite"]):
            refused(["case.nml", "-q", *options, "--output", name], name, "; it is not replaced")
    assert contents(case) == before


def test_the_result_of_another_case_is_replaced_only_if_asked(tiltpad, refused, case):
    tiltpad("case.nml", "-q", cwd=case, status=0)
    before = contents(case)
    heavier = ["case.nml", "-q", "--set", "rotor%mass=2100"]
    refused(
        heavier, "case.h5: is the result of another case; rotor%mass = 2000 there, 2100 here; --overwrite"
    )
    assert contents(case) == before
    # the same case is run again
    tiltpad("case.nml", "-q", cwd=case, status=0)
    tiltpad(*heavier, "--overwrite", cwd=case, status=0)
    with h5py.File(case / "case.h5") as file:
        assert "mass = 2100" in file.attrs["input"]
    assert sorted(contents(case)) == ["case.h5", "case.nml"]


def test_a_killed_run_leaves_its_part_and_others_theirs(running, tiltpad, case):
    """The next run deletes the part that the lock names, and no copy of it, though it has the part's name."""
    for replaced in (False, True):
        process = running("case.h5", "case.h5.part")
        process.kill()
        process.wait()
        part = case / "case.h5.part"
        if replaced:
            # both exist at once: within a tick of the clock the copy could get the part's number and time
            copy = case / "copy"
            copy.write_bytes(part.read_bytes())
            copy.replace(part)
        tiltpad("case.nml", "-q", "--overwrite", cwd=case, status=0)
        assert part.exists() == replaced
        (case / "case.h5").unlink()
    assert sorted(contents(case)) == ["case.h5.part", "case.nml"]


def test_a_file_put_under_the_name_while_the_run_writes(running, case):
    """It stays; where the run has a whole part, that stays too."""
    process = running("case.h5")
    (case / "precious").write_bytes(b"precious")
    (case / "precious").rename(case / "case.h5")
    said = one_error(process, 3)
    assert (case / "case.h5").read_bytes() == b"precious"
    if "something else has been put there" in said:
        with h5py.File(case / "case.h5.part") as file:
            assert len(file["time"]) > 0


def test_a_folder_that_looks_like_the_trial_of_a_study(program, case):
    """Also with the number of the process, which a shell knows."""
    (case / "sweep.nml").write_text("&case task='equilibrium' /\n&sweep rotor%mass=1000,2000 /\n")
    (case / "sweep").mkdir()
    command = ["sh", "-c", f"mkdir sweep/.part$$; exec {program} -q sweep.nml"]
    done = subprocess.run(command, cwd=case, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert [path.is_dir() for path in (case / "sweep").iterdir() if path.name.startswith(".part")] == [True]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may be another user")
def test_what_the_user_may_not_read(program, tiltpad):
    """Results, starts, rotors and studies: the reason is the system's."""
    study = "&case task='equilibrium' /\n&sweep rotor%mass=1001:1002:1 /\n"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        (folder / "case.nml").write_text("&case task='equilibrium' /\n")
        (folder / "study.nml").write_text(study)
        (folder / "rotor.nml").write_text(ROTOR)
        for case in "case.nml", "study.nml":
            tiltpad(case, "-q", cwd=folder, status=0)
        for result in folder.glob("*.h5"):
            result.chmod(0)
        folder.chmod(0o777)
        start = ["--set", "case%task=march", "--set", "start%from=file", "--set", "start%file=case.h5"]
        for arguments, which, status in (
            (["--resume", "case.h5"], "case.h5", 3),
            (["case.nml"], "case.h5", 3),
            (["case.nml", "--overwrite"], "case.h5", 3),
            (["study.nml", "--overwrite"], "study.h5", 3),
            (["case.nml", "-o", "other.h5", *start], "case.h5", 3),
            (["rotor.nml"], "case.h5'", 1),
        ):
            command = ["setpriv", "--reuid=65534", "--clear-groups", program, "-q", *arguments]
            done = subprocess.run(command, cwd=folder, text=True, capture_output=True)
            assert done.returncode == status, done.stderr
            assert done.stderr.count("\n") == 1
            assert f"{which}: cannot be read: permission denied" in done.stderr
        assert sorted(each.name for each in folder.glob("*.h5*")) == ["case.h5", "study.h5"]
