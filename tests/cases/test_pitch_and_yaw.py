"""Runs of bearings whose journal is inclined and whose pads pitch and yaw, and of shafts whose slopes count.

The figures are those of a study by an independent program: Galerkin's method with 20 x 14 weighted functions,
rigid pivots, pads without weight.
"""

import h5py
import numpy as np
import pytest
from scipy.linalg import eigvals
from test_machine_input import beam, write

CASE = """&case task = 'coefficients' /
&rotor unbalance = 0, gravity = 0, static_load = -19620, 0 /
&pads motion = '{motion}'{inertias} /
&bearing slope = {slope}, 0 /
&film cavitation = 'none' /
&asperity model = 'none' /
&coefficients slopes = .true. /
"""
#: Of the study, kg m^2.
INERTIAS = {"pitch": ", inertia_pitch = 7.790538e-4", "yaw": ", inertia_yaw = 9.777795e-4"}
#: Stiffness against y, z and the slopes, in N, N m, m and rad, at a slope of 200 urad: pads that only tilt,
#: and pads that pitch; damping of the first.
STIFFNESS = np.array(
    [
        [514903469.13, -443104.34, -1370237.29, -100590.28],
        [297771.73, 515967694.71, -1464008.87, -3889505.42],
        [-3098703.46, 1887738.05, 390406.83, 243921.21],
        [1995165.93, -2485385.32, -254947.35, 395890.61],
    ]
)
PITCHING = np.array(
    [
        [508064077.76, -673680.47, -422353.52, 1031.88],
        [64513.83, 509083441.93, 1142.58, 422354.71],
        [-246049.38, 1073.21, 30353.64, -64.93],
        [903.17, 245915.28, 99.88, 30291.39],
    ]
)
DAMPING = np.array(
    [
        [985496.79, -8842.41, -3320.52, -547.11],
        [-9054.49, 987489.82, -447.01, -1504.66],
        [-3949.64, -163.91, 794.94, -1.04],
        [-316.70, -3861.10, -1.54, 791.97],
    ]
)


@pytest.fixture
def found(tiltpad, tmp_path):
    """What a case has at its equilibrium, with its 4 x 4 coefficients."""

    def run(motion, slope, *overrides):
        inertias = "".join(INERTIAS[name] for name in INERTIAS if name in motion)
        (tmp_path / "case.nml").write_text(CASE.format(motion=motion, slope=slope, inertias=inertias))
        words = ("case.nml", "-q", "--overwrite", "-o", "found.h5")
        tiltpad(*words, overrides=overrides, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "found.h5") as file:
            values = {name: file["equilibrium"][name][()] for name in file["equilibrium"]}
            return values | {
                name: file[f"coefficients/slope_{name}"][0, 0] for name in ("stiffness", "damping")
            }

    return run


def expect_coefficients(found, expected, accuracy):
    """Each over the geometric mean of those on the diagonal in its row and column."""
    sizes = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    np.testing.assert_allclose(found / sizes, expected / sizes, rtol=0, atol=accuracy)


def test_an_inclined_journal_on_pads_that_only_tilt(found):
    there = found("tilting_only", 200e-6)
    assert there["journal_y"] == pytest.approx(-45.2283e-6, abs=0.2e-6)
    assert there["min_film_thickness"].min() == pytest.approx(32.4607e-6, abs=0.2e-6)
    assert there["journal_moment_y"] == pytest.approx(-76.594, rel=3e-3)
    assert there["journal_moment_z"] == pytest.approx(50.578, rel=3e-3)
    np.testing.assert_allclose(there["max_pressure"], [5.73324e6, 5.24483e6], rtol=1e-2)
    expect_coefficients(there["stiffness"], STIFFNESS, 1e-4)
    expect_coefficients(there["damping"], DAMPING, 1e-4)
    # the thinner end is that towards which the journal goes down
    assert there["start_film_thickness"].min() < there["end_film_thickness"].min()


def test_pads_that_pitch(found):
    there = found("tilting_pitch", 200e-6)
    assert there["journal_y"] == pytest.approx(-45.3620e-6, abs=0.2e-6)
    assert there["min_film_thickness"].min() == pytest.approx(39.6237e-6, abs=0.2e-6)
    np.testing.assert_allclose(there["pad_pitch"], [-242.379e-6, -40.2135e-6], rtol=0, atol=0.5e-6)
    assert there["journal_moment_y"] == pytest.approx(-9.3416, abs=0.3)
    # what is left of 382 kN m/rad on pads that only tilt
    expect_coefficients(there["stiffness"], PITCHING, 3e-4)


