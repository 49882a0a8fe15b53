"""Stations of machines as journals, and what is said of machines without films or pads."""

from pathlib import Path

import numpy as np
import pytest
import tiltpad
from tiltpad import command
from tiltpad.draw import figures
from tiltpad.files.station import Station

pytestmark = pytest.mark.usefixtures("quick_pictures")

AERO = Path(__file__).parents[2] / "input/examples/aero.nml"
#: Tasks of the aero rotor, which has no films, with what is changed.
TASKS = {
    "branch": ("branch%last=4500", "branch%step=250"),
    "march": ("operation%duration=0.2", "operation%final_speed_rpm=4000"),
    "ramp": ("case%task=march", "operation%duration=0.6", "operation%final_speed_rpm=5000"),
    "coefficients": (),
}
#: Plots of stations, and the result that each takes.
DRAWN = {"branch": "branch", "spectrum": "march", "poincare": "march", "size": "march"}
DRAWN |= {"orders": "ramp", "waterfall": "ramp"}


@pytest.fixture(scope="module")
def aero(tiltpad, tmp_path_factory):
    """aero("march"): path of the result of this task."""
    folder = tmp_path_factory.mktemp("aero")

    def path(task):
        file = folder / f"{task}.h5"
        if not file.exists():
            tiltpad(
                "-q", AERO, "-o", file, overrides=(f"case%task={task}", *TASKS[task]), cwd=folder, status=0
            )
        return file

    return path


def test_a_station_is_read_as_a_journal(aero):
    with tiltpad.read(aero("march")) as run:
        own = Station(run, 4)
        np.testing.assert_array_equal(own.journal_y, run.station_y[:, 3])
        part = slice(-20, None)
        np.testing.assert_array_equal(own.values("journal_z", part), run.station_z[part, 3])
        assert own["equilibrium/journal_y"] == run["equilibrium/station_y"][3]
        assert own.dimensions("journal_y") == 1
        assert "pad_tilt" not in own
        assert own.title.endswith(", station 4")
        for wrong in (0, 10):
            with pytest.raises(tiltpad.NotInRunError, match="stations are 1 to 9"):
                Station(run, wrong)


@pytest.mark.parametrize("plot", DRAWN)
def test_plots_of_stations(aero, tmp_path, plot):
    picture = tmp_path / "picture.png"
    assert command.main([plot, str(aero(DRAWN[plot])), "--station", "4", "-o", str(picture)]) == 0
    assert picture.stat().st_size > 1000


def test_a_branch_at_stations(aero):
    """The highest values of two stations, named at the axes and in the legend."""
    with tiltpad.read(aero("branch")) as run:
        fig = figures.branch([Station(run, 4), Station(run, 6)])
        upper = fig.axes[0].get_lines()[0]
        np.testing.assert_allclose(upper.get_ydata(), 1e6 * run.station_y_max[:, 3])
        assert "shaft" in fig.axes[0].get_ylabel()
        words = [text.get_text() for legend in fig.legends for text in legend.get_texts()]
        assert {"station 4", "station 6"} <= set(words)


@pytest.mark.parametrize(
    ("plot", "task", "words"),
    [
        ("branch", "branch", "choose stations of its shaft by --station (1 to 9)"),
        ("poincare", "march", "choose stations of its shaft by --station (1 to 9)"),
        ("orbit", "march", "of its shaft there are machine, stations, shaft, shapes, branch,"),
        ("coefficients", "coefficients", "of its shaft there are machine, stations"),
        ("movie", "march", "of its shaft there are machine, stations"),
    ],
)
def test_what_a_machine_without_films_has_not(aero, capsys, plot, task, words):
    """One line that names what works."""
    assert command.main([plot, str(aero(task))]) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert f"{plot}: none of its bearings has a film; " in said
    assert words in said


def test_pivots_are_not_told_where_there_are_none(aero, tmp_path):
    """Nothing of a machine without pads speaks of their pivots."""
    page = tmp_path / "page.html"
    assert command.report([str(aero("coefficients")), "-o", str(page)]) == 0
    text = page.read_text().partition("<pre>")[0]
    assert "whirl of the shaft" in text
    assert "The shaft is stable: least logarithmic decrement" in text
    assert "locked" not in text
    with tiltpad.read(aero("coefficients")) as run:
        assert "pivots" not in figures.shapes(run).get_suptitle()
