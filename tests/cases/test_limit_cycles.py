"""Limit cycles and tori against independent programs, marches, their own mirror image, and refusals."""

import h5py
import numpy as np
import pytest

#: The paper's two pads without unbalance.
PADS = """&case  task = 'branch' /
&rotor  mass = {mass}, unbalance = 0 /
&operation  speed_rpm = {first} /
&film  cavitation = 'none' /
&friction  model = '{friction}', static_coefficient = 0.1, dynamic_coefficient = 0.05 /
&asperity  model = 'none' /
&branch  of = 'limit_cycle', parameter = 'operation%speed_rpm', last = {last} /
"""
LUGRE = PADS.format(mass=2000, first=8000, friction="lugre", last=9500)
FREE = PADS.format(mass=200, first=14000, friction="none", last=15500)
#: Two of the paper's bearings with LuGre under an elastic rotor.
ELASTIC = """&case  task = 'branch' /
&shaft  length = 0.05, 0.05, 8*0.2, 0.05, 0.05, diameter = 2*0.0998, 8*0.34, 2*0.0998 /
&disc  station = 7, mass = 2847.3706547456786, polar_inertia = 512.526717854222
       diametral_inertia = 280.5609218476075 /
&bearing  name = 'a', station = 2 /
&bearing  name = 'b', station = 12 /
&film  cavitation = 'none' /
&friction  model = 'lugre', static_coefficient = 0.1, dynamic_coefficient = 0.05 /
&asperity  model = 'none' /
&operation  speed_rpm = 5000 /
&branch  of = 'limit_cycle', parameter = 'operation%speed_rpm', last = 7200 /
"""
#: A short plain bearing; lengths over the clearance, speeds over sqrt(g/c) and the capacity number
#: Gamma = mu R L^3/(m sqrt(g) c^2.5) make it comparable to that of Ocvirk.
CLEARANCE, GRAVITY = 1e-4, 9.81
SHORT = """&case  task = 'branch' /
&rotor  mass = 10, unbalance = 0 /
&operation  speed_rpm = {first} /
&bearing  journal_radius = {radius}, axial_length = {length}, assembled_clearance = 1e-4
          machined_clearance = 1e-4, viscosity = {viscosity} /
&pads  motion = 'fixed', pivot_angle_deg = -90, arc_deg = 360, pivot_ratio = 0.5 /
&film  cavitation = 'gumbel' /
&asperity  model = 'none' /
&branch  of = 'limit_cycle', parameter = 'operation%speed_rpm', last = {last} /
"""
RPM = (GRAVITY / CLEARANCE) ** 0.5 * 30 / np.pi


def short(gamma, first, last, radius=0.25, length=0.05):
    """The case of a capacity number and of dimensionless speeds."""
    viscosity = gamma * 10 * GRAVITY**0.5 * CLEARANCE**2.5 / (radius * length**3)
    return SHORT.format(viscosity=viscosity, first=first * RPM, last=last * RPM, radius=radius, length=length)


def multipliers(file, point):
    return file["multiplier_real"][point] + 1j * file["multiplier_imag"][point]


def extremes(file, point, names=("journal_y", "journal_z")):
    return [file[f"{name}_{end}"][point] for name in names for end in ("max", "min")]


def test_cycles_of_stuck_pads(follow):
    """Another program: finite volumes, shooting with an unknown period (limits 1e-5, 2e-6, 1e-5 c, 1e-3)."""
    file, printed = follow(LUGRE)
    with file:
        assert file["bifurcations/parameter"][0] == pytest.approx(9084.209641, rel=1e-5)
        assert "born towards higher operation%speed_rpm" in printed
        assert "unstable cycles" not in printed
        assert file["period"][-1] == pytest.approx(0.01198999651, rel=2e-6)
        assert file["whirl_ratio"][-1] == pytest.approx(0.526754905, rel=2e-6)
        expected = [-3.722715645e-05, -5.191108285e-05, 7.623848588e-06, -7.110132472e-06]
        np.testing.assert_allclose(extremes(file, -1), expected, atol=1e-9)
        found = multipliers(file, -1)
        assert len(found) == file["mode"].size == 13
        assert abs(found[0] - 0.7103481111) < 1e-3
        assert np.abs(found[1:3] - 0.2848993855).max() == pytest.approx(0.2499428243, abs=1e-3)
        assert file["trivial_multiplier_error"][-1] < 1e-4
        assert (file["stable"][1:] == 1).all()