def test_pads_that_pitch_and_yaw_leave_the_bearing_aligned(found):
    """Which is that of pads that only tilt, on a journal without slope."""
    aligned, there = found("tilting_only", 0), found("tilting_pitch_yaw", 200e-6)
    for name in ("journal_y", "journal_z", "min_film_thickness", "max_pressure", "pad_tilt"):
        size = np.abs(aligned[name]).max()
        np.testing.assert_allclose(there[name], aligned[name], rtol=0, atol=max(1e-6 * size, 1e-13))
    np.testing.assert_allclose(there["start_film_thickness"], there["end_film_thickness"], rtol=1e-6)
    assert abs(there["journal_moment_y"]) < 1e-3


def test_ends_exchanged(found):
    """What is even in the slope stays, what is odd has another sign."""
    here, there = found("tilting_pitch", 200e-6), found("tilting_pitch", -200e-6)
    np.testing.assert_allclose(here["pad_pitch"], -there["pad_pitch"], rtol=1e-6)
    np.testing.assert_allclose(here["start_film_thickness"], there["end_film_thickness"], rtol=1e-9)
    even = np.outer([1, 1, -1, -1], [1, 1, -1, -1])
    expect_coefficients(there["stiffness"] * even, here["stiffness"], 1e-6)


def test_a_pivot_off_the_middle_plane_pitches_its_pad(found):
    """1 mm pitches the pads of the paper by 35 to 41 urad."""
    there = found("tilting_pitch", 0, "pads%pivot_axial_offset=1e-3")
    assert np.all(np.abs(there["pad_pitch"]) > 34e-6)
    assert np.all(np.abs(there["pad_pitch"]) < 42e-6)


BRISTLES = ("bristle_deflection_pitch", "bristle_deflection_yaw")
MARCH = """&pads motion = 'tilting_radial_pitch_yaw' /
&friction model = '{friction}', static_coefficient = 0.1, dynamic_coefficient = 0.08 /
&bearing slope = {slope}, 1e-4 /
&operation duration = 0.01 /
&film cavitation = 'none' /
&pivot wear_coefficient = 1e-15 /
"""


@pytest.mark.parametrize("friction", ["none", "bengisu_akay", "lugre"])
def test_marches(tiltpad, tmp_path, friction):
    """With its ends exchanged a shaft moves in the same way; no friction is larger than its limit; all
    rotations wear the pivots (Archard).
    """
    series = {}
    for slope in (2e-4, -2e-4):
        (tmp_path / "case.nml").write_text(
            MARCH.format(friction=friction, slope=slope).replace(", 1e-4", f", {np.sign(slope) * 1e-4}")
        )
        start = (f"start%pad_pitch={slope}",)
        tiltpad("case.nml", "-q", "--overwrite", "-o", "run.h5", overrides=start, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "run.h5") as file:
            series[slope] = {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}
            series[slope]["wear"] = file["summary/pad_wear_rate"][()]
    here, there = series.values()
    slid = [
        (13e-3 - 15e-6) * here[f"pad_{name}"] - here.get("bristle_deflection" + end, 0)
        for name, end in (("tilt", ""), ("pitch", "_pitch"), ("yaw", "_yaw"))
    ]
    ways = np.abs(np.diff(slid, axis=1))[:, -360:]
    loads = 0.5 * (here["pivot_load"][1:] + here["pivot_load"][:-1])[-360:]
    per_time = 1e-15 / (here["time"][-1] - here["time"][-361])
    worn = per_time * np.sum(np.linalg.norm(ways, axis=0) * loads, axis=0)
    np.testing.assert_allclose(here["wear"], worn, rtol=1e-9)
    assert np.all(here["wear"] > 1.2 * per_time * np.sum(ways[0] * loads, axis=0))
    np.testing.assert_allclose(here["journal_y"], there["journal_y"], rtol=0, atol=1e-9)
    np.testing.assert_allclose(here["pad_pitch"], -there["pad_pitch"], rtol=0, atol=2e-8)
    np.testing.assert_allclose(here["start_film_thickness"], there["end_film_thickness"], rtol=0, atol=2e-9)
    if friction == "none":
        assert "friction_moment_pitch" not in here or not here["friction_moment_pitch"].any()
        return
    moments = [here[f"friction_moment{name}"] for name in ("", "_pitch", "_yaw")]
    limit = 0.1 * (13e-3 - 15e-6) * here["pivot_load"]
    if friction == "bengisu_akay":
        assert np.all(np.linalg.norm(moments, axis=0) <= limit * (1 + 1e-6))


