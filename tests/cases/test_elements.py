"""What machines have besides bearings: elements with coefficients, at stations of the shaft.

The values are those of an independent program (Timoshenko beams by Cowper, tilting pads with converged films,
all degrees of freedom): its eigenvalues have rounding errors of 1e-9 with linear elements, and its films err
by 1e-6 of the coefficients.
"""

from pathlib import Path

import numpy as np
import pytest

SHAFT = """
&shaft length=2*0.06, 0.11, 8*0.12, 0.11, 2*0.06, 0.07,
   diameter=2*0.0998, 0.13, 8*0.145, 0.13, 2*0.0998, 0.09 /
&disc station=5, mass=28, diametral_inertia=0.16, polar_inertia=0.29 /
&disc station=6, mass=28, diametral_inertia=0.16, polar_inertia=0.29 /
&disc station=7, mass=28, diametral_inertia=0.16, polar_inertia=0.29 /
&disc station=8, mass=28, diametral_inertia=0.16, polar_inertia=0.29 /
&disc station=9, mass=28, diametral_inertia=0.16, polar_inertia=0.29 /
&disc station=16, mass=22, diametral_inertia=0.1, polar_inertia=0.17 /
"""
#: All modes.
WHOLE = "&reduction frequency=1e5 /\n"
PADS = """
&case task='coefficients' /
&operation speed_rpm=11000 /
&bearing journal_radius=0.0499, axial_length=0.05, machined_clearance=105e-6, assembled_clearance=75e-6,
   viscosity=0.016 /
&pads pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=58, pivot_ratio=0.5, pivot_distance=0.013, mass=0.28,
   inertia=1.1e-4, centre_tangential=0, centre_radial=-0.0068 /
&pivot socket_radius=0.013, radius_difference=0.0002, deflection_factor=4 /
&asperity model='none' /
&film cavitation='none' /
"""
COMPRESSOR = f"""{SHAFT}{PADS}
&unbalance station=7, moment=1e-4 /
&bearing name='left', station=2 /
&bearing name='right', station=14 /
"""
PISTON = "&element station=10, stiffness=12e6, 7.2e6, -7.2e6, 12e6, damping=11000, 800, -800, 11000 {} /\n"

#: Of the balance piston that also acts at the equilibrium, and of one that does not.
SEALS = {
    "static": {
        "journals": [[-1.1758423728425621e-05, -3.3669854552616163e-07],
                     [-1.1156867336173803e-05, -8.362616220674745e-07]],
        "loads": [[-1477.9923875005938, -53.50240908944522], [-1398.0388277824286, -116.13937583145446]],
        "station": [-2.6929758005906943e-05, -2.021039393262651e-06],
        "eigenvalues": [-83.14334744449374 + 581.6897296524861j, -49.45016469395715 + 594.0764127780452j,
                        -413.4387467764979 + 781.391573338435j, -438.2002567074867 + 792.6032158892586j,
                        -552.6432614803039 + 978.9819241839556j, -584.124570419174 + 977.3469329420532j,
                        -253.6533361494601 + 2618.16644583621j, -263.159824423302 + 2836.0165122756957j],
        "whirl": [-6.465992438122693e-07 - 1.5724099183879888e-07j,
                  -1.6289731224929246e-07 + 6.447979252163544e-07j],
    },
    "in motion alone": {
        "journals": [[-1.2549312068899384e-05, 8.725319457955063e-08],
                     [-1.287841030400654e-05, 8.729064329082203e-08]],
        "loads": [[-1584.500478021249, 0.0], [-1629.2393169662816, 0.0]],
        "station": [-3.102998888566769e-05, 8.727883254342136e-08],
        "eigenvalues": [-82.55561194552627 + 582.919263949382j, -49.096897536264485 + 595.6030035310314j,
                        -416.93458921342744 + 783.1642753483918j, -444.78594541975843 + 794.7071633375094j,
                        -555.2920092404543 + 979.2768737033288j, -588.7165228371714 + 976.6682768701897j,
                        -252.4364479495761 + 2617.384653204441j, -261.9170805334792 + 2835.3730908027637j],
        "whirl": [-6.474906165533147e-07 - 1.5513262409534727e-07j,
                  -1.6182343773722564e-07 + 6.446175249085875e-07j],
    },
}  # fmt: skip
#: The first forward mode under a cross-coupled stiffness at midspan: level I of API 617.
LEVEL_I = {
    0.0: -46.56643902872705 + 561.8307187350027j,
    3787588.3490775484: -33.63781106259043 + 562.9571428716819j,
}

