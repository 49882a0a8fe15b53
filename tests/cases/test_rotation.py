"""A mirrored bearing or machine whose shaft turns the other way moves as in a mirror, to the last bit."""

import h5py
import numpy as np
import pytest

#: Pads that differ in everything a mirror changes, friction, an excitation that turns, and loads aside.
PADS = {"angles": (-50, 20, 140, 225), "others": "arc_deg=60,55,62,58, pivot_ratio=0.5,0.55,0.6,0.57"}
BEARING = """&rotor mass=2000, static_load=1000,{aside:g} /
&operation speed_rpm=6500, duration=0.02, rotation='{rotation}' /
&pads pivot_angle_deg={angles}, {others} /
&bearing machined_clearance=1e-4,1.1e-4,1e-4,0.95e-4 /
&output samples_per_revolution=60 /
"""
SHAKEN = (
    "&excitation kind='harmonic', amplitude=500, frequency_ratio=0.5, rotating='forward',"
    " direction_deg={to} /\n"
)
TABLE = "&excitation kind='table', file='{table}' /\n"
EQUAL = {"angles": (-45, 225), "others": "arc_deg=69.3, pivot_ratio=0.5"}
EQUAL_PADS = BEARING.replace("machined_clearance=1e-4,1.1e-4,1e-4,0.95e-4", "machined_clearance=1e-4")
MACHINE = """&shaft length=0.05, 0.05, 8*0.2, 0.05, 0.05, diameter=0.0998, 0.0998, 8*0.34, 0.0998, 0.0998 /
&disc station=7, mass=2000, polar_inertia=500, diametral_inertia=280 /
&disc station=1, mass=100, polar_inertia=20, diametral_inertia=11 /
&unbalance station=7, moment=0.01, angle_deg=40 / &unbalance station=1, moment=0.001, angle_deg=-70 /
&load station=7, force=500,{aside:g} /
&bearing name='left', station=2, offset=1e-5,{offset:g} / &bearing name='right', station=12 /
&pads bearing='left', pivot_angle_deg={angles}, {others} /
&pads bearing='right', pivot_angle_deg={second} /
&support bearing='left', mass=200, stiffness=1e9,2e9, damping=1e5,1e5 /
&operation speed_rpm=3000, duration=0.03, rotation='{rotation}' / &output samples_per_revolution=40 /
"""
STATION = "&excitation station=7, kind='harmonic', rotating='backward', amplitude=800, frequency_ratio=2 /\n"
SPEEDS = ("case%task='branch'", "branch%parameter='operation%speed_rpm'", "branch%step=100")
WARM = ("oil%grade=32", "thermal%model='film'")
COEFFICIENTS = "case%task='coefficients'"
THRESHOLD = ("coefficients%cross_stiffness=2e7", "coefficients%threshold_up_to_rpm=20000")
#: Case, pads, and what is set.
CASES = {
    "march": (BEARING + SHAKEN + TABLE, PADS, ("friction%model='lugre'",)),
    "run-up": (BEARING, PADS, (WARM[0], "thermal%model='pad'", "operation%final_speed_rpm=6000")),
    "touching": (BEARING + SHAKEN, PADS, ("excitation(1)%amplitude=60000", "film%cavitation='gumbel'")),
    "equal pads": (EQUAL_PADS, EQUAL, ("start%from='centred'", "friction%model='bengisu_akay'")),
    "fixed pads": (BEARING, PADS, ("pads%motion='fixed'", "case%task='equilibrium'")),
    "equilibrium": (BEARING, PADS, ("case%task='equilibrium'", "film%solver='direct'")),
    "coefficients": (BEARING, PADS, (COEFFICIENTS, *THRESHOLD)),
    "warm": (BEARING, PADS, (COEFFICIENTS, *WARM)),
    "warm march": (BEARING, PADS, (*WARM, "operation%duration=0.004")),
    "periodic": (BEARING + SHAKEN, PADS, ("case%task='periodic'",)),
    "orbits": (BEARING, PADS, (*SPEEDS, "branch%last=6700")),
    "equilibria": (BEARING, PADS, (*SPEEDS, "branch%last=6700", "branch%of='equilibrium'")),
    "machine": (MACHINE + STATION, PADS, ()),
    "orbit of a machine": (MACHINE + STATION, PADS, ("case%task='periodic'",)),
    "modes of a machine": (MACHINE, PADS, (COEFFICIENTS,)),
    "branch of a machine": (MACHINE, PADS, (*SPEEDS, "branch%last=3200")),
}
#: Names of what a mirror makes its negative, of the highest and lowest of them, and of their phases.
NEGATIVE = ("journal_z", "journal_vz", "excitation_z", "station_z", "station_slope_z", "poincare_z", "mean_z",
            "bearing_load_z", "bearing_offset_z", "z_real", "z_imag")  # fmt: skip
