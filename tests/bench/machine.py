"""On what the benchmark ran: processor, system, compiler, versions."""

import os
import platform
import re
import subprocess
from importlib.metadata import version

from paper.machine import processor
from peers import PROGRAM
from settings import ROOT


def described(found: dict[str, dict]) -> str:
    """A list for the page; `found` are the parts' records."""
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    compiler, flags = compiled()
    lines = [
        f"- machine: {processor()}, {os.cpu_count()} cores; {system}",
        f"- compiler: {compiler}; flags `{flags}`",
        f"- peers: Python {platform.python_version()}, NumPy {version('numpy')}, SciPy {version('scipy')}, "
        f"Numba {version('numba')}; {first_line(PROGRAM, '--version') or 'Octave is not installed'}",
    ]
    marks = {name: f"{record['version']}, {record['date']}" for name, record in found.items()}
    minutes = sum(record["seconds"] for record in found.values()) / 60
    if len(set(marks.values())) == 1:
        lines.append(f"- {next(iter(marks.values()))}; {minutes:.0f} minutes")
    else:
        lines += [f"- {name}: {mark}" for name, mark in marks.items()]
    return "\n".join(lines)


def compiled() -> tuple[str, str]:
    """Compiler and its flags, as the Makefile keeps them."""
    words = (ROOT / "build/flags").read_text().split()
    flags = [word for word in words[1:] if re.match(r"-[Omfgs]", word)]
    return first_line(words[0], "--version"), " ".join(flags)


def first_line(*command: str) -> str:
    """First line that a command says, '' where it is not there."""
    try:
        done = subprocess.run(command, text=True, capture_output=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.partition("\n")[0]
