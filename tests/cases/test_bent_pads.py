"""Bent pads and warm clearances: the shape against other calculations, what keeps it, and refusals."""

import importlib.util
import re

import numpy as np
import pytest
import tiltpad as package
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from tiltpad.files.namelist import of_pads

#: Two pads of unequal arms; constant viscosity.
REST = "&case task = 'equilibrium' /\n&rotor unbalance = 0 /\n"
PADS = "pivot_ratio = 0.58, motion = 'tilting_only', mass = 0.8, inertia = 4e-4, centre_radial = -0.01"
COLD = f"{REST}&pads {PADS} /\n"
ELASTIC = f"{REST}&pads {PADS}, bending = 'elastic', thickness = 20e-3 /\n"
#: The same with a temperature a pad, and with temperatures in films and pads.
PAD = COLD + "&oil grade = 46 /\n&thermal model = 'pad' /\n"
BOTH = (ELASTIC + "&oil grade = 46 /\n&thermal model = 'film' /\n").replace("elastic", "both")
#: Temperatures at which shaft, pads and housing expand.
WARM = ("bearing%clearance_temperature=20", "oil%shaft_temperature=60", "pads%temperature=60")
#: Relative agreement of equilibria whose shapes agree to 1e-7 of the clearance.
AGREE = 1e-5


@pytest.fixture
def run(tiltpad, tmp_path):
    """run(text, *overrides, name="case"): of a case file, which has to succeed; its file."""

    def perform(text, *overrides, name="case"):
        (tmp_path / f"{name}.nml").write_text(text)
        tiltpad(f"{name}.nml", cwd=tmp_path, overrides=overrides, status=0)
        return package.read(tmp_path / f"{name}.h5")

    return perform


def given(shape):
    """The clearances of a shape as overrides."""
    names = ("journal_radius", "machined_clearance", "assembled_clearance")
    values = {f"bearing%{name}": shape[name] for name in names} | {
        "pads%pivot_distance": shape["pivot_distance"]
    }
    return [
        f"{name}={','.join(repr(float(x)) for x in np.atleast_1d(value))}" for name, value in values.items()
    ]


def bent_beam(run, pad, young=2.1e11, poisson=0.3):
    """Change of the bore's radius of a pad by the film's pressure, m: the circle through both edges.

    The moment is integrated inward from each edge, the curved beam w'' + w = R_m^2 M/(E' I) outward
    from the pivot.
    """
    case = run.in_operation
    thickness = of_pads(case, "pads%thickness")[pad]
    bore = case["bearing"]["journal_radius"] + of_pads(case, "bearing%machined_clearance")[pad]
    middle = bore + thickness / 2
    film = package.pressure(run, along=401, across=81)
    across = np.trapezoid(film.pressure[pad], film.z[pad], axis=1) / np.ptp(film.z[pad])
    stiffness = young / (1 - poisson**2) * thickness**3 / 12
    arms = []
    for side in (1, -1):
        order = np.argsort(side * film.phi[pad])
        pressure = CubicSpline(side * film.phi[pad][order], across[order])
        edge = (side * film.phi[pad]).max()

        # the moment of what lies beyond phi, from the edge inward; then the beam, from the pivot outward
        def moments(phi, m, pressure=pressure):
            return [m[1], pressure(phi) * bore * middle - m[0]]

        moment = solve_ivp(moments, (edge, 0), [0, 0], rtol=1e-9, atol=1e-6, dense_output=True).sol

        def beam(phi, w, moment=moment):
            return [w[1], middle**2 * moment(phi)[0] / stiffness - w[0]]

        arms.append((edge, solve_ivp(beam, (0, edge), [0, 0], rtol=1e-9, atol=1e-15).y[0, -1]))
    matrix = [[1 - np.cos(edge), sign * np.sin(edge)] for (edge, _), sign in zip(arms, (1, -1), strict=True)]
    return np.linalg.solve(matrix, [moved for _, moved in arms])[0]


