"""Machines of the pages: that of docs/inputs.md, what is refused of it, and its files by docs/results.md;
those of docs/examples.md, their figures and what the page claims."""

import importlib.util
import re
import subprocess

import h5py
import numpy as np
import pytest

SAMPLE = re.compile(r"^    (&case +title = 'Overhung fan'.*?)\n\n", re.MULTILINE | re.DOTALL)
REFUSED = re.compile(r"^\| `(\S+=\S+)` \| `(.*)` \|$", re.MULTILINE)


@pytest.fixture(scope="module")
def inputs_page(root):
    return (root / "docs/inputs_head.md").read_text()


@pytest.fixture(scope="module")
def fan(inputs_page, tmp_path_factory):
    """The machine of the input reference."""
    path = tmp_path_factory.mktemp("fan") / "fan.nml"
    path.write_text(SAMPLE.search(inputs_page)[1].replace("\n    ", "\n") + "\n")
    return path


def test_the_machine_of_the_input_reference_is_one(tiltpad, fan):
    said = tiltpad("--check", fan, status=0).stdout
    assert said.count("\n&bearing\n") == said.count("\n&pads\n") == 2
    assert said.count("\n&support\n") == 1
    derived = said[said.index("! derived values") :]
    assert "! bearing 'motor_end'" in derived
    assert derived.count("!   preload            0.3 ") == 2
    assert "specific load" not in derived  # it follows from the equilibrium


def test_what_is_refused_of_a_machine_is_told_as_the_page_says(tiltpad, fan, inputs_page):
    rows = REFUSED.findall(inputs_page)
    assert len(rows) > 10
    for assignment, message in rows:
        assert tiltpad("--check", fan, overrides=[assignment], status=1).stderr.endswith(f": {message}\n")


def test_the_size_of_a_result_counts_stations_and_bearings(tiltpad, fan):
    def told(*overrides):
        said = tiltpad("--check", fan, overrides=["case%task=march", *overrides], status=0).stdout
        megabytes, samples = re.search(r"result +(\S+)  MB, (\d+) samples", said).groups()
        return 1e6 * float(megabytes) / int(samples)

    # time, angle, speed; y and z of 8 stations; two journals and 11 values of each of five pads
    values = 3 + 2 * 8 + 2 * (4 + 5 * 11)
    assert told() == pytest.approx(8 * values, rel=0.02)
    assert told("pads:fan_end%motion=fixed") == pytest.approx(8 * (values - 5 * 6), rel=0.02)


def documented(page):
    """Datasets of the table of machines with their dimensions and unit."""
    table = {}
    section = page[page.index("## Machines\n") : page.index("## Size\n")]
    for cells in re.findall(r"^\| (?:of each bearing: )?(`.*) \| (.*) \| (.*) \|$", section, re.MULTILINE):
        names, group = [], ""
        for name in re.findall(r"`([^`]+)`", re.sub(r"\([^()]*\)", "", cells[0])):
            if name.endswith("/"):
                group = name
            else:
                names.append(group + name)
        dimensions = [] if cells[1] == "-" else cells[1].split(", ")
        units = cells[2].split(", ")
        for name, unit in zip(names, units * len(names) if len(units) == 1 else units, strict=True):
            table[name] = dimensions, unit
    return table


def found(path):
    """Datasets of a machine's file that are no bearing's, and the misalignment of one bearing."""
    with h5py.File(path) as file:
        datasets = {}

        def visit(name, item):
            if isinstance(item, h5py.Dataset) and not name.startswith("bearings/"):
                scales = [axis[0].name[1:] for axis in item.dims if len(axis)]
                datasets[name] = scales, item.attrs["units"]

        file.visititems(visit)
        item = file["bearings/fan_end/summary/misalignment"]
        datasets["summary/misalignment"] = [], item.attrs["units"]
    return datasets


TASKS = {
    "march": ["operation%duration=0.1"],
    "periodic": [],
    "coefficients": ["coefficients%threshold_up_to_rpm=5000"],
    "branch": ["branch%parameter=unbalance(1)%moment", "branch%last=1.5e-3", "branch%step=1e-4"],
}


