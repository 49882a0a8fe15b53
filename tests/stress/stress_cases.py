"""Random cases over wide ranges of every input variable; the same seed and number give the same case."""

import math
import random

#: Load of the paper over the projected area of a pad pair, Pa.
PAPER_LOAD = 2000 * 9.81 / (0.1 * 2 * 0.0499)
STEEL = 7850.0

Case = dict[str, dict]


class Dice(random.Random):
    """Draws that a wide range needs."""

    def log(self, low: float, high: float) -> float:
        """Log-uniform."""
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def chance(self, share: float) -> bool:
        return self.random() < share


def draw(seed: int, number: int, fixed: bool = False) -> Case:
    """Case `number` of a seed; on request the same with fixed pads, drawn with dice of their own."""
    case = tilting(seed, number)
    return fix(case, Dice(f"fixed {seed}/{number}")) if fixed else case


def tilting(seed: int, number: int) -> Case:
    """A case with pads that tilt."""
    dice = Dice(f"{seed}/{number}")
    case: Case = {"case": {"title": f"stress case {number} of seed {seed}"}}
    case["bearing"] = bearing(dice)
    case["rotor"], direction = rotor(dice, case["bearing"])
    case["operation"] = operation(dice)
    case["pads"] = pads(dice, case["bearing"], direction)
    case["pivot"] = pivot(dice, case["bearing"])
    case["friction"] = friction(dice)
    case["film"] = film(dice)
    case["integration"] = {"relative_tolerance": dice.choice((1e-5, 1e-6, 1e-6, 1e-6, 1e-7))}
    case["integration"]["max_steps"] = step_budget(case)
    case["output"] = {"samples_per_revolution": 90}
    return case


def bearing(dice: Dice) -> dict:
    """Radius 20 to 250 mm, L/D 0.1 to 2, clearance 0.4 to 4 per mille, preload -0.3 to 0.7."""
    radius = dice.log(0.02, 0.25)
    machined = radius * dice.log(4e-4, 4e-3)
    preload = dice.uniform(0.05, 0.7)
    if dice.chance(0.2):
        preload = dice.choice((0.0, 0.0, dice.uniform(-0.3, 0.0)))
    values = {
        "journal_radius": radius,
        "machined_clearance": machined,
        "assembled_clearance": machined * (1 - preload),
        "axial_length": 2 * radius * dice.log(0.1, 2.0),
        "viscosity": dice.log(2e-3, 0.3),
    }
    if dice.chance(0.4):
        values["supply_pressure"] = dice.log(1e3, 1e6)
    if dice.chance(0.1):
        values["ambient_pressure"] = values["supply_pressure"] = dice.log(1e3, 1e5)
    if dice.chance(0.3):
        values["cavitation_pressure"] = -dice.log(1e3, 1e5)
    return values


def rotor(dice: Dice, bearing: dict) -> tuple[dict, float]:
    """Load 0 to 5 times the paper's in any direction, unbalance up to contact; and where the load points."""
    area = 2 * bearing["journal_radius"] * bearing["axial_length"]
    load = PAPER_LOAD * area * dice.log(0.01, 5.0)
    values = {"mass": load / 9.81}
    direction = -0.5 * math.pi
    if dice.chance(0.05):
        values["gravity"] = 0.0
    elif dice.chance(0.4):
        values["mass"] *= dice.log(0.02, 1.0)
        direction = dice.uniform(-math.pi, math.pi)
        extra = load * math.sin(direction) + 9.81 * values["mass"], load * math.cos(direction)
        values["static_load"] = list(extra)
    if dice.chance(0.1):
        values["balance_grade"] = dice.log(0.4, 40.0)
    else:
        eccentricity = bearing["assembled_clearance"] * dice.log(1e-3, 1.0)
        values["unbalance"] = 0.0 if dice.chance(0.15) else values["mass"] * eccentricity
    return values, direction


def operation(dice: Dice) -> dict:
    """100 to 15000 rpm, constant, up or down, over 2 to 30 revolutions."""
    values = {"speed_rpm": dice.log(100, 15000)}
    mean = values["speed_rpm"]
    if dice.chance(0.3):
        values["final_speed_rpm"] = dice.log(100, 15000)
        mean = 0.5 * (mean + values["final_speed_rpm"])
    values["duration"] = dice.log(2, 30) * 60 / mean
    return values


