"""Curves of bifurcation points over two inputs: an independent program, branches over one, and refusals."""

from pathlib import Path

import numpy as np
import pytest

#: The paper's two pads.
PADS = """&case  task = 'branch' /
&rotor  mass = {mass}, unbalance = 0 /
&operation  speed_rpm = {first} /
&film  cavitation = 'none' /
&friction  model = '{friction}', static_coefficient = 0.1, dynamic_coefficient = 0.05 /
&asperity  model = 'none' /
&branch  of = 'curve', point = 'hopf', parameter = 'operation%speed_rpm', last = {last}
         second_parameter = '{second}', second_last = {second_last} /
"""
MASS, CLEARANCE = "rotor%mass", "bearing%machined_clearance"
FREE = {"mass": 200, "friction": "none", "first": 12500, "last": 20000}
STUCK = {"mass": 2000, "friction": "lugre", "first": 8000, "last": 9500}


#: Another program: finite volumes x cosine modes, root finding (limit 1e-5): value, rpm, Hz at the end.
HOPF = [
    (FREE, MASS, 100.0, 13566.82039, 108.8864571),
    (FREE, MASS, 400.0, 18819.64369, 108.9748639),
    (FREE, CLEARANCE, 9.2e-05, 14946.29521, 113.6744411),
    (FREE, CLEARANCE, 0.000116, 15419.06573, 102.6297067),
    (STUCK, CLEARANCE, 9e-05, 9106.050884, 84.45362614),
    (STUCK, CLEARANCE, 0.00013, 9064.001598, 80.25800749),
    (STUCK, MASS, 1000.0, 9273.773483, 79.09207925),
    (STUCK, MASS, 3500.0, 8237.25546, 85.35740902),
]
START = {"none": (14945.84335, 109.5464534), "lugre": (9084.209641, 83.18377783)}


@pytest.mark.parametrize(("case", "second", "last", "rpm", "frequency"), HOPF)
def test_hopf_points(follow, case, second, last, rpm, frequency):
    file, _ = follow(PADS.format(second=second, second_last=last, **case))
    with file:
        start = START[case["friction"]]
        assert file["second_parameter"][-1] == last
        for at, expected in ((0, start), (-1, (rpm, frequency))):
            assert file["parameter"][at] == pytest.approx(expected[0], rel=1e-5)
            assert file["frequency"][at] == pytest.approx(expected[1], rel=1e-5)
        np.testing.assert_allclose(file["frequency_ratio"], file["frequency"][:] * 60 / file["parameter"][:])
        # what was stable is not any longer above the first threshold
        assert (file["stable_side"][:] == -1).all()
        assert (file["stable"][:] == 1).all()
        # the same program: cycles of free pads with 200 kg lie below; of stuck ones no derivative tells
        assert (file["born_side"][:] == (-1 if case is FREE else 0)).all()


#: The same program, shooting (limit 3e-5): kg m, rpm, rotation number.
SACKER = {
    "free": ((14700, 15200, FREE), (0.00025, 14948.20653, 0.4398735351), (0.001, 14969.53579, 0.4406360666)),
    "stuck": ((9000, 9600, STUCK), (0.003, 9245.47936, 0.4587497065), (0.005, 9437.830873, 0.4708894251)),
}


@pytest.mark.parametrize("name", SACKER)
def test_neimark_sacker_points(follow, name):
    (first, last, case), *expected = SACKER[name]
    text = PADS.format(
        second="rotor%unbalance", second_last=expected[1][0], **case | {"first": first, "last": last}
    )
    text = text.replace("unbalance = 0", f"unbalance = {expected[0][0]}").replace("hopf", "neimark_sacker")
    file, _ = follow(text, "branch%max_step=100")
    with file:
        for at, (unbalance, rpm, rotation) in zip((0, -1), expected, strict=True):
            assert file["second_parameter"][at] == unbalance
            assert file["parameter"][at] == pytest.approx(rpm, rel=3e-5)
            assert file["rotation_number"][at] == pytest.approx(rotation, rel=3e-5)
        frequency = file["rotation_number"][:] * file["parameter"][:] / 60
        np.testing.assert_allclose(file["frequency"], frequency)
        assert (file["stable_side"][:] == -1).all()


