"""Machines against ROSS: the shaft, its modes over the speed and its whirl, with the same bearings."""

import numpy as np
import pytest
import tiltpad as package
from ross_machine import ROTORS, by_ross, farthest, linear, shaft, vibrating, whirl_of
from test_ross_rotor import seen_from_outside

SPEEDS = [3000, 6000]
#: rad/s
HIGHEST = 1e4


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("name", ROTORS)
def test_modes_and_whirl_are_those_of_ross(program, ross, tmp_path, name, speed):
    """With the other sign of G, that of the other sense of rotation, modes are far off."""
    discs, unbalance = ROTORS[name]
    values, moved, matrices = linear(program, tmp_path, shaft(discs), unbalance, speed)
    found = by_ross(ross, discs, unbalance, speed, matrices)
    theirs = found["eigenvalues"] @ [1, 1j]
    slow = vibrating(values, HIGHEST)
    assert len(slow) == len(vibrating(theirs, HIGHEST)) >= 4
    assert farthest(slow, theirs) < 1e-6
    assert farthest(vibrating(theirs, HIGHEST), values) < 1e-6
    np.testing.assert_allclose(whirl_of(found), moved, rtol=0, atol=1e-6 * abs(moved).max())
    theirs = by_ross(ross, discs, unbalance, -speed, matrices)["eigenvalues"] @ [1, 1j]
    assert farthest(slow, theirs) > 1e-3


@pytest.mark.parametrize("name", ROTORS)
def test_a_rotor_of_ross_is_the_shaft_itself(program, ross, tmp_path, name):
    """Matrices that ROSS made, written by from_ross and read in place of shaft and discs."""
    discs, unbalance = ROTORS[name]
    values, moved, matrices = linear(program, tmp_path, shaft(discs), unbalance, SPEEDS[-1])
    package.from_ross(
        seen_from_outside(by_ross(ross, discs, unbalance, SPEEDS[-1], matrices)), tmp_path / "rotor.h5"
    )
    given, whirl, _ = linear(program, tmp_path, "&rotor file = 'rotor.h5' /", unbalance, SPEEDS[-1])
    slow = values[abs(values) < 1e4]
    assert farthest(slow, given) < 1e-7
    np.testing.assert_allclose(whirl, moved, rtol=0, atol=1e-7 * abs(moved).max())
