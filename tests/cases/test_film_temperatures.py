"""Temperatures along and across films: what a run writes of them, a rerun of its input, and refusals."""

import re

import h5py
import numpy as np
import pytest
import tiltpad as package

FILM = "&oil grade=46 /\n&thermal model='film' /\n"
REST = "&case task='equilibrium' /\n" + FILM


@pytest.fixture
def run(tiltpad, tmp_path):
    """run(text, *overrides, name="case"): of a case file in the test's folder, which has to succeed."""

    def perform(text, *overrides, name="case"):
        (tmp_path / f"{name}.nml").write_text(text)
        return tiltpad(f"{name}.nml", cwd=tmp_path, overrides=overrides, status=0)

    return perform


def test_a_run_has_the_fields_of_its_films(run, tmp_path):
    said = run(REST).stdout
    with h5py.File(tmp_path / "case.h5") as file:
        rest = file["equilibrium"]
        field, surface = rest["film_temperature"][()], rest["surface_temperature"][()]
        assert field.shape == (2, 40, 12)
        assert surface.shape == (2, 40)
        assert rest["film_temperature"].attrs["units"] == "degC"
        along, height = file["film_arc"][()], file["film_height"][()]
        np.testing.assert_allclose(along, (np.arange(40) + 0.5) / 40)
        assert (np.diff(height) > 0).all()
        # layers are the narrower the closer to a wall
        widths = np.diff((1 - np.cos(np.pi * np.arange(13) / 12)) / 2)
        np.testing.assert_allclose((field @ widths).mean(axis=1), rest["mean_temperature"])
        # the film beside the pad, and what heats it most: towards the trailing edge
        assert (np.abs(field[:, :, 0] - surface) < 1).all()
        assert (surface.max(axis=1) <= rest["maximum_temperature"][()] + 1e-9).all()
        assert (surface.argmax(axis=1) > 30).all()
        assert field.min() > 40 - 1
        highest = rest["maximum_temperature"][()].max()
    assert f"pad at most {highest:.1f} C" in said


def test_the_input_of_a_run_gives_its_numbers_again(run, tmp_path):
    run(REST + "&pads thickness=20e-3, conductivity=45 /\n")
    with h5py.File(tmp_path / "case.h5") as first:
        text = first.attrs["input"]
        run(text if isinstance(text, str) else text.decode(), name="again")
        with h5py.File(tmp_path / "again.h5") as again:
            for name in ("journal_y", "film_temperature", "viscosity", "power_loss"):
                np.testing.assert_array_equal(first[f"equilibrium/{name}"], again[f"equilibrium/{name}"])


def test_the_shaft_and_the_back_of_the_pads_take_heat(run, tmp_path):
    """A shaft and an oil behind the pads of 60 C warm a bearing; pads without a coefficient are warmer."""
    found = {}
    for name, more in {
        "usual": (),
        "tight": ("oil%back_coefficient=0",),
        "warm": ("oil%shaft_temperature=60", "oil%back_temperature=60"),
    }.items():
        run(REST, *more, name=name)
        with h5py.File(tmp_path / f"{name}.h5") as file:
            found[name] = {
                each: file[f"equilibrium/{each}"][()] for each in ("maximum_temperature", "shaft_temperature")
            }
    assert (found["tight"]["maximum_temperature"] > found["usual"]["maximum_temperature"]).all()
    assert (found["warm"]["maximum_temperature"] > found["usual"]["maximum_temperature"]).all()
    assert found["warm"]["shaft_temperature"] == 60


