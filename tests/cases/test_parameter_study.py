"""Parameter studies: counting and checking runs, running side by side, failures, signals, what is refused."""

import os
import re
import resource
import signal
import subprocess
import sys
import time

import h5py
import pytest
from conftest import FAST_CLOCK, TIMEOUT, on_a_terminal, one_error, wait_for

# quick runs; a run of a second or two; and one that does not end by itself
QUICK = "&case task='equilibrium' / &output keep='all' /\n"
LONG = "&operation duration=0.1 / &integration max_step=5e-5 / &output checkpoint_seconds=1e-9 /\n"
ENDLESS = LONG.replace("0.1", "10000")


def varied(*lines, base=QUICK):
    """A case with a study; it starts in the second line."""
    return base + "&sweep\n" + "".join(f"  {line}\n" for line in lines) + "/\n"


def result(run, *, status=0):
    """Standard output and the lines of standard error, which are errors of ours."""
    lines = run.stderr.splitlines()
    assert run.returncode == status, run.stderr
    assert all(line.startswith("tiltpad: error: ") for line in lines), run.stderr
    return run.stdout, [line.removeprefix("tiltpad: error: ") for line in lines]


def files(folder):
    return sorted(path.name for path in folder.iterdir())


def case_value(text, group, name):
    block = re.search(rf"^&{group}\n(.*?)^/$", text, re.M | re.S)[1]
    return plain(re.search(rf"^ *{name} = (.*)$", block, re.M)[1])


def plain(text):
    """A resolved case without the marks of --check, and without what the case does not give."""
    return re.sub(r" +! (default|derived)$|^! remark: not given, .*\n", "", text, flags=re.M)


def last_line(stdout):
    """What a study says at its end; before it, on a busy machine, how far it is."""
    return stdout.splitlines()[-1]


def speed(path):
    """Speed of a result, rpm, as it stands in its input."""
    with h5py.File(path) as file:
        assert file.attrs["complete"] == 1
        assert "&sweep" not in file.attrs["input"]
        return float(case_value(file.attrs["input"], "operation", "speed_rpm"))


# ---- counting and checking -----------------------------------------------------------------------
@pytest.mark.parametrize(
    ("text", "runs"),
    [
        ("&case /\n", 1),
        (varied("operation%speed_rpm = 5000"), 1),
        (varied("operation%speed_rpm = 1000:10000:500"), 19),
        (varied("rotor%mass=1:3:1", "friction%model='none','lugre'", "pads%arc_deg(1)=60,65"), 12),
        (varied("order='zip'", "rotor%mass=1:3:1", "rotor%unbalance=0.1:0.3:0.1"), 3),
        (varied("rotor%mass = 1:1000000:1"), 1000000),
    ],
)
def test_count(tiltpad, case, text, runs):
    folder = case(text)
    assert result(tiltpad("--count", "case.nml", cwd=folder)) == (f"{runs}\n", [])
    assert files(folder) == ["case.nml"]


def test_check_prints_a_case_that_resolves_to_itself(tiltpad, case):
    folder = case(
        varied("operation%speed_rpm=0.1:0.5:0.1, 7", "pads%arc_deg(2)=60, 61", "friction%model='LuGre'")
    )
    text, _ = result(tiltpad("--check", "case.nml", cwd=folder))
    assert text.endswith(
        "/\n&sweep\n  order = 'product'\n  operation%speed_rpm = 0.1:0.5:0.1, 7\n"
        "  pads%arc_deg(2) = 60, 61\n  friction%model = 'LuGre'\n/\n"
    )
    (folder / "again.nml").write_text(text)
    assert result(tiltpad("--check", "again.nml", cwd=folder)) == (text, [])
    for k in range(1, 13):
        first, second = (
            plain(result(tiltpad("--check", "--run", k, name, cwd=folder))[0])
            for name in ("case.nml", "again.nml")
        )
        assert first == second
        assert "&sweep" not in first
    assert files(folder) == ["again.nml", "case.nml"]


def test_members_in_order_and_to_the_last_bit(tiltpad, case):
    folder = case(varied("operation%speed_rpm=0.3:0.9:0.1", "rotor%mass=1e-3:1e1:*10"))
    runs = [(0.3 + i * 0.1, 1e-3 * 10.0**k) for i in range(7) for k in range(5)]
    assert result(tiltpad("--count", "case.nml", cwd=folder)) == (f"{len(runs)}\n", [])
    for k, (rpm, mass) in enumerate(runs, 1):
        text, _ = result(tiltpad("--check", "--run", k, "case.nml", cwd=folder))
        assert float(case_value(text, "operation", "speed_rpm")) == rpm
        assert float(case_value(text, "operation", "final_speed_rpm")) == rpm
        assert float(case_value(text, "rotor", "mass")) == mass


