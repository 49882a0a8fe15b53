"""The page of the benchmark: its words. Every number in it comes from the rows."""

import costs
import elements
import growth
import limits
import machines
import maps
import orbits
import settings
import slopes
import studies
import tables
import turbulent
import warm
from errors import JUMP
from runner import Row

PAGE = """\
# Benchmarks

`make bench` writes this page from its own runs; [benchmarks.csv](benchmarks.csv) contains every run. Only
the figures to reach, and why a case errs by more, were typed in.

{machine}

Wall times are those of the whole process, including the result file, on one core of a machine that runs
nothing else. For runs below 2 s the page gives the minimum of two or three runs. Memory is the maximum of
the process. The **error** of a run is the maximum deviation of journal y, journal z, pad tilt and friction
moment in the last revolution, with `&excitation` over the whole run, from a converged run of the same case.
Each deviation is over the peak-to-peak of its signal, or over 5 % of the signal's characteristic scale
(bearing clearance; clearance over pad radius; the moment at which the pivot slides) if the peak-to-peak is
smaller. The error must stay below {allowed:g}. That is said of the cases of this page alone: bearings with
unloaded pads may err by more, as `make realistic` counts.

A signal that jumps is compared by two numbers, by one rule for all cases. Where the converged signal
changes by more than {jump:.0%} of its peak-to-peak from one sample to the next, a deviation tells when the
signal jumps, not how far it errs. At these samples the shift of the jump in time counts, which is the
deviation over the change per sample; the tables give it in degrees of the shaft. It is not part of the
error. All other samples count as above. The friction moment of `steady_ba_20_10`, which jumps when a pad
starts to stick, is the main example.

## Figures to reach

{figures}

{fine_intro}

{fine}

## Run time against error

![Run time against error](images/bench_diagram.png)

Each point is a run. The tolerance of the table follows that of the march, or varies at a tolerance of the
march of {film_tolerance}. Where a curve is level, the quantity that varies no longer limits the error.
`direct` solves every film instead, with the default tolerance.

### The references

Each step of refinement changes both tolerances together. The film of a table's nodes becomes finer with its
tolerance, down to 1e-6; *Film solvers* compares the references with `direct` on fine grids, over short
runs. The table gives the deviation of each step from the finest:

{ladder}

{ladder_words}

The last revolution of the run-up is at full speed. The rows "whole run" give the deviations over its whole
length, which includes slow revolutions with more cavitation of the film.

### Choice of the defaults

The table lists all settings on all cases, in the order of their run time. {choice}

{settings}

## Every case with the default settings

{cases_words}

{cases}

"Cells" and "nodes" are those that the run built of its film table. "Jumps" is the largest shift of a jump.
"Reference change" is the deviation of the second finest run from the reference. The reference has
{reference}.

{cases_notes}

## Film solvers

![Time of a pad's film against the error of the run](images/bench_films.png)

All runs of a case are short and have the same settings except for the film. The film time is that of one
pad and includes right-hand sides and Jacobians, but not the building of tables, which stands beside it. The
error is against a run of the same length with the table and {film_reference}.

{films}

The march has the default tolerance there, and its error is a part of the error. With a march of
{check_tolerance} the error is that of the film. The independent check of the references is that `direct`
comes closer to them as its grid becomes finer; its error is of second order.

{film_checks}

### One film

Every solver evaluates a pad of the paper that moves along a small circle about a state, as in a march; the
table gives the minimum of three batches. The error is the maximum error of the force on this path, over the
maximum force, against a refined film. "Wandering" goes over a circle of 30 um in steps of two fifths of a
turn, so that nearly every film lies in another cell. The march requests derivatives only when it needs a
Jacobian.

{kernels}

### What runs build

A cell is built when the motion first enters it. So the table grows with the motion, not with the run, and
what a case does not visit it does not build: no node without cavitation, few over an orbit, more over a
run-up.

{visits}

## Omitted work

The program omits work that a case does not need. The table compares each run with a run that does this
work, as nearly as the input allows: bristles with a friction coefficient of 1e-6, half the film against
twice the rows, samples as a limit of the step.

{skips}

{skips_words}

The program also omits work for which there is no run to compare with: the pressures of a film without
cavitation (it computes the minimum only where cavitation is possible), the blocks of Newton's matrix between
pads, and samples before `output%start_time`.

## Periodic orbits

The task `periodic` finds the motion on which these marches of 2 s settle. Both are timed as whole processes,
in turn, with the defaults; the best of {orbit_rounds} counts. The error is that of the orbit over its
period, against an orbit with {orbit_reference}.

{orbits}

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

### Parameter studies

One call runs {runs} runs of 0.1 s without friction on all cores, and a second one collects their
results into one file. The time of a run "beyond its march" is its time on a core minus the time that 0.1
s more of a run takes; it contains reading, the contact table, the equilibrium, the file and its spectra.

{study}

Studies whose runs keep their figures alone (`output%keep = 'summary'`) are one file from the beginning. The
equilibria are those of the paper's bearing with seven sampled inputs; the study that is killed on its way is
compared with the one that was not, number by number.

{studies}

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
(bearing clearance 60 um) such that all pads carry load, 50 kg of rotor per pad, and `cavitation =
'none'`; the runs take 2 s. The table omits a single pad, because a journal cannot rest on one pivot. Pads
that are *each its own* have clearances that differ by up to 8 um, and share no tables of films. March time
is wall time without sampling, divided by the number of right-hand sides.

{pads}

{pads_words}

## Growth

How time and memory grow with the size of a task. The power is that of a law through the two largest sizes; 1
is linear. Steps are given where a task marches: where they grow, too, the motion is another one. On many
bearings it is LAPACK's eigenvalues of the whole machine that grow faster, with the cube: one search says
whether the equilibrium is stable, one at most which orders of BDF are.

{growth}

## Now over limit

What users wait for, beside the part of it that the physics or a library takes in any case: below this no
change of this program gets.

{limits}

## An older commit beside it

The last comparison by `make speed OLD=COMMIT`: processor times in pairs and instructions, over those of the
older commit; its noise is that of the older program against itself.

{speed}

## Peers

![Wall seconds per second of simulated time](images/bench_peers.png)

Other programs march `steady_lugre` on this machine in the same hour, from the same equilibrium and with the
same equations ([theory](theory/film.md)). Both are in `tests/bench/`:

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

## Coefficients: ROSS beside it

A map of stiffness and damping over {map_speeds} speeds from {map_first:g} to {map_last:g} rpm and
{map_ratios} whirl frequencies: a study of this program on one core, a file for each speed, and ROSS 3.1
(`ross.TiltingPad`), which solves some of the speeds at one frequency; its map is extrapolated from them.
The bearing is one that both describe: five pads with a preload of {map_preload:g}, the load between two of
them, rigid pivots, pads nearly without mass, oil of one viscosity, laminar. ROSS's time starts when its
code is compiled and has solved one speed; it does more than is asked here for (it has a thermal model, for
instance, that is switched off). ROSS finds the equilibrium anew for each frequency. "K" and "K and C"
are the largest differences of an element from tiltpad's, over the largest element; they contain the grid of
ROSS, and both programs treat the cavitation of the film in their own way. ROSS 3.1 asks for Python 3.13;
where that is not at hand it runs on an older one, which its code allows.

{maps}

## Warm oil

Equilibria with a temperature for each pad against those with the viscosity of the supply, as whole runs; maps
of {warm_speeds} speeds, a file for each; and marches with the viscosities of their equilibrium. An oil whose
viscosity does not fall makes the march with temperatures the same, step by step, as the one without. Times of
marches are those of the march alone; their errors are the largest deviation in the last revolution from the
same march with {warm_close}.

{warm}

## Turbulent films

A march from tables and equilibria with temperatures against the same ones with laminar films: processor time
of whole runs, the least of {turbulent_rounds} of each in turn. The error of the march is that of *Warm oil*.

{turbulent}

## Machines

Elastic rotors on several bearings of the paper, with the defaults: {machine_speed} rpm and LuGre friction
where nothing else is said. Errors are the largest deviations of all stations, and of the pads' tilts, from
a run with {reference}: in the last revolution, in the run-up over all of it, over the largest peak-to-peak;
for the modes those of all vibrations below five times the speed, from a map with closer films. ROSS marches
the rotor, which is not reduced, on the stiffness and damping of its bearings at this speed and free pivots,
and finds the modes on those that this program gave it for each speed; its error is that of the whirl of the
disc, of linear bearings without friction. SciPy marches the same equations for {machine_span:g} s with the
film of *Peers* and is extrapolated from there; its error is the largest deviation from this program with
this film.

{machines}

## Seals and dampers

The examples `compressor.nml`, with ten labyrinths and a balance piston over speed and frequency, and
`aero.nml`, processor time of the fastest of several runs: modes over the speed; stability level I with the
least and the largest clearance of the bearings; a march in two squeeze film dampers, beside the same without.

{elements}

## Pads that pitch

The paper's bearing at 6500 rpm for 0.2 s, on a journal with a vertical slope: pads that pitch, and pitch and
yaw, beside the same that only tilt, without a slope. Films with small slopes are from tables, the others are
solved ([pads that pitch and yaw](theory/pitch_and_yaw.md)).

{slopes}
"""


