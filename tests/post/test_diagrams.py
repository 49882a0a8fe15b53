"""Diagrams of studies: lines and labels, and the messages about what cannot be drawn."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad
from sampled import write_study
from tiltpad import command, diagrams, figures
from tiltpad.calculate import selection

pytestmark = pytest.mark.usefixtures("quick_pictures")

CASE = "&operation duration=0.04 / &output samples_per_revolution=40 /"
SPEEDS, UNBALANCES = [3000, 4000, 6500], [0.0002, 0.002, 0.02]
STUDIES = {
    "speed": ({"operation%speed_rpm": SPEEDS}, (2,)),
    "grid": ({"operation%speed_rpm": [4000, 6500], "rotor%unbalance": UNBALANCES}, (6,)),
    "wide": (
        {"operation%speed_rpm": range(4000, 5201, 200), "rotor%unbalance": [k / 1000 for k in range(1, 8)]},
        (),
    ),
    "text": ({"friction%model": ["none", "lugre"]}, ()),
    "both": ({"friction%model": ["none", "lugre"], "operation%speed_rpm": SPEEDS}, ()),
}


@pytest.fixture(scope="module")
def study(runs_of, tmp_path_factory):
    """study("grid"): that study, opened; of `wide` the runs are copies of one."""
    folder, opened = tmp_path_factory.mktemp("studies"), {}

    def read(name):
        if name not in opened:
            values, failed = STUDIES[name]
            if name == "wide":
                values = {variable: list(each)[:1] for variable, each in values.items()}
            runs = runs_of(folder / name, CASE, values, failed)
            if name == "wide":
                grown(runs, *STUDIES["wide"][0].values())
            tiltpad.collect(runs, folder / f"{name}.h5")
            opened[name] = tiltpad.read_study(folder / f"{name}.h5")
        return opened[name]

    yield read
    for each in opened.values():
        each.close()


def grown(runs, speeds, unbalances):
    """A run for every pair of values, copies of the first."""
    content = (runs / "0001.h5").read_bytes()
    pairs = [(speed, unbalance) for speed in speeds for unbalance in unbalances]
    for number, (speed, unbalance) in enumerate(pairs, 1):
        path = runs / f"{number:04d}.h5"
        path.write_bytes(content)
        with h5py.File(path, "r+") as file:
            text = f"operation%speed_rpm = {speed}\nrotor%unbalance = {unbalance}"
            file.attrs.update({"run": number, "runs": len(pairs), "sweep": text})


def test_a_line_over_a_parameter(study):
    case = study("speed")
    ax = diagrams.diagram(case)
    line, mark = ax.get_lines()
    np.testing.assert_array_equal(line.get_xdata(), SPEEDS)
    np.testing.assert_allclose(line.get_ydata(), 1e6 * case.orbit_size)
    assert np.isnan(line.get_ydata()[1])
    assert mark.get_xdata() == [4000, 4000]
    assert mark.get_ydata() == [0, 1]
    assert mark.get_linestyle() != "None"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("speed (rpm)", "orbit, peak to peak (µm)")
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["not done (1)"]
    said = figures.study(case).get_supxlabel().replace("\n", " ")
    assert said == "run 2 (speed_rpm = 4000) failed in its numerics: no equilibrium found"


def test_axes_that_are_given_are_used_and_returned(study):
    _, ax = plt.subplots()
    assert diagrams.diagram(study("speed"), ax, "steps", "speed_rpm") is ax
    assert ax.get_ylabel() == "time steps"
    np.testing.assert_array_equal(ax.get_lines()[0].get_ydata()[[0, 2]], study("speed").steps[[0, 2]])


def test_a_second_parameter_is_a_line_each(study):
    case = study("grid")
    ax = diagrams.diagram(case)
    assert ax.get_xlabel() == "unbalance (kg m)"
    assert ax.get_xscale() == "log"
    slow, fast = [line for line in ax.get_lines() if len(line.get_xdata()) == len(UNBALANCES)]
    np.testing.assert_allclose(slow.get_ydata(), 1e6 * case.orbit_size[:3])
    np.testing.assert_allclose(fast.get_ydata(), 1e6 * case.orbit_size[3:])
    legend = ax.get_legend()
    assert legend.get_title().get_text() == "speed (rpm)"
    assert [text.get_text() for text in legend.get_texts()] == ["4000", "6500", "not done (1)"]
    ax = diagrams.diagram(study("both"))
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["no friction", "LuGre"]


def test_a_second_parameter_has_the_unit_of_its_size(tmp_path):
    parameters = {"clearance": np.repeat([60e-6, 90e-6], 3), "speed_rpm": np.tile([1e3, 2e3, 3e3], 2)}
    with tiltpad.read_study(write_study(tmp_path / "two.h5", parameters, {"a": np.arange(6.0)})) as made:
        legend = diagrams.diagram(made, show="a", over="speed_rpm").get_legend()
    assert legend.get_title().get_text() == "bearing clearance (µm)"
    assert [text.get_text() for text in legend.get_texts()] == ["60", "90"]


def test_a_map_over_two_parameters(study):
    case = study("grid")
    ax = diagrams.diagram(case, show="max_pressure", over="speed_rpm", kind="map")
    (mesh,) = ax.collections
    table = mesh.get_array()
    np.testing.assert_allclose(table.filled(np.nan), 1e-6 * case.max_pressure.reshape(2, 3).T)
    np.testing.assert_array_equal(table.mask.T.ravel(), ~case.done)
    assert [line.get_xydata().tolist() for line in ax.get_lines()] == [[[6500, 0.02]]]
    edges = mesh.get_coordinates()[:, 0, 1]
    np.testing.assert_allclose(edges[1:] / edges[:-1], 10)
    assert (ax.get_xscale(), ax.get_yscale()) == ("linear", "log")
    assert ax.figure.axes[1].get_ylabel() == "maximum pressure (MPa)"
    wide = diagrams.diagram(study("wide"))
    assert wide.collections
    assert (wide.get_xscale(), wide.get_yscale()) == ("linear", "linear")


def test_points_of_a_bifurcation(study):
    case = study("speed")
    ax = diagrams.diagram(case, kind="bifurcation")
    points = ax.get_lines()[0].get_xydata()
    points = points[np.isfinite(points[:, 1])]
    expected = 1e6 * case.poincare_y[case.done]
    np.testing.assert_allclose(points[:, 1], expected[np.isfinite(expected)])
    assert set(points[:, 0]) == {3000, 6500}
    assert ax.get_ylabel() == "journal $y$ (µm) once a revolution"
    assert diagrams.diagram(case, show="poincare_z").get_ylabel() == "journal $z$ (µm) once a revolution"


def test_results_of_a_pad(study):
    opened = study("both")
    ax = diagrams.diagram(opened, show="pad_max_pressure", over="speed_rpm", pad=2)
    assert ax.get_ylabel() == "maximum pressure, pad 2 (MPa)"
    drawn = np.concatenate([line.get_ydata() for line in ax.get_lines()])
    assert sorted(drawn) == pytest.approx(sorted(1e-6 * opened.pad_max_pressure[:, 1]))
    ax = diagrams.diagram(opened, show="poincare_tilt", over="speed_rpm", kind="bifurcation", pad=1)
    points = np.concatenate([line.get_ydata() for line in ax.get_lines()])
    known = opened.poincare_tilt[..., 0].ravel()
    assert np.isfinite(known).any()
    assert np.sort(points[np.isfinite(points)]) == pytest.approx(1e3 * np.sort(known[np.isfinite(known)]))


def test_a_model_without_the_result_keeps_its_place_in_the_legend(study):
    ax = diagrams.diagram(study("both"), show="friction_work", over="speed_rpm")
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert sorted(texts) == ["LuGre", "no friction: none"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"show": "pad_max_pressure"}, "show: pad_max_pressure has a value for each pad: choose one by pad"),
        ({"show": "orbit_y", "pad": 1}, "show: orbit_y is not a result of a pad of this study"),
        ({"show": "pad_tilt_size", "pad": 3}, "pad 3: must be 1 to 2, the pads of this study"),
        ({"show": "poincare_y", "kind": "bifurcation", "pad": 1}, "not Poincare points of a pad"),
    ],
)
def test_a_pad_where_there_is_none(study, options, message):
    with pytest.raises(ValueError, match=message):
        diagrams.diagram(study("both"), over="speed_rpm", **options)


def test_a_text_along_the_axis(study):
    case = study("text")
    ax = diagrams.diagram(case)
    assert [text.get_text() for text in ax.get_xticklabels()] == ["no friction", "LuGre"]
    (line,) = ax.get_lines()
    assert line.get_linestyle() == "None"
    np.testing.assert_allclose(line.get_xydata(), np.column_stack([[0, 1], 1e6 * case.orbit_size]))
    assert ax.get_xlabel() == "friction model"


def test_values_that_are_kept(study):
    ax = diagrams.diagram(study("both"), where={"model": "lugre"})
    (line,) = ax.get_lines()
    np.testing.assert_allclose(line.get_ydata(), 1e6 * study("both").orbit_size[3:])
    for spelled in ("LuGre", "LUGRE"):
        assert selection.selected(study("both"), {"model": spelled}).sum() == 3
    figure = figures.study(study("grid"), where={"speed_rpm": "6.5e3"})
    assert figure.get_suptitle() == "speed_rpm = 6.5e3"
    np.testing.assert_array_equal(figure.axes[0].get_lines()[0].get_xdata(), UNBALANCES)


@pytest.mark.parametrize(
    ("values", "evenly"),
    [
        ([1e4, 1e5, 1e6], True),
        ([1, 2, 4, 8, 16], True),
        ([1, 2, 4], False),
        ([1, 10], False),
        ([0, 10, 100], False),
        ([-100, -10, -1], False),
        ([100, 400, 700, 1000], False),
        ([1, 5, 6, 100], False),
    ],
)
def test_values_spread_in_ratio(values, evenly):
    assert diagrams.spread_in_ratio(values) is evenly


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("speed", ["--show", "nix"], "--show: nix is not a result of this study: "),
        (
            "speed",
            ["--show", "pad_tilt_size"],
            "has a value for each pad: choose one by --pad",
        ),
        ("speed", ["--show", "orbitsize"], "is not a result of this study (did you mean orbit_size?): "),
        ("speed", ["--show", "poincare_y", "--as", "lines"], "poincare_y is once a revolution: --as bifurc"),
        ("text", ["--where", "model=none2"], "no run with model = none2: there are none, lugre"),
        ("speed", ["--over", "nix"], "--over: nix is not a parameter of this study: speed_rpm"),
        (
            "speed",
            ["--as", "map"],
            "a map needs two parameters that are numbers: its parameters are ",
        ),
        ("speed", ["--as", "bifurcation", "--show", "orbit_y"], "orbit_y is not Poincare points"),
        ("speed", ["--where", "nix=1"], "--where: nix is not a parameter"),
        ("speed", ["--where", "speed_rpm=3000", "--where", "speed_rpm=4000"], "--where: one value of each"),
        ("speed", ["--last", "3"], "--last: not for the plot study"),
        ("speed", ["--where", "speed_rpm=1"], "no run with speed_rpm = 1: there are 3000, 4000, 6500"),
        ("speed", ["--where", "speed_rpm=4000", "--as", "map"], "a map needs two parameters"),
        ("speed", ["--where", "speed_rpm"], "speed_rpm: must be PARAMETER=VALUE"),
        ("speed", ["--as", "pie"], "invalid choice: 'pie'"),
        ("speed", ["--time", "1"], "--time: for the plots pressure, film, not for study"),
    ],
)
def test_what_cannot_be_drawn_is_said_in_a_line(study, tmp_path, capsys, name, options, message):
    arguments = ["study", study(name).path, *options, "-o", str(tmp_path / "a.png")]
    try:
        status = command.main(arguments)
    except SystemExit as ended:
        status = ended.code
    said = capsys.readouterr().err
    assert status == 1
    assert message in said
    assert said.count("\n") == 1
    assert not (tmp_path / "a.png").exists()


def test_options_of_a_study_are_not_for_others(result, capsys):
    assert command.main(["orbit", str(result("none")), "--as", "map"]) == 1
    assert "--as: for the plot study, not for orbit" in capsys.readouterr().err


@pytest.mark.parametrize("name", STUDIES)
def test_the_command_writes_a_picture(study, tmp_path, name):
    for options in ([], ["--as", "bifurcation", "--over", study(name).parameters[0]]):
        output = tmp_path / "a.png"
        assert command.main(["study", study(name).path, *options, "-o", str(output)]) == 0
        assert plt.imread(output).std() > 0.02


def test_a_study_of_which_nothing_is_left(runs_of, tmp_path, capsys):
    """All runs failed: results that they have are drawn, a message names a result that none has."""
    folder = runs_of(tmp_path / "a", CASE, {"operation%speed_rpm": [4000, 5000]}, (1, 2))
    tiltpad.collect(folder, tmp_path / "a.h5")
    assert command.main(["study", str(tmp_path / "a.h5"), "-o", str(tmp_path / "a.png")]) == 1
    assert "no orbit_size in this study: no run has it" in capsys.readouterr().err
    assert (
        command.main(["study", str(tmp_path / "a.h5"), "--show", "status", "-o", str(tmp_path / "a.png")])
        == 0
    )


def test_studies_over_each_other(study):
    """A colour for each, and dashes for the lines within one; different results are refused."""
    fig = figures.study([study("speed"), study("both")], over="speed_rpm")
    (ax,) = fig.axes
    named = [line for line in ax.get_lines() if not line.get_label().startswith("_")]
    assert [line.get_color() for line in named] == ["C0", "C1", "C1"]
    assert len({(line.get_color(), line.get_linestyle()) for line in named}) == 3
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert texts == ["speed", "both, no friction", "both, LuGre"]
    with pytest.raises(ValueError, match="choose by show and over"):
        figures.study([study("speed"), study("grid")])
