"""What a run of the program must keep to: the checks of one case, and the error of its tolerances."""

import copy
import re
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np
from limited import Ended, limited
from stress_cases import Case, text

#: CPU time, s, of a run; the step budget ends most of them long before. One that does not stop then is hung.
TIME_BUDGET = 300
#: How a run ends that has been asked to stop.
STOPPED = 4
#: Steps of a case that stays in its equilibrium, where there is nothing to compare.
AT_REST = 20
#: Revolutions over which two runs of a case are compared.
COMPARED = 2.5
#: How much finer the run is that a case is compared with.
FINER = 100.0
#: Residual of an equilibrium where the force of films that cavitate may leap.
LEAP = 1e-5
#: Distance of two starts, in scales of the states, beyond which they are different equilibria.
APART = 1e-2
#: CPU time, s, for the global search of a case; what it finds in them counts.
SEARCHED = 60
#: Cases, by seed, that are refused though the global search finds an equilibrium from which a march can
#: start: what the program is without is told in docs/stability.md, "Searches of an equilibrium".
LOST = {1: (25, 109, 191, 248, 262, 317, 323), 2: (57, 93, 247, 277, 313, 489)}
START = ("stable", "oscillatory instability")
#: What a refusal for want of an equilibrium says of its cause, and how the report calls it.
CAUSES = {
    "where no pad is": "the load points where no pad is",
    "past the only pad": "the load points past the only pad",
    "one pad: the journal": "one pad: the journal rolls off",
    "the journal away": "pads that push the journal away",
    "no equilibrium (unloaded)": "unloaded pads have no equilibrium",
    "did not come to equilibrium": "unloaded pads did not come to equilibrium",
    "leaves every equilibrium": "the journal leaves every equilibrium that was found",
    "did not converge": "a film did not converge",
    "do not hold the journal": "fixed pads that do not hold the journal",
    "did not end": "the search did not end",
}
PREFIX = "tiltpad: error: "
NO_MESSAGE = ("At line", "runtime", "Backtrace", "HDF5-DIAG", "CVODE ERROR", "NaN", "Infinity", "with code")
#: What is no number where no oil flows or nothing moves.
NO_NUMBER = re.compile(
    r"equilibrium/temperature_rise|summary/(whirl|pad)_order$|by_revolution/(low|high)est_"
)
STATES = ("journal_y", "journal_z", "pad_tilt", "pivot_deflection")


@dataclass
class Comparison:
    """A short run against a finer one; errors in units of the tolerance and of the clearance."""

    outcome: str
    error: float = 0.0
    promised: float = 0.0
    sensitivity: float = 0.0
    share: float = 0.0
    moment: float = 0.0


@dataclass
class Result:
    """How a case ended."""

    number: int
    case: Case
    outcome: str = ""
    message: str = ""
    faults: list[str] = field(default_factory=list)
    steps: int = 0
    revolutions: float = 0.0
    failures: int = 0
    #: CPU time, s.
    seconds: float = 0.0
    #: Stability of the equilibrium at the start; where there is none, why, and what the global search found.
    stability: str = ""
    cause: str = ""
    searched: str = ""
    comparison: Comparison | None = None


def run(program: Path, case: Case, folder: Path, name: str) -> Ended:
    """Runs a case in a folder as NAME.nml."""
    (folder / f"{name}.nml").write_text(text(case))
    return limited([program, f"{name}.nml", "--quiet"], folder, TIME_BUDGET)


def assess(
    program: Path,
    number: int,
    case: Case,
    folder: Path,
    compare: bool,
    search: Path | None = None,
    lost: bool = False,
) -> Result:
    """Runs a case and checks how it ended; on request compares it with a finer run, and looks with the
    program of the global search for an equilibrium that was missed, which the cases that are lost may."""
    result = Result(number, case)
    done = run(program, case, folder, "case")
    result.seconds = done.seconds
    if done.hung:
        result.outcome = "hung"
        result.faults = [f"still running after {done.seconds:.0f} s of CPU time"]
        return result
    result.message = done.stderr.strip()
    file = folder / "case.h5"
    if done.returncode == 0:
        result.outcome = "done"
        result.faults += [f"printed: {said!r}" for said in (done.stdout, done.stderr) if said]
    elif done.returncode in (1, 2, STOPPED):
        result.outcome = outcome_of(done)
        result.faults += refusal_faults(done, file)
        if result.outcome == "no equilibrium":
            result.cause = cause_of(result.message)
        if result.outcome == "no equilibrium" and search:
            result.searched, faults = searched(search, folder / "case.nml")
            result.faults += faults
            if result.searched in START and not lost:
                result.faults.append(f"refused, though the global search found one: {result.searched}")
    else:
        result.outcome = "crashed"
        result.faults = [f"exit status {done.returncode}: {result.message[:300]}"]
        return result
    if file.exists():
        result.faults += file_faults(file, case, done.returncode == 0)
        with h5py.File(file) as opened:
            result.stability = opened.attrs.get("equilibrium_stability", "")
        read_cost(file, result)
    elif done.returncode == 0:
        result.faults.append("no result file")
    if compare and result.outcome == "done" and not result.faults and result.steps > AT_REST:
        result.comparison = compared(program, case, folder)
        if result.comparison.outcome == "missed":
            result.faults.append(f"error {result.comparison.error:.3g} tolerances against a finer run")
        if result.comparison.outcome == "hung":
            result.faults.append("a run to compare with hung")
    return result


