"""Texts of a user in pictures: titles, names of files, values of parameters, reasons; drawn as they are.

Matplotlib reads what is between dollar signs as a formula, and leaves entries of a legend out that begin with
an underscore. The texts here would be wrong formulas, and have a letter that no formula of the package has.
"""

import re
import shutil
import warnings

import h5py
import matplotlib.mathtext
import matplotlib.text
import pytest
import tiltpad
from tiltpad import figures
from tiltpad.draw import bearing, report, study_report
from tiltpad.draw.plots import STYLE

pytestmark = pytest.mark.usefixtures("quick_pictures")

#: A title, a name of a file without its ending, that of its folder, and another text.
TITLE, STEM, FOLDER, OTHER = r"Ж$\no{x}$ 5", "_Ж$a_$b^^$ $", "Ж$c_{$d", r"Ж\$c_{$d$"
CASES = ("lugre", "runup", "equilibrium", "periodic", "branch", "offset")


@pytest.fixture
def texts(monkeypatch):
    """What is drawn as text by Matplotlib; a formula with a text of the user is an error."""
    drawn = []
    parse = matplotlib.mathtext.MathTextParser.parse
    prepare = matplotlib.text.Text._preprocess_math

    def parsed(self, text, *arguments, **options):
        formulas = re.split(r"(?<!\\)\$", text)[1::2]
        assert "Ж" not in "".join(formulas), text
        return parse(self, text, *arguments, **options)

    def prepared(self, text):
        found = prepare(self, text)
        drawn.append(found[0].replace(r"\$", "$") if found[1] else found[0])
        return found

    monkeypatch.setattr(matplotlib.mathtext.MathTextParser, "parse", parsed)
    monkeypatch.setattr(matplotlib.text.Text, "_preprocess_math", prepared)
    return drawn


@pytest.fixture
def named(result, opened, tmp_path):
    """named("lugre", "title"): that result with a title, or as a file, whose name would be a formula."""

    def make(case, what):
        folder = tmp_path / FOLDER
        folder.mkdir()
        path = shutil.copy(result(case), folder / (f"{STEM}{case}.h5" if what == "stem" else f"{case}.h5"))
        with h5py.File(path, "r+") as file:
            file.attrs["title"] = TITLE + case if what == "title" else ""
            if "branch_parameter" in file.attrs:
                file.attrs["branch_parameter"] = f"operation%{OTHER}"
        return opened(path)

    return make


def in_lines(text):
    return " ".join(text.split())


def draw(figure):
    """Draws the figure, which needs every text, but not its layout, which takes most of the time."""
    figure.set_layout_engine("none")
    figure.draw_without_rendering()


@pytest.mark.parametrize("case", CASES)
def test_one_result(named, texts, case):
    run = named(case, "title")
    drawn = 0
    with matplotlib.pyplot.style.context(STYLE):
        draw(bearing.bearing(run))
        for picture in figures.FIGURES.values():
            try:
                figure = picture([run])
            except tiltpad.NotInRunError:
                continue
            finally:
                matplotlib.pyplot.close("all")
            texts.clear()
            draw(figure)
            drawn += any(TITLE in in_lines(text) for text in texts)
    assert drawn >= 1
    assert "Ж" in report.report(run)


@pytest.mark.parametrize(
    ("case", "what"),
    [
        *((case, "title") for case in ("lugre", "runup", "periodic", "branch", "offset")),
        *((case, what) for case in ("lugre", "offset") for what in ("stem", "folder")),
    ],
)
def test_several_results(named, texts, tmp_path, opened, case, what):
    """They are named by their titles, their files or their folders."""
    runs = [named(case, what)]
    other = tmp_path / "other" / "deeper"
    other.mkdir(parents=True)
    runs.append(opened(shutil.copy(runs[0].path, other / f"{'b' if what != 'folder' else case}.h5")))
    expected = {"title": TITLE, "stem": STEM, "folder": FOLDER}[what]
    if what == "title":
        runs[1].attributes["title"] = "another"
    drawn = 0
    with matplotlib.pyplot.style.context(STYLE):
        for name, picture in figures.FIGURES.items():
            try:
                figure = picture(runs)
            except (tiltpad.NotInRunError, ValueError):
                continue
            finally:
                matplotlib.pyplot.close("all")
            texts.clear()
            draw(figure)
            assert any(expected in "".join(text.split("\n")) for text in texts), name
            drawn += 1
    assert drawn >= 1


def test_a_study(runs_of, texts, tmp_path):
    """Names and descriptions in its file, values that are texts, reasons."""
    case = "&case title='Grid', task='coefficients' /"
    values = {"operation%speed_rpm": [4000, 5000], "friction%model": ["none", "lugre"]}
    folder = runs_of(tmp_path / "grid", case, values, failed=(4,))
    for number in range(1, 5):
        with h5py.File(folder / f"000{number}.h5", "r+") as file:
            file.attrs["title"] = TITLE
            file.attrs["sweep"] = file.attrs["sweep"].replace("none", f"_{OTHER}")
            if number == 4:
                file.attrs["reason"] = OTHER
    tiltpad.collect(folder, tmp_path / f"{STEM}.h5")
    with h5py.File(tmp_path / f"{STEM}.h5", "r+") as file:
        for name in ("model", "speed_rpm", "least_damping_ratio", "steps"):
            if name in file:
                file[name].attrs.update({"long_name": OTHER, "units": OTHER})
    shutil.copy(tmp_path / f"{STEM}.h5", tmp_path / "other.h5")
    with (
        tiltpad.read_study(tmp_path / f"{STEM}.h5") as one,
        tiltpad.read_study(tmp_path / "other.h5") as other,
    ):
        drawn = [
            figures.study(one, where={"speed_rpm": "4000"}),
            figures.study(one, "equilibrium_journal_y"),
            figures.study(one, over="model", where={"speed_rpm": "4000"}),
            figures.study([one, other], "least_damping_ratio", over="speed_rpm"),
            *(figures.FIGURES[name]([one]) for name in ("coefficients", "stability")),
            *(figures.FIGURES[name]([one, other]) for name in ("coefficients", "stability", "campbell")),
        ]
        for figure in drawn:
            texts.clear()
            draw(figure)
            assert any("Ж" in text for text in texts)
            assert any(OTHER in in_lines(text) or TITLE in in_lines(text) for text in texts)
        with warnings.catch_warnings(action="ignore"):
            assert study_report.study_report(one).count("Ж") > 3
