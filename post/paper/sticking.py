"""Beyond the paper: what pads that stick do to the stability of the rotor; pictures, tables and words."""

from itertools import product

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tiltpad.draw.layout import PAGE
from tiltpad.files.units import SHOWN

from paper.runs import Runs
from paper.settings import LUGRE, Case
from paper.tables import digits, table

RPM = SHOWN["speed"].label
#: Pivots, as results have them, and the lines of those whose threshold speeds lie in the pictures.
PIVOTS = ("free", "stuck", "locked")
LINES = {"stuck": "-", "locked": ":"}
#: Speed for which the page tells the stiffness, rpm.
TOLD_SPEED = 6000
#: Revolutions over which a whirl is measured.
STRETCH = 6
#: What sticking does to stability: the rotor's mass and other masses, kg, speeds, rpm, and bristle
#: stiffnesses, 1/m. Threshold speeds are sought from the first speed up to THRESHOLD_UP_TO.
ROTOR_MASS = 2000
STICK_MASSES = (100, 200, 400, 700, 1000, 1500, 2000, 3000, 4000)
STICK_SPEEDS = tuple(range(1000, 12001, 1000))
STICK_STIFFNESSES = ("1e4", "3e4", "1e5", "2e5", "5e5", "1e6", "2e6", "5e6", "2e7", "1e8")
THRESHOLD_UP_TO = 30000
#: Speeds of the marches, rpm, below and above the threshold speed of the paper's rotor on pads that stick.
WHIRL_SPEEDS = (8600, 9600)
WHIRL = (
    "rotor%unbalance=0",
    "start%journal=2e-7,0",
    "operation%duration=0.6",
    "output%samples_per_revolution=60",
    "integration%relative_tolerance=1e-7",
)
THRESHOLD = (
    "case%task=coefficients",
    f"operation%speed_rpm={STICK_SPEEDS[0]}",
    f"coefficients%threshold_up_to_rpm={THRESHOLD_UP_TO}",
)


def stick_name(mass: float, speed: float) -> str:
    return f"stick_{mass}_{speed}"


def at_rest(mass: float, speed: float) -> tuple[str, ...]:
    """Overrides: small vibrations of a rotor of this mass at a speed."""
    return "case%task=coefficients", f"rotor%mass={mass}", f"operation%speed_rpm={speed}"


CASES = (
    *(
        Case(stick_name(mass, speed), LUGRE, at_rest(mass, speed))
        for mass, speed in (*product(STICK_MASSES, STICK_SPEEDS), *product([ROTOR_MASS], WHIRL_SPEEDS))
    ),
    *(Case(f"threshold_mass_{mass}", LUGRE, (*THRESHOLD, f"rotor%mass={mass}")) for mass in STICK_MASSES),
    *(
        Case(f"threshold_stiffness_{word}", LUGRE, (*THRESHOLD, f"friction%bristle_stiffness={word}"))
        for word in STICK_STIFFNESSES
    ),
    *(Case(f"whirl_{speed}", LUGRE, (*WHIRL, f"operation%speed_rpm={speed}")) for speed in WHIRL_SPEEDS),
)


def thresholds(runs: Runs, kind: str, words: tuple) -> dict[str, np.ndarray]:
    """For each way of the pivots the threshold speeds of runs, rpm; nan where none is found."""
    found = np.array([runs[f"threshold_{kind}_{word}"]["modes/threshold_rpm"] for word in words])
    return dict(zip(PIVOTS, found.T, strict=True))


def stability_figure(runs: Runs) -> Figure:
    """Least damping ratio on pads that stick, and threshold speeds; these also over the bristles."""
    fig, axes = plt.subplots(1, 2, figsize=(PAGE, 3.0))
    draw_ratios(axes[0], runs)
    over_mass = thresholds(runs, "mass", STICK_MASSES)
    over_stiffness = thresholds(runs, "stiffness", STICK_STIFFNESSES)
    stiffnesses = [float(word) for word in STICK_STIFFNESSES]
    for pivot, dashes in LINES.items():
        axes[0].plot(over_mass[pivot], STICK_MASSES, dashes, color="black", label=pivot)
        axes[1].plot(stiffnesses, over_stiffness[pivot], dashes, color="C0", label=pivot)
    axes[0].set(xlim=(STICK_SPEEDS[0], STICK_SPEEDS[-1]))
    axes[1].set(xscale="log", xlabel=r"bristle stiffness $\sigma_0$ (1/m)", ylabel="threshold speed (rpm)")
    for ax in axes:
        ax.legend(title="pivots")
    return fig


