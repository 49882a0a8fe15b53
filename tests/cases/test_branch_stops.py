"""Branches that are stopped or killed at given moments, and go on: the same bits. Checkpoints that are none.

A small library counts how often the program asks for memory, which it does all the time, and sends a signal
at one of these requests: so that a moment is the same on every machine.
"""

import signal

import h5py
import numpy as np
import pytest
from conftest import EVERY_STEP, arrays, one_error, wait_for_checkpoint

#: Sends SIGNAL to the program, not to a child that opens a file for it, at its request number REQUEST.
AT_A_REQUEST = """
#include <signal.h>
void *__libc_malloc(size_t);
void *malloc(size_t size)
{
   static long requests;
   static pid_t own;
   if (!own) own = getpid();
   if (getenv("REQUEST") && own == getpid() && ++requests == atol(getenv("REQUEST")))
      raise(atoi(getenv("SIGNAL")));
   return __libc_malloc(size);
}
"""
BRANCH = "&case task='branch' / &output samples_per_revolution=90 /\n"
#: Equilibria that lose their stability and find it again.
EQUILIBRIA = f"""{BRANCH}&rotor mass=200 / &operation speed_rpm=14700 /
&branch of='equilibrium', parameter='operation%speed_rpm', last=15300, step=100, max_step=200 /
"""
#: Orbits in wide films without tables that cavitate; their period doubles, and the second branch leads back.
DOUBLED = f"""{BRANCH}&rotor mass=500, unbalance=0.007 /
&pads motion='fixed', pivot_angle_deg=-90,90, arc_deg=160 / &bearing preload=0 /
&branch parameter='rotor%unbalance', last=0.009, step=0.0005 /
"""
#: Orbits with sticking pads and films from tables.
LUGRE = f"""{BRANCH}&friction model='lugre' / &operation speed_rpm=11500 /
&branch parameter='operation%speed_rpm', last=11700, step=20, max_step=40 /
"""
#: Orbits with friction without bristles, whose pivots pass switching points.
SWITCHING = LUGRE.replace("lugre", "bengisu_akay").replace("11500", "6500").replace("11700", "6700")
#: Warm oil: its viscosities are unknowns of equilibria, and of orbits they are those of the equilibrium.
WARM = "&film cavitation='none' / &oil grade=46 / &thermal model='pad' /"
THERMAL_EQUILIBRIA = EQUILIBRIA.replace("14700", "13500").replace("15300", "14100") + WARM
UNEVEN_EQUILIBRIA = THERMAL_EQUILIBRIA.replace("'pad'", "'film'")
WARM_ORBITS = f"""{BRANCH}&operation speed_rpm=4000 / {WARM}
&branch parameter='oil%supply_temperature', last=41, step=0.1, max_step=0.1 /
"""
#: As these, with temperatures along and across the films.
UNEVEN_ORBITS = WARM_ORBITS.replace("'pad'", "'film'").replace("step=0.1", "step=0.2")
#: Limit cycles from a Hopf point, of pads that stick.
CYCLES = LUGRE.replace("last=11700, step=20, max_step=40", "of='limit_cycle', last=9300, step=50").replace(
    "&operation speed_rpm=11500", "&rotor unbalance=0 / &operation speed_rpm=9000"
)
#: Hopf points of pads that stick over two numbers, and Neimark-Sacker points of their orbits.
HOPF = CYCLES.replace(
    "'limit_cycle'", "'curve', point='hopf', second_parameter='rotor%mass', second_last=1500"
)
SACKER = HOPF.replace("hopf", "neimark_sacker").replace(
    "mass', second_last=1500", "unbalance', second_last=5e-3"
)
SACKER = SACKER.replace("unbalance=0", "mass=2000, unbalance=3e-3")
#: Films that are solved by SOR sweeps from the last ones.
RELAXED = EQUILIBRIA.replace("&rotor", "&film solver='sor', circumferential_cells=20, axial_cells=4 / &rotor")
#: What each stretch of a run has of its own, and the input, where the time between checkpoints may change.
OWN = ("created", "ended", "history", "resumes", "input")


def check_same(path, reference):
    """The same bits, texts and marks; the work that was done twice is counted twice."""
    own, expected = (arrays(each, "statistics", "checkpoint") for each in (path, reference))
    assert own.keys() == expected.keys()
    for name, values in own.items():
        np.testing.assert_array_equal(values, expected[name], err_msg=name)
    with h5py.File(path) as file, h5py.File(reference) as whole:
        assert file.attrs.keys() == whole.attrs.keys()
        for name in set(file.attrs) - set(OWN):
            assert file.attrs[name] == whole.attrs[name], name
        for name in ("rhs_evaluations", "jacobian_evaluations"):
            assert file["statistics"][name][()] >= whole["statistics"][name][()]


SLICED = {
    "equilibria": EQUILIBRIA,
    "relaxed": RELAXED,
    "doubled": DOUBLED,
    "lugre": LUGRE,
    "switching": SWITCHING,
    "cycles": CYCLES,
    "curve": HOPF,
    "neimark_sacker": SACKER,
    "warm equilibria": THERMAL_EQUILIBRIA,
    "uneven equilibria": UNEVEN_EQUILIBRIA,
    "warm": WARM_ORBITS,
    "uneven": UNEVEN_ORBITS,
}


