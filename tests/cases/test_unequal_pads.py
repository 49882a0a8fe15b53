"""Bearings as they are made: pads that differ in clearances and length."""

import re

import numpy as np
import pytest
import tiltpad as package
from conftest import arrays
from peer_film import Film
from scipy.optimize import least_squares

#: Pads and journal without weight, so that what acts on a pad is its film alone.
RADIUS, LENGTH, KAPPA, VISCOSITY, SPEED, LOAD = 0.05, 0.06, 0.014, 0.02, 3000, 3000
ANGLES, ARC = (-135, -90, -45), 40
ASSEMBLED, MACHINED, LENGTHS = (80e-6, 90e-6, 80e-6), (110e-6, 120e-6, 130e-6), (0.06, 0.06, 0.05)
CASE = f"""&case task='equilibrium' /
&rotor gravity=0, static_load=-{LOAD},0 /
&operation speed_rpm={SPEED} /
&bearing journal_radius={RADIUS}, viscosity={VISCOSITY} /
&pads pivot_angle_deg={",".join(map(str, ANGLES))}, arc_deg={ARC}, motion='tilting_only' /
"""
ONE = {"assembled_clearance": 80e-6, "machined_clearance": 120e-6, "axial_length": 0.06}
#: The same bearing, said in other ways.
SAID = {
    "list": ("bearing%assembled_clearance=80e-6,80e-6,80e-6", "bearing%axial_length=3*0.06"),
    "elements": ("bearing%machined_clearance=90e-6,3e-4,3e-4", "bearing%machined_clearance(1)=3*120e-6"),
}
#: Units of the unknowns, journal and tilts; where their search begins, and bounds that keep films open.
UNITS = np.array([1e-5, 1e-5, 1e-3, 1e-3, 1e-3])
FIRST, OPEN = [-3, 0, 0.5, 0.3, 0], ([-6, -3, -1, -1, -1], [0, 3, 2, 2, 2])
GRIDS = ((48, 8), (96, 16))


def listed(values):
    return ",".join(map(str, np.atleast_1d(values)))


def settings(**values):
    return [f"bearing%{name}={listed(value)}" for name, value in values.items()]


@pytest.mark.parametrize("way", SAID)
def test_equal_pads_by_a_list_are_the_same_to_the_last_bit(tiltpad, tmp_path, way):
    (tmp_path / "case.nml").write_text(CASE + "&output keep='all' /\n")
    march = ["case%task=march", "operation%duration=0.02", "bearing%cavitation_pressure=0"]
    for name, more in (("one", ()), ("other", SAID[way])):
        words = [*march, *settings(**ONE), *more]
        tiltpad("case.nml", "-q", "-o", f"{name}.h5", overrides=words, cwd=tmp_path, status=0)
    one, other = (arrays(tmp_path / f"{name}.h5", "statistics", "provenance") for name in ("one", "other"))
    assert one.keys() == other.keys()
    for name in one:
        if one[name].dtype.kind == "f" and "seconds" not in name:
            assert np.array_equal(one[name], other[name], equal_nan=True), name


class Balance:
    """The forces on journal and pads by films on a grid of their own."""

    def __init__(self, assembled, machined, length, grid):
        self.machined, self.pivot = np.array(machined), np.radians(ANGLES)
        self.reach = RADIUS + np.array(assembled) + KAPPA
        self.bore = RADIUS + self.machined
        self.length, self.grid = length, grid

    def forces(self, state):
        """Force of each film on the journal along the pad's own directions, (pad, 2); these directions."""
        found, directions = [], []
        for i, pivot in enumerate(self.pivot):
            own = pivot - state[2 + i]
            axes = np.array([[np.cos(own), -np.sin(own)], [np.sin(own), np.cos(own)]])
            centre = self.reach[i] * np.array([np.sin(pivot), np.cos(pivot)])
            centre -= (self.bore[i] + KAPPA) * axes[1]
            place = axes @ (state[:2] - centre) / self.machined[i]
            surface = RADIUS / self.bore[i]
            film = Film(np.radians(ARC), self.length[i] / self.bore[i], surface, place, *self.grid)
            unit = VISCOSITY * SPEED * np.pi / 30 * self.bore[i] ** 4 / self.machined[i] ** 2
            found.append(unit * film.force(place, np.zeros(2)))
            directions.append(axes)
        return np.array(found), np.array(directions)

    def residual(self, unknown):
        """What is left of the load, and the moment of each film about its pivot over its arm."""
        found, directions = self.forces(unknown * UNITS)
        left = np.einsum("pi,pij->j", found, directions) - [LOAD, 0]
        return np.append(left, found[:, 0]) / LOAD

    def solve(self):
        """Journal, m, tilts, rad, and the loads of the pads, N."""
        found = least_squares(self.residual, FIRST, bounds=OPEN, xtol=1e-12, ftol=1e-15, gtol=1e-14)
        assert np.abs(found.fun).max() < 1e-8, found.message
        state = found.x * UNITS
        return state, -self.forces(state)[0][:, 1]


