"""Machines of the pages: the one of docs/inputs.md, what is refused of it, and its files by docs/results.md."""

import re

import h5py
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
    for task, overrides in TASKS.items():
        path = fan.parent / f"{task}.h5"
        tiltpad(fan, "--quiet", "--output", path, overrides=[f"case%task={task}", *overrides], status=0)
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
