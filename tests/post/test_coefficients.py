"""Coefficients and modes of the program's results, in studies, tables and pictures."""

import csv
import re
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad
import xarray
from tiltpad import command, figures, read_study
from tiltpad.calculate.results import result
from tiltpad.draw import study_report

pytestmark = pytest.mark.usefixtures("quick_pictures")

SPEEDS, FAILED = [4000, 5000, 6000, 7000, 8000], 2
PIVOTS = ["free", "stuck", "locked"]


@pytest.fixture(scope="module")
def folder(runs_of, cases, tmp_path_factory):
    """Runs at five speeds, the slowest one last; the second has no equilibrium."""
    values = {"operation%speed_rpm": SPEEDS[1:] + SPEEDS[:1]}
    return runs_of(tmp_path_factory.mktemp("studies") / "offset", cases["offset"], values, failed=(FAILED,))


@pytest.fixture(scope="module")
def study(folder):
    tiltpad.collect(folder, folder.with_suffix(".h5"))
    with tiltpad.read_study(folder.with_suffix(".h5")) as opened:
        yield opened


@pytest.fixture
def run(folder, opened):
    """The run at 5000 rpm."""
    return opened(folder / "0001.h5")


def test_a_study_has_what_its_members_have(study, run, folder):
    assert list(study.pivot) == PIVOTS
    assert list(study.row) == list(study.column) == ["y", "z"]
    assert list(study.position_row)[:4] == ["y", "z", "tilt_1", "pivot_deflection_1"]
    np.testing.assert_array_equal(study.frequency_ratio, [0.5, 1, 2])
    for group in ("coefficients", "modes"):
        for name, values in run[group].items():
            if name == "name":
                continue  # texts are no columns
            # what is of each pad says so in a study
            own = f"pad_{name}" if name == "one_sided" else name
            np.testing.assert_array_equal(study[own][0], values, name)
            assert np.isnan(study[own][FAILED - 1]).all(), name
            assert study.about(own, "units") == run.about(f"{group}/{name}", "units"), name
    np.testing.assert_allclose(study.speed * 30 / np.pi, study.speed_rpm)
    np.testing.assert_array_equal(study.least_damping_ratio[0], np.nanmin(run["modes/damping_ratio"], axis=1))
    for k, pivot in enumerate(PIVOTS):
        found = tiltpad.modes(run, pivot)
        journal = np.char.startswith(found.name, "journal")
        assert study.rotor_damping_ratio[0, k] == found.damping_ratio[journal].min()
        of_pads = found.damping_ratio[~journal & (found.name != "")]
        assert np.array_equal(study.pads_damping_ratio[0, k], of_pads.min(initial=np.inf)) or not len(of_pads)


def test_members_with_other_frequencies_are_placed_by_their_labels(result, tiltpad, tmp_path, opened):
    """Without friction nothing sticks; two pads have fewer positions."""
    import tiltpad as package

    (tmp_path / "two.nml").write_text("&case task='coefficients' /\n&coefficients frequency_ratio=3, 1 /\n")
    tiltpad("--quiet", tmp_path / "two.nml", "--output", tmp_path / "two.h5", status=0)
    package.collect([tmp_path / "two.h5", result("offset")], tmp_path / "both.h5")
    two = opened(tmp_path / "two.h5")
    assert list(two["pivot"]) == ["free", "locked"]
    with package.read_study(tmp_path / "both.h5") as both:
        np.testing.assert_array_equal(both.frequency_ratio, [0.5, 1, 2, 3])
        assert sorted(both.pivot) == sorted(PIVOTS)
        for pivot in two["pivot"]:
            found = both.stiffness[0][list(both.pivot).index(pivot)]
            wanted = two["coefficients/stiffness"][list(two["pivot"]).index(pivot)]
            np.testing.assert_array_equal(found[[3, 1]], wanted[np.argsort(two["frequency_ratio"])[::-1]])
            assert np.isnan(found[[0, 2]]).all()
        assert np.isnan(both.stiffness[0][list(both.pivot).index("stuck")]).all()
        assert np.isfinite(both.stiffness[1][:, :3]).all()


