"""Pictures: lines and labels, and the files and messages of the command."""

import os
import re
import subprocess
import sys
import zlib
from pathlib import Path
from xml.etree import ElementTree

import h5py
import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad
from tiltpad import command
from tiltpad.draw import layout

pytestmark = pytest.mark.usefixtures("quick_pictures")

#: Plots by the runs that they need; the others have tests of their own.
PLOTS = [
    plot
    for plot in command.PLOTS
    if plot
    not in (
        "equilibrium",
        "multipliers",
        "pressure",
        "film",
        "turbulence",
        "bearing",
        "movie",
        "study",
        "branch",
        "chart",
        "basin",
        *command.OF_EITHER,
        *command.SAMPLES,
        *command.OF_MACHINES,
    )
]
STEADY = [plot for plot in PLOTS if plot not in ("orders", "waterfall")]
RUNUP = [plot for plot in PLOTS if plot != "spectrum"]


@pytest.fixture(scope="module")
def longer(tiltpad, tmp_path_factory):
    """A run-up of enough revolutions for order tracks."""
    folder = tmp_path_factory.mktemp("longer")
    (folder / "a.nml").write_text(
        "&operation speed_rpm=4000, final_speed_rpm=6500, duration=0.5 /\n&friction model='lugre' /\n"
        "&output samples_per_revolution=90 /\n"
    )
    tiltpad("--quiet", "a.nml", cwd=folder, status=0)
    return folder / "a.h5"


def test_an_orbit_has_equal_axes_and_y_up(run):
    case = run("lugre")
    ax = tiltpad.plots.orbit(case)
    assert ax.get_aspect() == 1
    path = ax.get_lines()[0].get_xydata()
    np.testing.assert_allclose(path[:, 0], 1e6 * case.journal_z[-361:])
    np.testing.assert_allclose(path[:, 1], 1e6 * case.journal_y[-361:])
    assert ax.get_ylim()[0] < ax.get_ylim()[1]
    assert ax.get_xlabel() == "journal $z$ (µm)"
    assert ax.get_ylabel() == "journal $y$ (µm)"
    rest = ax.get_lines()[1].get_xydata()[0]
    np.testing.assert_allclose(rest, 1e6 * np.array([case.journal_z[0], case.journal_y[0]]))


def test_multipliers_stand_around_the_unit_circle(run):
    case = run("periodic")
    ax = tiltpad.figures.multipliers([case]).axes[0]
    points = ax.get_lines()[0].get_xydata()
    np.testing.assert_array_equal(points[:, 0], case["periodic/multiplier_real"])
    np.testing.assert_array_equal(points[:, 1], case["periodic/multiplier_imag"])
    assert ax.patches[0].get_radius() == 1
    assert ax.get_aspect() == 1
    assert min(ax.get_xlim()[1], ax.get_ylim()[1]) > 1
    with pytest.raises(tiltpad.NotInRunError):
        tiltpad.figures.multipliers([run("lugre")])


def test_the_orbit_turns_as_the_arrow_of_rotation_does(run):
    """From +y towards +z: clockwise with y up and z to the right."""
    path = tiltpad.plots.orbit(run("lugre")).get_lines()[0].get_xydata()
    assert tiltpad.loop_area(path[:, 0], path[:, 1]) > 0
    ax = tiltpad.plots.clearance(run("lugre"))
    arrow = next(each for each in ax.patches if type(each).__name__ == "FancyArrowPatch")
    (x_tail, y_tail), (x_head, y_head) = arrow._posA_posB
    assert x_head * y_tail - x_tail * y_head > 0


def test_the_clearance_circle(run):
    ax = tiltpad.plots.clearance(run("lugre"))
    circle = next(each for each in ax.patches if type(each).__name__ == "Circle")
    assert circle.radius == pytest.approx(80)
    pads = [each for each in ax.patches if type(each).__name__ == "Arc"]
    middles = [(each.theta1 + each.theta2) / 2 for each in pads]
    np.testing.assert_allclose(middles, [-45, 225])
    assert pads[0].theta2 - pads[0].theta1 == pytest.approx(69.3)


