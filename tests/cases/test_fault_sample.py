"""A sample of the injected faults (make faults): other faults than those of the page."""

import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "faults"))
from faulty_commands import COMMANDS  # noqa: E402
from inject import campaign  # noqa: E402

#: Faults of a command of the program, and of Python's, which take longer.
FAULTS, PYTHON_FAULTS, SEED = 16, 2, 2
SAMPLE = [each for each in COMMANDS if each.name != "collect, with workers"]


@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc")), reason="no C compiler")
@pytest.mark.parametrize("command", SAMPLE, ids=[each.name.replace(", ", " ") for each in SAMPLE])
def test_faults(program, command):
    """Told or without effect; what was there stays, and the next command comes to the undisturbed result."""
    faults = FAULTS if command.words[0] == "tiltpad" else PYTHON_FAULTS
    outcomes = list(campaign(Path(program), [command], faults, SEED))
    assert not [(each.name, each.wrong) for each in outcomes if each.wrong]
    assert sum(each.reached for each in outcomes) > 0.7 * len(outcomes)
