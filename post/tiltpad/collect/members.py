"""Members of a study: how a run ended, results of its last revolution, Poincare points, cost."""

import re
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate import pivots, signals
from tiltpad.collect.parameters import swept
from tiltpad.files.archive import NotInRunError, RunError, damaged, reading
from tiltpad.files.read import LABELS, Run, read
from tiltpad.files.study import FIGURES, POINTS, QUANTITIES, REVOLUTIONS

#: Exit status of a member that was done, and those of one that did not end: running or killed, stopped.
DONE, UNENDED = 0, (-1, 4)
#: Most members of a sweep.
MOST = 100_000
#: Names as the program writes them: of a swept variable, and of a number of the cost.
VARIABLE = re.compile(r"[a-z]\w*%[a-z]\w*(\(\d+\))?", re.ASCII)
COST = re.compile(r"[a-z]\w*", re.ASCII)
#: A whole revolution, less a rounding error.
WHOLE = 1 - 1e-9


class Member(NamedTuple):
    """A run as a study has it.

    Its fields:

        path, number      its file; its number in the sweep, None of a run that is no member
        status, reason    exit status (nan: the file cannot be read), and the reason where it failed
        members, sweep    members of the whole sweep, and its own swept values by variable
        marks             checksums of the sweep: up to the member before, up to this one, of all; None where
                          they are not known
        input             resolved namelist, empty where the file cannot be read
        origin            version, title and input text
        values            results by names of tiltpad.files.study, with their dimensions less the member
        labels            values of its dimensions, where they are not counted from 1
        cost              the numbers of its group statistics
    """

    path: Path
    number: int | None
    status: float
    reason: str
    members: int | None = None
    sweep: dict[str, Any] = {}
    marks: tuple[str, str, str] | None = None
    input: dict[str, dict[str, Any]] = {}
    origin: dict[str, str] = {}
    values: dict[str, Any] = {}
    labels: dict[str, Sequence[Any]] = {}
    cost: dict[str, float] = {}


def member(path: Path) -> Member:
    """The member of a file; only with the reason where the file cannot be read."""
    try:
        with read(path) as run:
            return measured(path, run)
    except RunError as error:
        return unreadable(path, f"{error}")
    except Exception as error:
        # whatever a damaged file brings about, the other members are to be collected
        return unreadable(path, f"{damaged(f'{path}', 'it', error)}")


def unreadable(path: Path, reason: str) -> Member:
    """The member of a file that cannot be read; its number is that in its name, if any."""
    stem = path.stem
    number = int(stem) if stem.isascii() and stem.isdecimal() and len(stem) <= len(f"{MOST}") else 0
    return Member(path, number if 1 <= number <= MOST else None, np.nan, reason)


def measured(path: Path, run: Run) -> Member:
    """The member of a run that can be read."""
    attributes = run.attributes
    complete = bool(run.complete)
    with reading(run.path, "its place in a sweep"):
        number, members, sweep, marks = place(attributes)
    status = int(attributes.get("exit_status", DONE if complete else 2))
    if not complete and status == DONE:
        status = UNENDED[0]
    reason = f"{attributes.get('reason', '')}" if status != DONE else ""
    values: dict[str, Any] = {
        "complete": float(complete),
        "time_reached": float(run.values("time", -1)) if run.samples else 0.0,
    }
    if "resumes" in attributes:
        values["resumes"] = float(attributes["resumes"])
    with suppress(NotInRunError):
        values |= at_rest(run)
    with suppress(NotInRunError):
        values |= vibrations(run)
    if complete and status == DONE:
        with suppress(NotInRunError):
            part = signals.last_revolutions(run)
            values |= motion(run, part)
            values |= friction(run, part)
        with suppress(NotInRunError):
            points = signals.poincare(run, REVOLUTIONS, states=tuple(POINTS.values()))
            values |= {name: points[state] for name, state in POINTS.items() if state in points}
            values |= ends_of_revolutions(run, len(points["time"]))
    return Member(
        path,
        number,
        status,
        reason,
        members,
        sweep,
        marks,
        run.input,
        {name: attributes[name] for name in ("version", "title", "input")},
        values,
        labels(run, values),
        cost(run),
    )


def place(attributes: dict[str, Any]) -> tuple[int | None, int | None, dict[str, Any], Any]:
    """Number, members, values and marks of a member of a sweep; None, None, {} and None of another run.

    Raises ValueError where they are not those of a sweep that the program makes.
    """
    if "member" not in attributes:
        return None, None, {}, None
    number, members = (int(attributes.get(name, 0)) for name in ("member", "members"))
    if not 1 <= number <= members <= MOST:
        raise ValueError(f"member {number} of {members}")
    sweep = swept(attributes.get("sweep", ""))
    if strange := [name for name in sweep if not VARIABLE.fullmatch(name)]:
        raise ValueError(f"{strange[0]!r} is no variable")
    marks = tuple(f"{attributes.get('sweep_marks', '')}".split())
    return number, members, sweep, marks if len(marks) == len(("before", "own", "all")) else None


