"""The tutorial: each of its commands is run, in its order, in an empty folder."""

import contextlib
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import tiltpad
from tiltpad import command
from tiltpad.calculate import basins
from tiltpad.draw import bearing

BLOCK = re.compile(r"```(\w+)( fails| ross)?\n(.*?)```", re.DOTALL)
#: Commands of the package. They and Python's blocks need no process, which would load matplotlib.
HERE = {
    "tiltpad-plot": command.main,
    "tiltpad-report": command.report,
    "tiltpad-collect": command.collect,
}
#: What the shape of a bearing has of each pad.
OF_PADS = ("elastic_bending", "thermal_bending", "machined_clearance", "assembled_clearance")
SAVED = re.compile(r"Save this text as `([\w.]+)`")


def test_every_command_of_the_tutorial_does_what_it_says(
    root, program, tmp_path, monkeypatch, capsys, quick_pictures, ross
):
    monkeypatch.setenv("TILTPAD", program)
    # pictures of a movie in a revolution, which test_a_movie counts
    monkeypatch.setattr(bearing, "FRAMES", 5)
    text = (root / "docs/tutorial.md").read_text()
    folders = [str(Path(program).parent), str(Path(sys.executable).parent), os.environ["PATH"]]
    environment = os.environ | {"PATH": os.pathsep.join(folders)}
    commands, printed, cases = 0, "", iter(SAVED.findall(text))
    for language, mark, block in BLOCK.findall(text):
        fails, in_ross = mark == " fails", mark == " ross"
        if language == "nml":
            (tmp_path / next(cases)).write_text(block)
            continue
        if in_ross:
            unbalance_response(ross, block, tmp_path)
            commands += 1
            continue
        lines = block.splitlines() if language == "sh" else [None]
        for line in lines:
            words = shlex.split(line or "")
            if words[:1] and words[0] in HERE:
                with contextlib.chdir(tmp_path):
                    status, said = HERE[words[0]](words[1:]), capsys.readouterr().err
            elif line:
                done = subprocess.run(
                    ["sh", "-c", line],
                    cwd=tmp_path, env=environment, text=True, capture_output=True, timeout=300,
                )  # fmt: skip
                status, said = done.returncode, done.stderr
            else:
                with contextlib.chdir(tmp_path):
                    exec(compile(block, "<docs/tutorial.md>", "exec"), {"__name__": "__main__"})  # noqa: S102
                status, (out, said) = 0, capsys.readouterr()
                printed += out
            assert (status != 0) == bool(fails), f"{line or block}: {said}"
            assert len(said.splitlines()) == bool(fails), said
            commands += 1
    lines = re.findall(r"^tiltpad[ -]|^python -c", text, re.MULTILINE)
    assert commands == len(lines) + text.count("```python")
    for name in re.findall(r"images/[\w-]+\.png", text):
        assert (root / "docs" / name).exists(), name
    for name in re.findall(r"(?<!images/)\b[\w-]+\.(?:h5|png|pdf|svg|nml)\b", text):
        assert (tmp_path / name).exists(), name
    assert (tmp_path / "mine.html").exists()
    for example, own in (
        ("five_pads", "five.nml"),
        ("offset_preload", "bearing.nml"),
        ("overhung", "rotor.nml"),
        ("bent_pads", "large.nml"),
        ("turbine_bearing", "turbine.nml"),
        ("lemon_bore", "lemon.nml"),
    ):
        assert (root / f"input/examples/{example}.nml").read_text().endswith((tmp_path / own).read_text())
    for words in (*figures(tmp_path), *machine(tmp_path)):
        assert words in text
    assert "np." not in printed  # numbers as a reader expects them
    shares = [float(each) for each in re.findall(r"'assembled_clearance': ([\d.]+)", printed)]
    assert shares == [0, 1]
    assert f"The clearance has {100 * shares[0]:.0f} % of the variance of the film thickness" in text
    same = [(tmp_path / name).stat().st_size for name in ("mine.h5", "again.h5")]
    assert same[0] == same[1]


