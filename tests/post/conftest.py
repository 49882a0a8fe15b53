"""Result files that the tests share: short runs of the program, one a case."""

import gc
import itertools
import os
import sys
import warnings
from pathlib import Path

import h5py
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
import tiltpad as package
from result_files import replace_series
from ross_machine import recorded, recording
from tiltpad.command import OBJECTS
from tiltpad.draw import layout

mpl.use("agg")
# as the commands do, which say why
gc.set_threshold(OBJECTS)
#: The paper's package, post/paper, is not installed.
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "post"))

CASES = {
    "lugre": "&case title='Steady, it''s LuGre' / &operation duration=0.06 / &friction model='lugre' /",
    "bengisu": "&operation duration=0.06 / &friction model='bengisu_akay' /",
    "none": "&operation duration=0.06 /",
    "tilting": "&operation duration=0.06 / &friction model='lugre' / &pads motion='tilting_only' /",
    "four": "&operation duration=0.02 / &friction model='lugre' / &pads pivot_angle_deg=-45,225,45,135 /",
    "gumbel": "&operation duration=0.02 / &pads pivot_angle_deg=-45,225,45,135 / &film cavitation='gumbel' /",
    "sor": "&operation duration=0.02 / &pads pivot_angle_deg=-45,225,45,135 / &film solver='sor' /",
    "flooded": "&operation duration=0.02 / &bearing supply_pressure=3e5, ambient_pressure=1e5 / "
    "&pads pivot_angle_deg=-45,225,45,135, pivot_ratio=0.5,0.6,0.5,0.5, motion='tilting_only' /",
    "excited": "&operation duration=0.06 / &friction model='lugre' / "
    "&excitation amplitude=100, frequency_hz=80 / &excitation kind='step', amplitude=200, start=0.01 /",
    "runup": "&operation speed_rpm=1500, final_speed_rpm=6500, duration=0.1 / &friction model='lugre' /",
    "pitching": "&operation duration=0.02 / &friction model='lugre' / &bearing slope=2e-4,1e-4 / "
    "&pads motion='tilting_radial_pitch_yaw', pivot_axial_offset=1e-3, 0 / &film cavitation='none' /",
    "fixed": "&operation duration=0.06 / &pads motion='fixed' /",
    "equilibrium": "&case task='equilibrium' /",
    "turbulent": "&case task='equilibrium' / &film turbulence='ng_pan' /",
    "periodic": "&case task='periodic' / &friction model='lugre' /",
    "curve": "&case task='branch' / &rotor mass=200, unbalance=0 / &operation speed_rpm=12500 / "
    "&branch of='curve', point='hopf', parameter='operation%speed_rpm', last=20000, "
    "second_parameter='rotor%mass', second_last=400 /",
    "branch": "&case task='branch' / &operation speed_rpm=3000 / &output samples_per_revolution=60 / "
    "&branch parameter='operation%speed_rpm', last=4000, step=50, max_step=80 /",
    # offset pivots and a load beside the vertical: no symmetry
    "offset": "&case title='Offset', task='coefficients' / &coefficients frequency_ratio=0.5, 1, 2 / "
    "&pads pivot_angle_deg=-54, 18, 90, 162, 234, arc_deg=60, pivot_ratio=0.6 / "
    "&bearing preload=0.3 / &rotor mass=1200, static_load=0, 4000 / &friction model='lugre' /",
}


@pytest.fixture
def closed_figures():
    """For tests that draw."""
    yield
    plt.close("all")


@pytest.fixture
def quick_pictures(closed_figures, monkeypatch):
    """For tests that write pictures: with fewer pixels, and without the layout, which takes most of the time.

    test_nothing_is_cut_off lays out every plot.
    """
    whole = layout.write

    def write(figure, *arguments, **options):
        figure.set_layout_engine("none")
        with mpl.rc_context({"savefig.dpi": 160}):
            whole(figure, *arguments, **options)

    monkeypatch.setattr(layout, "write", write)


@pytest.fixture(scope="session")
def cases():
    """Texts of the cases by their names."""
    return CASES


@pytest.fixture(scope="session")
def result(tiltpad, tmp_path_factory):
    """result("lugre"): path of that case's result file; the program runs when it is first asked for."""
    folder = tmp_path_factory.mktemp("results")

    def path(case: str) -> Path:
        file = folder / f"{case}.h5"
        if not file.exists():
            namelist = folder / f"{case}.nml"
            namelist.write_text(CASES[case].replace(" / &", " /\n&") + "\n")
            done = tiltpad("--quiet", namelist.name, cwd=folder)
            assert done.returncode == 0, done.stderr
        return file

    return path