def at_rest(run: Run) -> dict[str, Any]:
    """The equilibrium."""
    known = {name: run[f"equilibrium/{own}"] for name, own in FIGURES.items() if f"equilibrium/{own}" in run}
    if (hottest := "equilibrium/maximum_temperature") in run:
        known["equilibrium_maximum_temperature"] = run[hottest].max()
    return known | {
        "equilibrium_y": float(run["equilibrium/journal_y"]),
        "equilibrium_z": float(run["equilibrium/journal_z"]),
        "equilibrium_min_film_thickness": run["equilibrium/min_film_thickness"].min(),
        "equilibrium_max_pressure": run["equilibrium/max_pressure"].max(),
    }


def vibrations(run: Run) -> dict[str, Any]:
    """Coefficients and modes; of a run without equilibrium only the speed."""
    if run.task != "coefficients":
        raise NotInRunError(f"{run.path}: no coefficients in this run")
    values: dict[str, Any] = {"speed": run.input["operation"]["speed_rpm"] * np.pi / 30}
    with suppress(NotInRunError):
        values |= {
            name: run[f"coefficients/{name}"] for name in run.names("coefficients") if name in QUANTITIES
        }
    with suppress(NotInRunError):
        values |= {name: run[f"modes/{name}"] for name in run.names("modes") if name in QUANTITIES}
        values["least_damping_ratio"] = np.nanmin(values["damping_ratio"], axis=1)
    return values


def labels(run: Run, values: dict[str, Any]) -> dict[str, Sequence[Any]]:
    """Values of the dimensions that are not counted from 1."""
    found = {name: list(run[name]) for name in (*LABELS, "frequency_ratio") if name in run}
    points = len(values.get("poincare_y", ()))
    return found | {"revolution": range(1 - points, 1)}


def motion(run: Run, part: slice) -> dict[str, Any]:
    """The motion in the last revolution, the samples `part`; NotInRunError where the run was shorter."""
    if signals.turned(run, part) < WHOLE:
        raise NotInRunError(f"{run.path}: no revolution in this run")
    y, z = (run.values(name, part) for name in ("journal_y", "journal_z"))
    tilting = "pad_tilt" in run
    # a periodic orbit of several revolutions is taken as a whole
    whole = slice(run.samples) if run.task == "periodic" else part
    first = {name: signals.first_harmonic(run, name, whole) for name in ("journal_y", "journal_z")}
    film, peak = run.values("min_film_thickness", part), run.values("max_pressure", part)
    return {
        "speed": float(run.values("speed", -1)),
        "orbit_y": np.ptp(y),
        "orbit_z": np.ptp(z),
        "orbit_size": max(np.ptp(y), np.ptp(z)),
        "mean_y": y.mean(),
        "mean_z": z.mean(),
        **{f"{name}_amplitude": abs(each) for name, each in first.items()},
        **{f"{name}_phase": -np.angle(each) for name, each in first.items()},
        "min_film_thickness": film.min(),
        "max_pressure": peak.max(),
        **({"pad_tilt_size": np.ptp(run.values("pad_tilt", part), axis=0)} if tilting else {}),
        "pad_min_film_thickness": film.min(axis=0),
        "pad_max_pressure": peak.max(axis=0),
    }


def ends_of_revolutions(run: Run, count: int) -> dict[str, Any]:
    """Lowest and highest states of the revolutions that end at the last `count` Poincare points.

    They are nan for the first of these where no whole revolution is before it.
    """
    values = {}
    for state in (each for each in POINTS.values() if each in run):
        for way, each in zip(("lowest", "highest"), signals.extremes(run, state, count), strict=True):
            own = np.full((count, *each.shape[1:]), np.nan)
            own[count - len(each) :] = each
            values[f"{way}_{state.rpartition('_')[2]}"] = own
    return values


def friction(run: Run, part: slice) -> dict[str, Any]:
    """Friction of the pivots in the samples `part`; NotInRunError where there is none."""
    limit = pivots.stick_velocity(run)
    names = ("time", "pad_tilt", "pad_tilt_rate", "friction_moment")
    time, tilt, rate, moment = (run.values(name, part) for name in names)
    sliding, duration = pivots.ball_radius(run) * rate, signals.lasted(run, part)
    pads = range(run.pads)
    work = np.array([pivots.path_integral(tilt[:, k], moment[:, k]) for k in pads])
    stuck = [np.diff(pivots.slow_intervals(time, sliding[:, k], limit)).sum() / duration for k in pads]
    return {
        "friction_work": work.sum(),
        "stick_fraction": np.mean(stuck),
        "pad_friction_work": work,
        "pad_stick_fraction": np.array(stuck),
    }


def cost(run: Run) -> dict[str, float]:
    """The numbers of the group statistics; none where the run has no such group."""
    if "statistics" not in run:
        return {}
    return {
        name: float(value)
        for name, value in run["statistics"].items()
        if COST.fullmatch(name) and name not in QUANTITIES
    }


def planned(members: Sequence[Member]) -> int:
    """Number of members that the sweep has, by the file that says most; 0 for single runs."""
    return max(each.members or 0 for each in members)
