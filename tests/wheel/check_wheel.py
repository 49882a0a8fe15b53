"""Checks the results of an installed wheel: check_wheel.py RESULT STUDY. Ends with "N passed, N failed"."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import tiltpad

RESULT, STUDY = sys.argv[1:]


def package() -> None:
    """It is the installed package that runs, and the program needs no library but glibc's."""
    assert Path(sys.prefix) in Path(tiltpad.__file__).parents, tiltpad.__file__
    for program in Path(sys.prefix, "libexec/tiltpad").iterdir():
        needed = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
        names = {line.split()[0].rpartition("/")[2].partition(".so")[0] for line in needed.splitlines()}
        assert names <= {"linux-vdso", "libm", "libmvec", "libc", "ld-linux-x86-64", "ld-linux-aarch64"}, (
            names
        )


def run() -> None:
    """The stopped and resumed run is complete."""
    with tiltpad.read(RESULT) as result:
        assert result.complete
        np.testing.assert_allclose(result.time[-1], 2, atol=1e-3)
        assert np.all(np.diff(result.time) > 0)


def library() -> None:
    """The compiled library gives the pressure of the equilibrium: by the same solver, to its tolerance."""
    with tiltpad.read(RESULT) as result:
        film = tiltpad.pressure(result)
        np.testing.assert_allclose(film.max_pressure, result["equilibrium/max_pressure"], rtol=1e-4)


def study() -> None:
    """Two runs were collected."""
    with tiltpad.read_study(STUDY) as found:
        assert len(found["speed_rpm"]) == 2


def pictures() -> None:
    """Plots and report were written."""
    for name in ("case-orbit.png", "case-spectrum.png", "case-pressure.png", "case.html"):
        assert Path(name).stat().st_size > 10_000, name


failed = 0
checks = (package, run, library, study, pictures)
for check in checks:
    try:
        check()
    except Exception as fault:
        failed += 1
        print(f"FAILED: {check.__name__}: {fault}")
print(f"{len(checks) - failed} passed, {failed} failed")
sys.exit(failed > 0)