def test_xarray_selects_by_names(study, run):
    with xarray.open_dataset(study.path, engine="h5netcdf") as data:
        assert data.stiffness.dims == ("run", "pivot", "frequency_ratio", "row", "column")
        over = data.set_index(run="speed_rpm").stiffness.sel(
            pivot="stuck", frequency_ratio=1, row="y", column="z"
        )
        assert over.sel(run=5000) == run["coefficients/stiffness"][1, 1, 0, 1]
    own = run.to_xarray("coefficients").stiffness.sel(pivot="stuck", frequency_ratio=1, row="y", column="z")
    assert own == run["coefficients/stiffness"][1, 1, 0, 1]


def test_coefficients_of_a_result_and_of_a_study(study, run):
    for k, pivot in enumerate(PIVOTS):
        found = tiltpad.coefficients(run, pivot)
        assert (found.pivot, found.speed_rpm) == (pivot, 5000)
        np.testing.assert_array_equal(found.stiffness, run["coefficients/stiffness"][k])
        np.testing.assert_array_equal(found.damping, run["coefficients/damping"][k])
        several = tiltpad.coefficients(study, pivot)
        np.testing.assert_array_equal(several.speed_rpm, SPEEDS)
        np.testing.assert_array_equal(several.stiffness[1], found.stiffness)
        assert list(np.isnan(several.damping).all(axis=(1, 2, 3))) == [False, False, True, False, False]
        np.testing.assert_allclose(several.frequency[1], found.frequency)
    assert tiltpad.coefficients(study).pivot == "free"
    one = tiltpad.coefficients(study, where={"speed_rpm": 5000})
    np.testing.assert_array_equal(one.stiffness, tiltpad.coefficients(run).stiffness[None])


def test_pads_condensed_here_are_those_of_the_program(run):
    """Both solve the same small systems; their conditions lose four digits of sixteen."""
    for pivot in PIVOTS:
        own = tiltpad.coefficients(run, pivot)
        here = tiltpad.coefficients(run, pivot, frequency_ratio=own.frequency_ratio)
        for one, other in ((own.stiffness, here.stiffness), (own.damping, here.damping)):
            np.testing.assert_allclose(other, one, rtol=0, atol=1e-9 * np.abs(one).max())


def test_modes_solve_the_equations_of_motion(run):
    """Free pivots: (lambda^2 M + lambda C + K) shape = 0 with the rotor's mass."""
    found = tiltpad.modes(run)
    mass = run["coefficients/full_mass"] + np.diag([1200.0, 1200.0] + [0.0] * 10)
    stiffness, damping = run["coefficients/full_stiffness"][0], run["coefficients/full_damping"][0]
    there = np.isfinite(found.frequency)
    assert there.sum() >= 4
    for value, shape in zip(found.eigenvalue[there], found.shape[there], strict=True):
        parts = np.array([value**2 * mass @ shape, value * damping @ shape, stiffness @ shape])
        assert np.abs(parts.sum(axis=0)).max() < 1e-7 * np.abs(parts).max()
    np.testing.assert_allclose(found.damping_ratio, -found.eigenvalue.real / np.abs(found.eigenvalue))


def test_elements_and_decrement_are_results_by_name(study):
    """At the whirl frequency of the shaft, which is the second; the decrement is the rotor's least."""
    whirls = list(study.frequency_ratio)
    for name, row, column in (("stiffness_yz", 0, 1), ("damping_zz", 1, 1)):
        own = result(study, name, pivot="stuck")
        of = study[name.partition("_")[0]][:, PIVOTS.index("stuck"), whirls.index(1), row, column]
        np.testing.assert_array_equal(own.values, of)
        assert own.shown.label.startswith(name.replace("_", " ") + ", pivots stuck (")
    modes = tiltpad.modes(study, "free")
    journal = np.char.startswith(modes.name.astype(str), "journal") & (modes.eigenvalue.imag > 0)
    least = np.where(journal, modes.log_decrement, np.inf).min(axis=1)
    least[np.isinf(least)] = np.nan
    order = np.argsort(study.speed_rpm)
    found = tiltpad.percentiles(study, "log_decrement")
    np.testing.assert_allclose(result(study, "log_decrement").values[order], least, rtol=1e-9)
    assert found.mean[0] == pytest.approx(least[np.isfinite(least)].mean(), rel=1e-9)


