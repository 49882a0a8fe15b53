"""Branches over a parameter: their parts and pictures, the response along them, marches below."""

import h5py
import numpy as np
import pytest
import tiltpad
from matplotlib.colors import to_hex
from tiltpad import command
from tiltpad.calculate import basins, branches
from tiltpad.draw import branches as pictures

pytestmark = pytest.mark.usefixtures("quick_pictures")


@pytest.fixture
def turned(changed, opened):
    """A branch of nine points whose fifth is a period doubling, and a second branch that is unstable but
    for its end."""

    def edit(file):
        count = len(file["point"])
        number = np.where(np.arange(count) < 9, 1, 2)
        stable = np.where(np.arange(count) < 4, 1, 0)
        stable[-1] = 1
        for name, values in (("branch", number), ("stable", stable)):
            file[name][...] = values
        own = file.create_group("bifurcations")
        for name, value in (("point", 5), ("branch", 1), ("parameter", file["parameter"][4])):
            own[name] = np.array([value], float)
        own["value_real"], own["value_imag"] = np.array([-1.0]), np.array([0.0])
        own["kind"] = np.array([b"period_doubling"])
        own["kind"].make_scale("kind")
        for name in own.keys() - {"kind"}:
            own[name].dims[0].attach_scale(own["kind"])

    return opened(changed("branch", edit))


def test_parts_and_bifurcations(turned, run):
    (special,) = branches.bifurcations(turned)
    assert (special.kind, special.letters, special.branch, special.point) == ("period_doubling", "PD", 1, 4)
    assert (special.parameter, special.value) == (turned["parameter"][4], -1)
    last = len(turned["point"]) - 1
    parts = branches.stretches(turned)
    found = [(each.branch, each.stable, each.points[0], each.points[-1]) for each in parts]
    assert found == [(1, True, 0, 4), (1, False, 4, 8), (2, False, 9, last)]
    assert branches.multipliers(turned).shape == (last + 1, len(turned["mode"]))
    with pytest.raises(tiltpad.NotInRunError, match="no branch in this run: its task is 'march'"):
        branches.stretches(run("none"))


def test_what_is_unstable_is_dashed_and_bifurcations_have_letters(turned):
    upper, _ = pictures.branch(turned).axes
    lines = [line for line in upper.get_lines() if len(line.get_xdata()) > 1]
    assert [line.is_dashed() for line in lines] == [False, True, True] * 2
    assert len({to_hex(line.get_color()) for line in lines}) == 2
    np.testing.assert_array_equal(lines[1].get_xdata(), turned["parameter"][4:9])
    np.testing.assert_allclose(lines[1].get_ydata(), 1e6 * turned["journal_y_max"][4:9])
    np.testing.assert_allclose(lines[4].get_ydata(), 1e6 * turned["journal_y_min"][4:9])
    assert [text.get_text() for text in upper.texts] == ["PD", "PD"]


def test_the_response_along_a_branch_is_that_of_its_orbits(run):
    found = tiltpad.response(run("branch"))
    assert found.parameter == "speed_rpm"
    case = {"case": {"task": "periodic"}, "operation": {"speed_rpm": 3000}}
    with tiltpad.run(case, output={"samples_per_revolution": 60}) as orbit:
        angle = orbit.shaft_angle
        turning = orbit.journal_z * np.exp(-1j * angle)
        one = np.sum(np.diff(angle) * (turning[1:] + turning[:-1])) / np.ptp(angle)
    # both are means over the samples of a revolution, one of the orbit itself
    assert found.amplitude[0, 1] * np.exp(-1j * found.phase[0, 1]) == pytest.approx(one, rel=1e-4)


def test_marches_lie_below_their_branch(run, result, tmp_path):
    lengths = {"settle": 6, "revolutions": 2, "output": {"samples_per_revolution": 60}}
    speeds = [3000, 4000]
    study = tiltpad.brute_force(None, "operation%speed_rpm", speeds, tmp_path / "up", **lengths)
    with study:
        branch = run("branch")
        ends = [0, int(np.argmax(branch["parameter"]))]
        # the motion from the equilibrium has come as near as 1e-3 of the orbit in six revolutions
        high, low = branch["journal_y_max"][ends], branch["journal_y_min"][ends]
        np.testing.assert_allclose(study["highest_y"][:2, -1], high, atol=0.01 * (high - low).min())
        figure = pictures.branch([branch, study], pad=2)
        grey = figure.axes[1].get_lines()[0]
        np.testing.assert_allclose(
            grey.get_ydata(), 1e3 * study["lowest_tilt"][..., 1].ravel(), equal_nan=True
        )
        with pytest.raises(tiltpad.NotInRunError, match="no branch in this study"):
            pictures.branch(study)
    output = tmp_path / "a.png"
    files = [str(result("branch")), str(tmp_path / "up/study.h5")]
    assert command.main(["branch", *files, "-o", str(output)]) == 0
    assert command.main(["multipliers", files[0], "-o", str(output)]) == 0


def test_extremes_of_each_revolution(made):
    run = made("none", seconds=5.5 * 60 / 6500, interval=60 / 6500 / 40, journal_y=lambda t, angle: angle)
    low, high = tiltpad.calculate.signals.extremes(run, "journal_y")
    assert len(low) == 5
    np.testing.assert_allclose(high - low, 2 * np.pi, rtol=0.05)


