"""Now over limit: what users wait for, beside the part of it that physics or a library takes in any case."""

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from runner import Row, Runner, launch
from settings import MAIN, ONE_FILMS, ONE_SOLVER
from tables import short, table

#: Short commands run so often; the best counts.
ROUNDS = 5
SUMMARY = ("output%keep=summary",)
#: Python with the libraries that a picture needs.
LIBRARIES = (sys.executable, "-c", "import h5py, matplotlib.pyplot")
NOW, LIMIT = "now", "limit"
#: What is measured, by its name: what users wait for, and what the limit is.
MEASURED = {
    "march": (f"march of 2 s (`{MAIN[1].name}`), its summary alone", "its films, each a look into a table"),
    "equilibrium": ("task `equilibrium`", "the start of the program"),
    "plot": ("`tiltpad-plot orbit` of this march", "Python and its libraries, loaded"),
    "report": ("`tiltpad-report` of it", "Python and its libraries, loaded"),
}


def limits(runner: Runner) -> Iterator[Row]:
    """Two rows for each: what it takes, and its limit where that is measured here."""
    march, path = runner.run(MAIN[1], NOW, "march", SUMMARY)
    path.unlink()
    yield march
    _, path = runner.run(MAIN[1], "all", "march", timed=False)
    equilibrium, found = runner.run(MAIN[1], NOW, "equilibrium", ("case%task=equilibrium",))
    found.unlink()
    equilibrium.case = "equilibrium"
    yield equilibrium
    yield Row(runner.part, "equilibrium", LIMIT, "", wall_seconds=best([runner.program, "--version"]))
    libraries = best(LIBRARIES)
    for name, command, suffix in (
        ("plot", ["tiltpad-plot", "orbit"], "png"),
        ("report", ["tiltpad-report"], "html"),
    ):
        words = [
            Path(sys.executable).with_name(command[0]),
            *command[1:],
            path,
            "-o",
            path.with_suffix(f".{suffix}"),
        ]
        yield Row(runner.part, name, NOW, "", wall_seconds=best(words))
        yield Row(runner.part, name, LIMIT, "", wall_seconds=libraries)
    path.unlink()


def best(command: Iterable) -> float:
    """Least wall seconds of a command on one core."""
    done = [launch(command) for _ in range(ROUNDS)]
    if any(each.status for each in done):
        raise RuntimeError(done[0].said)
    return min(each.seconds for each in done)


def over(found: list[Row], kernels: list[Row]) -> str:
    """The table of what is waited for, over its limit."""
    seconds = {(row.case, row.group): row.wall_seconds for row in found}
    film = [row for row in kernels if (row.case, row.group) == (ONE_FILMS[1], ONE_SOLVER)]
    lines = []
    for name, (what, limit) in MEASURED.items():
        case = MAIN[1].name if name == "march" else name
        now, least = seconds.get((case, NOW)), seconds.get((case, LIMIT))
        if name == "march" and film and now:
            mine = next(row for row in found if row.case == case and row.group == NOW)
            least = mine.film_evaluations * min(row.film_seconds for row in film)
        if now and least:
            lines.append((what, f"{short(now)} s", limit, f"{short(least)} s", short(now / least, 2)))
    return table("what | now | limit | | now over limit", lines)
