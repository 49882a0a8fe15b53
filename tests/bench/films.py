"""The film solvers against each other, and the cost of more pads."""

from collections.abc import Iterator

import numpy as np
from runner import Row, Runner
from settings import FILM_CASES, FILM_CHECKS, FILM_REFERENCE, FILM_SOLVERS, MAIN, PAD_COUNTS, Case

#: Group of the runs that check films alone; of bearings whose pads all differ.
CHECK = "check"
UNEQUAL = "each its own"


def films(runner: Runner) -> Iterator[Row]:
    """The table, `direct` and `sor` in the same settings; fine grids of `direct` check the reference."""
    references = runner.many([(case, "", *FILM_REFERENCE) for case in FILM_CASES])
    for case, (fine, reference) in zip(FILM_CASES, references, strict=True):
        if fine.note:
            raise RuntimeError(f"no reference for {case.label}: {fine.note}")
        for setting in FILM_SOLVERS:
            yield runner.judged(reference, case, "film solver", *setting)
        for setting in FILM_CHECKS:
            yield runner.judged(reference, case, CHECK, *setting, timed=False)
        reference.unlink()


def pads(runner: Runner) -> Iterator[Row]:
    """The same pad several times, and as many pads of which no two are alike."""
    for group in ("pads", UNEQUAL):
        for count in PAD_COUNTS:
            row, path = runner.run(
                ring(count), group, str(count), differing(count) if group == UNEQUAL else ()
            )
            path.unlink(missing_ok=True)
            yield row


def differing(count: int) -> tuple[str, ...]:
    """Clearances of pads that are a micrometre apart from one to the next, at most 8 in all."""
    steps = [8 * k / count for k in range(count)]
    return tuple(
        f"bearing%{name}={','.join(f'{each + step:.6g}e-6' for step in steps)}"
        for name, each in (("assembled_clearance", 60), ("machined_clearance", 100))
    )


def ring(count: int) -> Case:
    """This many pads evenly around the journal, two of them below it, each with its share of the load."""
    angles = (-45, 225) if count == 2 else [-90 + (i + 0.5) * 360 / count for i in range(count)]
    return Case(
        f"pads_{count}",
        f"{count} pads",
        MAIN[1].input_file,
        (
            f"pads%pivot_angle_deg={','.join(f'{each:g}' for each in angles)}",
            "pads%arc_deg=20",
            "bearing%assembled_clearance=60e-6",
            "film%cavitation=none",
            f"rotor%mass={50 * count}",
            f"rotor%unbalance={5e-5 * count:g}",
        ),
    )


def exponent(counts: list[int], seconds: list[float]) -> float:
    """Exponent of the power law through times over counts."""
    return float(np.polyfit(np.log(counts), np.log(seconds), 1)[0])