def test_cycles_of_free_pads_turn_back(follow):
    """The same program: unstable cycles from the Hopf point down to a fold, and stable ones beyond it."""
    file, printed = follow(FREE, "operation%speed_rpm=12500")
    with file:
        assert list(file["bifurcations/kind"][:2]) == [b"hopf", b"fold"]
        hopf, fold = file["bifurcations/parameter"][:2]
        assert hopf == pytest.approx(14945.84335, rel=1e-5)
        assert fold == pytest.approx(12795.1, abs=0.5)
        assert "born towards lower operation%speed_rpm" in printed
        assert "unstable cycles reach to operation%speed_rpm = 128" in printed or "= 1279" in printed
    file, _ = follow(FREE, "operation%speed_rpm=13500", name="last")
    with file:
        # back at the first value
        assert file["parameter"][-1] == 13500
        assert file["period"][-1] == pytest.approx(0.009792763063, rel=2e-6)
        expected = [3.60973943e-05, 8.070820668e-06, 1.445895263e-05, -1.580028683e-05]
        np.testing.assert_allclose(extremes(file, -1), expected, atol=1e-9)
        found = multipliers(file, -1)
        assert abs(found[0] - 1.608616175) < 1e-3
        assert abs(found[1] - (0.8024736504 + 0.007812716817j)) < 1e-3
        assert file["stable"][-1] == 0


@pytest.mark.parametrize("which", ["free", "stuck"])
def test_what_cycles_do_is_said_beside_a_threshold(follow, which):
    """The same figures as the branch's own, although the case has an unbalance."""
    text = FREE if which == "free" else LUGRE
    low, high = (12500, 15500) if which == "free" else (9000, 9500)
    branch, _ = follow(text, f"operation%speed_rpm={low}", f"branch%last={high}", name="branch")
    asked = (
        "case%task='coefficients'", f"operation%speed_rpm={low}", "rotor%unbalance=0.01",
        f"coefficients%threshold_up_to_rpm={high}", "coefficients%threshold_born=.true.",
    )  # fmt: skip
    file, printed = follow(text, *asked, name="born")
    with file, branch:
        own = {name: value[()] for name, value in file["modes"].items() if value.shape == ()}
        assert own["threshold_hopf_rpm"] == pytest.approx(branch["parameter"][0], rel=1e-6)
        pivots = [each.decode().strip() for each in file["pivot"][:]]
        threshold = file["modes/threshold_rpm"][pivots.index(which)]
        assert own["threshold_hopf_rpm"] == pytest.approx(threshold, rel=1e-5)
        least = int(np.argmin(branch["parameter"][:]))
        assert own["threshold_lowest_rpm"] == pytest.approx(branch["parameter"][least], abs=0.5)
        assert own["threshold_born"] == (-1 if which == "free" else 1)
        assert f"born towards {'lower' if which == 'free' else 'higher'} speeds" in printed
        if which == "free":
            ends = np.reshape(extremes(branch, least), (2, 2))
            size = [own["threshold_cycle_y"], own["threshold_cycle_z"]]
            np.testing.assert_allclose(size, (ends[:, 0] - ends[:, 1]) / 2, rtol=2e-2)
        else:
            assert "the lowest speed with one" not in printed


def test_a_cycle_has_no_start(follow):
    """Cycles that were reached by other steps begin elsewhere on themselves, and are the same."""
    found = []
    for step in (100, 35):
        file, _ = follow(LUGRE, f"branch%step={step}", f"branch%max_step={step}", name=f"of_{step}")
        with file:
            found.append([*extremes(file, -1), file["period"][-1]])
    np.testing.assert_allclose(*found, rtol=2e-6, atol=2e-10)


def test_an_unstable_cycle_parts_the_starts(follow, tiltpad, tmp_path):
    """Just below the threshold speed: a kick within the cycle dies away, one beyond it does not."""
    file, _ = follow(FREE, "operation%speed_rpm=14600")
    with file:
        assert file["parameter"][-1] == 14600
        assert file["stable"][-1] == 0
        amplitude = np.ptp(extremes(file, -1)[:2]) / 2
    (tmp_path / "march.nml").write_text(FREE.replace("&branch", "!&branch"))
    size = {}
    for part in (0.5, 2):
        settings = (
            "case%task='march'", "operation%speed_rpm=14600", "operation%duration=0.4",
            f"start%journal={part * amplitude},0",
        )  # fmt: skip
        command = ("march.nml", "-o", "march.h5", "--overwrite", "-q")
        tiltpad(*command, cwd=tmp_path, overrides=settings, status=0)
        with h5py.File(tmp_path / "march.h5") as march:
            size[part] = np.ptp(march["journal_y"][-800:]) / 2
    assert size[0.5] < 0.3 * amplitude
    assert size[2] > 1.5 * amplitude


