"""Tables of the steps and times of realistic bearings."""

from collections.abc import Callable

from bearing_runs import ROTOR_TIME, Bearing
from error_tables import FEATURES, NAMED, distribution, features
from report import table

#: CPU time, s, below which `direct` is not told from the start of the program.
SHORT = 0.2
#: Arc of a pad of the whole circle, degrees.
WHOLE = 360.0


def steps(bearings: list[Bearing]) -> str:
    """Distribution of the steps per revolution."""
    own = [(bearing.runs["long"].rate, bearing) for bearing in bearings]
    smooth = [each for each in own if not each[1].bouncing_pads]
    return distribution([("all", own, ".0f"), ("without pads that lift or rub", smooth, ".0f")])


def named(bearings: list[Bearing], key: Callable[[Bearing], float]) -> str:
    """The bearings in which something is largest."""
    rows = []
    for bearing in sorted(bearings, key=lambda bearing: -key(bearing))[:NAMED]:
        run = bearing.runs["long"]
        cost = f"{run.rate:.0f}", f"{seconds(bearing):.2f}", f"{share(bearing):.0%}", run.outcome
        rows.append((bearing.number, *cost, *features(bearing)))
    return table(("bearing", "steps per revolution", "CPU s", "tables", "march", *FEATURES), rows)


def most_steps(bearings: list[Bearing]) -> str:
    """The bearings with the most steps."""
    return named(bearings, lambda bearing: bearing.runs["long"].rate)


def longest(bearings: list[Bearing]) -> str:
    """The bearings that take the longest."""
    return named(bearings, seconds)


def seconds(bearing: Bearing) -> float:
    """CPU time of the long march, for the rotor's time that the page gives."""
    run = bearing.runs["long"]
    reached = run.revolutions * 60 / bearing.case["operation"]["speed_rpm"]
    return run.seconds * ROTOR_TIME / max(reached, 1e-9)


def share(bearing: Bearing) -> float:
    """Part of the long march's time that builds tables."""
    run = bearing.runs["long"]
    return min(1.0, run.building / max(run.seconds, 1e-9))


def ratio(bearing: Bearing) -> float:
    """Time with tables over that without."""
    return bearing.runs["default"].seconds / max(bearing.runs["direct"].seconds, SHORT)


def microseconds(bearings: list[Bearing]) -> str:
    """Distribution of the time of a step, over all pads and over those of the whole circle."""
    own = [
        (1e6 * run.seconds / run.steps, bearing)
        for bearing in bearings
        if (run := bearing.runs["long"]).steps
    ]
    whole = [each for each in own if each[1].case["pads"]["arc_deg"][0] == WHOLE]
    return distribution([("all", own, ".1f"), ("of 360 degrees", whole, ".1f")])


def times(bearings: list[Bearing]) -> str:
    """Distribution of times and shares."""
    both = [
        bearing
        for bearing in bearings
        if all(name in bearing.runs and bearing.runs[name].complete for name in ("default", "direct"))
    ]
    return distribution(
        [
            ("CPU s", [(seconds(bearing), bearing) for bearing in bearings], ".2f"),
            ("part of building tables", [(share(bearing), bearing) for bearing in bearings], ".0%"),
            ("over `direct`", [(ratio(bearing), bearing) for bearing in both], ".2f"),
        ]
    )
