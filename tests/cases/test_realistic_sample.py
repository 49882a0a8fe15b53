"""A sample of realistic bearings: those with the largest errors keep to the figures of docs/realistic.md."""

import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS / "stress"), str(TESTS / "realistic")]
from bearing_runs import SETTINGS, Bearing, compare, settle  # noqa: E402
from fixed_bearings import FIXED_ABOVE  # noqa: E402
from realistic import draw  # noqa: E402

SEED = 1
#: Unloaded pads that tilt (13, 14, 21, 87, 116) or rub (143), pads that flutter (160), loaded pads (111),
#: three lobes whose journals whirl (20024, 20059).
SAMPLE = (13, 14, 21, 87, 111, 116, 143, 160, 20024, 20059)
#: Largest errors of the default settings, those of fixed pads, and most steps a revolution.
LARGEST = {"journal": 2e-3, "tilt_loaded": 2e-2, "tilt_unloaded": 2e-2}
LARGEST_OF_FIXED = {"journal": 1e-3}
MOST_STEPS = 2000


@pytest.mark.parametrize("number", SAMPLE)
def test_default_settings(program, tmp_path, monkeypatch, number):
    # nothing is asked of it here
    monkeypatch.delitem(SETTINGS, "direct")
    bearing = Bearing(number, draw(SEED, number))
    settle(Path(program), bearing, tmp_path)
    compare(Path(program), bearing, tmp_path, curve=False)
    assert bearing.runs["long"].complete
    assert bearing.compared
    found = bearing.runs["default"].errors
    largest = LARGEST if number < FIXED_ABOVE else LARGEST_OF_FIXED
    assert {name: found[name] for name in largest if found.get(name, 0.0) > largest[name]} == {}
    # a pad that bounces takes the steps that its impacts ask for
    assert bearing.runs["long"].rate <= MOST_STEPS or bearing.bouncing_pads
