"""The page: the paper's statements beside the pictures and the checks. Every number comes from the runs."""

from collections.abc import Sequence

from paper import lost, settings, sticking, studies
from paper.judging import Checked
from paper.reasons import WHY
from paper.runs import Runs
from paper.sections import SECTIONS, Section
from paper.tables import digits, table

#: Of the settings `s` it takes the numbers themselves.
PAGE = """\
# The paper, reproduced

Š. Dyk, J. Rendl, R. Bulín, L. Smolík, *Influence of detailed ball-and-socket modelling on tilting pad
journal bearings dynamics*, Nonlinear Dynamics (2023), CC BY 4.0. `make paper` writes this page: all its
numbers are calculated from runs of the program, except those that are quoted from the paper.
[checks.csv](checks.csv) has all checks.

{machine}

**The page checks {count} claims: {good} hold, {bad} do not.** *Claims that do not hold* gives the reasons.
{failed}

One number decides a claim. It is taken over the last {s.LAST} revolutions, for pad 1, and from runs of 2 s at
6500 rpm, unless the claim names others. A number counts as larger or smaller if the difference is more than
{s.RESOLUTION:.0%}, ten times the limit of the error of the default settings ([benchmarks](../benchmarks.md)).
Orbits agree if their maximum distance at the same shaft angle is below {s.AGREEMENT:.0%} of their size. A pad
sticks while its pivot slides slower than 5 % of the Stribeck velocity; it comes to rest if it sticks
{s.STICKS:g} times as long as a sinusoid of the same amplitude would. Two columns have the same number from
other runs: *refined* with {refined} and, except for the run-ups, `{s.SHORT}`; *rule (26)* with the unbalance
that the rule of the paper gives for G 6.3, {unbalance} kg m at 6500 rpm. All pictures and verdicts have the
unbalance of Table 1 of the paper, 0.010 kg m.

{sections}

## Claims that do not hold

{why}

{rule}

# Beyond the paper

## Friction work

Friction dissipates energy of the tilting motion. Its work per revolution and its mean
power in each pivot are measures of fretting. The picture shows them in the run-ups (unbalance of Table 1):

![Friction work per revolution and mean power over speed](work.png)

The table gives the values at 6500 rpm:

{work}

## Stick map

The map is for Bengisu-Akay friction with f_d = f_s/2 and the unbalance of rule (26) for each speed. It shows
the time in which pad 1 sticks, and the friction power of both pads. White points are runs.

![Stick fraction and friction power over speed and friction coefficient](map.png)

The table gives the time in which pad 1 sticks, in %:

{map}

{map_words}

## Pivot deflection factor and Hertz's law

Eq. (13) as printed has the factor 4; with 2 pi the law agrees with Hertz's law for small contacts. The
pictures show the difference in Fig. 4, for the pivot of the bearing (grey: the load of its frictionless
orbit), and in Fig. 10. Hertz's law is not defined for dR = 0.

![Force over pivot deflection by contact law](laws4.png)

![Orbit, tilt and tilt rate by contact law](laws.png)

{laws}

## Unbalance rule

The unbalance of rule (26) depends on the balance grade and on a speed: that of the run, or the maximum
speed of the machine. The unbalance of Table 1 of the paper corresponds to G {grade}.

![Size of the orbit over balance grade and over speed](rule.png)

{rule_table}

{rule_words}

## Pads that stick, and stability

The stiffness and damping of a tilting pad bearing are calculated with pivots that slide freely: the pads
then follow the journal, hardly any cross-coupled stiffness is left, and rotors are stable. A small
vibration does not move a pivot with friction, however. Its bristles carry the moment of the film (LuGre),
the pad follows the journal no more than a fixed one would, and the bearing has the cross-coupled stiffness
of a fixed bearing: at {told} rpm {cross} MN/m beside a direct stiffness of {direct} MN/m. The left picture
shows the damping ratio of the least damped mode on pads that stick (the task `coefficients`; {runs} runs),
with the threshold speeds of stability for pivots that stick and that are locked; those of pivots that slide
lie to the right of it. The right picture shows how the threshold speed of the paper's rotor falls to that of
locked pads as the bristles become stiffer.

![Damping ratio over speed and mass; threshold speed over bristle stiffness](stability.png)

{thresholds}

Marches with LuGre friction, without unbalance, from a displacement of 0.2 um confirm the threshold speed on
both sides:

![Journal below and above the threshold speed](whirl.png)

{whirl_words}

Pivot friction thus drives whirl that an analysis with free pivots does not see, and it limits this whirl
itself. Friction whose bristles are soft, or a pivot that rolls instead of sliding, keeps the rotor stable.

## Where friction makes the bearing lose its synchronous orbit

The task `branch` follows the orbit that repeats every revolution over the speed, from {first} to {last_speed}
rpm, with both laws of friction and f_d = f_s/2, stable or not. The left pictures show its leading
multiplier with the unbalance of Table 1: above 1 a disturbance grows with each revolution. The bars of the
right pictures are the speeds at which the orbit is unstable.

![Leading multiplier over speed; unstable speeds over friction coefficient](lost.png)

{lost_table}

{lost_words} A small unbalance leaves the pads sticking, and the orbit is lost near the threshold speed of
stability of pads that stick (above). A larger one makes them slide in each revolution, and may keep its
orbit up to higher speeds.

## The four-pad bearing: orbits of two revolutions

The upper pads of the four-pad bearing ([input/examples](../../input/README.md)) carry no load and flutter
near half the shaft speed. The picture shows the branch of its synchronous orbit and one of orbits of two
revolutions, with marches of 150 revolutions each, up and down the speed and each from the end of the one
before: grey are the lowest and highest values of their last 50 revolutions.

![Branches of the four-pad bearing over the speed, over marches](doubling.png)

{doubling_words}
"""

