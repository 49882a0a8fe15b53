"""Studies whose runs are rows alone: how many files there are, what kills, signals and full disks leave,
the same bits however a study came about, and what is kept of single runs."""

import os
import re
import resource
import signal
import time

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import (
    FAST_CLOCK,
    TIMEOUT,
    arrays,
    in_a_mount_namespace,
    one_error,
    rows,
    wait_for,
    wait_for_checkpoint,
)

#: A study with a checkpoint whenever there can be one, and one of runs that do not end.
QUICK = "&case task='equilibrium' / &output checkpoint_seconds=1e-9 /\n&sweep rotor%mass=1001:{last}:1 /\n"
ENDLESS = "&operation duration=10000 / &output keep='summary' /\n&sweep rotor%mass=2000,2100,2200 /\n"


def expect_same(one, other):
    assert one.keys() == other.keys()
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def status(path):
    with h5py.File(path) as file:
        return file["status"][:]


def test_one_file_for_all_runs(tiltpad, case):
    folder = case(QUICK.format(last=1010))
    done = tiltpad("case.nml", cwd=folder, status=0)
    assert re.search(r"\n10 runs: 10 done, 0 failed; [0-9.]+ s; in case\.h5\n$", done.stdout)
    assert sorted(os.listdir(folder)) == ["case.h5", "case.nml"]
    before = rows(folder / "case.h5")
    assert "file" not in before
    # and one that is asked for
    tiltpad("case.nml", "--run", 3, cwd=folder, status=0)
    assert os.listdir(folder / "case") == ["0003.h5"]
    with h5py.File(folder / "case/0003.h5") as file:
        assert file["equilibrium/journal_y"][()] == before["equilibrium_journal_y"][2]
    for output in ("named", "named.h5", "named/"):
        tiltpad("case.nml", "-q", "-o", output, "--overwrite", cwd=folder, status=0)
        expect_same(rows(folder / "named.h5"), before)
    assert sorted(os.listdir(folder)) == ["case", "case.h5", "case.nml", "named.h5"]


@pytest.mark.parametrize(
    "text",
    [
        "&case task='coefficients' /\n"
        "&sweep pads%motion='tilting_radial','tilting_only' rotor%mass=1000:3000:500 /\n",
        "&operation duration=0.02 / &output keep='summary', samples_per_revolution=60 /\n"
        "&sweep operation%speed_rpm=2000:6000:1000 integration%max_steps=100000,30 "
        "friction%model='lugre','none' /\n",
    ],
    ids=["coefficients", "march"],
)
def test_bits_do_not_depend_on_the_number_of_processes(tiltpad, case, text):
    folder = case(text)
    for jobs in (1, 2, 5):
        tiltpad("case.nml", "-q", "--jobs", jobs, "-o", f"by{jobs}", cwd=folder)
    for jobs in (2, 5):
        expect_same(rows(folder / "by1.h5"), rows(folder / f"by{jobs}.h5"))


def test_failed_runs_are_rows(tiltpad, case):
    """With status and reason; the console has the first hundred."""
    folder = case(
        "&case task='equilibrium' /\n&sweep rotor%static_load(2)=0:1e5:1e5 rotor%mass=1001:1102:1 /\n"
    )
    done = tiltpad("case.nml", cwd=folder)
    assert done.returncode == 2
    *told, total = done.stderr.splitlines()
    assert total == "tiltpad: error: 102 of 204 runs failed"
    assert len(told) == 100
    assert told[0].startswith("tiltpad: error: run 103 (rotor%static_load(2) = 100000, rotor%mass = 1001): ")
    with h5py.File(folder / "case.h5") as file:
        assert list(file["status"]) == 102 * [0] + 102 * [2]
        reasons = file["reason"].asstr()[:]
        assert not any(reasons[:102])
        assert all(line.endswith(f": {reasons[102 + k]}") for k, line in enumerate(told))
        assert (np.isnan(file["equilibrium_journal_y"][:]) == (file["status"][:] == 2)).all()
        assert (file.attrs["finished"], file.attrs["missing"]) == (1, "")
    # they stay
    again = tiltpad("case.nml", cwd=folder)
    assert (again.returncode, again.stderr.splitlines()[-1]) == (2, total)


