"""Out of memory: one line and status 3, whoever asks for it; known before a march where the case can tell."""

import os
import re
import resource
import shutil
import subprocess

import pytest
from conftest import TIMEOUT

CASE = "&friction model='lugre' / &operation duration=0.02 /\n"
#: Tasks whose requests differ: what they write, read, solve and integrate.
TASKS = {
    "march": CASE,
    "coefficients": "&case task='coefficients' /\n",
    "periodic": "&case task='periodic' /\n",
    "branch": "&case task='branch' /\n"
    "&branch of='equilibrium', parameter='rotor%mass', last=2300, step=100 /\n",
}


def limited(kilobytes):
    """As `ulimit -v` of a shell."""
    size = 1024 * kilobytes
    return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size))}


@pytest.mark.parametrize("once", [False, True], ids=["from then on", "once"])
@pytest.mark.parametrize("task", TASKS)
def test_no_memory_at_any_request(tiltpad, tmp_path, failing, task, once):
    """Whichever it is: one line, and the next run goes its way."""
    (tmp_path / "case.nml").write_text(TASKS[task])
    call, refused = 1, 0
    while True:
        done = tiltpad(
            "case.nml", "-q", cwd=tmp_path, env=failing("memory", int(call), "ENOMEM", always=not once)
        )
        if done.returncode == 0:
            break
        assert (done.returncode, done.stdout, done.stderr) == (3, "", "tiltpad: error: out of memory\n"), call
        # the file is whole already where the last requests fail; the next run would read it without memory
        (tmp_path / "case.h5").unlink(missing_ok=True)
        refused += 1
        call = 1 + 1.2 * call
    assert refused > 40
    assert sorted(os.listdir(tmp_path)) == ["case.h5", "case.nml"]


def test_no_memory_for_a_run_of_a_study(tiltpad, tmp_path, failing):
    """It is told as others are that fail, and the next study does what is missing."""
    (tmp_path / "case.nml").write_text(CASE + "&sweep operation%speed_rpm=4000,5000 /\n")
    call, said = 1000, [""]
    while not said[-1].endswith("2 runs failed"):
        done = tiltpad("case.nml", "-q", "--jobs", 1, cwd=tmp_path, env=failing("memory", call, "ENOMEM"))
        if done.returncode == 0:
            # HDF5 gave back what it keeps in reserve, and asked again
            assert sorted(os.listdir(tmp_path / "case")) == ["0001.h5", "0002.h5"]
            shutil.rmtree(tmp_path / "case")
            (tmp_path / "case.h5").unlink()
            call += 1
            continue
        assert done.returncode == 3
        *lines, said = done.stderr.splitlines()
        said = [*sorted(lines), said]
        call *= 2
    failed = [line for line in said if " run " in line]
    assert said[:-1] == ["tiltpad: error: out of memory"] * len(failed) + failed
    assert all(line.endswith("000): out of memory") for line in failed)
    tiltpad("case.nml", "-q", cwd=tmp_path, status=0)
    assert sorted(os.listdir(tmp_path / "case")) == ["0001.h5", "0002.h5"]


def test_no_memory_for_the_program(start, tmp_path):
    """Where it can start at all."""
    (tmp_path / "case.nml").write_text(CASE)
    for kilobytes in range(18000, 26000, 500):
        done = start(tmp_path, "case.nml", "-q", **limited(kilobytes))
        message = done.communicate(timeout=TIMEOUT)[1]
        # the system's loader has its own
        assert done.returncode in (0, 3, 127)
        assert done.returncode == 0 or message.count("\n") == 1


#: Two revolutions whose figures are of many samples: a prime, for which a transform takes most.
LARGE = "&operation duration=0.02 / &output samples_per_revolution=200003, spectrum_revolutions=1 /\n"


def test_figures_that_do_not_fit(start, tmp_path):
    """They are refused before anything is calculated, or the run has the memory that it needs."""
    (tmp_path / "case.nml").write_text(LARGE)
    low, high = 20000, 120000
    while high - low > 500:
        kilobytes = (low + high) // 2
        run = start(tmp_path, "case.nml", "-q", **limited(kilobytes))
        message = run.communicate(timeout=TIMEOUT)[1]
        if run.returncode == 0:
            high = kilobytes
            (tmp_path / "case.h5").unlink()
            continue
        assert run.returncode == 3
        assert re.fullmatch(
            r"tiltpad: error: out of memory: the run needs \d+ MB; fewer output%spectrum_revolutions or "
            r"output%samples_per_revolution need less\n",
            message,
        )
        assert sorted(os.listdir(tmp_path)) == ["case.nml"]
        low = kilobytes
    assert high < 120000


def test_memory_does_not_grow_with_the_run(program, tmp_path):
    """Ten times the samples take the same, but for the places of their chunks in the file."""
    (tmp_path / "case.nml").write_text("&output samples_per_revolution=5000, spectrum_revolutions=2 /\n")
    largest = []
    for duration in ("0.05", "0.5"):
        words = ["case.nml", "-q", "--overwrite", "--set", f"operation%duration={duration}"]
        process = subprocess.Popen([program, *words], cwd=tmp_path)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
        assert status == 0
        largest.append(usage.ru_maxrss)
    assert largest[1] - largest[0] < 3000  # kB
