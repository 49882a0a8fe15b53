"""Cases changed byte by byte or spliced, and a case made as small as it goes."""

from collections.abc import Callable
from dataclasses import replace
from random import Random

from harness import Case

# what means something to the reader, and what does to other readers
PIECES = (
    b"' \" '' \"\" / & = , ! * ( ) % & ; : $ ( (1) (2) (01) 2* 24* 1*1 &end &END &case &rotor &pads /& "
    b"mass mass= title=' task= 'march' arc_deg= pivot_angle_deg= mass(1)= nan inf 1e400 1e-400 1d3 -0 +1. .5 "
    b"1e99999999999 999999* 1000001 .true. rotor%mass=1 =1 == ,, , --set &sweep sweep% order='zip' 1:9:2 "
    b"1:8:*2 : :* rotor%mass= \xef\xbb\xbf \xff \xc3\xa4 \xc2\x9b"
).split(b" ")
BLANKS = (b" ", b"\n", b"\r\n", b"\r", b"\t", b"\n\n", b"\0", b"\x1b", b" ! x\n")
LONGEST = 4000


def mutated(dice: Random, cases: list[Case]) -> Case:
    """A changed case: its text, or one of its arguments of --set."""
    # a short case is read faster, and less of it stands in the way
    case = min(dice.choices(cases, k=3), key=lambda case: len(case.text))
    other = dice.choice(cases)
    if case.sets and dice.random() < 0.3:
        sets = list(case.sets)
        i = dice.randrange(len(sets))
        sets[i] = changed(dice, sets[i], dice.choice((other.text, *other.sets))).replace(b"\0", b"")
        if dice.random() < 0.1:
            dice.shuffle(sets)
        return replace(case, sets=tuple(sets))
    if dice.random() < 0.05:
        return replace(case, sets=(*case.sets, *other.sets)[:20])
    return replace(case, text=changed(dice, case.text, other.text))


def changed(dice: Random, text: bytes, other: bytes) -> bytes:
    """One change or some."""
    for _ in range(dice.choice((1, 1, 1, 2, 4, 16))):
        text = dice.choice(CHANGES)(dice, text, other)
    return text[:LONGEST]


def some(dice: Random, text: bytes) -> tuple[int, int]:
    """A range of the text, mostly short."""
    start = dice.randint(0, len(text))
    return start, min(len(text), start + dice.choice((1, 1, 2, 4, 10, 100)))


def period_doubling(dice: Random, text: bytes, other: bytes) -> bytes:
    i, _ = some(dice, text)
    return text[:i] + bytes((dice.randrange(256),)) + text[i + 1 :]


def insert(dice: Random, text: bytes, other: bytes) -> bytes:
    i, _ = some(dice, text)
    return text[:i] + dice.choice(dice.choice((PIECES, BLANKS))) * dice.choice((1, 1, 1, 2, 60)) + text[i:]


def overwrite(dice: Random, text: bytes, other: bytes) -> bytes:
    i, _ = some(dice, text)
    piece = dice.choice(PIECES)
    return text[:i] + piece + text[i + len(piece) :]


def delete(dice: Random, text: bytes, other: bytes) -> bytes:
    i, j = some(dice, text)
    return text[:i] + text[j:]


def double(dice: Random, text: bytes, other: bytes) -> bytes:
    i, j = some(dice, text)
    return text[:j] + text[i:j] * dice.choice((1, 1, 3, 30)) + text[j:]


def swap(dice: Random, text: bytes, other: bytes) -> bytes:
    i, j = some(dice, text)
    k = dice.randint(j, len(text))
    return text[:i] + text[j:k] + text[i:j] + text[k:]


def splice(dice: Random, text: bytes, other: bytes) -> bytes:
    i, _ = some(dice, text)
    j, k = some(dice, other)
    return text[:i] + (other[j:] if dice.random() < 0.3 else other[j:k] + text[i:])


def digit(dice: Random, text: bytes, other: bytes) -> bytes:
    """Another digit, sign or point for one."""
    places = [i for i, byte in enumerate(text[:LONGEST]) if byte in b"0123456789+-.eEdD"]
    if not places:
        return text
    i = dice.choice(places)
    return text[:i] + dice.choice((b"0", b"1", b"9", b"+", b"-", b".", b"e", b"d", b"")) + text[i + 1 :]


CHANGES = (period_doubling, insert, insert, overwrite, delete, double, swap, splice, digit)


def shrunk(case: Case, same: Callable[[Case], bool], tries: int = 2000) -> Case:
    """The smallest case found for which `same` still holds, by leaving out ever smaller pieces."""
    for i in range(len(case.sets) - 1, -1, -1):
        fewer = replace(case, sets=case.sets[:i] + case.sets[i + 1 :])
        case = fewer if same(fewer) else case
    left = tries
    for i in range(-1, len(case.sets)):

        def with_part(part: bytes, case: Case = case, i: int = i) -> Case:
            if i < 0:
                return replace(case, text=part)
            return replace(case, sets=case.sets[:i] + (part,) + case.sets[i + 1 :])

        part = case.text if i < 0 else case.sets[i]
        size = max(len(part) // 2, 1)
        while size and left > 0:
            at = 0
            while at < len(part) and left > 0:
                less = part[:at] + part[at + size :]
                left -= 1
                if same(with_part(less)):
                    part = less
                else:
                    at += size
            size //= 2
        case = with_part(part)
    return case