def test_fixed_pads_leave_room_within_their_bores(run, tiltpad_set):
    """The arcs of both bores meet the circle of radius c_r where the pads are anchored, and lie around it."""
    ax = tiltpad.plots.clearance(tiltpad_set("none", "pads%motion='fixed'"))
    assert not [each for each in ax.patches if type(each).__name__ == "Circle"]
    bores = [each for each in ax.patches if type(each).__name__ == "Arc" and each.get_linewidth() < 1]
    for arc, angle in zip(bores, np.radians([-45, 225]), strict=True):
        z, y = arc.center
        assert arc.width == arc.height == pytest.approx(200)
        assert (z, y) == pytest.approx((-20 * np.cos(angle), -20 * np.sin(angle)), abs=1e-9)


def test_pictures_of_fixed_pads(run, result, tmp_path, capsys):
    from tiltpad import figures

    for plot in ("orbit", "equilibrium", "size", "poincare", "waveform", "spectrum", "runup", "pressure"):
        assert command.main([plot, str(result("fixed")), "-o", str(tmp_path / "a.png")]) == 0
        assert 0.01 < drawn(tmp_path / "a.png") < 0.7
    labels = [ax.get_ylabel() for ax in figures.waveform([run("fixed")]).axes]
    assert labels[2:] == ["minimum film\nthickness (µm)", "maximum\npressure (MPa)"]
    assert len(figures.runup([run("fixed"), run("lugre")]).axes) == 3
    assert len(figures.runup([run("lugre")]).axes) == 4
    assert figures.poincare([run("fixed")]).axes[1].get_xlabel() == "journal $y$ (µm)"
    for plot in ("hysteresis", "friction", "sticking"):
        capsys.readouterr()
        assert command.main([plot, str(result("fixed")), "-o", str(tmp_path / "b.png")]) == 1
        assert capsys.readouterr().err.count("\n") == 1


def test_axes_that_are_given_are_used_and_returned(run):
    _, ax = plt.subplots()
    case = run("lugre")
    for draw in (
        tiltpad.plots.orbit,
        tiltpad.plots.hysteresis,
        tiltpad.plots.waveform,
        tiltpad.plots.history,
    ):
        before = len(ax.get_lines())
        assert draw(case, ax, color="red") is ax
        assert len(ax.get_lines()) > before
        assert ax.get_lines()[before].get_color() == "red"


def test_a_spectrum_leaves_the_mean_out(run):
    case = run("lugre")
    line = tiltpad.plots.spectrum(case, name="journal_y").get_lines()[0]
    assert np.isnan(line.get_ydata()[0])
    assert np.nanmax(line.get_ydata()) == pytest.approx(1e6 * case["spectrum/journal_y"][1:].max())
    ax = tiltpad.plots.full_spectrum(case, orders=4)
    np.testing.assert_allclose(ax.get_xlim(), np.array([-4, 4]) * 6500 / 60)
    low, high = ax.get_ylim()
    assert 1e-6 * high < low < high


def test_units_and_values_of_the_others(run):
    case = run("lugre")
    ax = tiltpad.plots.hysteresis(case, pad=2)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("tilt (mrad)", "friction moment (N m)")
    np.testing.assert_allclose(ax.get_lines()[0].get_xdata(), 1e3 * case.pad_tilt[-361:, 1])
    ax = tiltpad.plots.waveform(case, name="pad_tilt_rate", last=2, pad=1)
    assert ax.get_ylabel() == "tilt rate (mrad/s)"
    np.testing.assert_allclose(ax.get_xlim(), (0, 2))
    ax = tiltpad.plots.history(run("runup"), name="journal_z")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time (s)", "journal $z$ (µm)")