def test_short_bearing(follow):
    """What an Ocvirk bearing (Fourier collocation of another program) has beyond it falls with (L/D)^2.

    The journals are large beside the clearance: the drag of the oil, which that bearing has not, is small.
    """
    missed = []
    for radius, length in ((0.25, 0.05), (1, 0.1)):
        file, _ = follow(short(0.85, 2.5, 2.6, radius, length))
        with file:
            hopf = file["bifurcations/parameter"][0] / RPM
            largest, least = (-file[f"journal_y_{end}"][-1] / CLEARANCE for end in ("min", "max"))
            missed.append(
                [
                    hopf / 2.545480236 - 1,
                    file["whirl_ratio"][-1] / 0.5174372072 - 1,
                    largest - 0.4280625681,
                    least + 0.1229587675,
                ]
            )
    wide, narrow = np.array(missed)
    assert (np.abs(narrow) < 0.3 * np.abs(wide)).all()
    assert np.abs((4 * narrow - wide) / 3).max() < 5e-4


def test_the_unstable_cycle_of_a_short_bearing(follow):
    """The same program: at a larger capacity number cycles are born towards lower speeds."""
    file, printed = follow(short(4.5, 2.75, 2.7, 1, 0.1))
    with file:
        assert "born towards lower" in printed
        assert file["bifurcations/parameter"][0] / RPM == pytest.approx(2.740915741, rel=1e-3)
        assert file["whirl_ratio"][-1] == pytest.approx(0.4994989299, rel=1e-3)
        assert multipliers(file, -1)[0].real == pytest.approx(1.059403045, abs=2e-3)
        assert (file["stable"][1:] == 0).all()
        found = [-file[f"journal_y_{end}"][-1] / CLEARANCE for end in ("min", "max")]
        # the amplitude goes with the root of the way from the Hopf point, 0.04, which lies 1e-3 lower here
        np.testing.assert_allclose(found, [0.3710959187, -0.351305419], atol=6e-3)


def test_a_branch_from_the_end_of_a_march(follow, tmp_path):
    """It comes to the cycles of the branch from the Hopf point, and so does a march from a kick."""
    branch, _ = follow(LUGRE, name="hopf")
    march = LUGRE.partition("&branch")[0].replace("branch", "march").replace("= 8000", "= 9500, duration = 1")
    follow(march, "start%journal=-20e-6,20e-6", name="march")
    start = ("operation%speed_rpm=9500", "branch%last=9000")
    for name, how in {
        "file": ("start%from='file'", f"start%file='{tmp_path / 'march.h5'}'"),
        "kick": ("start%journal=20e-6,0",),
    }.items():
        file, printed = follow(LUGRE, *start, *how, name=name)
        with file:
            assert extremes(file, 0) == pytest.approx(extremes(branch, -1), abs=1e-9)
            assert file["period"][0] == pytest.approx(branch["period"][-1], rel=1e-6)
            assert abs(multipliers(file, 0)[0] - multipliers(branch, -1)[0]) < 2e-4
            assert file["parameter"][-1] == pytest.approx(9084.209641, rel=1e-4)
            assert file.attrs["branch_ends"].endswith("it shrinks to an equilibrium, at a Hopf point")
            assert "born" not in printed
    branch.close()


def test_elastic_rotor(follow):
    """Another program; its high modes have another damping, which shows in the last digits."""
    file, _ = follow(ELASTIC)
    with file:
        assert file["parameter"][-1] == 7200
        assert file["period"][-1] == pytest.approx(0.01580723607, rel=2e-5)
        assert abs(multipliers(file, -1)[0] - 0.8500055278) < 1e-3
        bearing = [-4.556760624e-05, -5.916820926e-05, 6.88920622e-06, -6.731182477e-06]
        np.testing.assert_allclose(extremes(file["bearings/a"], -1), bearing, atol=1e-8)
        disc = [-7.016488859e-05, -9.651925801e-05, 1.305809343e-05, -1.332510668e-05]
        found = [file[f"station_{axis}_{end}"][-1, 6] for axis in "yz" for end in ("max", "min")]
        np.testing.assert_allclose(found, disc, atol=3e-8)


