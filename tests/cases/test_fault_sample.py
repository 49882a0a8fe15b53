"""A sample of the injected faults (make faults): every task, other faults than those of the page."""

import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "faults"))
from faulty_commands import COMMANDS  # noqa: E402
from inject import campaign  # noqa: E402

#: Faults of a command: two minutes on two cores, in all.
FAULTS, SEED = 48, 2
TASKS = [each for each in COMMANDS if each.words[0] == "tiltpad"]


@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc")), reason="no C compiler")
@pytest.mark.parametrize("command", TASKS, ids=[each.name.replace(", ", " ") for each in TASKS])
def test_faults(program, command):
    """Told or without effect; what was there stays, and the next command comes to the undisturbed result."""
    outcomes = list(campaign(Path(program), [command], FAULTS, SEED))
    assert not [(each.name, each.wrong) for each in outcomes if each.wrong]
    assert sum(each.reached for each in outcomes) > 0.7 * len(outcomes)
