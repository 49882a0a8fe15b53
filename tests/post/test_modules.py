"""The modules of the package that stand beside its functions."""

import subprocess
import sys

import pytest
import tiltpad


def test_modules_by_their_public_names():
    """As docs/api.md has them; most load matplotlib, and only when they are used."""
    for name, floor_of_it in tiltpad.MODULES.items():
        assert getattr(tiltpad, name).__name__ == f"tiltpad.{floor_of_it}.{name}"
    with pytest.raises(AttributeError, match="no attribute 'plot'"):
        tiltpad.plot  # noqa: B018


def test_the_package_loads_no_more_than_it_needs():
    """Neither pictures nor what tells versions, which take longer than the rest."""
    code = "import sys, tiltpad; print(*sys.modules); print(tiltpad.__version__)"
    loaded, own = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    assert not {"matplotlib", "importlib.metadata"} & set(loaded.split())
    assert own == tiltpad.__version__
