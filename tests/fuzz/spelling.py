"""A case in any spelling that the reader allows: the same values in ever different text."""

from dataclasses import dataclass, field, replace
from decimal import Decimal
from itertools import groupby
from random import Random

from harness import Case
from reader import LONGEST_NUMBER
from reference import Variable

BOM = b"\xef\xbb\xbf"
COMMENT = b"! any text, it's = / & \" 1*2 \xc3\xa4 \xff"


@dataclass
class Item:
    """One assignment: variable, what stands before and behind the equals sign; where it came to stand."""

    key: str
    target: bytes
    values: list[bytes]
    equals: bytes = b"="
    line: int = 0


@dataclass
class Group:
    """One group of a case."""

    name: bytes
    items: list[Item] = field(default_factory=list)
    close: bytes = b"/"
    line: int = 0


def case(
    dice: Random, inputs: dict[str, tuple], variables: dict[str, Variable], study: Group | None = None
) -> Case:
    """The values as a case file, some of it by --set, maybe with a study."""
    units = [spelled(dice, variables[key], value) for key, value in inputs.items()]
    sets, in_file = [], []
    share = dice.choice((0, 0, 0.1, 1))
    for unit in units:
        if len(unit) > 1 or dice.random() >= share:
            in_file.append(unit)
            continue
        sets.append(argument(dice, unit[0]))
        if dice.random() < 0.3:
            # what the file says then does not matter
            wrong = dice.choice(([b"1e9"], [b"-1"], [b"'no'"], [b"x", b"y"], [b"1"]))
            in_file.append([replace(unit[0], values=wrong)])
        if dice.random() < 0.1:
            sets.insert(0, argument(dice, replace(unit[0], values=[b"'undone'"])))
    drawn = groups(dice, in_file, variables)
    if study:
        drawn.insert(dice.randint(0, len(drawn)), study)
        if dice.random() < 0.3:
            sets.append(argument(dice, study.items.pop()))
    text = file_text(dice, drawn)
    return Case(text, tuple(sets))


def groups(dice: Random, units: list[list[Item]], variables: dict[str, Variable]) -> list[Group]:
    """The units in groups, both in any order; now and then an empty group."""
    dice.shuffle(units)
    by_group: dict[str, list[Item]] = {}
    for unit in units:
        by_group.setdefault(unit[0].key.partition("%")[0], []).extend(unit)
    if not by_group or dice.random() < 0.1:
        by_group.setdefault(dice.choice(list(variables)).partition("%")[0], [])
    names = list(by_group)
    dice.shuffle(names)
    return [Group(cased(dice, name), by_group[name], dice.choice((b"/", b"/", b"/", b"&end", b"&END")))
            for name in names]  # fmt: skip


def cased(dice: Random, name: str) -> bytes:
    """A name in small letters, capitals or both."""
    kind = dice.randrange(4)
    if kind == 0:
        name = name.upper()
    elif kind == 1:
        name = "".join(dice.choice((letter, letter.upper())) for letter in name)
    return name.encode()


def spelled(dice: Random, variable: Variable, value: tuple) -> list[Item]:
    """The assignments that give a variable its value."""
    if variable.is_text:
        return [item(dice, variable, [word(dice, variable, value[0])])]
    if not variable.per_pad or variable.fixes_pads or dice.random() < 0.5:
        if variable.per_pad and not variable.fixes_pads and len({repr(x) for x in value}) == 1:
            value = value[: dice.choice((1, len(value)))]
        return [item(dice, variable, listed(dice, variable, value))]
    # one value for all pads, then those that differ, by their subscripts
    unit = [item(dice, variable, listed(dice, variable, value[:1]))]
    at = 0
    for differs, run in groupby(value, lambda x: repr(x) != repr(value[0])):
        length = len(list(run))
        while differs and length:
            now = dice.randint(1, length)
            unit.append(item(dice, variable, listed(dice, variable, value[at : at + now]), at + 1))
            at, length = at + now, length - now
        at += length
    last = unit[1:]
    dice.shuffle(last)
    return unit[:1] + last


def item(dice: Random, variable: Variable, values: list[bytes], subscript: int = 0) -> Item:
    target = cased(dice, variable.name)
    if subscript:
        target += b"(%s)" % str(subscript).zfill(dice.choice((1, 1, 2, 4))).encode()
    return Item(variable.key, target, values)


