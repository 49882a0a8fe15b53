"""Realistic bearings: what a designer would draw and accept; the same seed and number give the same one.

Ranges:
- journals of 30 to 500 mm, L/D 0.4 to 1, equal pads of steel, 70 to 88 % of the pitch and at most 100
  degrees: catalogues of tilting pad bearings;
- radial clearance over radius 1.0 to 2.5 per mille, preload 0 (a third) or up to 0.6: the same;
- surface speeds of 5 to 90 m/s: slow hydraulic machines to turbochargers and compressors; of fast bearings,
  100 mm and larger, 50 to 150 m/s: large turbines and compressors, with turbulent films;
- oils of ISO VG 32 to 100 at 45 to 75 C in the film, or with a heat balance;
- unbalance after ISO 21940-11: G 2.5 (turbines, compressors), 6.3 (general machines) or 1 (spindles), and a
  closer grade where the unbalance would be more than half the load (the rotor would be balanced better);
- loads of 0.1 to 4 MPa by the rotor's weight, or mostly by gears;
- ball and socket of 0.2 to 0.4 of the radius, of a fit of 1 to 30 per mille; ground to 0.2 to 0.8 um;
- friction of oiled steel, 0.08 to 0.2.

A designer accepts a bearing that
- has the least film of ISO 7902-3, by its size and speed, under the pads that carry the load, where this film
  is that of the plane slider of the same load, length and width with the ratio of 2.2 of its film's ends;
- is laminar: below Taylor's number of ISO 7902-1, by the clearance of the pads; a fast one has a Reynolds
  number of 500 to 10,000 there;
- loads its pivots with at most 1 GPa by Hertz (hardened steel is allowed more).
A drawing that is not accepted is drawn again.
"""

import math
from bisect import bisect_right

from stress_cases import STEEL, Case, Dice

#: Least film, um, of ISO 7902-3: over diameters, m, and surface speeds, m/s, up to these.
DIAMETERS, VELOCITIES = (0.063, 0.160, 0.400), (1, 3, 10, 30)
LEAST_FILM = ((3, 4, 5, 7, 10), (4, 5, 7, 9, 12), (6, 7, 9, 11, 14), (8, 9, 11, 13, 16))
#: Load of the plane slider of infinite width, W h^2/(mu U B^2 L), at its best ratio of the film's ends;
#: what it loses at the sides is 1 + SIDES (B/L)^2, which fits the tables of Cameron, The Principles of
#: Lubrication.
SLIDER, SIDES = 0.16, 1.3
#: Taylor's number of ISO 7902-1: Re < 41.3 sqrt(R/c).
TAYLOR = 41.3
#: Fast bearings: the numbers above this, their surface speeds, m/s, least radius, m, and Reynolds numbers at
#: the clearance of the pads.
FAST_ABOVE, FAST, FAST_RADIUS, TURBULENT = 10_000, (50, 150), 0.05, (500, 10_000)
OIL_DENSITY = 860.0
#: Viscosity, Pa s, at 40 and 100 C of ISO VG grades of viscosity index 100, rounded.
GRADES = {32: (0.0275, 0.0046), 46: (0.0396, 0.0058), 68: (0.0585, 0.0075), 100: (0.086, 0.0098)}
#: Hertz's pressure at a pivot, Pa, and the modulus of steel on steel in his formula.
PIVOT_PRESSURE, CONTACT_MODULUS = 1e9, 2.1e11 / (2 * (1 - 0.3**2))
BALANCE_GRADES = (0.4, 1.0, 2.5, 6.3)
GRAVITY = 9.81


def draw(seed: int, number: int) -> Case:
    """Bearing `number` of a seed."""
    dice = Dice(f"realistic {seed}/{number}")
    while not accepted(case := drawing(dice, number > FAST_ABOVE)):
        pass
    if "thermal" in case:
        del case["bearing"]["viscosity"]
    case["case"] = {"title": f"realistic bearing {number} of seed {seed}"}
    return case


def drawing(dice: Dice, fast: bool) -> Case:
    """One drawing, accepted or not."""
    radius = dice.log(FAST_RADIUS if fast else 0.015, 0.25)
    length = 2 * radius * dice.uniform(0.4, 1.0)
    velocity = dice.log(*(FAST if fast else (5, 90)))
    case: Case = {"case": {}}
    case["operation"] = {"speed_rpm": velocity / radius * 30 / math.pi, "duration": 2.0}
    case["rotor"] = rotor(dice, dice.log(0.1e6, 4e6) * 2 * radius * length, velocity / radius)
    case["bearing"] = {
        "journal_radius": radius,
        "axial_length": length,
        "assembled_clearance": radius * dice.uniform(1.0e-3, 2.5e-3),
        "preload": dice.choice((0.0, dice.uniform(0.0, 0.6), dice.uniform(0.0, 0.6))),
    }
    case |= oil(dice, case["bearing"])
    case["pads"] = pads(dice, radius)
    socket = radius * dice.uniform(0.2, 0.4)
    case["pivot"] = {
        "law": dice.choice(("fang", "fang", "hertz")),
        "socket_radius": socket,
        "radius_difference": socket * dice.log(1e-3, 3e-2),
    }
    case["friction"] = friction(dice)
    case["asperity"] = {"roughness": dice.log(0.2e-6, 0.8e-6)}
    # what users choose: nearly all the condition of the default
    case["film"] = {"cavitation": dice.choice(("reynolds",) * 16 + ("gumbel",) * 3 + ("none",))}
    if fast:
        case["film"] |= {"turbulence": "ng_pan", "turbulent_above": dice.choice((1000.0, 1500.0))}
    return case


