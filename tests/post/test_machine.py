"""Results of machines: their stations and bearings, every plot of them, their report, and what is refused."""

import argparse
import re
import shutil
import subprocess

import h5py
import numpy as np
import pytest
import tiltpad
from tiltpad import command, figures, read_study
from tiltpad import read as tiltpad_read
from tiltpad.calculate import stations, vibration_limits
from tiltpad.draw import machine_report
from tiltpad.draw.report import report
from tiltpad.draw.study_report import study_report

pytestmark = pytest.mark.usefixtures("quick_pictures")

MARCHED = "orbit equilibrium size poincare waveform spectrum hysteresis friction sticking runup pressure film"
#: Tasks, and the plots of their results that are drawn; all others say in a line why not.
DRAWN = {
    "march": f"{MARCHED} machine stations shaft",
    "equilibrium": "equilibrium pressure film machine shaft",
    "coefficients": "equilibrium pressure film coefficients stability machine shaft shapes",
    "periodic": f"{MARCHED} multipliers machine stations shaft",
    "branch": "equilibrium pressure film machine shaft branch response multipliers",
}
#: Rounding alone is between a file's values and what is calculated from them.
ROUNDING = 1e-12


@pytest.fixture(scope="module")
def machine(tiltpad, tmp_path_factory):
    """machine("march"): path of the result of this task of a machine on two different bearings."""
    folder = tmp_path_factory.mktemp("machine")
    (folder / "machine.nml").write_text(CASE)

    def path(task):
        file = folder / f"{task}.h5"
        if not file.exists():
            words = ["--set", f"case%task={task}", *(BRANCH if task == "branch" else ())]
            tiltpad("--quiet", "machine.nml", *words, "--output", file, cwd=folder, status=0)
        return file

    return path


BRANCH = [word for each in ("parameter=operation%speed_rpm", "last=4200", "step=100") for word in
          ("--set", f"branch%{each}")]  # fmt: skip
CASE = """&case title='Machine' /
&operation speed_rpm=4100, duration=0.06 /
&output samples_per_revolution=60, spectrum_revolutions=2 /
&film cavitation='none' /
&friction model='lugre' /
&shaft length=0.05, 0.05, 4*0.4, 2*0.05, 0.15, diameter=2*0.0998, 4*0.34, 3*0.0998 /
&disc station=4, mass=2000, polar_inertia=400, diametral_inertia=220 /
&disc station=10, mass=60, polar_inertia=2, diametral_inertia=1 /
&unbalance station=4, moment=0.02 /
&unbalance station=10, moment=0.001, angle_deg=90 /
&load station=5, force=-2000, 1500 /
&bearing name='drive_end', station=2 /
&bearing name='free_end', station=8 /
&pads bearing='free_end', pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=5*60 /
&support bearing='free_end', mass=200, stiffness=1e9, 1e9, damping=1e5, 1e5 /
"""


#: A machine without films and pivots, and a study of one on fixed pads.
LINEAR = """&case task='coefficients' / &operation speed_rpm=3000 / &coefficients threshold_up_to_rpm=9000 /
&shaft length=10*0.127, diameter=0.1016, internal_damping=2e-4 / &unbalance station=6, moment=1e-4 /
&bearing name='left', station=1, kind='linear', stiffness=1.75e7, 0, 0, 1.75e7 /
&bearing name='right', station=11, kind='linear', stiffness=1.75e7, 0, 0, 1.75e7 /
"""
FIXED = """&case task='coefficients' / &sweep operation%speed_rpm=1500, 3000 /
&shaft length=4*0.3, diameter=0.06 / &disc station=3, mass=40, polar_inertia=0.4, diametral_inertia=0.2 /
&unbalance station=3, moment=1e-4 / &pads motion='fixed', pivot_angle_deg=-90, arc_deg=360 /
&bearing journal_radius=30e-3, axial_length=30e-3, assembled_clearance=60e-6, preload=0, viscosity=0.03 /
&bearing name='left', station=1 / &bearing name='right', station=5, axial_length=40e-3 /
"""


