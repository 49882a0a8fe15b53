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


# texts that are refused for what is read, assigned, or does not fit together, and what the message must name;
# more of each in tests/unit/test_namelist_text.f90, test_case_namelist.f90 and test_case_checks.f90
TEXTS = {
    "empty": ("", ["no namelist group"]),
    "unknown empty group": ("&motor /\n", ["line 1", "&motor", "rotor"]),
    "group twice": ("&rotor mass=1 /\n&rotor gravity=1 /\n", ["line 2", "&rotor", "twice", "line 1"]),
    "unclosed quote": ("&case\n title='a b\n/\n", ["line 2", "case%title", "quote"]),
    "binary": (bytes(range(256)) * 4, ["not a text file"]),
    "variable of another group": ("&rotor\n viscosity=1\n/\n", ["line 2", "rotor%viscosity"]),
    "out of range": ("&rotor\n mass=-1\n/\n", ["line 2", "rotor%mass", "1e-6 to"]),
    "not finite": ("&rotor\n mass=1e400\n/\n", ["line 2", "rotor%mass", "finite"]),
    "no number": ("&rotor\n mass=heavy\n/\n", ["line 2", "rotor%mass", "number"]),
    "no whole number": ("&film\n axial_cells=2.5\n/\n", ["line 2", "film%axial_cells", "whole"]),
    "too many values": ("&pads\n arc_deg=60,60,60\n/\n", ["line 2", "pads%arc_deg", "at most 2"]),
    "no value": ("&rotor\n mass=\n/\n", ["line 2", "rotor%mass", "value is missing"]),
    "no such word": ("&friction\n model='lugree'\n/\n", ["line 2", "friction%model", "bengisu_akay"]),
    "no quotes": ("&case\n title=untitled\n/\n", ["line 2", "case%title", "quotes"]),
    "overlapping pads": (
        "&pads pivot_angle_deg=-45,0 / &integration max_steps=20 /\n",
        ["pads%pivot_angle_deg", "-45", "overlap", "pads 1 and 2"],
    ),
}


@pytest.mark.parametrize("key", TEXTS)
def test_text(refused_text, key):
    refused_text(*TEXTS[key])


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


# --set: argument, what the message must name; more in tests/unit/test_namelist_text.f90
OVERRIDES = {
    "": ["group%name=value"],
    "rotor%mass=3 / &pads mass=1": ["rotor%mass=3 / &pads mass=1", "one group%name=value"],
    "rotor%mass=-3": ["rotor%mass = -3", "1e-6 to"],
    "motor%mass=3": ["motor", "rotor"],
    "output%start_time=3": ["output%start_time = 3", "operation%duration"],
    "rotor%mas\ns=3": ["--set", "name = value"],
    "case%title='\x1b[2J'": ["--set case%title=", "control character"],
    "case%title='\udcff'": ["--set", "case%title", "UTF-8"],
    f"case%title='{10000 * 'x'}'": ["--set", "too long"],
}


@pytest.mark.parametrize("override", OVERRIDES, ids=range(len(OVERRIDES)))
def test_override(refused, case, override):
    refused("case.nml", *SHORT, "--set", override, names=OVERRIDES[override])


def test_a_text_of_set_needs_no_quotes_but_for_blanks_and_slashes(tiltpad, refused, case):
    done = tiltpad("--check", "case.nml", "--set", "case%title=a_word", cwd=case)
    assert "\n  title = 'a_word'\n" in done.stdout
    for text, names in (("two words", ["takes one text, in quotes"]), ("a/b", ["\"group%name='a/b'\""])):
        refused("case.nml", "--set", f"case%title={text}", names=["case%title", *names])


def test_more_overrides_than_any_case_has(refused, case):
    many = 5000 * ("--set", "rotor%mass=1")
    refused("case.nml", *many, names=["--set rotor%mass=1", "more than 1000 times"])


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
    "range without &sweep": (
        ["case.nml", "--set", "operation%speed_rpm=1:3:1"],
        ["sweep%operation%speed_rpm = 1:3:1"],
    ),
    "values without &sweep": (
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