SWAPPED = {"journal_z_max": "journal_z_min", "station_z_max": "station_z_min", "highest_z": "lowest_z"}
#: Eigenvalues are those of LAPACK, whose rotations are others in a mirror: equal to rounding.
OF_LAPACK = ("eigenvalue", "modes/", "synchronous/", "damping_ratio", "whirl", "multiplier", "bifurcations")


def text(case, pads, folder, mirrored):
    """The case, or what a mirror makes of it."""
    turn = -1 if mirrored else 1

    def angles(given):
        return ",".join(f"{180 - each if mirrored else each:g}" for each in given)

    table = folder / f"{'mirrored' if mirrored else 'own'}.csv"
    table.write_text(f"time,force_y,force_z\n0,0,0\n0.004,300,{turn * 700}\n0.01,0,{turn * -200}\n")
    own = {"rotation": "anticlockwise" if mirrored else "clockwise", "aside": turn * 3000}
    own |= {"angles": angles(pads["angles"]), "second": angles((-45, 225)), "others": pads["others"]}
    return case.format(**own, to=turn * 30, offset=turn * 2e-5, table=table)


def numbers(path):
    """All numbers of a result by their names, but for angles of pads, internal states, and run times."""
    found = {}

    def take(name, each):
        if isinstance(each, h5py.Dataset) and each.dtype.kind in "fi" and "seconds" not in name:
            found[name] = each[()]

    with h5py.File(path) as file:
        file.visititems(take)
    return {n: v for n, v in found.items() if not n.endswith(("pivot_angle", "turned_state"))}


def in_mirror(found):
    """What a mirror makes of all numbers."""
    other = SWAPPED | {low: high for high, low in SWAPPED.items()}
    seen = {}
    for name, values in found.items():
        group, _, own = name.rpartition("/")
        if own in other:
            values = -found[f"{group}/{other[own]}".lstrip("/")]
        elif own in NEGATIVE and not group.endswith("spectrum"):
            values = -values
        elif own.endswith("z_phase"):
            values = np.where(values > 0, values - np.pi, values + np.pi)
        elif group.endswith("coefficients") and values.ndim >= 2 and values.shape[-1] == values.shape[-2]:
            sign = np.ones(values.shape[-1])
            sign[1] = -1
            values = values * sign * sign[:, None]
        seen[name] = values
    return seen


@pytest.mark.parametrize("name", CASES)
def test_a_mirrored_case_gives_mirrored_results(run, tmp_path, name):
    case, pads, overrides = CASES[name]
    both = []
    for mirrored in (False, True):
        run(text(case, pads, tmp_path, mirrored), *overrides, name=f"mirrored_{mirrored}")
        both.append(numbers(tmp_path / f"mirrored_{mirrored}.h5"))
    own, mirrored = both
    assert own.keys() == mirrored.keys()
    for name, wanted in in_mirror(own).items():
        found = mirrored[name]
        if not any(each in name for each in OF_LAPACK):
            exact = 1e-15 * np.pi if name.endswith("phase") else 0
            np.testing.assert_allclose(found, wanted, rtol=0, atol=exact, err_msg=name)
        elif "shape" not in name and "station_" not in name:
            close = 1e-9 * np.abs(np.nan_to_num(wanted)).max(initial=0)
            np.testing.assert_allclose(found, wanted, rtol=1e-7, atol=close, err_msg=name)


def test_modes_and_attitude_angle_follow_the_sense_and_the_pads_their_edges(run, tmp_path):
    """Of the same bearing that is not mirrored, the other sense is another bearing."""
    case, pads, _ = CASES["coefficients"]
    own = text(case, pads, tmp_path, False)
    run(own, COEFFICIENTS, name="own")
    run(own, COEFFICIENTS, "operation%rotation='anticlockwise'", name="other")
    run(text(case, pads, tmp_path, True), COEFFICIENTS, name="mirrored")
    names, angles = {}, {}
    for each in ("own", "mirrored", "other"):
        with h5py.File(tmp_path / f"{each}.h5") as file:
            names[each], angles[each] = (
                list(file["modes/name"].asstr()[0]),
                file["equilibrium/attitude_angle"][()],
            )
    assert names["own"] == names["mirrored"]
    assert any("forward" in each for each in names["own"])
    assert angles["own"] == angles["mirrored"]
    assert abs(angles["other"] - angles["own"]) > 0.1


def test_a_march_does_not_start_from_a_result_of_the_other_sense(run, tmp_path):
    case, pads, overrides = CASES["march"]
    mirrored = text(case, pads, tmp_path, True)
    run(mirrored, *overrides, name="whole")
    turned = ("operation%rotation='clockwise'", "start%from='file'", "start%file='whole.h5'")
    said = run(mirrored, *overrides, *turned, name="turned", status=3).stderr
    assert "its shaft turns anticlockwise, and that of this case clockwise" in said
