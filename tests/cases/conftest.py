"""What the tests of whole runs share.

None of them depends on how fast the machine is: what happens to a run happens when a file or a line says how
far it has come, and a run that is to be stopped would not end by itself, or only after many checkpoints.
"""

import os
import pty
import re
import select
import shutil
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import h5py
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "faults"))
from injector import Fault, Injector  # noqa: E402

# what a shell runs in the background ignores Ctrl-C, what nohup runs the end of its terminal, and so would
# the commands that are tested
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)

#: Seconds after which a test gives up what it waits for: many times what it takes on a loaded machine.
TIMEOUT = 300
#: Columns of a study that depend on the moment.
TIMES = ("wall_seconds", "film_seconds", "film_building_seconds", "output_seconds", "checkpoint_seconds")
#: A run that does not end by itself.
ENDLESS = ("--set", "operation%duration=10000")
#: A run that makes a checkpoint at each of its steps, which takes fifty times as long as the steps do.
EVERY_STEP = ("--set", "output%checkpoint_seconds=1e-9")

#: Of a library that is loaded before the system's own: what its functions stand for.
HEAD = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
#define NEXT(name) ((__typeof__(name) *)dlsym(RTLD_NEXT, #name))
"""
#: A clock that is a second later at every look: what happens now and then happens at once.
FAST_CLOCK = """
int clock_gettime(clockid_t clock, struct timespec *now)
{
   static long looks;
   int result = NEXT(clock_gettime)(clock, now);
   if (clock == CLOCK_MONOTONIC) now->tv_sec += ++looks;
   return result;
}
"""


def in_a_mount_namespace(script, cwd=None, **names):
    """Runs a shell script with mounts of its own."""
    if os.geteuid() != 0 or not shutil.which("unshare"):
        pytest.skip("needs root for a file system of its own")
    probe = subprocess.run(["unshare", "-m", "true"], capture_output=True)
    if probe.returncode != 0:
        pytest.skip("no mount namespaces here")
    return subprocess.run(
        ["unshare", "-m", "sh", "-e", "-c", script],
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
        cwd=cwd,
        env={**os.environ, **{name: str(value) for name, value in names.items()}},
    )


def wait_for(condition, process=None, seconds=TIMEOUT):
    """Until the condition holds. A process, where one is given, must not end before."""
    end = time.monotonic() + seconds
    while not condition():
        assert process is None or process.poll() is None, process.communicate()
        assert time.monotonic() < end
        # many of these conditions open a file
        time.sleep(0.005)


def publication(path):
    """What differs between a result and the checkpoint that replaces it; None where there is no file."""
    return (path.stat().st_ino, path.stat().st_mtime_ns) if path.exists() else None


def wait_for_checkpoint(path, process):
    """Until the process publishes its result, or publishes it anew."""
    before = publication(path)
    wait_for(lambda: publication(path) not in (None, before), process)


def wait_for_line(process, pattern):
    """Until the process has printed a line that begins so; it is one whose output is not buffered."""
    for line in process.stdout:
        if re.match(pattern, line):
            return
    raise AssertionError(process.communicate())


def on_a_terminal(program, arguments, folder, environment, stderr=None):
    """What the program writes to a pseudo-terminal, messages too unless `stderr` takes them; its status."""
    try:
        leader, follower = pty.openpty()
    except OSError:
        pytest.skip("no pseudo-terminals here")
    with subprocess.Popen(
        [program, *arguments], cwd=folder, env=environment,
        stdin=follower, stdout=follower, stderr=follower if stderr is None else stderr,
    ) as process:  # fmt: skip
        os.close(follower)
        seen = b""
        while select.select([leader], [], [], TIMEOUT)[0]:
            try:
                new = os.read(leader, 65536)
            except OSError:
                break
            if not new:
                break
            seen += new
    os.close(leader)
    return seen.decode(), process.returncode


def one_error(process, status):
    """The one line with which a process ended."""
    error = process.communicate(timeout=TIMEOUT)[1]
    assert process.returncode == status, error
    assert error.count("\n") == 1
    assert error.startswith("tiltpad: error: ")
    return error


def arrays(path, *but):
    """All arrays of a result by their full names, but those of some groups."""
    found = {}

    def note(name, each):
        if isinstance(each, h5py.Dataset) and name.partition("/")[0] not in but:
            found[name] = each[()]

    with h5py.File(path) as file:
        file.visititems(note)
    return found


def rows(path):
    """All arrays of a study that do not depend on the moment."""
    return {name: values for name, values in arrays(path).items() if name not in TIMES}


@pytest.fixture
def case(tmp_path):
    """Writes case.nml into a folder of its own and returns that."""

    def write(text):
        (tmp_path / "case.nml").write_text(text)
        return tmp_path

    return write


def shorten(path, more=0.01):
    """Sets the end of a stopped march this many seconds behind its checkpoint; gives it."""
    with h5py.File(path, "r+") as file:
        end = float(file["checkpoint/time"][()]) + more
        file.attrs["input"] = re.sub(r"duration = \S+", f"duration = {end!r}", file.attrs["input"])
    return end


@pytest.fixture
def start(program):
    """start(folder, *arguments, **options): the program under way; killed where the test leaves it so."""
    processes = []

    def begin(folder, *arguments, overrides=(), **options):
        own = {"env": os.environ | {"GFORTRAN_UNBUFFERED_PRECONNECTED": "yes"}} | options
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        words = [*map(str, arguments), *(word for each in overrides for word in ("--set", each))]
        processes.append(subprocess.Popen([program, *words], cwd=folder, **pipes | own))
        return processes[-1]

    yield begin
    for process in processes:
        with process:
            process.kill()


@pytest.fixture(scope="session")
def loaded(tmp_path_factory):
    """loaded(FAST_CLOCK): the environment in which these functions stand for the system's."""

    @cache
    def library(source):
        path = tmp_path_factory.mktemp("loaded") / "own.so"
        compiler = shutil.which("cc") or shutil.which("gcc")
        if not compiler:
            pytest.skip("no C compiler")
        subprocess.run(
            [compiler, "-shared", "-fPIC", "-w", "-x", "c", "-", "-o", path, "-ldl"],
            input=HEAD + source, text=True, check=True,
        )  # fmt: skip
        return str(path)

    return lambda source, **variables: {**os.environ, "LD_PRELOAD": library(source), **variables}


