"""Pictures of studies of samples: which input matters, how results are distributed, results over inputs.

Every function takes studies, and returns the figure.
"""

from collections.abc import Sequence
from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tiltpad.calculate.results import DEFAULTS, Result, key_results, result
from tiltpad.calculate.selection import Where, is_number, matching, selected, varying
from tiltpad.calculate.sensitivity import SALTELLI, Sensitivity, sensitivity, some
from tiltpad.calculate.statistics import beyond, quantiles, with_infinite
from tiltpad.draw.diagrams import AT_EDGE, EDGE, axis
from tiltpad.draw.layout import COLUMN, PAGE, cloud, grid, heading, labels, of_several, remark, title
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import Shown, digits, fitted, literal

#: Most inputs, results and points of a picture, and most results of a scatter matrix.
INPUTS, RESULTS, POINTS, ROWS = 12, 6, 2000, 4
#: Colours of a low and of a high value of an input.
LOW, HIGH = "C0", "C1"
#: Highest over lowest value of an input from which on its axis may be logarithmic.
DECADES = 100
#: Percentiles of a histogram.
MARKED = (5, 50, 95)
#: Bins of a histogram, least and most; runs for each.
BINS, RUNS_A_BIN = (8, 60), 12


@of_several
def tornado(
    studies: Sequence[Study],
    pad: int | None = None,
    show: str | None = None,
    pivot: str | None = None,
    where: Where = None,
) -> Figure:
    """Which sampled input matters for a result: its change with each input, and Sobol indices."""
    study = only(studies)
    if show is None:
        # the result that is drawn where none is asked for
        found = shown_results(study, pivot)
        needs_some(study, found)
        main = next((each for each in found if each.name in DEFAULTS), found[0])
        show, pivot = main.name, main.pivot
    own = sensitivity(study, show, pad, pivot, where)
    return bars(study, own, result(study, show, pad, pivot).shown, title(studies))


def bars(study: Study, own: Sensitivity, shown: Shown, heads: str = "") -> Figure:
    """The tornado of a result."""
    order = np.argsort(own.first, kind="stable")[-INPUTS:]
    fig, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(PAGE, 1.0 + 0.27 * len(order)))
    swings(left, own, order, fitted(shown, [*own.low, *own.high]))
    shares(right, own, order)
    names = [literal(study.about(own.inputs[k], "long_name") or own.inputs[k]) for k in order]
    left.set_yticks(range(len(order)), names)
    for ax in (left, right):
        ax.grid(visible=False, axis="y")
        ax.set_ylim(-0.6, len(order) - 0.4)
    bars = {"input low": LOW, "input high": HIGH, "first order": SHARE}
    marks = [(text, {"color": color, "linewidth": 5}) for text, color in bars.items()]
    heading(fig, [*marks, ("total", TOTAL | {"linestyle": ""})], heads)
    for text in words(own, len(own.inputs) - len(order)):
        remark(fig, text)
    return fig


#: Colour of a first-order index, and mark of a total index.
SHARE = "0.8"
TOTAL = {"marker": "D", "markersize": 4, "markerfacecolor": "w", "color": "0.2"}


def swings(ax: Axes, own: Sensitivity, order: np.ndarray, shown: Shown) -> None:
    """Bars from the mean result to those with each input low and high."""
    middle = shown.factor * own.mean
    for place, k in enumerate(order):
        for end, color in ((own.low[k], LOW), (own.high[k], HIGH)):
            ax.barh(place, shown.factor * end - middle, 0.6, middle, color=color)
    ax.axvline(middle, color="0.3", linewidth=0.8)
    ax.locator_params(axis="x", nbins=6)
    ax.set_xlabel(shown.label)


def shares(ax: Axes, own: Sensitivity, order: np.ndarray) -> None:
    """Sobol indices with their intervals, and rank correlations."""
    places = np.arange(len(order))
    first, total = 100 * own.first[order], 100 * own.total[order]
    ends = 100 * np.array([own.first_low, own.first_high])[:, order]
    ax.barh(places, first, 0.6, color=SHARE)
    ax.errorbar(first, places, xerr=np.abs(ends - first), fmt="none", color="0.2", elinewidth=1, capsize=2)
    ax.plot(total, places, linestyle="", zorder=4, **TOTAL)
    beside = ax.secondary_yaxis("right")
    correlations = ["" if np.isnan(each) else f"{each:+.2f}".replace("-", "−") for each in own.rank[order]]
    beside.set_yticks(places, correlations)
    beside.set_ylabel("rank correlation")
    ax.set(xlabel="share of the variance (%)", xlim=(0, max(105, 1.02 * ends.max())))


