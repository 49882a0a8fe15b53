"""Runs that are stopped, killed, or cannot write: what is left, and going on from it."""

import os
import random
import re
import resource
import shutil
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import (
    ENDLESS,
    EVERY_STEP,
    TIMEOUT,
    in_a_mount_namespace,
    one_error,
    shorten,
    wait_for,
    wait_for_checkpoint,
)

CASE = "&friction model='lugre' / &operation duration=0.5 / &output checkpoint_seconds=0.01 /\n"
#: What a case may add: every kind of state, film and end that a resumed run must take up.
CASES = {
    "lugre": "",
    "bengisu": "--set friction%model='bengisu_akay' --set operation%duration=0.1",
    "none": "--set friction%model='none' --set operation%duration=2",
    "tilting": "--set pads%motion='tilting_only'",
    "fixed": "--set pads%motion='fixed' --set friction%model='none' --set film%cavitation='gumbel' "
    "--set integration%max_step=1e-4",
    "runup": "--set operation%speed_rpm=3000 --set operation%final_speed_rpm=6500",
    "gumbel": "--set film%cavitation='gumbel' --set pads%pivot_angle_deg=-45,225,45,135 "
    "--set operation%duration=0.2",
    "sor": "--set film%solver='sor' --set operation%duration=0.02",
    "late": "--set output%start_time=0.02",
    "anticlockwise": "--set operation%rotation='anticlockwise' --set rotor%static_load=0,4000",
    "warm_runup": "--set oil%grade=46 --set thermal%model='pad' --set thermal%march='groove' "
    "--set oil%groove_volume=1e-5 --set operation%final_speed_rpm=5000 --set operation%duration=0.2",
    "warm": "--set oil%grade=46 --set thermal%model='pad' --set operation%duration=0.3",
    "film_temperatures": "--set oil%grade=46 --set thermal%model='film' --set operation%duration=0.1",
    "bent": "--set pads%bending='elastic' --set operation%duration=0.1",
}
KILLS = 6


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.nml").write_text(CASE)
    return tmp_path


