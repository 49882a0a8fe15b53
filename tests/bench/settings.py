"""What is run: cases, settings and figures to reach, all in one place."""

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


@dataclass(frozen=True)
class Case:
    """A case, with what is changed in it."""

    name: str
    label: str
    input_file: str
    overrides: tuple[str, ...] = ()


def direct(columns: int, rows: int) -> tuple[str, ...]:
    """The solver `direct`: cells along the arc and across half the width."""
    return ("film%solver=direct", f"film%circumferential_cells={columns}", f"film%axial_cells={rows}")


def sor(columns: int, rows: int) -> tuple[str, ...]:
    """Over-relaxation: cells along the arc and across half the width."""
    return ("film%solver=sor", f"film%circumferential_cells={columns}", f"film%axial_cells={rows}")


def tolerance(value: str) -> tuple[str, ...]:
    """Relative tolerance of the march, which that of the table follows."""
    return (f"integration%relative_tolerance={value}",)


def table(value: str) -> tuple[str, ...]:
    """Tolerance of the film table."""
    return (f"film%table_tolerance={value}",)


def together(march: str, film: str) -> tuple[str, tuple[str, ...]]:
    """Label and overrides: tolerances of the march and of the table."""
    return f"march {march}, table {film}", tolerance(march) + table(film)


#: The cases of the diagram, and the wall seconds that each is to stay below with the defaults.
MAIN = (
    Case("steady_tr", "frictionless", "input/paper/steady_tr.nml"),
    Case("steady_lugre", "LuGre", "input/paper/steady_lugre.nml"),
    Case("steady_tr_ba", "Bengisu-Akay", "input/paper/steady_tr_ba.nml"),
    Case("runup_lugre", "run-up, LuGre", "input/paper/runup_lugre.nml"),
    Case("four_pads", "four pads, LuGre, gumbel", "input/examples/four_pads.nml"),
    Case("steady_ba_20_10", "Bengisu-Akay 0.2/0.1", "input/paper/steady_ba_20_10.nml"),
    Case("four_pads_reynolds", "four pads, LuGre, reynolds", "input/examples/four_pads.nml",
          ("film%cavitation=reynolds",)),
)  # fmt: skip
FIGURES = {
    "steady_tr": 0.10,
    "steady_lugre": 0.17,
    "steady_tr_ba": 0.33,
    "runup_lugre": 0.33,
    "four_pads": 0.40,
    "steady_ba_20_10": 0.45,
    "four_pads_reynolds": 0.45,
}
#: Peak memory of every run of MAIN, MB; film time of `sor` on 60 x 15 over that of the table; one film with
#: its derivatives, us.
MEMORY, FILM_RATIO, FILM_MICROSECONDS = 100, 1000, 0.15
#: That one film among those timed by themselves: its states and the solver.
ONE_FILMS, ONE_SOLVER = ("whole, none", "corner cavitated, reynolds"), "table, same cell"
#: The error that every case is to stay below, and the setting that is to reach a hundredth of it.
ALLOWED = 1e-3
FINE = together("1e-8", "1.6e-6")
FINE_ALLOWED = 1e-5

#: What checkpoints cost: wall time between them (default: 300 s) and the share allowed; cases of some 20 s.
CHECKPOINT_SECONDS, CHECKPOINT_SHARE = 8.0, 0.02
CHECKPOINT_CASES = (
    Case("steady_tr", "frictionless", MAIN[0].input_file, ("operation%duration=200",)),
    Case("steady_lugre", "LuGre", MAIN[1].input_file, ("operation%duration=200",)),
    Case("steady_lugre", "LuGre, 36 samples a revolution", MAIN[1].input_file,
          ("operation%duration=250", "output%samples_per_revolution=36")),
    Case("steady_tr_ba", "Bengisu-Akay", MAIN[2].input_file, ("operation%duration=80",)),
    Case("steady_lugre", "LuGre, over-relaxation", MAIN[1].input_file,
          ("operation%duration=1", "film%solver=sor")),
)  # fmt: skip
#: Runs of the study of short runs; milliseconds allowed beyond a run's march; seconds to collect all.
RUNS, RUN_MILLISECONDS, COLLECT_SECONDS = 1000, 6, 10
#: Start of the program, which does nothing else.
START_MILLISECONDS = 20

#: Some of them without cavitation: full films alone.
FULL_FILM = tuple(
    Case(f"{case.name}_none", f"{case.label}, cavitation 'none'", case.input_file, ("film%cavitation=none",))
    for case in MAIN[:3]
)

