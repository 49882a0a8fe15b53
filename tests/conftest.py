"""What all Python tests share: the program under test, and the closing line of every test program."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("TILTPAD", str(ROOT / "build/bin/tiltpad"))


@pytest.fixture(scope="session")
def tiltpad():
    """Runs the program: tiltpad(*arguments, cwd=...) gives a CompletedProcess with text output.

    `overrides` are set by --set. With `status` it must end so, and say one line of error where that is not
    0, and none where it is.
    """

    def run(*arguments, cwd=None, timeout=300, overrides=(), status=None, **options):
        command = [PROGRAM, *map(str, arguments), *(word for each in overrides for word in ("--set", each))]
        done = subprocess.run(command, cwd=cwd, timeout=timeout, text=True, capture_output=True, **options)
        if status is not None:
            assert done.returncode == status, done.stderr
            assert done.stderr.count("\n") == (status != 0), done.stderr
            assert status == 0 or done.stderr.startswith("tiltpad: error: ")
        return done

    return run


@pytest.fixture(scope="session")
def program():
    """Path of the program under test."""
    return PROGRAM


@pytest.fixture(scope="session")
def root():
    """The project's folder."""
    return ROOT


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config):
    """Prints "N passed, N failed" behind everything pytest itself prints."""
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    if reporter is None:
        return
    count = {key: len(reporter.stats.get(key, [])) for key in ("passed", "failed", "error")}
    print(f"{count['passed']} passed, {count['failed'] + count['error']} failed")