def words(own: Sensitivity, left_out: int) -> list[str]:
    """What a tornado is of."""
    explains = f", which explains {100 * own.explained:.1f} % of the variance;"
    design = f"a Saltelli design of {own.runs} runs,", f"a regression on {own.runs} runs{explains}"
    said = [f"Sobol indices of {design[own.method != SALTELLI]} 95 % intervals"]
    said.append("low and high: mean result with the input in its lowest and its highest tenth")
    return [*said, f"and {left_out} inputs that matter less"] if left_out else said


@of_several
def distribution(
    studies: Sequence[Study],
    pad: int | None = None,
    show: str | None = None,
    pivot: str | None = None,
    where: Where = None,
) -> Figure:
    """Histograms of results of sampled studies, with percentiles; the key results, or the one asked for."""
    all_studies(studies)
    first = [named(studies[0], show, pad, pivot)] if show else shown_results(studies[0], pivot)
    needs_some(studies[0], first)
    fig, panels = grid(len(first), 2.2)
    texts = labels(studies) if len(studies) > 1 else [""]
    several = []
    for number, (study, text) in enumerate(zip(studies, texts, strict=True)):
        chosen = selected(study, where or {}) & study.done
        for ax, one in zip(panels, first, strict=True):
            own = one if number == 0 else named(study, one.name, pad, pivot)
            values = with_infinite(study, own)[chosen]
            shown = histogram(ax, own.shown, values, number, len(studies) == 1)
            if len(studies) == 1:
                in_figures(ax, shown, values, beyond(study, values))
        if text:
            several.append((literal(text), {"color": f"C{number}"}))
    marks = [("5, 50, 95 %", {"color": "0.2", "linestyle": "--"})]
    heading(fig, [*several, *marks], title(studies))
    return fig


def histogram(ax: Axes, shown: Shown, values: np.ndarray, number: int, alone: bool) -> Shown:
    """Shares of the runs with their percentiles; gives the unit in which they are shown."""
    values = values[~np.isnan(values)]
    finite = values[np.isfinite(values)]
    if not len(finite):
        raise ValueError(f"no {shown.label} to draw")
    shown = fitted(shown, finite) if alone else shown
    bins = int(np.clip(len(values) / RUNS_A_BIN, *BINS))
    share, color = np.full(len(finite), 100 / len(values)), f"C{number}"
    ax.hist(shown.factor * finite, bins, weights=share, color=color, alpha=0.5, histtype="stepfilled")
    for at in shown.factor * quantiles(values, MARKED):
        if np.isfinite(at):
            ax.axvline(at, color="0.2" if alone else color, linestyle="--", linewidth=0.9)
    ax.locator_params(axis="x", nbins=6)
    ax.set(xlabel=shown.label, ylabel="share of runs (%)")
    return shown


def in_figures(ax: Axes, shown: Shown, values: np.ndarray, infinite: str) -> None:
    """The percentiles above the panel, with the words for infinite ones."""
    values = values[~np.isnan(values)]
    found = quantiles(values, MARKED)
    said = [digits(shown.factor * at, 3) if np.isfinite(at) else infinite for at in found]
    rest = 100 * np.isinf(values).mean()
    more = f"; {rest:.3g} % of the runs {infinite}" if rest else ""
    ax.set_title(f"{', '.join(said)} {shown.unit}{more}", fontsize="small")


