"""Option --verify: what a run says of its own films, where, and what it leaves alone."""

import signal

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import arrays, one_error, wait_for_line
from tiltpad.draw.report import report

CASE = "&operation duration=0.05 / &friction model='lugre' /\n"
#: Tables' tolerance with the default settings: four times that of the march.
TOLERANCE = 4e-5
#: Of the names of the figures.
PREFIX = "pad_film_error"


def errors(path):
    """The figures of a file by their names, without `pad_film_error`."""
    with h5py.File(path) as file:
        own = file["summary"]
        return {name.removeprefix(PREFIX): own[name][:] for name in own if name.startswith(PREFIX)}


@pytest.fixture
def verified(run, tmp_path):
    """verified(case, overrides): the figures and what was printed."""

    def make(case, *overrides, states=40):
        done = run(case, *overrides, more=("--overwrite", "--verify", states))
        return errors(tmp_path / "case.h5"), done.stdout

    return make


def test_default_films_keep_the_tolerance_of_their_tables(verified):
    found, _ = verified(CASE)
    assert np.all(found["_max"] < TOLERANCE)
    # and they are not compared with themselves
    assert np.all(found["_max"] > 0)
    assert np.all((found[""] > 0) & (found[""] <= found["_max"]))
    assert np.all((found["_time"] >= 0) & (found["_time"] <= 0.05))
    assert np.all(found["_unknown"] == 0)


def test_loose_films_show_it(verified):
    """Hundreds of times the tolerance; the loaded pads' cells stop at their first size, far below it."""
    close, _ = verified(CASE)
    loose, _ = verified(CASE, "film%table_tolerance=1e-2")
    assert np.all(loose["_max"] > 10 * close["_max"])
    assert np.all(loose["_of_load"] > 10 * close["_of_load"])
    # the closely solved films are the same ones, whatever the run takes
    assert loose["_left"] == pytest.approx(close["_left"], rel=1)


def test_unloaded_pads_are_measured_by_what_they_carry(verified):
    """Errors of what an unloaded pad carries are nothing beside the load."""
    case = CASE + "&pads pivot_angle_deg=-45,225,45,135 /\n"
    found, _ = verified(case, "film%solver='sor'")
    loaded, unloaded = slice(2), slice(2, 4)
    assert np.all(found["_max"][unloaded] > 1e-3)
    assert np.all(found["_of_load"][unloaded] < 1e-2 * found["_of_load"][loaded].max())


@pytest.mark.parametrize("task", ["equilibrium", "coefficients"])
def test_an_equilibrium_is_one_state(verified, task):
    found, printed = verified(CASE, f"case%task='{task}'", states=7)
    assert "films in 1 state against" in printed
    assert "_time" not in found
    assert np.all((found["_max"] > 0) & (found["_max"] < TOLERANCE))
    assert found[""] == pytest.approx(found["_max"])


@pytest.mark.parametrize(
    ("model", "task"),
    [("pad", "equilibrium"), ("film", "equilibrium"), ("film", "march"), ("film", "periodic")],
)
def test_warm_oil(verified, model, task):
    """The films have the oil of the equilibrium: with any other their force would be another.

    Cells are for a usual error of the tolerance, and a film of an oil that varies may have somewhat more.
    """
    warm = f"&oil grade=46 / &thermal model='{model}' /\n"
    found, _ = verified(CASE + warm, f"case%task='{task}'")
    assert np.all(found["_max"] < (1.5 if model == "film" else 1) * TOLERANCE)


def test_over_an_orbit(verified):
    found, _ = verified(CASE, "case%task='periodic'")
    with_time = found["_time"]
    assert np.all(found["_max"] < TOLERANCE)
    assert np.all((with_time >= 0) & (with_time <= 60 / 6500))


def test_a_run_up_has_the_speed_and_oil_of_each_state(verified):
    case = CASE + "&oil grade=46, groove_volume=1e-5 / &thermal model='pad', march='groove' /\n"
    found, _ = verified(case, "operation%final_speed_rpm=9000")
    assert np.all(found["_max"] < TOLERANCE)


def test_file_console_and_report_say_the_same(verified, tmp_path):
    found, printed = verified(CASE)
    with h5py.File(tmp_path / "case.h5") as file:
        head, *pads = file.attrs["verification"].splitlines()
        assert file["summary/verified_states"][()] == 40
    assert "\n".join([head, *(f"  {line}" for line in pads)]) in printed
    words = {"": "median ", "_max": "largest ", "_of_load": "load ", "_left": "films "}
    for i, line in enumerate(pads):
        for name, before in words.items():
            told = float(line.split(before)[1].split()[0].rstrip(",;"))
            assert told == pytest.approx(found[name][i], rel=0.06)
    page = report(package.read(tmp_path / "case.h5"))
    assert all(f"{line[0].upper()}{line[1:]}." in page for line in (head, *pads))


def test_nothing_else_changes(run, tmp_path):
    """A run with its films verified has the bits of one without, but for times and what verification adds."""
    run(CASE, more=("-o", "without.h5"))
    run(CASE, more=("-o", "with.h5", "--verify", 10))
    without, with_it = arrays(tmp_path / "without.h5"), arrays(tmp_path / "with.h5")
    more = {name for name in with_it if "film_error" in name or "verified" in name}
    assert set(with_it) - more == set(without)
    assert len(more) == 8
    for name, values in without.items():
        assert "seconds" in name or np.array_equal(values, with_it[name], equal_nan=True), name
    with h5py.File(tmp_path / "without.h5") as file:
        assert "verification" not in file.attrs


