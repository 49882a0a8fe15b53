"""Coefficients over speed and whirl frequency: a study of this program, and ROSS's own tilting pads."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import tiltpad
from bearing import BEARING as B
from runner import Row, Runner, launch
from settings import ROOT
from tables import short, small, table

#: The map: speeds in rpm, whirl frequencies over the speed.
SPEEDS, RATIOS = np.linspace(2000, 8000, 100), (0.25, 0.5, 1.0, 1.5, 2.0)
#: Elements of ROSS's film along the arc and across, and the places of the speeds of the map that it does.
MESHES, PLACES = (20, 30), (0, 33, 66, 99)
#: Frequency ratio of which ROSS is timed, and that of a check.
TIMED, CHECKED = 1.0, 0.5
#: Python of ROSS's environment.
PYTHON = ROOT / "build/venv-ross/bin/python"
TILTPAD, ROSS = "tiltpad", "ROSS"


def maps(runner: Runner) -> Iterator[Row]:
    """The map by this program, and some of its speeds by ROSS, whose time counts for each speed."""
    folder = runner.folder / "map"
    input_file = tiltpad.write_case(runner.folder / "map.nml", groups())
    words = [f"sweep%operation%speed_rpm={','.join(f'{each:.10g}' for each in SPEEDS)}"]
    command = [runner.program, input_file, "--quiet", "--overwrite", "--jobs", "1", "--output", folder]
    done = launch([*command, *(word for each in words for word in ("--set", each))])
    row = Row(runner.part, "map", TILTPAD, "defaults", "", done.seconds, len(SPEEDS) * len(RATIOS))
    row.memory_mb = done.memory
    if done.status:
        row.note = f"failed with status {done.status}: {done.said[-200:]}"
        yield row
        return
    yield row
    with tiltpad.read_study(f"{folder}.h5") as study:
        for elements in MESHES:
            for ratio in (TIMED, CHECKED):
                yield by_ross(runner, study, ratio, elements)


def by_ross(runner: Runner, study: tiltpad.Study, ratio: float, elements: int) -> Row:
    """Some speeds by ROSS, and how far its coefficients are from this program's."""
    result = runner.folder / "ross.npz"
    speeds = [f"{SPEEDS[k]:.10g}" for k in PLACES]
    row = Row(runner.part, "map", ROSS, f"{elements} x {elements} elements", f"{ratio:g}", None, len(speeds))
    if not PYTHON.exists():
        row.note = "not installed"
        return row
    done = launch([PYTHON, Path(__file__).with_name("peer_ross.py"), result, ratio, elements, *speeds])
    row.memory_mb = done.memory
    if done.status:
        row.note = f"failed with status {done.status}: {done.said[-200:]}"
        return row
    found = np.load(result)
    own = tiltpad.coefficients(study, frequency_ratio=ratio)
    row.wall_seconds = float(found["seconds"])
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])  # from y, z to x = -z, y
    errors = []
    for name in ("stiffness", "damping"):
        wanted = turn @ getattr(own, name)[list(PLACES), 0] @ turn.T
        errors.append(np.abs(found[name] - wanted).max() / np.abs(wanted).max())
    row.error, row.error_same_film = float(max(errors)), float(errors[0])
    result.unlink()
    return row


def compared(rows: list[Row]) -> str:
    """Time of a speed at one whirl frequency, of the whole map, and how far the coefficients are apart."""
    lines = []
    base = next((row.wall_seconds / row.steps for row in rows if row.group == TILTPAD and row.steps), None)
    for row in rows:
        if row.note:
            lines.append((f"{row.group}, {row.setting}", row.note, *[""] * 7))
            continue
        each = row.wall_seconds / row.steps
        of_map = f"{'' if row.group == TILTPAD else 'would be '}{short(each * len(SPEEDS) * len(RATIOS))}"
        times = short(row.wall_seconds), short(1e3 * each), of_map, short(each / base)
        errors = small(row.error_same_film), small(row.error)
        lines.append((f"{row.group}, {row.setting}", row.overrides or "all", f"{row.steps}", *times, *errors))
    times = "wall s | ms each | the map, s | over tiltpad"
    return table(f" | whirl over shaft speed | solved | {times} | K | K and C", lines)


def groups() -> dict[str, dict]:
    """The case: rigid pivots, pads nearly without mass."""
    return {
        "case": {"task": "coefficients"},
        "coefficients": {"frequency_ratio": RATIOS},
        "rotor": {"mass": B.mass, "gravity": B.gravity},
        "bearing": {
            **{"journal_radius": B.radius, "axial_length": B.length, "viscosity": B.viscosity},
            **{"assembled_clearance": B.clearance, "preload": B.preload},
        },
        "pads": {
            **{"pivot_angle_deg": B.angles, "arc_deg": B.arc, "pivot_ratio": 0.5, "motion": "tilting_only"},
            **{"pivot_distance": B.thickness, "mass": 1e-3, "inertia": 1e-6},
        },
    }
