"""How run time and memory grow with the size of a task: the shaft, bearings, pads, modes, duration, runs."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from films import ring
from machines import written
from production import CASE
from runner import Row, Runner
from settings import Case
from tables import short, table

MACHINE = "&friction model = 'lugre' /\n&operation speed_rpm = 3000, duration = 0.4 /\n"
#: A rotor with its bearings at its ends.
TWO = """&disc station = {middle}, mass = 800, polar_inertia = 60, diametral_inertia = 35 /
&bearing name = 'a', station = 2 /
&bearing name = 'b', station = {last} /
"""


def long_shaft(stations: int) -> str:
    """A shaft of 3 m as many elements."""
    parts = stations - 1
    shaft = f"&shaft length = {parts}*{3 / parts:.10g}, diameter = {parts}*0.2 /\n"
    two = TWO.format(middle=stations // 2, last=parts)
    return f"&case task = 'coefficients' /\n&operation speed_rpm = 6000 /\n{shaft}{two}"


def train(bearings: int) -> str:
    """A shaft on this many bearings, four elements of half a metre from one to the next."""
    parts = 4 * bearings - 2
    shaft = f"&shaft length = {parts}*0.5, diameter = {parts}*0.3 /\n"
    stations = (f"&bearing name = 'b{k}', station = {4 * k + 2} /\n" for k in range(bearings))
    return f"{MACHINE}{shaft}{''.join(stations)}&unbalance station = 3, moment = 0.005 /\n"


def modes(frequency: int) -> str:
    """A machine with the modes of its shaft up to a frequency, Hz."""
    shaft = "&shaft length = 40*0.1, diameter = 40*0.12 /\n&unbalance station = 20, moment = 0.005 /\n"
    return f"{MACHINE}{shaft}{TWO.format(middle=20, last=40)}&reduction frequency = {frequency} /\n"


def marched(seconds: int) -> str:
    return "&friction model = 'lugre' /\n" + CASE.format(duration=seconds)


def rows(runs: int) -> str:
    return f"&case task = 'equilibrium' /\n&sweep rotor%mass = 1000:2000:{1000 / (runs - 1):.10g} /\n"


@dataclass
class Growth:
    """A task in several sizes."""

    label: str
    unit: str
    sizes: tuple[int, ...]
    #: The text of a case, or a case.
    made: Callable[[int], str | Case]


GROWTHS = {
    "stations": Growth("`coefficients` of a long shaft", "stations", (50, 100, 200, 400), long_shaft),
    "bearings": Growth("march of a shaft on many bearings", "bearings", (2, 4, 8, 16), train),
    "pads": Growth("march of a bearing (*Number of pads*)", "pads", (2, 4, 8, 16), ring),
    "modes": Growth(
        "march of a machine, modes up to 0.4 to 20 kHz", "modes", (400, 2000, 8000, 20000), modes
    ),
    "duration": Growth("march of the paper's bearing", "s", (2, 4, 8, 16), marched),
    "runs": Growth("study of equilibria", "rows", (100, 1000, 10000), rows),
}


def growth(runner: Runner) -> Iterator[Row]:
    """A row for each size; `setting` is the size, of modes how many were kept."""
    for name, each in GROWTHS.items():
        for size in each.sizes:
            made = each.made(size)
            case = made if isinstance(made, Case) else written(runner, f"{name}_{size}", each.label, made)
            row, path = runner.run(case, name, str(size))
            if name == "modes" and not row.note:
                row.setting = str(kept(path))
            path.unlink(missing_ok=True)
            yield row


def kept(path: Path) -> int:
    """The modes of the shaft that a run kept."""
    with h5py.File(path) as file:
        return len(file["rotor/mode_frequency"])


def grown(found: list[Row]) -> str:
    """The table: sizes, seconds, steps, memory, and the exponent between the two largest sizes."""
    lines = []
    for name, each in GROWTHS.items():
        mine = [row for row in found if row.group == name and row.wall_seconds and not row.note]
        if len(mine) < 2:
            continue
        sizes, seconds = [int(row.setting) for row in mine], [row.wall_seconds for row in mine]
        steps = ", ".join(f"{row.steps}" for row in mine) if mine[0].steps else "-"
        memory = ", ".join(short(row.memory_mb, 2) for row in mine)
        lines.append(
            (
                each.label,
                f"{', '.join(map(str, sizes))} {each.unit}",
                ", ".join(map(short, seconds)),
                steps,
                memory,
                short(last_exponent(sizes, seconds), 2),
            )
        )
    return table("task | sizes | wall s | steps | MB | power", lines)


def last_exponent(sizes: list[int], seconds: list[float]) -> float:
    """Exponent of the power law through the two largest sizes."""
    return float(np.log(seconds[-1] / seconds[-2]) / np.log(sizes[-1] / sizes[-2]))
