"""Rotors of ROSS as files of matrices."""

from types import SimpleNamespace

import h5py
import numpy as np
import pytest
import tiltpad

#: rad/s
SPEED = 300.0
UNBALANCE = 1e-3


@pytest.fixture(scope="module")
def turbine(ross):
    """What ROSS says of a rotor with an overhung disk."""
    return ross(turbine=SPEED)


@pytest.fixture
def rotor(turbine):
    return seen_from_outside(turbine)


def seen_from_outside(found):
    """The rotor as from_ross sees it: ROSS has an environment of its own."""
    places = dict(zip(("x_0", "y_0", "alpha_0", "beta_0"), found["places"].tolist(), strict=True))
    return SimpleNamespace(
        **{name: found[name] for name in ("M0", "C0", "G0", "K0")},
        number_dof=int(found["dof"]),
        nodes=range(int(found["nodes"])),
        shaft_elements=[SimpleNamespace(dof_mapping=lambda: places)],
        point_mass_elements=[],
    )


def test_the_matrices_vibrate_as_ross(turbine, rotor, tmp_path):
    """Unbalance at the phase 0 of ROSS, along its x, which is -z."""
    tiltpad.from_ross(rotor, tmp_path / "rotor.h5")
    with h5py.File(tmp_path / "rotor.h5") as file:
        found = {name: file[name][()] for name in file}
    station = found["station"]
    assert found["total_mass"] == pytest.approx(turbine["mass"], rel=1e-12)
    stiffness = found["stiffness"].copy()
    for node in (0, 4):
        for row, spring in ((2 * node, 5e7), (2 * node + 1, 3e7)):
            stiffness += spring * np.outer(station[row], station[row])
    dynamic = stiffness - SPEED**2 * found["mass"]
    dynamic = dynamic + 1j * SPEED * (found["damping"] + SPEED * found["gyroscopic"])
    # along -z at first, and a quarter turn later along y
    force = UNBALANCE * SPEED**2 * (-station[13] - 1j * station[12])
    y, z = station[12:14] @ np.linalg.solve(dynamic, force)
    x_ross, y_ross = turbine["moved"] @ [1, 1j]
    assert abs(y_ross) > 1e-7
    np.testing.assert_allclose([-z, y], [x_ross, y_ross], rtol=1e-9)


def test_slopes_and_weight(rotor, tmp_path):
    """A rotation about z, dy/dx = 1, is a rigid motion; weight acts along y alone."""
    tiltpad.from_ross(rotor, tmp_path / "rotor.h5")
    with h5py.File(tmp_path / "rotor.h5") as file:
        found = {name: file[name][()] for name in file}
    stiffness, station, slope = (found[name] for name in ("stiffness", "station", "slope"))
    position = 0.2 * np.arange(7)
    for plane in (0, 1):
        turned = position @ station[plane::2] + slope[plane::2].sum(axis=0)
        assert abs(stiffness @ turned).max() < 1e-9 * abs(stiffness).max()
    assert found["weighed"] @ station[::2].sum(axis=0) == pytest.approx(found["total_mass"])
    assert found["weighed"] @ station[1::2].sum(axis=0) == 0
    np.testing.assert_array_equal(found["gyroscopic"], -found["gyroscopic"].T)


def test_point_masses_are_refused(rotor, tmp_path):
    rotor.point_mass_elements = [None]
    with pytest.raises(ValueError, match="point masses"):
        tiltpad.from_ross(rotor, tmp_path / "rotor.h5")


class SealElement(SimpleNamespace):
    """What from_ross looks at in a seal of ROSS."""


AXES = ("xx", "xy", "yx", "yy")


def seal(node, link=None, speed=None, frequency=None, shape=(), **more):
    """One with other coefficients in every place."""
    count = int(np.prod(shape))
    own = {
        f"{letter}{axes}": 10.0**power * (1 + i + 0.1 * np.arange(count).reshape(shape))
        for letter, power in (("k", 6), ("c", 3), ("m", 0))
        for i, axes in enumerate(AXES)
    }
    return SealElement(n=node, n_link=link, speed=speed, frequency=frequency, **own | more)


SPEEDS, WHIRLS = np.array([100.0, 300.0, 900.0]), np.array([50.0, 400.0])
SEALS = (
    seal(1),
    seal(2, link=4, speed=SPEEDS, shape=(3,)),
    seal(3, frequency=WHIRLS, shape=(2,)),
    seal(4, speed=SPEEDS, frequency=WHIRLS, shape=(3, 2), mxx=0.0, mxy=0.0, myx=0.0, myy=0.0),
)


def test_seals_come_and_go(rotor, tmp_path):
    """What from_ross takes to_ross gives back; over the frequency alone at two speeds."""
    rotor.bearing_elements = [SimpleNamespace(n=0), *SEALS]
    bearings = [{"name": "left", "station": 1}, {"name": "right", "station": 6}]
    groups = tiltpad.from_ross(rotor, tmp_path / "rotor.h5")
    case = {"bearing": bearings, "operation": {"speed_rpm": 3000}, "film": {"cavitation": "none"}}
    with tiltpad.run(groups | case, case={"task": "coefficients"}) as run:
        for number, element in enumerate(SEALS, 1):
            found = tiltpad.to_ross(run, element=number)
            assert run.input["element"][number - 1]["station"] == element.n + 1
            for name in (letter + axes for letter in "kcm" for axes in AXES):
                expected = np.asarray(getattr(element, name), dtype=float)
                np.testing.assert_allclose(
                    found[name], np.broadcast_to(expected, found[name].shape), rtol=1e-12
                )
            if element.speed is not None:
                np.testing.assert_allclose(found["speed"], SPEEDS, rtol=1e-12)
            if element.frequency is not None:
                np.testing.assert_allclose(found["frequency"], WHIRLS, rtol=1e-12)
        assert run.input["element"][1]["to_station"] == 5
        assert not run.input["element"][0]["static"]
        with pytest.raises(ValueError, match="element 5: it has 4 of them"):
            tiltpad.to_ross(run, element=5)


def test_an_end_beside_the_shaft_is_refused(rotor, tmp_path):
    with pytest.raises(ValueError, match="n_link = 9: is no node of the shaft"):
        tiltpad.from_ross(rotor, tmp_path / "rotor.h5", [seal(1, link=9)])
