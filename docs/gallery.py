"""Writes docs/gallery.md and its pictures: every plot of tiltpad-plot with the one command that makes it.

usage: gallery.py TILTPAD FOLDER-FOR-RUNS
"""

import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tiltpad import command

DOCS = Path(__file__).resolve().parent
HEAD = """# Gallery

`make docs` writes this page. The command below each picture draws it, from the runs at the end of the page.
Most plots accept several files, `--last N` revolutions and `--pad K`; all but movies write PNG, PDF or SVG.
"""
LUGRE, PAPER = "input/paper/steady_lugre.nml", "input/paper"
MACHINE = "input/examples/unequal_bearings.nml"
#: Runs: name, case and what is changed in it.
RUNS = {
    "lugre": (LUGRE, ()),
    "bengisu": (f"{PAPER}/steady_tr_ba.nml", ()),
    "frictionless": (f"{PAPER}/steady_tr.nml", ()),
    "grade1": (LUGRE, ("rotor%balance_grade=1", 'case%title=""')),
    "grade2.5": (LUGRE, ("rotor%balance_grade=2.5", 'case%title=""')),
    "grade6.3": (LUGRE, ("rotor%balance_grade=6.3", 'case%title=""')),
    "runup": (f"{PAPER}/runup_lugre.nml", ()),
    "four_pads": ("input/examples/four_pads.nml", ()),
    "periodic": (LUGRE, ("case%task=periodic",)),
    "branch": (
        LUGRE,
        (
            "case%task=branch",
            'branch%parameter="operation%speed_rpm"',
            "operation%speed_rpm=2000",
            "branch%last=12000",
            "branch%step=100",
            "branch%max_step=500",
            'case%title=""',
        ),
    ),
    "five_pads": ("input/examples/five_pads.nml", ()),
    "machine": (MACHINE, ()),
    "machine_modes": (MACHINE, ("case%task=coefficients",)),
    "warm": ("input/examples/warm_five_pads.nml", ()),
    "bent": ("input/examples/bent_pads.nml", ()),
    "turbine": ("input/examples/turbine_bearing.nml", ()),
    "lemon": ("input/examples/lemon_bore.nml", ()),
    "curve": (
        "input/examples/lemon_bore.nml",
        (
            "branch%of=curve",
            "branch%point=hopf",
            "branch%second_parameter=bearing%viscosity",
            "branch%second_last=0.01",
        ),
    ),
}
#: Studies: name, which is that of the folder, case, and what is varied.
STUDIES = {
    "laws": (
        LUGRE,
        (
            'sweep%friction%model="none","bengisu_akay","lugre"',
            "sweep%operation%speed_rpm=1500:9000:500",
            'case%title=""',
        ),
    ),
    "map": (
        LUGRE,
        (
            "sweep%rotor%unbalance=0.002:0.034:0.004",
            "sweep%operation%speed_rpm=2000:8000:750",
            "operation%duration=0.5",
            'case%title=""',
        ),
    ),
    "upper": ("input/examples/four_pads.nml", ("sweep%operation%speed_rpm=2000:9250:250",)),
    "soft": (
        f"{PAPER}/steady_tr.nml",
        (
            "case%task=periodic",
            'case%title=""',
            "pivot%law=hertz",
            "sweep%pivot%radius_difference=1e-4,1e-3",
            "sweep%operation%speed_rpm=1500:9000:250",
        ),
    ),
    "warm_speeds": ("input/examples/warm_five_pads.nml", ("sweep%operation%speed_rpm=250:5250:250",)),
    "carry_over": (
        "input/examples/bent_pads.nml",
        (
            "case%task=equilibrium",
            "sweep%oil%carry_over=0.7,0.8,0.9",
            "sweep%operation%speed_rpm=2000:4000:500",
        ),
    ),
    "transition": (
        "input/examples/warm_five_pads.nml",
        (
            "film%turbulence=ng_pan",
            "oil%grade=32",
            "sweep%film%turbulent_above=1000,1500",
            "sweep%operation%speed_rpm=6000:18000:500",
            'case%title=""',
        ),
    ),
    "tolerances": ("input/examples/tolerances.nml", ()),
    "kicks": (
        "input/examples/lemon_bore.nml",
        (
            "case%task=march",
            "operation%speed_rpm=9800",
            "operation%duration=0.5",
            "output%keep=summary",
            "sweep%start%journal(1)=-30e-6:30e-6:5e-6",
            "sweep%start%journal(2)=-30e-6:30e-6:5e-6",
        ),
    ),
    "whirl": (
        "input/examples/five_pads.nml",
        (
            "case%task=coefficients",
            "coefficients%frequency_ratio=0.5,1",
            "friction%model=lugre",
            "sweep%operation%speed_rpm=2000:12000:250",
        ),
    ),
}
#: Pictures: plot, runs, further options, what is seen.
PICTURES = (
    ("orbit", "lugre bengisu frictionless", "", "friction enlarges the orbit"),
    ("orbit", "five_pads", "", "pads that carry no load are pale"),
    ("equilibrium", "lugre", "", "the equilibrium at which the motion starts"),
    ("size", "grade1 grade2.5 grade6.3", "", "the orbit grows with the balance grade"),
    ("waveform", "lugre", "--last 3", "the tilt of the pads follows the journal, with pauses"),
    ("multipliers", "periodic", "", "the orbit is stable: all multipliers lie in the unit circle"),
    ("spectrum", "lugre", "", "friction causes odd and even orders"),
    ("poincare", "four_pads", "--pad 3", "an upper pad flutters at half the shaft speed"),
    ("hysteresis", "lugre bengisu", "", "the friction work of a revolution"),
    ("friction", "lugre bengisu", "--pad 1", "a loop with LuGre, the Stribeck curve with Bengisu-Akay"),
    ("sticking", "bengisu", "", "the time in which the pivots stick"),
    ("runup", "runup", "", "a run-up from 1500 to 6500 rpm"),
    ("orders", "runup", "", "amplitude and phase of the orders over speed, with the peak"),
    ("waterfall", "runup", "", "frequencies over speed"),
    ("pressure", "lugre", "--time 1.9", "the film of the loaded pads"),
    ("pressure", "five_pads", "", "one scale for all pads: the upper ones carry next to nothing"),
    ("film", "five_pads", "", "thickness and pressure around the bearing"),
    ("orbit", "machine", "", "the journals of a machine, a row for each bearing"),
    ("hysteresis", "machine", "--bearing drive_end", "the pads of one bearing of a machine"),
    ("machine", "machine", "", "a machine to scale: shaft, discs, bearings, a support, unbalances, load"),
    ("stations", "machine", "--station 2,5,12,14", "orbits of the shaft of a machine at its stations"),
    ("shaft", "machine", "", "the shaft at the equilibrium, and the loads of its bearings"),
    ("shapes", "machine_modes", "--pivot stuck", "mode shapes of the shaft, forward and backward"),
    ("bearing", "five_pads", "", "pads, angles, load and sense of rotation, at the equilibrium"),
    ("movie", "five_pads", "--last 2", "the unloaded top pad flutters at half the shaft speed"),
    (
        "branch",
        "branch",
        "",
        "with LuGre friction a torus (Neimark-Sacker) bifurcation appears at high speed",
    ),
    ("branch", "lemon", "", "a whirl with a fold below its threshold speed"),
    ("chart", "curve", "", "the threshold speed over the viscosity, with its stable side"),
    ("basin", "kicks lemon", "", "the starts within the unstable cycle return"),
    ("response", "soft", "", "pivots that are soft give the rotor a critical speed"),
    ("coefficients", "whirl", "", "stiffness and damping over speed, at two whirl frequencies"),
    ("stability", "whirl", "--pivot stuck", "the modes with pivots that stick"),
    ("campbell", "whirl", "", "frequencies of the modes, free pivots"),
    ("temperatures", "warm", "", "temperatures of the pads, and where their heat goes"),
    ("temperatures", "warm_speeds", "", "temperatures and viscosities over speed, with VG 46"),
    ("temperatures", "bent", "--pad 2", "temperatures in a film: the journal is above"),
    ("bearing", "bent", "", "temperatures of the pads and the shaft"),
    (
        "temperatures",
        "carry_over",
        "--over speed_rpm",
        "bands: what the carry-over of oil, which is hardly known, changes",
    ),
    (
        "temperatures",
        "transition",
        "--over speed_rpm",
        "turbulent films of 127 mm at 40 to 120 m/s; bands: what the end of the transition changes",
    ),
    ("turbulence", "turbine", "", "where the films of a turbine bearing are turbulent"),
    ("tornado", "tolerances", "--show threshold_rpm --pivot stuck", "which input matters"),
    ("distribution", "tolerances", "", "results of bearings as they are made, with percentiles"),
    ("scatter", "tolerances", "", "results over the inputs, a point for each bearing"),
    ("study", "laws", "--show friction_work", "friction work over speed"),
    ("study", "map", "", "a map over two parameters"),
    ("study", "upper", "--show poincare_tilt --pad 3", "the motion of an upper pad bifurcates"),
)


