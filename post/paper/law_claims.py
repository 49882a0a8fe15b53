"""The paper's statements of Figs. 4 to 10: contact and friction laws, their parameters, radial motion."""

from itertools import pairwise

import numpy as np
import tiltpad

from paper.judging import Claims, Verdict, above, below, growth, larger, smaller
from paper.laws import FANG_DIFFERENCES, fang_force
from paper.measures import (
    height,
    peak_to_peak,
    rms_deviation,
    size,
    static_coefficient,
    sticking,
    stribeck_curve,
)
from paper.runs import Runs
from paper.settings import DIFFERENCES, ON_CURVE, RESOLUTION, STICKS, STIFFNESSES, VELOCITIES

CLAIMS = Claims()


# ---- contact and friction laws ---------------------------------------------------------------------------
@CLAIMS.add("Fig. 4", "The snug fit is the stiffest option: the larger dR, the smaller the force")
def snug_fit_stiffest(runs: Runs) -> Verdict:
    """Maximum ratio of the force to that of the next smaller dR at the same pivot deflection, R_2 = 100
    mm."""
    forces = [fang_force(difference)[1][1:] for difference in FANG_DIFFERENCES]
    return smaller(max(float((b / a).max()) for a, b in pairwise(forces)))


@CLAIMS.add("Fig. 6", "For gamma = 1 and chi = 1/v_s the Stribeck curve is equal for both models")
def one_stribeck_curve(runs: Runs) -> Verdict:
    """Maximum difference of (22) and (25) over f_s, at sliding velocities from v_c up."""
    bengisu, lugre = runs["steady_ba_20_10"], runs["steady_lugre_20_10"]
    law = bengisu.input["friction"]
    velocity = np.geomspace(law["critical_velocity"], 1e-2, 1000)
    gap = np.abs(stribeck_curve(bengisu, velocity) - stribeck_curve(lugre, velocity)).max()
    return below(float(gap) / static_coefficient(bengisu), ON_CURVE)


