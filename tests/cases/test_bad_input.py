"""Bad input is refused at once: exit status, one line that names the culprit, nothing left behind."""

import os
import resource
import stat
import subprocess

import pytest

# what only a runtime library, a signal handler or HDF5 would print
TRACE = ("At line", "Fortran runtime", "HDF5-DIAG", "Backtrace", "Program received", "forrtl")
RESULT = b"the result of an earlier run"


def snapshot(folder):
    """Every path below a folder with its kind, and the bytes of the files."""
    found = {}
    for path in sorted(folder.rglob("*")):
        mode = path.lstat().st_mode
        found[str(path)] = (stat.S_IFMT(mode), path.read_bytes() if stat.S_ISREG(mode) else b"")
    return found


def refused(tiltpad, folder, *arguments, names=(), status=1, **options):
    """Runs the program in a folder with an earlier result in it and checks that it refuses."""
    (folder / "case.h5").write_bytes(RESULT)
    before = snapshot(folder)
    run = tiltpad(*arguments, cwd=folder, errors="replace", **options)
    allowed = status if isinstance(status, tuple) else (status,)
    assert run.returncode in allowed, run.stderr
    assert run.stdout == ""
    assert run.stderr.endswith("\n"), run.stderr
    assert run.stderr.count("\n") == 1, run.stderr
    assert run.stderr.startswith("tiltpad: error: ")
    for name in names:
        assert name in run.stderr
    for word in TRACE:
        assert word not in run.stderr
    assert snapshot(folder) == before
    return run.stderr


