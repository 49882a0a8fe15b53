"""Whole runs against converged values of independent programs, and against each other."""

import resource
from pathlib import Path

import h5py
import numpy as np
import pytest

# Converged last revolution of the paper's LuGre case: y, z (um), tilt of pad 1 (mrad).
LUGRE = {"journal_y": (-63.16, -44.29), "journal_z": (-9.20, 9.82), "pad_tilt": (-0.2324, -0.1396)}


@pytest.fixture
def march(tiltpad, root, tmp_path):
    """Runs a case of input/ with overrides and returns the open file."""
    files = []

    def run(case, *overrides):
        output = tmp_path / f"{len(files)}.h5"
        tiltpad(root / "input" / f"{case}.nml", "-q", "-o", output, overrides=overrides, status=0)
        files.append(h5py.File(output))
        return files[-1]

    yield run
    for file in files:
        file.close()


def test_a_short_run_makes_a_small_file(march):
    """HDF5 takes room for whole chunks: they are as long as the run where it is short."""
    file = march("paper/steady_lugre", "operation%duration=0.008")
    values = sum(data.size for data in file.values() if isinstance(data, h5py.Dataset))
    beside_samples = 1e5  # as in result_size.f90
    assert Path(file.filename).stat().st_size < 2 * 8 * values + beside_samples


def last_revolution(file):
    """Samples of the last revolution at constant speed, both ends included."""
    angle = file["shaft_angle"][:]
    return slice(int(np.searchsorted(angle, angle[-1] - 2 * np.pi - 1e-6)), len(angle))


def deviation(a, b, name):
    """Largest difference of a signal in the last revolution over its peak-to-peak, or over 5 % of its natural
    scale where it hardly moves: bearing clearance; clearance over pad radius."""
    scale = {"journal": 80e-6, "pad": 80e-6 / 50e-3}.get(name.split("_")[0], 0)
    a, b = a[name][last_revolution(a)], b[name][last_revolution(b)]
    return np.abs(a - b).max() / max(np.ptp(b, axis=0).max(), 0.05 * scale)


def test_lugre_for_two_seconds(march):
    """The default case to the digits of the reference, far closer than 1 % of peak-to-peak."""
    file = march("paper/steady_lugre")
    part = last_revolution(file)
    assert len(file["time"]) == 78001
    assert file["time"][-1] == pytest.approx(2, abs=1e-12)
    for name, (low, high) in LUGRE.items():
        values = (1e3 if name == "pad_tilt" else 1e6) * file[name][part].reshape(part.stop - part.start, -1)[
            :, 0
        ]
        assert values.min() == pytest.approx(low, abs=1e-3 * (high - low)), name
        assert values.max() == pytest.approx(high, abs=1e-3 * (high - low)), name


@pytest.mark.parametrize(
    "case", ["steady_tr", "steady_to_ba", "steady_ba_10_05", "steady_lugre", "steady_lugre5"]
)
def test_default_tolerance(march, case):
    """The default relative tolerance keeps 1e-3 of peak-to-peak against one ten times tighter.

    One a thousand times tighter finds the same deviations within a quarter, and makes tables for seconds.
    """
    span = ("operation%duration=0.3", "output%start_time=0.28")
    quick = march(f"paper/{case}", *span)
    exact = march(f"paper/{case}", *span, "integration%relative_tolerance=1e-6")
    names = ["journal_y", "journal_z", "pad_tilt"] + (["friction_moment"] if case != "steady_tr" else [])
    for name in names:
        assert deviation(quick, exact, name) < 1e-3, name


def test_solvers_agree(march):
    """Over-relaxation approaches the axial modes with the square of its cell."""
    span = ("operation%duration=0.06", "film%tolerance=1e-7", "film%cavitation=none")
    fourier = march("paper/steady_lugre", *span)
    errors = []
    for cells in (24, 48):
        grid = (f"film%circumferential_cells={cells}", f"film%axial_cells={cells // 4}")
        errors.append(
            deviation(march("paper/steady_lugre", *span, "film%solver=sor", *grid), fourier, "journal_y")
        )
    assert 3 < errors[0] / errors[1] < 5
    assert errors[1] < 1e-2


