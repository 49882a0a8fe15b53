"""Python commands whose writes are refused, or that are killed: what was there stays, and nothing more.

Each command runs in a process of its own. Writes are refused by a limit on the size of files, by a small disk
(where one may be mounted), and one by one, by a library loaded before the system's own.
"""

import ctypes
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import TIMEOUT, wait_for, wait_for_checkpoint
from tiltpad import command
from tiltpad.draw import report, study_report  # noqa: F401 as a fork is not to load them

#: Seconds within which nothing of a killed command may run any more.
SOON = 5
COMMAND = "import sys; from tiltpad import command; sys.exit(getattr(command, sys.argv[1])(sys.argv[2:]))"
#: Commands by what they write.
WRITERS = {
    "study.h5": ("collect", "results"),
    "page.html": ("report", "results/e.h5"),
    "picture.png": ("main", "orbit", "results/a.h5"),
    "picture.pdf": ("main", "orbit", "results/a.h5"),
    "picture.svg": ("main", "bearing", "results/a.h5"),
    "movie.gif": ("main", "movie", "results/a.h5", "--last", "0.002"),
    "table.csv": ("main", "coefficients", "results/c.h5"),
    "table.toml": ("main", "coefficients", "results/c.h5"),
}
#: Writes files from Python, each over one that is there, and says how that ended.
IN_PYTHON = """
import resource
import sys
from pathlib import Path
import tiltpad
from tiltpad.files.writing import hdf5

def changed():
    with hdf5(Path("old.h5"), "r+") as file:
        file.attrs["run"] = 1

march, small = tiltpad.read("results/a.h5"), tiltpad.read("results/c.h5")
study = tiltpad.read_study("study.h5")
writers = {
    "a.csv": lambda: march.to_csv("a.csv"),
    "b.csv": lambda: study.to_csv("b.csv"),
    "c.csv": lambda: tiltpad.write_coefficients(small, "c.csv"),
    "d.toml": lambda: tiltpad.to_ross(small, "d.toml"),
    "e.nml": lambda: tiltpad.write_case("e.nml", march.input),
    "old.h5": changed,
}
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]), resource.RLIM_INFINITY))
for name, write in writers.items():
    try:
        write()
        print(name, "written")
    except OSError as error:
        print(name, error.strerror)
"""


@pytest.fixture(scope="module")
def results(tiltpad, tmp_path_factory):
    """A folder with the folder of results: of a march, of coefficients, and of an equilibrium."""
    folder = tmp_path_factory.mktemp("faults")
    (folder / "results").mkdir()
    (folder / "a.nml").write_text("&friction model='lugre' / &operation duration=0.02 /\n")
    (folder / "c.nml").write_text("&case task='coefficients' /\n")
    (folder / "e.nml").write_text("&case task='equilibrium' /\n")
    for name in ("a", "c", "e"):
        tiltpad(f"{name}.nml", "-q", "-o", f"results/{name}.h5", cwd=folder, status=0)
    return folder / "results"


@pytest.fixture
def folder(results, tmp_path):
    """A folder to write into."""
    (tmp_path / "here").mkdir()
    (tmp_path / "here/results").symlink_to(results)
    return tmp_path / "here"


def begun(folder, name, output=None, **options):
    """A command under way that writes what is called so."""
    words = [sys.executable, "-c", COMMAND, *WRITERS[name], "-o", output or name]
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(words, cwd=folder, **pipes | options)


def ended(*arguments, **options):
    """Status and messages of a command in a process of its own."""
    with begun(*arguments, **options) as process:
        said = process.communicate()[1]
    return process.returncode, said


def done(folder, name, output=None, most=resource.RLIM_INFINITY):
    """The same in a fork of this process, which has loaded what commands load; `most`: bytes of a file."""
    receive, send = os.pipe()
    child = os.fork()
    if child == 0:
        status = 70
        try:
            os.chdir(folder)
            with open(os.devnull, "w") as sys.stdout, open(send, "w") as sys.stderr:
                resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
                entry, *words = WRITERS[name]
                status = getattr(command, entry)([*words, "-o", str(output or name)])
        finally:
            os._exit(status)
    os.close(send)
    with open(receive) as stream:
        said = stream.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), said


def old(folder, name):
    """What an earlier run of the command has written."""
    assert done(folder, name) == (0, "")
    return (folder / name).read_bytes()


def names(folder):
    return sorted(path.name for path in folder.iterdir() if path.name != "results")


# ---- writes that are refused -------------------------------------------------------------------


@pytest.mark.parametrize("name", WRITERS)
def test_a_file_that_may_not_grow(folder, name):
    if name.startswith(("study", "table")):
        before = old(folder, name)
    else:
        # a picture takes long
        before = bytes(4196)
        (folder / name).write_bytes(before)
    # the first write, where a picture differs from others in its format alone, or a later one
    sizes = (
        (0, len(before) - 100) if name.endswith((".h5", ".html", ".png", ".csv")) else (len(before) - 100,)
    )
    for size in sizes:
        status, said = done(folder, name, most=size)
        assert (status, said.count("\n")) == (3, 1), said
        # the study's file is made in a temporary folder, where nothing can be written either
        words = (
            "file too large|cannot be written: no " if name == "study.h5" else "be written: file too large\n"
        )
        assert re.search(words, said.lower()), said
        assert (folder / name).read_bytes() == before
        assert names(folder) == [name]