def test_pressure_bends_pads_as_a_curved_beam_is_bent(run):
    """The pressure of the same films in the shape that is found bends the pads to this shape."""
    with run(ELASTIC) as found:
        bent = found["shape/elastic_bending"]
        own = [bent_beam(found, pad) for pad in range(2)]
        # 401 points of a film that cavitates: 1e-3 of its moment
        np.testing.assert_allclose(bent, own, rtol=2e-3)
        assert (bent > 1e-6).all()
        np.testing.assert_allclose(found["shape/machined_clearance"], 100e-6 + bent, rtol=1e-12)
        np.testing.assert_allclose(found["shape/assembled_clearance"], 80e-6, rtol=1e-12)


def plane_pad(bore, thickness, edge, young, poisson, along=60, through=8):
    """How far the edge of half a pad moves outward, m, by 1 MPa on its bore.

    Finite elements of plane strain, four nodes and incompatible modes (Taylor, Beresford and Wilson
    1976), clamped in the plane of the pivot.
    """
    phi, radius = np.linspace(0, edge, along + 1), bore + np.linspace(0, thickness, through + 1)
    places = np.array([(r * np.sin(a), r * np.cos(a)) for r in radius for a in phi])
    first = (np.arange(through)[:, None] * (along + 1) + np.arange(along)).ravel()
    corners = np.stack([first, first + 1, first + along + 2, first + along + 1], axis=1)
    factor = young / ((1 + poisson) * (1 - 2 * poisson))
    law = factor * np.array(
        [[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, 0.5 - poisson]], dtype=float
    )
    x = places[corners]
    middle = 0.25 * np.array([[-1, 1, 1, -1], [-1, -1, 1, 1]]) @ x
    matrix = np.zeros((len(corners), 12, 12))
    for a, b in np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / np.sqrt(3):
        slopes = 0.25 * np.array([[b - 1, 1 - b, 1 + b, -1 - b], [a - 1, -1 - a, 1 + a, 1 - a]])
        jacobian = slopes @ x
        area = np.linalg.det(jacobian)
        bubbles = np.linalg.solve(middle, np.broadcast_to([[-2 * a, 0], [0, -2 * b]], middle.shape))
        bubbles *= (np.linalg.det(middle) / area)[:, None, None]
        nodes = np.linalg.solve(jacobian, np.broadcast_to(slopes, x.swapaxes(1, 2).shape))
        shapes = np.concatenate([nodes, bubbles], 2)
        strain = np.zeros((len(corners), 3, 12))
        strain[:, 0, 0::2] = strain[:, 2, 1::2] = shapes[:, 0]
        strain[:, 1, 1::2] = strain[:, 2, 0::2] = shapes[:, 1]
        matrix += np.abs(area)[:, None, None] * (strain.swapaxes(1, 2) @ law @ strain)
    inner = np.linalg.solve(matrix[:, 8:, 8:], matrix[:, 8:, :8])
    matrix = matrix[:, :8, :8] - matrix[:, :8, 8:] @ inner
    unknowns = (2 * corners[:, :, None] + [0, 1]).reshape(-1, 8)
    rows, columns = np.repeat(unknowns, 8, axis=1).ravel(), np.tile(unknowns, 8).ravel()
    whole = coo_matrix((matrix.ravel(), (rows, columns)), shape=(2 * len(places),) * 2).tocsr()
    load = np.zeros((len(places), 2))
    between = (phi[:-1] + phi[1:]) / 2
    force = 0.5e6 * bore * np.diff(phi)[:, None] * np.column_stack([np.sin(between), np.cos(between)])
    load[:along] += force
    load[1 : along + 1] += force
    free = np.flatnonzero(np.repeat(places[:, 0] > 1e-9 * bore, 2))
    moved = np.zeros(2 * len(places))
    moved[free] = spsolve(whole[free][:, free].tocsc(), load.ravel()[free])
    return moved.reshape(-1, 2)[along] @ [np.sin(edge), np.cos(edge)]