def test_folds_of_cycles(follow):
    """The same program: 0.5 rpm; beyond the start, a branch over the speed alone."""
    case = FREE | {"last": 15500}
    text = PADS.format(second=MASS, second_last=210, **case).replace("hopf", "cycle_fold")
    file, printed = follow(text, "branch%max_step=1000")
    assert "remark: film%cavitation = 'none': limit cycles may be held by tension" in printed
    with file:
        assert file["parameter"][0] == pytest.approx(12795.1, abs=0.5)
        assert (file["stable_side"][:] == 1).all()
        mass, speed, period = (float(file[name][-2]) for name in ("second_parameter", "parameter", "period"))
        assert file["frequency"][-2] == pytest.approx(1 / period)
    branch = ("branch%of='limit_cycle'", f"rotor%mass={mass!r}")
    alone, _ = follow(
        text.replace("point = 'cycle_fold', ", "").split("         second")[0] + "/", *branch, name="one"
    )
    with alone:
        kinds = list(alone["bifurcations/kind"])
        assert alone["bifurcations/parameter"][kinds.index(b"fold")] == pytest.approx(speed, rel=1e-5)


#: A short plain bearing (L/D 0.05), over its viscosity; numbers as in test_limit_cycles.py.
SHORT = """&case  task = 'branch' /
&rotor  mass = 10, unbalance = 0 /
&operation  speed_rpm = 7700 /
&bearing  journal_radius = 1, axial_length = 0.1, assembled_clearance = 1e-4
          machined_clearance = 1e-4, viscosity = {viscosity} /
&pads  motion = 'fixed', pivot_angle_deg = -90, arc_deg = 360, pivot_ratio = 0.5 /
&film  cavitation = 'gumbel' /
&asperity  model = 'none' /
&branch  of = 'curve', point = 'hopf', parameter = 'operation%speed_rpm', last = 8400, max_step = 350
         second_parameter = 'bearing%viscosity', second_last = {last} /
"""
GRAVITY, GAP = 9.81, 1e-4
RPM = (GRAVITY / GAP) ** 0.5 * 30 / np.pi
#: Viscosity of a capacity number of 1.
VISCOSITY = 10 * GRAVITY**0.5 * GAP**2.5 / 0.1**3


def test_short_bearing(follow):
    """Ocvirk's bearing of no width (another program; limit 2e-3)."""
    file, _ = follow(SHORT.format(viscosity=4 * VISCOSITY, last=6 * VISCOSITY))
    with file:
        found = file["parameter"][0] / RPM, file["parameter"][-1] / RPM
        assert file["second_parameter"][-1] == 6 * VISCOSITY
        np.testing.assert_allclose(found, [2.735263141, 2.75064044], rtol=2e-3)


def test_where_cycles_change_their_side(follow):
    """The same bearing: above this capacity number cycles are born below the threshold speed."""
    file, printed = follow(SHORT.format(viscosity=2.5 * VISCOSITY, last=4 * VISCOSITY))
    assert "generalised_hopf at operation%speed_rpm" in printed
    with file:
        assert list(file["bifurcations/kind"]) == [b"generalised_hopf"]
        capacity = file["bifurcations/second_parameter"][0] / VISCOSITY
        assert capacity == pytest.approx(3.167158, rel=1e-3)
        at = int(file["bifurcations/point"][0]) - 1
        assert file["frequency_ratio"][at] == pytest.approx(0.505652, rel=1e-3)
        eccentricity = np.hypot(file["journal_y_max"][at], file["journal_z_max"][at]) / GAP
        assert eccentricity == pytest.approx(0.1410932, rel=2e-3)
        born = np.where(file["second_parameter"][:] < file["second_parameter"][at], 1, -1)
        assert (np.delete(file["born_side"][:] == born, at)).all()
    assert "above" in printed.split("cycles born")[1].splitlines()[1]