def test_a_corner_of_a_pad_that_has_left_its_pivot_hits_the_journal(tiltpad, root, tmp_path):
    """Nothing holds the pitch of a pad without load: asperities at a corner do, and the march goes on."""
    words = (root / "input/examples/five_pads.nml", "-q", "-o", "found.h5")
    overrides = ("pads%motion=tilting_radial_pitch", "operation%duration=0.34")
    tiltpad(*words, overrides=overrides, cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "found.h5") as file:
        asperities, ends = (file[f"{name}"][:, 2] for name in ("asperity_force", "min_film_thickness"))
        assert asperities.max() > 500
        # how hard hangs on rounding, from which its pitch has grown: 1.6 to 2.5 um at other tolerances
        assert -10e-6 < ends.min() < -1e-6
        assert abs(file["pad_pitch"][:, 2]).max() > 1e-3


@pytest.mark.parametrize("pads", [1, 24])
def test_one_pad_and_as_many_as_there_may_be(tiltpad, tmp_path, pads):
    """Under a journal that is held, as one pad holds none: they pitch against the slope."""
    angles = "-90" if pads == 1 else ", ".join(str(15 * k - 172.5) for k in range(24))
    arcs = f"{pads}*{60 if pads == 1 else 12}"
    (tmp_path / "case.nml").write_text(
        f"&pads motion = 'tilting_pitch', pivot_angle_deg = {angles}, arc_deg = {arcs} /\n"
        "&case task = 'equilibrium' /\n&bearing slope = 1e-4, 0, preload = 0.5 /\n"
        "&film cavitation = 'none' /\n&held position = -8e-6, 0 /\n&rotor gravity = 0 /\n"
    )
    tiltpad("case.nml", "-q", "-o", "run.h5", cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "run.h5") as file:
        pitch = file["equilibrium/pad_pitch"][()]
        assert pitch.shape == (pads,)
        # the outward direction of the pad below is -y
        assert pitch[0 if pads == 1 else 5] == pytest.approx(-1e-4, abs=15e-6)


def test_friction_holds_the_pitch_until_the_pads_slide(tiltpad, tmp_path):
    """A shaft that is inclined suddenly: free pads follow at once, rubbing ones are held for some time."""
    pitch = {}
    for friction in ("none", "lugre"):
        (tmp_path / "case.nml").write_text(MARCH.format(friction=friction, slope=2e-4))
        start = (f"friction%model={friction}", "bearing%slope=0,0", "operation%duration=0.001")
        tiltpad("case.nml", "-q", "-o", f"{friction}.h5", overrides=start, cwd=tmp_path, status=0)
        there = ("start%from=file", f"start%file={friction}.h5")
        tiltpad("case.nml", "-q", "--overwrite", "-o", "run.h5", overrides=there, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "run.h5") as file:
            pitch[friction] = file["pad_pitch"][()]
            if friction == "lugre":
                share = np.abs(file["friction_moment_pitch"][()]) / file["pivot_load"][()]
    # the friction coefficient is 0.1 at a ball of 13 mm
    assert 0.2 * 0.1 * 13e-3 < share.max() < 1.5 * 0.1 * 13e-3
    assert np.abs(pitch["lugre"][-1]).max() < 0.9 * np.abs(pitch["none"][-1]).max()