# ---- running -------------------------------------------------------------------------------------
@pytest.mark.parametrize("options", [(), ("--jobs", "1"), ("--jobs", "3"), ("--jobs", "100")])
def test_all_members_run(tiltpad, case, options):
    folder = case(varied("operation%speed_rpm=3000:3400:100"))
    stdout, errors = result(tiltpad("case.nml", *options, cwd=folder))
    assert errors == []
    assert re.fullmatch(r"5 runs: 5 done, 0 failed; [0-9.]+ s; in case\.h5", last_line(stdout))
    assert files(folder) == ["case", "case.h5", "case.nml"]
    assert files(folder / "case") == [f"000{k}.h5" for k in range(1, 6)]
    assert [speed(path) for path in sorted((folder / "case").iterdir())] == [3000, 3100, 3200, 3300, 3400]


def test_a_member_is_the_run_of_its_case(tiltpad, case):
    folder = case("&operation duration=0.01 /\n&sweep operation%speed_rpm=3000:5000:1000 /\n")
    assert result(tiltpad("--quiet", "case.nml", cwd=folder)) == ("", [])
    text, _ = result(tiltpad("--check", "--run", 2, "case.nml", cwd=folder))
    (folder / "second.nml").write_text(text)
    result(tiltpad("second.nml", cwd=folder))
    stdout, _ = result(tiltpad("--run", 2, "case.nml", "--output", "alone", cwd=folder))
    assert "written: alone/0002.h5" in stdout
    assert files(folder / "alone") == ["0002.h5"]
    with (
        h5py.File(folder / "second.h5") as by_itself,
        h5py.File(folder / "alone/0002.h5") as alone,
        h5py.File(folder / "case/0002.h5") as together,
    ):
        for other in (alone, together):
            assert other.attrs["input"] == by_itself.attrs["input"]
            assert (other["journal_y"][:] == by_itself["journal_y"][:]).all()


@pytest.mark.parametrize(
    ("name", "folder"), [("case.nml", "case"), ("a.b.nml", "a.b"), ("\u00fc x.nml", "\u00fc x")]
)
def test_default_folder(tiltpad, tmp_path, name, folder):
    (tmp_path / "work").mkdir()
    (tmp_path / name).write_text(varied("rotor%mass=2000"))
    result(tiltpad(f"../{name}", cwd=tmp_path / "work"))
    assert files(tmp_path / "work") == [folder, f"{folder}.h5"]
    assert files(tmp_path / "work" / folder) == ["0001.h5"]


def test_a_file_says_which_member_it_is(tiltpad, case):
    folder = case(varied("operation%speed_rpm=3000,4000", "friction%model='none','lugre'"))
    result(tiltpad("case.nml", cwd=folder))
    result(tiltpad("case.nml", "--run", 2, "-o", "alone", cwd=folder))
    for path in ("case/0002.h5", "alone/0002.h5"):
        with h5py.File(folder / path) as file:
            assert (file.attrs["run"], file.attrs["runs"]) == (2, 4)
            assert file.attrs["sweep"] == "operation%speed_rpm = 3000\nfriction%model = 'lugre'"


def test_a_second_call_runs_what_is_missing(tiltpad, case):
    folder = case(varied("operation%speed_rpm=3000,4000,5000"))
    (folder / "case").mkdir()
    (folder / "case/notes.txt").write_text("kept")
    result(tiltpad("case.nml", cwd=folder))
    before = {path.name: path.stat() for path in (folder / "case").iterdir()}
    (folder / "case/0002.h5").unlink()
    stdout, _ = result(tiltpad("case.nml", cwd=folder))
    assert last_line(stdout).startswith("3 runs: 3 done, 0 failed; ")
    assert [line.split()[:2] for line in stdout.splitlines()[:-1]] == [["run", "speed_rpm"], ["2", "4000"]]
    for name, status in before.items():
        now = (folder / "case" / name).stat()
        assert (now.st_mtime_ns == status.st_mtime_ns) == (name != "0002.h5")
    assert files(folder / "case") == ["0001.h5", "0002.h5", "0003.h5", "notes.txt"]


WAY_OUT = "; --overwrite replaces it, and --output names another place"


