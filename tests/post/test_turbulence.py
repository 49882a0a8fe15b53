"""Turbulent films: their picture over the arc, and what reports and results have of them."""

import numpy as np
import pytest
import tiltpad as package
from tiltpad import command, figures
from tiltpad.draw.report import report
from tiltpad.draw.study_report import study_report

pytestmark = pytest.mark.usefixtures("quick_pictures")

#: What turbulence adds to an equilibrium.
TURBULENT = {"largest_reynolds_number": "largest local rho", "turbulent_share": "share of turbulence"}


@pytest.fixture(scope="module")
def folder(tiltpad, root, tmp_path_factory):
    """A turbine bearing with either sense of rotation, other films, and a study."""
    folder = tmp_path_factory.mktemp("turbulence")
    case = root / "input/examples/turbine_bearing.nml"
    given = case.read_text().replace("  viscosity = 12e-3\n", "")
    (folder / "warm.nml").write_text(given.replace("density = 860", "grade = 32"))
    for name, *overrides in (
        ("clockwise",),
        ("anticlockwise", "operation%rotation=anticlockwise"),
        ("warm", "thermal%model=film"),
        ("later", "film%turbulent_above=1500"),
        ("laminar", "film%turbulence=none"),
        ("study", "sweep%film%turbulence=none,ng_pan", "sweep%operation%speed_rpm=1500,3000"),
    ):
        overrides = ("case%task=equilibrium", *overrides)
        tiltpad(
            f"{name}.nml" if name == "warm" else case,
            "-q",
            "-o",
            f"{name}.h5",
            overrides=overrides,
            cwd=folder,
            status=0,
        )
    return folder


@pytest.mark.parametrize("name", ["clockwise", "anticlockwise"])
def test_lines_have_the_numbers_of_the_file(folder, opened, name):
    """The solver has the same points of the arc; its mean film thickness is that of the arc."""
    run = opened(folder / f"{name}.h5")
    lines = figures.turbulence(run).axes[0].lines[:5]
    numbers = np.array([line.get_ydata() for line in lines])
    mean = np.trapezoid(numbers, lines[0].get_xdata(), axis=1)
    np.testing.assert_allclose(mean, run["equilibrium/reynolds_number"], rtol=1e-4)
    assert (numbers[:, 0] > numbers[:, -1]).all(), "films are thicker at the leading edge"
    s = np.clip((numbers - 500) / 500, 0, 1)
    w = s**5 * (126 - 420 * s + 540 * s**2 - 315 * s**3 + 70 * s**4)
    share = run["equilibrium/turbulent_share"]
    np.testing.assert_allclose(np.trapezoid(w, lines[0].get_xdata(), axis=1), share, rtol=1e-6)
    assert share.max() <= 1


def test_viscosity_changes_along_the_arc(folder, opened):
    """The density, and the viscosity of the weights of shear, give the same as the numbers of the file."""
    run = opened(folder / "warm.h5")
    number, shear = (run[f"equilibrium/{name}"] for name in ("reynolds_number", "shear_weights"))
    for line, own, c in zip(figures.turbulence(run).axes[0].lines, number, shear, strict=False):
        thinner = np.exp(np.polynomial.polynomial.polyval(2 * line.get_xdata() - 1, c))
        assert np.trapezoid(line.get_ydata() * thinner, line.get_xdata()) == pytest.approx(own, rel=1e-4)
        assert np.ptp(thinner) > 0.1


def test_the_transition_is_drawn(folder, opened):
    one, later = (opened(folder / f"{name}.h5") for name in ("clockwise", "later"))
    ax = figures.turbulence(one, pad=2).axes[0]
    assert [line.get_ydata()[0] for line in ax.lines[1:]] == [500, 1000]
    assert [(each.get_y(), each.get_y() + each.get_height()) for each in ax.patches] == [
        (500, 1000),
        (1000, ax.get_ylim()[1]),
    ]
    both = figures.turbulence([one, later], pad=2).axes[0]
    assert [line.get_ydata()[0] for line in both.lines[2:]] == [500, 1000, 500, 1500]
    assert not both.patches


def test_laminar_films_have_no_picture(folder, capsys):
    assert command.main(["turbulence", f"{folder}/laminar.h5"]) == 1
    said = capsys.readouterr().err
    assert said.endswith("laminar.h5: no turbulence in this run: film%turbulence is 'none'\n")


def test_names_units_and_reports(folder, opened):
    turbulent, laminar = (opened(folder / f"{name}.h5") for name in ("clockwise", "laminar"))
    for name, words in TURBULENT.items():
        assert turbulent.about(f"equilibrium/{name}", "units") == "1"
        assert words in report(turbulent)
        with pytest.raises(package.NotInRunError, match="film%turbulence is 'none'"):
            laminar[f"equilibrium/{name}"]
        assert words not in report(laminar)
    assert 'alt="turbulence"' in report(turbulent)
    assert 'alt="turbulence"' not in report(laminar)


def test_the_report_of_a_study(folder):
    with package.read_study(folder / "study.h5") as study:
        page = study_report(study)
        mean, most, share = (
            study[f"pad_equilibrium_{name}"][3, 0] for name in ("reynolds_number", *TURBULENT)
        )
    table = page.partition("<h2>Turbulent films</h2>")[2].partition("</table>")[0]
    assert f"{mean:.0f}, {most:.0f}, {100 * share:.0f} %" in table
    assert table.count("<tr>") == 3, "a head, and the runs with turbulence"


def test_the_report_of_a_study_of_machines(tiltpad, root, tmp_path):
    """A table for each bearing whose films are turbulent."""
    machine = root / "input/examples/unequal_bearings.nml"
    overrides = (
        *("case%task=equilibrium", "film:drive_end%turbulence=ng_pan"),
        "sweep%operation%speed_rpm=6000,9000",
    )
    tiltpad(machine, "-q", "-o", "machines", cwd=tmp_path, overrides=overrides, status=0)
    with package.read_study(tmp_path / "machines.h5") as study:
        page = study_report(study)
        mean = study.bearings["drive_end"]["pad_equilibrium_reynolds_number"][1, 0]
    table = page.partition("<h2>Turbulent films, bearing drive_end</h2>")[2].partition("</table>")[0]
    assert f"<td>9000</td><td>{mean:.0f}, " in table.replace("\n", "")
    assert page.count("<h2>Turbulent films") == 1