#: A balance piston by whirl frequency, rad/s: direct and cross-coupled stiffness (+yz, -zy), damping.
BY_FREQUENCY = (
    (125.66370614359172, 1500000.0, 8500000.0, 34000.0),
    (314.1592653589793, 3200000.0, 8400000.0, 33000.0),
    (502.6548245743669, 6000000.0, 8200000.0, 31000.0),
    (691.1503837897545, 9500000.0, 7800000.0, 28500.0),
    (942.4777960769379, 15000000.0, 7100000.0, 25000.0),
    (1256.6370614359173, 24000000.0, 6000000.0, 20500.0),
    (1633.6281798666923, 34000000.0, 4700000.0, 16000.0),
    (2010.6192982974676, 43000000.0, 3600000.0, 12500.0),
)
#: Level II: the first forward mode with five labyrinths, and with the piston, too, at the frequency of the
#: speed and at its own.
LABYRINTHS = "".join(
    f"&element station={at}, static=.false., stiffness=0.2e6, 0.45e6, -0.45e6, 0.2e6, damping=600, 2*0, 600/"
    for at in (5, 6, 7, 8, 9)
)
LEVEL_II = {
    "": -46.47915012100492 + 564.9894728765697j,
    ", frequency='synchronous'": -69.9845245052924 + 616.7662215689816j,
    ", frequency='own'": -74.346254196342 + 577.9789572129857j,
}
#: A seal by speed, rpm: direct and cross-coupled stiffness, damping.
BY_SPEED = (
    (2000, 1.0e6, 0.8e6, 6000, 100),
    (4000, 2.5e6, 1.8e6, 7000, 200),
    (6000, 5.0e6, 3.2e6, 8500, 400),
    (8000, 8.0e6, 5.0e6, 10000, 600),
    (10000, 12.0e6, 7.0e6, 11000, 800),
    (12000, 16.0e6, 9.0e6, 12000, 1000),
)
#: Where stations are in the run-up with it, at the start and after each tenth of it, m, and the largest
#: amplitude from peak to peak.
RUN_UP = {
    7: [
        -4.963848900157425e-05,
        -4.6301701019789156e-05,
        -4.421358019050857e-05,
        -4.052394717875113e-05,
        -4.082590327902297e-05,
        -4.077826329677637e-05,
        -4.027146410599586e-05,
        -3.441996751101726e-05,
        -3.281349520444682e-05,
        -3.33776221690035e-05,
        -3.653989950537173e-05,
    ],
    10: [
        -4.627860435550685e-05,
        -4.3058188753645994e-05,
        -4.092414333331573e-05,
        -3.744550003784318e-05,
        -3.746803402056523e-05,
        -3.710551977216485e-05,
        -3.6509057454307586e-05,
        -3.144464081024358e-05,
        -2.9925177984793105e-05,
        -3.0210014057555816e-05,
        -3.243874933831495e-05,
    ],
}
LARGEST = 9.007167702191594e-06
COLUMNS = "k_yy,k_yz,k_zy,k_zz,c_yy,c_yz,c_zy,c_zz"

#: What is set, and what the line says.
TABLE_REFUSED = {
    "operation%speed_rpm=12001": "its speed_rpm goes from 2000 to 12000 rpm, and the run has 12001 rpm",
    "case%task=march operation%final_speed_rpm=1500": "2000 to 12000 rpm, and the run has 1500 rpm",
    "coefficients%threshold_up_to_rpm=13000": "and the run has 13000 rpm",
    "element(1)%damping=4*1e3": "stiffness, damping or mass is given too; give one of them",
    "element(1)%frequency=synchronous": "has no effect, as seal.csv has no column frequency_hz",
    "element(1)%file=x.csv": "element(1)%file: x.csv: no such file",
}
ROW = "1,2,3,4,5,6,7,8"
FILE_REFUSED = {
    f"speed_rpm,{COLUMNS},m_yy\n1,{ROW},1\n2,{ROW},1\n": " line 1: must have all of m_yy, m_yz, m_zy, m_zz",
    f"speed_rpm,frequency,{COLUMNS}\n": " line 1: speed_rpm,frequency,k_yy",
    f"speed_rpm,{COLUMNS}\n1,{ROW},9\n": "line 2: has more than 9 numbers; the columns",
    f"speed_rpm,{COLUMNS}\n2,{ROW}\n1,{ROW}\n": " line 3: speed_rpm = 1: speeds must rise",
    f"speed_rpm,frequency_hz,{COLUMNS}\n1,10,{ROW}\n1,20,{ROW}\n2,10,{ROW}\n2,21,{ROW}\n": " line 5: "
    "speed_rpm = 2, frequency_hz = 21: speeds must rise from row to row, and each must",
    f"speed_rpm,frequency_hz,{COLUMNS}\n1,10,{ROW}\n1,20,{ROW}\n20000,10,{ROW}\n20000,20,{ROW}\n": " "
    "'own': seal.csv has coefficients over the frequency, which only modes take at their own",
}