#: Wide films without tables that cavitate: orbits whose period doubles. Folds of oil whose heat runs away.
DOUBLED = """&case  task = 'branch' /
&output  samples_per_revolution = 90 /
&rotor  mass = 500, unbalance = 0.007 /
&pads  motion = 'fixed', pivot_angle_deg = -90, 90, arc_deg = 160 /
&bearing  preload = 0 /
&branch  of = 'curve', point = 'period_doubling', parameter = 'rotor%unbalance', last = 0.009, step = 0.0005
         second_parameter = 'rotor%mass', second_last = 510 /
"""
THIN = """&case  task = 'branch' /
&rotor  mass = 5000, unbalance = 0 /
&operation  speed_rpm = 3000 /
&pads  motion = 'tilting_only' /
&film  cavitation = 'none' /
&oil  grade = 10, supply_temperature = 40 /
&thermal  model = 'pad' /
&branch  of = 'curve', point = 'fold', parameter = 'rotor%mass', last = 9000, max_step = 1000
         second_parameter = 'oil%supply_temperature', second_last = 43 /
"""
#: A rotor in squeeze film dampers, whose orbits jump.
JUMPS = (Path(__file__).parents[2] / "input/examples/aero.nml").read_text()
JUMPS = "&reduction damp_above = 2000 /" + JUMPS.replace("&reduction damp_above = 2000 /", "").replace(
    "last = 9000",
    """of = 'curve', point = 'fold', last = 7500, step = 1000, max_step = 1000
         second_parameter = 'bearing:front%damping(1)', second_last = 1000""",
)
#: Temperatures along and across films.
WARM = "&oil grade = 32, supply_temperature = 40 /\n&thermal model = 'film' /\n" + PADS.format(
    second=MASS, second_last=210, **FREE | {"first": 16500, "last": 18500}
).replace("point = 'hopf'", "point = 'hopf', max_step = 2000")
#: Case, the branch over one parameter, its kind of points, how closely both agree (multipliers of cavitated
#: films depend on the mesh), stable side.
ALONE = {
    "hopf": (
        PADS.format(second=CLEARANCE, second_last=9e-5, **FREE), "equilibrium", b"hopf", 2e-7, -1,
    ),
    "hopf with warm films": (WARM, "equilibrium", b"hopf", 2e-6, -1),
    "period_doubling": (DOUBLED, "periodic", b"period_doubling", 1e-3, 1),
    "fold": (THIN, "equilibrium", b"fold", 2e-7, -1),
    "fold of orbits": (JUMPS, "periodic", b"fold", 1e-6, -1),
}  # fmt: skip


@pytest.mark.parametrize("name", ALONE)
def test_points_are_those_of_branches(follow, name):
    """At the last value of the second parameter, a branch over the first finds the same point."""
    text, of, kind, closely, side = ALONE[name]
    point = name.partition(" ")[0]
    file, printed = follow(text)
    with file:
        second, value, parameter = (
            file.attrs["branch_second_parameter"], float(file["second_parameter"][-1]), file["parameter"][-1],
        )  # fmt: skip
        assert (file["stable_side"][:] == side).all()
        assert ("frequency" in file) == (point != "fold")
        assert ("above", "below")[side < 0] in printed
    alone = text[: text.index("second_parameter")].replace(f", point = '{point}'", "") + "/"
    one, _ = follow(alone, f"branch%of='{of}'", f"{second}={value!r}", name="one")
    with one:
        kinds = list(one["bifurcations/kind"])
        assert one["bifurcations/parameter"][kinds.index(kind)] == pytest.approx(parameter, rel=closely)


def test_five_pads(follow):
    """Both period doublings of a branch lie on one curve, which turns; that of tori ends at 1:2."""
    text = (Path(__file__).parents[2] / "input/examples/five_pads_unbalanced.nml").read_text()
    over = ("branch%of='curve'", "branch%second_parameter='operation%speed_rpm'", "branch%second_last=6000")
    over = (*over, "branch%max_step=0.004")
    branch, _ = follow(text, "branch%switch=.false.", "branch%last=0.032", name="one")
    with branch:
        kinds = list(branch["bifurcations/kind"])
        assert kinds == [b"period_doubling", b"period_doubling", b"neimark_sacker"]
        places = branch["bifurcations/parameter"][:]
    curve, _ = follow(text, *over, "branch%point='period_doubling'", name="doubled")
    with curve:
        np.testing.assert_allclose(curve["parameter"][[0, -1]], places[:2], rtol=1e-3)
        assert curve["second_parameter"][:].min() < 8900
    curve, printed = follow(text, *over, "branch%point='neimark_sacker'", name="torus")
    assert "its frequency comes to half of that of the orbit" in printed
    with curve:
        assert curve["parameter"][0] == pytest.approx(places[2], rel=1e-3)
        assert list(curve["bifurcations/kind"]) == [b"resonance_1_2"]
        assert curve["rotation_number"][-1] == pytest.approx(0.5, abs=0.01)


