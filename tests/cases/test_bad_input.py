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


@pytest.fixture
def case(tmp_path):
    """The folder of a test, with the path of its case; it says nothing of its own."""
    (tmp_path / "case.nml").write_text("&case /\n")
    return tmp_path


@pytest.fixture
def refused(tiltpad, tmp_path):
    """refused("case.nml", "--check", names=("mass",)): the message of a run that must be refused.

    It runs in the folder of the test, in which an earlier result stands; all there stays as it is.
    """

    def run(*arguments, names=(), status=1, **options):
        (tmp_path / "case.h5").write_bytes(RESULT)
        before = snapshot(tmp_path)
        run = tiltpad(*arguments, cwd=tmp_path, errors="replace", **options)
        assert run.returncode in (status if isinstance(status, tuple) else (status,)), run.stderr
        assert run.stdout == ""
        assert run.stderr.endswith("\n"), run.stderr
        assert run.stderr.count("\n") == 1, run.stderr
        assert run.stderr.startswith("tiltpad: error: ")
        for name in names:
            assert name in run.stderr
        for word in TRACE:
            assert word not in run.stderr
        assert snapshot(tmp_path) == before
        return run.stderr

    return run


@pytest.fixture
def refused_text(refused, tmp_path):
    """refused_text("&rotor mass=-1 /", names): the message with which a case of this text is refused."""

    def run(text, names):
        (tmp_path / "case.nml").write_bytes(text if isinstance(text, bytes) else text.encode())
        return refused("case.nml", names=["case.nml", *names])

    return run


# values that are not allowed: group, what the message must name, assignments
VALUES = [
    ("rotor", "1e-6 to", ["mass=-1", "mass=0", "mass=1e-400"]),
    ("rotor", "finite", ["mass=nan", "mass=NaN", "mass=inf", "mass=-Infinity", "mass=1e400", "mass=1e99999"]),
    (
        "rotor",
        "number",
        [
            "mass=1+2",
            "mass=0x10",
            "mass=1_8",
            "mass=1q3",
            "mass=1.5.2",
            "mass=.",
            "mass=1e",
            "mass=--1",
            "mass=.true.",
            "mass=(1)",
            "mass=2000kg",
            "mass='2000'",
            "mass=heavy",
            "mass=0*3",
            "mass=3*",
        ],
    ),
    ("rotor", "value|number|at most 1", ["mass=z'10'"]),
    ("rotor", "takes one value", ["mass=1,2"]),
    ("rotor", "at most 1", ["mass=2*3", "mass(2)=3"]),
    ("rotor", "value is missing", ["mass=", "mass=3,,"]),
    ("rotor", "0 to", ["unbalance=-0.01", "gravity=-9.81"]),
    ("rotor", "2 values", ["static_load=1"]),
    ("rotor", "at most 2", ["static_load=1,2,3"]),
    ("operation", "0.001 to", ["speed_rpm=0", "speed_rpm=-6500"]),
    ("operation", "1e-9 to", ["duration=0"]),
    ("bearing", "to 10", ["journal_radius=0", "journal_radius=49.9", "viscosity=0", "viscosity=19"]),
    ("bearing", "1e-9 to", ["machined_clearance=0", "assembled_clearance=-80e-6"]),
    ("bearing", "-1 to 0.999", ["preload=1"]),
    ("bearing", "1e-5 to", ["axial_length=0"]),
    ("oil", "0 to 3200", ["grade='VG46'"]),
    ("oil", "-100 to 500", ["supply_temperature=-274"]),
    ("oil", "0 to 1", ["temperature_exponent=-0.03"]),
    ("thermal", "pad", ["model='pads'"]),
    ("pads", "to 360", ["arc_deg=0"]),
    ("pads", "at most 2", ["arc_deg=60,60,60", "arc_deg(3)=60"]),
    ("pads", "to 0.99", ["pivot_ratio=1"]),
    ("pads", "24", ["pivot_angle_deg=25*0"]),
    ("pads", "1e-9 to", ["mass=-0.8"]),
    ("pads", "1 to", ["density=0"]),
    ("pads", "to 1", ["thickness=1.5"]),
    ("pads", "1e-15 to", ["inertia=0"]),
    ("pads", "tilting_radial", ["motion='tilting'"]),
    ("pivot", " to ", ["young_modulus=210,210"]),
    ("pivot", "to 0.5", ["poisson_ratio=0.6,0.3"]),
    ("pivot", "1e-5 to", ["socket_radius=0"]),
    ("pivot", "0 to", ["radius_difference=-15e-6"]),
    ("pivot", "fang", ["law='hertzian'"]),
    ("friction", "bengisu_akay", ["model='lugree'"]),
    ("friction", "lugre", ["model=''", "model=1"]),
    ("friction", "to 10", ["static_coefficient=0", "critical_velocity=0"]),
    ("friction", "0 to", ["dynamic_coefficient=-0.1"]),
    ("film", "whole", ["circumferential_cells=60.0", "circumferential_cells=6e1", "axial_cells=2.5"]),
    ("film", "2000", ["circumferential_cells=3000000000", "circumferential_cells=-8"]),
    ("film", "1 to", ["max_sweeps=0"]),
    ("film", "1.999", ["relaxation=2"]),
    ("film", "reynolds", ["cavitation='jfo'"]),
    ("film", "sor", ["solver='multigrid'"]),
    ("integration", "to 0.01", ["relative_tolerance=0"]),
    ("integration", "0 to", ["max_step=-1"]),
    ("output", "1 to", ["samples_per_revolution=0"]),
    ("output", "0 to", ["start_time=-1"]),
    ("case", "equilibrium", ["task='run'"]),
    ("case", "quotes", ["title=untitled", "title=3"]),
]
EACH_VALUE = [(group, each, allowed) for group, allowed, these in VALUES for each in these]


