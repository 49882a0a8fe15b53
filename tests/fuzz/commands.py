"""The program itself: arguments of any bytes, names of files, and runs at the limits of what is allowed."""

import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path
from random import Random

import cases
import mutate
import spelling
from harness import SANITIZER, Case, Reply
from judge import CONTROL, findings
from reference import Variable
from runs import SHOWN

PREFIX = b"tiltpad: error: "
TRACE = re.compile(rb"At line|Fortran runtime|HDF5-DIAG|Backtrace|Program received|runtime error|Sanitizer")
RUN = re.compile(rb", run (\d+): ")
# longest a command may take, s
LIMIT = 60
NAMES = (
    b"a.h5 | a.h5|-a|--|--quiet|.|..|/|./|a/|a/b|../a|~|~/a|\xff|\xc3\xa4|\xc3|a\nb|a\tb|\x1b[2J|%s%n"
    b"|$HOME|`a`|a;b|'a'|\"a\"|*|?|\\|#|a\\0|con|nul|a.h5.part|case.nml|./case.nml|/dev/null|/dev/full"
    b"|/proc/a|/nowhere/a| | a|a |"
).split(b"|")


def run(program: Path, folder: Path, *arguments: bytes) -> tuple[int, bytes, bytes]:
    """Exit status, standard output and error; -99 where it took too long."""
    try:
        environment = {**os.environ, "ASAN_OPTIONS": SANITIZER + "0"}
        command = [program, *arguments]
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=LIMIT, env=environment)
    except subprocess.TimeoutExpired:
        return -99, b"", b""
    return done.returncode, done.stdout, done.stderr


def ended_well(status: int, out: bytes, errors: bytes, allowed: tuple[int, ...]) -> list[str]:
    """What is wrong with the end of a command: its status, and its one line of error if it is not 0."""
    found = [] if status in allowed else [f"ended with {status}"]
    if TRACE.search(errors + out):
        found.append("a trace of the runtime library")
    if status == 0:
        return found + (["an error although it ended well"] if errors else [])
    said = errors.decode(errors="surrogateescape")
    if not errors.startswith(PREFIX) or not said.endswith("\n") or CONTROL.search(said[:-1]):
        found.append("no single line of error")
    return found


def one(dice: Random, program: Path, runner: Path, variables: dict[str, Variable], corpus: list[Case]):
    """One command of any kind, whole runs by the runner: what it was, its arguments, what is wrong."""
    kind = dice.choices((set_arguments, output_name, case_name, options, extremes), (16, 8, 4, 4, 1))[0]
    program = runner if kind is extremes else program
    return kind.__name__, *in_folder(dice, kind, program, variables, corpus)


def in_folder(dice: Random, kind, program: Path, variables: dict[str, Variable], corpus: list[Case]):
    """A command of the kind in a folder of its own: its arguments, what is wrong."""
    folder = Path(tempfile.mkdtemp(prefix="tiltpad-fuzz-"))
    try:
        return kind(dice, program, folder, variables, corpus)
    finally:
        shutil.rmtree(folder)


def set_arguments(dice: Random, program: Path, folder: Path, variables, corpus):
    """A case with --set of any bytes, judged as the reader alone is."""
    case = spelling.case(dice, cases.draw(dice, variables), variables)
    if corpus and dice.random() < 0.3:
        case = dice.choice(corpus)
    sets = list(case.sets)
    for _ in range(dice.choice((0, 1, 1, 2))):
        key = dice.choice(list(variables)).encode()
        title = b"case%title='" + dice.randbytes(9) + b"'"
        new = dice.choice((b"", b"\n", key, key + b"=1", title, key + b"=" + b"1" * 5000))
        sets.insert(dice.randint(0, len(sets)), mutate.changed(dice, new, case.text).replace(b"\0", b""))
    case = replace(case, sets=tuple(sets))
    (folder / "case.nml").write_bytes(case.text)
    arguments = [b"--check", b"case.nml"]
    for argument in case.sets:
        arguments += [b"--set", argument]
    status, out, errors = run(program, folder, *arguments)
    wrong = ended_well(status, out, errors, (0, 1))
    if not wrong and not any(len(argument) > 4096 for argument in case.sets):
        said = out if status == 0 else errors.removeprefix(PREFIX)[:-1]
        if b"\n&sweep\n" in said:
            said = with_members(program, folder, arguments, said)
        refused = RUN.search(said) if status else None
        # the program looks at every run, the second reader at those that are shown
        if not refused or int(refused[1]) <= SHOWN:
            wrong = findings(case, Reply(status, 0, said), variables)
    return arguments + [b"<", case.text], wrong


def with_members(program: Path, folder: Path, arguments: list[bytes], resolved: bytes) -> bytes:
    """What the harness would say of a study: how many, the resolved case, some runs."""
    count = run(program, folder, b"--count", *arguments[1:])[1].strip()
    runs = [*range(1, min(SHOWN, int(count)) + 1), *([int(count)] if int(count) > SHOWN else [])]
    cases = [run(program, folder, b"--run", b"%d" % k, *arguments)[1] for k in runs]
    return b"\0".join((count, resolved, *cases, b""))


