"""Pictures of warm oil: temperatures and viscosity of the pads, and where the heat goes.

Studies and branches are drawn over a parameter, single results as their pads.
"""

from collections.abc import Mapping, Sequence
from typing import Any, cast

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tiltpad.calculate import geometry
from tiltpad.calculate.heat import heat_balance
from tiltpad.calculate.selection import Where, selected
from tiltpad.draw import layout
from tiltpad.draw.branches import parameter_of
from tiltpad.draw.diagrams import mark_failed
from tiltpad.draw.vibrations import Part, axis_label, parts
from tiltpad.files.archive import NotInRunError
from tiltpad.files.read import Run
from tiltpad.files.study import Study
from tiltpad.files.units import SHOWN

#: Temperatures of a pad: how they are drawn beside each other, and along a line.
PLACES = {"inlet": "<", "mean": "o", "outlet": ">", "maximum": "^"}
#: Temperatures of the bearing.
SHAFT, DRAIN = {"color": "0.3", "linestyle": "--"}, {"color": "0.3", "linestyle": ":"}
SUPPLY = {"color": "0.3", "linestyle": "-", "linewidth": 0.8}
#: Values along an axis, and what runs there have of what is drawn.
Line = tuple[np.ndarray, dict[str, np.ndarray]]

#: What is drawn of a heat balance, and how the names in studies begin.
DRAWN = {
    **dict.fromkeys(("mean_temperature", "maximum_temperature", "viscosity"), "pad_"),
    **dict.fromkeys(("shaft_temperature", "drain_temperature"), ""),
}


@layout.of_several
def temperatures(
    runs: Sequence[Run | Study], pad: int | None = None, over: str | None = None, where: Where = None
) -> Figure:
    """Temperatures and viscosities over a parameter, of studies or a branch; of results the heat balances.

    A study that varies more than one parameter has lines for its middle run, and bands of all. Of results
    with temperatures along and across films, a pad that is chosen shows those of its film.
    """
    results = [each for each in runs if isinstance(each, Run)]
    branch = next((each for each in results if each.is_branch), None)
    if branch and len(runs) == 1:
        return of_branch(branch, pad)
    if branch:
        raise ValueError(f"{branch.path}: a branch has a picture of temperatures of its own")
    if len(results) == len(runs):
        return of_results(results, pad)
    for each in runs:
        if isinstance(each, Study) and "pad_equilibrium_mean_temperature" not in each:
            raise NotInRunError(f"{each.path}: no temperatures in this study: thermal%model is 'none'")
    found = parts(runs, None, over, where)
    if len(runs) > 1:
        names = "; ".join(one.text for one in found)
        raise ValueError(f"a picture of temperatures has a line for each pad: one study, not {names}")
    fig, panels = layout.stacked(["temperature", "viscosity"])
    lines = [along(each) for each in found]
    middle = len(found) // 2
    place, own = lines[middle]
    count = own["mean_temperature"].shape[1]
    if pad is not None and not 1 <= pad <= count:
        raise ValueError(f"{runs[0].path}: no pad {pad}: 1 to {count}")
    pads = [pad] if pad else list(range(1, count + 1))
    draw(place, own, pads, panels)
    for ax in panels.values():
        mark_failed(ax, place[np.isnan(own["mean_temperature"]).all(axis=1)], None)
    finish(fig, panels, pads, axis_label(found), runs)
    if len(found) > 1:
        draw_bands(lines, pads, panels)
        words = f"lines: {found[middle].text}; bands: {found[0].text} to {found[-1].text}"
        panels["temperature"].set_title(layout.plain(words, layout.width(fig)), fontsize="small")
    return fig


def draw_bands(lines: Sequence[Line], pads: Sequence[int], panels: Mapping[str, Axes]) -> None:
    """Between the least and the largest of the runs at each place: maximum temperatures and viscosities."""
    place = lines[0][0]
    if any(len(x) != len(place) or (x != place).any() for x, _ in lines):
        raise ValueError("bands need the same values along the axis for each of the other parameters")
    for shown, name in (("temperature", "maximum_temperature"), ("viscosity", "viscosity")):
        values = SHOWN[shown].factor * np.array([found[name] for _, found in lines])
        for i, k in enumerate(pads):
            own = values[:, :, k - 1]
            look = {"color": layout.part_color(i, len(pads)), "alpha": 0.25, "linewidth": 0}
            panels[shown].fill_between(place, own.min(0), own.max(0), **look)


