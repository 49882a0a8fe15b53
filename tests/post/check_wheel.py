"""Tries an installed wheel, in an environment of its own: python check_wheel.py RESULT-FILE."""

import sys
from pathlib import Path

import numpy as np
import tiltpad

assert Path(sys.prefix) in Path(tiltpad.__file__).parents, f"not the installed package: {tiltpad.__file__}"
with tiltpad.read(sys.argv[1]) as run:
    film = tiltpad.pressure(run)
    np.testing.assert_allclose(film.max_pressure, run["equilibrium/max_pressure"], rtol=1e-6)
    print(f"wheel: {run.pads} pads, highest pressure {film.pressure.max() / 1e6:.3f} MPa")
