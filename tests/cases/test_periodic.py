"""Whole runs of the task periodic: the file, agreement with marches, refusals, failures, signals, studies."""

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import one_error, wait_for_line

LUGRE = "&friction model='lugre' / &output samples_per_revolution=90 /\n"
PERIODIC = "case%task='periodic'"
#: Long searches, accurate meshes over several revolutions: one of a second and one of many.
LONG = (
    "friction%model='bengisu_akay'",
    "film%cavitation='none'",
    "integration%relative_tolerance=1e-8",
    "periodic%revolutions=5",
)
LONGER = (*LONG[:3], "periodic%revolutions=100")
#: A journal in fixed pads above its threshold speed: a whirl leaves the orbit and doubles once a revolution.
WHIRL = """&pads motion='fixed', pivot_angle_deg=-90,90, arc_deg=160 /
&bearing journal_radius=50e-3, assembled_clearance=100e-6, preload=0, axial_length=50e-3, viscosity=0.02 /
&rotor mass=300, balance_grade=2.5 /
&operation speed_rpm=7500, duration=0.06 /
&film cavitation='none' /
&output samples_per_revolution=60 /
"""
#: A slow bearing whose pads creep on their pivots for a hundred revolutions.
CREEPING = """
&rotor mass=3872.7, balance_grade=2.5 / &operation speed_rpm=321.19, duration=1 /
&bearing journal_radius=0.0903825, axial_length=0.177841, assembled_clearance=109.583e-6, preload=0.118178,
   viscosity=0.0222454 /
&pads pivot_angle_deg=-90,-18,54,126,-162, arc_deg=54.1867, thickness=0.0328177, pivot_distance=0.0328177,
   density=7850 /
&pivot socket_radius=0.0376181, radius_difference=90.8972e-6 / &film cavitation='none' /
&friction model='bengisu_akay', static_coefficient=0.0564655, dynamic_coefficient=0.0282327,
   critical_velocity=1.00047e-6, decay=226.189 /
&asperity roughness=0.293016e-6 /
"""
#: Five rigid pivots, the load on one pad, of which the others carry little.
LASTING = """&bearing journal_radius=0.02119, axial_length=0.03093, assembled_clearance=35.7e-6, preload=0,
  viscosity=0.01718 /
&rotor mass=185.7, unbalance=0 /
&operation speed_rpm=7082, duration=1 /
&pads motion='tilting_only', pivot_angle_deg=-90,-18,54,126,198, arc_deg=62.93, thickness=7.84e-3,
  pivot_distance=7.84e-3 /
&pivot socket_radius=6.72e-3, radius_difference=31.9e-6 /
&output samples_per_revolution=20 /
"""
#: Three pads, the upper one of which flutters once a revolution.
LIFTED = """&bearing journal_radius=0.04242442, axial_length=0.04881983, assembled_clearance=9.986509e-05,
  preload=0.5053135, viscosity=0.04844112 /
&rotor mass=725.1907, balance_grade=1 /
&operation speed_rpm=4135.391, duration=1 /
&pads motion='tilting_radial', pivot_angle_deg=-30,90,210, arc_deg=91.60654, thickness=0.01829894,
  pivot_distance=0.01829894 /
&pivot socket_radius=0.01026227, radius_difference=1.495652e-05 /
&film cavitation='reynolds' /
&asperity roughness=3.832256e-07 /
"""


def test_the_file(run, tmp_path):
    """One period of samples whose last is the first, and the group."""
    done = run(LUGRE, PERIODIC)
    assert "periodic orbit: period 9.2308 ms (1 revolution), stable" in done.stdout
    with h5py.File(tmp_path / "case.h5") as file:
        assert file.attrs["complete"] == 1
        group = file["periodic"]
        period = group["period"][()]
        assert period == pytest.approx(60 / 6500, rel=1e-12)
        assert len(file["time"]) == 91
        assert file["time"][-1] == pytest.approx(period, rel=1e-12)
        for name in ("journal_y", "pad_tilt_rate", "bristle_deflection", "pivot_load", "max_pressure"):
            series = file[name][:]
            np.testing.assert_allclose(series[-1], series[0], atol=1e-7 * np.ptp(series), err_msg=name)
        assert file["spectrum/revolutions"][()] == 1
        # what Newton's method leaves of the states: periodic%tolerance
        assert group["residual"][()] < 1e-8
        assert group["stable"][()] == 1
        real, imag = group["multiplier_real"][:], group["multiplier_imag"][:]
        assert len(real) == len(file["multiplier"]) == 14
        modulus = np.hypot(real, imag)
        assert (np.diff(modulus) < 1e-12).all()
        # 1e-3: the films' tables; without them test_periodic_orbits is as close as 1e-6
        assert (real[0], abs(imag[0])) == pytest.approx((-0.0504, 0.2970), abs=1e-3)
        # some iterations are on the mesh of half as many intervals
        most = 3 * group["intervals"][()] * group["iterations"][()]
        assert 0.5 * most < group["evaluations"][()] <= most
        assert (group["closed"][()], group["change"][()]) == (1, 0)
        # halves of smooth intervals, ended at switching points, leave next to nothing
        assert group["multiplier_error"][:].max() < 1e-4
        assert file["statistics/rhs_evaluations"][()] > group["evaluations"][()]


