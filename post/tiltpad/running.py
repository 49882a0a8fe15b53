"""Running the program: a case in, its result out."""

import os
import re
import shutil
import subprocess
import tempfile
import weakref
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from tiltpad.files import namelist
from tiltpad.files.archive import RunError, meant
from tiltpad.files.processes import program, run_program
from tiltpad.files.read import Run
from tiltpad.files.study import Study, read_either

#: Exit status of the program where case or command are wrong, and where there may be a result.
INPUT_ERROR, NUMERICS, STOPPED = 1, 2, 4

#: A line of what --check prints, and what it remarks on the variable.
REMARK = re.compile(r"^((?:'[^']*'|[^'!\n])*?)\s*!.*$", re.MULTILINE)

Groups = Mapping[str, Mapping[str, Any]]
Result = TypeVar("Result", bound=Run | Study)


def run(
    case: "str | os.PathLike | Groups | None" = None,
    output: str | os.PathLike | None = None,
    /,
    *,
    overwrite: bool = False,
    quiet: bool = True,
    verify: int = 0,
    **overrides: Mapping[str, Any],
) -> Run | Study:
    """Runs a case and gives its result, opened.

        run = tiltpad.run("mine.nml")
        run = tiltpad.run("mine.nml", "faster.h5", operation={"speed_rpm": 9000})
        run = tiltpad.run({"operation": {"speed_rpm": 3000}, "friction": {"model": "lugre"}})
        study = tiltpad.run("mine.nml", sweep={"operation%speed_rpm": "1000:6000:500"})
        study = tiltpad.run("mine.nml", sweep={"file": "members.csv"})

    `case` is a namelist file, or groups of variables as for `write_case`; without it all have their defaults.
    Each further keyword is a group with values of its own. A parameter study gives the study of its runs. The
    result is written to `output` (of a study NAME.h5, and where its runs keep samples their files in the
    folder NAME); it replaces that of another case only with `overwrite`, and a study goes on with the runs
    that are missing. Without a name it is temporary, for as long as it is used. With
    `verify` the films in this number of states are solved closely, too, and compared. A wrong case is a
    ValueError with the program's message, a run that gives no result a RunError. Where the numerics fail on
    the way the result is there up to this point, with an IncompleteRunWarning.
    """
    options = ["--overwrite"] * overwrite + ["--quiet"] * quiet + ["--verify", f"{verify}"] * (verify != 0)
    for group, values in overrides.items():
        if not isinstance(values, Mapping) and (likely := meant(group, ("overwrite", "quiet", "verify"))):
            raise ValueError(f"run has no option {group}{likely}")
    options += settings(overrides)

    def started(folder: Path) -> Run | Study:
        target = Path(output) if output is not None else folder / "result.h5"
        return result_of(case_file(case, folder), target, options)

    return in_temporary_folder(started)


def settings(overrides: Groups) -> list[str]:
    """The options of the program that set the values of these groups."""
    options = []
    for group, values in overrides.items():
        for name, value in namelist.variables(group, values).items():
            options += ["--set", f"{group}%{name}={namelist.written(value, namelist.is_varied(group, name))}"]
    return options


def case_file(case: "str | os.PathLike | Groups | None", folder: Path) -> str | os.PathLike:
    """The file of a case; groups are written to one in the folder. A table of theirs stays where it is."""
    if isinstance(case, str | os.PathLike):
        return case
    if not isinstance(case, Mapping | None):
        raise TypeError(f"case = {case!r}: must be a file, or groups {{'operation': {{'speed_rpm': 4500}}}}")
    groups = dict(case or {"case": {}})
    study = namelist.variables(namelist.STUDY, groups.get(namelist.STUDY, {}))
    if isinstance(study.get(namelist.TABLE), str | os.PathLike):
        groups[namelist.STUDY] = {**study, namelist.TABLE: os.path.abspath(study[namelist.TABLE])}
    return namelist.write_case(folder / "case.nml", groups)


def in_temporary_folder(work: Callable[[Path], Result]) -> Result:
    """What the work gives, opened; its folder stays for as long as that is used."""
    folder = Path(tempfile.mkdtemp(prefix="tiltpad-"))
    try:
        result = work(folder)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    weakref.finalize(result, shutil.rmtree, folder, ignore_errors=True)
    return result


def result_of(case: str | os.PathLike, target: Path, options: Sequence[str]) -> Run | Study:
    """Runs the program."""
    before = state_of(target)
    words = [program(), argument(case), "--output", os.fspath(target), *options]
    done = run_program(words, stderr=subprocess.PIPE)
    said = done.stderr.strip().removeprefix("tiltpad: error: ").removeprefix("--set: ")
    said = said.replace("--overwrite", "overwrite=True").replace("--output", "output")
    if done.returncode == INPUT_ERROR:
        raise ValueError(said)
    # a study has the ending whether it was given or not; a run always gets a new file
    if target.suffix != ".h5" and state_of(target) == before:
        target = target.with_name(f"{target.name}.h5")
    if done.returncode not in (0, NUMERICS, STOPPED) or not target.is_file():
        raise RunError(said or f"the program ended with status {done.returncode}")
    return read_either(target)


def state_of(path: Path) -> tuple[int, ...] | None:
    """Differs once a file has been replaced, whatever the clock says; None where there is none."""
    if not path.is_file():
        return None
    found = path.stat()
    return found.st_ino, found.st_mtime_ns, found.st_size


def argument(case: str | os.PathLike) -> str:
    """The name of a case for a command line: one that begins with - is no option."""
    name = os.fspath(case)
    return f"./{name}" if name.startswith("-") else name


def resolved(case: str | os.PathLike, bearing: str | None = None) -> dict[str, dict[str, Any]]:
    """The groups of a case with every default, as run.input; of a study those of its first run.

    Of a machine those of the bearing of this name, without a load. The program only checks the case.
    """
    text = checked(case)
    text = checked(case, "--run", "1") if "\n&sweep" in text else text
    groups = namelist.resolved(text)
    names = namelist.bearing_names(groups) if namelist.is_machine(groups) else []
    if bearing in names:
        return namelist.resolved(namelist.of_bearing(text, bearing))
    if bearing is not None:
        there = f"its bearings are {', '.join(names)}" if names else "it is a case of one bearing"
        raise ValueError(f"{case}: no bearing {bearing}{meant(bearing, names)}: {there}")
    return groups


def checked(case: str | os.PathLike, *options: str) -> str:
    """What --check prints, without its remarks."""
    words = [program(), "--check", *options, argument(case)]
    done = run_program(words, capture_output=True)
    if done.returncode == INPUT_ERROR:
        raise ValueError(done.stderr.strip().removeprefix("tiltpad: error: "))
    if done.returncode:
        raise RunError(done.stderr.strip() or f"the program ended with status {done.returncode}")
    return REMARK.sub(r"\1", done.stdout)
