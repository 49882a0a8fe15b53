"""Beyond the paper: where the synchronous orbit is lost, by branches over the speed; pictures and words."""

from itertools import product
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import tiltpad
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tiltpad.calculate import branches
from tiltpad.draw.branches import branch
from tiltpad.draw.layout import PAGE
from tiltpad.files.units import SHOWN

from paper.runs import Runs
from paper.settings import BA, FRICTIONLESS, LUGRE, ROOT, Case, coefficients
from paper.tables import digits, table

RPM = SHOWN["speed"].label
#: What happens where the orbit is lost or comes back, in a table.
HAPPENS = {"neimark_sacker": "torus bifurcation", "period_doubling": "period doubles", "fold": "turns back"}
#: The upper pad of the four-pad bearing that is shown.
UPPER = 3
#: Folder of the marches up and down, in that of the studies, and the step of their speed, rpm.
MARCHES, MARCH_STEP = "marches", 250
#: A motion is synchronous if the highest tilts of its last revolutions differ by less than this part.
ALIKE = 0.02
#: Branches of the synchronous orbit over the speed, rpm: laws of friction, static coefficients, the dynamic
#: ones half as large, and unbalances, kg m; that of Table 1 last.
LOST_LAWS = {"LuGre": LUGRE, "Bengisu-Akay": BA}
LOST_COEFFICIENTS = (0.02, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3)
LOST_UNBALANCES = (0.001, 0.010)
LOST_SPEEDS = (2000, 14000)


def over_speed(first: float, last: float, *, step: float, longest: float) -> tuple[str, ...]:
    """Overrides of a branch of orbits over the speed."""
    over = ("case%task=branch", 'branch%parameter="operation%speed_rpm"', f"operation%speed_rpm={first:g}")
    steps = (f"branch%last={last:g}", f"branch%step={step:g}", f"branch%max_step={longest:g}")
    return *over, *steps, "branch%switch=.false."


def lost_name(law: str, unbalance: float, coefficient: float) -> str:
    return f"lost_{law}_{unbalance:g}_{coefficient:g}"


#: The four-pad bearing: its synchronous orbit, and that of two revolutions, down from where it is found and
#: back again; speeds of its marches up and down.
FOUR = "input/examples/four_pads.nml"
FOUR_SPEEDS = (4000, 8500)
DOUBLED = ("periodic%revolutions=2", "branch%max_points=125", 'case%title="two revolutions"')
LOST = over_speed(*LOST_SPEEDS, step=100, longest=500)
CASES = (
    *(
        Case(
            lost_name(law, unbalance, f),
            case,
            (f"rotor%unbalance={unbalance:g}", *coefficients(f, f / 2), *LOST),
        )
        for law, case in LOST_LAWS.items()
        for unbalance in LOST_UNBALANCES
        for f in LOST_COEFFICIENTS
    ),
    Case("lost_none", FRICTIONLESS, LOST),
    Case("four_once", FOUR, (*over_speed(*FOUR_SPEEDS, step=50, longest=250), 'case%title="one revolution"')),
    Case("four_twice", FOUR, (*over_speed(6700, 5000, step=-50, longest=250), *DOUBLED)),
)


def march_up_and_down(folder: Path) -> None:
    """Marches of the four-pad bearing up and down its speeds, collected into a study."""
    speeds = range(FOUR_SPEEDS[0], FOUR_SPEEDS[1] + 1, MARCH_STEP)
    output = {"samples_per_revolution": 60}
    tiltpad.brute_force(ROOT / FOUR, "operation%speed_rpm", speeds, folder / MARCHES, output=output).close()


def lost_figure(runs: Runs) -> Figure:
    """Leading multiplier over the speed with the unbalance of Table 1; speeds of unstable orbits; by law."""
    fig, axes = plt.subplots(len(LOST_LAWS), 2, figsize=(PAGE, 6.2), sharex="col")
    for (left, right), law in zip(axes, LOST_LAWS, strict=True):
        draw_multiplier(left, runs["lost_none"], "0", {"color": "0.3", "linestyle": "--"})
        for k, f in enumerate(LOST_COEFFICIENTS):
            color = plt.get_cmap("viridis")(k / len(LOST_COEFFICIENTS))
            draw_multiplier(left, runs[lost_name(law, LOST_UNBALANCES[-1], f)], f"{f:g}", {"color": color})
        left.axhline(1, color="0.3", linewidth=0.8)
        left.set(title=law, ylabel="modulus of the leading multiplier", xlim=LOST_SPEEDS, ylim=(0, 1.6))
        left.legend(title="$f_s$", ncols=2, loc="upper left")
        for k, unbalance in enumerate(LOST_UNBALANCES):
            draw_unstable(right, runs, law, unbalance, f"C{k}", 4e-3 * (2 * k - 1))
        right.set(title=law, ylabel=RPM, xlim=(0, None), ylim=LOST_SPEEDS)
        right.legend(title="unstable, unbalance", loc="lower right")
    axes[-1, 0].set(xlabel=RPM)
    axes[-1, 1].set(xlabel="static friction coefficient $f_s$")
    return fig


def draw_multiplier(ax: Axes, run: tiltpad.Run, text: str, line: dict) -> None:
    leading = np.abs(branches.multipliers(run)[:, 0])
    ax.plot(run["parameter"], leading, label=text, **{"linewidth": 1.2} | line)