@pytest.mark.parametrize("friction", ["none", "lugre", "bengisu_akay"])
def test_a_march_ends_on_it(run, tmp_path, friction):
    """After twenty revolutions less than 1e-5 of the start is left: what remains are the tolerances, 1e-5 of
    the clearance in each of the states, which friction makes some times larger.
    """
    run(LUGRE, PERIODIC, f"friction%model='{friction}'")
    run(LUGRE, f"friction%model='{friction}'", "operation%duration=0.19", name="march")
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as march:
        for name in ("journal_y", "journal_z"):
            one, other = orbit[name][:-1], march[name][20 * 90 : 21 * 90][: len(orbit[name]) - 1]
            both = min(len(one), len(other))
            assert both > 40
            assert np.abs(one[:both] - other[:both]).max() < 2e-8, name


def test_a_march_leaves_an_unstable_orbit_as_its_multipliers_say(run, tmp_path):
    """From the orbit, disturbed by 1 nm: once a revolution its distance is multiplied by a matrix, whose
    eigenvalues these are, up to 1e-2 of the orbit (the square of which is left out).
    """
    done = run(WHIRL, PERIODIC, "integration%relative_tolerance=1e-7")
    assert "unstable: a vibration of a second frequency grows (torus bifurcation)" in done.stdout
    start = ("start%from='file'", "start%file='case.h5'", "start%journal=1e-9,0")
    run(WHIRL, *start, "integration%relative_tolerance=1e-9", name="march")
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as march:
        assert orbit["periodic/stable"][()] == 0
        leading = leading_multiplier(orbit)
        assert abs(leading) > 2
        away = np.array([march[name][60:361:60] - orbit[name][0] for name in ("journal_y", "journal_z")])
        found = factors(away)
        assert abs(found[np.argmax(found.imag)] - leading) < 0.01 * abs(leading)


@pytest.mark.parametrize(("speed", "kind"), [(9480, "stable"), (9560, "unstable: the period doubles")])
def test_marches_on_both_sides_of_a_doubling(run, tmp_path, speed, kind):
    """Before 9514 rpm a march comes back to the orbit by the factor of its leading multiplier, behind it
    leaves it by this. The second multiplier of 9560 rpm, -0.90, is left of the motion, too; the third is
    0.67, so that 20 periods leave 3e-4 of it. Both runs have the same tables of films.
    """
    settings = (
        "friction%static_coefficient=0.15",
        "friction%dynamic_coefficient=0.075",
        "film%table_tolerance=1e-5",
    )
    settings = (*settings, f"operation%speed_rpm={speed}", "output%samples_per_revolution=3")
    assert kind in run("&friction model='lugre' /\n", PERIODIC, *settings).stdout
    start = ("start%from='file'", "start%file='case.h5'", "start%journal=1e-7,0")
    march = ("integration%relative_tolerance=1e-8", f"operation%duration={40.01 * 60 / speed}")
    run("&friction model='lugre' /\n", *settings, *start, *march, name="march")
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as march:
        leading = leading_multiplier(orbit)
        changes = np.diff([march[name][60::3] for name in ("journal_y", "journal_z")])
    found = factors(changes)
    assert abs(leading) == pytest.approx(0.959 if speed < 9514 else 1.0515, abs=2e-3)
    assert min(abs(found - leading)) < 1e-3


def leading_multiplier(orbit):
    """Of a pair the one above the axis."""
    return orbit["periodic/multiplier_real"][0] + 1j * abs(orbit["periodic/multiplier_imag"][0])


