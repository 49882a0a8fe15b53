"""Runs what docs/rig.md tells of, draws its pictures and compares the figures in its text.

usage: rig.py TILTPAD
"""

import os
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.figure import Figure
from tiltpad.draw import layout, plots
from verify_runs import row

DOCS = Path(__file__).resolve().parent
CYCLE = DOCS.parent / "input/examples/load_cycle.nml"
#: The paper's bearing on a rig: no unbalance, forces at half the speed.
RIG = {
    "case": {"task": "periodic"},
    "rotor": {"unbalance": 0.0},
    "output": {"samples_per_revolution": 60, "keep": "all"},
}
RATIO, WEIGHT, DIRECTIONS = 0.5, 2000 * 9.81, (0.0, 90.0)
COEFFICIENTS = (0.1, 0.02, 0.002)
AMPLITUDES = np.geomspace(1.0, WEIGHT / 2, 25)
LAWS = {"lugre": "-", "bengisu_akay": "--"}
#: Friction coefficients of the cycle of the load.
CYCLED = (0.1, 0.3, 0.5)
#: Elements of the picture: of the stiffness and of the damping.
ELEMENTS = {"yy": (0, 0), "yz": (0, 1)}


def friction(law: str, coefficient: float) -> dict:
    """The group of a law; none for a coefficient of 0."""
    if not coefficient:
        return {"model": "none"}
    return {"model": law, "static_coefficient": coefficient, "dynamic_coefficient": coefficient}


def identified(law: str, coefficient: float) -> list[tiltpad.Coefficients]:
    """Coefficients as a rig finds them, at each of the amplitudes."""
    case = RIG | {
        "friction": friction(law, coefficient),
        "excitation": {"amplitude": 1.0, "frequency_ratio": RATIO},
    }
    varied = {"excitation(1)%amplitude": AMPLITUDES, "excitation(1)%direction_deg": DIRECTIONS}
    with tiltpad.run(case | {"sweep": varied}) as study:
        runs = [study.result(number) for number in range(1, 2 * len(AMPLITUDES) + 1)]
        return [tiltpad.impedance(pair) for pair in zip(runs[::2], runs[1::2], strict=True)]


def linear(law: str, coefficient: float, ratio: float = RATIO) -> dict[str, tiltpad.Coefficients]:
    """Coefficients of the linearised bearing, free and stuck."""
    case = RIG | {"case": {"task": "coefficients"}, "friction": friction(law, coefficient)}
    with tiltpad.run(case) as run:
        return {pivot: tiltpad.coefficients(run, pivot, ratio) for pivot in ("free", "stuck")}


def amplitude_picture(curves: dict, free: list, stuck: tiltpad.Coefficients) -> Figure:
    """Stiffness and damping over the amplitude, with the limits of stuck and of free pads."""
    with plt.style.context(plots.STYLE):
        fig = plt.figure(figsize=(layout.PAGE, 4.6))
        panels = fig.subplots(2, 2, sharex=True)
        for row, (name, factor, unit) in zip(
            panels, (("stiffness", 1e-6, "MN/m"), ("damping", 1e-3, "kN s/m")), strict=True
        ):
            for ax, (element, place) in zip(row, ELEMENTS.items(), strict=True):
                value = partial(part, name=name, place=place, factor=factor)
                ax.semilogx(AMPLITUDES, [value(each) for each in free], color="0.3", linestyle=":")
                ax.axhline(value(stuck), color="0.3", linestyle="-.", linewidth=0.8)
                for (law, coefficient), found in curves.items():
                    color = f"C{COEFFICIENTS.index(coefficient)}"
                    ax.semilogx(AMPLITUDES, [value(each) for each in found], LAWS[law], color=color)
                ax.set_ylabel(f"{name} {element} ({unit})")
        for ax in panels[-1]:
            ax.set_xlabel("amplitude of the force (N)")
        entries = [(f"f = {each:g}", {"color": f"C{k}"}) for k, each in enumerate(COEFFICIENTS)]
        entries += [("LuGre", {"color": "0.3"}), ("Bengisu-Akay", {"color": "0.3", "linestyle": "--"})]
        entries += [("no friction", {"color": "0.3", "linestyle": ":"})]
        entries += [("stuck, linear (LuGre)", {"color": "0.3", "linestyle": "-.", "linewidth": 0.8})]
        layout.heading(fig, entries, "")
    return fig


def part(each: tiltpad.Coefficients, name: str, place: tuple[int, int], factor: float) -> float:
    """An element of a matrix in the unit of the picture."""
    return float(factor * getattr(each, name)[0][place])