@pytest.mark.parametrize("low", [False, True], ids=["equal", "made"])
def test_load_shares_are_those_of_another_balance(tiltpad, tmp_path, low):
    """The middle pad is 10 um low, and no two pads are alike. Films of another solver on two grids of second
    order, extrapolated: what is left of their error is a tenth of what the finer one changes; films of an
    equilibrium err by 1.3e-5 of their force where they cavitate (docs/theory/film.md).
    """
    made = dict(zip(ONE, (ASSEMBLED, MACHINED, LENGTHS) if low else ([value] * 3 for value in ONE.values()),
                    strict=True))  # fmt: skip
    (tmp_path / "case.nml").write_text(CASE)
    tiltpad("case.nml", "-q", overrides=settings(**made), cwd=tmp_path, status=0)
    coarse, fine = (
        Balance(made["assembled_clearance"], made["machined_clearance"], made["axial_length"], grid).solve()
        for grid in GRIDS
    )
    with package.read(tmp_path / "case.h5") as run:
        assert run.clearance == 80e-6
        rest = run.equilibrium
        state = np.array([rest["journal_y"], rest["journal_z"], *rest["pad_tilt"]])
        shares = rest["pivot_load"]
    for found, first, second, size in (
        (shares, coarse[1], fine[1], LOAD),
        (state, coarse[0], fine[0], state),
    ):
        allowed = 0.1 * np.abs(first - second) + 1.3e-5 * np.abs(size)
        off = found - (second + (second - first) / 3)
        assert (np.abs(off) <= allowed).all(), (off, allowed)
    if low:
        # of equal pads the middle one carries 1750 N
        assert shares[1] == pytest.approx(1527, abs=2)


#: Two pivots that differ; their pads slide nearly all the time.
PIVOTS = """&operation duration=0.1 /
&pivot socket_radius=13e-3,15e-3, radius_difference=15e-6,30e-6, wear_coefficient=1e-15 /
&friction model='bengisu_akay', static_coefficient=0.01,0.02, dynamic_coefficient=0.01,0.02,
  critical_velocity=1e-6 /
"""


@pytest.fixture(scope="module")
def pivots(tiltpad, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pivots")
    (folder / "case.nml").write_text(PIVOTS)
    said = tiltpad("case.nml", cwd=folder, status=0).stdout
    with package.read(folder / "case.h5") as run:
        yield run, said


@pytest.mark.parametrize("pad", [1, 2])
def test_each_pivot_has_its_own_contact_and_friction(pivots, pad):
    """The contact table is within 1e-6 of the law; friction is its coefficient wherever the pivot slides."""
    run, _ = pivots
    load = package.pivot_load(run.pivot_deflection[:, pad - 1], run, pad)
    np.testing.assert_allclose(run.pivot_load[:, pad - 1], load, rtol=1e-6)
    velocity, coefficient = package.friction_coefficient(run, pad, last=5)
    slides = np.abs(velocity) > 1e-6
    assert slides.mean() > 0.5
    np.testing.assert_allclose(np.abs(coefficient[slides]), 0.01 * pad, rtol=1e-9)


def test_wear_follows_from_the_friction_work(pivots):
    """Where the coefficient of friction is constant, Archard's law is the friction work over it; pivots that
    creep below the critical velocity do less work, and wear hardly at all.
    """
    run, said = pivots
    expected = 1e-15 * run["summary/pad_friction_power"] / np.array([0.01, 0.02])
    np.testing.assert_allclose(run["summary/pad_wear_rate"], expected, rtol=1e-3)
    contact = [package.contact(run.pivot_deflection[-361:, k].mean(), run, k + 1).radius for k in range(2)]
    depth = run["summary/pad_wear_rate"] / (np.pi * np.array(contact) ** 2)
    # the radius follows from the mean load, not from the mean deflection
    np.testing.assert_allclose(run["summary/pad_wear_depth_rate"], depth, rtol=1e-2)
    worn = 3.6e6 * 1e9 * run["summary/pad_wear_rate"][0]
    assert f"wear {worn:.2f} mm^3 and" in said


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("pivot%socket_radius=1e-2,1e-2,1e-2", "pivot%socket_radius"),
        ("bearing%axial_length=0.1,-0.1", "bearing%axial_length = 0.1, -0.1: must be 1e-5 to 100"),
        ("bearing%machined_clearance=1e-4,0", "bearing%machined_clearance = 1e-4, 0: must be 1e-9 to 0.1"),
        (
            "bearing%assembled_clearance=8e-5,3e-4",
            "at most twice bearing%machined_clearance = 1e-4 (both in m; pad 2)",
        ),
        ("friction%static_coefficient=0.1,0.01", "(pad 2)"),
        ("pivot%wear_coefficient=-1e-15", "pivot%wear_coefficient"),
    ],
)
def test_a_wrong_value_of_a_pad_is_one_line(tiltpad, tmp_path, setting, words):
    (tmp_path / "case.nml").write_text("&case /\n")
    assert words in tiltpad("case.nml", overrides=(setting,), cwd=tmp_path, status=1).stderr


