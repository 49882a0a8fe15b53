"""A pad without load that flutters, over the speed: the same motion at two tolerances, or not."""

import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

import tiltpad
from report import table

CASE = Path(__file__).parents[2] / "input/examples/five_pads.nml"
#: The pad without load.
PAD = 3
#: Figures of its motion in the file.
FIGURES = ("pad_order", "pad_order_amplitude")
SPEEDS = "1000:9000:250"
#: Relative tolerances of the march.
TOLERANCES = ("1e-5", "1e-6")
#: Relative difference of the amplitudes, and difference of the orders, of motions that are called the same.
SAME, SAME_ORDER = 0.02, 0.01

SECTION = """
## A pad without load

The top pad of `input/examples/five_pads.nml` carries no load and flutters. The largest part of its tilt in
the last revolutions of a second, by its order (frequency over that of the shaft) and amplitude, is compared
at relative tolerances of {tolerances}. Where they differ by more than {same:.0%} of the amplitude or by
{order} in order, the motion is chaotic or has not settled in this time, and only its size is a result.

{same_count} of {count} speeds have the same motion at both.

{rows}
"""


class Motion(NamedTuple):
    """Order of the largest part of the tilt, and its amplitude, rad."""

    order: float
    amplitude: float


def flutter(program: Path, jobs: int) -> str:
    """The section of the page, by runs with a changing speed."""
    with tempfile.TemporaryDirectory(prefix="tiltpad-flutter-") as name:
        found = [motions(program, Path(name) / each, each, jobs) for each in TOLERANCES]
    rows, same = [], 0
    for speed, loose in found[0].items():
        close = found[1][speed]
        agrees = abs(loose.amplitude - close.amplitude) <= SAME * close.amplitude
        # a pad without motion has no order
        agrees = agrees and not abs(loose.order - close.order) > SAME_ORDER
        same += agrees
        rows.append((f"{speed:.0f}", *words(loose), *words(close), "yes" if agrees else "no"))
    over = [f"{word} at {each}" for each in TOLERANCES for word in ("order", "mrad")]
    head = ("speed, rpm", *over, "the same")
    return SECTION.format(
        tolerances=" and ".join(TOLERANCES), same=SAME, order=SAME_ORDER, same_count=same, count=len(rows),
        rows=table(head, rows),
    )  # fmt: skip


def words(found: Motion) -> tuple[str, str]:
    """Order and amplitude, mrad."""
    return f"{found.order:.3f}", f"{1e3 * found.amplitude:.4f}"


def motions(program: Path, folder: Path, tolerance: str, jobs: int) -> dict[float, Motion]:
    """What the pad does, by speed, rpm."""
    settings = (f"sweep%operation%speed_rpm={SPEEDS}", f"integration%relative_tolerance={tolerance}")
    options = [word for each in settings for word in ("--set", each)]
    subprocess.run([program, CASE, "--quiet", "--jobs", str(jobs), "--output", folder, *options], check=True)
    found = {}
    for path in sorted(folder.glob("*.h5")):
        with tiltpad.read(path) as run:
            own = Motion(*(float(run[f"summary/{name}"][PAD - 1]) for name in FIGURES))
            found[float(run.input["operation"]["speed_rpm"])] = own
    return found
