"""Result files that the tests share: short runs of the program, one a scene."""

import warnings
from pathlib import Path

import matplotlib as mpl
import pytest
import tiltpad as package

mpl.use("agg")

SCENES = {
    "lugre": "&case title='Steady, it''s LuGre' / &operation duration=0.06 / &friction model='lugre' /",
    "bengisu": "&operation duration=0.06 / &friction model='bengisu_akay' /",
    "none": "&operation duration=0.06 /",
    "tilting": "&operation duration=0.06 / &friction model='lugre' / &pads motion='tilting_only' /",
    "four": "&operation duration=0.02 / &friction model='lugre' / &pads pivot_angle_deg=-45,225,45,135 /",
    "gumbel": "&operation duration=0.02 / &pads pivot_angle_deg=-45,225,45,135 / &film cavitation='gumbel' /",
    "sor": "&operation duration=0.02 / &pads pivot_angle_deg=-45,225,45,135 / &film solver='sor' /",
    "flooded": "&operation duration=0.02 / &bearing supply_pressure=3e5, ambient_pressure=1e5 / "
    "&pads pivot_angle_deg=-45,225,45,135, pivot_ratio=0.5,0.6,0.5,0.5, motion='tilting_only' /",
    "runup": "&operation speed_rpm=1500, final_speed_rpm=6500, duration=0.1 / &friction model='lugre' /",
    "equilibrium": "&case task='equilibrium' /",
}


@pytest.fixture(scope="session")
def result(tiltpad, tmp_path_factory):
    """result("lugre"): path of that scene's result file; the program runs when it is first asked for."""
    folder = tmp_path_factory.mktemp("results")

    def path(scene: str) -> Path:
        file = folder / f"{scene}.h5"
        if not file.exists():
            case = folder / f"{scene}.nml"
            case.write_text(SCENES[scene].replace(" / &", " /\n&") + "\n")
            done = tiltpad("--quiet", case.name, cwd=folder)
            assert done.returncode == 0, done.stderr
        return file

    return path


@pytest.fixture
def run(result):
    """run("lugre"): that scene's result, opened by the package; an incomplete one would be an error."""
    opened = []

    def read(scene: str) -> package.Run:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            opened.append(package.read(result(scene)))
        return opened[-1]

    yield read
    for each in opened:
        each.close()


@pytest.fixture
def changed(result, tmp_path):
    """changed("lugre", edit): path of a copy of that result that the function `edit` changed."""
    import h5py

    def copy(scene: str, edit) -> Path:
        path = tmp_path / f"{scene}-changed.h5"
        path.write_bytes(result(scene).read_bytes())
        with h5py.File(path, "r+") as file:
            edit(file)
        return path

    return copy
