"""The order of remarks: what harms a machine first, what leaves the range of the model behind it."""

from collections.abc import Sequence

#: Words of remarks by their weight, the heaviest first; a remark without any of them is the lightest.
WEIGHTS = (
    ("touch", "rubs", "whirls", "deeper than the clearance"),
    ("flutters", "lifted off", "near its limit", "little oil film carries", "without equilibrium"),
    ("quasi-periodic", "not settled", "locked to the shaft"),
    ("no load", "does not close the orbit", "pads bend", "warms by", "gives way", "give way"),
)


def by_weight(remarks: Sequence[str]) -> list[str]:
    """The remarks, the heaviest first; those of the same weight keep their order."""
    return sorted(remarks, key=weight)


def weight(remark: str) -> int:
    """0 for the heaviest."""
    found = (k for k, words in enumerate(WEIGHTS) if any(word in remark for word in words))
    return next(found, len(WEIGHTS))