def draw_unstable(ax: Axes, runs: Runs, law: str, unbalance: float, color: str, beside: float) -> None:
    """A bar over the speeds at which the orbit is unstable, for each friction coefficient."""
    label = f"{unbalance:g} kg m"
    for f in LOST_COEFFICIENTS:
        for low, high in unstable(runs[lost_name(law, unbalance, f)]):
            ax.plot(2 * [f + beside], [low, high], color=color, linewidth=4, alpha=0.8, label=label)
            label = "_"
    if label != "_":
        ax.plot([], [], color=color, linewidth=4, label=f"{label}: nowhere")


def unstable(run: tiltpad.Run) -> list[tuple[float, float]]:
    """Lowest and highest speed of each unstable part of the first branch."""
    found = [each for each in branches.stretches(run) if not each.stable and each.branch == 1]
    speeds = [run["parameter"][each.points] for each in found]
    return [(float(each.min()), float(each.max())) for each in speeds]


def lost_table(runs: Runs) -> str:
    """Where the orbit becomes unstable and stable again, and what happens there."""
    cases = [(law, unbalance) for law in LOST_LAWS for unbalance in LOST_UNBALANCES]
    rows = []
    for f in LOST_COEFFICIENTS:
        those = (runs[lost_name(*case, f)] for case in cases)
        rows.append((f"{f:g}", *(unstable_words(run) or "never" for run in those)))
    return table(("f_s", *(f"{law}, unbalance {unbalance:g} kg m" for law, unbalance in cases)), rows)


def unstable_words(run: tiltpad.Run) -> str:
    """Speeds of the unstable parts, and what happens at their ends."""
    kinds = {round(each.parameter, 6): each.kind for each in branches.bifurcations(run)}

    def end(speed: float) -> str:
        happens = HAPPENS.get(kinds.get(round(speed, 6), ""), "end of the branch")
        return f"{speed:.0f} rpm ({happens})"

    return "; ".join(" to ".join(map(end, part)) for part in unstable(run))


def lost_words(runs: Runs) -> str:
    """Whether the frictionless orbit is lost, and how the two unbalances differ."""
    where = unstable_words(runs["lost_none"])
    stable = "the orbit is stable from {} to {} rpm".format(*LOST_SPEEDS)
    said = [f"Without friction {f'it is unstable {where}' if where else stable}."]
    for law, unbalance in product(LOST_LAWS, LOST_UNBALANCES):
        kept = [f for f in LOST_COEFFICIENTS if not unstable(runs[lost_name(law, unbalance, f)])]
        if kept:
            never = f"With {law} and the unbalance of {unbalance:g} kg m it is never lost in this range"
            said.append(f"{never} for f_s = {', '.join(f'{f:g}' for f in kept)}.")
    return " ".join(said)


def doubling_figure(runs: Runs) -> Figure:
    """Branches of one and of two revolutions of the four-pad bearing, over marches up and down."""
    with tiltpad.read_study(runs.folder / MARCHES / "study.h5") as study:
        return branch([runs["four_once"], runs["four_twice"], study], pad=UPPER)


def doubling_words(runs: Runs) -> str:
    """Where the orbits of the four-pad bearing are lost and appear, and what marches find."""
    once, twice = runs["four_once"], runs["four_twice"]
    crossed = []
    for each in branches.bifurcations(once):
        multiplier = f"{digits(each.value.real, 4)} +- {digits(abs(each.value.imag), 2)} i"
        happens = HAPPENS.get(each.kind, each.kind)
        crossed.append(f"{each.parameter:.0f} rpm ({happens}, multiplier {multiplier})")
    folds = [each.parameter for each in branches.bifurcations(twice) if each.kind == "fold"]
    leading = np.abs(branches.multipliers(twice)[:, 0])
    calm = bool(twice["stable"].any())
    said = [f"The synchronous orbit loses its stability at {', and again at '.join(crossed)}."]
    said += [f"Orbits of two revolutions exist from a fold at {folds[0]:.0f} rpm on."] if folds else []
    said.append(
        "Part of them is stable."
        if calm
        else "None of those followed is stable: at the least the leading multiplier is "
        f"{digits(leading.min(), 4)} in two revolutions, so that a slow beat of the upper pads remains."
    )
    return " ".join([*said, coexisting(runs)])


def coexisting(runs: Runs) -> str:
    """The speeds at which marches upwards are synchronous and those downwards are not, and how fast a flutter
    grows or dies there.
    """
    with tiltpad.read_study(runs.folder / MARCHES / "study.h5") as study:
        highest = study["highest_tilt"][..., UPPER - 1]
        spread = np.nanmax(highest, axis=1) - np.nanmin(highest, axis=1)
        alike = spread < ALIKE * np.abs(np.nanmean(highest, axis=1))
        marches = list(zip(study.speed_rpm, study.direction, alike, strict=True))
    up = {speed for speed, way, same in marches if way == "upwards" and same}
    down = {speed for speed, way, same in marches if way == "downwards" and not same}
    both = sorted(up & down)
    if not both:
        return "Marches upwards and downwards find the same motion at every speed."
    where = f"at {both[0]:.0f} rpm" if len(both) == 1 else f"from {both[0]:.0f} to {both[-1]:.0f} rpm"
    once = runs["four_once"]
    leading = np.abs(branches.multipliers(once)[:, 0])
    pace = np.abs(np.log(np.interp(both, once["parameter"], leading)))
    return (
        f"Marches upwards are synchronous {where}, where those downwards flutter. This does not prove that "
        "both motions last: by the leading multiplier a small flutter takes there "
        f"{1 / pace.max():.0f} to {1 / pace.min():.0f} revolutions to change by a factor of e."
    )


FIGURES = {"lost": lost_figure, "doubling": doubling_figure}
