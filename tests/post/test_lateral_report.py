"""The lateral report: what it takes from the results, its rules, its page and its tables."""

import csv
import subprocess
import sys

import numpy as np
import pytest
import tiltpad
from tiltpad.calculate import lateral_limits as limits
from tiltpad.draw.lateral_report import found_in, lateral_report

CASE = """
&case title='Compressor & seals' /
&operation speed_rpm=11000 /
&shaft length=2*0.06, 0.11, 8*0.12, 0.11, 2*0.06, 0.07,
   diameter=2*0.0998, 0.13, 8*0.145, 0.13, 2*0.0998, 0.09 /
&disc station=6, mass=70, diametral_inertia=0.4, polar_inertia=0.7 /
&disc station=8, mass=70, diametral_inertia=0.4, polar_inertia=0.7 /
&disc station=16, mass=22, diametral_inertia=0.1, polar_inertia=0.17 /
&bearing journal_radius=0.0499, axial_length=0.05, machined_clearance=105e-6, assembled_clearance=75e-6,
   viscosity=0.016 /
&pads pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=58, pivot_ratio=0.5, pivot_distance=0.013, mass=0.28,
   inertia=1.1e-4, centre_tangential=0, centre_radial=-0.0068 /
&pivot socket_radius=0.013, radius_difference=0.0002 /
&bearing name='left', station=2 /
&bearing name='right', station=14 /
&element station=4, stiffness=1e6, 2*0, 1e6, level=1, static=.false. /
&element station=10, stiffness=12e6, 7.2e6, -7.2e6, 12e6, damping=11e3, 2*0, 11e3, static=.false. /
&impeller station=6, power=1.2e6, diameter=0.4, width=0.014, suction_density=26.5, discharge_density=31.5 /
&impeller station=8, power=1.0e6, diameter=0.38, width=0.0105, suction_density=37, discharge_density=43 /
&lateral lowest_rpm=7000, clearance_change=-10e-6, 10e-6, probe_station=3, 13, close_station=6, 10,
   close_clearance=150e-6, 20e-6 /
"""
TITLES = (
    "Undamped critical speeds",
    "Damped natural frequencies",
    "Unbalance response",
    "Stability, level II",
)


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("lateral") / "compressor.nml"
    path.write_text(CASE)
    return path


@pytest.fixture(scope="module")
def found(case):
    return found_in(tiltpad.lateral(case, speeds=10))


def test_each_column_has_its_clearance_and_level_i_no_seals(found):
    for column, clearance in zip(found.lateral.columns, (65e-6, 85e-6), strict=True):
        for run, elements in ((column.level_1, [4]), (column.level_2, [4, 10])):
            assert [each["station"] for each in run.input["element"]] == elements
            for bearing in run.bearings.values():
                assert bearing.input["bearing"]["assembled_clearance"][0] == pytest.approx(clearance)
                assert bearing.input["bearing"]["machined_clearance"][0] == pytest.approx(105e-6)
    assert [each.name for each in found.lateral.columns] == ["minimum clearance", "maximum clearance"]


def test_the_unbalance_of_a_bending_mode_is_that_of_both_journals(found):
    (first, *_) = found.lateral.placed
    (unbalance,) = first.unbalances
    weight = float(found.lateral.columns[0].level_2["rotor/total_mass"])
    assert unbalance.load == pytest.approx(weight, rel=1e-6)
    assert unbalance.moment == pytest.approx(4 * 6350 * weight / 11000 * 1e-6, rel=1e-6)
    assert 5 <= unbalance.station <= 10
    assert unbalance.angle_deg == 0


def test_antinodes_of_shapes():
    """Of a conical mode two of opposite sign, at the ends; of a circle that is seen at any phase the same."""
    x = np.linspace(-1, 1, 9)
    shape = np.exp(0.7j) * np.stack([x, -1j * x], axis=-1)
    stations, size, sign = limits.antinodes(shape)
    assert stations.tolist() == [1, 9]
    np.testing.assert_allclose(size, [1, 1])
    assert sign[0] == -sign[1]
    assert limits.antinodes(np.stack([1 - x**2, 0 * x], axis=-1))[0].tolist() == [5]


