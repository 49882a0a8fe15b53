"""Modes of rotor and pads, of a run or over the runs of a study."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tiltpad.calculate.coefficients import JOURNAL, series
from tiltpad.calculate.selection import Where
from tiltpad.files.read import Run
from tiltpad.files.study import Study

#: Modes that are farther apart are different ones: by their eigenvalues (0 to 2) and shapes (0 to 1).
ANOTHER = 1.0
#: As on the console: the damping of a mode is that of the reduction where this part of it is.
MOSTLY = 0.5
#: As in the program: parts of the largest displacement that make a mode the journal's, or several pads'.
SHARE_OF_JOURNAL, SHARE_OF_PAD = 0.25, 0.5
#: Likewise: shorter over longer axis of an ellipse below which a mode is planar; what is left of the areas of
#: all stations, those that go backward taken off, from which on they go one way.
NARROWEST, ONE_WAY = 0.05, 0.5


class Modes(NamedTuple):
    """Modes of rotor and pads at the equilibrium; its fields:

        pivot            of which they are: free, stuck or locked
        speed_rpm        shaft speed, (); of a study (run,), rising
        eigenvalue       1/s, complex, (mode,); of a study (run, mode)
        frequency        Hz, likewise
        damping_ratio, log_decrement     likewise; a mode without vibration has no decrement (nan)
        shape            complex, (mode, position); of a study (run, mode, position)
        name             what moves: "journal, forward" (or backward, or planar: in an ellipse whose axes are
                         as 20 to 1 or more), "pad 3, tilt", "pads, tilt", ..., of a machine "shaft, forward"
                         (or mixed: some stations backward) or "pads", likewise; empty where there is no mode
        position         names of the positions: y, z, tilt_1, pivot_deflection_1, ...; of a machine those of
                         its stations: y_1, z_1, y_2, ...
        whirl            likewise as frequency, from -1 (circular backward) to 1 (forward, as the shaft
                         turns): of the journal, of a machine of all stations
        of_reduction     likewise as frequency, true of high modes of a machine's shaft, whose damping in a
                         march is that of its reduction (reduction%damp_above)
        threshold_rpm    lowest speed at which a mode turns unstable, nan where there is none, or none was
                         looked for; of a study (run,)
        parameters       of a study: values of its parameters by name, (run,) each

    In a study a mode keeps its place over the speed, and nan stands where a run does not have it. Where
    modes change in a leap, as when a pad is lifted off its pivot, those behind it have places of their own.
    """

    pivot: str
    speed_rpm: np.ndarray
    eigenvalue: np.ndarray
    frequency: np.ndarray
    damping_ratio: np.ndarray
    log_decrement: np.ndarray
    shape: np.ndarray
    name: np.ndarray
    position: np.ndarray
    whirl: np.ndarray
    of_reduction: np.ndarray
    threshold_rpm: np.ndarray
    parameters: dict[str, np.ndarray]


def modes(
    source: Run | Study, pivot: str | None = None, where: Where = None, over: str | None = None
) -> Modes:
    """Modes of a run of the task coefficients, or of a study of such runs over the speed.

    `pivot` is one of those in the file, by default the first; `where` keeps the runs of a study with these
    values of parameters; `over` is a parameter of the study that rises in place of the speed.
    """
    found = series(source, "modes", pivot, where, over)
    values = dict(found.values)
    values["eigenvalue"] = values["eigenvalue_real"] + 1j * values["eigenvalue_imag"]
    if "station_y_real" in values:
        plane = [values[f"station_{axis}_real"] + 1j * values[f"station_{axis}_imag"] for axis in "yz"]
        values["shape"] = np.stack(plane, axis=-1).reshape(*plane[0].shape[:2], -1)
        position = np.array([f"{axis}_{station:g}" for station in source["station"] for axis in "yz"])
        words = whirl_words(np.stack(plane, axis=-1), values["sense"][:, None])
    else:
        values["shape"] = values["shape_real"] + 1j * values["shape_imag"]
        values["whirl"] = values["sense"][:, None] * whirl(values["shape"])
        words = whirl_words(values["shape"][..., None, :JOURNAL], values["sense"][:, None])
        position = source["position_row"]
    order = tracked(values["eigenvalue"], values["shape"])
    names = ("eigenvalue", "frequency", "damping_ratio", "log_decrement", "shape", "whirl")
    own: dict[str, Any] = {name: placed(values[name], order) for name in names}
    vibrates = own["frequency"] > 0
    part = values.get("part_of_reduction", np.zeros_like(values["frequency"]))
    own["of_reduction"] = placed(part, order) > MOSTLY
    words = np.array([np.append(each, "")[at] for each, at in zip(words, order, strict=True)])
    own["name"] = mode_names(own["shape"], [str(each) for each in position], np.where(vibrates, words, ""))
    own["threshold_rpm"] = values.get("threshold_rpm", np.full(len(found.speed_rpm), np.nan))
    own["speed_rpm"] = found.speed_rpm
    if isinstance(source, Run):
        own = {name: each[0] for name, each in own.items()}
    return Modes(found.pivot, position=position, parameters=found.parameters, **own)


def tracked(eigenvalue: np.ndarray, shape: np.ndarray) -> np.ndarray:
    """For each run and place the mode to put there, so that a mode keeps its place: (run, place).

    Each run's modes are paired with the last ones before them: the pairs that are closest by eigenvalue
    and shape first. A mode that is like none of them begins a new place, as where a pad is lifted off its
    pivot; -1 stands where a run has no mode for a place.
    """
    runs, last, forms = len(eigenvalue), np.zeros(0), np.zeros((0, shape.shape[-1]))
    places: list[np.ndarray] = []
    for k, (now, form) in enumerate(zip(eigenvalue, shape, strict=True)):
        there = np.flatnonzero(np.isfinite(now))
        found = paired(distance(last, forms, now[there], form[there]))
        new = np.setdiff1d(np.arange(len(there)), found)
        places += [np.full(runs, -1) for _ in new]
        found = np.concatenate([found, new])
        here = found >= 0
        for place in np.flatnonzero(here):
            places[place][k] = there[found[place]]
        last, forms = np.append(last, now[there][new]), np.append(forms, form[there][new], axis=0)
        last[here], forms[here] = now[there][found[here]], form[there][found[here]]
    return np.array(places, dtype=int).reshape(-1, runs).T


def placed(values: np.ndarray, order: np.ndarray) -> np.ndarray:
    """Values, (run, mode, ...), at the places of `order`, (run, place); nan where it is -1."""
    whole = np.concatenate([values, np.full_like(values[:, :1], np.nan)], axis=1)
    return np.array([each[at] for each, at in zip(whole, order, strict=True)])


def distance(before: np.ndarray, forms: np.ndarray, now: np.ndarray, form: np.ndarray) -> np.ndarray:
    """How far the modes of two runs are apart, (mode before, mode now)."""
    size = np.maximum(np.abs(before)[:, None], np.abs(now))
    apart = np.abs(before[:, None] - now) / np.where(size > 0, size, 1)
    return apart + 1 - likeness(forms, form)


def likeness(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Modal assurance criterion of all pairs of shapes, 0 to 1."""
    one, other = np.nan_to_num(one), np.nan_to_num(other)
    scale = np.linalg.norm(one, axis=1)[:, None] * np.linalg.norm(other, axis=1)
    return (np.abs(one.conj() @ other.T) / np.where(scale > 0, scale, 1)) ** 2


