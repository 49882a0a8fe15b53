"""The check of words (tests/words.py) finds what is not of the field, and leaves standard terms alone."""

import subprocess
import sys

import pytest
import words


@pytest.mark.parametrize(
    ("line", "term"),
    [
        ("call pad_rest_of(x)", "equilibrium"),
        ("the bearing comes to rest", "equilibrium"),
        ("a ruptured film", "cavitated film"),
        ("use kink_mesh, only: x", "switching point"),
        ("integer :: few = 40", "the quantity"),
        ("use octaves, only: interval", "logarithmic grid"),
        ("member 12 of the study", "run (of a study)"),
        ("the sweep has 5 values", "parameter study"),
        ("The equilibrium is fluttering", "oscillatory instability"),
    ],
)
def test_what_is_found(line, term):
    found = [said for _, _, said in words.offences(line)]
    assert [said for said in found if said.startswith(term)]


@pytest.mark.parametrize(
    "line",
    [
        "the rest of the file, and the rest of it",
        "tangent = sine/cosine",
        "the rupture boundary; a cavitated film",
        "one SOR sweep; a case with &sweep",
        "pad 2 flutters",
        "GNU Octave",
        "few values",
        "a pad at rest on its pivot",
        "cells of half an octave",
        "the solver sor makes 8 sweeps",
        "operation%speed_rpm cannot be swept",
        "'scene': an alias of 'case'",
        "period doubling (flip)",
    ],
)
def test_what_is_not(line):
    assert not list(words.offences(line))


def test_the_command(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("A scene.\nTwo scenes.\n")
    (tmp_path / "picture.png").write_bytes(b"scene")
    listed = subprocess.run([sys.executable, words.__file__, tmp_path], capture_output=True, text=True)
    assert listed.returncode == 1
    assert listed.stdout.splitlines() == [
        f"{page}:1: scene: say case",
        f"{page}:2: scenes: say case",
        "     2  case",
    ]
    page.write_text("A case.\n")
    assert subprocess.run([sys.executable, words.__file__, tmp_path]).returncode == 0


def test_what_tools_leave_behind_is_not_read(tmp_path):
    (tmp_path / ".ruff_cache").mkdir()
    (tmp_path / ".ruff_cache" / "0").write_bytes(b"\xff\x00 ruptured")
    (tmp_path / "page.md").write_text("plain\n")
    assert [each.name for each in words.files([str(tmp_path)])] == ["page.md"]
