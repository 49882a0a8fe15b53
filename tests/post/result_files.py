"""Changes of result files that keep them whole."""

from collections.abc import Callable

import h5py
import numpy as np


def replace_series(file: h5py.File, series: Callable[[str, np.ndarray], np.ndarray], **options) -> None:
    """Puts other values, series(name, former values), for the datasets over the time, of any length.

    `options` are those of h5py's create_dataset.
    """
    former = {name: file[name] for name in file if isinstance(file[name], h5py.Dataset)}
    former = {name: each for name, each in former.items() if each.shape[:1] == file["time"].shape}
    values = {name: series(name, each[()]) for name, each in former.items()}
    for name, each in former.items():
        units = each.attrs["units"]
        del file[name]
        file.create_dataset(name, data=values[name], **options)
        file[name].attrs["units"] = units
    file["time"].make_scale("time")
    for name in former.keys() - {"time"}:
        for dimension, scale in zip(file[name].dims, ("time", "pad"), strict=False):
            dimension.attach_scale(file[scale])
