"""What the system may do: no processes, a quota, clocks that jump, long stops, calls that fail.

A small library, compiled here and loaded before the system's own, stands for each of them.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile

import h5py
import numpy as np
import pytest
from conftest import (
    ENDLESS,
    EVERY_STEP,
    TIMEOUT,
    arrays,
    one_error,
    rows,
    shorten,
    wait_for,
    wait_for_checkpoint,
)

CASE = "&friction model='lugre' / &operation duration=0.3 / &output checkpoint_seconds=0.01 /\n"
#: The calendar jumps by years at every look, there and back.
JUMPING_CLOCK = """
static long jump(void) { static long k; return (++k % 3 - 1) * 100000000; }
int clock_gettime(clockid_t clock, struct timespec *now)
{
   int result = NEXT(clock_gettime)(clock, now);
   if (clock == CLOCK_REALTIME) now->tv_sec += jump();
   return result;
}
int gettimeofday(struct timeval *restrict now, void *restrict zone)
{
   int result = NEXT(gettimeofday)(now, zone);
   now->tv_sec += jump();
   return result;
}
time_t time(time_t *now)
{
   time_t result = NEXT(time)(NULL) + jump();
   if (now) *now = result;
   return result;
}
"""
#: No more than QUOTA bytes are written, in all.
QUOTA = """
static size_t written;
static int beyond(size_t size)
{
   if ((written += size) <= strtoul(getenv("QUOTA"), NULL, 10)) return 0;
   errno = EDQUOT;
   return 1;
}
ssize_t write(int file, const void *bytes, size_t size)
{
   return file > 2 && beyond(size) ? -1 : NEXT(write)(file, bytes, size);
}
ssize_t pwrite(int file, const void *bytes, size_t size, off_t place)
{
   return beyond(size) ? -1 : NEXT(pwrite)(file, bytes, size, place);
}
ssize_t pwrite64(int file, const void *bytes, size_t size, off64_t place)
{
   return beyond(size) ? -1 : NEXT(pwrite64)(file, bytes, size, place);
}
"""
#: Another machine with the same files and without locks, on which seconds are short.
ELSEWHERE = """
int lockf(int file, int task, off_t size) { errno = ENOLCK; return -1; }
int lockf64(int file, int task, off64_t size) { errno = ENOLCK; return -1; }
int gethostname(char *name, size_t size) { strncpy(name, getenv("HOST"), size); return 0; }
unsigned sleep(unsigned seconds) { usleep(1000 * seconds); return 0; }
"""

#: A machine with this name.
NAMED = """
int gethostname(char *name, size_t size) { strncpy(name, getenv("HOST"), size); return 0; }
"""
#: A file system that knows no times of birth.
NO_BIRTHS = """
#include <fcntl.h>
#include <sys/stat.h>
int statx(int folder, const char *restrict path, int flags, unsigned mask, struct statx *restrict found)
{
   int result = NEXT(statx)(folder, path, flags, mask, found);
   found->stx_mask &= ~STATX_BTIME;
   found->stx_btime.tv_sec = random();
   return result;
}
"""
#: Notes in the file LOG which files are opened for writing (w) and reading (r), which are deleted (d), which
#: folders are made (m), and connections and programs (x).
NOTES = """
#include <fcntl.h>
#include <stdarg.h>
#include <spawn.h>
#include <stdio.h>
#include <sys/socket.h>
static void note(char what, const char *name)
{
   char line[5000];
   int log = NEXT(open)(getenv("LOG"), O_WRONLY | O_APPEND | O_CREAT, 0666);
   int length = snprintf(line, sizeof line, "%c %s\\n", what, name);
   NEXT(write)(log, line, length);
   close(log);
}
#define OPEN(name) \\
int name(const char *path, int flags, ...) \\
{ \\
   va_list list; \\
   va_start(list, flags); \\
   note((flags & O_ACCMODE) == O_RDONLY ? 'r' : 'w', path); \\
   return NEXT(name)(path, flags, va_arg(list, mode_t)); \\
}
OPEN(open) OPEN(open64)
#define OPENAT(name) \\
int name(int folder, const char *path, int flags, ...) \\
{ \\
   va_list list; \\
   va_start(list, flags); \\
   note((flags & O_ACCMODE) == O_RDONLY ? 'r' : 'w', path); \\
   return NEXT(name)(folder, path, flags, va_arg(list, mode_t)); \\
}
OPENAT(openat) OPENAT(openat64)
#define FOPEN(name) FILE *name(const char *path, const char *mode) \\
{ note(*mode == 'r' ? 'r' : 'w', path); return NEXT(name)(path, mode); }
FOPEN(fopen) FOPEN(fopen64)
int unlink(const char *path) { note('d', path); return NEXT(unlink)(path); }
int remove(const char *path) { note('d', path); return NEXT(remove)(path); }
int rmdir(const char *path) { note('d', path); return NEXT(rmdir)(path); }
int mkdir(const char *path, mode_t mode) { note('m', path); return NEXT(mkdir)(path, mode); }
int socket(int a, int b, int c) { note('x', "socket"); return -1; }
int connect(int a, const struct sockaddr *b, socklen_t c) { note('x', "connect"); return -1; }
int system(const char *command) { note('x', command); return -1; }
FILE *popen(const char *command, const char *mode) { note('x', command); return NULL; }
int execv(const char *path, char *const a[]) { note('x', path); return NEXT(execv)(path, a); }
int execve(const char *path, char *const a[], char *const b[])
{ note('x', path); return NEXT(execve)(path, a, b); }
int execvp(const char *path, char *const a[]) { note('x', path); return NEXT(execvp)(path, a); }
#define SPAWN(name) \\
int name(pid_t *process, const char *path, const posix_spawn_file_actions_t *a, const posix_spawnattr_t *b, \\
         char *const c[], char *const d[]) \\
{ note('x', path); return NEXT(name)(process, path, a, b, c, d); }
SPAWN(posix_spawn) SPAWN(posix_spawnp)
"""


@pytest.fixture
def case(tmp_path):
    folder = tmp_path / "case"
    folder.mkdir()
    (folder / "case.nml").write_text(CASE)
    return folder


def refused(done, *words):
    assert done.returncode == 3, done.stderr
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("tiltpad: error: ")
    assert all(word in done.stderr for word in words), done.stderr


def names(folder):
    return sorted(path.name for path in folder.iterdir())


# ---- processes ---------------------------------------------------------------------------------


def test_no_process_for_a_trial(tiltpad, case, failing):
    """A file that nobody has tried is not read."""
    tiltpad("case.nml", "-q", cwd=case, status=0)
    before = (case / "case.h5").read_bytes()
    for arguments in (
        ["--resume", "case.h5"],
        ["--resume", "case.h5", "--check"],
        ["case.nml", "--overwrite"],
    ):
        done = tiltpad(*arguments, cwd=case, env=failing("fork", 1, "EAGAIN", always=True))
        refused(
            done, "case.h5: not looked at, as no process could be started for it: resource temporarily unav"
        )
    assert (case / "case.h5").read_bytes() == before
    assert names(case) == ["case.h5", "case.nml"]


def test_a_caller_that_ignores_its_children(tiltpad, case):
    """The program inherits that, and waits for its own nevertheless."""
    ignore = {"preexec_fn": lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN)}
    tiltpad("case.nml", "-q", cwd=case, **ignore, status=0)
    tiltpad("--resume", "case.h5", cwd=case, **ignore, status=0)


# ---- clocks ------------------------------------------------------------------------------------


def test_clocks_that_jump(start, tiltpad, case, loaded):
    """Neither results nor checkpoints nor the lock depend on the calendar."""
    environment = loaded(JUMPING_CLOCK)
    tiltpad("case.nml", "-q", "-o", "still.h5", cwd=case, status=0)
    run = start(case, "-q", "case.nml", env=environment)
    assert run.wait(TIMEOUT) == 0, run.stderr.read()
    jumped, still = (arrays(case / f"{name}.h5", "statistics") for name in ("case", "still"))
    assert jumped.keys() == still.keys()
    assert all(np.array_equal(jumped[name], still[name], equal_nan=True) for name in still)
    with h5py.File(case / "case.h5") as file, h5py.File(case / "still.h5") as other:
        years = {re.match(r"\d{4}", file.attrs[name])[0] for name in ("created", "ended")}
        assert years != {other.attrs["created"][:4]}
        assert 0 < file["statistics/wall_seconds"][()] < 1e6
        assert 0 <= file["statistics/checkpoint_seconds"][()] < 1e6
    # studies, whole and in blocks
    (case / "study.nml").write_text(
        "&case task='equilibrium' /\n&output checkpoint_seconds=1e-9 /\n&sweep rotor%mass=1001:1009:1 /\n"
    )
    tiltpad("study.nml", "-q", "-o", "of", cwd=case, status=0)
    for arguments in ([], ["--block", "1/2"], ["--block", "2/2"]):
        output = "blocks" if arguments else "whole"
        tiltpad("study.nml", "-q", "-o", output, *arguments, cwd=case, env=environment, status=0)
    for output in "whole", "blocks":
        found, expected = rows(case / f"{output}.h5"), rows(case / "of.h5")
        assert all(np.array_equal(found[name], each) for name, each in expected.items())
        # in the future, as after a clock that was wrong
        os.utime(case / f"{output}.h5", (4e9, 4e9))
        tiltpad("study.nml", "-q", "-o", output, cwd=case, status=0)
        (case / f"{output}.h5").unlink()
    for name in "of.h5", "study.nml":
        (case / name).unlink()
    # checkpoints, stopping, rivals, going on
    (case / "case.h5").unlink()
    run = start(case, "-q", "case.nml", *ENDLESS, env=environment)
    wait_for_checkpoint(case / "case.h5", run)
    wait_for_checkpoint(case / "case.h5", run)
    refused(tiltpad("--resume", "case.h5", cwd=case, env=environment), f"process {run.pid}")
    run.terminate()
    one_error(run, 4)
    shorten(case / "case.h5")
    tiltpad("--resume", "case.h5", "-q", cwd=case, env=environment, status=0)
    assert names(case) == ["case.h5", "case.nml", "still.h5"]


# ---- quotas ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kilobytes", [0, 0.1, 400, 4000])
def test_a_quota(tiltpad, case, loaded, kilobytes):
    """Whatever is written when it is reached, the last checkpoint stays, and the run goes on from it."""
    environment = loaded(QUOTA, QUOTA=str(int(1000 * kilobytes)))
    done = tiltpad("case.nml", "-q", *ENDLESS, *EVERY_STEP, cwd=case, env=environment)
    refused(done, "cannot write", "case.h5")
    # HDF5 1.14 writes in opening, and does not keep the reason for which that fails
    assert done.stderr.endswith((": disk quota exceeded\n", "could not open the file\n")), done.stderr
    whole_and_going_on(tiltpad, case, (case / "case.h5").exists())
    assert (case / "case.h5").exists() or kilobytes < 4000


@pytest.mark.parametrize("syncs", [1, 2, 3, 6])
def test_a_quota_that_is_told_late(tiltpad, case, failing, syncs):
    """By the disk, as network file systems do."""
    environment = failing("sync", syncs, "EDQUOT", always=True)
    done = tiltpad("case.nml", "-q", *ENDLESS, cwd=case, env=environment)
    refused(done, "cannot write", "case.h5", "disk quota exceeded")
    whole_and_going_on(tiltpad, case, there=syncs > 1)


def whole_and_going_on(tiltpad, case, there):
    """Nothing is beside the result, if there is one, and that is a checkpoint."""
    assert names(case) == ["case.h5", "case.nml"][1 - there :]
    if not there:
        return
    shorten(case / "case.h5")
    with h5py.File(case / "case.h5") as file:
        samples = len(file["time"])
    tiltpad("--resume", "case.h5", "-q", cwd=case, status=0)
    with h5py.File(case / "case.h5") as file:
        assert file.attrs["complete"] == 1
        assert len(file["time"]) > samples


COEFFICIENTS = "&case task='coefficients' /\n"
BRANCH = (
    "&case task='branch' / &output checkpoint_seconds=1e-9 /\n"
    "&branch of='equilibrium', parameter='rotor%mass', last=2100, step=100, max_step=100 /\n"
)


@pytest.mark.parametrize("text", [COEFFICIENTS, BRANCH], ids=["coefficients", "branch"])
def test_one_refused_write(tiltpad, tmp_path, failing, text):
    """Whichever it is, it is told, or nothing is missing in the result: what HDF5 writes late, too."""
    (tmp_path / "case.nml").write_text(text)
    path = tmp_path / "case.h5"
    tiltpad("case.nml", "-q", "-o", "whole.h5", cwd=tmp_path, status=0)
    whole = arrays(tmp_path / "whole.h5", "statistics")
    told = missed = write = 0
    # the lock is noted without one write or another: three in a row behind the last are not reached
    while missed < 3:
        write += 1
        done = tiltpad("case.nml", "-q", cwd=tmp_path, env=failing("write", write, "ENOSPC"))
        if done.returncode != 0:
            refused(done, "tiltpad: error: cannot write")
            # a newer HDF5 may tell of a head that was not written only when it opens the file again
            assert "no space left on device" in done.stderr or "could not open" in done.stderr, done.stderr
            told += 1
        missed = 0 if done.returncode != 0 else missed + 1
        if done.returncode != 0 and path.exists():
            tiltpad("--resume", "case.h5", "-q", cwd=tmp_path, status=0)
        if path.exists():
            found = arrays(path, "statistics")
            assert found.keys() == whole.keys()
            for name, values in found.items():
                np.testing.assert_array_equal(values, whole[name], err_msg=f"{name}, write {write}")
            path.unlink()
        assert not list(tmp_path.glob("*.part*"))
    assert told > 50


# ---- stops -------------------------------------------------------------------------------------


def test_a_stopped_writer_on_this_machine(start, tiltpad, case):
    """It keeps its lock, however long it stands still."""
    run = start(case, "-q", "case.nml", *ENDLESS)
    wait_for_checkpoint(case / "case.h5", run)
    run.send_signal(signal.SIGSTOP)
    before = (case / "case.h5").read_bytes()
    for arguments in (["--resume", "case.h5"], ["case.nml", "--overwrite"]):
        refused(tiltpad(*arguments, cwd=case), f"process {run.pid} on {os.uname().nodename} is writing it")
    assert (case / "case.h5").read_bytes() == before
    run.send_signal(signal.SIGCONT)
    run.terminate()
    one_error(run, 4)
    assert names(case) == ["case.h5", "case.nml"]


@pytest.mark.parametrize("when", ["while the other writes", "when the other is done"])
def test_a_stopped_writer_elsewhere(start, case, loaded, when):
    """Where locks are not known, a rival takes over from a writer that stands still, which then gives up."""
    shared = "case.h5", "case.nml", "--set", f"operation%duration={'10000' if 'writes' in when else '2'}"
    first = start(case, "-q", "--resume", *shared, *EVERY_STEP, env=loaded(ELSEWHERE, HOST="one"))
    wait_for_checkpoint(case / "case.h5", first)
    first.send_signal(signal.SIGSTOP)
    second = start(case, "-q", "--resume", *shared, env=loaded(ELSEWHERE, HOST="two"))
    if "writes" in when:
        wait_for(lambda: (case / "case.h5.lock").read_text().startswith(f"two {second.pid} "), second)
        wait_for_checkpoint(case / "case.h5", second)
    else:
        assert second.wait(TIMEOUT) == 0, second.stderr.read()
        before = (case / "case.h5").read_bytes()
    first.send_signal(signal.SIGCONT)
    assert "cannot write case.h5" in one_error(first, 3)
    if "writes" in when:
        second.terminate()
        one_error(second, 4)
    else:
        assert (case / "case.h5").read_bytes() == before
    with h5py.File(case / "case.h5") as file:
        assert file.attrs["complete"] == ("done" in when)
        assert file.attrs["resumes"] == 1
        assert len({len(file[name]) for name in ("time", "journal_y", "pad_tilt", "max_pressure")}) == 1
        assert np.ptp(np.diff(file["time"][:])) < 1e-9
    assert names(case) == ["case.h5", "case.nml"]


# ---- calls that fail ---------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["stat", "close", "rename", "sync", "delete"])
@pytest.mark.parametrize("error", ["ESTALE", "kill"])
def test_one_call_that_fails(tiltpad, case, failing, kind, error):
    """Whichever it is, or kills: the run says so or is whole; what it leaves is gone after the next run."""
    shared = "case.nml", "-q", "--set", "operation%duration=0.005"
    calls = failed = missed = 0
    while missed < 8 and calls < 20:
        calls += 1
        done = tiltpad(*shared, *EVERY_STEP, cwd=case, env=failing(kind, calls, error))
        if done.returncode != 0:
            assert error == "kill" or done.returncode == 3
            if error != "kill":
                refused(done)
            failed += 1
        left = set(names(case)) - {"case.h5", "case.nml", "case.h5.lock"}
        # a part is whole, or the lock tells the next run of it
        assert not left or "which is whole" in done.stderr or (case / "case.h5.lock").exists()
        missed = 0 if done.returncode != 0 or left else missed + 1
        tiltpad(*shared, "--overwrite", cwd=case, status=0)
        assert names(case) == ["case.h5", "case.nml"]
        (case / "case.h5").unlink()
    # what is not deleted stays
    assert failed > 0 or kind == "delete"


def test_a_kill_behind_the_last_rename(tiltpad, case, failing):
    """What it leaves beside the complete result goes when the run is to go on."""
    for call in 1, 2:
        environment = failing("delete", call, "kill")
        tiltpad("case.nml", "-q", *EVERY_STEP, "--set", "operation%duration=0.02", cwd=case, env=environment)
        with h5py.File(case / "case.h5") as file:
            assert file.attrs["complete"] == 1
        assert "case.h5.lock" in names(case)
        assert ("case.h5.part" in names(case)) == (call == 1)
        done = tiltpad("--resume", "case.h5", cwd=case, status=0)
        assert done.stdout == "case.h5: complete already, nothing to do\n"
        assert names(case) == ["case.h5", "case.nml"]
        (case / "case.h5").unlink()


@pytest.mark.parametrize("host", ["two words", "two\nlines", "\tx\x7f", "", "h\u00f4te"])
def test_names_of_machines(start, tiltpad, case, loaded, host):
    """A killed run's lock is known as one, whatever the machine is called."""
    environment = loaded(NAMED, HOST=host)
    run = start(case, "-q", "case.nml", *ENDLESS, env=environment)
    wait_for_checkpoint(case / "case.h5", run)
    run.kill()
    run.wait()
    tiltpad("case.nml", "-q", "--overwrite", cwd=case, env=environment, status=0)
    assert names(case) == ["case.h5", "case.nml"]


