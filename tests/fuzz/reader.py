"""A second reader of cases, from the documented syntax (docs/inputs.md) and nothing of the program's."""

import math
import re
from dataclasses import dataclass, field

from harness import Case
from reference import OF_MACHINES, OF_MACHINES_TOO, Variable

MOST_ITEMS = 1000
MOST_TEXT = 1000
LONGEST_NUMBER = 60
STUDY = "sweep"

BLANK = re.compile(rb"(?:[ \t\r\n]|![^\n]*)*")
COMMAS = re.compile(rb"(?:[ \t\r\n,]|![^\n]*)*")
WORD = re.compile(rb"[^ ,=/&!'\"\t\n\r]*")
QUOTED = re.compile(rb"'(?:[^'\n]|'')*+'|\"(?:[^\"\n]|\"\")*+\"")
TARGET = re.compile(rb"([a-z0-9_]+)(?:\(([0-9]{1,4})\))?")
STUDY_TARGET = re.compile(rb"([a-z0-9_%]+)(?:\(([0-9]{1,4})\))?")
NUMBER = re.compile(rb"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[ed][+-]?[0-9]+)?")
REPEAT = re.compile(rb"(?:([0-9]{1,6})\*)?(.*)", re.S)
# control characters, and a carriage return that ends no line
CONTROL = re.compile(rb"[\0-\x08\x0b\x0c\x0e-\x1f\x7f]|\r(?!\n)")


#: Words that make a case a machine: its groups, their names with numbers and bearings, what names a bearing.
OF_MACHINE = re.compile(
    rf"&\s*(?:{'|'.join(OF_MACHINES)})\b|\b(?:name|bearing|station|offset)[\s(]*="
    rf"|^\s*(?:(?:{'|'.join(OF_MACHINES)})\b|[^%=]*[:(][^%=]*%)|{'|'.join(OF_MACHINES_TOO)}".encode(),
    re.I,
)


class Refused(Exception):
    """The text is no case; the words say why."""


class Unjudged(Exception):
    """The text may be a machine, whose values this reader does not know."""


@dataclass
class Assignment:
    """group%name(subscript) = values; subscript 0: none; values as text and whether in quotes."""

    group: str
    name: str
    subscript: int
    values: list[tuple[bytes, bool]] = field(default_factory=list)
    overrides: bool = False

    def undoes(self, other: "Assignment") -> bool:
        same = (self.group, self.name) == (other.group, other.name)
        return same and self.subscript in (0, other.subscript)

    def replaces(self, other: "Assignment") -> bool:
        """True where nothing is left of the other: an element leaves the rest of a list."""
        if not self.undoes(other) or not self.subscript or self.group == STUDY:
            return self.undoes(other)
        return len(other.values) == 1 and b"*" not in other.values[0][0]

    def put(self, others: list["Assignment"]) -> list["Assignment"]:
        """Behind the others in place of those it replaces; a study's where the first of them stood."""
        replaced = [i for i, each in enumerate(others) if self.replaces(each)]
        kept = [each for each in others if not self.replaces(each)]
        at = replaced[0] if replaced and self.group == STUDY else len(kept)
        return [*kept[:at], self, *kept[at:]]


class Scanner:
    """Where reading is."""

    def __init__(self, text: bytes):
        self.text, self.at = text, 0

    def skip(self, pattern: re.Pattern = BLANK) -> bytes:
        """Moves over blanks; gives the character behind them, empty at the end."""
        self.at = pattern.match(self.text, self.at).end()
        return self.text[self.at : self.at + 1]

    def take(self, pattern: re.Pattern) -> re.Match | None:
        found = pattern.match(self.text, self.at)
        if found:
            self.at = found.end()
        return found


def read(case: Case, known: set[str]) -> tuple[list[Assignment], bool]:
    """The assignments of a case, with those of --set in place; whether it has a study.

    Or Refused, or Unjudged.
    """
    if any(OF_MACHINE.search(text) for text in (case.text, *case.sets)):
        raise Unjudged
    assignments, groups = read_file(case.text, known | {STUDY})
    for argument in case.sets:
        assignments = read_set(argument).put(assignments)
    return assignments, STUDY in groups or any(each.group == STUDY for each in assignments)


