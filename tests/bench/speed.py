"""Compares the speed of two builds of the program: speed.py OLD NEW [--rounds N]

In every round the old program runs twice and the new one once, each from nothing; the smallest processor
times count. Where this machine counts instructions (by perf, or by valgrind), these are told, too: they have
no noise. A case is slower where it takes more time than noise allows, or more instructions. The status is 1
where a case is slower, where the new program alone fails, or where the old program runs no case.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from runner import launch
from settings import ROOT

#: Cases of input/ with what is changed in them: marches, statics, orbits, branches, machines and studies.
CASES = {
    "frictionless": ("paper/steady_tr.nml",),
    "lugre": ("paper/steady_lugre.nml",),
    "bengisu_akay": ("paper/steady_tr_ba.nml",),
    "run_up": ("paper/runup_lugre.nml",),
    "four_pads": ("examples/four_pads.nml",),
    "five_pads": ("examples/five_pads.nml",),
    "fixed_pads": ("examples/two_groove.nml",),
    "equilibrium": ("examples/equilibrium.nml",),
    "warm_equilibrium": ("examples/warm_five_pads.nml", "case%task=equilibrium"),
    "map": ("examples/stability.nml",),
    "equilibria": ("paper/steady_lugre.nml", "case%task=equilibrium", "sweep%rotor%mass=1500:1999:1"),
    "marches": ("paper/steady_lugre.nml", "operation%duration=0.2", "sweep%rotor%mass=1900:1980:5"),
    "orbit": ("paper/steady_lugre.nml", "case%task=periodic"),
    "branch": (
        *("paper/steady_tr.nml", "case%task=branch"),
        *("branch%parameter=operation%speed_rpm", "branch%last=7500"),
    ),
    "machine": ("examples/overhung.nml",),
    "bearings": ("examples/three_bearings.nml",),
}
#: How much slower a case may be in instructions, and beyond its noise in time.
SAME_INSTRUCTIONS, SAME_TIME = 1.005, 0.01
#: The least time, s, for which a case is repeated in a round.
LEAST = 0.5


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--commit", default="", help="of the old program, if it does not know it")
    parser.add_argument("--mode", default="release", help="of both builds (MODE of make)")
    parser.add_argument("--keep", type=Path, help="file for what is printed, which make bench shows")
    options = parser.parse_args()
    count = counter()
    lines: list[str] = []

    def say(line: str) -> None:
        print(line, flush=True)
        lines.append(line)

    builds = "" if options.mode == "release" else f", both built with MODE={options.mode}"
    say(f"{version(options.new)} against {options.commit or version(options.old)}{builds}")
    say(f"{'case':20} {'time':>6} {'noise':>6} {'instructions':>13} {'s':>8}")
    verdicts: list[bool | None] = []
    with tempfile.TemporaryDirectory() as folder:
        for name, (case, *changes) in CASES.items():
            settings = (word for each in changes for word in ("--set", each))
            command = [ROOT / "input" / case, "--quiet", *settings]
            line, bad = compare(options.old, options.new, command, Path(folder), options.rounds, count)
            say(f"{name:20} {line}{'  slower' if bad else ''}")
            verdicts.append(bad)
    slower, missing = verdicts.count(True), verdicts.count(None)
    say(f"{slower} of {len(verdicts) - missing} cases are slower; {missing} are not compared")
    if options.keep:
        options.keep.write_text("\n".join(lines) + "\n")
    return 1 if slower or missing == len(verdicts) else 0


def version(program: Path) -> str:
    done = subprocess.run([program, "--version"], text=True, capture_output=True, check=True)
    return done.stdout.strip()


def compare(
    old: Path, new: Path, command: list, folder: Path, rounds: int, count: Callable[[list], int] | None
) -> tuple[str, bool | None]:
    """New over old, noise, instructions and seconds of a case; whether it is slower, None if unknown."""
    try:
        before = seconds(old, command, folder, 1)
    except RuntimeError as error:
        return f"the old program does not run it: {error}", None
    try:
        repeats = max(1, round(LEAST / before))
        best = [float("inf")] * 3
        for _ in range(rounds):
            times = [seconds(program, command, folder, repeats) for program in (old, old, new)]
            best = list(map(min, best, times))
        ratio, noise = best[2] / min(best[:2]), max(best[:2]) / min(best[:2])
        bad, told = ratio > noise + SAME_TIME, ""
        counts = [count(emptied([program, *command], folder)) for program in (old, new)] if count else []
        if counts and all(counts):
            instructions = counts[1] / counts[0]
            bad, told = bad or instructions > SAME_INSTRUCTIONS, f"{instructions:.4f}"
        return f"{ratio:6.3f} {noise:6.3f} {told:>13} {best[2]:8.4f}", bad
    except RuntimeError as error:
        return f"the new program does not run it: {error}", True


def seconds(program: Path, command: list, folder: Path, repeats: int) -> float:
    """Mean processor time of runs from nothing, s."""
    total = 0.0
    for _ in range(repeats):
        done = launch(emptied([program, *command], folder))
        if done.status:
            raise RuntimeError(done.said.replace(f"{ROOT}/", "").strip().splitlines()[-1])
        total += done.work
    return total / repeats


def emptied(command: list, folder: Path) -> list[str]:
    """The command with its result in the folder, which holds nothing else."""
    shutil.rmtree(folder)
    folder.mkdir()
    return [*map(str, command), "--output", f"{folder}/result.h5"]


def counter() -> Callable[[list[str]], int] | None:
    """What counts the instructions of a command, of all its processes; None where nothing does."""
    if shutil.which("perf") and by_perf(["true"]):
        return lambda command: by_perf(command) or sys.exit("perf does not count any more")
    return by_valgrind if shutil.which("valgrind") else None


def by_perf(command: list[str]) -> int:
    words = ["perf", "stat", "-x", ",", "-e", "instructions:u", *command]
    found = re.search(r"^(\d+),,instructions", launch(words).said, re.MULTILINE)
    return int(found[1]) if found else 0


def by_valgrind(command: list[str]) -> int:
    """Of all processes; a forked one counts on from where it began, in both programs.

    0 where valgrind does not know the processor's instructions, and ends the program.
    """
    words = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", *command]
    done = launch(words)
    found = re.findall(r"I\s+refs:\s+([\d,]+)", done.said)
    return 0 if done.status else sum(int(each.replace(",", "")) for each in found)


if __name__ == "__main__":
    sys.exit(main())
