"""Studies in blocks (--block I/N): the same file as of the whole study, whatever ends where and how."""

import itertools
import os
import re
import signal
import subprocess

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import FAST_CLOCK, TIMEOUT, in_a_mount_namespace, one_error, rows, wait_for

QUICK = "&case task='equilibrium' / &output checkpoint_seconds=1e-9 /\n&sweep rotor%mass=1001:{last}:1 /\n"
#: Columns and labels that only some runs have, and runs that fail.
MIXED = """\
&operation duration=0.01 /
&output keep='summary', samples_per_revolution=60 /
&sweep
   operation%speed_rpm = 3000, 6000
   pads%motion = 'tilting_only', 'tilting_radial'
   friction%model = 'none', 'lugre'
   integration%max_steps = 20, 100000
/
"""
ANOTHER = "the study of another case, or of files that have changed since"
OTHERS = "; --overwrite replaces it, and --output names another place"


def expect_same(one, other):
    """All numbers and texts of two studies, and what they say of themselves."""
    first, second = rows(one), rows(other)
    assert first.keys() == second.keys()
    for name in first:
        np.testing.assert_array_equal(first[name], second[name], err_msg=name)
    with h5py.File(one) as first, h5py.File(other) as second:
        assert first.attrs.keys() == second.attrs.keys()
        for name in first.attrs:
            assert name == "created" or first.attrs[name] == second.attrs[name]


def whole(tiltpad, folder):
    """The file of the study that one program has performed."""
    tiltpad("case.nml", "-q", "-o", "whole", cwd=folder)
    return folder / "whole.h5"


def left(folder):
    """Files of the study and of its blocks."""
    return sorted(name for name in os.listdir(folder) if name.startswith("case") and name != "case.nml")


def times(path):
    """When a run is run again it has another time."""
    with h5py.File(path) as file:
        there = np.flatnonzero(file["status"][:] >= 0)
        return dict(zip(there, file["wall_seconds"][:][there], strict=True))


# ---- blocks that end well ----------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("text", "of"), [(QUICK.format(last=1040), 5), (MIXED, 3)], ids=["equilibria", "marches"]
)
def test_blocks_at_once_are_the_whole_study(tiltpad, start, case, text, of):
    """In any order; a block whose runs fail has their status, and the others have none."""
    folder = case(text)
    expected = whole(tiltpad, folder)
    started = [start(folder, "case.nml", "--block", f"{k}/{of}", "--jobs", "1") for k in range(1, of + 1)]
    failures = 0
    for process in started:
        _, errors = process.communicate(timeout=TIMEOUT)
        failed = re.fullmatch(r"(?s).*?([0-9]+) of [0-9]+ runs failed\n", errors)
        assert process.returncode == (2 if failed else 0), errors
        failures += int(failed[1]) if failed else 0
    assert left(folder) == ["case.h5"]
    expect_same(folder / "case.h5", expected)
    with h5py.File(expected) as file:
        assert failures == (file["status"][:] != 0).sum()


def counted(done):
    """How many runs a block says it has."""
    return int(re.search(r"^(\d+) runs: ", done.stdout, re.M)[1])


def test_sizes_and_names(tiltpad, case):
    folder = case(QUICK.format(last=1007))
    sizes = {3: (2, 2), 4: (1, 2), 10: (0, 1)}
    for of, allowed in sizes.items():
        found = []
        for k in range(1, of):
            done = tiltpad("case.nml", "--block", f"{k}/{of}", "-o", f"by{of}", cwd=folder, status=0)
            found.append(counted(done))
        last = tiltpad("case.nml", "--block", f"{of}/{of}", "-o", f"by{of}", cwd=folder, status=0)
        assert f"by{of}.h5: takes the rows of" in last.stdout
        found.append(counted(last))
        assert sum(found) == 7
        assert min(found) >= allowed[0]
        assert max(found) <= allowed[1] + (of == 3)
    tiltpad("case.nml", "--block", "7/12", cwd=folder, status=0)
    assert left(folder) == ["case.07of12.h5"]
    # it is read as a study while the others run
    with package.read_study(folder / "case.07of12.h5") as study:
        assert list(study["run"][study.done]) == [4]
        assert study.values("mass", study.done) == [1004]