def rotor(dice: Dice, load: float, speed: float) -> dict:
    """The load, by the weight or in a fifth of the bearings mostly by gears; and the grade of balance."""
    values = {"mass": load / GRAVITY}
    if dice.chance(0.2):
        values["mass"] *= dice.uniform(0.1, 0.5)
        values["static_load"] = [values["mass"] * GRAVITY - load, 0.0]
    allowed = 0.5 * load / values["mass"] / speed * 1e3
    grade = dice.choice((1.0, 2.5, 2.5, 2.5, 6.3))
    closer = [each for each in BALANCE_GRADES if each <= min(grade, allowed)]
    values["balance_grade"] = closer[-1] if closer else allowed
    return values


def oil(dice: Dice, bearing: dict) -> dict:
    """A viscosity in the film, or in a fifth of the bearings an oil and its heat balance."""
    grade, temperature = dice.choice(tuple(GRADES)), dice.uniform(45, 75)
    cold, hot = GRADES[grade]
    bearing["viscosity"] = cold * (hot / cold) ** ((temperature - 40) / 60)
    if not dice.chance(0.2):
        return {}
    return {
        "oil": {"grade": grade, "supply_temperature": dice.uniform(40, 50)},
        "thermal": {"model": "pad", "march": "frozen"},
    }


def pads(dice: Dice, radius: float) -> dict:
    """Three to six equal pads on pivots in their middle or behind it; load on or between pivots."""
    count = dice.choice((3, 4, 4, 5, 5, 6))
    pitch = 360 / count
    first = -90 + dice.choice((0.0, 0.5)) * pitch
    thickness = radius * dice.uniform(0.2, 0.5)
    return {
        "motion": dice.choice(("tilting_radial", "tilting_radial", "tilting_only")),
        "pivot_angle_deg": [first + i * pitch for i in range(count)],
        "arc_deg": [min(100.0, pitch * dice.uniform(0.7, 0.88))] * count,
        "pivot_ratio": [dice.choice((0.5, 0.5, dice.uniform(0.5, 0.6)))] * count,
        "density": STEEL,
        "thickness": thickness,
        "pivot_distance": thickness,
    }


def friction(dice: Dice) -> dict:
    """None in half of the bearings, Bengisu-Akay or LuGre in the others."""
    model = dice.choice(("none", "none", "bengisu_akay", "lugre"))
    if model == "none":
        return {"model": model}
    static = dice.uniform(0.08, 0.2)
    values = {"model": model, "static_coefficient": static}
    values["dynamic_coefficient"] = static * dice.uniform(0.5, 0.8)
    if model == "bengisu_akay":
        return values | {"critical_velocity": dice.log(1e-5, 1e-4)}
    return values | {"bristle_stiffness": dice.log(1e5, 1e6), "stribeck_velocity": dice.log(5e-4, 5e-3)}


def accepted(case: Case) -> bool:
    """Whether a designer would accept a drawing."""
    return (
        flows_well(case) and slider_film(case) >= least_film(case) and pivot_pressure(case) <= PIVOT_PRESSURE
    )


def flows_well(case: Case) -> bool:
    """Whether a film of the clearance of the pads is laminar, or turbulent in a fast bearing."""
    bearing, radius = case["bearing"], case["bearing"]["journal_radius"]
    clearance = bearing["assembled_clearance"] / (1 - bearing["preload"])
    reynolds = OIL_DENSITY * surface_speed(case) * clearance / bearing["viscosity"]
    if "turbulence" in case["film"]:
        return TURBULENT[0] <= reynolds <= TURBULENT[1]
    return reynolds < TAYLOR * math.sqrt(radius / clearance)


def least_film(case: Case) -> float:
    """Least film that a designer allows, m."""
    row = LEAST_FILM[bisect_right(DIAMETERS, 2 * case["bearing"]["journal_radius"])]
    return 1e-6 * row[bisect_right(VELOCITIES, surface_speed(case))]


def slider_film(case: Case) -> float:
    """Film of the plane slider that carries as much as the pads below the load, m."""
    bearing, pads = case["bearing"], case["pads"]
    width, length = bearing["axial_length"], math.radians(pads["arc_deg"][0]) * bearing["journal_radius"]
    carried = SLIDER / (1 + SIDES * (length / width) ** 2) * bearing["viscosity"] * surface_speed(case)
    return length * math.sqrt(carried * width / pad_load(case))


def pivot_pressure(case: Case) -> float:
    """Hertz's pressure of ball in socket, Pa."""
    socket, difference = case["pivot"]["socket_radius"], case["pivot"]["radius_difference"]
    radius = socket * (socket - difference) / difference
    return (6 * pad_load(case) * CONTACT_MODULUS**2 / (math.pi**3 * radius**2)) ** (1 / 3)


def pad_load(case: Case) -> float:
    """Load of a pad below the load, which bears all of it, or of the two to its sides, N."""
    rotor, angles = case["rotor"], case["pads"]["pivot_angle_deg"]
    load = rotor["mass"] * GRAVITY - rotor.get("static_load", [0.0])[0]
    if angles[0] == -90:
        return load
    return load / (2 * math.cos(math.radians(180 / len(angles))))


def surface_speed(case: Case) -> float:
    """Speed of the journal's surface, m/s."""
    return case["operation"]["speed_rpm"] * math.pi / 30 * case["bearing"]["journal_radius"]
