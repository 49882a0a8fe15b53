"""Where a march starts: each start leads to the same orbit, and begins where it says, or is refused."""

import re

import h5py
import numpy as np
import pytest
from conftest import EVERY_STEP, one_error, wait_for_checkpoint

CASE = "&operation duration=0.1 / &friction model='lugre' /\n"
#: Sizes of journal and tilt: their orbits'.
SIZES = {"journal_y": 2e-5, "journal_z": 2e-5, "pad_tilt": 1e-4, "bristle_deflection": 1e-7}


@pytest.fixture(scope="module")
def run(tiltpad, tmp_path_factory):
    """run(name, overrides): the open result of the case with these overrides, made once."""
    folder = tmp_path_factory.mktemp("starts")
    (folder / "case.nml").write_text(CASE)
    files = {}

    def make(name, *overrides):
        if name not in files:
            tiltpad("case.nml", "-q", "-o", f"{name}.h5", overrides=overrides, cwd=folder, status=0)
            files[name] = h5py.File(folder / f"{name}.h5")
        return files[name]

    make.folder = folder
    yield make
    for file in files.values():
        file.close()


def begins(file, name):
    return file[name][0]


STARTS = {
    "partial": ("start%from='partial'",),
    "centred": ("start%from='centred'",),
    "given": ("start%from='given'", "start%journal=-20e-6,20e-6", "start%pad_tilt=1e-4,2e-4"),
    "disturbed": ("start%journal=5e-6,-2e-6", "start%journal_velocity=1e-2,0", "start%pad_tilt_rate(2)=0.1"),
    "from_file": ("start%from='file'", "start%file='whole.h5'"),
}


@pytest.mark.parametrize("start", STARTS)
def test_each_start_leads_to_the_orbit(run, start):
    """After ten revolutions nothing is left of the start, within the errors of the march."""
    whole, other = run("whole"), run(start, *STARTS[start])
    for name, size in SIZES.items():
        one, two = (np.sort(file[name][-360:], axis=0) for file in (whole, other))
        assert np.abs(one - two).max() < 2e-3 * size, name


@pytest.mark.parametrize("model", ["pad", "film"])
@pytest.mark.parametrize("start", ["partial", "centred"])
def test_warm_oil_keeps_the_temperatures_of_the_equilibrium(run, start, model):
    """Wherever a march starts; and they are those of the march: one film is thicker than the other."""
    warm = ("oil%grade=46", f"thermal%model='{model}'")
    whole, other = run(model, *warm), run(f"{model}_{start}", *warm, *STARTS[start])
    for name, size in SIZES.items():
        one, two = (np.sort(file[name][-360:], axis=0) for file in (whole, other))
        assert np.abs(one - two).max() < 2e-3 * size, name
    rest = whole["equilibrium/journal_z"][()]
    assert rest < -5e-6
    assert abs(whole["journal_z"][-360:].mean() - rest) < 1e-6


def test_equilibrium_is_the_default(run):
    whole, same = run("whole"), run("same", "start%from='equilibrium'")
    assert whole.attrs["input"] == same.attrs["input"]
    for name in SIZES:
        assert np.array_equal(whole[name], same[name])
    assert begins(whole, "journal_y") == whole["equilibrium/journal_y"][()]


def test_it_begins_where_it_says(run):
    centred, given = run("centred", *STARTS["centred"]), run("given", *STARTS["given"])
    for name in (
        "journal_y",
        "journal_z",
        "journal_vy",
        "pad_tilt",
        "pivot_deflection",
        "bristle_deflection",
    ):
        assert np.all(begins(centred, name) == 0), name
    assert (begins(given, "journal_y"), begins(given, "journal_z")) == (-20e-6, 20e-6)
    assert list(begins(given, "pad_tilt")) == [1e-4, 2e-4]
    assert "equilibrium" not in given
    assert "equilibrium" not in centred


def test_a_disturbance_is_added(run):
    file = run("disturbed", *STARTS["disturbed"])
    rest = file["equilibrium"]
    assert begins(file, "journal_y") == rest["journal_y"][()] + 5e-6
    assert begins(file, "journal_z") == rest["journal_z"][()] - 2e-6
    assert begins(file, "journal_vy") == 1e-2
    assert list(begins(file, "pad_tilt")) == list(rest["pad_tilt"])
    assert list(begins(file, "pad_tilt_rate")) == [0, 0.1]