def test_a_complete_result(tiltpad, run, tmp_path):
    """Verified later, with tables made anew, as in the run itself; once, and again for another number."""
    run(CASE, more=("-o", "at_once.h5", "--verify", 20))
    run(CASE, more=("-o", "later.h5"))
    later = tiltpad("--resume", "later.h5", "--verify", 20, cwd=tmp_path, status=0)
    assert "films in 20 states" in later.stdout
    for name, values in errors(tmp_path / "later.h5").items():
        assert values == pytest.approx(errors(tmp_path / "at_once.h5")[name], rel=1e-6), name
    again = tiltpad("--resume", "later.h5", "--verify", 20, cwd=tmp_path, status=0)
    assert again.stdout == "later.h5: complete already, nothing to do\n"
    other = tiltpad("--resume", "later.h5", "--verify", 5, cwd=tmp_path, status=0)
    assert "films in 5 states" in other.stdout
    with h5py.File(tmp_path / "later.h5", "r+") as file:
        file["journal_y"][:] = np.nan
    damaged = tiltpad("--resume", "later.h5", "--verify", 3, cwd=tmp_path, status=3)
    assert "damaged: a state is not a number" in damaged.stderr


def test_all_samples_of_a_short_run(verified):
    """One revolution has 361 of them."""
    _, printed = verified(CASE, "operation%duration=0.00924", "output%samples_per_revolution=8", states=9)
    assert "films in 9 states" in printed


@pytest.mark.parametrize(
    ("value", "said"),
    [(0, "1 or more"), (-3, "1 or more"), ("ten", "1 or more"), (1.5, "1 or more"), (10**12, "1 or more"),
     (1952, "--verify 1952: the run has 1951 samples")],
)  # fmt: skip
def test_wrong_numbers(run, tmp_path, value, said):
    done = run(CASE, more=("--verify", value), status=1)
    assert said in done.stderr
    assert not (tmp_path / "case.h5").exists()


def test_where_there_is_nothing_to_verify(run, tmp_path):
    assert "is for runs" in run(CASE, more=("--check", "--verify", 3), status=1).stderr
    assert "is for runs" in run(CASE, more=("--count", "--verify", 3), status=1).stderr
    branch = "&case task='branch' / &branch parameter='operation%speed_rpm', last=7000, step=100 /\n"
    assert "a branch keep no states" in run(branch, more=("--verify", 3), status=1).stderr
    assert not (tmp_path / "case.h5").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_stopped_while_films_are_verified(start, tiltpad, run, tmp_path, number):
    """The result is complete before, and stays so; its films can be verified later."""
    case = CASE + "&pads pivot_angle_deg=-45,225,45,135 /\n"
    run(case, more=("-o", "whole.h5"))
    process = start(tmp_path, "case.nml", "--verify", 1951)
    wait_for_line(process, "written: case.h5")
    process.send_signal(number)
    if number == signal.SIGKILL:
        process.communicate()
    else:
        error = one_error(process, 4)
        assert "signal 2 while films were verified; case.h5 is complete without that" in error
        assert {each.name for each in tmp_path.iterdir()} == {"case.nml", "case.h5", "whole.h5"}
    whole, left = arrays(tmp_path / "whole.h5", "statistics"), arrays(tmp_path / "case.h5", "statistics")
    assert set(whole) == set(left)
    for name, values in whole.items():
        # remarks are texts
        assert np.array_equal(values, left[name], equal_nan=values.dtype.kind == "f"), name
    tiltpad("case.nml", "--resume", "case.h5", "--verify", 3, cwd=tmp_path, status=0)
    assert np.all(errors(tmp_path / "case.h5")["_unknown"] == 0)


def test_a_complete_result_with_temperatures_along_the_films(tiltpad, run, tmp_path):
    """Tables that a long march has filled, and those made anew for a few states, where they would not pay."""
    case = "&operation duration=0.6 / &oil grade=46 / &thermal model='film' /\n"
    run(case, more=("-o", "at_once.h5", "--verify", 10))
    run(case, more=("-o", "later.h5"))
    tiltpad("--resume", "later.h5", "--verify", 10, cwd=tmp_path, status=0)
    direct = run(case, "film%solver=direct", more=("-o", "direct.h5", "--verify", 10))
    assert "films in 10 states" in direct.stdout
    for name, values in errors(tmp_path / "later.h5").items():
        assert values == pytest.approx(errors(tmp_path / "at_once.h5")[name], rel=1e-6), name
    assert np.all(errors(tmp_path / "direct.h5")["_max"] != errors(tmp_path / "later.h5")["_max"])
    assert np.all(errors(tmp_path / "later.h5")["_max"] < TOLERANCE)


def test_every_run_of_a_study(tiltpad, run, tmp_path):
    study = CASE + "&sweep operation%speed_rpm=4000,6000 /\n"
    run(study, more=("--verify", 5))
    times = [errors(tmp_path / f"case/000{k}.h5")["_time"] for k in (1, 2)]
    assert not np.array_equal(*times)
    before = [(tmp_path / f"case/000{k}.h5").stat().st_mtime_ns for k in (1, 2)]
    tiltpad("case.nml", "--verify", 5, cwd=tmp_path, status=0)
    assert before == [(tmp_path / f"case/000{k}.h5").stat().st_mtime_ns for k in (1, 2)]
    collected = package.read_study(package.collect(tmp_path / "case", tmp_path / "study.h5").output)
    assert collected["pad_film_error_max"].shape == (2, 2)
    assert np.all(collected["verified_states"] == 5)


def test_from_python(tmp_path):
    with package.run({"operation": {"duration": 0.01}}, tmp_path / "case.h5", verify=3) as own:
        assert own["summary/verified_states"] == 3
    with pytest.raises(ValueError, match="must be a whole number"):
        package.run({"case": {}}, verify=-1)
