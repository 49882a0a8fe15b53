"""The job scripts of input/slurm on a real Slurm: what ends how, what goes on, and what a study comes to."""

import os
import re
import signal
from pathlib import Path

import numpy as np
import pytest
import tiltpad

#: Runs of the study, and the one that fails.
RUNS, FAILING = range(1, 7), 3
SHORT = "operation%duration=1"


def one(duration: float = 40) -> str:
    """A case of some seconds, with a checkpoint soon."""
    return f"""\
&operation duration={duration} /
&friction  model='lugre' /
&output    samples_per_revolution=36, checkpoint_seconds=0.2 /
"""


def six_speeds(duration: float = 40, speeds: str = "5000:7500:500") -> str:
    """A study over six speeds, of which the third fails."""
    steps = ", ".join("10" if k == FAILING else "1000000" for k in RUNS)
    return f"""{one(duration)}
&sweep
   order = 'zip'
   operation%speed_rpm = {speeds}
   integration%max_steps = {steps}
/
"""


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text)
    return path


def begun(cluster, path: Path) -> None:
    """Waits for the first checkpoint of a run."""
    cluster.wait_for(path.exists, f"a checkpoint in {path.name}")


def writer(path: Path) -> int:
    """The process that writes a result; its lock says "host process heartbeats"."""
    return int((path.parent / f"{path.name}.lock").read_text().split()[1])


def parent(process: int) -> int:
    """The process that started another."""
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


def outcome(job: dict[str, str]) -> tuple[str, str, str]:
    return job["JobState"], job["ExitCode"], job["Restarts"]


def check_whole(path: Path, resumed: bool) -> None:
    """The run is complete, was resumed or not, and no sample of its series is missing or there twice."""
    with tiltpad.read(path) as run:
        settings = run.input
        interval = 60 / (settings["operation"]["speed_rpm"] * settings["output"]["samples_per_revolution"])
        count = 1 + int(settings["operation"]["duration"] / interval + 1e-6)
        assert run.complete
        assert (run.attributes["resumes"] >= 1) == resumed
        np.testing.assert_allclose(run.time, interval * np.arange(count), rtol=1e-12)
        assert not (path.parent / f"{path.name}.lock").exists()


@pytest.fixture
def case(folder):
    return write(folder, "mine.nml", one())


def test_case(cluster, scripts, case):
    result = case.with_suffix(".h5")
    job = cluster.submit(scripts / "case.sh", "mine.nml", "--set", SHORT, cwd=case.parent)
    assert outcome(cluster.ended(job)) == ("COMPLETED", "0:0", "0")
    check_whole(result, resumed=False)

    written = result.stat().st_mtime_ns
    job = cluster.submit(scripts / "case.sh", "mine.nml", "--set", SHORT, cwd=case.parent)
    assert outcome(cluster.ended(job)) == ("COMPLETED", "0:0", "0")
    assert result.stat().st_mtime_ns == written


def test_bad_case_is_not_requeued(cluster, scripts, folder):
    write(folder, "bad.nml", "&operation speed_rpm=-1 /\n")
    job = cluster.submit(scripts / "case.sh", "bad.nml", cwd=folder)
    assert outcome(cluster.ended(job)) == ("FAILED", "1:0", "0")
    assert "operation%speed_rpm" in (folder / f"slurm-{job}.out").read_text()


def test_requeued_job_goes_on(cluster, scripts, case):
    result = case.with_suffix(".h5")
    job = cluster.submit(scripts / "case.sh", "mine.nml", cwd=case.parent)
    begun(cluster, result)
    cluster.ask("scontrol", "requeue", job)
    assert outcome(cluster.ended(job)) == ("COMPLETED", "0:0", "1")
    check_whole(result, resumed=True)
    # one log of both parts
    log = (case.parent / f"slurm-{job}.out").read_text()
    assert "stopped by signal 15" in log
    assert "going on from" in log


def test_preempted_job_goes_on(cluster, scripts, case):
    result = case.with_suffix(".h5")
    whole_node = f"--cpus-per-task={cluster.processors}"
    job = cluster.submit("--partition=low", whole_node, scripts / "case.sh", "mine.nml", cwd=case.parent)
    begun(cluster, result)
    write(case.parent, "urgent.nml", one())
    urgent = cluster.submit(whole_node, scripts / "case.sh", "urgent.nml", "--set", SHORT, cwd=case.parent)
    assert outcome(cluster.ended(urgent)) == ("COMPLETED", "0:0", "0")
    assert outcome(cluster.ended(job)) == ("COMPLETED", "0:0", "1")
    check_whole(result, resumed=True)
    assert "stopped by signal 15" in (case.parent / f"slurm-{job}.out").read_text()