def cycle(coefficient: float, law: str = "lugre") -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, load over the weight, and attitude angle in degrees (from the load towards +z), of the cycle."""
    with tiltpad.run(CYCLE, friction=friction(law, coefficient)) as run:
        load = 1 - run.excitation_y.sum(axis=1) / WEIGHT
        return run.time, load, np.degrees(np.arctan2(run.journal_z, -run.journal_y))


def hysteresis_picture(cycles: dict) -> Figure:
    """Attitude angle over the load, and over the time."""
    with plt.style.context(plots.STYLE):
        fig = plt.figure(figsize=(layout.PAGE, 2.8))
        left, right = fig.subplots(1, 2, sharey=True)
        for k, (time, load, angle) in enumerate(cycles.values()):
            look = {"color": "0.3" if k == 0 else f"C{k - 1}", "linestyle": ":" if k == 0 else "-"}
            left.plot(load, angle, **look)
            right.plot(time, angle, **look)
        left.set(xlabel="load over weight", ylabel="attitude angle (deg)")
        right.set(xlabel="time (s)")
        texts = [f"f = {each:g}" if each else "no friction" for each in cycles]
        looks = [{"color": "0.3", "linestyle": ":"}, *({"color": f"C{k}"} for k in range(len(CYCLED)))]
        layout.heading(fig, [*zip(texts, looks, strict=True)], "")
    return fig


def deviation(found: tiltpad.Coefficients, other: tiltpad.Coefficients) -> float:
    """The largest difference of an element of stiffness or damping over the largest element, %."""
    pairs = [(getattr(each, name)[0] for each in (found, other)) for name in ("stiffness", "damping")]
    return max(100 * np.abs(own - its).max() / np.abs(its).max() for own, its in pairs)


def amplitude_figures(curves: dict, free: list, stuck: tiltpad.Coefficients) -> Iterator[str]:
    """What the page says of the amplitude."""
    k, c = 1e-6 * stuck.stiffness[0], 1e-3 * stuck.damping[0]
    own, its = 1e-6 * free[0].stiffness[0], 1e-3 * free[0].damping[0]
    yield f"| {k[0, 0]:.0f} | {k[0, 1]:.0f} | {c[0, 0]:.0f} | {c[0, 1]:.0f} |"
    yield f"| {own[0, 0]:.0f} | {own[0, 1]:.0f} | {its[0, 0]:.0f} | {its[0, 1]:.0f} |"
    yield f"{100 * (k[0, 0] / own[0, 0] - 1):.0f} % stiffer in the vertical"
    yield f"{c[0, 0] / its[0, 0]:.1f} times the damping"
    small = max(deviation(curves["lugre", each][0], stuck) for each in COEFFICIENTS)
    yield f"at 1 N within {small:.1f} % of `stuck`"
    yield f"at half the load within {deviation(curves['lugre', 0.002][-1], free[-1]):.1f} % of"
    impedance = free[0].stiffness[0, 0, 0] + 1j * free[0].frequency[0] * free[0].damping[0, 0, 0]
    force = 0.05 * 80e-6 * abs(impedance)
    at = np.interp(np.log(force), np.log(AMPLITUDES), [each.stiffness[0, 0, 0] for each in free])
    yield f"a force of {1e-3 * force:.1f} kN here: without friction the stiffness has changed by"
    yield f"has changed by {100 * (1 - at / free[0].stiffness[0, 0, 0]):.1f} % there"
    sliding = curves["lugre", 0.02][int(np.argmin(np.abs(AMPLITUDES - force)))].stiffness[0]
    yield f"from {k[0, 1]:.0f} to {1e-6 * sliding[0, 1]:.0f} MN/m across"
    large = 1e-6 * curves["lugre", 0.1][-1].stiffness[0]
    yield f"{large[0, 0]:.0f} MN/m in the vertical and {large[0, 1]:.0f} MN/m across"
    yield f"from {own[0, 0]:.0f} to {1e-6 * free[-1].stiffness[0, 0, 0]:.0f} MN/m"
    creeping = linear("bengisu_akay", 0.002)["stuck"]
    yield f"within {deviation(curves['bengisu_akay', 0.002][0], creeping):.1f} % of its own `stuck`"
    yield f"{1e-6 * creeping.stiffness[0, 0, 0]:.0f} MN/m with f = 0.002"
    slow = linear("bengisu_akay", 0.1, 0.001)["stuck"].stiffness[0]
    yield f"{1e-6 * slow[0, 0]:.0f} MN/m and {1e-6 * slow[0, 1]:.0f} MN/m across at a thousandth of the speed"


def cycle_figures(cycles: dict) -> Iterator[str]:
    """What the page says of the slow cycle."""
    yield f"the angle stays below {np.abs(cycles[0][2]).max():.1f} degrees"
    for coefficient in CYCLED:
        time, _, angle = cycles[coefficient]
        at = (np.interp(each, time, angle) for each in (0.5, 1.0, 1.5, 2.0))
        yield row(f"{coefficient:g}", *(f"{each:.1f}" for each in at))


def main() -> None:
    os.environ["TILTPAD"] = str(Path(sys.argv[1]).resolve())
    page = (DOCS / "rig.md").read_text()
    curves = {(law, each): identified(law, each) for law in LAWS for each in COEFFICIENTS}
    free, stuck = identified("none", 0), linear("lugre", 0.1)["stuck"]
    cycles = {each: cycle(each) for each in (0, *CYCLED)}
    found = [*amplitude_figures(curves, free, stuck), *cycle_figures(cycles)]
    if wrong := [words for words in found if words not in page]:
        sys.exit(f"docs/rig.md: other figures now: {wrong}")
    amplitude_picture(curves, free, stuck).savefig(DOCS / "images/rig_amplitude.png")
    hysteresis_picture(cycles).savefig(DOCS / "images/rig_hysteresis.png")


if __name__ == "__main__":
    main()
