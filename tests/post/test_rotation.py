"""A bearing whose shaft turns anticlockwise, beside its mirror image: what Python calculates and draws."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad
from matplotlib.patches import FancyArrowPatch
from tiltpad.calculate import geometry, rotation, spectra, tables
from tiltpad.draw.bearing import bearing

PADS = {"arc_deg": (60.0, 55.0, 62.0), "pivot_ratio": (0.5, 0.55, 0.6)}
ANGLES = (-50.0, 80.0, 215.0)
UNBALANCE = {"rotor": {"mass": 2000.0, "static_load": (0.0, 2000.0)}}


def made(turning, **groups):
    """The case (1) or its mirror image (-1) run."""
    angles = tuple(each if turning > 0 else 180 - each for each in ANGLES)
    rotor = UNBALANCE["rotor"] | {"static_load": (0.0, turning * 2000.0)}
    operation = {"duration": 0.05, "rotation": "clockwise" if turning > 0 else "anticlockwise"}
    pads = PADS | {"pivot_angle_deg": angles}
    output = {"samples_per_revolution": 60}
    return tiltpad.run({"rotor": rotor, "operation": operation, "pads": pads, "output": output} | groups)


@pytest.fixture(scope="module")
def marches():
    return made(1), made(-1)


@pytest.fixture(scope="module")
def linear():
    return [made(turning, case={"task": "coefficients"}) for turning in (1, -1)]


def test_films_are_where_the_program_has_them(marches):
    own, other = marches
    for time in (None, 0.03):
        films = [geometry.surfaces(run.input, geometry.at_time(run, time)) for run in marches]
        np.testing.assert_allclose(films[1].thickness, films[0].thickness, atol=1e-12 * 80e-6)
        np.testing.assert_allclose(films[1].angle, np.pi - films[0].angle, atol=1e-12)
        pressures = [tiltpad.pressure(run, time) for run in marches]
        np.testing.assert_array_equal(pressures[1].pressure, pressures[0].pressure)
        # from the points of the picture, whose distance is 1/90 of the arc
        least = pressures[1].min_film_thickness
        np.testing.assert_allclose(films[1].thickness.min(axis=1), least, rtol=1e-3)


def test_spectra_and_modes_know_forward_from_backward(marches, linear):
    assert rotation.ends(rotation.sense(marches[1].input)) == "from +y to -z"
    for own, other in zip(*(spectra.full(run, 4) for run in marches), strict=True):
        np.testing.assert_array_equal(own, other)
    frequency, amplitude = spectra.full(marches[1], 4)
    assert frequency[np.argmax(np.where(frequency == 0, 0, amplitude))] > 0
    own, other = map(tiltpad.modes, linear)
    np.testing.assert_allclose(own.whirl, other.whirl, atol=1e-9)
    assert (
        list(own.name) == list(other.name) == list(linear[1]["modes/name"].astype(str)[0][: len(other.name)])
    )


def test_coefficients_for_ross_are_those_of_the_mirror_image(linear):
    """ROSS looks at a shaft that turns clockwise from its other end, and at this one as it is."""
    own, other = map(tiltpad.to_ross, linear)
    for name in own:
        np.testing.assert_array_equal(own[name], other[name])
    cross = tiltpad.coefficients(linear[1]).stiffness[0, 0, 1]
    assert other["kyx"][0] == pytest.approx(cross, rel=1e-12)
    assert tables.turning(linear[1]) == "from +y to -z"


def test_an_unbalance_identifies_like_its_mirror_image():
    """Unbalance and excitation have one frequency: the direction of the unbalance matters."""
    found = []
    for turning in (1, -1):
        runs = [
            made(
                turning,
                case={"task": "periodic"},
                excitation={"amplitude": 500.0, "frequency_ratio": 1.0, "direction_deg": turning * direction},
            )
            for direction in (0.0, 90.0)
        ]
        found.append(tiltpad.impedance(runs))
    mirror = np.array([[1, -1], [-1, 1]])
    for name in ("stiffness", "damping"):
        own, other = (getattr(each, name) for each in found)
        np.testing.assert_allclose(other, own * mirror, rtol=0, atol=1e-9 * np.abs(own).max())


def test_pictures_have_the_arrow_and_the_edges_of_the_sense(marches):
    for run, turning in zip(marches, (1, -1), strict=True):
        ax = tiltpad.plots.clearance(run)
        (arrow,) = (each for each in ax.patches if isinstance(each, FancyArrowPatch))
        start, end = arrow._posA_posB
        assert (end[0] > start[0]) == (turning > 0)
        plt.close()
        fig = bearing(run)
        (arrow,) = (each for each in fig.axes[0].patches if isinstance(each, FancyArrowPatch))
        start, end = arrow._posA_posB
        assert (end[0] > start[0]) == (turning > 0)
        said = " ".join(each.get_text() for each in fig.axes[1].texts)
        assert ("anticlockwise" in said) == (turning < 0)
        plt.close()
    fig = tiltpad.figures.film([marches[1]])
    assert "moves to the right" in fig.axes[1].get_xlabel()
    plt.close()