@pytest.mark.parametrize("size", [0, 20, 2000])
def test_writers_in_python(folder, size):
    old(folder, "study.h5")
    shutil.copy(folder / "results/a.h5", folder / "old.h5")
    before = {"old.h5": (folder / "old.h5").read_bytes(), "study.h5": (folder / "study.h5").read_bytes()}
    for name in ("a.csv", "b.csv", "c.csv", "d.toml", "e.nml"):
        (folder / name).write_bytes(before.setdefault(name, b"precious"))
    done = subprocess.run(
        [sys.executable, "-c", IN_PYTHON, str(size)], cwd=folder, capture_output=True, text=True, check=True
    )
    outcomes = dict(line.split(" ", 1) for line in done.stdout.splitlines())
    assert outcomes["a.csv"] == outcomes["old.h5"] == "File too large"
    assert size > 20 or set(outcomes.values()) == {"File too large"}
    assert names(folder) == sorted(before)
    for name, content in before.items():
        assert ((folder / name).read_bytes() == content) == (outcomes.get(name) != "written"), name


def test_a_movie_whose_program_fails(folder, tmp_path):
    """What ffmpeg says last is told."""
    fake = tmp_path / "bin/ffmpeg"
    fake.parent.mkdir()
    fake.write_text("#!/bin/sh\ncat >/dev/null\necho first >&2\necho no space >&2\nexit 1\n")
    fake.chmod(0o755)
    (folder / "movie.mp4").write_bytes(b"precious")
    environment = os.environ | {"PATH": f"{fake.parent}:{os.environ['PATH']}"}
    status, said = ended(folder, "movie.gif", "movie.mp4", env=environment)
    assert (status, said) == (3, "tiltpad-plot: error: movie.mp4: cannot be written: ffmpeg: no space\n")
    assert (folder / "movie.mp4").read_bytes() == b"precious"
    assert names(folder) == ["movie.mp4"]


@pytest.fixture
def small_disk(tmp_path):
    """small_disk(12): a folder that is a disk of this size."""
    mount, unmount = (getattr(ctypes.CDLL(None, use_errno=True), name) for name in ("mount", "umount2"))
    disk = tmp_path / "disk"
    disk.mkdir()

    def make(kilobytes):
        if mount(b"tmpfs", bytes(disk), b"tmpfs", 0, f"size={kilobytes}k".encode()):
            pytest.skip(f"a disk cannot be mounted: {os.strerror(ctypes.get_errno())}")
        return disk

    yield make
    unmount(bytes(disk), 2)


@pytest.mark.parametrize("kilobytes", [4, 12, 40])
def test_a_full_disk(folder, small_disk, kilobytes):
    """HDF5 would crash on one of 4 or 12 kB."""
    disk = small_disk(kilobytes)
    for name in ("study.h5", "picture.svg"):
        status, said = done(folder, name, output=disk / name)
        assert (status, said.count("\n")) == (3, 1), said
        assert said.endswith("cannot be written: No space left on device\n")
        assert names(disk) == []


def test_one_refused_write(folder, failing):
    """Whichever it is of some, it is told, and the study that was there stays."""
    before = old(folder, "study.h5")
    told = missed = write = 0
    # Python tries its folder for temporary files by a write, and takes another where that fails
    while missed < 2:
        write += 1 + write
        status, said = ended(folder, "study.h5", env=failing("write", write, "ENOSPC"))
        assert names(folder) == ["study.h5"]
        if status == 0:
            missed += 1
            before = (folder / "study.h5").read_bytes()
            continue
        told += 1
        missed = 0
        assert (status, said.count("\n")) == (3, 1), said
        assert "no space left on device" in said.lower(), said
        assert (folder / "study.h5").read_bytes() == before
    assert told > 0


# ---- what takes the place of what --------------------------------------------------------------


def test_a_link_a_mode_and_a_write_protection(folder):
    """The target of a link is replaced and keeps its mode; what must not be written is not replaced."""
    (folder / "there").mkdir()
    page = folder / "there/page.html"
    page.write_text("old")
    page.chmod(0o640)
    (folder / "page.html").symlink_to("there/page.html")
    old(folder, "page.html")
    assert (folder / "page.html").is_symlink()
    assert page.read_text() != "old"
    assert page.stat().st_mode & 0o777 == 0o640
    if os.geteuid() == 0:
        return
    page.chmod(0o440)
    before = page.read_bytes()
    assert done(folder, "page.html")[0] == 3
    assert page.read_bytes() == before


def test_a_pipe_is_written_as_it_is(folder):
    os.mkfifo(folder / "page.html")
    with begun(folder, "page.html") as process:
        text = (folder / "page.html").read_text()
        assert process.wait() == 0
    assert text.startswith("<!DOCTYPE html>")
    assert text.endswith("</html>\n")
    assert (folder / "page.html").is_fifo()