@pytest.fixture
def opened():
    """opened(path): a result, opened by the package, and closed at the end of the test."""
    runs = []

    def read(path: Path) -> package.Run:
        runs.append(package.read(path))
        return runs[-1]

    yield read
    for each in runs:
        each.close()


@pytest.fixture
def run(result, opened):
    """run("lugre"): that case's result, opened; an incomplete one would be an error."""

    def read(case: str) -> package.Run:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return opened(result(case))

    return read


@pytest.fixture
def tiltpad_set(tiltpad, result, opened, tmp_path):
    """tiltpad_set("none", "rotor%unbalance=0.02"): the result of that case with that value changed."""
    numbers = itertools.count()

    def run(case: str, change: str) -> package.Run:
        output = tmp_path / f"set{next(numbers)}.h5"
        namelist = result(case).with_suffix(".nml")
        done = tiltpad("--quiet", namelist, "--set", change, "--output", output)
        assert done.returncode == 0, done.stderr
        return opened(output)

    return run


@pytest.fixture
def changed(result, tmp_path):
    """changed("lugre", edit): path of a copy of that result that the function `edit` changed."""
    import h5py

    def copy(case: str, edit) -> Path:
        path = tmp_path / f"{case}-changed.h5"
        path.write_bytes(result(case).read_bytes())
        with h5py.File(path, "r+") as file:
            edit(file)
        return path

    return copy


@pytest.fixture
def made(result, opened, tmp_path):
    """made("runup", seconds=2, journal_y=...): a run with a case's input and signals of the test's own.

    Signals are arrays over the time, or functions of (time, shaft angle); what is not given is 0. The speed
    is that of the input, or rises to its final speed over the duration.
    """
    numbers = itertools.count()

    def run(case: str, seconds: float, interval: float = 1e-4, **signals) -> package.Run:
        path = tmp_path / f"made{next(numbers)}.h5"
        path.write_bytes(result(case).read_bytes())
        with h5py.File(path, "r+") as file:
            time = interval * np.arange(round(seconds / interval) + 1)
            first, final = (file["speed"][i] for i in (0, -1))
            acceleration = (final - first) / time[-1]
            angle = first * time + acceleration * time**2 / 2
            own = {"time": time, "shaft_angle": angle, "speed": first + acceleration * time} | signals

            def series(name: str, former: np.ndarray) -> np.ndarray:
                values = own.get(name, 0.0)
                values = np.transpose(values(time, angle) if callable(values) else values)
                return np.broadcast_to(values, former.shape[:0:-1] + time.shape).T

            replace_series(file, series)
        return opened(path)

    return run


@pytest.fixture(scope="session")
def runs_of(tiltpad):
    """runs_of(folder, "&friction model='lugre' /", {"operation%speed_rpm": [2000, 3000]}, failed=(2,)).

    The runs of the product of these values as a folder of results; the numbers in `failed` are runs
    whose equilibrium was not found. Gives the folder.
    """
    import h5py

    def run(folder: Path, case: str, values: dict[str, list], failed: tuple[int, ...] = ()) -> Path:
        folder.mkdir()
        namelist = folder.with_suffix(".nml")
        namelist.write_text(case.replace(" / &", " /\n&") + "\n")
        runs = list(itertools.product(*values.values()))
        for number, one_run in enumerate(runs, 1):
            path = folder / f"{number:04d}.h5"
            texts = [f"'{each}'" if isinstance(each, str) else f"{each}" for each in one_run]
            changes = [f"{name}={text}" for name, text in zip(values, texts, strict=True)]
            done = tiltpad("--quiet", namelist, "--output", path, *(w for c in changes for w in ("--set", c)))
            assert done.returncode in (0, 2), done.stderr
            with h5py.File(path, "r+") as file:
                lines = "\n".join(f"{name} = {text}" for name, text in zip(values, texts, strict=True))
                own = {"run": number, "runs": len(runs), "sweep": lines}
                file.attrs.update(own | {"resumes": 0, "history": ""})
                file.attrs.update({"exit_status": done.returncode, "reason": done.stderr.strip()})
                if number in failed:
                    file.attrs.update({"complete": 0, "exit_status": 2, "reason": "no equilibrium found"})
                    kept = ("pad", "pivot_angle", "statistics", "summary")
                    for name in [name for name in file if name not in kept]:
                        del file[name]
                    for name in [name for name in file["summary"] if name != "speed"]:
                        del file[f"summary/{name}"]
        return folder

    return run


@pytest.fixture(scope="session")
def ross():
    """ross(bearing=..., points=...): what ROSS answers to ross_program.py, or did when make ross asked it."""
    with recording() if "TILTPAD_ROSS" in os.environ else recorded() as answer:
        yield answer
