"""Bearings for ROSS, in ROSS itself: in what it answered when make ross last asked it."""

import itertools
import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
import tiltpad
from ross_machine import in_ross

SPEEDS = [4000, 4500, 5000, 5500, 6000, 6500]
#: Speed of the march, rpm; mass, kg; unbalance, kg m: an orbit of 0.08 um, in which the film is linear.
SPEED, MASS, UNBALANCE = 5000, 1200.0, 1e-4
#: Of march and ROSS: the march's own error; ten times the unbalance adds 5e-5, as its square demands.
CLOSE = 2e-5


@pytest.fixture(scope="module")
def study(runs_of, cases, tmp_path_factory):
    """The offset bearing at several speeds; one run has no equilibrium."""
    folder = tmp_path_factory.mktemp("studies") / "speeds"
    runs_of(folder, cases["offset"], {"operation%speed_rpm": [*SPEEDS, 9000]}, failed=(len(SPEEDS) + 1,))
    tiltpad.collect(folder, folder.with_suffix(".h5"))
    with tiltpad.read_study(folder.with_suffix(".h5")) as opened:
        yield opened


@pytest.mark.parametrize("over", ["speed", "frequency", "both"])
def test_ross_reads_the_tables(ross, study, run, tmp_path, over):
    """At the tabulated points to rounding; between 25 frequencies as close as its interpolation."""
    source = run("offset") if over == "frequency" else study
    axes = tiltpad.to_ross(source, tmp_path / "bearing.toml", over=over, pivot="stuck")
    speeds = axes["speed"] if over != "frequency" else np.array([6500 * np.pi / 30])
    whirls = np.tile(axes["frequency"], (len(speeds), 1)) if over != "speed" else speeds[:, None]
    near(ross, source, tmp_path / "bearing.toml", speeds, whirls, max(1e-12, ross.close))
    near(read_at, source, tmp_path / "bearing.toml", speeds, whirls, 1e-12)
    if over == "both":
        near(ross, source, tmp_path / "bearing.toml", speeds, (whirls[:, 1:] + whirls[:, :-1]) / 2, 1e-3)


def read_at(bearing, points):
    """Stiffness and damping in the file's own tables, which have these points one after another."""
    (table,) = tomllib.loads(Path(bearing).read_text()).values()
    named = [name in table for name in ("speed", "frequency")]
    rows = itertools.product(*(table[name] for name in itertools.compress(("speed", "frequency"), named)))
    assert list(rows) == [tuple(itertools.compress((speed, whirl), named)) for whirl, speed in points]
    return {
        name: np.transpose([np.ravel(table[letter + axes]) for axes in ("xx", "xy", "yx", "yy")]).reshape(
            -1, 2, 2
        )
        for name, letter in (("stiffness", "k"), ("damping", "c"))
    }


def near(ross, source, bearing, speeds, whirls, within):
    """ROSS's matrices at some frequencies for each speed are those of this program."""
    points = [(whirl, speed) for speed, row in zip(speeds, whirls, strict=True) for whirl in row]
    found = ross(bearing=str(bearing), points=points)
    for k, (whirl, speed) in enumerate(points):
        which = {"speed_rpm": speed * 30 / np.pi} if len(speeds) > 1 else None
        own = tiltpad.coefficients(source, "stuck", frequency_ratio=whirl / speed, where=which)
        for name in ("stiffness", "damping"):
            wanted = in_ross(getattr(own, name).reshape(2, 2))
            np.testing.assert_allclose(found[name][k], wanted, rtol=0, atol=within * np.abs(wanted).max())


def test_the_response_to_unbalance_is_that_of_the_march(ross, study, run, tmp_path, monkeypatch, program):
    """Synchronous amplitude and phase of both axes; a mirrored sense of rotation is far off."""
    monkeypatch.setenv("TILTPAD", program)
    case = {name: values for name, values in run("offset").input.items() if name != "coefficients"}
    case["case"] = {"task": "march"}
    case["operation"] = {"speed_rpm": SPEED, "duration": 0.2}
    case["friction"] = {"model": "none"}
    case["output"] |= {"keep": "all"}
    case["rotor"] |= {"unbalance": UNBALANCE}
    case["integration"] = {"relative_tolerance": 1e-9}
    with tiltpad.run(case) as march:
        marched = synchronous(march)
    bearing = tmp_path / "bearing.toml"
    # an unbalance along +y is a quarter turn ahead of x
    asked = {"mass": MASS, "unbalance": UNBALANCE, "phase": np.pi / 2, "speeds": [SPEED * np.pi / 30]}
    for over, within in (("speed", CLOSE), ("both", 10 * CLOSE)):
        tiltpad.to_ross(study, bearing, over=over)
        found = ross(bearing=str(bearing), **asked)
        assert distance(found, marched) < within, over
    tiltpad.to_ross(study, bearing, over="speed")
    bearing.write_text("\n".join(map(mirrored, bearing.read_text().splitlines())))
    assert distance(ross(bearing=str(bearing), **asked), marched) > 0.1