def figures(folder):
    """What the page says of its results, with the figures that they have."""

    def result(name):
        return tiltpad.read(folder / name)

    with result("rest.h5") as run:
        e = run.equilibrium
        yield f"specific load ({1e-6 * e['specific_load']:.2f} MPa)"
        yield f"{1e6 * e['min_film_thickness'].min():.0f} um and {1e-6 * e['max_pressure'].max():.1f} MPa at"
        assert (e["load"] > 1000).all()
    with tiltpad.read_study(folder / "map.h5") as study:
        k = 1e-6 * tiltpad.coefficients(study, "free").stiffness[2, 0]
        yield f"{k[0, 0]:.0f} MN/m at 9000 rpm in both directions, and cross terms that are small"
        assert round(k[0, 0]) == round(k[1, 1])
        assert abs(k[0, 1]) + abs(k[1, 0]) < 0.01 * k[0, 0]
    with result("smooth.h5") as smooth, result("rough.h5") as rough:
        sizes = [1e6 * tiltpad.orbit_size(run)[0] for run in (smooth, rough)]
        yield "from {:.1f} to {:.1f} um in the vertical".format(*sizes)
    with result("plain.h5") as run:
        yield f"whirls at {run['summary/whirl_order']:.2f} of the shaft speed"
    with result("cycle.h5") as run:
        yield f"towards higher speeds, at {run['parameter'][0]:.0f} rpm"
        assert (run["parameter"][1:] > run["parameter"][0]).all()
        assert (run["stable"][1:] == 1).all()
        size = (run["journal_y_max"] - run["journal_y_min"])[-1]
        yield f"to {1e6 * size:.0f} um from lowest to highest at 8500"
    with result("curve.h5") as run:
        lowest = int(np.argmin(run["parameter"]))
        viscosity = 1e3 * run["second_parameter"][lowest]
        yield f"to {run['parameter'][lowest]:.0f} rpm at {viscosity:.1f} mPa s"
        yield f"rises to {run['parameter'][-1]:.0f} rpm at 5 mPa s"
    with result("threshold.h5") as run:
        yield f"from which speed on: {run['modes/threshold_rpm'][-1]:.0f} rpm"
    with result("lemon.h5") as run, tiltpad.read_study(folder / "kicks.h5") as study:
        hopf, fold = run["bifurcations/parameter"]
        yield f"lose their stability at {hopf:.0f} rpm"
        yield f"At {fold:.0f} rpm (`LP`, a fold)"
        found = basins.basin(study, run)
        yield "at 9800 rpm {:.0f} um in the vertical and {:.0f} um in".format(*1e6 * found.cycle)
        yield f"whirl, {1e6 * found.amplitude.max():.0f} um to each side"
        yield f"nearest start that whirls is {1e6 * found.nearest:.0f} um away"
    with result("born.h5") as run:
        own = {
            name: run[f"modes/threshold_{name}"] for name in ("hopf_rpm", "lowest_rpm", "cycle_y", "cycle_z")
        }
        yield f"cycles begin at {own['hopf_rpm']:.0f} rpm, are born towards lower speeds"
        assert run["modes/threshold_born"] == -1
        size = [1e6 * own[f"cycle_{axis}"] for axis in "yz"]
        yield f"reach down to {own['lowest_rpm']:.0f} rpm with {size[0]:.0f} and {size[1]:.0f} um"
    with result("warm.h5") as run:
        e = run.equilibrium
        viscosity = np.sort(1e3 * e["viscosity"])
        yield f"have {viscosity[1]:.0f} and {viscosity[0]:.0f} mPa s, the others more than 30"
        assert viscosity[2] > 30
        yield f"moves by {-1e6 * e['journal_z']:.0f} um"
    with result("cross.h5") as run:
        k = 1e-6 * tiltpad.coefficients(run, "free").stiffness[0]
        yield f"cross-coupled stiffness of {k[0, 1]:.0f} and {k[1, 0]:.0f} MN/m"
    with result("large.h5") as run, result("stiff.h5") as stiff:
        bent = {name: [f"{1e6 * x:.0f}" for x in run[f"shape/{name}"][:2]] for name in OF_PADS}
        yield "bend by {} and {} um under".format(*bent["elastic_bending"])
        yield "pressure, and by {} and {} um as heat".format(*bent["thermal_bending"])
        yield "400 um becomes {} and {} um".format(*bent["machined_clearance"])
        yield "240 um become {} and {} um".format(*bent["assembled_clearance"])
        damping = [tiltpad.coefficients(each, "free").damping[0, 0, 0] for each in (stiff, run)]
        yield f"the damping is {100 * (damping[0] / damping[1] - 1):.0f} % higher"
        housing = 11e-6 * (0.15 + 240e-6 + 0.05)
        yield f"here by {1e6 * housing:.1f} um a kelvin"
    yield from turbulence(*(result(f"{name}.h5") for name in ("laminar", "turbine", "later")))
    with tiltpad.read_study(folder / "closures.h5") as study:
        fit, constantinescu, hirs = 1e-3 * study["equilibrium_total_power_loss"]
        yield f"change the loss less, to {fit:.0f} and {constantinescu:.0f} kW"
        yield f"says {hirs:.0f} kW and {1e6 * study['equilibrium_min_film_thickness'][2]:.0f} um"
    with tiltpad.read_study(folder / "transition.h5") as study:
        own = tiltpad.coefficients(study, "free")
        early, k = own.parameters["turbulent_above"] == 1000, own.stiffness[:, 0, 0, 0]
        apart = np.abs(k[early] - k[~early]).argmax()
        yield f"near {own.speed_rpm[early][apart]:.0f} rpm both answers are as far apart as they come"
    for size in ("small", "large"):
        k = 1e-6 * tiltpad.impedance([result(f"{size}_{axis}.h5") for axis in "yz"]).stiffness[0]
        yield f"{k[0, 0]:.0f} MN/m in the vertical and {k[0, 1]:.0f} MN/m across"
    with result("linear.h5") as run:
        yield f"freely have {1e-6 * tiltpad.coefficients(run, 'free').stiffness[0, 0, 0]:.0f} MN/m"


