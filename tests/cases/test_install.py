"""make install and uninstall, from and to folders of any name; what only tells makes no files."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ODD = 'it\'s $(touch WRONG)`touch WRONG`; touch WRONG; "x" & \\x |\n touch WRONG'
PAGES, COMPLETIONS = "share/man/man1", "share/bash-completion/completions"
#: Stands for Python: makes an environment without anything in it, whose Python tells what it is asked.
PYTHON = r"""#!/bin/sh
if [ "$2" = venv ]; then
   mkdir -p "$3/bin" && cp "$0" "$3/bin/python"
elif [ "$1" != -m ]; then
   printf 'usage: x\n\nDoes it.\n'
   printf '%s.' "$@"
fi
"""


def files(folder):
    return {str(each.relative_to(folder)) for each in folder.rglob("*") if not each.is_dir()}


def of(*commands):
    """The files of these commands under a prefix."""
    return {
        f"{folder}/{each}{suffix}"
        for each in commands
        for folder, suffix in (("bin", ""), (COMPLETIONS, ""), (PAGES, ".1"))
    }


@pytest.fixture
def checkout(root, program, tmp_path):
    """A folder with all that make needs, and a program that is up to date."""
    folder = tmp_path / f"of {ODD}"
    folder.mkdir()
    shutil.copy(root / "Makefile", folder)
    ignored = shutil.ignore_patterns("_library.*", "__pycache__")
    for name in ("src_f90", "post"):
        shutil.copytree(root / name, folder / name, ignore=ignored)
    (folder / "tests").mkdir()
    (folder / "build/bin").mkdir(parents=True)
    (folder / "build/bin/tiltpad").symlink_to(Path(program).resolve())
    (tmp_path / "python").write_text(PYTHON)
    (tmp_path / "python").chmod(0o755)
    yield folder
    assert not list(tmp_path.rglob("WRONG"))


@pytest.fixture
def make(checkout, tmp_path):
    """make(*words): what it does in the checkout, where program and environment are up to date."""

    def run(*words, status=0):
        words = ["make", "-o", "build", "-o", "python", f"PYTHON={tmp_path}/python", *words]
        # of a make around the tests
        own = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "PREFIX", "DESTDIR", "PLOTS")
        environment = {name: value for name, value in os.environ.items() if name not in own}
        done = subprocess.run(words, cwd=checkout, env=environment, text=True, capture_output=True)
        assert done.returncode == status, done.stderr
        return done.stdout + done.stderr

    return run


@pytest.mark.parametrize("plots", ["no", "yes"])
@pytest.mark.parametrize("relative", [False, True])
def test_into_folders_of_any_name(make, checkout, tmp_path, relative, plots):
    """What is there before stays, and so does what has come meanwhile under an installed name."""
    target = (checkout if relative else tmp_path) / f"{ODD}/it's"
    words = [f"DESTDIR={ODD}/", "PREFIX=it's"] if relative else [f"PREFIX={target}"]
    words = [f"PLOTS={plots}", *(word.replace("$", "$$") for word in words)]
    others = {"lib/tiltpad/mine", "bin/mine"} | (of("tiltpad-plot") if plots == "no" else set())
    for name in others:
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (target / name).write_text("mine")
    commands = ["tiltpad"] + ["tiltpad-plot", "tiltpad-report", "tiltpad-collect"] * (plots == "yes")
    for _ in range(2):
        make("install", *words)
        written = files(target) - others
        assert {each for each in written if not each.startswith("lib/tiltpad/")} == of(*commands)
        for command in commands:
            assert (target / PAGES / f"{command}.1").read_text().startswith(f".TH {command.upper()} 1")
            said = subprocess.run([target / "bin" / command, "--help"], text=True, capture_output=True)
            assert (said.returncode, said.stdout[:6]) == (0, "usage:")
    if plots == "yes":
        (tmp_path / "a link").symlink_to(target / "bin/tiltpad-collect")
        said = subprocess.run([tmp_path / "a link", "a b", "$x'"], text=True, capture_output=True).stdout
        assert "from tiltpad.command import collect\n" in said
        assert said.endswith(".a b.$x'.")
    (target / "bin/tiltpad").unlink()
    (target / "bin/tiltpad").write_text("another's")
    assert "bin/tiltpad: stays" in make("uninstall", *words)
    assert files(target) == others | {"bin/tiltpad"}
    assert "has written nothing" in make("uninstall", *words, status=2)


def test_a_program_stays_until_the_new_one_is_whole(make, tmp_path, monkeypatch):
    """A copy that fails half-way leaves the older one, which somebody may be about to start."""
    program = tmp_path / "to/bin/tiltpad"
    program.parent.mkdir(parents=True)
    program.write_text("older")
    (tmp_path / "install").write_text('#!/bin/sh\nfor last; do :; done\necho half >"$last"\nexit 1\n')
    (tmp_path / "install").chmod(0o755)
    with monkeypatch.context() as patch:
        patch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
        make("install", "PLOTS=no", f"PREFIX={tmp_path}/to", status=2)
    assert files(tmp_path / "to") == {"bin/tiltpad"}
    assert program.read_text() == "older"
    make("install", "PLOTS=no", f"PREFIX={tmp_path}/to")
    assert files(tmp_path / "to") == of("tiltpad") | {"lib/tiltpad/installed"}


def test_an_environment_of_somebody_else(make, tmp_path):
    (tmp_path / "to/lib/tiltpad/python").mkdir(parents=True)
    assert "none that make install has made" in make("install", f"PREFIX={tmp_path}/to", status=2)
    make("uninstall", f"PREFIX={tmp_path}/to")
    assert (tmp_path / "to/lib/tiltpad/python").is_dir()


def test_a_command_that_fails_leaves_no_empty_page(make, checkout, tmp_path):
    (checkout / "build/bin/tiltpad").unlink()
    (checkout / "build/bin/tiltpad").symlink_to("/bin/false")
    make("install", "PLOTS=no", f"PREFIX={tmp_path}/to", status=2)
    assert not list((tmp_path / "to").rglob("*.1"))


@pytest.mark.parametrize(
    "words", ["-n clean", "-n build/bin/tiltpad", "-n install", "-q clean", "help", "-n help", "-n lint"]
)
def test_what_only_tells_makes_no_files(make, checkout, words):
    shutil.rmtree(checkout / "build")
    before = files(checkout)
    make(*words.split(), status=int(words.startswith("-q")))
    assert files(checkout) == before
    assert not (checkout / "build").exists()


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (["help", "PREFIX=';touch WRONG;'"], 0, "PREFIX (';touch WRONG;')"),
        (["unit", "NAME=test_text ;touch WRONG"], 2, "NAME is one of"),
        (["unit", "NAME=%;touch WRONG"], 2, "NAME is one of"),
        (["-n", "build", "HDF5_PREFIX=/opt/my libraries"], 2, "HDF5_PREFIX=/opt/my libraries: must have no"),
        (["-n", "build", "FFTW_PREFIX=/opt;touch WRONG"], 2, "FFTW_PREFIX=/opt;touch WRONG: must have no"),
    ],
)
def test_words_of_the_command_line(make, checkout, words, status, said):
    (checkout / "tests/unit").mkdir()
    (checkout / "tests/unit/test_text.f90").touch()
    assert said in make(*words, status=status)


def test_paths_for_the_shell(root, tmp_path):
    """The Makefile evaluates them."""
    (tmp_path / "numpy/f2py").mkdir(parents=True)
    text = f"def get_include():\n    return {ODD!r}\n"
    for name in ("numpy/__init__.py", "numpy/f2py/__init__.py"):
        (tmp_path / name).write_text(text)
    done = subprocess.run(
        ["sh", "-ec", 'eval "$(python3 "$0")"; printf %s "$numpy$f2py"', root / "post/wrap/paths.py"],
        cwd=tmp_path, env=os.environ | {"PYTHONPATH": f"{tmp_path}"}, text=True, capture_output=True,
    )  # fmt: skip
    assert (done.stdout, done.stderr) == (ODD * 2, "")
    assert not (tmp_path / "WRONG").exists()
