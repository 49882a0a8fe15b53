"""Warm oil: temperatures in results, studies, pictures and reports, and where the heat goes."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad as package
from tiltpad import command, figures, summary

pytestmark = pytest.mark.usefixtures("quick_pictures")

#: Three pads, the last of which has no neighbour near; one speed is beyond what is compared.
CASE = """&operation duration=0.01 /
&oil grade=46, supply_temperature=45 /
&thermal model='pad' /
&pads pivot_angle_deg=-45,225,90, arc_deg=60, motion='tilting_only' /
"""
SPEEDS = (2000, 4000, 8000)

#: What a heat balance adds, with its dimensions.
WARM = {
    **dict.fromkeys(("inlet_temperature", "mean_temperature", "outlet_temperature"), ("pad",)),
    **dict.fromkeys(("maximum_temperature", "viscosity"), ("pad",)),
    **dict.fromkeys(("shaft_temperature", "drain_temperature"), ()),
}


@pytest.fixture(scope="module")
def folder(tiltpad, tmp_path_factory):
    """A march, runs of equilibria over the speed, and their study."""
    folder = tmp_path_factory.mktemp("warm")
    (folder / "warm.nml").write_text(CASE)
    varied = "sweep%operation%speed_rpm=" + ",".join(map(str, SPEEDS))
    for words in (
        ("warm.nml", "--set", "operation%speed_rpm=4000"),
        ("warm.nml", "--quiet", "--set", "case%task=equilibrium", "--set", varied, "--output", "speeds"),
    ):
        done = tiltpad(*words, cwd=folder, status=0)
        if "--quiet" not in words:
            (folder / "said").write_text(done.stdout)
    return folder


@pytest.fixture
def march(folder, opened):
    return opened(folder / "warm.h5")


@pytest.fixture(scope="module")
def study(folder):
    with package.read_study(folder / "speeds.h5") as study:
        yield study


def test_names_dimensions_and_units(march):
    for name, dimensions in WARM.items():
        full = f"equilibrium/{name}"
        assert march[full].shape == ((3,) if dimensions else ())
        assert march.about(full, "units") == ("Pa s" if name == "viscosity" else "degC")
        assert len(march.about(full, "long_name")) > 3


def test_the_oil_warms_and_thins(march):
    e, oil = march.equilibrium, march.input["oil"]
    assert (e["inlet_temperature"] > 45).any(), "a neighbour's oil"
    # the last pad has no pad upstream within the widest gap
    assert e["inlet_temperature"][2] == 45
    assert (e["outlet_temperature"] > e["inlet_temperature"]).all()
    assert (e["maximum_temperature"] >= e["outlet_temperature"]).all()
    # Walther's law through the points of the grade, by hand
    points = np.log10(np.log10(np.array([46.0, 6.7617]) + 0.7))
    place = np.log10(np.array([*oil["at_temperature"]]) + 273.15)
    slope = np.diff(points)[0] / np.diff(place)[0]
    line = points[0] + slope * (np.log10(e["mean_temperature"] + 273.15) - place[0])
    np.testing.assert_allclose(e["viscosity"], 860e-6 * (10**10**line - 0.7), rtol=1e-9)


def test_heat_is_conserved(march):
    """What a film makes goes to oil and shaft; a shaft of its own temperature takes none on the whole."""
    found, e = package.heat_balance(march), march.equilibrium
    np.testing.assert_array_equal(found.made, e["power_loss"])
    assert abs(found.to_shaft.sum()) < 1e-8 * found.made.sum()
    warmer = e["mean_temperature"] > e["shaft_temperature"]
    np.testing.assert_array_equal(found.to_shaft > 0, warmer)
    assert 0 < warmer.sum() < 3


@pytest.mark.parametrize("start", ["given", "partial"])
def test_a_march_that_starts_elsewhere_has_the_same_oil(folder, march, opened, tiltpad, start):
    case = ("warm.nml", "--set", "operation%speed_rpm=4000", "--set", f"start%from={start}")
    tiltpad(*case, "--quiet", "--output", f"{start}.h5", cwd=folder, status=0)
    run = opened(folder / f"{start}.h5")
    assert "equilibrium" not in run
    np.testing.assert_allclose(run.viscosity, march.viscosity, rtol=1e-6)
    np.testing.assert_array_equal(march.viscosity, march["equilibrium/viscosity"])
    # a sample has the error of the march
    force = np.hypot(run.film_force_tangential[-1], run.film_force_radial[-1])
    np.testing.assert_allclose(package.losses(run, last=1).load[-1], force, atol=1e-3 * force.max())


def test_films_have_the_viscosities_of_the_equilibrium(march):
    """Losses and films by the library start the march as its equilibrium says."""
    e, series = march.equilibrium, package.losses(march, last=10)
    np.testing.assert_allclose(series.power[0], e["power_loss"], rtol=1e-9)
    np.testing.assert_allclose(package.pressure(march).max_pressure, e["max_pressure"], rtol=1e-3)


def test_the_summary_says_it(folder, march, tiltpad):
    said, e = (folder / "said").read_text(), march.equilibrium
    assert f"mean {e['mean_temperature'][1]:.1f} C, {1e3 * e['viscosity'][1]:.2f} mPa s" in said
    assert f"shaft at {e['shaft_temperature']:.1f} C" in said
    assert "above 35 m/s" not in said
    check = tiltpad("--check", folder / "warm.nml", "--set", "operation%speed_rpm=8000").stdout
    assert "remark: surface speed 41.8 m/s: above 35 m/s" in check


def test_a_study_has_them(study):
    assert study.pad_equilibrium_mean_temperature.shape == (3, 3)
    assert (np.diff(study.equilibrium_maximum_temperature) > 0).all()
    hottest = study.pad_equilibrium_maximum_temperature.max(axis=1)
    np.testing.assert_array_equal(study.equilibrium_maximum_temperature, hottest)
    assert study.about("equilibrium_drain_temperature", "units") == "degC"
    fig = figures.study(study, show="pad_equilibrium_viscosity", pad=2)
    assert fig.axes[0].get_ylabel().replace("\n", " ") == "viscosity of the film, pad 2 (mPa s)"


def test_a_picture_over_the_speed(study):
    upper, lower = figures.temperatures([study]).axes
    np.testing.assert_array_equal(upper.lines[0].get_xdata(), SPEEDS)
    np.testing.assert_array_equal(upper.lines[2].get_ydata(), study.pad_equilibrium_maximum_temperature[:, 1])
    np.testing.assert_allclose(lower.lines[2].get_ydata(), 1e3 * study.pad_equilibrium_viscosity[:, 2])
    plt.close("all")
    assert len(figures.temperatures([study], pad=2).axes[1].lines) == 1
    with pytest.raises(ValueError, match="no pad 4: 1 to 3"):
        figures.temperatures([study], pad=4)


def test_a_picture_of_a_result(march):
    left, right = figures.temperatures([march]).axes
    drawn = {line.get_label(): line.get_ydata() for line in left.lines}
    np.testing.assert_array_equal(drawn["outlet"], march["equilibrium/outlet_temperature"])
    assert drawn["supply"][0] == 45
    heights = [bar.get_height() for bar in right.patches]
    np.testing.assert_allclose(np.sum(heights[:3]), np.sum(heights[3:]), rtol=1e-8)


def test_a_picture_of_a_branch(folder, tiltpad, opened):
    """Over its parameter; `stable` there means at frozen viscosity."""
    words = ("of='equilibrium'", "parameter='oil%supply_temperature'", "last=55", "step=5")
    changes = [word for each in words for word in ("--set", f"branch%{each}")]
    tiltpad("warm.nml", "-q", "--set", "case%task=branch", *changes, "-o", "branch.h5", cwd=folder, status=0)
    run = opened(folder / "branch.h5")
    for name, dimensions in WARM.items():
        assert run[name].shape == (len(run["point"]), *(3 for _ in dimensions))
    upper, lower = figures.temperatures([run], pad=2).axes
    np.testing.assert_array_equal(upper.lines[0].get_xdata(), run["parameter"])
    np.testing.assert_array_equal(upper.lines[1].get_ydata(), run["mean_temperature"][:, 1])
    np.testing.assert_array_equal(lower.lines[0].get_ydata(), 1e3 * run["viscosity"][:, 1])
    fig = figures.branch([run])
    texts = [text.get_text() for text in fig.legends[0].get_texts()]
    assert all(ax.get_ylabel().endswith("highest and lowest") for ax in fig.axes)
    assert texts[0] == "stable at frozen viscosity"
    with pytest.raises(ValueError, match="a branch has a picture of temperatures of its own"):
        figures.temperatures([run, run])


def test_key_figures(march):
    assert "equilibrium/drain_temperature" in [each.name for each in summary.journal(march)]
    rows = {each.name: each.value for each in summary.pads(march)}
    np.testing.assert_array_equal(rows["equilibrium/viscosity"], march["equilibrium/viscosity"])


@pytest.mark.parametrize("case_name", ["none", "equilibrium"])
def test_a_run_without_them_says_why(run, case_name):
    with pytest.raises(package.NotInRunError, match=r"no heat balance \(thermal%model = 'none'\)"):
        figures.temperatures([run(case_name)])
    assert not [each for each in summary.pads(run(case_name)) if each.name.endswith("_temperature")]


def test_pressures_of_a_run_up_take_the_oil_of_their_time(tiltpad, tmp_path, opened):
    """The force of the field is that of the march, at whose ends the oil has different viscosities."""
    (tmp_path / "runup.nml").write_text(
        "&operation speed_rpm=4000, final_speed_rpm=6000, duration=0.1 /&oil grade=46, groove_volume=1e-6 /\n"
        "&thermal model='pad', march='groove' / &film cavitation='none' /\n"
    )
    tiltpad("runup.nml", "-q", cwd=tmp_path, status=0)
    run = opened(tmp_path / "runup.h5")
    oil = run["oil/viscosity"]
    assert oil.shape == (len(run["oil/time"]), 2)
    np.testing.assert_allclose(oil[0], run["equilibrium/viscosity"], rtol=1e-14)
    assert np.abs(oil[-1] / oil[0] - 1).max() > 0.01
    for time in (0.0, 0.06, 0.1):
        field = package.pressure(run, time, 3, 3)
        sample = np.abs(run["time"] - field.time).argmin()
        np.testing.assert_allclose(field.force[:, 1], run["film_force_radial"][sample], rtol=2e-4)


def test_a_study_without_them_says_why(runs_of, tmp_path):
    package.collect(
        runs_of(tmp_path / "cold", "&case task='equilibrium' /", {"operation%speed_rpm": [3000, 6500]}),
        tmp_path / "cold.h5",
    )
    with (
        package.read_study(tmp_path / "cold.h5") as study,
        pytest.raises(package.NotInRunError, match="no temperatures in this study"),
    ):
        figures.temperatures([study])


def test_a_run_of_an_earlier_program_says_why(changed, opened):
    def without_groups(file):
        text = file.attrs["input"]
        start, end = text.index("&thermal"), text.index("&pads")
        file.attrs["input"] = text[:start] + text[end:]

    with pytest.raises(package.NotInRunError, match="no heat balance"):
        package.heat_balance(opened(changed("none", without_groups)))


def test_the_command(folder, capsys):
    assert command.main(["temperatures", f"{folder}/speeds.h5", "--last", "2"]) == 1
    assert "--last: not for the plot temperatures" in capsys.readouterr().err
    picture = folder / "picture.svg"
    assert command.main(["temperatures", f"{folder}/speeds.h5", "--pad", "1", "-o", f"{picture}"]) == 0
    assert picture.stat().st_size > 1000
