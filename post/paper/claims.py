"""The paper's statements, each decided by one number from the runs.

A claim is a function of the runs that returns a Verdict; its docstring says what is measured.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import tiltpad

from paper.laws import fang_force
from paper.measures import (
    acceleration,
    breakaway,
    distance,
    height,
    loop_width,
    off_curve,
    peak_to_peak,
    rms_deviation,
    size,
    speed_window,
    sticking,
    stribeck_curve,
)
from paper.runs import Runs
from paper.settings import (
    AGREEMENT,
    DIFFERENCES,
    FANG_DIFFERENCES,
    HIGH_SPEED,
    LAST,
    LOW_SPEED,
    MODELS,
    ON_CURVE,
    RESOLUTION,
    RESTS,
    RUNUPS,
    STIFFNESSES,
    VELOCITIES,
)


@dataclass(frozen=True)
class Verdict:
    """The number that decides, and what it must stay below or above."""

    value: float
    sense: str
    limit: float

    @property
    def holds(self) -> bool:
        return self.value < self.limit if self.sense == "<" else self.value > self.limit


@dataclass(frozen=True)
class Claim:
    """A statement of the paper."""

    name: str
    where: str
    statement: str
    measure: str
    judge: Callable[[Runs], Verdict]


CLAIMS: list[Claim] = []


def claim(where: str, statement: str) -> Callable:
    """Enters a function among CLAIMS; `where` is a figure or section of the paper."""

    def enter(judge: Callable[[Runs], Verdict]) -> Callable[[Runs], Verdict]:
        measure = " ".join(judge.__doc__.split())
        CLAIMS.append(Claim(judge.__name__, where, statement, measure, judge))
        return judge

    return enter


def smaller(value: float) -> Verdict:
    """A ratio clearly below 1."""
    return Verdict(value, "<", 1 - RESOLUTION)


def larger(value: float) -> Verdict:
    """A ratio clearly above 1."""
    return Verdict(value, ">", 1 + RESOLUTION)


def growth(values: Iterable[float]) -> float:
    """Least ratio of a value to the one before it."""
    return min(after / before for before, after in pairwise(values))


def fall(values: Iterable[float]) -> float:
    """Greatest ratio of a value to the one before it."""
    return max(after / before for before, after in pairwise(values))


def rate(runs: Runs, name: str) -> float:
    """Peak-to-peak of the tilt rate, rad/s."""
    return peak_to_peak(runs[name], "pad_tilt_rate")


# ---- contact and friction laws ---------------------------------------------------------------------------
@claim("Fig. 4", "The snug fit is the stiffest option: the larger dR, the smaller the force")
def snug_fit_stiffest(runs: Runs) -> Verdict:
    """Greatest ratio of the force to that of the next smaller dR at the same penetration, R_2 = 100 mm."""
    forces = [fang_force(difference)[1][1:] for difference in FANG_DIFFERENCES]
    return smaller(max(float((b / a).max()) for a, b in pairwise(forces)))


@claim("Fig. 6", "For gamma = 1 and chi = 1/v_s the Stribeck curve is equal for both models")
def one_stribeck_curve(runs: Runs) -> Verdict:
    """Greatest difference of (22) and (25) over f_s, at sliding velocities from v_c up."""
    bengisu, lugre = runs["steady_ba_20_10"], runs["steady_lugre_20_10"]
    law = bengisu.input["friction"]
    velocity = np.geomspace(law["critical_velocity"], 1e-2, 1000)
    gap = np.abs(stribeck_curve(bengisu, velocity) - stribeck_curve(lugre, velocity)).max()
    return Verdict(float(gap) / law["static_coefficient"], "<", ON_CURVE)


# ---- parameters of the friction models -------------------------------------------------------------------
@claim("Fig. 7", "With v_c = 1e-3 m/s only sliding occurs")
def coarse_velocity_slides(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude."""
    return Verdict(sticking(runs[VELOCITIES["1e-3"]]), "<", RESTS)


@claim("Fig. 7", "With lower v_c sticking is more apparent")
def fine_velocity_sticks(runs: Runs) -> Verdict:
    """The same, the least ratio of one v_c to the next higher."""
    return larger(growth(sticking(runs[name]) for name in VELOCITIES.values()))