REFUSED = {
    "&element station=3, mass=-1e3,0,0,-1e3 /": "element%mass: takes away more mass in a direction than the",
    "&element stiffness=4*1e6 /": "element(1)%station: must be given, 1 to 16",
    "&element station=17 /": "element(1)%station = 17: must be 1 to 16",
    "&element station=3, to_station=20 /": "element(1)%to_station = 20: must be 1 to 16",
    "&element station=3, to_station=3 /": "element(1)%to_station = 3: is its station; an element has",
    "&element station=3, to_station=4, housing='left' /": "to_station is given too; give one of them",
    "&element station=3, housing='left' /": "element(1)%housing = 'left': must be the name of a bearing",
    "&element station=3, stiffness=1e6 /": "element(1)%stiffness = 1e6: takes 4 values",
    "&element station=3, static=.false. /\n&start from='file', file='x.h5' /": "needs start%from",
}


def eigenvalues(file):
    modes = file["modes"]
    return modes["eigenvalue_real"][0] + 1j * modes["eigenvalue_imag"][0]


def expect_eigenvalues(file, expected, error):
    found = eigenvalues(file)
    for value in expected:
        assert np.nanmin(abs(found - value)) < error * abs(value)


@pytest.mark.parametrize("what", SEALS)
def test_a_balance_piston(result, what):
    """Equilibrium, eigenvalues and whirl with all modes of the shaft, and with those that a run chooses.

    Amplitudes are compared as phasors, which lag by little where a mode is left out.
    """
    element = PISTON.format("" if what == "static" else ", static=.false.")
    for reduction, eigenvalue, amplitude in (
        (WHOLE, 1e-6, 1e-5),
        ("", 1e-4, 1e-4),
    ):
        with result(COMPRESSOR + element + reduction) as file:
            expected = SEALS[what]
            expect_eigenvalues(file, expected["eigenvalues"], eigenvalue)
            for b, name in enumerate(("left", "right")):
                found = [file[f"bearings/{name}/equilibrium/journal_{axis}"][()] for axis in "yz"]
                np.testing.assert_allclose(found, expected["journals"][b], rtol=1e-5, atol=1e-12)
                loads = [file[f"equilibrium/bearing_load_{axis}"][b] for axis in "yz"]
                np.testing.assert_allclose(loads, expected["loads"][b], rtol=1e-6, atol=1e-3)
            station = [file[f"equilibrium/station_{axis}"][9] for axis in "yz"]
            np.testing.assert_allclose(station, expected["station"], rtol=1e-5)
            force = [file[f"equilibrium/element_force_{axis}"][0] for axis in "yz"]
            stiffness = np.array([[12e6, 7.2e6], [-7.2e6, 12e6]]) * (what == "static")
            np.testing.assert_allclose(force, -stiffness @ station, rtol=1e-9, atol=1e-9)
            whirl = np.array(
                [file[f"response/{a}_real"][0, 6] + 1j * file[f"response/{a}_imag"][0, 6] for a in "yz"]
            )
            assert abs(whirl - expected["whirl"]).max() < amplitude * abs(whirl).max()


def test_level_i(result):
    """Of a cross-coupled stiffness that acts in motion alone, in both senses of rotation."""
    for rotation in ("clockwise", "anticlockwise"):
        for stiffness, eigenvalue in LEVEL_I.items():
            element = f"&element station=7, static=.false., cross_stiffness={stiffness!r} /\n"
            with result(COMPRESSOR + WHOLE + element, f"operation%rotation={rotation}") as file:
                expect_eigenvalues(file, [eigenvalue], 1e-6)