def cause_of(message: str) -> str:
    """The cause that a refusal names; empty where it names none."""
    return next((name for words, name in CAUSES.items() if words in message), "")


def searched(search: Path, case: Path) -> tuple[str, list[str]]:
    """What the global search finds ('stable', 'oscillatory instability', 'static instability' or 'none'),
    and its own faults."""
    done = limited([search, case.name], case.parent, SEARCHED)
    if done.hung:
        return "not ended", []
    if done.returncode != 0:
        return "failed", [f"the global search failed: {done.stderr.strip()[:200]}"]
    # its name, what was found, how many
    return re.match(r"\S+ ([a-z ]+) ", done.stdout)[1], []


def outcome_of(done: Ended) -> str:
    """Kind of a refusal."""
    if done.returncode == 1:
        return "input refused"
    if done.returncode == STOPPED:
        return "time budget"
    if "no equilibrium found" in done.stderr:
        return "no equilibrium"
    return "step budget" if "integration%max_steps" in done.stderr else "march stopped"


def refusal_faults(done: Ended, file: Path) -> list[str]:
    """A refusal is one line that says why, where and when, and nothing else."""
    said, faults = done.stderr, []
    if done.stdout:
        faults.append(f"printed: {done.stdout[:200]!r}")
    if not said.startswith(PREFIX) or said.count("\n") != 1 or not said.endswith("\n"):
        faults.append(f"not one line of error: {said[:300]!r}")
    faults += [f"{word!r} in the message: {said.strip()}" for word in NO_MESSAGE if word in said]
    if done.returncode == 1 and not re.search(r"\w+%\w+", said):
        faults.append(f"no variable named: {said.strip()}")
    refused = done.returncode == 2 and "no equilibrium found" in said
    if refused and not cause_of(said):
        faults.append(f"no cause named: {said.strip()}")
    if refused or (done.returncode == STOPPED and "before the march" in said):
        if file.exists():
            faults.append("a result file without an equilibrium")
    elif done.returncode in (2, STOPPED):
        if not re.search(r" t = \S+ s", said):
            faults.append(f"no time named: {said.strip()}")
        if not file.exists():
            faults.append("what was computed is not kept")
    return faults


def file_faults(path: Path, case: Case, complete: bool) -> list[str]:
    """A result file holds finite numbers only, whole or not, and what physics allows."""
    with h5py.File(path) as file:
        faults = not_finite(file)
        if file.attrs["complete"] != int(complete):
            faults.append(f"complete = {file.attrs['complete']}")
        if faults or "time" not in file:
            return faults or (["no samples"] if complete else [])
        values = {name: file[name][:] for name in file if isinstance(file[name], h5py.Dataset)}
        residual = file["equilibrium/residual"][()]
        promised = promise(file, case["integration"]["relative_tolerance"])
    return unphysical(values, residual, promised, case, complete)


def promise(file: h5py.File, tolerance: float) -> float:
    """What the steps of a run may add up to over the scales of its states: N steps of at most sqrt(n)
    tolerances each, in n states."""
    states = 4 + sum(file[name].shape[1] for name in file if re.match("pad_t|pad_p|brist", name))
    return int(file["statistics/steps"][()]) * np.sqrt(states) * tolerance


def not_finite(file: h5py.File) -> list[str]:
    """Datasets that hold a NaN or an infinity."""
    faults = []

    def visit(name, item):
        numbers = isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not NO_NUMBER.match(name)
        if numbers and not np.all(np.isfinite(item[()])):
            faults.append(f"{name} is not finite")

    file.visititems(visit)
    return faults


