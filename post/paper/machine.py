"""The machine that a page is made on."""

import os
import platform
import re
from pathlib import Path


def machine(version: str, seconds: float | None) -> str:
    """Program, machine and time of the page; without `seconds` the runs are those of an earlier time."""
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    spent = "runs kept from an earlier time" if seconds is None else f"{seconds:.0f} s of runs and drawing"
    return f"{version}; {processor()}, {os.cpu_count()} cores, {system}; {spent}."


def processor() -> str:
    """Name of the processor."""
    try:
        found = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    except OSError:
        found = None
    return found[1] if found else platform.machine()
