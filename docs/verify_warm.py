"""Tables of docs/verification.md on warm oil, and the picture docs/images/fillon.png."""

import json
import re
import subprocess
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from tiltpad.draw import plots
from verify_runs import EXAMPLES, row, run

HERE = Path(__file__).resolve().parent
IMAGES = HERE / "images"
ROSS = HERE.parent / "build/venv-ross/bin/python"
#: Fillon, Bligoud and Frene 1992.
FILLON = """&case  task = 'equilibrium' /
&rotor  mass = 1000, gravity = 10, unbalance = 0 /
&operation  speed_rpm = 4000 /
&bearing  journal_radius = 50e-3, axial_length = 70e-3, machined_clearance = 148e-6
  assembled_clearance = 78.44e-6 /
&oil  reference_viscosity = 0.0277, reference_temperature = 40, temperature_exponent = 0.0341
  density = 860, specific_heat = 1951.8, conductivity = 0.149, supply_temperature = 40, carry_over = 1 /
&thermal  model = 'pad' /
&pads  pivot_angle_deg = -45, 45, 135, 225, arc_deg = 75, motion = 'tilting_only' /
"""
#: Five pads of a compressor, and an oil that peer_ross_pads.py has, too.
FIVE = """&rotor  mass = 1000, gravity = 10, unbalance = 0 /
&operation  speed_rpm = 9000 /
&bearing  journal_radius = 50.8e-3, axial_length = 50.8e-3, machined_clearance = 108.5714e-6
  assembled_clearance = 76e-6 /
&oil  OIL /
&thermal  model = 'film' /
&pads  pivot_angle_deg = -54, 18, 90, 162, 234, arc_deg = 60, pivot_distance = 14e-3, motion = 'tilting_only'
  mass = 0.33856, inertia = 0.00013605, centre_radial = -9.3406e-3 /
"""
EXPONENTIAL = "reference_viscosity = 0.02733, reference_temperature = 40, temperature_exponent = 0.0305"
#: Maximum temperature of the pads, C, over the speed, rpm: measured (read from a figure, within 1 K), by the
#: authors' TEHD model, and by an independent program with the temperature along and across the films.
SPEEDS = (1000, 2000, 3000, 4000)
MEASURED, TEHD, ACROSS = (49.5, 59.5, 67.5, 76.5), (43.7, 53.4, 63.2, 72.9), (48.6, 56.2, 62.8, 68.5)
#: An independent program with a temperature for each pad.
PEER = (50.5, 58.7, 64.8, 69.6)
#: The same at 4000 rpm: y, um; outlet temperatures and that of the shaft, C; K_yy, MN/m; C_yy, MN s/m; as
#: that program gave them, and by another one of the same balances for pads without weight, on finite
#: volumes of 240 x 48 and 480 x 96 for each half of a film, extrapolated (damping: to 5e-4).
AT_4000 = (-55.686, (51.67, 50.06, 65.45, 64.20), 57.26, 351.30, 0.61687)
CONVERGED = (-55.7045, (51.683, 50.079, 65.475, 64.208), 57.276, 351.43, 0.6163)
#: Pads without weight.
WEIGHTLESS = ("pads%mass=1e-6", "pads%inertia=1e-9")
#: A run-up whose grooves warm.
RUN_UP = (
    *("case%task=march", "operation%speed_rpm=3000", "operation%final_speed_rpm=6500"),
    *("operation%duration=2", "output%start_time=1.97", "thermal%march=groove", "oil%groove_volume=1e-5"),
)
#: Cases with temperatures along and across films, and what an independent program has of them: thinnest film,
#: um; highest and shaft temperature, C; loss, W; K_yy, MN/m; C_yy, MN s/m.
FIELDS = {
    "Fillon, 4000 rpm": (
        FILLON.replace("'pad'", "'film'").replace("arc_deg", "pivot_distance = 20e-3, arc_deg"),
        ("pads%mass=1e-3", "pads%inertia=1e-6", "pads%centre_radial=-0.01"),
        (31.20765, 68.40364, 54.26248, 2164.421, 353.4343, 0.6087114),
    ),
    "five pads, 9000 rpm": (
        FIVE.replace(
            "OIL", "kinematic_viscosity = 32e-6, 5.362e-6, density_at_15 = 870, density_slope = -0.64"
        ),
        (),
        (27.10105, 95.05194, 58.98248, 6078.02, 510.8134, 0.3927633),
    ),
    "the paper's pads, 6500 rpm": (
        """&asperity  model = 'none' /
&oil  kinematic_viscosity = 46e-6, 6.8e-6, density_at_15 = 870, density_slope = -0.64 /
&thermal  model = 'film' /
&pads  motion = 'tilting_only' /
""",
        (),
        (35.95983, 85.03676, 56.42648, 5260.808, 563.0279, 0.9732254),
    ),
}
#: Viscosities, mPa s, of an oil of 46 and 6.8 mm2/s.
WALTHER = {40: 39.284, 60: 17.348, 80: 9.197, 100: 5.546}