def test_names_of_modes_are_those_of_the_program(study, run, folder, opened):
    """tiltpad.modes tells them from the shapes, which a study has alone; the program from its model."""
    for source, row in ((run, 1), (opened(folder / "0003.h5"), 3)):
        for k, pivot in enumerate(PIVOTS):
            known = source["modes/name"][k]
            np.testing.assert_array_equal(tiltpad.modes(source, pivot).name, known[known != ""])
            own = tiltpad.modes(study, pivot).name[row]
            assert sorted(own[own != ""]) == sorted(known[known != ""])
    free = tiltpad.modes(run, "free")
    kinds = {str(name) for name in free.name}
    assert {"journal, planar", "pad 1, tilt"} <= kinds, kinds
    of_journal = np.abs(free.shape[:, :2]).max(axis=1) > 0.25
    assert np.char.startswith(free.name, "journal").tolist() == of_journal.tolist()


def test_a_pad_without_load_that_vibrates_is_no_instability_of_the_journal(tiltpad, tmp_path):
    """Pads above a journal that the lower ones carry grow at half the speed, and the journal does not."""
    import tiltpad as package

    (tmp_path / "case.nml").write_text(
        "&case task='coefficients' /\n&pads pivot_angle_deg=-45, 45, 135, 225, arc_deg=72 /\n"
    )
    said = tiltpad("case.nml", cwd=tmp_path, status=0).stdout
    free = said.partition("pivots free:")[2].partition("pivots ")[0]
    assert "the journal is stable:" in free
    assert "the pads are unstable:" in free
    journal, _, pads = free.partition("the pads are")
    assert journal.count("(journal, ") == 2
    assert "(pad" not in journal
    assert "(pad 2, tilt)" in pads
    assert "(journal" not in pads
    with package.read(tmp_path / "case.h5") as case:
        found = package.modes(case)
        assert {name[:5] for name in found.name[found.damping_ratio < 0]} == {"pad 2", "pad 3"}
        shares = np.abs(found.shape[found.damping_ratio < 0][:, :2])
        assert shares.max() < 1e-2
        assert found.frequency[:2] == pytest.approx([6500 / 120] * 2, rel=0.02)
        ring, other = figures.stability(case, pivot="free").axes[0].get_lines()[:2]
        assert ring.get_markerfacecolor() == other.get_markerfacecolor() == "none"
    # modes that do not vibrate fill no table
    listed = [line for line in said.splitlines() if line.startswith("    mode ")]
    assert listed
    assert not any(" 0.0000 Hz" in line for line in listed)
    speeds = ("sweep%operation%speed_rpm=6000,6500",)
    tiltpad("case.nml", "-q", "-o", "speeds", overrides=speeds, cwd=tmp_path, status=0)
    with package.read_study(tmp_path / "speeds.h5") as study:
        ax = figures.campbell(study, pivot="free").axes[0]
        of_journal, of_pads = ax.collections[-2:]
        own = package.modes(study, "free")
        assert len(of_journal.get_offsets()) == 0
        drawn = of_pads.get_offsets()[:, 1]
        assert set(drawn) == set(own.frequency[own.damping_ratio < 0])
        assert len(drawn) >= 2
    # the legend names what the picture has, and no more
    named = {text.get_text() for text in ax.figure.legends[0].get_texts()}
    assert "pad unstable" in named
    assert not named & {"journal unstable", "crossing"}


def test_a_study_s_modes_are_those_of_its_members_in_another_order(study, run):
    found, own = tiltpad.modes(study, "stuck"), tiltpad.modes(run, "stuck")
    assert np.isnan(found.frequency[2]).all()
    there = np.isfinite(found.eigenvalue[1])
    np.testing.assert_array_equal(
        np.sort_complex(found.eigenvalue[1][there]), np.sort_complex(own.eigenvalue)
    )
    rotor = np.argsort(found.damping_ratio[0])[:2]
    whole = found.frequency[[0, 1, 3, 4]][:, rotor]
    assert (np.abs(np.diff(whole, axis=0)) < 0.2 * whole[1:]).all()
    assert np.isnan(found.threshold_rpm).all()


