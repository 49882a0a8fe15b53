"""Files that are damaged, foreign or of a later format: one line that names the file, from every entry.

TILTPAD_DAMAGES=3000 tries as many damages instead of those of the usual run.
"""

import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

import damage
import h5py
import numpy as np
import pytest
import tiltpad
import xarray
from result_files import replace_series
from tiltpad import command
from tiltpad.files import heaps

pytestmark = pytest.mark.usefixtures("closed_figures")

#: Damages to a result and to a study for the readers in Python, and to any file for the program.
RUN, STUDY, PROGRAM = (int(os.environ.get("TILTPAD_DAMAGES", count)) for count in (100, 40, 80))
#: Commands by name, with the options that come before the file.
COMMANDS = {"tiltpad-report": [()], "tiltpad-plot": [(plot,) for plot in command.PLOTS]}
ENTRIES = {"tiltpad-report": command.report, "tiltpad-plot": command.main, "tiltpad-collect": command.collect}
#: Fewer samples than the other tests' runs, as each damage writes the file anew.
SMALL = "&operation duration=0.06 /\n&friction model='lugre' /\n&output samples_per_revolution=40 /\n"


@pytest.fixture(scope="module")
def small(tiltpad, tmp_path_factory):
    """A small result."""
    folder = tmp_path_factory.mktemp("small")
    (folder / "small.nml").write_text(SMALL)
    tiltpad("--quiet", "small.nml", cwd=folder, status=0)
    return folder / "small.h5"


@pytest.fixture(scope="module")
def study(runs_of, tmp_path_factory):
    """A study of six runs, one of which failed."""
    folder = tmp_path_factory.mktemp("study")
    values = {"operation%speed_rpm": [3000, 5000, 7000], "friction%model": ["none", "lugre"]}
    runs_of(folder / "speeds", "&operation duration=0.05 / &output samples_per_revolution=40 /", values, (2,))
    tiltpad.collect(folder / "speeds", folder / "speeds.h5")
    return folder / "speeds.h5"