def paired(apart: np.ndarray) -> np.ndarray:
    """For each row a column of its own, the closest pair first; -1 for a row that is far from all others."""
    apart, found = apart.copy(), np.full(len(apart), -1)
    while apart.size and apart.min() < ANOTHER:
        row, column = np.unravel_index(np.argmin(apart), apart.shape)
        found[row] = column
        apart[row], apart[:, column] = np.inf, np.inf
    return found


def whirl(shape: np.ndarray) -> np.ndarray:
    """Sense of the whirl of the journal, 1 clockwise (+y to +z), -1 anticlockwise: (..., mode)."""
    y, z = (shape[..., k] for k in range(JOURNAL))
    size = np.abs(y) ** 2 + np.abs(z) ** 2
    return -2 * (np.conj(y) * z).imag / np.where(size > 0, size, 1)


def whirl_words(shape: np.ndarray, sense: np.ndarray | float) -> np.ndarray:
    """How places go round in modes of a shaft that turns in this sense, by their shapes (..., place, 2).

    The words, (...,), are forward, backward, planar (in lines or narrow ellipses) and mixed (some forward,
    others backward).
    """
    y, z = shape[..., 0], shape[..., 1]
    turned = -(np.conj(y) * z).imag
    areas, size = np.abs(turned).sum(axis=-1), (np.abs(y) ** 2 + np.abs(z) ** 2).sum(axis=-1)
    left = sense * turned.sum(axis=-1)
    kinds = [areas < NARROWEST * size, np.abs(left) < ONE_WAY * areas, left > 0]
    return np.select(kinds, ["planar", "mixed", "forward"], "backward")


def mode_names(shape: np.ndarray, positions: Sequence[str], words: np.ndarray) -> np.ndarray:
    """What moves in the modes, as in the dataset `modes/name`: (..., mode), empty where none is.

    The words are those of whirl_words, empty where nothing vibrates. Shapes are (..., mode, position); their
    largest element is 1 m, and tilts count times a length that this tells: each pad has modes in which its
    tilt is the largest.
    """
    sizes = np.abs(np.nan_to_num(shape))
    places = dict.fromkeys(name.rsplit("_", 1)[-1] for name in positions[JOURNAL:])
    pads = {pad: [k for k, name in enumerate(positions) if name.endswith(f"_{pad}")] for pad in places}
    for k in (k for k, name in enumerate(positions) if name.startswith("tilt")):
        longest = sizes[..., k].max(axis=-1, keepdims=True, initial=0)
        sizes[..., k] /= np.where(longest > 0, longest, 1)
    sense = np.where(words == "", "", np.char.add(", ", words))
    own = np.char.add("journal", sense)
    if "y_1" in positions:
        moves = sizes.max(axis=-1) >= SHARE_OF_JOURNAL
        own = np.where(moves, np.char.add("shaft", sense), "pads")
    elif pads:
        of_pads = np.stack([sizes[..., k].max(axis=-1) for k in pads.values()], axis=-1)
        several = (of_pads >= SHARE_OF_PAD * of_pads.max(axis=-1, keepdims=True)).sum(axis=-1) > 1
        first = of_pads.argmax(axis=-1)
        who = np.where(several, "pads", np.array([f"pad {pad}" for pad in pads])[first])
        own_names = np.array(positions)
        how = np.stack([own_names[k][sizes[..., k].argmax(-1)] for k in pads.values()], axis=-1)
        how = np.take_along_axis(how, first[..., None], axis=-1)[..., 0]
        what = np.where(np.char.startswith(how, "tilt"), ", tilt", ", pivot deflection")
        of_journal = sizes[..., :JOURNAL].max(axis=-1) >= SHARE_OF_JOURNAL * sizes.max(axis=-1)
        own = np.where(of_journal, own, np.char.add(who, what))
    return np.where(np.isnan(shape).all(axis=-1), "", own)


def of_journal(name: np.ndarray) -> np.ndarray:
    """True for the names of modes of the journal or the shaft, and not of pads."""
    return np.char.startswith(name, "journal") | np.char.startswith(name, "shaft")