def test_a_container_without_statx(start, tiltpad, case, loaded):
    """One that is older than this call refuses it; a killed run's part is then known by its inode."""
    refuses = "#include <sys/stat.h>\nint statx(int a, const char *restrict b, int c, unsigned d, "
    environment = loaded(refuses + "struct statx *restrict e) { errno = EPERM; return -1; }")
    for next_one in (environment, None):
        run = start(case, "-q", "case.nml", *ENDLESS, env=environment)
        wait_for(lambda: all((case / name).exists() for name in ("case.h5", "case.h5.part")), run)
        run.kill()
        run.wait()
        tiltpad("case.nml", "-q", "--overwrite", cwd=case, env=next_one, status=0)
        assert names(case) == ["case.h5", "case.nml"]
        (case / "case.h5").unlink()


# ---- the runtime's variables -------------------------------------------------------------------


RUNTIME = (
    "OPTIONAL_PLUS=1 STDIN_UNIT=6 STDOUT_UNIT=7 STDERR_UNIT=9 UNBUFFERED_ALL=1 SHOW_LOCUS=0 DEFAULT_RECL=10 "
    "FORMATTED_BUFFER_SIZE=1 UNFORMATTED_BUFFER_SIZE=1 LIST_SEPARATOR=xx CONVERT_UNIT=swap ERROR_BACKTRACE=1"
)


