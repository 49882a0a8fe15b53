"""Prints docs/verification.md: comparison of the program's results with references, from its own runs.

usage: verify.py TILTPAD > verification.md
"""

import sys
import tempfile
from pathlib import Path

import tiltpad
import verify_coefficients
import verify_film
import verify_fits
import verify_machines
import verify_orbits
import verify_warm
from tiltpad.calculate.deviations import SIGNALS
from verify_runs import row, run

PAGE = """\
# Verification

`make docs` writes this page from runs of the program. The tests in `tests/` check the statements of this
page and more: analytic limits, orders of convergence, derivatives against differences, the energy balance,
wrong input.

## Equilibrium

The table compares the equilibrium of the paper's two pads, without unbalance and friction, with converged
values of independent programs that share no code with this one. The values in brackets are those of ROSS 3
(open-source rotordynamics, finite elements, rigid pivots). The references have no cavitation, so the first
three rows of each block have `film%cavitation = 'none'`. The last row has the default, which differs at low
speed, where the film cavitates near the trailing edge.

| pads, rpm | film | y um | reference | z um | reference | tilts mrad | reference | minimum film thickness um | reference | deviation of y, % of c_r |
|---|---|---|---|---|---|---|---|---|---|---|
{equilibria}

## Errors of the film

Largest errors at the default resolution over random films: pads of 20 to 120 degrees, lengths of 0.25 to 2 diameters,
clearances of 5 to 200 um, every direction of motion, and film thickness ratios (the thickest over the thinnest place)
up to 50. Force is over that of the full film in the same position that is just about to cavitate, driven as fast and
in the same sense along the arc. Slopes are derivatives over the position, likewise and times the thinnest film. Highest
pressure is over that of the film just about to cavitate; where half of the film or more converges, over itself, or over
a tenth of the other where this is higher. Field is the integral of the pressure field less the force. References are the axial expansion
on 640 cells (`none`), its clipped integral (`gumbel`) and extrapolated finite volumes on a film-adapted grid
(`reynolds`). `auto` has the default tolerances, 1e-5, and with `reynolds` 4e-5. `build/tests/test_film_accuracy {times}`
prints these figures, and the test holds those of fewer films below limits.

| solver, cells | condition | films | force, thickness ratio 1 to 5 | 5 to 20 | 20 to 50 | slopes | highest pressure | field |
|---|---|---|---|---|---|---|---|---|
{film_errors}

With `none` and `gumbel`, `direct` is `fourier`. With a supply pressure, `auto` is `direct` wherever a film may cavitate.

On long arcs of 150 to 360 degrees, with eccentricities up to 0.93, the largest errors of the force over that of the
full film driven as fast are (`tests/physics/test_fixed_pads.f90`):

| solver | force |
|---|---|
{long_arcs}

## The LuGre case

The table gives the ranges over the last revolution of `input/paper/steady_lugre.nml`, 2 s at 6500 rpm, with the
default settings.

| signal | here | reference | error, % of peak-to-peak |
|---|---|---|---|
{lugre}

## Default settings against tight ones

The table gives the maximum deviation in the last revolution, over the peak-to-peak or, where a pad hardly
moves, over 5 % of the characteristic scale (bearing clearance; clearance over pad radius; the moment at which
the pivot slides). The tight settings are {tight}.

| case | journal y | journal z | tilt | friction moment |
|---|---|---|---|---|
{settings}

## Stiffness and damping

Coefficients of the paper's bearing at the journal, by the task `coefficients` with `film%cavitation = 'none'`,
against independent programs; the error is over the first of the numbers.

| pads, rpm, whirl frequency over speed, pivots | coefficients | here | reference | error |
|---|---|---|---|---|
{independent}

With the default film an equilibrium is linearised with films that are closer than those of a march. The largest
difference of stiffness and damping, without pivot friction, from those with films ten times as close
({closer}), for pads of more than 149 degrees on 320 x 32 volumes, synchronous and at half and twice this
frequency, over the largest coefficient:

| bearing | stiffness | damping |
|---|---|---|
{close_films}

## Threshold speeds of stability

The first comes from `coefficients%threshold_up_to_rpm`. The last is that of a rigid rotor on the plain bearing of Lund
and Thomsen below; its Sommerfeld number is kept while the speed changes.

| rotor and bearing | here | reference |
|---|---|---|
{thresholds}

## Orbits against marches

Before and behind points where the tasks `branch` finds that stability is lost, an orbit by the task `periodic` with
its multiplier mu that crosses, and a march (tolerance 1e-10) from beside it. How the march comes back to the orbit or
leaves it gives the same multiplier: once a period, its changes are multiplied by a matrix, which has this eigenvalue.
The rates are `ln |mu|/T`, 1/s. The orbits of two revolutions exist on one side of their fold only, two of them at each
speed; the lower one was found from states that were continued over the root of the speed's distance from the fold.

| case | rpm | mu | by the march | rate, 1/s | by the march |
|---|---|---|---|---|---|
{both_sides}

## Four tilting pads: Someya's table

Someya (*Journal-Bearing Databook*, 1989), four pads of 80 degrees, load between them, L/D = 0.5, no preload. The
definitions of the table are not at hand; taken are S = mu N L D/W (R/c)^2, eccentricity over the bearing clearance,
K c/W and C c omega/W along the load, synchronous, of pads without mass on rigid pivots. Each cell gives the
program's number at that eccentricity, the table's, and how much they differ. Nothing was tuned.

| eccentricity | S | K | C |
|---|---|---|---|
{someya}

## A plain bearing with two grooves: Lund and Thomsen's table

Lund and Thomsen (1978), two fixed pads of 160 degrees, as Nicholas, Barrett and Leader (1980) use them: program / table.
K c/W and C c omega/W, x along the load.

| bearing | eccentricity | attitude angle | Kxx | Kxy | Kyx | Kyy | Cxx | Cxy | Cyx | Cyy |
|---|---|---|---|---|---|---|---|---|---|---|
{lund_thomsen}

### Where Someya's tables are not met

Some rows of these tables, in a copy that is public, cannot be those of the bearing that heads them. The rows of four
pads with the load on a pad are headed L/D = 0.5 and are those of L/D = 1. At light load this program and ROSS 3 agree,
and the tables have up to twice their numbers. Who compares a program with these tables should take loaded bearings, as
above. x is along the load, e the eccentricity over the clearance.

| bearing | number | program | ROSS 3 | table |
|---|---|---|---|---|
{lightly_loaded}

## Losses and flows

Pad 1 of the paper's bearing on rigid pivots at 6500 rpm, without cavitation, against an independent program.

| | here | reference | error |
|---|---|---|---|
{losses}

The largest errors of losses and flows of random films against sums over uniform finite volumes, extrapolated or four
times as many (`tests/physics/test_losses.f90`):

| films | error |
|---|---|
{loss_sums}

Full bearings of 360 degrees, which draw oil at the thickest place, against the tables of Raimondi and Boyd (ASLE
Transactions 1, 1958; in brackets), which are differences on a coarse grid and count a full gap in the cavitated region.
The last column counts the streamers of oil that flow there (the same test):

| L/D | e/c | S | Q_in/(R c N L) | Q_side/Q_in | friction R/c, full gap | with streamers |
|---|---|---|---|---|---|---|
{raimondi_boyd}

## Warm oil

Viscosity, mPa s, of an oil of 46 and 6.8 mm2/s at 40 and 100 C, 870 kg/m3 at 15 C and 0.64 less a kelvin, by
Walther's law:

| | here | reference | error |
|---|---|---|---|
{walther}

Bearings with a temperature for each pad, against an independent program with the same balances. The first is that of
Fillon, Bligoud and Frene (ASME Journal of Tribology 114, 1992): four pads, D = 100 mm, L = 70 mm, 10 kN between pads,
preload 0.47, VG 32 at 40 C, all oil carried over. The second is that of the paper with VG 46 at 40 C at 6500 rpm, whose
references have two or three digits. Fillon's bearing stands here twice: the first values were found on films that were
not converged, and lie up to 3e-4 (damping 1.3e-3) from those of another independent program, on finite volumes of
240 x 48 and 480 x 96 for each half of a film, extrapolated, with pads without weight. On 60 x 12 volumes the other
program has the temperatures of the first to 0.01 K, too. Its damping is known to 5e-4, as volumes cavitate one by one.

| | here | reference | error |
|---|---|---|---|
{warm_bearings}

Their maximum temperatures of the pads, C, as measured (read from a figure, within 1 K), by the authors' model with
conduction and deformation, by an independent program with temperatures along and across the films, by one with a
temperature for each pad, and here: with a temperature for each pad, with temperatures along and across the films, with
pads that bend as well, and with these and clearances of 20 C that become warm (what they were at is not known to us);
the last column is the last of these less what was measured. All models stay below the
measurements at high speed.

| rpm | measured | TEHD | along and across | a pad | here: a pad | along and across | bent | bent and warm | less measured |
|---|---|---|---|---|---|---|---|---|---|
{measured}

![Maximum temperature over the speed](images/fillon.png)

The heat of whole bearings, W: made in the films, in the oil that leaves, given to the shaft, and what is missing over
what is made.

| bearing | made | to the oil | to the shaft | missing |
|---|---|---|---|---|
{heat}

Bearings with temperatures along and across their films (`thermal%model = 'film'`, default stations and layers), against
an independent program that finds film, energy and conduction in the pad by finite volumes (120 x 24 and 240 x 48 in
each film, extrapolated). The first is Fillon's with pads that hardly weigh anything; the second has five pads, D = 101.6 mm,
L = 50.8 mm, 10 kN between two of them and VG 32; the third is that of the paper with VG 46.

| bearing | quantity | here | reference | difference |
|---|---|---|---|---|
{fields}

The five pads with an oil of 27.33 mPa s at 40 C, less by a factor of exp(0.0305) a kelvin, on all models of this
program and of ROSS 3.1 (`ross.TiltingPad`, 20 x 20 elements): thinnest film, highest temperature of a pad and that of
the shaft, loss, stiffness and synchronous damping along (y) and across (z) the load. What differs: ROSS's shaft has the
mean temperature of the films, here it takes from the warm films what it gives to the cool ones; ROSS's adiabatic
model has temperatures along the arc, `pad` one for each pad; its unloaded films cavitate in their own way.

| model | film, um | pad, C | shaft, C | loss, W | K_yy, MN/m | K_zz | C_yy, MN s/m | C_zz |
|---|---|---|---|---|---|---|---|---|
{by_ross}

The bearing of [input/examples/turbine_bearing.nml](../input/examples/turbine_bearing.nml), of one viscosity, here with
`ng_pan` and by the same ROSS, with three transitions from laminar to turbulent films (`film%laminar_below`,
`turbulent_above`): thinnest film, loss, stiffness and synchronous damping. What differs: ROSS holds its eddies where it
differentiates forces, and so has the stiffness of films whose resistance does not grow with their thickness
([turbulence](theory/turbulence.md)); here it does, and the stiffness is less, by a sixth where all is turbulent. The
share of the transition is in ROSS that of the largest Reynolds number of a film, so that all films are turbulent with 500
to 1000; here each place has its own, and the ends of the loaded pads are not. Its law of the wall begins 8.8 wall units
from it, here 10.7 as Ng and Pan have it, and so its shear and its loss are larger, the loss by an eighth. Films and
damping without a transition agree to 2 %.

| transition | film, um | loss, W | K_yy, MN/m | K_zz | C_yy, MN s/m | C_zz |
|---|---|---|---|---|---|---|
{turbulent_by_ross}

Bearings whose pads bend: thickness of the pads, their clearance, by how much pressure and heat change it at
the pad that bends most, and what stiffness and damping K_yy and C_yy are beside those of straight pads, in %: as the
pads bend by pressure alone, and by both. The last bearing is that of input/examples/bent_pads.nml with the clearances
of the input.

| bearing | thickness, mm | clearance, um | by pressure, um | by heat, um | K, pressure | C, pressure | K, both | C, both |
|---|---|---|---|---|---|---|---|---|
{bending}

What vibration changes at the end of a run-up of the paper's pads with VG 46, 3000 to 6500 rpm in 2 s with 10 ml in
each groove, of which the temperatures know nothing: the mean over the last two revolutions against a run-up without
unbalance, for each pad. The last column is the oil's warming from the leading to the trailing edge, if all heat
stayed in it.

| unbalance, kg m | vibration, peak to peak, um | over the clearance | heat, % | flow, % | warming, K |
|---|---|---|---|---|---|
{vibration}

## Machines

A rotor of 4 t with its disc in the middle, in two of the paper's bearings without cavitation at 4100 rpm, against an
independent program: Timoshenko beams, reduced after Craig and Bampton, pads with pivot friction, another integrator.
`tests/physics/test_machines.f90` and `test_machine_invariants.f90` hold these and more: orbits, the energy of a closed
orbit, limits of stiff shafts and supports.

| | here | reference | error |
|---|---|---|---|
{machine}

The disc's y at the frequency of the shaft, um: linear response, orbits without friction and with LuGre friction; here /
reference (error).

| rpm | linear | no friction | LuGre |
|---|---|---|---|
{whirl}

The shaft of this rotor with its disc in the middle, and with the disc off the middle and another one overhung, against
ROSS 3 with the same synchronous stiffness and damping of locked pads at each speed, `reduction%frequency = 1e7` and no
damping of high modes: how many modes of bending have eigenvalues up to 1000 Hz (their magnitude over 2 pi), and the
highest of them; the largest relative difference of an eigenvalue from the nearest one of the other program, of both
programs; and that of the whirl under an unbalance at all stations, y and z, over the largest amplitude.
`tests/post/test_ross_machine.py` holds both below 1e-6.

| discs | rpm | modes here | modes of ROSS | highest, Hz | eigenvalues | whirl |
|---|---|---|---|---|---|---|
{campbell_by_ross}

Rotors of Friswell, Penny, Garvey and Lees (*Dynamics of Rotating Machines*, 2010) on springs at 4000 rpm, the first six
frequencies, rad/s: here / printed.

| example | 1 | 2 | 3 | 4 | 5 | 6 |
|---|---|---|---|---|---|---|
{textbook}

Errors of amplitudes of journals and discs of random rotors with uneven sections, overhung discs and supports, at ten
speeds up to the highest, in bearings from a tenth to ten times as stiff as the shaft: of the modes that a run leaves out
and of the damping of high ones, in vibrations that grow as the estimate has it, and in steady ones. Half of the rotors,
nine of ten and all are below these errors, and below these multiples of the estimates that a run gives.

| | rotors | half | nine of ten | all | over the estimate: half | nine of ten | all |
|---|---|---|---|---|---|---|---|
{random_rotors}

## Fits

`tiltpad.fit` of three parameters at a time to the orbit of the paper's bearing with a friction coefficient of 0.1, 720
values with 1 % of normal noise, from the middle of wide bounds, {seeds} times with other noise. Deviations are over the
true value: the one told by a fit, and the root mean square of the errors. Of normal errors 95.4 % lie within two
standard deviations: of {seeds} fits from {fewest} to {most}, but for one case in a thousand (binomial distribution).

| parameter | true | standard deviation | of the errors | within two standard deviations |
|---|---|---|---|---|
{fits}
"""  # noqa: E501