def test_two_studies_are_not_mixed(tiltpad, case):
    """One line before anything runs; with --overwrite the results are replaced."""
    folder = case(varied("operation%speed_rpm=3000,4000,5000"))
    result(tiltpad("case.nml", cwd=folder))
    other = "is the result of another case"
    for change, line in (
        (
            "sweep%operation%speed_rpm=3000:5000:500",
            f"0002.h5: {other}; operation%speed_rpm = 4000 there, 3500 here{WAY_OUT}",
        ),
        ("rotor%mass=1900", f"0001.h5: {other}; rotor%mass = 2000 there, 1900 here{WAY_OUT}"),
        (
            "sweep%operation%speed_rpm=3000,4000",
            "0003.h5: is no run of this study, which has 2; remove it, or name another folder with --output",
        ),
    ):
        before = {path: path.read_bytes() for path in (folder / "case").iterdir()}
        stdout, errors = result(tiltpad("case.nml", "--set", change, cwd=folder), status=3)
        assert (stdout, errors) == ("", [f"case/{line}"])
        assert {path: path.read_bytes() for path in (folder / "case").iterdir()} == before
    faster = ("--set", "sweep%operation%speed_rpm=4000,5000,6000,7000")
    result(tiltpad("case.nml", *faster, "--overwrite", cwd=folder))
    assert [speed(folder / f"case/000{k}.h5") for k in (1, 2, 3, 4)] == [4000, 5000, 6000, 7000]


def test_a_single_member_looks_at_its_neighbours(tiltpad, case):
    folder = case(varied("operation%speed_rpm=3000,4000,5000"))
    result(tiltpad("case.nml", cwd=folder))
    other = ("--set", "sweep%operation%speed_rpm=3000:7000:500")
    _, errors = result(tiltpad("case.nml", "--run", 4, *other, cwd=folder), status=3)
    assert errors == ["case/0003.h5: is of another study than run 4" + WAY_OUT]
    assert len(files(folder / "case")) == 3
    grown = ("--set", "sweep%operation%speed_rpm=3000:7000:1000")
    result(tiltpad("case.nml", "--run", 4, *grown, cwd=folder))
    # nor is it a run of its own
    (folder / "one.nml").write_text(QUICK)
    options = ("--set", "operation%speed_rpm=3000", "--output", "case/0001.h5")
    _, errors = result(tiltpad("one.nml", *options, cwd=folder), status=3)
    assert errors == ["case/0001.h5: is run 1 of a study" + WAY_OUT]


def test_a_study_may_grow(tiltpad, case):
    folder = case(varied("operation%speed_rpm=3000,4000"))
    result(tiltpad("case.nml", cwd=folder))
    before = (folder / "case/0001.h5").read_bytes()
    longer = ("--set", "sweep%operation%speed_rpm=3000,4000,5000")
    assert last_line(result(tiltpad("case.nml", *longer, cwd=folder))[0]).startswith("3 runs: 3 done")
    assert (folder / "case/0001.h5").read_bytes() == before
    assert [speed(folder / f"case/000{k}.h5") for k in (1, 2, 3)] == [3000, 4000, 5000]


def test_the_same_case_in_another_place_is_refused(tiltpad, case):
    """A run of a study over something else, or a run that is none: the file could not tell what it is."""
    folder = case(varied("operation%speed_rpm=6500"))
    result(tiltpad("case.nml", cwd=folder))
    _, errors = result(tiltpad("case.nml", "--set", "sweep%rotor%gravity=9.81", cwd=folder), status=3)
    assert errors[0].endswith(
        "case/0001.h5: is run 1 of another study; operation%speed_rpm = 6500 there, "
        "operation%speed_rpm = 6500, rotor%gravity = 9.81 here" + WAY_OUT
    )
    (folder / "one.nml").write_text(QUICK)
    result(tiltpad("one.nml", "--output", "case/0001.h5", "--overwrite", cwd=folder))
    _, errors = result(tiltpad("case.nml", cwd=folder), status=3)
    assert errors == ["case/0001.h5: is the result of the same case, but no run of a study" + WAY_OUT]


def test_file_names_have_the_digits_of_the_last_member(tiltpad, case):
    folder = case(varied("operation%speed_rpm=1:20000:1"))
    result(tiltpad("--quiet", "--run", 7, "case.nml", cwd=folder))
    result(tiltpad("--quiet", "--run", 20000, "case.nml", cwd=folder))
    assert files(folder / "case") == ["00007.h5", "20000.h5"]


# ---- tables --------------------------------------------------------------------------------------
TABLE = "operation%speed_rpm,friction%model\n3000,none\n4000,lugre\n"


@pytest.fixture
def tabled(case):
    """tabled(text, line): a case with a table in the folder `cases`, and the folder above it."""

    def write(text=TABLE, line="file = 'members.csv'"):
        folder = case(varied(line))
        (folder / "cases").mkdir()
        (folder / "case.nml").rename(folder / "cases/case.nml")
        (folder / "cases/members.csv").write_text(text)
        return folder

    return write


def test_a_table_lies_beside_its_case(tiltpad, tabled):
    """That of --set lies where the program is called."""
    folder = tabled()
    assert result(tiltpad("--count", "cases/case.nml", cwd=folder)) == ("2\n", [])
    (folder / "members.csv").write_text(TABLE + "5000,none\n")
    for name in ("members.csv", folder / "members.csv", "cases/../members.csv"):
        three = ("--set", f"sweep%file='{name}'")
        assert result(tiltpad("--count", "cases/case.nml", *three, cwd=folder)) == ("3\n", [])


