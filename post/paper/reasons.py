"""Why some of the claims do not hold, with the numbers that show it."""

import tiltpad

from paper.measures import (
    loop_width,
    peak_to_peak,
    size,
)
from paper.runs import Runs
from paper.settings import (
    LAST,
    MODELS,
    STIFFNESSES,
)


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


#: Reasons by the name of the claim.
WHY = {
    "amplitude_below_frictionless": why_amplitude,
    "sticking_wider_dynamic": why_sticking,
    "loops_with_stiff_bristles": why_loops,
}