# Converged equilibria: motion, rpm: y, z um, tilts mrad, minimum film thickness um, y by ROSS um.
REFERENCES = {
    ("tilting_radial", 6500): (-55.595, 0.0266, (-0.2029, 1.0269), 41.512, None),
    ("tilting_only", 6500): (-45.561, 0.0234, (-0.0920, 0.9159), 41.514, -45.61),
    ("tilting_only", 3000): (-64.229, 0.0174, (-0.2848, 1.1362), 29.154, -64.24),
    ("tilting_only", 1500): (-77.619, 0.0129, (-0.4295, 1.2879), 20.261, -77.66),
}
FINE = ("film%circumferential_cells=120", "film%axial_cells=30")
FILMS = {
    "fourier": ("film%cavitation=none",),
    "sor 60 x 15": ("film%cavitation=none", "film%solver=sor"),
    "sor 120 x 30": ("film%cavitation=none", "film%solver=sor", *FINE),
    "default (reynolds)": (),
}
# Converged last revolution of the LuGre case.
LUGRE = {
    "journal y, um": ("journal_y", 1e6, -63.16, -44.29),
    "journal z, um": ("journal_z", 1e6, -9.20, 9.82),
    "tilt of pad 1, mrad": ("pad_tilt", 1e3, -0.2324, -0.1396),
}
CASES = ("steady_tr", "steady_to", "steady_to_ba", "steady_ba_10_05", "steady_lugre", "steady_lugre5")
TABLES = (
    *verify_film.TABLES,
    *verify_coefficients.TABLES,
    *verify_orbits.TABLES,
    *verify_warm.TABLES,
    *verify_machines.TABLES,
    *verify_fits.TABLES,
)
TIGHT = (
    "film%table_tolerance=2e-6",
    "integration%relative_tolerance=1e-8",
)


