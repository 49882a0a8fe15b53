"""The page that says what injected faults did."""

import signal
from collections import Counter

from faulty_commands import COMMANDS, GRACE, LIMIT
from injector import ERRORS, KILLS, KINDS

#: As it is in the quoted text of a message.
NEWLINE = r"\n"
PAGE = """\
# Faults from outside

{faults} faults were injected (seed {seed}): **{found}**. This command wrote the page:

    make faults FAULTS={faults} SEED={seed}

A small library (`tests/faults/injector.c`), loaded before the system's own, counts the calls of a kind that
a command and its children make, and lets the k-th fail, or this one and all after it, or kills the process
there, or all processes of the command. Calls for files count where these are in the folder of the work;
memory and new processes count from the first file on that is opened there. Which call it is, and how it
fails, is drawn: anywhere in the run, or close to its begin or end. Each fault has a folder of its own. These
must hold:

- The command ends within {limit} s: with status 0 and the bits of the undisturbed command, or with one line
  and status 3 (of a study one line for each run that failed, and one for all). A Python command may also
  say in lines of warnings which results could not be read. It never ends by a signal of its own, and prints
  no traceback. None of its processes is left after {grace} s. How a Python command ends without memory is
  left to its libraries; what follows holds then, too.
- What was there before is there, byte for byte. The file that the command makes is the former one, the new
  one bit for bit, or a checkpoint, whose samples or points are the first of the undisturbed run, bit for bit.
- The next command, without a fault (`--resume`, or the same command again), ends with status 0. Its result is
  that of the undisturbed command, bit for bit; of a march that goes on from a checkpoint bit for bit up to
  there, and behind it within a hundredth of the largest value of each array, as CVODE starts anew. No part,
  no lock, no other file and no process is left.

`make test` injects some others (`tests/cases/test_fault_sample.py`). [security.md](security.md) says what is
promised.

## Commands and calls

Faults of each kind of call. Marches, periodic orbits and branches make a checkpoint at every step.

{table}

## How the commands ended

What was not reached is a call that the disturbed command did not make: the calls of several processes come
in any order.

{endings}

## What calls failed with

{errors}
{findings}"""


def page(outcomes: list, seed: int) -> str:
    """The page, Markdown."""
    bad = [each for each in outcomes if each.wrong]
    # without what a library says behind the first line
    lines = "\n".join(f"- {each.name}: {'; '.join(each.wrong)[:300].partition(NEWLINE)[0]}" for each in bad)
    return PAGE.format(
        faults=len(outcomes),
        seed=seed,
        limit=LIMIT,
        grace=GRACE,
        found=f"{len(bad)} findings" if bad else "nothing found",
        table=kinds_table(outcomes),
        endings=endings_table(outcomes),
        errors=errors_table(outcomes),
        findings=f"\n## Findings\n\n{lines}\n" if bad else "",
    )


def rows(head: list[str], body: list[list[object]]) -> str:
    """A table."""
    lines = [head, ["---"] * len(head), *body]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def kinds_table(outcomes: list) -> str:
    """How many faults of each kind of call each command got."""
    count = Counter((each.command.name, each.fault.kind) for each in outcomes)
    body = [
        [name, *(count[name, kind] or "" for kind in KINDS), sum(count[name, kind] for kind in KINDS)]
        for name in (command.name for command in COMMANDS)
    ]
    sums = [sum(count[command.name, kind] for command in COMMANDS) for kind in KINDS]
    return rows(["command", *KINDS, "all"], [*body, ["all", *sums, len(outcomes)]])


def endings_table(outcomes: list) -> str:
    """How the commands of each kind of fault ended."""
    ways = {"done": 0, "refused (3)": 3, "killed": -signal.SIGKILL}
    body = []
    for kind in (*KINDS, "all"):
        own = [each for each in outcomes if kind in (each.fault.kind, "all")]
        ends = [sum(each.status == status and each.reached for each in own) for status in ways.values()]
        body.append(
            [kind, *ends, sum(not each.reached for each in own), sum(bool(each.wrong) for each in own)]
        )
    return rows(["call", *ways, "not reached", "findings"], body)


def errors_table(outcomes: list) -> str:
    """How often each error stood for the result of a call."""
    count = Counter((each.fault.kind, each.fault.action) for each in outcomes)
    body = []
    for kind in KINDS:
        actions = dict.fromkeys((*ERRORS[kind], *KILLS))
        body.append([kind, ", ".join(f"{each} {count[kind, each]}" for each in actions if count[kind, each])])
    return rows(["call", "errors; `short` and `torn`: half of it is written (and then killed)"], body)
