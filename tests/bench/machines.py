"""Machines: elastic rotors on several bearings, and what other programs need for them."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import settings
from maps import PYTHON
from runner import Launched, Row, Runner, launch
from settings import REFINED, Case
from tables import short, small, table, verdict

HERE = Path(__file__).parent
#: A rotor of 4 t with its disc in the middle.
LENGTH, DIAMETER = [0.05, 0.05, *[0.2] * 8, 0.05, 0.05], [*[0.0998] * 2, *[0.34] * 8, *[0.0998] * 2]
#: Mass, diametral and polar moment of inertia of its disc; its station, unbalance, and those of the bearings.
DISC, MIDDLE, MOMENT, BEARINGS = (2847.3706547456786, 280.5609218476075, 512.526717854222), 7, 0.02, (2, 12)
SYMMETRIC = """
&shaft length = 0.05, 0.05, 8*0.2, 0.05, 0.05, diameter = 2*0.0998, 8*0.34, 2*0.0998 /
&disc station = 7, mass = 2847.3706547456786, polar_inertia = 512.526717854222,
   diametral_inertia = 280.5609218476075 /
&unbalance station = 7, moment = 0.02 /
&bearing name = 'left', station = 2 /
&bearing name = 'right', station = 12 /
"""
TRAIN = """
&shaft length = 0.05, 0.05, 8*0.2, 0.05, 0.15, 8*0.2, 0.05, 0.05,
   diameter = 2*0.0998, 8*0.34, 2*0.12, 8*0.3, 2*0.0998 /
&disc station = 7, mass = 2847, polar_inertia = 512, diametral_inertia = 280 /
&disc station = 17, mass = 1500, polar_inertia = 200, diametral_inertia = 110 /
&unbalance station = 7, moment = 0.02 /
&unbalance station = 17, moment = 0.01, angle_deg = 90 /
&bearing name = 'left', station = 2 /
&bearing name = 'middle', station = 12 /
&bearing name = 'right', station = 22 /
"""
TWO_DISCS = """
&shaft length = 0.05, 0.05, 10*0.2, 0.05, 0.05, diameter = 2*0.0998, 10*0.26, 2*0.0998 /
&disc station = 6, mass = 1400, polar_inertia = 120, diametral_inertia = 70 /
&disc station = 10, mass = 1000, polar_inertia = 80, diametral_inertia = 50 /
&unbalance station = 6, moment = 0.01 /
&unbalance station = 10, moment = 0.01, angle_deg = 120 /
&bearing name = 'left', station = 2 /
&bearing name = 'right', station = 14 /
"""
SPEED = 4100
STEADY = f"&operation speed_rpm = {SPEED}, duration = 2 /\n&friction model = 'lugre' /\n"
#: Name, label, text, and wall seconds that the marches are to stay below.
MARCHES = (
    ("two_pads", "two bearings of two pads, LuGre, 2 s", STEADY + SYMMETRIC, 0.6),
    ("four_pads", "two bearings of four pads, LuGre, reynolds, 2 s",
     STEADY + "&pads pivot_angle_deg = -45, 225, 45, 135 /\n" + SYMMETRIC, 1.5),
    ("train", "three bearings of two pads, LuGre, 2 s", STEADY + TRAIN, 2.5),
    ("run_up", "run-up of 10 s through two critical speeds",
     "&operation speed_rpm = 1000, final_speed_rpm = 12000, duration = 10 /\n" + TWO_DISCS, 2.0),
)  # fmt: skip
#: The map of modes over the speed, its figure, and how films are solved for its reference.
MAP, MAP_SECONDS, CLOSER = "campbell", 1.5, ("film%table_tolerance=1.2e-6",)
SPEEDS = np.linspace(1000, 8000, 100)
#: Groups of the rows; seconds that SciPy marches, and its methods.
TILTPAD, ROSS, SCIPY = "tiltpad", "ROSS", "SciPy"
SPAN, METHODS = 0.005, ("BDF", "Radau")


def machines(runner: Runner) -> Iterator[Row]:
    """The marches and the map by this program, and the first march and the map by others."""
    for name, label, text, _ in MARCHES:
        case = written(runner, name, label, text)
        row, path = runner.run(case, TILTPAD, "defaults")
        reference, exact = runner.run(case, "reference", *REFINED[-1], timed=False)
        if not (row.note or reference.note):
            row.error, row.error_pad_tilt = errors(path, exact, whole=name == "run_up")
        if name == MARCHES[0][0] and not reference.note:
            peer = by_ross(runner, exact)
        yield row
        path.unlink(missing_ok=True)
        exact.unlink(missing_ok=True)
    yield campbell(runner)
    yield from peer
    yield from by_scipy(runner)


def written(runner: Runner, name: str, label: str, text: str) -> Case:
    """A case whose file stands in the runner's folder."""
    path = runner.folder / f"machine_{name}.nml"
    path.write_text(text)
    return Case(name, label, str(path))


