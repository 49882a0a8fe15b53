"""One fault of a known kind in an otherwise valid case, and what the refusal must name."""

from dataclasses import dataclass
from random import Random

import spelling
from harness import Case
from kinds import KINDS, Spot, default
from reference import Variable
from spelling import Item

# what does not fit together, and the variable that the refusal names
TOGETHER = (
    ({"film%circumferential_cells": "61"}, "film%circumferential_cells"),
    ({"film%circumferential_cells": "6"}, "film%circumferential_cells"),
    ({"film%axial_cells": "1"}, "film%axial_cells"),
    ({"film%circumferential_cells": "2000", "film%axial_cells": "1000"}, "film%axial_cells"),
    ({"film%solver": "'fourier'"}, "film%solver"),
    ({"bearing%machined_clearance": "1e-9"}, "bearing%machined_clearance"),
    ({"bearing%assembled_clearance": "201e-6"}, "bearing%assembled_clearance"),
    ({"bearing%axial_length": "2.5"}, "bearing%axial_length"),
    ({"bearing%cavitation_pressure": "1"}, "bearing%cavitation_pressure"),
    ({"rotor%balance_speed_rpm": "0.5"}, "rotor%balance_speed_rpm"),
    (
        {"operation%final_speed_rpm": "6501", "integration%stop_when_periodic": "0.1"},
        "integration%stop_when_periodic",
    ),
    ({"friction%dynamic_coefficient": "0.2"}, "friction%dynamic_coefficient"),
    ({"friction%dynamic_coefficient": "0", "friction%model": "'lugre'"}, "friction%dynamic_coefficient"),
    ({"pivot%radius_difference": "7e-3"}, "pivot%radius_difference"),
    ({"pivot%radius_difference": "0", "pivot%law": "'hertz'"}, "pivot%radius_difference"),
    ({"output%start_time": "2.1"}, "output%start_time"),
    ({"operation%duration": "1e6"}, "operation%duration"),
    ({"pads%inertia": "8e-5"}, "pads%inertia"),
    ({"rotor%balance_grade": "6.3", "rotor%unbalance": "1e-3"}, "rotor%balance_grade"),
    ({"rotor%balance_speed_rpm": "3000"}, "rotor%balance_speed_rpm"),
    ({"friction%bristle_damping": "5", "friction%characteristic_load": "1e4"}, "friction%bristle_damping"),
    ({"pads%mass": "1", "pads%density": "7850"}, "pads%density"),
    ({"bearing%preload": "0.3", "bearing%machined_clearance": "1e-4"}, "bearing%preload"),
    ({"oil%grade": "47"}, "oil%grade"),
    ({"oil%grade": "46", "oil%kinematic_viscosity": "46e-6, 7e-6"}, "oil%grade"),
    ({"oil%grade": "46", "bearing%viscosity": "0.02"}, "bearing%viscosity"),
    ({"oil%kinematic_viscosity": "7e-6, 46e-6"}, "oil%kinematic_viscosity"),
    ({"oil%law": "exponential", "oil%reference_viscosity": "0.02"}, "oil%law"),
    ({"thermal%model": "pad"}, "thermal%model"),
    ({"thermal%march": "groove"}, "thermal%march"),
    ({"start%file": "'x.h5'"}, "start%file"),
    ({"start%from": "file"}, "start%file"),
    ({"held%attitude_deg": "20"}, "held%attitude_deg"),
    ({"held%eccentricity_ratio": "0.5"}, "case%task = 'equilibrium'"),
    ({"start%pivot_deflection": "1e-6", "pads%motion": "tilting_only"}, "start%pivot_deflection"),
    ({"pads%motion": "fixed", "friction%model": "lugre"}, "friction%model"),
    ({"pads%motion": "fixed", "start%pad_tilt": "1e-3"}, "start%pad_tilt"),
    ({"bearing%slope": "1e-2, 0"}, "bearing%slope"),
    ({"pads%inertia_yaw": "1e-3"}, "pads%inertia_yaw"),
    ({"pads%pivot_axial_offset": "1e-3"}, "pads%pivot_axial_offset"),
    ({"pads%motion": "tilting_pitch", "film%solver": "sor"}, "pads%motion"),
    ({"pads%pivot_angle_deg": "0, 60"}, "pads%pivot_angle_deg"),
)


