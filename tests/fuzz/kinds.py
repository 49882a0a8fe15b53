"""Kinds of faults in one assignment or group: each puts its fault in place and says what must be named."""

import math
from dataclasses import dataclass, replace
from random import Random

import spelling
import studies
from reference import Variable
from spelling import Group, Item

# numbers that are none, though Fortran's own reader takes some of them
NO_NUMBERS = (
    b"1+2 1-2 0x10 1_8 1q3 1.5.2 . + - 1e 1e+ 1d- --1 +-1 .true. T (1) (1,2) 1kg kg 1e1.5 1e5e5 1,5e z10 1;2 "
    b"nan(1) infinit 1:2 $1 #1 1% 0*1 -1*1 1**1 3* *1 1*1*1 1.0*1 1234567*1 1^2 \xc2\xb2 \xef\xbc\x91 "
).split(b" ")[:-1]
SPECIAL = b"nan NaN inf -inf +Infinity INFINITY 1e400 -1d999 1e309 1.8e308".split()
NO_NAMES = (
    b"mas mass2 m#ss mass% \xc3\xa4 _ 2 mass.x x(0) x() x(-1) x(1:2) x(1)(1) x(00000) x(10000) (1)".split()
)
# text outside the groups, and what the refusal names
STRAY = {
    b"x": b"'x'",
    b"x=1": b"'x'",
    b"/": b"'/'",
    b"'x'": b"'''",
    b"=": b"'='",
    b"rotor%mass=1": b"'rotor%mass'",
    b"\xef\xbb\xbf": b"outside a group",
    b"&": b"behind &",
    b"& rotor /": b"behind &",
}


@dataclass
class Spot:
    """Where the fault goes: a variable, its assignment, its group among the groups of the case."""

    variable: Variable
    item: Item
    group: Group
    groups: list[Group]
    variables: dict[str, Variable]

    @property
    def key(self) -> bytes:
        return self.variable.key.encode()

    @property
    def one(self) -> bytes:
        """An allowed value."""
        return default(self.variable, self.variable.default[0])


def default(variable: Variable, value) -> bytes:
    """A default as text; of a variable that is left out, its highest value."""
    value = variable.high if value is None else value
    if variable.is_text:
        return b"'" + value + b"'"
    return str(int(value)).encode() if variable.whole else repr(value).encode()


# what follows gives what must be named, or None where the kind does not fit the variable


def out_of_range(dice: Random, spot: Spot):
    """One of the values just or far beyond a limit."""
    variable = spot.variable
    if variable.is_text:
        return None
    far = dice.random() < 0.5
    if variable.whole:
        # -1 takes back a number that may be left out
        near = 2 if variable.default[0] is None else 1
        wrong = dice.choice((variable.low - (10**9 if far else near), variable.high + (10**9 if far else 1)))
        said = str(int(wrong)).encode()
    else:
        below = -1e300 if far else math.nextafter(variable.low, -math.inf)
        above = 1e300 if far else math.nextafter(variable.high, math.inf)
        said = spelling.number(dice, dice.choice((below, above)), whole=False)
    return replaced(dice, spot, said)


def replaced(dice: Random, spot: Spot, said: bytes):
    """Puts it in place of one of the values."""
    spot.item.values[dice.randrange(len(spot.item.values))] = said
    return spot.item, spot.key


def no_number(dice: Random, spot: Spot):
    """Something else for a number."""
    if spot.variable.is_text:
        return None
    return replaced(dice, spot, dice.choice((*NO_NUMBERS, *SPECIAL, b"'1'", b'"1"', b"''", b"9" * 70)))


def not_whole(dice: Random, spot: Spot):
    """A whole number with a point or an exponent."""
    if not spot.variable.whole:
        return None
    return replaced(dice, spot, dice.choice((b"8.0", b"8.", b"1e1", b"1d1", b"8.5", b"1*8.0", b".8e1")))


def no_text(dice: Random, spot: Spot):
    """No text, several, or none of the choices."""
    if not spot.variable.is_text:
        return None
    wrong = [b"1", b"'a' 'b'", b"bare", b"2*'a'", b"'a'b", b"'a\xff'", b"'\xc3'", b"'\xed\xa0\x80'"]
    if spot.variable.choices:
        first, second = (word.encode() for word in dice.sample(spot.variable.choices, 2))
        wrong += [b"''", b"' '", b"'" + first + b"x'", b"'" + first[:-1] + b"'", b"1*" + first]
        wrong += [b"'" + first + b" " + second + b"'"] * 3
    else:
        wrong += [b"'" + b"x" * 1001 + b"'", b"'" + b"x" * 50000 + b"'"]
    spot.item.values = [dice.choice(wrong)]
    return spot.item, spot.key