def pads(dice: Dice, bearing: dict, direction: float) -> dict:
    """1 to 24 pads side by side, most often with the load on or between pivots."""
    count = dice.choice(
        (dice.randint(1, 2), 2, 2, 3, 4, 4, 5, 5, 6, dice.randint(7, 12), dice.randint(13, 24))
    )
    pitch = 360 / count if count > 2 else dice.uniform(60, 140)
    first = math.degrees(direction) - 0.5 * pitch * (count - 1) + 0.5 * pitch * dice.choice((0, 0, count % 2))
    if dice.chance(0.15):
        first += dice.uniform(-180, 180)
    angles = [(first + i * pitch + 360) % 360 for i in range(count)]
    ratio = each(dice, count, lambda: pivot_ratio(dice))
    room = 0.95 * min(pitch, 160 if count == 1 else pitch)
    arc = each(dice, count, lambda: room * dice.uniform(0.3, 1.0))
    while overlap(angles, arc, ratio):
        arc = [0.9 * value for value in arc]
    thickness = bearing["journal_radius"] * dice.uniform(0.15, 0.6)
    weights = [
        dice.uniform(0.5, 2.0) * STEEL * thickness * math.radians(value) * bearing["journal_radius"]
        * bearing["axial_length"] for value in each(dice, 1, lambda: sum(arc) / count) * count
    ]  # fmt: skip
    length = [math.radians(value) * bearing["journal_radius"] for value in arc]
    if dice.chance(0.6):
        tangential = [0.0] * count
    else:
        tangential = each(dice, count, lambda: dice.uniform(-0.15, 0.15) * min(length))
    radial = each(dice, count, lambda: -dice.uniform(0.0, 1.0) * thickness)
    inertia = [
        m * (t**2 + r**2 + (s**2 + thickness**2) / 12)
        for m, t, r, s in zip(weights, tangential, radial, length, strict=True)
    ]
    return {
        "motion": dice.choice(("tilting_radial", "tilting_radial", "tilting_only")),
        "pivot_angle_deg": angles,
        "arc_deg": arc,
        "pivot_ratio": ratio,
        "pivot_distance": thickness * dice.uniform(0.8, 1.2),
        "mass": weights,
        "inertia": inertia,
        "centre_tangential": tangential,
        "centre_radial": radial,
    }


def fix(case: Case, dice: Dice) -> Case:
    """Makes pads fixed: of a plain, partial, grooved or lobed bearing, some anchored off their middle."""
    bearing, rotor = case["bearing"], case["rotor"]
    extra = rotor.get("static_load", [0.0, 0.0])
    load = math.atan2(extra[0] - rotor["mass"] * rotor.get("gravity", 9.81), extra[1])
    count = dice.choice((1, 1, 2, 2, 2, 3, 4))
    groove = dice.choice((0.0, dice.uniform(1, 40))) if count == 1 else dice.uniform(2, 40)
    if count == 1 and dice.chance(0.4):
        groove = dice.uniform(160, 290)
    arc, ratio = 360 / count - groove, 0.5
    # the load somewhere on the middle half of a pad, or of a partial one
    middle = math.degrees(load) + dice.uniform(-0.25, 0.25) * min(arc, 120)
    if dice.chance(0.6):
        bearing["assembled_clearance"] = bearing["machined_clearance"]
    elif dice.chance(0.5):
        ratio = dice.uniform(0.01, 0.99)
    angles = [(middle + (ratio - 0.5) * -arc + 360 * i / count + 720) % 360 for i in range(count)]
    case["pads"] = {"motion": "fixed", "pivot_angle_deg": angles, "arc_deg": [0.9999 * arc] * count}
    case["pads"]["pivot_ratio"] = [ratio] * count
    case["friction"] = {"model": "none"}
    del case["pivot"]
    case["integration"]["max_steps"] = step_budget(case)
    return case


def pivot_ratio(dice: Dice) -> float:
    """Centred, behind the centre as usual, or anywhere."""
    return dice.choice((0.5, 0.5, dice.uniform(0.5, 0.65), dice.uniform(0.5, 0.65), dice.uniform(0.3, 0.7)))


