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

`make bench` writes this page from its own runs; [benchmarks.csv](benchmarks.csv) contains every run. Only
the figures to reach were typed in.

{machine}

Wall times are those of the whole process, including the result file, on one core of a machine that runs
nothing else. For runs below 2 s the page gives the minimum of two or three runs. Memory is the maximum of
the process. The **error** of a run is the maximum deviation of journal y, journal z, pad tilt and friction
moment in the last revolution from a converged run of the same scene. Each deviation is over the
peak-to-peak of its signal, or over 5 % of the signal's natural scale (assembled clearance; clearance over
pad radius) if the peak-to-peak is smaller. The error must stay below {allowed:g}.

## Figures to reach

{figures}

{fine_intro}

{fine}

Without rupture the solver uses the axial modes alone. With rupture, `circumferential_cells` is also the
grid of the finite volumes, and their error remains.

## Run time against error

![Run time against error of five scenes](images/bench_diagram.png)

Each point is a run. The numbers of cells and modes vary at a tolerance of {film_tolerance}, the number of
modes with {mode_cells} cells, and the tolerance with the default film. Where a curve is level, the quantity
that varies no longer limits the error.

### The references

Each step of refinement changes film and tolerances together, and with them the finite volumes that replace
the modes where a film ruptures (one row of cells for every eight columns). The table gives the deviation of
each step from the finest:

{ladder}

{ladder_words}

The last revolution of the run-up is at full speed. The rows "whole run" give the deviations over its whole
length, which includes slow revolutions with more rupture of the film.

With `cavitation = 'gumbel'` the clipped part is integrated on separate points across the width, which the
refinement does not change. *Film solvers* shows that these points suffice: over-relaxation has its own
grid, and converges to the same result as that grid is refined.

### Choice of the defaults

The table lists all settings on all five scenes, in the order of their run time. {choice}

{settings}

## Every scene with the default settings

{cases_words}

{cases}

"Reference change" is the deviation of the second finest run from the reference. "Finite volumes" is the
share of the film evaluations that used finite volumes, with the defaults and in the reference; where the
first is smaller, the coarser film missed a rupture that the finer one found. The reference has {reference}.

{cases_notes}

## Film solvers

![Time of a pad's film against the error of the run](images/bench_films.png)

All runs of a scene are short and have the same settings except for the film. The film time is that of one
pad and includes right-hand sides and Jacobians. The error is against a converged run of the same length.

{films}

### One film

Every solver evaluates a pad of the paper that moves along a small circle about a state, as in a march; the
table gives the minimum of three batches. The error is the maximum error of the force on this path, over the
force, against a refined film. The march requests derivatives only when it needs a Jacobian.

{kernels}

## Omitted work

The program omits work that a scene does not need. The table compares each run with a run that does this
work, as nearly as the input allows: bristles with a friction coefficient of 1e-6, half the film against
twice the rows, samples as a limit of the step.

{skips}

{skips_words}

The program also omits work for which there is no run to compare with: the pressures of a film without
rupture (it computes the minimum only where rupture is possible), the blocks of Newton's matrix between
pads, and samples before `output%start_time`.

## Production

### Checkpoints

These runs make a checkpoint every {checkpoint_seconds:g} s of wall time (default: 300 s). The table gives
the time that the program itself counts for its checkpoints. A checkpoint costs a few milliseconds, the time
to write data to the disk that the system still holds in memory, and a copy of the data since the last
checkpoint. In the end the program has copied all data once, so the share depends on the megabytes per
second that a run writes, and little on the number of checkpoints. For comparison the table gives the time
of a plain copy of the whole file on this machine. A run that ends before its first checkpoint has no such
cost.

{checkpoints}

### Sweeps and studies

One call runs {members} members of 0.1 s without friction on all cores, and a second one collects their
results into one file. The time of a member "beyond its march" is its time on a core minus the time that 0.1
s more of a run takes; it contains reading, the contact table, the equilibrium, the file and its spectra.

{study}

## Scaled and scalar absolute tolerances

The paper gives its integrator one absolute tolerance, {absolute:g}, for states whose units range from
metres to radians per second. tiltpad cannot use such a tolerance: `integration%tolerance_scale` multiplies
tolerances that already follow the scale of each state. The SciPy peer below therefore compares the two,
with a relative tolerance of {relative:g}, over {tolerance_span:g} s of `steady_lugre`. The error is against
tiltpad with the same film and a small tolerance.

{tolerances}

{tolerances_words}

## Number of pads

![March time of a right-hand side over the number of pads](images/bench_pads.png)

The bearing has several equal pads of 20 degrees around the journal, with LuGre friction, a preload
(assembled clearance 60 um) such that all pads carry load, 50 kg of rotor per pad, and `cavitation =
'none'`; the runs take 2 s. The table omits a single pad, because a journal cannot rest on one pivot. March
time is wall time without sampling, divided by the number of right-hand sides.

{pads}

{pads_words}

## Peers

![Wall seconds per second of simulated time](images/bench_peers.png)

Other programs march `steady_lugre` on this machine in the same hour, from the same equilibrium and with the
same equations ([theory.md](theory.md)). Both are in `tests/bench/`:

- **SciPy**: `solve_ivp(method='BDF')`. Numba compiles the right-hand side and the film. The film uses
  projected over-relaxation on 60 x 15 cells, starts from the previous pressure, and stops when a sweep
  changes no pressure by more than {peer_film_tolerance:g} of the maximum (with a larger limit the
  right-hand side is so rough that BDF takes many more steps). The relative tolerance is {relative:g}, the
  absolute tolerances follow the scales of the states, and the Jacobian comes from differences over these
  scales.
- **Octave**: `ode15s` with the paper's tolerances ({relative:g}, {absolute:g}). A sparse direct method
  solves the film on the same grid.

Both march over a short time. The measured time is that of the march, without start and compilation, and the
time for 2 s is extrapolated from it. "Same film" is the deviation from tiltpad with the peers' film and a
small tolerance; it is the peer's own error of integration in time. "Error" is the deviation from the
converged run, which also contains the error of the film's grid.

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