def test_the_cross_stiffness_of_the_task_is_that_of_elements_at_the_journals(result):
    found = []
    support = "&support mass=40, stiffness=2e8, 3e8 /\n"
    elements = "".join(
        f"&element station={at}, housing='{name}', static=.false., cross_stiffness=1e7 /\n"
        for at, name in ((2, "left"), (14, "right"))
    )
    for added in ("&coefficients cross_stiffness=1e7 /\n", elements):
        with result(COMPRESSOR + support + added) as file:
            found.append(np.sort_complex(np.nan_to_num(eigenvalues(file))))
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9, atol=1e-6)


def test_an_orbit_about_the_equilibrium_is_the_linear_whirl(result):
    """Of an element that acts in motion alone, with a stiffness that is not symmetric and a mass."""
    case = COMPRESSOR.replace("moment=1e-4", "moment=1e-6") + PISTON.format(
        ", mass=3, 0, 0, 2, static=.false."
    )
    # by the same modes and without damping of their own, the fewer the longer the steps
    modes = ("reduction%frequency=2000", "reduction%damp_above=1e7")
    with result(case, *modes) as file:
        expected = [np.hypot(file[f"response/{a}_real"][0], file[f"response/{a}_imag"][0]) for a in "yz"]
    with result(case, *modes, "case%task=periodic") as file:
        found = [file[f"summary/station_{a}_amplitude"][()] for a in "yz"]
        np.testing.assert_allclose(found, expected, rtol=1e-6)
        assert file["element_force_y"].shape == (*file["time"].shape, 1)


@pytest.mark.parametrize("group", REFUSED)
def test_an_element_is_refused(run, group):
    assert REFUSED[group] in run(COMPRESSOR + group, status=1).stderr


def test_a_branch_of_orbits_moves_about_its_equilibria(result):
    """Of an element that acts in motion alone: both ends are the orbits found there alone."""
    case = COMPRESSOR + PISTON.format(", static=.false.")
    branch = "&branch parameter='operation%speed_rpm', last=12000, step=500 /\n"
    names = [f"station_{axis}_{end}" for axis in "yz" for end in ("max", "min")]
    with result(case + branch, "case%task=branch") as file:
        assert file["parameter"][-1] == 12000
        found = {at: np.array([file[name][at] for name in names]) for at in (0, -1)}
        parts = [file[f"multiplier_{part}"] for part in ("real", "imag")]
        multiplier = {at: np.hypot(*(part[at, 0] for part in parts)) for at in found}
        first = file["parameter"][0]
    for at, speed in ((0, first), (-1, 12000)):
        with result(case, "case%task=periodic", f"operation%speed_rpm={speed}") as file:
            path = [file[f"station_{axis}"][:] for axis in "yz"]
            expected = np.array([each for one in path for each in (one.max(axis=0), one.min(axis=0))])
            # between the samples an orbit goes a little further
            np.testing.assert_allclose(found[at], expected, atol=2e-3 * np.ptp(expected, axis=0).max())
            size = np.hypot(file["periodic/multiplier_real"][0], file["periodic/multiplier_imag"][0])
            assert multiplier[at] == pytest.approx(size, rel=1e-4)
    with result(case.replace(", static=.false.", "") + branch, "case%task=branch") as file:
        # which an element that bears load, too, moves elsewhere
        assert np.abs(file["station_y_max"][-1] - found[-1][0]).max() > 1e-7


@pytest.fixture
def seal(tmp_path):
    """Writes the table of the seal over the speed."""
    rows = [f"{speed},{k},{q},{-q},{k},{c},{d},{-d},{c}" for speed, k, q, c, d in BY_SPEED]
    (tmp_path / "seal.csv").write_text("\n".join([f"speed_rpm,{COLUMNS}", *rows, ""]))


def test_level_ii(result, tmp_path):
    """Coefficients over the whirl frequency: modes take them at their own, or at that of the speed."""
    rows = [
        f"{speed},{nu / (2 * np.pi)!r},{k},{q},{-q},{k},{c},0,0,{c}"
        for speed in (5000, 15000)
        for nu, k, q, c in BY_FREQUENCY
    ]
    (tmp_path / "piston.csv").write_text("\n".join([f"speed_rpm,frequency_hz,{COLUMNS}", *rows, ""]))
    for frequency, eigenvalue in LEVEL_II.items():
        piston = f"&element station=10, static=.false., file='piston.csv'{frequency} /\n" if frequency else ""
        with result(COMPRESSOR + WHOLE + LABYRINTHS + piston) as file:
            expect_eigenvalues(file, [eigenvalue], 1e-6)