# ---- parameters of the friction models -------------------------------------------------------------------
@CLAIMS.add("Fig. 7", "With v_c = 1e-3 m/s only sliding occurs")
def coarse_velocity_slides(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude."""
    return below(sticking(runs[VELOCITIES["1e-3"]]), STICKS)


@CLAIMS.add("Fig. 7", "With lower v_c sticking is more apparent")
def fine_velocity_sticks(runs: Runs) -> Verdict:
    """Minimum ratio of this time for one v_c to that for the next higher v_c."""
    return larger(growth(sticking(runs[name]) for name in VELOCITIES.values()))


@CLAIMS.add("Fig. 7", "With v_c = 1e-5 m/s the pads stick")
def fine_velocity_rests(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude."""
    return above(sticking(runs[VELOCITIES["1e-5"]]), STICKS)


@CLAIMS.add("Fig. 8", "For low sigma_0 almost no sticking occurs")
def soft_bristles_slide(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude; sigma_0 = 1e5 1/m."""
    return below(sticking(runs[STIFFNESSES["1e5"]]), STICKS)


@CLAIMS.add("Fig. 8", "With higher sigma_0 the pads stick")
def stiff_bristles_stick(runs: Runs) -> Verdict:
    """Minimum of this time over all sigma_0 from 1e6 1/m."""
    return above(min(sticking(runs[name]) for name in list(STIFFNESSES.values())[1:]), STICKS)


@CLAIMS.add("Sec. 3.1", "With a further increase of sigma_0 the results do not differ significantly")
def stiffness_saturates(runs: Runs) -> Verdict:
    """Root mean square of the difference of the tilt rates at the two highest sigma_0, over the tilt
    rate's.
    """
    lower, higher = (runs[name] for name in list(STIFFNESSES.values())[-2:])
    return below(rms_deviation(lower, higher, "pad_tilt_rate"), 0.1)


@CLAIMS.add("Sec. 3.1", "and only the required CPU time increases")
def stiffness_costs(runs: Runs) -> Verdict:
    """Steps of the march at the two highest sigma_0, the higher over the lower."""
    lower, higher = (runs[name].statistics["steps"] for name in list(STIFFNESSES.values())[-2:])
    return larger(float(higher / lower))


# ---- radial displacement ---------------------------------------------------------------------------------
@CLAIMS.add("Fig. 9", "TO yields smaller orbits than TR")
def tilting_only_smaller(runs: Runs) -> Verdict:
    """Size of the orbit (mean of its peak-to-peaks in y and z), frictionless, TO over TR."""
    return smaller(size(runs["steady_to"]) / size(runs["steady_tr"]))


@CLAIMS.add("Fig. 9", "TO orbits lie higher than TR")
def tilting_only_higher(runs: Runs) -> Verdict:
    """Mean height of TO above TR over the bearing clearance, frictionless."""
    only, radial = runs["steady_to"], runs["steady_tr"]
    return above((height(only) - height(radial)) / radial.clearance, RESOLUTION)


@CLAIMS.add("Sec. 4.1", "Radial motion imposes a more significant tilting motion")
def radial_motion_tilts(runs: Runs) -> Verdict:
    """Peak-to-peak tilt, frictionless, TR over TO."""
    return larger(peak_to_peak(runs["steady_tr"], "pad_tilt") / peak_to_peak(runs["steady_to"], "pad_tilt"))


@CLAIMS.add("Fig. 9", "Friction enlarges the orbit of TO")
def friction_enlarges_tilting_only(runs: Runs) -> Verdict:
    """Size of the orbit, with friction over frictionless, TO."""
    return larger(size(runs["steady_to_ba"]) / size(runs["steady_to"]))


@CLAIMS.add("Fig. 9", "Friction enlarges the orbit of TR")
def friction_enlarges_tilting_radial(runs: Runs) -> Verdict:
    """Size of the orbit, with friction over frictionless, TR."""
    return larger(size(runs["steady_tr_ba"]) / size(runs["steady_tr"]))


@CLAIMS.add("Fig. 9", "The larger influence of friction occurs in TR")
def friction_more_in_tilting_radial(runs: Runs) -> Verdict:
    """Growth of the orbit by friction (size with friction over frictionless, minus 1), TR over TO."""
    only, radial = (
        size(runs[f"steady_{each}_ba"]) / size(runs[f"steady_{each}"]) - 1 for each in ("to", "tr")
    )
    return larger(radial / only)


# ---- radius difference -----------------------------------------------------------------------------------
def by_difference(runs: Runs, friction: int) -> list[tiltpad.Run]:
    """Runs in the order of their radius difference; friction: 0 without, 1 with."""
    return [runs[names[friction]] for names in DIFFERENCES.values()]


for column, words in enumerate(("frictionless", "with friction")):

    @CLAIMS.add("Fig. 10", f"A larger radius difference moves the journal downwards, {words}")
    def lowers(runs: Runs, friction: int = column) -> Verdict:
        """Minimum step down of the mean height from one dR to the next, over the bearing clearance."""
        found = by_difference(runs, friction)
        steps = [(height(a) - height(b)) / a.clearance for a, b in pairwise(found)]
        return above(min(steps), RESOLUTION)

    @CLAIMS.add("Fig. 10", f"... and raises the peak-to-peak tilt, {words}")
    def raises_tilt(runs: Runs, friction: int = column) -> Verdict:
        """Minimum ratio of the peak-to-peak tilt to that of the next smaller dR."""
        return larger(growth(peak_to_peak(run, "pad_tilt") for run in by_difference(runs, friction)))

    @CLAIMS.add("Fig. 10", f"... and the peak-to-peak tilt velocity, {words}")
    def raises_tilt_rate(runs: Runs, friction: int = column) -> Verdict:
        """Minimum ratio of the peak-to-peak tilt rate to that of the next smaller dR."""
        return larger(growth(peak_to_peak(run, "pad_tilt_rate") for run in by_difference(runs, friction)))

    @CLAIMS.add("Fig. 10", f"... and lets the journal perform larger orbits, {words}")
    def enlarges(runs: Runs, friction: int = column) -> Verdict:
        """Minimum ratio of the orbit's size to that of the next smaller dR."""
        return larger(growth(size(run) for run in by_difference(runs, friction)))


@CLAIMS.add("Fig. 10", "With friction the waveforms flatten due to sticking")
def friction_flattens(runs: Runs) -> Verdict:
    """Time below the stick velocity, over that of a sinusoid of the same amplitude; the minimum of the three
    dR.
    """
    return above(min(sticking(run) for run in by_difference(runs, 1)), STICKS)