def test_one_block_is_the_whole_study(tiltpad, case):
    folder = case(QUICK.format(last=1007))
    expected = whole(tiltpad, folder)
    tiltpad("case.nml", "--block", "1/1", cwd=folder, status=0)
    assert left(folder) == ["case.h5"]
    expect_same(folder / "case.h5", expected)


def test_nothing_is_run_twice(tiltpad, case):
    """Neither by a block that runs again before or after the joining, nor by the whole study."""
    folder = case(QUICK.format(last=1010))
    for k in (1, 2, 1):
        tiltpad("case.nml", "-q", "--block", f"{k}/3", cwd=folder, status=0)
    first = times(folder / "case.1of3.h5") | times(folder / "case.2of3.h5")
    tiltpad("case.nml", "-q", "--block", "3/3", cwd=folder, status=0)
    joined = times(folder / "case.h5")
    assert joined | first == joined
    before = (folder / "case.h5").read_bytes()
    for k in (1, 2, 3):
        done = tiltpad("case.nml", "--block", f"{k}/3", cwd=folder, status=0)
        assert re.match(r"[34] runs: [34] done, 0 failed; .* in case\.h5\n", done.stdout)
    assert (folder / "case.h5").read_bytes() == before
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    assert times(folder / "case.h5") == joined
    assert left(folder) == ["case.h5"]


def test_a_missing_block(tiltpad, case):
    """The study follows from its task, or from the whole study, which takes the others' rows."""
    folder = case(QUICK.format(last=1010))
    expected = whole(tiltpad, folder)
    for k in (1, 3, 4):
        done = tiltpad("case.nml", "--block", f"{k}/4", cwd=folder, status=0)
        assert done.stdout.splitlines()[-1] == "case.h5: follows when all 4 blocks are finished"
    assert left(folder) == ["case.1of4.h5", "case.3of4.h5", "case.4of4.h5"]
    there = times(folder / "case.1of4.h5") | times(folder / "case.3of4.h5") | times(folder / "case.4of4.h5")
    for name in left(folder):
        (folder / name.replace("case", "copy")).write_bytes((folder / name).read_bytes())
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    tiltpad("case.nml", "-q", "--block", "2/4", "-o", "copy", cwd=folder, status=0)
    for name in ("case.h5", "copy.h5"):
        expect_same(folder / name, expected)
        assert times(folder / name) | there == times(folder / name)
    assert sorted(os.listdir(folder)) == ["case.h5", "case.nml", "copy.h5", "whole.h5"]


def test_other_blocks_than_before(tiltpad, case):
    """Rows of any number of blocks are taken up."""
    folder = case(QUICK.format(last=1010))
    expected = whole(tiltpad, folder)
    tiltpad("case.nml", "-q", "--block", "2/3", cwd=folder, status=0)
    for k in (1, 2):
        tiltpad("case.nml", "-q", "--block", f"{k}/2", cwd=folder, status=0)
    assert left(folder) == ["case.h5"]
    expect_same(folder / "case.h5", expected)


def test_a_study_grows_by_blocks(tiltpad, case):
    """What has its row in the study is run by no block; a block goes on with what it has."""
    folder = case(QUICK.format(last=1010))
    expected = whole(tiltpad, folder)
    shorter = ("--set", "sweep%rotor%mass=1001:1004:1")
    tiltpad("case.nml", "-q", *shorter, cwd=folder, status=0)
    first = times(folder / "case.h5")
    for k in (1, 2):
        done = tiltpad("case.nml", "--block", f"{k}/2", cwd=folder, status=0)
        assert "5 runs: 5 done" in done.stdout
    assert times(folder / "case.h5") | first == times(folder / "case.h5")
    expect_same(folder / "case.h5", expected)
    tiltpad("case.nml", "-q", *shorter, "--block", "1/2", "-o", "other", cwd=folder, status=0)
    tiltpad("case.nml", "-q", "-o", "other", cwd=folder, status=0)
    expect_same(folder / "other.h5", expected)