def test_rows_are_runs(tiltpad, tabled):
    """Beside a list; the files say all of it, whether or not the table is still there."""
    folder = tabled(line="file = 'members.csv' rotor%mass = 1900, 2000")
    stdout, _ = result(tiltpad("cases/case.nml", "--output", "out", cwd=folder))
    assert last_line(stdout).startswith("4 runs: 4 done, 0 failed; ")
    (folder / "cases/members.csv").unlink()
    expected = [
        (rpm, model, mass) for rpm, model in ((3000, "none"), (4000, "lugre")) for mass in (1900, 2000)
    ]
    for k, (rpm, model, mass) in enumerate(expected, 1):
        with h5py.File(folder / f"out/000{k}.h5") as file:
            lines = f"operation%speed_rpm = {rpm}\nfriction%model = '{model}'\nrotor%mass = {mass}"
            assert (file.attrs["run"], file.attrs["runs"], file.attrs["sweep"]) == (k, 4, lines)
            assert speed(folder / f"out/000{k}.h5") == rpm
            assert case_value(file.attrs["input"], "friction", "model") == f"'{model}'"
    line = "cases/case.nml line 3: sweep%file: cases/members.csv: no such file"
    assert result(tiltpad("cases/case.nml", "--output", "out", cwd=folder), status=1) == ("", [line])


def test_a_checked_case_finds_its_table_from_anywhere(tiltpad, tabled):
    folder = tabled()
    text, _ = result(tiltpad("--check", "cases/case.nml", cwd=folder))
    (folder / "again.nml").write_text(text)
    assert result(tiltpad("--check", "again.nml", cwd=folder)) == (text, [])
    for k in (1, 2):
        first, second = (
            result(tiltpad("--check", "--run", k, name, cwd=folder))[0]
            for name in ("cases/case.nml", "again.nml")
        )
        assert plain(first) == plain(second)


def test_a_table_that_has_changed_is_noticed(tiltpad, tabled):
    """As a list: its runs are others'; rows at the end are new runs."""
    folder = tabled()
    result(tiltpad("cases/case.nml", cwd=folder))
    before = (folder / "case/0001.h5").read_bytes()
    (folder / "cases/members.csv").write_text(TABLE.replace("4000", "4500"))
    _, errors = result(tiltpad("cases/case.nml", cwd=folder), status=3)
    other = "is the result of another case; operation%speed_rpm = 4000 there, 4500 here"
    assert errors == [f"case/0002.h5: {other}{WAY_OUT}"]
    # a single run looks at its neighbours
    _, errors = result(tiltpad("--run", 1, "cases/case.nml", cwd=folder), status=3)
    assert errors == [f"case/0002.h5: is of another study than run 1{WAY_OUT}"]
    # however it is written
    (folder / "cases/members.csv").write_text(TABLE.replace("\n", "\r\n") + '5000,"none"\r\n')
    assert last_line(result(tiltpad("cases/case.nml", cwd=folder))[0]).startswith("3 runs: 3 done")
    assert (folder / "case/0001.h5").read_bytes() == before


@pytest.mark.parametrize("options", [(), ("--check",), ("--count",), ("--run", "1")], ids=" ".join)
@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("", ["members.csv: is empty"]),
        ("sweep%file\na.csv", ["members.csv line 1, column 1: sweep%file cannot be swept; the columns are"]),
        ("swep%file\na.csv", ["column 1: unknown group swep; known: case"]),
        (TABLE.replace(",", ";"), ["members.csv line 1, column 1", "commas must separate the columns"]),
        (TABLE + "5000", ["members.csv line 4", "1 values for 2 columns", "friction%model has none"]),
        (TABLE + "5000,5,none", ["members.csv line 4", "3 values for 2 columns", "decimals have a point"]),
        (TABLE.replace("speed_rpm", "speed"), ["column 1: unknown variable operation%speed", "speed_rpm"]),
        ("\0", ["members.csv: not a text file"]),
    ],
    ids=["empty", "of a study", "no group", "semicolons", "missing", "too many", "unknown", "no text"],
)
def test_table_refused(tiltpad, tabled, text, names, options):
    folder = tabled(text)
    stdout, (line,) = result(tiltpad("cases/case.nml", *options, cwd=folder), status=1)
    assert stdout == ""
    assert all(name in line for name in names), line
    assert files(folder) == ["cases"]


def test_a_bad_cell_is_named_and_nothing_runs(tiltpad, tabled):
    folder = tabled(TABLE + "fast,none\n")
    _, errors = result(tiltpad("cases/case.nml", cwd=folder), status=1)
    where = "cases/members.csv line 4, run 3: operation%speed_rpm = 'fast'"
    assert errors == [f"{where}: must be a number, 0.001 to 1e6 rpm"]
    assert files(folder) == ["cases"]


