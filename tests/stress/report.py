"""The page that says what the stress test found."""

import re
from collections import Counter
from collections.abc import Callable, Iterable

import numpy as np
from stress_judge import AT_REST, COMPARED, FINER, TIME_BUDGET, Result, cause_of

REFUSALS = ("step budget", "time budget", "march stopped", "no equilibrium", "input refused")
OUTCOMES = ("done", *REFUSALS, "crashed", "hung")
NUMBER = r"-?\d+(\.\d+)?([eE][+-]?\d+)?"

PAGE = """\
# Stability

The stress test runs {count} random cases (seed {seed}) over wide ranges of every input: 1 to 24 pads, L/D
0.1 to 2, clearance 0.4 to 4 per mille, preload -0.3 to 0.7, pivot ratios 0.3 to 0.7, load up to 5 times the
paper's in any direction, 100 to 15000 rpm (constant, rising and falling), unbalance up to contact, every
friction model (critical velocity down to 1e-8 m/s, bristle stiffness up to 1e9 1/m), pad motion, contact
law, cavitation and film solver, 2 to 30 revolutions. Sizes, masses and loads scale with the journal, so
that most cases are bearings, though not always good ones.

A case passes if it ends with a complete result whose numbers are finite and physically possible (contact
forces >= 0, film thickness > 0 unless asperities touch, friction within its bound, equally spaced
samples). It also passes if it ends with a refusal of one line that says why, where and when; the results
up to this point are then kept and finite. After a refusal for want of an equilibrium a global search of its
own (`tests/stress/global_search.f90`: slow, and independent of the one in the program) looks for one that is
stable or of oscillatory instability; where it finds one the case fails, but for the lost cases that *Searches
of an equilibrium* names. No case may hang: `integration%max_steps` limits the work, and the tables count a
case that reaches this limit separately ("step budget"). A run is asked to stop after {budget} s of CPU
time, which few take, whose films are dear ("time budget"); one that goes on is hung.

**{passed} passed, {failed} failed.** This command wrote the page:

    {command}

## Outcomes

{outcomes}

Outcomes by friction model and pad motion:

{models}

Outcomes by number of pads:

{counts}

## Equilibria

Stability of the equilibria at which the marches started, by the eigenvalues of the linearised motion:

{classes}

**{share:.0f} % of the cases are refused for want of an equilibrium.** The causes, as the messages name
them, and what the global search found in these cases:

{causes}

## Refusals

{reasons}

## Cost

This table shows the steps per revolution of the cases that moved (more than {moved} steps), and the share
of steps that the error test or Newton's iteration rejected:

{cost}

These cases took the most steps per revolution:

{most_steps}

## Error

The test ran {compared} of the cases that moved and were completed again over {revolutions} revolutions,
with a `relative_tolerance` (and `film%tolerance`) {finer} times smaller. The error is the maximum
difference of journal position, tilt and pivot deflection at any instant, in units of the tolerance
`relative_tolerance * (|state| + scale)`.

The settings set a limit of the error: CVODE keeps the error of one step below sqrt(n) tolerances for n
states, so after N steps the error of a case that does not amplify disturbances stays below **N sqrt(n)**
tolerances. A bearing may have several equilibria: where the two runs find different ones, both are run
again from the first. If the error of a case is above the limit, the test runs the case once more with the
small tolerance and a load changed by `relative_tolerance` of itself; pads are made heavier by the same force,
with its moment at their ends, as films promise their forces over that of a loaded film, however little a pad
carries. If this alone changes the result by a tenth of the error or more, the case is sensitive, and no
solver can follow it at this tolerance; otherwise it fails.

{verdicts}

{errors}

The friction moment is not a state. Where the friction law is steep, the moment jumps, and a small
difference in the time of a jump is a large difference of the moment. These cases have the largest errors
over the limit:

{worst}

`build/stress` (`--keep`) contains a namelist of every failed case; its first lines say what was wrong.
"""


