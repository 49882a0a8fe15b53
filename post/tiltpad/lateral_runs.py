"""A lateral analysis: the runs that it takes of one machine."""

import os
import re
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.calculate.lateral_limits import Column, Lateral, Placed, placed_unbalances
from tiltpad.files import namelist
from tiltpad.files.writing import write
from tiltpad.running import checked, run

#: Runs over the speed.
SPEEDS = 60
#: What the runs over the speed leave out.
OF_LEVELS = ("impeller", "lateral")


def lateral(case: str | os.PathLike, /, *, speeds: int = SPEEDS) -> Lateral:
    """Runs what a lateral report of a machine with groups &impeller and &lateral needs.

    With the minimum and the maximum clearance of the bearings: stability level I (without the elements of
    level 2) and level II, and a study of coefficients over this number of speeds for each mode's unbalance.
    """
    text = checked(case)
    groups: dict[str, Any] = namelist.parse(text)
    if namelist.STUDY in groups:
        raise ValueError(f"{case}: a study; a lateral report is of one case")
    if "lateral" not in groups:
        needed = "with its speeds, probes and close clearances, and groups &impeller"
        raise ValueError(f"{case}: has no group &lateral; a lateral report needs one, {needed}")
    low, high = groups["lateral"]["clearance_change"]
    named = {"minimum clearance": low, "maximum clearance": high} if high > low else {"given clearance": low}
    columns: list[Column] = []
    placed: list[Placed] = []
    with tempfile.TemporaryDirectory(prefix="tiltpad-") as folder:

        def performed(variant: str, change: float, **more: Any) -> Any:
            path = Path(folder, "case.nml")
            write(path, variant)
            own: dict[str, Any] = {
                f"bearing:{each['name']}": changed(each, change) for each in groups["bearing"]
            }
            return run(path, case={"task": "coefficients"}, **own, **more)

        for name, change in named.items():
            one = performed(without(text, lambda group, own: group == "element" and own["level"] > 1), change)
            two = performed(text, change)
            placed = placed or placed_unbalances(two, groups)
            studies = [
                performed(unbalanced(text, each), change, sweep={"operation%speed_rpm": over(groups, speeds)})
                for each in placed
            ]
            columns.append(Column(name, one, two, studies))
    return Lateral(Path(case).name, groups, placed, columns)


def changed(bearing: dict[str, Any], change: float) -> dict[str, Any]:
    """The assembled clearances of a bearing with this change, m."""
    return {"assembled_clearance": np.atleast_1d(bearing["assembled_clearance"]) + change}


def over(groups: dict[str, Any], speeds: int) -> np.ndarray:
    """Speeds of the diagrams, rpm, with both ends of the operating speeds."""
    own = groups["lateral"]
    ends = [own["lowest_rpm"], groups["operation"]["speed_rpm"]]
    return np.unique(np.round([*np.linspace(own["first_rpm"], own["last_rpm"], speeds), *ends], 3))


def without(text: str, left_out: Any) -> str:
    """The namelist text without some of its groups."""
    blocks = re.split(r"^(?=&)", text, flags=re.MULTILINE)
    return "".join(each for each in blocks if not any(left_out(*own) for own in namelist.variables_of(each)))


def unbalanced(text: str, placed: Placed) -> str:
    """The case with these unbalances in place of its own, and without what both levels alone need."""
    lines: Iterable[str] = (
        f"&unbalance station = {each.station}, moment = {each.moment!r}, angle_deg = {each.angle_deg!r} /\n"
        for each in placed.unbalances
    )
    kept = without(text, lambda group, _: group in ("unbalance", *OF_LEVELS))
    # it follows from the speed, which changes
    return re.sub(r"^  final_speed_rpm = .*\n", "", kept, flags=re.MULTILINE) + "".join(lines)
