"""Table of docs/verification.md on periodic orbits: on both sides of points where stability is lost marches
leave the orbit or come back to it as its multipliers say.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from tiltpad.calculate import branches
from verify_runs import EXAMPLES, row, run

FOUR = EXAMPLES / "four_pads.nml"
#: Orbits and marches have the same films: these do not follow the tolerance.
FILMS = ("film%table_tolerance=2e-6",)
ORBIT = ("case%task=periodic", "integration%relative_tolerance=1e-6", "output%samples_per_revolution=20")
MARCH = ("start%from=file", "integration%relative_tolerance=1e-10", "output%samples_per_revolution=3")


class Point(NamedTuple):
    """A bifurcation point of a branch over the speed, which is on the way between both `sides`, rpm.

    `multiplier` is the place of the one that crosses there. Marches start beside the orbit by `beside`; when
    the first of their periods are skipped, and this number of `modes` of the motion is left.
    """

    words: str
    case: str | Path
    overrides: tuple[str, ...]
    beside: str
    sides: tuple[float, float]
    of: str = "periodic"
    special: int = 0
    multiplier: int = 0
    modes: int = 2
    periods: int = 60
    skipped: int = 20


def lugre(static, dynamic):
    return f"friction%static_coefficient={static}", f"friction%dynamic_coefficient={dynamic}"


JOURNAL, UPPER_PADS = "start%journal=1e-8,0", "start%pad_tilt=0,0,1e-5,-1e-5"
LIGHT = ("rotor%mass=200", "rotor%unbalance=0", "film%cavitation=none")
PAPER, PAIRS = "steady_lugre", {"modes": 4, "periods": 160}
POINTS = (
    Point(
        *("200 kg, no friction, no unbalance", "steady_tr", LIGHT, "start%journal=1e-7,0", (14800, 15100)),
        **{"of": "equilibrium", "modes": 4},
    ),
    Point("LuGre 0.2/0.1", PAPER, lugre(0.2, 0.1), JOURNAL, (9350, 9420)),
    Point("LuGre 0.15/0.075", PAPER, lugre(0.15, 0.075), JOURNAL, (9480, 9560)),
    Point("Bengisu-Akay 0.2/0.1", "steady_ba_20_10", (), JOURNAL, (8600, 8760)),
    Point("four pads", FOUR, (), UPPER_PADS, (5200, 5600), **PAIRS),
    Point("four pads", FOUR, (), UPPER_PADS, (5400, 5900), special=1, multiplier=2, **PAIRS),
)
#: Orbits of two revolutions of four pads: speeds at which those of one side of their fold are found, one from
#: the next; the last ones give the other side.
FOLD_SPEEDS = (6700, 6450, 6350, 6300, 6260, 6230)
FOLD = Point(
    *(
        "four pads, two revolutions",
        FOUR,
        ("periodic%revolutions=2",),
        "start%pad_tilt=0,0,1e-6,-1e-6",
        (6230, 6230),
    ),
    **{"modes": 3, "periods": 30, "skipped": 4},
)
PAD_STATES = ("pad_tilt", "pad_tilt_rate", "pivot_deflection", "pivot_deflection_rate")


def at(speed):
    return f"operation%speed_rpm={speed:.17g}"


def from_file(result):
    return f'start%file="{result.path}"'


def bifurcation_point(program, folder, point, first, last, *overrides):
    """The bifurcation point of the branch from one speed to another, rpm."""
    way = (f"branch%of={point.of}", f"branch%last={last:.17g}", f"branch%step={(last - first) / 4:.17g}")
    task = ("case%task=branch", 'branch%parameter="operation%speed_rpm"')
    if point.of == "periodic":
        task = (*task, "branch%switch=.false.")
    with run(
        program, point.case, folder, *point.overrides, *FILMS, *task, *way, at(first), *overrides
    ) as result:
        return branches.bifurcations(result)[point.special]


def multipliers(orbit):
    return orbit["periodic/multiplier_real"] + 1j * orbit["periodic/multiplier_imag"]


def marched(program, folder, point, orbit):
    """The factors of a period by which a march leaves an orbit, or comes back to it, one for each mode.

    The changes of the motion from one period to the next are multiplied by a matrix in each period, which has
    as many dimensions as modes are left.
    """
    turns = int(orbit["periodic/revolutions"])
    speed = orbit.input["operation"]["speed_rpm"]
    duration = f"operation%duration={60 * turns * (point.periods + 0.01) / speed:.17g}"
    inputs = [each for each in point.overrides if not each.startswith("periodic")]
    with run(
        program,
        point.case,
        folder,
        *inputs,
        *FILMS,
        *MARCH,
        at(speed),
        duration,
        point.beside,
        from_file(orbit),
    ) as march:
        # tilts as what they move the ends of a pad by
        radius = march.input["bearing"]["journal_radius"]
        series = np.vstack([march.journal_y, march.journal_z, radius * march.pad_tilt.T])[:, :: 3 * turns]
    changes = np.diff(series[:, point.skipped : point.periods + 1])
    u, s, v = np.linalg.svd(changes[:, :-1], full_matrices=False)
    u, s, v = u[:, : point.modes], s[: point.modes], v[: point.modes]
    return np.linalg.eigvals(u.T @ changes[:, 1:] @ v.T / s)


def compared(program, folder, point, orbit, words, expected):
    """The row of an orbit whose multiplier is compared with the march."""
    found = marched(program, folder, point, orbit)
    nearest = found[np.argmin(abs(found - expected))]
    rates = [np.log(abs(each)) / orbit["periodic/period"] for each in (expected, nearest)]
    # of a pair the one above the axis
    values = [
        f"{each.real:.5f}" + (f" +- {abs(each.imag):.5f} i" if each.imag else "")
        for each in (expected, nearest)
    ]
    return row(
        words, f"{orbit.input['operation']['speed_rpm']:.0f}", *values, *(f"{each:.3f}" for each in rates)
    )


def both_sides(program, folder):
    """Rows of marches against multipliers, before and behind bifurcation points, and on both sides of a
    fold."""
    for point in POINTS:
        special = bifurcation_point(program, folder, point, *point.sides)
        words = f"{point.words}: {branches.KINDS[special.kind][1]} at {special.parameter:.2f} rpm"
        for speed in point.sides:
            with run(program, point.case, folder, *point.overrides, *FILMS, *ORBIT, at(speed)) as orbit:
                yield compared(program, folder, point, orbit, words, multipliers(orbit)[point.multiplier])
    yield from fold_rows(program, folder)


def fold_rows(program, folder):
    """Rows of both orbits beside a fold."""
    inputs = (*FOLD.overrides, *FILMS, *ORBIT)
    orbits = []
    for speed in FOLD_SPEEDS:
        start = ("start%from=file", from_file(orbits[-1])) if orbits else ()
        orbits.append(run(program, FOUR, folder, *inputs, at(speed), *start))
    fold = bifurcation_point(program, folder, FOLD, speed, 6100, "start%from=file", from_file(orbits[-1]))
    words = f"{FOLD.words}: fold at {fold.parameter:.2f} rpm"
    values = multipliers(orbits[-1])
    real = values[(values.imag == 0)][0]
    yield compared(program, folder, FOLD, orbits[-1], f"{words}, upper", real)
    # the states are smooth over the root of the way from the fold, which is negative on the other side
    with run(program, FOUR, folder, *inputs, at(speed), *other_side(orbits[-4:], fold.parameter)) as lower:
        yield compared(program, folder, FOLD, lower, f"{words}, lower", multipliers(lower)[0])
    for each in orbits:
        each.close()


def other_side(orbits, fold):
    """The start near the orbit on the other side of the fold at the speed of the last of these orbits."""
    roots = [np.sqrt(orbit.input["operation"]["speed_rpm"] - fold) for orbit in orbits]
    states = {
        "journal": [(each.journal_y[0], each.journal_z[0]) for each in orbits],
        "journal_velocity": [(each.journal_vy[0], each.journal_vz[0]) for each in orbits],
        **{name: [each[name][0] for each in orbits] for name in PAD_STATES},
    }
    beyond = {
        name: np.polyval(np.polyfit(roots, x, len(roots) - 1), -roots[-1]) for name, x in states.items()
    }
    return (
        "start%from=given",
        *(f"start%{name}={','.join(f'{x:.17g}' for x in beyond[name])}" for name in beyond),
    )


TABLES = (both_sides,)
