"""Tables of the values of a study: drawn in any spelling, changed, and read by a second reader.

The second reader is made from the documented syntax (docs/inputs.md) and nothing of the program's.
"""

import re
from random import Random

from harness import Case, Reply
from reader import CONTROL, Refused
from reference import Variable
from spelling import BOM, cased

NAME = re.compile(rb"(\w+)(\([0-9]+\)|:[a-z]\w{0,29})?%(\w+)(?:\(([0-9]{1,9})\))?", re.ASCII)
#: Groups of which a machine has several, and those of its bearings.
COUNTED = b"disc unbalance bow load element impeller excitation".split()
OF_BEARINGS = b"bearing support damper oil pads pivot friction asperity film".split()
CELL = re.compile(rb'[ \t]*+(?:"((?:[^"]|"")*+)"|((?!")[^,]*?))[ \t]*(?:,|\Z)')
NUMBER = re.compile(rb"[-+.0-9eEdD]*")
# cells of a table that is right in itself, whatever its variables take; and what breaks one
CONTENTS = b"1 -2.5e3 1d0 lugre nan 1:2:1 2*3 0x1 80.5 \xc3\xa4".split()
BREAKS = [
    b",",
    b'"',
    b'""',
    b";",
    b"\t",
    b"\n",
    b"\r\n",
    b"\r",
    b"\0",
    b"%",
    b"(",
    b")",
    b" ",
    b"x",
    b",,",
    BOM,
]
# the rows that the harness shows, with the last
SHOWN = 3


def draw(dice: Random, variables: dict[str, Variable]) -> Case:
    """A table of a few variables and rows."""
    names = []
    for key in dice.sample(list(variables), dice.randint(1, 4)):
        element = b"(%d)" % dice.choice((1, 2, 24, 9999)) if dice.random() < 0.2 else b""
        names.append(cased(dice, key) + element)
    rows = [[dice.choice((*CONTENTS, b'a, "b"')) for _ in names] for _ in range(dice.randint(1, 6))]
    quoting = dice.choice((0, 0, 0.3, 1))
    lines = [b",".join(spelled(dice, cell, quoting) for cell in cells) for cells in (names, *rows)]
    end = dice.choice((b"\n", b"\r\n"))
    text = end.join(lines) + dice.choice((b"", end, end + end, end + b" \t" + end))
    return Case(dice.choice((b"", b"", BOM)) + text)


def spelled(dice: Random, cell: bytes, quoting: float) -> bytes:
    if b"," in cell or dice.random() < quoting:
        cell = b'"' + cell.replace(b'"', b'""') + b'"'
    before, behind = (dice.choice((b"", b"", b"", b" ", b"\t ")) for _ in range(2))
    return before + cell + behind


def changed(dice: Random, case: Case) -> Case:
    """The table with a few other bytes."""
    text = case.text
    for _ in range(dice.randint(1, 3)):
        at = dice.randint(0, len(text))
        new = dice.choice((*BREAKS, b"", bytes([dice.randrange(256)])))
        text = text[:at] + new + text[at + dice.choice((0, 0, 1, 2)) :]
    return Case(text)


def read(text: bytes, variables: dict[str, Variable]) -> bytes:
    """What the harness must say: rows, names and values, a zero byte behind each; or Refused."""
    if CONTROL.search(text):
        raise Refused("control character")
    lines = text.removeprefix(BOM).rstrip(b" \t\r\n").split(b"\n")
    if lines == [b""]:
        raise Refused("empty")
    head, *rows = (cells(line.removesuffix(b"\r")) for line in lines)
    found = [NAME.fullmatch(name.lower()) for name in head]
    names = [each and variable(each, variables) for each in found]
    if not all(names) or not all(each[4] is None or 0 < int(each[4]) < 10000 for each in found):
        raise Refused("no variable")
    if not rows or any(len(row) != len(head) or not all(row) for row in rows):
        raise Refused("rows")
    said = [b"%d" % len(rows)]
    for each in found:
        element = b"(%d)" % int(each[4]) if each[4] else b""
        said.append(each[1] + (each[2] or b"") + b"%" + each[3] + element)
    for k, row in enumerate(rows, 1):
        if k <= SHOWN or k == len(rows):
            said += [value(cell, of.is_text) for cell, of in zip(row, names, strict=True)]
    return b"".join(each + b"\0" for each in said)


def variable(name: re.Match, variables: dict[str, Variable]) -> Variable | None:
    """The variable of a name, whose group may have a number or the name of a bearing."""
    group, which, own = name[1], name[2] or b"", name[3]
    if which and group not in (COUNTED if which.startswith(b"(") else OF_BEARINGS):
        return None
    return variables.get((group + b"%" + own).decode("latin-1"))


def cells(line: bytes) -> list[bytes]:
    """The contents of a line."""
    found, at = [], 0
    while True:
        cell = CELL.match(line, at)
        if not cell:
            raise Refused("quotes")
        found.append(cell[2] if cell[1] is None else cell[1].replace(b'""', b'"'))
        at = cell.end()
        if not cell[0].endswith(b","):
            return found


def value(cell: bytes, is_text: bool) -> bytes:
    """As a case has it: what is no number in quotes."""
    if is_text or not NUMBER.fullmatch(cell):
        return b"'" + cell.replace(b"'", b"''") + b"'"
    return cell


def findings(case: Case, reply: Reply, variables: dict[str, Variable], valid: bool) -> list[str]:
    """What is wrong with the answer, but for the form of its line."""
    try:
        expected = read(case.text, variables)
    except Refused as refused:
        return [f"accepted, but: {refused}"] if reply.status == 0 or valid else []
    if reply.status != 0:
        return ["refused, but the second reader accepts it"]
    return [] if reply.text == expected else [f"{reply.text!r}, not {expected!r}"]
