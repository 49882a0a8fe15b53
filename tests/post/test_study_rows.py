"""The study that the program writes, a row for each run: the same as tiltpad-collect makes of the files."""

import os
import signal
import subprocess
import time

import numpy as np
import pytest
from tiltpad import collect, command, figures, read, read_study
from tiltpad.calculate.statistics import common_remarks
from tiltpad.draw.study_report import study_report
from tiltpad.files import units

LUGRE = "&case task='march' / &friction model='lugre' /"
WARM = (
    "&case task='equilibrium' / &thermal model='pad' / &oil kinematic_viscosity=46e-6, 6.8e-6, "
    "at_temperature=40, 100, density=860, specific_heat=1951.8, conductivity=0.13, supply_temperature=40 /"
)
SHORT = "&operation duration=0.06 / &output samples_per_revolution=60, keep='all' /"
MACHINE = """&shaft length=2*0.05, 4*0.25, 2*0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=5, mass=800, polar_inertia=60, diametral_inertia=35 /
&unbalance station=5, moment=0.01 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
&sweep unbalance(1)%moment = 0.01, 0.02
pads:left%arc_deg(1) = 60, 65 /
"""
#: Cases in which runs have other columns and labels than others, and one fails.
CASES = {
    "marches": f"{SHORT} &sweep friction%model = 'none', lugre\noperation%speed_rpm = 1500, 6500 /",
    "coefficients": "&case task='coefficients' / &output keep='all' / &sweep "
    "coefficients%frequency_ratio = 1, 0.5, 1.5\nfriction%model = 'none', lugre /",
    "equilibria": f"{WARM} &output keep='all' / "
    "&sweep thermal%model = 'none', pad\nrotor%mass = 1000, 2000\noil%supply_temperature = 40, 50 /",
    "failures": "&case task='equilibrium' / &output keep='all' / "
    "&sweep rotor%static_load(1) = 0, 1e11, -1e3 /",
    "marches that fail": f"{SHORT} &sweep integration%max_steps = 100000, 30\n"
    "friction%model = 'none', lugre /",
    "tasks": f"{SHORT} &sweep case%task = march, equilibrium, coefficients\n"
    "pads%motion = tilting_only, tilting_radial /",
    "orbits": "&case task='periodic' / &output samples_per_revolution=60 / "
    "&sweep rotor%unbalance = 0.01, 0.02 /",
    "machines that march": "&operation speed_rpm=3000, duration=0.06 / "
    f"&output samples_per_revolution=60, keep='all' / {MACHINE}",
    "coefficients of machines": f"&case task='coefficients' / &output keep='all' / {MACHINE}",
    "last revolutions": "&output keep='last_revolutions' spectrum_revolutions=8 samples_per_revolution=60 / "
    "&sweep operation%duration = 0.005, 0.05, 0.15 /",
}


@pytest.fixture(scope="module", params=CASES)
def studies(request, tiltpad, tmp_path_factory):
    """The study of the program and that of tiltpad-collect, of the same runs."""
    folder = tmp_path_factory.mktemp(request.param)
    (folder / "case.nml").write_text(CASES[request.param])
    assert tiltpad("case.nml", cwd=folder).returncode == (2 if "fail" in request.param else 0)
    collect(folder / "case", folder / "collected.h5")
    with read_study(folder / "case.h5") as rows, read_study(folder / "collected.h5") as files:
        yield rows, files


def pairs(studies):
    """Both studies and their names; of machines both of each bearing, and what the file has in its group."""
    rows, files = studies
    assert list(rows.bearings) == list(files.bearings)
    found = [(rows, files, rows.names(), files.names())]
    for own, other in zip(rows.bearings.values(), files.bearings.values(), strict=True):
        found.append((own, other, *(sorted(each.file[each.group]) for each in (own, other))))
    return found


def test_columns_are_those_of_the_files(studies):
    for rows, files, names, others in pairs(studies):
        assert len(names) > 20
        assert names == others
        for name in names:
            assert rows.scales(name) == files.scales(name), name
            assert rows.about(name, "units") == files.about(name, "units"), name
            assert rows.about(name, "long_name") == files.about(name, "long_name"), name
            own, other = (each.own(name).attrs.get("coordinates") for each in (rows, files))
            assert own == other, name


def test_values_are_those_of_the_files_to_the_last_bit(studies):
    for rows, files, names, _ in pairs(studies):
        for name in names:
            np.testing.assert_array_equal(rows[name], files[name], err_msg=name)


def test_attributes_are_those_of_the_collected_study(studies):
    rows, files = studies
    for name in ("format_version", "program", "version", "title", "task", "parameters", "variables", "runs"):
        assert rows.attributes[name] == files.attributes[name], name
    assert rows.attributes["input"] == files.attributes["input"]
    assert rows.attributes["missing"] == files.attributes["missing"] == ""
    assert rows.attributes["finished"] == 1
    assert [each[2:] for each in rows.failures()] == [each[2:] for each in files.failures()]


