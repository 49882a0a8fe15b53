"""The page that says what the study of realistic bearings found."""

from collections import Counter

from bearing_runs import DISTURBANCE, LIMIT, REVOLUTIONS, ROTOR_TIME, SETTLED, Bearing
from bearings import FAST_ABOVE, TURBULENT
from cost_tables import SHORT, longest, microseconds, most_steps, steps, times
from error_tables import (
    SENSITIVE,
    curve,
    distribution,
    errors,
    numbers,
    on_curve,
    sensitive,
    unsensitive,
    worst,
)
from fixed_bearings import FIXED_ABOVE, KINDS
from march_errors import LAST, POWER, REPEATS, UNLOADED
from report import reason, table
from stress_judge import cause_of
from tiltpad.calculate.deviations import STEADY

PAGE = """\
# Realistic bearings

{count} bearings as designers draw them (seed {seed}; `tests/realistic/bearings.py` has the ranges and
where they come from): three to six pads, journals of 30 to 500 mm, 0.1 to 4 MPa, 5 to 90 m/s, preload 0
to 0.6, load on and between pivots, with and without friction. Each has the minimum film thickness of ISO
7902-3 by a plane slider's formula, a laminar film, and pivots that carry their load. This command wrote
the page:

    make realistic BEARINGS={count} SEED={seed}

Each bearing is marched from its equilibrium over {rotor_time:g} s, at least {revolutions} revolutions,
with the default settings. From the end of this march it is marched on over {revolutions} revolutions with
several settings, of which the closest is `integration%relative_tolerance = 1e-6`: the march and the
tables, whose tolerance follows it, are ten times closer than by default, so that an error is known to
about a tenth of itself. It is the difference from this march over the last {last} revolutions: of the
mean value of each signal, of the sizes of its motion above and below the mean (means of the power
{power}) and of its part at the speed of the shaft, in size and phase. The phase of a pad that flutters is
in none of these; it drifts without any error of the motion. Errors of the journal are relative to the
larger peak-to-peak value of its orbit, those of a pad's tilt to its peak-to-peak value, but at least to
{steady:.0%} of the bearing clearance, and of the clearance over the pad's radius (as in
[benchmarks](benchmarks.md)); those of minimum film thickness, highest pressure (their extremes) and pivot
force to the value itself. A pad is unloaded where its pivot bears less than {unloaded:.0%} of the load in
the mean.

A bearing is *sensitive* where a load changed by {disturbance:g} of itself, marched with the closest
settings, moves the journal by more than {journal:g} or a tilt by more than {tilt:g} in the same measure.
No solver can follow these; they are left out of the errors: {sensitive}.

## Outcomes

{outcomes}

## Errors of the default settings

{compared} bearings that are not sensitive:

{errors}

The largest errors:

{worst}

![Error against time of the default and of other table tolerances](images/realistic.png)

## Tables: error against time

{curve_count} of the bearings with other tolerances of the tables (`film%table_tolerance`), of the march
(`integration%relative_tolerance`) and of both, and films
without tables (`direct`); time of the {revolutions} revolutions:

{curve}

## Steps

Accepted steps per revolution of the march from the equilibrium:

{steps}

The bearings with the most:

{most_steps}

## Time

CPU seconds for {rotor_time:g} s of rotor (the same march), the part of it that builds tables (wall time),
and the time of the {revolutions} revolutions over that with `direct` (over {short:g} s, where `direct`
takes less):

{times}

The longest marches:

{longest}

## Refusals

Equilibria and marches that are refused or do not end within {limit} s of CPU time:

{refusals}

Periodic orbits (task `periodic`) from the equilibrium. A march repeats where each of its last revolutions
differs by less than {repeats:g} of the characteristic scales from that of one to four revolutions before:

{orbits}

Refused though the march repeats after one revolution: {missed}.
{fast}{fixed}"""

FAST = """
## Turbulent films

{count} more are fast bearings, 50 to 150 m/s, of 100 mm and more, with Reynolds numbers of {low} to
{high} at the clearance of their pads and turbulent films (`film%turbulence = 'ng_pan'`): {numbers}. They
are in no table above.

{outcomes}

{compared} bearings that are not sensitive; sensitive are: {sensitive}.

{errors}

{times}

Equilibria and marches that are refused or do not end within {limit} s of CPU time:

{refusals}
"""

FIXED = """
## Fixed pads

{count} more have fixed pads (`tests/realistic/fixed_bearings.py`): {kinds}
in turn, with L/D of 0.3 to 1.2, preloads of lobes up to 0.6, Sommerfeld numbers of 0.05 to 2 and
unbalance, at half to twice the speed at which rotors whirl in most of them: {numbers}.
They are in no table above. Marches that do not repeat after a few revolutions, as the journal whirls:
{whirling}.

{outcomes}

{compared} bearings that are not sensitive; sensitive are: {sensitive}.

{errors}

Accepted steps per revolution, the time of a step of the march from the equilibrium in microseconds, with
all that builds tables and writes, and other times as above:

{steps}

{microseconds}

{times}

Equilibria and marches that are refused or do not end within {limit} s of CPU time:

{refusals}
"""