def finish(
    fig: Figure, panels: Mapping[str, Axes], pads: Sequence[int], label: str, runs: Sequence[Run | Study]
) -> None:
    """Labels the axes of temperatures and viscosities over a parameter, and names their lines."""
    fig.set_figheight(4.2)
    for name, ax in panels.items():
        ax.set_ylabel(SHOWN[name].label)
    panels["viscosity"].set(xlabel=label, ylim=(0, None))
    entries = [(f"pad {k}", {"color": layout.part_color(i, len(pads))}) for i, k in enumerate(pads)]
    entries += [("maximum", {"color": "0.3"}), ("mean", {"color": "0.3", "linestyle": "-."})]
    layout.heading(fig, [*entries, ("shaft", SHAFT), ("drain", DRAIN)], layout.title(runs))


def of_branch(run: Run, pad: int | None) -> Figure:
    """Along the branches of a run."""
    fig, panels = layout.stacked(["temperature", "viscosity"])
    pads = layout.shown_pads([run], pad)
    for number in np.unique(run["branch"]):
        own = np.flatnonzero(run["branch"] == number)
        found = {name: run[name][own] for name in DRAWN}
        draw(run["parameter"][own], found, pads, panels)
    finish(fig, panels, pads, parameter_of(run).label, [run])
    return fig


def draw(
    x: np.ndarray, found: Mapping[str, np.ndarray], pads: Sequence[int], panels: Mapping[str, Axes]
) -> None:
    """Lines of what a heat balance gives, by name."""
    upper, lower = panels["temperature"], panels["viscosity"]
    dots = {"marker": "o", "markersize": 3} if len(x) < 30 else {}
    for i, k in enumerate(pads):
        color = layout.part_color(i, len(pads))
        upper.plot(x, found["maximum_temperature"][:, k - 1], color=color, **dots)
        upper.plot(x, found["mean_temperature"][:, k - 1], "-.", color=color, linewidth=1)
        lower.plot(x, SHOWN["viscosity"].factor * found["viscosity"][:, k - 1], color=color, **dots)
    upper.plot(x, found["shaft_temperature"], **SHAFT)
    upper.plot(x, found["drain_temperature"], **DRAIN)


def along(part: Part) -> Line:
    """Of the runs of a study that are a part: values of the parameter in their order, and what is there."""
    study = cast(Study, part.source)
    place = study[part.over]
    order = np.flatnonzero(selected(study, part.where) & np.isfinite(place))
    order = order[np.argsort(place[order], kind="stable")]
    return place[order], {name: study[f"{pads}equilibrium_{name}"][order] for name, pads in DRAWN.items()}


def of_results(runs: Sequence[Run], pad: int | None) -> Figure:
    """For each result its temperatures, viscosities and the heat of its pads, or the temperatures
    along their surfaces, in a row."""
    pads = layout.shown_pads(runs, pad)
    if pad is not None and all(run.has_film_temperatures for run in runs):
        return of_films(runs, pad)
    fig, rows = plt.subplots(len(runs), 2, squeeze=False, figsize=(layout.PAGE, 0.6 + 2.4 * len(runs)))
    names = layout.labels(runs) if len(runs) > 1 else [""]
    for (left, right), run, name in zip(rows, runs, names, strict=True):
        own = [k for k in pads if k <= run.pads]
        temperatures_of_pads(run, left, own)
        along_pads = run.has_film_temperatures
        (surfaces_of_pads if along_pads else heat_of_pads)(run, right, own)
        of_pads = [left] if along_pads else [left, right]
        viscosity = SHOWN["viscosity"].factor * run["equilibrium/viscosity"]
        of_pads[-1].set_xlabel(f"viscosity below each pad ({SHOWN['viscosity'].unit})")
        left.set_title(layout.plain(name, int(15 * layout.COLUMN)))
        for ax in of_pads:
            ax.set_xticks(range(len(own)), [f"pad {k}\n{viscosity[k - 1]:#.3g}" for k in own])
            ax.grid(visible=False, axis="x")
    both = (ax.get_legend_handles_labels() for ax in rows[0])
    handles, texts = ([*left, *right] for left, right in zip(*both, strict=True))
    heads = layout.plain(layout.title(runs), layout.width(fig)) or None
    fig.legend(handles, texts, loc="outside upper center", ncols=5, title=heads)
    return fig