def test_a_file_goes_on(run):
    """From the sample at the last whole turn, and then as the other went on."""
    whole, other = run("whole"), run("from_file", *STARTS["from_file"])
    turns = whole["shaft_angle"][:] / (2 * np.pi)
    at = np.flatnonzero(np.abs(turns - np.round(turns)) < 1e-6)[-1]
    assert at > whole["time"].size - 361
    for name in (*SIZES, "journal_vy", "journal_vz", "pad_tilt_rate", "pivot_deflection_rate"):
        assert np.array_equal(begins(other, name), whole[name][at]), name
    for name, size in SIZES.items():
        rest = whole[name][at:]
        # a march that starts anew has short steps of low order first
        assert np.abs(other[name][: len(rest)] - rest).max() < 2e-3 * size, name


def test_a_file_with_a_disturbance_and_another_speed(run):
    whole = run("whole")
    other = run("moved", *STARTS["from_file"], "start%journal=1e-6,0", "operation%speed_rpm=6000")
    here = run("from_file", *STARTS["from_file"])
    assert begins(other, "journal_y") == begins(here, "journal_y") + 1e-6
    assert other["speed"][0] != whole["speed"][0]


def test_a_partial_equilibrium(tiltpad, root, tmp_path):
    """The top pad stands on its pivot without tilt; journal and loaded pads are where they are at rest.

    With asperities the search would pass the films that close, and find where the top pad hangs.
    """
    case = (root / "input/examples/five_pads.nml", "--set", "operation%duration=0.01")
    case += ("--set", "asperity%model='none'")
    rest = tiltpad(*case, "-q", "-o", "rest.h5", cwd=tmp_path)
    part = tiltpad(*case, "-o", "part.h5", "--set", "start%from='partial'", cwd=tmp_path)
    assert (rest.returncode, part.returncode) == (0, 0), rest.stderr + part.stderr
    assert "remark: pad 3: without equilibrium; the march starts without tilt\n" in part.stdout
    with h5py.File(tmp_path / "rest.h5") as whole, h5py.File(tmp_path / "part.h5") as file:
        assert abs(begins(file, "pad_tilt")[2]) < 1e-15
        assert begins(file, "journal_y") == pytest.approx(begins(whole, "journal_y"), abs=1e-7)
        assert begins(file, "pad_tilt")[[0, 4]] == pytest.approx(begins(whole, "pad_tilt")[[0, 4]], abs=1e-6)
        assert np.all(begins(file, "pad_tilt_rate") == 0)
        assert "equilibrium" not in file


REFUSED = {
    "no file": (("start%from='file'", "start%file='none.h5'"), 3, "start%file: none.h5: no such file"),
    "text": (("start%from='file'", "start%file='case.nml'"), 3, "start%file: case.nml: "),
    "pads": ((*STARTS["from_file"], "pads%pivot_angle_deg=-90"), 3, "has 2 pads, and this case 1"),
    "motion": ((*STARTS["from_file"], "pads%motion='tilting_only'"), 3, "pads%motion = 'tilting_radial'"),
    "bristles": ((*STARTS["from_file"], "friction%model='none'"), 3, "friction%model = 'lugre'"),
    "no motion": (("start%from='file'", "start%file='rest.h5'"), 3, "no samples of a motion"),
    "turned over": (("start%from='given'", "start%pad_tilt(2)=1.2"), 2, "pad 2 turned over"),
    "closed": (("start%from='centred'", "start%journal=-90e-6,0"), 2, "the film of pad 1 closed"),
    "unknown": (("start%from='rest'",), 1, "must be one of 'equilibrium'"),
}


@pytest.mark.parametrize("why", REFUSED)
def test_refused(tiltpad, run, why):
    overrides, status, words = REFUSED[why]
    run("whole")
    run("rest", "case%task='equilibrium'")
    done = tiltpad("case.nml", "-q", "-o", "out.h5", overrides=overrides, cwd=run.folder, status=status)
    assert done.stdout == ""
    assert words in done.stderr
    assert not list(run.folder.glob("out.h5*"))


