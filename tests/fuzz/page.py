"""The page that says what fuzzing found."""

import re
import subprocess
from pathlib import Path

from campaign import Campaign
from commands import LIMIT

SOURCES = (
    "input/namelist_text",
    "input/case_namelist",
    "input/assignments",
    "input/parameter_study",
    "input/study_variables",
    "input/read_files",
    "input/namelist_writer",
    "input/case_fields",
    "input/variable_table",
)

PAGE = """\
# Fuzzing

{cases} cases and commands in {minutes:.0f} minutes (seed {seed}): **{found}**. This command wrote the page:

    make fuzz MINUTES={minutes:.0f} SEED={seed}

The test draws each case as a random case or makes it from earlier cases. The program's reader reads it,
and the test judges the result:

- **valid** cases in any spelling (blanks, comments, commas, line ends, repeats, subscripts, exponents,
  quotes, capitals, order, `--set`) must be accepted with exactly the intended values;
- **faults** of a known kind, one in each otherwise valid case, must be refused by one line that names the
  position and the faulty text;
- **changed** cases are earlier cases with changed bytes, or parts of several cases. The reader must accept
  or refuse them as a second reader does, which was written in Python from the documentation alone. The test
  keeps a case for further changes if it reaches a part of the reader that no case reached before, or
  reaches it a new number of times.

A refusal is exit status 1 and one printable line of limited length that says where the error is. If a case
is accepted, the program prints it, and reading this text must give the same text again. A study must have
the number of runs that the second reader counts, and the runs must have the values that it finds. If
there is no answer within {limit:g} s, the test counts a hang.

**Tables** of the values of a study are drawn in any spelling (quotes, blanks, line ends), and most of them
changed in some bytes. A second reader of tables judges them in the same way.

**Commands** run the program itself, with any bytes after `--set`, any names of cases and results, and
options in any order and number. The `extremes` are short runs of cases at the limits of the allowed
ranges, which must be completed or end with one line within {command:g} s. Reader and program are built with
bounds checks, floating-point traps and the sanitizers for addresses and undefined behaviour (the `extremes`
run without sanitizers).

**Damaged results** are tried by `make test` (`tests/post/damages.py`): results, checkpoints, runs of
studies, and studies with flipped bits, other blocks, very large numbers in their structure, other lengths,
and other objects and attributes in place of theirs. Every reader in Python, and the program, must give values
or one line, within 5 s of the processor's time and 500 MB, and leave nothing behind.
`TILTPAD_DAMAGES=3000 make test ONLY=damage_is` tries more of them.

| kind | number |
|---|---|
{counts}

The cases reached these parts of the reader's lines:

| file | lines | reached |
|---|---|---|
{coverage}

`tests/fuzz/seeds.jsonl` keeps {seeds} cases: every finding so far, and the few cases that together reach
all parts that any case reached. `make test` reads them again and draws some new ones.
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
