"""The paper's statements of Secs. 3 and 4 and of Fig. 15: low speed, small unbalance, upper pads, run-up."""

import numpy as np
import tiltpad

from paper.judging import Claims, Verdict, above, below, larger
from paper.measures import breakaway, distance, size, speed_window
from paper.runs import Runs
from paper.settings import AGREEMENT, HIGH_SPEED, LAST, LOW_SPEED, MODELS, RESOLUTION, RUNUPS

CLAIMS = Claims()


# ---- operating conditions --------------------------------------------------------------------------------
@CLAIMS.add("Sec. 4", "At low speed, with the unbalance of that speed, the pads stay stuck")
def stuck_at_low_speed(runs: Runs) -> Verdict:
    """Maximum part of the static friction used, both pads and models, at the lowest speed of the paper;
    if it is below 1, no pivot breaks away.
    """
    return below(max(breakaway(runs[f"{model}_slow"]) for model in ("ba", "lugre")), 1 - RESOLUTION)


@CLAIMS.add("Sec. 4", "A lower unbalance causes a stick at the nominal speed")
def stuck_when_balanced(runs: Runs) -> Verdict:
    """This part of the static friction at 6500 rpm with balance grade G 1."""
    return below(max(breakaway(runs[f"{model}_fine"]) for model in ("ba", "lugre")), 1 - RESOLUTION)


@CLAIMS.add("Sec. 3", "The upper pads flutter")
def upper_pads_flutter(runs: Runs) -> Verdict:
    """Peak-to-peak tilt, upper over lower pads, the minimum of both upper ones, four pads with LuGre."""
    run = runs["four_pads"]
    tilt = np.ptp(run.values("pad_tilt", tiltpad.last_revolutions(run, LAST)), axis=0)
    return larger(float(tilt[2:].min() / tilt[:2].max()))


for suffix, words in (("", "LuGre"), ("_none", "frictionless")):

    @CLAIMS.add("Sec. 3", f"The upper pads change the orbit little, {words}")
    def upper_pads_matter_little(runs: Runs, end: str = suffix) -> Verdict:
        """Maximum distance of the paths with four and two pads at the same shaft angle, over the orbit's
        size; cavitation 'gumbel'.
        """
        return below(distance(runs[f"four_pads{end}"], runs[f"two_pads{end}"]), AGREEMENT)


# ---- run-up ----------------------------------------------------------------------------------------------
def runup_distance(runs: Runs, model: str, rpm: float) -> float:
    """Maximum distance of a run-up from that with Bengisu-Akay, over the orbit's size, from a speed on."""
    true = runs[RUNUPS["Bengisu-Akay"]]
    return distance(runs[RUNUPS[model]], true, speed_window(true, rpm, LAST))


@CLAIMS.add("Fig. 15", "In the run-up LuGre's trajectory deviates from Bengisu-Akay's at low speed")
def runups_differ_at_low_speed(runs: Runs) -> Verdict:
    """Maximum distance at the same shaft angle over the orbit's size, five revolutions from 2000 rpm; the
    smaller of both sigma_0.
    """
    return above(min(runup_distance(runs, model, LOW_SPEED) for model in list(RUNUPS)[1:]), AGREEMENT)


@CLAIMS.add("Fig. 15", "A higher sigma_0 strengthens this deviation")
def stiffness_strengthens_deviation(runs: Runs) -> Verdict:
    """This distance, sigma_0 = 5e6 over 1e6 1/m."""
    return larger(runup_distance(runs, "LuGre 5e6", LOW_SPEED) / runup_distance(runs, "LuGre 1e6", LOW_SPEED))


@CLAIMS.add("Fig. 15", "The journal orbits at 6500 rpm are comparable")
def runups_agree_at_high_speed(runs: Runs) -> Verdict:
    """This distance in the last five revolutions, the larger of both sigma_0."""
    return below(max(runup_distance(runs, model, HIGH_SPEED) for model in list(RUNUPS)[1:]), AGREEMENT)


@CLAIMS.add(
    "Fig. 15",
    "At low speed the tilt velocity with sigma_0 = 1e6 differs from Bengisu-Akay and higher sigma_0",
)
def soft_bristles_differ_at_low_speed(runs: Runs) -> Verdict:
    """Peak-to-peak tilt rate in five revolutions from 2000 rpm, sigma_0 = 1e6 1/m over the larger of the two
    others.
    """
    rates = {}
    for model, name in RUNUPS.items():
        part = speed_window(runs[name], LOW_SPEED, LAST)
        rates[model] = float(np.ptp(runs[name].values("pad_tilt_rate", part)[:, 0]))
    return larger(rates.pop("LuGre 1e6") / max(rates.values()))


@CLAIMS.add("Fig. 15", "The run-up does not greatly affect the influence of the friction models")
def runup_ends_as_steady_state(runs: Runs) -> Verdict:
    """Maximum distance of the last five revolutions from the steady run's over the orbit's size, all
    models.
    """
    pairs = [(name, MODELS[model][0]) for model, name in RUNUPS.items()]
    return below(max(aligned_distance(runs[a], runs[b]) for a, b in pairs), AGREEMENT)


def aligned_distance(run: tiltpad.Run, steady: tiltpad.Run) -> float:
    """Maximum distance of a run's last orbit from the nearest point of a steady orbit, over its size."""
    path, true = (np.column_stack(tiltpad.orbit(each, 1)) for each in (run, steady))
    gap = np.linalg.norm(path[:, None] - true[None], axis=2).min(axis=1)
    return float(gap.max() / size(steady))