# one value that is not allowed: assignment in its group, what the message must name
VALUES = [
    ("rotor", "mass=-1", "1e-6 to"),
    ("rotor", "mass=0", "1e-6 to"),
    ("rotor", "mass=nan", "finite"),
    ("rotor", "mass=NaN", "finite"),
    ("rotor", "mass=inf", "finite"),
    ("rotor", "mass=-Infinity", "finite"),
    ("rotor", "mass=1e400", "finite"),
    ("rotor", "mass=1e99999", "finite"),
    ("rotor", "mass=1e-400", "1e-6 to"),
    ("rotor", "mass=1+2", "number"),
    ("rotor", "mass=0x10", "number"),
    ("rotor", "mass=z'10'", "value|number|at most 1"),
    ("rotor", "mass=1_8", "number"),
    ("rotor", "mass=1q3", "number"),
    ("rotor", "mass=1.5.2", "number"),
    ("rotor", "mass=.", "number"),
    ("rotor", "mass=1e", "number"),
    ("rotor", "mass=--1", "number"),
    ("rotor", "mass=.true.", "number"),
    ("rotor", "mass=(1)", "number"),
    ("rotor", "mass=2000kg", "number"),
    ("rotor", "mass='2000'", "number"),
    ("rotor", "mass=heavy", "number"),
    ("rotor", "mass=1,2", "takes one value"),
    ("rotor", "mass=2*3", "at most 1"),
    ("rotor", "mass=0*3", "number"),
    ("rotor", "mass=3*", "number"),
    ("rotor", "mass=", "value is missing"),
    ("rotor", "mass=3,,", "value is missing"),
    ("rotor", "mass(2)=3", "at most 1"),
    ("rotor", "unbalance=-0.01", "0 to"),
    ("rotor", "gravity=-9.81", "0 to"),
    ("rotor", "static_load=1", "2 values"),
    ("rotor", "static_load=1,2,3", "at most 2"),
    ("operation", "speed_rpm=0", "0.001 to"),
    ("operation", "speed_rpm=-6500", "0.001 to"),
    ("operation", "duration=0", "1e-9 to"),
    ("bearing", "journal_radius=0", "to 10"),
    ("bearing", "journal_radius=49.9", "to 10"),
    ("bearing", "machined_clearance=0", "1e-9 to"),
    ("bearing", "assembled_clearance=-80e-6", "1e-9 to"),
    ("bearing", "preload=1", "-1 to 0.999"),
    ("bearing", "axial_length=0", "1e-5 to"),
    ("bearing", "viscosity=0", "to 10"),
    ("bearing", "viscosity=19", "to 10"),
    ("oil", "grade='VG46'", "0 to 3200"),
    ("oil", "supply_temperature=-274", "-100 to 500"),
    ("oil", "temperature_exponent=-0.03", "0 to 1"),
    ("thermal", "model='pads'", "pad"),
    ("pads", "arc_deg=0", "to 360"),
    ("pads", "arc_deg=60,60,60", "at most 2"),
    ("pads", "arc_deg(3)=60", "at most 2"),
    ("pads", "pivot_ratio=1", "to 0.99"),
    ("pads", "pivot_angle_deg=25*0", "24"),
    ("pads", "mass=-0.8", "1e-9 to"),
    ("pads", "density=0", "1 to"),
    ("pads", "thickness=1.5", "to 1"),
    ("pads", "inertia=0", "1e-15 to"),
    ("pads", "motion='tilting'", "tilting_radial"),
    ("pivot", "young_modulus=210,210", " to "),
    ("pivot", "poisson_ratio=0.6,0.3", "to 0.5"),
    ("pivot", "socket_radius=0", "1e-5 to"),
    ("pivot", "radius_difference=-15e-6", "0 to"),
    ("pivot", "law='hertzian'", "fang"),
    ("friction", "model='lugree'", "bengisu_akay"),
    ("friction", "model=''", "lugre"),
    ("friction", "model=1", "lugre"),
    ("friction", "static_coefficient=0", "to 10"),
    ("friction", "dynamic_coefficient=-0.1", "0 to"),
    ("friction", "critical_velocity=0", "to 10"),
    ("film", "circumferential_cells=60.0", "whole"),
    ("film", "circumferential_cells=6e1", "whole"),
    ("film", "circumferential_cells=3000000000", "2000"),
    ("film", "circumferential_cells=-8", "2000"),
    ("film", "axial_cells=2.5", "whole"),
    ("film", "max_sweeps=0", "1 to"),
    ("film", "relaxation=2", "1.999"),
    ("film", "cavitation='jfo'", "reynolds"),
    ("film", "solver='multigrid'", "sor"),
    ("integration", "relative_tolerance=0", "to 0.01"),
    ("integration", "max_step=-1", "0 to"),
    ("output", "samples_per_revolution=0", "1 to"),
    ("output", "start_time=-1", "0 to"),
    ("case", "task='run'", "equilibrium"),
    ("case", "title=untitled", "quotes"),
    ("case", "title=3", "quotes"),
]


@pytest.mark.parametrize(("group", "assignment", "allowed"), VALUES, ids=lambda text: text[:40])
def test_value(tiltpad, tmp_path, group, assignment, allowed):
    (tmp_path / "case.nml").write_text(f"&{group}\n  {assignment}\n/\n")
    name = assignment.split("=")[0]
    message = refused(tiltpad, tmp_path, "case.nml", names=["case.nml line 2", f"{group}%{name}"])
    assert any(word in message for word in allowed.split("|"))


