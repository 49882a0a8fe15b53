"""Counterparts of the paper's figures of contact and friction laws, by the solver's own library."""

from math import pi

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.figure import Figure
from tiltpad.draw.layout import COLUMN, PAGE
from tiltpad.files.units import SHOWN

from paper.measures import stribeck_curve
from paper.runs import Runs

DEFLECTION, FORCE = SHOWN["pivot_deflection"], SHOWN["pivot_load"]
#: The example of Figs. 3 and 4: socket radius, m, load of Fig. 3, N, radius differences, um, and pivot
#: deflections up to, m, of Fig. 4. The paper prints the first of them only.
FANG_PIVOT, FANG_LOAD, FANG_DIFFERENCES, FANG_DEFLECTION = 0.1, 1e4, (0, 15, 30, 60), 20e-6
#: Contact laws beside the paper's, by their overrides.
LAWS = {
    "Fang, factor 4": (),
    r"Fang, factor 2 pi": (f"pivot%deflection_factor={2 * pi:.15g}",),
    "Hertz": ("pivot%law='hertz'",),
}
LAW_DIFFERENCES = (15, 30)


def pivot(difference: float, *overrides: str, socket_radius: float | None = None) -> str:
    """A namelist of a pivot with the radius difference, um; overrides as pivot%name=value."""
    words = [f"radius_difference={1e-6 * difference:g}", *(each.partition("%")[2] for each in overrides)]
    words += [f"socket_radius={socket_radius:g}"] if socket_radius else []
    return f"&pivot {', '.join(words)} /"


def fang_force(difference: float) -> tuple[np.ndarray, np.ndarray]:
    """Pivot deflection, m, and force, N, of the paper's example of Fig. 4."""
    pivot_deflection = np.linspace(0, FANG_DEFLECTION, 201)
    return pivot_deflection, tiltpad.pivot_load(pivot_deflection, pivot(difference, socket_radius=FANG_PIVOT))


def figure_3(runs: Runs) -> Figure:
    """Contact pressure over the projected contact, without radius difference."""
    case = pivot(0, socket_radius=FANG_PIVOT)
    # without radius difference the force is proportional to the pivot deflection
    pivot_deflection = FANG_LOAD / float(tiltpad.pivot_load(1.0e-6, case)) * 1e-6
    radius = float(tiltpad.contact(pivot_deflection, case).radius)
    r, angle = np.meshgrid(radius * np.sqrt(1 - np.linspace(1, 0, 80) ** 4), np.linspace(0, 2 * np.pi, 121))
    pressure = tiltpad.contact_pressure(pivot_deflection, r, case)
    fig, ax = plt.subplots(subplot_kw={"projection": "3d"}, figsize=(COLUMN + 0.6, 2.8))
    place = 1e3 * r * np.cos(angle), 1e3 * r * np.sin(angle)
    look = {"cmap": "viridis", "rcount": 121, "ccount": 80, "linewidth": 0, "antialiased": False}
    ax.plot_surface(*place, 1e-6 * pressure, **look)
    ax.set(xlabel=r"$\tilde x$ (mm)", ylabel=r"$\tilde y$ (mm)", zlabel="pressure (MPa)")
    ax.set_title(f"$\\Delta R$ = 0, $F_{{bs}}$ = {FORCE.factor * FANG_LOAD:g} kN", y=0.95)
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(plt.MultipleLocator(50))
    ax.zaxis.set_major_locator(plt.MaxNLocator(4))
    ax.set_box_aspect((1, 1, 0.6), zoom=0.95)
    ax.tick_params(pad=0)
    return fig


def figure_4(runs: Runs) -> Figure:
    """Force over pivot deflection for several radius differences."""
    fig, ax = plt.subplots(figsize=(COLUMN, 2.6))
    for difference in FANG_DIFFERENCES:
        pivot_deflection, force = fang_force(difference)
        label = f"$\\Delta R$ = {difference} µm"
        ax.plot(DEFLECTION.factor * pivot_deflection, FORCE.factor * force, label=label)
    ax.set(xlabel=DEFLECTION.label, ylabel=FORCE.label, xlim=(0, None), ylim=(0, None))
    ax.legend()
    return fig


def figure_6(runs: Runs) -> Figure:
    """Friction force of 1 N of load over sliding velocity, both laws, and enlarged around rest."""
    fig, axes = plt.subplots(1, 2, figsize=(PAGE, 2.5))
    for name, text, look in (
        ("steady_ba_20_10", "Bengisu-Akay", {"color": "C0"}),
        ("steady_lugre_20_10", "LuGre, steady", {"color": "C1", "linestyle": "--"}),
    ):
        run = runs[name]
        for ax, span in zip(axes, (5e-3, 5e-5), strict=True):
            velocity = np.linspace(-span, span, 2001)
            velocity[1000] = 0.0
            ax.plot(1e3 * velocity, steady_friction(run, velocity), label=text, **look)
            ax.set(xlabel="sliding velocity (mm/s)", ylabel="friction force at 1 N (N)")
    axes[0].legend(loc="upper left")
    axes[1].set_title("around rest", fontsize="medium")
    return fig


def steady_friction(run: tiltpad.Run, velocity: np.ndarray) -> np.ndarray:
    """Friction force, N, of 1 N of load at constant sliding velocities, m/s."""
    law, deflection = run.input["friction"], np.zeros_like(velocity)
    if law["model"] == "lugre":
        # bristles that bend no further
        deflection = stribeck_curve(run, velocity) / law["bristle_stiffness"]
    return tiltpad.friction_force(velocity, 1.0, deflection, run)


def laws4(runs: Runs) -> Figure:
    """Fig. 4 for the bearing's pivot by other contact laws."""
    fig, ax = plt.subplots(figsize=(PAGE - 1, 2.8))
    load = runs["steady_tr"].values("pivot_load", tiltpad.last_revolutions(runs["steady_tr"]))
    ax.axhspan(*(FORCE.factor * each for each in (load.min(), load.max())), color="0.93", zorder=0)
    pivot_deflection = np.linspace(0, 15e-6, 201)
    for color, (law, overrides) in enumerate(LAWS.items()):
        for dash, difference in zip((":", "-", "--"), (0, *LAW_DIFFERENCES), strict=True):
            if difference == 0 and law == "Hertz":
                continue
            force = tiltpad.pivot_load(pivot_deflection, pivot(difference, *overrides))
            look = {"color": f"C{color}", "linestyle": dash}
            label = f"{law_text(law)}, $\\Delta R$ = {difference} µm"
            ax.plot(DEFLECTION.factor * pivot_deflection, FORCE.factor * force, label=label, **look)
    ax.set(xlabel=DEFLECTION.label, ylabel=FORCE.label, xlim=(0, 15), ylim=(0, 40))
    fig.legend(loc="outside upper center", ncols=3)
    return fig


def law_text(law: str) -> str:
    """A law's name in a picture."""
    return law.replace("2 pi", r"2$\pi$")


FIGURES = {"3": figure_3, "4": figure_4, "6": figure_6}