def test_a_run_up_has_the_coefficients_of_each_speed(result, seal):
    """The first twelve modes in a plane, as the values have them; steps as fine as their errors are small.

    With the coefficients of the start amplitudes would be 4 % smaller.
    """
    other = "&unbalance station=16, moment=1e-4, angle_deg=90 /"
    case = COMPRESSOR.replace("moment=1e-4 /", f"moment=3e-4 /\n{other}")
    case = case.replace("speed_rpm=11000", "speed_rpm=3500, final_speed_rpm=8500, duration=1")
    run_up = ("case%task=march", "integration%relative_tolerance=1e-7", "reduction%frequency=4700")
    with result(case + "&element station=10, file='seal.csv' /\n", *run_up) as file:
        for station, expected in RUN_UP.items():
            found = np.interp(np.linspace(0, 1, 11), file["time"], file["station_y"][:, station - 1])
            assert abs(found - expected).max() < 2e-4 * LARGEST


@pytest.mark.parametrize("override", TABLE_REFUSED)
def test_a_table_is_refused(run, seal, override):
    case = COMPRESSOR + "&element station=10, file='seal.csv' /\n"
    assert TABLE_REFUSED[override] in run(case, *override.split(), status=1).stderr


@pytest.mark.parametrize("text", FILE_REFUSED)
def test_the_file_of_a_table_is_refused(run, tmp_path, text):
    (tmp_path / "seal.csv").write_text(text)
    line = run(COMPRESSOR + "&element station=10, file='seal.csv' /\n", "case%task=march", status=1).stderr
    assert f"element(1)%file: seal.csv{FILE_REFUSED[text]}" in line or FILE_REFUSED[text] in line


def test_masses_are_constant_where_the_speed_changes(run, tmp_path):
    rows = [f"{speed},{ROW},{speed},0,0,1" for speed in (1, 20000)]
    (tmp_path / "seal.csv").write_text("\n".join([f"speed_rpm,{COLUMNS},m_yy,m_yz,m_zy,m_zz", *rows, ""]))
    case = COMPRESSOR + "&element station=10, file='seal.csv' /\n"
    line = run(case, "case%task=march", "operation%final_speed_rpm=9000", status=1).stderr
    assert "element(1)%file = 'seal.csv': m_yy to m_zz must be constant where the speed changes" in line


#: A compressor whose housings stand on springs in squeeze film dampers, with eight modes in a plane: where
#: stations and the rings of the dampers go in the orbit, m. Here the weight of the housings is added, by
#: which all sinks and which the offset takes up.
SINKS = 40 * 9.81 / 3e7
IN_DAMPERS = f"""{COMPRESSOR.replace("moment=1e-4", "moment=1.5e-3").replace("11000", "9000")}
&support mass=40, stiffness=2*3e7 /
&damper radius=0.09, length=0.03, clearance=0.12e-3, viscosity=0.016, offset={45e-6 + SINKS!r}, 0 /
&reduction frequency=2500 /
"""
ORBITS = {
    "station": {
        1: ((-7.764679e-05, -5.506642e-05), (-1.121671e-05, 1.14711e-05)),
        6: ((-9.469478e-05, -8.339653e-05), (-5.48176e-06, 5.678312e-06)),
        13: ((-7.340652e-05, -6.425013e-05), (-4.453384e-06, 4.656388e-06)),
        15: ((-6.896686e-05, -5.641079e-05), (-6.165204e-06, 6.297076e-06)),
    },
    "element": {
        0: ((-6.102425e-05, -4.222748e-05), (-9.310561e-06, 9.317346e-06)),
        1: ((-5.75228e-05, -4.985838e-05), (-3.774119e-06, 3.747536e-06)),
    },
}  # fmt: skip


def test_an_orbit_in_dampers(result):
    """To 1e-4 of the clearance; 360 samples miss an extreme by 4e-5 of the vibration at most."""
    with result(IN_DAMPERS, "case%task=periodic") as file:
        for what, shift in (("station", -SINKS), ("element", 45e-6)):
            for at, expected in ORBITS[what].items():
                for axis, ends in zip("yz", expected, strict=True):
                    found = [file[f"summary/{what}_{axis}_{end}"][at] for end in ("min", "max")]
                    np.testing.assert_allclose(found, np.add(ends, shift * (axis == "y")), atol=1.2e-8)
        assert [name.decode() for name in file["rotor/element_name"]] == ["damper:left", "damper:right"]
        sizes = np.hypot(file["element_y"][()], file["element_z"][()]).max(0) / 0.12e-3
        np.testing.assert_allclose(file["summary/damper_eccentricity"], sizes, rtol=1e-6)


