"""What the commands do so that drawing takes less time changes no picture."""

import subprocess
import sys

PICTURES = ("orbit", "waveform", "spectrum", "hysteresis", "poincare", "equilibrium")
DRAW = """
import hashlib, io, sys
import matplotlib as mpl
mpl.use("agg")
path, quick, *names = sys.argv[1:]
if quick == "yes":
    from tiltpad.draw.quick import quicken
    quicken()
    quicken()
from tiltpad import read
from tiltpad.draw import figures, layout, plots
from matplotlib.text import Text
mpl.rcParams["svg.hashsalt"] = "always the same"
with read(path) as run, mpl.style.context(plots.STYLE):
    for name in names:
        figure, picture = figures.FIGURES[name](run), io.BytesIO()
        layout.write(figure, picture, "svg", metadata={"Date": None})
        print(name, hashlib.sha256(picture.getvalue()).hexdigest())
print(hasattr(Text._get_layout, "__wrapped__"))
"""


def test_pictures_are_the_same_to_the_byte(result):
    path = str(result("lugre"))
    said = []
    for quick in ("no", "yes"):
        command = [sys.executable, "-c", DRAW, path, quick, *PICTURES]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        said.append(done.stdout.splitlines())
    plain, quick = said
    assert plain[:-1] == quick[:-1]
    assert len(plain) == len(PICTURES) + 1
    assert [each[-1] for each in said] == ["False", "True"]
