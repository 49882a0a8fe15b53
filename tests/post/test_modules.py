"""The modules of the package that stand beside its functions."""

import pytest
import tiltpad


def test_modules_by_their_public_names():
    """As docs/api.md has them; most load matplotlib, and only when they are used."""
    for name, floor_of_it in tiltpad.MODULES.items():
        assert getattr(tiltpad, name).__name__ == f"tiltpad.{floor_of_it}.{name}"
    with pytest.raises(AttributeError, match="no attribute 'plot'"):
        tiltpad.plot  # noqa: B018
