"""Runs one command on one core, or on all, and prints its wall seconds, peak memory in MB, exit status and
the seconds of processor time of it and its children.

usage: launch.py CORE|all LIMIT COMMAND...     (LIMIT: seconds after which it is killed)

A process of its own, and small: a peak memory is inherited over `exec`, so a command started straight from
the benchmark would be charged with the benchmark's own.
"""

import os
import signal
import sys
import time


def main(core: int | None, limit: int, command: list[str]) -> None:
    started = time.perf_counter()
    child = os.fork()
    if child == 0:
        os.setsid()
        if core is not None and hasattr(os, "sched_setaffinity"):
            free = sorted(os.sched_getaffinity(0))
            os.sched_setaffinity(0, {free[core % len(free)]})
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.execvp(command[0], command)
    signal.signal(signal.SIGALRM, lambda *_: os.killpg(child, signal.SIGKILL))
    signal.alarm(limit)
    _, status, used = os.wait4(child, 0)
    seconds = time.perf_counter() - started
    print(seconds, used.ru_maxrss / 1024, os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime)


main(None if sys.argv[1] == "all" else int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
