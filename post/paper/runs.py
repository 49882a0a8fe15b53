"""Runs of the program, side by side on the cores present, and their result files."""

import os
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import tiltpad
from tiltpad.files.processes import run_program

from paper.settings import ROOT, Case

#: Seconds after which a run is killed.
LIMIT = 300
#: The longest runs come first, so that no core idles at the end.
SLOWEST = (
    *("four_twice", "four_once", "runup_ba", "runup_lugre5", "runup_lugre", "lugre100", "ba_slow"),
    "four_pads",
)


class Runs:
    """Results by the case's name, each opened when it is first asked for."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.opened: dict[str, tiltpad.Run] = {}

    def __getitem__(self, name: str) -> tiltpad.Run:
        if name not in self.opened:
            self.opened[name] = tiltpad.read(self.folder / f"{name}.h5")
        return self.opened[name]

    def __enter__(self) -> "Runs":
        return self

    def __exit__(self, *_: object) -> None:
        for run in self.opened.values():
            run.close()


def run_all(program: Path, jobs: Iterable[tuple[Case, Path]], cores: int | None = None) -> None:
    """Runs cases, each into its folder and a process of its own, as many at once as there are cores; raises
    RuntimeError for one that fails.
    """
    order = {name: k for k, name in enumerate(SLOWEST)}
    queue = sorted(jobs, key=lambda job: order.get(job[0].name, len(order)))
    for folder in {folder for _, folder in queue}:
        folder.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(cores or os.cpu_count()) as pool:
        list(pool.map(lambda job: run(program, *job), queue))


def run(program: Path, case: Case, folder: Path) -> Path:
    """One run; its result file."""
    path = folder / f"{case.name}.h5"
    options = [word for each in case.overrides for word in ("--set", each)]
    command = [program, ROOT / case.case, "--quiet", "--overwrite", "--output", path, *options]
    done = run_program(command, capture_output=True, timeout=LIMIT)
    if done.returncode:
        raise RuntimeError(f"{case.name}: {done.stderr.strip()}")
    return path
