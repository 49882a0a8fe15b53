"""Parameters of a study: the varied variables, or those in which the inputs differ."""

import re
from collections import Counter
from collections.abc import Collection, Sequence
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate.differences import by_variable, shared
from tiltpad.files import namelist, units

#: A text without quotes.
WORD = re.compile(r"[a-z_]\w*", re.ASCII | re.IGNORECASE)
#: What stands between a group that a machine has several times, and its number or the name of its bearing.
NUMBER_OR_NAME = re.compile(r"[:( )]")


class Parameter(NamedTuple):
    """A variable in which runs differ, with the value of each run."""

    name: str  # short and without special characters: speed_rpm, arc_deg_1
    variable: str  # as in the namelist: operation%speed_rpm, pads%arc_deg(1)
    long_name: str  # in words: speed; arc, 1
    units: str  # of the values; empty for texts
    values: list[float] | list[str]  # numbers, nan where a run has none, or texts, empty where it has none


def varied_values(text: str) -> dict[str, Any]:
    """Values by variable from the attribute `sweep` of a run: a line "operation%speed_rpm = 1500" each.

    A text may stand there without quotes, as in the case.
    """
    lines = [[part.strip() for part in line.partition("=")] for line in text.splitlines() if line.strip()]
    return {name: value if WORD.fullmatch(value) else namelist.value_of(value) for name, _, value in lines}


def differing(inputs: Sequence[dict[str, dict[str, Any]]]) -> list[dict[str, Any]]:
    """Values by variable of each input, of the variables in which they differ; lists by their elements."""
    flat = [by_variable(each) for each in inputs]
    # a run and the equilibrium of the same input do not differ
    names = [name for name in dict.fromkeys(name for each in flat for name in each) if name != "case%task"]
    if all(follows(each) for each in flat):
        names.remove("operation%final_speed_rpm")
    # machines have pads of each bearing
    angles = [each.get("pads%pivot_angle_deg") for each in flat]
    pads = [0 if each is None else namelist.count(each) for each in angles]
    found: list[dict[str, Any]] = [{"pads": count} if len(set(pads)) > 1 else {} for count in pads]
    for name in names:
        values = [each.get(name) for each in flat]
        if len(set(values)) > 1:
            alike = [shared(value) for value in values]
            if not any(isinstance(value, tuple) for value in alike):
                split = [{name: value} for value in alike] if len(set(alike)) > 1 else [{} for _ in alike]
            else:
                split = elements(name, values)
            for each, more in zip(found, split, strict=True):
                each.update(more)
    return found


def follows(flat: dict[str, Any]) -> bool:
    """True where the final speed is the speed: it is constant."""
    return flat["operation%final_speed_rpm"] == flat["operation%speed_rpm"]


def elements(name: str, values: Sequence[Any]) -> list[dict[str, Any]]:
    """The elements of a list that differ, by name(1), name(2), ..."""
    lists = [value if isinstance(value, tuple) else (value,) for value in values]
    places = range(max(map(len, lists)))
    differ = [k for k in places if len({each[k] if k < len(each) else None for each in lists}) > 1]
    return [{f"{name}({k + 1})": each[k] for k in differ if k < len(each)} for each in lists]


def parameters(runs: Sequence[dict[str, Any] | None], taken: Collection[str] = ()) -> list[Parameter]:
    """The parameters of runs from their values by variable; None for a run that is not known.

    A name that another group has too, or that is `taken`, gets its group.
    """
    variables = list(dict.fromkeys(variable for each in runs for variable in each or {}))
    short = Counter(short_name(variable) for variable in variables)
    found = []
    for variable in variables:
        values = [None if each is None else each.get(variable) for each in runs]
        group, _, rest = variable.rpartition("%")
        kind = NUMBER_OR_NAME.split(group)[0]
        name, (words, unit) = short_name(variable), units.named(f"{kind}%{rest.partition('(')[0]}")
        if kind != group:
            words += f" ({group})"
        if short[name] > 1 or name in taken:
            name, words = f"{group}_{name}", f"{words} ({group})"
        if "(" in rest:
            words += f", {rest.partition('(')[2].rstrip(')')}"
        if any(isinstance(value, str) for value in values):
            words = f"{group.removesuffix('s')} {words}"
            found.append(Parameter(name, variable, words, "", ["" if v is None else f"{v}" for v in values]))
        else:
            numbers = [number(value) for value in values]
            found.append(Parameter(name, variable, words, unit or "1", numbers))
    return found


def short_name(variable: str) -> str:
    """speed_rpm of operation%speed_rpm, arc_deg_1 of pads%arc_deg(1), disc_2_mass of disc(2)%mass."""
    group, _, name = variable.rpartition("%")
    several = f"{NUMBER_OR_NAME.sub('_', group).rstrip('_')}_" if NUMBER_OR_NAME.search(group) else ""
    return several + name.replace("(", "_").rstrip(")")


def number(value: Any) -> float:
    """The number, or the one that all elements of a list share; nan where there is none."""
    one = shared(value)
    return float(one) if isinstance(one, int | float) else np.nan
