"""Random bearings as they are built; the same seed and number give the same one."""

import math

from stress_cases import STEEL, Case, Dice


def draw(seed: int, number: int) -> Case:
    """Three to six pads, D 30 to 500 mm, L/D 0.4 to 1, clearance 0.8 to 2.5 per mille, preload 0 to 0.6, load
    on or between pivots, 0.1 to 4 MPa, shafts of 10 to 90 m/s; half of them with temperatures of the oil."""
    dice = Dice(f"ordinary {seed}/{number}")
    radius = dice.log(0.015, 0.25)
    length = 2 * radius * dice.uniform(0.4, 1.0)
    load = dice.log(0.1e6, 4e6) * 2 * radius * length
    case: Case = {"case": {"title": f"ordinary bearing {number} of seed {seed}", "task": "equilibrium"}}
    case["bearing"] = {
        "journal_radius": radius,
        "axial_length": length,
        "assembled_clearance": radius * dice.uniform(0.8e-3, 2.5e-3),
        "preload": dice.choice((0.0, dice.uniform(0.0, 0.6), dice.uniform(0.0, 0.6))),
    }
    case["rotor"] = {"mass": load / 9.81}
    case["operation"] = {"speed_rpm": dice.log(10, 90) / radius * 30 / math.pi, "duration": 1.0}
    case["pads"] = pads(dice, radius)
    case["pivot"] = {
        "socket_radius": radius * dice.uniform(0.2, 0.4),
        "radius_difference": dice.log(1e-6, 1e-4),
    }
    case["film"] = {"cavitation": dice.choice(("reynolds", "reynolds", "gumbel"))}
    if dice.chance(0.5):
        case["oil"] = {
            "grade": dice.choice((22, 32, 46, 68)),
            "supply_temperature": dice.uniform(30.0, 55.0),
        }
        case["thermal"] = {"model": "pad"}
    else:
        case["bearing"]["viscosity"] = dice.log(6e-3, 5e-2)
    return case


def pads(dice: Dice, radius: float) -> dict:
    """Equal pads of steel on yielding or rigid pivots, in the middle or behind it."""
    count = dice.choice((3, 4, 4, 5, 5, 6))
    pitch = 360 / count
    first = -90 + dice.choice((0.0, 0.5)) * pitch
    thickness = radius * dice.uniform(0.2, 0.5)
    return {
        "motion": dice.choice(("tilting_radial", "tilting_only")),
        "pivot_angle_deg": [first + i * pitch for i in range(count)],
        "arc_deg": [pitch * dice.uniform(0.65, 0.9)] * count,
        "pivot_ratio": [dice.choice((0.5, dice.uniform(0.5, 0.6)))] * count,
        "density": STEEL,
        "thickness": thickness,
        "pivot_distance": thickness,
    }