def test_thresholds_are_kept(tiltpad, tmp_path):
    import tiltpad as package

    (tmp_path / "case.nml").write_text(
        "&case task='coefficients' /\n&rotor mass=200 /\n&operation speed_rpm=14000 /\n"
        "&coefficients threshold_up_to_rpm=16000 /\n"
    )
    tiltpad("--quiet", "case.nml", cwd=tmp_path, status=0)
    with package.read(tmp_path / "case.h5") as case:
        assert package.modes(case).threshold_rpm == case["modes/threshold_rpm"][0]
        assert package.modes(case).threshold_rpm == pytest.approx(14945.85, abs=0.05)
        figure = figures.stability(case)
    lines = [line.get_xdata() for line in figure.axes[0].get_lines()]
    assert len(lines) > 4


@pytest.mark.parametrize("name", ["a.csv", "a.toml"])
def test_tables(study, run, tmp_path, name):
    tiltpad.write_coefficients(study, tmp_path / name)
    tiltpad.write_coefficients(run, tmp_path / f"one-{name}", pivot="stuck")
    own = tiltpad.coefficients(study, "stuck")
    if name.endswith("csv"):
        rows = list(csv.DictReader((tmp_path / name).open()))
        assert len(rows) == len(PIVOTS) * len(SPEEDS) * 3
        found = {
            (row["pivot"], float(row["speed_rpm"]), float(row["frequency_ratio"])): [
                float(row["K_zy (N/m)"]), float(row["C_yz (N s/m)"])
            ]
            for row in rows
        }  # fmt: skip
        assert found["stuck", 7000, 2] == [own.stiffness[3, 2, 1, 0], own.damping[3, 2, 0, 1]]
        assert len(list(csv.DictReader((tmp_path / f"one-{name}").open()))) == 3
        return
    found = tomllib.loads((tmp_path / name).read_text())
    assert list(found) == PIVOTS
    np.testing.assert_array_equal(found["stuck"]["stiffness"], own.stiffness)
    np.testing.assert_array_equal(found["stuck"]["damping"], own.damping)
    assert found["stuck"]["speed_rpm"] == SPEEDS
    assert list(tomllib.loads((tmp_path / f"one-{name}").read_text())) == ["stuck"]


def test_the_command_writes_tables(study, run, tmp_path, capsys):
    tiltpad.write_coefficients(study, tmp_path / "a.csv", pivot="free")
    assert command.main(["coefficients", study.path, "--pivot", "free", "-o", str(tmp_path / "b.csv")]) == 0
    assert (tmp_path / "a.csv").read_text() == (tmp_path / "b.csv").read_text()
    assert command.main(["coefficients", run.path, "-o", str(tmp_path / "b.toml")]) == 0
    for words, message in (
        (["coefficients", run.path, run.path, "-o", "c.csv"], "c.csv: a table is of one file"),
        (["stability", run.path, "-o", "c.csv"], "the name must end in .png, .pdf or .svg"),
    ):
        assert command.main(words) == 1
        assert message in capsys.readouterr().err


def test_pictures_show_the_coefficients(study, run):
    own = tiltpad.coefficients(study)
    axes = figures.coefficients(study).axes
    lines = [line for line in axes[1].get_lines() if len(line.get_xdata()) == len(SPEEDS)]
    np.testing.assert_array_equal(lines[2].get_xdata(), SPEEDS)
    np.testing.assert_allclose(lines[2].get_ydata(), 1e-6 * own.stiffness[:, 1, 0, 1])
    np.testing.assert_allclose(lines[3].get_ydata(), 1e-6 * own.stiffness[:, 1, 1, 0])
    lines = figures.coefficients([run], pivot="locked").axes[2].get_lines()
    np.testing.assert_allclose(
        lines[1].get_ydata(), 1e-3 * tiltpad.coefficients(run, "locked").damping[:, 1, 1]
    )