@dataclass(frozen=True)
class Fault:
    """A case that must be refused, and the words that the one line must have in it."""

    case: Case
    kind: str
    words: tuple[bytes, ...]


def plant(dice: Random, inputs: dict[str, tuple], variables: dict[str, Variable]) -> Fault:
    """The case as text with one fault in it."""
    kind = dice.choice((*KINDS, together, bad_set))
    if kind is together:
        return together(dice, variables)
    if kind is bad_set:
        return bad_set(dice, inputs, variables)
    named = None
    while named is None:
        named, groups = planted(dice, kind, inputs, variables)
    text = spelling.file_text(dice, groups)
    # what has a line by now is named by it
    words = tuple(word if isinstance(word, bytes) else b"line %d: " % word.line for word in named)
    return Fault(Case(text), kind.__name__, words)


def planted(dice: Random, kind, inputs: dict[str, tuple], variables: dict[str, Variable]):
    """What must be named, or None where the kind does not fit the variable; the groups with the fault."""
    variable = dice.choice(list(variables.values()))
    units = [spelling.spelled(dice, variables[key], value) for key, value in inputs.items()]
    unit = next((unit for unit in units if unit[0].key == variable.key), None)
    if not unit:
        size = 1 if variable.per_pad and not variable.fixes_pads else len(variable.default)
        unit = [
            spelling.item(dice, variable, [default(variable, value) for value in variable.default[:size]])
        ]
        units.append(unit)
    groups = spelling.groups(dice, units, variables)
    group = next(each for each in groups if each.name.lower().decode() == variable.group)
    return kind(dice, Spot(variable, unit[0], group, groups, variables)), groups


def together(dice: Random, variables: dict[str, Variable]) -> Fault:
    """Values that do not fit together."""
    values, culprit = dice.choice(TOGETHER)
    units = [
        [Item(key, spelling.cased(dice, key.partition("%")[2]), [value.encode()])]
        for key, value in values.items()
    ]
    text = spelling.file_text(dice, spelling.groups(dice, units, variables))
    return Fault(Case(text), "together", (culprit.encode(),))


def bad_set(dice: Random, inputs: dict[str, tuple], variables: dict[str, Variable]) -> Fault:
    """An argument of --set that is none."""
    # any word is a text
    key = dice.choice([key for key, each in variables.items() if not each.is_text or each.choices])
    group, name = key.encode().split(b"%")
    good = dice.choice(list(variables.values()))
    value = default(good, good.default[0])
    forms = (
        "|%|=|GROUP|NAME=VALUE|GROUP%NAME|GROUP%NAME=|GROUP%NAME=1 /|GROUP%NAME=1 x=2|GROUP%NAME=1 &end"
        "|GROUP%NAME=1 !|GROUP%=1|%NAME=1|&GROUP NAME=1 /|GROUP%no=1|no%NAME=1|GROUP%NAME='x"
        "|case%title='\x01'|case%title='\x1b[2J'|case%title='a\nb'|case%title='a\rb'|case%title='\xff'"
        "|GROUP%NAME(0)=1|GROUP.NAME=1|GROUP%NAME=LONG"
    )
    argument = dice.choice(forms.split("|")).encode("latin-1")
    long = b"x" * dice.choice((1, 100, 4000))
    for form, word in ((b"GROUP", group), (b"NAME", name), (b"VALUE", value), (b"LONG", long)):
        argument = argument.replace(form, word)
    text = spelling.case(dice, inputs, variables)
    return Fault(Case(text.text, (*text.sets, argument)), "bad_set", (b"--set",))
