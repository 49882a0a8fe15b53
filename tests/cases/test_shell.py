"""What make install puts beside the program: manual pages and completion, made from its own words."""

import os
import pty
import re
import select
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import wait_for

#: What an interactive bash reads before the tests: Ctrl-T writes the line as it stands, and has it emptied.
START = """
bind 'set enable-bracketed-paste off'
bind 'set completion-query-items 0'
bind '"\\C-o": insert-completions'
bind -x '"\\C-t": printf %s "$READLINE_LINE" >"$SAID.part"; mv "$SAID.part" "$SAID"; READLINE_LINE='
load() { . "$COMPLETION"; }
load
set -u
PS1='ready> '
"""
#: Names of files with what a shell takes for more than letters.
AWKWARD = (
    "case.nml", "my case.nml", "price$HOME.nml", "it's.nml", "-d.nml", "two\nlines.nml", "a=b.nml",
    "co:l.nml", "k$(touch WRONG)`touch WRONG`.nml", "f&g;h.nml", "\\back.nml",
    "s*r.nml", "star.nml", "äh.nml",
)  # fmt: skip


@pytest.fixture(scope="module")
def completed(root, program, tmp_path_factory):
    """completed(keys): the line of an interactive bash, in a folder of awkward files, once they are typed.

    The completion is loaded in a function, as bash-completion does, in a shell with nounset. Tab completes,
    Ctrl-O inserts all that is proposed.
    """
    path = tmp_path_factory.mktemp("shell")
    here = path / "here"
    (here / "a/b").mkdir(parents=True)
    (here / "a/b/;etouch${IFS}WRONG;#.h5").touch()
    (here / "dir x").mkdir()
    for name in (*AWKWARD, "notes.txt", "dir x/inside.nml"):
        (here / name).touch()
    (path / "start").write_text(START)
    said = path / "said"
    environment = {
        "PATH": f"{Path(program).parent}:{root}/build/venv/bin:/usr/bin:/bin",
        "COMPLETION": f"{root}/post/shell/tiltpad.bash",
        "SAID": f"{said}",
        "HOME": f"{here}",
        "TERM": "dumb",
        "LC_ALL": "C.UTF-8",
        "INPUTRC": "/dev/null",
    }
    try:
        leader, follower = pty.openpty()
    except OSError:
        pytest.skip("no pseudo-terminals here")
    with subprocess.Popen(
        ["bash", "--noprofile", "--rcfile", f"{path}/start", "-i"], cwd=here, env=environment,
        stdin=follower, stdout=follower, stderr=follower, start_new_session=True,
    ) as shell:  # fmt: skip
        os.close(follower)
        shown = b""

        def until(condition):
            """Reads what the shell shows until the condition holds."""

            def holds():
                nonlocal shown
                if select.select([leader], [], [], 0.01)[0]:
                    shown += os.read(leader, 65536)
                return condition()

            wait_for(holds, shell)

        def typed(keys):
            nonlocal shown
            shown = b""
            os.write(leader, f"{keys}\x14".encode())
            until(said.exists)
            assert not re.search(rb"bash: |sed: |awk: ", shown)
            line = said.read_text()
            said.unlink()
            return line

        until(lambda: b"ready> " in shown)
        yield typed
        shell.kill()
    os.close(leader)
    assert not list(here.rglob("WRONG*"))


@pytest.mark.parametrize(
    ("typed", "line"),
    [
        ("tiltpad --over\t", "tiltpad --overwrite "),
        (
            "tiltpad case.nml --set operation%\x0f",
            "tiltpad case.nml --set operation%duration= operation%final_speed_rpm= operation%rotation= "
            "operation%speed_rpm= ",
        ),
        ("tiltpad --set sweep%rotor%ma\t", "tiltpad --set sweep%rotor%mass="),
        ("tiltpad --set friction%model=\x0f", "tiltpad --set friction%model=bengisu_akay lugre none "),
        ("tiltpad --set friction%model=lu\t", "tiltpad --set friction%model=lugre "),
        ("tiltpad --set sweep%friction%model=lu\t", "tiltpad --set sweep%friction%model=lugre "),
        ("tiltpad --set rotor%mass=\t", "tiltpad --set rotor%mass="),
        ("tiltpad-plot orb\t", "tiltpad-plot orbit "),
        ("tiltpad-plot orders --scale \x0f", "tiltpad-plot orders --scale linear log "),
        ("tiltpad not\t", "tiltpad not"),
        ("tiltpad ca\t", "tiltpad case.nml "),
        ("tiltpad cXe.nml --q\t\x01\x06\x06", "tiltpad cXe.nml --quiet "),
    ],
)
def test_completion(completed, typed, line):
    assert completed(typed) == line