def test_runs_with_files(tiltpad, start, case):
    """They are all in one folder; one that is gone is made again."""
    text = "&operation duration=0.01 / &output keep='all' /\n&sweep operation%speed_rpm=3000:8000:1000 /\n"
    folder = case(text)
    expected = whole(tiltpad, folder)
    started = [start(folder, "-q", "case.nml", "--block", f"{k}/3", "--jobs", "1") for k in (1, 2, 3)]
    for process in started:
        assert process.communicate(timeout=TIMEOUT) == ("", "")
    assert left(folder) == ["case", "case.h5"]
    assert sorted(os.listdir(folder / "case")) == [f"000{k}.h5" for k in range(1, 7)]
    one, other = rows(folder / "case.h5"), rows(expected)
    assert [name.decode() for name in one.pop("file")] == [f"case/000{k}.h5" for k in range(1, 7)]
    other.pop("file")
    for name in other:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)
    (folder / "case/0003.h5").unlink()
    tiltpad("case.nml", "-q", "--block", "1/3", cwd=folder, status=0)
    assert not (folder / "case/0003.h5").exists()
    tiltpad("case.nml", "-q", "--block", "2/3", cwd=folder, status=0)
    assert (folder / "case/0003.h5").exists()
    assert left(folder) == ["case", "case.h5"]


# ---- what is refused ---------------------------------------------------------------------------------
def test_bad_blocks(tiltpad, case):
    folder = case(QUICK.format(last=1010))
    for value in ("0/4", "5/4", "x", "1/0", "1/", "/4", "1/4/2", "", "-1/4", "1.0/4", "1/9999999999"):
        done = tiltpad("case.nml", "--block", value, cwd=folder, status=1)
        assert f"--block {value}: must be I/N" in done.stderr
    for others in (("--run", "1"), ("--check",), ("--count",)):
        done = tiltpad("case.nml", "--block", "1/4", *others, cwd=folder, status=1)
        assert "not with --run, --check or --count" in done.stderr
    tiltpad("--resume", "case.h5", "--block", "1/2", cwd=folder, status=1)
    tiltpad("case.nml", "--block", cwd=folder, status=1)
    (folder / "one.nml").write_text("&case task='equilibrium' /\n")
    done = tiltpad("one.nml", "--block", "1/1", cwd=folder, status=1)
    assert "no group &sweep" in done.stderr
    assert sorted(os.listdir(folder)) == ["case.nml", "one.nml"]


def test_blocks_of_another_study(tiltpad, case):
    """Refused before anything runs; the last block names what it cannot join."""
    folder = case(QUICK.format(last=1010))
    heavy = ("--set", "rotor%gravity=9")
    tiltpad("case.nml", "-q", *heavy, "--block", "2/3", cwd=folder, status=0)
    before = (folder / "case.2of3.h5").read_bytes()
    done = tiltpad("case.nml", "-q", "--block", "2/3", cwd=folder, status=3)
    assert f"case.2of3.h5: is {ANOTHER}{OTHERS}" in done.stderr
    done = tiltpad("case.nml", "-q", cwd=folder, status=3)
    assert f"case.2of3.h5: is {ANOTHER}{OTHERS}" in done.stderr
    tiltpad("case.nml", "-q", "--block", "3/3", cwd=folder, status=3)
    done = tiltpad("case.nml", "-q", "--block", "1/3", cwd=folder, status=3)
    assert f"case.2of3.h5: is {ANOTHER}; --block 2/3 --overwrite replaces it" in done.stderr
    assert (folder / "case.2of3.h5").read_bytes() == before
    assert left(folder) == ["case.1of3.h5", "case.2of3.h5", "case.3of3.h5"]
    tiltpad("case.nml", "-q", "--block", "2/3", "--overwrite", cwd=folder, status=0)
    assert left(folder) == ["case.h5"]
    done = tiltpad("case.nml", "-q", *heavy, "--block", "2/3", cwd=folder, status=3)
    assert f"case.h5: is {ANOTHER}{OTHERS}" in done.stderr


