"""What the tests of whole runs share."""

import pytest


def options(overrides):
    """The words of a command line that set these variables."""
    return [word for each in overrides for word in ("--set", each)]


@pytest.fixture
def run(tiltpad, tmp_path):
    """run(case, overrides, status): the outcome of a case in tmp_path/case.nml."""

    def make(case, *overrides, status=0, name="case", more=()):
        (tmp_path / f"{name}.nml").write_text(case)
        done = tiltpad(f"{name}.nml", *more, *options(overrides), cwd=tmp_path)
        assert done.returncode == status, done.stderr
        return done

    return make
