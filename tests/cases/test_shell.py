"""What make install puts beside the program: manual pages and completion, made from its own words."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

# prints what bash would propose for the line in $LINE
PROPOSE = """. post/shell/tiltpad.bash
COMP_WORDS=($LINE) COMP_LINE=$LINE COMP_POINT=${#LINE}
_tiltpad
echo "${COMPREPLY[@]}"
"""


@pytest.mark.parametrize(
    ("line", "proposed"),
    [
        ("tiltpad --over", "--overwrite"),
        (
            "tiltpad case.nml --set operation%",
            "operation%speed_rpm= operation%final_speed_rpm= operation%duration=",
        ),
        ("tiltpad --set sweep%rotor%ma", "sweep%rotor%mass="),
        ("tiltpad --set friction%model=", "none bengisu_akay lugre"),
        ("tiltpad --set rotor%mass=", ""),
        ("tiltpad input/examples/five", "input/examples/five_pads.nml"),
        ("tiltpad LICEN", ""),
    ],
)
def test_completion(root, program, line, proposed):
    path = f"{Path(program).parent}:{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", PROPOSE], cwd=root, env={"PATH": path, "LINE": line}, text=True, capture_output=True
    )
    assert (done.stdout.strip(), done.stderr) == (proposed, "")


def test_the_manual_page_has_every_option(root, tiltpad):
    said = tiltpad("--help", cwd=root).stdout
    page = subprocess.run(
        ["awk", "-v", "name=tiltpad", "-f", "post/shell/man_page.awk"],
        input=said,
        cwd=root,
        text=True,
        capture_output=True,
    ).stdout
    entries = re.findall(r"^\.TP\n\\fB(.*)\\fR$", page, re.M)
    assert [each.replace("\\-", "-") for each in entries] == re.findall(r"^  (--.*?)(?:  |$)", said, re.M)
    assert re.findall(r"^\.SH (.*)$", page, re.M) == [
        "NAME",
        "SYNOPSIS",
        "DESCRIPTION",
        "OPTIONS",
        "EXIT STATUS",
    ]
    if shutil.which("groff"):
        done = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=page, text=True, capture_output=True)
        assert (done.returncode, done.stderr) == (0, "")
