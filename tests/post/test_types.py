"""The types of the package: mypy accepts them within it and in a user's script, and finds what is wrong."""

import re
import subprocess
import sys

SCRIPT = """
import numpy as np
import tiltpad

run = tiltpad.read("mine.h5")
y, z = tiltpad.orbit(run, last=2)
size: float = max(tiltpad.orbit_size(run))
title: str = run.title
modes = tiltpad.modes(run)
print(np.ptp(y) + np.ptp(z), size, title, modes.damping_ratio.min(), tiltpad.__version__)
ax = tiltpad.plots.orbit(run)
ax.figure.savefig("own.pdf")
study = tiltpad.run("mine.nml", sweep={"operation%speed_rpm": "3000:6000:1000"})
if isinstance(study, tiltpad.Study):
    study.to_csv("study.csv")
"""
#: The same as a user checks it, who has his own configuration.
STRICT = ["--strict", "--config-file", ""]
WRONG = ("tiltpad.read(3)", "tiltpad.orbit('mine.h5')", "tiltpad.orbit(run, last='all')", "tiltpad.modes()")


def test_mypy_accepts_the_package_and_scripts_that_use_it(root, tmp_path):
    right, wrong = tmp_path / "right.py", tmp_path / "wrong.py"
    right.write_text(SCRIPT)
    wrong.write_text("\n".join(["import tiltpad", "run = tiltpad.read('mine.h5')", *WRONG, ""]))
    config = root / "post/pyproject.toml"
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", config, root / "post/tiltpad", right, wrong],
        cwd=root,
        text=True,
        capture_output=True,
    )
    assert done.stderr == ""
    # the folder may be that of an earlier test, in which mypy saw the same file
    found = re.findall(r"^.*?([\w.]+):(\d+): error: ", done.stdout, re.MULTILINE)
    assert found == [("wrong.py", str(k)) for k in range(3, 3 + len(WRONG))], done.stdout


def test_a_strict_check_accepts_a_users_script(tmp_path):
    (tmp_path / "mine.py").write_text(SCRIPT)
    words = [sys.executable, "-m", "mypy", *STRICT, "mine.py"]
    done = subprocess.run(words, cwd=tmp_path, text=True, capture_output=True)
    assert done.returncode == 0, done.stdout + done.stderr
