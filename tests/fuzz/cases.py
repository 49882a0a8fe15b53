"""Random cases that must be accepted: values by "group%name", within their ranges and fitting together."""

import math
from random import Random

from reader import PIVOTS
from reference import MOST_PADS, Variable

# what is drawn together, as the program checks one against the other
TOGETHER = (
    (
        "operation%speed_rpm",
        "operation%final_speed_rpm",
        "operation%duration",
        "integration%stop_when_periodic",
        "output%samples_per_revolution",
        "output%start_time",
    ),
    (
        "bearing%journal_radius",
        "bearing%machined_clearance",
        "bearing%assembled_clearance",
        "bearing%axial_length",
    ),
    (
        "bearing%supply_pressure",
        "bearing%ambient_pressure",
        "bearing%cavitation_pressure",
        "film%solver",
        "film%cavitation",
    ),
    ("pivot%law", "pivot%socket_radius", "pivot%radius_difference"),
    ("friction%model", "friction%static_coefficient", "friction%dynamic_coefficient"),
)
#: What others follow from; drawn where these are not given.
INSTEAD = ("bearing%preload", "pads%density", "pads%thickness")
#: What changes the shape of the bearing; not drawn: it needs much else of the case.
SHAPE = ("bearing%clearance_temperature", "pads%bending", "pads%temperature")
#: Slopes of the journal and pads that follow them; not drawn: they need films that know them.
SLOPES = (
    *("bearing%slope", "coefficients%slopes", "pads%inertia_pitch", "pads%inertia_yaw"),
    "pads%pivot_axial_offset",
)
ALONE = ("film%circumferential_cells", "film%axial_cells")
#: Variables of which one stands in the place of the other; the last one belongs to the grade.
EITHER = (
    *("rotor%unbalance", "friction%characteristic_load", "rotor%balance_grade", "friction%bristle_damping"),
    "rotor%balance_speed_rpm",
)
#: What belongs to other laws of pivots than those that are drawn with their radii, and to pads that tilt.
OF_LAW = ("pivot%stiffness", "pivot%contact_length", "pivot%rotational_stiffness")
#: Turbulent films: one limit of the transition is above the other, and one closure serves no motion.
TURBULENCE = ("film%turbulence", "film%laminar_below", "film%turbulent_above")
#: Where a march starts; the values of the pads are not drawn.
START = (
    *("start%from", "start%file", "start%journal", "start%journal_velocity", "start%pad_tilt"),
    *("start%pad_tilt_rate", "start%pivot_deflection", "start%pivot_deflection_rate", "start%pad_pitch"),
    *("start%pad_pitch_rate", "start%pad_yaw", "start%pad_yaw_rate"),
)
#: Where the journal is held, in the order in which they belong together.
HELD = ("held%eccentricity_ratio", "held%attitude_deg", "held%position")
#: The oil's law, what it needs, and the heat balance.
OIL = (
    *("oil%law", "oil%grade", "oil%kinematic_viscosity", "oil%at_temperature", "oil%density_at_15"),
    *(
        "oil%density_slope",
        "oil%reference_viscosity",
        "oil%reference_temperature",
        "oil%temperature_exponent",
    ),
    *("oil%supply_temperature", "oil%density", "thermal%model", "thermal%march"),
)
#: Groups that belong to the task of their name; what other tasks have that these do not.
DRAWN = ("coefficients", "periodic")
#: A branch needs a parameter that suits its case; none is drawn.
OF_TASK = (*DRAWN, "branch")
OF_MARCH = ("operation%final_speed_rpm", "output%start_time", "integration%stop_when_periodic")
SPECIAL = {
    "case%task",
    "pivot%file",
    *(
        key
        for group in (*TOGETHER, ALONE, EITHER, INSTEAD, SHAPE, SLOPES, OF_LAW, TURBULENCE, START, HELD, OIL)
        for key in group
    ),
}
#: Circumferential times squared axial cells of all pads.
MOST_IN_BLOCKS = 2e8
TITLE = "abc ABC 0123  ''\"\"/!&=,*()%;:\t\\#$\u00e4\u20ac\U0001d70b"


