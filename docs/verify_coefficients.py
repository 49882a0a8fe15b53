"""Tables of docs/verification.md on coefficients, stability, losses and plain bearings."""

import math
from pathlib import Path

import numpy as np
import tiltpad
from verify_runs import EXAMPLES, row, run

# Coefficients at the journal, MN/m and MN s/m, by independent programs without cavitation: motion, rpm, whirl
# frequency over speed, pivots: yy, yz, zy, zz of K and of C, where they are known.
INDEPENDENT = {
    ("tilting_radial", 6500, 1.0, "free"): (
        (521.449, -0.768, -0.200, 522.734),
        (0.647359, None, None, 0.648953),
    ),
    ("tilting_radial", 6500, 0.5, "free"): ((545.403,), (0.524387,)),
    ("tilting_radial", 6500, 1.0, "stuck"): (
        (840.962, 352.514, -354.373, 842.451),
        (0.964977, -0.227835, 0.227328, 0.967452),
    ),
    ("tilting_radial", 6500, 1.0, "locked"): ((873.050,), (1.03309,)),
    ("tilting_only", 6500, 1.0, "free"): ((511.106, None, None, 512.137), (0.977657, None, None, 0.979630)),
    ("tilting_only", 3000, 1.0, "free"): ((709.094, None, None, 711.112), (2.06450, None, None, 2.07038)),
}
PLACES = ("yy", "yz", "zy", "zz")
# Bearings whose default films are compared with closer ones: name, case, what is changed in it, closer films.
GROOVES, SLOW = EXAMPLES / "two_groove.nml", "operation%speed_rpm=2000"
PARTS = ("stiffness", "damping")
CLOSER = ("film%table_tolerance=1.2e-6",)
FINER = ("film%solver=direct", "film%circumferential_cells=320", "film%axial_cells=32")
CLOSE_FILMS = (
    ("paper's pads, 6500 rpm", "steady_tr", (), CLOSER),
    ("paper's pads, 2000 rpm", "steady_tr", (SLOW,), CLOSER),
    ("offset pivots, 3000 rpm", EXAMPLES / "offset_preload.nml", ("operation%speed_rpm=3000",), CLOSER),
    ("five pads, preload 0.5", EXAMPLES / "five_pads.nml", ("bearing%preload=0.5",), CLOSER),
    ("two fixed pads of 140 degrees, 2000 rpm", GROOVES, ("pads%arc_deg=140", SLOW), CLOSER),
    ("two fixed pads of 160 degrees, 3000 rpm", GROOVES, ("operation%speed_rpm=3000",), FINER),
)

# Someya (1989), four pads, load between them: S, eccentricity over clearance, K c/W and C c omega/W along
# the load.
SOMEYA = (
    (0.756, 0.5, 1.94, 3.33),
    (0.550, 0.6, 2.26, 3.21),
    (0.381, 0.7, 2.65, 3.06),
    (0.259, 0.8, 3.15, 3.01),
    (0.168, 0.9, 3.72, 2.97),
    (0.103, 1.0, 4.47, 2.99),
)
# Lund and Thomsen (1978), two pads of 160 degrees: L/D, S: eccentricity ratio, attitude angle, Kxx Kxy Kyx
# Kyy, Cxx Cxy Cyx Cyy; x along the load.
LUND_THOMSEN = {
    (0.5, 1.656): (0.244, 65.85, 1.69, 5.06, -2.20, 1.95, 9.93, 2.15, 2.15, 4.80),
    (0.5, 0.244): (0.655, 40.25, 4.21, 3.74, -0.13, 1.64, 6.87, 1.82, 1.82, 1.54),
    (1.0, 0.235): (0.460, 49.27, 2.19, 3.57, -0.80, 1.55, 7.36, 1.89, 1.89, 2.19),
}

# Where Someya's tables (1989, in a public copy) are not met: what, L/D, S, pads, and the known numbers of
# ROSS 3 and of the tables; x along the load. The rows of load on pad are headed L/D = 0.5.
SOMEYA_ON_PAD = {"e": 0.2, "Kxx": 1.67, "Cxx": 7.18}
LIGHTLY = (
    ("four pads of 80 degrees, load on pad", 0.5, 1.42, "on", {}, SOMEYA_ON_PAD),
    ("four pads of 80 degrees, load on pad", 1.0, 1.42, "on", {}, SOMEYA_ON_PAD),
    ("four pads of 80 degrees, load between pads", 0.5, 5.76, "between", {"e": 0.052}, {"e": 0.10}),
    ("two grooves, pads of 170 degrees", 0.5, 5.96, "grooves", {"Kyx": -7.39}, {"Kyx": -13.1}),
    ("two grooves, pads of 170 degrees", 1.0, 0.689, "grooves", {"Kyx": -2.02}, {"Kyx": -4.38}),
)

