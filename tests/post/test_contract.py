"""Names, dimensions and units of the result file, as docs/results.md lists them."""

import h5py
import numpy as np
import pytest
import xarray

TIME, PADS = ("time",), ("time", "pad")
SERIES = {
    "time": (TIME, "s"),
    "shaft_angle": (TIME, "rad"),
    "speed": (TIME, "rad/s"),
    "journal_y": (TIME, "m"),
    "journal_z": (TIME, "m"),
    "journal_vy": (TIME, "m/s"),
    "journal_vz": (TIME, "m/s"),
    "pad_tilt": (PADS, "rad"),
    "pad_tilt_rate": (PADS, "rad/s"),
    "pivot_deflection": (PADS, "m"),
    "pivot_deflection_rate": (PADS, "m/s"),
    "bristle_deflection": (PADS, "m"),
    "pivot_load": (PADS, "N"),
    "friction_moment": (PADS, "N m"),
    "film_force_tangential": (PADS, "N"),
    "film_force_radial": (PADS, "N"),
    "min_film_thickness": (PADS, "m"),
    "max_pressure": (PADS, "Pa"),
    "asperity_force": (PADS, "N"),
}
ASPERITIES = {
    "summary/pad_asperity_force": (("pad",), "N"),
    "summary/pad_asperity_share": (("pad",), "1"),
    "summary/pad_asperity_time": (("pad",), "s"),
}
EXCITATION = {
    "excitation": (("excitation",), "1"),
    "excitation_y": (("time", "excitation"), "N"),
    "excitation_z": (("time", "excitation"), "N"),
}
CONSTANT = {"pad": (("pad",), "1"), "pivot_angle": (("pad",), "rad")}
EQUILIBRIUM = {
    "equilibrium/journal_y": ((), "m"),
    "equilibrium/journal_z": ((), "m"),
    "equilibrium/pad_tilt": (("pad",), "rad"),
    "equilibrium/pivot_deflection": (("pad",), "m"),
    "equilibrium/pivot_load": (("pad",), "N"),
    "equilibrium/min_film_thickness": (("pad",), "m"),
    "equilibrium/max_pressure": (("pad",), "Pa"),
    "equilibrium/residual": ((), "1"),
    "equilibrium/eccentricity_ratio": ((), "1"),
    "equilibrium/attitude_angle": ((), "rad"),
    "equilibrium/sommerfeld_number": ((), "1"),
    "equilibrium/specific_load": ((), "Pa"),
    "equilibrium/load": (("pad",), "N"),
    "equilibrium/power_loss": (("pad",), "W"),
    "equilibrium/couette_loss": (("pad",), "W"),
    "equilibrium/poiseuille_loss": (("pad",), "W"),
    "equilibrium/boundary_loss": (("pad",), "W"),
    "equilibrium/journal_drag": (("pad",), "N m"),
    "equilibrium/pad_drag": (("pad",), "N m"),
    "equilibrium/inlet_flow": (("pad",), "m^3/s"),
    "equilibrium/outlet_flow": (("pad",), "m^3/s"),
    "equilibrium/side_flow": (("pad",), "m^3/s"),
    "equilibrium/reformation_flow": (("pad",), "m^3/s"),
    "equilibrium/temperature_rise": (("pad",), "K"),
    "equilibrium/reynolds_number": (("pad",), "1"),
    "equilibrium/total_power_loss": ((), "W"),
    "equilibrium/total_inlet_flow": ((), "m^3/s"),
    "equilibrium/total_outlet_flow": ((), "m^3/s"),
    "equilibrium/total_side_flow": ((), "m^3/s"),
    "equilibrium/temperature_rise_fresh": ((), "K"),
    "equilibrium/temperature_rise_side": ((), "K"),
    "equilibrium/eigenvalue_real": ((), "1/s"),
    "equilibrium/eigenvalue_imag": ((), "1/s"),
}
TURBULENCE = {
    "equilibrium/largest_reynolds_number": (("pad",), "1"),
    "equilibrium/turbulent_share": (("pad",), "1"),
}
SPECTRUM = {
    "spectrum/frequency": (("spectrum/frequency",), "Hz"),
    "spectrum/order": (("spectrum/frequency",), "1"),
    "spectrum/journal_y": (("spectrum/frequency",), "m"),
    "spectrum/journal_z": (("spectrum/frequency",), "m"),
    "spectrum/pad_tilt": (("pad", "spectrum/frequency"), "rad"),
    "spectrum/full_frequency": (("spectrum/full_frequency",), "Hz"),
    "spectrum/journal_full": (("spectrum/full_frequency",), "m"),
}
PERIODIC = {
    "multiplier": (("multiplier",), "1"),
    "periodic/multiplier_real": (("multiplier",), "1"),
    "periodic/multiplier_imag": (("multiplier",), "1"),
    "periodic/period": ((), "s"),
    "periodic/multiplier_error": (("multiplier",), "1"),
    "periodic/residual": ((), "1"),
    "periodic/change": ((), "1"),
}
COUNTS = ["steps", "rhs_evaluations", "jacobian_evaluations", "error_test_failures", "convergence_failures"]
COUNTS += ["film_fourier", "film_volumes", "film_passes"]

