"""The page: the paper's statements beside the pictures and the checks. Every number comes from the runs."""

from collections.abc import Sequence

from paper import studies
from paper.judging import Checked
from paper.reasons import WHY
from paper.runs import Runs
from paper.sections import CAPTIONS, SECTIONS, Section
from paper.settings import AGREEMENT, LAST, REFINED, RESOLUTION, RESTS, SHORT
from paper.tables import digits, table

PAGE = """\
# The paper, reproduced

Š. Dyk, J. Rendl, R. Bulín, L. Smolík, *Influence of detailed ball-and-socket modelling on tilting pad
journal bearings dynamics*, Nonlinear Dynamics (2023), CC BY 4.0. Written by `make paper` from the program's
own runs; no number on this page was typed in but those that the paper says. All checks:
[checks.csv](checks.csv).

{machine}

**{count} claims checked: {good} hold, {bad} do not.** Why: *Where a claim does not hold* below. {failed}

Every claim is decided by one number over the last {last} revolutions (of 2 s at 6500 rpm, or as said) of
pad 1. A number is larger or smaller if it is so by {resolution}, ten times the error that the default
settings are held to ([benchmarks](../benchmarks.md)). Orbits whose greatest distance at the same shaft
angle is below {agreement} of their size agree. A pad sticks while its pivot slides slower than 5 % of the
Stribeck velocity; it comes to rest where it does so {rests:g} times as long as a sinusoid of the same
amplitude would. Beside the number stand two more, from the same runs again: *refined* with {refined} and,
but for the run-ups, {short}; and *rule (26)* with the unbalance that the paper's rule gives for G 6.3,
where the paper's Table 1, which all pictures and verdicts here take, says 0.010 kg m (the rule:
{unbalance} kg m at 6500 rpm).

{sections}

## Where a claim does not hold

{why}

{rule}

# Beyond the paper

## Friction work

Friction takes energy out of the tilting motion: work per revolution and mean power over each pivot, what
fretting is judged by. The run-ups (unbalance of Table 1):

![Friction work per revolution and mean power over speed](work.png)

At 6500 rpm:

{work}

## Stick map

Bengisu-Akay, f_d = f_s/2, unbalance by rule (26) for each speed: the time in which pad 1 sticks, and the
friction power of both pads. White points are runs.

![Stick fraction and friction power over speed and friction coefficient](map.png)

Time in which pad 1 sticks, %:

{map}

{map_words}

## Penetration factor and Hertz's law

Eq. (13) as printed has the factor 4; 2 pi meets Hertz's approach for small contacts. What this changes in
Fig. 4, for the pivot of the bearing (grey: the load of its frictionless orbit), and in Fig. 10 (Hertz's law
knows no dR = 0):

![Force over penetration by contact law](laws4.png)

![Orbit, tilt and tilt rate by contact law](laws.png)

{laws}

## Unbalance rule

Rule (26) with the grade of the balance, and with the speed that it takes: each speed its own, or the
highest one of the machine. Table 1 of the paper stands at G {grade}.

![Size of the orbit over balance grade and over speed](rule.png)

{rule_table}

{rule_words}
"""

#: What is said before the claims that change with the unbalance.
RULE_WORDS = """\
With the unbalance of rule (26) the orbits are larger (*Unbalance rule* below), the pads are driven harder,
faster than 1e-3 m/s, so that they come to rest even with that v_c, and the journal comes nearer the upper
pads. These verdicts change:"""


def page(checked: Sequence[Checked], paper: Runs, studied: Runs, machine: str) -> str:
    """The page as Markdown."""
    failed = [each for each in checked if not each.verdict.holds]
    return PAGE.format(
        machine=machine,
        count=len(checked),
        good=len(checked) - len(failed),
        bad=len(failed),
        failed=failed_words(failed),
        last=LAST,
        resolution=f"{RESOLUTION:.0%}",
        agreement=f"{AGREEMENT:.0%}",
        rests=RESTS,
        refined=", ".join(f"`{word}`" for word in REFINED),
        short=f"`{SHORT}`",
        sections="\n\n".join(section_text(each, checked) for each in SECTIONS),
        why=why(failed, paper),
        rule=rule_changes(checked),
        unbalance=digits(studies.ruled_unbalance(paper["steady_tr"])),
        work=studies.work_table(paper),
        map=studies.map_table(studied),
        map_words=studies.map_words(studied),
        laws=studies.laws_table(studied),
        rule_table=studies.rule_table(studied),
        rule_words=studies.rule_words(studied),
        grade=digits(studies.equivalent_grade(paper["steady_tr"]), 2),
    )


def failed_words(failed: Sequence[Checked]) -> str:
    """Which claims fail."""
    return "\n".join(["These do not:", "", *(f"- {short(each)}" for each in failed)]) if failed else ""


def section_text(section: Section, checked: Sequence[Checked]) -> str:
    """Heading, pictures, statement and checks."""
    pictures = [f"![{CAPTIONS[name]}](fig{name}.png)" for name in section.pictures]
    rows = [row(each) for each in checked if each.claim.where in section.where]
    head = "claim", "measured", "number", "must be", "holds", "refined", "rule (26)"
    parts = [
        f"## {section.title}",
        *pictures,
        f"> {section.quote}",
        section.note,
        table(head, rows) if rows else "",
    ]
    return "\n\n".join(part for part in parts if part)


def row(each: Checked) -> tuple[str, ...]:
    """A line of the check table."""
    verdict = each.verdict
    limit = f"{verdict.sense} {verdict.limit:g}"
    others = (
        f"{digits(other.value, 4)}{'' if other.holds else ' (no)'}" for other in (each.refined, each.rule)
    )
    return (
        each.claim.statement,
        each.claim.measure,
        digits(verdict.value, 4),
        limit,
        said(verdict.holds),
        *others,
    )


def said(holds: bool) -> str:
    return "yes" if holds else "**no**"


def why(failed: Sequence[Checked], runs: Runs) -> str:
    """What is said of the claims that fail, each reason once."""
    if not failed:
        return "All of them do."
    texts = []
    for name in dict.fromkeys(each.claim.name for each in failed):
        same = [each for each in failed if each.claim.name == name]
        texts.append("\n".join(f"- {short(each)}; refined {digits(each.refined.value)}" for each in same))
        if any(each.refined.holds for each in same):
            texts.append("The refined runs say otherwise: the numerics.")
        else:
            texts.append(WHY[name](runs) if name in WHY else "Not explained yet.")
    return "\n\n".join(texts)


def short(each: Checked) -> str:
    """A claim with its number."""
    return f"{each.claim.where}: {each.claim.statement}: {digits(each.verdict.value)}"


def rule_changes(checked: Sequence[Checked]) -> str:
    """Claims on which the unbalance decides."""
    changed = [each for each in checked if each.rule.holds != each.verdict.holds]
    if not changed:
        return "With the unbalance of rule (26) no verdict changes."
    lines = [
        f"- {short(each)}, by the rule {digits(each.rule.value)} "
        f"(must be {each.rule.sense} {each.rule.limit:g})"
        for each in changed
    ]
    return "\n".join([RULE_WORDS, "", *lines])
