"""What pictures say: colours and dashes, bearings, remarks, numbers; the bearing itself and its movie."""

import copy
from types import SimpleNamespace

import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad
from matplotlib import animation
from PIL import Image
from tiltpad import command, figures, units
from tiltpad.calculate import differences, signals
from tiltpad.draw import bearing, branches, layout, orbits, overview, vibrations
from tiltpad.running import resolved

pytestmark = pytest.mark.usefixtures("quick_pictures")


def with_input(run, **values):
    """The same result with another input: {"bearing": {"assembled_clearance": ...}}."""
    other = tiltpad.read(run.path)
    other.input = copy.deepcopy(run.input)
    for group, own in values.items():
        other.input[group].update(own)
    # nothing bends or expands
    other.in_operation = other.input
    return other


def test_many_runs_have_colours_along_a_scale(run):
    runs = [with_input(run("none"), rotor={"unbalance": k / 1000}) for k in range(9)]
    assert len(set(layout.colors(runs))) == 9
    fig = figures.orbit(runs)
    bar = fig.axes[-1]
    assert (bar.get_ylabel(), bar.get_ylim()) == ("unbalance (kg m)", (0, 0.008))
    assert [text.get_text() for text in fig.legends[0].get_texts()] == ["orbit", "equilibrium"]
    names = [run("none")] * 9
    assert len(figures.equilibrium(names).legends[0].get_texts()) == 9
    assert len(set(layout.DASHES)) >= 9


def test_what_many_runs_differ_in_is_found_once(run, monkeypatch):
    """Otherwise a picture of 200 runs takes minutes."""
    calls = []
    varied = differences.varied
    monkeypatch.setattr(differences, "varied", lambda inputs: calls.append(len(inputs)) or varied(inputs))
    figures.equilibrium([with_input(run("none"), rotor={"unbalance": k / 1000}) for k in range(9)])
    assert calls == [9]


def test_labels_of_special_points_do_not_overlap():
    _, ax = plt.subplots()
    ax.plot([0, 100], [0, 10])
    marked = [(50, 5, "PD"), (51, 5.2, "LP"), (51, 8, "LP"), (52, 5, "PD")]
    assert branches.apart(marked, ax) == [(50, 5.2, "PD, LP"), (51, 8, "LP")]
    plt.close()


def test_a_legend_has_as_many_columns_as_fit():
    texts = ["Pump bearing 5 pads", "4 pads", *(f"pad {k}" for k in range(1, 6))]
    assert [layout.columns_of(texts, width) for width in (20, 54, 200)] == [1, 3, 7]


def test_runs_of_different_bearings_have_their_own_circles(run):
    fig = figures.orbit([run("four"), run("none"), run("lugre")])
    whole = fig.axes[0], fig.axes[2]
    pads = [sum(type(each).__name__ == "Arc" for each in ax.patches) for ax in whole]
    assert pads == [4, 2]
    assert len(fig.axes[1].get_lines()) == 2
    assert len(fig.axes[3].get_lines()) == 4
    runs = [with_input(run("none"), bearing={"assembled_clearance": k * 1e-5}) for k in range(5, 11)]
    assert len(orbits.bearings(runs)) == 6
    fig = figures.orbit(runs)
    radii = [each.radius for each in fig.axes[0].patches if type(each).__name__ == "Circle"]
    np.testing.assert_allclose(radii, np.arange(50, 101, 10))
    assert "pads are left out" in fig.get_supxlabel()


def test_loops_of_pads_that_only_some_runs_have(run):
    fig = figures.hysteresis([run("lugre"), run("four")])
    assert [len(ax.get_lines()) for ax in fig.axes] == [2, 2, 1, 1]
    assert len(figures.runup([run("none"), run("four")]).axes[2].get_lines()) == 6


def test_the_legend_has_the_lines_of_the_curves(run):
    runs = [with_input(run("none"), rotor={"unbalance": k / 1000}) for k in range(3)]
    fig = figures.size(runs)
    drawn = [line.get_linestyle() for line in fig.axes[0].get_lines()]
    assert [line.get_linestyle() for line in fig.legends[0].get_lines()] == drawn == ["-", "--"]


