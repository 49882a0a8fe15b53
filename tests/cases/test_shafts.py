"""Shafts that damp their own bending, that are bent or carry skew discs, and housings with cross terms.

The values are those of the independent program of test_elements, with rounding errors of 1e-9.
"""

import numpy as np
import pytest
from test_elements import SHAFT, WHOLE, expect_eigenvalues

#: On two bearings by coefficients, N s/m.
ON_BEARINGS = """{shaft}
&case task='coefficients' /
&operation speed_rpm={rpm} /
&bearing kind='linear', stiffness=80e6, 0, 0, 80e6, damping={damping}, 0, 0, {damping} /
&bearing name='left', station=2 /
&bearing name='right', station=14 /
"""
DAMPED = ON_BEARINGS.format(
    shaft=SHAFT.replace("&shaft", "&shaft internal_damping=2e-5,"), rpm=11000, damping=2000
)
#: The first modes at two speeds, rpm, and where one of them begins to grow.
DAMPED_MODES = {
    6000: (-4.551108587308633 + 508.94616461467183j, -1.3481352311363537 + 511.9339733249578j,
           -32.77292048982008 + 1940.7058635014791j, -163.23334117693685 + 3667.4142341557217j),
    11000: (-5.934656508735898 + 507.69672480863403j, -0.06111780288292579 + 513.1739897683406j,
            -27.285035968267493 + 1974.8308178271327j, -177.42298313782908 + 3588.3428968779363j),
}  # fmt: skip
GROWS_RPM = 11240.11246432985

#: Bent to half a wave between its bearings, m.
BENT = (-2.8897809913844268e-06, 0, 2.8897809913844268e-06, 7.987291671313912e-06, 1.2896844254723412e-05,
        1.6729402760204533e-05, 1.9164916582183326e-05, 2e-05, 1.9164916582183326e-05, 1.672940276020454e-05,
        1.2896844254723424e-05, 7.987291671313927e-06, 2.889780991384428e-06, 0, -2.8897809913844323e-06,
        -6.180339887498946e-06)  # fmt: skip
BOWS = "".join(
    f"&bow station={at}, displacement={abs(bent)!r}, angle_deg={0 if bent >= 0 else 180} /\n"
    for at, bent in enumerate(BENT, 1)
)
#: Whirl along y, m, by speed, rpm: of station 8 of the bent shaft, of station 16 with a disc that is skew
#: there by 1 mrad in the direction of 90 degrees; along z it lags by a quarter of a turn.
WHIRLS = {
    3000: (
        3.021877442646716e-05 - 1.6252603641845544e-06j,
        -1.2675765860985092e-08 - 2.7276143999516566e-07j,
    ),
    5000: (2.002417197428587e-05 - 9.86131872527426e-05j, 3.3697483552899446e-07 - 1.1624760371791499e-06j),
    11000: (-3.223572451852458e-06 - 4.312194126494797e-06j, -3.9054353125685e-06 - 3.3119709760300667e-06j),
}
SKEW = ("polar_inertia=0.17 /", "polar_inertia=0.17, skew=1e-3, skew_angle_deg=90 /")

#: On housings, whose springs and dampers have cross terms, and a seal between shaft and
#: housing; the weight of the housings is what the values do not have.
ON_HOUSINGS = f"""{SHAFT}
&case task='coefficients' /
&operation speed_rpm=9000 /
&bearing kind='linear', stiffness=220e6, 0, 0, 190e6, damping=2000, 0, 0, 1800 /
&bearing name='left', station=2 /
&bearing name='right', station=14 /
&support bearing='left', mass=45, stiffness=90e6, 55e6, damping=40e3, 30e3 /
&support bearing='right', mass=60, stiffness=70e6, 60e6, damping=30e3, 30e3 /
&element housing='left', stiffness=0, 8e6, 6e6, 0, damping=0, 2e3, 2e3, 0 /
&element housing='right', stiffness=0, -5e6, -5e6, 0 /
&element station=3, housing='left', stiffness=2e6, 3e6, -3e6, 2e6, damping=5e3, 400, -400, 5e3 /
&unbalance station=7, moment=1e-4 /
&unbalance station=16, moment=4e-5, angle_deg=100 /
"""
HOUSING_MODES = (-27.12855123506347 + 411.2221578624662j, -24.233128666987454 + 453.2805877144276j,
                 -110.2022783116785 + 688.1772638678588j, -108.99665519206246 + 781.9974321279992j,
                 -164.49144571373148 + 1262.0776803874335j)  # fmt: skip
HOUSING_WHIRL = {
    6: (-7.124036315102488e-07 - 7.955424243903072e-08j, -2.646165941169392e-07 + 5.468709560499298e-07j),
    15: (1.190720495424186e-06 - 1.0245885004802047e-07j, 9.113453994945229e-08 - 5.625602884400672e-07j),
}


def whirl(file, station):
    return [
        file[f"response/{a}_real"][0, station] + 1j * file[f"response/{a}_imag"][0, station] for a in "yz"
    ]


@pytest.mark.parametrize("rpm", DAMPED_MODES)
def test_internal_damping(result, rpm):
    with result(DAMPED + WHOLE, f"operation%speed_rpm={rpm}") as file:
        expect_eigenvalues(file, DAMPED_MODES[rpm], 1e-8)
    with result(DAMPED, f"operation%speed_rpm={rpm}", "operation%rotation=anticlockwise") as file:
        expect_eigenvalues(file, DAMPED_MODES[rpm][:2], 1e-4)


