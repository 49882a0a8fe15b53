"""Coefficients for ROSS, a program for rotor dynamics (https://ross.readthedocs.io), from its version 3 on.

ROSS 3.0 asks for Python 3.12, ROSS 3.1 for Python 3.13. This package needs neither: a ROSS in an environment
of its own reads the file that `path` names.

ROSS has the axes x and y, y up, and its shafts turn from +x to +y. This program's shaft turns from +y to +z:
ROSS's x is -z, so that k_xx = K_zz, k_xy = -K_zy, k_yx = -K_yz, k_yy = K_yy, and likewise for the damping.
Of a shaft that turns anticlockwise, from +y to -z, it is z, and k_xy = K_zy, k_yx = K_yz.
"""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.calculate.coefficients import Series, at_frequencies, series
from tiltpad.calculate.rotation import sense as sense_of
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.writing import write

#: Row and column (0: y, 1: z) of ROSS's elements, and whether their signs follow its x.
ELEMENTS = {"xx": (1, 1, False), "xy": (1, 0, True), "yx": (0, 1, True), "yy": (0, 0, False)}
#: What tables may go over.
OVER = ("speed", "frequency", "both")
#: Number of whirl frequencies of a table over both, where none are given.
FREQUENCIES = 25


def to_ross(
    source: Run | Study,
    path: str | os.PathLike | None = None,
    *,
    over: str | None = None,
    frequency: Sequence[float] | None = None,
    pivot: str | None = None,
    where: Mapping[str, Any] | None = None,
    node: int = 0,
    element: int | None = None,
) -> dict[str, Any]:
    """Keywords for ROSS's bearing: `ross.BearingElement(n=2, **tiltpad.to_ross(study))`.

    The tables are `over` the speed (synchronously reduced coefficients, for unbalance response), over the
    whirl `frequency` at one speed, or over both (for modes, Campbell diagrams and stability). By default
    those of a run are over the frequency, those of a study over both where its runs have several frequency
    ratios, and otherwise over the speed. The pads are condensed at each `frequency` (rad/s) without
    interpolation; by default these are the run's own, or 25 over the range of the study. `pivot` and
    `where` choose as in `coefficients`. Runs of a study without equilibrium are left out.

    With `path` (.toml) a file is written, too, for `ross.BearingElement.load(path)`, for the node `node`.

    `element` (1, 2, ...) is a group &element of a machine's run in place of a bearing, with its coefficients
    as they are given: `ross.SealElement(n=9, **tiltpad.to_ross(run, element=1))`, or the file for
    `ross.SealElement.load(path)`.
    """
    if element is not None:
        return of_element(source, path, element, node)
    found = at_rest(source, series(source, "coefficients", pivot, where))
    ratios = np.unique(source["frequency_ratio"])
    if over is None:
        over = "frequency" if isinstance(source, Run) else "both" if len(ratios) > 1 else "speed"
    check(source, over, frequency, found)
    speed = np.pi / 30 * found.speed_rpm
    if over == "speed":
        whirl = speed[:, None]
    elif frequency is not None:
        whirl = np.tile(np.unique(np.asarray(frequency, dtype=float)), (len(speed), 1))
    elif over == "frequency":
        whirl = speed[:, None] * ratios
    else:
        ends = ratios[0] * speed[0], ratios[-1] * speed[-1]
        whirl = np.tile(np.linspace(*ends, FREQUENCIES), (len(speed), 1))
    keywords = dict(tables(found, whirl, over))
    keywords |= {"speed": speed} if over != "frequency" else {}
    keywords |= {"frequency": whirl[0]} if over != "speed" else {}
    if path is not None:
        write_element(Path(path), keywords, node)
    return keywords


