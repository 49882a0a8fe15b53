"""Runs a program within a limit of its own CPU time, which other work on the machine does not use up."""

import os
import resource
import signal
import subprocess
import tempfile
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

#: CPU time, s, in which a program that notes the limit's signal must stop.
NOTICE = 30
#: Limit by the clock, in limits of the CPU time: the last resort against a program that only waits.
TIMEOUT = 20


@dataclass
class Ended:
    """How a program ended."""

    returncode: int
    stdout: str
    stderr: str
    #: CPU time, s; most memory, bytes.
    seconds: float
    memory: int

    @property
    def hung(self) -> bool:
        """Whether the limit has ended the program, which did not end by itself."""
        return self.returncode in (-signal.SIGXCPU, -signal.SIGKILL)


def limited(command: Sequence, folder: Path, seconds: int, env: dict[str, str] | None = None) -> Ended:
    """Runs a command in a folder for so much CPU time, s; then SIGXCPU asks it to stop."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as error:
        process = subprocess.Popen(list(map(str, command)), cwd=folder, env=env, stdout=out, stderr=error)
        resource.prlimit(process.pid, resource.RLIMIT_CPU, (seconds, seconds + NOTICE))
        last_resort = threading.Timer(TIMEOUT * seconds, process.kill)
        last_resort.start()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        last_resort.cancel()
        spent = used.ru_utime + used.ru_stime
        return Ended(process.returncode, said(out), said(error), spent, used.ru_maxrss << 10)


def said(file: BinaryIO) -> str:
    """What a program has written."""
    file.seek(0)
    return file.read().decode(errors="replace")
