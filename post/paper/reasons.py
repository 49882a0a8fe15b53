"""Why some of the claims do not hold, with the numbers that show it."""

import tiltpad

from paper.measures import loop_width, peak_to_peak, size
from paper.runs import Runs
from paper.settings import LAST, MODELS, STIFFNESSES


def why_amplitude(runs: Runs) -> str:
    """Evidence for amplitude_below_frictionless."""
    free, equal, half = (runs[name] for name in ("steady_tr", "steady_tr_ba", "steady_ba_10_05"))
    rate, *rates = (peak_to_peak(run, "pad_tilt_rate") for run in (free, equal, half))
    rates = [each / rate for each in rates]
    sizes = [size(run) / size(free) for run in (equal, half)]
    return (
        "The reason is the model, not the numerics. Friction holds the pad, but it also enlarges the "
        f"orbit that drives it ({sizes[0]:.3f} and {sizes[1]:.3f} times the frictionless one for "
        "Bengisu-Akay 0.1/0.1 and 0.1/0.05). With f_d = f_s the amplitude of the tilt velocity is "
        f"{rates[0]:.3f} times the frictionless one; with f_d = f_s/2 the drop of friction at "
        f"break-away drives the pad as well, and it is {rates[1]:.3f} times. Divided by the size of "
        f"the orbit, both are below 1 ({rates[0] / sizes[0]:.3f} and {rates[1] / sizes[1]:.3f}). The "
        "paper compares with the frictionless case only for f_d = f_s (Figs. 9, 10), where it holds "
        "here too."
    )


def why_sticking(runs: Runs) -> str:
    """Evidence for sticking_wider_dynamic."""
    low, high = (runs[name] for name in MODELS["Bengisu-Akay"][:2])
    slip = [100 * (1 - tiltpad.stick_fraction(run, 1, LAST)) for run in (low, high)]
    ratio = peak_to_peak(high, "pad_tilt_rate") / peak_to_peak(low, "pad_tilt_rate")
    return (
        "The reason is the model, not the numerics, and the claim can be read in two ways. f_s "
        "determines when a pad breaks away, and f_d acts only while it slides. With 0.1/0.1 the pad "
        f"slides more slowly than with 0.1/0.05 ({ratio:.3f} times), so it takes longer to come to "
        f"rest: it slides for {slip[1]:.1f} instead of {slip[0]:.1f} % of the time. The paper does not "
        "print its pairs of friction coefficients; if both coefficients grow, the claim holds."
    )


def why_loops(runs: Runs) -> str:
    """Evidence for loops_with_stiff_bristles."""
    widths = ", ".join(f"{loop_width(runs[name]):.3f} ({text} 1/m)" for text, name in STIFFNESSES.items())
    return (
        "The reason is the model, not the numerics. When the direction changes, the bristles must "
        "bend by 2 f_s/sigma_0 before the pivot slides, and the pad moves during this time. The loop "
        "is therefore wide for soft bristles and narrow for stiff ones; its widths for 0.1/0.05 are "
        f"{widths}. With sigma_0 = 1e6 the pairs with larger coefficients never reach the steady law "
        "(see the picture). Their loops have no sliding part with the shape known from textbooks, "
        "which the paper may mean by a typical loop."
    )


#: Reasons by the name of the claim.
WHY = {
    "amplitude_below_frictionless": why_amplitude,
    "sticking_wider_dynamic": why_sticking,
    "loops_with_stiff_bristles": why_loops,
}