def test_another_study_is_refused(tiltpad, case):
    folder = case(QUICK.format(last=1003))
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    before = (folder / "case.h5").read_bytes()
    for change, reason in (
        ("rotor%gravity=9", "is the study of another case, or of files that have changed since"),
        ("sweep%rotor%mass=1001,1002,1004", "is of another study: its runs have other values"),
        ("sweep%rotor%mass=1001,1002", "is of a study with 3 runs; this one has 2"),
    ):
        done = tiltpad("case.nml", "-q", "--set", change, cwd=folder, status=3)
        assert f"case.h5: {reason}; --overwrite replaces it, and --output names another place" in done.stderr
        assert (folder / "case.h5").read_bytes() == before
    with h5py.File(folder / "case.h5", "r+") as file:
        del file.attrs["study_marks"]
    done = tiltpad("case.nml", "-q", cwd=folder, status=3)
    assert "case.h5: is a study that tiltpad-collect wrote; --overwrite replaces it" in done.stderr
    tiltpad("case.nml", "-q", "--set", "rotor%gravity=9", "--overwrite", cwd=folder, status=0)
    assert (folder / "case.h5").read_bytes() != before


def test_what_is_no_study_is_not_replaced(tiltpad, case):
    """Not with --overwrite either where it is no result; --resume names the way that a study goes on."""
    folder = case(QUICK.format(last=1003))
    (folder / "case.h5").write_bytes(b"precious")
    for options in ((), ("--overwrite",)):
        done = tiltpad("case.nml", "-q", *options, cwd=folder, status=3)
        assert done.stderr.endswith(
            "case.h5: not a result file (HDF5); tiltpad CASE.nml runs a case; it is not replaced\n"
        )
        assert (folder / "case.h5").read_bytes() == b"precious"
    assert sorted(os.listdir(folder)) == ["case.h5", "case.nml"]
    (folder / "case.h5").unlink()
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    done = tiltpad("--resume", "case.h5", cwd=folder, status=3)
    assert done.stderr == "tiltpad: error: case.h5: a study, which goes on when its case is run again\n"
    (folder / "other.nml").write_text("&case task='equilibrium' /\n")
    done = tiltpad("other.nml", "-q", "-o", "case.h5", cwd=folder, status=3)
    assert done.stderr.count("\n") == 1


def test_a_study_that_was_collected(tiltpad, case):
    """Where runs have files it is made anew of these, and no run is performed again."""
    folder = case(QUICK.format(last=1003))
    keep = ("--set", "output%keep=all")
    tiltpad("case.nml", "-q", *keep, cwd=folder, status=0)
    files = {path: path.stat().st_mtime_ns for path in (folder / "case").iterdir()}
    with h5py.File(folder / "case.h5", "r+") as file:
        del file.attrs["study_marks"]
    tiltpad("case.nml", "-q", *keep, cwd=folder, status=0)
    assert {path: path.stat().st_mtime_ns for path in (folder / "case").iterdir()} == files
    with h5py.File(folder / "case.h5") as file:
        assert "study_marks" in file.attrs
        assert list(file["status"]) == [0, 0, 0]


