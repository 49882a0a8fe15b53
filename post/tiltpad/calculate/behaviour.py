"""What each pad does at the end of a run: whether it carries load, lifts off, flutters or rubs.

Everything is in SI units; pads are 1, 2, ...
"""

from typing import NamedTuple

import numpy as np

from tiltpad.calculate import signals
from tiltpad.files import units
from tiltpad.files.read import Run

#: Revolutions at the end of a run that are looked at, and those that an order needs.
LAST, ENOUGH = 50, 8
#: Lines of a spectrum that belong to mean and drift.
DRIFT = 3
#: A pad is unloaded below this share of the load of all pads.
UNLOADED = 0.01
#: A pad flutters if its dominant order is so far from a whole number, and its edge moves so many clearances.
OFF_WHOLE, VISIBLE = 0.03, 0.01


class Behaviour(NamedTuple):
    """What a pad does.

    Mean contact force of its pivot, N, and its share of the sum over the pads; shares of the time in which
    the pivot carries nothing, and in which the film is so thin that the surfaces touch; order of the
    largest part of the tilt (nan where the run is short), and its amplitude, rad;
    whether this is a flutter. Of a fixed pad only the rubbing is known, the other numbers are nan.
    """

    pad: int
    load: float
    share: float
    lifted: float
    rubbing: float
    order: float
    amplitude: float
    flutters: bool

    @property
    def unloaded(self) -> bool:
        return self.share < UNLOADED

    @property
    def mark(self) -> str:
        """A few words for a picture."""
        found = {"no load": self.unloaded, "flutters": self.flutters, "rubs": self.rubbing > 0}
        return "\n".join(word for word, is_so in found.items() if is_so)

    def words(self) -> str:
        """A sentence, or nothing about a pad that is loaded, does not flutter and does not rub."""
        said = []
        if self.unloaded:
            said.append(f"carries no load (mean {self.load:.3g} N)")
        if self.lifted > 0:
            said.append(f"is lifted off its pivot {100 * self.lifted:.3g} % of the time")
        if self.flutters:
            said.append(
                f"flutters at {self.order:.3g} of the shaft speed, "
                f"amplitude of the tilt {1e3 * self.amplitude:.3g} mrad"
            )
        if self.rubbing > 0:
            said.append(f"rubs on the journal {100 * self.rubbing:.3g} % of the time")
        return f"Pad {self.pad} {'; it '.join(said)}." if said else ""


def of_pads(run: Run, last: float = LAST) -> list[Behaviour]:
    """What each pad does in the last revolutions, or in all that were sampled."""
    part = signals.last_revolutions(run, last)
    part = slice(part.start, part.stop - 1) if part.stop - part.start > 2 else part
    rubs = "asperity_force" in run
    touching = run.values("asperity_force", part) > 0 if rubs else np.zeros((1, run.pads), bool)
    if "pad_tilt" not in run and run.samples:
        return [
            Behaviour(i + 1, np.nan, np.nan, np.nan, share, np.nan, np.nan, False)
            for i, share in enumerate(touching.mean(axis=0))
        ]
    force, tilt = run.values("contact_force", part), run.values("pad_tilt", part)
    turns = signals.turned(run, slice(part.start, part.stop + 1))
    tilt = evenly(run, part, tilt)
    load = force.mean(axis=0)
    arc = np.radians(np.broadcast_to(run.input["pads"]["arc_deg"], run.pads))
    bearing = run.input["bearing"]
    visible = VISIBLE * bearing["assembled_clearance"] / (0.5 * arc * bearing["journal_radius"])
    found = []
    for i in range(run.pads):
        order, amplitude = np.nan, np.nan
        if turns > ENOUGH:
            order, amplitude = dominant(tilt[:, i], turns)
        flutters = bool(amplitude > visible[i] and abs(order - round(order)) > OFF_WHOLE)
        share = load[i] / max(load.sum(), np.finfo(float).tiny)
        lifted, rubbing = float((force[:, i] <= 0).mean()), float(touching[:, i].mean())
        found.append(
            Behaviour(i + 1, float(load[i]), float(share), lifted, rubbing, order, amplitude, flutters)
        )
    return found


class Whirl(NamedTuple):
    """The largest motion of the journal beside that of whole orders.

    Its order (nan where the run is short) and amplitude, m, and whether it is in sight, as a flutter is.
    """

    order: float
    amplitude: float
    whirls: bool

    def words(self) -> str:
        """A sentence, or nothing where there is no such motion."""
        if not self.whirls:
            return ""
        half = ", about half of it" if abs(self.order - 0.5) < 0.06 else ""
        size = units.in_words("size", [self.amplitude])
        return f"The journal whirls at {self.order:.3g} of the shaft speed{half}, amplitude {size}."


def whirl(run: Run, last: float = LAST) -> Whirl:
    """The whirl of the journal in the last revolutions, along that of y and z in which it is larger."""
    part = signals.last_revolutions(run, last)
    turns = signals.turned(run, part)
    part = slice(part.start, part.stop - 1)
    if turns <= ENOUGH:
        return Whirl(np.nan, 0.0, False)
    values = evenly(run, part, np.column_stack([run.values(f"journal_{each}", part) for each in "yz"]))
    apart = max(OFF_WHOLE, DRIFT / turns)
    found = max((dominant(each, turns, apart) for each in values.T), key=lambda one: one[1])
    return Whirl(*found, bool(found[1] > VISIBLE * run.clearance))


def evenly(run: Run, part: slice, values: np.ndarray) -> np.ndarray:
    """Samples, (time,) or (time, pad), at equal steps of the shaft angle; at constant speed they are that."""
    if signals.steady(run):
        return values
    angle = run.values("shaft_angle", part)
    return signals.at_angle(angle, values, np.linspace(angle[0], angle[-1], len(angle)))


def remarks(run: Run, last: float = LAST) -> list[str]:
    """A sentence on each pad that is unloaded, lifted, fluttering or rubbing."""
    return [words for each in of_pads(run, last) if (words := each.words())]


def dominant(values: np.ndarray, turns: float, apart: float = 0.0) -> tuple[float, float]:
    """Order and amplitude of the largest part of values at equal steps over so many revolutions.

    A Hann window and the higher neighbour tell them between the lines of the spectrum. Mean and drift do not
    count, nor do orders that are closer to a whole number than `apart`.
    """
    count = len(values)
    window = 2 * np.sin(np.pi * np.arange(count) / count) ** 2
    lines = 2 / count * np.abs(np.fft.rfft((values - values.mean()) * window))
    lines[:DRIFT] = 0
    orders = np.arange(len(lines)) / turns
    top = int(np.argmax(np.where(np.abs(orders - np.round(orders)) >= apart, lines, 0)[:-1]))
    if lines[top] == 0:
        return np.nan, 0.0
    side = 1 if lines[top + 1] >= lines[top - 1] else -1
    ratio = lines[top + side] / lines[top]
    beside = max(0.0, (2 * ratio - 1) / (ratio + 1))
    lost = np.sinc(beside) / (1 - beside**2)
    return float((top + side * beside) / turns), float(lines[top] / lost)
