"""Studies of samples that tests make: parameters and results of their own in the file of a study."""

from collections.abc import Mapping
from pathlib import Path

import h5py
import numpy as np
from tiltpad.files.archive import FORMAT_VERSION

#: Units and meanings of what tests put into a study; all other columns are pure numbers with their names.
ABOUT = {
    "clearance": ("m", "bearing clearance"),
    "least_damping_ratio": ("1", "lowest damping ratio of the modes"),
    "rotor_damping_ratio": ("1", "lowest damping ratio of the rotor"),
    "equilibrium_rotor_stable": ("1", "1 where the rotor is stable"),
    "equilibrium_min_film_thickness": ("m", "minimum film thickness at the equilibrium"),
    "threshold_rpm": ("rpm", "threshold speed"),
    "threshold_sought_rpm": ("rpm", "highest speed at which a threshold speed was looked for"),
}


def write_study(
    path: Path,
    parameters: Mapping[str, np.ndarray],
    results: Mapping[str, np.ndarray],
    status: np.ndarray | None = None,
    reason: list[str] | None = None,
    title: str = "Sample",
) -> Path:
    """A study as the program writes it, without files of its runs; (run, 3) is of three pivots."""
    runs = len(next(iter(parameters.values())))
    with h5py.File(path, "w") as file:
        file.attrs.update(
            {
                "format_version": FORMAT_VERSION,
                "program": "tiltpad",
                "version": "0",
                "created": "2026-01-01T00:00:00",
                "title": title,
                "task": "study",
                "input": "&case\n/\n",
                "parameters": " ".join(parameters),
                "variables": "\n".join(f"bearing%{name}" for name in parameters),
                "runs": runs,
                "missing": "",
            }
        )
        file["run"] = np.arange(1, runs + 1)
        file["run"].make_scale("run")
        file.create_dataset("pivot", data=["free", "stuck", "locked"], dtype=h5py.string_dtype())
        file["pivot"].make_scale("pivot")
        done = np.zeros(runs, dtype=int) if status is None else status
        for name, values in {**parameters, "status": done, **results}.items():
            put(file, name, np.asarray(values))
        if reason is not None:
            put(file, "reason", np.array(reason, dtype=object))
    return path


def put(file: h5py.File, name: str, values: np.ndarray) -> None:
    """A column of the study."""
    if values.dtype.kind in "OU":
        column = file.create_dataset(name, data=values.astype(object), dtype=h5py.string_dtype())
    else:
        column = file.create_dataset(name, data=values)
    column.dims[0].attach_scale(file["run"])
    if values.ndim > 1:
        column.dims[1].attach_scale(file["pivot"])
    units, meaning = ABOUT.get(name, ("1", name.replace("_", " ")))
    column.attrs.update({"units": units, "long_name": meaning})
