"""The input kept in a file makes the same run again."""

import h5py
import numpy as np
import pytest


def datasets(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(
            lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None
        )
        return found, file.attrs["input"]


@pytest.mark.parametrize("case_name", ["lugre", "tilting", "fixed", "runup", "equilibrium"])
def test_bit_for_bit(result, tiltpad, tmp_path, case_name):
    first, text = datasets(result(case_name))
    (tmp_path / "again.nml").write_text(text)
    tiltpad("--quiet", "again.nml", cwd=tmp_path, status=0)
    second, again = datasets(tmp_path / "again.h5")
    assert again == text
    assert set(second) == set(first)
    for name in first:
        if not (name.startswith("statistics/") and name.endswith("_seconds")):
            np.testing.assert_array_equal(second[name], first[name], err_msg=name, strict=True)
