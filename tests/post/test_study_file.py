"""The file of a study that the program writes: the same as tiltpad-collect makes of the files of its runs."""

import warnings

import h5py
import numpy as np
import pytest
import tiltpad as package

#: Every task, with runs whose numerics fail, texts and lists as parameters, and runs that lack what others have.
STUDIES = {
    "march": "&operation duration=0.05 / &output samples_per_revolution=60 / "
    "&sweep operation%speed_rpm=3000,4500 friction%model='none','lugre' integration%max_steps=100000,30 /",
    "equilibrium": "&case title='Loads', task='equilibrium' / &output keep='all' / "
    "&sweep order='zip' rotor%mass=1000:3000:500 pads%arc_deg(1)=60:68:2 /",
    "coefficients": "&case task='coefficients' / &output keep='all' / "
    "&sweep operation%speed_rpm=3000:6000:1000 pads%motion='tilting_only','tilting_radial' /",
    "tasks": "&operation duration=0.03 / &output keep='all' / "
    "&sweep case%task='march','equilibrium','coefficients' /",
    "thermal": "&case task='equilibrium' / &thermal model='pad' / &output keep='all' / "
    "&sweep operation%speed_rpm=3000:5000:1000 /",
    "periodic": "&case task='periodic' / &output samples_per_revolution=60 / &sweep rotor%unbalance=0.01,0.02 /",
    "revolutions": "&output keep='last_revolutions', spectrum_revolutions=8, samples_per_revolution=60 / "
    "&sweep operation%duration=0.005,0.05,0.15 /",
}
#: What depends on the moment, or is of the study's making alone.
TIMES = ("wall_seconds", "film_seconds", "film_building_seconds", "output_seconds", "checkpoint_seconds")
OF_THE_PROGRAM = ("created", "complete", "study_marks")


def described(path):
    """All datasets with their kind, dimensions, units and meaning; the attributes of the file."""
    found = {}
    with h5py.File(path) as file:
        for name, each in file.items():
            over = [] if each.is_scale else [scale[0].name for scale in each.dims]
            about = {key: each.attrs.get(key, "") for key in ("units", "long_name", "coordinates")}
            found[name] = (each.dtype.kind == "O", each.shape, over, about)
        return found, {key: each for key, each in file.attrs.items() if key not in OF_THE_PROGRAM}


@pytest.mark.parametrize("name", STUDIES)
def test_the_file_is_what_is_collected_of_its_runs(tiltpad, tmp_path, name):
    """Columns, dimensions, units, meanings, and all bits but those of times."""
    (tmp_path / "case.nml").write_text(STUDIES[name].replace(" / &", " /\n&") + "\n")
    tiltpad("--quiet", "case.nml", cwd=tmp_path)
    with warnings.catch_warnings(action="ignore"):
        package.collect(tmp_path / "case", tmp_path / "collected.h5")
    (ours, own), (collected, of_it) = (described(tmp_path / f"{each}.h5") for each in ("case", "collected"))
    assert ours == collected
    assert own == of_it
    with package.read_study(tmp_path / "case.h5") as one, package.read_study(tmp_path / "collected.h5") as other:
        for column in set(ours) - set(TIMES):
            np.testing.assert_array_equal(one[column], other[column], err_msg=column)
