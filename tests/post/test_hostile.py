"""Result files made to do harm: they lead out of the file, claim sizes, go in circles, bear false names.

Each is read by every reader, in a process with 500 MB more than it has and five seconds of the processor's
time: it is read, or refused in one line with the right status.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import damage
import h5py
import numpy as np
import pytest
import tiltpad
from tiltpad import command
from tiltpad.files import heaps

sys.path.insert(0, str(Path(__file__).parents[1] / "stress"))
from limited import limited  # noqa: E402


def replaced(name, **options):
    """Another dataset, of the same shape, in place of one of the file."""

    def edit(file):
        shape = file[name].shape
        given = {key: value(shape) if callable(value) else value for key, value in options.items()}
        del file[name]
        file.create_dataset(name, **{"shape": shape, "dtype": "f8"} | given)

    return edit


def linked(name, other):
    """Another thing in place of one of the file."""

    def edit(file):
        del file[name]
        file[name] = other

    return edit


def virtual(name, growing):
    """A dataset that is put together from another file's."""

    def edit(file):
        shape = file[name].shape
        most = (None,) if growing else shape
        del file[name]
        layout = h5py.VirtualLayout(shape, "f8", maxshape=most)
        part = slice(0, h5py.h5s.UNLIMITED if growing else shape[0])
        layout[part] = h5py.VirtualSource("pipe", "x", shape, maxshape=most)[part]
        file.create_virtual_dataset(name, layout)

    return edit


def attribute(**values):
    return lambda file: file.attrs.update(values)


def run(variable):
    return attribute(run=np.int32(1), runs=np.int32(2), sweep=f"{variable} = 3")


def through_a_link(file):
    del file["journal_y"]
    file["outside"] = h5py.ExternalLink("pipe", "/x")
    file["journal_y"] = h5py.SoftLink("/outside/y")


def zeros(name):
    """Very many zeros, which take no room in the file."""

    def edit(file):
        if name in file:
            del file[name]
        file.create_dataset(name, (400_000_000,), "f8", compression="gzip", chunks=(1_000_000,))[:1] = 1

    return edit


def chunks_of_two_gigabytes(**options):
    """Their values are not written, and take no room."""

    def edit(file):
        shape = file["journal_y"].shape
        del file["journal_y"]
        file.create_dataset("journal_y", shape, "f8", chunks=(2**28 - 1,), maxshape=(None,), **options)

    return edit


def many(kind, group="/"):
    """Far more attributes or datasets than a result has; each costs time where it is looked at."""

    def edit(file):
        for number in range(40_000 if kind == "attributes" else 10_000):
            if kind == "attributes":
                file[group].attrs[f"attribute {number}"] = "of nobody"
            else:
                file[f"{group}/a{number}"] = np.int32(1)

    return edit


def more_input(text):
    return lambda file: file.attrs.modify("input", file.attrs["input"] + text)


def root_in(name):
    def edit(file):
        file[name] = file["/"]

    return edit


#: Edits of a good file by the name of the attack.
OUTSIDE = {
    "external link": linked("journal_y", h5py.ExternalLink("pipe", "/x")),
    "external group": linked("equilibrium", h5py.ExternalLink("pipe", "/x")),
    "external link behind a soft one": through_a_link,
    "external storage": replaced("journal_y", external=lambda shape: [("pipe", 0, 8 * shape[0])]),
    "external storage of the axis": replaced("time", external=lambda shape: [("pipe", 0, 8 * shape[0])]),
    "foreign bytes": replaced("journal_y", external=lambda shape: [("secret", 0, 8 * shape[0])]),
    "virtual": virtual("journal_y", False),
    "virtual and growing": virtual("journal_y", True),
}
FALSE = {
    "zeros for a count": zeros("statistics/steps"),
    "unknown zeros": zeros("zeros"),
    "a thousand million runs": attribute(run=1, runs=10**9, sweep="operation%speed_rpm = 3000"),
    "a list of flags": attribute(complete=np.zeros(3000, np.int32)),
    "a list of texts": attribute(input=np.array(["&case /"] * 100, h5py.string_dtype())),
    "a group in itself": root_in("equilibrium/self"),
    "itself in a group": root_in("statistics/self"),
    "a group for a count": linked("statistics/steps", h5py.SoftLink("/equilibrium")),
    "a list for a count": linked("statistics/steps", np.arange(5)),
    "a number for a group": linked("statistics", 1.0),
    "names with blanks": lambda file: file.__setitem__("statistics/a b\nc", 1.0),
    "format_version 0": attribute(format_version=np.int32(0)),
    "format_version 1": attribute(format_version=np.int32(1)),
    "format_version -3": attribute(format_version=np.int32(-3)),
    "format_version 99": attribute(format_version=np.int32(99)),
    "format_version as text": attribute(format_version="2"),
    **{
        f"without {name}": lambda file, name=name: file.attrs.__delitem__(name)
        for name in ("complete", "task", "input")
    },
    "study over run": run("operation%run"),
    "study over status": run("rotor%status"),
    "study out of its group": run("operation%../../status"),
    "study over a blank": run("operation%a b"),
    "study over nothing": attribute(run=np.int32(1), runs=np.int32(2), sweep="operation%speed_rpm"),
    "run without runs": attribute(run=np.int32(1)),
    "texts for numbers": replaced("journal_y", dtype="S3"),
    "chunks of two gigabytes": chunks_of_two_gigabytes(),
    "deflated chunks of two gigabytes": chunks_of_two_gigabytes(compression="gzip"),
    "many attributes": many("attributes"),
    "many datasets": many("datasets"),
    "many figures": many("datasets", "summary"),
    "many lines": more_input("\n" * 60_000),
    "many variables": more_input("&more\n" + "".join(f"  a{k} = 1\n" for k in range(400_000))),
}
#: They are refused by whoever uses what they touch; the others may be read, where that is possible.
ATTACKS = OUTSIDE | FALSE


