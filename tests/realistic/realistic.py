"""Realistic bearings: error, steps, time and refusals of the program's default settings.

usage: realistic.py TILTPAD [--bearings N [--fast N] [--fixed N] | --only N,N,..] [--seed S] [--jobs J]
                    [--record FILE] [--report FILE] [--namelists FOLDER]

With a record, a long study may be stopped at any time: the same command goes on where it ended.
"""

import argparse
import json
import os
import shutil
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

import bearings
import fixed_bearings
import realistic_picture
from bearing_runs import Bearing, Run, study
from bearings import FAST_ABOVE
from fixed_bearings import FIXED_ABOVE
from realistic_page import line, page
from stress_cases import Case, text

#: One of eight bearings is marched with the tables of all tolerances.
CURVE_EVERY = 8


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=lambda word: Path(word).resolve())
    parser.add_argument("--bearings", type=int, default=200, help="how many")
    parser.add_argument("--fast", type=int, default=20, help="how many fast ones more")
    parser.add_argument("--fixed", type=int, default=60, help="how many of fixed pads more")
    parser.add_argument("--only", type=lambda words: list(map(int, words.split(","))), help="these bearings")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--record", type=Path, help="results so far; what is in it is not run again")
    parser.add_argument("--report", type=Path, help="Markdown page to write, and its picture in images")
    parser.add_argument("--namelists", type=Path, help="only write the bearings there")
    return parser.parse_args()


def draw(seed: int, number: int) -> Case:
    """Bearing `number` of a seed."""
    return (fixed_bearings if number > FIXED_ABOVE else bearings).draw(seed, number)


def run(options: argparse.Namespace, number: int, known: dict[int, Bearing]) -> Bearing:
    """Studies one bearing in a folder of its own, if it is not known."""
    if number in known:
        return known[number]
    bearing = Bearing(number, draw(options.seed, number))
    folder = Path(tempfile.mkdtemp(prefix="tiltpad-realistic-"))
    try:
        study(options.program, bearing, folder, number % CURVE_EVERY == 0 and number <= FAST_ABOVE)
    finally:
        shutil.rmtree(folder)
    if options.record:
        values = {"seed": options.seed} | asdict(bearing)
        del values["case"]
        with options.record.open("a") as file:
            file.write(json.dumps(values) + "\n")
    print(line(bearing), flush=True)
    return bearing


def recorded(options: argparse.Namespace) -> dict[int, Bearing]:
    """The bearings in the record."""
    known: dict[int, Bearing] = {}
    if not options.record or not options.record.exists():
        return known
    for each in options.record.read_text().splitlines():
        values = json.loads(each)
        if values.pop("seed") == options.seed:
            number = values["number"]
            values["runs"] = {name: Run(**run) for name, run in values["runs"].items()}
            known[number] = Bearing(case=draw(options.seed, number), **values)
    return known


def main() -> None:
    options = arguments()
    fast = range(FAST_ABOVE + 1, FAST_ABOVE + 1 + options.fast)
    fixed = range(FIXED_ABOVE + 1, FIXED_ABOVE + 1 + options.fixed)
    numbers = options.only or [*range(1, options.bearings + 1), *fast, *fixed]
    if options.namelists:
        options.namelists.mkdir(parents=True, exist_ok=True)
        for number in numbers:
            (options.namelists / f"{number:03d}.nml").write_text(text(draw(options.seed, number)))
        return
    started, known = time.monotonic(), recorded(options)
    with ThreadPoolExecutor(options.jobs) as pool:
        studied = list(pool.map(lambda number: run(options, number, known), numbers))
    summary = page(studied, options.seed)
    if options.report:
        options.report.write_text(summary)
        realistic_picture.draw(studied, options.report.parent / "images/realistic.png")
    else:
        print(summary)
    print(f"{time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()