@pytest.fixture(scope="module")
def said(tiltpad, tmp_path_factory):
    """said(environment): the messages of runs in it, a result, and the files that there are."""
    short = CASE.replace("0.3", "0.05")

    def perform(environment=None):
        folder = tmp_path_factory.mktemp("runtime")
        (folder / "case.nml").write_text(short)
        (folder / "sweep.nml").write_text(f"{short}&sweep operation%speed_rpm=4000,5000 /\n")
        own = {"cwd": folder, "env": environment}
        tiltpad("case.nml", "-q", **own, status=0)
        tiltpad("sweep.nml", "-q", "--jobs", 1, **own, status=0)
        checked = tiltpad("case.nml", "--check", **own, status=0)
        wrong = tiltpad("case.nml", "--set", "rotor%mass=-1", **own, status=1)
        files = names(folder) + names(folder / "sweep")
        return (checked.stdout, wrong.stderr, files), arrays(folder / "case.h5", "statistics")

    return perform


@pytest.fixture(scope="module")
def usually(said):
    return said()


@pytest.mark.parametrize("variable", RUNTIME.split())
def test_variables_of_the_runtime(said, usually, variable):
    """They change neither results nor messages."""
    ours, found = said(os.environ | dict([("GFORTRAN_" + variable).split("=")]))
    assert ours == usually[0]
    assert found.keys() == usually[1].keys()
    assert all(np.array_equal(found[name], each, equal_nan=True) for name, each in usually[1].items())
    assert ours[2][-2:] == ["0001.h5", "0002.h5"]


