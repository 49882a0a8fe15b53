"""Studies of samples in pictures and reports, and studies whose runs have no files or are still to be run."""

import re

import h5py
import numpy as np
import pytest
import tiltpad
from sampled import write_study
from scipy import stats
from scipy.stats import qmc
from tiltpad import command, figures, sampling, study_report
from tiltpad.draw import diagrams, samples
from tiltpad.files.study import Study

pytestmark = pytest.mark.usefixtures("quick_pictures")
CAUSE = "no equilibrium found at {} rpm: pad 1 has no equilibrium"


def sample_of(path, runs=256, refused=5, pending=4, **options):
    """A study of three inputs: clearance takes damping away, preload adds to it, mass does nothing."""
    points = qmc.Sobol(3, rng=1).random(runs)
    inputs = {"clearance": 7e-5 + 2e-5 * points[:, 0], "preload": points[:, 1] / 2, "mass": points[:, 2]}
    status = np.zeros(runs, dtype=int)
    status[:refused], status[runs - pending :] = 2, -2
    damping = np.where(status == 0, 0.25 - 0.3 * points[:, 0] + 0.1 * points[:, 1], np.nan)
    film = np.where(status == 0, 4e-5 + 1e-5 * points[:, 0] ** 2, np.nan)
    results = {
        "least_damping_ratio": damping[:, None] + np.array([0, -0.1, -0.2]),
        "equilibrium_min_film_thickness": film,
    }
    reason = [CAUSE.format(9000 + k) if k < refused else "" for k in range(runs)]
    return write_study(path, inputs, results, status, reason, **options)


@pytest.fixture
def sampled(tmp_path):
    return sample_of(tmp_path / "sample.h5")


def test_a_tornado_has_the_input_that_matters_most_on_top(sampled):
    with tiltpad.read_study(sampled) as study:
        fig = figures.tornado(study, show="least_damping_ratio")
    left, right = fig.axes
    assert [each.get_text() for each in left.get_yticklabels()] == ["mass", "preload", "bearing clearance"]
    assert left.get_xlabel() == "least damping ratio, pivots free (%)"
    low, high = left.patches[-2:]
    # a small clearance has the higher damping: 30 % from end to end, nine tenths of it between the tenths
    assert low.get_width() > 0 > high.get_width()
    assert low.get_width() - high.get_width() == pytest.approx(0.9 * 30, rel=0.02)
    widths = [bar.get_width() for bar in right.patches]
    np.testing.assert_allclose(widths, [0, 10, 90], atol=1)
    assert "explains 100.0 % of the variance" in fig.get_supxlabel()
    assert "4 runs have not been run yet" in fig.get_supxlabel()


def test_a_distribution_has_percentiles_and_all_runs(sampled):
    with tiltpad.read_study(sampled) as study:
        fig = figures.distribution(study)
        found = tiltpad.percentiles(study)
    assert [ax.get_xlabel() for ax in fig.axes] == [
        "minimum film thickness at the equilibrium (µm)",
        "least damping ratio, pivots free (%)",
    ]
    for ax, factor, values in zip(fig.axes, (1e6, 100), found.values, strict=True):
        assert [line.get_xdata()[0] for line in ax.get_lines()] == pytest.approx(
            list(factor * values[[0, 2, 4]])
        )
        (outline,) = ax.patches
        steps = outline.get_xy()
        assert steps[:, 1].max() > 1
        heights = [
            high for (left, high), (right, _) in zip(steps[:-1], steps[1:], strict=True) if right > left
        ]
        assert sum(heights) == pytest.approx(100)


def test_a_scatter_matrix_has_a_panel_for_each_input_and_result(sampled):
    with tiltpad.read_study(sampled) as study:
        panels = figures.scatter(study).axes
        assert len(panels) == 6
        assert len(panels[0].get_lines()[0].get_xdata()) == 256 - 5 - 4
        assert len(panels[3].get_lines()[0].get_xdata()) == 5
        assert len(figures.scatter(study, show="least_damping_ratio", pivot="locked").axes) == 3


def test_a_sample_is_drawn_as_points(sampled):
    with tiltpad.read_study(sampled) as study:
        (ax,) = figures.study(study, "least_damping_ratio", over="preload").axes
        points, refused = ax.get_lines()
        assert (len(points.get_xdata()), len(refused.get_xdata())) == (247, 5)
        assert points.get_linestyle() == "None"
        assert not study.pending[:252].any()
        with pytest.raises(ValueError, match="lines, one for each"):
            figures.study(study, "least_damping_ratio", over="preload", kind="lines")


