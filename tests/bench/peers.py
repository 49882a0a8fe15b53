"""Peers: the same case by SciPy's BDF and by Octave's ode15s, each the recipe that its user would write."""

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import settings
import tiltpad
from errors import Deviation
from peer_model import COLUMNS, ROWS, STATES, Bearing, compliance
from runner import Launched, Row, Runner, launch
from tiltpad.calculate.deviations import SIGNALS, characteristic_scale, deviation

HERE = Path(__file__).parent
PROGRAM = "octave-cli"
#: Groups of the rows.
TILTPAD, SHORT, SCIPY, OCTAVE = "tiltpad", "tiltpad, short", "SciPy BDF", "Octave ode15s"
SCALED, SCALAR = "scaled tolerances", "scalar tolerance"
OWN, DIFFERENCED = "", ", SciPy's own Jacobian"
MARCHES = (
    (settings.LONG_SPAN, SCALED, OWN),
    (settings.JACOBIAN_SPAN, SCALED, DIFFERENCED),
    (settings.TOLERANCE_SPAN, SCALED, OWN),
    (settings.TOLERANCE_SPAN, SCALAR, OWN),
)


def peers(runner: Runner) -> Iterator[Row]:
    """tiltpad with its defaults, with the peers' film, and the peers."""
    spans = {settings.LONG_SPAN, settings.JACOBIAN_SPAN, settings.TOLERANCE_SPAN, settings.OCTAVE_SPAN}
    files = {span: pair(runner, span) for span in sorted(spans)}
    row, path = runner.run(settings.PEER_CASE, TILTPAD, "defaults")
    path.unlink()
    yield row
    for setting, film in (("defaults", ()), ("the peers' film", settings.PEER_FILM)):
        more = (*film, f"operation%duration={settings.LONG_SPAN}")
        row, path = runner.run(settings.PEER_CASE, SHORT, setting, more)
        with tiltpad.read(path) as run:
            compare(row, {name: run[name] for name in SIGNALS}, files[settings.LONG_SPAN])
        path.unlink()
        yield row
    for march in MARCHES:
        yield scipy(runner, *march, files[march[0]])
    yield octave(runner, files[settings.OCTAVE_SPAN])
    for path in sum(files.values(), ()):
        path.unlink()


def pair(runner: Runner, span: float) -> tuple[Path, Path]:
    """Converged runs over a span: with the film of the modes, and with the film of the peers."""
    paths = []
    for label, overrides in (settings.PEER_REFERENCE, ("the peers' film", settings.PEER_TIGHT)):
        more = (*overrides, f"operation%duration={span}")
        row, path = runner.run(settings.PEER_CASE, "reference", label, more, timed=False)
        if row.note:
            raise RuntimeError(f"no reference for the peers: {row.note}")
        paths.append(path)
    return tuple(paths)


def compare(row: Row, found: dict[str, np.ndarray], files: tuple[Path, Path]) -> None:
    """Enters the deviations over the last revolution; a shorter march is not compared."""
    for path in files:
        with tiltpad.read(path) as true:
            part = tiltpad.last_revolutions(true)
            if part.start == 0:
                return
            errors = {
                name: deviation(values[part], true.values(name, part), characteristic_scale(true, name))
                for name, values in found.items()
            }
        if path == files[0]:
            row.compare(Deviation(errors))
        else:
            row.error_same_film = max(errors.values())


def scipy(runner: Runner, span: float, kind: str, jacobian: str, files: tuple[Path, Path]) -> Row:
    """SciPy's march over a span."""
    result = runner.folder / "scipy.npz"
    os.environ["NUMBA_CACHE_DIR"] = str(runner.folder)
    words = ["--scaled"] if kind == SCALED else ["--absolute", settings.PEER_ABSOLUTE]
    words += ["--own-jacobian"] if jacobian == OWN else []
    words += ["--relative", settings.PEER_RELATIVE, "--film-tolerance", settings.PEER_FILM_TOLERANCE]
    done = launch([sys.executable, HERE / "peer_scipy.py", files[1], result, *words])
    row = Row(runner.part, settings.PEER_CASE.name, SCIPY, kind + jacobian, " ".join(map(str, words)))
    if done.status:
        return failed(row, done)
    found = dict(np.load(result))
    enter(row, done, span, float(found.pop("seconds")), int(found.pop("evaluations")))
    compare(row, found, files)
    result.unlink()
    return row