def factors(series):
    """The eigenvalues of the matrix by which two series are multiplied from each sample to the next."""
    return np.linalg.eigvals(series[:, 1:] @ np.linalg.pinv(series[:, :-1]))


def test_a_switching_point_that_is_passed_slowly(run, tmp_path):
    """Pads creep while they stick: where ends of intervals followed each passage of the velocity 0, the
    corrections fell by a tenth a round only, and no orbit was found before the march had doubled.
    """
    run("&friction model='bengisu_akay', static_coefficient=0.1, dynamic_coefficient=0.05 /\n", PERIODIC)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["periodic/marched_periods"][()] <= 12
        assert file["periodic/iterations"][()] <= 10
        # 1e-3: the films' tables; on a march and tables of 1e-8
        assert leading_multiplier(file) == pytest.approx(-0.0520 + 0.2941j, abs=1e-3)


def test_two_revolutions_square_the_multipliers(run, tmp_path):
    run(LUGRE, PERIODIC, name="one")
    run(LUGRE, PERIODIC, "periodic%revolutions=2", name="two")
    with h5py.File(tmp_path / "one.h5") as one, h5py.File(tmp_path / "two.h5") as two:
        assert len(two["time"]) == 181
        np.testing.assert_allclose(two["journal_y"][90:], one["journal_y"][:], atol=1e-10)
        modulus = [
            np.hypot(*(each[f"periodic/multiplier_{part}"][0] for part in ("real", "imag")))
            for each in (one, two)
        ]
        assert modulus[1] == pytest.approx(modulus[0] ** 2, rel=1e-3)


def test_figures_are_of_the_whole_period(run, tmp_path):
    """A force at half the speed makes two revolutions that differ: work, extremes and loops are of both."""
    half = "&excitation amplitude=6000, frequency_ratio=0.5 /\n"
    done = run(LUGRE + half, PERIODIC)
    assert "period of 2 revolutions" in done.stdout
    assert "last revolution" not in done.stdout
    with package.read(tmp_path / "case.h5") as orbit:
        tilt, moment, y = (orbit[name] for name in ("pad_tilt", "friction_moment", "journal_y"))
        steps = np.diff(tilt, axis=0) * (moment[1:] + moment[:-1]) / 2
        work = steps.sum(axis=0) / 2
        # of one revolution they are others
        assert np.abs(steps[:90].sum(axis=0) / work - 1).max() > 0.05
        np.testing.assert_allclose(orbit["summary/pad_friction_work"], work, rtol=1e-9)
        assert orbit["summary/friction_work"] == pytest.approx(work.sum(), rel=1e-9)
        assert orbit["summary/orbit_y"] == pytest.approx(np.ptp(y), rel=1e-12)
        assert np.ptp(y[:91]) < 0.99 * np.ptp(y) or np.ptp(y[90:]) < 0.99 * np.ptp(y)
        loop = package.hysteresis(orbit, 1)
        assert len(loop[0]) == len(tilt)
        assert package.friction_work(orbit, 1) == pytest.approx(work[0], rel=1e-9)
        assert len(package.orbit(orbit)[0]) == len(tilt)


def test_an_orbit_that_the_march_has_left_for_the_doubled_one(run, tmp_path):
    """Upper pads flutter at half the shaft speed: only the mean of two periods is near the orbit of one."""
    four = "&pads pivot_angle_deg=-45,225,45,135 /\n&friction model='lugre' /\n&film cavitation='gumbel' /\n"
    run(four, PERIODIC, "operation%speed_rpm=8000", "output%samples_per_revolution=20")
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["periodic/multiplier_imag"][0] == 0
        assert file["periodic/multiplier_real"][0] < -2
        assert file["periodic/residual"][()] < 1e-8


def test_fixed_pads(run, tmp_path):
    run(LUGRE, PERIODIC, "pads%motion='fixed'", "friction%model='none'")
    with h5py.File(tmp_path / "case.h5") as file:
        assert len(file["multiplier"]) == 4
        assert "pad_tilt" not in file


