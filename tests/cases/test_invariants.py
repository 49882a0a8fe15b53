"""What no result may depend on: the units of length, time and mass, and the direction that is called up.

A whole run is done again in other units, or with bearing and load turned; its results are the same numbers in
these units, or the same vectors turned. A constant with a unit that hides in the code, or a direction that is
treated in a way of its own, would show.
"""

import re

import numpy as np
import pytest
from conftest import arrays

#: Four pads under preload, with friction in their pivots, on warm oil. No gravity: pads would feel it, too.
CASE = {
    "rotor": {"mass": 2000, "unbalance": 0.01, "gravity": 0, "static_load": (-20000, 3000)},
    "operation": {"speed_rpm": 6500, "final_speed_rpm": 6500, "duration": 0.02},
    "bearing": {
        "journal_radius": 0.05, "assembled_clearance": 80e-6, "machined_clearance": 130e-6,
        "axial_length": 0.1, "supply_pressure": 1e5,
    },
    "oil": {
        "reference_viscosity": 0.03, "temperature_exponent": 0.03, "density": 860, "specific_heat": 1950,
        "conductivity": 0.13,
    },
    "thermal": {"model": "pad"},
    "pads": {
        "pivot_angle_deg": (-45, 45, 135, 225), "arc_deg": 70, "pivot_distance": 0.014, "mass": 0.8,
        "inertia": 4e-4, "centre_radial": -0.01,
    },
    "pivot": {"socket_radius": 0.013, "radius_difference": 15e-6, "young_modulus": (2.1e11, 2.1e11)},
    "friction": {
        "model": "lugre", "stribeck_velocity": 1e-3, "bristle_stiffness": 1e6, "bristle_damping": 10,
        "critical_velocity": 1e-5, "decay": 1000,
    },
    "asperity": {"roughness": 5e-7, "elastic_modulus": 4.7e10},
    "output": {"samples_per_revolution": 72},
}  # fmt: skip
#: What a march starts with that is to move its pads.
PUSHED = {"from": "centred", "journal": (-20e-6, 10e-6), "journal_velocity": (-0.1, 0.05)}
#: Exponents of the units of mass, length and time, and what has this unit.
UNITS = """
1 0 0: mass
1 1 0: unbalance
0 1 -2: gravity
1 1 -2: static_load pivot_load film_force_radial asperity_force load
0 0 -1: speed_rpm final_speed_rpm eigenvalue_real eigenvalue_imag
0 0 1: duration time period
0 1 0: journal_radius assembled_clearance machined_clearance axial_length pivot_distance centre_radial
0 1 0: socket_radius radius_difference roughness journal
0 1 0: journal_y journal_z pivot_deflection bristle_deflection min_film_thickness
1 -1 -1: reference_viscosity viscosity
1 -1 -2: supply_pressure young_modulus elastic_modulus max_pressure
1 -3 0: density
0 2 -2: specific_heat
1 1 -3: conductivity
1 2 0: inertia
0 1 -1: stribeck_velocity critical_velocity journal_velocity journal_vy
0 -1 0: bristle_stiffness
0 -1 1: bristle_damping decay
1 2 -2: friction_moment journal_drag
1 2 -3: total_power_loss boundary_loss
0 3 -1: total_side_flow
1 0 -2: stiffness
1 0 -1: damping
0 0 0: pad_tilt reynolds_number mean_temperature maximum_temperature multiplier_real
"""
EXPONENTS = {
    name: [int(each) for each in exponents.split()]
    for exponents, names in re.findall("(.*): (.*)", UNITS)
    for name in names.split()
}
#: Powers of two, which round nothing: what remains is what a step or an iteration more or less leaves.
NEW_UNITS = (0.5, 0.5, 0.25)
#: Pads and journal touch.
SLOW = {"speed_rpm": 20, "final_speed_rpm": 20}
#: Values over those of CASE, and how closely it is the same, over the largest value: an equilibrium is solved
#: to 1e-8, but boundary friction needs a speed of some mm/s; an orbit is on a mesh that a step more or less
#: changes; two marches are both within 1e-3 of the truth (docs/benchmarks.md).
RUNS = {
    "equilibrium": ({"case": {"task": "coefficients"}}, 1e-6),
    "contact": ({"case": {"task": "coefficients"}, "operation": SLOW}, 3e-4),
    "orbit": ({"case": {"task": "periodic"}}, 2e-4),
    "run-up": ({"operation": {"final_speed_rpm": 9000}}, 2e-3),
    "march": ({"start": PUSHED, "rotor": {"unbalance": 0}}, 2e-3),
}