def test_the_report_of_a_sample(sampled, tmp_path):
    assert command.report([str(sampled), "-o", str(tmp_path / "a.html")]) == 0
    page = (tmp_path / "a.html").read_text()
    assert "256 runs, 247 of them done. 4 runs have not been run yet." in page
    assert (
        "<td>refused: no equilibrium found at # rpm: pad # has no equilibrium</td><td>5</td><td>252</td>"
        in page
    )
    assert re.search(r"<td>bearing clearance \(m\)</td><td>\+100 \(100\)</td><td>−\d\d \(\d\d\)</td>", page)
    assert re.findall('alt="([^"]*)"', page) == [
        "distribution", "tornado", "tornado", "scatter",
    ]  # fmt: skip
    assert page.count("failed in its numerics") == 5


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["tornado"], 0, ""),
        (["distribution", "--show", "least_damping_ratio", "--pivot", "stuck"], 0, ""),
        (["scatter"], 0, ""),
        (["study", "--as", "points", "--over", "mass"], 0, ""),
        (["tornado", "--show", "steps"], 1, "--show: steps is not a result of this study: "),
        (["tornado", "--where", "mass=2"], 1, "no run with mass = 2: there are 0.00"),
        (["tornado", "--pivot", "open"], 1, "pivot open: there are free, stuck, locked"),
        (["tornado", "--last", "2"], 1, "--last: not for the plot tornado"),
        (["tornado", "--over", "mass"], 1, "--over: for the plots"),
    ],
)
def test_the_command_draws_samples(sampled, tmp_path, capsys, arguments, status, words):
    plot, *options = arguments
    output = tmp_path / "a.png"
    assert command.main([plot, str(sampled), *options, "-o", str(output)]) == status
    said = capsys.readouterr().err
    assert words in said
    assert said.count("\n") == (status != 0)
    assert output.exists() == (status == 0)


def test_a_result_of_one_run_has_no_sample(run, result, tmp_path, capsys):
    for plot in command.SAMPLES:
        with pytest.raises(tiltpad.NotInRunError, match="the result of one run"):
            figures.FIGURES[plot](run("equilibrium"))
        assert command.main([plot, str(result("equilibrium")), "-o", str(tmp_path / "a.png")]) == 3
        assert "the result of one run, not a study" in capsys.readouterr().err


def test_refused_samples(tmp_path, capsys):
    """Nothing done, one done, all the same: pictures are refused in a line, reports are written."""
    for number, (runs, refused, pending) in enumerate(((64, 64, 0), (64, 63, 0), (64, 0, 64), (64, 0, 0))):
        path = sample_of(tmp_path / f"{number}.h5", runs, refused, pending)
        if number == 3:
            with h5py.File(path, "r+") as file:
                file["least_damping_ratio"][...] = 0.1
                file["equilibrium_min_film_thickness"][...] = 4e-5
        assert command.report([str(path), "-o", str(tmp_path / "a.html")]) == 0
        for plot in command.SAMPLES:
            assert command.main([plot, str(path), "-o", str(tmp_path / "a.png")]) == 1
            assert capsys.readouterr().err.count("\n") == 1


def test_texts_of_the_user_are_drawn_as_they_are(tmp_path):
    path = sample_of(tmp_path / "a.h5", title=r"$\no{x}$")
    with h5py.File(path, "r+") as file:
        for name in ("clearance", "least_damping_ratio"):
            file[name].attrs["long_name"] = "_$a_$b^^$ $"
    with tiltpad.read_study(path) as study:
        for plot in command.SAMPLES:
            fig = figures.FIGURES[plot](study)
            fig.set_layout_engine("none")
            fig.draw_without_rendering()
        assert "_$a_$b^^$ $" in study_report.study_report(study)


