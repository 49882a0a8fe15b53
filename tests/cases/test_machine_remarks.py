"""What a run says of a machine beside its figures: damping of high modes, and coefficients without pads."""

import re

import h5py
import numpy as np
import pytest

#: A light rotor of a turbocharger's kind, whose speed is not far below 500 Hz.
FAST = """&case task='coefficients' /
&operation speed_rpm=30000 /
&shaft length=4*0.05, diameter=4*0.05 /
&disc station=3, mass=3, polar_inertia=0.005, diametral_inertia=0.003 /
&disc station=1, mass=0.5, polar_inertia=0.0005, diametral_inertia=0.0003 /
&unbalance station=3, moment=1e-6 /
&bearing journal_radius=0.025, machined_clearance=4e-5, assembled_clearance=3e-5, axial_length=0.02 /
&bearing name='left', station=2 /
&bearing name='right', station=5 /
"""
HEAVY = """&case task='coefficients' /
&operation speed_rpm=4100 /
&shaft length=0.05, 0.05, 10*0.2, 0.05, 0.05, diameter=2*0.0998, 10*0.26, 2*0.0998 /
&disc station=6, mass=1400, polar_inertia=120, diametral_inertia=70 /
&disc station=10, mass=1000, polar_inertia=80, diametral_inertia=50 /
&unbalance station=6, moment=0.01 /
&bearing name='left', station=2 /
&bearing name='right', station=14 /
"""


MARCH = ("case%task=march", "operation%duration=0.005")


def eigenvalues(path, group="modes"):
    """Of all modes with free pivots."""
    with h5py.File(path) as file:
        return file[f"{group}/eigenvalue_real"][0] + 1j * file[f"{group}/eigenvalue_imag"][0]


def test_much_damping_of_high_modes_is_said_with_what_changes_it(run, tmp_path):
    note = re.search(
        r"remark: the damping of modes above 500 Hz changes amplitudes at the highest speed by (.*) %; "
        r"reduction%damp_above = (\d+) changes less",
        run(FAST, *MARCH, "reduction%damp_above=500").stdout,
    )
    with h5py.File(tmp_path / "case.h5") as file:
        before = file["rotor/damping_error"][()]
    assert float(note[1]) == pytest.approx(100 * before, abs=0.05)
    less = run(FAST, *MARCH, f"reduction%damp_above={note[2]}", more=("--overwrite",))
    assert "remark: the damping" not in less.stdout
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["rotor/damping_error"][()] < 0.01 < before


@pytest.mark.parametrize(
    ("more", "limit"),
    [
        ("", 2000),
        ("&operation speed_rpm=6000 /", 500),
        ("&operation speed_rpm=6000, final_speed_rpm=45000 /", 3000),
        ("&excitation station=3, amplitude=1, frequency_hz=900 /", 3600),
    ],
)
def test_no_mode_near_the_highest_frequency_is_damped(run, tmp_path, more, limit):
    case = FAST.replace("&operation speed_rpm=30000 /", more) if "operation" in more else FAST + more
    assert "remark: the damping" not in run(case, *MARCH).stdout
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["rotor/damped_above"][()] == pytest.approx(limit)


def test_an_unbalance_in_g_mm_is_said(run):
    said = run(HEAVY, "case%task=equilibrium", "unbalance(1)%moment=10").stdout
    assert re.search(
        r"remark: mass eccentricity \S+ um \(unbalance over the mass of the rotor\): more than", said
    )
    assert "mass eccentricity" not in run(HEAVY, "case%task=equilibrium", more=("--overwrite",)).stdout


def test_the_damping_of_the_reduction_is_no_part_of_modes_and_response(run, tmp_path):
    """The part says what it would be in a march: of small ones it grows with the damping ratio.

    Of the highest mode, in which the shaft moves alone, it decays by its frequency times the damping ratio.
    """
    values, whirls, decays = [], [], []
    for ratio in (1e-4, 2e-4):
        run(HEAVY, f"reduction%damping_ratio={ratio}", more=("--overwrite",))
        values.append(eigenvalues(tmp_path / "case.h5"))
        with h5py.File(tmp_path / "case.h5") as file:
            whirls.append(file["response/amplitude"][()])
            part = file["modes/part_of_reduction"][0]
            decays.append(part / (1 - part) * abs(values[-1].real))
    np.testing.assert_array_equal(*values)
    np.testing.assert_array_equal(*whirls)
    some = (values[0].imag > 0) & (decays[0] > 0)
    assert some.sum() > 4
    np.testing.assert_allclose(decays[1][some], 2 * decays[0][some], rtol=1e-6)
    k = np.nanargmax(values[0].imag)
    assert decays[0][k] == pytest.approx(1e-4 * values[0][k].imag, rel=0.2)


