"""Bent pads and warm clearances of machines: each bearing has the shape that it has alone under its load."""

import re

import h5py
import numpy as np
import pytest
import tiltpad as package
from test_machine_restarts import stop

#: Two bearings whose pads differ, and bend, and whose loads differ, as the disc is off the middle.
MACHINE = """
&operation speed_rpm=4000 /
&shaft length=0.05, 0.05, 4*0.25, 0.05, 0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=4, mass=1500, polar_inertia=110, diametral_inertia=65 /
&bearing name='left', station=2 /
&bearing name='right', station=8, machined_clearance=160e-6, clearance_temperature=20 /
&pads thickness=20e-3, motion='tilting_only', bending='elastic' /
&pads bearing='right', pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=60, bending='both' /
&oil grade=46 /
&oil bearing='right', grade=32, supply_temperature=45 /
&film cavitation='none' /
&thermal model='film' /
&output samples_per_revolution=90 /
"""
#: Two equal bearings under half of the weight each.
EQUAL = """
&operation speed_rpm=4000 /
&shaft length=0.05, 0.05, 4*0.25, 0.05, 0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=5, mass=1500, polar_inertia=110, diametral_inertia=65 /
&bearing clearance_temperature=20 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
&pads thickness=20e-3, pivot_ratio=0.55, motion='tilting_only', bending='both' /
&oil grade=46 /
&film cavitation='none' /
&thermal model='film' /
"""
#: Without temperatures: the right bearing alone bends, of cold oil.
COLD = """
&operation speed_rpm=4000 /
&shaft length=0.05, 0.05, 4*0.25, 0.05, 0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=4, mass=1500, polar_inertia=110, diametral_inertia=65 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
&pads thickness=20e-3, motion='tilting_only' /
&pads bearing='right', bending='elastic' /
&output samples_per_revolution=90 /
"""
REST = "&case task='equilibrium' /\n"
#: Shapes agree to 1e-7 of the smallest clearance of their bearing, and so do searches that end at such ones,
#: but for what the last round leaves of the one before.
OF_CLEARANCE = 1e-6
#: Of journals, stiffness and damping in such shapes, as in test_bent_pads.py.
AGREE = 1e-5
#: What bending and expansion change.
LENGTHS = ("journal_radius", "machined_clearance", "assembled_clearance", "pivot_distance")


@pytest.fixture
def solve(run, tmp_path):
    """solve(text, *overrides, name="case"): of a case, which has to succeed; its file."""

    def perform(text, *overrides, name="case"):
        run(text, *overrides, name=name)
        return package.read(tmp_path / f"{name}.h5")

    return perform


def given(run):
    """The shapes of a machine as overrides that keep them."""
    return [
        f"{'pads' if name == 'pivot_distance' else 'bearing'}:{bearing}%{name}="
        + ",".join(repr(float(x)) for x in np.atleast_1d(own[f"shape/{name}"]))
        for bearing, own in run.bearings.items()
        if "shape" in own.names()
        for name in LENGTHS
    ]


def assert_same_shape(one, other, part=OF_CLEARANCE):
    """Of two runs of one bearing: all that changes it."""
    size = one.clearance
    assert one.names("shape") == other.names("shape")
    for name in one.names("shape"):
        scale = 1e2 if name.endswith("temperature") else size
        np.testing.assert_allclose(one[f"shape/{name}"], other[f"shape/{name}"], rtol=0, atol=part * scale)