def test_stuck_pads_depend_on_their_bristles(follow):
    """The same program, with the damping of bristles of eq (28) at 1e6 throughout: 12353 rpm at 1e5, 8828 at
    4e6; and not on the coefficient of friction, which a remark says.
    """
    case = STUCK | {"first": 8500, "last": 14000}
    text = PADS.format(second="friction%bristle_stiffness", second_last=4e6, **case)
    file, printed = follow(text, "friction%bristle_stiffness=1e5", "friction%bristle_damping=10")
    assert "Hopf points of stuck pads" not in printed
    with file:
        assert (np.diff(file["parameter"]) < 0).all()
        np.testing.assert_allclose(file["parameter"][[0, -1]], [12353, 8828], atol=0.6)
    file, printed = follow(
        PADS.format(second="friction%static_coefficient", second_last=0.2, **STUCK), name="level"
    )
    assert "Hopf points of stuck pads depend on friction%bristle_stiffness, not on" in printed
    with file:
        np.testing.assert_allclose(file["parameter"], file["parameter"][0], rtol=1e-6)


REFUSALS = {
    "no such point": (("branch%last=13000",), 2, "the equilibria have no Hopf point from"),
    "eigenvalue": (("branch%last=13000",), 2, "there the leading eigenvalue is -29.2"),
    "twice": (("branch%second_parameter='operation%speed_rpm'",), 1, "a curve is over two different numbers"),
    "unbalance": (("rotor%unbalance=0.01",), 1, "branch%point = 'hopf': must be without unbalance"),
    "sharp folds": (
        ("branch%point='fold'", "thermal%model='film'", "oil%grade=32"),
        1,
        "a study of branches over operation%speed_rpm has the folds of this model at values of rotor%mass",
    ),
    "driven cycles": (("rotor%unbalance=0.01", "branch%point='cycle_fold'"), 1, "must be without unbalance"),
    "not driven": (("branch%point='neimark_sacker'",), 1, "needs an unbalance, about whose orbits it is"),
    "friction": (("friction%model='bengisu_akay'",), 1, "must be 'none' or 'lugre' with branch%point"),
    "no curve": (("branch%of='equilibrium'",), 1, "branch%point = 'hopf': has no effect on"),
    "level": (("branch%second_last=200",), 1, "is the value of rotor%mass already, where the curve starts"),
    "range": (("branch%second_last=-2",), 1, "branch%second_last = -2: must be"),
    "run-up": (("operation%final_speed_rpm=13000",), 1, "operation%final_speed_rpm = 13000: must be"),
    "effect": (("branch%second_parameter='rotor%unbalance'", "branch%second_last=1"), 1, "no effect"),
    "no name": (("branch%second_parameter='rotor%mess'",), 1, "branch%second_parameter = 'rotor%mess'"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals(tiltpad, tmp_path, name):
    """One line that names what to change."""
    overrides, status, words = REFUSALS[name]
    (tmp_path / "case.nml").write_text(PADS.format(second=MASS, second_last=400, **FREE))
    done = tiltpad("case.nml", "-q", cwd=tmp_path, overrides=overrides)
    assert done.returncode == status
    assert done.stderr.count("\n") == 1
    assert words in done.stderr


@pytest.mark.parametrize(
    ("left_out", "words"), [("point = 'hopf', ", "point"), (" second_parameter = 'rotor%mass',", "")]
)
def test_what_is_left_out(tiltpad, tmp_path, left_out, words):
    text = PADS.format(second=MASS, second_last=400, **FREE)
    assert left_out in text
    (tmp_path / "case.nml").write_text(text.replace(left_out, ""))
    done = tiltpad("case.nml", "-q", cwd=tmp_path, status=1)
    assert f"branch%of = 'curve': needs branch%{words or 'second_parameter'}, " in done.stderr