@claim("Fig. 7", "With v_c = 1e-5 m/s the pads stick")
def fine_velocity_rests(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude."""
    return Verdict(sticking(runs[VELOCITIES["1e-5"]]), ">", RESTS)


@claim("Fig. 8", "For low sigma_0 almost no sticking occurs")
def soft_bristles_slide(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude; sigma_0 = 1e5 1/m."""
    return Verdict(sticking(runs[STIFFNESSES["1e5"]]), "<", RESTS)


@claim("Fig. 8", "With higher sigma_0 the pads stick")
def stiff_bristles_stick(runs: Runs) -> Verdict:
    """The same, the least of all sigma_0 from 1e6 1/m."""
    return Verdict(min(sticking(runs[name]) for name in list(STIFFNESSES.values())[1:]), ">", RESTS)


@claim("Sec. 3.1", "With a further increase of sigma_0 the results do not differ significantly")
def stiffness_saturates(runs: Runs) -> Verdict:
    """Root mean square of the difference of the tilt rates at the two highest sigma_0, over the tilt
    rate's.
    """
    return Verdict(
        rms_deviation(*(runs[name] for name in list(STIFFNESSES.values())[-2:]), "pad_tilt_rate"), "<", 0.1
    )


@claim("Sec. 3.1", "and only the required CPU time increases")
def stiffness_costs(runs: Runs) -> Verdict:
    """Steps of the march at the two highest sigma_0, the higher over the lower."""
    lower, higher = (runs[name].statistics["steps"] for name in list(STIFFNESSES.values())[-2:])
    return larger(float(higher / lower))


# ---- radial displacement ---------------------------------------------------------------------------------
@claim("Fig. 9", "TO yields smaller orbits than TR")
def tilting_only_smaller(runs: Runs) -> Verdict:
    """Size of the orbit (mean of its peak-to-peaks in y and z), frictionless, TO over TR."""
    return smaller(size(runs["steady_to"]) / size(runs["steady_tr"]))


@claim("Fig. 9", "TO orbits lie higher than TR")
def tilting_only_higher(runs: Runs) -> Verdict:
    """Mean height of TO above TR over the assembled clearance, frictionless."""
    return Verdict(
        (height(runs["steady_to"]) - height(runs["steady_tr"])) / runs["steady_tr"].clearance, ">", RESOLUTION
    )


@claim("Sec. 4.1", "Radial motion imposes a more significant tilting motion")
def radial_motion_tilts(runs: Runs) -> Verdict:
    """Peak-to-peak tilt, frictionless, TR over TO."""
    return larger(peak_to_peak(runs["steady_tr"], "pad_tilt") / peak_to_peak(runs["steady_to"], "pad_tilt"))


@claim("Fig. 9", "Friction enlarges the orbit of TO")
def friction_enlarges_tilting_only(runs: Runs) -> Verdict:
    """Size of the orbit, with friction over frictionless, TO."""
    return larger(size(runs["steady_to_ba"]) / size(runs["steady_to"]))


@claim("Fig. 9", "Friction enlarges the orbit of TR")
def friction_enlarges_tilting_radial(runs: Runs) -> Verdict:
    """Size of the orbit, with friction over frictionless, TR."""
    return larger(size(runs["steady_tr_ba"]) / size(runs["steady_tr"]))


@claim("Fig. 9", "The larger influence of friction occurs in TR")
def friction_more_in_tilting_radial(runs: Runs) -> Verdict:
    """What friction adds to the size of the orbit (with friction over frictionless, less 1), TR over TO."""
    only, radial = (
        size(runs[f"steady_{each}_ba"]) / size(runs[f"steady_{each}"]) - 1 for each in ("to", "tr")
    )
    return larger(radial / only)


# ---- radius difference -----------------------------------------------------------------------------------
def by_difference(runs: Runs, friction: int) -> list[tiltpad.Run]:
    """Runs in the order of their radius difference; friction: 0 without, 1 with."""
    return [runs[names[friction]] for names in DIFFERENCES.values()]


for column, words in enumerate(("frictionless", "with friction")):

    @claim("Fig. 10", f"A larger radius difference moves the journal downwards, {words}")
    def lowers(runs: Runs, friction: int = column) -> Verdict:
        """Least step down of the mean height from one dR to the next, over the assembled clearance."""
        found = by_difference(runs, friction)
        steps = [(height(a) - height(b)) / a.clearance for a, b in pairwise(found)]
        return Verdict(min(steps), ">", RESOLUTION)

    @claim("Fig. 10", f"... and raises the peak-to-peak tilt, {words}")
    def raises_tilt(runs: Runs, friction: int = column) -> Verdict:
        """Least ratio of the peak-to-peak tilt to that of the next smaller dR."""
        return larger(growth(peak_to_peak(run, "pad_tilt") for run in by_difference(runs, friction)))

    @claim("Fig. 10", f"... and the peak-to-peak tilt velocity, {words}")
    def raises_tilt_rate(runs: Runs, friction: int = column) -> Verdict:
        """Least ratio of the peak-to-peak tilt rate to that of the next smaller dR."""
        return larger(growth(peak_to_peak(run, "pad_tilt_rate") for run in by_difference(runs, friction)))

    @claim("Fig. 10", f"... and lets the journal perform larger orbits, {words}")
    def enlarges(runs: Runs, friction: int = column) -> Verdict:
        """Least ratio of the orbit's size to that of the next smaller dR."""
        return larger(growth(size(run) for run in by_difference(runs, friction)))


@claim("Fig. 10", "With friction the waveforms flatten due to sticking")
def friction_flattens(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude; the least of the three
    dR.
    """
    return Verdict(min(sticking(run) for run in by_difference(runs, 1)), ">", RESTS)


# ---- friction pairs --------------------------------------------------------------------------------------
#: Pairs of friction pairs whose second has both coefficients twice as large.
DOUBLED = ((0, 2), (1, 3))
#: Of which the second has the same f_s and a larger f_d.
DYNAMIC = ((0, 1), (2, 3))

for words in MODELS:

    @claim("Figs. 11-13", f"With increasing friction coefficients the orbit is larger, {words}")
    def orbit_grows(runs: Runs, model: str = words) -> Verdict:
        """Least ratio of the orbit's size to that of the pair before, one or both smaller."""
        sizes = [size(runs[name]) for name in MODELS[model]]
        return larger(min(sizes[b] / sizes[a] for a, b in DOUBLED + DYNAMIC))

    @claim("Figs. 11-13", f"... and the amplitude of the tilt velocity decreases, {words}")
    def amplitude_falls(runs: Runs, model: str = words) -> Verdict:
        """Greatest ratio of the peak-to-peak tilt rate to that of the pair before, one or both smaller."""
        rates = [rate(runs, name) for name in MODELS[model]]
        return smaller(max(rates[b] / rates[a] for a, b in DOUBLED + DYNAMIC))

    @claim("Figs. 11-13", f"Every friction lowers the amplitude below the frictionless one, {words}")
    def amplitude_below_frictionless(runs: Runs, model: str = words) -> Verdict:
        """Greatest peak-to-peak tilt rate of the four pairs, over that without friction."""
        return smaller(max(rate(runs, name) for name in MODELS[model]) / rate(runs, "steady_tr"))


@claim("Figs. 11-12", "The orbits for both models are comparable in size and shape")
def orbits_comparable(runs: Runs) -> Verdict:
    """Greatest distance of the paths of LuGre and Bengisu-Akay at the same shaft angle, over the orbit's
    size; the greatest of all pairs and both sigma_0.
    """
    others = MODELS["LuGre 1e6"] + MODELS["LuGre 5e6"]
    both = zip(others, 2 * MODELS["Bengisu-Akay"], strict=True)
    return Verdict(max(distance(runs[a], runs[b]) for a, b in both), "<", AGREEMENT)


@claim("Fig. 11", "With increasing friction coefficients the sticking areas are wider (both doubled)")
def sticking_wider_doubled(runs: Runs) -> Verdict:
    """Least ratio of the stick fraction to that with both coefficients half as large, Bengisu-Akay."""
    return larger(min(widening(runs, DOUBLED)))


@claim("Fig. 11", "With increasing friction coefficients the sticking areas are wider (f_d alone)")
def sticking_wider_dynamic(runs: Runs) -> Verdict:
    """Least ratio of the stick fraction to that with the same f_s and half the f_d, Bengisu-Akay."""
    return larger(min(widening(runs, DYNAMIC)))


def widening(runs: Runs, steps: tuple[tuple[int, int], ...]) -> list[float]:
    """Stick fractions, the second over the first of each step."""
    share = [tiltpad.stick_fraction(runs[name], 1, LAST) for name in MODELS["Bengisu-Akay"]]
    return [share[b] / share[a] for a, b in steps]


@claim("Fig. 12", "LuGre's transition between sticking and sliding is smoother than Bengisu-Akay's")
def lugre_smoother(runs: Runs) -> Verdict:
    """Greatest angular acceleration of the pad, LuGre 1e6 over Bengisu-Akay; the greatest of all pairs."""
    both = zip(MODELS["LuGre 1e6"], MODELS["Bengisu-Akay"], strict=True)
    return smaller(max(acceleration(runs[a]) / acceleration(runs[b]) for a, b in both))


@claim("Fig. 12", "The amplitude of the tilt velocity decreases more in LuGre than in Bengisu-Akay")
def amplitude_falls_more(runs: Runs) -> Verdict:
    """Peak-to-peak tilt rate, LuGre 1e6 over Bengisu-Akay; the greatest of all pairs."""
    both = zip(MODELS["LuGre 1e6"], MODELS["Bengisu-Akay"], strict=True)
    return smaller(max(rate(runs, a) / rate(runs, b) for a, b in both))


@claim("Fig. 13", "With increased sigma_0 the sticking phase is more distinct")
def sticking_more_distinct(runs: Runs) -> Verdict:
    """Least ratio of the stick fraction to that of the next lower sigma_0, 1e5 to 1e8 1/m."""
    return larger(growth(tiltpad.stick_fraction(runs[name], 1, LAST) for name in STIFFNESSES.values()))


@claim("Fig. 13", "As sigma_0 grows, LuGre tends to Bengisu-Akay in steady state")
def lugre_tends_to_bengisu_akay(runs: Runs) -> Verdict:
    """Root mean square deviation of the tilt rate from that of Bengisu-Akay: greatest ratio to that of the
    next lower sigma_0.
    """
    true = runs[MODELS["Bengisu-Akay"][0]]
    return smaller(fall(rms_deviation(runs[name], true, "pad_tilt_rate") for name in STIFFNESSES.values()))


@claim("Fig. 14", "Bengisu-Akay's characteristic is exactly the Stribeck curve")
def characteristic_is_the_curve(runs: Runs) -> Verdict:
    """Greatest distance of M_f/(F_bs R_1) from (22) over f_s, all pairs."""
    return Verdict(max(off_curve(runs[name]) for name in MODELS["Bengisu-Akay"]), "<", ON_CURVE)


@claim("Fig. 14", "LuGre's characteristic is a loop")
def characteristic_is_a_loop(runs: Runs) -> Verdict:
    """Greatest difference of the coefficient at one sliding velocity, speeding up and slowing down, over f_s;
    the least of all pairs and both sigma_0.
    """
    names = MODELS["LuGre 1e6"] + MODELS["LuGre 5e6"]
    return Verdict(min(loop_width(runs[name]) for name in names), ">", 0.1)


@claim("Fig. 14", "Loops appear with the higher sigma_0, with the lower they are not significant")
def loops_with_stiff_bristles(runs: Runs) -> Verdict:
    """The same width, sigma_0 = 5e6 over 1e6 1/m, the least of all pairs."""
    both = zip(MODELS["LuGre 5e6"], MODELS["LuGre 1e6"], strict=True)
    return larger(min(loop_width(runs[a]) / loop_width(runs[b]) for a, b in both))


# ---- operating conditions --------------------------------------------------------------------------------
@claim("Sec. 4", "At low speed, with the unbalance of that speed, the pads stay stuck")
def stuck_at_low_speed(runs: Runs) -> Verdict:
    """Greatest part of the static friction used, both pads and models, at the lowest speed of the paper;
    where it stays below 1 no pivot breaks away.
    """
    return Verdict(max(breakaway(runs[f"{model}_slow"]) for model in ("ba", "lugre")), "<", 1 - RESOLUTION)


@claim("Sec. 4", "A lower unbalance causes a stick at the nominal speed")
def stuck_when_balanced(runs: Runs) -> Verdict:
    """The same, at 6500 rpm with balance grade G 1."""
    return Verdict(max(breakaway(runs[f"{model}_fine"]) for model in ("ba", "lugre")), "<", 1 - RESOLUTION)


@claim("Sec. 3", "The upper pads flutter")
def upper_pads_flutter(runs: Runs) -> Verdict:
    """Peak-to-peak tilt, upper over lower pads, the least of both upper ones, four pads with LuGre."""
    run = runs["four_pads"]
    tilt = np.ptp(run.values("pad_tilt", tiltpad.last_revolutions(run, LAST)), axis=0)
    return larger(float(tilt[2:].min() / tilt[:2].max()))


for suffix, words in (("", "LuGre"), ("_none", "frictionless")):

    @claim("Sec. 3", f"The upper pads change the orbit little, {words}")
    def upper_pads_matter_little(runs: Runs, end: str = suffix) -> Verdict:
        """Greatest distance of the paths with four and two pads at the same shaft angle, over the orbit's
        size; cavitation 'gumbel'.
        """
        return Verdict(distance(runs[f"four_pads{end}"], runs[f"two_pads{end}"]), "<", AGREEMENT)


# ---- run-up ----------------------------------------------------------------------------------------------
def runup_distance(runs: Runs, model: str, rpm: float) -> float:
    """Greatest distance of a run-up from that with Bengisu-Akay, over the orbit's size, from a speed on."""
    true = runs[RUNUPS["Bengisu-Akay"]]
    return distance(runs[RUNUPS[model]], true, speed_window(true, rpm, LAST))


@claim("Fig. 15", "In the run-up LuGre's trajectory deviates from Bengisu-Akay's at low speed")
def runups_differ_at_low_speed(runs: Runs) -> Verdict:
    """Greatest distance at the same shaft angle over the orbit's size, five revolutions from 2000 rpm; the
    smaller of both sigma_0.
    """
    return Verdict(min(runup_distance(runs, model, LOW_SPEED) for model in list(RUNUPS)[1:]), ">", AGREEMENT)


@claim("Fig. 15", "A higher sigma_0 strengthens this deviation")
def stiffness_strengthens_deviation(runs: Runs) -> Verdict:
    """The same distance, sigma_0 = 5e6 over 1e6 1/m."""
    return larger(runup_distance(runs, "LuGre 5e6", LOW_SPEED) / runup_distance(runs, "LuGre 1e6", LOW_SPEED))


@claim("Fig. 15", "The journal orbits at 6500 rpm are comparable")
def runups_agree_at_high_speed(runs: Runs) -> Verdict:
    """The same distance in the last five revolutions, the greater of both sigma_0."""
    return Verdict(max(runup_distance(runs, model, HIGH_SPEED) for model in list(RUNUPS)[1:]), "<", AGREEMENT)


@claim(
    "Fig. 15",
    "At low speed the tilt velocity with sigma_0 = 1e6 differs from Bengisu-Akay and higher sigma_0",
)
def soft_bristles_differ_at_low_speed(runs: Runs) -> Verdict:
    """Peak-to-peak tilt rate in five revolutions from 2000 rpm, sigma_0 = 1e6 1/m over the greater of the two
    others.
    """
    rates = {}
    for model, name in RUNUPS.items():
        part = speed_window(runs[name], LOW_SPEED, LAST)
        rates[model] = float(np.ptp(runs[name].values("pad_tilt_rate", part)[:, 0]))
    return larger(rates.pop("LuGre 1e6") / max(rates.values()))


@claim("Fig. 15", "The run-up does not greatly affect the influence of the friction models")
def runup_ends_as_steady_state(runs: Runs) -> Verdict:
    """Greatest distance of the last five revolutions from the steady run's over the orbit's size, all
    models.
    """
    names = [MODELS[model][0] for model in RUNUPS]
    return Verdict(
        max(aligned_distance(runs[a], runs[b]) for a, b in zip(RUNUPS.values(), names, strict=True)),
        "<",
        AGREEMENT,
    )


def aligned_distance(run: tiltpad.Run, steady: tiltpad.Run) -> float:
    """Greatest distance of a run's last orbit from the nearest point of a steady orbit, over its size."""
    path, true = (np.column_stack(tiltpad.orbit(each, 1)) for each in (run, steady))
    gap = np.linalg.norm(path[:, None] - true[None], axis=2).min(axis=1)
    return float(gap.max() / size(steady))


# ---- why some do not hold --------------------------------------------------------------------------------
def why_amplitude(runs: Runs) -> str:
    """Evidence for amplitude_below_frictionless."""
    free, equal, half = (runs[name] for name in ("steady_tr", "steady_tr_ba", "steady_ba_10_05"))
    rates = [
        peak_to_peak(run, "pad_tilt_rate") / peak_to_peak(free, "pad_tilt_rate") for run in (equal, half)
    ]
    sizes = [size(run) / size(free) for run in (equal, half)]
    return (
        "The model, not the numerics. Friction holds the pad, but it also enlarges the orbit that drives "
        f"it ({sizes[0]:.3f} and {sizes[1]:.3f} times the frictionless one for Bengisu-Akay 0.1/0.1 and "
        f"0.1/0.05). With f_d = f_s the amplitude of the tilt velocity is {rates[0]:.3f} times the "
        "frictionless one; with f_d = f_s/2 the friction that falls away at break-away drives the pad as "
        f"well, and it is {rates[1]:.3f} times. Over the size of the orbit both fall "
        f"({rates[0] / sizes[0]:.3f} and {rates[1] / sizes[1]:.3f}). The paper compares with the "
        "frictionless case only for f_d = f_s (Figs. 9, 10), where it holds here too."
    )


def why_sticking(runs: Runs) -> str:
    """Evidence for sticking_wider_dynamic."""
    low, high = (runs[name] for name in MODELS["Bengisu-Akay"][:2])
    slip = [100 * (1 - tiltpad.stick_fraction(run, 1, LAST)) for run in (low, high)]
    ratio = peak_to_peak(high, "pad_tilt_rate") / peak_to_peak(low, "pad_tilt_rate")
    return (
        "The model, not the numerics, and a matter of reading. f_s decides when a pad breaks away, f_d "
        f"only acts while it slides: with 0.1/0.1 it slides more slowly than with 0.1/0.05 ({ratio:.3f} "
        f"times) and so takes longer to come to rest, {slip[1]:.1f} instead of {slip[0]:.1f} % of the "
        "time. The paper does not print its friction pairs; where both coefficients grow the statement "
        "holds."
    )


def why_loops(runs: Runs) -> str:
    """Evidence for loops_with_stiff_bristles."""
    widths = ", ".join(f"{loop_width(runs[name]):.3f} ({text} 1/m)" for text, name in STIFFNESSES.items())
    return (
        "The model, not the numerics: when the direction changes, the bristles must bend by 2 "
        "f_s/sigma_0 before the pivot slides, and the pad moves meanwhile. So the loop is wide where the "
        f"bristles are soft and closes as they stiffen; widths for 0.1/0.05: {widths}. With sigma_0 = 1e6 "
        "the larger friction pairs never reach the steady law (see the picture): what lacks there is the "
        "sliding part, with the shape known from textbooks, which the paper may mean by a typical loop."
    )


#: What is said of a claim that does not hold.
WHY = {
    "amplitude_below_frictionless": why_amplitude,
    "sticking_wider_dynamic": why_sticking,
    "loops_with_stiff_bristles": why_loops,
}


@dataclass(frozen=True)
class Checked:
    """A claim with its verdict from the runs, from the refined ones, and from those by rule (26)."""

    claim: Claim
    verdict: Verdict
    refined: Verdict
    rule: Verdict


def check(runs: Runs, refined: Runs, rule: Runs) -> list[Checked]:
    """All claims."""
    return [Checked(each, *map(each.judge, (runs, refined, rule))) for each in CLAIMS]
