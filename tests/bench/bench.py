"""Benchmark: run time against error, cases with the defaults, films, pads, orbits, studies, peers, oil.

usage: bench.py TILTPAD [--only PART...] [--folder FOLDER] [--docs FOLDER]

Writes benchmarks.csv, benchmarks.md and images/bench_*.png into the docs folder. With --only, the other
parts are taken from their last run, which FOLDER keeps.
"""

import argparse
import csv
import json
import subprocess
import tempfile
import time
from dataclasses import asdict, fields
from pathlib import Path

from cases import cases
from diagram import diagram, ladder
from elements import elements
from figures import draw
from films import films, pads
from growth import growth
from limits import limits
from machine import described
from machines import machines
from maps import maps
from orbits import orbits
from page import page
from peers import peers
from production import production
from runner import Row, Runner
from settings import ROOT
from skips import kernels, skips, visits
from slopes import slopes
from studies import studies
from turbulent import turbulent
from warm import warm

PARTS = {
    "ladder": ladder,
    "diagram": diagram,
    "cases": cases,
    "kernels": kernels,
    "films": films,
    "visits": visits,
    "skips": skips,
    "pads": pads,
    "growth": growth,
    "limits": limits,
    "orbits": orbits,
    "production": production,
    "studies": studies,
    "peers": peers,
    "maps": maps,
    "warm": warm,
    "turbulent": turbulent,
    "machines": machines,
    "elements": elements,
    "slopes": slopes,
}


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=lambda word: Path(word).resolve())
    parser.add_argument("--only", nargs="+", choices=PARTS, default=list(PARTS), help="parts to run")
    parser.add_argument(
        "--folder", type=Path, default=Path("build/bench"), help="for what is kept between runs"
    )
    parser.add_argument("--docs", type=Path, default=ROOT / "docs", help="where the page goes")
    return parser.parse_args()


def tell(row: Row, started: float) -> None:
    """A line for a run."""
    wall = f"{row.wall_seconds:.2f} s" if row.wall_seconds else "-"
    error = f"error {row.error:.1e}" if row.error is not None else ""
    words = (f"{time.monotonic() - started:5.0f} s", row.part, row.case, row.group, row.setting, wall, error)
    print("  ".join(word for word in (*words, row.note) if word), flush=True)


def measure(options: argparse.Namespace) -> None:
    """Runs the parts asked for and keeps their rows."""
    started = time.monotonic()
    version = subprocess.run([options.program, "--version"], text=True, capture_output=True, check=True)
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        runner = Runner(options.program, Path(folder))
        for name in (each for each in PARTS if each in options.only):
            runner.part, began, rows = name, time.monotonic(), []
            for row in PARTS[name](runner):
                tell(row, started)
                rows.append(asdict(row))
            kept = {
                "version": version.stdout.strip(),
                "date": time.strftime("%Y-%m-%d"),
                "seconds": time.monotonic() - began,
                "rows": rows,
            }
            (options.folder / f"{name}.json").write_text(json.dumps(kept))


def main() -> None:
    options = arguments()
    options.folder.mkdir(parents=True, exist_ok=True)
    measure(options)
    files = {name: options.folder / f"{name}.json" for name in PARTS}
    found = {name: json.loads(path.read_text()) for name, path in files.items() if path.exists()}
    rows = {name: [Row(**row) for row in found[name]["rows"]] if name in found else [] for name in PARTS}
    with (options.docs / "benchmarks.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([each.name for each in fields(Row)])
        writer.writerows(list(asdict(row).values()) for part in rows.values() for row in part)
    draw(rows, options.docs / "images")
    speed = options.folder / "speed.txt"
    text = page(rows, described(found), speed.read_text() if speed.exists() else "")
    (options.docs / "benchmarks.md").write_text(text)


if __name__ == "__main__":
    main()
