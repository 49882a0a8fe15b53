"""Temperatures along and across films: what a run writes of them, a rerun of its input, and refusals."""

import h5py
import numpy as np
import pytest
import tiltpad as package

FILM = "&oil grade=46 /\n&thermal model='film' /\n"
REST = "&case task='equilibrium' /\n" + FILM


@pytest.fixture
def run(tiltpad, tmp_path):
    """run(text, *overrides, name="case"): of a case file in the test's folder, which has to succeed."""

    def perform(text, *overrides, name="case"):
        (tmp_path / f"{name}.nml").write_text(text)
        return tiltpad(f"{name}.nml", cwd=tmp_path, overrides=overrides, status=0)

    return perform


def test_a_run_has_the_fields_of_its_films(run, tmp_path):
    said = run(REST).stdout
    with h5py.File(tmp_path / "case.h5") as file:
        rest = file["equilibrium"]
        field, surface = rest["film_temperature"][()], rest["surface_temperature"][()]
        assert field.shape == (2, 40, 12)
        assert surface.shape == (2, 40)
        assert rest["film_temperature"].attrs["units"] == "degC"
        along, height = file["film_arc"][()], file["film_height"][()]
        np.testing.assert_allclose(along, (np.arange(40) + 0.5) / 40)
        assert (np.diff(height) > 0).all()
        # layers are the narrower the closer to a wall
        widths = np.diff((1 - np.cos(np.pi * np.arange(13) / 12)) / 2)
        np.testing.assert_allclose((field @ widths).mean(axis=1), rest["mean_temperature"])
        # the film beside the pad, and what heats it most: towards the trailing edge
        assert (np.abs(field[:, :, 0] - surface) < 1).all()
        assert (surface.max(axis=1) <= rest["maximum_temperature"][()] + 1e-9).all()
        assert (surface.argmax(axis=1) > 30).all()
        assert field.min() > 40 - 1
        highest = rest["maximum_temperature"][()].max()
    assert f"pad at most {highest:.1f} C" in said


def test_the_input_of_a_run_gives_its_numbers_again(run, tmp_path):
    run(REST + "&pads thickness=20e-3, conductivity=45 /\n")
    with h5py.File(tmp_path / "case.h5") as first:
        text = first.attrs["input"]
        run(text if isinstance(text, str) else text.decode(), name="again")
        with h5py.File(tmp_path / "again.h5") as again:
            for name in ("journal_y", "film_temperature", "viscosity", "power_loss"):
                np.testing.assert_array_equal(first[f"equilibrium/{name}"], again[f"equilibrium/{name}"])


def test_the_shaft_and_the_back_of_the_pads_take_heat(run, tmp_path):
    """A shaft and an oil behind the pads of 60 C warm a bearing; pads without a coefficient are warmer."""
    found = {}
    for name, more in {
        "usual": (),
        "tight": ("oil%back_coefficient=0",),
        "warm": ("oil%shaft_temperature=60", "oil%back_temperature=60"),
    }.items():
        run(REST, *more, name=name)
        with h5py.File(tmp_path / f"{name}.h5") as file:
            found[name] = {
                each: file[f"equilibrium/{each}"][()] for each in ("maximum_temperature", "shaft_temperature")
            }
    assert (found["tight"]["maximum_temperature"] > found["usual"]["maximum_temperature"]).all()
    assert (found["warm"]["maximum_temperature"] > found["usual"]["maximum_temperature"]).all()
    assert found["warm"]["shaft_temperature"] == 60


def test_coefficients_and_a_study(run, tmp_path):
    """Two oils in a study, of which each run is as it is alone."""
    run(
        "&case task='coefficients' /\n" + FILM + "&sweep oil%grade=32, 46 /\n",
        name="study",
    )
    run("&case task='coefficients' /\n" + FILM, name="alone")
    with h5py.File(tmp_path / "alone.h5") as alone, package.read_study(tmp_path / "study.h5") as study:
        np.testing.assert_allclose(
            study.pad_equilibrium_viscosity[1], alone["equilibrium/viscosity"], rtol=1e-12
        )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (FILM, "thermal%model = 'film': is for case%task = 'equilibrium' or 'coefficients'; 'march' takes"),
        (
            "&case task='coefficients' /\n&coefficients threshold_up_to_rpm=9000 /\n" + FILM,
            "threshold_up_to_rpm",
        ),
        (
            REST.replace("grade=46", "carry_over=0.5"),
            "needs an oil whose viscosity depends on its temperature",
        ),
        (REST.replace("'film'", "'film', layers=3"), "thermal%layers"),
    ],
)
def test_what_is_refused(tiltpad, tmp_path, text, words):
    (tmp_path / "case.nml").write_text(text)
    assert words in tiltpad("case.nml", cwd=tmp_path, status=1).stderr


def test_films_of_uneven_viscosity_are_not_solved_again(run, tmp_path):
    run(REST)
    with package.read(tmp_path / "case.h5") as case:
        for ask in (package.pressure, package.heat_balance):
            with pytest.raises(package.NotInRunError, match="temperatures along and across"):
                ask(case)
