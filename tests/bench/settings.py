"""What is run: scenes, settings and figures to reach, all in one place."""

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


@dataclass(frozen=True)
class Scene:
    """A case, with what is changed in it."""

    name: str
    label: str
    case: str
    overrides: tuple[str, ...] = ()


def film(cells: int, modes: int | None = None, rows: int | None = None) -> tuple[str, ...]:
    """Cells along the arc, axial modes, and rows of the finite volumes across half the width."""
    words = [f"film%circumferential_cells={cells}"]
    words += [f"film%axial_modes={modes}"] if modes else []
    return (*words, *([f"film%axial_cells={rows}"] if rows else []))


def tolerance(value: str) -> tuple[str, ...]:
    return (f"integration%relative_tolerance={value}",)


def together(cells: int, modes: int, value: str) -> tuple[str, tuple[str, ...]]:
    """Label and overrides: film and tolerance refined together, a row of finite volumes for eight columns."""
    return f"{cells} cells, {modes} modes, {value}", film(cells, modes, cells // 8) + tolerance(value)


#: The scenes of the diagram, and the wall seconds that each is to stay below with the defaults.
MAIN = (
    Scene("steady_tr", "frictionless", "input/paper/steady_tr.nml"),
    Scene("steady_lugre", "LuGre", "input/paper/steady_lugre.nml"),
    Scene("steady_tr_ba", "Bengisu-Akay", "input/paper/steady_tr_ba.nml"),
    Scene("runup_lugre", "run-up, LuGre", "input/paper/runup_lugre.nml"),
    Scene("four_pads", "four pads, LuGre, gumbel", "input/examples/four_pads.nml"),
)
FIGURES = {"steady_tr": 0.16, "steady_lugre": 0.35, "steady_tr_ba": 0.6, "runup_lugre": 1.5, "four_pads": 1.0}
#: Peak memory of every run of MAIN, MB; film time of `sor` on 60 x 15 over that of `auto`; one film, us.
MEMORY, FILM_RATIO, FILM_MICROSECONDS = 100, 300, 0.25
#: That one film among those timed by themselves: its state, and the solvers with their cells.
WHOLE_FILM, MODAL, SOR = "whole, none", "modal 24", "sor 60"
#: The error that every scene is to stay below, and the setting that is to reach a hundredth of it.
ALLOWED = 1e-3
FINE = ("64 cells, 12 modes, 1e-8", film(64, 12) + tolerance("1e-8"))
FINE_ALLOWED = 1e-5

#: What checkpoints cost: wall time between them (default: 300 s) and the share allowed; scenes of some 20 s.
CHECKPOINT_SECONDS, CHECKPOINT_SHARE = 8.0, 0.02
CHECKPOINT_SCENES = (
    Scene("steady_tr", "frictionless", MAIN[0].case, ("operation%duration=200",)),
    Scene("steady_lugre", "LuGre", MAIN[1].case, ("operation%duration=80",)),
    Scene("steady_lugre", "LuGre, 36 samples a revolution", MAIN[1].case,
          ("operation%duration=100", "output%samples_per_revolution=36")),
    Scene("steady_tr_ba", "Bengisu-Akay", MAIN[2].case, ("operation%duration=32",)),
    Scene("steady_lugre", "LuGre, over-relaxation", MAIN[1].case,
          ("operation%duration=2.5", "film%solver=sor")),
)  # fmt: skip
#: Members of the sweep of short runs; milliseconds allowed beyond a member's march; seconds to collect all.
MEMBERS, MEMBER_MILLISECONDS, COLLECT_SECONDS = 1000, 20, 10
#: Start of the program, which does nothing else.
START_MILLISECONDS = 20

#: Some of them without rupture, where no finite volumes stand beside the axial modes.
UNRUPTURED = tuple(
    Scene(f"{scene.name}_none", f"{scene.label}, cavitation 'none'", scene.case, ("film%cavitation=none",))
    for scene in MAIN[:3]
)

#: Refinements of the scenes of MAIN and of UNRUPTURED up to their references, the last.
LADDER = (
    together(48, 12, "1e-7"),
    together(80, 16, "1e-8"),
    together(112, 24, "1e-8"),
    together(160, 24, "1e-8"),
)
UNRUPTURED_LADDER = (
    together(48, 12, "1e-8"),
    together(64, 16, "1e-9"),
    together(96, 24, "1e-10"),
)
LADDERS = dict.fromkeys(MAIN, LADDER) | dict.fromkeys(UNRUPTURED, UNRUPTURED_LADDER)
#: Refinements of every scene of input/: the last is the reference, the other shows how far it still moves.
REFINED = (together(72, 16, "1e-7"), together(112, 16, "1e-7"))

#: Tolerance of the runs whose film is varied, and the cells of those whose modes are.
FILM_TOLERANCE, MODE_CELLS = "1e-6", 48
CELLS = tuple((f"{n} cells", film(n) + tolerance(FILM_TOLERANCE)) for n in (12, 16, 24, 32, 48))
MODES = tuple((f"{n} modes", film(MODE_CELLS, n) + tolerance(FILM_TOLERANCE)) for n in (2, 4, 8))
TOLERANCES = tuple((v, tolerance(v)) for v in ("1e-3", "1e-4", "3e-5", "1e-6", "1e-7", "1e-9"))
TOGETHER = (
    together(16, 4, "3e-5"),
    together(32, 8, "1e-6"),
    together(48, 12, "1e-7"),
    FINE,
)
#: Groups of the diagram.
DIAGRAM = {
    "defaults": (("defaults", ()),),
    "cells": CELLS,
    "modes": MODES,
    "tolerance": TOLERANCES,
    "together": TOGETHER,
}

#: Scenes for the film solvers, short because over-relaxation is slow, otherwise with the defaults.
FILM_SCENES = (
    Scene("lugre_whole", "LuGre, 6500 rpm, cavitation 'none', 0.05 s", MAIN[1].case,
          ("film%cavitation=none", "operation%duration=0.05")),
    Scene("lugre_6500", "LuGre, 6500 rpm, 0.05 s", MAIN[1].case, ("operation%duration=0.05",)),
    Scene("lugre_1500", "LuGre, 1500 rpm, 0.08 s", MAIN[1].case,
          ("operation%speed_rpm=1500", "operation%duration=0.08")),
    Scene("four_pads_short", "four pads, gumbel, 0.05 s", MAIN[4].case, ("operation%duration=0.05",)),
)  # fmt: skip
FILM_SOLVERS = (
    ("auto (default)", ()),
    ("sor 30 x 8", ("film%solver=sor", *film(30, rows=8))),
    ("sor 60 x 15", ("film%solver=sor", *film(60, rows=15))),
    ("sor 120 x 30", ("film%solver=sor", *film(120, rows=30))),
)
FILM_REFERENCE = together(160, 24, "1e-8")

#: The same pad so many times: pads of 20 degrees all around, preloaded so that each carries, 50 kg a pad.
PAD_COUNTS = (2, 4, 8, 16)

#: The scene of the peers; their tolerances are the paper's: relative, and absolute for every state.
PEER_SCENE = MAIN[1]
PEER_RELATIVE, PEER_ABSOLUTE = 1e-6, 1e-8
#: Seconds that they march: SciPy for speed, for its tolerances, with a Jacobian of its own; Octave.
LONG_SPAN, TOLERANCE_SPAN, JACOBIAN_SPAN, OCTAVE_SPAN = 0.1, 0.02, 5e-5, 0.012
#: The film of the peers within tiltpad, marched so finely that only the peers' own errors are left.
PEER_FILM = ("film%solver=sor", *film(60, rows=15))
PEER_TIGHT = (*PEER_FILM, *tolerance("1e-8"), "film%tolerance=1e-10", "film%max_sweeps=100000")
PEER_REFERENCE = together(64, 16, "1e-9")
#: Largest change of an over-relaxation sweep over the highest pressure at which the peer's film counts as
#: solved. A film solved less well shakes the right-hand side, and BDF takes many more steps.
PEER_FILM_TOLERANCE = 1e-9
