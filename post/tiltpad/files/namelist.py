"""The resolved namelist that every result file carries in its attribute `input`."""

import numbers
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.files.writing import write

QUOTED = re.compile(r"'((?:[^']|'')*)'")
ASSIGNMENT = re.compile(r"^&(?P<group>\w+)|^[ \t]+(?P<name>\w+) = (?P<value>.*)$", re.MULTILINE)

#: The group whose values are those of other variables.
STUDY = "sweep"
#: Its variable that names a table of values.
TABLE = "file"
#: Truth values as the program writes them.
TRUTH = {".true.": True, ".false.": False}
#: The range of no variable reaches beyond it.
LARGEST = 1e30
#: The program writes some thousand characters.
LONGEST = 1 << 20

#: Name of a variable: group%name, or of an element; a machine has groups with numbers or names of bearings.
VARIABLE = re.compile(r"[a-z]\w*(:\w+|\(\d+\))?%[a-z]\w*(\(\d+\))?", re.ASCII | re.IGNORECASE)
#: Groups that a machine has several times: those of its bearings, and what stands on its shaft.
OF_BEARINGS = ("bearing", "oil", "pads", "pivot", "friction", "asperity", "film")
ON_SHAFTS = ("disc", "unbalance", "bow", "load", "element", "impeller", "support", "damper", "excitation")
SEVERAL = (*OF_BEARINGS, *ON_SHAFTS)
#: Groups and variables of a machine that a case of one bearing has not.
OF_MACHINES = ("shaft", "reduction", "rotor", "lateral", *ON_SHAFTS)
OF_PLACES = ("name", "kind", "station", "offset", "misalignment")
#: The least mass, kg, that a rotor may have.
LEAST_MASS = 1e-6

#: Variables that the package uses: those of one number, those of one or several numbers, texts.
OPERATION = ("operation%speed_rpm", "operation%final_speed_rpm", "operation%duration")
ONE_NUMBER = (
    *OPERATION,
    *("bearing%journal_radius", "rotor%mass", "rotor%gravity"),
    *("friction%stribeck_velocity", "friction%decay", "friction%critical_velocity"),
)
NUMBERS = (
    *("pads%pivot_angle_deg", "pads%arc_deg", "pads%pivot_ratio", "pads%pivot_distance"),
    *("bearing%machined_clearance", "bearing%assembled_clearance", "bearing%axial_length"),
    *("pivot%socket_radius", "pivot%radius_difference"),
)
TEXTS = ("friction%model", "pads%motion")


def resolved(text: str) -> dict[str, dict[str, Any]]:
    """Groups of the namelist text of a result; ValueError where a variable that is used is missing."""
    groups = parse(text)
    if is_machine(groups):
        needs_variables(groups, OPERATION, int | float)
        return groups
    for names, kinds in ((ONE_NUMBER, int | float), (NUMBERS, int | float | tuple), (TEXTS, str)):
        needs_variables(groups, names, kinds)
    # in older files those of bearing and pivot are one number for all pads
    own = [name for name in NUMBERS if name.startswith("pads%") or isinstance(variable(groups, name), tuple)]
    if len({count(variable(groups, name)) for name in own}) > 1:
        raise ValueError("the pads' values are not equally many")
    return groups


def variable(groups: Mapping[str, Any], name: str) -> Any:
    """The value of "group%name"."""
    group, _, own = name.partition("%")
    return groups[group][own]


def of_pads(groups: Mapping[str, Any], name: str) -> tuple[float, ...]:
    """The value of "group%name" of each pad."""
    value = variable(groups, name)
    return value if isinstance(value, tuple) else (value,) * count(groups["pads"]["pivot_angle_deg"])


def needs_variables(groups: Mapping[str, Any], names: Sequence[str], kinds: Any) -> None:
    """Raises ValueError where one of these variables is missing, or is of another kind."""
    for group, _, name in (each.partition("%") for each in names):
        value = groups.get(group, {}).get(name)
        if not isinstance(value, kinds):
            raise ValueError(f"{group}%{name} is {'missing' if value is None else value}")


def needs_variable(name: object, where: str = "") -> None:
    """Raises ValueError for anything but the name of a variable."""
    if not isinstance(name, str) or not VARIABLE.fullmatch(name):
        raise ValueError(f"{where}{name!r}: must be a variable, group%name or group%name(element)")


def is_machine(groups: Mapping[str, Any]) -> bool:
    """True for the groups of a machine: its bearings have names, and are a list."""
    return isinstance(groups.get("bearing"), list)


def bearing_names(groups: Mapping[str, Any]) -> list[str]:
    """Names of the bearings of pads of a machine, in the order of its input."""
    return [f"{each.get('name', '')}" for each in groups["bearing"] if each.get("kind", "film") == "film"]