def missing(dice: Random, spot: Spot):
    """No value, or one missing among others."""
    values = spot.item.values
    spot.item.values = dice.choice(([], [b",", *values], [*values, b",,", values[-1]], [b"!\n"]))
    return spot.item, spot.key


def too_many(dice: Random, spot: Spot):
    """More values than there are elements, or too few."""
    variable = spot.variable
    if variable.is_text:
        return None
    kind = dice.randrange(4)
    if kind == 0:
        spot.item.values = [spot.one] * dice.choice((variable.most + 1, 1001))
    elif kind == 1:
        spot.item.values = [dice.choice((b"%d*" % (variable.most + 1), b"999999*")) + spot.one]
    elif kind == 2:
        spot.item.target += dice.choice((b"(%d)" % (variable.most + 1), b"(9999)"))
    elif len(variable.default) == 2 and not variable.per_pad:
        spot.item.values = [spot.one]
    else:
        return None
    return spot.item, spot.key


def twice(dice: Random, spot: Spot):
    """The same variable once more."""
    again = replace(spot.item, target=spelling.cased(dice, spot.variable.name), values=list(spot.item.values))
    spot.group.items.append(again)
    return again, spot.key


def element_twice(dice: Random, spot: Spot):
    """Two lists with a common element, or the only element once more."""
    variable = spot.variable
    if variable.is_text or variable.fixes_pads:
        return None
    name = spelling.cased(dice, variable.name)
    size = 2 if len(variable.default) == 2 else 1
    first = replace(spot.item, target=name + b"(1)", values=[spot.one] * size)
    again = replace(spot.item, target=name + (b"(2)" if size == 2 else b"(01)"), values=[spot.one])
    spot.group.items += [first, again]
    if len(variable.default) == 1 and not variable.per_pad:
        spot.group.items.remove(dice.choice((first, spot.item)))
        again = spot.group.items[-1]
    return again, spot.key


def unknown(dice: Random, spot: Spot):
    """A name that is none."""
    name = dice.choice(NO_NAMES)
    new = Item(spot.item.key, name, [b"1"])
    spot.group.items.insert(0, new)
    return new, name


def no_equals(dice: Random, spot: Spot):
    """Something else for the equals sign."""
    item, items = spot.item, spot.group.items
    if spot.variable.fixes_pads:
        # with another number of pads another variable may be the first that is wrong
        return None
    item.equals = dice.choice((b" ", b" : ", b"==", b"= ="))
    if item.equals in (b"==", b"= ="):
        return item, spot.key
    if items[0] is item:
        return (item,)
    # it reads as one more value of what stands before
    return (items[items.index(item) - 1],)


def unknown_group(dice: Random, spot: Spot):
    """A group that is none."""
    spot.group.name = dice.choice((b"roter", b"x", b"rotor%mass", b"case2", b"end", b"rotor(", b"\xc3\xa4"))
    return spot.group, b"&" + spot.group.name


def group_twice(dice: Random, spot: Spot):
    """The group once more."""
    again = Group(spot.group.name.swapcase())
    spot.groups.append(again)
    return again, b"&" + spot.group.name.lower()


def unclosed(dice: Random, spot: Spot):
    """A group without an end."""
    spot.group.close = dice.choice((b"", b"! /\n", b"& /", b"&\n"))
    return spot.group, b"&" + spot.group.name.lower()


def unclosed_quote(dice: Random, spot: Spot):
    """A quote without its counterpart on the line."""
    spot.item.values = [dice.choice((b"'x\n", b'"x\n', b"'x''\n", b"'\n'", b"'x\r\n'", b"\"x'\n"))]
    return spot.item, spot.key


def stray(dice: Random, spot: Spot):
    """Text outside the groups."""
    word = dice.choice(list(STRAY))
    spot.group.close = b"/ " + word + b"\n"
    return (STRAY[word],)


def control(dice: Random, spot: Spot):
    """A control character anywhere outside comments, or a carriage return that ends no line."""
    character = dice.choice((b"\0", b"\x01", b"\x1b", b"\x7f", b"\x0b", b"\r", b"\x08")) + b"x"
    spot.item.values.append(b"! " + character + b"\n" if dice.random() < 0.3 else character)
    return (b"not a text file",)


def bad_study(dice: Random, spot: Spot):
    """A study that is none."""
    return studies.wrong(dice, spot.groups, spot.variables)


KINDS = (
    out_of_range,
    no_number,
    not_whole,
    no_text,
    missing,
    too_many,
    twice,
    element_twice,
    unknown,
    no_equals,
    unknown_group,
    group_twice,
    unclosed,
    unclosed_quote,
    stray,
    control,
    bad_study,
)
