"""make paper: its claims can fail, its page has every picture, its cases are accepted."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad as package
from paper import __main__ as command
from paper import claims, figures, judging, measures, page, reasons, sections
from paper.runs import Runs, run_all
from paper.settings import CASES, Case

#: Runs of the claims tried here, shortened.
SHORT = ("operation%duration=0.1", "output%start_time=0.04")
#: Claims that these runs decide.
DECIDED = (
    "tilting_only_smaller",
    "tilting_only_higher",
    "radial_motion_tilts",
    "friction_enlarges_tilting_radial",
)
NAMES = ("steady_to", "steady_tr", "steady_tr_ba", "steady_ba_10_05", "ba_slow")


@pytest.fixture(scope="session")
def folder(program, tmp_path_factory):
    """Folder with the results of some cases."""
    results = tmp_path_factory.mktemp("paper")
    cases = [case_name for case_name in CASES if case_name.name in NAMES]
    assert len(cases) == len(NAMES)
    shortened = [Case(each.name, each.case, (*each.overrides, *SHORT)) for each in cases]
    run_all(program, [(each, results) for each in shortened])
    return results


@pytest.fixture
def runs(folder):
    with Runs(folder) as found:
        yield found


def judged(name):
    """The claim of that name."""
    return next(each for each in claims.CLAIMS if each.name == name).judge


def test_claims_hold_in_short_runs(runs):
    for name in DECIDED:
        assert judged(name)(runs).holds, name


def test_claims_fail_where_they_are_wrong(runs):
    swapped = {"steady_to": runs["steady_tr"], "steady_tr": runs["steady_to"]}
    swapped["steady_tr_ba"] = swapped["steady_tr"]
    for name in DECIDED:
        assert not judged(name)(swapped).holds, name


def test_a_difference_within_the_resolution_does_not_count():
    assert not judging.smaller(0.999).holds
    assert judging.smaller(0.9).holds
    assert not judging.larger(1.001).holds
    assert judging.larger(1.1).holds
    assert not judging.Verdict(np.nan, "<", 1).holds


def test_a_pad_that_slides_does_not_count_as_stuck(runs):
    stuck = {f"{model}_slow": runs["ba_slow"] for model in ("ba", "lugre")}
    sliding = {f"{model}_slow": runs["steady_tr_ba"] for model in ("ba", "lugre")}
    assert judged("stuck_at_low_speed")(stuck).holds
    assert not judged("stuck_at_low_speed")(sliding).holds


def test_sinusoid_does_not_rest(changed):
    """A pad that swings as a sinusoid is slow as long as a sinusoid is."""

    def swing(file):
        phase = file["shaft_angle"][()]
        file["pad_tilt_rate"][...] = 0.05 * np.column_stack([np.cos(phase), np.sin(phase)])

    with package.read(changed("lugre", swing)) as run:
        assert measures.sticking(run) == pytest.approx(1, rel=1e-2)


def test_loop_width(changed):
    """With v = V cos a and mu = 0.06 cos a - 0.02 sin a the branches are 0.04 sin a apart."""

    def loop(file):
        phase, radius = file["shaft_angle"][()], 0.013 - 15e-6
        velocity = 1e-3 * np.cos(phase)
        file["pad_tilt_rate"][...] = (velocity / radius)[:, None]
        file["pivot_load"][...] = 1e4
        file["friction_moment"][...] = (1e4 * radius * (0.06 * np.cos(phase) - 0.02 * np.sin(phase)))[:, None]

    with package.read(changed("lugre", loop)) as run:
        static = max(run.input["friction"]["static_coefficient"])
        width = 0.04 * np.sin(np.arccos(0.05)) / static
        assert measures.loop_width(run) == pytest.approx(width, rel=1e-2)


def test_stribeck_curve_is_the_programs(runs):
    """The page's own formula against the archived friction of Bengisu-Akay."""
    assert measures.off_curve(runs["steady_ba_10_05"]) == pytest.approx(0, abs=1e-6)


def test_page_has_every_picture_and_claim():
    shown = {f"fig{name}" for section in sections.SECTIONS for name in section.pictures}
    shown |= {name for name in command.PICTURES if f"({name}.png)" in page.PAGE}
    assert shown == set(command.PICTURES)
    numbers = {"3", "4", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15"}
    assert numbers <= {name.removeprefix("fig") for name in command.PICTURES}
    assert all(text for section in sections.SECTIONS for text in section.pictures.values())
    where = [each for section in sections.SECTIONS for each in section.where]
    assert len(where) == len(set(where))
    assert {each.where for each in claims.CLAIMS} == set(where)
    assert set(reasons.WHY) <= {each.name for each in claims.CLAIMS}


def test_a_claim_that_fails_is_on_the_page(runs):
    claim = next(each for each in claims.CLAIMS if each.name == "sticking_wider_dynamic")
    wrong, right = judging.Verdict(0.9, ">", 1.01), judging.Verdict(1.1, ">", 1.01)
    failed = judging.Checked(claim, wrong, wrong, right)
    assert "**no**" in page.row(failed)
    assert claim.statement in page.failed_words([failed])
    text = page.why([failed], runs)
    assert "0.900" in text
    assert "f_s determines" in text
    assert "numerics" in page.why([judging.Checked(claim, wrong, right, right)], runs)
    assert claim.statement in page.rule_changes([failed])


def test_cases_are_accepted(tiltpad, root):
    """Every case is one that the program takes; names tell them apart."""
    for cases in command.FOLDERS.values():
        assert len({case_name.name for case_name in cases}) == len(cases)
        for case_name in cases:
            tiltpad("--check", root / case_name.case, overrides=case_name.overrides, status=0)


def test_failed_run_is_told(program, tmp_path):
    case_name = Case("wrong", "input/paper/steady_tr.nml", ("friction%model=glue",))
    with pytest.raises(RuntimeError, match=r"wrong: .*glue"):
        run_all(program, [(case_name, tmp_path)])


def test_picture_has_equal_axes_and_units(runs):
    with plt.style.context(package.plots.STYLE):
        fig = figures.FIGURES["9"](
            {"steady_to_ba": runs["steady_tr_ba"], **{name: runs[name] for name in NAMES[:3]}}
        )
    assert fig.axes[0].get_aspect() == 1
    for ax in fig.axes:
        assert "(" in ax.get_ylabel()
    plt.close(fig)