def case(name: str) -> list[str]:
    """Arguments of the program for a run or study, without its output."""
    file, changes = (RUNS | STUDIES)[name]
    return [file, *(word for change in changes for word in ("--set", change))]


def march(program: str, name: str, output: Path) -> None:
    words = [program, *case(name), "--quiet", "--overwrite", "--output", output]
    subprocess.run(words, check=True, cwd=DOCS.parent)


def run_study(program: str, name: str, folder: Path) -> None:
    """Performs the runs of a study into its file."""
    # the files of an earlier study would be refused
    shutil.rmtree(folder / name, ignore_errors=True)
    march(program, name, folder / name)


def draw(plot: str, runs: str, options: str, number: int, folder: Path) -> str:
    """Draws a picture; gives the section of the page that shows it."""
    files = [f"{name}.h5" for name in runs.split()]
    words = [plot, *files, *options.split()]
    suffix = command.MOVIES[0] if plot == command.MOVIE else command.FORMATS[0]
    picture = DOCS / f"images/gallery_{plot}{number or ''}.{suffix}"
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
        list(pool.map(lambda name: march(program, name, folder / f"{name}.h5"), RUNS))
        for name in STUDIES:
            run_study(program, name, folder)
        # pictures of one plot are numbered from 0
        plots = [plot for plot, *_ in PICTURES]
        numbers = [plots[:k].count(plot) for k, plot in enumerate(plots)]
        drawn = list(pool.map(lambda picture, k: draw(*picture[:3], k, folder), PICTURES, numbers))
    parts = [HEAD]
    for (plot, *_, seen), section in zip(PICTURES, drawn, strict=True):
        parts.append(f"## {plot}: {seen}\n\n{section}")
    shown = [f"    tiltpad {shlex.join(case(name))} --output {name}.h5" for name in RUNS]
    for name in STUDIES:
        shown += ["", f"    tiltpad {shlex.join(case(name))} --output {name}"]
    parts.append("## The runs\n\n" + "\n".join(shown) + "\n")
    (DOCS / "gallery.md").write_text("\n".join(parts))


if __name__ == "__main__":
    main()