def test_killed_program_goes_on_once_requeued(cluster, scripts, case):
    result = case.with_suffix(".h5")
    job = cluster.submit(scripts / "case.sh", "mine.nml", cwd=case.parent)
    begun(cluster, result)
    os.kill(writer(result), signal.SIGKILL)
    assert outcome(cluster.ended(job)) == ("FAILED", "137:0", "0")
    cluster.ask("scontrol", "requeue", job)
    assert outcome(cluster.ended(job)) == ("COMPLETED", "0:0", "1")
    check_whole(result, resumed=True)


def test_second_writer_is_refused(cluster, scripts, case):
    """A run that Slurm has lost sight of goes on; the requeued job must not write beside it."""
    result = case.with_suffix(".h5")
    endless = "operation%duration=1000"
    job = cluster.submit(scripts / "case.sh", "mine.nml", "--set", endless, cwd=case.parent)
    begun(cluster, result)
    lost = writer(result)
    os.kill(parent(parent(lost)), signal.SIGKILL)
    cluster.ask("scontrol", "requeue", job)
    assert outcome(cluster.ended(job)) == ("FAILED", "3:0", "1")
    assert f"process {lost} on" in (case.parent / f"slurm-{job}.out").read_text()
    assert writer(result) == lost
    os.kill(lost, signal.SIGTERM)
    cluster.wait_for(lambda: not (case.parent / "mine.h5.lock").exists(), "the lost run's end")
    with pytest.warns(tiltpad.IncompleteRunWarning):
        run = tiltpad.read(result)
    with run:
        assert run.attributes["resumes"] == 0
        assert np.all(np.diff(run.time) > 0)


def test_cancelled_job_is_not_requeued(cluster, scripts, case):
    result = case.with_suffix(".h5")
    job = cluster.submit(scripts / "case.sh", "mine.nml", cwd=case.parent)
    begun(cluster, result)
    cluster.ask("scancel", job)
    cancelled = cluster.ended(job)
    assert (cancelled["JobState"], cancelled["Restarts"]) == ("CANCELLED", "0")
    job = cluster.submit(scripts / "case.sh", "mine.nml", cwd=case.parent)
    assert outcome(cluster.ended(job)) == ("COMPLETED", "0:0", "0")
    check_whole(result, resumed=True)


def check_study(path: Path) -> None:
    """All runs have their rows, once, and no file of a block is left."""
    with tiltpad.read_study(path) as study:
        assert list(study["run"]) == list(RUNS)
        assert list(study["status"]) == [2.0 if k == FAILING else 0.0 for k in RUNS]
        np.testing.assert_array_equal(np.isnan(study["orbit_size"]), [k == FAILING for k in RUNS])
    assert not list(path.parent.glob("*of*.h5*"))
    assert not list(path.parent.glob("*.lock"))


def test_task_requeues_itself_alone_when_its_time_is_over(cluster, scripts, folder):
    write(folder, "speeds.nml", six_speeds())
    # the last task that starts has the number of the whole array
    array = cluster.submit("--array=1-2", scripts / "sweep.sh", "speeds.nml", "6", cwd=folder)
    cluster.wait_for(lambda: len(cluster.running(array)) == 2, "both tasks")
    task = next(k for k in (1, 2) if cluster.job(f"{array}_{k}")["JobId"] == array)
    begun(cluster, folder / f"speeds/000{task}.h5")
    cluster.ask("scancel", "--batch", "--signal=USR1", f"{array}_{task}")
    for k in (1, 2):
        assert outcome(cluster.ended(f"{array}_{k}")) == ("COMPLETED", "0:0", str(int(k == task)))
        check_whole(folder / f"speeds/000{k}.h5", resumed=k == task)
        assert (folder / f"speeds.{k}of6.h5").exists()
    assert "stopped by signal 10" in (folder / f"slurm-{array}_{task}.out").read_text()
    assert not (folder / "speeds.h5").exists()


def test_study_in_one_job_goes_on(cluster, scripts, folder):
    write(folder, "speeds.nml", six_speeds(duration=25))
    job = cluster.submit("--cpus-per-task=2", scripts / "sweep.sh", "speeds.nml", cwd=folder)
    begun(cluster, folder / "speeds/0002.h5")
    cluster.ask("scancel", "--batch", "--signal=USR1", job)
    assert outcome(cluster.ended(job)) == ("FAILED", "2:0", "1")
    for k in RUNS:
        if k != FAILING:
            check_whole(folder / f"speeds/{k:04d}.h5", resumed=k <= 2)
    check_study(folder / "speeds.h5")