@pytest.mark.parametrize(("group", "assignment", "allowed"), EACH_VALUE, ids=lambda text: text[:40])
def test_value(refused_text, group, assignment, allowed):
    name = assignment.split("=")[0]
    message = refused_text(f"&{group}\n  {assignment}\n/\n", ["case.nml line 2", f"{group}%{name}"])
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
    "cavitation above supply": (
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
def test_values_together(refused_text, key):
    text, names = TOGETHER[key]
    refused_text(text + "\n&integration max_steps=20 /\n", names)


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
    "binary": (bytes(range(256)) * 4, ["not a text file"]),
}


@pytest.mark.parametrize("key", TEXTS)
def test_text(refused_text, key):
    refused_text(*TEXTS[key])


def test_result_file_for_a_case(refused, tmp_path):
    (tmp_path / "other.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(64))
    refused("other.h5", names=["other.h5: a result or study (an HDF5 file), where a case belongs"])


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
def test_a_huge_file_is_refused(refused_text, text):
    refused_text(text, ())


def test_directory_for_a_case(refused, tmp_path):
    (tmp_path / "case.nml").mkdir()
    refused("case.nml", names=["case.nml", "irectory", "tiltpad-collect"], status=(1, 3))


def test_no_such_case(refused):
    refused("other.nml", names=["other.nml", "no such file"], status=(1, 3))


def test_link_in_a_circle(refused, tmp_path):
    (tmp_path / "case.nml").symlink_to("case.nml")
    refused("case.nml", names=["case.nml"], status=(1, 3))


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_unreadable_case(tiltpad, tmp_path):
    (tmp_path / "case.nml").write_text("&case /\n")
    (tmp_path / "case.nml").chmod(0)
    run = tiltpad("case.nml", cwd=tmp_path)
    assert run.returncode in (1, 3)
    assert run.stderr.startswith("tiltpad: error: case.nml: ")
    assert run.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["case.nml"]


# output that cannot be written: the name, what the message must name.
# An output that cannot be is refused before anything is computed.
SHORT = ("--set", "operation%duration=1e-4")
OUTPUTS = {
    "in no directory": ("none/run.h5", ["cannot write none/run.h5: there is no folder none/"]),
    "below a file": ("case.nml/run.h5", ["case.nml/run.h5"]),
    "a directory": ("folder", ["folder", "irectory"]),
    "a name too long": (300 * "x" + ".h5", ["xxx.h5"]),
    "in a place that takes no files": ("/proc/run.h5", ["/proc/run.h5"]),
    "in a read-only directory": ("shut/run.h5", ["shut/run.h5"]),
    # likewise a device such as the null device is not replaced by a file
    "a pipe": ("pipe", ["pipe"]),
}


@pytest.mark.parametrize("key", OUTPUTS)
def test_output(refused, case, key):
    if "takes no files" in key and not os.path.isdir("/proc/self"):
        pytest.skip("no /proc here")
    if "read-only" in key and os.geteuid() == 0:
        pytest.skip("root writes everywhere")
    (case / "folder").mkdir()
    (case / "shut").mkdir(mode=0o500)
    os.mkfifo(case / "pipe")
    output, names = OUTPUTS[key]
    for more in ((), ("--quiet",)):
        refused("case.nml", *SHORT, *more, "--output", output, names=names, status=3)


@pytest.mark.parametrize("output", ["case.nml", "./case.nml", "linked.h5"])
def test_output_is_the_case_itself(refused, case, output):
    (case / "linked.h5").symlink_to("case.nml")
    refused("case.nml", *SHORT, "--output", output, names=[output], status=(1, 3))


def test_default_output_is_the_case_itself(refused, tmp_path):
    (tmp_path / "input.h5").write_text("&case /\n")
    refused("input.h5", *SHORT, names=["input.h5"], status=(1, 3))


@pytest.mark.parametrize("duration", ["1e-4", "0.05"])
def test_disk_full(refused, case, duration):
    """A limit on the size of files stands for a disk that is full."""

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

    message = refused(
        "case.nml", "--quiet", "-o", "full.h5", "--set", f"operation%duration={duration}",
        names=["full.h5"], status=3, preexec_fn=limit,
    )  # fmt: skip
    assert "full" in message or "too large" in message.lower()


def test_disk_full_for_standard_output(program, case):
    if not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full here")
    with open("/dev/full", "w") as full:
        command = [program, "--check", "case.nml"]
        run = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, cwd=case)
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
def test_override(refused, case, override):
    refused("case.nml", *SHORT, "--set", override, names=OVERRIDES[override])