def walther(program, folder):
    """Rows of Walther's law, as --check prints it."""
    command = [program, "--check", EXAMPLES / "warm_paper.nml"]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    for temperature, reference in WALTHER.items():
        here = 1e3 * float(re.search(rf"viscosity +(\S+)  Pa s at .*\b{temperature} C", text)[1])
        yield row(f"{temperature} C", f"{here:.4f}", reference, f"{abs(here / reference - 1):.1e}")


def warm_bearings(program, folder):
    """Rows of warm bearings against an independent program."""

    def compared(name, here, reference):
        return row(name, f"{here:.5g}", reference, f"{abs(here / reference - 1):.1e}")

    for label, reference, changes in (
        ("Fillon, 4000 rpm", AT_4000, ()),
        ("pads without weight, converged", CONVERGED, WEIGHTLESS),
    ):
        with run(program, fillon(folder), folder, "case%task=coefficients", *changes) as found:
            y, outlet, shaft, stiffness, damping = reference
            e, at = found.equilibrium, tiltpad.coefficients(found, "free")
            yield compared(f"{label}: journal y, um", 1e6 * e["journal_y"], y)
            order = np.argsort(found.pivot_angle % (2 * np.pi))
            for k, warmth in zip(order, outlet, strict=True):
                angle = np.degrees(found.pivot_angle[k]) % 360
                yield compared(f"outlet of the pad at {angle:.0f} deg, C", e["outlet_temperature"][k], warmth)
            yield compared("shaft, C", float(e["shaft_temperature"]), shaft)
            yield compared("K_yy, MN/m", 1e-6 * at.stiffness[0, 0, 0], stiffness)
            yield compared("C_yy, MN s/m", 1e-6 * at.damping[0, 0, 0], damping)
    with run(program, EXAMPLES / "warm_paper.nml", folder) as found:
        e, at = found.equilibrium, tiltpad.coefficients(found, "free")
        for k, reference in enumerate((23, 13.4)):
            yield compared(f"paper's pads, pad {k + 1}: viscosity, mPa s", 1e3 * e["viscosity"][k], reference)
        yield compared("journal z, um", 1e6 * e["journal_z"], -7)
        yield compared("K_yz, MN/m", 1e-6 * at.stiffness[0, 0, 1], 61)
        yield compared("K_zy, MN/m", 1e-6 * at.stiffness[0, 1, 0], 61)


def fields(program, folder):
    """Rows of bearings with temperatures along and across their films against an independent program."""
    for name, (text, changes, references) in FIELDS.items():
        case = Path(folder) / "film.nml"
        case.write_text(text)
        with run(program, case, folder, "case%task=coefficients", *changes) as found:
            e, at = found.equilibrium, tiltpad.coefficients(found, "free")
            here = {
                "thinnest film, um": 1e6 * e["min_film_thickness"].min(),
                "maximum temperature, C": e["maximum_temperature"].max(),
                "shaft, C": float(e["shaft_temperature"]),
                "loss, W": float(e["total_power_loss"]),
                "K_yy, MN/m": 1e-6 * at.stiffness[0, 0, 0],
                "C_yy, MN s/m": 1e-6 * at.damping[0, 0, 0],
            }
        for (quantity, value), reference in zip(here.items(), references, strict=True):
            part = (
                f"{value - reference:+.2f} K"
                if quantity.endswith("C")
                else f"{100 * (value / reference - 1):+.2f} %"
            )
            yield row(name, quantity, f"{value:.5g}", f"{reference:.5g}", part)


def by_ross(program, folder):
    """Rows of the five pads with each model of the oil's temperatures, here and by ROSS."""
    if not ROSS.exists():
        return
    case = Path(folder) / "five.nml"
    case.write_text(FIVE.replace("OIL", EXPONENTIAL))
    for model, kind in (("none", "none"), ("pad", "adiabatic"), ("film", "full")):
        with run(program, case, folder, "case%task=coefficients", f"thermal%model={model}") as found:
            e, warm = found.equilibrium, model != "none"
            hottest = e["maximum_temperature"].max() if warm else None
            here = film_and_heat(found, hottest, float(e["shaft_temperature"]) if warm else None)
        theirs = asked_of_ross("five", kind, 1e6, 2e6)
        yield from side_by_side(f"here, `{model}`", here, f"ROSS, {kind}", theirs)