def test_a_study_grows(tiltpad, case):
    folder = case(QUICK.format(last=1006))
    tiltpad("case.nml", "-q", "-o", "whole", cwd=folder, status=0)
    tiltpad("case.nml", "-q", "--set", "sweep%rotor%mass=1001:1003:1", cwd=folder, status=0)
    with h5py.File(folder / "case.h5") as file:
        first = file["wall_seconds"][:]
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    expect_same(rows(folder / "whole.h5"), rows(folder / "case.h5"))
    with h5py.File(folder / "case.h5") as file:
        # the first ones were not run again
        np.testing.assert_array_equal(file["wall_seconds"][:3], first)


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_killed_again_and_again(tiltpad, start, case, loaded, number):
    """No row of a checkpoint is lost or run again, and the rest is that of a study that was not killed."""
    folder = case(QUICK.format(last=1300))
    tiltpad("case.nml", "-q", "-o", "whole", cwd=folder, status=0)
    done = {}
    for attempt in range(100):
        process = start(folder, "-q", "--jobs", "2", "case.nml", env=loaded(FAST_CLOCK))
        # the last ones are left alone
        while process.poll() is None and (attempt > 6 or known(folder / "case.h5") <= len(done)):
            time.sleep(0.01)
        assert len([name for name in os.listdir(folder) if name.startswith("case.h5")]) <= 4
        process.send_signal(number)
        process.communicate(timeout=TIMEOUT)
        with h5py.File(folder / "case.h5") as file:
            there = np.flatnonzero(file["status"][:] == 0)
            times = dict(zip(there, file["wall_seconds"][:][there], strict=True))
        # a run that is run again has another time
        assert all(times.get(k) == seconds for k, seconds in done.items())
        done = times
        if process.returncode == 0:
            break
    assert len(done) == 300
    assert attempt >= 3
    assert sorted(os.listdir(folder)) == ["case.h5", "case.nml", "whole.h5"]
    expect_same(rows(folder / "whole.h5"), rows(folder / "case.h5"))


def known(path):
    """Rows of a study that is written; 0 before there is one, and while its name changes hands."""
    try:
        return int((status(path) == 0).sum())
    except OSError:
        return 0


def test_a_signal_stops_runs_without_files(start, case):
    folder = case(ENDLESS)
    process = start(folder, "--jobs", "2", "-q", "case.nml")
    wait_for(lambda: (folder / "case.h5.rows").exists(), process)
    process.terminate()
    assert "of 3 runs 0 done, 0 failed" in one_error(process, 4)
    assert sorted(os.listdir(folder)) == ["case.h5", "case.nml"]
    assert list(status(folder / "case.h5")) == [-2, -2, -2]
    with h5py.File(folder / "case.h5") as file:
        assert (file.attrs["finished"], file.attrs["missing"]) == (0, "1-3")


def test_a_full_disk(tiltpad, start, case, loaded):
    """One line; the last checkpoint stays, and the study goes on from it."""
    folder = case(QUICK.format(last=1500))
    tiltpad("case.nml", "-q", "-o", "whole", cwd=folder, status=0)
    size = (folder / "whole.h5").stat().st_size
    limit = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size // 2, size // 2))}
    process = start(folder, "-q", "case.nml", env=loaded(FAST_CLOCK), **limit)
    assert "case.h5" in one_error(process, 3)
    assert sorted(name for name in os.listdir(folder) if name.startswith("case.h5"))[-1] == "case.h5.rows"
    with package.read_study(folder / "case.h5") as study:
        assert 0 < study.done.sum() < 500
        there = dict(zip(study.run[study.done], study.wall_seconds[study.done], strict=True))
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    with package.read_study(folder / "case.h5") as study:
        assert all(study.wall_seconds[int(k) - 1] == seconds for k, seconds in there.items())
    expect_same(rows(folder / "whole.h5"), rows(folder / "case.h5"))


