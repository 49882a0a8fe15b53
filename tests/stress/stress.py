"""Stress test: random cases over wide ranges of every input; each ends in a result or a named refusal.

usage: stress.py TILTPAD [--cases N | --only N,N,..] [--seed S] [--fixed] [--jobs J] [--compare SHARE]
                 [--search PROGRAM] [--keep FOLDER] [--record FILE] [--flutter] [--searches] [--report FILE]

Cases that fail are kept as namelists, to be run again. With a record, a long test may be stopped
at any time: the same command goes on where it ended. The last line reads "N passed, N failed".
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

from flutter import flutter
from report import page
from searches import searches
from stress_cases import Dice, draw, text
from stress_judge import LOST, Comparison, Result, assess


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=lambda word: Path(word).resolve())
    parser.add_argument("--cases", type=int, default=300, help="how many")
    parser.add_argument("--first", type=int, default=1, help="number of the first case")
    parser.add_argument("--only", type=lambda words: list(map(int, words.split(","))), help="these cases")
    parser.add_argument("--search", type=Path, help="global search for the equilibria of refused cases")
    parser.add_argument("--fixed", action="store_true", help="the same cases with fixed pads")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--compare", type=float, default=0.5, help="share compared with a finer run")
    parser.add_argument("--keep", type=Path, default=Path("build/stress"), help="folder for cases that fail")
    parser.add_argument("--record", type=Path, help="results so far; what is in it is not run again")
    parser.add_argument("--flutter", action="store_true", help="also a fluttering pad over the speed")
    parser.add_argument("--searches", action="store_true", help="also which search finds what")
    parser.add_argument("--report", type=Path, help="Markdown page to write")
    parser.add_argument("--verbose", action="store_true", help="a line for every case")
    return parser.parse_args()


def run(options: argparse.Namespace, number: int, known: dict[int, Result]) -> Result:
    """Draws, runs and judges one case in a folder of its own, if its result is not known."""
    if number in known:
        return known[number]
    case = draw(options.seed, number, options.fixed)
    compare = Dice(f"compare {options.seed}/{number}").chance(options.compare)
    folder = Path(tempfile.mkdtemp(prefix="tiltpad-stress-"))
    try:
        search = options.search and options.search.resolve()
        lost = number in LOST.get(options.seed, ()) and not options.fixed
        result = assess(options.program, number, case, folder, compare, search, lost)
    finally:
        shutil.rmtree(folder)
    if result.faults:
        keep(options, result)
    if options.record:
        record(options, result)
    return result


def keep(options: argparse.Namespace, result: Result) -> None:
    """Writes a case that failed, with what was wrong, as a namelist."""
    options.keep.mkdir(parents=True, exist_ok=True)
    words = "".join(f"! {fault}\n" for fault in result.faults)
    (options.keep / f"seed{options.seed}_{result.number}.nml").write_text(words + text(result.case))


def record(options: argparse.Namespace, result: Result) -> None:
    """Adds a line of JSON to the record; the case itself is drawn again."""
    values = {"seed": options.seed, "fixed": options.fixed} | asdict(result)
    del values["case"]
    with options.record.open("a") as file:
        file.write(json.dumps(values, default=float) + "\n")


def recorded(options: argparse.Namespace) -> dict[int, Result]:
    """The results in the record."""
    known: dict[int, Result] = {}
    if not options.record or not options.record.exists():
        return known
    for line in options.record.read_text().splitlines():
        values = json.loads(line)
        if (values.pop("seed"), values.pop("fixed")) != (options.seed, options.fixed):
            continue
        number = values["number"]
        known[number] = Result(case=draw(options.seed, number, options.fixed), **values)
        if values["comparison"]:
            known[number].comparison = Comparison(**values["comparison"])
    return known


def tell(result: Result, verbose: bool) -> None:
    """A line for a case that failed, or for every case."""
    for fault in result.faults:
        print(f"FAILED: case {result.number}: {fault}", flush=True)
    if verbose:
        error = f", {result.comparison}" if result.comparison else ""
        said = result.message.removeprefix("tiltpad: error: ")
        print(f"{result.number}: {result.outcome}, {result.steps} steps, {result.revolutions:.2f} rev, "
              f"{result.seconds:.2f} s {said}{error}", flush=True)  # fmt: skip


def main() -> int:
    options = arguments()
    started = time.monotonic()
    results, known = [], recorded(options)
    with ThreadPoolExecutor(options.jobs) as pool:
        numbers = options.only or range(options.first, options.first + options.cases)
        for result in pool.map(lambda number: run(options, number, known), numbers):
            tell(result, options.verbose)
            results.append(result)
    summary = page(results, options.seed)
    if options.flutter:
        summary += flutter(options.program, options.jobs)
    if options.searches:
        summary += searches(options.program, options.jobs)
    if options.report:
        options.report.write_text(summary)
    else:
        print(summary)
    failed = sum(bool(result.faults) for result in results)
    print(f"{time.monotonic() - started:.0f} s")
    print(f"{len(results) - failed} passed, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
