"""Stiffness and damping identified from forced vibrations against those of the linearised bearing."""

import numpy as np
import pytest
import tiltpad

BASE = {
    "rotor": {"mass": 2000.0, "unbalance": 0.0},
    "operation": {"speed_rpm": 6000.0, "duration": 0.05},
    "output": {"samples_per_revolution": 60},
    "film": {"table_tolerance": 1e-6},
}
#: Bearings whose pads all carry: four pads that only tilt, four on flexible pivots, five.
BEARINGS = {
    "tilting": {
        "pads": {"pivot_angle_deg": (-45.0, 225.0, 45.0, 135.0), "motion": "tilting_only"},
        "bearing": {"preload": 0.5},
    },
    "flexible": {"pads": {"pivot_angle_deg": (-45.0, 225.0, 45.0, 135.0)}, "bearing": {"preload": 0.5}},
    "five": {
        "pads": {"pivot_angle_deg": (-54.0, 18.0, 90.0, 162.0, 234.0), "arc_deg": 60.0},
        "bearing": {"preload": 0.5},
    },
}
RATIOS = (0.25, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0)


def identified(bearing, ratio, amplitude, **groups):
    """Coefficients from two periodic orbits under forces along y and along z."""
    excitation = {"amplitude": amplitude, "frequency_ratio": ratio}
    runs = [
        tiltpad.run(
            BASE
            | {"case": {"task": "periodic"}, "periodic": {"tolerance": 1e-11}}
            | {"excitation": excitation | {"direction_deg": direction}}
            | bearing
            | groups
        )
        for direction in (0.0, 90.0)
    ]
    return tiltpad.impedance(runs)


def deviation(found, expected):
    """The largest difference of an element over the largest element."""
    return np.abs(found - expected).max() / np.abs(expected).max()


@pytest.mark.parametrize("name", BEARINGS)
def test_without_friction_a_small_force_identifies_the_coefficients(name):
    """1 N moves the journal by some 1e-4 of the clearance, so that what is not linear is 1e-8 of it; the
    orbit is closed to 1e-11 of the clearance, 1e-7 of the motion. The slopes of films from tables of a
    tolerance of 1e-6 are those of the films to some 1e-5."""
    reference = tiltpad.coefficients(
        tiltpad.run(BASE | BEARINGS[name] | {"case": {"task": "coefficients"}}), frequency_ratio=RATIOS
    )
    for k, ratio in enumerate(RATIOS):
        found = identified(BEARINGS[name], ratio, 1.0)
        assert found.pivot == "identified"
        assert found.frequency_ratio == pytest.approx([ratio])
        assert deviation(found.stiffness[0], reference.stiffness[k]) < 1e-4, ratio
        assert deviation(found.damping[0], reference.damping[k]) < 1e-4, ratio


@pytest.mark.parametrize("law", ["lugre", "bengisu_akay"])
def test_pivots_stick_at_a_small_amplitude_and_free_themselves_at_a_large_one(law):
    """1 N identifies pads that stick, or creep with Bengisu-Akay. Half the load identifies pads without
    friction under the same force, as the film is not linear there. What friction changes then is in
    proportion to its coefficient: with 0.001 less than 1 %, with 0.01 ten times as much."""
    bearing, quick = BEARINGS["flexible"], {"film": {}}

    def friction(coefficient):
        return {
            "friction": {"model": law, "static_coefficient": coefficient, "dynamic_coefficient": coefficient}
        }

    reference = tiltpad.run(BASE | bearing | friction(0.1) | {"case": {"task": "coefficients"}})
    stuck, free = (tiltpad.coefficients(reference, pivot, frequency_ratio=0.5) for pivot in ("stuck", "free"))
    small = identified(bearing, 0.5, 1.0, **friction(0.1))
    frictionless = identified(bearing, 0.5, 9810.0, **quick)
    slight, larger = (identified(bearing, 0.5, 9810.0, **quick, **friction(each)) for each in (0.001, 0.01))
    for name in ("stiffness", "damping"):
        limit = getattr(frictionless, name)
        assert deviation(getattr(stuck, name), getattr(free, name)) > 0.3
        assert deviation(getattr(small, name), getattr(stuck, name)) < 0.01
        assert deviation(getattr(slight, name), limit) < 0.01
        assert deviation(getattr(larger, name), limit) > 5 * deviation(getattr(slight, name), limit)


def test_several_excitations_of_one_frequency_are_one_force():
    """Halves of a force are read back as a list, and are the force; two frequencies are refused."""
    half = {"amplitude": 0.5, "frequency_ratio": 0.5}
    case = BASE | {"case": {"task": "periodic"}} | BEARINGS["tilting"]
    directions = (0.0, 90.0)
    runs = [tiltpad.run(case | {"excitation": [half | {"direction_deg": each}] * 2}) for each in directions]
    assert [each["amplitude"] for each in runs[0].input["excitation"]] == [0.5, 0.5]
    whole = identified(BEARINGS["tilting"], 0.5, 1.0)
    # orbits are closed to 1e-8 of the clearance, 1e-4 of the motion
    assert deviation(tiltpad.impedance(runs).stiffness, whole.stiffness) < 1e-3
    other = tiltpad.run(case | {"excitation": [half, half | {"frequency_ratio": 1.0}]})
    with pytest.raises(tiltpad.NotInRunError, match="different frequencies"):
        tiltpad.impedance([other, other])


def test_a_slow_load_leaves_the_journal_beside_it(root, tmp_path):
    """The cycle of docs/rig.md. Without friction the journal stays below the load. While the pads slide the
    attitude angle is in proportion to the friction coefficient, with the sign of where the load came from;
    with 0.5 it is of the size that Kim and Kim (2008) have, up to 25 degrees. Half as fast it is the same."""

    def angles(coefficient, **slower):
        model = "lugre" if coefficient else "none"
        own = {"model": model, "static_coefficient": coefficient or 0.1, "dynamic_coefficient": coefficient}
        with tiltpad.run(root / "input/examples/load_cycle.nml", friction=own, **slower) as run:
            angle = np.degrees(np.arctan2(run.journal_z, -run.journal_y))
            return np.interp(run.time[-1] * np.array([0.5, 0.75, 1.0]), run.time, angle)

    assert np.abs(angles(0)).max() < 0.2
    slight, twice = angles(0.02), angles(0.04)
    np.testing.assert_allclose(twice - angles(0), 2 * (slight - angles(0)), rtol=0.03)
    assert slight[0] > 0.5
    assert slight[2] < -0.5
    held = angles(0.5)
    assert 15 < held[1] < 30
    times = {f"excitation({k + 1})": {"start": float(k), "end": k + 1.0} for k in range(4)}
    np.testing.assert_allclose(angles(0.5, operation={"duration": 4.0}, **times), held, atol=0.5)
