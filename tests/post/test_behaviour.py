"""What pads do: in report and pictures of a run, by the figures in its file (see test_pad_behaviour.f90)."""

import h5py
import numpy as np
import pytest
import tiltpad
from result_files import replace_series
from tiltpad import behaviour, command, summary

SAID = [
    "pad 2 carries no load (mean 5.0 N); it is lifted off its pivot 75.0 % of the time",
    "pad 4 rubs on the journal 20.0 % of the time",
]


@pytest.fixture(scope="module")
def made(result, tmp_path_factory):
    """A file of four pads over 40 revolutions: the second has no load and flutters, the fourth rubs."""
    path = tmp_path_factory.mktemp("made") / "made.h5"
    path.write_bytes(result("four").read_bytes())
    turns = np.arange(40 * 90 + 1) / 90
    asperity = np.zeros((len(turns), 4))
    asperity[:720, 3] = 3
    figures = {"pad_unloaded": [0, 1, 0, 0], "pad_flutters": [0, 1, 0, 0], "pad_rubbing": [0, 0, 0, 0.2]}
    figures |= {"pad_lifted": [0, 0.75, 0, 0], "pad_order": [1, 0.48, 0.48, 2]}
    with h5py.File(path, "r+") as file:
        speed = file["speed"][0]
        series = {"time": 2 * np.pi * turns / speed, "shaft_angle": 2 * np.pi * turns}
        series |= {"asperity_force": asperity}
        replace_series(file, lambda name, each: series.get(name, np.repeat(each[:1], len(turns), axis=0)))
        for name, values in figures.items():
            file[f"summary/{name}"][...] = values
        file.pop("summary/remarks", None)
        remarks = file.create_dataset("summary/remarks", data=np.array(SAID, dtype="S"))
        remarks.make_scale("summary/remarks")
    return path


def test_remarks_and_marks(made, opened):
    assert opened(made).remarks == SAID
    assert f"remark: {SAID[1]}" in repr(opened(made))
    assert f"remark: {SAID[1]}" in opened(made)._repr_html_()
    assert behaviour.marks(opened(made)) == {2: "no load\nflutters", 4: "rubs"}


def test_nothing_to_say_of_loaded_pads(run):
    for case_name in ("lugre", "runup", "equilibrium"):
        assert run(case_name).remarks == []
        assert behaviour.marks(run(case_name)) == {}


def test_report_and_picture(made, opened, tmp_path, quick_pictures, capsys):
    figures = {each.name: each.value for each in summary.pads(opened(made))}
    assert list(figures["summary/pad_lifted"]) == [0, 0.75, 0, 0]
    assert command.report([str(made), "-o", str(tmp_path / "page.html")]) == 0
    said = f"{made}: {len(SAID)} remarks; the report of the run has them\n"
    assert capsys.readouterr().out == said
    assert command.main(["orbit", str(made), "-o", str(tmp_path / "orbit.png")]) == 0
    assert capsys.readouterr().out == said
    page = (tmp_path / "page.html").read_text()
    assert "<p class=warning>Pad 2 carries no load (mean 5.0 N)" in page
    assert "<p class=warning>Pad 4 rubs on the journal 20.0 % of the time.</p>" in page
    ax = tiltpad.plots.clearance(opened(made))
    assert {text.get_text() for text in ax.texts} >= {"no load\nflutters", "rubs"}
    plain = tiltpad.plots.clearance(opened(made), marks=False)
    assert not {text.get_text() for text in plain.texts} & {"no load\nflutters", "rubs"}


def test_the_program_says_the_same(tiltpad, tmp_path, root, opened):
    """Of the example whose upper pads lift off."""
    done = tiltpad(root / "input/examples/four_pads.nml", "--set", "operation%duration=1", cwd=tmp_path)
    run = opened(tmp_path / "four_pads.h5")
    assert list(run["summary/pad_unloaded"]) == [0, 0, 1, 1]
    told = [line.removeprefix("remark: ") for line in done.stdout.splitlines() if line.startswith("remark: ")]
    assert told == run.remarks
    said = [line for line in told if "no load (" in line]
    assert len(said) == 2
    for line, pad in zip(said, (2, 3), strict=True):
        assert f"is lifted off its pivot {100 * run['summary/pad_lifted'][pad]:.1f} % of the time" in line
        assert ("flutters" in line) == run["summary/pad_flutters"][pad]


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
