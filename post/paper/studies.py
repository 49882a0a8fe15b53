"""Beyond the paper: friction work, stick maps, contact laws, rule of the unbalance; pictures and tables."""

from itertools import product

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tiltpad.draw.layout import PAGE
from tiltpad.files.units import SHOWN

from paper import settings
from paper.figures import TILTS, legend, named, orbit_tilt_rate, panels
from paper.laws import LAW_DIFFERENCES, LAWS, law_text, laws4
from paper.measures import height, of_pad, peak_to_peak, size
from paper.runs import Runs
from paper.settings import BA, BA_10_10, FRICTIONLESS, LUGRE, Case, at_speed, coefficients, shorter
from paper.tables import digits, table

RPM = SHOWN["speed"].label


# ---- friction work ---------------------------------------------------------------------------------------
def work_figure(runs: Runs) -> Figure:
    """Friction work per revolution and mean power of each pad over the speed of the run-ups."""
    fig, axes = plt.subplots(1, 2, figsize=(PAGE, 2.6))
    lines = []
    for color, (model, name) in enumerate(settings.RUNUPS.items()):
        run = runs[name]
        speed, duration, work = work_by_revolution(run)
        for pad, dashes in ((0, "-"), (1, "--")):
            look = {"color": f"C{color}", "linestyle": dashes}
            lines.append((f"{named(model)}, pad {pad + 1}", run, look))
            axes[0].plot(speed, SHOWN["work"].factor * work[:, pad], **look)
            axes[1].plot(speed, work[:, pad] / duration, **look)
    axes[0].set(ylabel=f"friction work per revolution ({SHOWN['work'].unit})")
    axes[1].set(ylabel="mean friction power (W)")
    for ax in axes:
        ax.set(xlabel=RPM, xlim=(speed[0], speed[-1]))
    return legend(fig, lines, 3)