def page(results: list[Result], seed: int) -> str:
    """The whole page."""
    failed = sum(bool(result.faults) for result in results)
    compared = [result for result in results if result.comparison]
    return PAGE.format(
        count=len(results),
        seed=seed,
        budget=TIME_BUDGET,
        passed=len(results) - failed,
        failed=failed,
        command=f"make stress CASES={len(results)} SEED={seed}",
        outcomes=outcomes(results),
        models=crossed(results, lambda result: f"{model(result)}, {motion(result)}"),
        counts=crossed(results, pads),
        classes=classes(results),
        share=100 * sum(result.outcome == "no equilibrium" for result in results) / max(len(results), 1),
        causes=causes(results),
        reasons=reasons(results),
        moved=AT_REST,
        cost=cost(results),
        most_steps=most_steps(results),
        compared=len(compared),
        revolutions=f"{COMPARED:g}",
        finer=f"{FINER:g}",
        verdicts=verdicts(compared),
        errors=errors(compared),
        worst=worst(compared),
    )


def table(head: Iterable, rows: Iterable[Iterable]) -> str:
    """A Markdown table."""
    head = list(head)
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def model(result: Result) -> str:
    return result.case["friction"]["model"]


def motion(result: Result) -> str:
    return result.case["pads"]["motion"]


def pads(result: Result) -> str:
    count = len(result.case["pads"]["pivot_angle_deg"])
    return next(name for most, name in ((2, "1-2"), (6, "3-6"), (12, "7-12"), (24, "13-24")) if count <= most)


def outcomes(results: list[Result]) -> str:
    """Cases and failures of each outcome."""
    found = Counter(result.outcome for result in results)
    bad = Counter(result.outcome for result in results if result.faults)
    rows = [(each, found[each], bad[each]) for each in OUTCOMES if found[each]]
    return table(("outcome", "cases", "failed"), rows)


def crossed(results: list[Result], key: Callable[[Result], str]) -> str:
    """Outcomes over a property of the cases."""
    found = Counter((key(result), result.outcome) for result in results)
    used = [each for each in OUTCOMES if any(outcome == each for _, outcome in found)]
    keys = sorted({name for name, _ in found}, key=lambda name: (not name[0].isdigit(), len(name), name))
    return table(("", *used), ([name, *(found[name, outcome] for outcome in used)] for name in keys))


def classes(results: list[Result]) -> str:
    """Equilibria by stability."""
    found = Counter(result.stability for result in results if result.stability)
    return table(("stability", "cases"), found.most_common()) if found else "None."


def causes(results: list[Result]) -> str:
    """Refusals for want of an equilibrium, by cause, over what the global search found."""
    refused = [result for result in results if result.outcome == "no equilibrium"]
    if not refused:
        return "None."
    ends = sorted({result.searched or "not searched" for result in refused})
    found = Counter((result.cause or "no cause", result.searched or "not searched") for result in refused)
    total = Counter(result.cause or "no cause" for result in refused)
    rows = [(cause, count, *(found[cause, end] for end in ends)) for cause, count in total.most_common()]
    return table(("cause", "cases", *ends), rows)


def reasons(results: list[Result]) -> str:
    """Refusals by their words, without numbers."""
    refused = [result for result in results if result.outcome in REFUSALS]
    found = Counter(reason(result.message) for result in refused)
    return table(("reason", "cases"), found.most_common()) if found else "None."


def reason(message: str) -> str:
    """A message without its numbers, places and times."""
    if name := cause_of(message):
        return f"no equilibrium found: {name}"
    message = re.sub(r"; what was computed is in .*", "", message.removeprefix("tiltpad: error: "))
    message = re.sub(r"(the march \w+( up)?) at t = \S+ s, after \d+ steps:? ?", r"\1: ", message)
    message = re.sub(r" \(step size [^)]*\)| at \S+ rpm", "", message)
    return re.sub(NUMBER, "..", message)