# ---- what is opened, made, deleted, and never done ---------------------------------------------


def touched(log, folder):
    """What was noted, paths as seen from the folder."""
    lines = log.read_text().replace(f"{folder}/", "").replace(f" {folder}\n", " .\n").splitlines()
    return {re.sub(r"\d{4}(?=\.h5)|(?<=part)[0-9a-f]+", "N", line) for line in lines}


def test_all_that_the_program_touches(start, tiltpad, case, loaded, tmp_path):
    """Runs, a stop, going on, a refusal and a study: only files of their names, no connection, no program."""
    log = tmp_path / "log"
    environment = loaded(NOTES, LOG=str(log))
    run = start(case, "-q", "case.nml", *ENDLESS, env=environment)
    wait_for_checkpoint(case / "case.h5", run)
    run.terminate()
    one_error(run, 4)
    shorten(case / "case.h5")
    for arguments, status in (
        (["--resume", "case.h5"], 0), (["case.nml"], 3), (["case.nml", "--overwrite"], 0),
    ):  # fmt: skip
        tiltpad(*arguments, "-q", cwd=case, env=environment, status=status)
    own = {f"{what} case.h5.{side}" for what in "wd" for side in ("part", "lock")}
    read = {f"r {name}" for name in (".", "case.nml", "case.h5", "case.h5.part", "/proc/self/statm")}
    assert touched(log, case) == own | read | {"w /dev/null"}
    log.unlink()
    study = CASE.replace("0.3", "0.01").replace("seconds=0.01", "seconds=0")
    (case / "case.nml").write_text(f"{study}&sweep operation%speed_rpm=4000,5000 /\n")
    (case / "case.h5").unlink()
    tiltpad("case.nml", "-q", cwd=case, env=environment, status=0)
    own = {
        f"{what} {file}.h5.{side}"
        for what in "wd"
        for side in ("part", "lock")
        for file in ("case", "case/N")
    }
    own -= {"d case.h5.part", "d case/N.h5.part"}
    # the log, which has its name once its first lines are on disk
    own |= {"w case.h5.rows.part", "d case.h5.rows"}
    found = touched(log, case)
    assert {line for line in found if line[0] != "r"} == own | {
        "m case", "m case/.tiltpad.part", "d case/.tiltpad.part"
    }  # fmt: skip
    assert {"r case.nml"} < {line for line in found if line[0] == "r"} <= {
        f"r {name}" for name in (".", "case.nml", "case.h5.part", "case", "case/.", "case/N.h5.part")
    }  # fmt: skip


