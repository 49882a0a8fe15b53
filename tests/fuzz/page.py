"""The page that says what fuzzing found."""

import re
import subprocess
from pathlib import Path

from campaign import Campaign
from commands import LIMIT

SOURCES = (
    "input/namelist_text",
    "input/scene_namelist",
    "input/assigned_values",
    "input/number_syntax",
    "input/sweep",
    "input/namelist_writer",
    "input/scene_fields",
    "input/field_visitor",
)

PAGE = """\
# Fuzzing

{cases} cases and commands in {minutes:.0f} minutes (seed {seed}): **{found}**. Written by

    make fuzz MINUTES={minutes:.0f} SEED={seed}

A case is drawn as a scene or made from earlier cases, read by the program's reader, and judged:

- **valid** scenes in any spelling (blanks, comments, commas, line ends, repeats, subscripts, exponents,
  quotes, capitals, order, `--set`) must be accepted with the intended values to the last bit;
- **faults** of a known kind, one in an otherwise valid case, must be refused by one line that names
  place and culprit;
- **changed** cases, byte by byte or spliced, those kept that reach a part or a count of the reader's
  flow that none reached before, must be accepted or refused as a second reader does, written in Python
  from the documentation alone.

A refusal is exit status 1 and one printable line of bounded length that says where. A case that is
accepted is printed, and what is printed must read back to itself. A sweep must have the number of
members that the second reader counts, and these its values. No answer within {limit:g} s is a hang.

**Commands** run the program itself: `--set` with any bytes, names of cases and results, options in any
order and number; and, as `extremes`, short runs of scenes at the limits of what is allowed, which must
end well or with one line, within {command:g} s. Reader and program are built with bounds checks,
floating-point traps and the sanitizers for addresses and undefined behaviour (the runs without
sanitizers).

| what | how many |
|---|---|
{counts}

Lines of the reader that were reached:

| file | lines | reached |
|---|---|---|
{coverage}

{seeds} cases are kept in `tests/fuzz/seeds.jsonl`: every finding ever made, and the few that together
reach what all of them did. `make test` reads them again and draws some new ones.
{findings}"""


def page(campaign: Campaign, seed: int, minutes: float, objects: Path) -> str:
    """The page, Markdown."""
    counts = {key: n for key, n in sorted(campaign.count.items()) if key != "found again"}
    rows = "\n".join(f"| {key} | {n} |" for key, n in counts.items())
    found = "".join(f"\n- {each.what}" for each in campaign.found.values())
    return PAGE.format(
        cases=sum(counts.values()),
        minutes=minutes,
        seed=seed,
        found=f"{len(campaign.found)} findings" if found else "nothing found",
        limit=campaign.harness.limit,
        command=LIMIT,
        counts=rows,
        coverage="\n".join(lines(objects, source) for source in SOURCES),
        seeds=counts.get("seed", 0),
        findings=f"\n## Findings\n{found}\n" if found else "",
    )


def lines(objects: Path, source: str) -> str:
    """A row of the table of lines reached, by gcov."""
    path = f"src_f90/{source}.f90"
    said = subprocess.run(["gcov", "-n", "-o", objects, path], capture_output=True, text=True).stdout
    share = re.search(rf"File '[^']*{source}\.f90'\nLines executed:([\d.]+)% of (\d+)", said)
    return f"| `{path}` | {share[2]} | {share[1]} % |" if share else f"| `{path}` | ? | ? |"
