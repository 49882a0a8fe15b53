"""A bifurcation diagram by brute force: marches up and down a parameter, each from the last one's end."""

import os
import warnings
from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from tiltpad.collect.collect import collect
from tiltpad.files.namelist import written
from tiltpad.files.study import REVOLUTIONS, Study, read_study
from tiltpad.files.writing import hdf5
from tiltpad.running import Groups, in_temporary_folder, run

#: Parameter of the study that tells its two ways, and their names.
WAY, WAYS = "brute_force%direction", ("upwards", "downwards")


def brute_force(
    case: "str | os.PathLike | Groups | None",
    parameter: str,
    values: Iterable[float],
    output: str | os.PathLike | None = None,
    /,
    *,
    settle: int = 100,
    revolutions: int = REVOLUTIONS,
    **overrides: Mapping[str, Any],
) -> Study:
    """Marches over rising values of a parameter and back again, each from the last state of the one before.

        study = tiltpad.brute_force("mine.nml", "operation%speed_rpm", range(5000, 9001, 100))
        ax = tiltpad.diagrams.diagram(study, kind="bifurcation")

    The study has a run for each value, upwards and then downwards (its parameter `direction`), with the
    Poincare points of the last `revolutions` (at most 50), after `settle` revolutions without samples: one
    point where the motion repeats with each revolution. Where the two directions differ, motions coexist.
    `case` and overrides are those of tiltpad.run; `output` is a folder for the files of the runs and
    study.h5, by default temporary. A run that fails has no points, and the next one starts from the last
    one that did not.
    """
    rising = sorted(float(value) for value in values)
    if not rising or settle < 0 or not 0 < revolutions <= REVOLUTIONS:
        raise ValueError(f"it needs values, settle from 0 on, and revolutions from 1 to {REVOLUTIONS}")
    march = partial(marched, case, parameter, rising, (settle, revolutions), overrides)
    if output is None:
        return in_temporary_folder(march)
    folder = Path(output)
    folder.mkdir(parents=True, exist_ok=True)
    return march(folder)


def marched(
    case: "str | os.PathLike | Groups | None",
    parameter: str,
    rising: list[float],
    turns: tuple[int, int],
    overrides: Groups,
    folder: Path,
) -> Study:
    """The study of marches with these numbers of revolutions, without samples and with samples."""
    own: dict[str, Any] = {group: dict(values) for group, values in overrides.items()}
    own.setdefault("case", {})["task"] = "equilibrium"
    with run(case, **own) as first:
        speed = first.input["operation"]["speed_rpm"]
    own["case"]["task"] = "march"
    group, _, name = parameter.partition("%")
    runs = [(way, value) for way, step in zip(WAYS, (1, -1), strict=True) for value in rising[::step]]
    for number, (way, value) in enumerate(runs, 1):
        own.setdefault(group, {})[name] = value
        turn = 60 / (value if parameter == "operation%speed_rpm" else speed)
        own.setdefault("operation", {})["duration"] = sum(turns) * turn
        own.setdefault("output", {})["start_time"] = turns[0] * turn
        path = folder / f"{number:04d}.h5"
        with warnings.catch_warnings(action="ignore"), run(case, path, overwrite=True, **own) as result:
            if result.complete:
                own.setdefault("start", {}).update({"from": "file", "file": os.fspath(path.resolve())})
        varied = "\n".join(f"{each} = {written(of)}" for each, of in ((parameter, value), (WAY, way)))
        with hdf5(path, "r+") as file:
            file.attrs.update({"run": number, "runs": len(runs), "sweep": varied})
    return read_study(collect(folder, folder / "study.h5").output)