def test_its_own_result_is_no_start(tiltpad, run):
    run("whole")
    before = (run.folder / "whole.h5").read_bytes()
    own = ("start%from='file'", f"start%file='../{run.folder.name}/whole.h5'")
    words = ("case.nml", "-q", "--overwrite", "-o", "whole.h5")
    done = tiltpad(*words, overrides=own, cwd=run.folder, status=1)
    assert "is the result of this run itself" in done.stderr
    assert (run.folder / "whole.h5").read_bytes() == before


def test_a_damaged_file_is_no_start(tiltpad, run):
    """Bytes in the middle that are wrong, and samples that are no numbers."""
    content = bytearray((run.folder / "whole.h5").read_bytes() if run("whole") else b"")
    (run.folder / "half.h5").write_bytes(content[: len(content) // 2])
    with h5py.File(run.folder / "nan.h5", "w") as file:
        whole = run("whole")
        file.attrs.update(whole.attrs)
        for name in whole:
            whole.copy(name, file)
        file["pad_tilt"][-400:] = np.nan
    for name, words in (("half.h5", "half.h5: "), ("nan.h5", "its last state is not a number")):
        start = ("start%from='file'", f"start%file='{name}'")
        done = tiltpad("case.nml", "-q", "-o", "out.h5", overrides=start, cwd=run.folder, status=3)
        assert words in done.stderr


def test_a_resumed_run_does_not_start_again(start, tiltpad, tmp_path):
    """It goes on from its checkpoint, even where the file that it started from is gone."""
    text = "&operation duration=2 / &friction model='lugre' /\n"
    (tmp_path / "first.nml").write_text(text.replace("duration=2", "duration=0.01"))
    (tmp_path / "case.nml").write_text(text + "&start from='file', file='first.h5' /\n")
    tiltpad("first.nml", "-q", cwd=tmp_path, status=0)
    tiltpad("case.nml", "-q", "-o", "whole.h5", cwd=tmp_path, status=0)
    output = tmp_path / "stopped.h5"
    process = start(tmp_path, "case.nml", "-q", "-o", output.name, *EVERY_STEP)
    wait_for_checkpoint(output, process)
    process.terminate()
    assert "tiltpad --resume stopped.h5 goes on" in one_error(process, 4)
    (tmp_path / "first.h5").unlink()
    with h5py.File(output) as file:
        reached = file["checkpoint/time"][()]
        first = file["journal_y"][0]
    process = start(tmp_path, "-q", "--resume", output.name)
    wait_for_checkpoint(output, process)
    process.terminate()
    one_error(process, 4)
    with h5py.File(output) as file, h5py.File(tmp_path / "whole.h5") as whole:
        assert file["checkpoint/time"][()] > reached
        assert file["journal_y"][0] == first == whole["journal_y"][0]


@pytest.mark.parametrize(
    ("settings", "why", "start"),
    [
        # films that pull leave no equilibrium to pads without load
        (("film%cavitation=none",), r"pads? [\d, ]+ ha\w+ no equilibrium \(unloaded\)", "partial"),
        # a pivot before the middle of a pad whose bore is that of the journal's circle
        (
            ("pads%pivot_ratio=0.45",),
            r"statically unstable \(divergence\): a small motion of pad 2",
            "partial",
        ),
    ],
)
def test_a_refusal_of_unloaded_pads_offers_a_start_that_works(tiltpad, tmp_path, settings, why, start):
    """Four pads without preload, the load on one of them: it names pads and cause, and the march goes."""
    (tmp_path / "case.nml").write_text(
        "&bearing journal_radius=0.0635, assembled_clearance=95.25e-6, axial_length=0.0635, preload=0, "
        "viscosity=15.17e-3 /\n&pads pivot_angle_deg=-90,0,90,180, arc_deg=75, motion='tilting_only', "
        "density=7850, thickness=15.24e-3 /\n&rotor mass=680.4, unbalance=1e-3 /\n"
        "&operation speed_rpm=10000, duration=0.002 /"
    )
    for task, advice in (("march", ""), ("equilibrium", "case%task = 'march', ")):
        done = tiltpad("case.nml", overrides=(f"case%task={task}", *settings), cwd=tmp_path, status=2)
        assert re.search(why, done.stderr), done.stderr
        assert f"a march from another start ({advice}start%from = '{start}')" in done.stderr
    go_on = (*settings, f"start%from={start}")
    tiltpad("case.nml", "--overwrite", overrides=go_on, cwd=tmp_path, status=0)