def octave(runner: Runner, files: tuple[Path, Path]) -> Row:
    """Octave's march over a span, where there is Octave."""
    setting = "scalar tolerance, sparse direct film"
    words = f"RelTol {settings.PEER_RELATIVE:g}, AbsTol {settings.PEER_ABSOLUTE:g}"
    row = Row(runner.part, settings.PEER_CASE.name, OCTAVE, setting, words)
    if not shutil.which(PROGRAM):
        row.note = "not installed"
        return row
    script, result = runner.folder / "case.m", runner.folder / "octave.txt"
    with tiltpad.read(files[1]) as run:
        script.write_text(case(run))
    done = launch([PROGRAM, "--quiet", "--norc", HERE / "peer_octave.m", script, result])
    if done.status:
        return failed(row, done)
    seconds, evaluations = result.read_text().split("\n", 1)[0].split()
    values = np.loadtxt(result, skiprows=1)
    pads = (values.shape[1] - 5) // (STATES + 1)
    found = {
        "journal_y": values[:, 1],
        "journal_z": values[:, 2],
        "pad_tilt": values[:, 5 : 5 + STATES * pads : STATES],
        "friction_moment": values[:, -pads:],
    }
    enter(row, done, settings.OCTAVE_SPAN, float(seconds), int(evaluations))
    compare(row, found, files)
    return row


def enter(row: Row, done: Launched, span: float, seconds: float, evaluations: int) -> None:
    """Enters what a peer's march cost; starting the interpreter and compiling do not count."""
    row.wall_seconds, row.rotor_seconds, row.rhs, row.memory_mb = seconds, span, evaluations, done.memory


def failed(row: Row, done: Launched) -> Row:
    row.note = f"failed with status {done.status}: {done.said[-200:]}"
    return row


def case(run: tiltpad.Run) -> str:
    """The case, its first state and the times of its samples as Octave reads them."""
    bearing = Bearing(run.input, settings.PEER_FILM_TOLERANCE)
    pivot, inputs = run.input["pivot"], run.input["bearing"]
    names = "theta", "pivot", "centre", "pad_mass", "inertia", "centre_radial"
    values = dict(zip(names, bearing.pads.T, strict=True))
    names = "mass", "unbalance", "gravity"
    values |= dict(zip(names, bearing.rotor, strict=True))
    names = "ball", "sticking", "dynamic", "stribeck", "stiffness", "damping"
    values |= dict(zip(names, bearing.friction, strict=True))
    values |= {
        "columns": COLUMNS, "rows": ROWS, "arc": bearing.geometry[:, 4:6].sum(axis=1),
        "trailing": bearing.geometry[:, 5], "length": np.max(inputs["axial_length"]),
        "machined": np.max(inputs["machined_clearance"]), "radius": bearing.geometry[0, 0],
        "inner": inputs["journal_radius"], "viscosity": inputs["viscosity"], "speed": bearing.speed,
        "outer": np.max(pivot["socket_radius"]), "difference": np.max(pivot["radius_difference"]),
        "compliance": compliance(pivot), "factor": pivot["deflection_factor"],
        "relative": settings.PEER_RELATIVE, "absolute": settings.PEER_ABSOLUTE,
    }  # fmt: skip
    equilibrium = run.equilibrium
    first = [equilibrium["journal_y"], equilibrium["journal_z"], 0, 0]
    for tilt, depth in zip(equilibrium["pad_tilt"], equilibrium["pivot_deflection"], strict=True):
        first += [tilt, 0, depth, 0, 0]
    lines = [f"s.{name} = {row_of(value)};" for name, value in values.items()]
    lines += [f"first = {row_of(first)}';", f"times = {row_of(run.time)}';"]
    return "\n".join(lines) + "\n"


def row_of(value) -> str:
    """A number or a row of numbers."""
    numbers = np.atleast_1d(np.asarray(value, float))
    return f"[{', '.join(f'{each:.17g}' for each in numbers)}]"