@of_several
def scatter(
    studies: Sequence[Study],
    pad: int | None = None,
    show: str | None = None,
    pivot: str | None = None,
    where: Where = None,
) -> Figure:
    """Results of a sampled study over its inputs, a point for each run; refused runs along the edge."""
    study = only(studies)
    chosen = selected(study, where or {})
    inputs = varying(study, matching(study, where or {}))
    if not inputs:
        raise ValueError(f"{study.path}: its runs differ in no parameter")
    found = [named(study, show, pad, pivot)] if show else shown_results(study, pivot)
    if not found:
        raise ValueError(f"{study.path}: no key result in this study: choose one by show")
    if not show:
        # those that are drawn where none is asked for come first
        found = sorted(found, key=lambda each: each.name not in DEFAULTS)[:ROWS]
    refused = some(np.flatnonzero(chosen & study.failed), EDGE)
    whole = np.flatnonzero(chosen & study.done)
    done = some(whole, POINTS)
    inputs, rest = inputs[:INPUTS], len(inputs) - INPUTS
    height = 1.3 if len(found) > 1 else 2.2
    size = (COLUMN if len(inputs) * len(found) == 1 else PAGE, 0.7 + height * len(found))
    shared = {"squeeze": False, "sharex": "col", "sharey": "row"}
    fig, panels = plt.subplots(len(found), len(inputs), figsize=size, **shared)
    for name, column in zip(inputs, panels.T, strict=True):
        last = column[-1]
        at, place = axis(study, name, last, "x")
        edge = last.get_xaxis_transform()
        last.plot(place[refused], np.zeros(len(refused)), transform=edge, **AT_EDGE)
        for ax, own in zip(column, found, strict=True):
            ax.plot(place[done], own.shown.factor * own.values[done], **cloud(len(done)))
        if is_number(study, name):
            few_ticks(last, place)
        last.set_xlabel(in_lines(at.label, len(inputs)), fontsize="small")
    for row, own in zip(panels, found, strict=True):
        row[0].set_ylabel(in_lines(own.shown.label, 5), fontsize="small")
        row[0].locator_params(axis="y", nbins=4)
    for ax in panels.ravel():
        ax.tick_params(labelsize="x-small")
    fig.align_labels()
    marks = [("not done", AT_EDGE)] if len(refused) else []
    heading(fig, marks, title(studies))
    if len(whole) > len(done):
        remark(fig, f"{len(done)} of {len(whole)} runs")
    if rest > 0:
        remark(fig, f"and {rest} further inputs")
    return fig


def only(studies: Sequence[Study]) -> Study:
    """The one study of a picture."""
    if len(studies) > 1:
        raise ValueError("one study in this picture")
    return all_studies(studies)[0]


def all_studies(studies: Sequence[Study | Run]) -> list[Study]:
    """The same; NotInRunError for the result of one run."""
    for each in studies:
        if isinstance(each, Run):
            raise NotInRunError(f"{each.path}: the result of one run, and this picture is of a study")
    return [each for each in studies if isinstance(each, Study)]


def needs_some(study: Study, found: Sequence[Result]) -> None:
    """Raises ValueError where there is no result to draw."""
    if not found:
        raise ValueError(f"{study.path}: no key result in this study that differs: choose one by show")


def few_ticks(ax: Axes, values: np.ndarray) -> None:
    """Lets the narrow panel have few ticks; a logarithmic axis only has room for whole decades."""
    if ax.get_xscale() == "log" and np.nanmax(values) < DECADES * np.nanmin(values):
        ax.set_xscale("linear")
    if ax.get_xscale() == "linear":
        ax.locator_params(axis="x", nbins=3)


def shown_results(study: Study, pivot: str | None) -> list[Result]:
    """The key results that differ between the runs that were done."""
    done = study.done
    found = [each for each in key_results(study, pivot) if differs(each.values[done])]
    return found[:RESULTS]


def differs(values: np.ndarray) -> bool:
    """True for numbers of which not all are the same but for rounding."""
    finite = values[np.isfinite(values)]
    return len(finite) > 1 and bool(np.ptp(finite) > 1e-9 * np.abs(finite).max())


def named(study: Study, name: str, pad: int | None, pivot: str | None) -> Result:
    """A result by name; a key result without a choice of pivots is of the first that have it."""
    if pad is None and pivot is None:
        return next((each for each in key_results(study) if each.name == name), result(study, name))
    return result(study, name, pad, pivot)


def in_lines(text: str, beside: int) -> str:
    """A label in lines, for this number of panels beside each other."""
    return fill(text, max(12, 90 // beside))