PLAIN = """\
&case task = 'coefficients' /
&rotor mass = 1000, unbalance = 0 /
&operation speed_rpm = 3000 /
&bearing journal_radius = 0.05, assembled_clearance = 1e-4, preload = 0,
  axial_length = {length}, viscosity = {viscosity} /
"""
FOUR_PADS = """\
&pads pivot_angle_deg = -45, 45, 135, 225, arc_deg = 80, motion = 'tilting_only',
  mass = 1e-6, inertia = 1e-9 /
"""
ON_PAD = "&pads pivot_angle_deg = -90, 0, 90, 180, arc_deg = 80, motion = 'tilting_only' /\n"
NARROW_GROOVES = "&pads motion = 'fixed', pivot_angle_deg = -90, 90, arc_deg = 170 /\n"
TWO_GROOVES = "&pads motion = 'fixed', pivot_angle_deg = -90, 90, arc_deg = 160 /\n"
LOAD, RADIUS, CLEARANCE, SPEED = 9810.0, 0.05, 1e-4, 100 * math.pi


def independent(program, folder):
    """Rows of coefficients against those of independent programs."""
    for (motion, speed, ratio, pivot), references in INDEPENDENT.items():
        inputs = (f"pads%motion={motion}", f"operation%speed_rpm={speed}", "film%cavitation=none")
        friction = ("friction%model=lugre",) if pivot == "stuck" else ()
        task = ("case%task=coefficients", f"coefficients%frequency_ratio={ratio}")
        with run(program, "steady_tr", folder, *inputs, *friction, *task) as result:
            found = tiltpad.coefficients(result, pivot=pivot)
        for name, unit, matrix, reference in (
            ("K", "MN/m", found.stiffness[0], references[0]),
            ("C", "MN s/m", found.damping[0], references[1]),
        ):
            known = [(place, x) for place, x in zip(PLACES, reference, strict=False) if x is not None]
            here = [1e-6 * matrix.flat[PLACES.index(place)] for place, _ in known]
            worst = max(abs(a - b) for a, (_, b) in zip(here, known, strict=True)) / abs(known[0][1])
            yield row(
                *(f"{motion}, {speed}, {ratio}, {pivot}", f"{name} {' '.join(p for p, _ in known)}, {unit}"),
                *(
                    ", ".join(f"{x:.6g}" for x in here),
                    ", ".join(f"{x:.6g}" for _, x in known),
                    f"{worst:.1e}",
                ),
            )


def close_films(program, folder):
    """Rows of coefficients with the default films against those with closer ones."""
    task = ("case%task=coefficients", "coefficients%frequency_ratio=0.5,1,2")
    for name, case, changes, close in CLOSE_FILMS:
        with (
            run(program, case, folder, *changes, *task) as usual,
            run(program, case, folder, *changes, *task, *close) as closer,
        ):
            pairs = [[each[f"coefficients/{part}"][0] for each in (usual, closer)] for part in PARTS]
        yield row(name, *(f"{np.abs(a - b).max() / np.abs(b).max():.1e}" for a, b in pairs))


def thresholds(program, folder):
    """Rows of speeds at which stability is lost."""
    inputs = ("film%cavitation=none", "rotor%mass=200", "case%task=coefficients", "operation%speed_rpm=12000")
    with run(program, "steady_tr", folder, *inputs, "coefficients%threshold_up_to_rpm=20000") as result:
        speed = result["modes/threshold_rpm"][0]
    yield row(
        "paper's pads, 200 kg, without friction", f"{speed:.3f} rpm", "14945.85 rpm (independent program)"
    )
    at = (*inputs[:-1], f"operation%speed_rpm={speed:.17g}")
    with run(program, "steady_tr", folder, *at) as result:
        frequency = result["modes/frequency"][0][0]
    yield row("its frequency there", f"{frequency:.4f} Hz", "109.546 Hz (independent program)")
    low, high, at = 1500.0, 8000.0, None
    viscosity = 0.235 * LOAD / (SPEED / (2 * math.pi) * 0.1 * 2 * RADIUS) * (CLEARANCE / RADIUS) ** 2
    case = Path(folder) / "grooves.nml"
    # the Sommerfeld number is kept while the speed changes: the load is fixed, so the viscosity falls
    for _ in range(40):
        at = 0.5 * (low + high)
        case.write_text(PLAIN.format(length=0.1, viscosity=viscosity * 3000 / at) + TWO_GROOVES)
        with run(program, case, folder, f"operation%speed_rpm={at:.17g}") as result:
            grows = np.nanmax(result["modes/eigenvalue_real"][0]) > 0
        low, high = (low, at) if grows else (at, high)
    number = at * math.pi / 30 * math.sqrt(CLEARANCE / 9.81)
    yield row(
        "two grooves, L/D = 1, S = 0.235: omega sqrt(c/g)",
        f"{number:.3f}",
        "2.1 (Nicholas, Barrett and Leader 1980)",
    )


