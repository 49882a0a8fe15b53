"""The page: the paper's statements beside the pictures and the checks. Every number comes from the runs."""

import os
import platform
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from paper import studies
from paper.claims import WHY, Checked
from paper.runs import Runs
from paper.settings import AGREEMENT, LAST, REFINED, RESOLUTION, RESTS, SHORT
from paper.tables import digits, table


@dataclass(frozen=True)
class Section:
    """A part of the page: pictures, what the paper says, and the claims by where they stand."""

    title: str
    pictures: tuple[str, ...]
    quote: str
    where: tuple[str, ...] = ()
    note: str = ""


SECTIONS = (
    Section(
        "Figs. 3 and 4: contact",
        ("3", "4"),
        "the pressure field generated in the BS coupling is shown in Fig. 3. [...] The resulting force "
        "generated in the BS coupling for various radius differences is shown in Fig. 4. [...] It is "
        "supposed that the snug fit [...] is the stiffest option.",
        ("Fig. 4",),
        "Steel on steel, R_2 = 100 mm. The paper does not print the load of Fig. 3 and the radius "
        "differences of Fig. 4.",
    ),
    Section(
        "Fig. 6: friction laws",
        ("6",),
        "for gamma = 1, which is our setting, the resulting Stribeck curve is equal for both studied "
        "models, so the results are comparable.",
        ("Fig. 6",),
    ),
    Section(
        "Fig. 7: critical velocity",
        ("7",),
        "For v_c = 0.001 m/s only sliding friction occurs, while with lower values the friction sticking "
        "is more apparent.",
        ("Fig. 7",),
    ),
    Section(
        "Fig. 8: bristle stiffness",
        ("8",),
        "For lower sigma_0 almost no sticking occurs, while with higher sigma_0 the sticking phenomena "
        "together with presliding behaviour appear. [...] with a further increase of sigma_0 the results "
        "do not differ significantly and only the required CPU time increases.",
        ("Fig. 8", "Sec. 3.1"),
    ),
    Section(
        "Fig. 9: radial motion of the pads",
        ("9",),
        "the TO model yields smaller journal orbits than the TR model. At the same time, the orbits are "
        "located higher compared to the TR model. [...] the journal orbit gets larger in both cases "
        "[with friction]. [...] the larger influence of friction occurs in the TR case",
        ("Fig. 9", "Sec. 4.1"),
    ),
    Section(
        "Fig. 10: radius difference",
        ("10",),
        "the journal moves downwards significantly with the increasing radius difference [...] The "
        "peak-to-peak amplitudes of the tilting angle and velocity displacement increase with the radius "
        "difference [...] Therefore, the journal can perform larger orbital motions when the radius "
        "difference increases. [...] When friction is applied using the Bengisu-Akay model, the "
        "waveforms flatten due to the sticking phenomenon",
        ("Fig. 10",),
    ),
    Section(
        "Figs. 11, 12 and 13: friction coefficients",
        ("11", "12", "13"),
        "with the increasing values of friction coefficients, the journal orbit is slightly larger. "
        "[...] The journal orbits for both friction models are comparable in size and shape. [...] With "
        "the increase in friction coefficients, the sticking phenomenon areas are wider, and the "
        "amplitudes of the pad tilting velocities decrease. [...] the amplitude of the pad tilting "
        "velocity decreases more than in the case of the Bengisu-Akay friction model. [...] With a "
        "further increase of sigma_0, the resulting pad tilting velocity curve shape is getting closer "
        "to the results obtained using the Bengisu-Akay model.",
        ("Figs. 11-13", "Figs. 11-12", "Fig. 11", "Fig. 12", "Fig. 13"),
        "Above Bengisu-Akay, then LuGre with 1e6 1/m, then with 5e6 1/m. The paper does not print its "
        "friction pairs; these span its range.",
    ),
    Section(
        "Fig. 14: friction characteristics",
        ("14",),
        "The resulting curve exactly corresponds to the used Stribeck curve in the case of the "
        "Bengisu-Akay model, while in the case of the LuGre model, the hysteresis behaviour is present. "
        "The typical friction curve loops appear in the case of a higher sigma_0, while with the lower "
        "sigma_0 this phenomenon is not significant.",
        ("Fig. 14",),
    ),
    Section(
        "Section 4: low speed and small unbalance",
        (),
        "For lower speeds, small unbalance forces generate a small journal orbit and a small tilting "
        "motion of the pad. Hence, the pads remain in the sticking regime. Similarly, the lower "
        "unbalance causes a stick in the BS coupling concerning the given nominal rotor speed.",
        ("Sec. 4",),
        "Up to which speed they stay stuck, by friction coefficient: the map further down.",
    ),
    Section(
        "Section 3: the upper pads",
        ("pads",),
        "only two lower pads are considered, and we neglect the influence of upper pads. [...] the upper "
        "pads do not have a load-carrying function [...] and they are, under some conditions, even "
        "subjected to pad fluttering.",
        ("Sec. 3",),
        "LuGre 0.1/0.05, cavitation 'gumbel' in both runs.",
    ),
    Section(
        "Fig. 15: run-up",
        ("15",),
        "There is an apparent deviation in the journal trajectory for the LuGre model compared to the "
        "Bengisu-Akay model at lower rotor speed. A higher parameter value sigma_0 strengthens the "
        "deviation [...] However, the journal orbits at 6500 rpm are comparable. [...] the results for "
        "sigma_0 = 1e6 1/m are different from the Bengisu-Akay model and higher sigma_0 at lower rotor "
        "speed.",
        ("Fig. 15",),
        "Above the whole run (grey: the path with Bengisu-Akay friction), below it revolutions at low "
        "and at high speed.",
    ),
)

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

#: What the pictures show, for those who cannot see them.
CAPTIONS = {
    "3": "Contact pressure over the projected contact",
    "4": "Force over penetration",
    "6": "Friction coefficient over velocity",
    "7": "Tilt rate for several critical velocities",
    "8": "Tilt rate for several bristle stiffnesses",
    "9": "Orbit, tilt and tilt rate, TO and TR",
    "10": "Orbit, tilt and tilt rate for several radius differences",
    "11": "Orbit, tilt rate and hysteresis, Bengisu-Akay",
    "12": "Orbit, tilt rate and hysteresis, LuGre 1e6",
    "13": "Orbit, tilt rate and hysteresis, LuGre 5e6",
    "14": "Friction characteristics",
    "15": "Run-up",
    "pads": "Orbit with two and four pads, tilt and contact force of the upper pads",
}


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


def machine(version: str, seconds: float | None) -> str:
    """On what the page was made, in so many seconds; None: from the runs of an earlier time."""
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    spent = "runs kept from an earlier time" if seconds is None else f"{seconds:.0f} s of runs and drawing"
    return f"{version}; {processor()}, {os.cpu_count()} cores, {system}; {spent}."


def processor() -> str:
    """Name of the processor."""
    try:
        found = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    except OSError:
        found = None
    return found[1] if found else platform.machine()
