"""What pyproject.toml cannot say: the package holds a part compiled for one machine and one Python."""

from pathlib import Path

from setuptools import Distribution, setup


class CompiledDistribution(Distribution):
    """Tags the wheel with Python and platform where the compiled part is there."""

    def has_ext_modules(self) -> bool:
        return any(Path(__file__).parent.glob("tiltpad/_library.*"))


setup(distclass=CompiledDistribution)