def draw(dice: Random, variables: dict[str, Variable]) -> dict[str, tuple]:
    """Values of some variables, all fitting together; the others keep their defaults."""
    found: dict[str, tuple] = {}
    few = dice.choice((0.0, 0.02, 0.02, 0.05, 0.05, 0.1, 0.2, 1.0))
    for key, variable in variables.items():
        if key not in SPECIAL and variable.group not in ("pads", *OF_TASK) and dice.random() < few:
            found[key] = anything(dice, variable)
    around = pads(dice, variables) if dice.random() < few else {}
    for group, together in zip(TOGETHER, (operation, bearing, pressures, pivot, friction), strict=True):
        if dice.random() < few:
            found.update(zip(group, together(dice, len(around.get(PIVOTS, (-45, 225)))), strict=True))
    for pair in zip(EITHER[:2], EITHER[2:4], strict=True):
        if dice.random() < few:
            key = dice.choice(pair)
            found[key] = anything(dice, variables[key])
    if dice.random() < few:
        found["pivot%law"] = (b"linear",)
        for key in ("pivot%stiffness", "pivot%rotational_stiffness"):
            found[key] = (number(dice, variables[key]),)
    if dice.random() < few:
        closure = dice.choice((b"none", b"ng_pan", b"ng_pan_fit", b"constantinescu"))
        limits = sorted(log_between(dice, 1, 1e6) for _ in range(2))
        found.update(zip(TURBULENCE, ((closure,), *((limit,) for limit in limits)), strict=True))
    if "rotor%balance_grade" in found and dice.random() < 0.5:
        found["rotor%balance_speed_rpm"] = (dice.choice((-1.0, 1.0, 1e6, dice.uniform(1, 1e6))),)
    if dice.random() < few:
        found["film%circumferential_cells"] = (float(dice.choice((0, 8, 2000, 2 * dice.randint(4, 1000)))),)
    if dice.random() < few:
        found["film%axial_cells"] = (float(dice.choice((0, 2, 1000, dice.randint(2, 1000)))),)
    found.update(around)
    if found.get("pads%motion") == (b"fixed",):
        found["friction%model"] = (b"none",)
        found.pop("pivot%rotational_stiffness", None)
    fit_memory(found)
    if dice.random() < few:
        found.update(start(dice, variables))
    if dice.random() < few:
        follow(dice, found)
    if dice.random() < few:
        found.update(oil(dice, found))
    if dice.random() < few:
        set_task(dice, variables, found)
    return found


def set_task(dice: Random, variables: dict[str, Variable], found: dict[str, tuple]) -> None:
    """A task, with what belongs to it and without what does not."""
    task = dice.choice(("march", "equilibrium", *DRAWN))
    found["case%task"] = (task.encode(),)
    if task == "branch":
        found.pop("output%keep", None)
    if task in ("equilibrium", "coefficients") and "rotor%static_load" not in found and dice.random() < 0.3:
        found.update(held(dice, variables, found))
    if task not in OF_TASK:
        return
    for key in (*OF_MARCH, *(START if task == "coefficients" else ())):
        found.pop(key, None)
    for key, variable in variables.items():
        if variable.group == task and dice.random() < 0.5:
            found[key] = anything(dice, variable)
    # above the speed, or none
    if "coefficients%threshold_up_to_rpm" in found:
        found["coefficients%threshold_up_to_rpm"] = (0.0,)
    # which it needs
    found.pop("coefficients%threshold_born", None)
    found.pop("coefficients%slopes", None)


def held(dice: Random, variables: dict[str, Variable], found: dict[str, tuple]) -> dict[str, tuple]:
    """Where the journal is held: a position or, from the direction of a load, an eccentricity."""
    if dice.random() < 0.5 or found.get("rotor%gravity") == (0.0,):
        return {"held%position": anything(dice, variables["held%position"])}
    keys = HELD[: dice.choice((1, 2))]
    return {key: anything(dice, variables[key]) for key in keys}


def start(dice: Random, variables: dict[str, Variable]) -> dict[str, tuple]:
    """Where a march starts, and a disturbance of the journal."""
    origin = dice.choice(variables["start%from"].choices).encode()
    moved = {key: anything(dice, variables[key]) for key in ("start%journal", "start%journal_velocity")}
    return moved | {"start%from": (origin,), "start%file": (b"other.h5" if origin == b"file" else b"",)}


