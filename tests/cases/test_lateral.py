"""Stability levels of API 617 in the task coefficients, and what the lateral analysis asks of a case.

The values of level I are those of an independent program with all degrees of freedom, whose films err by 1e-6
of the coefficients. Its Q acts at station 7.
"""

import h5py
import numpy as np
import pytest
from test_elements import BY_FREQUENCY, COLUMNS, COMPRESSOR, LABYRINTHS, LEVEL_II, PISTON, WHOLE

POWER = (1.30e6, 1.22e6, 1.14e6, 1.06e6, 0.98e6)
DIAMETER = (0.4, 0.4, 0.38, 0.38, 0.36)
WIDTH = (0.016, 0.014, 0.012, 0.0105, 0.009)
DENSITY = (22, 26.5, 31.5, 37, 43, 49.5)
IMPELLERS = "".join(
    f"&impeller station={5 + k}, power={POWER[k]}, diameter={DIAMETER[k]}, width={WIDTH[k]}, "
    f"suction_density={DENSITY[k]}, discharge_density={DENSITY[k + 1]} /\n"
    for k in range(5)
)
LATERAL = "&lateral cross_station=7, lowest_rpm=7000 /\n"
#: Of each impeller, N/m.
ANTICIPATED = (637262.7195247933, 674478.9879931388, 764826.83982684, 804139.9567715357, 906879.8449612404)
#: By bearing clearance c_b: logarithmic decrements with Q from 0 to 10 Q_A, Q_0, and with synchronous
#: coefficients Q_0 and the decrement with Q_A.
LEVEL_I = {
    75e-6: (
        (0.5207717480662978, 0.3754328422871188, 0.21113629305357148, 0.048934356628624893,
         -0.11085448984778885, -0.26782713425281157, -0.42155335174603364, -0.5716406184336047,
         -0.7177558750263036, -0.859632433285561, -0.9970702490097185),
        12516235.1301522, 22836354.98188677, 0.9667040927292991,
    ),
    65e-6: (
        (0.4019668378628188, 0.25555199710364546, 0.10711440987720129, -0.04023470273904622,
         -0.1859539816811153, -0.3296176058829054, -0.47083782263768026, -0.6092696088829953,
         -0.7446151057755802, -0.8766256431639977, -1.0051017055206737),
        10324857.419478826, 16057653.232103558, 0.5171971973769782,
    ),
    85e-6: (
        (0.5002188982661293, 0.36297143508432916, 0.18850733233685113, 0.015123157221173321,
         -0.15537580823561195, -0.3222359584044337, -0.48488633386572977, -0.6428724832312079,
         -0.7958447661575393, -0.9435515962611556, -1.085831398879402),
        11695863.61105527, 28998382.473518435, 1.6564361824084561,
    ),
}  # fmt: skip
#: First frequency on rigid bearings without gyroscopic moments, Hz.
RIGID = 110.77825683408075

#: What is added, and what the line says.
REFUSED = {
    LATERAL: "lateral: needs groups &impeller, from which the stability levels of API 617 follow",
    "&impeller station=17 /": "impeller(1)%station = 17: must be 1 to 16, the stations of the shaft",
    "&impeller station=5 /": "impeller(1)%power: must be given, W",
    "&impeller station=5, power=1e6, diameter=1, width=0.01 /": "impeller(1)%suction_density: must be given",
    "&impeller station=5, kind=axial, power=1, diameter=1, width=1, suction_density=1 /": "kind = 'axial': "
    "has no suction_density or discharge_density",
    IMPELLERS
    + "&lateral lowest_rpm=12000 /": "lateral%lowest_rpm = 12000: must be at most operation%speed_rpm",
    IMPELLERS
    + "&lateral last_rpm=9000 /": "lateral%last_rpm = 9000: must be above operation%speed_rpm = 11000",
    IMPELLERS + "&lateral first_rpm=11000 /": "first_rpm = 11000: must be below lowest_rpm = 11000",
    IMPELLERS
    + "&lateral clearance_change=1e-6, -1e-6 /": "lateral%clearance_change = 1e-6, -1e-6: must rise",
    IMPELLERS
    + "&lateral clearance_change=-80e-6, 0 /": "must leave a clearance of bearing 'left', which has",
    IMPELLERS + "&lateral probe_station=3, 20 /": "lateral%probe_station = 20: must be 1 to 16",
    IMPELLERS
    + "&lateral close_station=3, 4, close_clearance=1e-4 /": "must have a value for each close_station",
}


@pytest.fixture
def levels(run, tmp_path):
    """The datasets of a case's stability levels."""

    def make(case, *overrides):
        run(case, *overrides, more=["--overwrite"])
        with h5py.File(tmp_path / "case.h5") as file:
            return {name: values[()] for name, values in file["stability"].items()}

    return make