RADIAL = {"pivot_deflection", "pivot_deflection_rate", "equilibrium/pivot_deflection"}
BRISTLE = {"bristle_deflection"}
TILTING = {"pad_tilt", "pad_tilt_rate", "pivot_load", "friction_moment", "spectrum/pad_tilt"}
TILTING |= {"equilibrium/pad_tilt", "equilibrium/pivot_load"}
#: Cases that march nothing.
EQUILIBRIA = ("equilibrium", "turbulent")
ABSENT = {
    "lugre": set(PERIODIC),
    "bengisu": BRISTLE | set(PERIODIC),
    "none": BRISTLE | set(PERIODIC),
    "tilting": RADIAL | set(PERIODIC),
    "four": set(PERIODIC),
    "fixed": RADIAL | BRISTLE | TILTING | set(PERIODIC),
    "runup": set(SPECTRUM) | set(PERIODIC),
    **dict.fromkeys(EQUILIBRIA, set(SERIES) | set(SPECTRUM) | set(ASPERITIES) | set(PERIODIC)),
    "periodic": set(),
    "excited": set(PERIODIC),
}
ABSENT |= {name: absent | set(EXCITATION) for name, absent in ABSENT.items() if name != "excited"}
ABSENT |= {name: absent | set(TURBULENCE) for name, absent in ABSENT.items() if name != "turbulent"}
EVERYTHING = SERIES | EXCITATION | CONSTANT | EQUILIBRIUM | TURBULENCE | SPECTRUM | ASPERITIES | PERIODIC


@pytest.fixture(params=ABSENT)
def case_name(request):
    return request.param


@pytest.fixture
def file(result, case_name):
    with h5py.File(result(case_name), "r") as file:
        yield file


def test_every_dataset_is_there_and_no_other_case_s(file, case_name):
    there = {name for name in EVERYTHING if name in file}
    assert there == set(EVERYTHING) - ABSENT[case_name]


def test_dimensions_units_and_meaning(file, case_name):
    for name in set(EVERYTHING) - ABSENT[case_name]:
        dimensions, units = EVERYTHING[name]
        dataset = file[name]
        assert dataset.dtype == np.float64, name
        assert dataset.attrs["units"] == units, name
        assert len(dataset.attrs["long_name"]) > 3, name
        assert dataset.ndim == len(dimensions), name
        for axis, dimension in enumerate(dimensions):
            assert dataset.shape[axis] == len(file[dimension]), name
            if name != dimension:
                assert dataset.dims[axis][0] == file[dimension], name
        if dimensions == (name,):
            assert dataset.is_scale, name


def test_pads_and_samples(file, case_name):
    pads = 4 if case_name == "four" else 2
    np.testing.assert_array_equal(file["pad"], np.arange(1, pads + 1))
    np.testing.assert_allclose(np.degrees(file["pivot_angle"]), [-45, 225, 45, 135][:pads], rtol=1e-14)
    for name in set(SERIES) - ABSENT[case_name]:
        assert np.isfinite(file[name][()]).all(), name


def test_excitations_are_those_of_the_case(result):
    """A vibration along y, and a step from its start on; they are numbered in the order of the case."""
    with h5py.File(result("excited"), "r") as file:
        time = file["time"][:]
        expected = np.column_stack([100 * np.cos(2 * np.pi * 80 * time), 200.0 * (time >= 0.01)])
        np.testing.assert_array_equal(file["excitation"], [1, 2])
        np.testing.assert_allclose(file["excitation_y"], expected, atol=1e-9)
        np.testing.assert_allclose(file["excitation_z"], 0, atol=1e-9)


def test_attributes(file, case_name):
    attributes = file.attrs
    assert attributes["format_version"] == 3
    assert attributes["complete"] == 1
    assert attributes["program"] == "tiltpad"
    assert attributes["title"] == ("Steady, it's LuGre" if case_name == "lugre" else "")
    task = "equilibrium" if case_name in EQUILIBRIA else "periodic" if case_name == "periodic" else "march"
    assert attributes["task"] == task
    assert attributes["input"].startswith("&case\n")
    grows = file["equilibrium/eigenvalue_real"][()] > 0
    assert attributes["equilibrium_stability"] == ("oscillatory instability" if grows else "stable")
    assert attributes["version"]
    assert attributes["commit"]
    assert np.datetime64(attributes["created"][:19]) > np.datetime64("2020-01-01")


def test_statistics(file, case_name):
    statistics = file["statistics"]
    for name in COUNTS:
        assert np.issubdtype(statistics[name].dtype, np.integer), name
        assert statistics[name][()] >= 0, name
    marched = case_name not in EQUILIBRIA
    assert (statistics["steps"][()] > 0) == marched
    films = sum(statistics[name][()] for name in ("film_table", "film_fourier", "film_volumes"))
    assert (films > 0) == marched
    for name in ("wall_seconds", "film_seconds"):
        assert statistics[name].attrs["units"] == "s"
    assert statistics["wall_seconds"][()] > 0


def test_xarray_reads_it_as_it_is(result):
    path = result("lugre")
    with xarray.open_dataset(path, engine="h5netcdf") as root:
        assert dict(root.sizes) == {"time": 6 * 360 + 181, "pad": 2, "revolution": 7}
        assert root["pad_tilt"].dims == ("time", "pad")
        assert root["journal_y"].dims == ("time",)
        assert root["journal_y"].attrs["units"] == "m"
        assert {"time", "pad"} <= set(root.coords)
        assert float(root["journal_y"].sel(time=0)) == float(root["journal_y"][0])
    with xarray.open_dataset(path, engine="h5netcdf", group="equilibrium") as group:
        assert group["pad_tilt"].dims == ("pad",)
        assert group["journal_y"].dims == ()
    with xarray.open_dataset(path, engine="h5netcdf", group="spectrum") as group:
        assert group["journal_y"].dims == ("frequency",)
        assert group["pad_tilt"].dims == ("pad", "frequency")
        assert group["journal_full"].dims == ("full_frequency",)
