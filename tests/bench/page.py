"""The page of the benchmark: its words. Every number in it comes from the rows."""

import costs
import tables
from runner import Row
from settings import (
    ALLOWED,
    CHECKPOINT_SECONDS,
    FILM_TOLERANCE,
    FINE,
    MEMBERS,
    MODE_CELLS,
    PEER_ABSOLUTE,
    PEER_FILM_TOLERANCE,
    PEER_RELATIVE,
    REFINED,
    TOLERANCE_SPAN,
)

PAGE = """\
# Benchmarks

Written by `make bench` from its own runs, with every run in [benchmarks.csv](benchmarks.csv). Nothing on this
page was typed in but the figures to reach.

{machine}

Wall times are those of the whole process on one core with nothing else started, result file included; of
runs below 2 s the best of two or three. Memory is the peak of the process. The **error** of a run is the
largest deviation of journal y, journal z, pad tilt and friction moment in the last revolution from a
converged run of the same scene, each over that signal's peak-to-peak, or over 5 % of its natural scale
(assembled clearance; clearance over pad radius) where it moves less. It is to stay below {allowed:g}.

## Figures to reach

{figures}

{fine_intro}

{fine}

Without rupture only the axial modes are at work; with it, `circumferential_cells` is also the grid of the
finite volumes, and their error is what is left.

## Run time against error

![Run time against error of five scenes](images/bench_diagram.png)

One point a run. Cells and modes are varied at a tolerance of {film_tolerance}, modes with {mode_cells} cells,
the tolerance with the default film. Where a curve is level, what it varies no longer limits the error.

### The references

Film and tolerances are refined together, and with them the finite volumes that take over where a film
ruptures (a row for eight columns). Each rung's deviation from the finest:

{ladder}

{ladder_words}

The last revolution of the run-up is at full speed. Over its whole length, slow revolutions with more of the
film ruptured among them, the deviations are those of the rows "whole run".

With `cavitation = 'gumbel'` what is clipped is integrated on points across the width of their own; the ladder
does not refine these. That they suffice is seen under *Film solvers*, where over-relaxation, which has a grid
of its own, comes to the same result as that grid is refined.

### Choice of the defaults

All settings on all five scenes, by run time; {choice}

{settings}

## Every scene with the default settings

{cases_words}

{cases}

"Reference moves" is the deviation of the second finest run from the reference. "Ruptured" is the part of the
film evaluations that fell to finite volumes, with the defaults and in the reference; where the first is less,
the coarser film did not see a rupture that the finer one does. The reference has {reference}.

{cases_notes}

## Film solvers

![Time of a pad's film against the error of the run](images/bench_films.png)

The same short runs with the same settings but for the film; film time is that of a pad, right-hand sides and
Jacobians together. The error is against a converged run as long.

{films}

### One film

A pad of the paper by every solver, moved along a small circle about a state as a march would move it; the
shortest of three batches. The error is the largest of the force on the way, over the force, from a refined
film. Slopes, the Jacobian's part, are asked for when a Jacobian is, and only then.

{kernels}

## What is left out

What a scene does not need it does not pay for. Beside each the same run with it, as near as the input can
say so: bristles with friction of 1e-6, the half film as twice the rows, samples as a limit of the step.

{skips}

{skips_words}

Left out besides, with nothing to measure it against: the pressures of a film while it is whole (its lowest is
looked for only where it can fall), rows of Newton's matrix between pads, and samples before
`output%start_time`.

## Production

### Checkpoints

Runs with a checkpoint every {checkpoint_seconds:g} s of wall time (default: 300 s), and what the program
itself counts as the time of checkpoints. One costs a few milliseconds, the writing to the disk of what the
system still holds back, and a copy of what was written since the last one. So the share goes with the
megabytes a second that a run writes, and little with how often there is one: in the end all has been copied
once. Beside it stands how long a plain copy of the whole file takes here. A run that is over before its first
checkpoint pays nothing.

{checkpoints}

### Sweeps and studies

{members} runs of 0.1 s without friction by one call on all cores, and their results collected into one file.
"Beyond the march" is a member's time on its core less what 0.1 s more of a run takes: reading, contact table,
equilibrium, the file and its spectra.

{study}

## Scaled and scalar absolute tolerances

The paper gives its integrator one absolute tolerance, {absolute:g}, for states between metres and radians a
second. tiltpad cannot be told to: `integration%tolerance_scale` multiplies tolerances that already follow
each state's own scale. So the two are compared in the SciPy peer below, both with a relative tolerance of
{relative:g}, over {tolerance_span:g} s of `steady_lugre`. The error is against tiltpad with the same film,
marched finely.

{tolerances}

{tolerances_words}

## Number of pads

![March time of a right-hand side over the number of pads](images/bench_pads.png)

The same pad of 20 degrees several times around the journal, LuGre, preloaded (assembled clearance 60 um) so
that all carry, with 50 kg of rotor a pad, `cavitation = 'none'`, 2 s. One pad alone is left out: a journal
does not rest on a single pivot. March time is wall time without sampling, over right-hand sides.

{pads}

{pads_words}

## Peers

![Wall seconds a second of rotor time](images/bench_peers.png)

`steady_lugre` as others would march it, on this machine in the same hour, from the same equilibrium with the
same equations ([theory.md](theory.md)); both are in `tests/bench/`:

- **SciPy**: `solve_ivp(method='BDF')`, right-hand side and film compiled by Numba, film by projected
  over-relaxation on 60 x 15, warm-started, until a sweep changes no pressure by more than
  {peer_film_tolerance:g} of the highest (solved less well, it shakes the right-hand side, and BDF takes many
  more steps); relative tolerance {relative:g}, absolute ones scaled to the states, and a Jacobian by
  differences over those scales.
- **Octave**: `ode15s` with the paper's tolerances ({relative:g}, {absolute:g}), the film by a sparse direct
  solution on the same grid.

Both march a short span; only the march counts, neither start nor compilation. The time of 2 s is scaled from
it. "Same film" is the deviation from tiltpad with the peers' film, marched finely: what it leaves is the
peer's own error in time. "Error" is that from the converged run: the film's grid comes to it.

{peers}

{peers_words}
"""


