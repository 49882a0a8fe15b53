"""The paper, reproduced: runs all cases, draws counterparts of its figures, checks its claims.

usage: python -m paper TILTPAD [--folder FOLDER] [--docs FOLDER] [--keep]

Writes the pictures, checks.csv and README.md, the page, into the docs folder.
"""

import argparse
import io
import os
import subprocess
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
from tiltpad.draw.plots import STYLE
from tiltpad.files.processes import begin_worker
from tiltpad.files.writing import write, write_csv

from paper import laws, lost, settings, sticking, studies
from paper.claims import check
from paper.figures import FIGURES
from paper.judging import Checked
from paper.machine import machine
from paper.page import page
from paper.runs import Runs, run_all
from paper.settings import ROOT

#: Folders of the runs, with their cases: those of figures and claims; again with a finer film and by rule
#: (26); and the studies'.
FOLDERS = {
    "paper": tuple(map(settings.kept, settings.CASES)),
    "refined": tuple(map(settings.refined, settings.CASES)),
    "rule": tuple(map(settings.balanced, settings.CASES)),
    "studies": (*studies.CASES, *sticking.CASES, *lost.CASES),
}
#: Pictures by their file's name, with the folder of their runs.
PICTURES: dict[str, tuple[Callable, str]] = {
    **{f"fig{name}": (draw, "paper") for name, draw in (laws.FIGURES | FIGURES).items()},
    **{name: (draw, "paper") for name, draw in studies.REUSED.items()},
    **{name: (draw, "studies") for name, draw in (studies.FIGURES | sticking.FIGURES | lost.FIGURES).items()},
}


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(prog="paper", description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=lambda word: Path(word).resolve())
    parser.add_argument("--folder", type=Path, default=Path("build/paper"), help="for the result files")
    parser.add_argument("--docs", type=Path, default=ROOT / "docs/paper", help="where page and pictures go")
    parser.add_argument("--keep", action="store_true", help="run nothing, take the results that are there")
    return parser.parse_args()


def draw(name: str, folder: Path, docs: Path) -> None:
    """One picture."""
    mpl.use("agg")
    picture, runs = PICTURES[name]
    with plt.style.context(STYLE), Runs(folder / runs) as found:
        fig = picture(found)
        content = io.BytesIO()
        fig.savefig(content, dpi=200)
        write(docs / f"{name}.png", content.getbuffer())
        plt.close(fig)


def write_checks(checked: list[Checked], path: Path) -> None:
    """The check table, a row a claim."""
    rows = [("where", "claim", "measured", "number", "sense", "limit", "holds", "refined", "rule_26")]
    for each in checked:
        claim, verdict = each.claim, each.verdict
        holds = "pass" if verdict.holds else "fail"
        numbers = f"{verdict.value:.6g}", verdict.sense, f"{verdict.limit:g}", holds
        others = (f"{other.value:.6g}" for other in (each.refined, each.rule))
        rows.append((claim.where, claim.statement, claim.measure, *numbers, *others))
    write_csv(path, rows)


def main() -> None:
    options = arguments()
    started = time.monotonic()
    options.docs.mkdir(parents=True, exist_ok=True)
    if not options.keep:
        jobs = [(case, options.folder / name) for name, cases in FOLDERS.items() for case in cases]
        os.environ["TILTPAD"] = str(options.program)
        with ThreadPoolExecutor(1) as beside:
            marches = beside.submit(lost.march_up_and_down, options.folder / "studies")
            run_all(options.program, jobs)
            marches.result()
        print(f"{len(jobs)} runs: {time.monotonic() - started:.0f} s", flush=True)
    with ProcessPoolExecutor(initializer=begin_worker) as pool:
        drawn = [pool.submit(draw, name, options.folder, options.docs) for name in PICTURES]
        paper, refined, rule, studied = (Runs(options.folder / name) for name in FOLDERS)
        checked = check(paper, refined, rule)
        for each in drawn:
            each.result()
    write_checks(checked, options.docs / "checks.csv")
    version = subprocess.check_output([options.program, "--version"], text=True).strip()
    spent = None if options.keep else time.monotonic() - started
    text = page(checked, paper, studied, machine(version, spent))
    write(options.docs / "README.md", text)
    failed = [each for each in checked if not each.verdict.holds]
    for each in failed:
        print(f"does not hold: {each.claim.where}: {each.claim.statement}")
    print(f"{len(checked)} claims, {len(failed)} do not hold; {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()
