"""A shaft with discs as a Python user would write it: Timoshenko beams, integrated over their shapes, and the
reduction of Craig and Bampton with damped high modes (docs/theory/machines.md).
"""

import numpy as np
from scipy.linalg import block_diag, eigh

#: Steel: Young's modulus, Poisson's ratio, density.
STEEL = (2.1e11, 0.3, 7850.0)


def section(length: float, diameter: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mass, gyroscopic and stiffness matrix in one plane of deflections and slopes at both ends."""
    young, poisson, density = STEEL
    area, second = np.pi / 4 * diameter**2, np.pi / 64 * diameter**4
    shear = 6 * (1 + poisson) / (7 + 6 * poisson) * young / (2 * (1 + poisson)) * area
    phi = 12 * young * second / (shear * length**2)
    places, weights = np.polynomial.legendre.leggauss(5)
    mass, gyroscopic, stiffness = np.zeros((3, 4, 4))
    for x, weight in zip((places + 1) / 2, weights * length / 2, strict=True):
        w = [2 * x**3 - 3 * x**2 + 1 + phi * (1 - x), length * (x**3 - 2 * x**2 + x + phi / 2 * (x - x**2)),
             3 * x**2 - 2 * x**3 + phi * x, length * (x**3 - x**2 + phi / 2 * (x**2 - x))]  # fmt: skip
        slope = [6 * (x**2 - x) / length, 3 * x**2 - 4 * x + 1 + phi * (1 - x),
                 6 * (x - x**2) / length, 3 * x**2 - 2 * x + phi * x]  # fmt: skip
        bend = [6 * (2 * x - 1) / length, 6 * x - 4 - phi, 6 * (1 - 2 * x) / length, 6 * x - 2 + phi]
        tilt = [6 * x**2 - 6 * x - phi, length * (3 * x**2 - 4 * x + 1 + phi / 2 * (1 - 2 * x)),
                6 * x - 6 * x**2 + phi, length * (3 * x**2 - 2 * x + phi / 2 * (2 * x - 1))]  # fmt: skip
        w, slope = np.array(w) / (1 + phi), np.array(slope) / (1 + phi)
        bend, sheared = np.array(bend) / length / (1 + phi), np.array(tilt) / length / (1 + phi) - slope
        mass += weight * density * (area * np.outer(w, w) + second * np.outer(slope, slope))
        gyroscopic += weight * density * 2 * second * np.outer(slope, slope)
        stiffness += weight * (young * second * np.outer(bend, bend) + shear * np.outer(sheared, sheared))
    return mass, gyroscopic, stiffness


class Rotor:
    """Matrices in y and z of each journal, then the amplitudes of the modes with the journals held, in y and
    z of each; forces of weight and unbalances; stations over these displacements. Stations count from 1."""

    def __init__(self, length, diameter, discs, unbalances, bearings, modes, damp_above, ratio, gravity=9.81):
        n = 2 * (len(length) + 1)
        mass, gyroscopic, stiffness = np.zeros((3, n, n))
        for k, each in enumerate(zip(length, diameter, strict=True)):
            part = slice(2 * k, 2 * k + 4)
            for whole, matrix in zip((mass, gyroscopic, stiffness), section(*each), strict=True):
                whole[part, part] += matrix
        for station, weight, diametral, polar in discs:
            at = 2 * station - 2
            mass[at, at] += weight
            mass[at + 1, at + 1] += diametral
            gyroscopic[at + 1, at + 1] += polar
        border = [2 * station - 2 for station in bearings]
        inner = [k for k in range(n) if k not in border]
        held = np.ix_(inner, inner)
        squares, shapes = eigh(stiffness[held], mass[held])
        basis = np.zeros((n, len(border) + modes))
        basis[border, range(len(border))] = 1
        basis[inner, : len(border)] = -np.linalg.solve(stiffness[held], stiffness[np.ix_(inner, border)])
        basis[inner, len(border) :] = shapes[:, :modes]
        frequency = np.sqrt(squares[:modes])
        damping = np.where(frequency > 2 * np.pi * damp_above, 2 * ratio * frequency, 0)
        self.mass, self.stiffness = (in_planes(basis.T @ each @ basis) for each in (mass, stiffness))
        self.damping = in_planes(block_diag(np.zeros((len(border), len(border))), np.diag(damping)))
        self.gyroscopic = np.kron(basis.T @ gyroscopic @ basis, [[0, 1], [-1, 0]])
        self.stations = in_planes(basis[::2])
        self.load = -gravity * np.kron(basis.T @ mass[:, ::2].sum(axis=1), [1, 0])
        turned = [moment * np.exp(1j * np.radians(angle)) for _, moment, angle in unbalances]
        rows = [basis[2 * station - 2] for station, *_ in unbalances]
        #: Complex: the force is Omega^2 times the real part of this times exp(i Omega t).
        self.unbalance = np.kron(np.array(turned) @ np.array(rows), [1, -1j])
        self.journals = 2 * len(border)


def in_planes(matrix: np.ndarray) -> np.ndarray:
    """The matrix in y and z, whose rows and columns take turns."""
    return np.kron(matrix, np.eye(2))