def test_a_march_starts_where_another_has_ended(tiltpad, tmp_path):
    """At the end of its only whole revolution, with all states of the pads."""
    (tmp_path / "case.nml").write_text(MARCH.format(friction="lugre", slope=2e-4))
    first = ("operation%duration=9.2308e-3",)
    tiltpad("case.nml", "-q", "-o", "first.h5", overrides=first, cwd=tmp_path, status=0)
    start = ("start%from=file", "start%file=first.h5", "operation%duration=1e-3")
    start = (*start, "start%pad_yaw_rate(2)=1e-3", "start%pad_pitch(1)=1e-6")
    tiltpad("case.nml", "-q", "-o", "more.h5", overrides=start, cwd=tmp_path, status=0)
    with h5py.File(tmp_path / "first.h5") as first, h5py.File(tmp_path / "more.h5") as more:
        turned = np.argmin(np.abs(first["shaft_angle"][1:] - 2 * np.pi)) + 1
        for name in ("pad_pitch", "pad_yaw", "bristle_deflection", *BRISTLES):
            for each in (name,) if name.startswith("bristle") else (name, f"{name}_rate"):
                assert np.abs(first[each][turned]).max() > 0
                added = {"pad_pitch": [1e-6, 0], "pad_yaw_rate": [0, 1e-3]}.get(each, 0)
                np.testing.assert_array_equal(more[each][0], first[each][turned] + added, err_msg=each)


#: Station of the disc, and those of the bearings.
DISC, STATIONS = 4, (2, 8)
MACHINE = """&case task = 'coefficients' /
&rotor file = 'rotor.h5' /
&bearing name = 'left', station = {0}, shaft_slope = 'film' /
&bearing name = 'right', station = {1}, shaft_slope = 'film' /
&film cavitation = 'none' /
&asperity model = 'none' /
"""


def shaft(disc=DISC, stiffer=1.0):
    """Matrices of a shaft with a disc of 3 t, which bends by some 0.2 mrad in its bearings."""
    matrices = beam(sections=8, length=0.2, diameter=0.2)
    at = 4 * (disc - 1)
    for plane in (at, at + 2):
        matrices["mass"][plane, plane] += 3000
        matrices["mass"][plane + 1, plane + 1] += 150
    matrices["gyroscopic"][at + 1, at + 3] = 300
    matrices["gyroscopic"][at + 3, at + 1] = -300
    matrices["weighed"][at] += 3000
    matrices["total_mass"] += 3000
    matrices["stiffness"] *= stiffer
    return matrices


@pytest.fixture
def machine(tiltpad, tmp_path):
    """What the file of a machine on this shaft has."""

    def run(matrices, *overrides, stations=STATIONS, task="coefficients"):
        write(tmp_path / "rotor.h5", matrices)
        (tmp_path / "machine.nml").write_text(MACHINE.format(*stations))
        words = ("machine.nml", "-q", "--overwrite", "-o", "machine.h5", "--set", f"case%task={task}")
        tiltpad(*words, overrides=overrides, cwd=tmp_path, status=0)
        found = {}
        with h5py.File(tmp_path / "machine.h5") as file:
            file.visititems(
                lambda name, item: found.update({name: item[()]}) if hasattr(item, "shape") else None
            )
        return found

    return run


def in_bearing(found, name, bearing="left"):
    return found[f"bearings/{bearing}/equilibrium/{name}"]


#: Of a bearing alone, and what it has as in the machine.
MATRICES = ("stiffness", "damping")
SAME = ("journal_y", "journal_z", "journal_moment_y", "journal_moment_z", "min_film_thickness")


def on_whole_shaft(matrices, coefficients, speed):
    """Eigenvalues of a shaft, rad/s and 1/s, on stiffness and damping of its bearings, 4 x 4."""
    mass, stiffness = matrices["mass"], matrices["stiffness"].copy()
    damping = speed * matrices["gyroscopic"]
    for station, (own_stiffness, own_damping) in zip(STATIONS, coefficients, strict=True):
        at = 4 * (station - 1) + np.array([0, 2, 1, 3])
        stiffness[np.ix_(at, at)] += own_stiffness
        damping[np.ix_(at, at)] += own_damping
    none, one = np.zeros_like(mass), np.eye(len(mass))
    return eigvals(np.block([[none, one], [-stiffness, -damping]]), np.block([[one, none], [none, mass]]))