def test_a_table_that_is_too_large(tiltpad, tabled):
    """It is refused before it is read."""
    folder = tabled()
    os.truncate(folder / "cases/members.csv", 1_000_000_001)
    _, errors = result(tiltpad("--count", "cases/case.nml", cwd=folder), status=1)
    assert errors[0].endswith("cases/members.csv: 1000000001 bytes; a table has at most 1000000000")


# ---- runs that fail ---------------------------------------------------------------------------
def test_a_failing_member_among_good_ones(tiltpad, case):
    values = ("operation%speed_rpm=3000,4000", "integration%max_steps=100000,20")
    folder = case(varied(*values, base="&operation duration=0.01 /\n"))
    stdout, errors = result(tiltpad("case.nml", cwd=folder), status=2)
    assert last_line(stdout).startswith("4 runs: 2 done, 2 failed; ")
    quiet = tiltpad("--quiet", "--jobs", 1, "case.nml", "-o", "Case", cwd=folder)
    assert result(quiet, status=2) == ("", errors)
    again, _ = result(tiltpad("case.nml", cwd=folder), status=2)
    assert last_line(again).startswith("4 runs: 2 done, 2 failed; ")
    assert len(errors) == 3
    for line, k, rpm in zip(errors, (2, 4), (3000, 4000), strict=False):
        start = f"run {k} (operation%speed_rpm = {rpm}, integration%max_steps = 20): "
        assert line.startswith(start)
        assert "after 20 steps" in line
    assert errors[2] == "2 of 4 runs failed"
    for k, complete in enumerate((1, 0, 1, 0), 1):
        with h5py.File(folder / f"case/000{k}.h5") as file:
            assert file.attrs["complete"] == complete


def test_a_file_error_has_its_own_status(tiltpad, case):
    """A folder where one run's file is to be, beside a run whose numerics fail."""
    folder = case(varied("integration%max_steps=20,21,100000", base="&operation duration=0.01 /\n"))
    (folder / "case").mkdir()
    (folder / "case/0003.h5").mkdir()
    _, errors = result(tiltpad("case.nml", cwd=folder), status=3)
    assert errors[2].startswith("run 3 (integration%max_steps = 100000): ")
    assert "case/0003.h5" in errors[2]
    assert errors[3] == "3 of 3 runs failed"


def children(process):
    path = f"/proc/{process.pid}/task/{process.pid}/children"
    if not os.path.exists(path):
        pytest.skip("no list of children here")
    with open(path) as file:
        return [int(word) for word in file.read().split()]


@pytest.fixture
def started(start):
    """started(folder, arguments, runs=2): the program under way, with this many children."""

    def begin(folder, *arguments, runs=1):
        process = start(folder, *arguments)
        wait_for(lambda: len(children(process)) >= runs, process)
        return process

    return begin


def test_a_killed_member_is_a_failed_one_and_the_others_go_on(start, tiltpad, case):
    """The first run is long; it is killed as soon as it says who runs it."""
    durations = "operation%duration=0.2" + 4 * ",0.01"
    folder = case(varied("order='zip'", "rotor%mass=2000:2400:100", durations, base=LONG))
    process = start(folder, "--jobs", "2", "case.nml")
    lock = folder / "case/0001.h5.lock"
    wait_for(lambda: lock.exists() and lock.read_text(), process)
    os.kill(int(lock.read_text().split()[1]), signal.SIGKILL)
    stdout, stderr = process.communicate(timeout=TIMEOUT)
    assert process.returncode == 3
    assert last_line(stdout).startswith("5 runs: 4 done, 1 failed; ")
    line, total = stderr.splitlines()
    run = "run 1 (rotor%mass = 2000, operation%duration = 0.2)"
    assert line == f"tiltpad: error: {run}: ended by signal 9"
    assert total == "tiltpad: error: 1 of 5 runs failed"
    assert all(speed(folder / f"case/000{k}.h5") for k in range(2, 6))
    stdout, _ = result(tiltpad("case.nml", cwd=folder))
    assert last_line(stdout).startswith("5 runs: 5 done, 0 failed; ")
    assert all(speed(folder / f"case/000{k}.h5") for k in range(1, 6))


def test_a_child_runs_many_members_and_leaves_nothing_open(program, tiltpad, case):
    """Few processes for many runs, with hardly more descriptors than one run needs."""
    folder = case(varied("rotor%mass=2000:2119:1"))
    seen = set()
    limit = (24, resource.getrlimit(resource.RLIMIT_NOFILE)[1])
    few = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_NOFILE, limit)}
    with subprocess.Popen([program, "--quiet", "--jobs", "2", "case.nml"], cwd=folder, **few) as process:
        while process.poll() is None:
            seen.update(children(process))
            time.sleep(0.001)
    assert process.returncode == 0
    assert len(files(folder / "case")) == 120
    # fifty runs a child
    assert len(seen) <= 4
    result(tiltpad("--run", 60, "-o", "alone", "case.nml", cwd=folder))
    with h5py.File(folder / "case/0060.h5") as one, h5py.File(folder / "alone/0060.h5") as other:
        assert one["equilibrium/journal_y"][()] == other["equilibrium/journal_y"][()]