def test_a_result_has_its_tables_read_once(start, tiltpad, case, loaded, tmp_path):
    """What a run that goes on has read is not read again, when it may be another."""
    (case / "force.csv").write_text("time,force_y,force_z\n0,0,0\n0.1,1,0\n9,0,0\n")
    (case / "case.nml").write_text(f"{CASE}&excitation kind='table', file='force.csv' /\n")
    run = start(case, "-q", "case.nml", *ENDLESS)
    wait_for_checkpoint(case / "case.h5", run)
    run.terminate()
    one_error(run, 4)
    shorten(case / "case.h5")
    log = tmp_path / "log"
    tiltpad("--resume", "case.h5", "-q", cwd=case, env=loaded(NOTES, LOG=str(log)), status=0)
    assert len(re.findall(r"^r \S*force\.csv$", log.read_text(), re.MULTILINE)) == 1


def test_neighbours_are_opened_once(tiltpad, case, loaded, tmp_path):
    """A single run of a study opens them only in a child, and a run that writes its own file is not tried."""
    (case / "case.nml").write_text(
        "&case task='equilibrium' /\n&sweep operation%speed_rpm=4000,5000,6000 /\n"
    )
    for run in 1, 3:
        tiltpad("case.nml", "-q", "--run", run, cwd=case, status=0)
    log = tmp_path / "log"
    tiltpad("case.nml", "-q", "--run", 2, cwd=case, env=loaded(NOTES, LOG=str(log)), status=0)
    read = [line for line in log.read_text().splitlines() if line.startswith("r ") and line.endswith(".h5")]
    assert sorted(path[-7:] for path in read) == ["0001.h5", "0003.h5"]


