"""Films of fixed pads by a solver of their own, and their stiffness and damping by differences of forces.

It shares no scheme with the program: pressures at nodes, not means of cells, equally spaced over
Sommerfeld's variable along the arc and as sines across half the width, elimination in a band, policy
iteration for the condition of Reynolds, and no adjoints. Lengths are over the radius of the pad, film
thicknesses over the clearance, pressures over mu omega (R/c)^2.
"""

import numpy as np
from scipy.linalg import solve_banded

#: Of differences of the fourth order: their error is far below that of the grids.
STEP = 0.04


class Film:
    """One pad of an arc, rad, and a length; the nodes follow the film at this position and stay there.

    `surface` is the radius of the journal, whose surface drives the film.
    """

    def __init__(self, arc, length, surface, position, columns, rows):
        fine = np.linspace(-arc / 2, arc / 2, 20001)
        per_thickness = 1 / thickness(position, fine)
        along = np.concatenate([[0], np.cumsum((per_thickness[1:] + per_thickness[:-1]) / 2)])
        self.phi = np.interp(np.linspace(0, along[-1], columns + 1), along, fine)
        self.z = length / 2 * np.sin(np.linspace(0, np.pi / 2, rows + 1))
        self.surface = surface
        self.full = np.ones((columns - 1, rows), dtype=bool)

    def force(self, position, velocity):
        """Force on the journal in the mid-arc frame, over mu omega R^4/c^2."""
        phi, z, columns, rows = self.phi, self.z, len(self.phi) - 2, len(self.z) - 1
        middle = (phi[1:] + phi[:-1]) / 2
        face = thickness(position, middle) ** 3 / np.diff(phi)
        width = (phi[2:] - phi[:-2]) / 2
        height = np.append(np.diff(z)[0] / 2, (z[2:] - z[:-2]) / 2)
        cube = thickness(position, phi[1:-1]) ** 3 * width
        across = np.diag(1 / np.diff(z)) + np.diag(np.append(0, 1 / np.diff(z)[:-1]))
        across -= np.diag(1 / np.diff(z)[:-1], 1) + np.diag(1 / np.diff(z)[:-1], -1)
        squeeze = -velocity[0] * np.sin(phi[1:-1]) - velocity[1] * np.cos(phi[1:-1])
        source = 6 * self.surface * np.diff(thickness(position, middle)) - 12 * squeeze * width
        load = np.outer(source, height)
        for _ in range(300):
            pressure = self.eliminate(face, cube, across, height, load)
            padded = np.pad(pressure, ((1, 1), (0, 0)))
            flow = face[:-1, None] * padded[:-2] + face[1:, None] * padded[2:]
            inflow = flow * height - cube[:, None] * (pressure @ (across - np.diag(np.diag(across))).T) + load
            full = np.where(self.full, pressure >= 0, inflow > 1e-14)
            if (full == self.full).all():
                break
            self.full = full
        else:
            raise RuntimeError("the cavitation does not settle")
        assert pressure.shape == (columns, rows)
        sums = 2 * pressure @ height * width
        return -np.array([sums @ np.sin(phi[1:-1]), sums @ np.cos(phi[1:-1])])

    def eliminate(self, face, cube, across, height, load):
        """Pressures of the nodes that are in the film, 0 elsewhere, (column, row)."""
        full, rows = self.full, len(height)
        # rows of the matrix for nodes that are not in the film are those of the unit matrix
        band = np.zeros((2 * rows + 1, *full.shape))
        inner = cube[:, None] * np.diag(across) + (face[:-1] + face[1:])[:, None] * height
        band[rows] = np.where(full, inner, 1)
        band[rows - 1, :, 1:] = cube[:, None] * np.diag(across, 1) * full[:, :-1]
        band[rows + 1, :, :-1] = cube[:, None] * np.diag(across, -1) * full[:, 1:]
        coupling = -face[1:-1, None] * height
        band[0, 1:] = coupling * full[:-1]
        band[-1, :-1] = coupling * full[1:]
        solution = solve_banded((rows, rows), band.reshape(2 * rows + 1, -1), (load * full).ravel())
        return solution.reshape(full.shape) * full


def thickness(position, phi):
    return 1 - position[0] * np.sin(phi) - position[1] * np.cos(phi)


def linearised(arc, length, surface, position, columns, rows):
    """Force, and its derivatives over position and velocity (over the shaft speed), (component, variable)."""
    film = Film(arc, length, surface, position, columns, rows)
    thinnest = thickness(position, film.phi).min()
    eccentricity = np.hypot(*position)
    towards = np.column_stack([[position[1], -position[0]], position]) / eccentricity
    # over the length on which the film becomes twice as thick, across and towards the thinnest place
    wide = np.sqrt(2 * thinnest)
    force = film.force(position, np.zeros(2))
    derivatives = np.zeros((2, 4))
    for k, step in enumerate(STEP * np.array([wide, thinnest, wide, wide])):
        for side, weight in ((-2, 1 / 12), (-1, -2 / 3), (1, 2 / 3), (2, -1 / 12)):
            motion = np.zeros((2, 2))
            motion[k // 2] = side * step * towards[:, k % 2]
            derivatives[:, k] += weight * film.force(position + motion[0], motion[1]) / step
    derivatives[:, :2] = derivatives[:, :2] @ towards.T
    derivatives[:, 2:] = derivatives[:, 2:] @ towards.T
    return force, derivatives
