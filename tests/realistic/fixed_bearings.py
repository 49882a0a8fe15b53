"""Bearings of fixed pads; the same seed and number give the same one.

Plain bearings with one groove, two axial grooves, lemon bores, offset halves and three lobes of 60 to 300 mm;
L/D 0.3 to 1.2, preload 0 to 0.6 (of lobes), Sommerfeld numbers 0.05 to 2. The rotor has the balance of ISO
21940-11, and turns at half to twice the speed at which a rotor of its weight begins to whirl in most plain
bearings, w^2 c/g = 6: some are stable, others whirl.
"""

import math

from stress_cases import Case, Dice

#: Their numbers are above this.
FIXED_ABOVE = 20_000
#: Pads of each kind: angles of their middles, arc, degrees, and whether they are lobes.
KINDS = {
    "plain": ((-90.0,), 360.0, False),
    "two grooves": ((-90.0, 90.0), 160.0, False),
    "lemon bore": ((-90.0, 90.0), 155.0, True),
    "offset halves": ((-90.0, 90.0), 165.0, True),
    "three lobes": ((-90.0, 30.0, 150.0), 105.0, True),
}
#: Place of the pivot on the arc of offset halves.
OFFSET = 0.75
#: w^2 c/g.
SPEEDS = (1.5, 24.0)
GRAVITY = 9.81


def draw(seed: int, number: int) -> Case:
    """Bearing `number` of a seed."""
    dice = Dice(f"fixed {seed}/{number}")
    kind = tuple(KINDS)[number % len(KINDS)]
    angles, arc, lobes = KINDS[kind]
    radius = dice.log(0.03, 0.15)
    length = 2 * radius * dice.uniform(0.3, 1.2)
    preload = dice.uniform(0.1, 0.6) if lobes else 0.0
    clearance = radius * dice.uniform(1.0e-3, 2.0e-3)
    speed = math.sqrt(dice.log(*SPEEDS) * GRAVITY / clearance)
    viscosity = dice.log(0.008, 0.04)
    sommerfeld = dice.log(0.05, 2.0)
    # S = mu N L D/W (R/c)^2
    load = viscosity * speed / (2 * math.pi) * length * 2 * radius / sommerfeld * (radius / clearance) ** 2
    return {
        "case": {"title": f"fixed bearing {number} of seed {seed}: {kind}"},
        "operation": {"speed_rpm": speed * 30 / math.pi, "duration": 1.0},
        "rotor": {"mass": load / GRAVITY, "balance_grade": dice.choice((1.0, 2.5, 6.3))},
        "bearing": {
            "journal_radius": radius,
            "axial_length": length,
            "assembled_clearance": clearance,
            "preload": preload,
            "viscosity": viscosity,
        },
        "pads": {
            "motion": "fixed",
            "pivot_angle_deg": list(angles),
            "arc_deg": [arc] * len(angles),
            "pivot_ratio": [OFFSET if kind == "offset halves" else 0.5] * len(angles),
        },
    }