def test_a_text_of_set_needs_no_quotes_but_for_blanks_and_slashes(tiltpad, refused, case):
    done = tiltpad("--check", "case.nml", "--set", "case%title=a_word", cwd=case)
    assert "\n  title = 'a_word'\n" in done.stdout
    for text, names in (("two words", ["takes one text, in quotes"]), ("a/b", ["\"group%name='a/b'\""])):
        refused("case.nml", "--set", f"case%title={text}", names=["case%title", *names])


def test_override_too_long(refused, case):
    refused("case.nml", "--set", f"case%title='{10000 * 'x'}'", names=["--set", "too long"])


def test_override_that_is_not_utf_8(refused, case):
    refused("case.nml", "--set", "case%title='\udcff'", names=["--set", "case%title", "UTF-8"])


def test_more_overrides_than_any_case_has(refused, case):
    many = 5000 * ("--set", "rotor%mass=1")
    refused("case.nml", *many, names=["--set rotor%mass=1", "more than 1000 times"])


def test_name_that_ends_in_a_blank(refused, case):
    """Fortran would open the file without the blank."""
    (case / "case.nml ").write_text("&rotor mass=1 /\n")
    refused("case.nml ", names=["case.nml ", "blank"])


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
def test_a_long_word_makes_no_long_message(refused_text, text):
    assert len(refused_text(text.format(50000 * "x"), ["case.nml line 1", "xxx..."])) < 400


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
    "former variable": (
        ["case.nml", "--set", "pivot%penetration_factor=4"],
        ["(is called pivot%deflection_factor now)"],
    ),
    "former word": (["case.nml", "--set", "film%solver=modal"], ["(is called fourier now)"]),
    "former option": (["case.nml", "--member", "3"], ["(is called --run now)"]),
    "group like another": (["case.nml", "--set", "rotors%mass=1"], ["(did you mean rotor?)"]),
}


@pytest.mark.parametrize("key", LINES)
def test_command_line(refused, case, key):
    arguments, names = LINES[key]
    message = refused(*arguments, names=names, status=(1, 3) if "such" in str(arguments) else 1)
    assert "\x1b" not in message