LIMITS = ("laminar_below", "turbulent_above")
#: Limits of the transition of the turbine bearing; beyond all of its films, usual, below all of them.
TRANSITIONS = {"laminar": (1e5, 2e5), "500 to 1000": (500, 1000), "turbulent everywhere": (1, 2)}


def turbulent_by_ross(program, folder):
    """Rows of the turbine bearing with limits of the transition, here and by ROSS."""
    if not ROSS.exists():
        return
    for name, limits in TRANSITIONS.items():
        settings = (f"film%{each}={limit}" for each, limit in zip(LIMITS, limits, strict=True))
        with run(program, EXAMPLES / "turbine_bearing.nml", folder, *settings) as found:
            here = film_and_heat(found)
        theirs = asked_of_ross("turbine", "none", *limits)
        yield from side_by_side(f"{name}, here", here, f"{name}, ROSS", [*theirs[:1], *theirs[3:]])


def film_and_heat(found, *temperatures):
    """Thinnest film, um, temperatures, loss, W, coefficients along and across the load, MN and m."""
    e, at = found.equilibrium, tiltpad.coefficients(found, "free")
    return (
        1e6 * e["min_film_thickness"].min(),
        *temperatures,
        float(e["total_power_loss"]),
        *(1e-6 * each[0, i, i] for each in (at.stiffness, at.damping) for i in (0, 1)),
    )


def asked_of_ross(*question):
    """What peer_ross_pads.py answers."""
    words = [ROSS, HERE / "peer_ross_pads.py", *map(str, question)]
    said = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout
    return json.loads(said.splitlines()[-1])


def side_by_side(*rows):
    """Rows of names and values in turn, with four digits and whole numbers in full."""
    for name, values in zip(rows[::2], rows[1::2], strict=True):
        words = ("-" if each is None else f"{each:.{max(4, len(str(int(each))))}g}" for each in values)
        yield row(name, *words)


#: Bearings whose pads bend, and their thickness, m.
BENDING = {
    "Fillon, 4000 rpm": ("Fillon, 4000 rpm", 20e-3),
    "five pads, 9000 rpm": ("five pads, 9000 rpm", 14e-3),
}


def bending(program, folder):
    """Rows of bearings whose pads bend: the pad that bends most, and what changes."""
    cases = {name: (*FIELDS[of][:2], thickness) for name, (of, thickness) in BENDING.items()}
    turbine = (EXAMPLES / "bent_pads.nml").read_text().replace("clearance_temperature = 20", "")
    cases["turbine, 3600 rpm"] = (turbine, (), 50e-3)
    for name, (text, changes, thickness) in cases.items():
        case, k, c = Path(folder) / "bent.nml", {}, {}
        case.write_text(text)
        more = (*changes, "case%task=coefficients", f"pads%thickness={thickness}")
        for kind in ("none", "elastic", "both"):
            with run(program, case, folder, *more, f"pads%bending={kind}") as found:
                at = tiltpad.coefficients(found, "free")
                k[kind], c[kind] = at.stiffness[0, 0, 0], at.damping[0, 0, 0]
                if kind == "both":
                    most = found["shape/elastic_bending"].argmax()
                    bent = [1e6 * found[f"shape/{each}_bending"][most] for each in ("elastic", "thermal")]
                    clearance = 1e6 * np.atleast_1d(found.input["bearing"]["machined_clearance"])[0]
        changed = (
            f"{100 * (each[kind] / each['none'] - 1):+.1f}" for kind in ("elastic", "both") for each in (k, c)
        )
        yield row(name, f"{1e3 * thickness:.0f}", f"{clearance:.1f}", *(f"{x:.1f}" for x in bent), *changed)