#: Tables of a pivot that are refused, and what is said.
TABLES = {
    "falls": (
        "deflection,force\n1e-6,100\n2e-6,90\n",
        "line 3: force = 90: must be above 100, that of the line before",
    ),
    "twice": ("deflection,force\n1e-6,100\n1e-6,200\n", "line 3: deflection = 1e-6: must be above 1e-6"),
    "micrometres": (
        "deflection,force\n1,100\n2,200\n",
        "deflection = 1: must be 0 to 0.1 m; 1 um are 1e-6",
    ),
    "below zero": ("deflection,force\n-1e-6,100\n1e-6,200\n", "deflection = -1e-6: must be 0 to 0.1 m"),
    "one": ("deflection,force\n0,0\n1e-6,200\n", "has one point of force over deflection"),
    "empty": ("", "it needs a line of names, deflection, force"),
    "text": ("deflection,force\n1e-6,many\n", "line 2: force = many: must be a finite number"),
    "nan": ("deflection,force\n1e-6,nan\n", "line 2: force = nan: must be a finite number"),
    "columns": ("force,deflection\n1,2\n", "line 1: force,deflection: must name the columns"),
    "short": ("deflection,force\n1e-6\n", "line 2: force = "),
}


@pytest.mark.parametrize("name", TABLES)
def test_a_bad_table_of_a_pivot_is_one_line(tiltpad, tmp_path, name):
    text, words = TABLES[name]
    (tmp_path / "pivot.csv").write_text(text)
    (tmp_path / "case.nml").write_text("&pivot law='table', file='pivot.csv' /\n")
    said = tiltpad("case.nml", cwd=tmp_path, status=1).stderr
    assert "pivot%file: pivot.csv" in said
    assert words in said


#: Tables in other units, and the number that is meant.
OTHER_UNITS = {
    "kilonewtons": (
        "1e-6,0.9\n1e-5,30\n",
        "pivot%file: its largest force is 30 N, and the bearing carries 19620 N; 30 kN are 30000",
    ),
    "millimetres": (
        "1e-3,900\n1e-2,30000\n",
        "pivot%file: its largest deflection is 0.01 m, and the clearance of the bearing is 8e-5 m; "
        "0.01 mm are 1e-5",
    ),
    "its own": ("1e-6,900\n1e-5,30000\n", ""),
}


@pytest.mark.parametrize("name", OTHER_UNITS)
def test_a_table_of_a_pivot_in_another_unit_has_a_remark(tiltpad, tmp_path, name):
    """Before the run, which may find no equilibrium, and with --check."""
    rows, words = OTHER_UNITS[name]
    (tmp_path / "pivot.csv").write_text(f"deflection,force\n{rows}")
    (tmp_path / "case.nml").write_text("&case task='equilibrium' /\n&pivot law='table', file='pivot.csv' /\n")
    said = tiltpad("case.nml", cwd=tmp_path, status=2 if words else 0).stdout
    assert said.count("pivot%file") == bool(words)
    assert not words or f"remark: {words}" in said
    checked = tiltpad("--check", "case.nml", cwd=tmp_path, status=0).stdout
    assert not words or f"! remark: {words}" in checked