@pytest.fixture(scope="module")
def attacked(result, tmp_path_factory):
    """attacked("virtual"): the file of that attack, which is made once, as the largest take seconds."""
    folder = tmp_path_factory.mktemp("attacks")

    def path(attack):
        file = folder / f"{list(ATTACKS).index(attack)}.h5"
        if not file.exists():
            file.write_bytes(result("lugre").read_bytes())
            with h5py.File(file, "r+") as edited:
                ATTACKS[attack](edited)
        return file

    return path


@pytest.fixture
def hostile(attacked, tmp_path):
    """hostile("virtual"): the file of that attack, beside a pipe that nobody writes into and a secret."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "secret").write_bytes(b"SECRET01" * 10_000)

    def copy(attack):
        return shutil.copyfile(attacked(attack), tmp_path / "hostile.h5")

    return copy


def run_limited(words, folder, **variables):
    """Runs a command with limits; it ends with a right status and, where it fails, one line. Gives both."""
    done = limited(words, folder, damage.SECONDS, env={**os.environ, **variables})
    assert done.returncode in (0, 1, 2, 3), (done.returncode, done.stderr)
    lines = [line for line in done.stderr.splitlines() if ": warning: " not in line]
    assert len(lines) == (done.returncode != 0), done.stderr
    assert "please report" not in done.stderr
    assert done.seconds < damage.SECONDS
    assert done.memory < damage.MEMORY
    return done.returncode, done.stderr


def within_limits(work):
    """Status of the work in a child that has little memory and time."""
    outcome, said = damage.in_child(lambda: (str(work()), ""))
    assert outcome.isdigit(), (outcome, said)
    return int(outcome)


@pytest.mark.parametrize("attack", ATTACKS)
def test_readers_in_python(hostile, attack, tmp_path, monkeypatch):
    """A plot, and the page of a run: status 0, 1 or 3, and nothing of another file on the page."""
    path = hostile(attack)
    monkeypatch.chdir(tmp_path)

    def work():
        # what a crash or a false number would be seen by
        statuses = [command.main(["orbit", str(path)])]
        if attack in OUTSIDE:
            statuses.append(command.report([str(path), "-o", "page.html"]))
        return 0 if set(statuses) <= {0, 1, 3} else 50

    assert within_limits(work) == 0
    if attack in OUTSIDE:
        damaged = pytest.raises(tiltpad.RunError, match="cannot be read, the file is damaged")
        with tiltpad.read(path) as run, damaged:
            run.journal_y, run.time, run["equilibrium/journal_y"]
    page = tmp_path / "page.html"
    assert not page.exists() or "SECRET" not in page.read_text()


@pytest.mark.parametrize("attack", ATTACKS)
def test_one_bad_run_stops_no_study(hostile, result, attack, tmp_path, monkeypatch):
    single = result("none")
    bad = hostile(attack)
    monkeypatch.chdir(tmp_path)
    if attack.startswith(("study", "run", "a thousand")):
        # as a run of a study it is refused beside a single run, or unreadable
        assert within_limits(lambda: command.collect([str(bad), str(single), "-o", "study.h5"])) in (0, 1)
    else:
        assert within_limits(lambda: command.collect([str(bad), str(single), "-o", "study.h5"])) == 0
        with tiltpad.read_study("study.h5") as study:
            assert len(study.status) == 2
            assert study.status[1] == 0
            assert set(study.file) - set(study.names()) == set()


@pytest.mark.parametrize("attack", ATTACKS)
def test_the_program(hostile, program, attack, tmp_path):
    """It looks at the file, or would replace it; a pipe is never waited for."""
    path = hostile(attack)
    (tmp_path / "case.nml").write_text("&case title='another' /\n")
    start = ["case.nml", "--set", "start%from=file", "--set", f"start%file='{path}'"]
    for arguments in (
        ["--resume", path, "--check"],
        ["--resume", path],
        ["case.nml", "--output", path],
        start,
    ):
        run_limited([program, "--quiet", *arguments], tmp_path)


def test_letters_of_two_gigabytes(result, program, tmp_path):
    """The type of a text claims letters of that size; HDF5 would take memory for each of them."""
    content = bytearray(result("lugre").read_bytes())
    letter = bytes.fromhex("10000000 01000000 00000800")
    place = content.index(letter, content.index(b"program\0")) + 4
    content[place : place + 4] = (2**31 - 1).to_bytes(4, "little")
    path = tmp_path / "hostile.h5"
    path.write_bytes(content)
    assert run_limited([program, "--quiet", "--resume", path, "--check"], tmp_path)[0] == 3


@pytest.mark.skipif(not shutil.which("cc"), reason="no C compiler")
def test_a_filter_that_is_a_library(result, program, tmp_path):
    """HDF5 would look for it in the folders of HDF5_PLUGIN_PATH, and load every library there."""
    source = '__attribute__((constructor)) void run(void) { fopen("loaded", "w"); }'
    library = tmp_path / "libfilter.so"
    subprocess.run(
        ["cc", "-shared", "-fPIC", "-x", "c", "-include", "stdio.h", "-", "-o", library],
        input=source, text=True, check=True,
    )  # fmt: skip
    path = tmp_path / "hostile.h5"
    path.write_bytes(result("lugre").read_bytes())
    with h5py.File(path, "r+") as file:
        values = file["journal_y"][()]
        del file["journal_y"]
        file.create_dataset("journal_y", data=values, chunks=True, compression="gzip")
    # its number, and the length of its name
    named = (bytes([1, 0, 8, 0, 1, 0, 1, 0]) + b"deflate", bytes([123, 125, 8, 0, 0, 0, 1, 0]) + b"deflate")
    content = path.read_bytes()
    assert named[0] in content
    path.write_bytes(content.replace(*named))
    here = {"HDF5_PLUGIN_PATH": str(tmp_path)}
    assert run_limited([program, "--quiet", "--resume", path, "--check"], tmp_path, **here)[0] == 3
    orbit = "from tiltpad import command; raise SystemExit(command.main(['orbit', 'hostile.h5']))"
    status, said = run_limited([sys.executable, "-c", orbit], tmp_path, **here)
    assert status == 3
    assert "compressed by an unknown filter" in said
    assert not (tmp_path / "loaded").exists()


def test_heaps_in_each_other(result, tmp_path):
    """Each claims the same million objects, and HDF5 would read none of them."""
    path = tmp_path / "hostile.h5"
    length, index, least = ((number).to_bytes(8, "little") for number in (1 << 22, 1, heaps.HEAD))
    path.write_bytes(result("lugre").read_bytes() + 120_000 * (heaps.SIGNATURE + length + index + least))

    def work():
        with tiltpad.read(path) as run:
            return int(len(run.time) == 0)

    assert within_limits(work) == 0


@pytest.mark.parametrize("name", ["20000000000000000000.h5", "b\udcff.h5", "\u0663.h5"])
def test_names_of_members(result, name, tmp_path):
    """A number of twenty digits, bytes that are no text, digits of another script."""
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "good.h5").write_bytes(result("lugre").read_bytes())
    with open(os.fsencode(folder / name), "wb") as file:
        file.write(b"no result")
    study = tmp_path / "study.h5"
    assert within_limits(lambda: command.collect([str(folder), "-o", str(study)])) == 0
    with tiltpad.read_study(study) as found:
        assert sorted(np.isnan(found.status)) == [False, True]