@pytest.mark.parametrize(
    ("overrides", "names"),
    [
        ((PERIODIC, "operation%final_speed_rpm=7000"), ("operation%final_speed_rpm", "7000", "periodic")),
        ((PERIODIC, "periodic%revolutions=0"), ("periodic%revolutions", "1 to")),
        ((PERIODIC, "periodic%tolerance=0"), ("periodic%tolerance", "1e-12 to")),
        ((PERIODIC, "periodic%max_iterations=0"), ("periodic%max_iterations", "1 to")),
    ],
)
def test_what_is_refused(run, tmp_path, overrides, names):
    done = run(LUGRE, *overrides, status=1)
    for name in names:
        assert name in done.stderr
    assert not (tmp_path / "case.h5").exists()


@pytest.mark.parametrize(
    ("overrides", "name"),
    [
        ((PERIODIC, "output%start_time=0.1"), "output (start_time)"),
        ((PERIODIC, "integration%stop_when_periodic=1e-3"), "integration (stop_when_periodic)"),
        (("periodic%revolutions=2",), "periodic (revolutions)"),
        (("periodic%tolerance=1e-6",), "periodic (tolerance)"),
        (("periodic%max_iterations=3",), "periodic (max_iterations)"),
    ],
)
def test_what_belongs_to_another_task_is_a_remark(run, overrides, name):
    assert f"remark: {name}: has no effect with case%task" in run(LUGRE, *overrides, more=("--check",)).stdout


def test_a_march_that_repeats_is_an_orbit(run, tmp_path):
    """Where Newton's method may not go on, the march that settles on the orbit is taken, as the file says.
    Its displacements change by `change` of their scales in a period, and half of this is left by the next:
    the orbit is less than twice the change away.
    """
    close = "integration%relative_tolerance=1e-6"
    run(LUGRE, PERIODIC, close)
    done = run(LUGRE, PERIODIC, close, "periodic%max_iterations=1", name="march")
    assert "a march repeats it" in done.stdout
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as march:
        assert (march["periodic/closed"][()], march["periodic/stable"][()]) == (0, 1)
        change = march["periodic/change"][()]
        assert 0 < change < 1e-4
        for name in ("journal_y", "journal_z"):
            away = np.abs(march[name][:] - orbit[name][:]).max()
            assert away < 100e-6 * min(1e-4, 2 * change), name
        assert abs(leading_multiplier(march) - leading_multiplier(orbit)) < 1e-3


def test_a_march_that_creeps_to_its_orbit_goes_on(run, tmp_path):
    """It changes by 4e-4 of the clearance in a revolution and keeps 0.967 of that by the next: after 16 it
    repeated well enough, and was 64 % of the orbit away from where it led.
    """
    run(CREEPING, PERIODIC)
    run(CREEPING, PERIODIC, "periodic%max_iterations=1", name="march")
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as march:
        assert (orbit["periodic/closed"][()], march["periodic/closed"][()]) == (1, 0)
        assert march["periodic/marched_periods"][()] > 16
        extent = np.ptp(orbit["journal_z"][:])
        assert extent > 1e-6
        for name in ("journal_y", "journal_z"):
            assert np.abs(march[name][:] - orbit[name][:]).max() < 0.01 * extent, name
    slower = ("periodic%max_iterations=1", "operation%speed_rpm=4000")
    done = run(CREEPING, PERIODIC, *slower, name="slower", status=2)
    assert "% of the orbit away from where it leads: begin at the end of a longer march" in done.stderr
    # where changes hardly fall, the distance from where they lead is a number without meaning
    done = run(CREEPING, PERIODIC, *slower, "friction%critical_velocity=1e-8", name="stuck", status=2)
    hardly = "the march changes in each period by nearly as much as in the one before: begin at the end"
    assert hardly in done.stderr


def test_a_vibration_that_lasts_is_seen(run, tmp_path):
    """Without unbalance multipliers are exp(lambda T). Hardly damped, at ten times the speed of the shaft,
    this vibration was lost on the long steps of a march that hardly moves (0.56).
    """
    run(LASTING, PERIODIC)
    with h5py.File(tmp_path / "case.h5") as file:
        rate = file["equilibrium/eigenvalue_real"][()] + 1j * file["equilibrium/eigenvalue_imag"][()]
        expected = np.exp(rate * file["periodic/period"][()])
        assert abs(expected) > 0.99
        # that of marches and that of the equilibrium have films of different tables, and 2 pi 10 radians
        assert abs(leading_multiplier(file)) == pytest.approx(abs(expected), abs=1e-3)
        assert file["periodic/multiplier_error"][0] < 1e-3