def test_the_vibration_at_a_probe_is_the_projection_of_the_response(found):
    """At the angle from +y towards +z, peak to peak; the scale is that of the largest at operation."""
    study, own = found.lateral.columns[0].studies[0], found.vibrations[0][0]
    at = int(np.flatnonzero(study["speed_rpm"] == 11000)[0])
    y, z = (study[f"response_{a}_real"][at, 0, 2] + 1j * study[f"response_{a}_imag"][at, 0, 2] for a in "yz")
    turn = np.exp(1j * np.linspace(0, 2 * np.pi, 2001))
    along = ((y * turn).real + (z * turn).real) / np.sqrt(2)
    k = int(np.flatnonzero(own.speed_rpm == 11000)[0])
    assert own.labels[1] == "station 3, 45°"
    assert own.probes[k, 1] == pytest.approx(np.ptp(along), rel=1e-5)
    among = (own.speed_rpm >= 7000) & (own.speed_rpm <= 11000)
    assert own.largest == own.probes[among].max()
    assert own.limit == pytest.approx(25.4e-6)
    assert own.scale == pytest.approx(min(6, own.limit / own.largest))


def test_peaks_whose_sides_the_diagram_does_not_reach():
    """The width is that of the side that is there; without any, no margin is asked for."""
    from tiltpad.calculate.response import Peak

    one = limits.judged(Peak("", 5000.0, 1e-6, 4500.0, np.nan), 7000, 11000)
    assert one.peak.amplification_factor == pytest.approx(5)
    assert one.required == pytest.approx(17 * (1 - 1 / 3.5))
    assert limits.judged(Peak("", 5000.0, 1e-6, np.nan, np.nan), 7000, 11000).required == 0


def test_level_i_is_judged_by_the_full_matrices(found):
    for column, level in zip(found.lateral.columns, found.one, strict=True):
        run = column.level_1
        assert level.speed_ratio == pytest.approx(11000 / run["stability/rigid_rpm"][0])
        assert level.decrement[0] == run["stability/log_decrement"][0, 0, 4]
        assert level.decrement[1] > 1.2 * level.decrement[0]
        assert bool(level.reasons) == (level.zero[0] < 2 * level.anticipated or level.decrement[0] < 0.1)


def test_region_b():
    assert [limits.boundary(density) for density in (10, 60, 61)] == [2.5, pytest.approx(2.0), 0]


def test_the_page_and_its_tables(found, quick_pictures):
    page, tables = lateral_report(found.lateral)
    assert all(f"<h2>{title}</h2>" in page for title in TITLES)
    assert "<h1>Compressor &amp; seals</h1>" in page
    named = {each.name: each for each in tables}
    head, rows = named["summary"].head, {row[0]: row for row in named["summary"].rows}
    assert head[3:5] == ("minimum clearance", "maximum clearance")
    # a clearance of 20 um is too close
    assert rows["close clearances"][-1] == "not met"
    assert "Not met: close clearances." in page
    assert rows["stability, level II"][-1] == "met"
    decrements = [each.log_decrement[0, 0] for each in found.two]
    assert [float(each) for each in rows["stability, level II"][3:5]] == pytest.approx(decrements, abs=5e-4)
    clearances = {row[0]: row for row in named["mode_1_clearances"].rows}
    assert [clearances["6"][-1], clearances["10"][-1]] == ["met", "not met"]
    assert len(named["impellers"].rows) == 3


def test_the_command_writes_page_and_tables(case, tmp_path, monkeypatch, quick_pictures):
    from tiltpad import command, lateral_runs

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(lateral_runs.lateral, "__kwdefaults__", {"speeds": 6})
    assert command.report(["--lateral", str(case)]) == 0
    assert (tmp_path / "compressor-lateral.html").stat().st_size > 1e5
    with open(tmp_path / "compressor-lateral-level_1.csv", newline="") as file:
        assert next(csv.reader(file))[1] == "minimum clearance, full"


REFUSED = {
    CASE.partition("&lateral")[0]: "has no group &lateral; a lateral report needs one",
    CASE + "&sweep operation%speed_rpm = 9000, 10000 /": "a study; a lateral report is of one case",
    "&operation speed_rpm = 3000 /": "has no group &lateral",
}


@pytest.mark.parametrize("text", REFUSED)
def test_a_case_is_refused_in_one_line(tmp_path, text):
    (tmp_path / "case.nml").write_text(text)
    words = [sys.executable, "-c", "import sys; from tiltpad.command import report; sys.exit(report())"]
    done = subprocess.run([*words, "--lateral", "case.nml"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert REFUSED[text] in done.stderr
