"""Machines against ROSS: the shaft, its modes over the speed and its whirl, with the same bearings."""

import subprocess

import h5py
import numpy as np
import pytest
import tiltpad as package
from ross_machine import ROOT, ROTORS, by_ross, farthest, linear, shaft, vibrating, whirl_of
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
    theirs = by_ross(ross, discs, unbalance, SPEEDS[-1], matrices, described=True)
    package.from_ross(seen_from_outside(theirs), tmp_path / "rotor.h5")
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


#: Film and lands of a damper, and what ROSS calls it: with a groove it cavitates in two lands of half the
#: length; unbalances, kg m, that drive the ring to 0.2 to 0.6 of its clearance.
DAMPERS = {
    ("pi", 1): ("groove-end_seals", True, 3e-3),
    ("full", 1): ("groove-end_seals", False, 5e-3),
    ("pi", 2): ("groove", True, 0.7e-3),
    ("sealed", 1): ("end_seals", False, 0.1),
}
RADIUS, LAND, CLEARANCE, DAMPED_SPEED = 0.05, 0.03, 0.1e-3, 6000


@pytest.mark.parametrize("film", DAMPERS)
def test_a_damper_on_a_circle_is_that_of_ross(program, ross, tmp_path, film):
    """Force over displacement and velocity of the rings of the aero rotor, which no weight lowers.

    ROSS has a stiffness of cavitated films alone.
    """
    geometry, cavitates, unbalance = DAMPERS[film]
    frequency = DAMPED_SPEED * np.pi / 30
    asked = {"frequency": [frequency], "axial_length": LAND, "journal_diameter": 2 * RADIUS,
             "radial_clearance": CLEARANCE, "geometry": geometry, "cavitation": cavitates}  # fmt: skip
    viscosity = float(ross(damper={**asked, "eccentricity_ratio": 0.1})["viscosity"])
    damper = {"film": film[0], "lands": film[1], "length": LAND / film[1], "viscosity": viscosity,
              "radius": RADIUS, "clearance": CLEARANCE, "offset": "0,0"}  # fmt: skip
    words = {"case%task": "periodic", "operation%speed_rpm": DAMPED_SPEED, "rotor%gravity": 0}
    words |= {f"unbalance({k})%moment": unbalance for k in (1, 2)}
    words |= {f"damper%{name}": value for name, value in damper.items()}
    command = [program, ROOT / "input/examples/aero.nml", "--quiet", "--output", tmp_path / "aero.h5"]
    subprocess.run(
        [*command, *(w for each in words.items() for w in ("--set", "{}={}".format(*each)))], check=True
    )
    with h5py.File(tmp_path / "aero.h5") as file:
        u, force = (file[f"{n}_y"][()] + 1j * file[f"{n}_z"][()] for n in ("element", "element_force"))
        front = file["rotor/element_name"][()].tolist().index(b"damper:front")
    u, force = u[:, front], force[:, front]
    ratio = abs(u) / CLEARANCE
    assert np.ptp(ratio) < 1e-5 * ratio.mean()
    assert 0.2 < ratio.mean() < 0.6
    theirs = ross(damper={**asked, "eccentricity_ratio": float(ratio.mean())})
    own = -force / u
    np.testing.assert_allclose(own.real.mean(), theirs["stiffness"], atol=1e-5 * abs(own).mean())
    np.testing.assert_allclose(own.imag.mean() / frequency, theirs["damping"], rtol=1e-4)