@pytest.fixture(scope="session")
def failing(tmp_path_factory):
    """failing("write", 12, "ENOSPC"): the environment in which it fails; `always`: and all after it."""
    if not (shutil.which("cc") or shutil.which("gcc")):
        pytest.skip("no C compiler")
    library = tmp_path_factory.mktemp("injector")
    injector = Injector(library)

    def environment(*fault, always=False, folder=None):
        return injector.environment(library / "counts", Fault(*fault, always), folder)

    return environment


@pytest.fixture
def run(tiltpad, tmp_path):
    """run(case, overrides, status): the outcome of a case in tmp_path/case.nml."""

    def make(case, *overrides, status=0, name="case", more=()):
        (tmp_path / f"{name}.nml").write_text(case)
        return tiltpad(f"{name}.nml", *more, overrides=overrides, cwd=tmp_path, status=status)

    return make


@pytest.fixture
def result(run, tmp_path):
    """The file of a case."""

    def make(case, *overrides):
        run(case, *overrides, more=["--overwrite"])
        return h5py.File(tmp_path / "case.h5")

    return make


@pytest.fixture
def follow(tiltpad, tmp_path):
    """follow(text, *overrides): the file of a branch or a curve, and what the program printed."""

    def perform(text, *overrides, name="case"):
        (tmp_path / f"{name}.nml").write_text(text)
        command = (f"{name}.nml", "-o", f"{name}.h5", "--overwrite")
        done = tiltpad(*command, cwd=tmp_path, overrides=overrides, status=0)
        return h5py.File(tmp_path / f"{name}.h5"), done.stdout

    return perform
