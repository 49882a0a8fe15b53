"""The tutorial: each of its commands is run, in its order, in an empty folder."""

import os
import re
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"```(\w+)( fails)?\n(.*?)```", re.DOTALL)
SAVED = re.compile(r"Save this text as `([\w.]+)`")


def test_every_command_of_the_tutorial_does_what_it_says(root, program, tmp_path):
    text = (root / "docs/tutorial.md").read_text()
    folders = [str(Path(program).parent), str(Path(sys.executable).parent), os.environ["PATH"]]
    environment = os.environ | {"PATH": os.pathsep.join(folders)}
    commands, cases = 0, iter(SAVED.findall(text))
    for language, fails, block in BLOCK.findall(text):
        if language == "nml":
            (tmp_path / next(cases)).write_text(block)
            continue
        lines = block.splitlines() if language == "sh" else [None]
        for line in lines:
            command = ["sh", "-c", line] if line else [sys.executable, "-c", block]
            done = subprocess.run(
                command, cwd=tmp_path, env=environment, text=True, capture_output=True, timeout=120
            )
            assert (done.returncode != 0) == bool(fails), f"{line or block}: {done.stdout}{done.stderr}"
            assert len(done.stderr.splitlines()) == bool(fails), done.stderr
            commands += 1
    assert commands == len(re.findall(r"^tiltpad|^python -c", text, re.MULTILINE)) + text.count("```python")
    for name in re.findall(r"images/[\w-]+\.png", text):
        assert (root / "docs" / name).exists(), name
    for name in re.findall(r"(?<!images/)\b[\w-]+\.(?:h5|png|pdf|svg|nml)\b", text):
        assert (tmp_path / name).exists(), name
    assert (tmp_path / "mine.html").exists()
    example = (root / "input/examples/five_pads.nml").read_text()
    assert example.endswith((tmp_path / "five.nml").read_text())
    same = [(tmp_path / name).stat().st_size for name in ("mine.h5", "again.h5")]
    assert same[0] == same[1]
