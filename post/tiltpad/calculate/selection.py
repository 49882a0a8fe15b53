"""Runs of a study by the values of their parameters."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tiltpad.calculate.differences import WORDS
from tiltpad.files.archive import meant
from tiltpad.files.study import Study

#: Values of parameters that the runs of a study must have.
Where = Mapping[str, Any] | None
#: The parameter over which results are drawn where runs differ in it.
SPEED = "speed_rpm"


#: Most values of a parameter in a message.
MOST_WORDS = 50
#: A sample has a parameter of more values than this, and this many times fewer runs than combinations.
LEVELS, COMBINATIONS = 10, 4


class ArgumentError(ValueError):
    """Arguments that do not fit the study or the machine.

    The text has {show}, {over}, {kind}, {where}, {pad} and {bearing} where it speaks of these arguments, so
    that the command can put its options there.
    """

    #: Arguments by the command's options.
    OPTIONS = {
        **{"show": "--show", "over": "--over", "kind": "--as", "where": "--where", "pad": "--pad"},
        "bearing": "--bearing",
    }

    def __init__(self, text: str, **values: object):
        self.text, self.values = text, values
        super().__init__(text.format(**dict(zip(self.OPTIONS, self.OPTIONS, strict=True)), **values))

    def of_command(self) -> str:
        """The message with the command's options."""
        return self.text.format(**self.OPTIONS, **self.values)


def selected(study: Study, where: Mapping[str, Any]) -> np.ndarray:
    """True for the runs with the given values of parameters that have been run, (run,)."""
    chosen = matching(study, where) & ~study.pending
    if not chosen.any():
        raise ValueError(f"{study.path}: none of these runs has been run yet")
    return chosen


def matching(study: Study, where: Mapping[str, Any]) -> np.ndarray:
    """True for the runs with the given values of parameters, also those not run yet, (run,)."""
    chosen = np.ones(study.length("run"), dtype=bool)
    for name, value in where.items():
        needs(name, study.parameters, "where", "a parameter")
        values = study[name]
        if is_number(study, name):
            try:
                here = np.isclose(values, float(value), rtol=1e-6, atol=0)
            except ValueError:
                here = np.zeros(len(values), dtype=bool)
        else:
            here = np.array([spelled(value) in (spelled(each), spelled(written(each))) for each in values])
        if not here.any():
            raise ValueError(f"{study.path}: no run with {name} = {value}: there are {in_words(values)}")
        chosen &= here
    if not chosen.any():
        raise ValueError(f"{study.path}: no run with all of these values")
    return chosen


def in_words(values: np.ndarray) -> str:
    """The different values of a parameter; of many the first and the last."""
    texts = [each if isinstance(each, str) else f"{each:g}" for each in distinct(values)]
    if len(texts) > MOST_WORDS:
        return f"{texts[0]} ... {texts[-1]}, {len(texts)} values"
    return ", ".join(texts)


def default_over(study: Study, several: Sequence[str], chosen: np.ndarray) -> str:
    """The number with the most values; without numbers the text with the most."""
    if not study.parameters:
        raise ValueError(f"{study.path}: its runs differ in no parameter that they could be drawn over")
    names = several or study.parameters
    numeric = [name for name in names if is_number(study, name)]
    return max(numeric or names, key=lambda name: len(distinct(study[name][chosen])))


def varying(study: Study, chosen: np.ndarray) -> list[str]:
    """The parameters in which the chosen runs differ."""
    return [name for name in study.parameters if differ(study[name][chosen])]


def differ(values: np.ndarray) -> bool:
    """True for more than one value; nan and empty texts are none."""
    known = values[values != ""] if values.dtype.kind == "O" else values[np.isfinite(values)]
    return bool(len(known) and (known != known[0]).any())


def sampled(study: Study, chosen: np.ndarray) -> bool:
    """True for runs that are a sample of their parameters, and no grid of values or a row of them."""
    counts = [len(distinct(study[name][chosen])) for name in study.parameters]
    return max(counts, default=0) > LEVELS and math.prod(counts) > COMBINATIONS * chosen.sum()


def axis_of(study: Study, over: str | None, chosen: np.ndarray) -> str:
    """The parameter along the axis: the speed where it differs, otherwise the number with the most values."""
    several = varying(study, chosen)
    over = over or (SPEED if SPEED in several else default_over(study, several, chosen))
    needs(over, study.parameters, "over", "a parameter")
    return over


def is_number(study: Study, name: str) -> bool:
    return study.item(name).dtype.kind != "O"


def distinct(values: np.ndarray) -> list:
    """The different values in rising order, texts in the order of the study; without nan and empty texts."""
    if values.dtype.kind == "O":
        return [value for value in dict.fromkeys(values) if value]
    return list(np.unique(values[np.isfinite(values)]))


def written(value: Any) -> str:
    """A value of a parameter in words."""
    return WORDS.get(value, value.replace("_", " ")) if isinstance(value, str) else f"{value:g}"


def spelled(text: str) -> str:
    """A word as the input has it: "Bengisu-Akay" is bengisu_akay."""
    return text.strip().lower().replace(" ", "_").replace("-", "_")


def needs(name: str, allowed: Sequence[str], option: str, what: str) -> None:
    """Raises ValueError for a name that is not allowed."""
    if name not in allowed:
        text = f"{{{option}}}: {{name}} is not {what} of this study{{meant}}: {{there}}"
        raise ArgumentError(text, name=name, meant=meant(name, allowed), there=", ".join(allowed))
