"""The commands that get the faults: what is there before, what follows, and what both must leave."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from injector import Fault, Injector

#: Seconds after which a command counts as hung, and in which its other processes must have ended.
LIMIT, GRACE = 120, 10
MARCH = (
    "&friction model='lugre' /\n&operation duration=0.01 /\n"
    "&output checkpoint_seconds=1e-9, samples_per_revolution=100 /\n"
)
CASES = {
    "march": MARCH,
    "periodic": "&case task='periodic' / &output checkpoint_seconds=1e-9 /\n",
    "coefficients": "&case task='coefficients' /\n",
    "branch": "&case task='branch' / &output checkpoint_seconds=1e-9 /\n"
    "&branch of='equilibrium', parameter='rotor%mass', last=2150, step=100, max_step=100 /\n",
    "study": MARCH + "&sweep operation%speed_rpm=4000,5000,6000,7000 /\n",
    "rows": "&case task='equilibrium' /\n&sweep operation%speed_rpm=4000:7000:10 /\n",
}
#: Files from which on tiltpad-collect has workers, at two processors.
MANY = 200
PACKAGE = Path(__file__).resolve().parents[2] / "post"


@dataclass(frozen=True)
class Command:
    """A command, what is there before it, and the command after it, if that is another."""

    name: str
    words: tuple[str, ...]
    #: Files that it makes, by patterns.
    results: tuple[str, ...]
    #: Files before it: a case; what further commands make, without faults or with one; more.
    case: str = "march"
    before: tuple[tuple[tuple[str, ...], Fault | None], ...] = ()
    make: Callable[[Path], None] = field(default=lambda folder: None)
    then: tuple[str, ...] = ()
    #: Whether a run that goes on has other bits than one that was not stopped.
    marches: bool = False

    @property
    def next_words(self) -> tuple[str, ...]:
        return self.then or self.words

    @property
    def copied(self) -> bool:
        """Whether what is there before may be copied: a part of a killed run is known by its inode."""
        return not any(fault for _, fault in self.before)

    @property
    def speaker(self) -> str:
        """The command's name in messages."""
        return self.words[0]


def run_of(case: str, *options: str) -> tuple[str, ...]:
    return ("tiltpad", "-q", *options, f"{case}.nml")


def hard_links(folder: Path) -> None:
    """As many results as workers need."""
    (folder / "many").mkdir()
    for number in range(MANY):
        os.link(folder / "equilibrium.h5", folder / "many" / f"{number}.h5")


def going_on(case: str) -> tuple[str, ...]:
    """Goes on with the result of a run, or starts it."""
    return run_of(case, "--resume", f"{case}.h5")


EQUILIBRIUM = (run_of("march", "--set", "case%task=equilibrium", "--output", "equilibrium.h5"), None)
COLLECT, REPORT, PLOT = "tiltpad-collect", "tiltpad-report", "tiltpad-plot"
PART_OF_STUDY = (COLLECT, "study/0001.h5", "study/0002.h5", "-o", "collected.h5")
COMMANDS = (
    Command("march", run_of("march"), ("march.h5",), then=going_on("march"), marches=True),
    Command(
        "march, over another result", run_of("march", "--overwrite"), ("march.h5",),
        before=((run_of("march", "--set", "rotor%mass=2000"), None),), marches=True,
    ),
    Command(
        "march, resumed", going_on("march"), ("march.h5",),
        before=((run_of("march"), Fault("rename", 3, "kill")),), marches=True,
    ),
    *(
        Command(task, run_of(task), (f"{task}.h5",), task, then=going_on(task))
        for task in ("branch", "periodic", "coefficients")
    ),
    Command("study", run_of("study", "--jobs", "2"), ("study.h5", "study/*.h5"), "study", marches=True),
    Command("study of rows", run_of("rows", "--jobs", "2"), ("rows.h5",), "rows"),
    Command(
        "collect", (COLLECT, "study", "-o", "collected.h5"), ("collected.h5",), "study",
        before=((run_of("study"), None), (PART_OF_STUDY, None)),
    ),
    Command("collect, with workers", (COLLECT, "many"), ("many.h5",), before=(EQUILIBRIUM,), make=hard_links),
    Command(
        "report", (REPORT, "equilibrium.h5"), ("equilibrium.html",), before=(EQUILIBRIUM,),
        make=lambda folder: (folder / "equilibrium.html").write_text("the page before"),
    ),
    Command(
        "plot", (PLOT, "equilibrium", "equilibrium.h5", "-o", "a.png"), ("a.png",), before=(EQUILIBRIUM,),
        make=lambda folder: (folder / "a.png").write_text("the picture before"),
    ),
)  # fmt: skip


@dataclass
class Ended:
    """How a command ended, and which of its processes had not."""

    status: int
    said: str
    orphans: list[int]


class Place:
    """A folder in which commands run, with and without faults."""

    def __init__(self, program: Path, injector: Injector, folder: Path):
        self.program, self.injector, self.folder = program, injector, folder
        self.work = folder / "work"
        self.counts = folder / "counts"

    def prepare(self, command: Command, template: Path) -> None:
        """What is there before the command, in a template if it has been made there, and may be copied."""
        if command.copied and template.exists():
            shutil.copytree(template, self.work)
            return
        self.work.mkdir()
        (self.work / f"{command.case}.nml").write_text(CASES[command.case])
        for words, fault in command.before:
            done = self.run(words, fault)
            if done.status != (-signal.SIGKILL if fault else 0):
                raise RuntimeError(f"{words}: {done.status} {done.said}")
        command.make(self.work)
        if command.copied:
            shutil.copytree(self.work, template)

    def run(self, words: tuple[str, ...], fault: Fault | None = None) -> Ended:
        """Runs a command in a session of its own."""
        name, *arguments = words
        start = [str(self.program)]
        if name != "tiltpad":
            entry = name.removeprefix("tiltpad-").replace("plot", "main")
            code = f"import sys; from tiltpad import command; sys.exit(command.{entry}(sys.argv[1:]))"
            start = [sys.executable, "-P", "-c", code]
        environment = self.injector.environment(self.counts, fault, self.work.resolve())
        environment["PYTHONPATH"] = str(PACKAGE)
        # pages have the same bits at any time
        environment |= {
            "SOURCE_DATE_EPOCH": "0",
            "MATPLOTLIBRC": str(self.folder),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        (self.folder / "matplotlibrc").write_text("svg.hashsalt: faults\n")
        with tempfile.TemporaryFile() as said:
            process = subprocess.Popen(
                [*start, *arguments], cwd=self.work, env=environment, start_new_session=True,
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said,
            )  # fmt: skip
            try:
                status = process.wait(LIMIT)
            except subprocess.TimeoutExpired:
                status = None
            orphans = left(process.pid, GRACE if status is not None else 0)
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            said.seek(0)
            return Ended(-99 if status is None else status, said.read().decode(errors="replace"), orphans)


def left(session: int, seconds: float) -> list[int]:
    """Processes of a session that have not ended after this time, s."""
    end = time.monotonic() + seconds
    while (found := of_session(session)) and time.monotonic() < end:
        time.sleep(0.05)
    return found


def of_session(session: int) -> list[int]:
    """Processes of a session that have not ended."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            # behind the name, in brackets: state, parent, group, session
            words = path.read_text().rpartition(")")[2].split()
            if int(words[3]) == session and words[0] not in "ZX":
                found.append(int(path.parent.name))
    return found