def test_coefficients_and_a_study(run, tmp_path):
    """Two oils in a study, of which each run is as it is alone."""
    run(
        "&case task='coefficients' /\n" + FILM + "&sweep oil%grade=32, 46 /\n",
        name="study",
    )
    run("&case task='coefficients' /\n" + FILM, name="alone")
    with h5py.File(tmp_path / "alone.h5") as alone, package.read_study(tmp_path / "study.h5") as study:
        np.testing.assert_allclose(
            study.pad_equilibrium_viscosity[1], alone["equilibrium/viscosity"], rtol=1e-12
        )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            FILM.replace("'film'", "'film', march='groove'") + "&operation final_speed_rpm=9000 /\n",
            "thermal%march = 'groove': has no effect but with thermal%model = 'pad'",
        ),
        (
            REST.replace("grade=46", "carry_over=0.5"),
            "needs an oil whose viscosity depends on its temperature",
        ),
        (REST.replace("'film'", "'film', layers=3"), "thermal%layers"),
    ],
)
def test_what_is_refused(tiltpad, tmp_path, text, words):
    (tmp_path / "case.nml").write_text(text)
    assert words in tiltpad("case.nml", cwd=tmp_path, status=1).stderr


def test_films_are_solved_again_as_they_were(run, tmp_path):
    """Pressures, forces and losses from the oil in the file are those of the run, at rest and in a march."""
    run(FILM + "&operation duration=0.02 /\n&output samples_per_revolution=90 /\n")
    with package.read(tmp_path / "case.h5") as case:
        rest = case.equilibrium
        np.testing.assert_allclose(package.pressure(case).max_pressure, rest["max_pressure"], rtol=1e-9)
        found = package.pressure(case, 0.01)
        # a sample has the error of the march
        radial = case.film_force_radial[np.abs(case.time - found.time).argmin()]
        np.testing.assert_allclose(found.force[:, 1], radial, rtol=1e-3)
        losses = package.losses(case, last=3)
        # the march starts at the equilibrium
        np.testing.assert_allclose(losses.power[0], rest["power_loss"], rtol=1e-6)
        np.testing.assert_allclose(losses.side_flow[0], rest["side_flow"], rtol=1e-6)
        np.testing.assert_array_equal(case["flow_weights"], rest["flow_weights"])


#: A heavy and slow journal: asperities make all but half a percent of the heat.
RUBBING = "&rotor mass=300 /\n&operation speed_rpm=60 /\n&asperity roughness=1.2e-5 /\n"


@pytest.mark.parametrize("more", ["", RUBBING], ids=["films", "asperities"])
def test_heat_is_conserved(run, tmp_path, more):
    """What films and asperities make warms the fresh oil up to the drain and goes out behind the pads."""
    run(REST + more)
    with package.read(tmp_path / "case.h5") as case:
        heat, rest, oil = package.heat_balance(case), case.equilibrium, case.input["oil"]
        np.testing.assert_allclose(heat.to_oil + heat.to_shaft + heat.to_pad, heat.made)
        assert abs(heat.to_shaft.sum()) < 1e-9 * heat.made.sum()
        assert (heat.to_pad > 0).all()
        assert (rest["boundary_loss"].sum() > 0.9 * heat.made.sum()) == bool(more)
        np.testing.assert_allclose(heat.made.sum(), rest["total_power_loss"], rtol=2e-3)
        # pad 2 gets what its neighbour upstream sends on
        hot = oil["carry_over"] * rest["outlet_flow"][0]
        fresh = rest["inlet_flow"].sum() - hot
        warming = rest["drain_temperature"] - oil["supply_temperature"]
        # flows of the energy's volumes and of the losses' differ by the error of either
        np.testing.assert_allclose(
            heat.to_oil.sum(), oil["density"] * oil["specific_heat"] * fresh * warming, rtol=2e-3
        )


def test_an_orbit_is_what_a_march_leads_to(run, tmp_path):
    """As with even oil: after twenty revolutions the tolerances remain."""
    more = "&friction model='none' /\n&output samples_per_revolution=90 /\n"
    run(FILM + more + "&case task='periodic' /\n")
    run(FILM + more, "operation%duration=0.19", name="march")
    with h5py.File(tmp_path / "case.h5") as orbit, h5py.File(tmp_path / "march.h5") as march:
        for name in ("journal_y", "journal_z"):
            one, other = orbit[name][:-1], march[name][20 * 90 : 21 * 90]
            assert np.ptp(one) > 1e-5
            both = min(len(one), len(other))
            assert both > 40
            assert np.abs(one[:both] - other[:both]).max() < 2e-8, name
        for name in ("flow_weights", "shear_weights", "viscosity"):
            np.testing.assert_array_equal(orbit[name], march[name])


