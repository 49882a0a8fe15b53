"""Local Reynolds numbers of turbulent films."""

import numpy as np

from tiltpad.calculate import geometry, library
from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Run

#: Points along the arc at which the solver takes local Reynolds numbers, too.
POINTS = 201


def local_reynolds(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Places on the arc, 0 at the leading edge to 1 at the trailing edge, and rho U h/mu of each pad there at
    the equilibrium, (pad, place); `h` and, with temperatures in films, `mu` are those of the place.

    Raises NotInRunError for a run without turbulence.
    """
    if not run.is_turbulent:
        raise not_in_run(run, "turbulence", "film%turbulence is 'none'")
    place = np.linspace(0, 1, POINTS)
    # thicknesses are given from the trailing edge on
    thickness = geometry.surfaces(run.in_operation, geometry.at_time(run, None), POINTS).thickness[:, ::-1]
    # of the viscosity along the arc, ln(f0/mu) in powers from -1 to 1
    along = library.oil(run, None)[1][:, 2]
    local = thickness / np.exp(np.polynomial.polynomial.polyval(2 * place - 1, along))
    return place, local * (run["equilibrium/largest_reynolds_number"] / local.max(axis=1))[:, None]
