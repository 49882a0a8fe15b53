"""Large files: how much of them is read, and how much at once, in bytes."""

import h5py
import matplotlib.pyplot as plt
import pytest
import tiltpad
from tiltpad import figures
from tiltpad.calculate import signals

SECONDS, INTERVAL = 5, 5e-5


@pytest.fixture
def reads(monkeypatch):
    """Bytes of each read from a file."""
    sizes = []
    original = h5py.Dataset.__getitem__

    def counted(self, key):
        found = original(self, key)
        sizes.append(getattr(found, "nbytes", 0))
        return found

    monkeypatch.setattr(h5py.Dataset, "__getitem__", counted)
    return sizes


@pytest.fixture
def large(made):
    """A made run, some 20 MB; nothing in it moves but the shaft and the journal."""

    def run(case_name):
        return made(case_name, SECONDS, INTERVAL, journal_y=lambda time, angle: 1e-6 * time, pivot_load=1e3)

    return run


def size(run):
    return sum(each.size * 8 for each in run.file.values() if isinstance(each, h5py.Dataset))


def test_the_end_is_found_without_loading_the_way_there(large, reads):
    run = large("lugre")
    reads.clear()
    part = tiltpad.last_revolutions(run, 2)
    assert len(reads) < 30
    assert sum(reads) < 300
    assert part.stop - part.start == pytest.approx(2 * 60 / 6500 / INTERVAL, abs=2)


@pytest.mark.parametrize(
    "plot", ["orbit", "size", "poincare", "waveform", "hysteresis", "friction", "sticking"]
)
def test_the_last_revolutions_need_a_small_part_of_the_file(large, reads, plot):
    run = large("lugre")
    reads.clear()
    figures.FIGURES[plot]([run])
    plt.close("all")
    assert 0 < sum(reads) < (0.15 if plot == "poincare" else 0.02) * size(run)


@pytest.mark.parametrize(
    ("plot", "share"), [("runup", 0.003), ("size", 0.003), ("orders", 0.003), ("waterfall", 0.004)]
)
def test_the_whole_run_is_read_in_pieces(large, reads, plot, share, monkeypatch):
    monkeypatch.setattr(signals, "BLOCK", 4096)
    run = large("runup")
    reads.clear()
    figures.FIGURES[plot]([run])
    plt.close("all")
    # at most the longest window of an order track, or of a spectrum, in which the shaft turns slowly
    assert 0 < max(reads) < share * size(run)


def test_spectra_of_the_end(large, reads):
    run = large("lugre")
    reads.clear()
    tiltpad.one_sided(run, "journal_y", 3)
    tiltpad.full(run, 3)
    tiltpad.friction_power(run, 1, 3)
    tiltpad.stick_intervals(run, 1, 3)
    assert 0 < sum(reads) < 0.01 * size(run)