def test_all_that_the_commands_touch(program, tiltpad, case, loaded, tmp_path):
    """Beside what they are asked for: caches of Matplotlib at most; no program but tiltpad and uname."""
    (case / "results").mkdir()
    for name in ("a", "b"):
        tiltpad("case.nml", "-q", "-o", f"results/{name}.h5", cwd=case, status=0)
    log = tmp_path / "log"
    environment = loaded(NOTES, LOG=str(log), PYTHONDONTWRITEBYTECODE="1")
    for entry, *words in (
        ("main", "orbit", "results/a.h5", "-o", "a.png"),
        ("collect", "results", "-o", "study.h5"),
    ):
        code = (
            "import sys; from tiltpad import command; sys.exit(getattr(command, sys.argv[1])(sys.argv[2:]))"
        )
        done = subprocess.run([sys.executable, "-c", code, entry, *words], cwd=case, env=environment)
        assert done.returncode == 0
    found = {line for line in touched(log, case) if line[0] != "r"}
    import matplotlib

    caches = (matplotlib.get_cachedir(), matplotlib.get_configdir())
    # h5py asks for the processor
    libraries = {line for line in found if line[2:].startswith(caches) or line.endswith("/uname")}
    # HDF5 looks for the file that it makes in memory
    libraries |= {line for line in found if re.fullmatch(r"w study\.h5\.[0-9a-f]{64}", line)}
    # the study's log, of which the program makes the file, is in a folder of its own
    libraries |= {line for line in found if line[2:].startswith(f"{tempfile.gettempdir()}/")}
    libraries |= {"w /dev/null", f"x {program}"}
    assert found - libraries == {"w a.png.partN.png", "w study.h5.partN.h5"}