@pytest.mark.parametrize("motion", ["fixed", "tilting_radial", "tilting_radial_pitch"])
def test_modes_of_a_shaft_in_bearings_with_slopes(machine, tiltpad, tmp_path, motion):
    """By matrices of each bearing alone, on a rigid journal of the same slope, on the whole shaft."""
    matrices = shaft()
    found = machine(matrices, f"pads%motion={motion}")
    coefficients = []
    for b, bearing in enumerate(("left", "right")):
        slope, load = (
            [float(found[name.format(axis)] if b is None else found[name.format(axis)][b]) for axis in "yz"]
            for name, b in (
                (f"bearings/{bearing}/equilibrium/journal_slope_{{}}", None),
                ("equilibrium/bearing_load_{}", b),
            )
        )
        assert abs(slope[0]) > 1e-4
        (tmp_path / "case.nml").write_text(
            "&case task = 'coefficients' /\n&rotor mass = 1, unbalance = 0, "
            f"static_load = {load[0] + 9.81}, {load[1]} /\n&pads motion = '{motion}' /\n"
            f"&bearing slope = {slope[0]}, {slope[1]} /\n"
            "&film cavitation = 'none' /\n&asperity model = 'none' /\n&coefficients slopes = .true. /\n"
        )
        tiltpad("case.nml", "-q", "--overwrite", "-o", "alone.h5", cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "alone.h5") as file:
            coefficients.append([file[f"coefficients/slope_{name}"][0, 0] for name in MATRICES])
            for name in SAME:
                expected = file[f"equilibrium/{name}"][()]
                nearly = 1e-4 if "moment" in name else 1e-10
                np.testing.assert_allclose(in_bearing(found, name, bearing), expected, rtol=1e-5, atol=nearly)
    expected = on_whole_shaft(matrices, coefficients, 6500 * np.pi / 30)
    expected = expected[(expected.imag >= 0) & (abs(expected) < 2500)]
    modes = found["synchronous/eigenvalue_real"][0] + 1j * found["synchronous/eigenvalue_imag"][0]
    assert len(expected) >= 5
    for value in expected:
        assert np.nanmin(abs(modes - value)) < 1e-3 * abs(value)


def test_a_shaft_that_sags(machine):
    """A symmetric shaft has opposite slopes in its bearings; moments of the films bend it back."""
    found = machine(shaft(disc=5), task="equilibrium")
    left, right = (in_bearing(found, "journal_slope_y", name) for name in ("left", "right"))
    assert left < -1e-4
    assert right == pytest.approx(-left, rel=1e-6)
    moments = [in_bearing(found, "journal_moment_y", name) for name in ("left", "right")]
    assert moments[0] > 30
    assert moments[1] == pytest.approx(-moments[0], rel=1e-6)
    np.testing.assert_allclose(
        in_bearing(found, "start_film_thickness"), in_bearing(found, "end_film_thickness", "right"), rtol=1e-6
    )
    # the static deflection of the whole shaft under weight, and the films' forces and moments
    matrices = shaft(disc=5)
    force = -9.81 * matrices["weighed"]
    at = [4 * (station - 1) for station in STATIONS]
    force[np.array(at) + 1] += moments
    held = [k for k in range(0, 36, 1) if k % 4 < 2 and k not in at]
    bent = np.zeros(36)
    bent[held] = np.linalg.solve(matrices["stiffness"][np.ix_(held, held)], force[held])
    assert bent[at[0] + 1] == pytest.approx(left, rel=1e-4)
    ignored = machine(shaft(disc=5), "bearing%shaft_slope=ignored", task="equilibrium")
    assert abs(ignored["equilibrium/station_slope_y"][1]) > 1.01 * abs(left)


def test_housings_that_are_misaligned(machine, found):
    """A shaft that does not bend is a rigid journal: its bearings have the slope that their housings lack."""
    there = found("tilting_only", 200e-6)
    stiff = shaft(disc=5, stiffer=1e6)
    load = 9.81 * stiff["total_mass"] / 2
    stiff["weighed"] *= 19620 / load
    stiff["mass"] *= 19620 / load
    stiff["total_mass"] *= 19620 / load
    misaligned = ("bearing:left%misalignment=-200e-6,0", "bearing:right%misalignment=200e-6,0")
    machine_found = machine(stiff, "pads%motion=tilting_only", *misaligned, task="equilibrium")
    assert in_bearing(machine_found, "journal_slope_y") == pytest.approx(200e-6, rel=1e-3)
    for name in ("journal_y", "min_film_thickness", "journal_moment_y", "journal_moment_z", "max_pressure"):
        np.testing.assert_allclose(in_bearing(machine_found, name), there[name], rtol=2e-3)


