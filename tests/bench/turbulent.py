"""Turbulent films: a march from tables and equilibria with temperatures against those with laminar films."""

from collections.abc import Iterator

from errors import deviations
from runner import Row, Runner
from settings import Case
from tables import short, table, verdict
from warm import CLOSE

#: A large bearing with an unbalance of grade G 2.5, so preloaded that pads with laminar films do not flutter;
#: five pads with VG 46 at 100 m/s; and what the time of a step or of a run over that with laminar films is to
#: stay below.
MARCH = Case(
    *("march", "turbine, 40 s", "input/examples/turbine_bearing.nml"),
    (
        *("case%task=march", "operation%duration=40", "rotor%unbalance=0.146"),
        "bearing%assembled_clearance=0.2e-3",
    ),
)
WARM = tuple(
    Case(
        *(f"equilibrium, {model}", f"five pads, `thermal%model = '{model}'`"),
        "input/examples/warm_five_pads.nml",
        (f"thermal%model={model}", "operation%speed_rpm=15000"),
    )
    for model in ("pad", "film")
)
MOST = {MARCH.name: 1.2, **{case.name: 1.3 for case in WARM}}
ROUNDS = 15
FILMS = (("laminar", ("film%turbulence=none",)), ("turbulent", ("film%turbulence=ng_pan",)))


def turbulent(runner: Runner) -> Iterator[Row]:
    """With laminar films, which stand first, and with turbulent ones, in turn; the least time counts."""
    for case in (MARCH, *WARM):
        runs = [runner.run(case, case.label, *film, repeat=False) for _ in range(ROUNDS) for film in FILMS]
        for film, tries in zip(FILMS, (runs[::2], runs[1::2]), strict=True):
            if tries[0][0].note:
                raise RuntimeError(f"{case.label}, {film[0]}: {tries[0][0].note}")
            row, path = min(tries, key=lambda each: each[0].work_seconds)
            if case is MARCH:
                _, reference = runner.run(case, case.label, film[0], (*film[1], *CLOSE), timed=False)
                row.compare(deviations(path, reference))
                reference.unlink()
            for _, path in tries:
                path.unlink()
            yield row


def compared(rows: list[Row]) -> str:
    """Times, and the figures to reach."""
    lines = []
    for row in rows:
        laminar = next(each for each in rows if each.case == row.case)
        marches = row.case == MARCH.name
        words = row.group, f"march, {row.steps} steps" if marches else "equilibrium", row.setting
        ratio, figure = "", ("", "")
        if row is not laminar:
            value = cost(row) / cost(laminar)
            ratio = f"{short(value)}{' a step' if marches else ''}"
            figure = f"{MOST[row.case]:g}", verdict(value, MOST[row.case])
        lines.append((*words, short(row.work_seconds), ratio, *figure, short(row.error) if marches else ""))
    return table(" | task | films | s | over laminar | to reach |  | error", lines)


def cost(row: Row) -> float:
    """Processor seconds of a step of a march, or of a whole run."""
    return row.work_seconds / (row.steps or 1)
