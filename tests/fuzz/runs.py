"""What a case stands for, by the second reader: one run, or the runs of a study."""

import math
from dataclasses import replace

from harness import Case
from reader import LONGEST_NUMBER, NUMBER, STUDY, Assignment, Refused, read, resolve, resolved
from reference import Variable

MOST_RUNS = 1000000
# the runs that the harness shows, with the last
SHOWN = 3
# part of a stride by which the last value of a range may miss its end; sizes of its numbers
ROUNDING = 1e-6
SMALLEST, LARGEST = 1e-100, 1e100


def expected(case: Case, variables: dict[str, Variable]) -> tuple[int, list[dict[str, tuple]]]:
    """How many runs, 0 without a study, and the values of those that are shown; or Refused."""
    assignments, is_study = read(case, {v.group for v in variables.values()})
    base = [each for each in assignments if each.group != STUDY]
    if not is_study:
        return 0, [resolve(base, variables)]
    zipped, varied = varied_variables([each for each in assignments if each.group == STUDY], base)
    counts = [sum(count_of(piece) for piece in pieces) for _, pieces in varied]
    runs = counts[0] if zipped else math.prod(counts)
    if zipped and len(set(counts)) > 1 or runs > MOST_RUNS:
        raise Refused("number of runs")
    shown = [*range(1, min(SHOWN, runs) + 1), *([runs] if runs > SHOWN else [])]
    return runs, [resolve(run(k, zipped, varied, counts, base), variables) for k in shown]


def answered(text: bytes) -> tuple[int, list[dict[str, tuple]]]:
    """The same from what the harness says."""
    if b"\0" not in text:
        return 0, [resolved(text)]
    count, _, *cases = text.split(b"\0")[:-1]
    return int(count), [resolved(inputs) for inputs in cases]


def varied_variables(assignments: list[Assignment], base: list[Assignment]):
    """Whether the order is zip; assignments and pieces of the varied variables."""
    zipped, varied = False, []
    for each in assignments:
        if each.name == "order":
            word = each.values[0][0].strip(b" ").lower()
            if len(each.values) > 1 or each.subscript or word not in (b"product", b"zip"):
                raise Refused("order")
            zipped = word == b"zip"
            continue
        group, percent, name = each.name.partition("%")
        if not percent or not group or not name or "%" in name:
            raise Refused("no group%name")
        if group == STUDY or each.name == "case%title":
            raise Refused("cannot be varied")
        target = Assignment(group, name, each.subscript, overrides=True)
        if any(target.undoes(other) or other.undoes(target) for other, _ in varied):
            raise Refused("varied twice")
        if any(target.undoes(other) and other.overrides for other in base):
            raise Refused("varied and set")
        varied.append((target, [piece(*value) for value in each.values]))
    if not varied:
        raise Refused("nothing is varied")
    return zipped, varied


def piece(text: bytes, quoted: bool):
    """A single value, or first, step, whether that is a factor, and count."""
    if quoted or b":" not in text:
        if b"*" in text and not quoted:
            raise Refused("repeat in a study")
        return text, quoted
    parts = text.lower().split(b":")
    if len(parts) != 3:
        raise Refused("no range")
    geometric = parts[2].startswith(b"*")
    parts[2] = parts[2].removeprefix(b"*")
    first, last, step = (range_number(part) for part in parts)
    if geometric:
        away = (abs(last) - abs(first)) * (step - 1) < 0
        if first * last == 0 or (first > 0) != (last > 0) or step <= 0 or step == 1 or away:
            raise Refused("no range")
        steps = math.log(last / first) / math.log(step)
    else:
        if step == 0 or (last - first) * step < 0:
            raise Refused("no range")
        steps = (last - first) / step
    if steps >= MOST_RUNS:
        raise Refused("too many values")
    return first, step, geometric, 1 + math.floor(steps + ROUNDING)


def range_number(text: bytes) -> float:
    """A number of a range."""
    if not NUMBER.fullmatch(text) or len(text) > LONGEST_NUMBER:
        raise Refused("no number")
    value = float(text.replace(b"d", b"e"))
    if not (value == 0 or SMALLEST <= abs(value) <= LARGEST):
        raise Refused("size of a number")
    return value


def count_of(piece) -> int:
    return piece[3] if len(piece) == 4 else 1


def value_of(pieces, n: int) -> tuple[bytes, bool]:
    """The n-th value, from 0, as it would stand in a case."""
    for each in pieces:
        if n < count_of(each):
            break
        n -= count_of(each)
    if len(each) == 2:
        return each
    first, step, geometric, _ = each
    x = first * step**n if geometric else first + n * step
    whole = x == round(x) and abs(x) < 1e15
    return str(round(x) if whole else x).encode(), False


def run(k: int, zipped: bool, varied, counts: list[int], base: list[Assignment]) -> list[Assignment]:
    """The assignments of the k-th run."""
    at, assignments = k - 1, base
    places = []
    for count in reversed(counts):
        places.insert(0, k - 1 if zipped else at % count)
        at //= count
    for (target, pieces), place in zip(varied, places, strict=True):
        assignments = replace(target, values=[value_of(pieces, place)]).put(assignments)
    return assignments
