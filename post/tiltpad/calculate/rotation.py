"""The sense in which shafts turn: 1 clockwise, from +y to +z; -1 anticlockwise, from +y to -z."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tiltpad.files import namelist
from tiltpad.files.read import Run
from tiltpad.files.study import Study

VARIABLE = "operation%rotation"
ANTICLOCKWISE = "anticlockwise"


def sense(case: Mapping[str, Any]) -> int:
    """The sense of a case, by its groups; results of former versions do not name it and turn clockwise."""
    return -1 if case["operation"].get("rotation") == ANTICLOCKWISE else 1


def senses(source: Run | Study) -> np.ndarray:
    """The sense of a run, (1,), or of the runs of a study, (run,)."""
    if isinstance(source, Run):
        return np.array([sense(source.input)])
    variables = f"{source.attributes.get('variables', '')}".split("\n")
    for variable, name in zip(variables, source.parameters, strict=False):
        if variable == VARIABLE:
            return np.where(source[name] == ANTICLOCKWISE, -1, 1)
    groups = namelist.parse(f"{source.attributes['input']}")
    return np.full(source.length("run"), sense({"operation": groups.get("operation", {})}))


def ends(turning: int) -> str:
    """From which axis to which the shaft turns."""
    return "from +y to +z" if turning > 0 else "from +y to -z"
