"""Pictures of temperatures along and across films: what is drawn is what the file has, each at its place."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad as package
from matplotlib.collections import PolyCollection
from matplotlib.contour import QuadContourSet
from tiltpad import figures
from tiltpad.draw.bearing import bearing

pytestmark = pytest.mark.usefixtures("quick_pictures")

#: Two loaded pads that bend, and an upper one that turns little oil warm.
CASE = """&case task='equilibrium' /
&oil grade=46, supply_temperature=45 /
&thermal model='film' /
&pads pivot_angle_deg=-45,225,90, arc_deg=60, motion='tilting_only', bending='both', thickness=20e-3 /
"""
SPEEDS, CARRIED = (3000, 4000, 5000), (0.7, 0.8, 0.9)


@pytest.fixture(scope="module")
def folder(tiltpad, tmp_path_factory):
    """Equilibria of both senses of rotation, and a study over the speed and the oil that is carried over."""
    folder = tmp_path_factory.mktemp("films")
    (folder / "warm.nml").write_text(CASE)
    speeds, carried = (",".join(map(str, each)) for each in (SPEEDS, CARRIED))
    varied = (f"sweep%oil%carry_over={carried}", f"sweep%operation%speed_rpm={speeds}")
    for name, overrides in (
        ("clockwise", ("operation%speed_rpm=4000",)),
        ("anticlockwise", ("operation%speed_rpm=4000", "operation%rotation=anticlockwise")),
        ("study", varied),
    ):
        tiltpad("warm.nml", "-q", "-o", f"{name}.h5", overrides=overrides, cwd=folder, status=0)
    return folder


@pytest.fixture(params=["clockwise", "anticlockwise"])
def found(request, folder, opened):
    return opened(folder / f"{request.param}.h5")


def test_temperatures_over_the_arc(found):
    """A line for each pad, from the leading edge on; the surface becomes warmer along a loaded pad."""
    right = figures.temperatures([found]).axes[1]
    surfaces = found["equilibrium/surface_temperature"]
    assert len(right.lines) == len(surfaces) == 3
    for line, own in zip(right.lines, surfaces, strict=True):
        np.testing.assert_array_equal(line.get_xdata(), found["film_arc"])
        np.testing.assert_array_equal(line.get_ydata(), own)
    first = right.lines[0].get_ydata()
    assert first[-1] > first[0] + 1


def test_the_field_across_a_film(found):
    """It fills the film of the pad in operation, thicker at the leading edge, from the pad to the shaft."""
    ax = figures.temperatures([found], pad=2).axes[0]
    (field,) = (each for each in ax.collections if isinstance(each, QuadContourSet))
    rest = found.equilibrium
    every = [rest["film_temperature"][1], rest["surface_temperature"][1], rest["shaft_temperature"]]
    assert field.zmin == min(each.min() for each in every)
    assert field.zmax == max(each.max() for each in every)
    points = np.concatenate([path.vertices for path in field.get_paths() if len(path.vertices)])
    place = found["film_arc"]
    at = [np.isclose(points[:, 0], each, atol=1e-9) for each in place]
    top = np.array([points[each, 1].max() for each in at])
    # between two of 40 stations the film may be thinner
    thinnest = 1e6 * rest["min_film_thickness"][1]
    assert thinnest * (1 - 1e-9) <= top.min() < 1.02 * thinnest
    assert top[0] > 1.2 * top[-1]
    assert points[:, 1].min() == 0
    hottest = [path.vertices for path in field.get_paths() if len(path.vertices)][-1]
    assert hottest[:, 0].mean() > 0.5, "near the trailing edge"
    assert (hottest[:, 1] < 0.7 * top.max()).all(), "and the pad"


def test_a_bearing_coloured_by_temperature(found):
    """Each stretch of a pad has the temperature of the surface there, and the journal that of the shaft."""
    ax = bearing(found).axes[0]
    (shown,) = (each for each in ax.collections if isinstance(each, PolyCollection))
    surfaces, shaft = found["equilibrium/surface_temperature"], float(found["equilibrium/shaft_temperature"])
    warmth = shown.get_array().reshape(len(surfaces), -1)
    middles = np.array([path.vertices[:4].mean(0) for path in shown.get_paths()]).reshape(*warmth.shape, 2)
    angles = np.degrees(np.arctan2(middles[..., 1], middles[..., 0]))
    turn = -1 if found.input["operation"]["rotation"] == "clockwise" else 1
    pivots = np.atleast_1d(found.input["pads"]["pivot_angle_deg"])
    for pivot, own, drawn, angle in zip(pivots, surfaces, warmth, angles, strict=True):
        # from the leading edge on, half an arc before the pivot; tilts and enlarged films turn it a little
        along = 0.5 + turn * ((angle - pivot + 180) % 360 - 180) / 60
        assert (np.diff(along) < 0).all() or (np.diff(along) > 0).all()
        np.testing.assert_allclose(np.sort(along)[[0, -1]], [0, 1], atol=0.15)
        order = np.argsort(along)
        even = (np.arange(len(order)) + 0.5) / len(order)
        np.testing.assert_allclose(drawn[order], np.interp(even, found["film_arc"], own), atol=1e-9)
    assert shown.get_clim() == (min(shaft, surfaces.min()), max(shaft, surfaces.max()))
    circles = [each for each in ax.patches if getattr(each, "radius", None) == 1]
    assert [each.get_facecolor() for each in circles] == [shown.to_rgba(shaft)]


def test_bands_of_what_is_carried_over(folder):
    """Lines of the middle value; bands from the least to the largest of the runs at each speed."""
    with package.read_study(folder / "study.h5") as study:
        fig = figures.temperatures([study], over="speed_rpm")
        order = np.lexsort((study["carry_over"], study["speed_rpm"]))
        for ax, name, factor in zip(fig.axes, ("maximum_temperature", "viscosity"), (1, 1e3), strict=True):
            values = factor * study[f"pad_equilibrium_{name}"][order].reshape(len(SPEEDS), len(CARRIED), 3)
            assert len(ax.collections) == 3
            for pad, band in enumerate(ax.collections):
                points = band.get_paths()[0].vertices
                for speed, own in zip(SPEEDS, values[..., pad], strict=True):
                    there = points[points[:, 0] == speed, 1]
                    np.testing.assert_array_equal([there.min(), there.max()], [own.min(), own.max()])
                    assert own.max() > own.min()
            own = values[:, 1, 0]
            assert any(np.array_equal(line.get_ydata(), own) for line in ax.lines)
        assert "lines: carry over 0.8; bands: carry over 0.7 to" in fig.axes[0].get_title()
        plt.close("all")
        one = figures.temperatures([study], over="speed_rpm", pad=2)
        assert [len(ax.collections) for ax in one.axes] == [1, 1]
