"""What a study has is kept: whatever fails while it is opened again, writes beside it, or changes."""

import os
import resource
import shlex
import shutil
import signal
import subprocess

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import ENDLESS, EVERY_STEP, one_error, wait_for, wait_for_checkpoint
from test_branch_stops import AT_A_REQUEST

SMALL = "&case task='equilibrium' /\n&sweep rotor%mass=1001:{last}:1 /\n"
#: Calls that fail when a study is opened again, with what.
FAULTS = [
    *[("open", "ESTALE"), ("open", "EMFILE"), ("read", "EIO"), ("stat", "ESTALE"), ("fork", "EAGAIN")],
    *[("write", "ENOSPC"), ("write", "EDQUOT"), ("rename", "EIO"), ("lock", "ENOLCK")],
]


def times(path):
    """Seconds of the runs that have rows: a run that is run again has others."""
    with package.read_study(path) as study:
        return dict(zip(study.run[study.done], study.wall_seconds[study.done], strict=True))


def steps():
    """The first calls, then fewer and fewer of them."""
    step = 0
    while True:
        step += 1 + step // 4
        yield step


@pytest.mark.parametrize(("kind", "action"), FAULTS)
def test_overwrite_after_a_fault_keeps_finished_rows(program, tiltpad, case, failing, kind, action):
    """A study of 8 runs that has grown by two; the fault is one of those that pass."""
    folder = case(SMALL.format(last=1008))
    made = folder / "made"
    made.mkdir()
    tiltpad("case.nml", "-q", "-o", "made/case", cwd=folder, status=0)
    before, done = (made / "case.h5").read_bytes(), times(made / "case.h5")
    case(SMALL.format(last=1010))
    failures = whole = 0
    for step in steps():
        shutil.rmtree(made)
        made.mkdir()
        (made / "case.h5").write_bytes(before)
        own = {"cwd": folder, "env": failing(kind, step, action, folder=made)}
        ended = tiltpad("case.nml", "-q", "--overwrite", "--jobs", "1", "-o", "made/case", **own)
        assert ended.returncode in (0, 3), ended.stderr
        assert (ended.stderr != "") == (ended.returncode == 3)
        assert "--overwrite replaces" not in ended.stderr
        found = times(made / "case.h5")
        assert {k: found.get(k) for k in done} == done, (step, ended.stderr)
        if ended.returncode == 0:
            assert len(found) == 10
            whole += 1
        failures += ended.returncode == 3
        # nothing is called so often
        if whole > 6 or step > 300:
            break
    assert failures > 0 or kind in ("rename", "lock")


def test_a_block_that_is_run_again_beside_the_whole_study(start, case):
    """Its file stays where it has rows that the whole study, which is stopped, has not taken."""
    # the second run does not end
    folder = case("&output keep='summary' /\n&sweep operation%duration=1e-3,10000,2e-3,3e-3,4e-3,5e-3 /\n")

    def until_there_are(rows, name, process):
        def there():
            try:
                return len(times(folder / name)) == rows
            except package.RunError:
                return False

        wait_for(there, process)

    def stopped(process):
        process.send_signal(signal.SIGTERM)
        one_error(process, 4)

    block = start(folder, "-q", "case.nml", "--block", "1/2", "--jobs", "1")
    until_there_are(1, "case.1of2.h5", block)
    stopped(block)
    whole = start(folder, "-q", "case.nml", "--jobs", "1")
    until_there_are(1, "case.h5", whole)
    again = start(folder, "-q", "case.nml", "--block", "1/2", "--jobs", "2")
    until_there_are(2, "case.1of2.h5", again)
    stopped(again)
    kept = times(folder / "case.1of2.h5")
    stopped(whole)
    assert times(folder / "case.1of2.h5") == kept
    assert set(kept) == {1, 3}
    assert set(times(folder / "case.h5")) == {1}


