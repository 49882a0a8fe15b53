"""From where the journal comes back to its equilibrium, and from where it whirls: a study of starts."""

from typing import NamedTuple

import numpy as np

from tiltpad.calculate import branches
from tiltpad.files import namelist
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study

#: Displacements of the journal at the start, y and z, as the columns of a study, and their variables.
STARTS = {"journal_1": "start%journal(1)", "journal_2": "start%journal(2)"}
#: Revolutions at the end of a march that tell how far the journal goes.
LAST = 8


class Basin(NamedTuple):
    """Starts of marches, and where they end against an unstable limit cycle.

    parameter    value of the parameter of the branch of cycles at which the marches are
    start        displacements of the journal from the equilibrium, y and z, m, (run, 2)
    amplitude    half of the way of the journal in the last revolutions, the larger of y and z, m, (run,)
    whirls       whether that is more than the amplitude of the unstable cycle, (run,); of runs that are done
    cycle        amplitude of the unstable cycle along y and z, m
    done         whether a run was done, (run,)
    """

    parameter: float
    start: np.ndarray
    amplitude: np.ndarray
    whirls: np.ndarray
    cycle: np.ndarray
    done: np.ndarray

    @property
    def nearest(self) -> float:
        """Distance of the nearest start that whirls, m; infinite where none does."""
        return float(np.hypot(*self.start[self.whirls].T).min(initial=np.inf))


def basin(study: Study, branch: Run) -> Basin:
    """What a study of marches from a grid of starts tells beside a branch of limit cycles.

    The starts are `start%journal(1)` and `start%journal(2)` in `&sweep`, at one value of the parameter.
    """
    for name, variable in STARTS.items():
        if name not in study.parameters:
            known = ", ".join(study.parameters) or "none"
            raise ValueError(f"{study.path}: no grid of starts: {variable} is not in its &sweep ({known})")
    name = str(branch.attributes["branch_parameter"]) if branch.is_branch else ""
    branches.needs_branch(branch)
    if name.rpartition("%")[2] in study.parameters:
        raise ValueError(f"{study.path}: its marches differ in {name}: a basin is of one value")
    group, _, variable = name.partition("%")
    value = float(np.ravel(namelist.resolved(study.attributes["input"])[group][variable])[0])
    cycle = unstable_cycle(branch, value)
    ends = [study[f"{end}_{axis}"][:, -LAST:] for end in ("highest", "lowest") for axis in "yz"]
    way = np.array([high.max(axis=1) - low.min(axis=1) for high, low in zip(ends[:2], ends[2:], strict=True)])
    amplitude = way.max(axis=0) / 2
    start = np.column_stack([study[each] for each in STARTS])
    whirls = study.done & (amplitude > cycle.max())
    return Basin(value, start, amplitude, whirls, cycle, study.done)


def unstable_cycle(branch: Run, value: float) -> np.ndarray:
    """Amplitudes along y and z of the smallest unstable limit cycle at a value of the parameter, m."""
    found = []
    for each in branches.stretches(branch):
        own = each.points
        at = branch["parameter"][own]
        if each.stable:
            continue
        size = [
            (branch[f"journal_{axis}_max"][own] - branch[f"journal_{axis}_min"][own]) / 2 for axis in "yz"
        ]
        for k in np.flatnonzero((at[:-1] - value) * (at[1:] - value) <= 0):
            part = (value - at[k]) / (at[k + 1] - at[k])
            found.append([one[k] + part * (one[k + 1] - one[k]) for one in size])
    if branch.attributes["branch_of"] != "limit_cycle" or not found:
        name = branch.attributes["branch_parameter"]
        raise NotInRunError(f"{branch.path}: no unstable limit cycle at {name} = {value:g}")
    return np.array(min(found, key=max))
