"""What checkpoints cost, what a run of a study costs beyond its march, and what collecting costs."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import tiltpad
from runner import Row, Runner
from settings import CHECKPOINT_CASES, CHECKPOINT_SECONDS, RUNS

CHECKPOINTS, STUDY, COLLECT, START = "checkpoints", "sweep", "collect", "start"
#: Short runs so often; the best counts. Starts so often; their median counts.
REPEATS = 3
STARTS = 21
#: A study of short frictionless runs, and one of them longer: what the march alone takes follows.
CASE = "&operation duration={duration:g} /\n"
VARIED = "&sweep rotor%unbalance=1e-5:{last:g}:1e-5 /\n"
SHORT, LONG = 0.1, 10.1


def production(runner: Runner) -> Iterator[Row]:
    """Rows of checkpoints, study and collection."""
    for case in CHECKPOINT_CASES:
        # what runs before it left to the system to write is not its own
        os.sync()
        overrides = (f"output%checkpoint_seconds={CHECKPOINT_SECONDS:g}",)
        row, path = runner.run(case, CHECKPOINTS, f"{CHECKPOINT_SECONDS:g} s", overrides, repeat=False)
        with tiltpad.read(path) as run:
            row.checkpoint_seconds = float(run["statistics/checkpoint_seconds"])
        row.case, row.note = case.label, f"{path.stat().st_size / 1e6:.0f} MB"
        row.copy_seconds = copying(path)
        path.unlink()
        yield row
    yield Row(runner.part, "none", START, "--version", wall_seconds=start(runner))
    yield from runs(runner)


def start(runner: Runner) -> float:
    """Seconds of the program as a process that prints its version."""
    times = []
    for _ in range(STARTS):
        started = time.perf_counter()
        subprocess.run([runner.program, "--version"], stdout=subprocess.DEVNULL, check=True)
        times.append(time.perf_counter() - started)
    return sorted(times)[STARTS // 2]


def copying(path: Path) -> float:
    """Seconds of a plain copy of a file, of which the system has yet to write as much as it likes."""
    twin = path.with_suffix(".copy")
    started = time.perf_counter()
    shutil.copyfile(path, twin)
    seconds = time.perf_counter() - started
    twin.unlink()
    return seconds


def runs(runner: Runner) -> Iterator[Row]:
    """A run, a longer one, all of a study of the first, the same again, and its collection."""
    folder = runner.folder / "runs"
    folder.mkdir()
    for duration in (SHORT, LONG):
        times = [timed(runner, folder / "case.nml", CASE.format(duration=duration)) for _ in range(REPEATS)]
        seconds = min(times)
        yield Row(runner.part, "one", STUDY, f"{duration:g}", wall_seconds=seconds, rotor_seconds=duration)
    text = CASE.format(duration=SHORT) + VARIED.format(last=1e-5 * RUNS)
    for setting in ("all", "again"):
        seconds = timed(runner, folder / "study.nml", text)
        yield Row(runner.part, "sweep", STUDY, setting, wall_seconds=seconds)
    collect = Path(sys.executable).with_name("tiltpad-collect")
    started = time.perf_counter()
    words = [collect, "study", "-o", "collected.h5"]
    done = subprocess.run(words, cwd=folder, text=True, capture_output=True)
    seconds = time.perf_counter() - started
    if done.returncode:
        raise RuntimeError(done.stderr)
    yield Row(runner.part, "sweep", COLLECT, "all", wall_seconds=seconds)
    shutil.rmtree(folder)


def timed(runner: Runner, case: Path, text: str) -> float:
    """Wall seconds of a case, on all cores; a study goes on from what it has, a run starts anew."""
    if "&sweep" not in text:
        case.with_suffix(".h5").unlink(missing_ok=True)
    case.write_text(text)
    os.sync()
    started = time.perf_counter()
    subprocess.run([runner.program, "--quiet", case.name], cwd=case.parent, check=True)
    return time.perf_counter() - started
