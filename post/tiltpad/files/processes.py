"""Processes that the package starts: none lives longer than the one that started it, however that ended."""

import ctypes
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeVar

from tiltpad.files.archive import RunError
from tiltpad.files.writing import look

Part = TypeVar("Part")
Result = TypeVar("Result")

#: The program, where the environment variable TILTPAD names no other.
PROGRAM = "tiltpad"
#: Signals that end or interrupt a process.
INTERRUPTS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
#: The system's own functions, and the number with which prctl asks for a signal at the parent's end.
SYSTEM, PARENT_DEATH_SIGNAL = ctypes.CDLL(None), 1


class MissingProgramError(RunError):
    """There is no program to run."""


def program() -> str:
    """The program: TILTPAD in the environment, that of this Python, on PATH, or built where the source is."""
    if given := os.environ.get("TILTPAD"):
        if not os.access(given, os.X_OK):
            raise MissingProgramError(f"TILTPAD = {given}: no program")
        return given
    beside = Path(sys.executable).parent / PROGRAM
    built = Path(__file__).resolve().parents[3] / "build/bin" / PROGRAM
    for each in (beside, shutil.which(PROGRAM), built):
        if each and os.access(each, os.X_OK):
            return os.fspath(each)
    raise MissingProgramError(
        "no program tiltpad: build it (make build), put it on PATH, or name it in the variable TILTPAD"
    )


def run_program(words: Sequence[str], **options: Any) -> subprocess.CompletedProcess:
    """Runs a program as subprocess.run does, and asks it to stop where this process ends before it."""
    parent = os.getpid()

    def follow() -> None:
        SYSTEM.prctl(PARENT_DEATH_SIGNAL, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(1)

    return subprocess.run(words, text=True, preexec_fn=follow, **options)


def write_table(log: str | os.PathLike, target: str | os.PathLike) -> None:
    """Has the program make the file of a study of its log. Raises RunError."""
    words = [program(), "--table", os.fspath(log), "--output", os.fspath(target)]
    done = run_program(words, stderr=subprocess.PIPE)
    if done.returncode:
        raise RunError(done.stderr.strip().removeprefix("tiltpad: error: "))


def side_by_side(work: Callable[[Part], Result], parts: Iterable[Part]) -> list[Result]:
    """The result of `work` for each of the parts, which have a process each.

    All are ended where one of them fails, which is an EOFError, and where this process is interrupted.
    """
    with ExitStack() as stack:
        results = [started(stack, work, part) for part in parts]
        # an interrupt may have come in the end of an object, where it is lost
        look()
        return [each.recv() for each in results]


def started(stack: ExitStack, work: Callable[[Part], Result], part: Part) -> Connection:
    """Where the result of `work` will come from; the stack ends its process."""
    receive, send = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=worker, args=(work, part, send), daemon=True)
    # an interrupt here would lose the process
    former = signal.pthread_sigmask(signal.SIG_BLOCK, INTERRUPTS)
    try:
        process.start()
        stack.callback(process.join)
        stack.callback(process.kill)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, former)
    send.close()
    return receive


def worker(work: Callable[[Part], Result], part: Part, send: Connection) -> None:
    begin_worker()
    send.send(work(part))


def begin_worker() -> None:
    """What a worker does first: it leaves Ctrl-C to its parent, and follows its end."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for each in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(each, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, INTERRUPTS)
    threading.Thread(target=end_with_parent, daemon=True).start()


def end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)