def test_a_study_of_rows_is_read_as_a_collected_one(runs_of, tmp_path, capsys):
    """Without files of the runs, and with rows of runs that are still to be run."""
    case = "&case task='coefficients' / &coefficients frequency_ratio=0.5, 1 /"
    folder = runs_of(tmp_path / "speeds", case, {"operation%speed_rpm": [3000, 4000, 5000, 6000]})
    whole, rows = tmp_path / "whole.h5", tmp_path / "rows.h5"
    tiltpad.collect(folder, whole)
    rows.write_bytes(whole.read_bytes())
    with h5py.File(rows, "r+") as file:
        del file["file"]
        for name, column in file.items():
            if column.shape[:1] == (4,) and column.dtype.kind == "f" and name not in ("speed_rpm", "mode"):
                column[3] = np.nan
        file["status"][3] = -2
    with tiltpad.read_study(rows) as study, tiltpad.read_study(whole) as known:
        assert (list(study.done), list(study.pending)) == ([True] * 3 + [False], [False] * 3 + [True])
        assert study.failures() == []
        assert not study.failed.any()
        np.testing.assert_array_equal(study.equilibrium_journal_y[:3], known.equilibrium_journal_y[:3])
        assert tiltpad.coefficients(study).speed_rpm.tolist() == [3000, 4000, 5000]
        assert study.to_xarray().sizes["run"] == 4
        study.to_csv(tmp_path / "a.csv")
        assert len((tmp_path / "a.csv").read_text().splitlines()) == 5
        # no line across where nothing has failed
        (ax,) = figures.study(study, "least_damping_ratio").axes
        assert len(ax.get_lines()) == 1
    for plot in ("study", "coefficients", "stability", "campbell"):
        assert command.main([plot, str(rows), "-o", str(tmp_path / f"{plot}.png")]) == 0
    assert capsys.readouterr().err == ""
    assert command.report([str(rows), "-o", str(tmp_path / "a.html")]) == 0
    page = (tmp_path / "a.html").read_text()
    assert "4 runs, 3 of them done. 1 run has not been run yet." in page
    assert "Runs that were not done" not in page


def test_of_many_runs_only_what_is_drawn_is_read(tmp_path, monkeypatch):
    """Pictures of 50,000 runs have few points, and no column of another result is read."""
    path = sample_of(tmp_path / "a.h5", 2**15, 700, 0)
    with h5py.File(path, "r+") as file:
        for k in range(20):
            file[f"other_{k}"] = np.zeros(2**15)
            file[f"other_{k}"].dims[0].attach_scale(file["run"])
            file[f"other_{k}"].attrs["units"] = "1"
    names = []
    values = Study.values
    monkeypatch.setattr(
        Study, "values", lambda self, name, *part: names.append(name) or values(self, name, *part)
    )
    with tiltpad.read_study(path) as study:
        drawn = [figures.FIGURES[plot](study) for plot in command.SAMPLES]
        drawn.append(figures.study(study, "least_damping_ratio"))
        study_report.study_report(study)
    assert not [name for name in names if name.startswith("other")]
    for fig in drawn:
        points = [len(line.get_xdata()) for ax in fig.axes for line in ax.get_lines()]
        assert max(points) <= diagrams.MOST_POINTS
        assert sum(points) <= 6 * (samples.POINTS + diagrams.EDGE) + diagrams.MOST_POINTS
    assert "700 runs were not done" in drawn[0].get_supxlabel()


def test_a_saltelli_design(tmp_path, monkeypatch, program):
    """Rows of a point are A, B, and A with each variable from B; the program runs them."""
    monkeypatch.setenv("TILTPAD", program)
    case = {"case": {"task": "equilibrium"}}
    made = {"bearing%assembled_clearance": ("normal", 80e-6, 3e-6), "rotor%mass": ("uniform", 1e3, 2e3)}
    path = tiltpad.sample(case, made, 16, method="saltelli", file=tmp_path / "a.csv")
    rows = np.loadtxt(path, delimiter=",", skiprows=1).reshape(16, 4, 2)
    np.testing.assert_array_equal(rows[:, 2], np.column_stack([rows[:, 1, 0], rows[:, 0, 1]]))
    np.testing.assert_array_equal(rows[:, 3], np.column_stack([rows[:, 0, 0], rows[:, 1, 1]]))
    assert stats.kstest(rows[:, :2, 1].ravel(), stats.uniform(1e3, 1e3).cdf).pvalue > 0.01
    with tiltpad.run(case, sweep={"file": path}) as study:
        found = tiltpad.sensitivity(study, "equilibrium_min_film_thickness")
    assert (found.method, found.runs) == ("saltelli", 64)
    assert found.first[1] > found.first[0]
    with pytest.raises(ValueError, match="1050000 runs, and a study has at most 1000000"):
        tiltpad.sample(
            case, dict.fromkeys(("rotor%mass",), made["rotor%mass"]), 350000, method=sampling.SALTELLI
        )
