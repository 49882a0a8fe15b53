"""Injects faults from outside into commands: the k-th call of a kind fails, or the process is killed there.

usage: inject.py TILTPAD [--faults N] [--seed S] [--only WORD] [--jobs J] [--report FILE] [--verbose]

Each fault has a folder of its own: what is there before, the command with the fault, a look at what it left,
the next command without a fault, and a look at its result. The last line reads "N passed, N failed".
"""

import argparse
import os
import shutil
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

import aftermath
from fault_page import page
from faulty_commands import COMMANDS, Command, Place
from injector import Fault, Injector, counted, draw

#: Faults of a command for one of the others: those in Python take seconds, and so does their next command.
SHARES = {"collect": 0.45, "collect, with workers": 0.08, "report": 0.2, "plot": 0.15}


@dataclass
class Outcome:
    """What became of a fault: the status of its command, whether it was reached, and what is wrong."""

    command: Command
    fault: Fault
    status: int
    reached: bool
    wrong: list[str] = field(default_factory=list)

    @property
    def name(self) -> str:
        return f"{self.command.name}, {self.fault}"


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=lambda word: Path(word).resolve())
    parser.add_argument("--faults", type=int, default=1500, help="how many")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="commands with this word in their names")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--report", type=Path, help="Markdown page to write")
    parser.add_argument("--verbose", action="store_true", help="a line for every fault")
    return parser.parse_args()


def numbers(commands: Sequence[Command], faults: int) -> dict[str, int]:
    """How many faults each command gets."""
    shares = {each.name: SHARES.get(each.name, 1.0) for each in commands}
    found = {name: int(faults * share / sum(shares.values())) for name, share in shares.items()}
    found[commands[0].name] += faults - sum(found.values())
    return found


def campaign(
    program: Path, commands: Sequence[Command], faults: int, seed: int, jobs: int | None = os.cpu_count()
) -> Iterator[Outcome]:
    """Injects this number of faults into some commands."""
    with tempfile.TemporaryDirectory(prefix="tiltpad-faults-") as name, ThreadPoolExecutor(jobs) as pool:
        folder = Path(name)
        injector = Injector(folder)
        for command in commands:
            place, template = new_place(program, injector, folder), folder / command.name
            place.prepare(command, template)
            ended = place.run(command.words)
            if wrong := aftermath.ending(command, None, ended):
                raise RuntimeError(f"{command.name}: {wrong}")
            undisturbed = aftermath.Undisturbed(command, place.work)
            dice, calls = Random(f"{seed}/{command.name}"), counted(place.counts)[0]
            drawn = draw(dice, calls, numbers(commands, faults)[command.name])
            tried = (
                pool.submit(
                    injected, new_place(program, injector, folder), command, fault, template, undisturbed
                )
                for fault in drawn
            )
            for each in list(tried):
                yield each.result()
            shutil.rmtree(template, ignore_errors=True)


def new_place(program: Path, injector: Injector, folder: Path) -> Place:
    return Place(program, injector, Path(tempfile.mkdtemp(dir=folder)))


def injected(
    place: Place, command: Command, fault: Fault, template: Path, undisturbed: aftermath.Undisturbed
) -> Outcome:
    """Injects a fault and judges what it leaves."""
    place.prepare(command, template)
    before = aftermath.contents(place.work)
    ended = place.run(command.words, fault)
    outcome = Outcome(command, fault, ended.status, counted(place.counts)[1] > 0)
    outcome.wrong += aftermath.ending(command, fault, ended)
    outcome.wrong += aftermath.what_is_left(command, ended, place.work, before, undisturbed)
    kept = aftermath.samples_kept(place.work, undisturbed)
    after = place.run(command.next_words)
    wrong = aftermath.after_next(command, after, place.work, kept, undisturbed)
    outcome.wrong += [f"next: {each}" for each in wrong]
    shutil.rmtree(place.folder)
    return outcome


def main() -> int:
    options = arguments()
    started = time.monotonic()
    outcomes = []
    commands = [each for each in COMMANDS if options.only in each.name]
    for outcome in campaign(options.program, commands, options.faults, options.seed, options.jobs):
        outcomes.append(outcome)
        if outcome.wrong:
            print(f"FAILED: {outcome.name}", *outcome.wrong, sep="\n   ", flush=True)
        elif options.verbose:
            print(f"{outcome.name}: {outcome.status}{'' if outcome.reached else ', not reached'}", flush=True)
    if options.report:
        options.report.write_text(page(outcomes, options.seed))
    failed = sum(bool(outcome.wrong) for outcome in outcomes)
    print(f"{time.monotonic() - started:.0f} s")
    print(f"{len(outcomes) - failed} passed, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