def test_pictures_show_the_modes(study, run):
    own = tiltpad.modes(study, "stuck")
    upper, lower = figures.stability([study], pivot="stuck").axes
    for ax, values in ((upper, 100 * own.damping_ratio), (lower, own.log_decrement)):
        for k in range(values.shape[1]):
            np.testing.assert_allclose(ax.get_lines()[k].get_ydata(), values[:, k])
    points = np.concatenate([each.get_offsets() for each in figures.campbell(study).axes[0].collections])
    known = tiltpad.modes(study).frequency
    assert set(known[known > 0]) <= set(points[:, 1])
    assert len(figures.stability(run).axes[0].get_lines()) > 6


def test_lines_of_modes_of_pads_have_hollow_markers(study):
    """By what each mode is in the last run that has it; the legend says which is which."""
    own = tiltpad.modes(study, "free")
    fig = figures.stability(study, pivot="free")
    last = [[name for name in names if name][-1] for names in own.name.T]
    of_pads = [not name.startswith("journal") for name in last]
    assert set(of_pads) == {True, False}
    for ax in fig.axes:
        lines = ax.get_lines()[: len(last)]
        assert [line.get_markerfacecolor() == "white" for line in lines] == of_pads
        assert [line.get_linestyle() == "--" for line in lines] == of_pads
    # the legend of one study has its modes, that of two the kinds
    named = [(text.get_text(), line.get_markerfacecolor()) for text, line in legend_of(fig)]
    assert named
    assert all((color == "white") == text.startswith("pad") and text.endswith(" Hz") for text, color in named)
    both = figures.stability([study, study], pivot="free")
    told = {text.get_text(): line for text, line in legend_of(both)}
    assert told["pads"].get_markerfacecolor() == "white" != told["journal"].get_markerfacecolor()


def legend_of(fig):
    """Texts and lines of the legend of a picture."""
    return [pair for each in fig.legends for pair in zip(each.get_texts(), each.get_lines(), strict=True)]


@pytest.mark.parametrize("plot", command.VIBRATIONS)
def test_the_command_draws_studies_and_results(study, run, tmp_path, capsys, plot):
    picture = tmp_path / "a.png"
    assert command.main([plot, study.path, "--pivot", "stuck", "-o", str(picture)]) == 0
    assert command.main([plot, study.path, study.path, "-o", str(picture)]) == 0
    assert command.main([plot, run.path, "-o", str(picture)]) == (plot == "campbell")
    assert plt.imread(picture).shape[2] == 4
    capsys.readouterr()
    for options, message in (
        (["--pivot", "nix"], "pivot nix: there are free, stuck, locked"),
        (["--where", "speed_rpm=1"], "no run with speed_rpm = 1: there are 4000"),
        (["--over", "nix"], "--over: nix is not"),
        (["--pad", "1"], f"--pad: not for the plot {plot}"),
        (["--last", "1"], f"--last: not for the plot {plot}"),
    ):
        assert command.main([plot, study.path, *options, "-o", str(picture)]) == 1
        assert message in capsys.readouterr().err
    assert command.main(["study", study.path, "--pivot", "locked", "-o", str(picture)]) == 0


def test_results_without_coefficients_say_why(result, opened, folder):
    for case_name, reason in (
        ("none", "its task is 'march', not 'coefficients'"),
        ("equilibrium", "its task is 'equilibrium'"),
    ):
        with pytest.raises(tiltpad.NotInRunError, match=reason):
            tiltpad.coefficients(opened(result(case_name)))
    with pytest.warns(tiltpad.IncompleteRunWarning, match="no equilibrium found"):
        failed = opened(folder / f"{FAILED:04d}.h5")
    with pytest.raises(tiltpad.NotInRunError, match="no modes in this run: no equilibrium found"):
        tiltpad.modes(failed)
    with pytest.raises(TypeError, match="not a result or study"):
        tiltpad.coefficients("own.h5")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"frequency_ratio": -1}, "must be numbers from 0 on"),
        ({"frequency_ratio": [1, np.nan]}, "must be numbers from 0 on"),
        ({"pivot": "nix"}, "pivot nix: there are free, stuck, locked"),
        ({"where": {"speed_rpm": 1}}, "no run with speed_rpm = 1"),
    ],
)
def test_wrong_arguments(study, options, message):
    with pytest.raises(ValueError, match=message):
        tiltpad.coefficients(study, **options)