# values that do not fit together: case, what the message must name
TOGETHER = {
    "odd cells": ("&film circumferential_cells=61 /", ["film%circumferential_cells", "61", "even"]),
    "dynamic above static": (
        "&friction static_coefficient=0.1, dynamic_coefficient=0.2 /",
        ["friction%dynamic_coefficient", "0.2", "friction%static_coefficient", "0.1"],
    ),
    "lugre that never slides": (
        "&friction model='lugre', dynamic_coefficient=0 /",
        ["friction%dynamic_coefficient", "> 0", "lugre"],
    ),
    "samples after the end": (
        "&operation duration=1 / &output start_time=2 /",
        ["output%start_time", "2", "operation%duration", "1"],
    ),
    "hertz in a snug socket": (
        "&pivot law='hertz', radius_difference=0 /",
        ["pivot%radius_difference", "> 0", "hertz"],
    ),
    "ball half the socket": (
        "&pivot socket_radius=13e-3, radius_difference=12e-3 /",
        ["pivot%radius_difference", "pivot%socket_radius"],
    ),
    "overlapping pads": (
        "&pads pivot_angle_deg=-45,0 /",
        ["pads%pivot_angle_deg", "-45", "overlap", "pads 1 and 2"],
    ),
    "pads in one place": (
        "&pads pivot_angle_deg=0,360, arc_deg=1 /",
        ["pads%pivot_angle_deg", "360", "overlap"],
    ),
    "pads too long": ("&pads arc_deg=200 /", ["pads%arc_deg", "overlap"]),
    "too many cells for elimination": (
        "&film circumferential_cells=2000, axial_cells=1000 /",
        ["film%axial_cells = 1000", "at most 223", "film%circumferential_cells = 2000", "'sor'"],
    ),
    "preload and clearance": (
        "&bearing preload=0.3, machined_clearance=1e-4 /",
        ["bearing%preload = 0.3", "bearing%machined_clearance = 1e-4", "give one of them"],
    ),
    "preload too high": (
        "&bearing preload=0.999, assembled_clearance=2e-4 /",
        ["bearing%preload = 0.999", "bearing%machined_clearance = 0.2", "1e-5 to 0.05", "= 0.0499"],
    ),
    "mass and density": (
        "&pads mass=1, density=7850 /",
        ["pads%density = 7850", "pads%mass = 1", "give one of them"],
    ),
    "thickness of no use": (
        "&pads mass=1, inertia=1, centre_tangential=0, centre_radial=0, thickness=0.1 /",
        ["pads%thickness = 0.1", "no effect"],
    ),
    "mass of a grain": (
        "&bearing journal_radius=1e-3, axial_length=1e-3 / &pads density=1, thickness=1e-5 /",
        ["pads%mass", "from the size of the pad", "1e-9 to 1e9"],
    ),
    "inertia below mass": ("&pads mass=8.108 /", ["pads%inertia", "pad 1"]),
    "values for more pads": ("&pads pivot_angle_deg=0,120,240, mass=1,2 /", ["pads%mass", "1, 2", "3"]),
    "clearance in mm": (
        "&bearing machined_clearance=0.1 /",
        ["bearing%machined_clearance", "bearing%journal_radius"],
    ),
    "loose pads": (
        "&bearing assembled_clearance=1e-3 /",
        ["bearing%assembled_clearance", "machined_clearance"],
    ),
    "length in mm": ("&bearing axial_length=100 /", ["bearing%axial_length", "bearing%journal_radius"]),
    "rupture above supply": (
        "&bearing cavitation_pressure=1e5 /",
        ["bearing%cavitation_pressure", "supply_pressure"],
    ),
    "too many samples": (
        "&operation duration=1e6 / &output samples_per_revolution=1000000 /",
        ["operation%duration", "output%samples_per_revolution"],
    ),
    "balanced at rest": (
        "&rotor balance_grade=2.5, balance_speed_rpm=0 /",
        ["rotor%balance_speed_rpm", "0"],
    ),
}


@pytest.mark.parametrize("key", TOGETHER)
def test_values_together(tiltpad, tmp_path, key):
    text, names = TOGETHER[key]
    (tmp_path / "case.nml").write_text(text + "\n&integration max_steps=20 /\n")
    refused(tiltpad, tmp_path, "case.nml", names=["case.nml", *names])