def of_bearing(text: str, name: str, load: Sequence[float] = (0, 0)) -> str:
    """The namelist text of one bearing of a machine, as a case of its own under this load (y, z), N.

    Its rotor is the mass that the bearing carries, and what else the load is, on a journal without slope.
    """
    gravity = parse(text).get("rotor", {}).get("gravity", 0)
    mass = max(LEAST_MASS, -load[0] / gravity) if gravity > 0 else LEAST_MASS
    rotor = {"mass": mass, "gravity": gravity, "static_load": (load[0] + mass * gravity, load[1])}
    kept = ["\n".join(["&rotor", *(f"  {name} = {written(value)}" for name, value in rotor.items()), "/\n"])]
    for block in re.split(r"^(?=&)", text, flags=re.MULTILINE)[1:]:
        ((group, own),) = variables_of(block)
        of_any = group in OF_BEARINGS
        if group not in OF_MACHINES and (not of_any or name in (own.get("name"), own.get("bearing"))):
            places = (*OF_PLACES, "bearing") if of_any else ()
            lines = (line for line in block.splitlines() if line.split("=")[0].strip() not in places)
            kept.append(re.sub("shaft_slope = .*", "slope = 0.0, 0.0", "\n".join(lines)) + "\n")
    return "".join(kept)


def with_values(text: str, values: Mapping[str, Any]) -> str:
    """The namelist text of a result with other values of variables, each of which one group alone has."""
    for name, value in values.items():
        line = rf"\g<1>{written(value)}"
        text = re.sub(rf"^([ \t]+{name} = ).*$", line, text, flags=re.MULTILINE)
    return text


def count(value: Any) -> int:
    return len(value) if isinstance(value, tuple) else 1


def parse(text: str) -> dict[str, dict[str, Any]]:
    """Groups of the namelist text: {"bearing": {"journal_radius": 0.0499, ...}, ...}.

    Excitations are a list, and in a machine all that are there several times: {"bearing": [{"name": "left",
    ...}, ...]}.
    It reads what the program writes (one assignment a line, texts in single quotes), not every namelist.
    """
    if len(text) > LONGEST:
        raise ValueError(f"{len(text)} characters")
    blocks = variables_of(text)
    machine = any(group == "bearing" and "name" in own for group, own in blocks)
    several = SEVERAL if machine else ("excitation",)
    groups: dict[str, Any] = {}
    for group, own in blocks:
        if group in several:
            groups.setdefault(group, []).append(own)
        else:
            groups[group] = own
    return groups


def variables_of(text: str) -> list[tuple[str, dict[str, Any]]]:
    """Each group of a namelist text with its variables, in its order."""
    blocks: list[tuple[str, dict[str, Any]]] = []
    for found in ASSIGNMENT.finditer(text):
        if found["group"]:
            blocks.append((found["group"], {}))
        elif blocks:
            blocks[-1][1][found["name"]] = value_of(found["value"].strip())
        else:
            raise ValueError(f"{found['name']} before any group")
    return blocks


def value_of(text: str) -> str | bool | int | float | tuple[int | float, ...] | tuple[str, ...]:
    """A text without its quotes, a truth value, a number, or a tuple of texts or numbers."""
    if text.startswith("'"):
        texts = tuple(each.replace("''", "'") for each in QUOTED.findall(text))
        return texts[0] if len(texts) == 1 else texts or text[1:-1]
    if text in TRUTH:
        return TRUTH[text]
    numbers = tuple(number_of(word) for word in text.split(","))
    return numbers[0] if len(numbers) == 1 else numbers


def number_of(word: str) -> int | float:
    number = float(word) if re.search(r"[.eE]", word) else int(word)
    if abs(number) > LARGEST:
        raise ValueError(f"{word.strip()} is beyond all ranges")
    return number


def write_case(path: str | os.PathLike, groups: Mapping[str, Mapping[str, Any]]) -> Path:
    """Writes a case for the program: {"operation": {"speed_rpm": 3000}, ...}; gives its path.

    A group that a machine has several times is a list: {"disc": [{"station": 3, ...}, {"station": 7, ...}]}.
    Values are numbers, texts, paths, truth values, or sequences of them. The input of a result,
    `run.input`, is such a dictionary. Raises ValueError for anything else.
    """
    lines = []
    for group, values in groups.items():
        for each in values if isinstance(values, list) else [values]:
            own = variables(group, each).items()
            lines.append(f"&{group}")
            lines += [f"  {name} = {written(value, is_varied(group, name))}" for name, value in own]
            lines.append("/")
    write(path, "\n".join([*lines, ""]))
    return Path(path)


def variables(group: str, values: Any) -> Mapping[str, Any]:
    """The variables of a group; ValueError where they are not given by name."""
    if not isinstance(values, Mapping):
        raise ValueError(f"{group} = {values!r}: a group has variables: {group}={{'name': value, ...}}")
    return values


def is_varied(group: str, name: str) -> bool:
    """True for what a study varies; a text there may be a range."""
    return group == STUDY and name != TABLE


def written(value: Any, varied: bool = False) -> str:
    """A value as a namelist has it; a text of varied values as it is ("1000:6000:500")."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return value if varied else "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool | np.bool_):
        return ".true." if value else ".false."
    if isinstance(value, numbers.Real):
        return f"{value:d}" if isinstance(value, numbers.Integral) else repr(float(value))
    if isinstance(value, Sequence | np.ndarray) and len(value):
        return ", ".join(written(each) for each in value)
    raise ValueError(f"{value!r} is neither a number nor a text, nor a sequence of them")