@pytest.mark.parametrize("rotation", ["clockwise", "anticlockwise"])
@pytest.mark.parametrize("text", [MACHINE, EQUAL], ids=["unequal", "equal"])
def test_each_bearing_has_the_shape_that_it_has_alone(solve, text, rotation):
    """A rigid journal under the load that the machine lays on the bearing finds the same shape.

    Journal, stiffness and damping are the same, too.
    """
    words = ("case%task=coefficients", f"operation%rotation={rotation}")
    with solve(text, *words) as machine:
        for name, own in machine.bearings.items():
            with solve(str(own.attributes["input"]), name=name) as alone:
                assert_same_shape(own, alone)
                assert (own["shape/elastic_bending"] > 0).all()
                rest = "equilibrium/journal_y"
                np.testing.assert_allclose(own[rest], alone[rest], atol=AGREE * own.clearance)
                one, other = (package.coefficients(each, "free") for each in (own, alone))
                stiff, damp = np.abs(other.stiffness).max(), np.abs(other.damping).max()
                np.testing.assert_allclose(one.stiffness, other.stiffness, rtol=0, atol=10 * AGREE * stiff)
                np.testing.assert_allclose(one.damping, other.damping, rtol=0, atol=10 * AGREE * damp)


def test_equal_bearings_have_one_shape(solve, run, tmp_path):
    """Under the same load; the console tells it once."""
    with solve(REST + EQUAL) as machine:
        left, right = machine.bearings.values()
        assert_same_shape(left, right)
    (tmp_path / "case.h5").unlink()
    said = run(REST + EQUAL).stdout
    assert len(re.findall(r"pad 1: pad clearance .* in operation", said)) == 1
    assert "all else as of bearing 'left'" in said


def test_a_shaft_that_turns_the_other_way_bends_the_mirrored_pads(solve):
    """The mirror image of a machine has the same shapes, each pad in its place."""
    mirrored = (
        "operation%rotation=anticlockwise",
        "pads:left%pivot_angle_deg=225,-45",
        "pads:right%pivot_angle_deg=234,162,90,18,-54",
    )
    with solve(REST + MACHINE) as one, solve(REST + MACHINE, *mirrored, name="other") as other:
        for name, own in one.bearings.items():
            assert_same_shape(own, other.bearings[name], 1e-2 * OF_CLEARANCE)


def test_a_bearing_that_keeps_its_shape_has_none(solve):
    """Beside one that bends: it has its clearances of the input in operation."""
    with solve(REST + COLD) as machine:
        assert "shape" not in machine.names()
        left, right = machine.bearings.values()
        assert "shape" not in left.names()
        assert left.in_operation == left.input
        bent = right["shape/elastic_bending"]
        assert (bent > 1e-6).all()
        there = np.array(right.input["bearing"]["machined_clearance"])
        np.testing.assert_allclose(
            right.in_operation["bearing"]["machined_clearance"], there + bent, rtol=1e-12
        )
        np.testing.assert_allclose(
            right["summary/equilibrium_bearing_clearance"], right["shape/assembled_clearance"].min()
        )


def test_a_shape_is_that_of_a_machine_made_so(solve):
    """A machine with the radii and clearances that were found has the same films and coefficients."""
    task, shaft = "case%task=coefficients", "oil:right%shaft_temperature=60"
    still = MACHINE.replace(", clearance_temperature=20", "")
    with solve(MACHINE, task, shaft, name="found") as found:
        kept = ("pads:left%bending=none", "pads:right%bending=none", shaft, *given(found))
        with solve(still, task, *kept, name="made") as made:
            for name, own in found.bearings.items():
                other = made.bearings[name]
                assert "shape" not in other.names()
                one, also = (each.equilibrium for each in (own, other))
                for what in ("journal_y", "min_film_thickness", "power_loss"):
                    np.testing.assert_allclose(one[what], also[what], rtol=AGREE)
                one, also = (package.coefficients(each, "free").stiffness for each in (own, other))
                np.testing.assert_allclose(one, also, rtol=0, atol=10 * AGREE * np.abs(also).max())
            one, also = (each["modes/eigenvalue_imag"][0] for each in (found, made))
            np.testing.assert_allclose(one, also, rtol=0, atol=10 * AGREE * np.nanmax(also))


