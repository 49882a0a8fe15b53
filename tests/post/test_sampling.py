"""Samples of uncertain inputs: the table, its distributions, what is refused, and the study that it makes."""

import csv
import re

import numpy as np
import pytest
import tiltpad
from scipy import stats

CASE = {"case": {"task": "equilibrium"}}
CLEARANCE = "bearing%assembled_clearance"
KINDS = {
    "normal": (("normal", 80e-6, 3e-6), stats.norm(80e-6, 3e-6)),
    "truncated normal": (
        ("truncated normal", 80e-6, 3e-6, 78e-6, 90e-6),
        stats.truncnorm(-2 / 3, 10 / 3, 80e-6, 3e-6),
    ),
    "lognormal": (("lognormal", 80e-6, 0.05), stats.lognorm(0.05, scale=80e-6)),
    "uniform": (("uniform", 70e-6, 90e-6), stats.uniform(70e-6, 20e-6)),
    "of scipy": (stats.triang(0.5, 70e-6, 20e-6), stats.triang(0.5, 70e-6, 20e-6)),
}


@pytest.fixture(autouse=True)
def under_test(program, monkeypatch, tmp_path):
    monkeypatch.setenv("TILTPAD", program)
    monkeypatch.chdir(tmp_path)


def table(path):
    """Names and values of a table."""
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return names, np.array(rows, dtype=float)


@pytest.mark.parametrize("method", ["sobol", "lhs", "halton"])
@pytest.mark.parametrize("kind", KINDS)
def test_values_have_their_distribution(kind, method):
    """Of 256 even points no share of the values is off by more than a few hundredths (random ones: 0.085)."""
    given, expected = KINDS[kind]
    path = tiltpad.sample(CASE, {CLEARANCE: given, "rotor%mass": ("uniform", 1e3, 2e3)}, 256, method=method)
    names, values = table(path)
    assert (names, values.shape) == ([CLEARANCE, "rotor%mass"], (256, 2))
    assert stats.kstest(values[:, 0], expected.cdf).statistic < 0.02
    assert abs(stats.spearmanr(values).statistic) < 0.2


def test_the_same_seed_gives_the_same_table(tmp_path):
    variables = {CLEARANCE: KINDS["normal"][0]}
    texts = [
        tiltpad.sample(CASE, variables, 8, seed=seed, file=tmp_path / f"{k}.csv").read_bytes()
        for k, seed in enumerate((1, 1, 2))
    ]
    assert texts[0] == texts[1] != texts[2]
    assert texts[0] == tiltpad.sample(CASE, variables, 8).read_bytes()


def test_a_table_is_a_study_with_its_inputs_as_coordinates(tmp_path):
    """The values reach the runs to the last bit, from a case in another folder, too."""
    (tmp_path / "cases").mkdir()
    case = tiltpad.write_case(tmp_path / "cases/mine.nml", CASE)
    variables = {CLEARANCE: KINDS["normal"][0], "pads%pivot_distance(2)": ("uniform", 11e-3, 12e-3)}
    path = tiltpad.sample(case, variables, 4, method="lhs", file="cases/members.csv")
    _, values = table(path)
    for study in (
        tiltpad.run(case, sweep={"file": path}),
        tiltpad.run({**CASE, "sweep": {"file": "cases/members.csv"}}),
        tiltpad.run(tiltpad.write_case("cases/with.nml", {**CASE, "sweep": {"file": "members.csv"}})),
    ):
        with study:
            data = study.to_xarray()
            np.testing.assert_array_equal(data.assembled_clearance, values[:, 0])
            np.testing.assert_array_equal(data.pivot_distance_2, values[:, 1])
            assert {"assembled_clearance", "pivot_distance_2"} <= set(data.coords)
            assert len(set(data.equilibrium_journal_y.values)) == 4


MACHINE = """&case task='equilibrium' /
&operation speed_rpm=3000 /
&output keep='summary' /
&shaft length=2*0.05, 4*0.25, 2*0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=5, mass=800, polar_inertia=60, diametral_inertia=35 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
"""