def someya(program, folder):
    """Rows of four tilting pads at the eccentricities of the table."""
    case = Path(folder) / "pads.nml"

    def found(sommerfeld):
        viscosity = (
            sommerfeld * LOAD / (SPEED / (2 * math.pi) * 0.05 * 2 * RADIUS) * (CLEARANCE / RADIUS) ** 2
        )
        case.write_text(PLAIN.format(length=0.05, viscosity=f"{viscosity:.17g}") + FOUR_PADS)
        with run(program, case, folder) as result:
            return result["equilibrium/eccentricity_ratio"], tiltpad.coefficients(result, pivot="free")

    for table_s, eccentricity, stiffness, damping in SOMEYA:
        low, high = math.log(0.5 * table_s), math.log(2 * table_s)
        for _ in range(30):
            middle = 0.5 * (low + high)
            # a larger Sommerfeld number lifts the journal
            low, high = (middle, high) if found(math.exp(middle))[0] > eccentricity else (low, middle)
        _, at = found(math.exp(middle))
        k = at.stiffness[0][0, 0] * CLEARANCE / LOAD
        c = at.damping[0][0, 0] * CLEARANCE * SPEED / LOAD
        cells = [(math.exp(middle), table_s), (k, stiffness), (c, damping)]
        yield row(
            eccentricity,
            *(f"{here:.3f} / {table} ({100 * (here / table - 1):+.1f} %)" for here, table in cells),
        )


def lund_thomsen(program, folder):
    """Rows of two fixed pads at the Sommerfeld numbers of the table."""
    case = Path(folder) / "grooves.nml"
    for (ratio, sommerfeld), table in LUND_THOMSEN.items():
        length = 2 * RADIUS * ratio
        viscosity = (
            sommerfeld * LOAD / (SPEED / (2 * math.pi) * length * 2 * RADIUS) * (CLEARANCE / RADIUS) ** 2
        )
        case.write_text(PLAIN.format(length=length, viscosity=f"{viscosity:.17g}") + TWO_GROOVES)
        with run(program, case, folder) as result:
            e = result.equilibrium
            at = tiltpad.coefficients(result)
        values = [
            *(e["eccentricity_ratio"], math.degrees(e["attitude_angle"])),
            *(at.stiffness[0] * CLEARANCE / LOAD).flat,
            *(at.damping[0] * CLEARANCE * SPEED / LOAD).flat,
        ]
        yield row(
            f"L/D {ratio}, S {sommerfeld}", *(f"{x:.3g} / {y}" for x, y in zip(values, table, strict=True))
        )


def lightly_loaded(program, folder):
    """Rows of bearings for which the program and Someya's tables are not the same: program / ROSS / table."""
    case = Path(folder) / "light.nml"
    pads = {"on": ON_PAD, "between": FOUR_PADS, "grooves": NARROW_GROOVES}
    for what, ratio, sommerfeld, which, ross, table in LIGHTLY:
        length = 2 * RADIUS * ratio
        viscosity = (
            sommerfeld * LOAD / (SPEED / (2 * math.pi) * length * 2 * RADIUS) * (CLEARANCE / RADIUS) ** 2
        )
        case.write_text(PLAIN.format(length=length, viscosity=f"{viscosity:.17g}") + pads[which])
        with run(program, case, folder) as result:
            at = tiltpad.coefficients(result)
            found = {"e": result["equilibrium/eccentricity_ratio"]}
        k, c = (each[0] * CLEARANCE / LOAD for each in (at.stiffness, at.damping))
        found |= {"Kxx": k[0, 0], "Cxx": SPEED * c[0, 0], "Kyx": k[1, 0]}
        for name in table:
            cells = (f"{found[name]:.3g}", ross.get(name, "-"), table[name])
            yield row(f"{what}, L/D {ratio}, S {sommerfeld}", name, *cells)


def losses(program, folder):
    """Rows of losses and flows of a pad."""
    inputs = ("pads%motion=tilting_only", "case%task=equilibrium", "film%cavitation=none")
    names = {
        "couette_loss": ("Couette loss, W", 1, 2684.97),
        "poiseuille_loss": ("Poiseuille loss, W", 1, 124.15),
        "inlet_flow": ("inlet flow, ml/s", 1e6, 91.06),
        "outlet_flow": ("outlet flow, ml/s", 1e6, 76.22),
    }
    with run(program, "steady_tr", folder, *inputs) as result:
        for name, (label, factor, reference) in names.items():
            here = factor * result[f"equilibrium/{name}"][0]
            yield row(label, f"{here:.4f}", reference, f"{abs(here / reference - 1):.1e}")


TABLES = (independent, close_films, thresholds, someya, lund_thomsen, lightly_loaded, losses)
