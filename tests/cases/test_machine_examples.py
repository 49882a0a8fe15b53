"""Machines of the pages: the one of docs/inputs.md and what is refused of it."""

import re

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