def test_a_table_of_the_law_is_the_law(tiltpad, tmp_path):
    """With 200 points in a decade, byte order mark and row of zeros: the equilibrium is within 1e-6."""
    depth = np.geomspace(1e-8, 1e-4, 801)
    rows = [
        f"{one!r},{two!r}"
        for one, two in zip(depth.tolist(), package.pivot_load(depth).tolist(), strict=True)
    ]
    (tmp_path / "pivot.csv").write_text(
        "\ufeff" + "\r\n".join(["deflection,force", "0,0", *rows]), encoding="utf-8"
    )
    (tmp_path / "case.nml").write_text("&case task='equilibrium' /\n")
    own = ("pivot%law=table", "pivot%file=pivot.csv")
    tiltpad("case.nml", "-q", cwd=tmp_path, status=0)
    tiltpad("case.nml", "-q", "-o", "table.h5", overrides=own, cwd=tmp_path, status=0)
    with package.read(tmp_path / "case.h5") as one, package.read(tmp_path / "table.h5") as other:
        first, second = one.equilibrium, other.equilibrium
        np.testing.assert_allclose(second["pivot_deflection"], first["pivot_deflection"], rtol=1e-6)
        np.testing.assert_allclose(second["pivot_load"], first["pivot_load"], rtol=1e-6)
    assert (
        "needs pivot%law = 'table'" in tiltpad("case.nml", overrides=own[1:], cwd=tmp_path, status=1).stderr
    )


def test_each_pad_may_have_a_table_of_its_own(tiltpad, tmp_path, monkeypatch):
    """Two springs, as law 'linear' has them; file and case keep the names, and both files are looked at."""
    stiffness = 2e9, 3e8
    for name, k in zip("ab", stiffness, strict=True):
        (tmp_path / f"{name}.csv").write_text(f"deflection,force\n1e-6,{1e-6 * k}\n1e-4,{1e-4 * k}\n")
    own = "law='table', file='a.csv', 'b.csv'"
    (tmp_path / "case.nml").write_text(f"&operation duration=0.01 /\n&pivot {own} /\n")
    tiltpad("case.nml", "-q", cwd=tmp_path, status=0)
    springs = ("pivot%law=linear", "pivot%file=''", "pivot%stiffness=2e9,3e8")
    tiltpad("case.nml", "-q", "-o", "springs.h5", overrides=springs, cwd=tmp_path, status=0)
    with package.read(tmp_path / "case.h5") as one, package.read(tmp_path / "springs.h5") as other:
        assert one.input["pivot"]["file"] == ("a.csv", "b.csv")
        for name in ("pivot_deflection", "pivot_load"):
            np.testing.assert_allclose(one.equilibrium[name], other.equilibrium[name], rtol=1e-7)
        depth = one.equilibrium["pivot_deflection"]
        np.testing.assert_allclose(one.equilibrium["pivot_load"], stiffness * depth)
    for value in ("a.csv,b.csv,a.csv", "a.csv,''"):
        overrides = (f"pivot%file={value}",)
        done = tiltpad("case.nml", "-o", "bad.h5", overrides=overrides, cwd=tmp_path, status=1)
        said = r"one text for all pads or one each \(2\)|must name a CSV file .* \(pad 2\)"
        assert re.search(said, done.stderr)
    monkeypatch.chdir(tmp_path)
    with package.run("case.nml", pivot={"file": ["b.csv", "a.csv"]}) as turned:
        np.testing.assert_allclose(
            turned.equilibrium["pivot_load"], stiffness[::-1] * turned.equilibrium["pivot_deflection"]
        )
    (tmp_path / "b.csv").write_text("deflection,force\n1e-6,301\n1e-4,30000\n")
    said = tiltpad("--resume", "case.h5", "--verify", "1", cwd=tmp_path, status=3).stderr
    assert "the file that pivot%file names has changed since" in said


def test_a_changed_table_of_a_pivot_is_noticed(tiltpad, tmp_path):
    """A result does not go on with another pivot."""
    (tmp_path / "pivot.csv").write_text("deflection,force\n1e-6,900\n1e-5,30000\n")
    (tmp_path / "case.nml").write_text("&operation duration=0.01 /\n&pivot law='table', file='pivot.csv' /\n")
    tiltpad("case.nml", "-q", cwd=tmp_path, status=0)
    tiltpad("--resume", "case.h5", "--verify", "1", cwd=tmp_path, status=0)
    (tmp_path / "pivot.csv").write_text("deflection,force\n1e-6,900\n1e-5,30001\n")
    said = tiltpad("--resume", "case.h5", "--verify", "1", cwd=tmp_path, status=3).stderr
    assert "the file that pivot%file names has changed since" in said
