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


def test_a_seal_with_a_table_is_that_of_ross(program, ross, tmp_path):
    """With the coefficients at a speed of the table: between them ROSS is not linear by default."""
    discs, unbalance = ROTORS["disc in the middle"]
    columns = "speed_rpm,k_yy,k_yz,k_zy,k_zz,c_yy,c_yz,c_zy,c_zz"
    rows = [f"{speed},{3e7 + speed},2e7,-1.5e7,{4e7},3e4,-2e3,1e3,5e4" for speed in (2000, *SPEEDS, 9000)]
    (tmp_path / "seal.csv").write_text("\n".join([columns, *rows, ""]))
    rotor = shaft(discs) + "\n&element station=5, file='seal.csv', static=.false. /\n"
    values, moved, matrices = linear(program, tmp_path, rotor, unbalance, SPEEDS[-1])
    with package.read(tmp_path / "machine.h5") as run, pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path)
        package.to_ross(run, tmp_path / "seal.toml", element=1)
    found = by_ross(ross, discs, unbalance, SPEEDS[-1], matrices, tmp_path / "seal.toml")
    theirs = found["eigenvalues"] @ [1, 1j]
    assert farthest(vibrating(values, HIGHEST), theirs) < 1e-6
    np.testing.assert_allclose(whirl_of(found), moved, rtol=0, atol=1e-6 * abs(moved).max())
    without = by_ross(ross, discs, unbalance, SPEEDS[-1], matrices)["eigenvalues"] @ [1, 1j]
    assert farthest(vibrating(values, HIGHEST), without) > 1e-3