def each(dice: Dice, count: int, draw_one) -> list[float]:
    """One value for all pads, or (now and then) one each."""
    if dice.chance(0.7):
        return [draw_one()] * count
    return [draw_one() for _ in range(count)]


def overlap(angles: list[float], arc: list[float], ratio: list[float]) -> bool:
    """Whether a pad reaches over the start of another, with a margin for what rounding takes."""
    count = len(angles)
    return any(
        (angles[j] - angles[i]) % 360 < 1.001 * (ratio[i] * arc[i] + (1 - ratio[j]) * arc[j])
        for i in range(count)
        for j in range(count)
        if i != j
    )


def pivot(dice: Dice, bearing: dict) -> dict:
    """Both contact laws, radius difference 0 to 100 um, steel or softer."""
    values = {"law": dice.choice(("fang", "fang", "hertz"))}
    values["socket_radius"] = bearing["journal_radius"] * dice.uniform(0.15, 0.5)
    values["radius_difference"] = dice.log(1e-7, 1e-4)
    if values["law"] == "fang" and dice.chance(0.15):
        values["radius_difference"] = 0.0
    if dice.chance(0.2):
        values["young_modulus"] = [dice.log(2e9, 4e11), dice.log(2e9, 4e11)]
    if dice.chance(0.2):
        values["deflection_factor"] = 2 * math.pi
    return values


def friction(dice: Dice) -> dict:
    """No friction, Bengisu-Akay down to v_c = 1e-8 m/s, LuGre up to sigma_0 = 1e9 1/m."""
    model = dice.choice(("none", "bengisu_akay", "bengisu_akay", "lugre", "lugre"))
    if model == "none":
        return {"model": model}
    static = dice.log(0.01, 0.5)
    values = {"model": model, "static_coefficient": static}
    values["dynamic_coefficient"] = static * dice.uniform(0.2, 1.0)
    if model == "bengisu_akay":
        values |= {"critical_velocity": dice.log(1e-8, 1e-2), "decay": dice.log(1, 1e5)}
        return values
    values["bristle_stiffness"] = dice.log(1e4, 1e9)
    values["stribeck_velocity"] = dice.log(1e-5, 1e-1)
    if dice.chance(0.3):
        values["stribeck_exponent"] = dice.uniform(0.5, 2.0)
    if dice.chance(0.3):
        values["bristle_damping"] = dice.choice((0.0, dice.log(0.1, 100.0)))
    if dice.chance(0.3):
        values["viscous_coefficient"] = dice.log(1e-3, 1.0)
    return values


def film(dice: Dice) -> dict:
    """Every kind of cavitation and solver, the grid left alone or drawn."""
    values = {"cavitation": dice.choice(("reynolds", "reynolds", "gumbel", "gumbel", "none"))}
    if dice.chance(0.15):
        values["solver"] = "sor"
    elif dice.chance(0.15) and values["cavitation"] != "reynolds":
        values["solver"] = "fourier"
    if dice.chance(0.15):
        values["circumferential_cells"] = dice.choice((16, 24, 40, 60))
    if dice.chance(0.15):
        values["axial_modes"] = dice.randint(2, 16)
    if dice.chance(0.15):
        values["axial_cells"] = dice.randint(4, 20)
    return values


def studies(case: Case) -> bool:
    """Whether films are solved by over-relaxation, which costs a hundred times more."""
    return case["film"].get("solver") == "sor"


def step_budget(case: Case) -> int:
    """Steps that take some ten seconds."""
    count = len(case["pads"]["pivot_angle_deg"])
    a_pad = 3e-4 if studies(case) else 5e-6
    return int(min(400000, 15 / (3e-5 + count * a_pad + count**2 * 1e-6)))


def text(case: Case) -> str:
    """The case as a namelist."""
    groups = []
    for group, values in case.items():
        lines = [f"  {name} = {literal(value)}\n" for name, value in values.items()]
        groups.append(f"&{group}\n{''.join(lines)}/\n")
    return "".join(groups)


def literal(value) -> str:
    """A value as a namelist writes it."""
    if isinstance(value, str):
        return f"'{value}'"
    if isinstance(value, list):
        return ", ".join(map(literal, value))
    return f"{value:.7g}" if isinstance(value, float) else str(value)
