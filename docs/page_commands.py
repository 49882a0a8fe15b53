"""Runs the commands of a page, draws its pictures and compares the figures in its text."""

import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from tiltpad import command

DOCS = Path(__file__).resolve().parent


def follow(name: str, figures: Callable[[Path], Iterator[str]]) -> None:
    """Runs the page docs/NAME with the arguments TILTPAD FOLDER-FOR-RUNS of the command.

    `figures` are its words with figures as the runs in this folder have them now.
    """
    program, folder = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    page = (DOCS / name).read_text()
    run(page, program, folder)
    if wrong := [words for words in figures(folder) if words not in page]:
        sys.exit(f"docs/{name}: other figures now: {wrong}")


def run(page: str, program: str, folder: Path) -> None:
    """The commands of the page in their order; files of results stay in the folder."""
    for line in re.findall(r"```sh\n(.*?)```", page, re.DOTALL):
        for each in line.splitlines():
            first, *words = shlex.split(each)
            if first == "tiltpad":
                case = DOCS.parent / words[0]
                subprocess.run([program, case, *words[1:], "--overwrite"], cwd=folder, check=True)
                continue
            own = [str(folder / word) if word.endswith((".h5", ".png")) else word for word in words]
            if command.main(own):
                sys.exit(each)
            shutil.copy(own[-1], DOCS / "images")