def turbulence(*runs):
    """The same of laminar films, and of those of two transitions."""
    film, loss, stiffness, damping = [], [], [], []
    for run in runs:
        own = tiltpad.coefficients(run, "free")
        film.append(1e6 * run["equilibrium/min_film_thickness"].min())
        loss.append(1e-3 * run["equilibrium/total_power_loss"])
        stiffness.append(1e-6 * own.stiffness[0, 0, 0])
        damping.append(1e-6 * own.damping[0].diagonal())
    yield f"thinnest film has {film[0]:.0f} um, and the bearing loses {loss[0]:.0f} kW"
    yield f"turbulent ones have {film[1]:.0f} um and {loss[1]:.0f} kW"
    yield f"falls from {stiffness[0]:.0f} to {stiffness[1]:.0f} MN/m"
    (y, z), (own_y, own_z) = damping[:2]
    yield f"damping, {y:.2f} and {own_y:.2f} MN s/m, changes little in the vertical"
    yield f"from {z:.2f} to {own_z:.2f} MN s/m in the horizontal"
    share = 100 * runs[1]["equilibrium/turbulent_share"]
    yield f"in {share[0]:.0f} and {share[4]:.0f} % of their arcs"
    yield f"loss is {loss[2]:.0f} kW, the film {film[2]:.0f} um and the stiffness {stiffness[2]:.0f} MN/m"


def machine(folder):
    """The same of the machine."""
    with h5py.File(folder / "loads.h5") as run:
        coupling, impeller = -run["equilibrium/bearing_load_y"][:]
        yield f"{coupling:.0f} N at the coupling, {impeller:.0f} N at the impeller"
    with h5py.File(folder / "whirl.h5") as study:

        def slowest(speed, sense):
            row = study["speed_rpm"][:].tolist().index(speed)
            frequency, damping, whirl = (
                study[name][row, 0] for name in ("frequency", "damping_ratio", "whirl")
            )
            found = np.flatnonzero((whirl * sense > 0) & (damping < 0.5) & (frequency > 0))
            mode = found[frequency[found].argmin()]
            return frequency[mode], damping[mode]

        yield "is at {:.0f} Hz at 8000 rpm, with a damping ratio of {:.2f}".format(*slowest(8000, 1))
        yield f"loses its damping with the speed, {slowest(12000, -1)[1]:.2f} at 12000 rpm"
    with tiltpad.read_study(folder / "whirl.h5") as study:
        yield f"a flat peak of {1e6 * tiltpad.response(study, station=8).amplitude.max():.1f} um"


def unbalance_response(ross, block, folder):
    """What a block prints in ROSS: the text says where the critical speed is."""
    said = str(ross(script=block, bearing=str(folder / "speeds.toml"))["printed"])
    found = re.findall(r"^(\d+) rpm: ([\d.]+) um$", said, re.MULTILINE)
    speed, size = max(found, key=lambda row: float(row[1]))
    assert len(found) == 17
    assert (speed, round(float(size))) == ("9000", 19)