def errors(path: Path, reference: Path, whole: bool) -> tuple[float, float]:
    """Deviations of stations and of pad tilts in the last revolution, or over the whole run, over the largest
    peak-to-peak."""
    with h5py.File(path) as run, h5py.File(reference) as true:
        angle = true["shaft_angle"][()]
        first = 0 if whole else int(np.searchsorted(angle, angle[-1] - 2 * np.pi * (1 + 1e-9)))
        tilts = [f"bearings/{name}/pad_tilt" for name in true["bearings"]]
        return tuple(largest(run, true, names, first) for names in (("station_y", "station_z"), tilts))


def largest(run: h5py.File, true: h5py.File, names, first: int) -> float:
    """Largest deviation of some signals, over the largest peak-to-peak of them."""
    span = max(float(np.ptp(true[name][first:], axis=0).max()) for name in names)
    return max(float(abs(run[name][first:] - true[name][first:]).max()) for name in names) / span


def campbell(runner: Runner) -> Row:
    """The map, and its error against closer films."""
    text = f"&case task = 'coefficients' /\n&friction model = 'lugre' /\n{SYMMETRIC}"
    text += f"&sweep operation%speed_rpm = {', '.join(f'{each:.10g}' for each in SPEEDS)} /\n"
    case = written(runner, MAP, "modes at 100 speeds, a core", text)
    row = Row(runner.part, MAP, TILTPAD, "defaults")
    found = {}
    for setting, overrides in (("defaults", ()), ("closer", CLOSER)):
        path = runner.folder / f"{MAP}_{setting}.h5"
        words = [word for each in overrides for word in ("--set", each)]
        command = [runner.program, case.input_file, "--quiet", "--overwrite", "--jobs", "1", "--output", path]
        done = launch([*command, *words])
        if done.status:
            return failed(row, done)
        if setting == "defaults":
            row.wall_seconds, row.memory_mb, row.steps = done.seconds, done.memory, len(SPEEDS)
        with h5py.File(path) as file:
            found[setting] = file["eigenvalue_real"][()] + 1j * file["eigenvalue_imag"][()]
        path.unlink()
    row.error = max(
        nearest(found["defaults"][k, p], found["closer"][k, p], 5 * speed * np.pi / 30)
        for k, speed in enumerate(SPEEDS)
        for p in range(found["closer"].shape[1])
    )
    return row


def nearest(values: np.ndarray, exact: np.ndarray, below: float) -> float:
    """Largest deviation of vibrations, 1/s, of a frequency below this from the nearest one, over them."""
    values = values[np.isfinite(values)]
    chosen = exact[(exact.imag > 0) & (exact.imag < below)]
    return max(float(abs(values - each).min() / abs(each)) for each in chosen)


def by_ross(runner: Runner, reference: Path) -> list[Row]:
    """ROSS marches the rotor on its bearings' matrices at this speed, and finds its modes over the speed."""
    rows = [
        Row(runner.part, name, ROSS, setting)
        for name, setting in ((MARCHES[0][0], "linear bearings"), (MAP, "given stiffness and damping"))
    ]
    if not PYTHON.exists():
        for row in rows:
            row.note = "not installed"
        return rows
    question, result = runner.folder / "ross.json", runner.folder / "ross.npz"
    question.write_text(json.dumps(asked_of_ross(runner)))
    done = launch([PYTHON, HERE / "peer_ross_machine.py", question, result])
    if done.status:
        return [failed(row, done) for row in rows]
    found = np.load(result)
    rows[0].wall_seconds, rows[1].wall_seconds = float(found["march"]), float(found["modes"])
    rows[0].rotor_seconds, rows[0].memory_mb, rows[1].steps = 2.0, done.memory, len(SPEEDS)
    # from x = -z, y to y, z; the reference at the same phases of its last revolution
    moved = found["moved"] @ np.array([[0.0, -1.0], [1.0, 0.0]])
    with h5py.File(reference) as file:
        true = np.column_stack(
            [
                file[f"station_{axis}"][:, MIDDLE - 1] - file[f"equilibrium/station_{axis}"][MIDDLE - 1]
                for axis in "yz"
            ]
        )
        phase = file["shaft_angle"][()]
    first = np.searchsorted(phase, phase[-1] - 2 * np.pi)
    wave = [whirl(phase[first:-1], true[first:-1]), whirl(found["times"] * SPEED * np.pi / 30, moved)]
    rows[0].error = float(np.linalg.norm(wave[1] - wave[0]) / np.linalg.norm(wave[0]))
    return rows


def whirl(phase: np.ndarray, moved: np.ndarray) -> np.ndarray:
    """Complex amplitudes at the frequency of the shaft of samples of a revolution."""
    return 2 * np.exp(-1j * phase) @ moved / len(phase)


