"""Load on a pad, no preload, pivots in the middle: a bearing without an equilibrium is refused with the cause
and with a start from which it marches."""

import re
import shlex
import sys
from functools import cache
from pathlib import Path

import h5py
import pytest

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS / "stress"), str(TESTS / "realistic")]
from bearings import draw  # noqa: E402
from stress_cases import text  # noqa: E402

SEED = 7
#: Revolutions in which unloaded pads leave zero tilt and flutter.
REVOLUTIONS = 12
REFUSED = (40, 713)
#: What may be the cause: which of them is found hangs on rounding.
CAUSE = (
    r"statically unstable \(divergence\): a small motion of pads? [\d, ]+ grows by \S+ 1/s|"
    r"pads? [\d, ]+ (\(unloaded\) did not come to equilibrium|ha(s|ve) no equilibrium \(unloaded\))|"
    # on some machines rounding ends the search of a bearing elsewhere, and the start is the centred one
    r"the search did not end"
)


@pytest.mark.parametrize("number", REFUSED)
def test_refused_with_a_start_that_works(tiltpad, tmp_path, number):
    case = draw(SEED, number)
    case["operation"]["duration"] = REVOLUTIONS * 60 / case["operation"]["speed_rpm"]
    (tmp_path / "case.nml").write_text(text(case))
    message = tiltpad("case.nml", cwd=tmp_path, status=2).stderr
    assert re.search(CAUSE, message), message
    start = re.search("start%from = '(partial|centred)'", message)[1]
    tiltpad("case.nml", "-q", overrides=(f"start%from='{start}'",), cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["summary/pad_flutters"][()].any()


@pytest.mark.parametrize("number", REFUSED)
def test_more_preload_helps(tiltpad, tmp_path, number):
    case = draw(SEED, number)
    case["case"]["task"] = "equilibrium"
    (tmp_path / "case.nml").write_text(text(case))
    tiltpad("case.nml", "-q", overrides=("bearing%preload=0.2",), cwd=tmp_path, status=0)


def test_film_temperatures_beside_a_fold(tiltpad, tmp_path):
    """From 47,000 rpm on pad 2 of bearing 139 tips; its equilibrium changes little with the speed."""
    case = draw(SEED, 139)
    case["case"]["task"] = "equilibrium"
    case["thermal"]["model"] = "film"
    (tmp_path / "case.nml").write_text(text(case))
    found = {}
    for speed in (48300, case["operation"]["speed_rpm"]):
        settings = (f"operation%speed_rpm={speed}",)
        tiltpad("case.nml", "-q", "--overwrite", overrides=settings, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "case.h5") as file:
            found[speed] = {
                name: file[f"equilibrium/{name}"][()] for name in ("journal_y", "maximum_temperature")
            }
    one, other = found.values()
    assert abs(one["journal_y"] - other["journal_y"]) < 0.02 * abs(one["journal_y"])
    assert abs(one["maximum_temperature"] - other["maximum_temperature"]).max() < 1


@pytest.fixture(scope="module")
def refused(tiltpad, tmp_path_factory):
    """refused(202): the folder of a bearing with film temperatures, its speed, the line that refuses it.

    Options are variables of the group film.
    """

    @cache
    def equilibrium(number, **film):
        folder = tmp_path_factory.mktemp("refused")
        case = draw(SEED, number)
        case["case"]["task"] = "equilibrium"
        case["thermal"]["model"] = "film"
        case["film"] |= film
        (folder / "case.nml").write_text(text(case))
        return folder, case["operation"]["speed_rpm"], tiltpad("case.nml", cwd=folder, status=2).stderr

    return equilibrium


@pytest.mark.parametrize(
    ("number", "film", "words"),
    [
        (202, {}, r"the temperatures in the film of pad \d do not settle at 26193\.2 rpm"),
        # with few cells, which take a tenth of the time
        (271, {"circumferential_cells": 40, "axial_cells": 6}, r"no equilibrium found at 3949\.07 rpm"),
    ],
)
def test_film_temperatures_without_an_equilibrium(tiltpad, refused, number, film, words):
    """Unloaded pads on pivots in their middle: there is one with a temperature for each, and with preload."""
    folder, _, message = refused(number, **film)
    assert re.search(f"{words}: .*try more preload", message), message
    assert "; thermal%model = 'pad' has an equilibrium" in message
    for setting in ("thermal%model='pad'", "bearing%preload=0.2"):
        tiltpad("case.nml", "-q", "--overwrite", overrides=(setting,), cwd=folder, status=0)


def test_a_branch_shows_up_to_which_speed_films_have_temperatures(tiltpad, refused):
    """That of the refusal of bearing 202 ends well below its speed."""
    folder, speed, refusal = refused(202)
    _, settings = refusal.split("a branch of equilibria shows how far there are some: ")
    # its upper end is a fold, along which it goes for hundreds of points more
    points = ("--set", "branch%max_points=30")
    tiltpad("case.nml", *shlex.split(settings), *points, "-q", "--output", "branch.h5", cwd=folder)
    with h5py.File(folder / "branch.h5") as file:
        speeds = file["parameter"][()]
    assert len(speeds) > 10
    assert 0.6 < speeds.max() / speed < 0.9
    assert abs(speeds[-3:] - speeds.max()).max() < 1e-3 * speed
