"""What all Python tests share: the program under test, and the closing line of every test program."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("TILTPAD", str(ROOT / "build/bin/tiltpad"))


@pytest.fixture(scope="session")
def tiltpad():
    """Runs the program: tiltpad(*arguments, cwd=...) gives a CompletedProcess with text output."""

    def run(*arguments, cwd=None, timeout=300, **options):
        command = [PROGRAM, *map(str, arguments)]
        return subprocess.run(command, cwd=cwd, timeout=timeout, text=True, capture_output=True, **options)

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
