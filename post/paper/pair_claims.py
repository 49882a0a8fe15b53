"""The paper's statements of Figs. 11 to 14: friction coefficients, and friction over sliding velocity."""

import tiltpad

from paper.judging import Claims, Verdict, above, below, fall, growth, larger, smaller
from paper.measures import (
    acceleration,
    distance,
    loop_width,
    off_curve,
    peak_to_peak,
    rms_deviation,
    size,
)
from paper.runs import Runs
from paper.settings import AGREEMENT, LAST, MODELS, ON_CURVE, STIFFNESSES

CLAIMS = Claims()


# ---- friction pairs --------------------------------------------------------------------------------------
#: Pairs of friction pairs whose second has both coefficients twice as large.
DOUBLED = ((0, 2), (1, 3))
#: Of which the second has the same f_s and a larger f_d.
DYNAMIC = ((0, 1), (2, 3))


def rate(runs: Runs, name: str) -> float:
    """Peak-to-peak of the tilt rate, rad/s."""
    return peak_to_peak(runs[name], "pad_tilt_rate")


for words in MODELS:

    @CLAIMS.add("Figs. 11-13", f"With increasing friction coefficients the orbit is larger, {words}")
    def orbit_grows(runs: Runs, model: str = words) -> Verdict:
        """Minimum ratio of the orbit's size to that of the pair before, one or both smaller."""
        sizes = [size(runs[name]) for name in MODELS[model]]
        return larger(min(sizes[b] / sizes[a] for a, b in DOUBLED + DYNAMIC))

    @CLAIMS.add("Figs. 11-13", f"... and the amplitude of the tilt velocity decreases, {words}")
    def amplitude_falls(runs: Runs, model: str = words) -> Verdict:
        """Maximum ratio of the peak-to-peak tilt rate to that of the pair before, one or both smaller."""
        rates = [rate(runs, name) for name in MODELS[model]]
        return smaller(max(rates[b] / rates[a] for a, b in DOUBLED + DYNAMIC))

    @CLAIMS.add("Figs. 11-13", f"Every friction lowers the amplitude below the frictionless one, {words}")
    def amplitude_below_frictionless(runs: Runs, model: str = words) -> Verdict:
        """Maximum peak-to-peak tilt rate of the four pairs, over that without friction."""
        return smaller(max(rate(runs, name) for name in MODELS[model]) / rate(runs, "steady_tr"))


@CLAIMS.add("Figs. 11-12", "The orbits for both models are comparable in size and shape")
def orbits_comparable(runs: Runs) -> Verdict:
    """Maximum distance of the paths of LuGre and Bengisu-Akay at the same shaft angle, over the orbit's
    size; the maximum of all pairs and both sigma_0.
    """
    others = MODELS["LuGre 1e6"] + MODELS["LuGre 5e6"]
    both = zip(others, 2 * MODELS["Bengisu-Akay"], strict=True)
    return below(max(distance(runs[a], runs[b]) for a, b in both), AGREEMENT)


@CLAIMS.add("Fig. 11", "With increasing friction coefficients the sticking areas are wider (both doubled)")
def sticking_wider_doubled(runs: Runs) -> Verdict:
    """Minimum ratio of the stick fraction to that with both coefficients half as large, Bengisu-Akay."""
    return larger(min(widening(runs, DOUBLED)))


@CLAIMS.add("Fig. 11", "With increasing friction coefficients the sticking areas are wider (f_d alone)")
def sticking_wider_dynamic(runs: Runs) -> Verdict:
    """Minimum ratio of the stick fraction to that with the same f_s and half the f_d, Bengisu-Akay."""
    return larger(min(widening(runs, DYNAMIC)))


def widening(runs: Runs, steps: tuple[tuple[int, int], ...]) -> list[float]:
    """Stick fractions, the second over the first of each step."""
    share = [tiltpad.stick_fraction(runs[name], 1, LAST) for name in MODELS["Bengisu-Akay"]]
    return [share[b] / share[a] for a, b in steps]


@CLAIMS.add("Fig. 12", "LuGre's transition between sticking and sliding is smoother than Bengisu-Akay's")
def lugre_smoother(runs: Runs) -> Verdict:
    """Maximum angular acceleration of the pad, LuGre 1e6 over Bengisu-Akay; the maximum of all pairs."""
    both = zip(MODELS["LuGre 1e6"], MODELS["Bengisu-Akay"], strict=True)
    return smaller(max(acceleration(runs[a]) / acceleration(runs[b]) for a, b in both))


@CLAIMS.add("Fig. 12", "The amplitude of the tilt velocity decreases more in LuGre than in Bengisu-Akay")
def amplitude_falls_more(runs: Runs) -> Verdict:
    """Peak-to-peak tilt rate, LuGre 1e6 over Bengisu-Akay; the maximum of all pairs."""
    both = zip(MODELS["LuGre 1e6"], MODELS["Bengisu-Akay"], strict=True)
    return smaller(max(rate(runs, a) / rate(runs, b) for a, b in both))


@CLAIMS.add("Fig. 13", "With increased sigma_0 the sticking phase is more distinct")
def sticking_more_distinct(runs: Runs) -> Verdict:
    """Minimum ratio of the stick fraction to that of the next lower sigma_0, 1e5 to 1e8 1/m."""
    return larger(growth(tiltpad.stick_fraction(runs[name], 1, LAST) for name in STIFFNESSES.values()))


@CLAIMS.add("Fig. 13", "As sigma_0 grows, LuGre tends to Bengisu-Akay in steady state")
def lugre_tends_to_bengisu_akay(runs: Runs) -> Verdict:
    """Root mean square deviation of the tilt rate from that of Bengisu-Akay: maximum ratio to that of the
    next lower sigma_0.
    """
    true = runs[MODELS["Bengisu-Akay"][0]]
    return smaller(fall(rms_deviation(runs[name], true, "pad_tilt_rate") for name in STIFFNESSES.values()))


@CLAIMS.add("Fig. 14", "Bengisu-Akay's characteristic is exactly the Stribeck curve")
def characteristic_is_the_curve(runs: Runs) -> Verdict:
    """Maximum distance of M_f/(F_bs R_1) from (22) over f_s, all pairs."""
    return below(max(off_curve(runs[name]) for name in MODELS["Bengisu-Akay"]), ON_CURVE)


@CLAIMS.add("Fig. 14", "LuGre's characteristic is a loop")
def characteristic_is_a_loop(runs: Runs) -> Verdict:
    """Maximum difference of the coefficient at one sliding velocity, speeding up and slowing down, over f_s;
    the minimum of all pairs and both sigma_0.
    """
    names = MODELS["LuGre 1e6"] + MODELS["LuGre 5e6"]
    return above(min(loop_width(runs[name]) for name in names), 0.1)


@CLAIMS.add("Fig. 14", "Loops appear with the higher sigma_0, with the lower they are not significant")
def loops_with_stiff_bristles(runs: Runs) -> Verdict:
    """Width of this loop, sigma_0 = 5e6 over 1e6 1/m, the minimum of all pairs."""
    both = zip(MODELS["LuGre 5e6"], MODELS["LuGre 1e6"], strict=True)
    return larger(min(loop_width(runs[a]) / loop_width(runs[b]) for a, b in both))
