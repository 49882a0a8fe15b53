"""Runs of the program: timed alone on one core, or side by side where only the result counts."""

import itertools
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import h5py
from errors import Deviation, deviations
from settings import ROOT, Case

#: Seconds after which a run is killed.
LIMIT = 600
#: A run is timed again, three times at most, until that takes this many seconds; the best counts.
SHORT, REPEATS = 2.0, 3
#: Core of the timed runs.
CORE = 1
DURATION = re.compile(r"\bduration = (\S+)")
LAUNCH = Path(__file__).with_name("launch.py")


@dataclass
class Row:
    """One run, as docs/benchmarks.csv has it."""

    part: str
    case: str
    group: str
    setting: str
    overrides: str = ""
    wall_seconds: float | None = None
    steps: int = 0
    rhs: int = 0
    jacobians: int = 0
    film_evaluations: int = 0
    film_seconds: float = 0.0
    film_solved: int = 0
    film_cells: int = 0
    film_nodes: int = 0
    building_seconds: float = 0.0
    memory_mb: float | None = None
    error_journal_y: float | None = None
    error_journal_z: float | None = None
    error_pad_tilt: float | None = None
    error_friction_moment: float | None = None
    error: float | None = None
    jump_degrees: float = 0.0
    reference_moved: float | None = None
    error_same_film: float | None = None
    rotor_seconds: float = 0.0
    march_seconds: float = 0.0
    checkpoint_seconds: float = 0.0
    copy_seconds: float = 0.0
    work_seconds: float | None = None
    note: str = ""

    def compare(self, found: Deviation) -> None:
        """Enters the deviations from the reference."""
        for name, value in found.signals.items():
            setattr(self, f"error_{name}", value)
        self.error, self.jump_degrees = found.largest, found.jump_degrees


@dataclass
class Launched:
    """What launch.py says of a command."""

    seconds: float
    memory: float
    status: int
    said: str
    #: Processor time, s.
    work: float


def launch(command: Iterable, core: int | None = CORE, limit: int = LIMIT) -> Launched:
    """Runs a command by launch.py, on one core or, without one, on all."""
    place = "all" if core is None else str(core)
    words = [sys.executable, "-I", "-S", LAUNCH, place, str(limit), *map(str, command)]
    quiet = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
    done = subprocess.run(words, text=True, capture_output=True, env=quiet)
    if done.returncode:
        raise RuntimeError(done.stderr)
    seconds, memory, status, work = done.stdout.split()
    return Launched(float(seconds), float(memory), int(status), done.stderr.strip(), float(work))


@dataclass
class Runner:
    """The program, and a folder for its results."""

    program: Path
    folder: Path
    part: str = ""
    #: Finest run of a case, by its name.
    references: dict[str, Path] = field(default_factory=dict)
    number: Callable[[], int] = field(default_factory=lambda: itertools.count().__next__)

    def run(
        self, case: Case, group: str, setting: str, overrides: tuple[str, ...] = (), timed: bool = True,
        core: int = CORE, repeat: bool = True,
    ) -> tuple[Row, Path]:  # fmt: skip
        """One run and its result file, which the caller removes; timed: the best of several if short."""
        path = self.folder / f"{self.number()}.h5"
        overrides = (*case.overrides, *overrides)
        options = [word for each in overrides for word in ("--set", each)]
        command = [self.program, ROOT / case.input_file, "--quiet", "--overwrite", "--output", path, *options]
        row = Row(self.part, case.name, group, setting, " ".join(overrides))
        done, spent, left = launch(command, core), 0.0, REPEATS - 1 if timed and repeat else 0
        while left and done.status == 0 and spent + done.seconds < SHORT:
            # from nothing: a study would go on from its rows
            path.unlink()
            again = launch(command, core)
            done = min(done, again, key=lambda each: each.seconds)
            spent, left = spent + again.seconds, left - 1
        row.memory_mb = done.memory
        if timed:
            row.wall_seconds, row.work_seconds = done.seconds, done.work
        if done.status != 0:
            row.note = done.said.removeprefix("tiltpad: error: ").partition(";")[0] or f"status {done.status}"
            path.unlink(missing_ok=True)
        else:
            count(row, path)
        return row, path

    def many(self, runs: list[tuple], jobs: int = os.cpu_count()) -> list[tuple[Row, Path]]:
        """Untimed runs, each the arguments of `run`, side by side, in the order given."""
        cores = iter(itertools.cycle(range(jobs)))
        with ThreadPoolExecutor(jobs) as pool:
            waiting = [pool.submit(self.run, *each, timed=False, core=next(cores)) for each in runs]
            return [each.result() for each in waiting]

    def judged(self, reference: Path, *arguments, timed: bool = True) -> Row:
        """A run against a reference file; the result file is removed."""
        row, path = self.run(*arguments, timed=timed)
        if not row.note:
            row.compare(deviations(path, reference))
            path.unlink()
        return row


def count(row: Row, path: Path) -> None:
    """Enters what a result file says of its cost."""
    with h5py.File(path) as file:
        if "statistics" not in file:
            return
        row.rotor_seconds = float(DURATION.search(file.attrs["input"])[1])
        counts = {name: values[()] for name, values in file["statistics"].items()}
    row.steps, row.rhs = int(counts["steps"]), int(counts["rhs_evaluations"])
    row.jacobians = int(counts["jacobian_evaluations"])
    row.film_solved = int(counts["film_fourier"] + counts["film_volumes"])
    row.film_evaluations = int(counts["film_table"]) + row.film_solved
    row.film_cells, row.film_nodes = int(counts["film_cells"]), int(counts["film_nodes"])
    row.film_seconds = float(counts["film_seconds"])
    row.building_seconds = float(counts["film_building_seconds"])
    row.march_seconds = float(counts["wall_seconds"] - counts["output_seconds"])
