"""Damages results, checkpoints, runs of a study and studies, and has the program read each of them.

usage: damage_program.py PROGRAM COUNT SEED [FOLDER]

The program looks at the damaged file (--resume --check), goes on with it, starts from it, replaces it, or
finds it among the runs of a study. Prints a line for each damage at which it crashed, hung, needed too
much time or memory, said anything but its own lines, changed a file that it refused, or left something
behind; with FOLDER the damaged file is kept there. The last line counts the damages that were read, refused
and faulty.
"""

import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import h5py
from damages import Source, damaged_copy

#: Seconds of the processor's time and bytes of memory for what is refused; seconds of time after which a run
#: is asked to stop, and after which it hangs.
SECONDS, MEMORY, ENOUGH, HANGS = 5, 500 << 20, 8, 60
#: Exit statuses: done or to be continued, numerics, file, stopped.
STATUSES = (0, 2, 3, 4)
MARCH = "&friction model='lugre' /\n&output samples_per_revolution=40, checkpoint_seconds=0 /\n"
CASES = {
    "complete": "&operation duration=0.02 /\n" + MARCH,
    "other": "&operation duration=0.01 /\n" + MARCH,
    "start": "&operation duration=0.01 /\n&start from='file', file='damaged.h5' /\n" + MARCH,
    "equilibrium": "&case task='equilibrium' /\n",
    "failed": "&integration max_steps=100 /\n" + MARCH,
    "stopped": "&operation duration=10000 /\n" + MARCH.replace("=0 /", "=0.01 /"),
    "sweep": "&operation duration=0.01 /\n&sweep operation%speed_rpm=4000:6000:1000 /\n" + MARCH,
}
#: Of a file: the arguments of the program. {} is the file; it is the second run in the folder of a study.
USES = {
    "complete": ("--resume {} --check", "--resume {}", "complete.nml -o {}", "other.nml -o {}",
                 "other.nml --overwrite -o {}", "start.nml"),
    "equilibrium": ("--resume {} --check", "equilibrium.nml -o {}"),
    "failed": ("--resume {} --check", "--resume {}"),
    "stopped": ("--resume {} --check", *("--resume {}",) * 4, "stopped.nml --resume {}"),
    "sweep/0002": ("sweep.nml", "sweep.nml --jobs 1", "sweep.nml --overwrite", "sweep.nml --run 1",
                   "sweep.nml --run 2", "--resume {}"),
    "study": ("--resume {}", "equilibrium.nml -o {}"),
}  # fmt: skip
#: How often each of them is drawn.
SHARES = {"complete": 6, "equilibrium": 1, "failed": 1, "stopped": 10, "sweep/0002": 5, "study": 1}


def main() -> None:
    program, count, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    keep = Path(sys.argv[4]) if len(sys.argv) > 4 else None
    outcomes = Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sources = make_sources(program, folder)
        for number in range(count):
            dice = random.Random(f"{seed}/{number}")
            which = dice.choices(tuple(SHARES), SHARES.values())[0]
            target = folder / f"{which if '/' in which else 'damaged'}.h5"
            what = damaged_copy(dice, sources[which], target)
            damaged = target.read_bytes()
            arguments = dice.choice(USES[which]).replace("{}", str(target.relative_to(folder))).split()
            outcome, said = tried(program, arguments, folder, target)
            outcomes[outcome] += 1
            if outcome not in ("read", "refused"):
                command = " ".join(arguments)
                print(f"seed {seed}, damage {number} ({which}: {what}), {command}: {outcome}: {said}")
                if keep:
                    (keep / f"{seed}-{number}.h5").write_bytes(damaged)
            tidy(folder, sources)
    print(f"{outcomes.pop('read', 0)} read, {outcomes.pop('refused', 0)} refused, {outcomes.total()} faulty")


