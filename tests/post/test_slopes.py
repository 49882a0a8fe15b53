"""Pictures and figures of films with slopes: inclined journals, pads that pitch and yaw."""

import numpy as np
import pytest
import tiltpad as package
from tiltpad import figures
from tiltpad.calculate import differences, geometry
from tiltpad.draw import bearing

pytestmark = pytest.mark.usefixtures("quick_pictures")
ENDS = ("start_film_thickness", "end_film_thickness")


@pytest.mark.parametrize("rotation", ["clockwise", "anticlockwise"])
def test_films_are_where_the_program_has_them(run, tiltpad_set, rotation):
    """At both ends, with pitch, yaw and a pivot off the middle plane."""
    case = run("pitching")
    if rotation == "anticlockwise":
        case = tiltpad_set("pitching", "operation%rotation=anticlockwise")
    found = geometry.surfaces(case.input, geometry.at_time(case, case.time[100]), 4001)
    for name, x in zip(ENDS, (-0.05, 0.05), strict=True):
        least = (found.thickness + x * found.slope).min(axis=1)
        np.testing.assert_allclose(least, case[name][100], rtol=1e-6)
    ends = package.film_thickness(case, case.time[100], 4001, np.array([-1.0, 1.0])).min(axis=1)
    np.testing.assert_allclose(ends.T, [case[name][100] for name in ENDS], rtol=1e-6)
    assert np.abs(case[ENDS[0]][100] / case[ENDS[1]][100] - 1).max() > 0.05


def test_films_at_both_ends_are_drawn(run):
    case = run("pitching")
    upper, lower = figures.film([case], time=0.01).axes
    assert len(upper.get_lines()) == 6
    lowest = [line.get_ydata().min() for line in upper.get_lines()]
    at = np.argmin(np.abs(case.time - 0.01))
    np.testing.assert_allclose(lowest[0::3], 1e6 * case[ENDS[0]][at], rtol=1e-3)
    np.testing.assert_allclose(lowest[2::3], 1e6 * case[ENDS[1]][at], rtol=1e-3)
    highest = [line.get_ydata().max() for line in lower.get_lines()]
    np.testing.assert_allclose(highest, 1e-6 * case.max_pressure[at], rtol=2e-2)
    # of a run without slopes the film is one line
    assert len(figures.film([case, run("none")]).axes[0].get_lines()) == 8


def test_pressures_have_lines_of_thickness(run):
    case = run("pitching")
    for of, lines in ((case, 1), (run("none"), 0)):
        ax = package.plots.pressure(of)
        drawn = [text.get_text() for text in ax.texts if text.get_text().endswith("µm")]
        assert len(ax.collections) == 1 + lines
        assert bool(drawn) == bool(lines)


def test_histories_have_pitch_and_films_at_both_ends(run):
    case = run("pitching")
    for draw in (figures.waveform, figures.runup):
        labels = [ax.get_ylabel() for ax in draw([case]).axes]
        assert "pad pitch (mrad)" in labels
        for end in ("lower", "higher"):
            assert f"film, end of\n{end} $x$ (µm)" in labels
        # beside a run that has none of it they are left out
        assert "pad pitch (mrad)" not in [ax.get_ylabel() for ax in draw([case, run("none")]).axes]


def test_pads_from_the_side(run):
    case = run("pitching")
    _, beside, *sides = bearing.bearing(case).axes
    assert "from the side" in beside.texts[0].get_text()
    views = bearing.side_views(case.in_operation, geometry.at_rest(case))
    for k, (view, ax) in enumerate(zip(views, sides, strict=True)):
        assert f"pitch {1e6 * case['equilibrium/pad_pitch'][k]:.0f} µrad" in ax.get_title()
        assert view.outward == -1
        journal, pad = (each.get_paths()[0].vertices for each in ax.collections)
        for film, name, x in zip(view.films, ENDS, (-view.half, view.half), strict=True):
            # at the pivot the film is not thinner than the least at this end
            assert film >= case[f"equilibrium/{name}"][k]
            gap = journal[journal[:, 0] == x, 1].min() - pad[pad[:, 0] == x, 1].max()
            assert gap == pytest.approx(view.scale * film)
    assert len(bearing.bearing(run("none")).axes) == 2


def test_figures_of_the_last_revolution(run):
    case = run("pitching")
    last = slice(-361, None)
    for axis in "yz":
        mean = case[f"journal_moment_{axis}"][last][1:].mean()
        assert case[f"summary/mean_moment_{axis}"] == pytest.approx(mean, rel=1e-9)
    for name in ENDS:
        np.testing.assert_array_equal(case[f"summary/pad_{name}"], case[name][last].min(axis=0))
    for name in ("pad_pitch", "pad_yaw"):
        np.testing.assert_array_equal(case[f"summary/{name}_max"], case[name][last].max(axis=0))
        np.testing.assert_array_equal(case[f"summary/{name}_min"], case[name][last].min(axis=0))
    page = package.report.report(case)
    assert "<td>highest pitch</td>" in page
    assert "<td>minimum film thickness at the end of lower x</td>" in page
    assert "summary/mean_moment_y" not in run("none")


def test_runs_with_other_pads_are_named_by_what_these_can_do(run):
    names = differences.differences([run("pitching").input, run("none").input])
    assert "inertia" not in "".join(names)


def test_films_on_a_shaft_that_bends(tiltpad, root, opened, tmp_path):
    """Its slopes in the bearing are those of the file, also for the pressures that the library solves."""
    words = (root / "input/examples/slender.nml", "-q", "-o", "a.h5")
    tiltpad(*words, overrides=("case%task=equilibrium",), cwd=tmp_path, status=0)
    case = opened(tmp_path / "a.h5").bearings["front"]
    assert case.has_slopes
    ends = package.film_thickness(case, None, 4001, np.array([-1.0, 1.0])).min(axis=1)
    np.testing.assert_allclose(ends.T, [case[f"equilibrium/{name}"] for name in ENDS], rtol=1e-6)
    found = package.pressure(case)
    np.testing.assert_allclose(found.min_film_thickness, case["equilibrium/min_film_thickness"], rtol=1e-6)
    np.testing.assert_allclose(found.max_pressure, case["equilibrium/max_pressure"], rtol=1e-3)
    y, z = (case[f"equilibrium/journal_slope_{axis}"] for axis in "yz")
    # the pad stands at -45 degrees
    assert f"slope {1e6 * (z - y) / np.sqrt(2):.0f}" in bearing.bearing(case).axes[2].get_title()
