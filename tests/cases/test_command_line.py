"""The command line: options, precedence, names of files, exit status 0, and what a run prints."""

import re
import subprocess

import h5py
import pytest
from conftest import FAST_CLOCK, on_a_terminal

BRIEF = "&operation duration=0.002 /\n"
#: Some hundreds of steps, after each of which the run looks whether it is time for a line.
LONG = "&operation duration=0.02 / &integration max_step=1e-4 /\n"

# a case with something unusual in every kind of value
RICH = """! comment
&CASE Title = 'it''s "quoted", 50 % & more! / \u00fc \u20ac ' task='March' /
&rotor static_load = 0,-1.5D2 mass=1*2000.0 /
&operation
  speed_rpm = 3000, final_speed_rpm = 6500 ! run-up
  duration = 0.1
/
&pads
  pivot_angle_deg = -90 0 90 180
  arc_deg = 4*60
  arc_deg(2) = 61.23456789012345
  mass(2) = 2*0.9
&end
&friction model = "LuGre" /
"""


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.nml").write_text(BRIEF)
    return tmp_path


def value(text, group, name):
    """A value of a resolved case."""
    block = re.search(rf"^&{group}\n(.*?)^/$", text, re.M | re.S)[1]
    return plain(re.search(rf"^ *{name} = (.*)$", block, re.M)[1])


def plain(text):
    """A resolved case without the marks."""
    return re.sub(r" +! (default|derived)$", "", text, flags=re.M)


def check(tiltpad, folder, *arguments):
    run = tiltpad("--check", *arguments, cwd=folder, status=0)
    return run.stdout


@pytest.mark.parametrize("option", ["--help", "-h"])
def test_help(tiltpad, tmp_path, option):
    run = tiltpad(option, cwd=tmp_path, status=0)
    assert run.stdout.startswith("usage: tiltpad [options] CASE.nml\n")
    for word in ("--output", "--set", "--check", "--quiet", "--version", "--help", "Exit status"):
        assert word in run.stdout
    assert all(len(line) <= 100 for line in run.stdout.splitlines())
    assert not list(tmp_path.iterdir())


def test_version(tiltpad, tmp_path):
    run = tiltpad("--version", cwd=tmp_path, status=0)
    assert re.fullmatch(
        r"tiltpad [0-9]+\.[0-9]+\.[0-9]+ \([0-9a-f]{7,}(-dirty)?\)\n|tiltpad [0-9.]+ \(unknown\)\n",
        run.stdout,
    )


def test_check_runs_nothing(tiltpad, case):
    text = check(tiltpad, case, "case.nml")
    assert text.startswith("&case\n")
    assert "/\n! derived values\n" in text
    assert [path.name for path in case.iterdir()] == ["case.nml"]


@pytest.mark.parametrize(
    "text", [BRIEF, RICH, "&case /\n", "&case / &rotor /"], ids=["brief", "rich", "empty", "groups"]
)
def test_check_resolves_to_itself(tiltpad, tmp_path, text):
    (tmp_path / "case.nml").write_text(text, encoding="utf-8")
    first = check(tiltpad, tmp_path, "case.nml")
    (tmp_path / "again.nml").write_text(first, encoding="utf-8")
    assert check(tiltpad, tmp_path, "again.nml") == plain(first)


def test_check_of_all_cases_that_come_along(tiltpad, tmp_path, root):
    cases = sorted((root / "input").rglob("*.nml"))
    assert cases
    # files of numbers count from the working directory
    (tmp_path / "input").symlink_to(root / "input")
    for path in cases:
        first = check(tiltpad, tmp_path, path)
        (tmp_path / "again.nml").write_text(first, encoding="utf-8")
        assert check(tiltpad, tmp_path, "again.nml") == plain(first)


