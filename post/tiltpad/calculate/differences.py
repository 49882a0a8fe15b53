"""Differences between the inputs of runs, as values and in words."""

from typing import Any

from tiltpad.files import namelist, units

#: Variables without influence on the results: inputs that differ in them alone count as the same.
IGNORED = ("case%title", "output%checkpoint_seconds")
#: How the names of variables begin that have a value for each pad.
PER_PAD = (
    *("pads%", "start%pad_", "start%pivot_"),
    *("bearing%machined_clearance", "bearing%assembled_clearance", "bearing%axial_length"),
    *("pivot%socket_radius", "pivot%radius_difference", "pivot%stiffness", "pivot%rotational_stiffness"),
    "pivot%contact_length",
    *("friction%static_coefficient", "friction%dynamic_coefficient"),
)
#: Names of friction models as they are written in pictures.
WORDS = {"none": "no friction", "bengisu_akay": "Bengisu-Akay", "lugre": "LuGre"}


def differences(inputs: list[dict[str, dict[str, Any]]]) -> list[str]:
    """The values in which inputs differ, a short text for each run: "LuGre, tilting only"."""
    values = [flattened(each) for each in inputs]
    names = list(dict.fromkeys(name for each in values for name in each))
    varying = [name for name in names if len({each.get(name) for each in values}) > 1]
    if "pads" in varying:
        varying.remove("pads%pivot_angle_deg")
    if "pads%motion" in varying:
        # pads that pitch have these of their shape
        varying = [name for name in varying if not name.startswith("pads%inertia_")]
    return [", ".join(described(name, each.get(name)) for name in varying) for each in values]


def varied(inputs: list[dict[str, dict[str, Any]]]) -> tuple[str, list[float]] | None:
    """The one number in which all inputs differ: its label with the unit, and its values.

    Lengths below a millimetre are in µm, all others as in the namelist.
    """
    values = [by_variable(each) for each in inputs]
    every = {name for each in values for name in each}
    names = {name for name in every if len({each.get(name) for each in values}) > 1}
    names.discard("operation%final_speed_rpm")
    if len(names) != 1:
        return None
    name = names.pop()
    found = [shared(each.get(name)) for each in values]
    if not all(isinstance(each, int | float) for each in found) or len(set(found)) < len(found):
        return None
    shown = units.shown(*units.named(name), found)
    return shown.label, [shown.factor * each for each in found]


def by_variable(groups: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The same values by "group%name", without those that are IGNORED; of a machine by "disc 2%name", too."""
    blocks: dict[str, Any] = {}
    for group, own in groups.items():
        if isinstance(own, list):
            blocks |= {f"{group} {number}": each for number, each in enumerate(own, 1)}
        else:
            blocks[group] = own
    flat = {f"{group}%{name}": value for group, own in blocks.items() for name, value in own.items()}
    return {name: value for name, value in flat.items() if name not in IGNORED}


def shared(value: Any) -> Any:
    """The value that a tuple repeats, or the value itself."""
    return value[0] if isinstance(value, tuple) and len(set(value)) == 1 else value


def flattened(groups: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """Values by "group%name" for a reader: one speed or a range, a value that all pads share once."""
    values = by_variable(groups)
    first, last = values.pop("operation%speed_rpm"), values.pop("operation%final_speed_rpm")
    found = {"speed": f"{first:g} rpm" if first == last else f"{first:g} to {last:g} rpm"}
    if "pads%pivot_angle_deg" in values:
        found["pads"] = f"{namelist.count(values['pads%pivot_angle_deg'])} pads"
    for name, value in values.items():
        found[name] = shared(value) if name.startswith(PER_PAD) else value
    return found


def described(name: str, value: Any) -> str:
    """A value of a variable in words: "LuGre", "duration = 0.02 s"."""
    text, unit = units.named(name)
    if value is None:
        return f"no {text}"
    if isinstance(value, str):
        if name == "friction%model":
            return WORDS.get(value, value)
        return f"{name.partition('%')[0]} {value}" if text == "model" else value.replace("_", " ")
    numbers = value if isinstance(value, tuple) else (value,)
    shown = units.shown(text, unit, numbers)
    return f"{text} = {', '.join(f'{shown.factor * number:g}' for number in numbers)} {shown.unit}".rstrip()