def test_the_page_of_results_lists_what_a_machine_has_more(tiltpad, fan, root):
    page = (root / "docs/results.md").read_text()
    table, seen = documented(page), set()
    known = set(re.findall(r"(\w+)`", page))
    seal = fan.parent / "seal.nml"
    seal.write_text(
        fan.read_text()
        + "&element station=5, cross_stiffness=1e5, static=.false. /\n"
        + "&damper bearing='fan_end', radius=0.07, length=0.02, clearance=0.1e-3, viscosity=0.01 /\n"
        + "&impeller station=8, power=2e5, diameter=0.5, width=0.03, suction_density=1, "
        + "discharge_density=1.2 /\n"
    )
    for task, overrides in TASKS.items():
        path = fan.parent / f"{task}.h5"
        tiltpad(
            fan if task == "branch" else seal,
            "--quiet",
            "--output",
            path,
            overrides=[f"case%task={task}", *overrides],
            status=0,
        )
        for name, (dimensions, unit) in found(path).items():
            seen.add(name)
            if name in table:
                assert (dimensions, unit) == table[name], (task, name)
            else:
                assert name.split("/")[-1] in known, (task, name)
    assert seen >= set(table)


def test_verify_refuses_a_machine(tiltpad, fan):
    said = tiltpad(fan, "--verify", 3, status=1).stderr
    assert "--verify: compares the films of one bearing with a rigid journal, not those of a machine" in said


