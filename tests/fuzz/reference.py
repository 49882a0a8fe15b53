"""The input variables, from the program's own reference (tiltpad --reference)."""

import re
from dataclasses import dataclass

GROUP = re.compile(r"^## &(\w+)$", re.M)
ROW = re.compile(r"^\| `(\w+)` \| (.*?) \| .*? \| (.*?) \| (.*?) \|$", re.M)
MOST_PADS = 24
#: What only machines have, and excitations: groups, and variables of other groups. They are not resolved.
ON_SHAFTS = ("shaft", "disc", "unbalance", "bow", "load", "element", "impeller")
OF_MACHINES = (*ON_SHAFTS, "lateral", "support", "damper", "reduction", "excitation")
OF_MACHINES_TOO = (
    "rotor%file",
    *(
        f"bearing%{name}"
        for name in [
            *("kind", "station", "offset", "shaft_slope", "misalignment"),
            *("stiffness", "damping", "file", "frequency"),
        ]
    ),
)


@dataclass(frozen=True)
class Variable:
    """One input variable: what it takes, and its default; None: a number that is left out."""

    group: str
    name: str
    default: tuple
    choices: tuple[str, ...] = ()
    low: float = 0.0
    high: float = 0.0
    whole: bool = False
    per_pad: bool = False
    #: Whether a list sets its own length, up to `most`: that of the pivots is the number of pads.
    fixes_pads: bool = False
    most: int = MOST_PADS

    @property
    def key(self) -> str:
        return f"{self.group}%{self.name}"

    @property
    def is_text(self) -> bool:
        return isinstance(self.default[0], bytes)


def variables(markdown: str) -> dict[str, Variable]:
    """All variables of a rigid journal in one bearing by "group%name", in the order of the reference."""
    found = {}
    parts = GROUP.split(markdown)
    for group, table in zip(parts[1::2], parts[2::2], strict=True):
        if group in OF_MACHINES:
            continue
        for name, default, allowed, meaning in ROW.findall(table):
            variable = _variable(group, name, default.strip("`"), allowed, meaning)
            if variable.key not in OF_MACHINES_TOO:
                found[variable.key] = variable
    return found


def _variable(group: str, name: str, default: str, allowed: str, meaning: str) -> Variable:
    if default.startswith(("'", ".")):
        choices = () if allowed == "any text" else tuple(allowed.split())
        return Variable(group, name, (default.strip("'").encode(),), choices)
    numbers = tuple(None if word.strip() == "-" else float(word) for word in default.split(","))
    longest = re.search(r"1 to (\d+) of them", meaning)
    low, _, high = allowed.removeprefix("whole, ").partition(" to ")
    return Variable(
        group,
        name,
        numbers,
        low=float(low),
        high=float(high),
        whole=allowed.startswith("whole"),
        per_pad="one for all pads or one each" in meaning,
        fixes_pads="of them" in meaning,
        most=int(longest[1]) if longest else MOST_PADS,
    )