@pytest.mark.parametrize("jobs", [1, 3])
def test_as_many_at_a_time_as_asked(start, case, jobs):
    folder = case(varied("rotor%mass=2000:2500:100", base=ENDLESS))
    check_members_at_a_time(start(folder, "--quiet", "--jobs", str(jobs), "case.nml"), folder, jobs)


def test_as_many_at_a_time_as_processors(start, case):
    folder = case(varied("rotor%mass=2000:2500:100", base=ENDLESS))
    one = min(os.sched_getaffinity(0))
    process = start(folder, "--quiet", "case.nml", preexec_fn=lambda: os.sched_setaffinity(0, [one]))
    check_members_at_a_time(process, folder, 1)


def check_members_at_a_time(process, folder, count):
    """This many of runs that do not end run, and no more."""
    results = [folder / f"case/000{k}.h5" for k in range(1, count + 1)]
    wait_for(lambda: all(path.exists() for path in results), process)
    assert len(children(process)) == count
    process.terminate()
    assert f", {count} stopped, {6 - count} not started" in one_error(process, 4)


# ---- signals -------------------------------------------------------------------------------------
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGUSR1])
def test_a_signal_stops_the_study(started, case, number):
    folder = case(varied("rotor%mass=2000:2900:1", base=ENDLESS))
    process = started(folder, "--jobs", "2", "case.nml", runs=2)
    process.send_signal(number)
    stdout, stderr = process.communicate(timeout=TIMEOUT)
    totals = "901 runs: 0 done, 0 failed, 2 stopped, 899 not started"
    assert process.returncode == 4
    assert stderr == f"tiltpad: error: stopped by signal {number.value}; of {totals.replace(':', '')}\n"
    # after a note that the results are large
    assert stdout.splitlines()[1].startswith(totals)


def test_stopped_members_go_on_at_the_second_call(started, tiltpad, case):
    folder = case(varied("rotor%mass=2000,2100", base=LONG))
    whole = {}
    for output in ("stopped", "through"):
        if output == "stopped":
            process = started(folder, "--jobs", "2", "case.nml", "-o", output, runs=2)
            wait_for(lambda: all((folder / f"stopped/000{k}.h5").exists() for k in (1, 2)), process)
            process.terminate()
            assert "2 stopped" in one_error(process, 4)
        stdout, _ = result(tiltpad("case.nml", "-o", output, cwd=folder))
        assert last_line(stdout).startswith("2 runs: 2 done, 0 failed; ")
        for k in (1, 2):
            with h5py.File(folder / output / f"000{k}.h5") as file:
                assert file.attrs["complete"] == 1
                assert file.attrs["resumes"] == (output == "stopped")
                whole[output, k] = file["journal_y"][:]
    for k in (1, 2):
        assert whole["stopped", k].shape == whole["through", k].shape


def test_members_end_with_the_program(started, case):
    """Nobody is left behind by a program that is killed."""
    folder = case(varied("rotor%mass=2000,2100", base=ENDLESS))
    process = started(folder, "--quiet", "--jobs", "2", "case.nml", runs=2)
    runs = children(process)
    process.kill()
    wait_for(lambda: not any(running(run) for run in runs))


