"""A Slurm of one node, started by hand in a folder of its own: munged, slurmctld, slurmd."""

import os
import secrets
import shutil
import signal
import socket
import subprocess
import time
from contextlib import ExitStack, suppress
from pathlib import Path

PROGRAMS = ("munged", "munge", "slurmctld", "slurmd", "sbatch", "scancel", "scontrol", "sinfo", "squeue")

# proctrack/pgid: the default loses jobs where there is no cgroup freezer, and calls them completed.
# cred_expire: a requeued job waits for it, at least five seconds (less is taken for the default, 120).
CONFIGURATION = """\
ClusterName=tiltpad
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/log/slurmctld
SlurmdLogFile={folder}/log/slurmd
MailProg=/bin/true
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,sched_min_interval=100000,batch_sched_delay=0
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MinJobAge=3600
NodeName=localhost NodeAddr=127.0.0.1 CPUs={processors} RealMemory=16000
PartitionName=main Nodes=localhost Default=YES PriorityTier=2
PartitionName=low Nodes=localhost PriorityTier=1
"""


class CannotStartError(Exception):
    """Why there is no Slurm to be had here."""


class Cluster:
    """The daemons, and what is asked of them. A context: at its end every process of it is gone.

    `path` is searched for commands before PATH, by the jobs too.
    """

    def __init__(self, folder: Path, path: str, processors: int):
        own = ("SLURM", "SBATCH", "SQUEUE", "SCONTROL")
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(own)}
        self.environment["PATH"] = f"{path}:{os.environ['PATH']}:/usr/sbin:/sbin"
        self.environment["SLURM_CONF"] = f"{folder}/slurm.conf"
        self.folder, self.processors, self.daemons = folder, processors, []

    def __enter__(self) -> "Cluster":
        missing = [name for name in PROGRAMS if not shutil.which(name, path=self.environment["PATH"])]
        if missing:
            raise CannotStartError(f"not installed: {', '.join(missing)}")
        if os.geteuid() != 0:
            raise CannotStartError("its daemons are started as root")
        with ExitStack() as stack:
            stack.callback(self.stop)
            self.start()
            stack.pop_all()
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def start(self) -> None:
        """Starts the daemons and waits until the node takes jobs."""
        for name in ("", "state", "spool", "log", "munge"):
            (self.folder / name).mkdir(exist_ok=True)
            (self.folder / name).chmod(0o755)
        key = self.folder / "munge/key"
        key.touch(0o600)
        key.write_bytes(secrets.token_bytes(128))
        text = CONFIGURATION.format(folder=self.folder, ports=free_ports(2), processors=self.processors)
        (self.folder / "slurm.conf").write_text(text)
        files = [f"--{name}-file={self.folder}/munge/{name}" for name in ("key", "pid", "seed", "log")]
        socket_option = f"--socket={self.folder}/munge/socket"
        self.daemon("munged", "--foreground", socket_option, *files)
        self.wait_for_daemons(lambda: self.call("munge", socket_option, "--no-input").returncode == 0)
        self.daemon("slurmctld", "-D")
        self.daemon("slurmd", "-D")
        self.wait_for_daemons(lambda: set(self.call("sinfo", "-h", "-o", "%T").stdout.split()) == {"idle"})

    def wait_for_daemons(self, condition) -> None:
        """Waits until the daemons do what is asked; CannotStartError where one ends or none of them does."""

        def told() -> bool:
            for each in self.daemons:
                if each.poll() is not None:
                    lines = (self.folder / "log/out").read_text().splitlines()
                    said = [line for line in lines if line.startswith(f"{each.args[3]}: error: ")]
                    raise CannotStartError(said[0] if said else f"{each.args[3]} ended without a word")
            return condition()

        try:
            self.wait_for(told, "the daemons")
        except TimeoutError as error:
            raise CannotStartError(error) from error

    def daemon(self, *command: str) -> None:
        """Starts a daemon, which ends with this process even where that is killed."""
        with open(self.folder / "log/out", "a") as log:
            self.daemons.append(
                subprocess.Popen(
                    ["setpriv", "--pdeathsig", "TERM", *command],
                    stdin=subprocess.DEVNULL,
                    stdout=log,
                    stderr=log,
                    env=self.environment,
                    start_new_session=True,
                )
            )

    def stop(self) -> None:
        """Ends jobs and daemons; what is left of them after some seconds is killed."""
        self.call("scancel", "--user=root")
        with suppress(TimeoutError):
            self.wait_for(lambda: not self.call("squeue", "-h").stdout, "the last job", 10)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            with suppress(subprocess.TimeoutExpired):
                daemon.wait(5)
        for process in self.processes():
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        for daemon in self.daemons:
            daemon.wait()

    def processes(self) -> list[int]:
        """The processes that know this cluster's configuration: daemons, jobs and their programs."""
        mark = f"SLURM_CONF={self.environment['SLURM_CONF']}".encode()
        found = []
        for each in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if mark in (each / "environ").read_bytes().split(b"\0"):
                    found.append(int(each.name))
        return found

    def call(self, *command: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess:
        """Runs a command that knows this cluster."""
        return subprocess.run(
            [str(each) for each in command],
            cwd=cwd,
            env=self.environment,
            text=True,
            capture_output=True,
            timeout=300,
        )

    def ask(self, *command: str | Path, cwd: Path | None = None) -> str:
        """Standard output of a command, which must succeed."""
        done = self.call(*command, cwd=cwd)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))}: {done.stderr or done.stdout}")
        return done.stdout.strip()

    def submit(self, *arguments: str | Path, cwd: Path) -> str:
        """Submits a job with sbatch; gives its number."""
        return self.ask("sbatch", "--parsable", *arguments, cwd=cwd)

    def job(self, number: str) -> dict[str, str]:
        """What Slurm says of a job or a task of an array: JobState, ExitCode, Restarts, ..."""
        words = self.ask("scontrol", "--oneliner", "show", "job", number).split()
        return dict(word.split("=", 1) for word in words if "=" in word)

    def running(self, number: str) -> list[str]:
        """The jobs under this number that run now: "12", or the tasks "12_3"."""
        return self.ask("squeue", "-h", "-r", "-t", "running", "-j", number, "-o", "%i").split()

    def ended(self, number: str) -> dict[str, str]:
        """Waits until a job has ended and left the node, for good; gives what Slurm says of it."""
        self.wait_for(lambda: self.call("squeue", "-h", "-j", number).stdout == "", f"job {number}")
        return self.job(number)

    def wait_for(self, condition, what: str, seconds: float = 120) -> None:
        """Waits until the condition is true; TimeoutError says for what, with the ends of the logs."""
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                logs = [log.read_text().splitlines()[-15:] for log in sorted((self.folder / "log").iterdir())]
                raise TimeoutError("\n".join([f"{what}: not within {seconds} s", *sum(logs, [])]))
            time.sleep(0.1)


def free_ports(count: int) -> list[int]:
    """Ports of this machine that nobody listens on."""
    with ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