def page(rows: dict[str, list[Row]], machine: str, speed: str) -> str:
    """The whole page; `speed` is what make speed printed last, if it did."""
    return PAGE.format(
        machine=machine,
        allowed=settings.ALLOWED,
        figures=tables.figures(rows["diagram"], rows["films"], rows["kernels"]),
        fine_intro=f"The setting {settings.FINE[0]}:",
        fine=tables.fine(rows["diagram"]),
        film_tolerance=settings.FILM_TOLERANCE,
        jump=JUMP,
        ladder=tables.ladder(rows["ladder"]),
        ladder_words=tables.ladder_words(rows["ladder"]),
        choice=tables.choice(rows["diagram"]),
        settings=tables.settings(rows["diagram"]),
        cases=tables.cases(rows["cases"]),
        cases_words=tables.cases_words(rows["cases"]),
        cases_notes=tables.cases_notes(rows["cases"]),
        reference=settings.REFINED[-1][0],
        film_reference=settings.FILM_REFERENCE[0],
        check_tolerance=settings.CHECK_TOLERANCE,
        film_checks=costs.film_checks(rows["films"]),
        visits=costs.visits(rows["visits"]),
        films=costs.films(rows["films"]),
        kernels=costs.kernels(rows["kernels"]),
        skips=costs.skips(rows["skips"]),
        skips_words=costs.skips_words(rows["diagram"], rows["kernels"]),
        orbit_rounds=orbits.ROUNDS,
        orbit_reference=orbits.REFERENCE,
        orbits=orbits.compared(rows["orbits"]),
        checkpoint_seconds=settings.CHECKPOINT_SECONDS,
        checkpoints=costs.checkpoints(rows["production"]),
        runs=settings.RUNS,
        study=costs.study(rows["production"]),
        studies=studies.written(rows["studies"]),
        absolute=settings.PEER_ABSOLUTE,
        relative=settings.PEER_RELATIVE,
        peer_film_tolerance=settings.PEER_FILM_TOLERANCE,
        tolerance_span=settings.TOLERANCE_SPAN,
        tolerances=costs.tolerances(rows["peers"]),
        tolerances_words=costs.tolerances_words(rows["peers"]),
        pads=costs.pads(rows["pads"]),
        pads_words=costs.pads_words(rows["pads"]),
        growth=growth.grown(rows["growth"]),
        limits=limits.over(rows["limits"], rows["kernels"]),
        speed=f"```text\n{speed}```" if speed else tables.NOT_RUN,
        peers=costs.peers(rows["peers"]),
        peers_words=costs.peers_words(rows["peers"]),
        map_speeds=len(maps.SPEEDS),
        map_first=maps.SPEEDS[0],
        map_last=maps.SPEEDS[-1],
        map_ratios=len(maps.RATIOS),
        map_preload=maps.B.preload,
        maps=maps.compared(rows["maps"]),
        warm_speeds=warm.MAP_SPEEDS,
        warm_close=" and ".join(f"`{each}`" for each in warm.CLOSE),
        warm=warm.compared(rows["warm"]),
        turbulent_rounds=turbulent.ROUNDS,
        turbulent=turbulent.compared(rows["turbulent"]),
        machine_speed=machines.SPEED,
        machine_span=machines.SPAN,
        machines=machines.compared(rows["machines"]),
        elements=elements.compared(rows["elements"]),
        slopes=slopes.compared(rows["slopes"]),
    )