DAMPERS_REFUSED = {
    "damper:left%clearance=-1": "damper:left%clearance: must be given",
    "damper%offset=1e-3,0": "damper:left%offset = 0.001, 0: must lie within clearance = 1.2e-4",
    "damper%offset=-80e-6,0": "the damper of bearing 'right' is closed: its ring lies at y -147",
    "damper%clearance=0.02": "damper:left%clearance = 0.02: must be below a tenth of radius = 0.09",
    "damper%film=none": "must be one of 'pi', 'full', 'sealed'",
}


@pytest.mark.parametrize("override", DAMPERS_REFUSED)
def test_a_damper_is_refused(run, override):
    assert DAMPERS_REFUSED[override] in run(IN_DAMPERS, override, status=1).stderr


def test_a_damper_needs_a_spring(run):
    case = IN_DAMPERS.replace("&support mass=40, stiffness=2*3e7 /", "")
    assert "damper:left%clearance = 1.2e-4: needs a group &support" in run(case, status=1).stderr


#: Machines without films: seals and bearings by coefficients over the speed, rpm, each with stiffness and
#: damping yy, yz, zy, zz; at 10000 rpm, between two of these speeds, eigenvalues, and station 10 at rest and
#: station 7 in the whirl under the unbalances.
SPEEDS = (4000, 8000, 12000, 16000)
LINEAR = {
    "ball": (
        (60e6, 3e6, -2e6, 46e6, 90e3, 2e3, 2e3, 80e3),
        (70e6, 4e6, -2.5e6, 56e6, 70e3, 1.5e3, 1.5e3, 60e3),
        (76e6, 5e6, -3e6, 62e6, 56e3, 1e3, 1e3, 50e3),
        (80e6, 6e6, -3.5e6, 68e6, 48e3, 800, 800, 42e3),
    ),
    "seal": (
        (2e6, 3e6, -3e6, 2e6, 12e3, 1e3, -1e3, 12e3, 6, 0, 0, 6),
        (5e6, 6e6, -6e6, 5e6, 15e3, 2e3, -2e3, 15e3, 6, 0, 0, 6),
        (9e6, 10e6, -10e6, 9e6, 18e3, 3e3, -3e3, 18e3, 6, 0, 0, 6),
        (14e6, 15e6, -15e6, 14e6, 20e3, 4e3, -4e3, 20e3, 6, 0, 0, 6),
    ),
}
LINEAR_MODES = (
    -57.38886956962306 + 513.7281150844277j,
    -112.38272889983293 + 507.6337109044071j,
    -450.8458470838027 + 929.8867566924532j,
)
STATION_10 = (-3.5603708395329014e-05, -5.266071453999416e-06)
WHIRL_7 = (
    (-6.487613712005249e-07 - 2.6733345169635783e-07j),
    (-2.7532114712168013e-07 + 6.381980634913152e-07j),
)
NO_FILMS = f"""{SHAFT}
&case task='coefficients' /
&operation speed_rpm=10000 /
&unbalance station=7, moment=1e-4 /
&unbalance station=16, moment=3e-5, angle_deg=120 /
&bearing kind='linear', file='ball.csv' /
&bearing name='left', station=2 /
&bearing name='right', station=14 /
&element station=10, file='seal.csv' /
"""


@pytest.fixture
def tables(tmp_path):
    masses = ",m_yy,m_yz,m_zy,m_zz"
    for name, rows in LINEAR.items():
        lines = [f"{speed},{','.join(map(str, row))}" for speed, row in zip(SPEEDS, rows, strict=True)]
        head = f"speed_rpm,{COLUMNS}{masses if name == 'seal' else ''}"
        (tmp_path / f"{name}.csv").write_text("\n".join([head, *lines, ""]))


