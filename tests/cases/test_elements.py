"""What machines have besides bearings: elements with coefficients, at stations of the shaft.

The values are those of an independent program (Timoshenko beams by Cowper, tilting pads with converged films,
all degrees of freedom): its eigenvalues have rounding errors of 1e-9 with linear elements, and its films err
by 1e-6 of the coefficients.
"""

import h5py
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
#: All modes, none of them damped.
WHOLE = "&reduction frequency=1e5, damp_above=1e7 /\n"
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

REFUSED = {
    "&element stiffness=4*1e6 /": "element(1)%station: must be given, 1 to 16",
    "&element station=17 /": "element(1)%station = 17: must be 1 to 16",
    "&element station=3, to_station=20 /": "element(1)%to_station = 20: must be 1 to 16",
    "&element station=3, to_station=3 /": "element(1)%to_station = 3: is its station; an element has",
    "&element station=3, to_station=4, housing='left' /": "to_station is given too; give one of them",
    "&element station=3, housing='left' /": "element(1)%housing = 'left': must be the name of a bearing",
    "&element station=3, stiffness=1e6 /": "element(1)%stiffness = 1e6: takes 4 values",
    "&element station=3, static=.false. /\n&start from='file', file='x.h5' /": "needs start%from",
}


@pytest.fixture
def result(run, tmp_path):
    """The file of a case."""

    def make(case, *overrides):
        run(case, *overrides, more=["--overwrite"])
        return h5py.File(tmp_path / "case.h5")

    return make


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
        ("&reduction damp_above=1e7 /\n", 1e-4, 1e-4),
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
    with result(case) as file:
        expected = [np.hypot(file[f"response/{a}_real"][0], file[f"response/{a}_imag"][0]) for a in "yz"]
    with result(case, "case%task=periodic") as file:
        found = [file[f"summary/station_{a}_amplitude"][()] for a in "yz"]
        np.testing.assert_allclose(found, expected, rtol=1e-4)
        assert file["element_force_y"].shape == (*file["time"].shape, 1)


@pytest.mark.parametrize("group", REFUSED)
def test_an_element_is_refused(run, group):
    assert REFUSED[group] in run(COMPRESSOR + group, status=1).stderr


def test_a_branch_of_orbits_has_no_equilibria_to_move_about(run):
    branch = "&branch parameter='operation%speed_rpm', last=12000 /\n"
    done = run(COMPRESSOR + branch + PISTON.format(", static=.false."), "case%task=branch", status=1)
    assert "static = .false.: is not for a branch of periodic orbits" in done.stderr
