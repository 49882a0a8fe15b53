"""Writes docs/gallery.md and its pictures: every plot of tiltpad-plot with the one command that makes it.

usage: gallery.py TILTPAD FOLDER-FOR-RUNS
"""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tiltpad import command

DOCS = Path(__file__).resolve().parent
HEAD = """# Gallery

Written by `make docs`: every picture by the command beneath it, from runs by the commands at the end of the
page. All take several files, `--last N` revolutions, `--pad K`, and write PNG, PDF or SVG.
"""
LUGRE, PAPER = "input/paper/steady_lugre.nml", "input/paper"
#: Runs: name, case and what is changed in it.
RUNS = {
    "lugre": (LUGRE, ()),
    "bengisu": (f"{PAPER}/steady_tr_ba.nml", ()),
    "frictionless": (f"{PAPER}/steady_tr.nml", ()),
    "grade1": (LUGRE, ("rotor%balance_grade=1", "case%title=''")),
    "grade2.5": (LUGRE, ("rotor%balance_grade=2.5", "case%title=''")),
    "grade6.3": (LUGRE, ("rotor%balance_grade=6.3", "case%title=''")),
    "runup": (f"{PAPER}/runup_lugre.nml", ()),
    "four_pads": ("input/examples/four_pads.nml", ()),
}
#: Studies: name, which is that of the folder, and the command that runs its members into it.
STUDIES = {
    "laws": """for law in none bengisu_akay lugre; do
  for speed in $(seq 1500 500 9000); do
    tiltpad input/paper/steady_lugre.nml --set friction%model="'$law'" --set operation%speed_rpm=$speed \\
      --set operation%duration=2 --set case%title="''" --output laws/$law$speed.h5
  done
done""",
    "map": """for unbalance in $(seq 0.002 0.004 0.034); do
  for speed in $(seq 2000 750 8000); do
    tiltpad input/paper/steady_lugre.nml --set rotor%unbalance=$unbalance --set operation%speed_rpm=$speed \\
      --set operation%duration=0.5 --set case%title="''" --output map/$unbalance-$speed.h5
  done
done""",
}
#: Pictures: plot, runs, further options, what is seen.
PICTURES = (
    ("orbit", "lugre bengisu frictionless", "", "friction enlarges the orbit"),
    ("equilibrium", "lugre", "", "where the journal rests before it moves"),
    ("size", "grade1 grade2.5 grade6.3", "", "the orbit grows with the balance grade"),
    ("waveform", "lugre", "--last 3", "the pads' tilt follows the journal, with pauses"),
    ("spectrum", "lugre", "", "friction makes odd and even orders"),
    ("poincare", "four_pads", "--pad 3", "an upper pad flutters at half the shaft's speed"),
    ("hysteresis", "lugre bengisu", "", "the work that friction takes in a revolution"),
    ("friction", "lugre bengisu", "--pad 1", "a loop with LuGre, the Stribeck curve with Bengisu-Akay"),
    ("sticking", "bengisu", "", "where the pivots stick"),
    ("runup", "runup", "", "from 1500 to 6500 rpm"),
    ("orders", "runup", "", "amplitude and phase over speed"),
    ("waterfall", "runup", "", "all orders over speed"),
    ("pressure", "lugre", "--time 1.9", "the film of the loaded pads"),
    ("study", "laws", "--show friction_work", "what friction takes, over the speed"),
    ("study", "map", "", "two parameters as a map"),
    ("study", "laws", "--as bifurcation --where model=lugre", "Poincare points over the speed"),
)


def case(name: str) -> list[str]:
    """Arguments of the program for a run, without its output."""
    file, changes = RUNS[name]
    return [file, *(word for change in changes for word in ("--set", change))]


def march(program: str, name: str, folder: Path) -> None:
    words = [program, *case(name), "--quiet", "--output", folder / f"{name}.h5"]
    subprocess.run(words, check=True, cwd=DOCS.parent)


def sweep(program: str, name: str, folder: Path) -> None:
    """Runs the members of a study into their folder, and collects them."""
    (folder / name).mkdir(exist_ok=True)
    script = (
        STUDIES[name].replace("tiltpad ", f"{program} --quiet ").replace("--output ", f"--output {folder}/")
    )
    subprocess.run(["sh", "-c", script], check=True, cwd=DOCS.parent)
    subprocess.run([Path(sys.executable).with_name("tiltpad-collect"), name], check=True, cwd=folder)


def draw(plot: str, runs: str, options: str, number: int, folder: Path) -> str:
    """Draws a picture; gives the section of the page that shows it."""
    files = [f"{name}.h5" for name in runs.split()]
    words = [plot, *files, *options.split()]
    picture = DOCS / f"images/gallery_{plot}{number or ''}.png"
    command_line = [Path(sys.executable).with_name("tiltpad-plot"), *words, "-o", picture]
    subprocess.run(command_line, check=True, cwd=folder)
    return f"![{plot}](images/{picture.name})\n\n    tiltpad-plot {' '.join(words)}\n"


def main() -> None:
    program, folder = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    folder = folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    missing = set(command.PLOTS) - {plot for plot, *_ in PICTURES}
    if missing:
        sys.exit(f"gallery.py: no picture of {', '.join(sorted(missing))}")
    with ThreadPoolExecutor() as pool:
        list(pool.map(lambda name: march(program, name, folder), RUNS))
        list(pool.map(lambda name: sweep(program, name, folder), STUDIES))
        # pictures of one plot are numbered from 0
        plots = [plot for plot, *_ in PICTURES]
        numbers = [plots[:k].count(plot) for k, plot in enumerate(plots)]
        drawn = list(pool.map(lambda picture, k: draw(*picture[:3], k, folder), PICTURES, numbers))
    parts = [HEAD]
    for (plot, *_, seen), section in zip(PICTURES, drawn, strict=True):
        parts.append(f"## {plot}: {seen}\n\n{section}")
    shown = [f"    tiltpad {' '.join(case(name))} --output {name}.h5" for name in RUNS]
    for name, script in STUDIES.items():
        shown += ["", f"    mkdir {name}", *(f"    {line}" for line in script.splitlines())]
        shown += [f"    tiltpad-collect {name}"]
    parts.append("## The runs\n\n" + "\n".join(shown) + "\n")
    (DOCS / "gallery.md").write_text("\n".join(parts))


if __name__ == "__main__":
    main()
