"""Studies of many runs: what filing, collecting, killing and drawing them costs beyond their calculation."""

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import tiltpad
from runner import Row, Runner, launch
from tables import short, table, verdict

SPEEDS, SAMPLES, KILLED, MARCHES, DRAWN = "speeds", "samples", "killed", "marches", "drawn"
#: Speeds of a map of coefficients; runs of a table of sampled inputs, and of a part of it, whose memory is
#: compared; marches, and their revolutions.
MAP, TABLE, PART, LUGRE, REVOLUTIONS = 1000, 2**17, 2**14, 1000, 20
#: Kills of the study of samples on its way, and the seconds between them.
KILLS, BETWEEN = 10, 8
#: Figures to reach: seconds of processor time, wall seconds, part of the marches' own time, wall seconds.
MAP_SECONDS, TABLE_SECONDS, SHARE, DRAWN_SECONDS = 2.5, 150, 0.05, 5

#: What is sampled of the paper's bearing: tolerances of its making, and what a machine does not hold exactly.
SAMPLED = {
    "bearing%assembled_clearance": ("normal", 80e-6, 2e-6),
    "bearing%machined_clearance": ("normal", 100e-6, 2e-6),
    "bearing%viscosity": ("normal", 0.019, 0.001),
    "rotor%mass": ("normal", 2000, 50),
    "operation%speed_rpm": ("uniform", 5500, 6500),
    "pivot%radius_difference": ("normal", 15e-6, 1e-6),
    "pads%arc_deg(1)": ("normal", 69.3, 0.2),
}


def studies(runner: Runner) -> Iterator[Row]:
    """Rows of all studies."""
    folder = runner.folder / "studies"
    folder.mkdir()
    yield speeds(runner, folder)
    yield from samples(runner, folder)
    yield killed(runner, folder)
    yield marches(runner, folder)
    yield from drawn(runner, folder)
    shutil.rmtree(folder)


def row_of(runner: Runner, group: str, setting: str, done, runs: int) -> Row:
    """The row of a command that performed this number of runs."""
    row = Row(runner.part, "study", group, setting, "", done.seconds, runs)
    row.memory_mb, row.work_seconds = done.memory, done.work
    if done.status:
        row.note = f"failed with status {done.status}: {done.said[-200:]}"
    return row


def speeds(runner: Runner, folder: Path) -> Row:
    """Coefficients over the speed, on one core."""
    case = folder / "speeds.nml"
    case.write_text(f"&case task='coefficients' /\n&sweep operation%speed_rpm=2000:{1999 + MAP}:1 /\n")
    done = launch([runner.program, case, "--quiet", "--jobs", "1", "--output", folder / "speeds"])
    return row_of(runner, SPEEDS, f"{MAP}", done, MAP)


def samples(runner: Runner, folder: Path) -> Iterator[Row]:
    """Equilibria of sampled bearings on all cores: some, and all."""
    for runs in (PART, TABLE):
        case = folder / f"{runs}.nml"
        case.write_text("&case task='equilibrium' /\n")
        table_of_runs = tiltpad.sample(case, SAMPLED, runs, file=folder / f"{runs}.csv")
        case.write_text(f"&case task='equilibrium' /\n&sweep file='{Path(table_of_runs).name}' /\n")
        done = launch([runner.program, case, "--quiet", "--output", folder / f"{runs}"], None)
        yield row_of(runner, SAMPLES, f"{runs}", done, runs)


