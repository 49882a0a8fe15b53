"""The resolved namelist that every result file carries in its attribute `input`."""

import re
from typing import Any

ASSIGNMENT = re.compile(r"^&(?P<group>\w+)|^\s+(?P<name>\w+) = (?P<value>.*)$", re.MULTILINE)

#: No variable's range goes further.
LARGEST = 1e30

WORDS = {"none": "no friction", "bengisu_akay": "Bengisu-Akay", "lugre": "LuGre"}
#: Units by the variable's name; what has none is a pure number. Names that end in _rpm or _deg say theirs.
UNITS = {
    **{"mass": "kg", "unbalance": "kg m", "inertia": "kg m²", "characteristic_load": "N", "static_load": "N"},
    **{"balance_grade": "mm/s", "gravity": "m/s²", "viscosity": "Pa s"},
    **dict.fromkeys(("duration", "start_time", "max_step", "checkpoint_seconds"), "s"),
    **dict.fromkeys(("supply_pressure", "ambient_pressure", "cavitation_pressure", "young_modulus"), "Pa"),
    **dict.fromkeys(("radius_difference", "socket_radius", "journal_radius", "axial_length"), "m"),
    **dict.fromkeys(("machined_clearance", "assembled_clearance", "pivot_distance"), "m"),
    **dict.fromkeys(("centre_tangential", "centre_radial"), "m"),
    **dict.fromkeys(("critical_velocity", "stribeck_velocity"), "m/s"),
    **{"decay": "s/m", "bristle_stiffness": "1/m", "bristle_damping": "s/m", "viscous_coefficient": "s/m"},
}
#: What the package takes from the input: one number each, one or several, texts.
ONE_NUMBER = (
    *("operation%speed_rpm", "operation%final_speed_rpm", "operation%duration"),
    *("bearing%journal_radius", "bearing%machined_clearance", "bearing%assembled_clearance"),
    *("pivot%socket_radius", "pivot%radius_difference"),
    *("friction%stribeck_velocity", "friction%decay", "friction%critical_velocity"),
)
NUMBERS = ("pads%pivot_angle_deg", "pads%arc_deg", "pads%pivot_ratio")
TEXTS = ("friction%model", "pads%motion")


def resolved(text: str) -> dict[str, dict[str, Any]]:
    """Groups of the namelist text of a result; ValueError where it is none or lacks what is needed."""
    groups = parse(text)
    for names, kinds in ((ONE_NUMBER, int | float), (NUMBERS, int | float | tuple), (TEXTS, str)):
        for group, _, name in (each.partition("%") for each in names):
            value = groups.get(group, {}).get(name)
            if not isinstance(value, kinds):
                raise ValueError(f"{group}%{name} is {'missing' if value is None else value}")
    if len({count(groups["pads"][name.split("%")[1]]) for name in NUMBERS}) > 1:
        raise ValueError("the pads' values are not equally many")
    return groups


def count(value: Any) -> int:
    return len(value) if isinstance(value, tuple) else 1


def parse(text: str) -> dict[str, dict[str, Any]]:
    """Groups of the namelist text: {"bearing": {"assembled_clearance": 8e-5, ...}, ...}.

    It reads what the program writes (one assignment a line, texts in single quotes), not every namelist.
    """
    groups: dict[str, dict[str, Any]] = {}
    for found in ASSIGNMENT.finditer(text):
        if found["group"]:
            groups[found["group"]] = group = {}
        else:
            group[found["name"]] = value_of(found["value"].strip())
    return groups


def value_of(text: str) -> str | int | float | tuple[int | float, ...]:
    """A text without its quotes, a number, or a tuple of numbers."""
    if text.startswith("'"):
        return text[1:-1].replace("''", "'")
    numbers = tuple(number_of(word) for word in text.split(","))
    return numbers[0] if len(numbers) == 1 else numbers


def number_of(word: str) -> int | float:
    number = float(word) if re.search(r"[.eE]", word) else int(word)
    if abs(number) > LARGEST:
        raise ValueError(f"{word.strip()} is beyond all ranges")
    return number


def differences(inputs: list[dict[str, dict[str, Any]]]) -> list[str]:
    """What tells runs apart, one short text each: "LuGre, tilting only", from the values that differ."""
    values = [flattened(each) for each in inputs]
    names = list(dict.fromkeys(name for each in values for name in each))
    varying = [name for name in names if len({each.get(name) for each in values}) > 1]
    if "pads" in varying:
        varying.remove("pads%pivot_angle_deg")
    return [", ".join(described(name, each.get(name)) for name in varying) for each in values]


def varied(inputs: list[dict[str, dict[str, Any]]]) -> tuple[str, list[float]] | None:
    """The one number in which inputs differ, each time another: its label with the unit, and its values.

    Lengths below a millimetre are in µm, all others as in the namelist.
    """
    values = [by_variable(each) for each in inputs]
    names = {name for each in values for name in each if len({other.get(name) for other in values}) > 1}
    names -= {"case%title", "operation%final_speed_rpm", "output%checkpoint_seconds"}
    if len(names) != 1:
        return None
    name = names.pop()
    found = [shared(each.get(name)) for each in values]
    if not all(isinstance(each, int | float) for each in found) or len(set(found)) < len(found):
        return None
    text, unit = named(name)
    if unit == "m" and max(map(abs, found)) < 1e-3:
        unit, found = "µm", [1e6 * each for each in found]
    return f"{text} ({unit})" if unit else text, found


def by_variable(groups: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The same values by "group%name"."""
    return {f"{group}%{name}": value for group in groups for name, value in groups[group].items()}


def shared(value: Any) -> Any:
    """The value that a tuple repeats, or the value itself."""
    return value[0] if isinstance(value, tuple) and len(set(value)) == 1 else value


def named(name: str) -> tuple[str, str]:
    """Text and unit (may be empty) of "group%name"."""
    name = name.split("%")[-1]
    for ending in ("deg", "rpm"):
        if name.endswith("_" + ending):
            return name.removesuffix("_" + ending).replace("_", " "), ending
    return name.replace("_", " "), UNITS.get(name, "")


def flattened(groups: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """Values by "group%name" as a reader would tell them: one speed or a range, pads alike once, no title."""
    values = by_variable(groups)
    values.pop("case%title", None)
    values.pop("output%checkpoint_seconds", None)
    first, last = values.pop("operation%speed_rpm"), values.pop("operation%final_speed_rpm")
    angles = values["pads%pivot_angle_deg"]
    said = {"speed": f"{first:g} rpm" if first == last else f"{first:g} to {last:g} rpm"}
    said["pads"] = f"{len(angles) if isinstance(angles, tuple) else 1} pads"
    for name, value in values.items():
        said[name] = shared(value) if name.startswith("pads%") else value
    return said


def described(name: str, value: Any) -> str:
    text, unit = named(name)
    if value is None:
        return f"no {text}"
    if isinstance(value, str):
        return WORDS.get(value, value) if text == "model" else value.replace("_", " ")
    numbers = value if isinstance(value, tuple) else (value,)
    return f"{text} = {', '.join(f'{number:g}' for number in numbers)} {unit}".rstrip()
