"""Studies of machines: columns of bearings and stations, blocks, what a stop leaves, maps over the speed.

The rotor is that of docs/theory/machines.md, *Check values*. The response of a light shaft with a heavy disc
is known in closed form over the coefficients of its bearings.
"""

import csv
import signal

import h5py
import numpy as np
import pytest
import tiltpad as package
from conftest import wait_for

SPEEDS = "1000:8000:70"
LENGTHS = "length=2*0.05, 8*0.2, 2*0.05, diameter=2*0.0998, 8*0.34, 2*0.0998"
#: Disc, bearings and their films.
REST = """
&film cavitation='none' /
&friction model='lugre' /
&disc station=7, mass=2847.3706547456786, polar_inertia=512.526717854222,
   diametral_inertia=280.5609218476075 /
&unbalance station=7, moment=0.02 /
&bearing name='left', station=2 /
&bearing name='right', station=12 /
"""
MACHINE = f"&operation speed_rpm=4100, duration=0.05 /\n&shaft {LENGTHS} /{REST}"
#: The same with a shaft that is no mass: a disc on a spring between two bearings.
YOUNG, POISSON, DIAMETER, DISC, UNBALANCE = 2.1e11, 0.3, 0.2, 2000.0, 0.02
HALF_SPAN, DENSITY = 0.8, 1.0
JEFFCOTT = f"""
&shaft length=2*{HALF_SPAN}, diameter=2*{DIAMETER}, density={DENSITY} /
&film cavitation='none' /
&disc station=2, mass={DISC}, polar_inertia=1e-3, diametral_inertia=1e-3 /
&unbalance station=2, moment={UNBALANCE} /
&bearing name='left', station=1 /
&bearing name='right', station=3 /
"""


@pytest.fixture(scope="module")
def performed(tiltpad, tmp_path_factory):
    """Runs a study in a folder of its own and gives the path of its file."""

    def run(case, *overrides, arguments=()):
        folder = tmp_path_factory.mktemp("machine")
        (folder / "case.nml").write_text(case)
        tiltpad("case.nml", *arguments, overrides=overrides, cwd=folder, status=0)
        return folder / "case.h5"

    return run


@pytest.fixture(scope="module")
def speeds(performed):
    """The linear map over the speed."""
    with package.read_study(
        performed(MACHINE, "case%task=coefficients", f"sweep%operation%speed_rpm={SPEEDS}")
    ) as study:
        yield study