def test_pictures_of_the_pivots(run):
    case = run("lugre")
    ax = tiltpad.plots.friction_coefficient(case, pad=2)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("sliding velocity (mm/s)", "friction coefficient")
    velocity, coefficient = tiltpad.friction_coefficient(case, 2)
    np.testing.assert_allclose(ax.get_lines()[0].get_xydata(), np.column_stack([1e3 * velocity, coefficient]))
    slides, sticks = tiltpad.plots.sticking(case, pad=1).get_lines()
    stuck = tiltpad.sticking(case, 1, 2)
    np.testing.assert_array_equal(np.isfinite(sticks.get_ydata()), stuck)
    np.testing.assert_array_equal(sticks.get_ydata()[stuck], slides.get_ydata()[stuck])
    assert sticks.get_linewidth() > slides.get_linewidth()


def test_a_poincare_section_lies_on_the_path(run):
    ax = tiltpad.plots.poincare(run("lugre"), last=5)
    path, points = (line.get_xydata() for line in ax.get_lines())
    assert ax.get_aspect() == 1
    assert points.shape == (5, 2)
    assert np.abs(path - points[-1]).max(axis=1).min() < 0.1
    ax = tiltpad.plots.poincare(run("lugre"), last=5, names=tiltpad.plots.PHASE, pad=2)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("tilt (mrad)", "tilt rate (mrad/s)")


def test_a_ring_joins_the_points_of_a_torus(made, opened, tmp_path):
    from tiltpad import figures

    def y(time, angle):
        return 1e-6 * (20 + 3 * np.cos(angle) + 5 * np.cos(0.53 * angle))

    def z(time, angle):
        return 1e-6 * 4 * np.sin(0.53 * angle)

    case = made("lugre", 0.5, journal_y=y, journal_z=z)
    assert len(figures.poincare([case]).axes[0].get_lines()) == 2
    torus = {"quasi_periodic": 1, "rotation_number": 0.53, "ring_y": 1e-5, "ring_z": 8e-6}
    path = tmp_path / "torus.h5"
    path.write_bytes(Path(case.path).read_bytes())
    with h5py.File(path, "r+") as file:
        for name, value in torus.items():
            file["summary"].require_dataset(name, (), "f8")[()] = value
    left, right = figures.poincare([opened(path)]).axes
    assert left.get_title() == "journal: rotation number 0.530000,\nring of 8 by 10 µm"
    _, points, ring = (line.get_xydata() for line in left.get_lines())
    assert len(points) + 1 == len(ring)
    # each way between neighbours is short
    assert np.hypot(*np.diff(ring, axis=0).T).max() < 5
    assert np.hypot(*np.diff(points, axis=0).T).max() > 8
    assert len(right.get_lines()) == 3


def test_orbit_size_over_what_differs(run, result, tiltpad_set):
    from tiltpad import figures

    more = tiltpad_set("none", "rotor%unbalance=0.02")
    ax = figures.size([more, run("none")]).axes[0]
    y, z = (line.get_xydata() for line in ax.get_lines())
    np.testing.assert_allclose(y[:, 0], [0.01, 0.02])
    assert y[0, 1] == pytest.approx(1e6 * tiltpad.orbit_size(run("none"))[0])
    assert z[1, 1] == pytest.approx(1e6 * tiltpad.orbit_size(more)[1])
    assert ax.get_xlabel() == "unbalance (kg m)"
    bars = figures.size([run("none"), run("bengisu")]).axes[0]
    assert [text.get_text() for text in bars.get_yticklabels()] == ["no friction", "Bengisu-Akay"]
    assert len(bars.patches) == 4


def test_orbit_size_of_a_runup_is_over_its_speed(longer):
    with tiltpad.read(longer) as case:
        x, y = tiltpad.plots.orbit_size(case).get_lines()[0].get_xydata().T
        assert 4000 < x[0] < x[-1] < 6500
        assert y[-1] == pytest.approx(1e6 * tiltpad.orbit_size(case)[0], rel=0.05)


