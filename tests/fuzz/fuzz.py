"""Fuzzes cases and --set, in the reader alone and in the program: no crash, no hang, nothing passes unseen.

usage: fuzz.py HARNESS TILTPAD RUNNER [--minutes M] [--seed S] [--seeds FILE] [--keep FOLDER] [--report FILE]

The harness is tests/fuzz/fuzz_input.f90; the runner is the program again, built without sanitizers, as whole
runs are too slow with them. Findings, each as small as it goes, and the cases that together
reach what all cases reached are kept in a folder, in the form of the seeds. The last line reads
"N passed, N failed".
"""

import argparse
import time
from pathlib import Path
from random import Random

import commands
import seeds
from campaign import Campaign, Finding, sort_of
from harness import Case, Harness
from page import page

# seconds of cases for the reader alone, then of commands, and so on
READER, COMMANDS = 50, 10


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("harness", type=lambda word: Path(word).resolve())
    parser.add_argument("program", type=lambda word: Path(word).resolve())
    parser.add_argument("runner", type=lambda word: Path(word).resolve())
    parser.add_argument("--minutes", type=float, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seeds", type=Path, default=Path(__file__).with_name("seeds.jsonl"))
    parser.add_argument("--keep", type=Path, default=Path("build/fuzz/kept"), help="folder for what is found")
    parser.add_argument("--report", type=Path, help="Markdown page to write")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    options.keep.mkdir(parents=True, exist_ok=True)
    objects = options.harness.parent.parent / "obj"
    for counts in objects.glob("*.gcda"):
        counts.unlink()
    started = time.monotonic()
    with Harness(options.harness) as harness:
        campaign = Campaign(harness, options.seed)
        for case, _ in seeds.load(options.seeds):
            campaign.check(case, "seed")
        while (left := options.minutes * 60 - (time.monotonic() - started)) > 0:
            campaign.run(min(READER, left))
            run_commands(campaign, options, min(COMMANDS, left))
            keep(options.keep / "found.jsonl", campaign.found.values())
            said = (
                f"{campaign.count.total()} cases, {len(campaign.corpus)} kept, {len(campaign.found)} findings"
            )
            print(f"{time.monotonic() - started:.0f} s: {said}", flush=True)
        harness.close()
        if harness.leaks:
            campaign.found["leak"] = Finding(Case(b""), "memory is never freed", harness.leaks)
            print(f"FOUND: {harness.leaks}", flush=True)
        minutes = (time.monotonic() - started) / 60
    smallest = few(options.harness, campaign.corpus)
    (options.keep / "corpus.jsonl").write_text("".join(seeds.line(case) for case in smallest))
    print(f"{len(smallest)} cases reach what all of them reached")
    if options.report:
        options.report.write_text(page(campaign, options.seed, minutes, objects))
    print(f"{campaign.count.total() - len(campaign.found)} passed, {len(campaign.found)} failed")
    return int(bool(campaign.found))


def run_commands(campaign: Campaign, options: argparse.Namespace, seconds: float) -> None:
    """Runs commands for this many seconds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        dice = Random(f"{campaign.seed}/{campaign.count.total()}")
        programs = options.program, options.runner
        kind, words, wrong = commands.one(dice, *programs, campaign.variables, campaign.corpus)
        campaign.count[f"command: {kind}"] += 1
        for what in wrong:
            if (sort := f"{kind}: {sort_of(what)}") not in campaign.found:
                # as a case, so that it can be kept: what stands behind < is the text
                text = words[-1] if b"<" in words else b""
                campaign.found[sort] = Finding(Case(text, tuple(words)), sort, what)
                print(f"FOUND: {kind}: {what[:300]}\n   {words!r:.1500}", flush=True)


def keep(path: Path, found) -> None:
    """Writes what was found."""
    path.write_text("".join(seeds.line(each.case, f"{each.what}; {each.said}"[:500]) for each in found))


def few(program: Path, corpus: list[Case]) -> list[Case]:
    """Those cases, the short ones first, that reach something that none before them did."""
    with Harness(program) as harness:
        ordered = sorted(corpus, key=lambda case: len(case.text) + sum(map(len, case.sets)))
        return [case for case in ordered if harness.read(case).news]


if __name__ == "__main__":
    raise SystemExit(main())
