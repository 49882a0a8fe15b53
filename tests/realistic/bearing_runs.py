"""The runs of one realistic bearing, and what they say of the program's default settings."""

import copy
import re
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np
from limited import Ended, limited
from march_errors import errors, period
from stress_cases import Case, text

#: Revolutions of the marches that are compared, from the end of the long one on, and least of the long one.
REVOLUTIONS, SETTLED = 40, 10
#: Rotor's time, s, that the seconds stand for.
ROTOR_TIME = 2.0
#: Samples per revolution: enough for the highest values within 1e-3 of the size.
SAMPLES = 90
#: CPU time, s, of a run, and of one with the closest settings.
LIMIT, CLOSE_LIMIT = 30, 90
#: How a run ends that has been asked to stop.
STOPPED = 4
#: Relative change of the load of the disturbed march, far less than any load is known.
DISTURBANCE = 1e-5
#: The closest march, ten times closer than by default: tables follow the tolerance of the march.
CLOSEST = {"integration": {"relative_tolerance": 1e-6}}
#: What every bearing is marched with.
SETTINGS = {"default": {}, "direct": {"film": {"solver": "direct"}}, "closest": CLOSEST}
#: Tolerances of the curve of error against time: of tables, of the march with tables as by default, of both.
TABLES, MARCHES, BOTH = (1e-3, 2e-4, 1e-5, 4e-6), (1e-4, 1e-6), (1e-4, 3e-6)
CURVE = (
    {f"tables {each:.0e}": {"film": {"table_tolerance": each}} for each in TABLES}
    | {
        f"march {each:.0e}": {
            "integration": {"relative_tolerance": each},
            "film": {"table_tolerance": 4e-5},
        }
        for each in MARCHES
    }
    | {f"both {each:.0e}": {"integration": {"relative_tolerance": each}} for each in BOTH}
)


@dataclass
class Run:
    """One run: how it ended, its cost, and its errors against the closest."""

    outcome: str
    message: str = ""
    #: CPU time, and wall time of building tables, s.
    seconds: float = 0.0
    building: float = 0.0
    #: Accepted steps, and revolutions of the shaft that were reached.
    steps: int = 0
    revolutions: float = 0.0
    errors: dict[str, float] = field(default_factory=dict)

    @property
    def complete(self) -> bool:
        return self.outcome == "complete"

    @property
    def rate(self) -> float:
        """Steps per revolution."""
        return self.steps / max(self.revolutions, 1e-9)


@dataclass
class Bearing:
    """What was found of one bearing."""

    number: int
    case: Case
    runs: dict[str, Run] = field(default_factory=dict)
    #: Why there is no equilibrium; the march then starts where the refusal offers.
    refusal: str = ""
    #: Revolutions after which the long march repeats; 0 where it does not.
    period: int = 0
    #: Pads of the long march that rub or lift from time to time, and pads that flutter.
    bouncing_pads: list[int] = field(default_factory=list)
    flutter_pads: list[int] = field(default_factory=list)

    @property
    def compared(self) -> bool:
        return all(name in self.runs and self.runs[name].errors for name in ("default", "disturbed"))


def study(program: Path, bearing: Bearing, folder: Path, curve: bool) -> None:
    """All runs of a bearing."""
    settle(program, bearing, folder)
    orbit = changed(bearing.case, {"case": {"task": "periodic"}})
    bearing.runs["periodic"] = march(program, orbit, folder / "periodic")
    compare(program, bearing, folder, curve)


def settle(program: Path, bearing: Bearing, folder: Path) -> None:
    """The long march from the equilibrium, or from the start that its refusal offers."""
    time = max(ROTOR_TIME, time_of(bearing.case, REVOLUTIONS))
    case = changed(bearing.case, {"operation": {"duration": time}})
    bearing.runs["long"] = march(program, case, folder / "long")
    if offered := re.search(r"no equilibrium.* start%from = '(\w+)'", bearing.runs["long"].message):
        bearing.refusal = bearing.runs["long"].message
        bearing.runs["long"] = march(program, changed(case, {"start": {"from": offered[1]}}), folder / "long")
    if bearing.runs["long"].revolutions >= SETTLED:
        behaviour(bearing, folder / "long.h5")