def output_name(dice: Random, program: Path, folder: Path, variables, corpus):
    """A result of any name: there under that very name, or refused and nothing there."""
    name = dice.choice(NAMES)
    if dice.random() < 0.5:
        name = mutate.changed(dice, name, b"case.nml").replace(b"\0", b"")
    if dice.random() < 0.1:
        # as long as an argument may be, and more than any file's name
        name = (name * dice.choice((10, 300)))[:20000]
    # what leads out of the folder is left to the names above
    if name not in NAMES:
        name = name.replace(b"..", b"").replace(b"/", b"_")
    work = folder / "a" / "work"
    work.mkdir(parents=True)
    (work / "case.nml").write_bytes(b"&case task='equilibrium' /\n")
    before = everything(folder)
    arguments = [b"--quiet", b"case.nml", dice.choice((b"--output", b"-o")), name]
    status, out, errors = run(program, work, *arguments)
    wrong = ended_well(status, out, errors, (0, 1, 3))
    new = everything(folder) - before
    expected = {os.path.normpath(os.path.join(os.fsencode(work), name))} if status == 0 else set()
    if new != expected:
        wrong.append(f"left {sorted(new)}, not {sorted(expected)}")
    return arguments, wrong


def everything(folder: Path) -> set[bytes]:
    """All files below a folder."""
    return {os.path.join(top, name) for top, _, names in os.walk(os.fsencode(folder)) for name in names}


def case_name(dice: Random, program: Path, folder: Path, variables, corpus):
    """A case of any name is read, not another, or refused."""
    name = mutate.changed(dice, dice.choice(NAMES), b"case.nml").replace(b"\0", b"").replace(b"/", b"_")[:200]
    if name in (b"", b".", b".."):
        name = b"a"
    path = os.path.join(os.fsencode(folder), name)
    for other in (name.rstrip(), name.strip(), name + b" "):
        if other not in (b"", b".", b".."):
            with open(os.path.join(os.fsencode(folder), other), "wb") as file:
                file.write(b"&rotor mass=1 /\n")
    with open(path, "wb") as file:
        file.write(b"&rotor mass=1234 /\n")
    arguments = [b"--check", name]
    status, out, errors = run(program, folder, *arguments)
    asks = name.startswith(b"-")
    wrong = ended_well(status, out, errors, (0, 1))
    if status == 0 and not asks and b"mass = 1234\n" not in out:
        wrong.append("another case was read")
    return arguments, wrong


def options(dice: Random, program: Path, folder: Path, variables, corpus):
    """Arguments in any order and number."""
    (folder / "case.nml").write_bytes(b"&case task='equilibrium' /\n")
    words = (
        b"--check --check --check --quiet -q --set --output -o case.nml case.nml rotor%mass=1 --help -h "
        b"--version --reference -- - --resume --count --run --jobs 1 -1 --set=rotor%mass=1 --output=a "
        b"--chec".split()
    )
    arguments = dice.choices((*words, b"", b" ", b"\n", b"\xff", b"x" * 3000), k=dice.choice((0, 1, 2, 3, 5)))
    if dice.random() < 0.1:
        arguments += [b"--set", b"rotor%mass=1"] * dice.choice((100, 999, 1001, 8000)) + [b"--check"]
    status, out, errors = run(program, folder, *arguments)
    return arguments[:20], ended_well(status, out, errors, (0, 1, 3))


def extremes(dice: Random, program: Path, folder: Path, variables, corpus):
    """A short run of any case that is allowed: done, or given up with one line, in time."""
    inputs = cases.draw(dice, variables)
    while len(inputs.get("pads%mass", ())) > 4:
        inputs = cases.draw(dice, variables)
    # what belongs to a task of its own has no effect without it
    apart = ("pads", *cases.OF_TASK)
    inputs = {key: value for key, value in inputs.items() if variables[key].group not in cases.OF_TASK}
    # there is no other result to start from
    if inputs.get("start%from") == (b"file",):
        del inputs["start%from"], inputs["start%file"]
    # an oil of the case gives the viscosity
    alone = (*cases.SPECIAL, "bearing%viscosity")
    for key in dice.sample(list(variables), 5):
        if key not in inputs and key not in alone and variables[key].group not in apart:
            inputs[key] = cases.anything(dice, variables[key])
    # within the time allowed: few pads and steps, films of a usual size
    duration = 10 ** dice.uniform(-9, -2)
    speed = max(
        inputs.get("operation%speed_rpm", (6500.0,))[0], inputs.get("operation%final_speed_rpm", (0.0,))[0]
    )
    samples = max(1, min(10**6, int(1e4 * 60 / speed / duration)))
    sizes = {"circumferential_cells": 60, "axial_cells": 15, "axial_modes": 20, "max_sweeps": 10000}
    sets = [
        f"operation%duration={duration!r}",
        "output%start_time=0",
        f"output%samples_per_revolution={samples}",
    ]
    sets += [
        "integration%max_steps=100",
        "case%task='" + dice.choice(("march", "march", "equilibrium")) + "'",
    ]
    for name, most in sizes.items():
        key = f"film%{name}"
        sets.append(f"{key}={int(min(most, inputs.get(key, variables[key].default)[0]))}")
    case = spelling.case(dice, inputs, variables)
    (folder / "case.nml").write_bytes(case.text)
    arguments = [b"--quiet", b"case.nml"]
    for argument in (*case.sets, *(word.encode() for word in sets)):
        arguments += [b"--set", argument]
    status, out, errors = run(program, folder, *arguments)
    return arguments + [b"<", case.text], ended_well(status, out, errors, (0, 2))
