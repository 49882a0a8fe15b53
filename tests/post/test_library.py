"""The compiled part: pressure fields of archived instants, contact, friction and spectra by the library."""

import ctypes
import gc
import subprocess
import sys

import numpy as np
import pytest
import tiltpad
from tiltpad.calculate import library

CASES = ["lugre", "tilting", "four", "gumbel", "sor", "flooded", "runup", "pitching"]
LUGRE = "&friction model='lugre' /"
BENGISU = "&friction model='bengisu_akay', critical_velocity=1e-3 /"


def integrals(case, film):
    """Force of the field, (pad, 2), by the trapezoidal rule."""
    bearing = case.input["bearing"]
    radius = bearing["journal_radius"] + np.array(bearing["machined_clearance"])
    line = np.trapezoid(film.pressure, film.z[:, None], axis=2)
    parts = [np.trapezoid(line * f(film.phi), film.phi, axis=1) for f in (np.sin, np.cos)]
    return -(radius * np.array(parts)).T


@pytest.mark.parametrize("case_name", [*CASES, "fixed", "equilibrium"])
def test_the_equilibrium_is_as_archived(run, case_name):
    """The same solver in the same state: to rounding, or to the tolerance of over-relaxation, 1e-6; but films
    with slopes of a march, as these are, know the pressure less closely than those of statics.
    """
    case = run(case_name)
    film = tiltpad.pressure(case)
    assert film.time is None
    accuracy = 2e-3 if case_name == "pitching" else 1e-6
    np.testing.assert_allclose(film.max_pressure, case["equilibrium/max_pressure"], rtol=accuracy)
    np.testing.assert_allclose(film.min_film_thickness, case["equilibrium/min_film_thickness"], rtol=1e-9)


@pytest.mark.parametrize("case_name", CASES)
def test_rebuilt_forces_are_those_archived(run, case_name):
    """A sample is the polynomial of the step through the values at its ends (docs/theory), not a film
    solved there, and the states for the rebuilt film are CVODE's interpolation. Both are as accurate as the
    march, 1e-5 of the scales of the states at the default tolerance; squeeze makes it several times that of
    the range of the force. The samples come from tables of converged films, the rebuilt ones from `direct`,
    whose finite volumes err by 2e-4 of it where the film cavitates. The maximum pressure is that at the
    points of the solver. It has switching points where it passes from one point to the next, of 1e-3 of the
    range, which no polynomial follows. The minimum film thickness in the file is calculated from the states.
    """
    case = run(case_name)
    force = np.stack([case.film_force_tangential, case.film_force_radial], axis=2)
    samples = np.unique(np.linspace(1, case.samples - 1, 40).astype(int))
    films = [tiltpad.pressure(case, case.time[k], 3, 3) for k in samples]
    assert [film.time for film in films] == list(case.time[samples])
    for name, archived, tolerance in (
        ("force", force, 3e-4),
        ("max_pressure", case.max_pressure, 3e-3),
        ("min_film_thickness", case.min_film_thickness, 1e-9),
    ):
        rebuilt = np.array([getattr(film, name) for film in films])
        span = np.ptp(archived, axis=0).max()
        assert np.abs(rebuilt - archived[samples]).max() < tolerance * span, name


@pytest.mark.parametrize("case_name", CASES)
def test_the_field_carries_the_force(run, case_name):
    """Trapezoidal rule on 241 x 81 points: 3e-4 of the force of a loaded pad; and what a field of finite
    volumes has at most (tests/unit/test_film_field.f90).
    """
    case = run(case_name)
    film = tiltpad.pressure(case, case.time[-1], 241, 81)
    assert film.pressure.shape == (case.pads, 241, 81)
    error = np.abs(integrals(case, film) - film.force).max()
    assert error < (3e-3 if case_name == "sor" else 3e-4) * np.abs(film.force).max()
    coarse = tiltpad.pressure(case, case.time[-1], 31, 11)
    assert np.abs(integrals(case, coarse) - film.force).max() > 2 * error
    # the highest point of the field lies between the solver's points
    loaded = film.max_pressure > 0.1 * film.max_pressure.max()
    rise = film.pressure.max(axis=(1, 2)) / film.max_pressure - 1
    assert np.all(np.abs(rise[loaded]) < 5e-3)


def test_edges_have_the_pressures_of_the_input(run):
    case = run("flooded")
    film = tiltpad.pressure(case, 0.01)
    np.testing.assert_allclose(film.pressure[:, 0, :], 1e5)
    np.testing.assert_allclose(film.pressure[:, 1:-1, [0, -1]], 1e5, rtol=1e-9)
    np.testing.assert_allclose(film.pressure[:, -1, 1:-1], 3e5)
    ratio, arc = case.input["pads"]["pivot_ratio"], np.radians(case.input["pads"]["arc_deg"])
    np.testing.assert_allclose(film.phi[:, -1], ratio * arc)
    np.testing.assert_allclose(film.phi[:, 0], ratio * arc - arc)
    np.testing.assert_allclose(film.z[:, [0, -1]], [[-0.05, 0.05]] * len(film.z))
    np.testing.assert_allclose(film.pressure, film.pressure[:, :, ::-1], rtol=1e-12)