# a stop and a checkpoint write the same
@pytest.mark.parametrize(
    ("name", "number"),
    [*((name, signal.SIGTERM) for name in SLICED), ("doubled", signal.SIGKILL), ("warm", signal.SIGKILL)],
)
def test_slices_of_a_branch_join_to_the_bit(run, tiltpad, tmp_path, loaded, name, number):
    """Slices that end after this many requests; one without a new point is followed by a longer one."""
    run(SLICED[name], more=("-o", "whole.h5"))
    path, library = tmp_path / "case.h5", loaded(AT_A_REQUEST, SIGNAL=str(int(number)))
    requests, points, stops, status = 20000, 0, 0, None
    while status != 0:
        done = tiltpad(
            "--resume", "case.h5", "case.nml", "-q", *EVERY_STEP,
            cwd=tmp_path, env=library | {"REQUEST": str(requests)},
        )  # fmt: skip
        status = done.returncode
        assert status in (0, 4, -signal.SIGKILL), done.stderr
        assert done.stderr.count("\n") == (status == 4)
        stops += status != 0
        reached = len(arrays(path)["point"]) if path.exists() else 0
        requests = requests + 997 if reached > points else requests * 3 // 2
        points = reached
    assert stops > 5
    check_same(path, tmp_path / "whole.h5")
    assert sorted(each.name for each in tmp_path.glob("case*")) == ["case.h5", "case.nml"]


@pytest.fixture
def stopped(start, tmp_path):
    """stopped(case): the result of this case with a checkpoint."""

    def stop(case):
        (tmp_path / "case.nml").write_text(case)
        process = start(tmp_path, "case.nml", "-q", *EVERY_STEP)
        wait_for_checkpoint(tmp_path / "case.h5", process)
        process.terminate()
        one_error(process, 4)
        return tmp_path / "case.h5"

    return stop


#: Lists of a checkpoint, each with the place of a number that others depend on.
OF_ORBITS = {"periods": 0, "interval_ends": 1, "switching_points": 1}


@pytest.mark.parametrize("case", [EQUILIBRIA, LUGRE, HOPF], ids=["equilibria", "lugre", "curve"])
def test_a_checkpoint_that_is_none(tiltpad, stopped, case):
    """Numbers that cannot be, and lists that are too short or not there."""
    path = stopped(case)
    good = path.read_bytes()

    def spoiled(spoil):
        path.write_bytes(good)
        with h5py.File(path, "r+") as file:
            spoil(file["checkpoint"])
        done = tiltpad("--resume", "case.h5", "-q", cwd=path.parent, status=3)
        assert not list(path.parent.glob("*.part"))
        return done.stderr

    def shorten(point, name):
        values = point[name][:-1]
        del point[name]
        if len(values):
            point[name] = values

    none = "tiltpad: error: case.h5: damaged: its checkpoint is none of this branch\n"
    with h5py.File(path) as file:
        point = file["checkpoint/point"]
        lists = [name for name, each in point.items() if each.shape]
        assert all(each.attrs["units"] and each.attrs["long_name"] for each in point.values())
    for name in lists:
        assert spoiled(lambda group, name=name: shorten(group["point"], name)) == none, name
        assert spoiled(lambda group, name=name: group["point"][name].__setitem__(0, np.nan)) == none, name
    for name, place in OF_ORBITS.items() if case == LUGRE else ():
        for value in (-2, 3e9, 1e300, -1e300):
            change = lambda group, n=name, p=place, v=value: group["point"][n].__setitem__(p, v)  # noqa: E731
            assert spoiled(change) == none, (name, value)
    assert spoiled(lambda group: group["branch"].__setitem__((), 0)) == none
    assert "damaged" in spoiled(lambda group: group.__delitem__("step"))
    assert "damaged" in spoiled(lambda group: group.file.attrs.__delitem__("branch_ends"))


def test_a_checkpoint_of_another_version(tiltpad, stopped):
    """One whose state is a list of numbers without names is refused in a line."""
    path = stopped(EQUILIBRIA)
    with h5py.File(path, "r+") as file:
        time = file["checkpoint/time"][()]
        del file["checkpoint"]
        file["checkpoint/time"] = time
        file["checkpoint/state"] = [1.0, 2.0, 3.0]
    done = tiltpad("--resume", "case.h5", "-q", cwd=path.parent, status=3)
    assert done.stderr == (
        "tiltpad: error: case.h5: its checkpoint is of another version of tiltpad; start the run anew\n"
    )


def test_checkpoints_of_equilibria_have_their_time(run, tmp_path, tiltpad, loaded):
    """Killed in its second half, a branch that is shorter than the time between them has left nothing."""
    (tmp_path / "case.nml").write_text(EQUILIBRIA)
    killed = loaded(AT_A_REQUEST, SIGNAL=str(int(signal.SIGKILL)), REQUEST="50000")
    done = tiltpad("case.nml", "-q", "--set", "output%checkpoint_seconds=60", cwd=tmp_path, env=killed)
    assert done.returncode == -signal.SIGKILL
    assert not (tmp_path / "case.h5").exists()
