"""Machines with temperatures along and across their films: what each bearing has, and what keeps it."""

import numpy as np
import pytest
import tiltpad as package

#: Two bearings that differ in pads and oil.
MACHINE = """
&operation speed_rpm=4000 /
&shaft length=0.05, 0.05, 4*0.25, 0.05, 0.05, diameter=2*0.0998, 4*0.2, 2*0.0998 /
&disc station=5, mass=1500, polar_inertia=110, diametral_inertia=65 /
&unbalance station=5, moment=0.005 /
&bearing name='left', station=2 /
&bearing name='right', station=8 /
&pads bearing='right', pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=60 /
&oil grade=46 /
&oil bearing='right', grade=32, supply_temperature=45 /
&film cavitation='none' /
&thermal model='film' /
&output samples_per_revolution=90 /
"""
REST = "&case task='equilibrium' /\n" + MACHINE
#: Pads of each bearing.
PADS = {"left": 2, "right": 5}
#: Of what the state of an orbit may miss, m; orbits and marches are closed to 1e-6 of a clearance of 80 um.
OF_ORBITS = 2e-8


@pytest.fixture
def solve(run, tmp_path):
    """solve(text, *overrides, name="case"): of a case, which has to succeed; its file."""

    def perform(text, *overrides, name="case"):
        run(text, *overrides, name=name)
        return package.read(tmp_path / f"{name}.h5")

    return perform


def test_each_bearing_has_the_fields_of_its_films(solve):
    """Heat is conserved in each, and its films are solved again as they were from the oil in the file."""
    with solve(REST) as machine:
        for name, bearing in machine.bearings.items():
            rest = bearing.equilibrium
            assert rest["film_temperature"].shape == (PADS[name], 40, 12)
            assert rest["surface_temperature"].shape == (PADS[name], 40)
            heat = package.heat_balance(bearing)
            assert abs(heat.to_shaft.sum()) < 1e-9 * heat.made.sum()
            assert (heat.to_pad > 0).all()
            highest = package.pressure(bearing).max_pressure
            np.testing.assert_allclose(highest, rest["max_pressure"], rtol=1e-9)
        warm = {name: each.equilibrium["inlet_temperature"].min() for name, each in machine.bearings.items()}
        # each groove begins with the oil of its own supply
        assert 39.9 < warm["left"] < 45
        assert warm["right"] > 44.9


def test_a_branch_over_speed_has_the_temperatures_of_each_bearing(solve):
    """Up and down: the first point of either is the equilibrium that is sought there."""
    over = "case%task='branch'", "branch%of='equilibrium'", "branch%parameter='operation%speed_rpm'"
    up = solve(MACHINE, *over, "branch%last=5000", "branch%step=250", name="up")
    down = solve(
        MACHINE, *over, "operation%speed_rpm=5000", "branch%last=4000", "branch%step=-250", name="down"
    )
    with up, down:
        for name in PADS:
            for here, there in ((0, -1), (-1, 0)):
                for each in ("inlet_temperature", "mean_temperature", "maximum_temperature"):
                    one, other = (run.bearings[name][each][k] for run, k in ((up, here), (down, there)))
                    np.testing.assert_allclose(one, other, atol=1e-5, err_msg=each)
            mean = up.bearings[name]["mean_temperature"]
            assert (np.diff(mean, axis=0).max(axis=1) > 0.1).all()


def test_the_input_of_a_run_gives_its_numbers_again(solve):
    with solve(REST) as first, solve(str(first.attributes["input"]), name="again") as again:
        for name in PADS:
            for what in ("journal_y", "film_temperature", "viscosity", "power_loss"):
                one, other = (each.bearings[name][f"equilibrium/{what}"] for each in (first, again))
                np.testing.assert_array_equal(one, other)


def test_an_orbit_is_what_a_march_leads_to(solve):
    """It has the oil of the march; after forty revolutions the tolerances remain."""
    with (
        solve(MACHINE, "case%task=periodic") as orbit,
        solve(MACHINE, "operation%duration=0.62", name="march") as march,
    ):
        for name in PADS:
            one, other = orbit.bearings[name], march.bearings[name]
            for what in ("flow_weights", "shear_weights", "viscosity"):
                np.testing.assert_array_equal(one[what], other[what])
            path, late = one["journal_y"][:-1], other["journal_y"][40 * 90 : 41 * 90]
            assert np.ptp(path) > 1e-6
            both = min(len(path), len(late))
            assert both > 40
            assert np.abs(path[:both] - late[:both]).max() < OF_ORBITS


def test_orbits_of_a_branch_have_the_oil_of_their_equilibrium(solve):
    """Its last point is the orbit that the task periodic finds with the parameter's last value."""
    last = "oil:right%supply_temperature=47"
    branch = f"&branch parameter='{last.partition('=')[0]}', last=47, step=1 /\n"
    with (
        solve(branch + MACHINE, "case%task=branch", name="branch") as along,
        solve(MACHINE, "case%task=periodic", last) as orbit,
    ):
        for name in PADS:
            one, other = along.bearings[name], orbit.bearings[name]
            np.testing.assert_allclose(one["viscosity"][-1], other["equilibrium/viscosity"], rtol=1e-6)
            highest = other["equilibrium/maximum_temperature"]
            np.testing.assert_allclose(one["maximum_temperature"][-1], highest, atol=1e-4)
            assert abs(one["journal_y_max"][-1] - other["journal_y"][:].max()) < OF_ORBITS


def test_a_study_has_the_oil_of_each_run(solve, run, tmp_path):
    """Each run is as it is alone."""
    run(REST + "&sweep oil:right%grade=32, 46 /\n", name="study")
    with (
        solve(REST, "oil:right%grade=46", name="alone") as alone,
        package.read_study(tmp_path / "study.h5") as study,
    ):
        for name in PADS:
            own = study.bearings[name].pad_equilibrium_viscosity[1]
            np.testing.assert_allclose(own, alone.bearings[name]["equilibrium/viscosity"], rtol=1e-12)


def test_oil_that_boils_names_its_bearing(run):
    """Thin hot oil in one bearing, under asperities at 100 rpm."""
    changes = ("operation%speed_rpm=100", "oil:right%grade=10", "oil:right%supply_temperature=90")
    said = run(REST, *changes, "oil:left%grade=680", "disc(1)%mass=6000", status=2).stderr
    assert "bearing 'right'" in said
    assert "where mineral oil boils" in said