def test_a_machine_without_pivots_has_none_in_its_words(tiltpad, tmp_path):
    (tmp_path / "linear.nml").write_text(LINEAR)
    tiltpad("--quiet", "linear.nml", cwd=tmp_path, status=0)
    with tiltpad_read(tmp_path / "linear.h5") as run:
        assert not run.has_pivots
        page = report(run)
        assert "locked" not in page
        assert "pivots" not in page.partition("<pre>")[0]
        assert "locked" not in figures.shapes([run]).get_suptitle()


def test_the_operating_points_of_a_machine_are_those_of_its_worst_bearing(tiltpad, tmp_path, capsys):
    (tmp_path / "fixed.nml").write_text(FIXED)
    tiltpad("--quiet", "fixed.nml", cwd=tmp_path, status=0)
    with read_study(tmp_path / "fixed.h5") as study:
        table = study_report(study).partition("Operating points")[2].partition("</table>")[0]
        head, *rows = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in table.split("<tr>")[1:]]
        own = [each.equilibrium_min_film_thickness for each in study.bearings.values()]
        film = [float(row[head.index("minimum film (µm)")]) for row in rows]
        np.testing.assert_allclose(film, 1e6 * np.minimum(*own), rtol=1e-3)
        lost = sum(each.equilibrium_total_power_loss for each in study.bearings.values())
        loss = [float(row[head.index("power loss (kW)")]) for row in rows]
        np.testing.assert_allclose(loss, 1e-3 * lost, rtol=1e-3)
        assert "locked" not in study_report(study).partition("Critical speeds")[2].partition("</table>")[0]
    words = ["coefficients", str(tmp_path / "fixed.h5"), "-o"]
    for output in (str(tmp_path / "a.png"), str(tmp_path / "a.csv")):
        assert command.main([*words, output]) == 1
        assert "its bearings are left, right; choose by --bearing" in capsys.readouterr().err
        assert command.main([*words, output, "--bearing", "right"]) == 0


def test_stations_and_bearings(machine):
    with tiltpad.read(machine("march")) as run:
        assert list(run.bearings) == ["drive_end", "free_end"]
        assert run.scales("station_y") == ("time", "station")
        assert run.about("station_y", "units") == "m"
        left, right = run.bearings.values()
        assert (left.pads, right.pads) == (2, 5)
        with h5py.File(machine("march")) as file:
            np.testing.assert_array_equal(right.pad_tilt, file["bearings/free_end/pad_tilt"])
        np.testing.assert_allclose(left.journal_y, run.station_y[:, 1], atol=ROUNDING * 1e-4)
        np.testing.assert_array_equal(left.time, run.time)
        y, z = stations.station_orbit(run, 2)
        np.testing.assert_allclose([np.ptp(y), np.ptp(z)], tiltpad.orbit_size(left), rtol=1e-9)
        assert "2 bearings (drive_end, free_end)" in repr(run)


def test_a_bearing_is_a_run_of_one_bearing(machine):
    """Calculations take it, also those of the library: its films carry its load."""
    with tiltpad.read(machine("equilibrium")) as run:
        for k, (name, bearing) in enumerate(run.bearings.items()):
            assert bearing.title == f"Machine, bearing {name}"
            rotor = bearing.input["rotor"]
            load = np.array([run[f"equilibrium/bearing_load_{axis}"][k] for axis in "yz"])
            weight = np.array([rotor["mass"] * rotor["gravity"], 0])
            np.testing.assert_allclose(
                np.array(rotor["static_load"]) - weight, load, atol=1e-9 * abs(load[0])
            )
            found = tiltpad.pressure(bearing)
            np.testing.assert_allclose(found.max_pressure, bearing["equilibrium/max_pressure"], rtol=1e-3)
        assert sum(run["equilibrium/bearing_load_y"]) == pytest.approx(-9.81 * run["rotor/total_mass"] - 2000)
    with tiltpad.read(machine("coefficients")) as run:
        one, other = (tiltpad.modes(each) for each in run.bearings.values())
        np.testing.assert_array_equal(one.frequency, other.frequency)
        assert tiltpad.coefficients(run.bearings["free_end"]).stiffness.shape == (1, 2, 2)