@pytest.mark.parametrize("plot", command.VIBRATIONS)
def test_nothing_is_cut_off(study, plot):
    with plt.style.context("tiltpad.draw.tiltpad"):
        fig = figures.FIGURES[plot]([study, study], pivot="stuck")
        fig.canvas.draw()
    page = fig.bbox.padded(1)
    texts = [text for ax in fig.axes for text in (ax.xaxis.label, ax.yaxis.label, ax.title)]
    texts += [text for legend in fig.legends for text in legend.get_texts()]
    for text in (each for each in texts if each.get_text()):
        box = text.get_window_extent()
        assert page.contains(box.x0, box.y0), text
        assert page.contains(box.x1, box.y1), text


def test_the_modes_of_the_rotor_have_the_axis(study):
    """It reaches to the least of them; pads take a quarter of it below 0 at most, and are told beyond."""
    for pivot in PIVOTS:
        fig = figures.stability(study, pivot=pivot)
        found, upper = tiltpad.modes(study, pivot), fig.axes[0]
        low, high = upper.get_ylim()
        journal = np.char.startswith(found.name, "journal")
        least, pads = (100 * np.nanmin(np.where(own, found.damping_ratio, 1)) for own in (journal, ~journal))
        assert low <= min(least, 0)
        assert -low <= max(1.05 * 0.26 * high, -1.06 * least)
        assert any(text.get_text().startswith("pads to") for text in upper.texts) == (pads < low)
        # each line in sight has its name
        texts = [text.get_text() for legend in fig.legends for text in legend.get_texts()]
        assert any(text.startswith("journal, ") and text.endswith(" Hz") for text in texts), texts


def test_a_report_begins_with_the_operating_points(study):
    """A row for each run, with the stability of the journal, whatever the pads do."""
    page = study_report.study_report(study)
    rows = page.partition("Operating points")[2].partition("</table>")[0].split("<tr>")[1:]
    head, *cells = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]
    assert len(cells) == study.done.sum() < len(study.done)
    for name in ("eccentricity ratio", "minimum film (µm)", "K yy (MN/m)", "C zz (kN s/m)", "the journal is"):
        assert name in head, head
    stable = ((study.equilibrium_rotor_stable == 1) & (study.rotor_damping_ratio[:, 0] > 0))[study.done]
    assert [row[-1] for row in cells] == ["stable" if each else "unstable" for each in stable]
    stiffness = [float(row[head.index("K yy (MN/m)")]) for row in cells]
    np.testing.assert_allclose(stiffness, 1e-6 * study.stiffness[study.done, 0, 0, 0, 0], rtol=1e-3)


def test_points_of_a_held_journal_are_a_table_of_bearings(tiltpad, tmp_path):
    """What tables over the eccentricity have: attitude, Sommerfeld number and load."""
    case = "&sweep held%eccentricity_ratio=0.2, 0.6 / &case task='equilibrium' /"
    (tmp_path / "held.nml").write_text(case)
    tiltpad("--quiet", "held.nml", cwd=tmp_path, status=0)
    with read_study(tmp_path / "held.h5") as study:
        page = study_report.study_report(study)
        found = study.equilibrium_sommerfeld_number[:]
    head, *rows = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in page.split("<tr>")[1:4]]
    assert "attitude angle (deg)" in head
    assert "specific load (MPa)" in head
    np.testing.assert_allclose(
        [float(row[head.index("Sommerfeld number")]) for row in rows], found, rtol=1e-3
    )


def test_diagrams_of_pivots(study):
    ax = tiltpad.diagrams.diagram(study, pivot="locked")
    order = np.argsort(study.speed_rpm)
    np.testing.assert_allclose(ax.get_lines()[0].get_ydata(), 100 * study.rotor_damping_ratio[order, 2])
    assert ax.get_ylabel().replace("\n", " ") == "damping ratio of the rotor, pivots locked (%)"