def test_mirror(follow):
    """A shaft that turns the other way: z and all tilts with the other sign."""
    file, _ = follow(LUGRE)
    mirrored, _ = follow(LUGRE, "operation%rotation='anticlockwise'", name="mirror")
    with file, mirrored:
        assert mirrored["period"][-1] == pytest.approx(file["period"][-1], rel=1e-6)
        expected = extremes(file, -1)
        found = extremes(mirrored, -1)
        np.testing.assert_allclose(found[:2], expected[:2], atol=1e-9)
        np.testing.assert_allclose([-found[3], -found[2]], expected[2:], atol=1e-9)


#: The torus of an unbalance with stuck pads, over 600 revolutions.
TORUS = LUGRE.partition("&branch")[0].replace("branch", "march").replace("unbalance = 0", "unbalance = 0.002")
TORUS = TORUS.replace("= 8000", "= 9400, duration = 3.83") + (
    "&output  samples_per_revolution = 12, spectrum_revolutions = 500 /\n"
    "&integration  relative_tolerance = 1e-7 /\n"
)


def test_torus(follow):
    """Another program, whose film is coarser: 0.53154749 at 500 revolutions, to 2e-6 as periods of cycles."""
    file, printed = follow(TORUS)
    with file:
        own = {name: value[()] for name, value in file["summary"].items() if value.shape == ()}
        assert own["quasi_periodic"] == 1
        assert own["repeats_after"] == 0
        assert own["rotation_number"] == pytest.approx(0.53154749, abs=2e-6)
        assert own["rotation_difference"] < 1e-6
        points = [file[f"by_revolution/poincare_{axis}"][:] for axis in "yz"]
        assert own["ring_y"] == pytest.approx(-4.0451e-05 + 5.1722e-05, rel=2e-3)
        assert own["ring_z"] == pytest.approx(6.006e-06 + 6.799e-06, rel=2e-3)
        rotation, speed = own["rotation_number"], 9400 / 60
        assert own["second_frequency"] == pytest.approx(rotation * speed)
        assert own["second_amplitude"] == pytest.approx(own["whirl_amplitude"], rel=1e-3)
        orders = {"second": rotation, "lower_sideband": 1 - rotation, "upper_sideband": 1 + rotation}
        for name, order in orders.items():
            assert own[f"{name}_frequency"] == pytest.approx(order * speed)
            # the spectrum under its window, between the lines of which the line may lie
            line = np.abs(file["spectrum/order"][:] - order).argmin()
            found = max(file[f"spectrum/journal_{axis}"][line] for axis in "yz")
            assert 0.8 < found / own[f"{name}_amplitude"] < 1.01
    assert f"quasi-periodic: rotation number {rotation:.7f}, second frequency 83.28 Hz" in printed
    for count, known in ((200, 0.53154754), (250, 0.53154742)):
        number = rotation_number(*(each[-count:] for each in points))
        assert number == pytest.approx(known, abs=4e-6)
    # what the plain mean of the same angles makes of them
    assert abs(rotation_number(*(each[-200:] for each in points), weighted=False) - 0.5315475) > 3e-5


def rotation_number(y, z, weighted=True):
    """The weighted Birkhoff average once more."""
    at = np.linspace(0, 1, len(y) + 2)[1:-1]
    weight = np.exp(-1 / (at * (1 - at)))
    points = y + 1j * z - np.average(y + 1j * z, weights=weight)
    turns = np.angle(points[1:] / points[:-1]) / (2 * np.pi) % 1
    at = np.linspace(0, 1, len(turns) + 2)[1:-1]
    return np.average(turns, weights=np.exp(-1 / (at * (1 - at))) if weighted else None)


#: Two frequencies beside that of the shaft: the points once a revolution fill an area.
WILD = """&rotor  mass = 500, unbalance = 0 /
&operation  speed_rpm = 6000, duration = 1.3 /
&film  cavitation = 'none' /
&asperity  model = 'none' /
&output  samples_per_revolution = 12, spectrum_revolutions = 120 /
&excitation  amplitude = 300, frequency_ratio = 0.381966011, rotating = 'forward' /
&excitation  amplitude = 300, frequency_ratio = 0.7320508, rotating = 'backward' /
"""