def test_an_incomplete_run_says_why(changed):
    def stopped(file):
        file.attrs.modify("complete", 0)
        file.attrs["reason"] = "film of pad 2 closed"

    with pytest.warns(tiltpad.IncompleteRunWarning, match="film of pad 2 closed"):
        case = tiltpad.read(changed("none", stopped))
    why = "ended at 0.06 s of 0.06 s: film of pad 2 closed"
    assert figures.waveform([case]).get_supxlabel().replace("\n", " ") == f"incomplete, {why}"
    assert list(overview.ended(case)) == [(f"Incomplete run, {why}.", True)]


def test_a_runup_names_its_peak(made):
    """A motion whose amplitude over the speed is that of an oscillator, and whose mean drifts by more."""
    low, high, top = (each * np.pi / 30 for each in (1500, 6500, 4000))

    def amplitude(time):
        ratio = (low + (high - low) * time / 4) / top
        return 1e-6 * ratio**2 / np.hypot(1 - ratio**2, ratio / 5)

    case = made(
        "runup",
        4,
        interval=2e-4,
        journal_y=lambda time, angle: 1e-5 * time + amplitude(time) * np.cos(angle - 1),
        journal_z=lambda time, angle: amplitude(time) * np.cos(angle - 1 - np.pi / 2),
    )
    speed, size = signals.swing(case, "journal_y")
    known = 2 * amplitude((speed - low) / (high - low) * 4)
    # in the three revolutions of a span the amplitude rises by as much as that
    np.testing.assert_allclose(size, known, atol=np.abs(np.diff(known)).max())
    fig = figures.orders([case])
    y, _, phase = fig.axes
    assert y.get_yscale() == "linear"
    assert figures.orders([case], scale="log").axes[0].get_yscale() == "log"
    words = y.get_title(loc="right")
    assert words.startswith("peak 5.0")
    speed, factor = (float(word) for word in words.replace("rpm, AF", "").split()[-2:])
    assert (speed, factor) == (pytest.approx(4040, abs=30), pytest.approx(5, rel=0.05))
    first, second = (line.get_ydata() for line in phase.get_lines())
    np.testing.assert_allclose(second - first, 90, atol=1)
    np.testing.assert_allclose(first, np.degrees(1), atol=1)
    # a run that moves more comes second, and is drawn whole
    larger = made("runup", 4, interval=2e-4, journal_y=lambda time, angle: 1e-4 * np.cos(angle))
    assert figures.orders([case, larger]).axes[0].get_ylim() == (0, pytest.approx(105, rel=1e-3))
    assert "from where the unbalance points along +y" in fig.get_supxlabel().replace("\n", " ")
    assert "y: peak 10." in figures.size([case]).get_supxlabel()
    assert "Peaks of the first order" in tiltpad.report.peaks(case)


def test_a_band_of_half_the_order_is_no_sawtooth(made):
    case = made("none", 0.6, journal_y=lambda time, angle: np.cos(0.48 * angle))
    _, low, high = signals.envelope(case, "journal_y")
    assert len(high) == 65
    assert high[1:-1].min() > 0.99
    assert low[1:-1].max() < -0.99


@pytest.mark.parametrize(
    ("quantity", "values", "words"),
    [
        ("work", [2.38e-3, 2.99e-3], "2.38, 2.99 mJ"),
        ("work", [9.86e-9, 0], "9.86, 0 nJ"),
        ("work", [1e-3, 2e-3, 4e-3, 3e-3, np.nan], "1.00 to 4.00 mJ"),
        ("work", [3.5e-9, 2.5e-3], "0.00, 2.50 mJ"),
        ("work", [-3.5e-9, 2.5e-3], "0.00, 2.50 mJ"),
        ("pressure", [3.9e3], "3.90 kPa"),
        ("share", [0.123], "12.3 %"),
        ("share", [1e-7], "1.00×10⁻⁵ %"),
    ],
)
def test_numbers_in_words(quantity, values, words):
    assert units.in_words(quantity, values) == words


def test_values_of_a_parameter_have_the_unit_of_its_axis():
    differences_of_radii = np.array([1e-5, 1e-4])
    assert vibrations.in_unit("radius_difference", 1e-5, differences_of_radii) == "radius difference 10 µm"


def test_ticks_have_no_offsets():
    with plt.style.context(tiltpad.plots.STYLE):
        fig, ax = plt.subplots()
        ax.plot([0, 1], [3.74, 3.74 + 1e-9])
        layout.spread(fig)
        fig.draw_without_rendering()
    assert ax.yaxis.get_offset_text().get_text() == ""
    assert np.ptp(ax.get_ylim()) == pytest.approx(2e-4 * 3.74, rel=1e-3)