@pytest.fixture(scope="module")
def whole(tiltpad, tmp_path_factory):
    """whole("lugre"): path of that case's result, never interrupted."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "case.nml").write_text(CASE)

    def path(case_name):
        output = folder / f"{case_name}.h5"
        if not output.exists():
            tiltpad("case.nml", "-q", "-o", output, *CASES[case_name].split(), cwd=folder, status=0)
        return output

    return path


def series(file):
    """Names of the series over time."""
    return [
        name
        for name, each in file.items()
        if isinstance(each, h5py.Dataset) and each.shape and (name == "time" or "time" in each.dims[0])
    ]


def reached(path):
    """Simulated time of the checkpoint in a file; 0 where it is opened while its name changes hands."""
    try:
        with h5py.File(path) as file:
            return file["checkpoint/time"][()]
    except BlockingIOError:
        return 0.0


def lengths(file):
    return {len(file[name]) for name in series(file)}


def check_checkpoint(path, reference):
    """A whole HDF5 file with all samples up to its checkpoint, at the very times of the uninterrupted run."""
    with h5py.File(path) as file, h5py.File(reference) as uninterrupted:
        assert len(lengths(file)) <= 1
        if file.attrs["complete"]:
            return
        found, expected = file["time"][:] if "time" in file else np.zeros(0), uninterrupted["time"][:]
        assert (found == expected[: len(found)]).all()
        reached = file["checkpoint/time"][()]
        assert np.searchsorted(expected, reached, side="right") == len(found)
        assert file["statistics/steps"][()] > 0 or reached == 0


def check_joined(path, reference, resumes=None):
    """Nothing doubled, nothing missing, and within the integration error of the uninterrupted run."""
    with h5py.File(path) as file, h5py.File(reference) as uninterrupted:
        assert file.attrs["complete"] == 1
        assert file.attrs["exit_status"] == 0
        if resumes is not None:
            assert file.attrs["resumes"] == resumes
            assert len(file.attrs["history"].splitlines()) == resumes + 1
        assert "checkpoint" not in file
        assert file.keys() == uninterrupted.keys()
        assert (file["time"][:] == uninterrupted["time"][:]).all()
        assert file["statistics"].keys() == uninterrupted["statistics"].keys()
    with package.read(path) as run, package.read(reference) as uninterrupted:
        # both are within 1e-3 of the truth (docs/benchmarks.md), so within twice that of each other
        assert max(package.deviations(run, uninterrupted).values()) < 2e-3


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGUSR1, signal.SIGINT, signal.SIGXCPU])
def test_a_signal_leaves_a_checkpoint(start, tiltpad, case, number):
    process = start(case, "case.nml", *ENDLESS, "--set", "output%checkpoint_seconds=0")
    # the first chunk of samples
    part = case / "case.h5.part"
    wait_for(lambda: part.exists() and part.stat().st_size > 1e6, process)
    process.send_signal(number)
    error = one_error(process, 4)
    assert f"signal {int(number)}" in error
    assert "tiltpad --resume case.h5" in error
    assert sorted(path.name for path in case.iterdir()) == ["case.h5", "case.nml"]
    end = shorten(case / "case.h5")
    tiltpad("case.nml", "-q", "-o", "whole.h5", "--set", f"operation%duration={end!r}", cwd=case, status=0)
    check_checkpoint(case / "case.h5", case / "whole.h5")
    with h5py.File(case / "case.h5") as file:
        assert file.attrs["exit_status"] == 4
        assert file.attrs["ended"]
        assert str(int(number)) in file.attrs["reason"]
    tiltpad("--resume", "case.h5", cwd=case, status=0)
    check_joined(case / "case.h5", case / "whole.h5", resumes=1)
    assert sorted(path.name for path in case.iterdir()) == ["case.h5", "case.nml", "whole.h5"]


def test_a_signal_while_the_equilibrium_is_sought(start, case):
    """There is nothing to keep yet."""
    (case / "case.nml").write_text("&film circumferential_cells=400, axial_cells=200 /\n")
    run = start(case, "case.nml", "-q")
    wait_for((case / "case.h5.part").exists, run)
    assert not (case / "case.h5").exists()
    run.terminate()
    said = one_error(run, 4)
    assert said == "tiltpad: error: stopped by signal 15 before the march; nothing was computed yet\n"
    assert [path.name for path in case.iterdir()] == ["case.nml"]


WIDE_ARCS = "pads%motion=fixed friction%model=none pads%pivot_angle_deg=-90,90 pads%arc_deg=160"


@pytest.mark.parametrize("settings", ["", WIDE_ARCS], ids=["lugre", "wide arcs"])
def test_a_cavitated_film_is_resumed_to_the_bit(start, tiltpad, case, settings):
    """From a checkpoint where a film is cavitated: the same bits, twice."""
    of_case = [word for each in settings.split() for word in ("--set", each)]
    process = start(case, "case.nml", "-q", *ENDLESS, "--set", "rotor%unbalance=0.03", *of_case)
    wait_for_checkpoint(case / "case.h5", process)
    process.terminate()
    one_error(process, 4)
    shorten(case / "case.h5", 0.3)
    shutil.copy(case / "case.h5", case / "again.h5")
    with h5py.File(case / "case.h5") as file:
        before = len(file["time"])
        assert file["statistics/film_nodes"][()] > 0
    for name in ("case.h5", "again.h5"):
        tiltpad("--resume", name, "-q", cwd=case, status=0)
    with h5py.File(case / "case.h5") as one, h5py.File(case / "again.h5") as other:
        assert len(one["time"]) > before
        for name in series(one):
            assert (one[name][:] == other[name][:]).all(), name


@pytest.mark.parametrize("case_name", CASES)
def test_every_case_can_be_resumed(start, tiltpad, case, whole, case_name):
    """Stopped at some parts of its way, the last time by kill -9."""
    arguments = ["--resume", "case.h5", "case.nml", "-q", *CASES[case_name].split()]
    output = case / "case.h5"
    with h5py.File(whole(case_name)) as file:
        end = file["time"][-1]
    for number, part in ((signal.SIGTERM, 0), (signal.SIGUSR1, 0.05), (signal.SIGKILL, 0.1)):
        process = start(case, *arguments, *EVERY_STEP)
        wait_for_checkpoint(output, process)
        wait_for(lambda part=part: reached(output) > part * end, process)
        process.send_signal(number)
        process.wait(TIMEOUT)
        check_checkpoint(output, whole(case_name))
    tiltpad(*arguments, cwd=case, status=0)
    check_joined(case / "case.h5", whole(case_name), resumes=3)


def test_kills_at_random_instants(start, case, whole):
    """kill -9 at any instant leaves what was published last, whole; and the run goes on from it."""
    chance = random.Random(5)
    output = case / "case.h5"
    arguments = ("--resume", "case.h5", "case.nml", "-q")
    began = time.monotonic()
    assert start(case, "case.nml", "-q").wait(TIMEOUT) == 0
    all_of_it = time.monotonic() - began
    output.unlink()
    kills = 0
    while kills < KILLS:
        with start(case, *arguments) as process:
            try:
                process.wait(chance.uniform(0, all_of_it))
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
        if process.returncode == -signal.SIGKILL:
            if output.exists():
                check_checkpoint(output, whole("lugre"))
        else:
            assert process.returncode == 0
            check_joined(output, whole("lugre"))
            output.unlink()
    assert start(case, *arguments).wait(TIMEOUT) == 0
    check_joined(output, whole("lugre"))
    assert sorted(path.name for path in case.iterdir()) == ["case.h5", "case.nml"]


def test_checkpoints_do_not_change_a_run(tiltpad, case, whole):
    tiltpad("case.nml", "--set", "output%checkpoint_seconds=0", cwd=case, status=0)
    with h5py.File(case / "case.h5") as file, h5py.File(whole("lugre")) as often:
        assert file.keys() == often.keys()
        for name in ("time", "journal_y", "pad_tilt", "friction_moment", "max_pressure"):
            assert (file[name][:] == often[name][:]).all()
        assert file["statistics/steps"][()] == often["statistics/steps"][()]


def test_a_periodic_orbit_is_recognised_after_resuming(start, tiltpad, case):
    """The end by stop_when_periodic looks back over the interruption."""
    smooth = CASE.replace("lugre", "none")
    (case / "case.nml").write_text(f"{smooth}&integration stop_when_periodic=1e-4 /\n")
    arguments = ["case.nml", "-q", "--set", "integration%max_step=1e-5"]
    tiltpad(*arguments, "-o", "whole.h5", cwd=case, status=0)
    process = start(case, *arguments, *EVERY_STEP)
    wait_for_checkpoint(case / "case.h5", process)
    # behind the first revolution
    wait_for(lambda: reached(case / "case.h5") > 0.01, process)
    process.terminate()
    one_error(process, 4)
    tiltpad(*arguments, "--resume", "case.h5", cwd=case, status=0)
    with h5py.File(case / "case.h5") as file, h5py.File(case / "whole.h5") as reference:
        assert file.attrs["complete"] == 1
        revolution = 360
        assert len(reference["time"]) < 0.5 * 6500 / 60 * revolution  # it did end early
        assert abs(len(file["time"]) - len(reference["time"])) <= revolution


def test_a_complete_run_is_left_alone(tiltpad, case):
    tiltpad("case.nml", "-q", cwd=case, status=0)
    before = (case / "case.h5").read_bytes()
    for arguments in (["--resume", "case.h5"], ["--resume", "case.h5", "case.nml"]):
        done = tiltpad(*arguments, cwd=case, status=0)
        assert done.stdout == "case.h5: complete already, nothing to do\n"
        assert tiltpad(*arguments, "--quiet", cwd=case).stdout == ""
    assert (case / "case.h5").read_bytes() == before
    assert sorted(path.name for path in case.iterdir()) == ["case.h5", "case.nml"]


@pytest.fixture
def stopped(start, case):
    """A folder with a run that was stopped at a checkpoint."""
    process = start(case, "case.nml", "-q", *EVERY_STEP)
    wait_for_checkpoint(case / "case.h5", process)
    process.terminate()
    one_error(process, 4)
    with h5py.File(case / "case.h5", "r+") as file:
        file.attrs["input"] = re.sub(r"(checkpoint_seconds = )\S+", r"\g<1>0.01", file.attrs["input"])
    return case


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ("operation%duration=1", "operation%duration = 0.5 there, 1 here"),
        ("rotor%mass=2100", "rotor%mass = 2000 there, 2100 here"),
        ("friction%model='none'", "friction%model = 'lugre' there, 'none' here"),
        ("pads%arc_deg=60,69", "pads%arc_deg = 69.3, 69.3 there, 60, 69 here"),
        ("case%title='another'", "case%title = '' there, 'another' here"),
    ],
)
def test_another_case_is_refused_by_name(tiltpad, stopped, change, named):
    before = (stopped / "case.h5").read_bytes()
    done = tiltpad("--resume", "case.h5", "case.nml", "--set", change, cwd=stopped, status=3)
    assert done.stderr == f"tiltpad: error: case.h5: is the result of another case; {named}\n"
    assert (stopped / "case.h5").read_bytes() == before


def test_the_time_between_checkpoints_may_change(tiltpad, stopped):
    tiltpad("--resume", "case.h5", "case.nml", "--set", "output%checkpoint_seconds=7", cwd=stopped, status=0)


def test_resume_takes_no_other_output(tiltpad, stopped):
    for arguments in (["--output", "x.h5"], ["--set", "rotor%mass=1"]):
        tiltpad("--resume", "case.h5", *arguments, cwd=stopped, status=1)


def test_a_checkpoint_is_not_discarded_unasked(tiltpad, stopped):
    """The same command again says what goes on; a study, whose runs go on, needs no such word."""
    before = (stopped / "case.h5").read_bytes()
    own = ["case.nml", "-q", *EVERY_STEP]
    done = tiltpad(*own, cwd=stopped, status=3)
    assert done.stderr == (
        "tiltpad: error: case.h5: has a checkpoint of this case; --resume case.h5 goes on from it, "
        "and --overwrite starts anew\n"
    )
    assert (stopped / "case.h5").read_bytes() == before
    tiltpad("case.nml", "-q", "--overwrite", cwd=stopped, status=0)
    with h5py.File(stopped / "case.h5") as file:
        assert (file.attrs["complete"], file.attrs["resumes"]) == (1, 0)
    # a complete result is calculated anew
    tiltpad("case.nml", "-q", cwd=stopped, status=0)


def test_check_prints_the_case_of_a_file(tiltpad, stopped):
    done = tiltpad("--resume", "case.h5", "--check", cwd=stopped, status=0)
    with h5py.File(stopped / "case.h5") as file:
        assert done.stdout == file.attrs["input"]


def test_numerics_that_failed_are_not_tried_again(tiltpad, case):
    arguments = ["case.nml", "--set", "integration%max_steps=500", "-q"]
    tiltpad(*arguments, cwd=case, status=2)
    before = (case / "case.h5").read_bytes()
    again = tiltpad(*arguments, "--resume", "case.h5", cwd=case, status=2)
    assert "integration%max_steps" in again.stderr
    assert (case / "case.h5").read_bytes() == before


def test_the_file_tells_its_making(tiltpad, stopped):
    tiltpad("--resume", "case.h5", cwd=stopped, status=0)
    version = tiltpad("--version").stdout.split()
    with h5py.File(stopped / "case.h5") as file:
        attributes = dict(file.attrs)
    assert [attributes["version"], f"({attributes['commit']})"] == version[1:]
    assert attributes["host"] == os.uname().nodename
    assert attributes["compiler"].startswith("GCC version")
    assert "-O" in attributes["flags"]
    assert attributes["created"] <= attributes["ended"]
    assert (attributes["resumes"], attributes["exit_status"], attributes["reason"]) == (1, 0, "")
    first, second = attributes["history"].splitlines()
    assert "exit status 4: stopped by signal 15" in first
    assert second.endswith("exit status 0")


def test_the_second_writer_is_refused(start, tiltpad, case):
    long = start(case, "case.nml", "-q", *ENDLESS)
    wait_for_checkpoint(case / "case.h5", long)
    for arguments in (["case.nml", "--overwrite"], ["--resume", "case.h5"]):
        done = tiltpad(*arguments, cwd=case, status=3)
        assert f"process {long.pid} on {os.uname().nodename} is writing it" in done.stderr
        assert done.stderr.count("\n") == 1
    # through a link it is the same file
    (case / "link.h5").symlink_to("case.h5")
    tiltpad("case.nml", "--overwrite", "-o", "link.h5", cwd=case, status=3)
    # killed, it holds nothing
    long.kill()
    long.wait()
    assert (case / "case.h5.lock").exists()
    done = tiltpad("--resume", "case.h5", "--check", cwd=case, status=0)
    done = tiltpad("case.nml", "--overwrite", cwd=case, status=0)
    assert f"process {long.pid} on {os.uname().nodename}, which wrote it, has ended" in done.stdout
    assert not list(case.glob("*.lock"))
    assert not list(case.glob("*.part"))


def test_a_reader_keeps_what_it_opened(start, case):
    """Who has a checkpoint open is not disturbed by the next ones."""
    process = start(case, "case.nml", "-q", *ENDLESS)
    wait_for_checkpoint(case / "case.h5", process)
    with h5py.File(case / "case.h5") as file:
        samples, reached = len(file["time"]), file["checkpoint/time"][()]
        for _ in range(20):
            assert len(file["time"]) == samples
            assert file["time"][-1] <= reached
            wait_for_checkpoint(case / "case.h5", process)
    process.terminate()
    one_error(process, 4)
    with h5py.File(case / "case.h5") as file:
        assert len(file["time"]) > samples
        assert len(lengths(file)) == 1


# ---- disks -------------------------------------------------------------------------------------
def test_a_full_disk_keeps_the_last_checkpoint(program, case, whole):
    """Whatever is written when the disk is full; room made, the run goes on."""
    for size in (1900, 2500, 2900, 3500):
        done = in_a_mount_namespace(
            """
            mkdir -p $FOLDER/disk; mount -t tmpfs -o size=${SIZE}k tmpfs $FOLDER/disk; cd $FOLDER/disk
            status=0; $PROGRAM -q ../case.nml $MORE || status=$?
            ls >&2; test $status = 3
            cp case.h5 ../full.h5
            mount -o remount,size=100m $FOLDER/disk
            $PROGRAM -q --resume case.h5
            cp case.h5 ../joined.h5
            """,
            FOLDER=case,
            PROGRAM=program,
            MORE="--set operation%duration=0.25 --set output%checkpoint_seconds=1e-3",
            SIZE=size,
        )
        assert done.returncode == 0, done.stderr
        error, *left = done.stderr.splitlines()
        assert error.startswith("tiltpad: error: ")
        assert error.endswith("no space left on device")
        assert left == ["case.h5"]
        with h5py.File(case / "full.h5") as file, h5py.File(case / "joined.h5") as joined:
            assert file.attrs["complete"] == 0
            assert len(lengths(file)) == 1
            assert joined.attrs["complete"] == 1
            assert (joined["time"][: len(file["time"])] == file["time"][:]).all()
            assert np.ptp(np.diff(joined["time"][:])) < 1e-12


def test_a_disk_full_from_the_start(program, case):
    done = in_a_mount_namespace(
        """
        mkdir $FOLDER/disk; mount -t tmpfs -o size=200k tmpfs $FOLDER/disk; cd $FOLDER/disk
        status=0; $PROGRAM -q ../case.nml || status=$?
        ls; exit $status
        """,
        FOLDER=case,
        PROGRAM=program,
    )
    assert done.returncode == 3
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert "no space left on device" in done.stderr


def test_a_read_only_disk(program, stopped):
    """What is there stays as it is."""
    done = in_a_mount_namespace(
        """
        mkdir $FOLDER/disk; mount -t tmpfs tmpfs $FOLDER/disk; cd $FOLDER/disk
        cp ../case.h5 .; mount -o remount,ro $FOLDER/disk
        status=0; $PROGRAM -q --resume case.h5 || status=$?
        cmp case.h5 ../case.h5; ls; exit $status
        """,
        FOLDER=stopped,
        PROGRAM=program,
    )
    assert done.returncode == 3
    assert done.stderr.count("\n") == 1
    assert "read-only file system" in done.stderr
    assert done.stdout == "case.h5\n"


def test_a_complete_run_on_a_read_only_disk(program, tiltpad, case):
    """There is nothing to do, and so nothing to write."""
    tiltpad("case.nml", "-q", "--set", "operation%duration=0.01", cwd=case, status=0)
    done = in_a_mount_namespace(
        """
        mkdir $FOLDER/disk; mount -t tmpfs tmpfs $FOLDER/disk; cd $FOLDER/disk
        cp ../case.h5 .; mount -o remount,ro $FOLDER/disk
        $PROGRAM --resume case.h5; ls
        """,
        FOLDER=case,
        PROGRAM=program,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "case.h5: complete already, nothing to do\ncase.h5\n"


def test_a_deleted_folder(start, case):
    (case / "run").mkdir()
    process = start(case, "case.nml", "-q", "-o", "run/case.h5", *ENDLESS)
    wait_for_checkpoint(case / "run" / "case.h5", process)
    shutil.rmtree(case / "run", ignore_errors=True)
    shutil.rmtree(case / "run", ignore_errors=True)
    error = one_error(process, 3)
    # Which of the three is missed first depends on what the run does in that moment.
    reasons = ("no such file or directory", "its lock is gone", "was removed or replaced by something else")
    assert any(reason in error for reason in reasons)


def test_a_limit_on_file_size(start, case):
    limits = (2**20, 2**20)
    process = start(
        case, "case.nml", "-q", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    )
    assert "file too large" in one_error(process, 3)
    if (case / "case.h5").exists():
        with h5py.File(case / "case.h5") as file:
            assert len(lengths(file)) == 1


# ---- damaged files -----------------------------------------------------------------------------


def refused(tiltpad, folder, names=(), status=3):
    before = (folder / "case.h5").read_bytes()
    done = tiltpad("--resume", "case.h5", cwd=folder, status=status)
    assert done.stderr.startswith("tiltpad: error: case.h5: ")
    assert done.stderr.count("\n") == 1
    for name in names:
        assert name in done.stderr
    assert (folder / "case.h5").read_bytes() == before
    assert not list(folder.glob("*.part"))
    return done.stderr


def test_what_cannot_be_resumed(tiltpad, stopped):
    path = stopped / "case.h5"
    good = path.read_bytes()
    for content in (b"", b"text\n", b"\x89HDF\r\n\x1a\n" + 100 * b"\0", good[: len(good) // 2], good[:2000]):
        path.write_bytes(content)
        refused(tiltpad, stopped)

    def edited(edit, *names):
        path.write_bytes(good)
        with h5py.File(path, "r+") as file:
            edit(file)
        refused(tiltpad, stopped, names)

    edited(lambda file: file.attrs.__setitem__("format_version", 99), "later version")
    for version in (0, 2):
        edited(
            lambda file, version=version: file.attrs.__setitem__("format_version", version),
            f"format_version {version}, written by an earlier version",
        )
    edited(lambda file: file.attrs.__setitem__("program", "another"), "not a result of tiltpad")
    edited(lambda file: file.attrs.__delitem__("program"), "not a result of tiltpad")
    edited(lambda file: file.attrs.__delitem__("input"), "input")
    edited(lambda file: file.attrs.__setitem__("input", "&rotor mass=-1 /"), "rotor%mass")
    edited(lambda file: file.__delitem__("checkpoint"), "no checkpoint")
    path.write_bytes(good)
    with h5py.File(path, "w") as file:
        file["x"] = 1
    refused(tiltpad, stopped, ["not a result of tiltpad"])
    path.unlink()
    done = tiltpad("--resume", "case.h5", cwd=stopped)
    assert (done.returncode, done.stderr) == (3, "tiltpad: error: case.h5: no such file\n")
    os.mkfifo(path)
    done = tiltpad("--resume", "case.h5", cwd=stopped, status=3)
    assert done.stderr == "tiltpad: error: case.h5: a directory, device or pipe, not a result file\n"


def test_a_checkpoint_that_does_not_fit_its_samples(tiltpad, stopped):
    path = stopped / "case.h5"
    good = path.read_bytes()

    def other(name, values):
        def edit(file):
            del file[name]
            file[name] = values

        return edit

    edits = [
        lambda file: file["checkpoint/time"].__setitem__((), 0.4999),
        lambda file: file["checkpoint/time"].__setitem__((), -1),
        lambda file: file.attrs.__delitem__("history"),
        lambda file: file.__delitem__("statistics/steps"),
        other("checkpoint/state", [1.0]),
        lambda file: file["checkpoint/state"].__setitem__(0, np.nan),
        lambda file: file["journal_y"].resize(len(file["time"]) - 1, axis=0),
        lambda file: file.__delitem__("pad_tilt"),
    ]
    for edit in edits:
        path.write_bytes(good)
        with h5py.File(path, "r+") as file:
            edit(file)
        done = tiltpad("--resume", "case.h5", cwd=stopped, status=3)
        assert re.match(r"tiltpad: error: \S*case\.h5: damaged: ", done.stderr), done.stderr
        assert "no such file" not in done.stderr


def test_a_file_without_checksums(tiltpad, stopped):
    """HDF5 may crash where it changes damaged structures that have none: such a file is not continued."""
    path = stopped / "case.h5"
    path.rename(stopped / "sound.h5")
    with h5py.File(stopped / "sound.h5") as sound, h5py.File(path, "w", libver="earliest") as file:
        file.attrs.update(sound.attrs)
        for name in sound:
            sound.copy(name, file)
    before = path.read_bytes()
    done = tiltpad("--resume", "case.h5", cwd=stopped, status=3)
    assert done.stderr.endswith("HDF5 could not find checksums in it; start the run anew\n")
    assert path.read_bytes() == before