def page(bearings: list[Bearing], seed: int) -> str:
    """The whole page."""
    fixed = [bearing for bearing in bearings if bearing.number > FIXED_ABOVE]
    bearings = [bearing for bearing in bearings if bearing.number <= FIXED_ABOVE]
    fast = [bearing for bearing in bearings if bearing.number > FAST_ABOVE]
    bearings = [bearing for bearing in bearings if bearing.number <= FAST_ABOVE]
    compared = [bearing for bearing in bearings if bearing.compared]
    left_out = [bearing for bearing in compared if sensitive(bearing)]
    kept = unsensitive(bearings)
    curve_bearings = [bearing for bearing in kept if on_curve(bearing)]
    longs = marched(bearings)
    return PAGE.format(
count=len(bearings), repeats=REPEATS, seed=seed, revolutions=REVOLUTIONS, last=LAST, steady=STEADY,
        unloaded=UNLOADED, disturbance=DISTURBANCE, journal=SENSITIVE["journal"],
        tilt=SENSITIVE["tilt_loaded"],
        sensitive=numbers(left_out), outcomes=outcomes(bearings, compared),
        compared=len(kept), errors=errors(kept), worst=worst(kept), curve_count=len(curve_bearings),
        curve=curve(curve_bearings), rotor_time=ROTOR_TIME, steps=steps(longs), most_steps=most_steps(longs),
        short=SHORT, times=times(longs), longest=longest(longs), limit=LIMIT, power=POWER,
        refusals=refusals(bearings),
        orbits=orbits(bearings), missed=numbers([bearing for bearing in bearings if missed_orbit(bearing)]),
        fast=of_others(fast, FAST, low=TURBULENT[0], high=TURBULENT[1]) if fast else "",
        fixed=of_fixed(fixed) if fixed else "",
    )  # fmt: skip


def of_others(bearings: list[Bearing], section: str, **more) -> str:
    """The section on bearings that are in no other table."""
    compared = [bearing for bearing in bearings if bearing.compared]
    kept = unsensitive(bearings)
    return section.format(
        count=len(bearings),
        numbers=f"{bearings[0].number} to {bearings[-1].number}",
        outcomes=outcomes(bearings, compared),
        compared=len(kept),
        sensitive=numbers([bearing for bearing in compared if sensitive(bearing)]),
        errors=errors(kept),
        times=times(marched(bearings)),
        limit=LIMIT,
        refusals=refusals(bearings),
        **more,
    )


def of_fixed(bearings: list[Bearing]) -> str:
    """The section on fixed pads."""
    longs = marched(bearings)
    return of_others(
        bearings,
        FIXED,
        kinds=", ".join(KINDS),
        whirling=sum(not bearing.period for bearing in longs),
        steps=steps(longs),
        microseconds=microseconds(longs),
    )


def marched(bearings: list[Bearing]) -> list[Bearing]:
    """Bearings whose long march came far enough."""
    return [bearing for bearing in bearings if bearing.runs["long"].revolutions >= SETTLED]


def missed_orbit(bearing: Bearing) -> bool:
    """Whether an orbit was refused that a march finds."""
    return not bearing.runs["periodic"].complete and bearing.period == 1


def line(bearing: Bearing) -> str:
    """What was found of a bearing, in a line."""
    said = ", ".join(f"{name} {run.outcome} {run.seconds:.2f} s" for name, run in bearing.runs.items())
    errors = bearing.runs["default"].errors if "default" in bearing.runs else {}
    found = " ".join(f"{name} {value:.1e}" for name, value in errors.items())
    return f"{bearing.number}: {bearing.runs['long'].rate:.0f} steps a revolution; {said}; {found}"


def outcomes(bearings: list[Bearing], compared: list[Bearing]) -> str:
    """How the runs ended."""
    names = {"long": f"march of {ROTOR_TIME:g} s", "closest": "closest", "default": "default",
             "direct": "direct", "disturbed": "disturbed", "periodic": "periodic orbit"}  # fmt: skip
    ends = ("complete", "refused", "time limit")
    found = Counter(
        (name, bearing.runs[name].outcome) for bearing in bearings for name in names if name in bearing.runs
    )
    others = sorted({end for _, end in found} - set(ends))
    rows = [(words, *(found[name, end] for end in (*ends, *others))) for name, words in names.items()]
    started = sum(bool(bearing.refusal) for bearing in bearings)
    said = f"{len(compared)} bearings are compared; {started} start where a refusal offers."
    return f"{table(('run', *ends, *others), rows)}\n\n{said}"


def refusals(bearings: list[Bearing]) -> str:
    """Refused equilibria and marches, with the bearings."""
    found: dict[str, list[Bearing]] = {}
    for bearing in bearings:
        run = bearing.runs["long"]
        if bearing.refusal:
            cause = cause_of(bearing.refusal) or reason(bearing.refusal)
            found.setdefault(
                f"no equilibrium: {cause}; march from the offered start: {run.outcome}", []
            ).append(bearing)
        elif not run.complete:
            found.setdefault(reason(run.message), []).append(bearing)
    rows = [(words, len(own), numbers(own)) for words, own in sorted(found.items())]
    return table(("reason", "bearings", "numbers"), rows) if rows else "None."


def orbits(bearings: list[Bearing]) -> str:
    """Orbits found and refused, over whether a march repeats."""

    def repeats(bearing):
        return (
            "does not repeat"
            if not bearing.period
            else "repeats"
            if bearing.period == 1
            else "of 2 to 4 revolutions"
        )

    found = Counter((bearing.runs["periodic"].outcome, repeats(bearing)) for bearing in bearings)
    kinds = ("repeats", "of 2 to 4 revolutions", "does not repeat")
    rows = [(end, *(found[end, kind] for kind in kinds)) for end in sorted({end for end, _ in found})]
    took = [(bearing.runs["periodic"].seconds, bearing) for bearing in bearings]
    return (
        table(("task", *(f"march: {kind}" for kind in kinds)), rows)
        + "\n\n"
        + distribution([("CPU s", took, ".2f")])
    )
