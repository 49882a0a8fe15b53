"""Tables of docs/verification.md about single films: errors of the solvers, long arcs, losses and flows.

Test programs find the figures; their lines are read here.
"""

import re
import subprocess
from pathlib import Path

from verify_runs import row

#: How many times as many random films as in a test.
TIMES = 12
LINE = re.compile(
    r"(?P<solver>[^,]+), (?P<condition>\w+)(?P<supply>, supply pressure)?, film thickness ratio [\d to]+:"
    r" *(?P<films>\d+) films; force, slopes, highest pressure +(?P<errors>.+)"
)
FIELD = re.compile(r"field of (?P<solver>[^,]+), (?P<condition>\w+) *: integral less force +(?P<error>\S+)")
#: Of Raimondi and Boyd: S, Q_in/(R c N L), Q_side/Q_in, friction R/c, by L/D and e/c.
RAIMONDI_BOYD = {
    ("1.0", "0.2"): (0.631, 3.59, 0.280, 12.8),
    ("1.0", "0.4"): (0.264, 3.99, 0.497, 5.79),
    ("1.0", "0.6"): (0.121, 4.33, 0.680, 3.22),
    ("1.0", "0.8"): (0.0446, 4.62, 0.842, 1.70),
    ("0.5", "0.2"): (2.03, 3.72, 0.318, 40.9),
    ("0.5", "0.4"): (0.779, 4.29, 0.552, 17.0),
    ("0.5", "0.6"): (0.319, 4.85, 0.730, 8.10),
    ("0.5", "0.8"): (0.0923, 5.41, 0.874, 3.26),
}


def lines(program, test, *arguments):
    """What a test program prints."""
    path = Path(program).resolve().parent.parent / "tests" / test
    return subprocess.run(
        [path, *map(str, arguments)], check=True, capture_output=True, text=True
    ).stdout.splitlines()


def film_errors(program, _folder):
    """Rows of the largest errors of each solver and condition."""
    printed = lines(program, "test_film_accuracy", TIMES)
    fields = {
        (found["solver"], found["condition"]): found["error"] for found in map(FIELD.match, printed) if found
    }
    cases = {}
    for found in filter(None, map(LINE.match, printed)):
        case = (found["solver"], found["condition"], found["supply"] or "")
        cases.setdefault(case, []).append((int(found["films"]), *map(float, found["errors"].split())))
    for (solver, condition, supply), ranges in cases.items():
        films, forces, slopes, pressures = zip(*ranges, strict=True)
        field = fields.get((solver, condition), "") if not supply else ""
        yield row(
            f"`{solver.partition(' ')[0]}`{solver.removeprefix(solver.partition(' ')[0])}{supply}",
            *(f"`{condition}`", sum(films), *(f"{force:.1e}" for force in forces)),
            *(f"{max(slopes):.1e}", f"{max(pressures):.1e}", field and f"{float(field):.1e}"),
        )


def long_arcs(program, _folder):
    """Rows of the largest errors of the force on long arcs."""
    for line in lines(program, "test_fixed_pads"):
        if found := re.match(r"wide films, largest error of the force, (\w+) +(\S+)", line):
            yield row(f"`{found[1]}`", f"{float(found[2]):.1e}")


def loss_sums(program, _folder):
    """Rows of the largest errors of losses and flows against sums over finite volumes."""
    for line in lines(program, "test_losses"):
        if found := re.match(r"full films, largest error +(\S+)", line):
            yield row("full films", f"{float(found[1]):.1e}")
        elif found := re.match(r"cavitated films, largest errors at rest and squeezed +(\S+) +(\S+)", line):
            yield row("cavitated films without squeeze", f"{float(found[1]):.1e}")
            yield row("cavitated films with squeeze", f"{float(found[2]):.1e}")


def raimondi_boyd(program, _folder):
    """Rows of full bearings beside the tables of Raimondi and Boyd."""
    for line in lines(program, "test_losses"):
        if found := re.match(r"L/D, e/c (\S+) (\S+): .*streamers +(.+)", line):
            *here, streamers = map(float, found[3].split())
            there = RAIMONDI_BOYD[found[1], found[2]]
            cells = [f"{ours:.4g} ({theirs:g})" for ours, theirs in zip(here, there, strict=True)]
            yield row(found[1], found[2], *cells, f"{streamers:.4g}")


TABLES = (film_errors, long_arcs, loss_sums, raimondi_boyd)