#: A command that comes to where its part is whole says so by a file, and waits there until the file is gone.
WAITS = """#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
int fsync(int file)
{
   const char *reached = getenv("REACHED");
   /* the program that makes a study's file in a temporary folder does not wait */
   if (strcmp(program_invocation_short_name, "tiltpad") == 0) return 0;
   close(creat(reached, 0600));
   while (access(reached, F_OK) == 0) usleep(1000);
   return 0;
}
"""


@pytest.mark.parametrize("name", ["study.h5", "picture.png"])
def test_parts_of_killed_commands(folder, loaded, tmp_path, name):
    """The next command removes them; those of living ones, and what only looks like one, stay."""
    before = old(folder, name)
    reached, environment = tmp_path / "reached", loaded(WAITS, REACHED=str(tmp_path / "reached"))

    def waiting():
        process = begun(folder, name, env=environment)
        wait_for(reached.exists, process)
        return process

    suffix = Path(name).suffix
    others = [f"{name}.part", f"{name}.part1234", f"{name}.partner{suffix}", f"{name}.part{'0' * 16}"]
    for each in others:
        (folder / each).write_text("precious")
    (folder / f"{name}.part{'0' * 16}{suffix}").symlink_to(others[0])
    others += [f"{name}.part{'0' * 16}{suffix}"]
    for end in (signal.SIGKILL, signal.SIGTERM):
        with waiting() as process:
            assert len(names(folder)) == len(others) + 2
            process.send_signal(end)
            reached.unlink()
            said = process.communicate(timeout=TIMEOUT)[1]
        if end == signal.SIGKILL:
            assert len(names(folder)) == len(others) + 2
            before = old(folder, name)
        else:
            assert process.returncode == 128 + end
            assert said.count("\n") == 1
            assert said.endswith(": error: stopped\n")
        assert names(folder) == sorted([name, *others])
        assert (folder / name).read_bytes() == before
    with waiting() as process:
        assert done(folder, name)[0] == 0
        assert len(names(folder)) == len(others) + 2
        process.kill()


#: Gets SIGTERM in the end of an object, out of which Python lets no exception.
IN_THE_END = """
import os, signal, sys
from tiltpad import command
from tiltpad.files import writing

class Last:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGTERM)

def new_part(target, _new=writing.new_part):
    Last()
    return _new(target)

writing.new_part = new_part
sys.exit(getattr(command, sys.argv[1])(sys.argv[2:]))
"""


@pytest.mark.parametrize("name", ["study.h5", "picture.png"])
def test_a_signal_in_the_end_of_an_object(folder, name):
    """Nothing is written then, and nothing said to be done."""
    words = [sys.executable, "-c", IN_THE_END, *WRITERS[name], "-o", name]
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 128 + signal.SIGTERM
    assert done.stdout == ""
    assert re.fullmatch(r"tiltpad-\w+: error: stopped\n", done.stderr)
    assert names(folder) == []


# ---- processes that commands start -------------------------------------------------------------


def children(process):
    """Those of a process that are there."""
    try:
        return Path(f"/proc/{process}/task/{process}/children").read_text().split()
    except FileNotFoundError:
        return []


def alive(process):
    """Whether a process runs; one that has ended and that nobody waits for does not."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except (FileNotFoundError, ProcessLookupError):
        return False


def gone(processes):
    """Until none of these runs any more, which must be soon."""
    wait_for(lambda: not any(map(alive, processes)), seconds=SOON)


@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_killed_collect_leaves_no_workers(folder, results, end):
    (folder / "many").mkdir()
    for number in range(1000):
        os.link(results / "a.h5", folder / f"many/{number}.h5")
    code = f"import os; os.sched_getaffinity = lambda _: (0, 1)\n{COMMAND}"
    words = [sys.executable, "-c", code, "collect", "many", "-o", "study.h5"]
    with subprocess.Popen(words, cwd=folder, stderr=subprocess.PIPE, text=True) as process:
        wait_for(lambda: len(children(process.pid)) == 2, process)
        workers = children(process.pid)
        process.send_signal(end)
        said = process.communicate()[1]
        gone(workers)
    assert process.returncode == (-end if end == signal.SIGKILL else 128 + end)
    assert said == ("" if end == signal.SIGKILL else "tiltpad-collect: error: stopped\n")
    assert names(folder) == ["many"]


def test_a_killed_python_stops_its_program(folder, program):
    """It stops as by SIGTERM, with a checkpoint."""
    values = "operation={'duration': 1e4}, output={'checkpoint_seconds': 0.01}"
    code = f"import tiltpad; tiltpad.run(None, 'case.h5', {values})"
    environment = os.environ | {"TILTPAD": program}
    with subprocess.Popen([sys.executable, "-c", code], cwd=folder, env=environment) as run:
        wait_for(lambda: (folder / "case.h5").exists(), run)
        (march,) = children(run.pid)
        wait_for_checkpoint(folder / "case.h5", run)
        run.kill()
    gone([march])
    assert names(folder) == ["case.h5"]