def unphysical(
    values: dict[str, np.ndarray], residual: float, promised: float, case: Case, complete: bool
) -> list[str]:
    """What the samples must fulfil, each in words, and whether they do."""
    step = np.diff(values["time"])
    cavitated = case["bearing"].get("cavitation_pressure", 0.0)
    cavitated -= np.inf if case["film"]["cavitation"] == "none" else 1e-3 + 1e-6 * abs(cavitated)
    duration = case["operation"]["duration"]
    checks = {
        "time does not grow evenly": np.all(step > 0) and np.all(abs(np.diff(step)) <= 1e-9 * duration),
        "the last sample misses the end": not complete
        or 0 <= 1 - values["time"][-1] / duration + 1e-12 <= 1.01 * step.max() / duration,
        "the shaft turns back": np.all(np.diff(values["shaft_angle"]) > 0) and np.all(values["speed"] > 0),
        "min_film_thickness <= 0 without contact": np.all(
            (values["min_film_thickness"] > 0) | (values["asperity_force"] > 0)
        ),
        "max_pressure below the film's cavitation": np.all(values["max_pressure"] >= cavitated),
        "unbalanced forces": residual <= (1e-7 if case["film"]["cavitation"] == "none" else LEAP),
    }
    if case["pads"]["motion"] != "fixed":
        checks |= unphysical_pivots(values, promised, case)
    return [words for words, kept in checks.items() if not kept]


def unphysical_pivots(values: dict[str, np.ndarray], promised: float, case: Case) -> dict[str, bool]:
    """The same of pads that tilt on pivots."""
    moment, bound = values["friction_moment"], moment_bound(values, case)
    reach = 0.5 * np.radians(case["pads"]["arc_deg"])
    return {
        "pivot_load < 0": np.all(values["pivot_load"] >= 0),
        "friction_moment over its bound": np.all(abs(moment) <= bound * (1 + promised) + 1e-12),
        "a pad turned over": np.all(abs(values["pad_tilt"]) <= reach),
        "contact without pivot deflection": "pivot_deflection" not in values
        or np.all(values["pivot_load"][values["pivot_deflection"] < 0] == 0),
    }


def moment_bound(values: dict[str, np.ndarray], case: Case) -> np.ndarray:
    """Largest friction moment: f_s N R_1; with LuGre what its damping and viscosity may add."""
    friction, contact = case["friction"], case["pivot"]
    ball = contact["socket_radius"] - contact["radius_difference"]
    if friction["model"] == "none":
        return 0 * values["pivot_load"]
    coefficient = friction["static_coefficient"]
    if friction["model"] == "lugre":
        damping = friction.get("bristle_damping", -1.0)
        if damping < 0:
            damping = np.sqrt(friction["bristle_stiffness"] / 1e4)
        velocity = abs(ball * values["pad_tilt_rate"])
        ratio = coefficient / friction["dynamic_coefficient"]
        slope = damping * (1 + ratio) + friction.get("viscous_coefficient", 0.0)
        coefficient = coefficient + slope * velocity
    return coefficient * values["pivot_load"] * ball


def read_cost(path: Path, result: Result) -> None:
    """Steps and failures of a run, and how far it came."""
    with h5py.File(path) as file:
        counts = file["statistics"]
        result.steps = int(counts["steps"][()])
        result.failures = int(counts["convergence_failures"][()] + counts["error_test_failures"][()])
    when = re.search(r" t = (\S+) s", result.message)
    result.revolutions = revolutions(case_time(result.case, when), result.case)


def case_time(case: Case, when: re.Match | None) -> float:
    """When a run ended: as its message says, or as planned."""
    return float(when[1]) if when else case["operation"]["duration"]


def revolutions(end: float, case: Case) -> float:
    """Revolutions of the shaft up to a time."""
    operation = case["operation"]
    first, last = operation["speed_rpm"], operation.get("final_speed_rpm", operation["speed_rpm"])
    return (first + 0.5 * (last - first) * end / operation["duration"]) * end / 60


def shortened(case: Case) -> Case:
    """The first revolutions of a case, with the same speed at the same time."""
    short = copy.deepcopy(case)
    operation = short["operation"]
    first, last = operation["speed_rpm"], operation.get("final_speed_rpm", operation["speed_rpm"])
    duration = operation["duration"]
    wanted = min(duration, COMPARED * 60 / min(max(first, 0.5 * (first + last)), max(first, last)))
    operation["duration"] = wanted
    operation["final_speed_rpm"] = first + (last - first) * wanted / duration
    short["output"] = {"samples_per_revolution": 180}
    return short


def tightened(case: Case) -> Case:
    """The case with a finer tolerance."""
    fine = copy.deepcopy(case)
    tolerance = case["integration"]["relative_tolerance"]
    fine["integration"]["relative_tolerance"] = tolerance / FINER
    fine["integration"]["max_steps"] *= 20
    fine["film"]["tolerance"] = min(1e-6, tolerance) / FINER
    fine["film"]["max_sweeps"] = 100000
    return fine


