"""A rotor of ROSS as a file of matrices, which `rotor%file` of a machine reads in place of a shaft.

ROSS has the axes x and y, y up, and its shafts turn from +x to +y about z. Here the shaft turns from +y to +z
about x: ROSS's x is -z, its y is y, its z is x.
"""

import os
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.files.writing import hdf5

#: ROSS's displacements of a node in which a shaft bends; axial ones and torsion stand alone and are left out.
BENDING = ("x", "y", "alpha", "beta")


def from_ross(rotor: Any, path: str | os.PathLike) -> None:
    """Writes the matrices of a `ross.Rotor` without its bearings: shaft, discs and their weight.

    Its nodes are the stations, counted from 1. Bearings and supports are those of the machine: a rotor with
    point masses, of which ROSS makes supports, is refused.
    """
    if len(rotor.point_mass_elements):
        use = "use disks, or supports of the machine"
        raise ValueError(f"rotor: has point masses, which are not taken: {use}")
    count, nodes = rotor.number_dof, len(rotor.nodes)
    places = rotor.shaft_elements[0].dof_mapping()
    every = np.ravel([[count * k + places[f"{name}_0"] for name in BENDING] for k in range(nodes)])
    # the displacements are -x, y, alpha and beta of each node, so that those of a station are z and y
    signs = np.tile([-1.0, 1.0, 1.0, 1.0], nodes)
    matrices = {"mass": rotor.M0, "damping": rotor.C0, "gyroscopic": rotor.G0, "stiffness": rotor.K0}
    kept = {name: np.asarray(matrix)[np.ix_(every, every)] for name, matrix in matrices.items()}
    found = {name: signs[:, None] * matrix * signs for name, matrix in kept.items()}
    station, slope = np.zeros((2, 2 * nodes, 4 * nodes))
    k = np.arange(nodes)
    station[2 * k, 4 * k + 1] = 1
    station[2 * k + 1, 4 * k] = 1
    # dy/dx is -alpha, dz/dx is -beta
    slope[2 * k, 4 * k + 2] = -1
    slope[2 * k + 1, 4 * k + 3] = -1
    upward = station[::2].sum(axis=0)
    found |= {"station": station, "slope": slope, "weighed": found["mass"] @ upward}
    found |= {"total_mass": np.array(upward @ found["weighed"])}
    with hdf5(Path(path)) as file:
        for name, values in found.items():
            file[name] = np.asarray(values, dtype=float)
