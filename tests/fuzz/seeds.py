"""Cases kept in a file: one a line, bytes as the characters of the same number, and why it is kept."""

import json
from pathlib import Path

from harness import Case


def load(path: Path) -> list[tuple[Case, str]]:
    """Cases and why they are kept."""
    found = []
    for line in path.read_text(encoding="utf-8").splitlines():
        said = json.loads(line)
        sets = tuple(argument.encode("latin-1") for argument in said.get("set", []))
        found.append((Case(said["text"].encode("latin-1"), sets), said.get("why", "")))
    return found


def line(case: Case, why: str = "") -> str:
    """The line that stands for a case."""
    said = {"why": why} if why else {}
    said["text"] = case.text.decode("latin-1")
    if case.sets:
        said["set"] = [argument.decode("latin-1") for argument in case.sets]
    return json.dumps(said) + "\n"