@pytest.mark.parametrize(
    ("typed", "line"),
    [
        ("tiltpad my\t", r"tiltpad my\ case.nml "),
        (r"tiltpad my\ " "\t", r"tiltpad my\ case.nml "),
        ("tiltpad 'my \t", "tiltpad 'my case.nml' "),
        ('tiltpad "my \t', 'tiltpad "my case.nml" '),
        ("tiltpad pr\t", r"tiltpad price\$HOME.nml "),
        (r"tiltpad price\$" "\t", r"tiltpad price\$HOME.nml "),
        ("tiltpad 'price$\t", "tiltpad 'price$HOME.nml' "),
        ("tiltpad it\t", r"tiltpad it\'s.nml "),
        ("tiltpad ./-\t", "tiltpad ./-d.nml "),
        ("tiltpad tw\t", "tiltpad 'two\nlines.nml' "),
        ("tiltpad a=\t", "tiltpad a=b.nml "),
        ("tiltpad co:\t", "tiltpad co:l.nml "),
        (r"tiltpad s\*" "\t", r"tiltpad s\*r.nml "),
        ("tiltpad f\t", r"tiltpad f\&g\;h.nml "),
        (r"tiltpad \\" "\t", r"tiltpad \\back.nml "),
        ("tiltpad ä\t", "tiltpad äh.nml "),
        ("tiltpad k\t", r"tiltpad k\$\(touch\ WRONG\)\`touch\ WRONG\`.nml "),
        ("tiltpad di\tin\t", r"tiltpad dir\ x/inside.nml "),
        ("tiltpad ~/ca\t", "tiltpad ~/case.nml "),
        ("tiltpad $HOME/ca\t", "tiltpad $HOME/case.nml "),
        ("tiltpad-plot orbit a/\t", "tiltpad-plot orbit a/b/"),
        # a sed program and its command e, which runs the rest
        ("tiltpad-report 'a/b/\t \t", "tiltpad-report 'a/b/;etouch${IFS}WRONG;#.h5'  "),
        ("tiltpad-report a/b/;etouch${IFS}WRONG;#.h5 \t", "tiltpad-report a/b/;etouch${IFS}WRONG;#.h5 "),
        ("tiltpad $(touch${IFS}WRONG)/\t", "tiltpad $(touch${IFS}WRONG)/"),
        (r"tiltpad `touch\ WRONG`/" "\t", r"tiltpad `touch\ WRONG`/"),
        ("tiltpad --set a[$(touch${IFS}WRONG)]=\t", "tiltpad --set a[$(touch${IFS}WRONG)]="),
        ('tiltpad --set \'"; system("touch WRONG") #=\t', 'tiltpad --set \'"; system("touch WRONG") #='),
    ],
)
def test_completion_takes_no_word_for_a_command(completed, typed, line):
    assert completed(typed) == line


#: Stands for Slurm: sbatch [options] SCRIPT ARGUMENT... runs the job, or all tasks of the array, at once.
SBATCH = """#!/bin/bash
for option; do
   [[ $option == -* ]] || break
   [[ $option != *\\;* ]] || exit
   [[ $option == --array=1-* ]] && tasks=${option#--array=1-}
   shift
done
for ((k = 1; k <= ${tasks%%%*}; k++)); do
   SLURM_ARRAY_TASK_COUNT=${tasks%%%*} SLURM_ARRAY_TASK_ID=$k "$@" >&2 || exit
done
[[ $tasks ]] || "$@" >&2 || exit
echo "7;here"
"""


@pytest.fixture
def job(root, program, tmp_path):
    """job(script, *arguments): runs one of the job scripts in tmp_path/here; gives the names of all files."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/sbatch").write_text(SBATCH)
    (tmp_path / "bin/sbatch").chmod(0o755)
    scripts = tmp_path / "scripts of\na job"
    shutil.copytree(root / "input/slurm", scripts)
    folder = tmp_path / "here"
    folder.mkdir()
    path = f"{tmp_path}/bin:{Path(program).parent}:{root}/build/venv/bin:{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "SLURM_CPUS_ON_NODE": "2"}

    def run(script, *arguments):
        done = subprocess.run(
            [scripts / script, *arguments],
            cwd=folder, env=environment, text=True, capture_output=True,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return {str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file()}

    return run


@pytest.mark.parametrize(
    "name", ["-d", "--quiet", "my case", "two\nlines", "$(touch WRONG)`touch WRONG`;'\"*&"]
)
def test_jobs_take_any_name(job, tmp_path, name):
    case = tmp_path / f"here/{name}.nml"
    case.write_text("&operation duration=0.01 /\n")
    assert job("case.sh", case.name, "--set", "operation%speed_rpm=5000") == {case.name, f"{name}.h5"}
    (tmp_path / f"here/{name}.h5").unlink()
    case.write_text("&operation duration=0.01 /\n&sweep operation%speed_rpm=5000, 6000, 7000 /\n")
    runs = {f"{name}/000{k}.h5" for k in (1, 2, 3)}
    assert job("sweep.sh", case.name) == {case.name, *runs, f"{name}.h5"}
    (tmp_path / f"here/{name}.h5").unlink()
    assert job("submit.sh", case.name, "2") == {case.name, *runs, f"{name}.h5"}


def test_the_manual_page_has_every_option(root, tiltpad):
    said = tiltpad("--help", cwd=root).stdout
    page = subprocess.run(
        ["awk", "-v", "name=tiltpad", "-f", "post/shell/man_page.awk"],
        input=said,
        cwd=root,
        text=True,
        capture_output=True,
    ).stdout
    entries = re.findall(r"^\.TP\n\\fB(.*)\\fR$", page, re.M)
    assert [each.replace("\\-", "-") for each in entries] == re.findall(r"^  (--.*?)(?:  |$)", said, re.M)
    assert re.findall(r"^\.SH (.*)$", page, re.M) == [
        "NAME",
        "SYNOPSIS",
        "DESCRIPTION",
        "OPTIONS",
        "EXIT STATUS",
    ]
    if shutil.which("groff"):
        done = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=page, text=True, capture_output=True)
        assert (done.returncode, done.stderr) == (0, "")