def synchronous(run):
    """Complex amplitudes of y and z at the speed of the shaft over the last four revolutions."""
    part = tiltpad.last_revolutions(run, 4)
    angle = run.values("shaft_angle", part)
    wave = np.exp(-1j * angle)
    found = []
    for name in ("journal_y", "journal_z"):
        moved = run.values(name, part) - run[f"equilibrium/{name}"]
        found.append(2 * np.trapezoid(moved * wave, angle) / (angle[-1] - angle[0]))
    return np.array(found)


def distance(found, marched):
    """Of ROSS's motion, x = -z, from the march's."""
    x, y = (found[name][0] @ [1, 1j] for name in "xy")
    return np.linalg.norm([y, -x] - marched) / np.linalg.norm(marched)


def mirrored(line):
    """The line with the cross-coupled terms of the other sense of rotation."""
    name, equals, values = line.partition(" = ")
    if name not in ("kxy", "kyx", "cxy", "cyx"):
        return line
    return f"{name}{equals}{[-each for each in json.loads(values)]}"


def test_keywords_without_ross(study, run, tmp_path):
    """Shapes, axes, and runs without equilibrium left out."""
    both = tiltpad.to_ross(study)
    assert both["kxx"].shape == (len(SPEEDS), 25)
    np.testing.assert_allclose(both["speed"] * 30 / np.pi, SPEEDS)
    assert tiltpad.to_ross(study, frequency=[100, 300])["cyx"].shape == (len(SPEEDS), 2)
    over = tiltpad.to_ross(study, over="speed")
    assert "frequency" not in over
    assert over["kxx"].shape == (len(SPEEDS),)
    one = tiltpad.to_ross(run("offset"))
    np.testing.assert_allclose(one["frequency"], 6500 * np.pi / 30 * np.array([0.5, 1, 2]))
    assert "speed" not in one
    own = tiltpad.coefficients(study, frequency_ratio=1).stiffness[:-1, 0]
    np.testing.assert_array_equal(over["kxx"], own[:, 1, 1])
    np.testing.assert_array_equal(over["kxy"], -own[:, 1, 0])
    np.testing.assert_array_equal(over["kyx"], -own[:, 0, 1])
    np.testing.assert_array_equal(over["kyy"], own[:, 0, 0])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"over": "time"}, "over = time: must be speed, frequency, both"),
        ({"over": "speed", "frequency": [1]}, "frequency: not for tables over the speed"),
        ({"over": "frequency"}, "of one run, choose it by where"),
        ({"frequency": [-1.0]}, "must be numbers from 0 on"),
        ({"frequency": []}, "must be numbers from 0 on"),
        ({"path": "bearing.json"}, "the name must end in .toml"),
    ],
)
def test_wrong_arguments(study, options, message):
    with pytest.raises(ValueError, match=message):
        tiltpad.to_ross(study, **options)


def test_several_members_at_one_speed(tiltpad, tmp_path):
    import tiltpad as package

    (tmp_path / "case.nml").write_text("&case task='coefficients' /\n")
    varied = ["sweep%operation%speed_rpm=3000,4000", "sweep%rotor%mass=1000,2000", "sweep%order=product"]
    words = [word for each in varied for word in ("--set", each)]
    tiltpad("--quiet", "case.nml", *words, "--output", "loads", cwd=tmp_path, status=0)
    with package.read_study(tmp_path / "loads.h5") as study:
        with pytest.raises(ValueError, match="several runs at 3000 rpm, which differ in mass: choose"):
            package.to_ross(study)
        assert package.to_ross(study, where={"mass": 1000})["kxx"].shape == (2,)
