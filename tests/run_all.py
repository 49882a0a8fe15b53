"""Runs every test program and the Python tests, and ends with "N passed, N failed" over all of them.

One more runs at a time than there are processors, as some wait for disks. The slowest tests are listed.

usage: run_all.py TEST-PROGRAM...
TILTPAD: the program under test. ONLY=NAME: of the test programs the cases whose "program:case" contains
NAME, of the Python tests those that pytest -k NAME takes.
"""

import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

TESTS = Path(__file__).parent
ONLY = os.environ.get("ONLY", "")
#: How many of the slowest tests are listed; shorter ones than this, s, never are.
SLOWEST, SHORT = 25, 0.5
#: Files of tests that one process runs: starting Python and runs that tests share take as long as many tests.
TOGETHER = 12
#: Files that take longest: each is a job of its own and starts first, so that none is left alone at the end.
LONG = ("cases/test_blocks", "post/test_tutorial", "cases/test_command_faults", "cases/test_fault_sample",
        "cases/test_checkpoint", "cases/test_branch_stops", "post/test_damaged", "post/test_hostile",
        "post/test_literal_texts", "post/test_machine", "post/test_fit",
        "cases/test_realistic_refusals")  # fmt: skip
#: A test that hangs shows where, and ends the others of its process.
PYTEST = ["-m", "pytest", "-q", "-p", "no:cacheprovider", "--durations=0", f"--durations-min={SHORT}",
          "-o", "faulthandler_timeout=900", "-o", "faulthandler_exit_on_timeout=true"]  # fmt: skip
#: What pytest says of a test's time, and all that it says of times.
DURATION = re.compile(r"^([\d.]+)s (?:call|setup|teardown) +(\S.*)\n", re.M)
TIMES = re.compile(rf"^=+ slowest durations =+\n|{DURATION.pattern}|\n?^\(\d+ durations < .*\n", re.M)
COUNTS = re.compile(r"(\d+) passed, (\d+) failed")


def jobs(programs):
    """Each job's name and command; programs, which are the shortest, come last."""
    python = [sys.executable, *PYTEST, *(["-k", ONLY] if ONLY else [])]
    groups = [[TESTS / f"{name}.py"] for name in LONG]
    for folder in ("cases", "post"):
        files = [file for file in TESTS.glob(f"{folder}/test_*.py") if [file] not in groups]
        files.sort(key=lambda file: -file.stat().st_size)
        count = -(-len(files) // TOGETHER)
        groups += [files[first::count] for first in range(count)]
    for group in groups:
        names = [str(file.relative_to(TESTS.parent)) for file in group]
        yield " ".join(names), [*python, *names]
    for program in programs:
        yield Path(program).name, [program]


def perform(name, command):
    """Whatever a job wrote, and the seconds of its tests by their names."""
    start = time.monotonic()
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "errors": "replace"}
    done = subprocess.run(command, cwd=TESTS.parent, **pipes)
    seconds = {}
    for spent, test in DURATION.findall(done.stdout):
        seconds[test] = seconds.get(test, 0) + float(spent)
    if command[0] != sys.executable:
        seconds[name] = time.monotonic() - start
    return TIMES.sub("", done.stdout), seconds


def main(programs):
    if not programs:
        sys.exit("no test program is given")
    passed = failed = 0
    seconds = {}
    with ThreadPoolExecutor(len(os.sched_getaffinity(0)) + 1) as pool:
        started = {pool.submit(perform, *job): job[0] for job in jobs(map(os.path.abspath, programs))}
        for job in as_completed(started):
            log, spent = job.result()
            seconds |= spent
            counts = COUNTS.fullmatch(log.rstrip().rpartition("\n")[2])
            if counts and ONLY and counts[0] == "0 passed, 0 failed":
                continue
            print(f"== {started[job]}\n{log}", end="", flush=True)
            if counts:
                passed += int(counts[1])
                failed += int(counts[2])
            else:
                print(f"FAILED: {started[job]} ended without a count of its tests")
                failed += 1
    print("\nThe tests that took longest:")
    for name in sorted(seconds, key=seconds.get, reverse=True)[:SLOWEST]:
        if seconds[name] >= SHORT:
            print(f"{seconds[name]:8.1f} s  {name}")
    if ONLY and passed + failed == 0:
        print(f"no test has {ONLY} in its name")
    print(f"\n{passed} passed, {failed} failed")
    sys.exit(not passed or failed > 0)


main(sys.argv[1:])