def word(dice: Random, variable: Variable, value: bytes) -> bytes:
    """A text in quotes of either kind; one of a choice also in capitals, with blanks, or bare."""
    if variable.choices:
        value = cased(dice, value.decode())
        if dice.random() < 0.3:
            return value
        value = dice.choice((b"", b" ", b"  ")) + value + dice.choice((b"", b" "))
    quote = dice.choice((b"'", b'"'))
    return quote + value.replace(quote, 2 * quote) + quote


def listed(dice: Random, variable: Variable, values: tuple) -> list[bytes]:
    """Numbers one by one or repeated."""
    said, at = [], 0
    while at < len(values):
        same = 1
        while at + same < len(values) and repr(values[at + same]) == repr(values[at]):
            same += 1
        count = dice.choice((1, same))
        digits = number(dice, values[at], variable.whole)
        if count > 1 or dice.random() < 0.1:
            digits = str(count).zfill(dice.choice((1, 1, 1, 6))).encode() + b"*" + digits
        said.append(digits)
        at += count
    return said


def number(dice: Random, value: float, whole: bool) -> bytes:
    """A number in any form that reads back to the same bits."""
    if whole:
        sign = dice.choice(("", "+")) if value >= 0 else "-"
        return (sign + str(abs(int(value))).zfill(dice.choice((1, 1, 5, 30)))).encode()
    sign, digits, exponent = Decimal(repr(value)).as_tuple()
    said = "".join(map(str, digits))
    kind = dice.randrange(5)
    if kind == 0:
        text = repr(abs(value))
    elif kind == 1:
        text = f"{abs(value):.{dice.choice((16, 17, 25))}e}"
    else:
        # the point anywhere
        more = dice.choice((0, 0, 3))
        said = said.zfill(dice.choice((1, len(said) + 2))) + "0" * more
        point = dice.randint(0, len(said))
        power = exponent - more + len(said) - point
        text = said[:point] + "." + said[point:]
        if power or dice.random() < 0.3:
            text += f"e{dice.choice(('', '+')) if power >= 0 else '-'}{abs(power):0{dice.choice((1, 3))}d}"
    text = text.replace("e", dice.choice("eEdD"))
    if len(text) > 2 and text.endswith(".0") and dice.random() < 0.3:
        text = text[:-1]
    text = ("-" if sign else dice.choice(("", "", "+"))) + text
    read_back = float(text.lower().replace("d", "e"))
    assert repr(read_back) == repr(value), (text, value)
    return text.encode() if len(text) <= LONGEST_NUMBER else repr(value).encode()


def argument(dice: Random, item: Item) -> bytes:
    """An assignment as an argument of --set."""
    group = cased(dice, item.key.partition("%")[0])
    blank = dice.choice((b"", b"", b" "))
    comma = dice.choice((b",", b" ", b" , "))
    end = dice.choice((b"", b"", b" ", b","))
    return blank + group + blank + b"%" + item.target + blank + b"=" + blank + comma.join(item.values) + end


def file_text(dice: Random, groups: list[Group]) -> bytes:
    """Text of the groups; puts the lines where they stand into them and their items."""
    newline = dice.choice((b"\n", b"\n", b"\r\n"))
    plain = dice.random() < 0.4
    out = bytearray(BOM if dice.random() < 0.1 else b"")

    def blank(needed: bool = False) -> bytes:
        """Any blanks; at least one where needed."""
        if plain:
            return b" " if needed else b""
        kind = dice.randrange(8)
        if kind < 4:
            return b" " * kind if kind or not needed else b" "
        if kind == 4:
            return b"\t"
        if kind == 5:
            return dice.choice((b"", b" ")) + COMMENT + newline
        return newline + b" " * dice.randrange(4)

    def line() -> int:
        return out.count(b"\n") + 1

    out += blank()
    for group in groups:
        out += b"&"
        group.line = line()
        out += group.name
        follows = blank(needed=True)
        for each in group.items:
            out += follows
            each.line = line()
            out += each.target + blank() + each.equals + blank()
            for i, value in enumerate(each.values):
                if i:
                    separator = blank() + b"," + blank() if dice.random() < 0.6 else blank(needed=True)
                    out += separator
                out += value
            follows = blank() + b"," + blank() if dice.random() < 0.4 else blank(needed=True)
        if group.close.startswith(b"&") and not group.items:
            out += blank(needed=True)
        elif group.items:
            out += dice.choice((b"", follows))
        ends = [b"", blank(), newline]
        if group.close.strip() in (b"/", b"&end", b"&END"):
            ends.append(blank() + b"," + blank())
        out += group.close + dice.choice(ends)
    return bytes(out)