def cost(results: list[Result]) -> str:
    """Steps per revolution by friction model and motion: median, 90 %, maximum."""
    groups: dict[str, list[tuple[float, float]]] = {}
    for result in results:
        if result.steps > AT_REST and result.revolutions > 0:
            attempts = result.steps + result.failures
            rates = result.steps / result.revolutions, result.failures / attempts
            groups.setdefault(f"{model(result)}, {motion(result)}", []).append(rates)
    rows = []
    for name in sorted(groups, key=lambda name: (len(name), name)):
        rate, share = np.array(groups[name]).T
        middle, most = np.median(rate), rate.max()
        row = name, len(rate), short(middle), short(np.quantile(rate, 0.9)), short(most)
        rows.append((*row, f"{100 * np.median(share):.0f} %"))
    return table(("", "cases", "median", "90 % below", "maximum", "rejected steps (median)"), rows)


def short(number: float) -> str:
    """Three digits."""
    return f"{number:.3g}"


def most_steps(results: list[Result], count: int = 8) -> str:
    """Cases with the most steps per revolution."""
    moved = [result for result in results if result.revolutions > 0]
    moved.sort(key=lambda result: -result.steps / result.revolutions)
    rows = []
    for each in moved[:count]:
        rate = short(each.steps / each.revolutions)
        rows.append((each.number, rate, f"{each.seconds:.1f}", each.outcome, *features(each)))
    return table(("case", "steps per revolution", "CPU s", "outcome", *FEATURES), rows)


FEATURES = ("pads", "friction", "motion", "film")


def features(result: Result) -> tuple:
    """Pads, friction, motion and film in short."""
    friction, film = result.case["friction"], result.case["film"]
    said = friction["model"]
    if "critical_velocity" in friction:
        said += f" {friction['critical_velocity']:.0e} m/s"
    if "bristle_stiffness" in friction:
        said += f" {friction['bristle_stiffness']:.0e} 1/m"
    film = f"{film['cavitation']}, {film.get('solver', 'auto')}"
    return len(result.case["pads"]["pivot_angle_deg"]), said, motion(result), film


def verdicts(compared: list[Result]) -> str:
    """How the comparisons ended."""
    meaning = {
        "kept": "within the limit",
        "sensitive": "sensitive: above the limit, as is a run with a slightly different load",
        "missed": "above the limit (failed)",
    }
    found = Counter(result.comparison.outcome for result in compared)
    return table(("", "cases"), ((meaning.get(key, key), n) for key, n in found.most_common()))


def errors(compared: list[Result]) -> str:
    """Distribution of the errors, of the cases that moved."""
    runs = [r.comparison for r in compared if r.comparison.outcome in ("kept", "sensitive", "missed")]
    if not runs:
        return "None compared."
    rows = []
    for name, values in (
        ("error over limit", [each.error / each.promised for each in runs]),
        ("error in tolerances", [each.error for each in runs]),
        ("error in scales of the states (clearance)", [each.share for each in runs]),
        ("friction moment in its peak-to-peak", [each.moment for each in runs]),
    ):
        rows.append((name, *(f"{q:.1e}" for q in np.quantile(values, (0.5, 0.9, 0.99, 1.0)))))
    return table(("", "median", "90 % below", "99 % below", "maximum"), rows)


def worst(compared: list[Result], most: int = 8) -> str:
    """Cases with the largest errors over the limit."""
    runs = [(each.comparison.error / each.comparison.promised, each) for each in compared
            if each.comparison.promised > 0]  # fmt: skip
    rows = []
    for part, each in sorted(runs, key=lambda run: -run[0])[:most]:
        moved = each.comparison.sensitivity
        row = each.number, f"{part:.1e}", f"{each.comparison.share:.1e}", f"{moved:.1e}" if moved else "-"
        rows.append((*row, each.comparison.outcome, *features(each)))
    head = ("case", "error over limit", "error in scales", "change by the load, tolerances", "verdict")
    return table((*head, *FEATURES), rows)