def test_groups_of_a_machine_are_sampled(tmp_path):
    """Those of a bearing by its name, discs by their numbers; each bearing has its own sensitivities."""
    (tmp_path / "machine.nml").write_text(MACHINE)
    variables = {
        "pads:left%arc_deg(1)": ("uniform", 58.0, 62.0),
        "pivot:right%radius_difference": ("uniform", 30e-6, 40e-6),
        "disc(1)%mass": ("normal", 800.0, 1.0),
    }
    path = tiltpad.sample(tmp_path / "machine.nml", variables, 16, file=tmp_path / "members.csv")
    _, values = table(path)
    with tiltpad.run(tmp_path / "machine.nml", sweep={"file": str(path)}) as study:
        assert study.done.all()
        for k, name in enumerate(("pads_left_arc_deg_1", "pivot_right_radius_difference", "disc_1_mass")):
            np.testing.assert_array_equal(study[name], values[:, k])
        most = {}
        for bearing, own in study.bearings.items():
            assert all(len(own[name]) for name in own.names())
            found = tiltpad.sensitivity(own, "equilibrium_journal_y")
            most[bearing] = found.inputs[int(np.argmax(found.first))]
    assert most == {"left": "pads_left_arc_deg_1", "right": "pivot_right_radius_difference"}


NORMAL = ("normal", 2000.0, 10.0)
WRONG = {
    "no variables": ({}, {}, "variables = {}: must be distributions by name"),
    "no number": ({"rotor%mass": NORMAL}, {"n": 0}, "n = 0: must be a whole number, 1 to 1000000"),
    "half a run": ({"rotor%mass": NORMAL}, {"n": 2.5}, "n = 2.5"),
    "method": (
        {"rotor%mass": NORMAL},
        {"method": "mc"},
        "method = 'mc': must be one of 'sobol', 'lhs', 'halton'",
    ),
    "seed": ({"rotor%mass": NORMAL}, {"seed": "x"}, "seed = 'x': must be a whole number from 0 on"),
    "name": ({"mass": NORMAL}, {}, "'mass': must be a variable, group%name"),
    "comma in a name": ({"rotor%mass,x": NORMAL}, {}, "'rotor%mass,x': must be a variable"),
    "distribution": (
        {"rotor%mass": ("gauss", 1, 2)},
        {},
        "rotor%mass: ('gauss', 1, 2) is no distribution; known: ",
    ),
    "a number": ({"rotor%mass": 3}, {}, "rotor%mass: 3 is no distribution"),
    "numbers": (
        {"rotor%mass": ("normal", 1)},
        {},
        "rotor%mass: ('normal', 1): must be ('normal', mean, deviation)",
    ),
    "a text": ({"rotor%mass": ("uniform", 1, "2")}, {}, "must be ('uniform', low, high)"),
    "nan": ({"rotor%mass": ("normal", 1, np.nan)}, {}, "must be ('normal', mean, deviation)"),
    "deviation": (
        {"rotor%mass": ("normal", 1, 0)},
        {},
        "rotor%mass: ('normal', 1, 0): the deviation must be > 0",
    ),
    "ends": ({"rotor%mass": ("uniform", 2, 1)}, {}, "low must be less than high"),
    "median": ({"rotor%mass": ("lognormal", 0, 1)}, {}, "the median must be > 0"),
    "infinite": ({"rotor%mass": stats.norm(1, np.nan)}, {}, "has values that are no finite numbers"),
    "unknown": ({"rotor%mess": NORMAL}, {}, "members.csv line 1, column 1: unknown variable rotor%mess"),
    "twice": (
        {"rotor%mass": NORMAL, "Rotor%Mass": NORMAL},
        {},
        "members.csv line 1, column 2: rotor%mass is swept twice, first at members.csv line 1, column 1",
    ),
    "range": ({"rotor%mass": ("uniform", -2, -1)}, {}, "members.csv line 2, run 1: rotor%mass = -"),
    "case": ({"rotor%mass": NORMAL}, {"case": "none.nml"}, "none.nml: no such file"),
}


@pytest.mark.parametrize("kind", WRONG)
def test_what_is_wrong_is_said_in_a_line_and_leaves_the_file(kind, tmp_path):
    variables, others, words = WRONG[kind]
    (tmp_path / "members.csv").write_text("before")
    others = {"case": CASE, "n": 4, **others}
    with pytest.raises(ValueError, match=re.escape(words)) as error:
        tiltpad.sample(variables=variables, **others)
    assert "\n" not in f"{error.value}"
    assert [each.name for each in tmp_path.iterdir()] == ["members.csv"]
    assert (tmp_path / "members.csv").read_text() == "before"