def asked_of_ross(runner: Runner) -> dict:
    """The rotor, and the matrices of its bearings over the speed with free pivots."""
    text = f"&case task = 'coefficients' /\n{SYMMETRIC}"
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    tables = {"stiffness": [], "damping": []}
    for speed in SPEEDS:
        case = written(runner, "coefficients", "", f"{text}&operation speed_rpm = {speed:.10g} /\n")
        _, path = runner.run(case, "", "", timed=False)
        with h5py.File(path) as file:
            for name, values in tables.items():
                values.append(
                    [
                        turn @ file[f"bearings/{b}/coefficients/{name}"][0, 0] @ turn.T
                        for b in ("left", "right")
                    ]
                )
        path.unlink()
    return {
        "length": LENGTH, "diameter": DIAMETER, "discs": [(MIDDLE - 1, *DISC)],
        "unbalance": [MIDDLE - 1, MOMENT], "nodes": [station - 1 for station in BEARINGS],
        "speeds": list(SPEEDS * np.pi / 30), "speed": SPEED * np.pi / 30, "samples": 360, "duration": 2.0,
        "watched": MIDDLE - 1,
        **{name: np.swapaxes(values, 0, 1).tolist() for name, values in tables.items()},
    }  # fmt: skip


def by_scipy(runner: Runner) -> Iterator[Row]:
    """SciPy's march of the first machine over a short time, with the film of the peers, its error against
    tiltpad with this film."""
    name, label, text, _ = MARCHES[0]
    short_span = f"operation%duration={SPAN}"
    case = written(runner, name, label, text)
    reference, exact = runner.run(case, "reference", "", (*settings.PEER_TIGHT, short_span), timed=False)
    alone = Case(
        "bearing",
        "",
        settings.PEER_CASE.input_file,
        ("case%task=equilibrium", f"operation%speed_rpm={SPEED}"),
    )
    _, bearing = runner.run(alone, "reference", "", timed=False)
    question, result = runner.folder / "scipy.json", runner.folder / "scipy.npz"
    for method in METHODS:
        row = Row(runner.part, name, SCIPY, method)
        if reference.note:
            row.note = reference.note
            yield row
            continue
        with h5py.File(exact) as file:
            modes = len(file["rotor/mode_frequency"])
        rotor = {
            "length": LENGTH, "diameter": DIAMETER, "discs": [(MIDDLE, *DISC)],
            "unbalances": [(MIDDLE, MOMENT, 0)], "bearings": BEARINGS, "modes": modes, "damp_above": 500,
            "ratio": 0.3,
        }  # fmt: skip
        asked = {"archive": str(exact), "bearing": str(bearing), "rotor": rotor, "method": method}
        asked |= {"relative": settings.PEER_RELATIVE, "film_tolerance": settings.PEER_FILM_TOLERANCE}
        question.write_text(json.dumps(asked))
        done = launch([sys.executable, HERE / "peer_machine.py", question, result])
        yield failed(row, done) if done.status else marched(row, done, result, exact)
    exact.unlink(missing_ok=True)
    bearing.unlink(missing_ok=True)


def marched(row: Row, done: Launched, result: Path, exact: Path) -> Row:
    """Enters what a march of SciPy cost, and its error over all of it."""
    found = np.load(result)
    row.wall_seconds, row.rotor_seconds = float(found["seconds"]), SPAN
    row.rhs, row.memory_mb = int(found["evaluations"]), done.memory
    with h5py.File(exact) as file:
        true = np.dstack([file["station_y"][()], file["station_z"][()]])
        at_rest = np.dstack([file[f"equilibrium/station_{axis}"][()] for axis in "yz"])
    moved = found["stations"].reshape(true.shape)
    # tiltpad adds the static deflection of the modes that are left out
    moved = moved - moved[:1] + true[:1]
    row.error = float(abs(moved - true).max() / abs(true - at_rest).max())
    return row


def failed(row: Row, done: Launched) -> Row:
    row.note = f"failed with status {done.status}: {done.said[-200:]}"
    return row


def compared(rows: list[Row]) -> str:
    """Times, errors, and the figures to reach; for peers the time of all that this program does."""
    own = {row.case: row for row in rows if row.group == TILTPAD}
    labels = {name: label for name, label, *_ in MARCHES} | {MAP: f"modes at {len(SPEEDS)} speeds"}
    limits = {name: limit for name, *_, limit in MARCHES} | {MAP: MAP_SECONDS}
    lines = []
    for row in rows:
        words = labels[row.case], " ".join((row.group, "" if row.group == TILTPAD else row.setting)).strip()
        if row.note:
            lines.append((*words, row.note, *[""] * 7))
            continue
        whole = row.wall_seconds
        if row.group == SCIPY:
            whole *= own[row.case].rotor_seconds / row.rotor_seconds
        seconds = f"{'would be ' if row.group == SCIPY else ''}{short(whole)}"
        counts = row.steps or "-", row.rhs or "-", small(row.error), small(row.error_pad_tilt)
        if row.group == TILTPAD:
            ends = f"{limits[row.case]:g} s", verdict(whole, limits[row.case]), ""
        else:
            ends = "", "", short(whole / own[row.case].wall_seconds)
        lines.append((*words, seconds, *counts, *ends))
    return table(
        " | program | s | steps or speeds | evaluations | error | error of tilts | to reach | | over tiltpad",
        lines,
    )