def test_states_are_verified_in_runs_that_have_rows(tiltpad, case):
    """With or without files of their own; what was verified is not verified again."""
    for keep in ("all", "summary"):
        text = f"&case task='equilibrium' /\n&output keep='{keep}' /\n&sweep rotor%mass=1001:1003:1 /\n"
        folder = case(text)
        tiltpad("case.nml", "-q", "-o", keep, cwd=folder, status=0)
        tiltpad("case.nml", "-q", "--verify", "1", "-o", keep, cwd=folder, status=0)
        with h5py.File(folder / f"{keep}.h5") as file:
            np.testing.assert_array_equal(file["verified_states"], 1)
        before = times(folder / f"{keep}.h5")
        tiltpad("case.nml", "-q", "--verify", "1", "-o", keep, cwd=folder, status=0)
        assert times(folder / f"{keep}.h5") == before


def test_a_start_that_has_changed(tiltpad, case):
    """A study is that of the files that its runs start from."""
    folder = case("&operation duration=1e-3 /\n")
    tiltpad("case.nml", "-q", "-o", "from.h5", cwd=folder, status=0)
    case(
        "&operation duration=1e-3 /\n&start from='file', file='from.h5' /\n&output keep='summary' /\n"
        "&sweep rotor%mass=2001,2002 /\n"
    )
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    (folder / "one.nml").write_text("&operation duration=2e-3 /\n")
    tiltpad("one.nml", "-q", "-o", "from.h5", "--overwrite", cwd=folder, status=0)
    done = tiltpad("case.nml", "-q", cwd=folder, status=3)
    assert "case.h5: is the study of another case, or of files that have changed since" in done.stderr


def test_very_many_starts(tiltpad, case, loaded):
    """Eight times as many names take no more than some eight times the work; a signal is obeyed meanwhile."""
    folder = case("&start from='file' /\n&sweep file='t.csv' /\n")

    def work(names, trial):
        (folder / "t.csv").write_text("start%file\n" + "".join(f"none/{k}.h5\n" for k in range(names)))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = tiltpad("case.nml", "-q", "--block", f"1/{names}", "-o", f"{names}_{trial}", cwd=folder)
        assert done.returncode == 3
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    def more(trial):
        few = work(2_500, trial)
        return work(20_000, trial) / few

    # on a busy machine one trial may be dearer; in quadratic time each was 33 times the work
    assert any(more(trial) < 14 for trial in range(3))
    environment = loaded(AT_A_REQUEST, SIGNAL=str(int(signal.SIGTERM)), REQUEST="100000")
    done = tiltpad("case.nml", "-q", "--block", "2/20000", cwd=folder, env=environment, status=4)
    assert done.stderr.endswith("; no run was started\n")


@pytest.mark.parametrize("kilobytes", [64, 256])
def test_a_small_stack(program, case, kilobytes):
    """No array whose size comes from the input is on it; with next to none nothing is begun."""
    folder = case(
        "&case task='coefficients' /\n&operation speed_rpm=6000 /\n&shaft length=99*0.03, diameter=99*0.2 /\n"
        "&bearing name='a', station=2 /\n&bearing name='b', station=99 /\n"
    )
    words = ["sh", "-c", f"ulimit -s {kilobytes}; exec {shlex.quote(program)} case.nml -q"]
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    enlarged = done.returncode == 0 and done.stderr == ""
    assert enlarged or kilobytes == 64
    assert enlarged or (done.returncode, done.stderr.count("\n")) == (3, 1)


def test_permissions_stay(tiltpad, start, case):
    """Of a result that is replaced, of one that grows, its part, and of a study and its rows."""
    folder = case("&operation duration=0.02 /\n")
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    (folder / "case.h5").chmod(0o600)
    process = start(
        folder, "case.nml", "-q", "--overwrite", "--set", "rotor%mass=2100", *ENDLESS, *EVERY_STEP
    )
    wait_for_checkpoint(folder / "case.h5", process)
    wait_for_checkpoint(folder / "case.h5", process)
    process.terminate()
    process.wait()
    modes = {path.name: path.stat().st_mode & 0o777 for path in folder.glob("case.h5*")}
    assert {name: mode for name, mode in modes.items() if mode != 0o600 and ".lock" not in name} == {}
    case(SMALL.format(last=1003))
    tiltpad("case.nml", "-q", "-o", "study", cwd=folder, status=0)
    (folder / "study.h5").chmod(0o640)
    case(SMALL.format(last=1004))
    tiltpad("case.nml", "-q", "-o", "study", cwd=folder, status=0)
    assert (folder / "study.h5").stat().st_mode & 0o777 == 0o640
    if os.geteuid() != 0:
        (folder / "study.h5").chmod(0o444)
        case(SMALL.format(last=1005))
        done = tiltpad("case.nml", "-q", "-o", "study", cwd=folder, status=3)
        assert "study.h5: permission denied" in done.stderr