def test_internal_damping_has_a_threshold_speed(result):
    with result(DAMPED + WHOLE, "coefficients%threshold_up_to_rpm=12000") as file:
        assert abs(file["modes/threshold_rpm"][0] - GROWS_RPM) < 1e-4 * GROWS_RPM


@pytest.mark.parametrize("rpm", WHIRLS)
def test_a_bow_and_a_skew_disc(result, rpm):
    """Alone, and the orbit of a motion under both."""
    straight = ON_BEARINGS.format(shaft=SHAFT, rpm=rpm, damping=60e3)
    skew = ON_BEARINGS.format(shaft=SHAFT.replace(*SKEW), rpm=rpm, damping=60e3)
    of_bow, of_skew = WHIRLS[rpm]
    for reduction, error in ((WHOLE, 1e-8), ("", 3e-4)):
        with result(straight + BOWS + reduction) as file:
            np.testing.assert_allclose(whirl(file, 7), (of_bow, -1j * of_bow), atol=error * abs(of_bow))
        with result(skew + reduction) as file:
            np.testing.assert_allclose(whirl(file, 15), (of_skew, -1j * of_skew), atol=error * abs(of_skew))
    # by the same modes and without damping of their own, the fewer the longer the steps
    modes = ("reduction%frequency=2000", "reduction%damp_above=1e7")
    with result(skew + BOWS, *modes) as file:
        expected = [abs(x) for x in whirl(file, 7)]
    with result(skew + BOWS, *modes, "case%task=periodic") as file:
        found = [file[f"summary/station_{a}_amplitude"][7] for a in "yz"]
        np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_a_bow_of_one_station_is_bent_least(result):
    """Between the bearings: with the displacements that it has elsewhere given, too, nothing changes."""
    case = ON_BEARINGS.format(shaft=SHAFT, rpm=3000, damping=60e3)
    one = "&bow station=8, displacement=2e-5 /\n"
    with result(case + one + WHOLE) as file:
        found = whirl(file, 7)
    with result(case + one + "&bow station=2 /\n&bow station=14, angle_deg=30 /\n" + WHOLE) as file:
        np.testing.assert_allclose(whirl(file, 7), found, rtol=1e-12)
    # far below the critical speed the shaft turns in its bow, less what its bearings give way
    with result(case + one + WHOLE, "operation%speed_rpm=30") as file:
        assert abs(abs(whirl(file, 7)[0]) - 2e-5) < 1e-3 * 2e-5


def test_housings_with_cross_terms(result):
    with result(ON_HOUSINGS + WHOLE) as file:
        expect_eigenvalues(file, HOUSING_MODES, 1e-8)
        for station, expected in HOUSING_WHIRL.items():
            np.testing.assert_allclose(whirl(file, station), expected, rtol=1e-7)
        # an element under a housing has the force on it, and its displacement
        place = [file[f"equilibrium/element_{a}"][0] for a in "yz"]
        force = [file[f"equilibrium/element_force_{a}"][0] for a in "yz"]
        np.testing.assert_allclose(force, -np.array([[0, 8e6], [6e6, 0]]) @ place, rtol=1e-9)
        assert place[0] < -1e-5


REFUSED = {
    "&bow displacement=1e-5 /": "bow(1)%station: must be given, 1 to 16",
    "&bow station=20, displacement=1e-5 /": "bow(1)%station = 20: must be 1 to 16",
    "&bow station=2, displacement=-1 /": "bow(1)%displacement = -1: must be 0 to 0.1 m",
    "&element housing='middle' /": "element(1)%housing = 'middle': must be the name of a bearing with",
    "&element housing='left', to_station=3 /": "element(1)%station: must be given",
    "&branch of='limit_cycle', parameter='operation%speed_rpm', last=12000 /\n"
    "&bow station=8, displacement=1e-5 /\n&case task='branch' /": "must be without groups &bow and disc%skew",
}


@pytest.mark.parametrize("groups", REFUSED)
def test_a_shaft_is_refused(run, groups):
    case = DAMPED.replace("&case task='coefficients' /", "") if "&case" in groups else DAMPED
    assert REFUSED[groups] in run(case + groups, status=1).stderr


def test_modes_of_a_damped_shaft_are_those_of_a_march(result):
    """What is left of a kick decays as the first forward mode does, the least damped one by far."""
    value = DAMPED_MODES[6000][1]
    march = ("case%task=march", "operation%speed_rpm=6000", "operation%duration=1.8", "rotor%gravity=0")
    kick = "&excitation kind='step', station=8, amplitude=3000, start=0, end=0.01 /\n"
    with result(DAMPED + kick, *march, "integration%relative_tolerance=1e-7") as file:
        t, y = file["time"][()], file["station_y"][:, 7]
        late = [np.abs(y[(t > a) & (t < a + 0.1)]).max() for a in (1.0, 1.6)]
        assert abs(np.log(late[0] / late[1]) / 0.6 + value.real) < 0.1


#: Undamped: its modes up to twice the speed are no high ones of the reduction, and none of them grows.
UNDAMPED = ON_BEARINGS.format(shaft=SHAFT, rpm=60000, damping=0)


def test_modes_without_damping_are_listed_and_are_no_instability(result):
    with result(UNDAMPED) as file:
        modes, speed = file["modes"], 60000 / 60
        frequency, part = modes["frequency"][0], modes["part_of_reduction"][0]
        slow = (frequency > 0) & (frequency <= 2 * speed)
        assert slow.sum() >= 4
        assert (part[slow] == 0).all()
        assert part[frequency > 2 * speed].max() > 0.5
        assert (modes["damping_ratio"][0][slow] == 0).all()
        assert (np.diff(frequency[slow]) >= 0).all()
        assert file["summary/rotor_damping_ratio"][0] == 0
