"""Tables of the errors of realistic bearings."""

from typing import NamedTuple

import numpy as np
from bearing_runs import CURVE, Bearing
from march_errors import QUANTITIES
from report import table

#: A bearing is sensitive where the disturbance moves the journal, or a tilt, by more: a quarter of the
#: largest errors that the default settings may have.
SENSITIVE = {"journal": 5e-4, "tilt_loaded": 5e-3, "tilt_unloaded": 5e-3}
#: The errors of tilts.
TILTS = ("tilt_loaded", "tilt_unloaded")
#: Bearings that a table of the worst names.
NAMED = 8


def unsensitive(bearings: list[Bearing]) -> list[Bearing]:
    """The bearings that are compared and not sensitive."""
    return [bearing for bearing in bearings if bearing.compared and not sensitive(bearing)]


def sensitive(bearing: Bearing) -> bool:
    """Whether the disturbance alone moves a bearing too much; one that the disturbance stops is."""
    moved = bearing.runs["disturbed"].errors
    return not moved or any(moved.get(name, 0.0) > limit for name, limit in SENSITIVE.items())


def numbers(bearings: list[Bearing]) -> str:
    """Numbers of bearings."""
    return ", ".join(str(bearing.number) for bearing in bearings) or "none"


def quantiles(values: list[float], form: str) -> tuple[str, ...]:
    """Median, 95 % and largest."""
    return tuple(f"{each:{form}}" for each in np.quantile(values, (0.5, 0.95, 1.0)))


def distribution(rows: list[tuple[str, list[tuple[float, Bearing]], str]]) -> str:
    """A table of median, 95 %, largest and the bearing of the largest."""
    lines = []
    for name, found, form in rows:
        if found:
            values = [value for value, _ in found]
            bearing = max(found, key=lambda each: each[0])[1]
            lines.append((name, len(found), *quantiles(values, form), bearing.number))
    return table(("", "bearings", "median", "95 % below", "largest", "bearing"), lines)


def errors(bearings: list[Bearing]) -> str:
    """Distribution of the errors of the default march."""
    return distribution(
        [
            (words, [(bearing.runs["default"].errors[name], bearing) for bearing in bearings
                     if name in bearing.runs["default"].errors], ".1e")
            for name, words in QUANTITIES.items()
        ]
    )  # fmt: skip


def worst(bearings: list[Bearing]) -> str:
    """The bearings with the largest errors of journal and tilts, over the limits of the sensitive ones."""
    ranked = sorted(bearings, key=lambda bearing: -badness(bearing))[:NAMED]
    rows = []
    for bearing in ranked:
        own, direct = bearing.runs["default"].errors, bearing.runs["direct"].errors
        found = [f"{each[name]:.1e}" if name in each else "-" for each in (own, direct) for name in SENSITIVE]
        rows.append((bearing.number, *found, *features(bearing)))
    head = [QUANTITIES[name] for name in SENSITIVE]
    return table(("bearing", *head, *(f"{name} (direct)" for name in head), *FEATURES), rows)


def badness(bearing: Bearing) -> float:
    """Largest error of journal and tilts, over the limits of the sensitive ones."""
    own = bearing.runs["default"].errors
    return max(own.get(name, 0.0) / limit for name, limit in SENSITIVE.items())


FEATURES = ("pads", "load", "friction", "cavitation", "pads that lift or rub", "pads that flutter")


def features(bearing: Bearing) -> tuple:
    """What a bearing is, in short."""
    case, angles = bearing.case, bearing.case["pads"]["pivot_angle_deg"]
    place = "on a pivot" if angles[0] == -90 else "between pivots"
    kind = case["friction"]["model"], case["film"]["cavitation"]
    return len(angles), place, *kind, listed(bearing.bouncing_pads), listed(bearing.flutter_pads)


def listed(pads: list[int]) -> str:
    """Numbers of pads."""
    return ", ".join(map(str, pads)) or "-"


class Point(NamedTuple):
    """A point of the curve: median, 95 % and largest errors; CPU time of all marches, s."""

    count: int
    journal: np.ndarray
    tilt: np.ndarray
    seconds: float


def curve_points(bearings: list[Bearing], name: str) -> Point:
    """The point of a tolerance, over the bearings that were marched with all of them."""
    runs = [bearing.runs[name] for bearing in bearings]
    found = [run.errors for run in runs if run.errors]
    journal = [each["journal"] for each in found]
    tilt = [max(each[name] for name in TILTS if name in each) for each in found]
    parts = (0.5, 0.95, 1.0)
    return Point(
        len(found), np.quantile(journal, parts), np.quantile(tilt, parts), sum(run.seconds for run in runs)
    )


def on_curve(bearing: Bearing) -> bool:
    """Whether a bearing was marched with the tables of all tolerances, and all marches are complete."""
    return all(name in bearing.runs and bearing.runs[name].complete for name in curve_names())


def curve(bearings: list[Bearing]) -> str:
    """Errors and time over the tolerance of the tables."""
    if not bearings:
        return "None."
    rows = []
    for name in curve_names():
        point = curve_points(bearings, name)
        found = [f"{each:.1e}" for each in (*point.journal, *point.tilt)]
        rows.append((name, *found, f"{point.seconds:.2f}"))
    words = ("median", "95 %", "largest")
    head = ("", *(f"{each}, {word}" for each in ("journal", "tilt") for word in words), "CPU s, all")
    return table(head, rows)


def curve_names() -> list[str]:
    """The runs of the curve."""
    return [*CURVE, "default", "direct"]
