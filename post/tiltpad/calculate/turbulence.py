"""Local Reynolds numbers of turbulent films."""

import numpy as np

from tiltpad.calculate import geometry, library
from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Run


def local_reynolds(run: Run, points: int = 201) -> tuple[np.ndarray, np.ndarray]:
    """Places on the arc, 0 at the leading edge to 1 at the trailing edge, and rho U h/mu of each pad there at
    the equilibrium, (pad, place); `h` and, with temperatures in films, `mu` are those of the place.

    Raises NotInRunError for a run without turbulence.
    """
    if not run.is_turbulent:
        raise not_in_run(run, "turbulence", "film%turbulence is 'none'")
    case, place = run.in_operation, np.linspace(0, 1, points)
    # thicknesses are given from the trailing edge on
    thickness = geometry.surfaces(case, geometry.at_time(run, None), points).thickness[:, ::-1]
    viscosity, along = library.oil(run, None)
    given = np.where(viscosity > 0, viscosity, case["bearing"].get("viscosity", np.nan))
    # of the viscosity along the arc, ln(f0/mu) in powers from -1 to 1
    weight = np.exp(np.polynomial.polynomial.polyval(2 * place - 1, along[:, 2]))
    speed = np.pi / 30 * case["operation"]["speed_rpm"] * case["bearing"]["journal_radius"]
    return place, case["oil"]["density"] * speed * thickness / (given[:, None] * weight)
