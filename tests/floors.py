"""Checks the plan of the house: no folder uses one above it, no module and no procedure is too long.

A folder of src_f90 or post/tiltpad is a floor; the lists below are the only place that names their order.
Every offence is one line, "file:line: what". make lint calls this.
"""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

#: Lowest first: each uses only those before it. A folder inside one may be a floor of its own ("film/table").
FORTRAN = (
    *("base", "system", "case", "input"),
    *("film/common", "film/fourier", "film/volumes", "film/tables", "film", "film/sloped"),
    *("pivot", "rotor", "bearing", "integrate", "model"),
    *("statics", "heat", "equilibrium", "linear", "orbits", "branches", "signals"),
    *("storage", "results", "app"),
)
#: How high the folders of the Python package are; those of one height do not use each other.
PYTHON = {"files": 0, "calculate": 1, "draw": 2, "collect": 2}

#: Most lines of a Fortran module, and of a procedure without those in it. A procedure that is one list or
#: one kernel may be longer; a comment in it says which: "! long: a kernel".
MODULE_LINES = 600
PROCEDURE_LINES = 60

USE = re.compile(r"\s*use\s*(?:,\s*(?:non_)?intrinsic\s*)?(?:::)?\s*(\w+)", re.IGNORECASE)
BEGIN = re.compile(r"\s*(?:[^!'\"]*\s)?(?:subroutine|function)\s+(\w+)\s*\(", re.IGNORECASE)
END = re.compile(r"\s*end (?:subroutine|function)\b", re.IGNORECASE)
LONG = re.compile(r"\s*! long: \w")


def fortran_floors(root: Path) -> Iterator[str]:
    """Uses of modules of a floor above."""
    files = sorted(root.rglob("*.[fF]90"))
    floors = {path.stem: fortran_floor(path.relative_to(root)) for path in files}
    for name in sorted(set(floors.values()) - set(FORTRAN)):
        yield f"{root / name}: is no floor; tests/floors.py lists them"
        return
    for path in files:
        for number, line in enumerate(path.read_text().splitlines(), 1):
            used = USE.match(line)
            floor = floors.get(used[1].lower()) if used else None
            if floor and FORTRAN.index(floor) > FORTRAN.index(floors[path.stem]):
                yield f"{path}:{number}: {floors[path.stem]} uses {used[1]} of {floor}, a floor above it"


def fortran_floor(path: Path) -> str:
    """Floor of a source: the smallest folder around it that is one, else its outermost folder."""
    folders = [str(folder) for folder in path.parents]
    return next((folder for folder in folders if folder in FORTRAN), path.parts[0])


def fortran_lengths(root: Path) -> Iterator[str]:
    """Modules and procedures that are too long."""
    for path in sorted(root.rglob("*.[fF]90")):
        lines = path.read_text().splitlines()
        if len(lines) > MODULE_LINES:
            yield f"{path}:{len(lines)}: {len(lines)} lines; a module has at most {MODULE_LINES}"
        # procedures that are open: where they begin, name, lines of those in them, whether they may be long
        opened: list[list] = []
        for number, line in enumerate(lines, 1):
            if END.match(line):
                first, name, inner, may_be_long = opened.pop()
                length = number - first + 1
                if opened:
                    opened[-1][2] += length
                if length - inner > PROCEDURE_LINES and not may_be_long:
                    yield (
                        f"{path}:{first}: {name} has {length - inner} lines; a procedure has at most "
                        f'{PROCEDURE_LINES}, or a comment in it says why not: "! long: a kernel"'
                    )
            elif found := BEGIN.match(line):
                opened.append([number, found[1], 0, False])
            elif opened and LONG.match(line):
                opened[-1][3] = True


def python_floors(root: Path) -> Iterator[str]:
    """Imports of modules of a floor above; what stands beside the folders is above them all."""
    for name in sorted(path.parent.name for path in root.glob("*/__init__.py")):
        if name not in PYTHON:
            yield f"{root / name}: is no floor; tests/floors.py lists them"
    for path in sorted(root.rglob("*.py")):
        own, height = python_floor(".".join(("tiltpad", *path.relative_to(root).parts)))
        for node in ast.walk(ast.parse(path.read_text())):
            for module in imported(node):
                other, above = python_floor(module)
                if above > height or (above == height and other != own):
                    yield f"{path}:{node.lineno}: {own} imports {module}, which is not below it"


def python_floor(module: str) -> tuple[str, int]:
    """Floor of a module by its whole name, and its height."""
    name = module.split(".")[1] if "." in module else ""
    return (name, PYTHON[name]) if name in PYTHON else ("the package itself", len(PYTHON))


def imported(node: ast.AST) -> list[str]:
    """Modules of tiltpad that a statement imports, by their whole names; the compiled one is below all."""
    found = []
    if isinstance(node, ast.Import):
        found = [each.name for each in node.names]
    elif isinstance(node, ast.ImportFrom):
        prefix = "tiltpad." * (node.level > 0) + (node.module or "")
        found = [f"{prefix}.{each.name}" for each in node.names]
    return [each for each in found if each.split(".")[0] == "tiltpad" and "._" not in each]


def main() -> int:
    """Prints what is wrong, relative to the project's folder; 1 where something is."""
    fortran, python = Path("src_f90"), Path("post/tiltpad")
    found = [*fortran_floors(fortran), *fortran_lengths(fortran), *python_floors(python)]
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