def test_check_marks_what_is_not_given(tiltpad, tmp_path):
    """Given, default and derived values; --set gives too."""
    (tmp_path / "case.nml").write_text(
        "&bearing preload=0.3, viscosity=19e-3 / &pads pivot_angle_deg=-90,0,90, arc_deg=60, mass(2)=1 /"
        " &rotor balance_grade=2.5 /"
    )
    text = check(tiltpad, tmp_path, "case.nml", "--set", "operation%speed_rpm=3000")
    marked, group = {}, ""
    for line in text.splitlines():
        if line.startswith("&"):
            group = line[1:]
        elif found := re.fullmatch(r"  (\w+) = .*?(?: +! (default|derived))?", line):
            marked.setdefault(found[2], []).append(f"{group}%{found[1]}")
    given = "viscosity pivot_angle_deg arc_deg mass balance_grade speed_rpm"
    assert {name.partition("%")[2] for name in marked[None]} == set(given.split())
    derived = "machined_clearance inertia centre_radial final_speed_rpm"
    assert {name.partition("%")[2] for name in marked["derived"]} == set(derived.split())
    assert "rotor%mass" in marked["default"]
    assert "!   preload            0.3  1 - c_r/c_m\n" in text
    # 9549*2.5*2000/3000 g mm
    assert "!   unbalance          0.015915  kg m" in text
    assert ", c_r 80 um as assembled\n" in text
    sommerfeld = 0.019 * 50 * 0.1 * 0.0998 / (2000 * 9.81) * (49.9 / 0.08) ** 2
    assert float(re.search(r"Sommerfeld number +(\S+)", text)[1]) == pytest.approx(sommerfeld, rel=1e-5)


@pytest.mark.parametrize(
    ("case", "remark"),
    [
        ("&bearing preload=-0.2 /", "remark: negative preload -0.2:"),
        (
            "&bearing journal_radius=2.5, assembled_clearance=4e-3, preload=0 /",
            "remark: bearing%journal_radius = 2.5:",
        ),
    ],
)
def test_check_remarks_what_is_seldom_meant(tiltpad, tmp_path, case, remark):
    (tmp_path / "case.nml").write_text(f"{case}\n&case task='equilibrium' /")
    assert f"\n! {remark}" in check(tiltpad, tmp_path, "case.nml")
    assert tiltpad("case.nml", cwd=tmp_path).stdout.startswith(remark)


def test_byte_order_mark(tiltpad, tmp_path):
    """Some editors put one in front of UTF-8."""
    (tmp_path / "case.nml").write_text("\ufeff&rotor mass=1234 /\n", encoding="utf-8")
    assert value(check(tiltpad, tmp_path, "case.nml"), "rotor", "mass") == "1234"


def test_long_line_and_title(tiltpad, tmp_path):
    title = 500 * "x "
    (tmp_path / "case.nml").write_text(f"&rotor{20000 * ' '}mass=1234 / &case title='{title}' /")
    text = check(tiltpad, tmp_path, "case.nml")
    assert value(text, "rotor", "mass") == "1234"
    assert value(text, "case", "title") == f"'{title}'"


def test_pads_from_one_to_the_most(tiltpad, tmp_path):
    for pads in range(1, 25):
        angles = ",".join(f"{-90 + 15 * i}" for i in range(pads))
        (tmp_path / "case.nml").write_text(f"&pads pivot_angle_deg={angles} arc_deg=10 /\n")
        text = check(tiltpad, tmp_path, "case.nml")
        assert len(value(text, "pads", "inertia").split(",")) == pads