def killed(runner: Runner, folder: Path) -> Row:
    """The same, killed on its way; its note says what was lost, and how many files there were at any time."""
    words = [runner.program, folder / f"{TABLE}.nml", "--quiet", "--output", folder / "killed/study"]
    (folder / "killed").mkdir()
    started, files, kills = time.perf_counter(), 0, 0
    while True:
        with subprocess.Popen(words) as process:
            again = time.perf_counter()
            while process.poll() is None:
                time.sleep(0.05)
                files = max(files, sum(1 for _ in (folder / "killed").iterdir()))
                if kills < KILLS and time.perf_counter() - again > BETWEEN:
                    process.kill()
                    kills += 1
        if process.returncode >= 0:
            break
    row = Row(runner.part, "study", KILLED, f"{TABLE}", "", time.perf_counter() - started, TABLE)
    with (
        tiltpad.read_study(folder / f"{TABLE}.h5") as whole,
        tiltpad.read_study(folder / "killed/study.h5") as study,
    ):
        same = all(
            np.array_equal(study[name], whole[name], equal_nan=True)
            for name in whole.names()
            if not name.endswith("_seconds") and whole[name].dtype.kind == "f"
        )
    row.note = json.dumps({"kills": kills, "files": files, "same": bool(same)})
    return row


def marches(runner: Runner, folder: Path) -> Row:
    """Marches with LuGre friction that keep their figures alone, on one core, and what they took by
    themselves."""
    case, speed = folder / "marches.nml", 3000
    duration = REVOLUTIONS * 60 / speed
    case.write_text(
        f"&operation speed_rpm={speed} duration={duration!r} /\n&friction model='lugre' /\n"
        f"&output keep='summary' /\n&sweep rotor%unbalance=1e-3:{1e-3 + 1e-5 * (LUGRE - 1)!r}:1e-5 /\n"
    )
    done = launch([runner.program, case, "--quiet", "--jobs", "1", "--output", folder / "marches"])
    row = row_of(runner, MARCHES, f"{LUGRE}", done, LUGRE)
    with tiltpad.read_study(folder / "marches.h5") as study:
        row.march_seconds = float(study.wall_seconds.sum())
    return row


def drawn(runner: Runner, folder: Path) -> Iterator[Row]:
    """A report and a picture of the study of samples."""
    study = folder / f"{TABLE}.h5"
    for command in (
        ("tiltpad-report", study, "-o", folder / "report.html"),
        ("tiltpad-plot", "study", study, "-o", folder / "study.png"),
    ):
        program = Path(sys.executable).with_name(command[0])
        yield row_of(runner, DRAWN, command[0], launch([program, *command[1:]]), TABLE)


def written(rows: list[Row]) -> str:
    """The table of the page."""
    lines = []
    for row in rows:
        if row.note.startswith("failed"):
            lines.append((row.group, row.note, "", "", "", ""))
            continue
        each = f"{short(1e3 * row.wall_seconds / row.steps, 2)} ms"
        memory = f"{row.memory_mb:.0f} MB" if row.memory_mb else ""
        wall = f"{short(row.wall_seconds)} s"
        if row.group == SPEEDS:
            name, value, target = (
                f"coefficients at {row.steps} speeds, processor time",
                row.work_seconds,
                MAP_SECONDS,
            )
            lines.append((name, f"{short(value)} s", each, memory, f"{target} s", verdict(value, target)))
        elif row.group == SAMPLES:
            whole = row.steps == TABLE
            target = (f"{TABLE_SECONDS} s", verdict(row.wall_seconds, TABLE_SECONDS)) if whole else ("", "")
            lines.append((f"{row.steps} equilibria, all cores", wall, each, memory, *target))
        elif row.group == KILLED:
            found = json.loads(row.note)
            name = f"the same, killed {found['kills']} times; at most {found['files']} files"
            lost = "the same rows" if found["same"] else "OTHER ROWS"
            lines.append((name, wall, each, "", lost, ""))
        elif row.group == MARCHES:
            beyond = row.wall_seconds / row.march_seconds - 1
            name = (
                f"{row.steps} marches with LuGre friction of {REVOLUTIONS} revolutions: time beyond their own"
            )
            lines.append((name, f"{beyond:.1%}", each, memory, f"{SHARE:.0%}", verdict(beyond, SHARE)))
        else:
            lines.append((f"{row.setting} of {row.steps} runs", wall, "", memory, f"{DRAWN_SECONDS} s",
                          verdict(row.wall_seconds, DRAWN_SECONDS)))  # fmt: skip
    return table("study | measured | a run | memory | to reach | ", lines)