def test_orders_of_a_runup(longer):
    with tiltpad.read(longer) as case:
        line = tiltpad.plots.order_track(case, name="pad_tilt", pad=2).get_lines()[0]
        speed, amplitude, phase = tiltpad.order_track(case, "pad_tilt", 1, 2)
        np.testing.assert_allclose(line.get_xdata(), speed * 30 / np.pi)
        np.testing.assert_allclose(line.get_ydata(), 1e3 * amplitude)
        ax = tiltpad.plots.order_phase(case)
        assert ax.get_ylabel() == "phase lag (deg)"
        ax = tiltpad.plots.waterfall(case)
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("speed (rpm)", "frequency (Hz)")
        assert ax.figure.axes[1].get_ylabel() == "journal $y$ (µm)"
        assert tiltpad.plots.waterfall(case, by="order").get_ylabel() == "order"
        whole, near = (tiltpad.plots.waterfall(case, decades=k).collections[0].norm for k in (3, 1))
        assert (whole.vmax / whole.vmin, near.vmax / near.vmin) == pytest.approx((1e3, 10))


def test_every_series_can_be_drawn_and_has_a_unit(run):
    case = run("lugre")
    series = [name for name in case.file if getattr(case.file[name], "shape", ())[:1] == (case.samples,)]
    assert len(series) == 19
    for name in series:
        ax = tiltpad.plots.waveform(case, name=name, last=1)
        assert re.search(r" \(.+\)$", ax.get_ylabel()), name
        plt.close(ax.figure)


def test_a_history_of_many_revolutions_is_a_light_band(run, monkeypatch):
    case = run("lugre")
    monkeypatch.setattr(tiltpad.plots, "BAND_FROM", 3)
    ax = tiltpad.plots.history(case, name="journal_y")
    low, high = (line.get_ydata() for line in ax.get_lines())
    assert len(low) == len(high) == 6
    assert low.min() == pytest.approx(1e6 * case.journal_y.min())
    assert high.max() == pytest.approx(1e6 * case.journal_y.max())
    assert len(tiltpad.plots.history(case, name="pad_tilt").get_lines()) == 4


def test_a_runup_shows_its_speed(run):
    from tiltpad import figures

    fig = figures.runup([run("runup")])
    fig.draw_without_rendering()
    (top,) = fig.axes[0].child_axes
    assert top.get_xlabel() == "speed (rpm)"
    np.testing.assert_allclose(top.get_xlim(), (1500, 6500), rtol=5e-3)
    assert not figures.runup([run("lugre")]).axes[0].child_axes


def test_one_run_is_named_by_its_title(run):
    from tiltpad import figures

    assert figures.orbit([run("lugre")]).legends[0].get_title().get_text() == "Steady, it's LuGre"
    assert figures.hysteresis([run("lugre")]).get_suptitle() == "Steady, it's LuGre"


def test_runs_are_told_apart(run):
    from tiltpad import figures

    runs = [run("none"), run("bengisu")]
    fig = figures.orbit(runs)
    texts = [text.get_text() for text in fig.legends[0].get_texts()]
    assert texts == ["no friction", "Bengisu-Akay", "orbit", "equilibrium"]
    colours = {fig.axes[1].get_lines()[k].get_color() for k in (0, 2)}
    assert len(colours) == 2
    assert layout.labels([run("none"), run("none")])[0].endswith("none.h5")


@pytest.mark.parametrize(
    ("plot", "case_name"), [*((plot, "lugre") for plot in STEADY), *((plot, "runup") for plot in RUNUP)]
)
def test_nothing_is_cut_off(run, longer, plot, case_name):
    """Every text lies within the picture, and no two tick labels of an axis lie on each other."""
    from tiltpad import figures

    with plt.style.context(tiltpad.plots.STYLE), tiltpad.read(longer) as rising:
        fig = figures.FIGURES[plot]([run(case_name) if case_name == "lugre" else rising])
        fig.draw_without_rendering()
    page = fig.bbox.padded(0.5)
    panels = [ax.get_tightbbox() for ax in fig.axes]
    heading = fig.legends[0] if fig.legends else fig.get_suptitle() and fig._suptitle
    above = [heading.get_window_extent()] if heading else []
    untitled = case_name == "runup" and plot in ("orbit", "hysteresis", "friction", "waterfall")
    assert bool(above) != untitled
    assert not any(box.overlaps(panel) for box in above for panel in panels)
    assert not (fig.legends and fig.get_suptitle())
    for ax in [*fig.axes, *(child for each in fig.axes for child in each.child_axes)]:
        box = ax.get_tightbbox()
        assert page.x0 <= box.x0 < box.x1 <= page.x1
        assert page.y0 <= box.y0 < box.y1 <= page.y1
        for axis in (ax.xaxis, ax.yaxis):
            ticks = [t for t in axis.get_majorticklabels() if t.get_visible() and t.get_text()]
            low, high = sorted(axis.get_view_interval())
            boxes = [
                t.get_window_extent() for t in ticks if low <= t.get_position()[axis is ax.yaxis] <= high
            ]
            boxes.sort(key=lambda each: (each.x0, each.y0))
            assert not any(a.overlaps(b) for a, b in zip(boxes[:-1], boxes[1:], strict=True))


