"""Warm oil at the corners of its range: an equilibrium, or a refusal whose cause is shown."""

import pytest

#: The paper's pads; 100 to 15000 rpm, 0.1 to 3 times the paper's load, VG 10 to 220, supply of 20 to 80 C.
CASE = """&case task='equilibrium' /
&oil grade=46, density_at_15=870, density_slope=-0.64 /
&thermal model='pad' /
&pads motion='tilting_only' /
&sweep
  operation%speed_rpm = 100, 1200, 15000
  rotor%mass = 200, 6000
  oil%grade = 10, 220
  oil%supply_temperature = 20, 80
/
"""
#: Runs whose asperities carry: heaviest load and slowest, or thin hot oil.
BOILING = (5, 6, 7, 8, 14)


@pytest.fixture
def failures(tiltpad, tmp_path):
    """failures(overrides): the ends of the runs that failed, by their number."""
    (tmp_path / "case.nml").write_text(CASE)

    def run(*overrides):
        words = ("case.nml", "--quiet", "--overwrite", "--output", "range")
        done = tiltpad(*words, overrides=overrides, cwd=tmp_path)
        lines = [line for line in done.stderr.splitlines() if "error: run" in line]
        assert done.returncode == (2 if lines else 0)
        return {int(line.split("error: run ")[1].split()[0]): line for line in lines}

    return run


def test_corners_of_the_range(failures):
    """Most have an equilibrium; in the others the friction of asperities boils the oil."""
    refused = failures()
    assert tuple(sorted(refused)) == BOILING
    assert all("above 300 C, where mineral oil boils" in line for line in refused.values())
    assert failures("asperity%friction_coefficient=0") == {}
