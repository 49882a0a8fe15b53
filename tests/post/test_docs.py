"""The API reference is that of this package."""

import inspect
import json
import re
import subprocess
import sys

import numpy as np
import pytest
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
    from tiltpad import command
    from tiltpad.draw import page

    alone = {command.STUDY, command.BEARING, command.MACHINE, command.MOVIE}
    assert set(command.PLOTS) - alone == set(figures.FIGURES) == set(page.PICTURES)


def test_the_worked_examples(root, program, tmp_path):
    """Their cases are good, their plots and pictures are there; `make docs` runs them."""
    from tiltpad import command

    page = (root / "docs/examples.md").read_text()
    lines = [line for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL) for line in block.splitlines()]
    assert len(lines) > 10
    (tmp_path / "input").symlink_to(root / "input")
    for line in lines:
        name, *words = line.split()
        if name == "sed":
            subprocess.run(["sh", "-c", line], cwd=tmp_path, check=True)
        if name == "tiltpad":
            checked = [
                word
                for word in words
                if "/" in word or "%" in word or word == "--set" or word.endswith(".nml")
            ]
            words = [program, "--check", *checked]
            done = subprocess.run(words, cwd=tmp_path, text=True, capture_output=True)
            assert (done.returncode, done.stderr) == (0, ""), line
        elif name == "tiltpad-plot":
            options = command.plot_parser().parse_args(words)
            assert options.output.endswith(".csv") or f"](images/{options.output})" in page
    for picture in re.findall(r"\]\((images/[\w.]+)\)", page):
        assert (root / "docs" / picture).exists()


def python_of(root, heading):
    """The blocks of Python of a section of the worked examples."""
    section = (root / "docs/examples.md").read_text().partition(f"## {heading}")[2].partition("\n## ")[0]
    return re.findall(r"```python\n(.*?)```", section, re.DOTALL)


def test_the_worked_example_of_a_fit(root, program, tmp_path, monkeypatch, capsys):
    """Its first fit has the figures of the page, and finds what was hidden; `make docs` runs the second."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TILTPAD", str(program))
    (tmp_path / "input").symlink_to(root / "input")
    names: dict = {}
    for block in python_of(root, "Which friction coefficient")[:2]:
        exec(block, names)
    fit = names["fit"]
    error = fit.values - [0.12, 4e5, 82e-6]
    # chi-squared of 3, 99.9 %
    assert error @ np.linalg.inv(fit.covariance) @ error < 16.3
    assert fit.in_words(0) in (root / "docs/examples.md").read_text()
    assert capsys.readouterr().out.startswith("<tiltpad fit: 240 values")
    assert (tmp_path / "example_fit.png").exists()
    plots.plt.close("all")


def test_the_worked_example_of_tolerances(root, program, tmp_path, monkeypatch, capsys):
    """A small one: its Python draws the table, the program runs it, and it answers which input matters."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TILTPAD", str(program))
    (tmp_path / "input").symlink_to(root / "input")
    draws, asks = python_of(root, "Tolerances")
    assert ", 256, " in draws
    exec(draws, {})
    whole = (tmp_path / "tolerances.csv").read_text()
    kept = (root / "input/examples/tolerances.csv").read_text()
    assert whole.splitlines()[0] == kept.splitlines()[0]
    drawn, stored = (np.loadtxt(text.splitlines(), delimiter=",", skiprows=1) for text in (whole, kept))
    np.testing.assert_allclose(drawn, stored, rtol=1e-12)  # the logarithms of NumPy depend on the processor
    (tmp_path / "tolerances.csv").write_text("".join(whole.splitlines(keepends=True)[:33]))
    with tiltpad.run("input/examples/tolerances.nml", "runs", sweep={"file": "tolerances.csv"}) as study:
        assert study.done.all()
    (tmp_path / "tolerances.h5").symlink_to("runs.h5")
    exec(asks, {})
    assert capsys.readouterr().out.startswith("Share(runs=")
    with tiltpad.read_study("tolerances.h5") as study:
        found = tiltpad.sensitivity(study, "threshold_rpm", pivot="locked")
        assert {found.inputs[k] for k in np.argsort(found.first)[-2:]} == {"assembled_clearance", "preload"}
        assert figures.tornado(study, show="threshold_rpm", pivot="locked").axes
    plots.plt.close("all")


def test_the_notebook(root, program, tmp_path, monkeypatch, capsys):
    """Its cells run one after the other, and print what the texts beside them say."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TILTPAD", str(program))
    cells = json.loads((root / "docs/notebook.ipynb").read_text())["cells"]
    names: dict = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
            assert not cell["outputs"]
    assert names["rough"].input["friction"]["model"] == "lugre"
    small, large = (max(tiltpad.orbit_size(names[each])) for each in ("run", "rough"))
    assert large > 1.2 * small
    assert names["tables"]["kyy"].shape == (4,)
    assert len(capsys.readouterr().out.splitlines()) == 3
    plots.plt.close("all")


def test_the_index_of_terms_names_what_is_there(root):
    """Its input variables, plots, sections and datasets are those of the program."""
    from tiltpad import command

    page = (root / "docs/terms.md").read_text()
    inputs, results = ((root / f"docs/{name}.md").read_text() for name in ("inputs", "results"))
    for group, name in re.findall(r"`(\w+)%(\w+)", page):
        section = inputs.partition(f"\n## &{group}\n")[2].partition("\n## ")[0]
        assert f"| `{name}`" in section, f"{group}%{name}"
    names = re.findall(r"`(?:equilibrium|summary|modes|coefficients)/(\w+)`", page)
    assert len(names) > 5
    for name in names:
        assert name in results, name
    assert set(re.findall(r"tiltpad-plot (\w+)", page)) <= set(command.PLOTS)
    for target, anchor in re.findall(r"\]\(([\w/.]+)#([\w-]+)\)", page):
        titles = re.findall(r"^#+ (.*)$", (root / "docs" / target).read_text(), re.M)
        assert anchor in {re.sub(r"[^\w -]", "", each.lower()).replace(" ", "-") for each in titles}, anchor
    for term in ("LBP", "LOP", "API 617", "log dec", "half-frequency whirl", "Gumbel", "DyRoBeS", "XLTRC2"):
        assert term in page


def test_where_someya_s_tables_are_not_met(root, program, tmp_path, monkeypatch):
    """The page has the numbers of this program: near those of ROSS, and of the table of another L/D."""
    monkeypatch.syspath_prepend(root / "docs")
    from verify_coefficients import lightly_loaded

    rows = list(lightly_loaded(program, tmp_path))
    page = (root / "docs/verification.md").read_text()
    assert all(f"{row}\n" in page for row in rows)
    for row in rows:
        own, ross, table = (None if each == "-" else float(each) for each in row.strip("| ").split(" | ")[2:])
        if ross is not None:
            assert own == pytest.approx(ross, rel=0.03)
        elif "L/D 1.0" in row:
            assert own == pytest.approx(table, rel=0.09)
        else:
            assert own != pytest.approx(table, rel=0.25)


def test_the_version_is_the_same_everywhere(root):
    places = {"Makefile": r"^VERSION := (.*)$", "post/pyproject.toml": r'^version = "(.*)"$'}
    places["CITATION.cff"] = r"^version: (.*)$"
    found = {re.search(each, (root / name).read_text(), re.M)[1] for name, each in places.items()}
    assert len(found) == 1
    assert f"## {found.pop()}" in (root / "docs/changelog.md").read_text()
