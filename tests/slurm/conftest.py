"""The cluster of the tests: one for all, in a folder that is removed with it."""

import signal
import tempfile
from pathlib import Path

import pytest
from cluster import CannotStartError, Cluster


@pytest.fixture(scope="session")
def cluster(program, root):
    """A Slurm of one node; the tests are skipped where none can be started."""
    # a test run that is told to end cleans up, too
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    path = f"{Path(program).resolve().parent}:{root}/build/venv/bin"
    with tempfile.TemporaryDirectory(prefix="tiltpad-slurm-") as folder:
        try:
            with Cluster(Path(folder), path, processors=4) as started:
                yield started
        except CannotStartError as reason:
            pytest.skip(f"no Slurm can be started here: {reason}")


@pytest.fixture
def folder(cluster, request):
    """The directory of submission of one test."""
    made = cluster.folder / request.node.name
    made.mkdir()
    return made


@pytest.fixture(scope="session")
def scripts(root):
    """The folder of the job scripts."""
    return root / "input/slurm"
