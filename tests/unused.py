"""Finds names that nothing uses: imports of a Fortran module, and what a module of src_f90 makes public.

A source file uses an import where the name stands outside the use statements, though not as a component or as
the name of an argument. A public name is used where another file imports it, be it a test. Every offence is
one line, "file:line: what". make lint calls this.
"""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

USE = re.compile(
    r"use(?:\s*,\s*(?:non_)?intrinsic)?(?:\s*::\s*|\s+)(?P<module>\w+)"
    r"\s*(?P<only>,\s*only\s*:)?\s*(?P<names>.*)"
)
PUBLIC = re.compile(r"public\s*::\s*(.*)")
TEXT = re.compile(r"'(?:[^']|'')*'|\"(?:[^\"]|\"\")*\"|!.*")
#: A name, be it the kind of a number (1.0_name), unless it is a component (a%name) or the name of an argument
#: (f(name=...)).
NAME = re.compile(r"(?:(?<![\w%.])(?<!% )|(?<=\d_)|(?<=\.))([a-z]\w*)")
ARGUMENT = re.compile(r"([(,]\s*)[a-z]\w*\s*=(?![=>])")


class Source:
    """A Fortran source, read without comments and texts: what it imports, and names that it uses."""

    def __init__(self, path: Path):
        self.path = path
        self.imports: list[tuple[int, str, str, str]] = []  # line, module, name there, name here
        self.whole: list[tuple[int, str]] = []  # line and module of a use without a list
        self.public: list[tuple[int, str]] = []
        self.names: set[str] = set()
        for number, statement in statements(path.read_text()):
            if used := USE.fullmatch(statement):
                self.take_use(number, used)
            else:
                if public := PUBLIC.fullmatch(statement):
                    self.public += [(number, name.strip()) for name in public[1].split(",")]
                self.names.update(NAME.findall(ARGUMENT.sub(r"\1", statement)))

    def take_use(self, number: int, used: re.Match[str]) -> None:
        """Notes what a use statement imports; operators and assignments have no name to look for."""
        if not used["only"]:
            self.whole.append((number, used["module"]))
        for name in filter(None, map(str.strip, used["names"].split(","))):
            here, _, there = (part.strip() for part in name.partition("=>"))
            if "(" not in name:
                self.imports.append((number, used["module"], there or here, here))


def statements(text: str) -> Iterator[tuple[int, str]]:
    """Statements in lower case, without comments and texts, continued lines joined, each with its line."""
    first, joined = 0, ""
    for number, line in enumerate(text.splitlines(), 1):
        line = TEXT.sub(" ", line).strip().lower()
        first = first or number
        joined = f"{joined} {line.removeprefix('&').removesuffix('&').strip()}".strip()
        if not line.endswith("&") and not (joined and not line):
            if joined:
                yield first, joined
            first, joined = 0, ""


def unused_imports(sources: list[Source]) -> Iterator[str]:
    """Imports of names that the file does not use; of one named in several scopes, all are taken as used."""
    for source in sources:
        for number, module, _, here in source.imports:
            if here not in source.names:
                yield f"{source.path}:{number}: imports {here} of {module} and does not use it"


def unused_publics(sources: list[Source], root: Path) -> Iterator[str]:
    """Public names of modules below the root that no other file imports."""
    imported = {(module, there) for source in sources for _, module, there, _ in source.imports}
    for source in sources:
        if not source.path.is_relative_to(root):
            continue
        module = source.path.stem
        users = [other for other in sources if module in {name for _, name in other.whole}]
        for number, name in source.public:
            if (module, name) not in imported and not any(name in user.names for user in users):
                yield f"{source.path}:{number}: {name} is public and no other file uses it"


def main() -> int:
    """Prints what is wrong, relative to the project's folder; 1 where something is."""
    root = Path("src_f90")
    folders = (root, Path("post/wrap"), Path("tests"))
    sources = [Source(path) for folder in folders for path in sorted(folder.rglob("*.[fF]90"))]
    found = [*unused_imports(sources), *unused_publics(sources, root)]
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
