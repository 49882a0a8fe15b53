"""A sample of the injected faults (make faults): other faults than those of the page,
one of each kind of call."""

import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "faults"))
from faulty_commands import CASES, COLLECT, COMMANDS  # noqa: E402
from inject import campaign  # noqa: E402
from injector import KINDS  # noqa: E402

#: Faults of a command of the program; of those in Python, which take longer and write in one way, fewer.
FAULTS, OF_COLLECT, OF_PICTURES, SEED = len(KINDS), 2, 1, 2
#: Studies with fewer runs than those of the page.
FEWER = {"study": ("5000,6000,7000", "5000"), "rows": ("7000:10", "7000:100")}
SAMPLE = [each for each in COMMANDS if each.name != "collect, with workers"]


@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc")), reason="no C compiler")
@pytest.mark.parametrize("command", SAMPLE, ids=[each.name.replace(", ", " ") for each in SAMPLE])
def test_faults(program, command, monkeypatch):
    """Told or without effect; what was there stays, and the next command comes to the undisturbed result."""
    for name, change in FEWER.items():
        monkeypatch.setitem(CASES, name, CASES[name].replace(*change))
    faults = {"tiltpad": FAULTS, COLLECT: OF_COLLECT}.get(command.words[0], OF_PICTURES)
    outcomes = list(campaign(Path(program), [command], faults, SEED))
    assert not [(each.name, each.wrong) for each in outcomes if each.wrong]
    assert sum(each.reached for each in outcomes) > 0.7 * len(outcomes)
