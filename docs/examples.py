"""Runs the commands of docs/examples.md, writes its pictures and compares the figures in its text.

usage: examples.py TILTPAD FOLDER-FOR-RUNS
"""

import contextlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import tiltpad

DOCS = Path(__file__).resolve().parent
#: The section on fits, whose blocks of Python are run.
FIT = "Which friction coefficient has my machine?"
#: Inputs of the tolerances that the page speaks of.
NAMES = ("assembled_clearance", "preload", "bristle_stiffness")
#: Place of the pivots that stick, behind free ones.
STUCK = 1


def commands(page: str) -> list[str]:
    """The commands of a page, a line each."""
    return [line for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL) for line in block.splitlines()]


def python(page: str, heading: str) -> list[str]:
    """The blocks of Python of a section."""
    section = page.partition(f"## {heading}")[2].partition("\n## ")[0]
    return re.findall(r"```python\n(.*?)```", section, re.DOTALL)


def fits(page: str, folder: Path) -> Iterator[str]:
    """What the page says of its fits."""
    names: dict = {}
    with contextlib.chdir(folder):
        for block in python(page, FIT):
            exec(block, names)
    fit, more = names["fit"], names["more"]
    friction, stiffness, clearance = map(fit.in_words, range(3))
    yield f"The friction coefficient is {friction}, the stiffness {stiffness}, the clearance {clearance},"
    yield f"is now {more.in_words(0)}, and still found"
    least = np.abs(more.correlation[1:, 1:]).min()
    yield f"have correlations of {np.floor(1e3 * least) / 1e3:g} and more"
    yield f"no better than to {1e6 * more.deviations[2]:.1f} µm"


def figures(folder: Path) -> Iterator[str]:
    """What the page says of its results, with the figures that they have."""
    with tiltpad.read_study(folder / "speeds.h5") as study:
        cross = 1e-6 * tiltpad.coefficients(study, "free").stiffness[1, 0, 0, 1]
        yield f"its cross-coupled stiffness is {cross:.0f} MN/m"
    with tiltpad.read(folder / "up.h5") as run:
        yield f"near {100 * round(tiltpad.response(run).peaks[0].speed_rpm / 100)} rpm"
    with tiltpad.read_study(folder / "lobes.h5") as study:
        found = tiltpad.modes(study, "locked")
    growth = np.nanmax(found.eigenvalue.real, axis=1)
    for preload, words in (
        (0, "unstable from {} rpm on"),
        (0.3, "adds little ({} rpm)"),
        (0.5, "holds to {} rpm"),
    ):
        lobes = found.parameters["preload"] == preload
        yield words.format(100 * round(np.interp(0, growth[lobes], found.speed_rpm[lobes]) / 100))
    with tiltpad.read_study(folder / "tolerances.h5") as study:
        low, *_, high = 100 * tiltpad.percentiles(study, "least_damping_ratio", pivot="stuck").values[0]
        yield f"the damping ratio is {low:.0f} to {high:.0f} % in nine of ten"
        shafts, pads = (
            tiltpad.outcomes(study, "stuck").unstable.share,
            study["pads_damping_ratio"][:, STUCK] < 0,
        )
        yield f"the shaft is unstable in {100 * shafts:.0f} % of them, and a pad in {100 * pads.mean():.0f} %"
        locked, stuck = (
            tiltpad.sensitivity(study, "threshold_rpm", pivot=own) for own in ("locked", "stuck")
        )
    clearance, preload = (100 * locked.first[locked.inputs.index(name)] for name in NAMES[:2])
    yield f"clearance ({clearance:.0f} % of the variance) and preload ({preload:.0f} %)"
    yield f"its stiffness comes first ({100 * stuck.first[stuck.inputs.index(NAMES[2])]:.0f} %)"
    yield f"{100 * locked.explained:.0f} % here, and {100 * stuck.explained:.0f} % with pivots that stick"
    yield f"of {stuck.runs} bearings that have a threshold speed"


def bent(folder: Path) -> Iterator[str]:
    """The same of pads that bend and clearances that become warm."""
    with tiltpad.read(folder / "large.h5") as run:
        rest, shape = run.equilibrium, run["shape"]
        highest = rest["maximum_temperature"]
        yield f"pads 1 and 2 reach {highest[0]:.0f} and {highest[1]:.0f} °C at their trailing edges"
        assert (
            rest["surface_temperature"][:2].argmax(axis=1).min() >= rest["surface_temperature"].shape[1] - 2
        )
        yield f"the shaft has {rest['shaft_temperature']:.0f} °C"
        both = shape["elastic_bending"][0] + shape["thermal_bending"][0]
        yield f"bend pad 1 by {1e6 * both:.0f} um of its pad clearance"
    with tiltpad.read_study(folder / "thick.h5") as study:
        thin, usual = (np.flatnonzero(np.isclose(study["thickness"], each))[0] for each in (0.03, 0.06))
        found = tiltpad.coefficients(study, "free")
        stiff, damp = (
            100 * (1 - values[thin, 0, 0, 0] / values[usual, 0, 0, 0])
            for values in (found.stiffness, found.damping)
        )
        films = 1e6 * study["equilibrium_min_film_thickness"]
        yield f"{damp:.0f} % less damping and {stiff:.0f} % less stiffness than those of 60 mm"
        yield f"films of {films[thin]:.1f} um in place of {films[usual]:.1f} um"
    with tiltpad.read_study(folder / "housing.h5") as study:
        cold, *_, warm = 1e6 * study["equilibrium_bearing_clearance"]
        damping = tiltpad.coefficients(study, "free").damping[:, 0, 0, 0]
        yield f"at {study['housing_temperature'][-1]:.0f} °C the bearing clearance is {warm:.0f} um"
        yield f"in place of {cold:.0f} um, and the damping {100 * (1 - damping[-1] / damping[0]):.0f} % less"