def make_sources(program: str, folder: Path) -> dict[str, Source]:
    """The sound files, by name."""
    for name, text in CASES.items():
        (folder / f"{name}.nml").write_text(text)
    for name, status in (("complete", 0), ("start", 0), ("equilibrium", 0), ("failed", 2), ("sweep", 0)):
        done = subprocess.run([program, "-q", f"{name}.nml"], cwd=folder, stderr=subprocess.DEVNULL)
        assert done.returncode == status
        if name == "complete":
            shutil.copy(folder / "complete.h5", folder / "damaged.h5")
    run = subprocess.Popen([program, "-q", "stopped.nml"], cwd=folder, stderr=subprocess.DEVNULL)
    while not (folder / "stopped.h5").exists():
        assert run.poll() is None
        time.sleep(0.001)
    run.terminate()
    assert run.wait() == 4
    with h5py.File(folder / "stopped.h5", "r+") as file:
        # not much is left to march
        end = float(file["checkpoint/time"][()]) + 1e-3
        file.attrs["input"] = re.sub(r"duration = \S+", f"duration = {end!r}", file.attrs["input"])
    (folder / "stopped.nml").write_text(CASES["stopped"].replace("=10000", f"={end!r}"))
    shutil.move(folder / "sweep.h5", folder / "study.h5")
    sources = {name: Source(folder / f"{name}.h5") for name in SHARES}
    (folder / "kept").mkdir()
    for name in ("0001", "0003"):
        shutil.copy(folder / f"sweep/{name}.h5", folder / "kept")
    return sources


def tidy(folder: Path, sources: dict[str, Source]) -> None:
    """The folder as it was."""
    for path in (*folder.glob("damaged.h5*"), folder / "sweep.h5"):
        path.unlink(missing_ok=True)
    for path in (folder / "sweep").iterdir():
        path.unlink()
    for path in (folder / "kept").iterdir():
        shutil.copy(path, folder / "sweep")
    (folder / "sweep/0002.h5").write_bytes(sources["sweep/0002"].content)


def tried(program: str, arguments: list[str], folder: Path, target: Path) -> tuple[str, str]:
    """Outcome of a command, and what it said."""
    # a study has its own file
    before, there = target.read_bytes(), names(folder) - {"sweep.h5"}
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen([program, "-q", *arguments], cwd=folder, stdout=out, stderr=errors)
        status, used, stopped = waited(process)
        errors.seek(0)
        said = errors.read().decode(errors="replace")
    if status is None:
        return "hung", said
    if status < 0:
        return "died", f"{signal.Signals(-status).name} {said}"
    lines, seconds = said.splitlines(), used.ru_utime + used.ru_stime
    # the run of a damaged input may take any time, if it stops when it is asked to
    ran = status in (0, 2) or stopped
    wrong = {
        f"status {status}": status not in STATUSES or (status == 4 and not stopped),
        f"{seconds:.1f} s": seconds > SECONDS and not ran,
        f"{used.ru_maxrss >> 10} MB": used.ru_maxrss << 10 > MEMORY,
        "not its own lines": not all(line.startswith("tiltpad: error: ") for line in lines),
        "not one line": "sweep.nml" not in arguments and len(lines) != (status != 0),
        "asks for a report": "please report" in said,
        "changed what it refused": "--check" in arguments and target.read_bytes() != before,
        f"left {sorted(names(folder) - there)}": not names(folder) - there <= {"sweep.h5"},
        "lost a file": not there <= names(folder),
    }
    if found := [each for each, bad in wrong.items() if bad]:
        return ", ".join(found), said[:500]
    return ("refused" if status == 3 else "read"), said


def names(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def waited(process: subprocess.Popen) -> tuple[int | None, object, bool]:
    """Status of a process (None: it hung), what it used, and whether it had to be asked to stop."""
    started, asked = time.monotonic(), False
    pause = 0.001
    while True:
        found, status, used = os.wait4(process.pid, os.WNOHANG)
        if found:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, used, asked
        spent = time.monotonic() - started
        if spent > ENOUGH and not asked:
            process.terminate()
            asked = True
        if spent > HANGS:
            process.kill()
            os.wait4(process.pid, 0)
            process.returncode = -9
            return None, None, asked
        time.sleep(pause := min(0.05, 1.2 * pause))


if __name__ == "__main__":
    main()
