"""Parts of the page about a study of a sample: how its runs ended, its results, which input matters."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from tiltpad.calculate.results import Result
from tiltpad.calculate.sensitivity import Sensitivity, sensitivity
from tiltpad.calculate.statistics import LEVELS, Share, beyond, outcomes, percentiles
from tiltpad.draw import samples
from tiltpad.draw.diagrams import label
from tiltpad.draw.page import paragraph, picture, section, table
from tiltpad.files.study import Study
from tiltpad.files.units import digits, fitted

#: An influence of less than this share of the variance has no sign.
SLIGHT = 0.005
#: Results that have a tornado, at most.
TORNADOS = 2


def sample(study: Study) -> list[str]:
    """The sections."""
    found = samples.shown_results(study, None)
    return [
        section("How the runs ended", ends(study)),
        section("Results", results(study, found)),
        section("Which input matters", influences(study, found)),
    ]


def ends(study: Study) -> str:
    """Shares of refused and of unstable runs, with the causes."""
    own = outcomes(study)
    if not own.refused.of:
        return paragraph("No run has ended.")
    rows = [("refused", *in_words(own.refused))]
    rows += [(f"refused: {text}", *in_words(each)) for text, each in own.causes.items()]
    if own.unstable:
        rows.append(("unstable journal or shaft, of those done", *in_words(own.unstable)))
    return table(("", "runs", "of", "share (%)", "95 % interval (%)"), rows)


def in_words(own: Share) -> tuple[str, ...]:
    low, high = (f"{100 * each:.3g}" for each in (own.low, own.high))
    return f"{own.runs}", f"{own.of}", f"{100 * own.share:.3g}", f"{low} to {high}"


def results(study: Study, found: Sequence[Result]) -> str:
    """Percentiles of the key results, and their histograms."""
    rows = []
    for each in found:
        own = percentiles(study, each.name, pivot=each.pivot)
        shown, infinite = fitted(each.shown, each.values), beyond(study, own.values)
        numbers = (own.mean[0], own.deviation[0], *own.values[0])
        texts = [infinite if np.isinf(value) else digits(shown.factor * value) for value in numbers]
        rows.append((shown.label, f"{own.runs[0]}", *texts))
    if not rows:
        return ""
    heads = ("", "runs", "mean", "standard deviation", *(f"{level} %" for level in LEVELS))
    return table(heads, rows) + picture("distribution", partial(samples.distribution, [study]), remarks=False)


def influences(study: Study, found: Sequence[Result]) -> str:
    """Sobol indices of the key results, a tornado of the first ones, and the runs over their inputs."""
    indices: list[tuple[Result, Sensitivity]] = []
    said = []
    for each in found:
        try:
            indices.append((each, sensitivity(study, each.name, pivot=each.pivot)))
        except ValueError as error:
            said.append(f"{error}".removeprefix(f"{study.path}: "))
    parts = [paragraph(text) for text in said]
    if indices:
        inputs = indices[0][1].inputs
        rows = [(label(study, name), *(cell(own, k) for _, own in indices)) for k, name in enumerate(inputs)]
        rows.append(("explained by the regression (%)", *(explained(own) for _, own in indices)))
        parts.append(table(("share of the variance (%)", *(each.shown.text for each, _ in indices)), rows))
        first = "First-order Sobol index, with the sign of the rank correlation"
        parts.append(paragraph(f"{first}, and behind it the total index."))
    # the last ones are those of stability
    for each, own in indices[: -TORNADOS - 1 : -1]:
        caption = f"{each.shown.text.replace('$', '')}."
        parts.append(picture("tornado", partial(samples.bars, study, own, each.shown), caption.capitalize()))
    if found:
        parts.append(picture("scatter", partial(samples.scatter, [study]), remarks=False))
    return "".join(parts)


def cell(own: Sensitivity, k: int) -> str:
    """First-order and total index of an input in percent, with the sign of its influence."""
    sign = "" if np.isnan(own.rank[k]) or own.first[k] < SLIGHT else "−" if own.rank[k] < 0 else "+"
    return f"{sign}{100 * own.first[k]:.0f} ({100 * own.total[k]:.0f})"


def explained(own: Sensitivity) -> str:
    return "–" if np.isnan(own.explained) else f"{100 * own.explained:.1f}"
