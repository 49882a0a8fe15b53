"""The API reference is that of this package."""

import inspect
import subprocess
import sys

import tiltpad
from tiltpad import figures, plots


def test_the_reference_is_up_to_date(root):
    done = subprocess.run([sys.executable, root / "docs/api.py"], capture_output=True, text=True, check=True)
    assert (root / "docs/api.md").read_text() == done.stdout, "docs/api.md is old: call make docs"


def test_everything_public_is_in_it_and_documented(root):
    text = (root / "docs/api.md").read_text()
    for name in tiltpad.__all__:
        assert f"### `tiltpad.{name}`" in text
        assert len(inspect.getdoc(getattr(tiltpad, name))) > 20, name
    assert all(f"tiltpad.figures.{name}(" in text for name in figures.FIGURES)
    assert inspect.getdoc(plots.orbit) in text


def test_every_picture_is_a_plot_of_the_command(root):
    from tiltpad import command, report

    alone = {command.STUDY, command.BEARING, command.MOVIE}
    assert set(command.PLOTS) - alone == set(figures.FIGURES) == set(report.PICTURES)
