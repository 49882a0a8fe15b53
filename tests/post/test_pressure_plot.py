"""The picture of the film pressure: its axes, and the files and messages of the command."""

import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad
from tiltpad import command, figures
from tiltpad.calculate import geometry

pytestmark = pytest.mark.usefixtures("quick_pictures")


def test_the_pressure_over_the_unrolled_pad(run):
    case = run("four")
    ax = tiltpad.plots.pressure(case, time=0.01, pad=2)
    film = tiltpad.pressure(case, 0.01)
    np.testing.assert_allclose(ax.get_xlim(), np.degrees(film.phi[1, [0, -1]]))
    np.testing.assert_allclose(ax.get_ylim(), [-50, 50])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("angle from pivot (deg)", "axial position (mm)")
    levels = ax.collections[0].levels
    assert levels[0] == 0
    assert levels[-2] < film.pressure[1].max() / 1e6 <= levels[-1]
    bar = next(each for each in ax.figure.axes if each is not ax)
    assert bar.get_ylabel() == "film pressure (MPa)"
    # the highest contour surrounds the highest point
    k = np.unravel_index(film.pressure[1].argmax(), film.pressure[1].shape)
    top = ax.collections[0].get_paths()[-1]
    assert top.contains_point((np.degrees(film.phi[1, k[0]]), 1e3 * film.z[1, k[1]]))
    # the journal's surface moves from the leading edge, at the right, to the trailing edge
    places = {each.get_text(): each.get_position()[0] for each in ax.texts}
    assert places["trailing edge"] < 0.5 < places["leading edge"]


def test_a_film_without_pressure_is_drawn(changed):
    """Pads that leave the journal at 10 m/s: nothing but cavitation."""

    def leaving(file):
        file["pivot_deflection_rate"][3] = 10.0

    with tiltpad.read(changed("lugre", leaving)) as case:
        assert not tiltpad.pressure(case, case.time[3]).pressure.any()
        tiltpad.plots.pressure(case, time=case.time[3]).figure.draw_without_rendering()


def test_a_panel_a_pad(run):
    runs = [run("four"), run("gumbel"), run("lugre")]
    titles = [ax.get_title() for ax in figures.pressure(runs[:1], time=0.01).axes if ax.get_title()]
    highest = 1e-6 * tiltpad.pressure(runs[0], 0.01).pressure.max(axis=(1, 2))
    assert [title.split(": at most ")[0] for title in titles] == [f"pad {k}" for k in (1, 2, 3, 4)]
    shown = [float(title.split()[-2]) for title in titles]
    np.testing.assert_allclose(shown, highest, rtol=6e-3)
    titles = [ax.get_title() for ax in figures.pressure(runs[:2], pad=3).axes if ax.get_title()]
    assert [title.splitlines()[0] for title in titles] == ["LuGre, reynolds", "no friction, gumbel"]
    title = figures.pressure(runs[2:], time=0.01).get_suptitle()
    assert title == "Steady, it's LuGre at 0.01 s"


def test_all_pads_have_one_scale(run):
    fig = figures.pressure([run("four")])
    panels = [ax.collections[0] for ax in fig.axes if ax.get_title()]
    assert len({tuple(each.levels) for each in panels}) == 1
    assert len(fig.axes) == len(panels) + 1


def test_films_around_the_bearing(run):
    """The thickness follows from the states alone, and has the minimum that the library has."""
    for case_name, time in (("four", 0.01), ("offset", None), ("fixed", 0.03)):
        case = run(case_name)
        found = geometry.surfaces(case.input, geometry.at_time(case, time), 4001)
        least = tiltpad.pressure(case, time).min_film_thickness
        # a minimum between two points is too high by c_m step^2/8
        np.testing.assert_allclose(found.thickness.min(axis=1), least, rtol=1e-6)
    upper, lower = figures.film([run("four")], time=0.01).axes
    places = {text.get_text(): text.xy[1] for text in upper.texts}
    assert places["journal"] < places["pads: the lines"]
    assert len(upper.get_lines()) == len(lower.get_lines()) == 4
    np.testing.assert_allclose(
        upper.get_lines()[0].get_xdata()[[0, -1]], [-45 - 34.65, -45 + 34.65], atol=0.2
    )
    assert lower.get_lines()[0].get_ydata().max() == pytest.approx(
        1e-6 * tiltpad.pressure(run("four"), 0.01).max_pressure[0], rel=5e-3
    )


def test_names_of_many_pads_do_not_overlap(tiltpad, tmp_path):
    import tiltpad as package

    angles = ", ".join(str(15 * k - 90) for k in range(24))
    (tmp_path / "many.nml").write_text(
        f"&case task='equilibrium' / &rotor mass=800 /\n&pads pivot_angle_deg={angles}, arc_deg=12 /\n"
    )
    tiltpad("many.nml", "-q", cwd=tmp_path, status=0)
    with package.read(tmp_path / "many.h5") as case, plt.style.context(package.plots.STYLE):
        fig = figures.film([case])
        fig.draw_without_rendering()
    of_pads = [each for each in fig.axes[0].texts if each.xy[1] > 1]
    boxes = sorted((each.get_window_extent() for each in of_pads), key=lambda box: box.x0)
    assert len(boxes) == 24
    assert all(left.x1 < right.x0 for left, right in zip(boxes, boxes[1:], strict=False))


def test_the_command_draws_it(result, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert command.main(["pressure", str(result("four")), "--time", "0.01"]) == 0
    pixels = matplotlib.image.imread(tmp_path / "four-pressure.png")[..., :3]
    assert (pixels.min(axis=2) < 0.9).mean() > 0.4


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["pressure", "none", "--time", "1"], "no time 1 s in this run: sampled from 0 to 0.06 s"),
        (["pressure", "none", "--time", "soon"], "argument --time: invalid float value: 'soon'"),
        (["pressure", "none", "--pad", "3"], "no pad 3 in this run: pads are 1 to 2"),
        (["pressure", "equilibrium", "--time", "0"], "nothing was marched in time"),
        (["orbit", "none", "--time", "0.01"], "--time: for the plots pressure, film, not for orbit"),
    ],
)
def test_errors_are_one_line(result, tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    given = [str(result(each)) if each in ("none", "equilibrium") else each for each in arguments]
    try:
        status = command.main(given)
    except SystemExit as stop:
        status = stop.code
    said = capsys.readouterr().err
    assert status == 1
    assert said.startswith("tiltpad-plot: error: ")
    assert said.count("\n") == 1
    assert message in said
    assert not list(tmp_path.iterdir())
