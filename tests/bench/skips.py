"""What a case does not need and the program leaves out: each beside the same with it."""

import csv
import subprocess
from collections.abc import Iterator

from runner import Row, Runner
from settings import MAIN, VISITS, Case

LUGRE = MAIN[1].input_file
#: Interval of the samples of `LUGRE` at 360 a revolution and 6500 rpm, s.
SAMPLE = 60 / 6500 / 360
#: Group of the row that times the contact table.
TABLE = "table"
#: (what is left out, case, setting without it, setting with it)
SKIPS = (
    ("the pivot's two states in a tilting-only case", "input/paper/steady_to.nml",
     (), ("pads%motion=tilting_radial",)),
    ("the bristles' states in a case without friction", "input/paper/steady_tr.nml",
     (), ("friction%model=lugre", "friction%static_coefficient=1e-6", "friction%dynamic_coefficient=1e-6")),
    ("the other half of the film (over-relaxation, 0.02 s)", LUGRE,
     ("film%solver=sor", "operation%duration=0.02"),
     ("film%solver=sor", "operation%duration=0.02", "film%axial_cells=30")),
    ("films that the table has", LUGRE, (), ("film%solver=direct",)),
    ("steps that end at samples (CVODE interpolates)", LUGRE, (), (f"integration%max_step={SAMPLE:.3g}",)),
    ("a harmonic excitation (of 0 N; left out: until shortly before the end)", "tests/bench/excited.nml",
     ("excitation(1)%start=1.99",), ()),
    ("revolutions that repeat (stop_when_periodic)", LUGRE,
     ("integration%stop_when_periodic=1e-4",), ()),
)  # fmt: skip


def skips(runner: Runner) -> Iterator[Row]:
    """Every pair, timed one after the other."""
    for what, input_file, without, including in SKIPS:
        timed = Case(what, what, input_file)
        for setting, overrides in (("left out", without), ("kept", including)):
            row, path = runner.run(timed, "skips", setting, overrides)
            path.unlink(missing_ok=True)
            yield row


def visits(runner: Runner) -> Iterator[Row]:
    """What runs visit of the film table, and therefore build."""
    for timed in VISITS:
        row, path = runner.run(timed, "visits", "defaults", repeat=False)
        path.unlink(missing_ok=True)
        yield row


def kernels(runner: Runner) -> Iterator[Row]:
    """One film evaluation by every solver, by the program film_bench."""
    program = runner.program.parent.parent / "bench/film_bench"
    done = subprocess.run(["taskset", "-c", "1", program], text=True, capture_output=True, check=True)
    for line in csv.DictReader(done.stdout.splitlines()):
        yield Row(
            runner.part,
            f"{line['state']}, {line['condition']}",
            line["film"],
            "with derivatives" if line["derivatives"] == "yes" else "force",
            film_seconds=1e-6 * float(line["microseconds"]),
            film_evaluations=1,
            error=float(line["error"]),
        )
