"""What pads do: from made-up samples of which it is known, and in report and pictures of a run."""

import h5py
import numpy as np
import pytest
import tiltpad
from tiltpad import behaviour, command, summary


@pytest.fixture(scope="module")
def made(result, tmp_path_factory):
    """A file of four pads over 40 revolutions: loaded, fluttering and lifted, moving little, rubbing."""
    path = tmp_path_factory.mktemp("made") / "made.h5"
    path.write_bytes(result("four").read_bytes())
    turns = np.arange(40 * 90 + 1) / 90
    tilt = np.stack([a * np.cos(2 * np.pi * order * turns + 1) for a, order in TONES], axis=1)
    force = np.tile([1e4, 0.0, 5e3, 5e3], (len(turns), 1))
    force[::4, 1] = 20
    asperity = np.zeros_like(force)
    asperity[:720, 3] = 3
    with h5py.File(path, "r+") as file:
        speed = file["speed"][0]
        series = {"time": 2 * np.pi * turns / speed, "shaft_angle": 2 * np.pi * turns, "pad_tilt": tilt}
        series |= {"contact_force": force, "asperity_force": asperity}
        for name, each in list(file.items()):
            if isinstance(each, h5py.Dataset) and each.shape[:1] == file["time"].shape and name not in series:
                series[name] = np.repeat(each[:1], len(turns), axis=0)
        for name, values in series.items():
            if name in file:
                del file[name]
            file[name] = values
            file[name].attrs["units"] = "1"
    return path


TONES = ((1e-4, 1.0), (1e-3, 0.48), (1e-6, 0.48), (1e-3, 2.0))


def test_numbers(made, opened):
    loaded, fluttering, small, rubbing = behaviour.of_pads(opened(made))
    assert (loaded.load, loaded.share, loaded.lifted, loaded.rubbing) == (
        1e4,
        pytest.approx(0.5, rel=1e-3),
        0,
        0,
    )
    assert loaded.order == pytest.approx(1)
    assert [each.unloaded for each in (loaded, fluttering, small, rubbing)] == [False, True, False, False]
    assert [each.flutters for each in (loaded, fluttering, small, rubbing)] == [False, True, False, False]
    assert (fluttering.load, fluttering.lifted) == (5, 0.75)
    assert fluttering.order == pytest.approx(0.48, abs=1e-3)
    assert fluttering.amplitude == pytest.approx(1e-3, rel=1e-3)
    assert rubbing.rubbing == 0.2
    assert fluttering.mark == "no load\nflutters"


def test_words(made, opened):
    assert behaviour.remarks(opened(made)) == [
        "Pad 2 carries no load (mean 5 N); it is lifted off its pivot 75 % of the time; it flutters at "
        "0.48 of the shaft speed, amplitude of the tilt 1 mrad.",
        "Pad 4 rubs on the journal 20 % of the time.",
    ]


def test_nothing_to_say_of_loaded_pads(run):
    assert behaviour.remarks(run("lugre")) == []
    assert behaviour.remarks(run("runup")) == []
    with pytest.raises(tiltpad.NotInRunError):
        behaviour.of_pads(run("equilibrium"))


@pytest.mark.parametrize("beside", [0.0, 0.1, 0.5, 0.9])
def test_dominant(beside):
    """Between the lines; mean and drift are none."""
    turns = np.arange(3600) / 90
    order = (37 + beside) / 40
    values = 7 + 0.3 * turns + 0.02 * np.cos(2 * np.pi * order * turns) + 0.01 * np.cos(2 * np.pi * 3 * turns)
    found, amplitude = behaviour.dominant(values - 0.3 * turns, 40)
    assert found == pytest.approx(order, abs=1e-5)
    assert amplitude == pytest.approx(0.02, rel=1e-3)
    assert behaviour.dominant(np.ones(100), 10) == (pytest.approx(np.nan, nan_ok=True), 0)


def test_report_and_picture(made, opened, tmp_path, quick_pictures):
    figures = {text: values for text, _, values in summary.pads(opened(made))}
    assert list(figures["share of the time lifted off its pivot"]) == [0, 0.75, 0, 0]
    assert list(figures["share of the time rubbing"]) == [0, 0, 0, 0.2]
    assert figures["dominant order of the tilt"] == pytest.approx([1, 0.48, 0.48, 2], abs=1e-3)
    assert command.report([str(made), "-o", str(tmp_path / "page.html")]) == 0
    page = (tmp_path / "page.html").read_text()
    assert "<p>Pad 2 carries no load (mean 5 N)" in page
    assert "<p class=warning>Pad 4 rubs on the journal 20 % of the time.</p>" in page
    ax = tiltpad.plots.clearance(opened(made))
    assert {text.get_text() for text in ax.texts} >= {"no load\nflutters", "rubs"}
    plain = tiltpad.plots.clearance(opened(made), marks=False)
    assert not {text.get_text() for text in plain.texts} & {"no load\nflutters", "rubs"}


def test_the_program_says_the_same(tiltpad, tmp_path, root, opened):
    """Of the example whose upper pads lift off."""
    done = tiltpad(root / "input/examples/four_pads.nml", "--set", "operation%duration=1", cwd=tmp_path)
    pads = behaviour.of_pads(opened(tmp_path / "four_pads.h5"))
    assert [each.unloaded for each in pads] == [False, False, True, True]
    for each in pads:
        lifted = f"is lifted off its pivot {100 * each.lifted:.1f} % of the time"
        words = [line for line in done.stdout.splitlines() if line.startswith(f"  pad {each.pad} ")]
        assert len(words) == each.unloaded
        assert all("carries no load" in line and lifted in line for line in words)
        assert all(("flutters" in line) == each.flutters for line in words)


def test_contact_is_marked_on_the_film(made, opened):
    """In the samples of the waveform, and in the spans of a whole run, of the pad that touches alone."""
    run = opened(made)
    for draw, marks in (
        (tiltpad.plots.history, 8),
        (lambda *a, **k: tiltpad.plots.waveform(*a, last=40, **k), 720),
    ):
        for pad, expected in ((4, marks), (3, 0), (None, marks)):
            ax = draw(run, name="min_film_thickness", pad=pad)
            rug = [line for line in ax.get_lines() if line.get_marker() == "|"]
            assert sum(len(line.get_xdata()) for line in rug) == expected
            assert len(ax.texts) == (expected > 0)