def running(process):
    """False once a process has ended, whether or not anybody took note of that."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


# ---- what is printed -----------------------------------------------------------------------------
def test_a_terminal_has_one_line_for_all_members(program, case, loaded):
    base = "&operation duration=0.001 /\n"
    folder = case(varied("rotor%mass=2000:2900:100", "integration%max_steps=100000,1", base=base))
    arguments = "--jobs", "1", "case.nml"
    text, status = on_a_terminal(program, arguments, folder, loaded(FAST_CLOCK), subprocess.DEVNULL)
    assert status == 2
    lines = re.findall(r"\r(\d[^\r\n]*)\x1b", text)
    assert len(lines) >= 2
    for line in lines:
        assert re.fullmatch(r"\d+ of 20 runs, \d+ failed, [\d.]+ runs/s(, \d+ s left)?", line), line
    counts = [int(line.split()[0]) for line in lines]
    assert counts == sorted(counts)
    assert "\n" not in text[: text.index("  run  mass")]
    assert "\r\x1b[K  run  mass" in text
    assert re.search(r"\r\n20 runs: 10 done, 10 failed; [0-9.]+ s; in case\.h5\r\n$", text)


def test_a_study_ends_with_a_table(tiltpad, case):
    """Of the first and the last runs what varied and what the file says of them."""
    base = "&case task='coefficients' /\n"
    folder = case(varied("operation%speed_rpm=3000:4000:50", "rotor%static_load(1)=0", base=base))
    stdout, _ = result(tiltpad("case.nml", cwd=folder))
    lines = stdout.splitlines()[:-1]
    assert all(len(line) <= 118 for line in lines)
    assert lines[9] == "  ..."
    head, *rows = [line.split() for line in lines[:9] + lines[10:]]
    assert [int(row[0]) for row in rows] == [*range(1, 9), *range(14, 22)]
    assert head[:3] == ["run", "speed_rpm", "static_load(1)"]
    with h5py.File(folder / "case.h5") as study:
        of = {name: study[name][:] for name in ("speed_rpm", "equilibrium_min_film_thickness", "stiffness")}
        stable = study["equilibrium_rotor_stable"][:]
    names = re.sub(r" um| MN/m| kN s/m| dec", "", " ".join(head)).split()
    for row in rows:
        k = int(row[0]) - 1
        shown = dict(zip(names, row[:-1], strict=False))
        assert float(shown["speed_rpm"]) == of["speed_rpm"][k]
        film = 1e6 * of["equilibrium_min_film_thickness"][k]
        assert float(shown["film"]) == pytest.approx(film, rel=1e-3)
        assert float(shown["K_yy"]) == pytest.approx(1e-6 * of["stiffness"][k, 0, 0, 0, 0], rel=1e-3)
        assert row[-1] == ("stable" if stable[k] else "unstable")


def test_the_table_says_why_a_run_has_nothing(tiltpad, case):
    folder = case(varied("integration%max_steps=100000,1", base="&operation duration=0.001 /\n"))
    lines = result(tiltpad("case.nml", cwd=folder), status=2)[0].splitlines()
    assert lines[0].split()[:2] == ["run", "max_steps"]
    assert lines[2].split()[:3] == ["2", "1", "-"]
    assert "the march gave up" in lines[2]
    assert result(tiltpad("case.nml", "-q", "--overwrite", "-o", "quiet", cwd=folder), status=2)[0] == ""


def test_nothing_is_printed_twice(tiltpad, case):
    """Output that waits to be written when a child is made is written once."""
    folder = case(varied("rotor%mass=2000:2900:100"))
    stdout, _ = result(tiltpad("case.nml", cwd=folder))
    lines = stdout.splitlines()
    assert len(lines) == len(set(lines)) == 12


# ---- what is refused -----------------------------------------------------------------------------
@pytest.fixture
def refused(tiltpad, tmp_path):
    """refused("case.nml", names=("mass",)): a run in the folder of the case that must be refused."""

    def run(*arguments, names=(), status=1):
        before = sorted(tmp_path.rglob("*"))
        done = tiltpad(*arguments, cwd=tmp_path, status=status)
        assert done.stdout == ""
        for name in names:
            assert name in done.stderr
        assert sorted(tmp_path.rglob("*")) == before

    return run


# of the study itself: line, what the message must name; more in tests/unit/test_parameter_study.f90
STUDIES = {
    "": ["line 2", "&sweep"],
    "order='zip', rotor%mass=1,2, rotor%gravity=1": ["zip", "rotor%mass has 2", "rotor%gravity has 1"],
    "rotor%mass=1:2": ["line 3", "rotor%mass = 1:2", "first:last:stride"],
}


@pytest.mark.parametrize("line", STUDIES, ids=lambda line: line or "empty")
@pytest.mark.parametrize("options", [(), ("--check",), ("--count",), ("--run", "1")], ids=" ".join)
def test_study_refused(refused, case, line, options):
    """Whatever is asked for, also where the study is not run."""
    case(varied(*line.split(", ")) if line else "\n&sweep /\n")
    refused("case.nml", *options, names=["case.nml", *STUDIES[line]])


@pytest.mark.parametrize("options", [(), ("--check",)], ids=" ".join)
@pytest.mark.parametrize(
    ("line", "names"),
    [
        ("rotor%mass=1:3:1, -1", ["line 3, run 4", "rotor%mass = -1", "1e-6 to"]),
        ("friction%dynamic_coefficient=0.1,0.2", ["run 2", "friction%static_coefficient"]),
    ],
)
def test_a_bad_member_is_named_and_nothing_runs(refused, case, options, line, names):
    case(varied(line))
    refused("case.nml", *options, names=names)


def test_only_the_member_that_runs_must_be_good(tiltpad, refused, case):
    folder = case(varied("rotor%mass=2000,-1"))
    result(tiltpad("--run", 1, "case.nml", cwd=folder))
    refused("--run", 2, "case.nml", names=["line 3, run 2: rotor%mass = -1"])


# command lines: arguments, what the message must name
LINES = {
    "run beyond the last": (["--run", "3"], ["--run 3", "1 to 2"]),
    "run zero": (["--run", "0"], ["--run 0", "whole number"]),
    "run by name": (["--run", "first"], ["--run first", "whole number"]),
    "run too large": (["--run", "99999999999"], ["--run 99999999999", "whole number"]),
    "no jobs": (["--jobs", "0"], ["--jobs 0", "whole number"]),
    "negative jobs": (["--jobs", "-2"], ["--jobs -2", "whole number"]),
    "half a job": (["--jobs", "0.5"], ["--jobs 0.5", "whole number"]),
    "empty number": (["--jobs", ""], ["--jobs", "whole number"]),
    "count and check": (["--count", "--check"], ["--count", "--check"]),
    "jobs and a run": (["--jobs", "2", "--run", "1"], ["--jobs", "--run"]),
    "jobs and count": (["--jobs", "2", "--count"], ["--jobs", "--count"]),
    "count and run": (["--count", "--run", "1"], ["--count", "--run"]),
    "set of what is varied": (
        ["--set", "rotor%mass=1"],
        ["--set rotor%mass = 1", "swept", "case.nml line 3", "--set sweep%rotor%mass="],
    ),
    "bad study by set": (["--set", "sweep%rotor%gravity=1:2:-1"], ["--set", "sweep%rotor%gravity = 1:2:-1"]),
    "bad run by set": (["--set", "sweep%rotor%mass=1,-1"], ["--set, run 2", "rotor%mass = -1"]),
    "bad order by set": (["--set", "sweep%order='all'"], ["--set", "sweep%order = 'all'"]),
    "resume of a study": (["--resume", "case.h5"], ["--resume", "case.nml"]),
    "output is the case": (["--output", "case.nml"], ["case.nml", "replace"]),
}


@pytest.mark.parametrize("key", LINES)
def test_command_line(refused, case, key):
    arguments, names = LINES[key]
    case(varied("rotor%mass=1000,2000"))
    refused("case.nml", *arguments, names=names)


@pytest.mark.parametrize("option", ["--run", "--jobs"])
def test_a_case_without_a_study(refused, case, option):
    """With the option's value, and without."""
    case(QUICK)
    refused("case.nml", option, 1, names=["case.nml", "&sweep", option])
    refused("case.nml", option, names=[option, "value"])