def numbers(path):
    """All datasets of a file but times, by their names."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, each: found.update({name: each[()]}) if is_result(name, each) else None)
    return found


def is_result(name, each):
    return isinstance(each, h5py.Dataset) and not name.endswith("seconds")


def expect_same(one, other):
    assert one.keys() == other.keys()
    for name, values in one.items():
        np.testing.assert_array_equal(values, other[name], err_msg=name)


@pytest.mark.parametrize("task", ["equilibrium", "coefficients", "march", "periodic"])
def test_groups_of_a_bearing_and_of_the_shaft_are_varied(performed, task):
    path = performed(
        MACHINE,
        f"case%task={task}",
        "output%keep=summary",
        "output%samples_per_revolution=60",
        "sweep%pads:left%arc_deg(1)=60, 65",
        "sweep%unbalance(1)%moment=0.01, 0.02",
    )
    with package.read_study(path) as study:
        assert study.parameters == ["pads_left_arc_deg_1", "unbalance_1_moment"]
        np.testing.assert_array_equal(study.unbalance_1_moment, [0.01, 0.02, 0.01, 0.02])
        assert study.done.all()
        assert list(study.bearings) == ["left", "right"]
        left, right = study.bearings.values()
        # a longer pad lifts the journal, and the other bearing is as it was
        height = [own.equilibrium_journal_y for own in (left, right)]
        assert (height[0][2:] > height[0][:2] + 1e-7).all()
        np.testing.assert_allclose(height[1][2:], height[1][:2], rtol=1e-5)
        if task in ("march", "periodic"):
            size = study.station_y_size
            assert size.shape == (4, 13)
            assert (size[1::2] > size[::2]).all()
            np.testing.assert_allclose(left.orbit_y, size[:, 1], rtol=1e-12)
        if task == "coefficients":
            whirl = study.response_amplitude
            np.testing.assert_allclose(whirl[1::2], 2 * whirl[::2], rtol=1e-9)


def test_a_table_varies_groups_with_names(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text(MACHINE)
    (tmp_path / "runs.csv").write_text(
        "pads:left%arc_deg(1),disc(1)%mass,bearing:right%preload\n60,2500,0.2\n65,2600,0.3\n"
    )
    tiltpad(
        "case.nml",
        overrides=["case%task=equilibrium", 'sweep%file="runs.csv"'],
        cwd=tmp_path,
        status=0,
    )
    with package.read_study(tmp_path / "case.h5") as study:
        assert study.parameters == ["pads_left_arc_deg_1", "disc_1_mass", "bearing_right_preload"]
        total = study.equilibrium_bearing_load_y.sum(axis=1)
        assert total[0] - total[1] == pytest.approx(9.81 * 100, rel=1e-6)
        study.to_csv(tmp_path / "rows.csv")
        with open(tmp_path / "rows.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        column = "right/equilibrium_journal_y"
        own = study.bearings["right"].equilibrium_journal_y
        assert [float(row[column]) for row in rows] == own.tolist()


def test_a_row_is_the_result_of_its_run(tiltpad, performed):
    path = performed(MACHINE, "case%task=coefficients", "sweep%operation%speed_rpm=1000:4000:1500")
    tiltpad(
        "case.nml",
        *("--run", 2),
        overrides=["case%task=coefficients", "sweep%operation%speed_rpm=1000:4000:1500"],
        cwd=path.parent,
        status=0,
    )
    with package.read_study(path) as study, h5py.File(path.parent / "case/0002.h5") as run:
        for name in ("stiffness", "damping", "full_stiffness"):
            own = run[f"bearings/right/coefficients/{name}"][()]
            np.testing.assert_array_equal(study.bearings["right"][name][1], own)
        np.testing.assert_array_equal(study.response_y_real[1], run["response/y_real"][()])
        count = run["modes/frequency"].shape[1]
        np.testing.assert_array_equal(study.frequency[1, :, :count], run["modes/frequency"][()])


def test_blocks_and_one_process_give_the_same_rows(performed, tiltpad):
    overrides = ["case%task=coefficients", "sweep%operation%speed_rpm=1000:8000:1000"]
    whole = performed(MACHINE, *overrides)
    blocks = performed(MACHINE, *overrides, arguments=["--block", "2/2"])
    tiltpad("case.nml", "--block", "1/2", overrides=overrides, cwd=blocks.parent, status=0)
    expect_same(numbers(blocks), numbers(whole))


def test_a_stopped_study_goes_on_and_loses_nothing(start, performed, tiltpad, tmp_path):
    overrides = ["case%task=march", "output%keep=summary", "sweep%operation%speed_rpm=3000:6000:250"]
    (tmp_path / "case.nml").write_text(MACHINE)
    process = start(tmp_path, "case.nml", "--jobs", "1", overrides=overrides)
    wait_for(lambda: any(tmp_path.glob("case.h5*")), process)
    process.send_signal(signal.SIGTERM)
    assert process.wait() in (0, 4)
    tiltpad("case.nml", overrides=overrides, cwd=tmp_path, status=0)
    expect_same(numbers(tmp_path / "case.h5"), numbers(performed(MACHINE, *overrides)))


def closed_form(study, direction):
    """Whirl of the disc of the light shaft, (run,): its spring and two bearings in a row under the disc."""
    turning = study.speed
    bearing = study.bearings["left"]
    dynamic = bearing.stiffness[:, 0, 0] + 1j * turning[:, None, None] * bearing.damping[:, 0, 0]
    area, inertia = np.pi * DIAMETER**2 / 4, np.pi * DIAMETER**4 / 64
    cowper = 6 * (1 + POISSON) / (7 + 6 * POISSON)
    shear = YOUNG / (2 * (1 + POISSON))
    length = 2 * HALF_SPAN
    flexibility = length**3 / (48 * YOUNG * inertia) + length / (4 * cowper * shear * area)
    both = np.linalg.inv(np.linalg.inv(2 * dynamic) + flexibility * np.eye(2))
    whole = both - (turning**2 * DISC)[:, None, None] * np.eye(2)
    force = UNBALANCE * turning[:, None, None] ** 2 * np.array([[1], [-1j]])
    return np.linalg.solve(whole, force)[:, "yz".index(direction), 0]


@pytest.fixture(scope="module")
def jeffcott(performed):
    with package.read_study(
        performed(JEFFCOTT, "case%task=coefficients", "sweep%operation%speed_rpm=400:4400:20")
    ) as study:
        yield study


def test_the_response_of_a_light_shaft_is_that_of_a_disc_on_its_springs(jeffcott):
    for direction in "yz":
        found = jeffcott[f"response_{direction}_real"] + 1j * jeffcott[f"response_{direction}_imag"]
        exact = closed_form(jeffcott, direction)
        # what the mass of the shaft, as much more mass of the disc, would add to its motion at most
        more = DENSITY * np.pi / 4 * DIAMETER**2 * 2 * HALF_SPAN
        assert (abs(found[:, 0, 1] - exact) <= more / UNBALANCE * abs(exact) ** 2).all()


def test_critical_speeds_converge_with_the_step_of_the_speed(performed, jeffcott):
    """The error of amplification factors falls with the square of the step at least."""
    errors = []
    for step in (100, 50):
        path = performed(JEFFCOTT, "case%task=coefficients", f"sweep%operation%speed_rpm=400:4400:{step}")
        with package.read_study(path) as study:
            pairs = [
                [peak_at(each, axis).amplification_factor for each in (study, jeffcott)] for axis in "yz"
            ]
        errors.append(max(abs(found / exact - 1) for found, exact in pairs))
    assert errors[1] < errors[0] / 3
    # four and eight speeds in the width of the peak
    assert errors[0] < 1e-2
    assert errors[1] < 2.5e-3


def test_the_critical_speed_is_where_a_mode_vibrates_with_the_shaft(jeffcott):
    """Of constant stiffness and damping it is (1 - 2 zeta^2)^(-1/2) of the natural frequency, the mode
    (1 - zeta^2)^(1/2): 3/2 zeta^2 are between them."""
    modes, peak = package.modes(jeffcott), peak_at(jeffcott, "y")
    apart = 60 * modes.frequency - modes.speed_rpm[:, None]
    run, mode = np.nonzero((apart[:-1] > 0) & (apart[1:] <= 0) & (modes.damping_ratio[1:] < 0.2))
    assert len(run) == 2
    share = apart[run, mode] / (apart[run, mode] - apart[run + 1, mode])
    speed = modes.speed_rpm[run] + share * np.diff(modes.speed_rpm)[run]
    square = modes.damping_ratio[run, mode] ** 2
    between = peak.speed_rpm / speed - 1
    assert ((square < between) & (between < 2 * square)).all()
    # 1/(2 zeta) is the factor of a lightly damped rotor
    assert peak.amplification_factor == pytest.approx(0.5 / np.sqrt(square.mean()), rel=0.1)


def test_margins_are_those_to_the_operating_speeds(jeffcott):
    peak = peak_at(jeffcott, "y")
    below, above, among = (
        next(each for each in package.critical_speeds(jeffcott, operating=speeds) if each.peak == peak)
        for speeds in ((3500, 4000), 2000, (2500, 3000))
    )
    assert below.margin == pytest.approx(100 * (3500 - peak.speed_rpm) / 3500)
    assert above.margin == pytest.approx(100 * (peak.speed_rpm - 2000) / 2000)
    assert among.margin == 0
    excess = 17 * (1 - 1 / (peak.amplification_factor - 1.5))
    assert (below.required, above.required) == pytest.approx((excess, excess + 10))
    assert np.isnan(package.critical_speeds(jeffcott)[0].margin)
    with pytest.raises(ValueError, match="must be a speed in rpm, or the lowest and the highest"):
        package.critical_speeds(jeffcott, operating=(3000, 2000))


def test_a_map_of_a_machine_has_its_bending_modes_at_all_speeds(speeds):
    """A second bending mode, between 150 and 400 Hz, at low speeds too, where the response needs none."""
    modes = package.modes(speeds)
    bending = (modes.damping_ratio < 0.2) & (modes.frequency > 150) & (modes.frequency < 400)
    assert bending.any(axis=1).all()


def peak_at(study, direction):
    (found,) = [
        each.peak
        for each in package.critical_speeds(study)
        if (each.station, each.peak.direction) == (2, direction)
    ]
    return found