def of_element(
    source: Run | Study, path: str | os.PathLike | None, number: int, node: int
) -> dict[str, np.ndarray]:
    """ROSS's keywords of an element of a machine; tables are read again, linear between their rows."""
    groups: dict[str, Any] = source.input if isinstance(source, Run) else {}
    if not 1 <= number <= len(groups.get("element", [])):
        raise ValueError(f"{source.path}: element {number}: it has {len(groups.get('element', []))} of them")
    own, sense = groups["element"][number - 1], sense_of(groups)
    keywords: dict[str, np.ndarray] = {}
    if own.get("file"):
        rows = np.genfromtxt(own["file"], delimiter=",", names=True, ndmin=1)
        names = rows.dtype.names or ()
        speed = np.unique(rows["speed_rpm"])
        shape: tuple[int, ...] = (len(speed),)
        keywords["speed"] = speed * np.pi / 30
        if "frequency_hz" in names:
            keywords["frequency"] = 2 * np.pi * rows["frequency_hz"][: len(rows) // len(speed)]
            shape = (len(speed), len(keywords["frequency"]))
        values = {name: rows[name].reshape(shape) for name in names if name[1:2] == "_"}
    else:
        given = zip("kcm", ("stiffness", "damping", "mass"), strict=True)
        pairs = [(letter, np.asarray(own[name], dtype=float)) for letter, name in given]
        axes = ("yy", "yz", "zy", "zz")
        values = {f"{letter}_{each}": v[i] for letter, v in pairs for i, each in enumerate(axes)}
    cross = sense * own.get("cross_stiffness", 0.0)
    values |= {"k_yz": values["k_yz"] + cross, "k_zy": values["k_zy"] - cross}
    for letter in "kcm":
        for name, (row, column, crossed) in ELEMENTS.items():
            if (here := f"{letter}_{'yz'[row]}{'yz'[column]}") in values:
                keywords[letter + name] = np.asarray((-sense if crossed else 1) * values[here])
    if path is not None:
        write_element(Path(path), keywords, node or int(own["station"]) - 1, "SealElement")
    return keywords


def tables(found: Series, whirl: np.ndarray, over: str) -> dict[str, np.ndarray]:
    """ROSS's kxx, ... cyy: (speed,), (frequency,) or (speed, frequency)."""
    part: Any = {"speed": (slice(None), 0), "frequency": 0, "both": ()}[over]
    x = -found.values["sense"][:, None]
    return {
        letter + name: ((x if crossed else 1) * values[..., row, column])[part]
        for letter, values in zip("kc", at_frequencies(found, whirl), strict=True)
        for name, (row, column, crossed) in ELEMENTS.items()
    }


def at_rest(source: Run | Study, found: Series) -> Series:
    """The runs that have an equilibrium."""
    there = np.isfinite(found.values["full_stiffness"][:, 0, 0])
    if not there.any():
        raise NotInRunError(f"{source.path}: no coefficients to write: no run has an equilibrium")
    own = (
        {name: each[there] for name, each in all_of.items()} for all_of in (found.values, found.parameters)
    )
    return Series(found.pivot, found.speed_rpm[there], *own)


def check(source: Run | Study, over: str, frequency: Sequence[float] | None, found: Series) -> None:
    """Raises ValueError for arguments that do not fit each other or the source."""
    if over not in OVER:
        raise ValueError(f"over = {over}: must be {', '.join(OVER)}")
    if frequency is not None and over == "speed":
        raise ValueError("frequency: not for tables over the speed, which are of synchronous whirl")
    if frequency is not None and not (np.size(frequency) and (np.asarray(frequency) >= 0).all()):
        raise ValueError(f"frequency = {frequency}: must be numbers from 0 on, rad/s")
    speeds = found.speed_rpm
    if over == "frequency" and len(speeds) > 1:
        raise ValueError(f"{source.path}: over = frequency: of one run, choose it by where")
    if (twice := speeds[1:][np.diff(speeds) <= 0]).size:
        others = ", ".join(name for name in found.parameters if name != "speed_rpm") or "nothing"
        twice_at = f"{source.path}: several runs at {twice[0]:g} rpm"
        raise ValueError(f"{twice_at}, which differ in {others}: choose by where")


def write_element(
    path: Path, keywords: Mapping[str, np.ndarray], node: int, kind: str = "BearingElement"
) -> None:
    """The file that ROSS loads an element from."""
    if path.suffix != ".toml":
        raise ValueError(f"{path}: the name must end in .toml")
    lines = ["# Written by tiltpad; axes and sense of rotation are those of ROSS. SI units."]
    lines += [f"[{kind}_tiltpad]", f"n = {node}", 'tag = "tiltpad"']
    lines += [f"{name} = {values.tolist()}" for name, values in keywords.items()]
    write(path, "\n".join(lines) + "\n")
