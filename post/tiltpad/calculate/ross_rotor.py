"""A rotor of ROSS as a file of matrices, for `rotor%file` of a machine in place of a shaft, and its seals.

ROSS has the axes x and y, y up, and its shafts turn from +x to +y about z. Here the shaft turns from +y to +z
about x: ROSS's x is -z, its y is y, its z is x.
"""

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from tiltpad.files.writing import hdf5, write_csv

#: ROSS's displacements of a node in which a shaft bends; axial ones and torsion stand alone and are left out.
BENDING = ("x", "y", "alpha", "beta")
#: Names of ROSS behind k, c and m in the order yy, yz, zy, zz, and their signs.
ELEMENT = (("yy", 1), ("yx", -1), ("xy", -1), ("xx", 1))
#: Columns of the table of an element.
COLUMNS = [f"{letter}_{each}" for letter in "kcm" for each in ("yy", "yz", "zy", "zz")]
#: Speeds, rpm, between which coefficients hold that do not depend on it.
ANY_SPEED = (1e-3, 1e6)


def from_ross(rotor: Any, path: str | os.PathLike, elements: Iterable[Any] | None = None) -> dict[str, Any]:
    """Writes the matrices of a `ross.Rotor` without its bearings: shaft, discs and their weight.

        groups = tiltpad.from_ross(rotor, "rotor.h5")        # {"rotor": {"file": ...}, "element": [...]}
        tiltpad.write_case("machine.nml", groups | {"bearing": [...], ...})

    Its nodes are the stations, counted from 1. Bearings and supports are those of the machine: a rotor with
    point masses, of which ROSS makes supports, is refused. It gives the groups of a case that name the file
    and have `elements`, by default the rotor's seals: these act in motion alone, as ROSS leaves them out of
    its statics, and bearings also at the equilibrium. Coefficients over speed or frequency go to tables
    beside the file, rotor-element-1.csv, ..., which are linear between their rows: ROSS 3 takes them so with
    interpolation="linear".
    """
    if len(rotor.point_mass_elements):
        use = "use disks, or supports of the machine"
        raise ValueError(f"rotor: has point masses, which are not taken: {use}")
    count, nodes = rotor.number_dof, len(rotor.nodes)
    places = rotor.shaft_elements[0].dof_mapping()
    every = np.ravel([[count * k + places[f"{name}_0"] for name in BENDING] for k in range(nodes)])
    # the displacements are -x, y, -alpha and -beta of each node, so that those of a station are z and y, and
    # its slopes dy/dx and dz/dx
    signs = np.tile([-1.0, 1.0, -1.0, -1.0], nodes)
    matrices = {"mass": rotor.M0, "damping": rotor.C0, "gyroscopic": rotor.G0, "stiffness": rotor.K0}
    kept = {name: np.asarray(matrix)[np.ix_(every, every)] for name, matrix in matrices.items()}
    found = {name: signs[:, None] * matrix * signs for name, matrix in kept.items()}
    station, slope = np.zeros((2, 2 * nodes, 4 * nodes))
    k = np.arange(nodes)
    station[2 * k, 4 * k + 1] = 1
    station[2 * k + 1, 4 * k] = 1
    slope[2 * k, 4 * k + 2] = 1
    slope[2 * k + 1, 4 * k + 3] = 1
    upward = station[::2].sum(axis=0)
    found |= {"station": station, "slope": slope, "weighed": found["mass"] @ upward}
    found |= {"total_mass": np.array(upward @ found["weighed"])}
    with hdf5(Path(path)) as file:
        for name, values in found.items():
            file[name] = np.asarray(values, dtype=float)
    if elements is None:
        elements = [each for each in getattr(rotor, "bearing_elements", ()) if is_seal(each)]
    groups = [element_of(each, nodes, Path(path), k) for k, each in enumerate(elements, 1)]
    return {"rotor": {"file": os.fspath(path)}} | ({"element": groups} if groups else {})


def is_seal(element: Any) -> bool:
    return any(each.__name__ == "SealElement" for each in type(element).__mro__)


def element_of(element: Any, nodes: int, path: Path, number: int) -> dict[str, Any]:
    """The group of an element of ROSS; a table of its coefficients is written."""
    seal = is_seal(element)
    group: dict[str, Any] = {"station": int(element.n) + 1, "static": not seal, "level": 2 if seal else 1}
    if element.n_link is not None:
        if not 0 <= element.n_link < nodes:
            raise ValueError(f"element {number}: n_link = {element.n_link}: is no node of the shaft")
        group["to_station"] = int(element.n_link) + 1
    speed, frequency = (
        None if each is None else np.atleast_1d(each) for each in (element.speed, element.frequency)
    )
    shape = (1 if speed is None else len(speed), 1 if frequency is None else len(frequency))
    names = [(f"{letter}{each}", sign) for letter in "kcm" for each, sign in ELEMENT]
    found = ((sign, np.asarray(getattr(element, name), dtype=float)) for name, sign in names)
    # a constant, or a value for each row of the table
    own = [sign * (each.reshape(shape) if each.size > 1 else np.full(shape, each)) for sign, each in found]
    values = np.stack(own, axis=-1)
    if values[..., 0].size == 1:
        stiffness, damping, mass = np.reshape(values, (3, 4))
        return group | {"stiffness": stiffness, "damping": damping, "mass": mass}
    speeds = np.array(ANY_SPEED) if speed is None else speed * 30 / np.pi
    heads, whirls = ["speed_rpm"], np.zeros((shape[1], 0))
    if frequency is not None:
        heads, whirls = ["speed_rpm", "frequency_hz"], frequency[:, None] / (2 * np.pi)
    rows = [
        [float(each), *map(float, whirls[j]), *map(float, values[i % len(values), j])]
        for i, each in enumerate(speeds)
        for j in range(shape[1])
    ]
    file = path.with_name(f"{path.stem}-element-{number}.csv")
    write_csv(file, [[*heads, *COLUMNS], *rows])
    return group | {"file": os.fspath(file)}