def test_a_small_disk(tiltpad, program, case):
    """However much room there is: one line, no row of a checkpoint is lost, and with more room it goes on."""
    folder = case(QUICK.format(last=1300))
    tiltpad("case.nml", "-q", "-o", "whole", cwd=folder, status=0)
    checkpoints = 0
    for part in (0.3, 0.9, 1.5):
        done = in_a_mount_namespace(
            """
            mkdir -p disk; mount -t tmpfs -o size=${SIZE}k tmpfs disk; cd disk
            status=0; $PROGRAM -q ../case.nml || status=$?
            ls; test $status = 3
            rm -f ../full.h5; test ! -e case.h5 || cp case.h5 ../full.h5
            mount -o remount,size=100m .
            $PROGRAM -q ../case.nml
            cp case.h5 ../case.h5
            """,
            PROGRAM=program,
            SIZE=int(part * (folder / "whole.h5").stat().st_size / 1024),
            cwd=folder,
        )
        assert done.returncode == 0, done.stderr
        assert done.stderr.startswith("tiltpad: error: cannot write ")
        assert "o space left on device" in done.stderr
        assert done.stderr.count("\n") == 1
        assert done.stdout in ("", "case.h5.rows\n", "case.h5\ncase.h5.rows\n")
        expect_same(rows(folder / "whole.h5"), rows(folder / "case.h5"))
        if (folder / "full.h5").exists():
            with h5py.File(folder / "full.h5") as full, h5py.File(folder / "case.h5") as file:
                there = full["status"][:] == 0
                checkpoints += there.any()
                np.testing.assert_array_equal(full["wall_seconds"][:][there], file["wall_seconds"][:][there])
    assert checkpoints > 0


# ---- the log ----------------------------------------------------------------------------------------
def test_a_killed_study_is_read_whole(tiltpad, start, case, failing):
    """All rows that its log has, by Python, by --table, and by the study that goes on."""
    folder = case(QUICK.format(last=1200).replace("1e-9", "1000"))
    log = folder / "case.h5.rows"
    killed = {"env": failing("write", 100, "killall", folder=folder), "start_new_session": True}
    start(folder, "-q", "--jobs", "2", "case.nml", **killed).communicate(timeout=TIMEOUT)
    assert sorted(os.listdir(folder)) == ["case.h5.lock", "case.h5.rows", "case.nml"]
    with package.read_study(folder / "case.h5") as study:
        done = np.flatnonzero(study.done)
        seconds = study.wall_seconds[done]
    assert 10 < len(done) < 200
    tiltpad("--table", "case.h5.rows", "-o", "copy.h5", cwd=folder, status=0)
    np.testing.assert_array_equal(np.flatnonzero(status(folder / "copy.h5") == 0), done)
    log.write_bytes(log.read_bytes() + b"R   cut off")
    said = tiltpad("case.nml", cwd=folder, status=0).stdout
    assert "case.h5.rows: the last 11 bytes were no whole row; its run is performed again" in said
    assert sorted(os.listdir(folder)) == ["case.h5", "case.nml", "copy.h5"]
    with package.read_study(folder / "case.h5") as study:
        assert study.done.all()
        np.testing.assert_array_equal(study.wall_seconds[done], seconds)


def test_what_is_no_log(tiltpad, case):
    """One line, and nothing is made or replaced."""
    folder = case(QUICK.format(last=1003))
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    (folder / "empty.h5.rows").write_bytes(b"")
    (folder / "text.h5.rows").write_bytes(b"a text")
    (folder / "begun.h5.rows").write_bytes(b"tiltpad log 1\n" + bytes(1000))
    before = sorted(os.listdir(folder))
    for words, why in (
        (("none.h5.rows",), "cannot read none.h5.rows: no such file"),
        (("empty.h5.rows",), "empty.h5.rows: damaged: it does not say of which study it is"),
        (("text.h5.rows",), "text.h5.rows: is no log of a study"),
        (("begun.h5.rows",), "begun.h5.rows: damaged: it does not say of which study it is"),
        (("case.h5", "-o", "a.h5"), "case.h5: is no log of a study"),
        (("case.h5",), "the log of a study is called NAME.h5.rows; of another name, --output must say"),
    ):
        done = tiltpad("--table", *words, cwd=folder, status=3)
        assert done.stderr.startswith("tiltpad: error: ")
        assert why in done.stderr
        assert done.stderr.count("\n") == 1
    assert sorted(os.listdir(folder)) == before
    # what is in the way of a log is not replaced
    for name in ("text", "begun"):
        (folder / f"{name}.h5.rows").rename(folder / "case.h5.rows")
        for words in ((), ("--overwrite",)):
            done = tiltpad("case.nml", "-q", *words, cwd=folder, status=3)
            assert "case.h5.rows: " in done.stderr
            assert done.stderr.endswith("; it is not replaced\n")
        (folder / "case.h5.rows").unlink()