@pytest.fixture(scope="module")
def page_of_examples(root):
    """docs/examples.py."""
    spec = importlib.util.spec_from_file_location("examples", root / "docs/examples.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def examples(tiltpad, root, page_of_examples, tmp_path_factory):
    """The folder in which the program's commands of the page about machines were run."""
    folder = tmp_path_factory.mktemp("examples")
    (folder / "input").symlink_to(root / "input")
    page = (root / "docs/examples.md").read_text()
    for line in page_of_examples.commands(page[page.index("## A turbine that") :]):
        program, *words = line.split()
        if program == "tiltpad":
            tiltpad(*words, "--quiet", cwd=folder, status=0)
        elif program == "sed":
            subprocess.run(["sh", "-c", line], cwd=folder, check=True)
    return folder


def test_the_page_of_examples_has_the_figures_of_its_machines(root, page_of_examples, examples):
    page = (root / "docs/examples.md").read_text()
    assert [words for words in page_of_examples.machines(examples) if words not in page] == []


def test_stuck_pivots_lose_their_damping_at_the_threshold_speed_that_is_told(tiltpad, root, examples):
    with h5py.File(examples / "turbine_modes.h5") as run:
        assert list(run["pivot"].asstr()) == ["free", "stuck", "locked"]
        threshold = run["modes/threshold_rpm"][1]
    for speed, sign in ((threshold - 20, -1), (threshold + 20, 1)):
        at = examples / f"modes{sign}.h5"
        overrides = ["case%task=coefficients", f"operation%speed_rpm={speed}"]
        tiltpad(root / "input/examples/turbine.nml", "--quiet", "--output", at, overrides=overrides, status=0)
        with h5py.File(at) as run:
            growth = np.nanmax(run["modes/eigenvalue_real"][:], axis=1)
        assert np.sign(growth[1]) == sign
        assert growth[0] < 0


def test_orbits_of_vanishing_unbalance_lose_their_stability_where_stuck_pivots_do(tiltpad, root, examples):
    with h5py.File(examples / "turbine_modes.h5") as run:
        threshold = run["modes/threshold_rpm"][1]
    speeds = []
    for moment in (2e-3, 1e-3, 5e-4):
        path = examples / "turbine_branch.h5"
        if moment < 2e-3:
            path = examples / f"branch{moment}.h5"
            overrides = {"case%task": "branch", "branch%parameter": "operation%speed_rpm", "branch%step": 100}
            overrides |= {"operation%speed_rpm": 7250, "branch%last": 7350, "unbalance(1)%moment": moment}
            tiltpad(
                root / "input/examples/turbine.nml", "--quiet", "--output", path,
                overrides=[f"{name}={value}" for name, value in overrides.items()], status=0,
            )  # fmt: skip
        with h5py.File(path) as run:
            assert run["bifurcations/kind"].asstr()[0] == "neimark_sacker"
            speeds.append(run["bifurcations/parameter"][0])
    # linear in the unbalance, up to what the two extrapolations to none differ by
    coarse, fine = 2 * speeds[1] - speeds[0], 2 * speeds[2] - speeds[1]
    assert abs(fine - threshold) < abs(fine - coarse) < 0.1 * (speeds[0] - threshold)


def test_below_the_threshold_a_march_comes_to_the_orbit_and_above_to_a_limit_cycle(examples):
    middle, last = 6, 50 * 60
    with h5py.File(examples / "turbine_branch.h5") as run:
        size = run["station_y_max"][0, middle] - run["station_y_min"][0, middle]
        unstable = run["station_y_max"][-1, middle] - run["station_y_min"][-1, middle]
        assert run["stable"][0] == 1
        assert run["stable"][-1] == 0
    with h5py.File(examples / "turbine_below.h5") as run:
        assert run["bearings/front/summary/whirls"][()] == 0
        assert run["summary/station_y_size"][middle] == pytest.approx(size, rel=2e-3)
    with h5py.File(examples / "turbine_above.h5") as run:
        y = run["station_y"][-2 * last :, middle]
        assert run["bearings/front/summary/whirls"][()] == 1
        assert np.ptp(y[:last]) == pytest.approx(np.ptp(y[last:]), rel=0.01)
        assert np.ptp(y) > 10 * unstable


def complex_of(group, name):
    """Of free pivots."""
    return group[f"{name}_real"][0] + 1j * group[f"{name}_imag"][0]


def test_modes_left_out_cost_what_is_said(tiltpad, root, tmp_path):
    """Response and modes of three bearings beside those with all modes of the shaft.

    Bare shaft between discs errs by more than journals and discs, and modes by more, the closer they come to
    those that are left out.
    """
    found = {}
    for name, more in (("usual", ()), ("all", ("reduction%frequency=1e5",))):
        overrides = ("case%task=coefficients", *more)
        case = root / "input/examples/three_bearings.nml"
        tiltpad(case, "-q", "-o", f"{name}.h5", cwd=tmp_path, overrides=overrides, status=0)
        with h5py.File(tmp_path / f"{name}.h5") as file:
            response = [complex_of(file["response"], axis) for axis in "yz"]
            modes = complex_of(file["modes"], "eigenvalue")
            estimates = file["rotor/truncation_error"][()], file["rotor/station_error"][()]
        found[name] = np.array(response), modes[np.isfinite(modes)], estimates
    (usual, modes, (at_discs, anywhere)), (exact, every, _) = found.values()
    errors = np.abs(usual - exact).max(axis=0) / np.abs(exact).max()
    discs = np.array([2, 4, 6, 9, 11]) - 1
    assert at_discs < errors[discs].max() < 4 * at_discs
    assert anywhere < errors.max() < 4 * anywhere
    rates = [(abs(mode), np.abs(every - mode).min() / abs(mode)) for mode in modes]
    assert max(error for size, error in rates if size < 2 * np.pi * 500) < 1e-3
    assert max(error for size, error in rates if size < 2 * np.pi * 600) < 1e-2
    slow = ("case%task=coefficients", "operation%speed_rpm=1000")
    said = tiltpad(case, "-o", "slow.h5", cwd=tmp_path, overrides=slow, status=0).stdout
    rough = re.findall(r"(\d+)\.\d+ Hz,.*; rough, as modes from 772\.4 Hz on are left out", said)
    assert rough == ["1198", "1224", "1209"]


def test_two_bearings_share_the_weight_by_the_levers(examples):
    with h5py.File(examples / "overhung.h5") as run:
        rotor, loads = run["rotor"], -run["equilibrium/bearing_load_y"][:]
        place = rotor["station_position"][:]
        length, diameter = rotor["section_length"][:], rotor["section_diameter"][:]
        masses = np.concatenate([7850 * np.pi / 4 * diameter**2 * length, rotor["disc_mass"][:]])
        at = np.concatenate([place[:-1] + length / 2, place[rotor["disc_station"][:].astype(int) - 1]])
        first, second = place[rotor["bearing_station"][:].astype(int) - 1]
        assert loads.sum() == pytest.approx(9.81 * masses.sum(), rel=1e-6)
        assert loads[1] == pytest.approx(9.81 * masses @ (at - first) / (second - first), rel=1e-6)


def test_the_branch_of_orbits_is_the_linear_response_where_the_unbalance_is_small(examples):
    with h5py.File(examples / "overhung_linear.h5") as run:
        linear = np.hypot(run["response/y_real"][0], run["response/y_imag"][0])
    with h5py.File(examples / "overhung_response.h5") as run:
        amplitude = [np.interp(7250, run["parameter"][:], each) for each in run["station_y_amplitude"][:].T]
    assert amplitude[7] == pytest.approx(linear[7], rel=0.01)
    assert amplitude[6] == pytest.approx(linear[6], rel=0.01)


def test_a_raised_bearing_takes_load_from_its_neighbours(examples):
    with h5py.File(examples / "level.h5") as level, h5py.File(examples / "raised.h5") as raised:
        change = level["equilibrium/bearing_load_y"][:] - raised["equilibrium/bearing_load_y"][:]
        place = level["rotor/station_position"][:][level["rotor/bearing_station"][:].astype(int) - 1]
        weight = 9.81 * level["rotor/total_mass"][()]
    assert change[1] > 0
    assert change[0] < 0
    assert change[2] < 0
    # neither force nor moment of all bearings changes
    assert abs(change.sum()) < 1e-6 * weight
    assert abs(change @ (place - place[0])) < 1e-6 * weight * (place[-1] - place[0])