def work_by_revolution(run: tiltpad.Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean speed, rpm, duration, s, and friction work of each pad, J, (revolution, pad), of every
    revolution.
    """
    turns, tilt, moment = tiltpad.revolutions(run), run.pad_tilt, run.friction_moment
    pieces = 0.5 * (moment[1:] + moment[:-1]) * np.diff(tilt, axis=0)
    done = np.vstack([np.zeros(run.pads), np.cumsum(pieces, axis=0)])
    whole = np.arange(np.floor(turns[-1]) + 1)
    duration = np.diff(np.interp(whole, turns, run.time))
    work = np.column_stack([np.diff(np.interp(whole, turns, each)) for each in done.T])
    return 60 / duration, duration, work


def work_table(runs: Runs) -> str:
    """Work per revolution and mean power over each pivot of the steady runs."""
    rows = []
    for model, names in settings.MODELS.items():
        for pair, name in zip(settings.PAIRS, names, strict=True):
            run = runs[name]
            pads = range(1, run.pads + 1)
            work = [digits(1e3 * tiltpad.friction_work(run, pad, settings.LAST)) for pad in pads]
            power = [digits(tiltpad.friction_power(run, pad, settings.LAST)) for pad in pads]
            share = [f"{100 * tiltpad.stick_fraction(run, pad, settings.LAST):.0f}" for pad in pads]
            rows.append((model, pair, *work, *power, *share))
    measured = ("work, pad 1, mJ", "power, pad 1, W", "stick, pad 1, %")
    return table(("model", "f_s/f_d", *(word for each in measured for word in (each, "pad 2"))), rows)


# ---- stick map -------------------------------------------------------------------------------------------
#: Map of the stick fraction: speeds, rpm, and static friction coefficients, the dynamic ones half as large.
MAP_SPEEDS = tuple(range(1500, 6501, 500))
MAP_COEFFICIENTS = (0.01, 0.02, 0.035, 0.05, 0.075, 0.1, 0.15, 0.2)
#: Only the last revolutions are kept.
MAP_TIME = ("operation%duration=0.5", "output%start_time=0.25")


def map_name(speed: float, coefficient: float) -> str:
    return f"map_{speed:g}_{coefficient:g}"


MAP = tuple(
    Case(map_name(speed, f), BA, (*coefficients(f, f / 2), *at_speed(speed), *MAP_TIME))
    for speed in MAP_SPEEDS
    for f in MAP_COEFFICIENTS
)


def map_figure(runs: Runs) -> Figure:
    """Stick fraction and friction power over speed and friction coefficient."""
    fig, axes = plt.subplots(1, 2, figsize=(PAGE, 2.9))
    power = map_values(
        runs, lambda run: sum(tiltpad.friction_power(run, pad, settings.LAST) for pad in (1, 2))
    )
    sticks = f"time in which pad {settings.PAD} sticks (%)"
    draw_map(axes[0], 100 * stick_map(runs), sticks, np.arange(0, 101, 10))
    draw_map(axes[1], power, "friction power, both pads (W)", 10)
    return fig


def map_values(runs: Runs, measure) -> np.ndarray:
    """A number of every run of the map, (coefficient, speed)."""
    return np.array([[measure(runs[map_name(speed, f)]) for speed in MAP_SPEEDS] for f in MAP_COEFFICIENTS])


def stick_map(runs: Runs) -> np.ndarray:
    """Stick fraction of the first pad, (coefficient, speed)."""
    return map_values(runs, lambda run: tiltpad.stick_fraction(run, settings.PAD, settings.LAST))


def draw_map(ax: Axes, values: np.ndarray, label: str, levels: int | np.ndarray) -> None:
    """Filled contours, with the runs as points."""
    shades = ax.contourf(MAP_SPEEDS, MAP_COEFFICIENTS, values, levels=levels, cmap="viridis")
    points = (each.ravel() for each in np.meshgrid(MAP_SPEEDS, MAP_COEFFICIENTS))
    ax.plot(*points, ".", color="white", markersize=1.5, clip_on=False)
    ax.figure.colorbar(shades, ax=ax, label=label)
    ax.set(xlabel=RPM, ylabel=r"static friction coefficient $f_s$")
    ax.grid(visible=False)


def map_table(runs: Runs) -> str:
    """Stick fraction, %."""
    those = zip(MAP_COEFFICIENTS, stick_map(runs), strict=True)
    rows = [(f"{f:g}", *(f"{100 * share:.0f}" for share in shares)) for f, shares in those]
    return table(("f_s", *(f"{speed} rpm" for speed in MAP_SPEEDS)), rows)


def map_words(runs: Runs) -> str:
    """The speed up to which the pad sticks all the time."""
    parts = []
    for f, shares in zip(MAP_COEFFICIENTS, stick_map(runs), strict=True):
        # the first speed at which it slides
        first = int(np.argmax(shares < 1)) if np.any(shares < 1) else len(shares)
        if first:
            parts.append(f"{MAP_SPEEDS[first - 1]} rpm (f_s = {f:g})")
    return f"The pad sticks all the time up to {', '.join(parts)}." if parts else ""


# ---- contact laws ----------------------------------------------------------------------------------------
def law_name(law: str, difference: int, friction: bool) -> str:
    return f"law_{list(LAWS).index(law)}_{difference}_{'ba' if friction else 'none'}"


LAW_CASES = tuple(
    shorter(Case(law_name(law, um, friction), case, (*overrides, f"pivot%radius_difference={um}e-6")))
    for law, overrides in LAWS.items()
    for um in LAW_DIFFERENCES
    for friction, case in ((False, FRICTIONLESS), (True, BA_10_10))
)


def laws_figure(runs: Runs) -> Figure:
    """Fig. 10 by other contact laws: without friction above, with it below."""
    fig, axes = panels(2)
    lines = []
    for row, friction in enumerate((False, True)):
        for color, law in enumerate(LAWS):
            for difference, dash in zip(LAW_DIFFERENCES, ("-", "--"), strict=True):
                run = runs[law_name(law, difference, friction)]
                look = {"color": f"C{color}", "linestyle": dash}
                lines.append((f"{law_text(law)}, $\\Delta R$ = {difference} µm", run, look))
                orbit_tilt_rate(axes[row], lines[-1:])
        axes[row][1].set_title("Bengisu-Akay, $f$ = 0.1" if friction else "frictionless")
    return legend(fig, lines[: len(lines) // 2], 3)


def laws_table(runs: Runs) -> str:
    """The influence of the laws on Fig. 10."""
    rows = []
    for friction, law, difference in product((False, True), LAWS, LAW_DIFFERENCES):
        run = runs[law_name(law, difference, friction)]
        part = tiltpad.last_revolutions(run, settings.LAST)
        pivot_deflection = of_pad(run, "pivot_deflection", part).mean()
        tilts = (1e3 * peak_to_peak(run, name) for name in TILTS)
        numbers = 1e6 * pivot_deflection, 1e6 * height(run), 1e6 * size(run), *tilts
        rows.append((law, difference, "0.1" if friction else "none", *map(digits, numbers)))
    measured = ("mean pivot deflection, um", "mean journal y, um", "orbit size, um")
    return table(("law", "dR, um", "friction", *measured, "tilt, mrad", "tilt rate, mrad/s"), rows)


# ---- unbalance rule --------------------------------------------------------------------------------------
#: Balance grades at 6500 rpm, and speeds at which rule (26) takes that speed or 6500 rpm.
GRADES = (0.4, 1, 2.5, 4, 6.3, 10)
RULE_SPEEDS = tuple(range(1500, 8501, 500))
RULE_CASES = tuple(
    shorter(Case(f"rule_{model}_{kind}_{value:g}", case, overrides))
    for model, case in (("none", FRICTIONLESS), ("lugre", LUGRE))
    for kind, values, make in (
        ("grade", GRADES, lambda grade: at_speed(6500, grade)),
        ("own", RULE_SPEEDS, at_speed),
        ("highest", RULE_SPEEDS, lambda speed: (*at_speed(speed), "rotor%balance_speed_rpm=6500")),
    )
    for value in values
    for overrides in [make(value)]
)


def rule_figure(runs: Runs) -> Figure:
    """Orbit size over the balance grade, and over the speed by the speed that rule (26) takes."""
    fig, axes = plt.subplots(1, 2, figsize=(PAGE, 2.6))
    for color, (model, words) in enumerate((("none", "frictionless"), ("lugre", "LuGre 0.1/0.05"))):
        sizes = [1e6 * size(runs[f"rule_{model}_grade_{grade:g}"]) for grade in GRADES]
        axes[0].plot(GRADES, sizes, "o-", color=f"C{color}", markersize=3, label=words)
        for kind, dash, which in (("own", "-", "own speed"), ("highest", "--", "6500 rpm")):
            sizes = 1e6 * rule_sizes(runs, model, kind)
            look = {"linestyle": dash, "color": f"C{color}", "markersize": 3}
            axes[1].plot(RULE_SPEEDS, sizes, "o", label=f"{words}, {which}", **look)
    table_1 = equivalent_grade(runs["rule_none_grade_1"])
    axes[0].axvline(table_1, color="0.4", linestyle=":", linewidth=0.8, label="Table 1")
    axes[0].set(xlabel="balance grade G (mm/s), at 6500 rpm", xlim=(0, None))
    axes[1].set(xlabel=RPM)
    for ax in axes:
        ax.set(ylabel="orbit size (µm)", ylim=(0, None))
        ax.legend()
    return fig


def rule_sizes(runs: Runs, model: str, kind: str) -> np.ndarray:
    """Size of the orbit at RULE_SPEEDS, m; model: none or lugre; kind: rule (26) takes its own or the
    highest speed.
    """
    return np.array([size(runs[f"rule_{model}_{kind}_{speed:g}"]) for speed in RULE_SPEEDS])


def rule_table(runs: Runs) -> str:
    """Size of the orbit over the speed, um, and its ratio with and without friction."""
    sizes = [rule_sizes(runs, model, kind) for kind in ("own", "highest") for model in ("none", "lugre")]
    numbers = np.transpose([*(1e6 * each for each in sizes), sizes[1] / sizes[0]])
    rows = [(speed, *map(digits, these)) for speed, these in zip(RULE_SPEEDS, numbers, strict=True)]
    heads = (f"{which}: frictionless, um" for which in ("its own", "6500 rpm"))
    both = (word for each in heads for word in (each, "LuGre 0.1/0.05, um"))
    return table(("speed, rpm", *both, "its own: LuGre over frictionless"), rows)


def rule_words(runs: Runs) -> str:
    """Where friction enlarges the orbit and where it does not, and where the orbits are largest."""
    none, lugre = (rule_sizes(runs, model, "own") for model in ("none", "lugre"))
    smaller = [speed for speed, ratio in zip(RULE_SPEEDS, lugre / none, strict=True) if ratio < 1]
    if not smaller:
        return "Friction enlarges the orbit at all these speeds."
    peaks = [RULE_SPEEDS[int(np.argmax(each))] for each in (none, lugre)]
    return (
        f"The orbit is largest at {peaks[0]} rpm without friction and at {peaks[1]} rpm with it. Friction "
        f"makes it smaller up to {max(smaller)} rpm and larger above: the paper's statement that friction "
        "enlarges the orbit is one about its speed of 6500 rpm."
    )


def ruled_unbalance(run: tiltpad.Run) -> float:
    """Unbalance that rule (26) gives for the paper's grade at the speed of a run, kg m."""
    return 1e-6 * 9549 * settings.GRADE * run.input["rotor"]["mass"] / run.input["operation"]["speed_rpm"]


def equivalent_grade(run: tiltpad.Run) -> float:
    """Grade for which rule (26) gives the unbalance of Table 1 at the speed of a run, mm/s."""
    return settings.GRADE * run.input["rotor"]["unbalance"] / ruled_unbalance(run)


#: Pictures from the runs of the studies, and from those of the figures.
FIGURES = {"map": map_figure, "laws": laws_figure, "rule": rule_figure}
REUSED = {"work": work_figure, "laws4": laws4}
#: The runs of the others.
CASES = (*MAP, *LAW_CASES, *RULE_CASES)