def draw_ratios(ax: Axes, runs: Runs) -> None:
    """Filled contours of the least damping ratio on pads that stick, in per cent."""
    ratios = [
        [100 * least_damped(runs[stick_name(mass, speed)])[0] for speed in STICK_SPEEDS]
        for mass in STICK_MASSES
    ]
    limit = np.abs(ratios).max()
    shades = ax.contourf(STICK_SPEEDS, STICK_MASSES, ratios, 20, cmap="RdBu", vmin=-limit, vmax=limit)
    ax.figure.colorbar(shades, ax=ax, label="least damping ratio, pads stuck (%)")
    ax.set(xlabel=RPM, ylabel="mass of the rotor (kg)", yscale="log")
    ax.grid(visible=False)


def least_damped(run: tiltpad.Run) -> tuple[float, float]:
    """Damping ratio of the first mode on pads that stick, and its growth, 1/s."""
    found = tiltpad.modes(run, "stuck")
    k = np.nanargmin(found.damping_ratio)
    return float(found.damping_ratio[k]), float(found.eigenvalue[k].real)


def stuck_stiffness(runs: Runs, row: int, column: int) -> float:
    """Synchronous stiffness of the paper's bearing on pads that stick, MN/m."""
    found = tiltpad.coefficients(runs[stick_name(ROTOR_MASS, TOLD_SPEED)], "stuck")
    return 1e-6 * float(found.stiffness[0, row, column])


def whirl_figure(runs: Runs) -> Figure:
    """Peak to peak of the journal in both marches over time."""
    fig, axes = plt.subplots(1, 2, figsize=(PAGE, 2.6), sharey=True)
    for ax, speed in zip(axes, WHIRL_SPEEDS, strict=True):
        time, size = envelope(runs[f"whirl_{speed}"])
        ax.semilogy(time, 1e6 * size, color="C0")
        ax.set(title=f"{speed} rpm", xlabel="time (s)")
    axes[0].set(ylabel=f"peak to peak of y in {STRETCH} revolutions (µm)")
    return fig


def envelope(run: tiltpad.Run) -> tuple[np.ndarray, np.ndarray]:
    """End of each stretch of revolutions, s, and peak to peak of y in it, m: each has several whirls."""
    turns = np.floor(tiltpad.revolutions(run) / STRETCH)
    ends = np.flatnonzero(np.diff(turns))
    parts = np.split(run.journal_y, ends + 1)[1:-1]
    return run.time[ends][1:], np.array([np.ptp(part) for part in parts])


def growth(run: tiltpad.Run, first: float, last: float) -> float:
    """Growth of the envelope between two times, 1/s."""
    time, size = envelope(run)
    part = (time > first) & (time < last)
    return float(np.polyfit(time[part], np.log(size[part]), 1)[0])


def threshold_table(runs: Runs) -> str:
    """Threshold speeds over the mass, rpm."""
    found = thresholds(runs, "mass", STICK_MASSES)
    rows = [(mass, *(said(found[pivot][k]) for pivot in PIVOTS)) for k, mass in enumerate(STICK_MASSES)]
    return table(("mass, kg", *(f"{pivot}, rpm" for pivot in PIVOTS)), rows)


def said(threshold: float) -> str:
    return f"none up to {THRESHOLD_UP_TO}" if np.isnan(threshold) else f"{threshold:.0f}"


def whirl_words(runs: Runs) -> str:
    """What the marches say beside the threshold speed."""
    k = STICK_MASSES.index(ROTOR_MASS)
    stuck = thresholds(runs, "mass", STICK_MASSES)["stuck"][k]
    below, above = (runs[f"whirl_{speed}"] for speed in WHIRL_SPEEDS)
    modes = [digits(least_damped(runs[stick_name(ROTOR_MASS, speed)])[1]) for speed in WHIRL_SPEEDS]
    end = envelope(above)[1][-1]
    return (
        f"For the rotor of the paper, {ROTOR_MASS} kg, the threshold speed on pads that stick "
        f"is {stuck:.0f} rpm. "
        f"At {WHIRL_SPEEDS[0]} rpm the motion grows by {digits(growth(below, 0.1, 0.4))} 1/s (first mode: "
        f"{modes[0]}), which means that it dies away, at {WHIRL_SPEEDS[1]} rpm by "
        f"{digits(growth(above, 0.1, 0.2))} 1/s (first mode: {modes[1]}). The growth ends where the friction "
        f"moments reach their limit and the pads break away in every turn of the whirl: the journal then "
        f"whirls steadily, with {digits(1e6 * end)} um from peak to peak, without any unbalance."
    )


#: Pictures of this module.
FIGURES = {"stability": stability_figure, "whirl": whirl_figure}