@pytest.mark.parametrize("clearance", LEVEL_I)
def test_level_i(levels, clearance):
    """The first forward mode from no Q, where it is nearly planar, to ten times the anticipated one."""
    found = levels(COMPRESSOR + IMPELLERS + LATERAL, f"bearing%assembled_clearance={clearance}")
    decrements, zero, synchronous_zero, synchronous = LEVEL_I[clearance]
    anticipated = found["anticipated_cross_stiffness"]
    np.testing.assert_allclose(found["impeller_cross_stiffness"], ANTICIPATED, rtol=1e-12)
    assert anticipated == pytest.approx(sum(ANTICIPATED), rel=1e-12)
    assert found["mean_density"] == 35.75
    np.testing.assert_allclose(found["cross_stiffness"][::4], anticipated * np.arange(11), rtol=1e-12)
    # the modes of the shaft are those that the run chooses
    np.testing.assert_allclose(found["log_decrement"][0, 0, ::4], decrements, atol=2e-5)
    np.testing.assert_allclose(found["zero_cross_stiffness"][0], [zero, synchronous_zero], rtol=2e-5)
    assert found["log_decrement"][0, 1, 4] == pytest.approx(synchronous, abs=2e-5)


def test_level_ii_takes_elements_at_the_frequency_of_the_mode(levels, tmp_path):
    """With labyrinths and a piston over the whirl frequency: without Q as the modes of the task have it."""
    rows = [
        f"{speed},{nu / (2 * np.pi)!r},{k},{q},{-q},{k},{c},0,0,{c}"
        for speed in (2000, 15000)
        for nu, k, q, c in BY_FREQUENCY
    ]
    (tmp_path / "piston.csv").write_text("\n".join([f"speed_rpm,frequency_hz,{COLUMNS}", *rows, ""]))
    piston = "&element station=10, static=.false., file='piston.csv' /\n"
    found = levels(COMPRESSOR + WHOLE + LABYRINTHS + piston + IMPELLERS + LATERAL)
    value = found["eigenvalue_real"][0, 0, 0] + 1j * found["eigenvalue_imag"][0, 0, 0]
    assert abs(value - LEVEL_II[", frequency='own'"]) < 1e-6 * abs(value)


def test_the_sense_of_rotation_does_not_matter(levels):
    one, other = (
        levels(COMPRESSOR + IMPELLERS, f"operation%rotation={sense}")
        for sense in ("clockwise", "anticlockwise")
    )
    for name, values in one.items():
        if values.dtype.kind == "f":
            np.testing.assert_allclose(values, other[name], rtol=1e-6)


def test_where_the_stiffness_acts(levels):
    """Nearest to the middle of the outer bearings, or at overhung impellers in their parts."""
    assert levels(COMPRESSOR + IMPELLERS)["cross_station"] == 8
    overhung = "&impeller station=16, kind='axial', power=1e6, diameter=0.4, width=0.02 /\n"
    found = levels(COMPRESSOR + overhung)
    assert found["cross_station"] == 0
    assert found["anticipated_cross_stiffness"] == pytest.approx(1.5 * 9.55 * 1e6 / (0.4 * 0.02 * 11000))
    stiffness = float(found["anticipated_cross_stiffness"])
    element = f"&element station=16, static=.false., cross_stiffness={stiffness!r} /\n"
    by_element = levels(COMPRESSOR + element + overhung)
    at = found["eigenvalue_imag"][0, 0, 4]
    assert by_element["eigenvalue_imag"][0, 0, 0] == pytest.approx(at, rel=1e-5)


def test_undamped_critical_speeds(levels, run, tmp_path):
    """On stiff bearings those on rigid ones; on soft ones first that of a rigid body on springs.

    Discs of more polar inertia raise them, as they stiffen forward whirl.
    """
    found = levels(COMPRESSOR + IMPELLERS)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["rotor/mode_frequency"][0] == pytest.approx(RIGID, rel=1e-6)
        mass = file["rotor/total_mass"][()]
    speeds, rigid = found["undamped_rpm"], found["rigid_rpm"]
    assert RIGID * 60 < rigid[0] < 1.02 * RIGID * 60
    assert (np.diff(speeds[:, 0]) > 0).all()
    np.testing.assert_allclose(speeds[-1, :2], rigid[:2], rtol=0.01)
    bounce = np.sqrt(2 * found["bearing_stiffness"][0] / mass) * 30 / np.pi
    assert speeds[0, 0] == pytest.approx(bounce, rel=0.03)
    heavier = levels(COMPRESSOR + IMPELLERS, "disc(3)%polar_inertia=0.32", "disc(1)%polar_inertia=0.32")
    assert heavier["rigid_rpm"][1] > rigid[1]


@pytest.mark.parametrize("added", REFUSED)
def test_a_lateral_analysis_is_refused(run, added):
    assert REFUSED[added] in run(COMPRESSOR + added, status=1).stderr


def test_tables_cover_the_diagrams(run, tmp_path):
    columns = "speed_rpm,k_yy,k_yz,k_zy,k_zz,c_yy,c_yz,c_zy,c_zz"
    (tmp_path / "seal.csv").write_text(f"{columns}\n5000,{'1,' * 7}1\n12000,{'1,' * 7}1\n")
    seal = "&element station=10, file='seal.csv' /\n"
    line = run(COMPRESSOR + seal + IMPELLERS + LATERAL, status=1).stderr
    assert "its speed_rpm goes from 5000 to 12000 rpm, and the run has 2200 rpm" in line


def test_a_piston_at_the_equilibrium_is_part_of_the_curve(levels):
    """What the case has is in it, whatever its level."""
    one, other = (levels(COMPRESSOR + PISTON.format(more) + IMPELLERS) for more in ("", ", level=1"))
    np.testing.assert_array_equal(one["log_decrement"], other["log_decrement"])


def test_impellers_need_a_shaft(run):
    assert "&impeller: needs a shaft" in run("&impeller station=1 /", status=1).stderr