def test_orbits_of_a_branch_have_the_oil_of_their_equilibrium(run, tmp_path):
    """Its last point is the orbit that the task periodic finds with the parameter's last value."""
    more = FILM + "&output samples_per_revolution=90 /\n"
    run(
        "&case task='branch' /\n&branch parameter='oil%supply_temperature', last=42, step=1 /\n" + more,
        name="branch",
    )
    run("&case task='periodic' /\n" + more, "oil%supply_temperature=42")
    with h5py.File(tmp_path / "branch.h5") as branch, h5py.File(tmp_path / "case.h5") as orbit:
        rest = orbit["equilibrium"]
        np.testing.assert_allclose(branch["viscosity"][-1], rest["viscosity"], rtol=1e-6)
        np.testing.assert_allclose(branch["maximum_temperature"][-1], rest["maximum_temperature"], atol=1e-4)
        highest = branch["journal_y_max"][-1], orbit["journal_y"][:].max()
        assert abs(highest[0] - highest[1]) < 2e-8


def test_oil_that_does_not_thin_is_even(run, tmp_path):
    """A march with temperatures of an oil whose viscosity does not depend on them is that of cold oil."""
    even = "&oil reference_viscosity=0.02, temperature_exponent=0 /\n&operation duration=0.05 /\n"
    # rounding alone differs, which changes where steps end: their errors are far below the limit
    even += "&film table_tolerance=4e-6 /\n&integration relative_tolerance=1e-9 /\n"
    run(even + "&thermal model='film' /\n")
    run(even, name="cold")
    with h5py.File(tmp_path / "case.h5") as case, h5py.File(tmp_path / "cold.h5") as cold:
        for name in ("journal_y", "journal_z", "pad_tilt"):
            size = np.ptp(cold[name][:])
            assert np.abs(case[name][:] - cold[name][:]).max() < 1e-6 * size, name


def test_films_of_a_march_come_from_tables(run, tmp_path):
    """Five pads, most of which cavitate: orbits are those of films that are solved.

    Both march closely. The grid of `direct` is what differs: 9e-4 with its default, 6.6e-4, 1.5e-4 and 8e-5
    with 80 by 16, 160 by 16 and 160 by 32 cells.
    """
    case = (
        "&rotor mass=1500, balance_grade=2.5 /\n&operation speed_rpm=5000, duration=0.5 /\n"
        "&bearing journal_radius=63.5e-3, axial_length=63.5e-3, assembled_clearance=0.2e-3, preload=0.3 /\n"
        "&pads pivot_angle_deg=-54,18,90,162,234, arc_deg=60, density=7850,"
        " thickness=20e-3, pivot_distance=20e-3 /\n"
    )
    close = "integration%relative_tolerance=1e-6"
    run(case + FILM, close)
    grid = ("film%circumferential_cells=160", "film%axial_cells=16")
    run(case + FILM, close, "film%solver='direct'", *grid, name="direct")
    with h5py.File(tmp_path / "case.h5") as tables, h5py.File(tmp_path / "direct.h5") as direct:
        counts = {name: tables[f"statistics/film_{name}"][()] for name in ("table", "volumes")}
        assert counts["table"] > 10 * counts["volumes"]
        assert direct["statistics/film_volumes"][()] > 5 * counts["volumes"]
        assert direct["statistics/film_table"][()] == 0
        for name in ("journal_y", "journal_z"):
            both = [file[name][:][-200:] for file in (tables, direct)]
            assert np.ptp(both[1]) > 1e-6
            assert np.abs(both[0] - both[1]).max() < 5e-4 * np.ptp(both[1]), name


def test_oil_that_boils_names_its_pad(tiltpad, tmp_path):
    """Thin oil under asperities, at 100 rpm."""
    text = REST.replace("grade=46", "grade=10, supply_temperature=80") + "&rotor mass=6000 /\n"
    (tmp_path / "case.nml").write_text(text + "&operation speed_rpm=100 /\n")
    refused = tiltpad("case.nml", cwd=tmp_path, status=2).stderr
    assert "the oil in the hottest place of the film of pad 1 would have" in refused
    assert "where mineral oil boils" in refused


