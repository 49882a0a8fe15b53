"""What pyproject.toml cannot say: parts compiled for one machine and one Python, and programs.

The Makefile installs it with editable_mode=compat: so type checkers find the package of a checkout.
"""

from pathlib import Path

from setuptools import Distribution, setup

HERE = Path(__file__).parent
#: `make wheel` puts them here: what `tiltpad` starts, and the builds of the program for several processors.
PROGRAMS = HERE / "programs"


class CompiledDistribution(Distribution):
    """Tags the wheel with Python and platform where the compiled part is there."""

    def has_ext_modules(self) -> bool:
        return any(HERE.glob("tiltpad/_library.*"))


def programs() -> list[tuple[str, list[str]]]:
    """Folders of an environment, and what goes there."""
    files = [str(file.relative_to(HERE)) for file in PROGRAMS.glob("*")]
    start = str(PROGRAMS.relative_to(HERE) / "tiltpad")
    return [("bin", [start]), ("libexec/tiltpad", [file for file in files if file != start])] if files else []


setup(distclass=CompiledDistribution, data_files=programs())
