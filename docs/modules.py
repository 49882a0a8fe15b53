"""Writes the list of modules of docs/architecture.md: each with the first sentence that it says of itself.

usage: modules.py [--check]     --check only says whether the list is up to date
"""

import ast
import re
import sys
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))
import floors  # noqa: E402

PAGE = ROOT / "docs/architecture.md"
BEGIN, END = "<!-- written by docs/modules.py -->\n", "<!-- end -->\n"
#: Letters of a long sentence, and of a first part that says too little.
LONG, SHORT = 130, 20
SENTENCE = re.compile(r"(.+?[.])(?:\s|$)")


def fortran_says(path: Path) -> str:
    """The comment that stands before a module, on one line."""
    lines = path.read_text().splitlines()
    start = next((i for i, line in enumerate(lines) if line.startswith("!>")), len(lines))
    stop = next((i for i in range(start, len(lines)) if not lines[i].startswith("!>")), len(lines))
    return " ".join(line.removeprefix("!>").strip() for line in lines[start:stop])


def python_says(path: Path) -> str:
    """The docstring of a module, on one line."""
    return " ".join((ast.get_docstring(ast.parse(path.read_text())) or "").split())


def sentence(text: str) -> str:
    """The first sentence of a text, without full stop and pointers to pages; of a long one its first part."""
    found = SENTENCE.match(re.sub(r" \(docs/[^)]*\)", "", text))
    said = (found[1] if found else text).removesuffix(".")
    first = re.split(r"[:;] ", said)[0]
    return first if len(said) > LONG and len(first) > SHORT else said


def folders(root: Path, pattern: str, order: tuple[str, ...]) -> Iterator[tuple[str, list[Path]]]:
    """Folders below the root in the order of the floors, each with its sources."""

    def place(path: Path) -> tuple[int, str]:
        inner = path.relative_to(root)
        floor = floors.fortran_floor(inner) if len(inner.parts) > 1 else ""
        return (order.index(floor) if floor in order else len(order)), str(inner.parent)

    files = sorted(root.rglob(pattern), key=lambda path: (place(path), path.stem))
    for folder, paths in groupby(files, key=lambda path: str(path.parent.relative_to(ROOT))):
        yield folder, list(paths)


def table() -> str:
    """The list of all modules, folder by folder."""
    lines = []
    for folder, paths in folders(ROOT / "src_f90", "*.[fF]90", floors.FORTRAN):
        lines += ["", f"**{folder}**", ""]
        lines += [f"- `{path.stem}`: {sentence(fortran_says(path))}" for path in paths]
    for folder, paths in folders(ROOT / "post/tiltpad", "*.py", tuple(floors.PYTHON)):
        lines += ["", f"**{folder}**", ""]
        lines += [
            f"- `{path.stem}`: {sentence(python_says(path))}" for path in paths if path.stem != "__init__"
        ]
    return "\n".join(lines[1:]) + "\n"


def main() -> int:
    """Writes the page, or says that its list is old; 1 where it is."""
    head, rest = PAGE.read_text().split(BEGIN)
    page = head + BEGIN + "\n" + table() + "\n" + END + rest.split(END)[1]
    if page == PAGE.read_text():
        return 0
    if "--check" in sys.argv:
        print("docs/architecture.md: its list of modules is old; docs/modules.py writes it anew")
        return 1
    PAGE.write_text(page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