def test_a_march_keeps_the_shapes(solve):
    """Without unbalance it stays at its equilibrium; one that goes on from its end has the same shapes."""
    march = ("operation%duration=0.02", "case%task=march")
    with solve(COLD, *march, name="march") as found:
        bent = found.bearings["right"]["shape/elastic_bending"]
        for own in found.bearings.values():
            assert np.ptp(own.journal_y) < 1e-5 * own.clearance
            highest = package.pressure(own).max_pressure
            np.testing.assert_allclose(highest, own["equilibrium/max_pressure"], rtol=1e-4)
    more = (*march, "start%from=file", "start%file=march.h5")
    with solve(COLD, *more, name="next") as after:
        own = after.bearings["right"]
        np.testing.assert_allclose(own["shape/elastic_bending"], bent, rtol=1e-6)
        assert np.ptp(own.journal_y) < 1e-5 * own.clearance


def test_a_stopped_march_goes_on_in_its_shapes(start, tiltpad, solve, tmp_path):
    """It begins with the bits of the one that was not stopped, and ends so but for the errors of both."""
    text = COLD.replace("4000", "4000, duration=0.2") + "&unbalance station=4, moment=0.01 /\n"
    with solve(text, name="whole") as whole:
        (tmp_path / "case.nml").write_text(text)
        stop(start, tmp_path, after=0.02)
        with h5py.File(tmp_path / "case.h5") as file:
            before = len(file["time"])
        tiltpad("--resume", "case.h5", "case.nml", "-q", cwd=tmp_path, status=0)
        with package.read(tmp_path / "case.h5") as resumed:
            assert 0 < before < len(resumed.time) == len(whole.time)
            for name, own in whole.bearings.items():
                other = resumed.bearings[name]
                for what in own.names("shape") if "shape" in own.names() else ():
                    np.testing.assert_array_equal(own[f"shape/{what}"], other[f"shape/{what}"])
                one, also = own.journal_y, other.journal_y
                np.testing.assert_array_equal(one[:before], also[:before])
                assert np.abs(one - also).max() < 2e-3 * np.ptp(one)


def test_an_orbit_keeps_the_shapes(solve):
    """It is the orbit of a machine that is made so."""
    task, text = "case%task=periodic", COLD + "&unbalance station=4, moment=0.01 /\n"
    with solve(text, task, name="found") as found:
        kept = ("pads:right%bending=none", *given(found))
        with solve(text, task, *kept, name="made") as made:
            for name, own in found.bearings.items():
                other = made.bearings[name].journal_y
                assert np.ptp(other) > 1e-6
                np.testing.assert_allclose(np.ptp(own.journal_y), np.ptp(other), rtol=1e-4)


def test_a_study_has_the_clearances_of_each_run(run, solve, tmp_path):
    """Each run is as it is alone."""
    varied = "pads:right%thickness"
    run(REST + COLD, f"sweep%{varied}=20e-3,25e-3", name="study")
    with (
        solve(REST + COLD, f"{varied}=25e-3", name="alone") as alone,
        package.read_study(tmp_path / "study.h5") as study,
    ):
        found = study.bearings["right"].pad_equilibrium_min_film_thickness
        own = alone.bearings["right"]["equilibrium/min_film_thickness"]
        np.testing.assert_allclose(found[1], own, rtol=1e-12)
        assert (np.abs(found[0] / own - 1) > 1e-4).all()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (("case%task=branch", "branch%parameter=operation%speed_rpm", "branch%last=7000"), "a study of"),
        (("case%task=coefficients", "coefficients%threshold_up_to_rpm=9000"), "finds the shape at each"),
        (("pads:right%motion=fixed",), "pads%motion = 'fixed' has none"),
        (("pads:right%bending=both",), "needs the temperatures in the pads"),
        (("bearing:right%clearance_temperature=20",), "needs oil%shaft_temperature"),
    ],
)
def test_what_is_refused(run, changes, words):
    """With the name of the bearing that asks for it."""
    said = run(COLD, *changes, status=1).stderr
    assert words in said
    assert "bearing 'right': " in said


def test_a_bearing_without_clearance_is_named(run):
    said = run(REST + COLD, "pads:right%thickness=3e-3", status=2).stderr
    assert "bearing 'right': pad 1 bends by" in said
    assert "it is too thin (pads%thickness = 0.003 m)" in said