#: Introduction to the claims that change with the unbalance.
RULE_WORDS = """\
With the unbalance of rule (26) the orbits are larger (*Unbalance rule* below) and drive the pads harder. The
pads then move faster than 1e-3 m/s and come to rest even with this v_c, and the journal comes nearer to the
upper pads. These verdicts change:"""


def page(checked: Sequence[Checked], paper: Runs, studied: Runs, machine: str) -> str:
    """The page as Markdown."""
    failed = [each for each in checked if not each.verdict.holds]
    return PAGE.format(
        machine=machine,
        count=len(checked),
        good=len(checked) - len(failed),
        bad=len(failed),
        failed=failed_words(failed),
        s=settings,
        refined=", ".join(f"`{word}`" for word in settings.REFINED),
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
        told=sticking.TOLD_SPEED,
        cross=digits(sticking.stuck_stiffness(studied, 0, 1)),
        direct=digits(sticking.stuck_stiffness(studied, 0, 0)),
        runs=len(sticking.STICK_MASSES) * len(sticking.STICK_SPEEDS),
        thresholds=sticking.threshold_table(studied),
        whirl_words=sticking.whirl_words(studied),
        first=lost.LOST_SPEEDS[0],
        last_speed=lost.LOST_SPEEDS[1],
        lost_table=lost.lost_table(studied),
        lost_words=lost.lost_words(studied),
        doubling_words=lost.doubling_words(studied),
        grade=digits(studies.equivalent_grade(paper["steady_tr"]), 2),
    )


def failed_words(failed: Sequence[Checked]) -> str:
    """Which claims fail."""
    lines = ["These claims do not hold:", "", *(f"- {short(each)}" for each in failed)]
    return "\n".join(lines) if failed else ""


def section_text(section: Section, checked: Sequence[Checked]) -> str:
    """Heading, pictures, statement and checks."""
    pictures = [f"![{caption}](fig{name}.png)" for name, caption in section.pictures.items()]
    rows = [row(each) for each in checked if each.claim.where in section.where]
    head = "claim", "measured", "number", "must be", "holds", "refined", "rule (26)"
    words = f"> {section.quote}", section.note, table(head, rows) if rows else ""
    parts = [f"## {section.title}", *pictures, *words]
    return "\n\n".join(part for part in parts if part)


def row(each: Checked) -> tuple[str, ...]:
    """A line of the check table."""
    claim, verdict, others = each.claim, each.verdict, (each.refined, each.rule)
    limit = f"{verdict.sense} {verdict.limit:g}"
    said = "yes" if verdict.holds else "**no**"
    more = (f"{digits(other.value, 4)}{'' if other.holds else ' (no)'}" for other in others)
    return (claim.statement, claim.measure, digits(verdict.value, 4), limit, said, *more)


def why(failed: Sequence[Checked], runs: Runs) -> str:
    """The reasons why claims fail, each once."""
    if not failed:
        return "All claims hold."
    texts = []
    for name in dict.fromkeys(each.claim.name for each in failed):
        same = [each for each in failed if each.claim.name == name]
        texts.append("\n".join(f"- {short(each)}; refined {digits(each.refined.value)}" for each in same))
        if any(each.refined.holds for each in same):
            texts.append("The claim holds in the refined runs: the reason is the numerics.")
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
    limits = (f"(must be {each.rule.sense} {each.rule.limit:g})" for each in changed)
    found = (f"- {short(each)}, by the rule {digits(each.rule.value)}" for each in changed)
    lines = map(" ".join, zip(found, limits, strict=True))
    return "\n".join([RULE_WORDS, "", *lines])