# text that is no namelist of ours
TEXTS = {
    "empty": ("", ["no namelist group"]),
    "blank": (" \n\t\n", ["no namelist group"]),
    "comment only": ("! nothing but this\n", ["no namelist group"]),
    "unknown group": ("&motor\n mass=1\n/\n", ["line 1", "&motor", "rotor"]),
    "unknown empty group": ("&motor /\n", ["line 1", "&motor", "rotor"]),
    "group without name": ("& mass=1 /\n", ["line 1", "group"]),
    "unknown variable": ("&rotor\n weight=1\n/\n", ["line 2", "rotor%weight", "mass"]),
    "variable of another group": ("&rotor\n viscosity=1\n/\n", ["line 2", "rotor%viscosity"]),
    "group twice": ("&rotor mass=1 /\n&rotor gravity=1 /\n", ["line 2", "&rotor", "twice", "line 1"]),
    "variable twice": ("&rotor\n mass=1\n mass=2\n/\n", ["line 3", "rotor%mass", "twice", "line 2"]),
    "variable twice, other case": ("&rotor\n mass=1\n MASS=2\n/\n", ["line 3", "rotor%mass", "twice"]),
    "element and whole": ("&pads\n arc_deg(2)=30\n arc_deg=60\n/\n", ["line 3", "pads%arc_deg"]),
    "unclosed group": ("&rotor\n mass=1\n", ["line 1", "&rotor", "closed"]),
    "group in a group": ("&rotor\n mass=1\n&pads /\n", ["line 1", "&rotor", "closed"]),
    "unclosed quote": ("&case\n title='a b\n/\n", ["line 2", "case%title", "quote"]),
    "unclosed quote of a word": ("&friction model='lugre /\n", ["line 1", "friction%model", "quote"]),
    "title over two lines": ("&case title='one\ntwo' /\n", ["line 1", "case%title", "quote"]),
    "no equals sign": ("&rotor\n mass 1\n/\n", ["line 2", "mass", "name = value"]),
    "colon for equals": ("&rotor\n mass: 1\n/\n", ["line 2", "mass", "name = value"]),
    "value without name": ("&rotor\n = 1\n/\n", ["line 2", "name = value"]),
    "two equals signs": ("&rotor\n mass == 1\n/\n", ["line 2", "rotor%mass"]),
    "text before": ("mass=1\n&rotor /\n", ["line 1", "'mass'", "outside a group"]),
    "text after": ("&rotor /\nmass=1\n", ["line 2", "'mass'", "outside a group"]),
    "subscript zero": ("&pads arc_deg(0)=60 /\n", ["line 1", "arc_deg(0)"]),
    "subscript text": ("&pads arc_deg(a)=60 /\n", ["line 1", "arc_deg(a)"]),
    "subscript range": ("&pads arc_deg(1:2)=60 /\n", ["line 1", "arc_deg(1:2)"]),
    "json": ('{"rotor": {"mass": 1}}\n', ["line 1", "outside a group"]),
    "nul": ("&rotor mass=1\0 /\n", ["not a text file"]),
}


@pytest.mark.parametrize("key", TEXTS)
def test_text(tiltpad, tmp_path, key):
    text, names = TEXTS[key]
    (tmp_path / "case.nml").write_text(text)
    refused(tiltpad, tmp_path, "case.nml", names=["case.nml", *names])