def test_reports_of_branches(result, tmp_path):
    output = tmp_path / "page.html"
    assert command.report([str(result("branch")), "-o", str(output)]) == 0
    page = output.read_text()
    assert all(f'alt="{name}"' in page for name in ("branch", "multipliers", "response"))
    with h5py.File(result("branch")) as file:
        assert file.attrs["complete"]


def test_a_chart_has_bands_on_stable_sides(run, changed, opened, result, tmp_path):
    curve = run("curve")
    (ax,) = pictures.chart(curve).axes
    (line, _), (band,) = ax.get_lines(), ax.patches
    np.testing.assert_array_equal(line.get_xdata(), curve["second_parameter"])
    np.testing.assert_array_equal(line.get_ydata(), curve["parameter"])
    edge = band.get_xy()[len(line.get_xdata()) : -1]
    assert (np.interp(edge[:, 0], line.get_xdata(), line.get_ydata()) >= edge[:, 1]).all()

    def round_curve(file):
        """A circle whose inside is stable, but for its last points, where nothing is."""
        angle = np.linspace(0.2, 6, len(file["point"]))
        for name, values in (
            ("parameter", np.sin(angle)),
            ("second_parameter", np.cos(angle)),
            ("arc_length", angle),
        ):
            file[name][...] = values
        file["stable_side"][...] = -np.sign(np.sin(angle))
        file["stable"][-3:] = 0

    turning = opened(changed("curve", round_curve))
    places = np.stack([turning["second_parameter"], turning["parameter"]], axis=1)
    inwards = branches.stable_sides(turning, np.ones(2))
    np.testing.assert_allclose(inwards, -places, atol=0.15)
    (ax,) = pictures.chart(turning).axes
    assert [each.is_dashed() for each in ax.get_lines()[:2]] == [False, True]
    with pytest.raises(tiltpad.NotInRunError, match="no curve over two parameters .*plot branch draws"):
        pictures.chart(run("branch"))
    for draw in (pictures.branch, tiltpad.response):
        with pytest.raises(tiltpad.NotInRunError, match="no branch over one parameter .*plot chart draws"):
            draw(curve)
    output = tmp_path / "page.html"
    assert command.report([str(result("curve")), "-o", str(output)]) == 0
    page = output.read_text()
    assert 'alt="chart"' in page
    assert "points of the branches" not in page


@pytest.fixture(scope="module")
def kicked(root, tiltpad, tmp_path_factory):
    """A branch of limit cycles with a fold below its Hopf point, and starts of marches between both."""
    folder, case = tmp_path_factory.mktemp("kicked"), root / "input/examples/lemon_bore.nml"
    tiltpad("-q", case, "-o", folder / "cycles.h5", status=0)
    settings = (
        "case%task=march", "operation%speed_rpm=9800", "operation%duration=0.4", "output%keep=summary",
        "sweep%start%journal(1)=-16e-6:16e-6:16e-6", "sweep%start%journal(2)=0,16e-6,26e-6",
    )  # fmt: skip
    words = [word for each in settings for word in ("--set", each)]
    tiltpad("-q", case, *words, "-o", folder / "starts", status=0)
    return folder


def test_starts_beyond_the_unstable_cycle_whirl(kicked):
    with tiltpad.read(kicked / "cycles.h5") as branch, tiltpad.read_study(kicked / "starts.h5") as study:
        found = basins.basin(study, branch)
        assert found.parameter == 9800
        np.testing.assert_allclose(found.cycle, [20.07e-6, 22.33e-6], rtol=1e-2)
        away = np.hypot(*(found.start / found.cycle).T)
        assert not found.whirls[away < 0.9].any()
        assert found.whirls[away > 1.1].all()
        assert 3 <= found.whirls.sum() < 6
        assert (found.amplitude[found.whirls] > 40e-6).all()
        assert found.nearest == np.hypot(*found.start[found.whirls].T).min()
        # no unstable cycle at a speed below the fold, and none beyond the Hopf point
        for value in (9400, 10400):
            with pytest.raises(tiltpad.NotInRunError, match="no unstable limit cycle"):
                basins.unstable_cycle(branch, value)
        returns, whirls, cycle = pictures_of_basin(study, branch)
        assert len(whirls) == found.whirls.sum()
        assert len(returns) + len(whirls) == 9
        assert cycle[:, 0].max() == pytest.approx(1e6 * found.cycle[1])


def pictures_of_basin(study, branch):
    figure = tiltpad.figures.basin([study, branch])
    assert "speed 9800 rpm; nearest start that whirls: 2" in figure.legends[0].get_title().get_text()
    return [line.get_xydata() for line in figure.axes[0].get_lines()]


def test_a_basin_needs_starts_and_cycles(kicked, result, capsys, tmp_path):
    cycles, starts = str(kicked / "cycles.h5"), str(kicked / "starts.h5")
    output = tmp_path / "basin.png"
    assert command.main(["basin", starts, cycles, "-o", str(output)]) == 0
    assert output.exists()
    capsys.readouterr()
    for files, words in (
        ([cycles], "a basin is of one study of starts and one branch of limit cycles"),
        ([starts, str(result("branch"))], "no unstable limit cycle at"),
        ([starts, str(result("none"))], "no branch in this run"),
    ):
        assert command.main(["basin", *files, "-o", str(output)]) == 1
        said = capsys.readouterr().err
        assert words in said
        assert said.count("\n") == 1