def test_a_pad_bends_as_plane_elements_do():
    """The closed form of even pressure (tests/unit/test_pad_bending.f90) against plane strain.

    Shear and the curved section, which the beam leaves out, are of the second order in the thickness.
    With the radius of the bore in place of that in the middle they would hide behind the first order.
    """
    bore, edge, young, poisson = 0.05, np.radians(37.5), 2.1e11, 0.3
    differences = []
    for thickness in (0.005, 0.01, 0.02):
        middle = bore + thickness / 2
        stiffness = young / (1 - poisson**2) * thickness**3 / 12
        beam = 1e6 * bore * middle**3 / stiffness * (1 - np.cos(edge)) ** 2 / 2
        differences.append(plane_pad(bore, thickness, edge, young, poisson) / beam - 1)
    thin, usual, thick = differences
    assert 3 < usual / thin < 5
    assert 3 < thick / usual < 5
    # what docs/theory/heat.md says
    assert 0 < thin < 0.02
    assert usual < 0.08
    assert thick < 0.28


@pytest.mark.parametrize("text", [ELASTIC, PAD, BOTH])
def test_a_shape_is_that_of_a_bearing_made_so(run, text):
    """A bearing that is made with the radii and clearances that were found is in the same equilibrium.

    It has the same stiffness and damping, too: they keep the shape.
    """
    warm = (*WARM[::2], "oil%shaft_temperature=55", "pads%pivot_ratio=0.55")
    task = "case%task=coefficients"
    with run(text, task, *warm, name="found") as found:
        shape = found["shape"]
        made = (*given(shape), "pads%bending=none", "oil%shaft_temperature=55", "pads%pivot_ratio=0.55")
        with run(text, task, *made, name="made") as again:
            assert "shape" not in again.names()
            for name in ("journal_y", "min_film_thickness", "power_loss"):
                np.testing.assert_allclose(found.equilibrium[name], again.equilibrium[name], rtol=AGREE)
            one, other = (package.coefficients(each, "free") for each in (found, again))
            size = np.abs(other.stiffness).max()
            np.testing.assert_allclose(one.stiffness, other.stiffness, atol=10 * AGREE * size)
            np.testing.assert_allclose(one.damping, other.damping, rtol=10 * AGREE, atol=1e-3 * size / 680)


def test_a_bearing_of_one_material_grows_as_a_whole(run):
    """Shaft, pads and housing of 60 C: all lengths, and so all clearances, grow by the same part."""
    with run(COLD, *WARM, "bearing%housing_temperature=60") as found:
        shape, bearing = found["shape"], found.input["bearing"]
        part = 1 + 11e-6 * 40
        for name in ("journal_radius", "machined_clearance", "assembled_clearance"):
            np.testing.assert_allclose(shape[name], part * np.array(bearing[name]), rtol=1e-11)
        assert found.clearance == shape["assembled_clearance"].min()


def test_a_warm_shaft_of_300_mm_takes_60_um(run):
    """36 K at a radius of 150 mm: 59.4 um of both clearances, housing and pads being cold."""
    text = REST.replace("unbalance = 0", "mass = 13500, unbalance = 0") + (
        "&bearing journal_radius=0.15, axial_length=0.225, machined_clearance=300e-6\n"
        "  assembled_clearance=225e-6, viscosity=0.02 /\n&operation speed_rpm=3600 /\n"
        "&pads pivot_distance=0.05, motion='tilting_only' /\n"
    )
    warm = ("bearing%clearance_temperature=45", "oil%supply_temperature=45", "pads%temperature=45")
    with run(text, *warm, "oil%shaft_temperature=81") as found:
        taken = 225e-6 - found["shape/assembled_clearance"]
        np.testing.assert_allclose(taken, 11e-6 * 0.15 * 36, rtol=1e-9)
        np.testing.assert_allclose(taken, 60e-6, rtol=0.02)