def test_binary_file(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_bytes(bytes(range(256)) * 4)
    refused(tiltpad, tmp_path, "case.nml", names=["case.nml", "not a text file"])


def test_result_file_for_a_case(tiltpad, tmp_path):
    (tmp_path / "other.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(64))
    refused(
        tiltpad,
        tmp_path,
        "other.h5",
        names=["other.h5: a result or study (an HDF5 file), where a case belongs"],
    )


@pytest.mark.parametrize(
    "text",
    [
        "&rotor mass=" + 200000 * "3," + "3 /",
        "&pads arc_deg=" + 100000 * " 24*3" + " /",
        "".join(f"&g{i} /\n" for i in range(20000)),
        "&rotor " + "".join(f"v{i}=1\n" for i in range(20000)) + "/",
    ],
    ids=["values", "repeats", "groups", "variables"],
)
def test_a_huge_file_is_refused(tiltpad, tmp_path, text):
    (tmp_path / "case.nml").write_text(text)
    refused(tiltpad, tmp_path, "case.nml", names=["case.nml"])


def test_directory_for_a_case(tiltpad, tmp_path):
    (tmp_path / "case.nml").mkdir()
    refused(tiltpad, tmp_path, "case.nml", names=["case.nml", "irectory", "tiltpad-collect"], status=(1, 3))


def test_no_such_case(tiltpad, tmp_path):
    refused(tiltpad, tmp_path, "other.nml", names=["other.nml", "no such file"], status=(1, 3))


def test_link_in_a_circle(tiltpad, tmp_path):
    (tmp_path / "case.nml").symlink_to("case.nml")
    refused(tiltpad, tmp_path, "case.nml", names=["case.nml"], status=(1, 3))


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_unreadable_case(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text("&case /\n")
    (tmp_path / "case.nml").chmod(0)
    run = tiltpad("case.nml", cwd=tmp_path)
    assert run.returncode in (1, 3)
    assert run.stderr.startswith("tiltpad: error: case.nml: ")
    assert run.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["case.nml"]


# output that cannot be written: what stands in the way, the name, what the message must name.
# An output that cannot be is refused before anything is computed.
SHORT = ("--set", "operation%duration=1e-4")


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.nml").write_text("&case /\n")
    return tmp_path


def test_output_in_no_directory(tiltpad, case):
    refused(
        tiltpad,
        case,
        "case.nml",
        *SHORT,
        "--output",
        "none/run.h5",
        names=["cannot write none/run.h5: there is no folder none/"],
        status=3,
    )


def test_output_below_a_file(tiltpad, case):
    refused(
        tiltpad, case, "case.nml", *SHORT, "--output", "case.nml/run.h5", names=["case.nml/run.h5"], status=3
    )


def test_output_is_a_directory(tiltpad, case):
    (case / "run.h5").mkdir()
    refused(tiltpad, case, "case.nml", *SHORT, "--output", "run.h5", names=["run.h5", "irectory"], status=3)


def test_output_is_a_directory_quietly(tiltpad, case):
    (case / "run.h5").mkdir()
    refused(tiltpad, case, "case.nml", *SHORT, "--quiet", "--output", "run.h5", names=["run.h5"], status=3)


def test_output_name_too_long(tiltpad, case):
    refused(tiltpad, case, "case.nml", *SHORT, "--output", 300 * "x" + ".h5", names=["xxx.h5"], status=3)


def test_output_in_a_place_that_takes_no_files(tiltpad, case):
    if not os.path.isdir("/proc/self"):
        pytest.skip("no /proc here")
    refused(tiltpad, case, "case.nml", *SHORT, "--output", "/proc/run.h5", names=["/proc/run.h5"], status=3)


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_output_in_a_read_only_directory(tiltpad, case):
    (case / "shut").mkdir(mode=0o500)
    refused(tiltpad, case, "case.nml", *SHORT, "--output", "shut/run.h5", names=["shut/run.h5"], status=3)


def test_output_is_a_pipe(tiltpad, case):
    """A pipe, and likewise a device such as the null device, is not replaced by a file."""
    os.mkfifo(case / "run.h5")
    refused(tiltpad, case, "case.nml", *SHORT, "--output", "run.h5", names=["run.h5"], status=3)


@pytest.mark.parametrize("output", ["case.nml", "./case.nml", "linked.h5"])
def test_output_is_the_case_itself(tiltpad, case, output):
    (case / "linked.h5").symlink_to("case.nml")
    refused(tiltpad, case, "case.nml", *SHORT, "--output", output, names=[output], status=(1, 3))


def test_default_output_is_the_case_itself(tiltpad, tmp_path):
    (tmp_path / "input.h5").write_text("&case /\n")
    refused(tiltpad, tmp_path, "input.h5", *SHORT, names=["input.h5"], status=(1, 3))


@pytest.mark.parametrize("duration", ["1e-4", "0.05"])
def test_disk_full(tiltpad, case, duration):
    """A limit on the size of files stands for a disk that is full."""

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

    message = refused(
        tiltpad, case, "case.nml", "--quiet", "-o", "full.h5", "--set", f"operation%duration={duration}",
        names=["full.h5"], status=3, preexec_fn=limit,
    )  # fmt: skip
    assert "full" in message or "too large" in message.lower()


def test_disk_full_for_standard_output(program, case):
    if not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full here")
    with open("/dev/full", "w") as full:
        run = subprocess.run(
            [program, "--check", "case.nml"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=case,
        )
    assert run.returncode == 3
    assert run.stderr.startswith("tiltpad: error: ")
    assert run.stderr.count("\n") == 1


# --set: argument, what the message must name
OVERRIDES = {
    "": ["group%name=value"],
    "mass=3": ["mass=3", "group%name=value"],
    "%mass=3": ["%mass=3", "group%name=value"],
    "rotor%mass": ["rotor%mass", "group%name=value"],
    "rotor%=3": ["rotor%=3"],
    "a=b%c=3": ["a=b%c=3"],
    "rotor%mass=": ["rotor%mass", "value is missing"],
    "rotor%mass=3 gravity=4": ["rotor%mass=3 gravity=4", "one group%name=value"],
    "rotor%mass=3, gravity=4": ["rotor%mass=3, gravity=4", "one group%name=value"],
    "rotor%mass=3 / &pads mass=1": ["rotor%mass=3 / &pads mass=1", "one group%name=value"],
    "rotor%mass=3 / mass=4": ["rotor%mass=3 / mass=4", "one group%name=value"],
    "rotor%mass=3/": ["rotor%mass=3/"],
    "rotor%mass=-3": ["rotor%mass = -3", "1e-6 to"],
    "rotor%mass=1+2": ["rotor%mass = 1+2", "number"],
    "rotor%weight=3": ["rotor%weight", "mass"],
    "motor%mass=3": ["motor", "rotor"],
    "friction%model='lugree'": ["friction%model = 'lugree'", "lugre"],
    "case%title='open": ["case%title", "quote"],
    "output%start_time=3": ["output%start_time = 3", "operation%duration"],
    "rotor%mas\ns=3": ["--set", "name = value"],
    "rotor%mass=3 !\n4": ["--set"],
    "case%title='\x1b[2J'": ["--set case%title=", "control character"],
    "case%title='a\rb'": ["--set case%title=", "control character"],
    "friction%model='none lugre'": ["friction%model = 'none lugre'", "must be one of"],
}


@pytest.mark.parametrize("override", OVERRIDES)
def test_override(tiltpad, case, override):
    names = OVERRIDES[override]
    refused(tiltpad, case, "case.nml", *SHORT, "--set", override, names=names)


def test_a_text_of_set_needs_no_quotes_but_for_blanks_and_slashes(tiltpad, case):
    done = tiltpad("--check", "case.nml", "--set", "case%title=a_word", cwd=case)
    assert "\n  title = 'a_word'\n" in done.stdout
    for text, names in (("two words", ["takes one text, in quotes"]), ("a/b", ["\"group%name='a/b'\""])):
        refused(tiltpad, case, "case.nml", "--set", f"case%title={text}", names=["case%title", *names])


def test_override_too_long(tiltpad, case):
    refused(tiltpad, case, "case.nml", "--set", f"case%title='{10000 * 'x'}'", names=["--set", "too long"])


def test_override_that_is_not_utf_8(tiltpad, case):
    refused(tiltpad, case, "case.nml", "--set", "case%title='\udcff'", names=["--set", "case%title", "UTF-8"])


def test_more_overrides_than_any_case_has(tiltpad, case):
    many = 5000 * ("--set", "rotor%mass=1")
    refused(tiltpad, case, "case.nml", *many, names=["--set rotor%mass=1", "more than 1000 times"])


def test_name_that_ends_in_a_blank(tiltpad, case):
    """Fortran would open the file without the blank."""
    (case / "case.nml ").write_text("&rotor mass=1 /\n")
    refused(tiltpad, case, "case.nml ", names=["case.nml ", "blank"])


def test_a_huge_file_is_not_read_in_part(tiltpad, case):
    """Its length in 32 bits is that of its first lines."""
    with open(case / "big.nml", "wb") as file:
        file.write(b"&rotor mass=1 /\n")
        file.truncate(2**32 + 16)
    run = tiltpad("--check", "big.nml", cwd=case)
    (case / "big.nml").unlink()
    assert (run.returncode, run.stdout) == (1, "")
    assert "big.nml: 4294967312 bytes" in run.stderr


@pytest.mark.parametrize(
    "text",
    ["&{} /", "&rotor {}=1 /", "&rotor mass={} /", "&case task='{}' /", "{}"],
    ids=lambda text: text[:20],
)
def test_a_long_word_makes_no_long_message(tiltpad, tmp_path, text):
    (tmp_path / "case.nml").write_text(text.format(50000 * "x"))
    assert len(refused(tiltpad, tmp_path, "case.nml", names=["case.nml line 1", "xxx..."])) < 400


# command lines: arguments, what the message must name
LINES = {
    "no case": ([], ["no case", "--help"]),
    "only an option": (["--quiet"], ["no case"]),
    "empty argument": ([""], ["empty"]),
    "unknown option": (["--verbose", "case.nml"], ["--verbose", "--help"]),
    "unknown short option": (["-x", "case.nml"], ["-x", "--help"]),
    "option behind": (["case.nml", "--verbose"], ["--verbose", "--help"]),
    "misspelt option": (["case.nml", "--chek"], ["--chek"]),
    "dash": (["-"], ["-", "--help"]),
    "two cases": (["case.nml", "other.nml"], ["case.nml", "other.nml"]),
    "the case twice": (["case.nml", "case.nml"], ["case.nml"]),
    "output without value": (["case.nml", "--output"], ["--output", "value"]),
    "set without value": (["case.nml", "--set"], ["--set", "value"]),
    "empty output": (["case.nml", "--output", ""], ["--output", "empty"]),
    "option with a newline": (["--one\ntwo"], ["--one"]),
    "option with an escape code": (["--\x1b[31mred"], ["unknown option"]),
    "case with a newline": (["no\nsuch.nml"], ["such.nml"]),
    "option like another": (["case.nml", "--ouput", "x.h5"], ["(did you mean --output?)"]),
    "option with equals sign": (["case.nml", "--output=x.h5"], ["(did you mean --output x.h5?)"]),
    "value without --set": (
        ["case.nml", "speed_rpm=3000"],
        ["--set group%name", "(did you mean operation%sp"],
    ),
    "value without group": (["case.nml", "--set", "speed_rpm=1"], ["(did you mean operation%speed_rpm?)"]),
    "value in another group": (
        ["case.nml", "--set", "operation%mass=1"],
        ["(did you mean rotor%mass or pads%"],
    ),
    "range without sweep": (
        ["case.nml", "--set", "operation%speed_rpm=1:3:1"],
        ["sweep%operation%speed_rpm = 1:3:1"],
    ),
    "values without sweep": (
        ["case.nml", "--set", "rotor%mass=1,2"],
        ["takes one value", "sweep%rotor%mass = 1, 2"],
    ),
    "word like another": (["case.nml", "--set", "friction%model=lugree"], ["(did you mean lugre?)"]),
    "group like another": (["case.nml", "--set", "rotors%mass=1"], ["(did you mean rotor?)"]),
}


@pytest.mark.parametrize("key", LINES)
def test_command_line(tiltpad, case, key):
    arguments, names = LINES[key]
    message = refused(
        tiltpad, case, *arguments, names=names, status=(1, 3) if "such" in str(arguments) else 1
    )
    assert "\x1b" not in message