def test_a_run_that_is_called_like_a_block(tiltpad, case):
    """It is told of, and with --overwrite left alone."""
    folder = case("&case task='equilibrium' /\n")
    tiltpad("case.nml", "-q", "-o", "case.3of4.h5", cwd=folder, status=0)
    before = (folder / "case.3of4.h5").read_bytes()
    case(SMALL.format(last=1003))
    done = tiltpad("case.nml", "-q", cwd=folder, status=3)
    assert "case.3of4.h5: is the result of one run, and not a study" in done.stderr
    tiltpad("case.nml", "-q", "--overwrite", cwd=folder, status=0)
    assert len(times(folder / "case.h5")) == 3
    assert (folder / "case.3of4.h5").read_bytes() == before


def change(path, how):
    """Another program changes a file: h5py, in place."""
    with h5py.File(path, "r+") as file:
        how(file)


@pytest.mark.parametrize(
    "how",
    [
        lambda file: file["equilibrium_journal_y"].attrs.modify("units", "mm"),
        lambda file: file.move("equilibrium_journal_y", "mine"),
        lambda file: file["pad"].write_direct(np.array([2.0, 1.0])),
    ],
    ids=["unit", "name", "label"],
)
def test_a_block_whose_columns_were_changed(tiltpad, case, how):
    """Its values would stand under the names and units of the others; with --overwrite, too."""
    folder = case(SMALL.format(last=1004))
    tiltpad("case.nml", "-q", "--block", "1/2", cwd=folder, status=0)
    change(folder / "case.1of2.h5", how)
    for arguments in (["--block", "2/2"], [], ["--overwrite"], ["--block", "1/2"]):
        refused = tiltpad("case.nml", "-q", *arguments, cwd=folder, status=3)
        assert "case.1of2.h5: its columns have other names, units or labels than the" in refused.stderr
    (folder / "case.1of2.h5").unlink()
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    change(folder / "case.h5", how)
    refused = tiltpad("case.nml", "-q", cwd=folder, status=3)
    assert refused.stderr.endswith("something else has changed them; it is not replaced\n")


def test_the_builds_of_all_rows_are_told(tiltpad, case):
    """Of joined blocks, of a study that has grown, and of one that was collected."""
    own = "{} {}".format(*tiltpad("--version").stdout.split()[1:])

    def made_by(path, other="0.0.9 (0ldc0de)"):
        change(path, lambda file: file.attrs.modify("version", other))

    def builds(path):
        with h5py.File(path) as file:
            return file.attrs["version"]

    folder = case(SMALL.format(last=1004))
    for k in 1, 2, 3:
        tiltpad("case.nml", "-q", "--block", f"{k}/3", cwd=folder, status=0)
        if k < 3:
            assert builds(folder / f"case.{k}of3.h5") == own
            made_by(folder / f"case.{k}of3.h5")
    assert builds(folder / "case.h5") == f"0.0.9 (0ldc0de), {own}"
    made_by(folder / "case.h5")
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    assert builds(folder / "case.h5") == "0.0.9 (0ldc0de)"
    case(SMALL.format(last=1005))
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    assert builds(folder / "case.h5") == f"0.0.9 (0ldc0de), {own}"
    for k in 1, 2:
        tiltpad("case.nml", "-q", "--run", k, "-o", "runs", cwd=folder, status=0)
    change(folder / "runs/0002.h5", lambda file: file.attrs.modify("commit", "0ldc0de"))
    package.collect(folder / "runs", folder / "of_runs.h5")
    assert builds(folder / "of_runs.h5") == f"{own}, {own.split()[0]} (0ldc0de)"