def test_xarray_reads_it(studies):
    rows, files = studies
    data = rows.to_xarray()
    assert set(data.coords) >= {"run", *rows.parameters}
    # test_columns_are_those_of_the_files compares both studies
    sizes = [zip(files.scales(name), files[name].shape, strict=True) for name in files.names()]
    assert dict(data.sizes) == dict(each for pairs in sizes for each in pairs)


@pytest.mark.parametrize("base", [LUGRE, WARM])
def test_parameters_are_called_as_by_tiltpad_collect(tiltpad, tmp_path, base):
    """All numbers of a case, each varied by the one value that it has."""
    case = f"{base} &output keep='all', start_time=0.02 / &operation duration=0.03"
    (tmp_path / "base.nml").write_text(f"{case} /")
    tiltpad("base.nml", cwd=tmp_path, status=0)
    with read(tmp_path / "base.h5") as run:
        flat = {f"{group}%{name}": value for group, own in run.input.items() for name, value in own.items()}
    flat |= {f"{name}(1)": value[0] for name, value in flat.items() if isinstance(value, tuple)}
    # lists of any length have no elements that could be varied
    for name in ("pads%pivot_angle_deg", "coefficients%frequency_ratio"):
        flat.pop(f"{name}(1)", None)
    varied = {name: value for name, value in flat.items() if type(value) in (int, float)}
    lines = "\n".join(f"{name} = {value!r}" for name, value in varied.items())
    (tmp_path / "case.nml").write_text(f"{case} / &sweep\n{lines}\n/")
    tiltpad("case.nml", cwd=tmp_path, status=0)
    collect(tmp_path / "case", tmp_path / "collected.h5")
    with read_study(tmp_path / "case.h5") as rows, read_study(tmp_path / "collected.h5") as files:
        assert len(rows.parameters) == len(varied) > 50
        assert rows.attributes["variables"].split("\n") == list(varied)
        for name, variable in zip(rows.parameters, varied, strict=True):
            own = variable.partition("(")[0]
            assert rows.about(name, "units") == (units.named(own)[1] or "1"), variable
            assert rows[name] == varied[variable], variable
            assert rows.about(name, "long_name").startswith(units.named(own)[0]), variable
        for name, other, variable in zip(rows.parameters, files.parameters, varied, strict=True):
            # a name that some study has for a column is no parameter's in any
            assert name in (other, f"{variable.partition('%')[0]}_{other}")
            if name == other:
                assert rows.about(name, "units") == files.about(name, "units"), name
                assert rows.about(name, "long_name") == files.about(name, "long_name"), name


def test_a_study_of_which_little_was_run(program, tmp_path):
    """Runs that have not been run take no room in the file."""
    (tmp_path / "case.nml").write_text(
        "&case task='coefficients' / &output checkpoint_seconds=1e-3, keep='summary' / "
        f"&coefficients frequency_ratio={', '.join(f'{0.1 * k:.1f}' for k in range(1, 61))} / "
        "&sweep operation%speed_rpm = 1000:3999:1 /"
    )
    with subprocess.Popen([program, "case.nml", "-q"], cwd=tmp_path, stderr=subprocess.PIPE) as process:
        while not (tmp_path / "case.h5").exists():
            assert process.poll() is None, process.communicate()
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.communicate()
    with read_study(tmp_path / "case.h5") as study:
        assert 0 < study.done.sum() < 3000
        assert study.stiffness.nbytes > os.path.getsize(study.path)
        np.testing.assert_array_equal(np.isfinite(study.stiffness[:, 0, 0, 0, 0]), study.done)
        np.testing.assert_array_equal(study.status[~study.done], -2)
        assert np.nansum(study.complete) == study.done.sum()


def test_remarks_are_counted_by_kind(tiltpad, tmp_path, capsys, closed_figures):
    """Those that differ in their numbers alone are one, in the words of the first run that has it."""
    (tmp_path / "case.nml").write_text("&case task='equilibrium' / &sweep rotor%mass=1000,6000,7000,9000 /")
    tiltpad("case.nml", "-q", cwd=tmp_path, status=0)
    with read_study(tmp_path / "case.h5") as study:
        assert study.remarks[0] == ""
        first = study.remarks[1].splitlines()[0]
        told = sum(len(each.splitlines()) for each in study.remarks)
        common = common_remarks(study)
        page = study_report(study)
        below = figures.study(study).get_supxlabel()
    assert below == "remarks on 3 of 4 runs; the report of the study counts them"
    assert common[0].runs == 3
    assert (common[0].first, common[0].words) == (2, first)
    assert common[0].words.startswith("specific load 5.90 MPa")
    assert sum(each.runs for each in common) == told > len(common)
    assert "<h2>Remarks</h2>" in page
    assert f"<td>3</td><td>2</td><td>{common[0].words}</td>" in page
    assert command.report([str(tmp_path / "case.h5"), "-o", str(tmp_path / "a.html")]) == 0
    assert "remarks on 3 of 4 runs" in capsys.readouterr().out