@pytest.mark.parametrize("task", ["march", "equilibrium", "coefficients", "periodic"])
def test_all_that_a_file_has_is_shown_in_a_notebook(machine, task):
    """Every dataset has its dimensions, of the machine and of its bearings."""
    with tiltpad.read(machine(task)) as run:
        for each in (run, *run.bearings.values()):
            page = each._repr_html_()
            for group in ("", *each.single_and_groups()[1]):
                assert all(f"<td>{name}</td>" in page for name in each.names(group) if name not in run.GROUPS)


def test_what_a_machine_has_not_is_said(machine):
    with tiltpad.read(machine("march")) as run:
        with pytest.raises(tiltpad.NotInRunError, match=r"as run.bearings\['drive_end'\]\['journal_y'\]"):
            run.journal_y  # noqa: B018
        with pytest.raises(tiltpad.NotInRunError, match=r"as run.bearings\['drive_end'\].pads"):
            run.pads  # noqa: B018
        with pytest.raises(tiltpad.NotInRunError, match=r"no bearing fre_end \(did you mean free_end\?\)"):
            run.bearings["fre_end"]
        with pytest.raises(tiltpad.NotInRunError, match="no station 11 .*: stations are 1 to 10"):
            stations.station_orbit(run, 11)
        with pytest.raises(tiltpad.NotInRunError, match="its task is 'march', not 'coefficients'"):
            stations.station_modes(run)


def test_a_run_of_one_bearing_has_no_stations(run):
    own = run("lugre")
    assert not own.bearings
    with pytest.raises(tiltpad.NotInRunError, match="it is a run of one bearing"):
        own.bearings["left"]
    with pytest.raises(tiltpad.NotInRunError, match="it is of one bearing and not of a machine"):
        stations.station_orbit(own, 1)


@pytest.mark.parametrize("task", DRAWN)
def test_every_plot_or_a_line_that_says_why_not(machine, task, tmp_path, capsys):
    for bearing in ((), ("--bearing", "free_end")) if task == "march" else ((),):
        for plot in command.PLOTS:
            if plot == command.MOVIE:
                continue
            status = command.main([plot, str(machine(task)), "-o", str(tmp_path / "a.png"), *bearing])
            said = capsys.readouterr().err
            of_one = plot == command.BEARING and bearing
            refused = bearing and plot in command.WITHOUT_BEARING
            assert (status == 0) == ((plot in DRAWN[task].split() or bool(of_one)) and not refused), (
                plot,
                said,
            )
            assert said.count("\n") == (status != 0), said
            assert "report this error" not in said, said


@pytest.mark.parametrize("plot", ["bearing", "movie"])
def test_a_picture_of_one_bearing_asks_which(machine, plot, tmp_path, capsys):
    output = tmp_path / f"a.{'gif' if plot == 'movie' else 'png'}"
    assert command.main([plot, str(machine("march")), "-o", str(output)]) == 1
    assert "its bearings are drive_end, free_end; choose by --bearing" in capsys.readouterr().err


def test_a_wrong_bearing_of_the_command(machine, capsys):
    assert command.main(["orbit", str(machine("march")), "--bearing", "drive"]) == 1
    assert "no bearing drive (did you mean drive_end?)" in capsys.readouterr().err