def test_sampling_changes_nothing(march):
    """Samples are interpolated: more or fewer of them give the same states at the same times."""
    span = "operation%duration=0.02"
    many = march("paper/steady_lugre", span, "output%samples_per_revolution=360")
    few = march("paper/steady_lugre", span, "output%samples_per_revolution=40")
    late = march("paper/steady_lugre", span, "output%start_time=0.01")
    # the sample times themselves are rounded
    for name in ("journal_y", "bristle_deflection"):
        assert np.allclose(many[name][::9], few[name][:], rtol=1e-9, atol=0)
    assert late["time"][0] == 0.01
    assert late["journal_y"][-1] == pytest.approx(many["journal_y"][-1], abs=1e-9)


def test_run_up_ends_in_the_steady_orbit(march):
    """A slow run-up that ends at 6500 rpm is close to the steady orbit there."""
    steady = march("paper/steady_tr", "operation%duration=0.3")
    runup = march("paper/steady_tr", "operation%speed_rpm=5500", "operation%final_speed_rpm=6500")
    speed = runup["speed"][:]
    assert speed[0] * 30 / np.pi == pytest.approx(5500)
    assert speed[-1] * 30 / np.pi == pytest.approx(6500)
    # the phase is the integral of the speed
    angle = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(runup["time"][:]))])
    assert np.allclose(runup["shaft_angle"][:], angle, rtol=1e-9)
    for name in ("journal_y", "journal_z"):
        size, reference = (np.ptp(file[name][last_revolution(file)]) for file in (runup, steady))
        # the unbalance force of the last revolutions is that of 0.25 % less speed, 0.5 % in force
        assert size == pytest.approx(reference, rel=0.01)


def test_a_run_up_through_a_resonance_keeps_its_accuracy(march):
    """It passes a light vibration, which the integrator raises: after it the orbit erred by 4e-3."""
    usual = march("examples/run_up")
    close = march("examples/run_up", "integration%relative_tolerance=1e-6")
    last = last_revolution(close)
    for name in ("journal_y", "journal_z"):
        # of 5 % of the clearance, as in docs/benchmarks.md
        assert np.abs(usual[name][last] - close[name][last]).max() < 1e-3 * 0.05 * 80e-6


def test_friction_none_is_lugre_without_grip(march):
    """With coefficients of 1e-6 the bristles hold nothing: the frictionless orbit."""
    span = "operation%duration=0.1"
    free = march("paper/steady_tr", span)
    weak = march(
        "paper/steady_lugre", span, "friction%static_coefficient=1e-6", "friction%dynamic_coefficient=1e-6"
    )
    assert deviation(weak, free, "journal_y") < 1e-3
    assert deviation(weak, free, "pad_tilt") < 1e-3


def test_four_pads_change_the_orbit_little(march):
    """The two upper pads carry nothing: less than 2 % of the orbit; equilibrium within 0.05 um."""
    span = ("operation%duration=0.2", "film%cavitation=gumbel")
    two = march("paper/steady_tr", *span)
    four = march("paper/steady_tr", *span, "pads%pivot_angle_deg=-45,225,45,135")
    assert deviation(four, two, "journal_y") < 0.02
    assert abs(four["equilibrium/journal_y"][()] - two["equilibrium/journal_y"][()]) < 5e-8
    assert np.all(four["equilibrium/pivot_load"][2:] == 0)


def test_long_spectra_need_no_stack(tiltpad, tmp_path):
    """180000 samples, with a stack of 1 MB."""
    (tmp_path / "case.nml").write_text(
        "&operation duration=0.47 / &output samples_per_revolution=3600, start_time=0.001 /\n"
    )
    limit = (2**20, resource.getrlimit(resource.RLIMIT_STACK)[1])
    small = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_STACK, limit)}
    tiltpad("case.nml", cwd=tmp_path, status=0, **small)
    with h5py.File(tmp_path / "case.h5") as file:
        assert file["spectrum/frequency"].shape == (50 * 3600 // 2 + 1,)
        assert file["spectrum/revolutions"][()] == 50


def test_stop_when_periodic(march):
    """Ends early and complete, in an orbit that is as close to the final one as was asked for."""
    limit = 1e-4
    early = march("paper/steady_lugre", f"integration%stop_when_periodic={limit}")
    late = march("paper/steady_lugre", "operation%duration=0.5")
    assert early.attrs["complete"] == 1
    assert early["time"][-1] < 0.1
    for name in ("journal_y", "journal_z"):
        a, b = (file[name][-360:] for file in (early, late))
        # what is left falls by half or more each revolution, so it is no more than the last change
        assert abs(a.min() - b.min()) < 2 * limit * 80e-6
        assert abs(a.max() - b.max()) < 2 * limit * 80e-6
    assert "spectrum" in early