def test_a_case_as_the_program_completes_it(result, run, tmp_path, monkeypatch, program):
    monkeypatch.setenv("TILTPAD", program)
    case = result("offset").with_suffix(".nml")
    assert resolved(case) == run("offset").input
    varied = tmp_path / "varied.nml"
    varied.write_text(case.read_text() + "&sweep operation%speed_rpm=4000,5000 /\n")
    assert resolved(varied)["operation"]["speed_rpm"] == 4000


def test_the_bearing_of_a_case(result, run, tmp_path, monkeypatch, program):
    """Angles grow against the rotation; the leading edge of a pad is at its larger angle."""
    monkeypatch.setenv("TILTPAD", program)
    output = tmp_path / "a.png"
    assert command.main(["bearing", str(result("four").with_suffix(".nml")), "-o", str(output)]) == 0
    assert (matplotlib.image.imread(output)[..., :3].min(axis=2) < 0.9).mean() > 0.05
    ax = bearing.bearing(run("four")).axes[0]
    places = {text.get_text(): np.array(text.get_position()) for text in ax.texts}
    for angle in (-45, 225, 45, 135):
        away = places[f"{angle}°"]
        assert np.degrees(np.arctan2(*away[::-1])) % 360 == pytest.approx(angle % 360)
    ahead, behind = (np.arctan2(*places[edge][::-1]) for edge in ("leading\nedge", "trailing\nedge"))
    assert ahead > behind
    np.testing.assert_allclose(bearing.load(run("four").input), [-2000 * 9.81, 0])
    (z_tail, y_tail), (z_head, y_head) = next(
        each._posA_posB for each in ax.patches if type(each).__name__ == "FancyArrowPatch"
    )
    assert z_head * y_tail - z_tail * y_head > 0
    words = ax.figure.axes[1].texts[0].get_text()
    assert "4 pads" in words
    assert "the equilibrium" in words


def test_pads_and_journal_of_the_picture_leave_the_film(run):
    """The distance of a pad's surface from the journal is the film, enlarged."""
    case = run("four")
    state = bearing.geometry.at_time(case, 0.01)
    drawing = bearing.Drawing(plt.subplots()[1], case.input, state)
    inner = drawing.pads[2].get_xy()[:91] - np.array(drawing.journal.center)
    film = (np.hypot(*inner.T) - 1) * case.clearance / bearing.CLEARANCE
    least = tiltpad.pressure(case, 0.01).min_film_thickness[2]
    assert film.min() == pytest.approx(least, rel=1e-3)


def test_a_movie(result, tmp_path, monkeypatch, capsys):
    output = tmp_path / "a.gif"
    assert command.main(["movie", str(result("four")), "--last", "0.1", "-o", str(output)]) == 0
    with Image.open(output) as picture:
        assert picture.n_frames == 6
        assert picture.info["loop"] == 0
    monkeypatch.setattr(animation, "FFMpegWriter", SimpleNamespace(isAvailable=lambda: False))
    for name, message in (("a.mp4", "needs the program ffmpeg"), ("a.png", "must end in .gif or .mp4")):
        assert command.main(["movie", str(result("four")), "-o", str(tmp_path / name)]) == 1
        said = capsys.readouterr().err
        assert message in said
        assert said.count("\n") == 1


def test_the_report_of_a_study(runs_of, tmp_path, capsys):
    speeds = {"operation%speed_rpm": [3000, 4000, 6500]}
    folder = runs_of(tmp_path / "speeds", "&case task='equilibrium' /", speeds, (2,))
    tiltpad.collect(folder, tmp_path / "speeds.h5")
    assert command.report([str(tmp_path / "speeds.h5"), "-o", str(tmp_path / "a.html")]) == 0
    page = (tmp_path / "a.html").read_text()
    assert "3 runs, 2 of them done. speed: 3000, 4000, 6500." in page
    failed = "<tr><td>2</td><td>4000</td><td>failed in its numerics</td><td>no equilibrium found</td></tr>"
    assert failed in page
    assert '<img alt="equilibrium_min_film_thickness"' in page
    assert "<td>1</td><td>3000</td><td>yes</td>" in page
    assert 'name="viewport"' in page