def test_temperatures_of_the_solution_expand_the_parts(run):
    """Shaft and pads have the temperatures of the films, and the housing that of the supply."""
    with run(BOTH, WARM[0]) as found:
        shape, rest = found["shape"], found.equilibrium
        assert shape["shaft_temperature"] == pytest.approx(float(rest["shaft_temperature"]), abs=1e-3)
        assert shape["housing_temperature"] == found.input["oil"]["supply_temperature"]
        assert (shape["pad_temperature"] > 40).all()
        assert (shape["pad_temperature"] < rest["maximum_temperature"]).all()
        assert (shape["thermal_bending"] > 0).all()
        grown = 11e-6 * (shape["shaft_temperature"] - 20) * 49.9e-3
        assert shape["journal_radius"] - 49.9e-3 == pytest.approx(grown, rel=1e-9)
        own = found["summary/equilibrium_bearing_clearance"]
        assert own == shape["assembled_clearance"].min()


def test_heat_bends_a_pad_as_far_as_its_temperatures_say(run):
    """The better the back is cooled, the more heat goes through the pad, and the more it bends.

    Without expansion it does not bend by heat at all.
    """
    with (
        run(BOTH, "oil%back_coefficient=100", name="usual") as usual,
        run(BOTH, "oil%back_coefficient=1000", name="cooled") as cooled,
        run(BOTH, "pads%expansion=0", name="stiff") as stiff,
    ):
        assert (cooled["shape/thermal_bending"] > 2 * usual["shape/thermal_bending"]).all()
        assert not stiff["shape/thermal_bending"].any()
        assert (stiff["shape/elastic_bending"] > 0).all()


def test_a_march_keeps_the_shape(run, tiltpad, tmp_path):
    """A march without unbalance stays at its equilibrium, and Python takes the shape for films.

    One that goes on from its end has the same shape; so has a result that is verified later.
    """
    march = ("case%task=march", "operation%duration=0.01")
    with run(ELASTIC, *march, name="march") as found:
        assert np.ptp(found.journal_y) < 1e-5 * found.clearance
        film = package.pressure(found)
        np.testing.assert_allclose(film.max_pressure, found["equilibrium/max_pressure"], rtol=1e-4)
        bent = found["shape/elastic_bending"]
    more = (*march, "start%from=file", "start%file=march.h5", "operation%duration=0.002")
    with run(ELASTIC, *more, name="next") as found:
        np.testing.assert_allclose(found["shape/elastic_bending"], bent, rtol=1e-9)
        assert np.ptp(found.journal_y) < 1e-5 * found.clearance
    tiltpad("--resume", "march.h5", "--verify", "5", cwd=tmp_path, status=0)
    with package.read(tmp_path / "march.h5") as found:
        assert (found["summary/pad_film_error_max"] < 1e-3).all()


def test_a_shaft_that_turns_the_other_way_bends_the_mirrored_pads(run):
    """The mirror image of a bearing has the same shape, each pad in its place."""
    mirrored = ("operation%rotation=anticlockwise", "pads%pivot_angle_deg=225,-45")
    with run(BOTH, WARM[0], name="one") as one, run(BOTH, WARM[0], *mirrored, name="other") as other:
        for name in one["shape"]:
            np.testing.assert_allclose(one[f"shape/{name}"], other[f"shape/{name}"], rtol=1e-12)


def test_an_orbit_keeps_the_shape(run):
    with (
        run(ELASTIC, "case%task=periodic", "rotor%unbalance=0.01", name="found") as found,
        run(COLD, "case%task=periodic", "rotor%unbalance=0.01", *given(found["shape"]), name="made") as made,
    ):
        np.testing.assert_allclose(np.ptp(found.journal_y), np.ptp(made.journal_y), rtol=1e-4)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (("pads%bending=thermal",), "needs the temperatures in the pads, thermal%model = 'film'"),
        (("pads%motion=fixed",), "pads%motion = 'fixed' has none"),
        (("case%task=branch", "branch%parameter=operation%speed_rpm", "branch%last=7000"), "a study of"),
        (("case%task=coefficients", "coefficients%threshold_up_to_rpm=9000"), "finds the shape at each"),
        (("case%task=march", "start%from=partial"), "starts at the equilibrium"),
        (("bearing%clearance_temperature=20",), "needs oil%shaft_temperature"),
        (WARM[:2], "needs pads%temperature, or thermal%model = 'film', which gives it (pad 1)"),
        (("pads%pivot_angle_deg=0", "pads%arc_deg=200"), "may reach at most 90 deg from its pivot (pad 1)"),
        (("pads%young_modulus=1",), "pads%young_modulus"),
    ],
)
def test_what_is_refused(tiltpad, tmp_path, changes, words):
    (tmp_path / "case.nml").write_text(ELASTIC)
    assert words in tiltpad("case.nml", cwd=tmp_path, overrides=changes, status=1).stderr


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (("pads%thickness=4e-3",), "it is too thin (pads%thickness = 0.004 m)"),
        ((*WARM, "oil%shaft_temperature=240"), "the clearance of pad 1 is gone: bearing%"),
    ],
)
def test_shapes_without_clearance_are_refused(tiltpad, tmp_path, changes, words):
    (tmp_path / "case.nml").write_text(ELASTIC)
    said = tiltpad("case.nml", cwd=tmp_path, overrides=changes, status=2).stderr
    assert words in said
    assert said.startswith("tiltpad: error: pad") or "the clearance of pad" in said