def drawn(path: Path) -> float:
    """Share of a picture that is drawn on (PNG), or number of line pieces in it; checks the format."""
    data = path.read_bytes()
    if path.suffix == ".png":
        assert data.startswith(b"\x89PNG\r\n\x1a\n")
        pixels = matplotlib.image.imread(path)[..., :3]
        assert min(pixels.shape[:2]) > 200
        return float((pixels.min(axis=2) < 0.9).mean())
    if path.suffix == ".pdf":
        assert data.startswith(b"%PDF-")
        assert data.rstrip().endswith(b"%%EOF")
        streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", data, re.DOTALL)
        texts = [zlib.decompress(each) for each in streams if each[:1] == b"x"]
        return float(sum(len(re.findall(rb" (?:l|c)\s", each)) for each in texts))
    root = ElementTree.fromstring(data)
    assert root.tag.endswith("}svg")
    curves = [each for each in root.iter() if each.tag.endswith("}path") and each.get("clip-path")]
    return float(sum(len(each.get("d").split("L")) for each in curves))


@pytest.mark.parametrize("plot", PLOTS)
def test_the_command_draws_every_plot(result, longer, tmp_path, monkeypatch, plot):
    monkeypatch.chdir(tmp_path)
    file = result("lugre") if plot in STEADY else longer
    assert command.main([plot, str(file)]) == 0
    assert [path.name for path in tmp_path.iterdir()] == [f"{file.stem}-{plot}.png"]
    assert 0.01 < drawn(tmp_path / f"{file.stem}-{plot}.png") < 0.7


@pytest.mark.parametrize("plot", PLOTS)
def test_every_plot_lays_runs_over_each_other(run, opened, longer, plot):
    """Both are in the picture: each as a colour, a panel or a bar."""
    from tiltpad import figures

    runs = [run("lugre"), run("tilting")] if plot in STEADY else [opened(longer), opened(longer)]
    with plt.style.context(tiltpad.plots.STYLE):
        one, both = (figures.FIGURES[plot](part, None, 2) for part in (runs[:1], runs))

    def pieces(fig):
        return sum(len(ax.lines) + len(ax.patches) + len(ax.collections) for ax in fig.axes)

    assert pieces(both) > pieces(one)


@pytest.mark.parametrize("form", ["pdf", "svg", "PNG"])
def test_the_command_writes_every_format(result, tmp_path, form):
    output = tmp_path / f"picture.{form}"
    assert command.main(["waveform", str(result("lugre")), "-o", str(output), "--last", "2"]) == 0
    if form == "PNG":
        assert output.read_bytes().startswith(b"\x89PNG")
    else:
        assert drawn(output) > 500


def test_the_command_draws_several_files(result, tmp_path):
    files = [str(result(case_name)) for case_name in ("lugre", "bengisu")]
    output = tmp_path / "both.svg"
    for given, second in ((files, True), (files[:1], False)):
        assert command.main(["hysteresis", *given, "--pad", "1", "-o", str(output)]) == 0
        assert "stroke: #0072b2" in output.read_text()
        assert ("stroke: #d55e00" in output.read_text()) == second