def test_killed_and_requeued_tasks_of_an_array(cluster, scripts, folder):
    """The last to end joins the blocks: here the one that was killed, after it is requeued."""
    write(folder, "speeds.nml", six_speeds(duration=20))
    array = cluster.submit("--array=1-3", "--cpus-per-task=2", scripts / "sweep.sh", "speeds.nml", cwd=folder)
    for k in (1, 2, 4):
        begun(cluster, folder / f"speeds/{k:04d}.h5")
    os.kill(writer(folder / "speeds.2of3.h5"), signal.SIGKILL)
    cluster.ask("scontrol", "requeue", f"{array}_1")
    assert outcome(cluster.ended(f"{array}_2")) == ("FAILED", "137:0", "0")
    assert outcome(cluster.ended(f"{array}_1")) == ("COMPLETED", "0:0", "1")
    assert outcome(cluster.ended(f"{array}_3")) == ("COMPLETED", "0:0", "0")
    assert not (folder / "speeds.h5").exists()
    cluster.ask("scontrol", "requeue", f"{array}_2")
    assert outcome(cluster.ended(f"{array}_2")) == ("FAILED", "2:0", "1")
    check_study(folder / "speeds.h5")
    for k in RUNS:
        if k != FAILING:
            check_whole(folder / f"speeds/{k:04d}.h5", resumed=k in (1, 2, 4))


def test_one_task_again(cluster, scripts, folder):
    """By its number, or the whole study in one job, which takes the rows of the others."""
    write(folder, "speeds.nml", six_speeds(duration=0.5))
    for name, last in (("one", ("--array=2",)), ("all", ())):
        (folder / name).mkdir()
        study = write(folder / name, "speeds.nml", (folder / "speeds.nml").read_text())
        first = cluster.submit("--array=1,3", scripts / "sweep.sh", study.name, "3", cwd=study.parent)
        for k in (1, 3):
            assert outcome(cluster.ended(f"{first}_{k}")) == ("COMPLETED", "0:0", "0")
        blocks = ("3",) if last else ()
        again = cluster.submit(*last, scripts / "sweep.sh", study.name, *blocks, cwd=study.parent)
        assert outcome(cluster.ended(again)) == ("FAILED", "2:0", "0")
        check_study(study.with_suffix(".h5"))


def test_study(cluster, scripts, folder):
    at_a_time = 2
    assert at_a_time < cluster.processors
    write(folder, "speeds.nml", six_speeds(duration=6))
    said = cluster.ask(scripts / "submit.sh", "speeds.nml", "5", str(at_a_time), cwd=folder)
    assert "6 runs in 5 blocks" in said
    (array,) = re.findall(r"job ([0-9]+)", said)
    seen = []

    def watched() -> bool:
        seen.append(len(cluster.running(array)))
        return cluster.ask("squeue", "-h", "-j", array) == ""

    cluster.wait_for(watched, "the study")
    assert max(seen) == at_a_time
    # the blocks 1, 1, 1, 1 and 2
    for k in range(1, 6):
        expected = ("FAILED", "2:0", "0") if k == FAILING else ("COMPLETED", "0:0", "0")
        assert outcome(cluster.job(f"{array}_{k}")) == expected
    check_study(folder / "speeds.h5")
    cluster.ask("tiltpad-plot", "study", "speeds.h5", "-o", "study.png", cwd=folder)
    assert (folder / "study.png").read_bytes().startswith(b"\x89PNG")


def test_faulty_study_is_not_submitted(cluster, scripts, folder):
    write(folder, "speeds.nml", six_speeds(speeds="5000:-5000:-2000"))
    refused = cluster.call(scripts / "submit.sh", "speeds.nml", cwd=folder)
    assert refused.returncode == 1
    assert "speed_rpm" in refused.stderr
    write(folder, "mine.nml", one())
    refused = cluster.call(scripts / "submit.sh", "mine.nml", cwd=folder)
    assert refused.returncode == 1
    assert "no group &sweep" in refused.stderr
    assert cluster.ask("squeue", "-h") == ""


def test_every_command_of_the_page_does_what_it_says(cluster, root, folder):
    """Each block of docs/cluster.md in turn, once the jobs of the one before have ended."""
    (folder / "input").symlink_to(root / "input")
    text = (root / "docs/cluster.md").read_text()
    blocks = re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert blocks
    for block in blocks:
        cluster.ask("bash", "-ec", block, cwd=folder)
        cluster.wait_for(lambda: cluster.ask("squeue", "-h") == "", "the jobs of the page")
    told = cluster.ask("scontrol", "--oneliner", "show", "jobs").splitlines()
    jobs = [line for line in told if f"WorkDir={folder}" in line.split()]
    assert jobs
    said = {path.name: path.read_text()[-300:] for path in folder.glob("slurm-*.out")}
    assert [line.split()[0] for line in jobs if "JobState=COMPLETED" not in line] == [], said
    files = ("steady_lugre.h5", "sweep.h5", "short.h5", "sweep-study.png", "work.png", "0005-orbit.png")
    for name in files:
        assert (folder / name).exists(), name


def test_scripts_have_the_same_part(scripts):
    same = [
        re.search(r"\n# ---- the same in [a-z]*\.sh(.*?)# ---- end", (scripts / name).read_text(), re.S)
        for name in ("case.sh", "sweep.sh")
    ]
    assert same[0][1] == same[1][1]
