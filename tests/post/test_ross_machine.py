"""Machines against ROSS: the shaft, its modes over the speed and its whirl, with the same bearings."""

import h5py
import numpy as np
import pytest
import tiltpad as package
from test_ross import in_ross
from test_ross_rotor import seen_from_outside

SPEEDS = [3000, 6000]
#: Place of the pivots that are locked, whose bearings couple y and z as strongly as they resist.
LOCKED = 1
#: All modes of the shaft, without damping: the equations of ROSS.
CASE = """
&case task = 'coefficients' /
&operation speed_rpm = {speed} /
{rotor}
&unbalance station = {unbalance}, moment = 0.02, angle_deg = 0 /
&reduction frequency = 1e7, damping_ratio = 0 /
&bearing name = 'left', station = 2 /
&bearing name = 'right', station = 12, assembled_clearance = 90e-6 /
&film cavitation = 'none' /
"""
LENGTH, DIAMETER = [0.05, 0.05, *[0.2] * 8, 0.05, 0.05], [*[0.0998] * 2, *[0.34] * 8, *[0.0998] * 2]
#: Station, mass, diametral and polar moment of inertia of discs; station of the unbalance.
DISC = (2847.3706547456786, 280.5609218476075, 512.526717854222)
ROTORS = {
    "disc in the middle": ([(7, *DISC)], 7),
    "off the middle and overhung": ([(5, *DISC), (13, 300.0, 12.0, 20.0)], 13),
}


def shaft(discs):
    """The rotor's groups."""
    lines = [f"&shaft length = {row(LENGTH)}, diameter = {row(DIAMETER)} /"]
    names = ("station", "mass", "diametral_inertia", "polar_inertia")
    for each in discs:
        lines.append(f"&disc {', '.join(f'{k} = {v!r}' for k, v in zip(names, each, strict=True))} /")
    return "\n".join(lines)


def row(values):
    return ", ".join(map(repr, values))


def linear(tiltpad, folder, rotor, unbalance, speed):
    """Eigenvalues and whirl, (station, y and z), on the bearings' synchronous matrices, and these."""
    path = folder / "machine.nml"
    path.write_text(CASE.format(speed=speed, rotor=rotor, unbalance=unbalance))
    tiltpad("--quiet", "--overwrite", path, "--output", folder / "machine.h5", cwd=folder, status=0)
    with h5py.File(folder / "machine.h5") as file:
        values = (
            file["synchronous/eigenvalue_real"][LOCKED] + 1j * file["synchronous/eigenvalue_imag"][LOCKED]
        )
        moved = [
            file[f"response/{name}_real"][LOCKED] + 1j * file[f"response/{name}_imag"][LOCKED]
            for name in "yz"
        ]
        matrices = {
            name: [file[f"bearings/{b}/coefficients/{name}"][LOCKED, 0] for b in ("left", "right")]
            for name in ("stiffness", "damping")
        }
    return values[np.isfinite(values)], np.transpose(moved), matrices


def by_ross(ross, discs, unbalance, speed, matrices):
    """ROSS's rotor on the same matrices. Its nodes count from 0; +y is a quarter turn ahead of its x."""
    return ross(
        machine={
            "length": LENGTH,
            "diameter": DIAMETER,
            "discs": [(station - 1, *rest) for station, *rest in discs],
            "nodes": [1, 11],
            "speed": speed * np.pi / 30,
            "unbalance": [unbalance - 1, 0.02, np.pi / 2],
            **{name: [in_ross(each).tolist() for each in values] for name, values in matrices.items()},
        }
    )


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("name", ROTORS)
def test_modes_and_whirl_are_those_of_ross(tiltpad, ross, tmp_path, name, speed):
    """With the other sign of G, that of the other sense of rotation, modes are far off."""
    discs, unbalance = ROTORS[name]
    values, moved, matrices = linear(tiltpad, tmp_path, shaft(discs), unbalance, speed)
    found = by_ross(ross, discs, unbalance, speed, matrices)
    theirs = found["eigenvalues"] @ [1, 1j]
    slow = values[(values.imag > 0) & (abs(values) < 1e4)]
    assert len(slow) >= 4
    np.testing.assert_allclose([nearest(theirs, each) for each in slow], slow, rtol=1e-6)
    x, y = np.moveaxis(found["moved"] @ [1, 1j], -1, 0)
    np.testing.assert_allclose(np.transpose([y, -x]), moved, rtol=0, atol=1e-6 * abs(moved).max())
    theirs = by_ross(ross, discs, unbalance, -speed, matrices)["eigenvalues"] @ [1, 1j]
    assert max(abs(nearest(theirs, each) / each - 1) for each in slow) > 1e-3


def nearest(values, value):
    return values[abs(values - value).argmin()]


@pytest.mark.parametrize("name", ROTORS)
def test_a_rotor_of_ross_is_the_shaft_itself(tiltpad, ross, tmp_path, name):
    """Matrices that ROSS made, written by from_ross and read in place of shaft and discs."""
    discs, unbalance = ROTORS[name]
    values, moved, matrices = linear(tiltpad, tmp_path, shaft(discs), unbalance, SPEEDS[-1])
    package.from_ross(
        seen_from_outside(by_ross(ross, discs, unbalance, SPEEDS[-1], matrices)), tmp_path / "rotor.h5"
    )
    given, whirl, _ = linear(tiltpad, tmp_path, "&rotor file = 'rotor.h5' /", unbalance, SPEEDS[-1])
    slow = values[abs(values) < 1e4]
    np.testing.assert_allclose([nearest(given, each) for each in slow], slow, rtol=1e-7)
    np.testing.assert_allclose(whirl, moved, rtol=0, atol=1e-7 * abs(moved).max())
