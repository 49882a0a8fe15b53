"""Processes that the package starts: none lives longer than the one that started it, however that ended."""

import ctypes
import multiprocessing
import os
import signal
import subprocess
import threading
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from multiprocessing.connection import Connection
from typing import Any, TypeVar

Part = TypeVar("Part")
Result = TypeVar("Result")

#: Signals that end or interrupt a process.
INTERRUPTS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
#: The system's own functions, and the number with which prctl asks for a signal at the parent's end.
SYSTEM, PARENT_DEATH_SIGNAL = ctypes.CDLL(None), 1


def run_program(words: Sequence[str], **options: Any) -> subprocess.CompletedProcess:
    """Runs a program as subprocess.run does, and asks it to stop where this process ends before it."""
    parent = os.getpid()

    def follow() -> None:
        SYSTEM.prctl(PARENT_DEATH_SIGNAL, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(1)

    return subprocess.run(words, text=True, preexec_fn=follow, **options)


def side_by_side(work: Callable[[Part], Result], parts: Iterable[Part]) -> list[Result]:
    """The result of `work` for each of the parts, which have a process each.

    All are ended where one of them fails, which is an EOFError, and where this process is interrupted.
    """
    with ExitStack() as stack:
        results = [started(stack, work, part) for part in parts]
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