def test_a_case_is_drawn(machine, program, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("TILTPAD", str(program))
    case, output = str(machine("march").parent / "machine.nml"), str(tmp_path / "a.png")
    assert command.main(["machine", case, "-o", output]) == 0
    assert command.main(["bearing", case, "--bearing", "free_end", "-o", output]) == 0
    assert command.main(["bearing", case, "-o", output]) == 1
    assert "choose one of its bearings by --bearing: drive_end, free_end" in capsys.readouterr().err
    assert command.main(["bearing", case, "--bearing", "fre_end", "-o", output]) == 1
    assert "(did you mean free_end?)" in capsys.readouterr().err


def test_response_of_a_branch_at_a_station(machine, tmp_path, capsys):
    """Of the station that moves most, or of one that is chosen; of a bearing as of any run."""
    with tiltpad.read(machine("branch")) as run:
        first = run["branch"] == 1
        found = tiltpad.response(run, station=4)
        assert (found.parameter, found.station) == ("speed_rpm", 4)
        assert list(found.values) == list(run["parameter"][first])
        for k, axis in enumerate("yz"):
            np.testing.assert_allclose(found.amplitude[:, k], run[f"station_{axis}_amplitude"][first, 3])
            turned = found.phase[:, k] - run[f"station_{axis}_phase"][first, 3]
            np.testing.assert_allclose(np.exp(1j * turned), 1)
        largest = max(run[f"station_{axis}_amplitude"][first].max() for axis in "yz")
        assert tiltpad.response(run).amplitude.max() == largest
        journal = tiltpad.response(run.bearings["free_end"])
        assert journal.station is None
        np.testing.assert_array_equal(
            journal.amplitude[:, 0], run.bearings["free_end"]["journal_y_amplitude"][first]
        )
        with pytest.raises(ValueError, match="station 11: must be 1 to 10"):
            tiltpad.response(run, station=11)
        with pytest.raises(ValueError, match="station, pivot: for a machine"):
            tiltpad.response(run.bearings["free_end"], station=4)
        fig = figures.FIGURES["response"]([run], None, None, station=4)
        assert fig.legends[0].get_title().get_text() == "Machine, station 4"
        fig = figures.FIGURES["response"](list(run.bearings.values()))
        named = [each.get_text() for each in fig.legends[0].get_texts()]
        assert named == [f"bearing {name}, ${axis}$" for name in ("drive_end", "free_end") for axis in "yz"]
        assert fig.legends[0].get_title().get_text() == "Machine"
    output = tmp_path / "a.png"
    assert command.main(["response", str(machine("branch")), "--station", "4", "-o", str(output)]) == 0
    assert output.exists()
    assert capsys.readouterr().err == ""


def test_response_of_a_run_up_at_a_station_is_that_of_its_order_tracks(tiltpad_runup):
    with tiltpad.read(tiltpad_runup) as run:
        found = tiltpad.response(run, station=2)
        own = tiltpad.response(run.bearings["drive_end"])
        # this bearing stands on the ground: its journal is the station
        np.testing.assert_allclose(found.amplitude, own.amplitude, rtol=1e-9)
        np.testing.assert_allclose(found.phase, own.phase, atol=1e-9)


@pytest.fixture
def tiltpad_runup(tiltpad, machine, tmp_path):
    """A short run-up of the machine."""
    case = machine("march").parent / "machine.nml"
    speeds = ("--set", "operation%speed_rpm=3000", "--set", "operation%final_speed_rpm=4100")
    tiltpad("-q", case, *speeds, "--set", "operation%duration=0.3", "-o", "up.h5", cwd=tmp_path, status=0)
    return tmp_path / "up.h5"


def test_the_report_leaves_out_modes_with_the_damping_of_the_reduction(machine):
    with tiltpad.read(machine("coefficients")) as run:
        page = machine_report.mode_table(run)
        parts = run["modes/part_of_reduction"]
        vibrate = run["modes/frequency"] > 0
        left_out = int((parts > 0.5).sum())
        assert left_out > 0
        assert f"Not listed: high modes of the shaft, {left_out}, which a march damps" in page
        shown = (vibrate | (run["modes/damping_ratio"] < 0)) & ~(parts > 0.5)
        assert page.count("<tr>") == 1 + shown.sum()


def test_orbits_are_drawn(machine):
    with tiltpad.read(machine("march")) as run:
        fig = figures.FIGURES["stations"](run, station=[2, 4])
        for ax, number in zip(fig.axes, (2, 4), strict=True):
            y, z = stations.station_orbit(run, number)
            np.testing.assert_allclose(ax.get_lines()[0].get_xydata(), 1e6 * np.column_stack([z, y]))
        assert fig.axes[1].get_title() == "station 4: disc 1, unbalance 1"


def test_the_static_line_is_drawn(machine):
    with tiltpad.read(machine("equilibrium")) as run:
        fig = figures.FIGURES["shaft"](run)
        upper = fig.axes[0]
        np.testing.assert_allclose(upper.get_lines()[0].get_ydata(), 1e6 * run["equilibrium/station_y"])
        np.testing.assert_allclose(upper.get_lines()[0].get_xdata()[-1], 1.95)
        load = run["equilibrium/bearing_load_y"][0]
        assert f"drive_end: {1e-3 * load:.2f} kN" in [text.get_text() for text in upper.texts]


def test_shapes_are_drawn_with_their_sense(machine):
    with tiltpad.read(machine("coefficients")) as run:
        found = stations.station_modes(run, "stuck")
        fig = figures.FIGURES["shapes"](run, pivot="stuck")
        titles = [ax.get_title() for ax in fig.axes]
        for title in titles:
            hertz = float(title.split()[0])
            k = np.nanargmin(abs(found.frequency - hertz))
            y, z = found.shape[k].T
            turns = np.sum((np.conj(y) * z).imag)
            assert str(found.word[k]) in title
            assert ("forward" in title) <= (turns < 0)
            assert ("backward" in title) <= (turns > 0)
        assert {"forward", "backward"} <= {title.split()[2] for title in "\n".join(titles).split("\n")[::2]}


def test_what_the_reduction_damps_is_in_no_picture_of_stability(machine):
    with tiltpad.read(machine("coefficients")) as run:
        found = tiltpad.modes(run, "stuck")
        assert found.of_reduction.any()
        own = stations.station_modes(run, "stuck").own[: len(found.name)]
        np.testing.assert_array_equal(found.of_reduction, ~own)
        options = argparse.Namespace(plot="stability", bearing=None, station=None)
        fig = figures.FIGURES["stability"](command.bearings_of(run, options), pivot="stuck")
        drawn = [k for k, line in enumerate(fig.axes[0].get_lines()) if np.isfinite(line.get_ydata()).all()]
        assert set(drawn[: len(found.name)]) >= set(np.flatnonzero(~found.of_reduction))
        assert not set(drawn) & set(np.flatnonzero(found.of_reduction))
        assert "shaft" in {text.get_text() for legend in fig.legends for text in legend.get_texts()}


def test_names_are_those_of_the_documents(machine):
    """Names, dimensions and units of a machine's file at its root."""
    expected = {
        "station": (("station",), "1"),
        "station_y": (("time", "station"), "m"),
        "station_z": (("time", "station"), "m"),
        "equilibrium/station_y": (("station",), "m"),
        "equilibrium/station_z": (("station",), "m"),
        "equilibrium/bearing_load_y": (("bearing",), "N"),
        "equilibrium/bearing_load_z": (("bearing",), "N"),
        "rotor/total_mass": ((), "kg"),
        "rotor/mode_frequency": (("rotor/mode",), "Hz"),
        "rotor/left_out_frequency": ((), "Hz"),
        "rotor/truncation_error": ((), "1"),
        "rotor/station_error": ((), "1"),
        "rotor/damped_above": ((), "Hz"),
        "rotor/damping_error": ((), "1"),
        "rotor/station_position": (("station",), "m"),
        "rotor/section_length": (("rotor/section",), "m"),
        "rotor/section_diameter": (("rotor/section",), "m"),
        "rotor/section_bore": (("rotor/section",), "m"),
        "rotor/bearing_station": (("bearing",), "1"),
        "rotor/disc_mass": (("rotor/disc",), "kg"),
        "summary/station_y_size": (("station",), "m"),
        "summary/station_z_amplitude": (("station",), "m"),
    }
    modes = {
        **dict.fromkeys(("modes/frequency",), (("pivot", "mode"), "Hz")),
        **dict.fromkeys(("modes/whirl",), (("pivot", "mode"), "1")),
        **dict.fromkeys((f"modes/station_{axis}_{part}" for axis in "yz" for part in ("real", "imag")),
                        (("pivot", "mode", "station"), "m")),
        **dict.fromkeys(("response/amplitude", "response/y_real"), (("pivot", "station"), "m")),
        "synchronous/log_decrement": (("pivot", "synchronous_mode"), "1"),
    }  # fmt: skip
    for task, names in (("march", expected), ("coefficients", modes)):
        with tiltpad.read(machine(task)) as run:
            assert run.format_version == 4
            for name, (dimensions, units) in names.items():
                assert run.scales(name) == dimensions, name
                assert run.about(name, "units") == units, name
                assert len(run.about(name, "long_name")) > 3, name


def broken(name):
    """Files of machines that are refused, and what is said."""

    def other_names(file):
        file.move("bearings/free_end", "bearings/other")

    def other_pads(file):
        del file["bearings/free_end/pad"]
        file.move("bearings/drive_end/pad", "bearings/free_end/pad")

    def outside(file):
        del file["bearings/free_end"]
        file["bearings/free_end"] = h5py.ExternalLink("other.h5", "/")

    def no_group(file):
        del file["bearings"]
        file["bearings"] = np.zeros(3)

    def no_numbers(file):
        file["equilibrium/bearing_load_y"][:] = np.nan

    def one_bearing(file):
        text = file.attrs["input"]
        file.attrs["input"] = text.replace("name = 'free_end'", "name = 'drive_end'")

    return {
        "other names": (other_names, "drive_end, other, and drive_end, free_end in the input"),
        "other pads": (other_pads, "pad"),
        "outside": (outside, "a link and not in this file"),
        "no group": (no_group, "and drive_end, free_end in the input"),
        "no numbers": (no_numbers, "attribute 'input'"),
        "one bearing": (one_bearing, "and drive_end, drive_end in the input"),
    }[name]


@pytest.mark.parametrize(
    "name", ["other names", "other pads", "outside", "no group", "no numbers", "one bearing"]
)
def test_broken_machines_are_refused(machine, name, tmp_path, capsys):
    edit, words = broken(name)
    path = tmp_path / "broken.h5"
    path.write_bytes(machine("march").read_bytes())
    with h5py.File(path, "r+") as file:
        edit(file)
    with pytest.raises(tiltpad.RunError) as error:
        tiltpad.read(path)
    assert words in str(error.value)
    assert str(error.value).startswith(f"{path}: ")
    assert command.main(["orbit", str(path), "-o", str(tmp_path / "a.png")]) == 3
    assert capsys.readouterr().err.count("\n") == 1


def test_the_input_is_a_case(machine, program, tmp_path):
    """What was read is written as a case, which the program resolves to the same input."""
    with tiltpad.read(machine("equilibrium")) as run:
        assert [each["station"] for each in run.input["disc"]] == [4, 10]
        case = tiltpad.write_case(tmp_path / "again.nml", run.input)
        output = tmp_path / "again.h5"
        subprocess.run([program, "--quiet", case, "--output", output], check=True)
        with tiltpad.read(output) as again:
            assert again.input == run.input
            np.testing.assert_array_equal(again["equilibrium/station_y"], run["equilibrium/station_y"])


def test_a_bearing_as_xarray(machine):
    with tiltpad.read(machine("march")) as run:
        data = run.bearings["free_end"].to_xarray()
        assert data["pad_tilt"].dims == ("time", "pad")
        assert data.sizes["pad"] == 5


def test_the_report_tells_of_the_machine_and_of_each_bearing(machine, tmp_path):
    page = tmp_path / "page.html"
    assert command.report([str(machine("coefficients")), "-o", str(page)]) == 0
    text = page.read_text()
    for title in ("Rotor", "Bearings", "Stations", "Modes", "Bearing drive_end", "Bearing free_end", "Input"):
        assert f"<h2>{title}</h2>" in text, title
    with tiltpad.read(machine("coefficients")) as run:
        mass, load = run["rotor/total_mass"], 1e-3 * run["equilibrium/bearing_load_y"][1]
        found = stations.station_modes(run)
    assert f"<td>mass of the rotor</td><td>{mass:.0f}</td>" in text
    assert f"<td>{load:.2f}</td>" in text
    first = text[: text.index("<details>")]
    with tiltpad.read(machine("coefficients")) as run:
        shaft = found.own & (found.frequency > 0) & np.char.startswith(run["modes/name"][0], "shaft")
    least = found.log_decrement[shaft].min()
    assert f"The shaft is stable with pivots free: least logarithmic decrement {least:.3g}" in first
    assert all(f"<td>{name}</td>" in first for name in ("drive_end", "free_end"))
    k = np.flatnonzero(found.frequency > 0)[0]
    assert f"<td>{found.frequency[k]:.5g}</td>" in text
    pictures = ("machine", "shaft", "shapes", "stability", "bearing", "equilibrium", "film")
    count = {name: text.count(f'<img alt="{name}"') for name in pictures}
    assert count == dict.fromkeys(("machine", "shaft", "shapes", "stability"), 1) | dict.fromkeys(
        ("bearing", "equilibrium", "film"), 2
    )
    assert command.report([str(machine("march")), "-o", str(page)]) == 0
    text = page.read_text()
    assert text.count('<img alt="stations"') == 1
    assert text.count('<img alt="orbit"') == 2
    assert "peak to peak y, z (µm)" in text
    assert "1 where" not in text
    first = text[: text.index("<details>")]
    with tiltpad.read(machine("march")) as run:
        sizes = np.maximum(run["summary/station_y_size"], run["summary/station_z_size"])
        limit = vibration_limits.of_api_617(run.input["operation"]["speed_rpm"])
    assert f"The shaft moves most at station {sizes.argmax() + 1} " in first
    assert f"API 617 allows {1e6 * limit:.2f} µm (kept), zone A of ISO 7919-3" in first


def test_a_load_that_is_nothing_beside_the_others_is_told_as_0(machine, tmp_path):
    path = tmp_path / "upright.h5"
    shutil.copy(machine("equilibrium"), path)
    with h5py.File(path, "r+") as file:
        file["equilibrium/bearing_load_z"][...] = [-1e-11, 4e-15]
    with tiltpad.read(path) as run:
        text = machine_report.bearing_figures(run)
    assert re.search("<td>load of the rotor, horizontal</td><td>0.00</td><td>0.00</td><td>kN</td>", text)


def test_the_table_of_critical_speeds_of_one_result_has_all_stations(machine, tmp_path, closed_figures):
    table = tmp_path / "x.csv"
    result = str(machine("branch"))
    assert command.main(["response", result, "-o", str(table)]) == 0
    with tiltpad.read(result) as run:
        found = tiltpad.critical_speeds(run)
        stations_of = range(1, run.length("station") + 1)
        peaks = {each: tiltpad.response(run, station=each).peaks for each in stations_of}
    assert [(each.station, each.peak) for each in found] == [(k, own) for k in peaks for own in peaks[k]]
    assert len(table.read_text().splitlines()) == 1 + len(found)
