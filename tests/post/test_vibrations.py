"""Coefficients and modes of given matrices: condensation, whirl, modes that keep their places."""

import numpy as np
import pytest
from tiltpad.calculate import modes
from tiltpad.calculate.coefficients import condensed
from tiltpad.draw import vibrations

RANDOM = np.random.default_rng(7)
STIFFNESS, DAMPING = RANDOM.normal(size=(2, 6, 6)) + 6 * np.eye(6)
MASS = np.diag([0, 0, 0.1, 0.2, 0.3, 0.4]) + 0.01 * np.eye(6, k=1) * [0, 0, 0, 1, 0, 1]
FREQUENCY = np.array([0.3, 1.0, 2.0])


def test_condensed_pads_move_as_the_whole_system_does():
    """A force on the journal alone moves it as the condensed coefficients say."""
    stiffness, damping = condensed(STIFFNESS, DAMPING, MASS, FREQUENCY)
    for nu, k, c in zip(FREQUENCY, stiffness, damping, strict=True):
        whole = STIFFNESS + 1j * nu * DAMPING - nu**2 * MASS
        for force in ([1, 0], [0, 1]):
            moved = np.linalg.solve(whole, [*force, 0, 0, 0, 0])[:2]
            np.testing.assert_allclose((k + 1j * nu * c) @ moved, force, atol=1e-12)


def test_frequency_zero_is_the_limit():
    """The error of the difference is of second order: a hundredth at a tenth of the step."""
    at_zero = condensed(STIFFNESS, DAMPING, MASS, np.array([0.0]))
    errors = [
        np.abs(np.subtract(condensed(STIFFNESS, DAMPING, MASS, np.array([step])), at_zero)).max()
        for step in (1e-1, 1e-2)
    ]
    assert errors[1] < 0.02 * errors[0]


def test_positions_without_numbers_are_left_out():
    """Locked tilts are nan."""
    there = [0, 1, 3, 5]
    part = np.ix_(there, there)
    locked = [np.full((6, 6), np.nan) for _ in range(2)]
    for each, whole in zip(locked, (STIFFNESS, DAMPING), strict=True):
        each[part] = whole[part]
    found = condensed(*locked, MASS, FREQUENCY)
    np.testing.assert_array_equal(found, condensed(STIFFNESS[part], DAMPING[part], MASS[part], FREQUENCY))
    nowhere = np.full((6, 6), np.nan)
    assert np.isnan(condensed(nowhere, nowhere, MASS, FREQUENCY)).all()


def test_modes_that_cross_keep_their_places():
    """Two frequencies cross; a run in the middle has nothing; the modes of each come in rising order."""
    speed = np.linspace(0, 1, 21)
    own = np.stack([-1 + 1j * (10 + 10 * speed), -2 + 1j * (20 - 10 * speed)], axis=1)
    forms = np.broadcast_to(np.array([[1, 0, 0.1], [0.1j, 1, 0]]), (21, 2, 3))
    order = np.argsort(own.imag, axis=1)
    eigenvalue = np.take_along_axis(own, order, axis=1)
    shape = np.take_along_axis(forms, order[:, :, None], axis=1)
    eigenvalue[7], shape[7] = np.nan, np.nan
    found = modes.placed(eigenvalue, modes.tracked(eigenvalue, shape))
    there = np.arange(21) != 7
    np.testing.assert_array_equal(found[there], own[there])
    assert np.isnan(found[7]).all()


def test_a_mode_that_is_missing_leaves_the_others_where_they_are():
    eigenvalue = np.array([[1j, 2j, 3j], [1j, 3j, np.nan], [1j, 2j, 3j]])
    shape = np.ones((3, 3, 2), complex)
    found = modes.placed(eigenvalue, modes.tracked(eigenvalue, shape))
    np.testing.assert_array_equal(found, [[1j, 2j, 3j], [1j, np.nan, 3j], [1j, 2j, 3j]])


def test_a_mode_that_is_like_none_before_has_a_place_of_its_own():
    """As where a pad is lifted off its pivot: the number of modes is the same, and one is another."""
    eigenvalue = np.array([[88 + 83j, -10 + 105j], [105 + 79j, -9 + 131j], [-6 + 183j, -5600 + 21650j]])
    shape = np.array([[[1, 0], [0, 1]], [[1, 0], [0, 1]], [[0, 1], [0.4, 1]]], complex)
    found = modes.placed(eigenvalue, modes.tracked(eigenvalue, shape))
    nan = np.nan
    wanted = [[88 + 83j, -10 + 105j, nan], [105 + 79j, -9 + 131j, nan], [nan, -6 + 183j, -5600 + 21650j]]
    np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize(
    ("places", "word"),
    [
        ([(1, -0.06j)], "forward"),
        ([(1, 0.06j)], "backward"),
        ([(1, 0.04j)], "planar"),
        ([(1, 2 + 0.0j)], "planar"),
        ([(1, -0.5j), (1, 0.1j)], "forward"),
        ([(1, -0.5j), (1, 0.4j)], "mixed"),
        ([(1, -0.02j), (1e-3, 1e-3j)], "planar"),
    ],
)
def test_a_whirl_in_words(places, word):
    """A shaft that turns from y to z; one that turns the other way has the others' words."""
    shape = np.array(places, complex)
    assert modes.whirl_words(shape, 1) == word
    other = {"forward": "backward", "backward": "forward"}
    assert modes.whirl_words(shape, -1) == other.get(word, word)


@pytest.mark.parametrize(("z", "ahead"), [(-1j, True), (1j, False)])
def test_whirl_from_y_to_z_is_forward(z, ahead):
    time = np.linspace(0, 1, 5)
    y_of_time, z_of_time = (np.real(each * np.exp(1j * time)) for each in (1, z))
    turned = np.unwrap(np.arctan2(z_of_time, y_of_time))
    assert (turned[-1] > turned[0]) == ahead
    assert modes.whirl(np.array([1, z, 0])) == (1 if ahead else -1)


def test_where_modes_cross_the_speed_of_the_shaft():
    """Between runs, of modes that are there in both; one that only comes or goes crosses nothing."""
    speed = np.array([3000.0, 6000.0, 9000.0])
    frequency = np.array(
        [[80.0, 40.0, np.nan, 10.0], [80.0, 90.0, 120.0, np.nan], [80.0, 140.0, 100.0, 200.0]]
    )
    at, of = vibrations.crossings(speed, frequency)
    np.testing.assert_allclose(at, [4800, 6000 + 3000 * 2 / 7])
    np.testing.assert_allclose(of, at / 60)