@pytest.mark.parametrize("motion", ["fixed", "tilting_only"])
def test_oil_that_runs_against_the_rotation_names_its_pad(tiltpad, tmp_path, motion):
    """Pressures beside slow pads above that of the supply press oil out of the leading edges."""
    text = REST + f"&bearing ambient_pressure=1e6 /\n&pads motion='{motion}' /\n&operation speed_rpm=20 /\n"
    text += "&film circumferential_cells=40, axial_cells=5 /\n"
    (tmp_path / "case.nml").write_text(text.replace("grade=46", "grade=46, shaft_temperature=45"))
    refused = tiltpad("case.nml", cwd=tmp_path, status=2).stderr
    said = r"around pad (\d) drive its oil against the rotation .* over (\d+) % of its arc"
    pad, part = map(int, re.search(said, refused).groups())
    assert 0 < part < 50
    assert "; thermal%model = 'pad' has an equilibrium" in refused
    for way, sign in (("thermal%model='pad'", -1), ("bearing%supply_pressure=1e6", 1)):
        tiltpad("case.nml", "--overwrite", cwd=tmp_path, overrides=(way,), status=0)
        with h5py.File(tmp_path / "case.h5") as file:
            assert sign * file["equilibrium/inlet_flow"][pad - 1] > 0


@pytest.mark.parametrize(("offset", "missed"), [(0.6, 0.2), (0.7, 1)])
def test_the_trailing_edge_is_the_hottest_place(run, tmp_path, offset, missed):
    """Most heat is made at the end of a steep wedge, half a station behind the last one, which is cooler."""
    highest = {}
    for stations in (40, 160):
        wedge = ("pads%motion='tilting_only'", f"pads%pivot_ratio={offset}", f"thermal%stations={stations}")
        run(REST, *wedge, name=f"wedge{stations}")
        with h5py.File(tmp_path / f"wedge{stations}.h5") as file:
            highest[stations] = file["equilibrium/maximum_temperature"][()].max()
            last = file["equilibrium/surface_temperature"][:, -1].max()
    assert highest[160] == pytest.approx(highest[40], abs=missed)
    assert highest[160] > last


def test_a_grid_with_an_unloaded_pad_that_leaps(run, tmp_path):
    """A turbine bearing of 200 mm, whose third pad bears nothing: the same on three grids."""
    case = """&case task='equilibrium' /
&rotor mass=6177.37 /
&operation speed_rpm=6360 /
&bearing journal_radius=0.1, axial_length=0.15, machined_clearance=0.0002, assembled_clearance=0.00015 /
&pads pivot_angle_deg=-54,18,90,162,234, arc_deg=58, motion='tilting_only', mass=1e-3, inertia=1e-6,
   pivot_distance=35e-3, thickness=35e-3, conductivity=50, centre_tangential=0, centre_radial=-0.01 /
&pivot socket_radius=0.05, radius_difference=1e-4 /
&asperity model='none' /
&oil law='walther', kinematic_viscosity=32e-6,5.362e-6, at_temperature=40,100,
   density=860, density_slope=-0.64, specific_heat=1950, conductivity=0.13,
   supply_temperature=45, carry_over=0.8, widest_gap_deg=60, back_coefficient=100, back_temperature=45 /
&thermal model='film', stations=40, layers=12 /
"""
    journal = []
    for parts in (1, 2, 3):
        run(case, f"thermal%stations={40 * parts}", f"thermal%layers={12 * parts}", name=f"grid{parts}")
        with h5py.File(tmp_path / f"grid{parts}.h5") as file:
            journal.append([file[f"equilibrium/journal_{axis}"][()] for axis in "yz"])
            assert file["equilibrium/pivot_load"][2] == pytest.approx(0, abs=1)
    coarse, fine = np.linalg.norm(np.diff(journal, axis=0), axis=1)
    assert fine < coarse / 4 < 5e-8