def test_folder_that_cannot_be(refused, case):
    folder = case(varied("rotor%mass=1000,2000"))
    (folder / "file").write_text("a file")
    outputs = {"none/runs": "no such file", "file": "not a directory", "file/runs": "not a directory"}
    if os.path.isdir("/proc/self"):
        outputs["/proc"] = ""
    outputs[300 * "x"] = "too long"
    for output, reason in outputs.items():
        for options in ((), ("--run", "2")):
            refused("case.nml", *options, "-o", output, names=["folder", output, reason], status=3)


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_folder_that_is_shut(refused, case):
    folder = case(varied("rotor%mass=1000,2000"))
    (folder / "shut").mkdir(mode=0o500)
    refused("case.nml", "-o", "shut", names=["shut", "ermission"], status=3)


def test_default_folder_is_the_case_itself(refused, tmp_path):
    (tmp_path / "noend").write_text(varied("rotor%mass=1000,2000"))
    refused("noend", names=["noend"])


# prints the most memory that a command took, kilobytes; a child begins with its parent's
MEMORY = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""


def test_members_leave_nothing_in_memory(program, tiltpad, tmp_path):
    """Less than a kilobyte each, a tenth of what the assignments take that each is made from."""
    (tmp_path / "one.nml").write_text("&case /\n")
    whole = tiltpad("--check", "one.nml", cwd=tmp_path).stdout
    most = {}
    for runs in (1, 500):
        (tmp_path / "case.nml").write_text(f"{whole}&sweep rotor%mass=1001:{1000 + runs}:1 /\n")
        command = [sys.executable, "-S", "-c", MEMORY, program, "--check", "case.nml"]
        most[runs] = int(subprocess.run(command, cwd=tmp_path, capture_output=True, check=True).stdout)
    assert most[500] - most[1] < 500


def test_a_terminal_asks_for_yes_before_a_gigabyte(program, tmp_path):
    """200 runs of 18 MB are refused there before anything is written."""
    (tmp_path / "large.nml").write_text("&sweep rotor%mass = 1001:1200:1 /")
    said, status = on_a_terminal(program, ["large.nml"], tmp_path, dict(os.environ))
    assert status == 1
    assert said.startswith(
        "tiltpad: error: large.nml: about 3.6 GB of results, 78001 samples in each of 200 files"
    )
    assert said.rstrip().endswith("--yes performs them all the same")
    assert [each.name for each in tmp_path.iterdir()] == ["large.nml"]