def test_a_pad_that_leaves_its_pivot(run, tmp_path):
    """Two thirds of the time. Marches from beside the orbit come back to it by the factor of its leading
    multiplier, when the others (below 0.25) are gone; the films of both runs are solved, not interpolated.
    """
    direct = ("film%solver='direct'", "output%samples_per_revolution=3")
    run(LIFTED, PERIODIC, *direct)
    start = ("start%from='file'", "start%file='case.h5'", "start%journal=1e-6,0")
    march = ("integration%relative_tolerance=1e-10", f"operation%duration={17.01 * 60 / 4135.391}")
    run(LIFTED, *direct, *start, *march, name="march")
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as file:
        leading = leading_multiplier(orbit)
        assert orbit["periodic/multiplier_error"][0] < 1e-3
        # tilts by what they move the ends of the pads
        series = np.vstack([file["journal_y"][:], file["journal_z"][:], 0.04 * file["pad_tilt"][:].T])
    changes = np.diff(series[:, 10 * 3 :: 3])
    factor = np.sum(changes[:, 1:] * changes[:, :-1]) / np.sum(changes[:, :-1] ** 2)
    assert leading == pytest.approx(factor, abs=1e-3)


def test_no_convergence(run, tmp_path):
    """The file has the equilibrium and says why there is nothing else: the motion itself does not repeat."""
    four = "&pads pivot_angle_deg=-45,225,45,135 /\n&friction model='lugre' /\n&film cavitation='gumbel' /\n"
    done = run(four, PERIODIC, "operation%speed_rpm=8000", "periodic%max_iterations=1", status=2)
    said = ("no periodic orbit was found", "periods", "after 1 iterations", "periodic%max_iterations")
    for words in (*said, "correction of", "the march does not repeat: pad", "case.h5"):
        assert words in done.stderr, words
    with h5py.File(tmp_path / "case.h5") as file:
        assert (file.attrs["complete"], file.attrs["exit_status"]) == (0, 2)
        assert "no periodic orbit" in file.attrs["reason"]
        assert "equilibrium" in file
        assert "periodic" not in file
        assert file["statistics/steps"][()] > 0


def test_a_march_that_ends(run):
    """Where, when and why."""
    done = run(LUGRE, PERIODIC, "rotor%unbalance=1", "asperity%model='none'", status=2)
    for words in ("no periodic orbit was found", "the march stopped at t =", "pad"):
        assert words in done.stderr, words
    assert (
        "integration%max_steps"
        in run(LUGRE, PERIODIC, "integration%max_steps=50", status=2, name="few").stderr
    )


def stopped_search(start, folder, case, *overrides):
    """What a run says that is stopped behind its equilibrium, while it marches to the orbit."""
    process = start(folder, case, "-o", "part.h5", overrides=(PERIODIC, *overrides))
    wait_for_line(process, "equilibrium")
    process.terminate()
    return one_error(process, 4)


def test_a_signal(start, tmp_path):
    (tmp_path / "case.nml").write_text(LUGRE)
    said = stopped_search(start, tmp_path, "case.nml", *LONGER)
    assert said.endswith("signal 15 while the periodic orbit was sought; tiltpad --resume part.h5 goes on\n")
    with h5py.File(tmp_path / "part.h5") as file:
        assert (file.attrs["complete"], file.attrs["exit_status"]) == (0, 4)


def test_a_stopped_search_goes_on_to_the_same_orbit(start, tiltpad, run, tmp_path):
    run(LUGRE, PERIODIC, *LONG, name="whole")
    stopped_search(start, tmp_path, "whole.nml", *LONG)
    tiltpad("--resume", "part.h5", "-q", cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "whole.h5") as whole, h5py.File(tmp_path / "part.h5") as part:
        assert part.attrs["complete"] == 1
        np.testing.assert_allclose(part["journal_y"][:], whole["journal_y"][:], atol=1e-10)


def test_a_study(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text(LUGRE)
    varied = (PERIODIC, "sweep%operation%speed_rpm=3000,6500")
    tiltpad("case.nml", "-q", overrides=varied, cwd=tmp_path, status=0)
    periods = []
    for number in (1, 2):
        with h5py.File(tmp_path / f"case/000{number}.h5") as file:
            assert file.attrs["complete"] == 1
            periods.append(file["periodic/period"][()])
    assert periods == pytest.approx([0.02, 60 / 6500])