def test_points_that_are_no_ring(follow):
    """A number that is none is compared with nothing: the debug build would stop there."""
    file, printed = follow(WILD)
    with file:
        assert np.isnan(file["summary/rotation_number"][()])
        assert np.isnan(file["summary/rotation_difference"][()])
    assert "the motion does not repeat, and has no rotation number" in printed


def test_motions_that_are_no_torus(follow):
    """Too few revolutions, a march that has come to rest, and one that still grows."""
    _, printed = follow(TORUS, "output%spectrum_revolutions=150", "integration%relative_tolerance=1e-5")
    assert "the motion does not repeat: rotation number 0.53" in printed
    kick = ("rotor%unbalance=0", "start%journal=-45e-6,1e-6", "output%spectrum_revolutions=100")
    short = ("operation%duration=1",)
    file, printed = follow(TORUS, *kick, "operation%speed_rpm=8000", *short, "output%checkpoint_seconds=0.02")
    with file:
        assert file["summary/repeats_after"][()] == 1
        # a checkpoint before had some
        assert not {"rotation_number", "ring_y"} & set(file["summary"])
    _, printed = follow(TORUS, *kick, "operation%speed_rpm=9086", *short)
    assert "the motion is not settled, or chaotic" in printed


def test_warm_oil_keeps_its_viscosities(follow):
    """A temperature for each pad: viscosities are those of the equilibrium at the speed of the cycle."""
    warm = "&oil  grade = 46, supply_temperature = 40 /\n&thermal  model = 'pad' /\n"
    file, printed = follow(FREE + warm, "operation%speed_rpm=13000")
    with file:
        at = int(np.argmin(file["parameter"]))
        speed, viscosity = float(file["parameter"][at]), file["viscosity"][at]
        assert "at frozen viscosity" in printed
    rest, _ = follow(FREE + warm, "case%task='equilibrium'", f"operation%speed_rpm={speed!r}", name="rest")
    with rest:
        np.testing.assert_allclose(viscosity, rest["equilibrium/viscosity"], rtol=1e-6)


REFUSALS = {
    "unbalance": (("rotor%unbalance=0.01",), 1, "must be without unbalance (0.01 kg m; rotor%unbalance = 0)"),
    "friction": (("friction%model='bengisu_akay'",), 1, "must be 'none' or 'lugre'"),
    "no Hopf point": (("branch%last=8500",), 2, "the equilibria have no Hopf point"),
    "parameter": (
        ("branch%parameter='rotor%unbalance'", "branch%last=0.01"),
        1,
        "limit cycles are without unbalance; branch%of = 'periodic' follows orbits over it",
    ),
    "born without limit": (
        ("case%task='coefficients'", "coefficients%threshold_born=.true."),
        1,
        "coefficients%threshold_born = .true.: needs coefficients%threshold_up_to_rpm",
    ),
    "born with friction": (
        (
            "case%task='coefficients'",
            "coefficients%threshold_up_to_rpm=9500",
            "coefficients%threshold_born=.true.",
            "friction%model='bengisu_akay'",
        ),
        1,
        "must be 'none' or 'lugre' with coefficients%threshold_born",
    ),
    "kick within": (
        ("start%journal=1e-6,0", "operation%speed_rpm=9000"),
        2,
        "no limit cycle was found: the march from the start of the case comes to rest",
    ),
    "switch": (("branch%of='equilibrium'", "branch%switch=.false."), 1, "no effect on a branch of equilib"),
    "cross-coupled": (
        (
            *("case%task='coefficients'", "coefficients%threshold_born=.true."),
            *("coefficients%threshold_up_to_rpm=9500", "coefficients%cross_stiffness=1e6"),
        ),
        1,
        "not with coefficients%cross_stiffness = 1e6, which acts on small vibrations alone",
    ),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals(tiltpad, tmp_path, name):
    """One line that names what to change."""
    overrides, status, words = REFUSALS[name]
    (tmp_path / "case.nml").write_text(LUGRE)
    done = tiltpad("case.nml", "-q", cwd=tmp_path, overrides=overrides)
    assert done.returncode == status
    assert done.stderr.count("\n") == 1
    assert words in done.stderr