def page(rows: dict[str, list[Row]], machine: str) -> str:
    """The whole page."""
    return PAGE.format(
        machine=machine,
        allowed=ALLOWED,
        figures=tables.figures(rows["diagram"], rows["films"], rows["kernels"]),
        fine_intro=f"The setting {FINE[0]}:",
        fine=tables.fine(rows["diagram"]),
        film_tolerance=FILM_TOLERANCE,
        mode_cells=MODE_CELLS,
        ladder=tables.ladder(rows["ladder"]),
        ladder_words=tables.ladder_words(rows["ladder"]),
        choice=tables.choice(rows["diagram"]),
        settings=tables.settings(rows["diagram"]),
        cases=tables.cases(rows["cases"]),
        cases_words=tables.cases_words(rows["cases"]),
        cases_notes=tables.cases_notes(rows["cases"]),
        reference=REFINED[-1][0],
        films=costs.films(rows["films"]),
        kernels=costs.kernels(rows["kernels"]),
        skips=costs.skips(rows["skips"]),
        skips_words=costs.skips_words(rows["diagram"], rows["kernels"]),
        checkpoint_seconds=CHECKPOINT_SECONDS,
        checkpoints=costs.checkpoints(rows["production"]),
        members=MEMBERS,
        study=costs.study(rows["production"]),
        absolute=PEER_ABSOLUTE,
        relative=PEER_RELATIVE,
        peer_film_tolerance=PEER_FILM_TOLERANCE,
        tolerance_span=TOLERANCE_SPAN,
        tolerances=costs.tolerances(rows["peers"]),
        tolerances_words=costs.tolerances_words(rows["peers"]),
        pads=costs.pads(rows["pads"]),
        pads_words=costs.pads_words(rows["pads"]),
        peers=costs.peers(rows["peers"]),
        peers_words=costs.peers_words(rows["peers"]),
    )