#: Refinements of the cases of MAIN and of FULL_FILM up to their references, the last.
LADDER = (
    together("1e-6", "1e-5"),
    together("1e-7", "4e-6"),
    FINE,
    together("1e-9", "1.2e-6"),
)
FULL_FILM_LADDER = (together("1e-7", "1e-5"), together("1e-8", "1e-6"), together("1e-9", "1e-7"))
LADDERS = dict.fromkeys(MAIN, LADDER) | dict.fromkeys(FULL_FILM, FULL_FILM_LADDER)
#: Refinements of every case of input/: the last is the reference, the other shows how far it still moves.
REFINED = (together("1e-7", "1e-5"), together("1e-8", "2e-6"))

#: Tolerance of the march where that of the table varies.
FILM_TOLERANCE = "1e-6"
TABLES = tuple((v, tolerance(FILM_TOLERANCE) + table(v)) for v in ("1e-3", "3e-4", "1e-4", "3e-5", "1e-5"))
TOLERANCES = tuple((v, tolerance(v)) for v in ("1e-3", "1e-4", "3e-5", "3e-6", "1e-6"))
TOGETHER = (LADDER[1], FINE)
#: The default settings but for the film.
DIRECT = (("direct", ("film%solver=direct",)),)
#: Groups of the diagram.
DIAGRAM = {
    "defaults": (("defaults", ()),),
    "tolerance": TOLERANCES,
    "table": TABLES,
    "together": TOGETHER,
    "direct": DIRECT,
}

#: Cases for the film solvers, short because over-relaxation is slow, otherwise with the defaults.
FILM_CASES = (
    Case("lugre_whole", "LuGre, 6500 rpm, cavitation 'none', 0.05 s", MAIN[1].input_file,
          ("film%cavitation=none", "operation%duration=0.05")),
    Case("lugre_6500", "LuGre, 6500 rpm, 0.05 s", MAIN[1].input_file, ("operation%duration=0.05",)),
    Case("lugre_1500", "LuGre, 1500 rpm, 0.08 s", MAIN[1].input_file,
          ("operation%speed_rpm=1500", "operation%duration=0.08")),
    Case("four_pads_short", "four pads, gumbel, 0.05 s", MAIN[4].input_file, ("operation%duration=0.05",)),
)  # fmt: skip
FILM_SOLVERS = (
    ("table (default)", ()),
    ("table 4e-6", table("4e-6")),
    ("direct (default)", ("film%solver=direct",)),
    ("sor 30 x 8", sor(30, 8)),
    ("sor 60 x 15", sor(60, 15)),
    ("sor 120 x 30", sor(120, 30)),
)
FILM_REFERENCE = LADDER[-1]
#: Films of runs with a march so fine that their errors are those of the film.
CHECK_TOLERANCE, MODES = "1e-8", ("film%axial_modes=60",)
FILM_CHECKS = tuple(
    (label, tolerance(CHECK_TOLERANCE) + overrides)
    for label, overrides in (
        ("table 4e-5", table("4e-5")),
        ("table 4e-6", table("4e-6")),
        ("direct 80 x 8", (*direct(80, 8), *MODES)),
        ("direct 160 x 16", (*direct(160, 16), *MODES)),
        ("direct 320 x 32", (*direct(320, 32), *MODES)),
    )
)

#: What a case visits of its table: it grows with the motion, not with the run.
VISITS = tuple(
    Case(f"{MAIN[1].name}_{v}", f"LuGre, {v} s", MAIN[1].input_file, (f"operation%duration={v}",))
    for v in ("0.02", "0.2", "2", "20")
) + (FULL_FILM[1], *MAIN[2:])

#: The same pad this many times: pads of 20 degrees all around, preloaded so that each carries, 50 kg a pad.
PAD_COUNTS = (2, 4, 8, 16)

#: The case of the peers; their tolerances are the paper's: relative, and absolute for every state.
PEER_CASE = MAIN[1]
PEER_RELATIVE, PEER_ABSOLUTE = 1e-6, 1e-8
#: Seconds that they march: SciPy for speed, for its tolerances, with a Jacobian of its own; Octave.
LONG_SPAN, TOLERANCE_SPAN, JACOBIAN_SPAN, OCTAVE_SPAN = 0.1, 0.02, 5e-5, 0.012
#: The film of the peers within tiltpad, marched so finely that only the peers' own errors are left.
PEER_FILM = sor(60, 15)
PEER_TIGHT = (*PEER_FILM, *tolerance("1e-8"), "film%tolerance=1e-10", "film%max_sweeps=100000")
PEER_REFERENCE = LADDER[-1]
#: Largest change of an over-relaxation sweep over the highest pressure at which the peer's film counts as
#: solved. A film solved less well shakes the right-hand side, and BDF takes many more steps.
PEER_FILM_TOLERANCE = 1e-9