# ---- what is kept of single runs ---------------------------------------------------------------------
MARCH = (
    "&operation duration=0.4 / &rotor unbalance=0.02 / "
    "&output keep='{keep}', spectrum_revolutions=50, samples_per_revolution=60 /\n"
)


@pytest.mark.parametrize("keep", ["last_revolutions", "summary"])
def test_a_stopped_run_goes_on_with_the_samples_of_before(tiltpad, start, case, keep):
    """The series are those that a run keeps that keeps all; figures follow from them."""
    folder = case(MARCH.format(keep=keep))
    every = ("--set", "output%checkpoint_seconds=1e-9")
    process = start(folder, "-q", "case.nml", *every)
    wait_for_checkpoint(folder / "case.h5", process)
    wait_for_checkpoint(folder / "case.h5", process)
    process.terminate()
    process.communicate(timeout=TIMEOUT)
    assert process.returncode == 4
    with h5py.File(folder / "case.h5") as file:
        assert file["checkpoint/time"][()] > 0
        assert "journal_y" not in file
    tiltpad("--resume", "case.h5", "-q", cwd=folder, status=0)
    tiltpad("case.nml", "-q", "-o", "whole.h5", cwd=folder, status=0)
    found, whole = arrays(folder / "case.h5", "statistics"), arrays(folder / "whole.h5", "statistics")
    assert found.keys() == whole.keys()
    assert ("journal_y" in found) == (keep == "last_revolutions")
    # what the march leaves of its error where it starts anew
    for name in found:
        if name.startswith(("journal", "pad_tilt", "time", "shaft", "by_revolution")):
            scale = np.nanmax(abs(whole[name]))
            np.testing.assert_allclose(found[name], whole[name], atol=1e-3 * scale, err_msg=name)


@pytest.mark.parametrize("keep", ["last_revolutions", "summary"])
def test_figures_do_not_depend_on_what_is_kept(tiltpad, case, keep):
    folder = case(MARCH.format(keep="all").replace("0.4", "0.15"))
    tiltpad("case.nml", "-q", "-o", "all.h5", cwd=folder, status=0)
    tiltpad("case.nml", "-q", "-o", "some.h5", "--set", f"output%keep='{keep}'", cwd=folder, status=0)
    every, some = arrays(folder / "all.h5"), arrays(folder / "some.h5")
    for name, values in some.items():
        if "seconds" in name:
            continue
        whole = every[name]
        if whole.shape != values.shape:
            assert keep == "last_revolutions"
            whole = whole[-len(values) :]
        np.testing.assert_array_equal(whole, values, err_msg=name)
    gone = set(every) - set(some)
    assert (gone == set()) == (keep == "last_revolutions")
    assert all("/" not in name for name in gone)


def test_what_needs_all_samples_is_refused(tiltpad, case):
    folder = case("&operation duration=0.02 / &output keep='summary' /\n")
    done = tiltpad("case.nml", "--verify", 3, cwd=folder)
    assert done.returncode in (1, 3)
    assert done.stderr.count("\n") == 1
    assert "output%keep" in done.stderr
    done = tiltpad("case.nml", "--set", "case%task='branch'", cwd=folder)
    assert done.returncode == 1
    assert "output%keep" in done.stderr
    assert os.listdir(folder) == ["case.nml"]