def read_file(text: bytes, known: set[str]) -> tuple[list[Assignment], set[str]]:
    """The assignments of a file, and its groups."""
    if CONTROL.search(text):
        raise Refused("control character")
    scan = Scanner(text)
    scan.take(re.compile(rb"\xef\xbb\xbf"))
    groups, found = set(), []
    while scan.skip(COMMAS):
        if not scan.take(re.compile(b"&")):
            raise Refused("outside a group")
        group = scan.take(WORD)[0].lower().decode("latin-1")
        if group not in known or group in groups:
            raise Refused(f"group {group}")
        groups.add(group)
        read_group(scan, group, found)
    if not groups:
        raise Refused("no group")
    return found, groups


def read_set(argument: bytes) -> Assignment:
    """The assignment of --set."""
    group, percent, rest = argument.partition(b"%")
    if CONTROL.search(argument) or not percent or b"=" in group:
        raise Refused("--set")
    found = []
    scan = Scanner(rest + b" /")
    read_group(scan, group.strip(b" ").lower().decode("latin-1"), found)
    if len(found) != 1 or scan.skip():
        raise Refused("--set")
    found[0].overrides = True
    return found[0]


def read_group(scan: Scanner, group: str, found: list[Assignment]) -> None:
    """Assignments up to the end of the group."""
    while True:
        here = scan.skip(COMMAS)
        if here == b"/":
            scan.at += 1
            return
        if here in (b"&", b""):
            if scan.take(re.compile(rb"&end", re.I)):
                return
            raise Refused(f"{group} not closed")
        target = (STUDY_TARGET if group == STUDY else TARGET).fullmatch(scan.take(WORD)[0].lower())
        if not target or scan.skip() != b"=" or target[2] and int(target[2]) == 0:
            raise Refused("expected name = value")
        scan.at += 1
        new = Assignment(group, target[1].decode(), int(target[2] or 0), read_values(scan))
        if any(new.undoes(each) for each in found) or len(found) == MOST_ITEMS:
            raise Refused("twice, or too many")
        found.append(new)


def read_values(scan: Scanner) -> list[tuple[bytes, bool]]:
    """Values up to the next name or the end of the group: separated by blanks, or one comma each."""
    values, comma = [], True
    while True:
        here = scan.skip()
        if here == b",":
            if comma:
                raise Refused("a value is missing")
            comma = True
            scan.at += 1
            continue
        if here in (b"/", b"&", b""):
            break
        if here in (b"'", b'"'):
            quoted = scan.take(QUOTED)
            if not quoted:
                raise Refused("quote not closed")
            token = quoted[0][1:-1].replace(2 * here, here), True
        else:
            before = scan.at
            token = scan.take(WORD)[0], False
            if scan.skip() == b"=":
                scan.at = before
                break
        values.append(token)
        comma = False
        if len(values) > MOST_ITEMS:
            raise Refused("too many values")
    if not values:
        raise Refused("a value is missing")
    return values


def resolve(assignments: list[Assignment], variables: dict[str, Variable]) -> dict[str, tuple | None]:
    """Values of all variables, defaults included; None where this reader does not judge them."""
    given: dict[str, list[Assignment]] = {}
    for each in assignments:
        key = f"{each.group}%{each.name}"
        if key in OF_MACHINES_TOO:
            raise Unjudged
        if key not in variables:
            raise Refused(f"unknown {key}")
        given.setdefault(key, []).append(each)
    pads = len(numbers(variables[PIVOTS], given.get(PIVOTS, []), 0))
    found = {
        key: words(variable, given.get(key, []))
        if variable.is_text
        else numbers(variable, given.get(key, []), pads)
        for key, variable in variables.items()
    }
    if "output%keep" not in given and found["case%task"][0] in (b"equilibrium", b"coefficients"):
        found["output%keep"] = (b"summary",)
    if found["branch%point"] == (b"",):
        # written where it is given
        found.pop("branch%point")
    if found["case%task"] == (b"branch",) and found["output%keep"] != (b"all",):
        raise Refused("a branch keeps all of its points")
    if found["operation%final_speed_rpm"] == (None,):
        found["operation%final_speed_rpm"] = found["operation%speed_rpm"]
    found["bearing%machined_clearance"] = pad_clearances(found)
    for key in FOLLOWING:
        if set(found[key]) == {None}:
            # as if it were not given
            given.pop(key, None)
        found[key] = tuple(variables[key].default[0] if value is None else value for value in found[key])
    complete(found, given, variables)
    return found