def oil(dice: Random, found: dict[str, tuple]) -> dict[str, tuple]:
    """An oil whose viscosity depends on its temperature; its law is given or meant by its numbers."""
    found.pop("bearing%viscosity", None)
    law = dice.choice((b"walther", b"exponential"))
    supply = dice.uniform(20, 80)
    if law == b"exponential":
        new = {
            "oil%reference_viscosity": (log_between(dice, 1e-3, 1),),
            "oil%reference_temperature": (dice.uniform(20, 60),),
            "oil%temperature_exponent": (dice.choice((0.0, dice.uniform(0, 0.05))),),
        }
    elif dice.random() < 0.5:
        new = {"oil%grade": (float(dice.choice((10, 32, 46, 220))),)}
    else:
        new = {"oil%kinematic_viscosity": (log_between(dice, 1e-5, 1e-3), log_between(dice, 1e-6, 1e-5))}
        new["oil%at_temperature"] = dice.uniform(20, 50), dice.uniform(60, 120)
        # between the points: a steep line through them leaves the range of viscosities beyond
        supply = dice.uniform(50, 60)
        new["oil%density_at_15"] = (dice.uniform(800, 1000),)
        new["oil%density_slope"] = (dice.uniform(-1, 0),)
    new["oil%supply_temperature"] = (supply,)
    if dice.random() < 0.5:
        new["oil%law"] = (law,)
    if dice.random() < 0.5:
        new["thermal%model"] = (b"pad",)
    return new


def follow(dice: Random, found: dict[str, tuple]) -> None:
    """Variables from which others follow, in the place of these."""
    if "bearing%machined_clearance" not in found and "bearing%assembled_clearance" not in found:
        found["bearing%preload"] = (dice.uniform(-1, 0.9),)
    if "pads%mass" not in found and "bearing%journal_radius" not in found:
        found["pads%density"] = tuple(dice.uniform(1000, 10000) for _ in range(2))
        found["pads%thickness"] = tuple(log_between(dice, 1e-3, 0.1) for _ in range(2))


def fit_memory(found: dict[str, tuple]) -> None:
    """No more axial cells than `auto` takes where films cavitate."""
    if found.get("film%solver", (b"auto",)) != (b"auto",):
        return
    if found.get("film%cavitation", (b"reynolds",)) != (b"reynolds",):
        return
    cells = max(found.get("film%circumferential_cells", (0.0,))[0], 100)
    count = len(found.get(PIVOTS, (-45, 225)))
    most = float(math.isqrt(int(MOST_IN_BLOCKS / (cells * count))))
    if "film%axial_cells" in found:
        found["film%axial_cells"] = (min(found["film%axial_cells"][0], most),)


def anything(dice: Random, variable: Variable) -> tuple:
    """Any allowed value of a variable."""
    if variable.choices:
        return (dice.choice(variable.choices).encode(),)
    if variable.is_text:
        return ("".join(dice.choices(TITLE, k=dice.choice((0, 1, 10, 200)))).encode(),)
    return tuple(number(dice, variable) for _ in variable.default)


def number(dice: Random, variable: Variable) -> float:
    """An allowed number: a limit, a neighbour of one, even or in powers of ten."""
    low, high = variable.low, variable.high
    if variable.whole:
        return float(dice.choice((low, high, dice.randint(int(low), int(high)))))
    kind = dice.randrange(6)
    if kind == 0:
        return dice.choice((low, high, math.nextafter(low, high), math.nextafter(high, low)))
    if kind == 1:
        return min(max(round(dice.uniform(low, high), dice.randrange(6)), low), high)
    if kind == 2 and low <= 0 <= high:
        return min(dice.choice((0.0, -0.0, 5e-324, 2.2250738585072014e-308, 1.0)), high)
    return log_between(dice, low, high) if kind < 5 else dice.uniform(low, high)


def log_between(dice: Random, low: float, high: float) -> float:
    """A number of any size between the limits, to random last bits."""
    least = low if low > 0 else min(1e-12, high)
    return min(max(math.exp(dice.uniform(math.log(least), math.log(high))), low), high)


def operation(dice: Random, _pads: int):
    """Speeds, duration, sampling."""
    speed = log_between(dice, 1e-3, 1e6)
    final = dice.choice((-1.0, speed, 0.0, log_between(dice, 1e-3, 1e6)))
    samples = dice.choice((1, 360, 1000, dice.randint(1, 10**6)))
    longest = 0.99e9 * 60 / samples / max(speed, final)
    duration = log_between(dice, 1e-9, min(1e6, longest))
    steady = final < 0 or final == speed
    periodic = dice.choice((0.0, 1.0, dice.random())) if steady else 0.0
    start = dice.choice((0.0, duration, duration * dice.random()))
    return (speed,), (final,), (duration,), (periodic,), (float(samples),), (start,)


