"""Parameter studies for drawn cases, right ones and wrong ones."""

from random import Random

import cases
import spelling
from reference import Variable
from spelling import Group, Item

# values of a varied number that are none
NO_VALUES = (
    b"1:2 1:2:0 2:1:1 1:2:-1 1:2:*1 1:2:*0 0:1:*2 1:0:*2 -1:1:*2 1:2:*0.5 2:1:*2 1:2:*-2 1:1e9:1e-9 1:2:3:4 "
    b"a:b:c 1::1 :: ::: : :1:1 1:2: 1:2:* 1:2:** 1:2:2* 2*3 2*1:2:1 1e101:1e102:1e101 1e-101:1:1 nan:1:1 "
    b"1:inf:1 1:2:1+1 1:1e400:1"
).split()
NO_TARGETS = (
    b"mass case%title sweep%order sweep%rotor%mass rotor%mass%x rotor% %mass rotor%% order% orde".split()
)


def draw(dice: Random, variables: dict[str, Variable]) -> tuple[Group, int]:
    """A study of some variables, and how many runs it has."""
    zipped = dice.random() < 0.4
    count = dice.randint(1, 5)
    items, runs = [], 1
    for variable in dice.sample(variable_alone(variables), dice.randint(1, 3)):
        values, number = varied(dice, variable, count if zipped else None)
        items.append(Item(f"sweep%{variable.key}", target(dice, variable), values))
        runs = number if zipped else runs * number
    order = b"'zip'" if zipped else b"'product'"
    if zipped or dice.random() < 0.5:
        items.insert(dice.randint(0, len(items)), Item("sweep%order", spelling.cased(dice, "order"), [order]))
    return Group(spelling.cased(dice, "sweep"), items), runs


def variable_alone(variables: dict[str, Variable]) -> list[Variable]:
    """Variables of one value that fit whatever the others are."""
    apart = ("pads", *cases.OF_TASK)
    # an oil may have another law of its viscosity
    alone = (*cases.SPECIAL, "case%title", "bearing%viscosity")
    return [v for key, v in variables.items() if key not in alone
            and v.group not in apart and len(v.default) == 1]  # fmt: skip


def target(dice: Random, variable: Variable) -> bytes:
    element = b"(1)" if not variable.is_text and dice.random() < 0.1 else b""
    return spelling.cased(dice, variable.key) + element


def varied(dice: Random, variable: Variable, count: int | None) -> tuple[list[bytes], int]:
    """Values of a variable, this many if that is given, and how many."""
    number = count or dice.choice((1, 2, 3, dice.randint(1, 8)))
    if variable.is_text:
        return [
            spelling.word(dice, variable, dice.choice(variable.choices).encode()) for _ in range(number)
        ], number
    if number > 1 and dice.random() < 0.6:
        return [spread(dice, variable, number)], number
    return [
        spelling.number(dice, cases.number(dice, variable), variable.whole) for _ in range(number)
    ], number


def spread(dice: Random, variable: Variable, number: int) -> bytes:
    """A range of this many values within the limits."""
    if variable.whole:
        step = dice.randint(1, max(1, min(1000, int(variable.high - variable.low) // number)))
        first = dice.randint(int(variable.low), int(variable.high) - step * (number - 1))
        last = min(first + step * (number - 1) + dice.randrange(step), int(variable.high))
        if dice.random() < 0.3:
            first, last, step = last, first, -step
        return b"%d:%d:%d" % (first, last, step)
    low, high = max(variable.low, 1e-9), variable.high * 0.99
    first, last = (cases.log_between(dice, low, high) for _ in range(2))
    part = dice.choice((0.0, 0.5)) if number > 1 else 0.5
    words = [spelling.number(dice, x, whole=False) for x in (first, last)]
    if dice.random() < 0.5:
        factor = (last / first) ** (1 / (number - 1 + part))
        return b":".join((*words, b"*" + spelling.number(dice, factor, whole=False)))
    stride = (last - first) / (number - 1 + part)
    return b":".join((*words, spelling.number(dice, stride, whole=False)))


def wrong(dice: Random, groups: list[Group], variables: dict[str, Variable]) -> tuple:
    """Adds a study with one fault; gives what must be named."""
    group = Group(b"sweep")
    groups.append(group)
    number = dice.choice([v for v in variable_alone(variables) if not v.is_text])
    good = Item(f"sweep%{number.key}", spelling.cased(dice, number.key), [b"1", b"2"])
    kind = dice.randrange(7)
    if kind == 0:
        good.values[dice.randrange(2)] = dice.choice(NO_VALUES)
        group.items = [good]
        return good, b"sweep%" + number.key.encode()
    if kind == 1:
        group.items = [Item("sweep%", dice.choice(NO_TARGETS), [b"1", b"2"])]
        return (group.items[0],)
    if kind == 2:
        group.items = [
            good,
            Item("sweep%order", b"order", [dice.choice((b"1", b"'zap'", b"''", b"'zip' 'product'"))]),
        ]
        return group.items[1], b"order"
    if kind == 3:
        other = next(v for v in variable_alone(variables) if v is not number)
        group.items = [good, Item("sweep%order", b"order", [b"'zip'"])]
        group.items.append(Item(f"sweep%{other.key}", other.key.encode(), [b"1:3:1"]))
        return group, b"&sweep"
    if kind == 4:
        group.items = [] if dice.random() < 0.5 else [Item("sweep%order", b"order", [b"'zip'"])]
        return group, b"&sweep"
    if kind == 5:
        many = dice.sample(variable_alone(variables), 3)
        group.items = [Item(f"sweep%{v.key}", v.key.encode(), [b"1:101:1"]) for v in many]
        return group, b"runs"
    group.items = [good, Item(good.key, good.target + dice.choice((b"(1)", b"")), [b"1"])]
    return group.items[1], number.key.encode()