def measured(program, folder):
    """Rows of maximum temperatures against measurements; draws them."""
    case, curve = fillon(folder), {}
    for speed in range(500, 4501, 250):
        with run(program, case, folder, f"operation%speed_rpm={speed}") as found:
            curve[speed] = found["equilibrium/maximum_temperature"].max()
    with plt.style.context(plots.STYLE):
        fig = plt.figure(figsize=(3.35, 2.8))
        ax = fig.subplots()
        ax.errorbar(SPEEDS, MEASURED, 1, fmt="o", color="0.2", markersize=4, capsize=2, label="measured")
        ax.plot(SPEEDS, TEHD, "--", color="C1", marker="s", markersize=3, label="Fillon et al., TEHD")
        ax.plot(
            SPEEDS, ACROSS, "-.", color="C2", marker="D", markersize=3, label="along and across the films"
        )
        ax.plot(*zip(*curve.items(), strict=True), color="C0", label="tiltpad, one for each pad")
        ax.set(xlabel="speed (rpm)", ylabel="maximum temperature (°C)")
        ax.legend()
        fig.savefig(IMAGES / "fillon.png")
        plt.close(fig)
    film = ("thermal%model=film", "pads%pivot_distance=20e-3", *FIELDS["Fillon, 4000 rpm"][1])
    kinds = {
        "along and across": film,
        "bent": (*film, "pads%bending=both"),
        "bent and warm": (*film, "pads%bending=both", "bearing%clearance_temperature=20"),
    }
    for speed, *others in zip(SPEEDS, MEASURED, TEHD, ACROSS, PEER, strict=True):
        here = [curve[speed]]
        for changes in kinds.values():
            with run(program, case, folder, f"operation%speed_rpm={speed}", *changes) as found:
                here.append(found["equilibrium/maximum_temperature"].max())
        yield row(speed, *others, *(f"{each:.1f}" for each in here), f"{here[-1] - others[0]:+.1f}")


def heat(program, folder):
    """Rows of the heat balance of whole bearings: heat made, in the oil that leaves, and in the shaft."""
    cases = {
        "Fillon, 4000 rpm": (fillon(folder), ()),
        "the same, shaft of 50 C": (fillon(folder), ("oil%shaft_temperature=50",)),
        "the paper's pads": (EXAMPLES / "warm_paper.nml", ("case%task=equilibrium",)),
        "five pads": (EXAMPLES / "warm_five_pads.nml", ()),
    }
    for name, (case, changes) in cases.items():
        with run(program, case, folder, *changes) as found:
            balance, oil = tiltpad.heat_balance(found), found.input["oil"]
            warming = found["equilibrium/drain_temperature"] - oil["supply_temperature"]
            away = oil["density"] * oil["specific_heat"] * fresh(found) * warming
        made, shaft = balance.made.sum(), balance.to_shaft.sum()
        parts = (f"{round(x, 4) + 0:.4f}" for x in (made, away, shaft))
        yield row(name, *parts, f"{abs(made - away - shaft) / made:.1e}")


def fresh(found):
    """The fresh oil that a bearing draws, m^3/s: what enters the pads less what neighbours carry over."""
    e, oil, pads = found.equilibrium, found.input["oil"], found.input["pads"]
    angle, arc, ratio = (
        np.broadcast_to(pads[name], found.pads) for name in ("pivot_angle_deg", "arc_deg", "pivot_ratio")
    )
    total = 0
    for k in range(found.pads):
        # the shaft turns towards smaller angles of the pads, so the one upstream is at the next larger angle
        ahead = (angle - angle[k] - 1e-9) % 360
        up = int(np.argmin(ahead))
        gap = (angle[up] - angle[k]) % 360 or 360
        gap -= ratio[k] * arc[k] + (1 - ratio[up]) * arc[up]
        carried = oil["carry_over"] * e["outlet_flow"][up] if gap <= oil["widest_gap_deg"] else 0
        total += e["inlet_flow"][k] - min(carried, e["inlet_flow"][k])
    return total


def fillon(folder):
    """The case of Fillon et al. as a file."""
    case = Path(folder) / "fillon.nml"
    case.write_text(FILLON)
    return case


def vibration(program, folder):
    """Rows of what vibration changes in the heat and the flow of the pads, at the end of a run-up."""
    still = None
    for unbalance in (0, 0.01, 0.03):
        changes = (*RUN_UP, f"rotor%unbalance={unbalance}")
        with run(program, EXAMPLES / "warm_paper.nml", folder, *changes) as found:
            loss, oil = tiltpad.losses(found, last=2), found.input["oil"]
            size = np.ptp(found.journal_y[tiltpad.last_revolutions(found, 2)])
            clearance = found.clearance
        heat, flow = loss.power.mean(axis=0), loss.inlet_flow.mean(axis=0)
        through = (loss.inlet_flow + loss.outlet_flow).mean(axis=0) / 2
        here = heat, flow, heat / (oil["density"] * oil["specific_heat"] * through)
        still = still or here
        more = [100 * (a / b - 1) for a, b in zip(here[:2], still[:2], strict=True)]
        cells = [", ".join(f"{x:+.1f}" for x in each) for each in (*more, here[2] - still[2])]
        yield row(unbalance, f"{1e6 * size:.1f}", f"{size / clearance:.2f}", *(cells if unbalance else "---"))


TABLES = (walther, warm_bearings, measured, heat, fields, by_ross, turbulent_by_ross, bending, vibration)
