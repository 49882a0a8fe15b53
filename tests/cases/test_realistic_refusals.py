"""Load on a pad, no preload, pivots in the middle: a bearing without an equilibrium is refused with the cause
and with a start from which it marches."""

import re
import sys
from pathlib import Path

import h5py
import pytest

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS / "stress"), str(TESTS / "realistic")]
from bearings import draw  # noqa: E402
from stress_cases import text  # noqa: E402

SEED = 7
#: Revolutions in which unloaded pads leave zero tilt and flutter.
REVOLUTIONS = 20
#: Number of the bearing, cause, start that is offered.
REFUSED = {
    40: (r"statically unstable \(divergence\): a small motion of pads? [\d, ]+ grows by", "partial"),
    268: (r"statically unstable \(divergence\): a small motion of pads? [\d, ]+ grows by", "centred"),
    713: (r"pads? [\d, ]+ \(unloaded\) did not come to equilibrium", "partial"),
}


@pytest.mark.parametrize("number", REFUSED)
def test_refused_with_a_start_that_works(tiltpad, tmp_path, number):
    case = draw(SEED, number)
    case["operation"]["duration"] = REVOLUTIONS * 60 / case["operation"]["speed_rpm"]
    (tmp_path / "case.nml").write_text(text(case))
    message = tiltpad("case.nml", cwd=tmp_path, status=2).stderr
    cause, start = REFUSED[number]
    assert re.search(cause, message), message
    assert f"start%from = '{start}'" in message
    tiltpad("case.nml", "-q", overrides=(f"start%from='{start}'",), cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["summary/pad_flutters"][()].any()


@pytest.mark.parametrize("number", REFUSED)
def test_more_preload_helps(tiltpad, tmp_path, number):
    case = draw(SEED, number)
    case["case"]["task"] = "equilibrium"
    (tmp_path / "case.nml").write_text(text(case))
    tiltpad("case.nml", "-q", overrides=("bearing%preload=0.2",), cwd=tmp_path, status=0)