def test_a_damage_is_read_or_refused(small, study, program, root):
    """Half of the damages to a result at a time: a machine has two cores or more."""
    calls = [
        ("damage.py", small, RUN // 2, 1, 25),
        ("damage.py", small, RUN - RUN // 2, 2, 25),
        ("damage.py", study, STUDY, 3, 25),
        ("damage_program.py", program, PROGRAM, 4),
    ]
    started = [
        subprocess.Popen(
            [sys.executable, root / "tests/post" / script, *map(str, words)],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )
        for script, *words in calls
    ]  # fmt: skip
    outcomes = defaultdict(lambda: np.zeros(2, int))
    for each, (_, source, count, *_) in zip(started, calls, strict=True):
        said = each.communicate()[0].splitlines()
        assert said[-1].endswith(", 0 faulty"), "\n".join(said)
        own = [int(part.split()[0]) for part in said[-1].split(", ")[:2]]
        assert sum(own) == count
        outcomes[source] += own
    # both halves of a result's damages together, as of one of them a tenth is read
    for both in outcomes.values():
        assert min(both) > 0.1 * sum(both)


def refused(capsys, name: str, arguments: list, path: Path) -> str:
    """The message of a command that must refuse a file, with status 3 and one line that names the file."""
    status = ENTRIES[name]([*map(str, arguments)])
    said = capsys.readouterr().err
    assert status == 3, said
    assert said.startswith(f"{name}: error: {path}: ")
    assert said.count("\n") == 1
    return said


def suffix(plot: str = "") -> str:
    """Of what a command writes; without a plot it is a report."""
    return {"": "html", command.MOVIE: "gif"}.get(plot, "png")


def in_every_entry(capsys, path: Path, kinds: tuple[str, ...] = ("run", "study")) -> None:
    """Every entry refuses the file."""
    if "run" in kinds:
        with pytest.raises(tiltpad.RunError, match="^" + str(path)):
            tiltpad.read(path)
    if "study" in kinds:
        with pytest.raises(tiltpad.RunError, match="^" + str(path)):
            tiltpad.read_study(path)
    for name, options in COMMANDS.items():
        for words in options:
            if ("study" if words == ("study",) else "run") in kinds:
                refused(
                    capsys,
                    name,
                    [*words, path, "-o", path.with_name(f"a.{suffix(*words)}")],
                    path,
                )
    status = command.collect([str(path), "-o", str(path.with_name("collected.h5"))])
    warned, said = capsys.readouterr().err.splitlines()
    assert status == 3
    assert warned.startswith(f"tiltpad-collect: warning: {path}: ")
    assert said == f"tiltpad-collect: error: {path}: none of 1 files can be read"
    assert not list(path.parent.glob("collected.h5*"))


@pytest.mark.parametrize("kind", ["text", "empty", "HDF5", "netCDF", "netCDF classic", "another program's"])
def test_a_foreign_file(tmp_path, capsys, kind):
    path = tmp_path / "foreign.h5"
    expected = "not an HDF5 file"
    if kind in ("text", "empty", "netCDF classic"):
        path.write_bytes({"text": b"time,journal_y\n", "empty": b""}.get(kind, b"CDF\x01" + bytes(200)))
    elif kind == "netCDF":
        xarray.Dataset({"a": ("x", [1.0])}).to_netcdf(path, engine="h5netcdf")
    else:
        with h5py.File(path, "w") as file:
            file["time"] = [0.0]
            if kind == "another program's":
                file.attrs["program"] = 3.5
    if path.read_bytes().startswith(b"\x89HDF"):
        expected = "not a result of tiltpad"
    assert expected in refused(capsys, "tiltpad-plot", ["orbit", path], path)
    in_every_entry(capsys, path)


def test_a_later_format(changed, study, tmp_path, capsys):
    path = changed("none", lambda file: file.attrs.modify("format_version", 5))
    in_every_entry(capsys, path, ("run",))
    assert "format_version 5 is newer than 4" in refused(capsys, "tiltpad-plot", ["orbit", path], path)
    later = tmp_path / "later.h5"
    later.write_bytes(study.read_bytes())
    with h5py.File(later, "r+") as file:
        file.attrs["format_version"] = 5
    in_every_entry(capsys, later, ("study",))
    assert "format_version 5 is newer than 4" in refused(capsys, "tiltpad-plot", ["study", later], later)


def test_a_study_is_no_run_and_a_run_no_study(study, small):
    with pytest.raises(tiltpad.RunError, match="a study, not the result of one run: see tiltpad-plot study"):
        tiltpad.read(study)
    with pytest.raises(tiltpad.RunError, match="the result of one run, not a study"):
        tiltpad.read_study(small)


@pytest.mark.parametrize("share", [0.001, 0.02, 0.3, 0.7, 0.95, 0.9999])
def test_a_file_cut_short(small, study, tmp_path, capsys, share):
    for source, kind, plot in ((small, "run", "orbit"), (study, "study", "study")):
        content = source.read_bytes()
        path = tmp_path / "cut.h5"
        path.write_bytes(content[: int(share * len(content))])
        assert share < 0.01 or "damaged" in refused(capsys, "tiltpad-plot", [plot, path], path)
        in_every_entry(capsys, path, (kind,))


def test_sizes_that_the_file_cannot_hold_are_not_allocated(changed):
    def enlarge(file):
        del file["journal_y"]
        file.create_dataset("journal_y", shape=len(file["time"]) * 1000000, dtype="f8", chunks=(1024,))

    path = changed("none", enlarge)
    with tiltpad.read(path) as run, pytest.raises(tiltpad.RunError, match="more than the file holds"):
        run["journal_y"]

    def resize(file):
        file["journal_y"].resize(len(file["time"]) - 1, axis=0)

    path = changed("none", resize)
    with tiltpad.read(path) as run, pytest.raises(tiltpad.RunError, match="journal_y .* fits the others"):
        run["journal_y"]


@pytest.mark.parametrize("other", ["group", "itself"])
def test_a_group_in_place_of_an_array(changed, other):
    """Whoever reads the array is told so."""
    for name in ("pivot_load", "time", "pad", "equilibrium/journal_y", "statistics/steps"):

        def edit(file, name=name):
            del file[name]
            if other == "group":
                file.create_group(name)
            else:
                file[name] = file["/"]

        path = changed("lugre", edit)
        with pytest.raises(tiltpad.RunError, match="a group and not an array"), tiltpad.read(path) as run:
            run[name]


def test_what_the_library_itself_does_not_end_or_survive(small, tmp_path):
    """A heap of attributes in which an object has no length; a text's type that is none."""
    content, path = bytearray(small.read_bytes()), tmp_path / "a.h5"
    endless = content.copy()
    heap = endless.index(heaps.SIGNATURE) + heaps.HEAD
    endless[heap : heap + 64] = bytes(64)
    path.write_bytes(endless)
    outcome, said = damage.in_child(lambda: damage.use(path, [damage.calculate]))
    assert outcome == "refused", said
    assert "an object without length in their heap" in said
    untyped = content.copy()
    # of its message behind the name: a list of variable length, version 1, that is a text (1)
    kind = untyped.index(bytes([0x19, 1]), untyped.index(b"program\0"))
    untyped[kind + 1] = 9
    path.write_bytes(untyped)
    outcome, said = damage.in_child(lambda: damage.use(path, [damage.calculate]))
    assert outcome == "refused", said


def test_a_deflated_copy_is_read(small, tmp_path):
    """As h5repack writes it."""
    path = tmp_path / "deflated.h5"
    path.write_bytes(small.read_bytes())
    with h5py.File(path, "r+") as file:
        replace_series(file, lambda name, values: values, chunks=True, compression="gzip")
    with tiltpad.read(small) as run, tiltpad.read(path) as copy:
        np.testing.assert_array_equal(copy.pad_tilt, run.pad_tilt)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("duration = 0.06", "duration = 0,06"), r"operation%duration is \(0, 6\)"),
        (("speed_rpm = 6500", "speed_rpm = 65p0"), "invalid literal"),
        (("&operation", "&operatinn"), "operation%speed_rpm is missing"),
        (("pivot_angle_deg = -45, 225", "pivot_angle_deg = -45"), "not equally many"),
        (("socket_radius = 0.013", "socket_radius = 1e300"), "beyond all ranges"),
    ],
)
def test_an_input_that_is_none(changed, change, message):
    def edit(file):
        assert change[0] in file.attrs["input"]
        file.attrs["input"] = file.attrs["input"].replace(*change)

    with pytest.raises(tiltpad.RunError, match=f"attribute 'input' cannot be read, .*{message}"):
        tiltpad.read(changed("none", edit))


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e20])
@pytest.mark.parametrize("case_name", ["lugre", "runup"])
def test_pictures_of_values_that_are_none(changed, tmp_path, capsys, case_name, value):
    """A picture or one line, whatever the values."""
    axes = ("time", "pad", "shaft_angle", "speed", "pivot_angle")

    def edit(file):
        for name in [*file, *(f"equilibrium/{each}" for each in file["equilibrium"])]:
            if isinstance(file[name], h5py.Dataset) and name not in axes:
                file[name][...] = value

    path = changed(case_name, edit)
    # a movie has a hundred pictures; a run-up differs in these plots alone
    every = [plot for plot in command.PLOTS if plot not in (command.STUDY, command.MOVIE)]
    for plot in every if case_name == "lugre" else ("runup", "size", "orders", "waterfall", "response"):
        status = command.main([plot, str(path), "-o", str(tmp_path / "a.png")])
        said = capsys.readouterr().err
        assert status in (0, 1, 2, 3)
        assert said.count("\n") == (status != 0), said
        assert (str(path) in said) == (status != 0), said


@pytest.mark.parametrize("name", ["time", "shaft_angle", "speed", "pivot_angle"])
def test_an_axis_is_finite(changed, name):
    def edit(file):
        file[name][-1] = np.nan

    with (
        tiltpad.read(changed("none", edit)) as run,
        pytest.raises(tiltpad.RunError, match="it is not finite"),
    ):
        run[name]
