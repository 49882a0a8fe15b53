"""The model of a fit: what a case has at points in its free parameters, beside what was measured."""

import os
import re
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.calculate.estimation import Parameter
from tiltpad.calculate.measured import Measured
from tiltpad.files import namelist
from tiltpad.files.archive import RunError
from tiltpad.files.study import Study
from tiltpad.running import Groups, case_file, checked, run, settings
from tiltpad.sampling import lines

#: Where a study says that one of its runs is wrong: the file or the case, its line or its run.
PLACE = re.compile(r"^(?:sweep%file: )?(?:\S*points\.csv line \d+(?:, column \d+|, run \d+)|\S+, run \d+): ")
#: Directions of the two excitations by which coefficients are identified.
DIRECTION, DIRECTIONS = "excitation(1)%direction_deg", (0.0, 90.0)

Case = str | os.PathLike | Groups | None
#: Bounds by the variables of each parameter.
Bounds = Mapping[tuple[str, ...], tuple[float, float]]
#: What the model has of a test, by name.
Values = dict[str, np.ndarray]


class FittedModel:
    """Residuals of a case over points in its free parameters, over the standard deviations of the noise.

    `runs` counts the runs, and `why` is the reason of the last one that failed.
    """

    def __init__(self, case: Case, tests: Sequence[Measured], free: Bounds):
        self.case, self.tests, self.free = case, tests, free
        self.parameters = [Parameter(names[0], *bounds) for names, bounds in free.items()]
        self.names = [each.name for each in self.parameters]
        target = np.concatenate([*(each.compared(each.values) for each in tests), []])
        self.known = np.isfinite(target)
        self.target = target[self.known]
        if not len(self.target):
            raise ValueError("measured: there are no values to fit")
        self.runs, self.why = 0, ""

    def __call__(self, points: np.ndarray) -> np.ndarray:
        found = [self.of_test(test, points) for test in self.tests]
        parts = [
            [np.full(test.size, np.nan) if each is None else test.compared(each) for each in own]
            for test, own in zip(self.tests, found, strict=True)
        ]
        return np.array([np.concatenate(own)[self.known] - self.target for own in zip(*parts, strict=True)])

    def single(self, point: np.ndarray) -> list[Values]:
        """What the model has at a point, by name, for each test. Raises RunError where a run fails."""
        found = [self.of_test(test, point[None])[0] for test in self.tests]
        if None in found:
            raise RunError(f"at {self.in_words(point)}: {self.why}")
        return [each for each in found if each is not None]

    def in_words(self, point: np.ndarray) -> str:
        """The values of a point: "rotor%mass = 2000"."""
        return ", ".join(f"{name} = {value:.6g}" for name, value in zip(self.names, point, strict=True))

    def groups(self, point: np.ndarray) -> dict[str, dict[str, float]]:
        """The groups of a point, as overrides of a run."""
        found: dict[str, dict[str, float]] = {}
        for names, value in zip(self.free, point, strict=True):
            for group, _, name in (each.partition("%") for each in names):
                found.setdefault(group, {})[name] = float(value)
        return found

    def of_test(self, test: Measured, points: np.ndarray) -> list[Values | None]:
        """What the model of a test has at each of the points, by name; None where a run failed."""
        repeats = len(DIRECTIONS) if test.is_identified else 1
        with tempfile.TemporaryDirectory(prefix="tiltpad-") as folder:
            table = self.table(Path(folder, "points.csv"), test, points)
            case, overrides = self.case_of(test)
            kept = {**overrides.get("output", {}), "keep": "all"}
            study = run(case, **{**overrides, "sweep": {"file": table}, "output": kept})
        assert isinstance(study, Study)
        self.runs += len(points) * repeats
        with study:
            self.why = next((each.reason for each in study.failures(1)), self.why)
            done = np.all(np.reshape(study.done, (len(points), repeats)), axis=1).tolist()
            places = range(len(points))
            return [values_of(test, study, repeats, k) if done[k] else None for k in places]

    def table(self, path: Path, test: Measured, points: np.ndarray) -> Path:
        """Writes the table of a study of the points; of identified coefficients a row for each direction."""
        names = [name for own in self.free for name in own]
        values = np.column_stack([points[:, [k] * len(own)] for k, own in enumerate(self.free)])
        if test.is_identified:
            names = [*names, DIRECTION]
            turned = np.tile(DIRECTIONS, len(points))
            values = np.column_stack([np.repeat(values, len(DIRECTIONS), axis=0), turned])
        path.write_text(lines(names, values))
        return path

    def case_of(self, test: Measured) -> tuple[Case, dict[str, Any]]:
        """The case of a test, and what else is set in it: groups are merged, those of a file overridden."""
        own = dict(test.case)
        if test.task:
            own["case"] = {**own.get("case", {}), "task": test.task}
        if not isinstance(self.case, Mapping):
            return self.case, own
        merged: dict[str, Any] = dict(self.case)
        for group, values in own.items():
            there = merged.get(group, {})
            both = isinstance(there, Mapping) and isinstance(values, Mapping)
            merged[group] = {**there, **values} if both else values
        return merged, {}

    def check(self, begin: np.ndarray) -> None:
        """Raises ValueError for a case that is wrong, at the start or with a parameter at a bound."""
        bounds = np.array([each[1:] for each in self.parameters]).T
        ends = np.concatenate([np.diag(bound - begin) + begin for bound in bounds])
        for test in self.tests:
            with tempfile.TemporaryDirectory(prefix="tiltpad-") as folder:
                table = self.table(Path(folder, "points.csv"), test, np.vstack([begin, ends]))
                case, overrides = self.case_of(test)
                options = settings(overrides)
                file = case_file(case, Path(folder))
                if "\n&sweep" in checked(file, *options):
                    raise ValueError("a fit needs a case of one run, and this one is a parameter study")
                try:
                    checked(file, *options, "--set", f"sweep%file={namelist.written(table)}")
                except ValueError as error:
                    said = f"{error}".removeprefix("--set: ")
                    raise ValueError(PLACE.sub("", said)) from None


def values_of(test: Measured, study: Study, repeats: int, point: int) -> Values:
    """What the runs of a point have of a test."""
    runs = [study.result(point * repeats + k + 1) for k in range(repeats)]
    try:
        return test.of(runs)
    finally:
        for each in runs:
            each.close()
