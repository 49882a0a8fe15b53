"""What the parts of verify.py share: runs of the program, and rows of tables."""

import itertools
import subprocess
from pathlib import Path

import tiltpad

CASES, EXAMPLES = (Path(__file__).resolve().parent.parent / "input" / name for name in ("paper", "examples"))
NUMBERS = itertools.count()


def run(program, case, folder, *overrides):
    """Runs a case file, or a case of the paper by its name, and returns the open result."""
    return tiltpad.read(result_of(program, case, folder, *overrides))


def result_of(program, case, folder, *overrides):
    """The result file of a case."""
    path = case if isinstance(case, Path) else CASES / f"{case}.nml"
    output = Path(folder) / f"{next(NUMBERS)}.h5"
    options = [word for override in overrides for word in ("--set", override)]
    subprocess.run([program, path, "--quiet", "--output", output, *options], check=True)
    return output


def row(*cells):
    """A row of a Markdown table."""
    return "| " + " | ".join(map(str, cells)) + " |"
