"""The study of realistic bearings: it draws what a designer accepts; its errors are those of the motion."""

import sys
from pathlib import Path

import h5py
import pytest

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS / "stress"), str(TESTS / "realistic")]
import bearings  # noqa: E402
import fixed_bearings  # noqa: E402
from bearing_runs import CLOSEST, REVOLUTIONS, Bearing, changed, compare, march, settle, time_of  # noqa: E402
from march_errors import errors, period  # noqa: E402

SEED = 1
#: Fast bearings, of which the study has as many.
FAST = range(bearings.FAST_ABOVE + 1, bearings.FAST_ABOVE + 21)
#: Of fixed pads: all around, and two lobes.
FIXED = (fixed_bearings.FIXED_ABOVE + 5, fixed_bearings.FIXED_ABOVE + 7)


def test_a_designer_accepts_every_bearing():
    for number in (*range(1, 201), *FAST):
        case = bearings.draw(SEED, number)
        assert case == bearings.draw(SEED, number)
        if "thermal" not in case:
            assert bearings.accepted(case)
        assert 0.1e6 <= specific_load(case) <= 4e6


def test_fast_bearings_are_turbulent(program, tmp_path):
    """A film has a share of turbulence where its largest Reynolds number is beyond the transition."""
    case = bearings.draw(SEED, FAST[1])
    for number in FAST:
        drawn = bearings.draw(SEED, number)
        assert drawn["film"]["turbulence"] == "ng_pan"
        assert 50 <= bearings.surface_speed(drawn) <= 150
    case["case"]["task"] = "equilibrium"
    assert march(Path(program), case, tmp_path / "fast").complete
    with h5py.File(tmp_path / "fast.h5") as file:
        reynolds, share = (
            file[f"equilibrium/{name}"][()] for name in ("largest_reynolds_number", "turbulent_share")
        )
    assert ((share > 0) == (reynolds > 500)).all()
    assert share.max() > 0


@pytest.mark.parametrize("number", FIXED)
def test_fixed_pads_march_closely(program, tmp_path, number):
    """A plain bearing and a lemon bore, by the figures of docs/realistic.md."""
    case = fixed_bearings.draw(SEED, number)
    assert case == fixed_bearings.draw(SEED, number)
    bearing = Bearing(number, case)
    settle(Path(program), bearing, tmp_path)
    compare(Path(program), bearing, tmp_path, curve=False)
    assert bearing.compared
    assert bearing.runs["default"].errors["journal_clearance"] < 1e-3
    assert "tilt_loaded" not in bearing.runs["default"].errors
    with h5py.File(tmp_path / "default.h5") as file:
        assert file["statistics/film_table"][()] > 0
        assert file["statistics/film_volumes"][()] == 0


def specific_load(case):
    """Load over the projected area, Pa."""
    rotor, bearing = case["rotor"], case["bearing"]
    load = rotor["mass"] * bearings.GRAVITY - rotor.get("static_load", [0.0])[0]
    return load / (2 * bearing["journal_radius"] * bearing["axial_length"]) * (1 + 1e-12)


def test_errors_are_those_of_the_motion(program, tmp_path):
    """Nothing where a run is compared with itself or begins elsewhere; a load that differs by a hundredth is
    seen."""
    case = bearings.draw(SEED, 12)
    case["operation"]["duration"] = time_of(case, REVOLUTIONS)
    moved = changed(case, {"start": {"journal": [0.1 * case["bearing"]["assembled_clearance"], 0.0]}})
    heavier = changed(case, {"rotor": {"mass": 1.01 * case["rotor"]["mass"]}})
    for name, each in (("one", case), ("moved", moved), ("heavier", heavier)):
        assert march(Path(program), changed(each, CLOSEST), tmp_path / name).complete
    assert period(tmp_path / "one.h5", case) == 1
    assert max(errors(tmp_path / "one.h5", tmp_path / "one.h5", case).values()) == 0
    assert max(errors(tmp_path / "moved.h5", tmp_path / "one.h5", case).values()) < 1e-3
    found = errors(tmp_path / "heavier.h5", tmp_path / "one.h5", case)
    assert 3e-3 < found["force"] < 3e-2
    assert found["journal"] > 1e-3