def bearing(dice: Random, pads: int):
    """Radius; clearances and length of all pads, or of each."""
    radius = log_between(dice, 1e-4, 10)

    def pad() -> tuple[float, float, float]:
        clearance = min(radius * log_between(dice, 1.01e-5, 0.0499), 0.1)
        assembled = max(1e-9, min(clearance * log_between(dice, 1e-3, 1.999), 0.1))
        return clearance, assembled, radius * log_between(dice, 0.11, 9.9)

    return (radius,), *zip(*(pad() for _ in range(dice.choice((1, pads)))), strict=True)


def pressures(dice: Random, _pads: int):
    """Pressures and film."""
    solver, cavitation = dice.choice(
        (
            ("auto", "reynolds"),
            ("fourier", "gumbel"),
            ("fourier", "none"),
            ("sor", "none"),
            ("sor", "reynolds"),
        )
    )
    low, middle, high = sorted(dice.uniform(-1e9, 1e9) for _ in range(3))
    if dice.random() < 0.3:
        low, high = -1e9, 1e9
    if cavitation == "none" and dice.random() < 0.5:
        low, middle = middle, low
    return (middle,), (high,), (low,), (solver.encode(),), (cavitation.encode(),)


def pivot(dice: Random, pads: int):
    """Contact law; radii of all pivots, or of each."""
    law = dice.choice(("fang", "hertz"))

    def pad() -> tuple[float, float]:
        socket = log_between(dice, 1e-5, 2)
        difference = dice.choice((0.499 * socket, log_between(dice, 1e-9 * socket, 0.499 * socket)))
        return socket, dice.choice((0.0, difference)) if law == "fang" else difference

    return (law.encode(),), *zip(*(pad() for _ in range(dice.choice((1, pads)))), strict=True)


def friction(dice: Random, pads: int):
    """Friction model; coefficients of all pivots, or of each."""
    model = dice.choice(("none", "bengisu_akay", "lugre"))

    def pad() -> tuple[float, float]:
        static = log_between(dice, 1e-6, 10)
        dynamic = dice.choice((static, static * (1 - dice.random())))
        return static, 0.0 if model != "lugre" and dice.random() < 0.3 else dynamic

    return (model.encode(),), *zip(*(pad() for _ in range(dice.choice((1, pads)))), strict=True)


def pads(dice: Random, variables: dict[str, Variable]) -> dict[str, tuple]:
    """Pads side by side around the journal."""
    count = dice.choice((1, 2, 4, 5, MOST_PADS, dice.randint(1, MOST_PADS)))
    room = 360 / count
    first = dice.uniform(-180, -160)
    angles = [first + room * i for i in range(count)]
    if dice.random() < 0.3:
        angles = [float(round(angle)) for angle in angles]
    dice.shuffle(angles)

    def each(value) -> tuple:
        if dice.random() < 0.4:
            return (value(),) * count
        return tuple(value() for _ in range(count))

    ratio = each(lambda: dice.uniform(0.4, 0.6))
    arc = each(lambda: dice.uniform(0.1, 0.75 * room - 2))
    mass = each(lambda: log_between(dice, 1e-9, 1e3))
    tangential = each(lambda: dice.choice((0.0, -0.0, dice.uniform(-1, 1))))
    radial = each(lambda: dice.choice((0.0, dice.uniform(-1, 1))))
    inertia = each(lambda: log_between(dice, 2.1 * max(mass), 1e6))
    distance = each(lambda: number(dice, variables["pads%pivot_distance"]))
    solid = (
        each(lambda key=key: number(dice, variables[f"pads%{key}"]))
        for key in ("conductivity", "young_modulus", "poisson_ratio", "expansion")
    )
    motion = dice.choice([each for each in variables["pads%motion"].choices if "pitch" not in each]).encode()
    values = (tuple(angles), arc, ratio, distance, mass, inertia, tangential, radial, *solid, (motion,))
    left = {*INSTEAD, *SHAPE, *SLOPES}
    keys = (key for key, variable in variables.items() if variable.group == "pads" and key not in left)
    return dict(zip(keys, values, strict=True))
