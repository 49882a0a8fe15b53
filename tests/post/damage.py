"""Damages a result or a study and uses the damaged file, each time in a process of its own.

usage: damage.py FILE COUNT SEED [PICTURE-EVERY]

The damages are those of damages.py. All calculations are done each time, a picture or a page for some of the
damages. Prints a line for each damage that crashed, hung, needed too much memory, or ended with
neither success nor one line that names the file. The last line counts the damages that were read, refused
and faulty.
"""

import io
import os
import random
import resource
import signal
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import h5py
import matplotlib as mpl
from damages import Source, damaged_copy

mpl.use("agg")

import tiltpad  # noqa: E402
from tiltpad import command, diagrams, figures, summary  # noqa: E402, F401

#: Damages from one picture to the next; seconds, of the processor's time too, and bytes for one damage.
PICTURE_EVERY, TIMEOUT, SECONDS, MEMORY = 6, 60, 5, 500 << 20


def main() -> None:
    source, count, seed = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    every = int(sys.argv[4]) if len(sys.argv) > 4 else PICTURE_EVERY
    with h5py.File(source, "r") as file:
        calculate, entries = (STUDIED, STUDY) if file.attrs["task"] == "study" else (MARCHED, RUN)
    sound = Source(source)
    outcomes = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            dice = random.Random(f"{seed}/{number}")
            path = Path(folder) / f"{source.stem}.h5"
            what = damaged_copy(dice, sound, path)
            work = [calculate, *([dice.choice(entries)] if number % every == 0 else [])]
            outcome, said = in_child(lambda work=work, path=path: use(path, work))
            outcomes[outcome] += 1
            if outcome not in ("read", "refused"):
                print(f"seed {seed}, damage {number} ({what}): {outcome}: {said}")
    print(f"{outcomes.pop('read', 0)} read, {outcomes.pop('refused', 0)} refused, {outcomes.total()} faulty")


def in_child(work: Callable[[], tuple[str, str]]) -> tuple[str, str]:
    """Outcome and message of the work in a process of its own, or the signal that ended it."""
    receive, send = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(TIMEOUT)
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        try:
            os.write(send, "\n".join(work()).encode()[:4000])
        finally:
            os._exit(0)
    os.close(send)
    status = os.waitpid(child, 0)[1]
    with os.fdopen(receive, "rb") as stream:
        told = stream.read().decode(errors="replace")
    if os.WIFSIGNALED(status):
        return "died", signal.Signals(os.WTERMSIG(status)).name
    outcome, _, said = told.partition("\n")
    return outcome or "ended", said


def use(path: Path, work: list[Callable[[Path], None]]) -> tuple[str, str]:
    """Does the work on a file; gives the outcome and the message."""
    outcome, words = "read", ""
    for each in work:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                each(path)
        except (tiltpad.RunError, tiltpad.LibraryError) as error:
            outcome, words = "refused", f"{error}"
            # or it names the option that asks for what is not there
            if not words.startswith((str(path), "--show: ")) or "\n" in words:
                return "unclear", words
        except BaseException as error:
            frame = error.__traceback__
            while frame.tb_next:
                frame = frame.tb_next
            where = f"{Path(frame.tb_frame.f_code.co_filename).name}:{frame.tb_lineno}"
            return "fault", f"{each.__name__}: {where} {type(error).__name__}: {error}"
    return outcome, words


def calculate(path: Path) -> None:
    """Every array of a result or of a machine and its bearings, their key figures and films."""
    with tiltpad.read(path) as run:
        for each in (run, *run.bearings.values()):
            repr(each), dir(each), each.input
            for name in each.names():
                each[name]
            summary.journal(each)
        for own in run.bearings.values() or [run]:
            own.clearance, own.pads, summary.pads(own)
            tiltpad.poincare(own, 50)
            tiltpad.pressure(own)
            tiltpad.pressure(own, float(own.values("time", -1)))


def calculate_study(path: Path) -> None:
    """Every array of a study, with its unit and meaning."""
    with tiltpad.read_study(path) as study:
        repr(study), dir(study), study.parameters, study.done
        for name in study.names():
            if name != "runs":
                study[name], study.about(name, "units"), study.about(name, "long_name")


def collected(path: Path) -> None:
    """The study of the file alone; it is refused if the file cannot be read."""
    tiltpad.collect(path, path.with_name("collected.h5"))


def by_command(
    entry: Callable[[list[str]], int], *words: str, options: tuple[str, ...] = (), ending: str = ".png"
) -> Callable[[Path], None]:
    """A command; it must print lines of its own only, and an error exactly if its status is not 0."""

    def run(path: Path) -> None:
        said = io.StringIO()
        with redirect_stderr(said), redirect_stdout(said):
            status = entry([*words, str(path), *options, "-o", str(path.with_suffix(ending))])
        lines = said.getvalue().splitlines()
        errors = [line for line in lines if ": error: " in line]
        if any(": error: " not in line and ": warning: " not in line for line in lines):
            raise AssertionError(f"{words}: {lines}")
        if (status == 0) != (not errors) or len(errors) > 1 or status not in (0, 1, 3):
            raise AssertionError(f"{words}: status {status}: {lines}")
        if errors:
            raise tiltpad.RunError(errors[0].partition(": error: ")[2])

    run.__name__ = " ".join((*words, *options)) or "report"
    return run


MARCHED, STUDIED = calculate, calculate_study
#: Work on a result, and on a study, for some of the damages.
RUN = [
    collected,
    by_command(command.report, ending=".html"),
    *(by_command(command.main, plot) for plot in command.PLOTS if plot not in (command.STUDY, command.MOVIE)),
]
STUDY = [
    by_command(command.main, "study"),
    *(by_command(command.main, "study", options=("--as", kind)) for kind in diagrams.KINDS),
    by_command(command.main, "study", options=("--show", "wall_seconds")),
    *(by_command(command.main, plot) for plot in command.SAMPLES),
]

if __name__ == "__main__":
    main()