#: The variable whose length is the number of pads.
PIVOTS = "pads%pivot_angle_deg"
#: What decides whether pads are those of the paper, and what is then theirs.
SIZE = (
    *("bearing%journal_radius", "bearing%axial_length"),
    *("pads%arc_deg", "pads%pivot_ratio", "pads%pivot_distance", "pads%density", "pads%thickness"),
)
BODY = ("pads%mass", "pads%inertia", "pads%centre_tangential", "pads%centre_radial")
#: What may be left out though it has a default, and is never below 0.
FOLLOWING = (
    *("bearing%machined_clearance", "bearing%viscosity", "pads%mass", "pads%inertia"),
    *("rotor%unbalance", "friction%characteristic_load"),
)
#: What stands in the place of which of these.
REPLACED = (
    ("rotor%balance_grade", "rotor%unbalance"),
    ("friction%bristle_damping", "friction%characteristic_load"),
)


def pad_clearances(found: dict[str, tuple | None]) -> tuple[float | None, ...]:
    """The pad clearance of each pad, as given or by its preload; None: neither."""
    names = ("machined_clearance", "preload", "assembled_clearance")
    pads = list(zip(*(found[f"bearing%{name}"] for name in names), strict=True))
    if any(machined is not None and preload is not None for machined, preload, _ in pads):
        raise Refused("preload and pad clearance")
    return tuple(machined if preload is None else own / (1 - preload) for machined, preload, own in pads)


def complete(found: dict[str, tuple | None], given: dict[str, list], variables: dict[str, Variable]) -> None:
    """What follows from other variables."""
    complete_oil(found, given)
    for key, other in REPLACED:
        if found[key] == (None,):
            continue
        if other in given:
            raise Refused(f"{key} and {other}")
        found[other] = ()
    if found["rotor%balance_grade"] == (None,) != found["rotor%balance_speed_rpm"]:
        raise Refused("the speed of no grade")
    bodies = [each for key in (*BODY, "pads%density", "pads%thickness") for each in given.get(key, ())]
    if any(value != variables[key].default[0] for key in SIZE for value in found[key]):
        # no closed forms here; pads may also have values given in part
        found.update({key: None for key in BODY if key not in given or any(map(subscript, given[key]))})
    if found["pads%motion"] == (b"fixed",):
        found.update({key: () for key in BODY if key not in given})
    surplus = {"pads%density", "pads%mass"}, {"pads%thickness", *BODY}
    if any(keys <= given.keys() for keys in surplus) and not any(map(subscript, bodies)):
        raise Refused("density or thickness without use")
    found.update(dict.fromkeys(("bearing%preload", "pads%density", "pads%thickness"), ()))
    # what is left out has no line
    found.update({key: () for key, values in found.items() if values and set(values) == {None}})


#: ISO viscosity grades.
GRADES = (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)
#: The numbers that tell which law of the viscosity is meant.
OF_LAW = {
    b"walther": ("oil%grade", "oil%kinematic_viscosity"),
    b"exponential": ("oil%reference_viscosity", "oil%temperature_exponent"),
    b"constant": ("bearing%viscosity",),
}


def complete_oil(found: dict[str, tuple | None], given: dict[str, list]) -> None:
    """The law of the viscosity, and whether it has its numbers alone."""

    def there(key: str) -> bool:
        return key in given and set(found[key]) != {None}

    if found["oil%grade"] == (0.0,):
        found["oil%grade"] = (None,)
    if "oil%law" not in given:
        found["oil%law"] = (
            next(law for law in OF_LAW if law == b"constant" or any(map(there, OF_LAW[law]))),
        )
    (law,) = found["oil%law"]
    if any(there(key) for other in OF_LAW if other != law for key in OF_LAW[other]):
        raise Refused("numbers of another law")
    if law == b"constant":
        return
    found["bearing%viscosity"] = ()
    (grade,), points, at = (
        found[f"oil%{name}"] for name in ("grade", "kinematic_viscosity", "at_temperature")
    )
    if law == b"exponential":
        if not all(map(there, OF_LAW[law])):
            raise Refused("a law without its numbers")
    elif grade:
        if grade not in GRADES or points != (None, None) or at != (40, 100):
            raise Refused("no grade alone")
    elif None in points or at[0] >= at[1] or points[0] < points[1]:
        raise Refused("no points of falling viscosity")