def disturbed(case: Case, force: float) -> Case:
    """The case with a load that much larger, N, and pads that much heavier, with the moment of this force at
    their ends: films promise their forces over that of a loaded film, however little a pad carries."""
    other = copy.deepcopy(case)
    rotor, pads = other["rotor"], other["pads"]
    rotor["static_load"] = [each + force for each in rotor.get("static_load", [0.0, 0.0])]
    gravity = rotor.get("gravity", 9.81)
    if gravity > 0 and pads["motion"] != "fixed":
        ends = 0.5 * other["bearing"]["journal_radius"] * np.radians(pads["arc_deg"])
        moments = force / gravity * ends
        pads["centre_tangential"] = list(pads["centre_tangential"] + moments / pads["mass"])
        pads["mass"] = [each + force / gravity for each in pads["mass"]]
    return other


def compared(program: Path, case: Case, folder: Path) -> Comparison:
    """The first revolutions against a finer run; where they differ too much, whether the case amplifies."""
    short = shortened(case)
    for _ in range(2):
        for name, each in (("coarse", short), ("fine", tightened(short))):
            (folder / f"{name}.h5").unlink(missing_ok=True)
            done = run(program, each, folder, name)
            if done.returncode != 0:
                return Comparison("hung" if done.hung else f"{name} run refused")
        if starts_differ(folder / "coarse.h5", folder / "fine.h5", case):
            short["start"] = start_of(folder / "coarse.h5")
        else:
            break
    tolerance = case["integration"]["relative_tolerance"]
    error, share, moment = difference(folder / "coarse.h5", folder / "fine.h5", case)
    with h5py.File(folder / "coarse.h5") as file:
        promised = promise(file, tolerance) / tolerance
    found = Comparison("kept", error, promised, share=share, moment=moment)
    if error <= found.promised:
        return found
    done = run(program, disturbed(tightened(short), tolerance * load_of(case)), folder, "disturbed")
    if done.returncode != 0:
        return Comparison("hung" if done.hung else "disturbed run refused", error, found.promised)
    found.sensitivity = difference(folder / "disturbed.h5", folder / "fine.h5", case)[0]
    found.outcome = "sensitive" if found.sensitivity > 0.1 * error else "missed"
    return found


def starts_differ(path: Path, other: Path, case: Case) -> bool:
    """Whether two runs start from equilibria that lie apart: then they say nothing of the march's error."""
    with h5py.File(path) as a, h5py.File(other) as b:
        scales = state_scales(case, b)
        gaps = [np.max(abs(a[name][0] - b[name][0]) / scales[name]) for name in STATES if name in a]
    return max(gaps) > APART


def start_of(path: Path) -> dict:
    """The start of a run as the group &start gives it, without its motion."""
    with h5py.File(path) as file:
        start = {"from": "given", "journal": [float(file[name][0]) for name in STATES[:2]]}
        for name in STATES[2:]:
            if name in file:
                start[name] = file[name][0].tolist()
    return start


def load_of(case: Case) -> float:
    """Static load, N; without one the unbalance force."""
    rotor = case["rotor"]
    force = rotor.get("static_load", [0.0, 0.0])
    load = np.hypot(force[0] - rotor["mass"] * rotor.get("gravity", 9.81), force[1])
    speed = case["operation"]["speed_rpm"] * np.pi / 30
    return max(load, rotor.get("unbalance", 0.0) * speed**2, 1.0)


def difference(path: Path, other: Path, case: Case) -> tuple[float, float, float]:
    """Largest difference of two runs: of the states in units of their tolerance, of the states in their
    scales, of the friction moment in its peak-to-peak."""
    tolerance = case["integration"]["relative_tolerance"]
    error = share = 0.0
    with h5py.File(path) as a, h5py.File(other) as b:
        common = min(len(a["time"]), len(b["time"]))
        scales = state_scales(case, b)
        for name in STATES:
            if name not in a:
                continue
            found, true = a[name][:common], b[name][:common]
            gap = abs(found - true)
            error = max(error, float(np.max(gap / (tolerance * (abs(true) + scales[name])))))
            share = max(share, float(np.max(gap / scales[name])))
        moment = 0.0
        if "friction_moment" in a:
            found, true = a["friction_moment"][:common], b["friction_moment"][:common]
            span = float(np.ptp(true, axis=0).max())
            moment = float(abs(found - true).max() / span) if span > 0 else 0.0
    return error, share, moment


def state_scales(case: Case, file: h5py.File) -> dict[str, np.ndarray | float]:
    """Characteristic scale of the positions, as the absolute tolerances have it; of the pivot deflection
    its largest."""
    bearing, clearance = case["bearing"], case["bearing"]["assembled_clearance"]
    radius = bearing["journal_radius"] + bearing["machined_clearance"]
    length = radius * np.radians(case["pads"]["arc_deg"])
    scales = {"journal_y": clearance, "journal_z": clearance, "pad_tilt": clearance / length}
    if "pivot_deflection" in file:
        scales["pivot_deflection"] = max(file["pivot_deflection"][:].max(), 1e-3 * clearance)
    return scales