def test_set_comes_before_the_file_and_the_last_one_counts(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text("&rotor mass=1 /\n")
    set_1, set_2 = ("--set", "rotor%mass=2"), ("--set", "ROTOR%Mass = 3")
    assert value(check(tiltpad, tmp_path, *set_1, "case.nml", *set_2), "rotor", "mass") == "3"
    assert value(check(tiltpad, tmp_path, *set_2, *set_1, "case.nml"), "rotor", "mass") == "2"


def test_set_mends_a_value_of_the_file(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text("&rotor mass=-1 /\n")
    assert value(check(tiltpad, tmp_path, "case.nml", "--set", "rotor%mass=5"), "rotor", "mass") == "5"


@pytest.mark.parametrize(
    ("name", "output"),
    [
        ("case.nml", "case.h5"),
        ("a.b.nml", "a.b.h5"),
        ("noend", "noend.h5"),
        (".hidden", ".hidden.h5"),
        ("\u00fc x.nml", "\u00fc x.h5"),
    ],
)
def test_default_output(tiltpad, tmp_path, name, output):
    """The case's name with .h5, in the working directory and not beside the case."""
    (tmp_path / "cases").mkdir()
    (tmp_path / "work").mkdir()
    (tmp_path / "cases" / name).write_text(BRIEF)
    run = tiltpad(f"../cases/{name}", cwd=tmp_path / "work", status=0)
    assert [path.name for path in (tmp_path / "work").iterdir()] == [output]
    assert [path.name for path in (tmp_path / "cases").iterdir()] == [name]
    assert output in run.stdout


@pytest.mark.parametrize("option", ["--output", "-o"])
@pytest.mark.parametrize("output", ["run.h5", "deep er/b c/run 1.h5", "noend", "new\nline.h5"])
def test_output(tiltpad, case, option, output):
    (case / output).parent.mkdir(parents=True, exist_ok=True)
    tiltpad("case.nml", option, output, cwd=case, status=0)
    with h5py.File(case / output) as file:
        assert file.attrs["complete"] == 1
    assert len(list((case / output).parent.glob("*.part*"))) == 0


def test_output_replaces_what_a_link_leads_to(tiltpad, case):
    """A link, to a larger disk say, stays a link."""
    (case / "store").mkdir()
    (case / "case.h5").symlink_to("store/case.h5")
    tiltpad("case.nml", "-o", "store/case.h5", cwd=case, status=0)
    tiltpad("case.nml", cwd=case, status=0)
    assert (case / "case.h5").is_symlink()
    with h5py.File(case / "store" / "case.h5") as file:
        assert file.attrs["complete"] == 1


def test_a_reader_that_goes_away_ends_no_run(program, case):
    """As in: tiltpad case.nml | head -1."""
    run = subprocess.Popen([program, "case.nml"], cwd=case, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    run.stdout.close()
    assert (run.wait(60), run.stderr.read()) == (0, b"")
    run.stderr.close()
    with h5py.File(case / "case.h5") as file:
        assert file.attrs["complete"] == 1


def test_names_of_results_that_end_in_a_blank(tiltpad, case):
    for option in ("--output", "--resume"):
        run = tiltpad("case.nml", option, "case.h5 ", cwd=case, status=1)
        said = f"{option} case.h5 : the name of a file must not end in a blank"
        assert run.stderr == f"tiltpad: error: {said}\n"


def test_quiet(tiltpad, case):
    for option in ("--quiet", "-q"):
        run = tiltpad("case.nml", option, cwd=case)
        assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


def test_input_of_the_result_runs_again(tiltpad, case):
    tiltpad("case.nml", "--set", "case%title='a ''b'' c'", cwd=case, status=0)
    with h5py.File(case / "case.h5") as file:
        text = file.attrs["input"]
        assert file.attrs["title"] == "a 'b' c"
        first = file["journal_y"][:]
    (case / "again.nml").write_text(text)
    tiltpad("again.nml", cwd=case, status=0)
    with h5py.File(case / "again.h5") as file:
        assert file.attrs["input"] == text
        assert (file["journal_y"][:] == first).all()


def test_a_result_that_has_a_grade_and_an_unbalance_goes_on(tiltpad, case):
    """Results once had both, of which the grade held; a case or study that gives both is refused."""
    folder = case
    (folder / "case.nml").write_text("&rotor balance_grade=2.5 /\n" + LONG)
    for given in ("rotor%unbalance=0.02", "sweep%rotor%unbalance=0.02,0.03"):
        said = tiltpad("case.nml", cwd=folder, overrides=[given], status=1).stderr
        assert "rotor%balance_grade = 2.5: rotor%unbalance = 0.02 is given too; give one of them" in said
    tiltpad("case.nml", "-q", cwd=folder, status=0)
    with h5py.File(folder / "case.h5", "r+") as file:
        text = file.attrs["input"]
        assert " unbalance" not in text
        file.attrs["input"] = text.replace("  balance_grade", "  unbalance = 0.01\n  balance_grade")
    tiltpad("--resume", "case.h5", "--verify", "2", "-q", cwd=folder, status=0)


def test_a_log_is_plain_lines(tiltpad, tmp_path, loaded):
    (tmp_path / "case.nml").write_text(LONG)
    run = tiltpad("case.nml", cwd=tmp_path, env=loaded(FAST_CLOCK), status=0)
    assert "\r" not in run.stdout
    assert "\x1b" not in run.stdout
    assert run.stdout.endswith("\n")
    assert re.search(r"^t = \S+ s of 0.02 s, [0-9]+ %, [0-9]+ steps, [0-9]+ s left$", run.stdout, re.M)
    for word in ("equilibrium", "last revolution", "pad 1", "pad 2", "cost", "wall time", "case.h5"):
        assert word in run.stdout
    assert not re.search(r"\*\*|NaN|Infinity", run.stdout)
    assert not re.search(r"(^|[\s-])\.[0-9]", run.stdout), "numbers have a digit before the point"


def test_a_terminal_has_a_line_that_renews_itself(program, tmp_path, loaded):
    (tmp_path / "case.nml").write_text(LONG)
    seen, status = on_a_terminal(program, ["case.nml"], tmp_path, loaded(FAST_CLOCK))
    assert status == 0
    lines = re.findall(r"\r(t = [^\r\n]*)", seen)
    assert len(lines) >= 2
    for line in lines:
        assert re.match(r"t = \S+ s of 0.02 s, [0-9]+ %, [0-9]+ steps, [0-9]+ s left", line), line
    percent = [int(re.search(r"([0-9]+) %", line)[1]) for line in lines]
    assert percent == sorted(percent)
    # it renews itself in place and is gone at the end
    assert "\n" not in seen[seen.index(lines[0]) : seen.rindex(lines[-1])]
    assert re.search(r"\r\x1b\[K[^\r]*last revolution", seen)


def test_quiet_on_a_terminal(program, tmp_path, loaded):
    (tmp_path / "case.nml").write_text(LONG)
    assert on_a_terminal(program, ["--quiet", "case.nml"], tmp_path, loaded(FAST_CLOCK)) == ("", 0)


def test_the_input_reference_is_up_to_date(tiltpad, root):
    said = tiltpad("--reference").stdout
    head = (root / "docs/inputs_head.md").read_text()
    assert (root / "docs/inputs.md").read_text() == head + said, "docs/inputs.md is old: call make docs"


def test_every_option_of_the_help_is_known(tiltpad, case):
    """One that is not is proposed for its own name without its last letter."""
    options = re.findall(r"^  (--[a-z]+)", tiltpad("--help", cwd=case).stdout, re.M) + ["--help"]
    assert len(options) == 16
    for option in options:
        run = tiltpad("case.nml", option + "x", cwd=case)
        assert f"(did you mean {option}?)" in run.stderr


@pytest.mark.parametrize("changes", ["friction%model=lugre", "pads%motion=fixed", "asperity%model=none"])
def test_the_size_of_a_result_is_known_before(tiltpad, tmp_path, changes):
    """But for the spectra, which are small beside the samples, and the rest of the last chunk."""
    (tmp_path / "case.nml").write_text("&operation duration=0.21 / &output spectrum_revolutions=1 /\n")
    said = check(tiltpad, tmp_path, "case.nml", "--set", changes)
    size = float(re.search(r"^!   result +([\d.]+)  MB, 8191 samples$", said, re.M)[1])
    tiltpad("case.nml", "--quiet", "--set", changes, cwd=tmp_path, status=0)
    assert (tmp_path / "case.h5").stat().st_size == pytest.approx(1e6 * size, rel=0.05)