def test_a_file_system_without_times_of_birth(start, tiltpad, case, loaded):
    """The part of a killed run is known by its inode alone."""
    environment = loaded(NO_BIRTHS)
    for copied in (False, True):
        (case / "case.h5").unlink(missing_ok=True)
        run = start(case, "-q", "case.nml", *ENDLESS, env=environment)
        wait_for(lambda: (case / "case.h5").exists() and (case / "case.h5.part").exists(), run)
        run.kill()
        run.wait()
        part = case / "case.h5.part"
        if copied and part.exists():
            shutil.copy(part, case / "copy")
            part.unlink()
            (case / "copy").rename(part)
        copied = copied and part.exists()
        tiltpad("case.nml", "-q", "--overwrite", cwd=case, env=environment, status=0)
        assert part.exists() == copied
        (case / "case.h5").unlink()


# ---- make --------------------------------------------------------------------------------------


@pytest.mark.skipif(not shutil.which("flock"), reason="no flock")
def test_two_makes_in_one_folder(root, tmp_path):
    """The second waits until the first has ended."""
    shutil.copy(root / "Makefile", tmp_path)
    (tmp_path / "more.mk").write_text(
        "include Makefile\nslow:\n\t@touch began; until [ -e go ]; do sleep 0.1; done\n"
    )
    environment = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    both = {"cwd": tmp_path, "env": environment, "stderr": subprocess.PIPE, "text": True}
    first = subprocess.Popen(["make", "-f", "more.mk", "slow"], **both)
    wait_for((tmp_path / "began").exists)
    second = subprocess.Popen(["make", "-f", "more.mk", "clean"], **both)
    assert second.stderr.readline() == "make: another make works in this folder; waiting\n"
    assert second.poll() is None
    assert (tmp_path / "build").exists()
    (tmp_path / "go").touch()
    assert (first.wait(TIMEOUT), second.wait(TIMEOUT)) == (0, 0)
    assert not (tmp_path / "build").exists()