@pytest.mark.parametrize("damage", ["cut", "empty", "text"])
def test_what_is_no_block_is_not_replaced(tiltpad, case, damage):
    """Not with --overwrite either; one line says so, and once it is removed nothing of the others is lost."""
    folder = case(QUICK.format(last=1010))
    expected = whole(tiltpad, folder)
    path = folder / "case.2of3.h5"
    for k in (1, 2):
        tiltpad("case.nml", "-q", "--block", f"{k}/3", cwd=folder, status=0)
    there = path.read_bytes()
    found = {"cut": there[: len(there) // 2], "empty": b"", "text": b"a text"}[damage]
    path.write_bytes(found)
    for words in (("--block", "3/3"), ("--block", "2/3"), ()):
        for more in ((), ("--overwrite",)):
            done = tiltpad("case.nml", "-q", *words, *more, cwd=folder, status=3)
            assert "case.2of3.h5: not a result file" in done.stderr
            assert done.stderr.endswith("; it is not replaced\n")
            assert done.stderr.count("\n") == 1
    assert path.read_bytes() == found
    assert left(folder) == ["case.1of3.h5", "case.2of3.h5", "case.3of3.h5"]
    others = times(folder / "case.1of3.h5") | times(folder / "case.3of3.h5")
    path.unlink()
    tiltpad("case.nml", "-q", "--block", "2/3", cwd=folder, status=0)
    assert left(folder) == ["case.h5"]
    assert times(folder / "case.h5") | others == times(folder / "case.h5")
    expect_same(folder / "case.h5", expected)


def test_bytes_of_a_block_that_are_others(tiltpad, case):
    """One line, or a study that is as it must be but for what these bytes are."""
    folder = case(QUICK.format(last=1010))
    expected = whole(tiltpad, folder)
    for k in (1, 2):
        tiltpad("case.nml", "-q", "--block", f"{k}/3", cwd=folder, status=0)
    path = folder / "case.2of3.h5"
    there = path.read_bytes()
    refused = 0
    for place in range(0, len(there) - 8, len(there) // 12):
        path.write_bytes(
            there[:place] + bytes(byte ^ 255 for byte in there[place : place + 8]) + there[place + 8 :]
        )
        done = tiltpad("case.nml", "-q", "--overwrite", cwd=folder)
        assert done.stderr.count("\n") == (done.returncode != 0)
        assert done.returncode in (0, 3)
        if done.returncode == 0:
            assert left(folder) == ["case.h5"]
            with h5py.File(folder / "case.h5") as file, h5py.File(expected) as other:
                differ = [name for name in rows(expected) if (file[name][:] != other[name][:]).any()]
                assert len(differ) <= 1 or not np.isnan(other[differ[0]][:]).all()
            (folder / "case.h5").unlink()
            tiltpad("case.nml", "-q", "--block", "1/3", cwd=folder, status=0)
        else:
            refused += 1
            assert not (folder / "case.h5").exists()
    assert refused > 0


def test_a_collected_study_in_the_way(tiltpad, case):
    """Where runs have files it is made anew of these, by whoever joins; else one line says what it is."""
    quick = QUICK.format(last=1006)
    for name, keep in (("filed", "all"), ("rows", "summary")):
        (case(quick).parent / name).mkdir(exist_ok=True)
        folder = case(quick).parent / name
        (folder / "case.nml").write_text(quick.replace("&output", f"&output keep='{keep}',"))
        tiltpad("case.nml", "-q", cwd=folder, status=0)
        expected = times(folder / "case.h5")
        with h5py.File(folder / "case.h5", "r+") as file:
            del file.attrs["study_marks"]
        before = (folder / "case.h5").read_bytes()
        if keep == "all":
            for k in (2, 1):
                tiltpad("case.nml", "-q", "--block", f"{k}/2", cwd=folder, status=0)
            assert times(folder / "case.h5") == expected
            assert left(folder) == ["case", "case.h5"]
        else:
            done = tiltpad("case.nml", "-q", "--block", "1/2", cwd=folder, status=3)
            assert f"case.h5: is a study that tiltpad-collect wrote{OTHERS}" in done.stderr
            assert (folder / "case.h5").read_bytes() == before
            assert left(folder) == ["case.h5"]


def test_overwrite_of_an_old_study(tiltpad, case):
    """Given to all tasks of an array it replaces what is there, block by block and at the end."""
    folder = case(QUICK.format(last=1010))
    expected = whole(tiltpad, folder)
    heavy = ("--set", "rotor%gravity=9")
    for words in ((), ("--block", "2/3"), ("--block", "3/3"), ("--block", "1/2")):
        tiltpad("case.nml", "-q", *heavy, *words, "-o", "old", cwd=folder, status=0)
        for path in folder.glob("old*.h5"):
            path.rename(folder / path.name.replace("old", "case"))
    assert left(folder) == ["case.1of2.h5", "case.2of3.h5", "case.3of3.h5", "case.h5"]
    for k in (1, 2, 3):
        tiltpad("case.nml", "-q", "--overwrite", "--block", f"{k}/3", cwd=folder, status=0)
    assert left(folder) == ["case.h5"]
    expect_same(folder / "case.h5", expected)


# ---- blocks that are stopped -------------------------------------------------------------------------
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_block_that_is_stopped_goes_on(tiltpad, start, case, loaded, number):
    """No row of a checkpoint is lost or run again."""
    folder = case(QUICK.format(last=1200))
    expected = whole(tiltpad, folder)
    tiltpad("case.nml", "-q", "--block", "1/2", cwd=folder, status=0)
    path = folder / "case.2of2.h5"
    process = start(folder, "-q", "--jobs", "2", "case.nml", "--block", "2/2", env=loaded(FAST_CLOCK))
    wait_for(path.exists, process)
    process.send_signal(number)
    process.communicate(timeout=TIMEOUT)
    done = times(path)
    assert 0 < len(done) < 100
    # the whole study takes what there is, and so does the block
    for name in os.listdir(folder):
        if name.startswith("case.") and name.endswith(".h5"):
            (folder / name.replace("case", "copy")).write_bytes((folder / name).read_bytes())
    tiltpad("case.nml", "-q", "--block", "2/2", cwd=folder, status=0)
    tiltpad("case.nml", "-q", "-o", "copy", cwd=folder, status=0)
    for name in ("case.h5", "copy.h5"):
        assert times(folder / name) | done == times(folder / name)
        expect_same(folder / name, expected)
    assert left(folder) == ["case.h5"]


def test_a_block_that_is_written(tiltpad, start, case):
    """Two tasks of one block, or the whole study beside it: the second is refused."""
    folder = case(
        "&operation duration=10000 / &output keep='summary' /\n&sweep rotor%mass=2000,2100,2200 /\n"
    )
    process = start(folder, "-q", "case.nml", "--block", "1/3")
    wait_for(lambda: (folder / "case.1of3.h5.rows").exists(), process)
    done = tiltpad("case.nml", "-q", "--block", "1/3", cwd=folder, status=3)
    assert f"case.1of3.h5: process {process.pid} on" in done.stderr
    done = tiltpad("case.nml", "-q", cwd=folder, status=3)
    assert f"case.1of3.h5: process {process.pid} on" in done.stderr
    process.terminate()
    assert "of 1 runs 0 done" in one_error(process, 4)
    assert left(folder) == ["case.1of3.h5"]


@pytest.mark.parametrize(
    ("kind", "stride", "action"),
    [
        *[
            ("write", 41, "killall"),
            ("sync", 2, "killall"),
            ("rename", 1, "killall"),
            ("delete", 1, "killall"),
        ],
        *[("write", 37, "ENOSPC"), ("sync", 2, "EIO"), ("rename", 1, "EIO")],
    ],
)
def test_a_kill_or_failure_at_each_step(tiltpad, program, case, failing, kind, stride, action):
    """Of the last block: the next to run completes the study; no run is lost or run twice."""
    folder = case("&case task='equilibrium' /\n&sweep rotor%mass=1001:1004:1 /\n")
    expected = whole(tiltpad, folder)
    made = folder / "made"
    made.mkdir()
    tiltpad("case.nml", "-q", "--block", "1/2", "-o", "made/case", cwd=folder, status=0)
    before = {path.name: path.read_bytes() for path in made.iterdir()}
    there = times(made / "case.1of2.h5")
    killed = 0
    for step in itertools.count(1, stride):
        for path in made.iterdir():
            path.unlink()
        for name, content in before.items():
            (made / name).write_bytes(content)
        environment = failing(kind, step, action, folder=made)
        command = [program, "case.nml", "-q", "--block", "2/2", "--jobs", "1", "-o", str(made / "case")]
        own = {"cwd": folder, "env": environment, "start_new_session": True, "timeout": TIMEOUT}
        status = subprocess.run(command, **own, check=False).returncode
        if status == 0:
            break
        assert status == (-signal.SIGKILL if action == "killall" else 3)
        killed += 1
        # every row that was there is there; any block, or none, completes it
        kept = {}
        for path in made.glob("case*.h5"):
            kept |= times(path)
        assert kept | there == kept
        again = (("--block", "1/2"), ("--block", "2/2")) if killed % 2 else ((),)
        for words in again:
            tiltpad("case.nml", "-q", *words, "-o", "made/case", cwd=folder, status=0)
        found = times(made / "case.h5")
        assert found | kept == found
        expect_same(made / "case.h5", expected)
        assert [path.name for path in made.glob("*.h5")] == ["case.h5"]
    assert killed > 1


def test_two_blocks_that_end_at_once(tiltpad, start, case):
    """Many times: both end well, and the study is there once and whole."""
    folder = case("&case task='equilibrium' /\n&sweep rotor%mass=1001:1008:1 /\n")
    expected = whole(tiltpad, folder)
    for _ in range(3):
        started = [start(folder, "-q", "case.nml", "--block", f"{k}/4", "--jobs", "1") for k in (1, 2, 3, 4)]
        for process in started:
            assert process.communicate(timeout=TIMEOUT) == ("", "")
            assert process.returncode == 0
        assert left(folder) == ["case.h5"]
        expect_same(folder / "case.h5", expected)
        (folder / "case.h5").unlink()


def test_a_disk_that_is_full_while_blocks_are_joined(tiltpad, program, case):
    """One line; all rows stay in the files of the blocks, and with more room the study follows."""
    folder = case(QUICK.format(last=1200))
    expected = whole(tiltpad, folder)
    (folder / "made").mkdir()
    for k in (1, 2):
        tiltpad("case.nml", "-q", "--block", f"{k}/3", "-o", "made/case", cwd=folder, status=0)
    there = times(folder / "made/case.1of3.h5") | times(folder / "made/case.2of3.h5")
    taken = sum(path.stat().st_size for path in (folder / "made").iterdir()) // 1024
    full = 0
    for more in range(0, 10000, expected.stat().st_size // 2048):
        done = in_a_mount_namespace(
            """
            mkdir -p disk; mount -t tmpfs -o size=${SIZE}k tmpfs disk; cd disk; cp ../made/* .
            status=0; $PROGRAM -q ../case.nml -o case --block 3/3 || status=$?
            ls; test $status = 0 || test $status = 3
            mount -o remount,size=100m .
            $PROGRAM -q ../case.nml -o case $WORDS
            ls; cp case.h5 ../case.h5
            """,
            PROGRAM=program,
            SIZE=taken + 100 + more,
            WORDS="--block 3/3" if full % 2 else "",
            cwd=folder,
        )
        assert done.returncode == 0, done.stderr
        assert done.stdout.endswith("case.h5\n")
        assert times(folder / "case.h5") | there == times(folder / "case.h5")
        expect_same(folder / "case.h5", expected)
        if not done.stderr:
            break
        full += 1
        assert done.stderr.count("\n") == 1
        assert "o space left on device" in done.stderr
        assert "case.1of3.h5\ncase.2of3.h5\n" in done.stdout
    assert full > 2


def test_films_of_joined_blocks_are_verified_in_the_whole_study(tiltpad, case):
    """Its rows are in one file: no block gets one again, and where they are verified it has nothing to do."""
    folder = case(QUICK.format(last=1004))
    for k in 1, 2:
        tiltpad("case.nml", "-q", "--block", f"{k}/2", cwd=folder, status=0)
    before = (folder / "case.h5").read_bytes()
    refused = tiltpad("case.nml", "--block", "2/2", "--verify", "1", cwd=folder, status=1)
    says = "case.h5: has run 3 of this block already; --verify 1 without --block looks at its films\n"
    assert refused.stderr.endswith(says)
    assert (folder / "case.h5").read_bytes() == before
    assert left(folder) == ["case.h5"]
    tiltpad("case.nml", "-q", "--verify", "1", cwd=folder, status=0)
    before = (folder / "case.h5").read_bytes()
    tiltpad("case.nml", "-q", "--block", "2/2", "--verify", "1", cwd=folder, status=0)
    assert (folder / "case.h5").read_bytes() == before
    assert left(folder) == ["case.h5"]