def test_the_installed_command_needs_no_display(result, tmp_path):
    program = Path(sys.executable).with_name("tiltpad-plot")
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "MPLBACKEND")}
    done = subprocess.run(
        [program, "orbit", result("tilting")], cwd=tmp_path, env=environment, text=True, capture_output=True
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert drawn(tmp_path / "tilting-orbit.png") > 0.01
    done = subprocess.run([program, "--help"], text=True, capture_output=True)
    assert done.returncode == 0
    assert all(plot in done.stdout for plot in PLOTS)
    assert all(option in done.stdout for option in ("--output", "--last", "--pad"))


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (["orbit", "missing.h5"], 3, "missing.h5: no such file"),
        (["orbit", "text.h5"], 3, "text.h5: not an HDF5 file"),
        (["orbit", "none", "-o", "a.bmp"], 1, "a.bmp: the name must end in .png, .pdf or .svg"),
        (["orbit", "none", "-o", "a"], 1, "a: the name must end in .png, .pdf or .svg"),
        (["orbit", "none", "-o", "no/such/a.png"], 3, "no/such/a.png: cannot be written: No such file"),
        (["orbit", "none", "--last", "0"], 1, "argument --last: 0: must be a positive number"),
        (["orbit", "none", "--last", "two"], 1, "argument --last: two: must be a positive number"),
        (["orbit", "none", "--pad", "3"], 1, "no pad 3 in this run: pads are 1 to 2"),
        (["friction", "none"], 1, "no friction in this run: friction model is 'none'"),
        (["sticking", "none"], 1, "no friction in this run: friction model is 'none'"),
        (["orders", "none"], 1, "no order track in this run: its speed stays the same, a run-up is needed"),
        (["waterfall", "none"], 1, "no waterfall in this run: its speed stays the same, a run-up is needed"),
        (["waterfall", "runup"], 1, "it has 6.67 shaft revolutions, and 8 are needed"),
        (["orbit", "equilibrium"], 1, "nothing was marched in time"),
        (["waveform", "none", "--pad", "3"], 1, "no pad 3 in this run: pads are 1 to 2"),
        (["hysteresis", "none"], 1, "no friction in this run: friction model is 'none'"),
        (["spectrum", "runup"], 1, "no spectrum in this run: the speed changes"),
        (["waveform", "equilibrium"], 1, "its task is 'equilibrium', nothing was marched in time"),
        (["map", "none"], 1, "map: no plot: orbit, "),
        (["orbits", "none"], 1, "orbits: no plot (did you mean orbit?): "),
        (
            ["text.h5", "orbit"],
            1,
            "a file, where the plot's name belongs: tiltpad-plot PLOT text.h5",
        ),
        (["orbit", "case.nml"], 3, "case.nml: not an HDF5 file; a case: tiltpad runs it"),
        (["orbit"], 1, "the following arguments are required: FILE"),
    ],
)
def test_errors_are_one_line_and_a_status(result, tmp_path, monkeypatch, capsys, arguments, status, message):
    monkeypatch.chdir(tmp_path)
    Path("text.h5").write_text("no result\n")
    Path("case.nml").write_text("! a case\n&case /\n")
    cases = ("none", "runup", "equilibrium")
    given = [str(result(each)) if each in cases else each for each in arguments]
    try:
        found = command.main(given)
    except SystemExit as stop:
        found = stop.code
    said = capsys.readouterr()
    assert found == status
    assert said.out == ""
    assert said.err.startswith("tiltpad-plot: error: ")
    assert said.err.count("\n") == 1
    assert message in said.err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["case.nml", "text.h5"]


def test_an_incomplete_run_is_drawn_with_a_warning(changed, tmp_path, capsys):
    path = changed("none", lambda file: file.attrs.modify("complete", 0))
    output = tmp_path / "a.png"
    assert command.main(["orbit", str(path), "-o", str(output)]) == 0
    said = capsys.readouterr().err
    assert said.startswith("tiltpad-plot: warning: ")
    assert said.count("\n") == 1
    assert drawn(output) > 0.01