def machines(folder: Path) -> Iterator[str]:
    """The same of the machines."""
    with h5py.File(folder / "turbine_modes.h5") as run:
        _, stuck, locked = run["modes/threshold_rpm"]
        yield f"With stuck pivots the threshold speed is {stuck:.0f} rpm"
        yield f"one with locked pads says {locked:.0f} rpm"
    with h5py.File(folder / "turbine_branch.h5") as run:
        yield f"The orbit loses its stability at {run['bifurcations/parameter'][0]:.0f} rpm"
    middle = 6
    with h5py.File(folder / "turbine_below.h5") as run:
        size = 1e6 * run["summary/station_y_size"][middle]
        yield f"comes to the orbit of the branch, {size:.1f} um peak to peak at the wheel in the middle"
    with h5py.File(folder / "turbine_above.h5") as run:
        size = 1e6 * np.ptp(run["station_y"][-50 * 60 :, middle])
        order = run["bearings/front/summary/whirl_order"][()]
        yield f"a limit cycle of {size:.0f} um at {order:.2f} of the shaft speed"
        yield f"that is {order * 7600 / 60:.0f} Hz"
    with h5py.File(folder / "compressor.h5") as run:
        levels = run["stability"]
        yield f"of the ten stages is {1e-6 * levels['anticipated_cross_stiffness'][()]:.2f} MN/m"
        with_seals = levels["log_decrement"][0, :, 0]
        yield "With all seals its decrement is {:.2f}, and {:.2f} with synchronously".format(*with_seals)
    with h5py.File(folder / "compressor_bare.h5") as run:
        full, reduced = run["stability/log_decrement"][0, :, 4]
        zero = run["stability/zero_cross_stiffness"][0] / run["stability/anticipated_cross_stiffness"][()]
        yield f"the decrement with Q_A is {full:.3f}, and 0 at {zero[0]:.2f} times Q_A"
        yield f"Synchronously reduced coefficients say {reduced:.2f} and {zero[1]:.2f}"
    with h5py.File(folder / "aero.h5") as run:
        assert run["bifurcations/kind"].asstr()[:].tolist() == ["fold", "fold"]
        up, down = run["bifurcations/point"][:].astype(int) - 1
        high, low = run["bifurcations/parameter"][:]
        ratio = run["damper_eccentricity"][:, 0]
        yield f"turns back at {high:.0f} rpm, where the front ring goes to {ratio[up]:.2f} of its clearance"
        yield f"again at {low:.0f} rpm, at {ratio[down]:.2f}"
    with h5py.File(folder / "aero_modes.h5") as run:
        parts, modes = run["modes/element_decrement"][0], run["modes/log_decrement"][0]
        lowest = run["modes/frequency"][0][: len(modes)].argsort()
        first = next(k for k in lowest if modes[k] > 0)
        yield f"{parts[first, 2:].sum():.3f} of the decrement of {modes[first]:.3f}"
    with h5py.File(folder / "overhung.h5") as run:
        small, large = sorted(-run["equilibrium/bearing_load_y"][:])
        yield f"The bearing at the impeller bears {large:.0f} N and the other one {small:.0f} N"
    with h5py.File(folder / "overhung_response.h5") as run:
        response = 1e6 * run["station_y_amplitude"][:]
        peak = response[:, 7].argmax()
        speed = 100 * round(run["parameter"][peak] / 100)
        yield f"a flat peak of {response[peak, 7]:.1f} um near {speed} rpm"
        yield f"the journal beside it moves by {response[peak, 6]:.1f} um"
    with tiltpad.read_study(folder / "overhung_speeds.h5") as study:
        peak = next(each for each in tiltpad.response(study, station=8).peaks if each.direction == "y")
        yield f"its amplification factor (AF) is {peak.amplification_factor:.2f}"
    with h5py.File(folder / "level.h5") as level, h5py.File(folder / "raised.h5") as raised:
        loads = [-run["equilibrium/bearing_load_y"][:] for run in (level, raised)]
        for name, *both in zip(level["bearing"].asstr(), *loads, strict=True):
            yield "| `{}` | {:.0f} | {:.0f} |".format(name, *both)
        yield f"moves {100 * (loads[1][1] / loads[0][1] - 1):.0f} % more load to the middle bearing"


def main() -> None:
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "input").symlink_to(DOCS.parent / "input")
    path = os.pathsep.join([str(program.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    page = (DOCS / "examples.md").read_text()
    for line in commands(page):
        subprocess.run(["sh", "-c", line], check=True, cwd=folder, env=os.environ | {"PATH": path})
    os.environ["TILTPAD"] = str(program)
    found = (*figures(folder), *bent(folder), *machines(folder), *fits(page, folder))
    wrong = [words for words in found if words not in page]
    if wrong:
        sys.exit(f"docs/examples.md: other figures now: {wrong}")
    for picture in folder.glob("example_*.png"):
        shutil.copy(picture, DOCS / "images")


if __name__ == "__main__":
    main()