def subscript(assignment: Assignment) -> int:
    return assignment.subscript


def words(variable: Variable, assignments: list[Assignment]) -> tuple[bytes]:
    """The value of a text."""
    value = variable.default[0]
    for each in assignments:
        value, quoted = each.values[0]
        if len(each.values) > 1 or each.subscript:
            raise Refused("takes one text")
        if variable.choices:
            value = value.strip(b" ").lower()
            if value.decode("latin-1") not in variable.choices:
                raise Refused("not one of the choices")
        elif not (quoted or each.overrides) or len(value) > MOST_TEXT:
            raise Refused("text in quotes")
        try:
            value.decode("utf-8")
        except UnicodeDecodeError:
            raise Refused("not UTF-8") from None
    return (value,)


def numbers(variable: Variable, assignments: list[Assignment], pads: int) -> tuple[float, ...]:
    """The values of a variable of numbers."""
    size = pads if variable.per_pad else len(variable.default)
    most = variable.most if variable.fixes_pads else size
    values = list(variable.default) if variable.fixes_pads else list(variable.default[:1] * size)
    if not variable.per_pad:
        values = list(variable.default)
    if variable.key in FOLLOWING:
        values = [None] * size
    taken: set[int] = set()
    for each in assignments:
        new = list(number_list(variable, each, most))
        if variable.fixes_pads and each.subscript:
            raise Refused("angles without subscript")
        if variable.fixes_pads:
            values = new
        elif each.subscript:
            elements = set(range(each.subscript, each.subscript + len(new)))
            # an element that the file itself gives twice
            if not each.overrides and (elements & taken or size == 1 and each is not assignments[0]):
                raise Refused("element given twice")
            taken |= elements
            values[each.subscript - 1 : each.subscript - 1 + len(new)] = new
        elif len(new) == size:
            values = new
        elif len(new) == 1 and variable.per_pad:
            values = new * size
        else:
            raise Refused("number of values")
    return tuple(values)


def number_list(variable: Variable, assignment: Assignment, most: int):
    """The numbers of an assignment, each checked."""
    count = max(assignment.subscript, 1) - 1
    for text, quoted in assignment.values:
        repeat, digits = REPEAT.fullmatch(text.lower()).groups()
        if quoted or repeat and int(repeat) == 0 or len(digits) > LONGEST_NUMBER:
            raise Refused("no number")
        if not NUMBER.fullmatch(digits):
            raise Refused("no number")
        value = float(digits.replace(b"d", b"e"))
        if value == -1 and variable.low >= 0 and (None in variable.default or variable.key in FOLLOWING):
            value = None
        elif not math.isfinite(value) or not variable.low <= value <= variable.high:
            raise Refused("out of range")
        if variable.whole and not re.fullmatch(rb"[+-]?[0-9]+", digits):
            raise Refused("not whole")
        count += int(repeat or 1)
        if count > most:
            raise Refused("too many values")
        # the sign of a zero is kept by reals alone
        yield from [float(int(value)) if variable.whole and value is not None else value] * int(repeat or 1)


LINE = re.compile(rb"^(?:&(\w+)|  (\w+) = (.*?)(?: +! (?:default|derived))?|/)$", re.M)


def resolved(text: bytes) -> dict[str, tuple]:
    """Values of a resolved case, as the program writes it: one variable a line, which --check marks."""
    found, group = {}, ""
    for line in LINE.finditer(text):
        if line[1]:
            group = line[1].decode()
        elif line[2]:
            value = line[3]
            if value in (b".true.", b".false."):
                said = (value,)
            elif value[:1] == b"'":
                said = (value[1:-1].replace(b"''", b"'"),)
            else:
                said = tuple(float(word) for word in value.split(b","))
            found[f"{group}%{line[2].decode()}"] = said
    return found