@pytest.mark.parametrize("case_name", ["four", "gumbel", "sor"])
def test_a_cavitated_film_has_no_tension(run, case_name):
    film = tiltpad.pressure(run(case_name), 0.015)
    assert film.pressure.min() == 0
    assert np.any(film.pressure[2:, 1:-1, 1:-1] == 0), "an upper pad's film cavitates"


def test_own_points(run):
    film = tiltpad.pressure(run("lugre"), 0.03, [0, 0.5, 1], [0.0])
    assert film.pressure.shape == (2, 3, 1)
    np.testing.assert_allclose(film.phi[:, 1], 0, atol=1e-15)
    same = tiltpad.pressure(run("lugre"), 0.03, 3, 3).pressure[:, :, 1:2]
    np.testing.assert_allclose(film.pressure, same)
    with pytest.raises(ValueError, match="shares of the arc must be between 0 and 1"):
        tiltpad.pressure(run("lugre"), 0.03, [1.1])


@pytest.mark.parametrize("time", [0.07, -0.1, np.nan])
def test_a_time_outside(run, time):
    with pytest.raises(tiltpad.NotInRunError, match=r"no time \S+ s in this run: sampled from 0 to 0.06 s"):
        tiltpad.pressure(run("lugre"), time)


def test_a_run_without_time_has_an_equilibrium_only(run):
    with pytest.raises(tiltpad.NotInRunError, match="nothing was marched in time"):
        tiltpad.pressure(run("equilibrium"), 0.0)


def test_contact_is_the_programs(run):
    """The march takes it from a table with a relative error of 3e-8."""
    case = run("lugre")
    force = tiltpad.pivot_load(case.pivot_deflection, case)
    np.testing.assert_allclose(force, case.pivot_load, rtol=1e-7)
    assert force.shape == case.pivot_load.shape


@pytest.mark.parametrize("pivot", ["", "law='hertz'", "radius_difference=0", "deflection_factor=6.28"])
def test_contact_pressure_carries_the_force(pivot):
    """Over rings of equal area: with r**2 spread evenly the midpoint rule leaves n^-(1 + exponent)."""
    case = f"&pivot {pivot} /"
    eta = np.array([1e-7, 1e-6, 5e-6])[:, None]
    point = tiltpad.contact(eta, case)
    r = point.radius * np.sqrt((np.arange(4000) + 0.5) / 4000)
    mean = tiltpad.contact_pressure(eta, r, case).mean(axis=1, keepdims=True)
    np.testing.assert_allclose(np.pi * point.radius**2 * mean, point.force, rtol=1e-4)
    np.testing.assert_allclose(tiltpad.contact_pressure(eta, 0, case), point.peak_pressure, rtol=1e-12)
    assert not tiltpad.contact_pressure(eta, 1.001 * point.radius, case).any()
    step = 1e-4 * eta
    force = [tiltpad.pivot_load(eta + d, case) for d in (-step, step)]
    np.testing.assert_allclose((force[1] - force[0]) / (2 * step), point.slope, rtol=1e-6)


def test_contact_numbers_of_a_double():
    """A real of single precision on the way would change the eighth digit."""
    eta = 5.5191e-6
    assert tiltpad.pivot_load(eta) == pytest.approx(1e4, rel=1e-4)
    both = tiltpad.pivot_load([eta, eta * (1 + 1e-12)])
    assert both[1] / both[0] - 1 == pytest.approx(1.32e-12, rel=0.1)
    assert tiltpad.pivot_load([0, -1e-6]).tolist() == [0, 0]


@pytest.mark.parametrize("case_name", ["lugre", "bengisu", "tilting"])
def test_friction_is_the_programs(run, case_name):
    case = run(case_name)
    pivot = case.input["pivot"]
    radius = max(pivot["socket_radius"]) - max(pivot["radius_difference"])
    deflection = case.bristle_deflection if "bristle_deflection" in case else 0
    force = tiltpad.friction_force(radius * case.pad_tilt_rate, case.pivot_load, deflection, case)
    scale = np.abs(case.friction_moment).max()
    np.testing.assert_allclose(radius * force, case.friction_moment, atol=1e-9 * scale, rtol=1e-9)