def of_run(name):
    """The case of one of the RUNS."""
    changes, _ = RUNS[name]
    case = CASE | {"case": {"task": "march"}, "start": {}}
    return {group: values | changes.get(group, {}) for group, values in case.items()}


def unit(name):
    return np.prod(np.power(NEW_UNITS, np.array(EXPONENTS[name], float)))


def in_new_units(case):
    return {
        group: {
            name: np.multiply(value, unit(name)).tolist() if name in EXPONENTS else value
            for name, value in values.items()
        }
        for group, values in case.items()
    }


def turned(vector, angle):
    """Numbers along y and z, in the first dimension, turned from +z towards +y."""
    y, z = vector
    return np.array([y * np.cos(angle) + z * np.sin(angle), z * np.cos(angle) - y * np.sin(angle)])


def turned_case(case, angle):
    case = {group: dict(values) for group, values in case.items()}
    case["pads"]["pivot_angle_deg"] = [each + np.degrees(angle) for each in case["pads"]["pivot_angle_deg"]]
    for group, name in (("rotor", "static_load"), ("start", "journal"), ("start", "journal_velocity")):
        if name in case[group]:
            case[group][name] = turned(case[group][name], angle).tolist()
    return case


@pytest.fixture(scope="module")
def results(tiltpad, tmp_path_factory):
    """results(case, name): all arrays of a case's result; a name that is there is not run again."""
    folder = tmp_path_factory.mktemp("invariants")
    done = {}

    def make(case, name):
        if name not in done:
            words = [
                f"{group}%{each}=" + (", ".join(map(str, value)) if np.ndim(value) else f"{value}")
                for group, values in case.items()
                for each, value in values.items()
            ]
            (folder / "case.nml").write_text("&case /\n")
            tiltpad("case.nml", "-q", "-o", f"{name}.h5", overrides=words, cwd=folder, status=0)
            done[name] = arrays(folder / f"{name}.h5")
        return done[name]

    return make


def check_same(found, expected, limit, what):
    assert np.shape(found) == np.shape(expected), what
    size = np.nanmax(np.abs(expected))
    assert np.nanmax(np.abs(found - expected)) <= limit * size, (what, size)


@pytest.mark.parametrize("name", RUNS)
def test_units(results, name):
    one, other = results(of_run(name), name), results(in_new_units(of_run(name)), f"{name}-units")
    if name == "contact":
        assert np.max(one["equilibrium/boundary_loss"]) > 0
    shared = [each for each in one if each.rpartition("/")[2] in EXPONENTS]
    assert len(shared) >= 10
    for each in shared:
        check_same(other[each] / unit(each.rpartition("/")[2]), one[each], RUNS[name][1], each)


@pytest.mark.parametrize("name", ["equilibrium", "contact", "orbit", "march"])
def test_directions(results, name):
    angle, limit = -2.4, RUNS[name][1]
    one = results(of_run(name), name)
    other = results(turned_case(of_run(name), angle), f"{name}-turned")
    alike = ["equilibrium/pivot_load", "equilibrium/mean_temperature", "equilibrium/total_power_loss"]
    if name == "march":
        alike = ["pad_tilt", "min_film_thickness", "pivot_load"]
    for each in alike:
        check_same(other[each], one[each], limit, each)
    if name in ("equilibrium", "contact"):
        turn = turned(np.eye(2), angle)
        for each in ("coefficients/stiffness", "coefficients/damping"):
            check_same(other[each], turn @ one[each] @ turn.T, limit, each)
        check_same(other["modes/damping_ratio"], one["modes/damping_ratio"], limit, "damping ratio")
        return
    orbit = turned([one["journal_y"], one["journal_z"]], angle)
    if name == "orbit":
        # the unbalance starts along y as before: the turned pads meet it later
        orbit = later(orbit[:, :-1], angle)
        other = {each: value[:-1] for each, value in other.items() if each in ("journal_y", "journal_z")}
    check_same(np.array([other["journal_y"], other["journal_z"]]), orbit, limit, "orbit")


def later(orbit, angle):
    """A periodic orbit from this angle of the shaft on."""
    waves = np.fft.fft(orbit, axis=1)
    order = np.fft.fftfreq(orbit.shape[1], 1 / orbit.shape[1])
    return np.fft.ifft(waves * np.exp(1j * order * angle), axis=1).real