def of_films(runs: Sequence[Run], pad: int) -> Figure:
    """For each result the temperatures in the film of a pad, between pad and journal."""
    fig, rows = plt.subplots(len(runs), 1, squeeze=False, figsize=(layout.PAGE, 0.5 + 2.4 * len(runs)))
    names = layout.labels(runs) if len(runs) > 1 else [f"{runs[0].title}, pad {pad}".removeprefix(", ")]
    for ax, run, name in zip(rows.flat, runs, names, strict=True):
        shown = film_of_pad(run, ax, pad)
        fig.colorbar(shown, ax=ax, label=SHOWN["temperature"].label)
        ax.set_title(layout.plain(name, layout.width(fig)))
    rows[-1, 0].set_xlabel("place on the arc, from the leading to the trailing edge")
    return fig


def film_of_pad(run: Run, ax: Axes, pad: int) -> Any:
    """Temperatures in a pad's film at the equilibrium, over its thickness from the pad to the journal."""
    film = geometry.surfaces(run.in_operation, geometry.at_rest(run)).thickness[pad - 1]
    place, height = run["film_arc"], run["film_height"]
    # thicknesses are given from the trailing edge on
    thickness = np.interp(1 - place, np.linspace(0, 1, len(film)), film)
    walls = np.concatenate([[0], height, [1]])
    surface, film = (run[f"equilibrium/{name}_temperature"][pad - 1] for name in ("surface", "film"))
    shaft = np.full(len(place), float(run["equilibrium/shaft_temperature"]))
    field = np.column_stack([surface, film, shaft]).T
    y = SHOWN["min_film_thickness"].factor * np.outer(walls, thickness)
    shown = ax.contourf(np.broadcast_to(place, field.shape), y, field, 20, cmap=layout.WARMTH)
    ax.set(ylabel="height in the film (µm)", ylim=(0, None))
    return shown


def temperatures_of_pads(run: Run, ax: Axes, pads: Sequence[int]) -> Axes:
    """Temperatures of each pad beside those of supply, shaft and drain."""
    columns = [k - 1 for k in pads]
    for i, (name, marker) in enumerate(PLACES.items()):
        values = run[f"equilibrium/{name}_temperature"][columns]
        ax.plot(np.arange(len(pads)), values, marker, color=f"C{i}", label=name, linestyle="")
    ax.axhline(run.input["oil"]["supply_temperature"], label="supply", **SUPPLY)
    for name, look in (("shaft", SHAFT), ("drain", DRAIN)):
        ax.axhline(float(run[f"equilibrium/{name}_temperature"]), label=name, **look)
    ax.margins(x=0.2, y=0.15)
    ax.set_ylabel(SHOWN["temperature"].label)
    return ax


def surfaces_of_pads(run: Run, ax: Axes, pads: Sequence[int]) -> Axes:
    """For each pad the temperature of its surface along the arc."""
    along = run["film_arc"]
    for k in pads:
        ax.plot(along, run["equilibrium/surface_temperature"][k - 1], color=f"C{k - 1}", label=f"pad {k}")
    ax.set(xlabel="place on the arc, from the leading edge", ylabel=SHOWN["temperature"].label, xlim=(0, 1))
    return ax


def heat_of_pads(run: Run, ax: Axes, pads: Sequence[int]) -> Axes:
    """For each pad the heat made in its film, and beside it where it goes."""
    columns, place = [k - 1 for k in pads], np.arange(len(pads))
    shown, found = SHOWN["power_loss"], heat_balance(run)
    made = shown.factor * found.made[columns]
    to_oil, to_shaft = (shown.factor * each[columns] for each in (found.to_oil, found.to_shaft))
    ax.bar(place - 0.2, made, 0.38, color="C0", label="heat made")
    ax.bar(place + 0.2, to_oil, 0.38, color="C2", label="to the oil")
    # a shaft that warms the film is drawn below zero
    ax.bar(place + 0.2, to_shaft, 0.38, np.where(to_shaft > 0, to_oil, 0), color="C4", label="to the shaft")
    ax.axhline(0, color="0.3", linewidth=0.8)
    ax.set_ylabel(f"heat ({shown.unit})")
    return ax