def test_a_pad_that_heat_bends_too_far_is_refused(tiltpad, tmp_path):
    """Of little conductivity and with a cooled back: by heat alone, whatever its thickness."""
    (tmp_path / "case.nml").write_text(BOTH.replace("'both'", "'thermal'"))
    changes = ("pads%conductivity=0.5", "pads%thickness=3e-3", "oil%back_coefficient=1000")
    said = tiltpad("case.nml", cwd=tmp_path, overrides=changes, status=2).stderr
    assert re.search(r"pad \d bends by .* um, more than its clearance of .*: 0\.0 um by pressure", said)
    assert "too much heat goes through it (pads%thickness = 0.003 m, pads%conductivity = 0.5 W/(m K)" in said


def test_a_study_has_the_clearance_of_each_run(tiltpad, tmp_path):
    """The shaft that is warmer leaves less."""
    (tmp_path / "study.nml").write_text(ELASTIC + "&sweep oil%shaft_temperature = 50, 60 /\n")
    tiltpad("study.nml", cwd=tmp_path, overrides=WARM[::2], status=0)
    with package.read_study(tmp_path / "study.h5") as study:
        warm, warmer = study.equilibrium_bearing_clearance
        assert warm - warmer == pytest.approx(11e-6 * 10 * 49.9e-3, rel=1e-3)


def test_the_page_of_examples_has_its_figures(tiltpad, root, tmp_path):
    """The commands of the section, and what the page says of their results."""
    spec = importlib.util.spec_from_file_location("examples", root / "docs/examples.py")
    page_of_examples = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(page_of_examples)
    page = (root / "docs/examples.md").read_text()
    (tmp_path / "input").symlink_to(root / "input")
    section = page[page.index("## A large turbine bearing") :].partition("\n## ")[0]
    for line in page_of_examples.commands(section):
        program, *words = line.split()
        if program == "tiltpad":
            tiltpad(*words, "--quiet", cwd=tmp_path, status=0)
    assert [words for words in page_of_examples.bent(tmp_path) if words not in section] == []


def test_films_are_verified_in_the_shape_to_the_bit(tiltpad, run, tmp_path):
    """A run that verifies itself has the shape that it found, one that is verified later that of its file."""
    march = (
        *("case%task=march", "rotor%unbalance=0.01", "operation%duration=0.02"),
        "film%solver=direct",
    )
    with run(BOTH, WARM[0], *march, name="later"):
        pass
    words = ("later.nml", "-o", "once.h5", "--verify", "3")
    tiltpad(*words, overrides=(WARM[0], *march), cwd=tmp_path, status=0)
    tiltpad("--resume", "later.h5", "--verify", "3", cwd=tmp_path, status=0)
    with package.read(tmp_path / "once.h5") as once, package.read(tmp_path / "later.h5") as later:
        names = [name for name in once.names("summary") if "film_error" in name]
        assert names == [name for name in later.names("summary") if "film_error" in name]
        for name in names:
            np.testing.assert_array_equal(once[f"summary/{name}"], later[f"summary/{name}"])
        assert (once["summary/pad_film_error_max"] > 0).all()