def equilibria(program, folder):
    """Rows of equilibrium against reference, per film solver."""
    for (motion, speed), (ref_y, ref_z, ref_tilt, ref_film, ross) in REFERENCES.items():
        inputs = (f"pads%motion={motion}", f"operation%speed_rpm={speed}", "case%task=equilibrium")
        for name, film in FILMS.items():
            with run(program, "steady_tr", folder, *inputs, *film) as found:
                e, c_r = found.equilibrium, found.clearance
            y, z, least = (1e6 * x for x in (e["journal_y"], e["journal_z"], e["min_film_thickness"].min()))
            tilt = ", ".join(f"{1e3 * x:.4f}" for x in e["pad_tilt"])
            yield row(
                *(f"{motion}, {speed}", name, f"{y:.3f}", f"{ref_y}{f' ({ross})' if ross else ''}"),
                *(f"{z:.4f}", ref_z, tilt, ", ".join(map(str, ref_tilt)), f"{least:.3f}", ref_film),
                f"{100 * abs(1e-6 * (y - ref_y)) / c_r:.4f}",
            )


def lugre(program, folder):
    """Rows of the LuGre case's last revolution against reference."""
    with run(program, "steady_lugre", folder) as found:
        part = tiltpad.last_revolutions(found)
        for label, (name, factor, low, high) in LUGRE.items():
            values = factor * found.values(name, part).reshape(part.stop - part.start, -1)[:, 0]
            worst = max(abs(values.min() - low), abs(values.max() - high)) / (high - low)
            here = f"{values.min():.4f} to {values.max():.4f}"
            yield row(label, here, f"{low} to {high}", f"{100 * worst:.3f}")


def settings(program, folder):
    """Rows of default against tight settings."""
    for case in CASES:
        with run(program, case, folder) as quick, run(program, case, folder, *TIGHT) as exact:
            found = tiltpad.deviations(quick, exact)
            errors = [f"{found[name]:.1e}" if name in found else "-" for name in SIGNALS]
            yield row(case, *errors)


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        tables = {f.__name__: "\n".join(f(program, folder)) for f in (equilibria, lugre, settings, *TABLES)}
    if empty := [name for name, rows in tables.items() if not rows]:
        sys.exit(f"no rows of {', '.join(empty)}")
    closer = f"`{verify_coefficients.CLOSER[0]}`"
    tight = ", ".join(f"`{each}`" for each in TIGHT)
    fewest, most = verify_fits.expected()
    print(
        PAGE.format(
            closer=closer,
            tight=tight,
            times=verify_film.TIMES,
            seeds=verify_fits.SEEDS,
            fewest=fewest,
            most=most,
            **tables,
        ),
        end="",
    )


main(str(Path(sys.argv[1]).resolve()))
