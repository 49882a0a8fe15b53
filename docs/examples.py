"""Runs the commands of docs/examples.md and writes its pictures.

usage: examples.py TILTPAD FOLDER-FOR-RUNS
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent


def commands(page: str) -> list[str]:
    """The commands of a page, a line each."""
    return [line for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL) for line in block.splitlines()]


def main() -> None:
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "input").symlink_to(DOCS.parent / "input")
    path = os.pathsep.join([str(program.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    for line in commands((DOCS / "examples.md").read_text()):
        subprocess.run(["sh", "-c", line], check=True, cwd=folder, env=os.environ | {"PATH": path})
    for picture in folder.glob("example_*.png"):
        shutil.copy(picture, DOCS / "images")


if __name__ == "__main__":
    main()