def test_bearings_by_coefficients(result, tables):
    """A machine without films: statics, modes, whirl; what elements add to the decrements is all of these."""
    with result(NO_FILMS + WHOLE) as file:
        expect_eigenvalues(file, LINEAR_MODES, 1e-8)
        station = [file[f"equilibrium/station_{axis}"][9] for axis in "yz"]
        np.testing.assert_allclose(station, STATION_10, rtol=1e-8)
        whirl = [file[f"response/{a}_real"][0, 6] + 1j * file[f"response/{a}_imag"][0, 6] for a in "yz"]
        np.testing.assert_allclose(whirl, WHIRL_7, rtol=1e-7)
        decrement = file["modes/log_decrement"][0]
        of_elements = file["modes/element_decrement"][0].sum(1)
        vibrates = np.isfinite(decrement)
        np.testing.assert_allclose(of_elements[vibrates], decrement[vibrates], rtol=1e-6, atol=1e-9)
        names = [name.decode() for name in file["rotor/element_name"]]
        assert names == ["element(1)", "bearing:left", "bearing:right"]
        force = sum(file["equilibrium/element_force_y"])
        assert abs(force - 9.81 * file["rotor/total_mass"][()]) < 1e-6 * force


#: An aero rotor on ball bearings in dampers: where orbits turn back over the speed, rpm, and the eccentricity
#: ratios there, of a rotor whose weight leaves the rings in the middle.
AERO = (Path(__file__).parents[2] / "input/examples/aero.nml").read_text()
FOLDS = ((7410.150307313705, (0.80338446, 0.79169291)), (7000.218256125207, (0.63238641, 0.62228512)))


def test_a_jump_between_orbits(result):
    """The branch of orbits turns back twice: between, two orbits are stable and one is not."""
    with result(AERO, "branch%last=8000", "rotor%gravity=0", "damper%offset=0,0") as file:
        assert file["bifurcations/kind"][()].tolist() == [b"fold", b"fold"]
        places = file["bifurcations/point"][()].astype(int) - 1
        for place, (speed, ratios) in zip(places, FOLDS, strict=True):
            assert abs(file["parameter"][place] - speed) < 1e-4 * speed
            np.testing.assert_allclose(file["damper_eccentricity"][place], ratios, atol=2e-4)
        assert not file["stable"][places[0] + 1 : places[1]].any()
        assert file["stable"][0] == file["stable"][-1] == 1


#: Largest eccentricity ratios of both rings, and station 4, mean and first harmonic of y, in orbits that sink
#: by their weight, by speed, rpm.
SUNK = {
    6000: ((0.7534296152508352, 0.7338602521595208), -2.0330865088572626e-05,
           5.7940808304876866e-05 - 7.615622773581539e-05j),
    9000: ((0.4447661374411313, 0.463078591705312), None, None),
}  # fmt: skip


@pytest.mark.parametrize("speed", SUNK)
def test_orbits_off_the_middle_of_dampers(result, speed):
    ratios, mean, first = SUNK[speed]
    eccentric = AERO.replace("0.7e-3", "0.5e-3").replace("0.35e-3", "0.25e-3")
    with result(eccentric, "case%task=periodic", f"operation%speed_rpm={speed}", "damper%offset=0,0") as file:
        np.testing.assert_allclose(file["summary/damper_eccentricity"], ratios, atol=1e-4)
        if mean is not None:
            turn = file["station_y"][:-1, 3]
            assert abs(turn.mean() - mean) < 1e-8
            assert abs(2 * abs(np.fft.rfft(turn)[1]) / turn.size - abs(first)) < 1e-8


#: What is changed in the aero rotor, and what the line says.
LINEAR_REFUSED = {
    "bearing%stiffness=4*0": "nothing holds its shaft",
    "bearing%stiffness=1.5e8,3*0": "nothing holds its shaft",
    "bearing:front%viscosity=0.02": "bearing:front%viscosity = 0.02: has no effect on a bearing of this kind",
    "pads:front%arc_deg=60": "pads:front%arc_deg = 60: has no effect on a bearing of this kind",
    "bearing:front%frequency=synchronous": "%frequency = 'synchronous': has no effect without a file",
    "bearing:front%file=x.csv": "bearing:front%file = 'x.csv': stiffness, damping or mass is given too",
    "bearing:front%kind=ball": "bearing:front%kind = ball: must be one of 'film', 'linear'",
}


@pytest.mark.parametrize("override", LINEAR_REFUSED)
def test_a_bearing_by_coefficients_is_refused(run, override):
    assert LINEAR_REFUSED[override] in run(AERO, override, status=1).stderr
