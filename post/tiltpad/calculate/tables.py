"""Tables of coefficients, for spreadsheets and other programs."""

import os
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.calculate import rotation
from tiltpad.calculate.coefficients import Coefficients, coefficients
from tiltpad.calculate.selection import Where
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.writing import write, write_csv

#: Elements of the matrices in the order of the columns.
ELEMENTS = ("yy", "yz", "zy", "zz")
HEAD = "Stiffness in N/m, damping in N s/m; y is up, the shaft turns"


def write_coefficients(
    source: Run | Study, path: str | os.PathLike, *, pivot: str | None = None, where: Where = None
) -> None:
    """Writes the coefficients of a run or a study to a table, .csv or .toml; by default of all its pivots.

    A row has pivot, speed, frequency ratio and the elements of both matrices, rows before columns.
    """
    target = Path(path)
    first = coefficients(source, pivot, where=where)
    names = [first.pivot] if pivot else [str(each) for each in source["pivot"]]
    found = [coefficients(source, each, where=where) for each in names]
    if target.suffix == ".csv":
        write_csv(target, table(found))
    elif target.suffix == ".toml":
        write(target, "\n".join(sections(found, turning(source))))
    else:
        raise ValueError(f"{target}: the name must end in .csv or .toml")


def table(found: list[Coefficients]) -> list[list[Any]]:
    """Head and rows of the table."""
    others = [name for name in found[0].parameters if name != "speed_rpm"]
    units = {"K": "N/m", "C": "N s/m"}
    elements = [f"{letter}_{each} ({unit})" for letter, unit in units.items() for each in ELEMENTS]
    rows: list[list[Any]] = [["pivot", *others, "speed_rpm", "frequency_ratio", *elements]]
    for one in found:
        shape = (-1, len(one.frequency_ratio), len(ELEMENTS))
        both = np.concatenate([one.stiffness.reshape(shape), one.damping.reshape(shape)], axis=-1)
        for k, (speed, own) in enumerate(zip(np.atleast_1d(one.speed_rpm), both, strict=True)):
            start = [one.pivot, *(one.parameters[name][k] for name in others), speed]
            rows += [[*start, ratio, *values] for ratio, values in zip(one.frequency_ratio, own, strict=True)]
    return rows


def turning(source: Run | Study) -> str:
    """How the shaft turns, in words."""
    found = set(rotation.senses(source).tolist())
    return rotation.ends(found.pop()) if len(found) == 1 else "as its rotation says"


def sections(found: list[Coefficients], turns: str) -> list[str]:
    """Lines of the TOML file: a section for each pivot, with nested arrays as in `coefficients`."""
    lines = [f"# {HEAD} {turns}.", "# Arrays: (speed, frequency ratio, row, column)."]
    for one in found:
        shape = (-1, len(one.frequency_ratio), 2, 2)
        arrays = {name: np.asarray(each) for name, each in one.parameters.items()}
        arrays |= {"speed_rpm": np.atleast_1d(one.speed_rpm), "frequency_ratio": one.frequency_ratio}
        arrays |= {"stiffness": one.stiffness.reshape(shape), "damping": one.damping.reshape(shape)}
        lines += ["", f"[{one.pivot}]", *(f"{name} = {toml(each.tolist())}" for name, each in arrays.items())]
    return [*lines, ""]


def toml(value: Any) -> str:
    """A number, a text or nested lists of them as TOML has them."""
    if isinstance(value, list):
        return f"[{', '.join(map(toml, value))}]"
    if not isinstance(value, str):
        return repr(value)
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