def test_friction_of_closed_forms():
    v = np.array([-2e-3, 0, 5e-4, 1e-3])
    coefficient = tiltpad.friction_force(v, 1e4, case=BENGISU) / 1e4
    np.testing.assert_allclose(coefficient, [-0.05 - 0.05 / np.e, 0, 0.075, 0.1], atol=1e-15)
    # in steady sliding the bristles rest, and carry the Stribeck curve
    g = 0.05 + 0.05 * np.exp(-np.abs(v) / 1e-3)
    rest = np.sign(v) * g / 1e6
    np.testing.assert_allclose(tiltpad.bristle_rate(v, rest, LUGRE), 0, atol=1e-18)
    np.testing.assert_allclose(tiltpad.friction_force(v, 1e4, rest, LUGRE), 1e4 * np.sign(v) * g)
    np.testing.assert_allclose(tiltpad.bristle_rate(v, 0, LUGRE), v)
    assert not tiltpad.friction_force(v, 1e4).any()


@pytest.mark.parametrize(
    ("case", "message"),
    [
        ("", "case: no namelist group in it; expected &name ... /"),
        ("&pivot law='fung' /", "case line 1: pivot%law = 'fung': must be one of 'fang', 'hertz'"),
        ("\n&rotor mass=-1 /", "case line 2: rotor%mass = -1: must be 1e-6 to 1e9"),
        ("&pivot radius_difference=0, law='hertz' /", "case: pivot%radius_difference = 0: must be > 0 for"),
    ],
)
def test_errors_of_the_library_are_exceptions(case, message):
    """The same text as on the program's standard error, with the same exit status."""
    with pytest.raises(tiltpad.LibraryError) as caught:
        tiltpad.pivot_load(1e-6, case)
    assert str(caught.value).startswith(message)
    assert caught.value.status == 1


def test_the_programs_own_message(tiltpad, tmp_path):
    """Word for word, but for the name of the file."""
    text = "&friction dynamic_coefficient=0.5 /\n"
    (tmp_path / "case").write_text(text)
    said = tiltpad("case", cwd=tmp_path).stderr.strip()
    with pytest.raises(library.LibraryError) as caught:
        library.friction_force(1.0, 1.0, case=text)
    assert said.endswith(str(caught.value))


def test_a_closed_film_is_an_exception(changed):
    def closed(file):
        file["journal_y"][3] = -0.2e-3

    with tiltpad.read(changed("lugre", closed)) as case:
        with pytest.raises(
            tiltpad.LibraryError, match=r"the film of pad 1 closed: thickness -\S+ m"
        ) as caught:
            tiltpad.pressure(case, case.time[3])
        assert caught.value.status == 2


class Heap(ctypes.Structure):
    """What glibc tells of the memory that it gave, struct mallinfo2."""

    _fields_ = tuple(
        (name, ctypes.c_size_t)
        for name in (
            *("arena", "ordblks", "smblks", "hblks", "hblkhd"),
            *("usmblks", "fsmblks", "uordblks", "fordblks", "keepcost"),
        )
    )


@pytest.mark.parametrize(
    "call",
    [
        lambda run: tiltpad.pressure(run, None, 3, 3),
        lambda run: tiltpad.pivot_load(1e-6, run),
        lambda run: tiltpad.contact_pressure(1e-6, 0, run),
        lambda run: tiltpad.friction_force(1e-3, 1e4, 0, run),
        lambda _: pytest.raises(tiltpad.LibraryError, tiltpad.contact, 1e-6, "&pivot law='x' /"),
    ],
    ids=["pressure", "pivot_load", "contact_pressure", "friction_force", "refused"],
)
def test_no_memory_is_lost(run, call):
    """Not 20 bytes a call, counted by the library that gives the memory; the first calls may fill caches."""
    system = ctypes.CDLL(None)
    if not hasattr(system, "mallinfo2"):
        pytest.skip("the system does not count its memory")
    system.mallinfo2.restype = Heap

    def growth(calls):
        gc.collect()
        before = system.mallinfo2()
        for _ in range(calls):
            call(case)
        gc.collect()
        after = system.mallinfo2()
        return after.uordblks + after.hblkhd - before.uordblks - before.hblkhd

    case = run("four")
    growth(20)
    assert any(growth(50) < 20 * 50 for _ in range(10))


def test_without_the_compiled_part(result):
    """The rest of the package works; functions that need the library fail with one line."""
    script = f"""
import sys
sys.modules["tiltpad._library"] = None
import tiltpad
run = tiltpad.read({str(result("lugre"))!r})
tiltpad.orbit(run)
try:
    tiltpad.pressure(run)
except ImportError as error:
    print(error)
from tiltpad import command
sys.exit(command.main(["pressure", run.path]))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=300)
    assert done.stdout.startswith("the compiled part of the package tiltpad is missing (")
    assert done.stdout.count("\n") == 1
    assert done.stderr == "tiltpad-plot: error: " + done.stdout
    assert done.returncode == 3