def test_modes_with_the_damping_of_the_reduction_are_not_listed(run, tmp_path):
    said = run(FAST).stdout.partition("pivots locked:")[0]
    listed = [int(each) for each in re.findall(r"mode (\d+) \(shaft", said)]
    with h5py.File(tmp_path / "case.h5") as file:
        parts = file["modes/part_of_reduction"][0]
        shaft = np.char.startswith(file["modes/name"].asstr()[0].astype(str), "shaft")
    assert len(listed) >= 4
    assert all(parts[each - 1] <= 0.5 for each in listed)
    left_out = int((shaft & (parts > 0.5)).sum())
    assert left_out > 0
    assert f"not listed: {left_out} high modes of the shaft, which a march damps" in said


def test_a_mode_that_grows_is_listed_whatever_the_reduction_adds(run, tmp_path):
    """Lobes with little damping, of which the reduction has a part that is near the growth."""
    settings = ("pads%motion=fixed", "operation%speed_rpm=8000", "reduction%damp_above=10")
    said = run(HEAVY, *settings, "reduction%damping_ratio=0.02").stdout
    assert re.search(r"the shaft is unstable:\n    mode 1 \(shaft, .*\): .* damping ratio -", said)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["modes/part_of_reduction"][0, 0] < 0.5
        assert file["summary/rotor_damping_ratio"][0] == file["modes/damping_ratio"][0, 0] < 0


def test_all_modes_are_compared_with_those_of_synchronous_coefficients(run, tmp_path):
    """Said of those whose decrement differs by more than a tenth, four at most with their figures."""
    said = run(HEAVY).stdout
    line = re.search(r"pivots free: synchronously reduced coefficients would give other .*: (mode .*)", said)[
        1
    ]
    own, reduced = (eigenvalues(tmp_path / "case.h5", group) for group in ("modes", "synchronous"))
    own, reduced = (-2 * np.pi * each.real / each.imag for each in (own, reduced[reduced.imag > 0]))
    listed = re.findall(r"mode (\d+) \(shaft, \w+\) ([-.\d]+|none) and not ([-.\d]+)", line)
    assert len(listed) == 4
    for number, other, decrement in listed:
        assert float(decrement) == pytest.approx(own[int(number) - 1], abs=5.1e-5)
        if other != "none":
            assert abs(reduced - float(other)).min() < 5.1e-5
            assert abs(float(other) - float(decrement)) > 0.1 * abs(float(decrement))
    assert re.search(r", and \d+ more$", line)


#: A rotor whose halves are alike.
SYMMETRIC = """&case task='equilibrium' /
&operation speed_rpm=4100 /
&shaft length=2*0.05, 4*0.25, 2*0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=5, mass=800, polar_inertia=60, diametral_inertia=35 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
"""


def test_equal_bearings_in_one_equilibrium_are_told_once(run, tmp_path):
    """Their figures stand in the file of each; where anything differs, inputs or loads, both are told."""
    said = run(SYMMETRIC).stdout
    assert said.count("pad 1: tilt") == 1
    assert re.search(
        r"\nbearing 'right' at station 8: load y \S+, z \S+ N, all else as of bearing 'left'\n", said
    )
    with h5py.File(tmp_path / "case.h5") as file:
        heights = [file[f"bearings/{name}/equilibrium/journal_y"][()] for name in ("left", "right")]
    assert heights[0] == pytest.approx(heights[1], rel=1e-5)
    for other in ("bearing:right%viscosity=0.0131", "disc(1)%station=4"):
        said = run(SYMMETRIC, other, more=("--overwrite",)).stdout
        assert said.count("pad 1: tilt") == 2
    said = run(SYMMETRIC, more=("--check",)).stdout
    assert "! bearings 'left', 'right'\n" in said
    assert said.count("clearance ratio") == 1
    said = run(SYMMETRIC, "bearing:right%axial_length=0.11", more=("--check",)).stdout
    assert said.count("clearance ratio") == 2