def compare(program: Path, bearing: Bearing, folder: Path, curve: bool) -> None:
    """Marches on from the end of the long march with several settings, where it came far enough."""
    if bearing.runs["long"].revolutions < SETTLED:
        return
    case = changed(bearing.case, {"operation": {"duration": time_of(bearing.case, REVOLUTIONS)}})
    case["start"] = {"from": "file", "file": "long.h5"}
    marches = {name: changed(case, settings) for name, settings in SETTINGS.items()}
    marches["disturbed"] = changed(marches["closest"], {"rotor": heavier(case)})
    if curve:
        marches |= {name: changed(case, settings) for name, settings in CURVE.items()}
    for name, each in marches.items():
        if name in SETTINGS or bearing.runs["closest"].complete:
            limit = CLOSE_LIMIT if name in ("closest", "disturbed") else LIMIT
            bearing.runs[name] = march(program, each, folder / name.replace(" ", "_"), limit)
    if bearing.runs["closest"].complete:
        for name in marches.keys() - {"closest"}:
            if bearing.runs[name].complete:
                path = folder / f"{name.replace(' ', '_')}.h5"
                bearing.runs[name].errors = errors(path, folder / "closest.h5", case)


def changed(case: Case, groups: dict[str, dict]) -> Case:
    """A case with other values in some groups."""
    other = copy.deepcopy(case)
    for group, values in groups.items():
        other.setdefault(group, {}).update(values)
    return other


def time_of(case: Case, revolutions: float) -> float:
    """Time of some revolutions, s."""
    return revolutions * 60 / case["operation"]["speed_rpm"]


def heavier(case: Case) -> dict:
    """The static load with the disturbance of the weight."""
    down, aside = case["rotor"].get("static_load", [0.0, 0.0])
    return {"static_load": [down * (1 + DISTURBANCE) - DISTURBANCE * 9.81 * case["rotor"]["mass"], aside]}


def march(program: Path, case: Case, path: Path, limit: int = LIMIT) -> Run:
    """Runs a case as PATH.nml; its result is PATH.h5."""
    case = changed(case, {"output": {"samples_per_revolution": SAMPLES}})
    path.with_suffix(".nml").write_text(text(case))
    result = path.with_suffix(".h5")
    result.unlink(missing_ok=True)
    done = limited([program, f"{path.name}.nml", "--quiet"], path.parent, limit)
    run = Run(outcome(done), done.stderr.strip().removeprefix("tiltpad: error: "), done.seconds)
    if result.exists():
        with h5py.File(result) as file:
            run.steps = int(file["statistics/steps"][()]) if "statistics/steps" in file else 0
            run.building = float(file["statistics/film_building_seconds"][()])
            if "shaft_angle" in file and len(file["shaft_angle"]):
                run.revolutions = float(file["shaft_angle"][-1] / (2 * np.pi))
    return run


def outcome(done: Ended) -> str:
    """How a run ended, in a word or two."""
    if done.hung:
        return "hung"
    return {0: "complete", 2: "refused", STOPPED: "time limit"}.get(
        done.returncode, f"status {done.returncode}"
    )


def behaviour(bearing: Bearing, path: Path) -> None:
    """What the pads do at the end of the long march, and whether it repeats."""
    bearing.period = period(path, bearing.case)
    with h5py.File(path) as file:
        if "summary/pad_lifted" not in file:
            return
        lifted, rubbing, flutters = (
            file[f"summary/pad_{name}"][()] for name in ("lifted", "rubbing", "flutters")
        )
        bounces = ((lifted > 0) & (lifted < 1)) | ((rubbing > 0) & (rubbing < 1))
        bearing.bouncing_pads = [int(pad) + 1 for pad in np.flatnonzero(bounces)]
        bearing.flutter_pads = [int(pad) + 1 for pad in np.flatnonzero(flutters)]