def test_a_shaft_with_its_ends_exchanged(machine):
    here = machine(shaft(disc=4), "pads%motion=tilting_pitch")
    there = machine(shaft(disc=6), "pads%motion=tilting_pitch")
    slope = -in_bearing(there, "journal_slope_y", "right")
    assert in_bearing(here, "journal_slope_y") == pytest.approx(slope, rel=1e-6)
    np.testing.assert_allclose(
        in_bearing(here, "pad_pitch"), -in_bearing(there, "pad_pitch", "right"), rtol=1e-5, atol=1e-12
    )
    for part in ("real", "imag"):
        one, other = (np.sort(each[f"modes/eigenvalue_{part}"][0]) for each in (here, there))
        slow = abs(one) < 1e4
        np.testing.assert_allclose(one[slow], other[slow], rtol=1e-5, atol=1e-3)


def test_pads_that_cannot_pitch_drive_a_slender_rotor(tiltpad, root, tmp_path):
    """By the skew stiffness against slopes, from 6935 rpm on; pads that pitch have none of it."""
    growth = {}
    tilting, pitching = ("pads%motion=tilting_radial" + ending for ending in ("", "_pitch"))
    for setting in (tilting, "bearing%shaft_slope=ignored", pitching):
        overrides = (setting, "operation%speed_rpm=8000", "coefficients%threshold_up_to_rpm=0")
        words = (root / "input/examples/slender.nml", "-q", "--overwrite", "-o", "found.h5")
        tiltpad(*words, overrides=overrides, cwd=tmp_path, status=0)
        with h5py.File(tmp_path / "found.h5") as file:
            values = file["modes/eigenvalue_real"][0] + 1j * file["modes/eigenvalue_imag"][0]
            growth[setting] = values.real[(values.imag > 100) & (values.imag < 220)].max()
    stuck, ignored, free = growth.values()
    assert stuck > 0.1
    assert ignored < -0.3
    assert free < -0.3


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (("bearing%slope=3e-3,0",), "closes the film of pad 1 at rest"),
        (("bearing%slope=0,5e-3", "pads%motion=tilting_pitch"), "closes the film of pad 1 at rest"),
        (("pads%motion=fixed", "pads%inertia_pitch=1e-3"), "is for pads that pitch"),
        (("pads%inertia_yaw=1e-3",), "is for pads that yaw"),
        (("pads%motion=tilting_pitch_yaw", "pads%inertia_yaw=0"), "must be 1e-15 to 1e12"),
        (("pads%motion=tilting_pitch", "pads%inertia_pitch=1e-5"), "must exceed 8.27"),
        (("pads%pivot_axial_offset=1e-3",), "is for pads that pitch"),
        (("pads%motion=tilting_pitch", "pads%pivot_axial_offset=0.05"), "must be less than half of"),
        (("pads%motion=tilting_pitch", "film%solver=sor"), "'auto' does"),
        (
            ("pads%motion=tilting_pitch", "oil%grade=46", "thermal%model=film"),
            "'pad' has a temperature for each pad",
        ),
        (
            ("bearing%slope=1e-4,0", "oil%grade=46", "thermal%model=film"),
            "bearing%slope = 1e-4, 0: is not for",
        ),
        (("machine", "bearing%misalignment=3e-3,0"), "closes the film of pad 1 at rest"),
        (
            ("machine", "bearing%shaft_slope=ignored", "bearing%misalignment=1e-4,0"),
            "bearing%misalignment = 1e-4, 0: has no effect where films ignore slopes",
        ),
        (("machine", "film%solver=sor"), "bearing%shaft_slope = 'film': is not for film%solver = 'sor'"),
        (("bearing%shaft_slope=film",), "shaft_slope"),
    ],
)
def test_bad_input(tiltpad, tmp_path, overrides, words):
    on_shaft = overrides[0] == "machine"
    (tmp_path / "case.nml").write_text(MACHINE.format(*STATIONS) if on_shaft else "&case /\n")
    write(tmp_path / "rotor.h5", shaft())
    overrides = overrides[on_shaft:]
    done = tiltpad("--check", "case.nml", overrides=overrides, cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert words in done.stderr
