"""What is refused of a machine: in one line that says which value, and what is allowed."""

import os
import re

import h5py
import numpy as np
import pytest

CASE = """
&operation speed_rpm=4100, duration=0.3 /
&film cavitation='none' /
&shaft length=2*0.05, 8*0.2, 2*0.05, diameter=2*0.0998, 8*0.34, 2*0.0998 /
&disc station=7, mass=2847, polar_inertia=512, diametral_inertia=280 /
&unbalance station=7, moment=0.02 /
&bearing name='left', station=2 /
&bearing name='right', station=12 /
"""
HUNDRED_BEARINGS = "".join(f"&bearing name='b{i}', station=5 /\n" for i in range(100))

#: What is added to the case, and what its line says.
ADDED = {
    "number": ("&disc(1) mass=1 /", "unknown group &disc(1); groups &disc are counted in their order"),
    "name": (
        "&pads:left arc_deg=60 /",
        "unknown group &pads:left; the bearing of a group &pads is named in it",
    ),
    "bearing": ("&bearing:x station=4 /", "unknown group &bearing:x; .* is named in it: name = '...'"),
    "shaft": (
        "&shaft:left density=1 /",
        "unknown group shaft:left; the name of a bearing stands behind its own",
    ),
    "unnamed station": (
        "&bearing station=3 /",
        "line 9: bearing%station: must be in a group &bearing with a name",
    ),
    "support without mass": (
        "&support stiffness=1e9, 1e9 /",
        "support:left%mass = 0: must be above 0, kg",
    ),
    "many bearings": (HUNDRED_BEARINGS, "case.nml: 102 groups &bearing with names; a machine has at most 20"),
    "start": (
        "&start from='centred' /",
        "case.nml: start%from = 'centred': must be 'equilibrium' or 'file' for a machine",
    ),
    "end": ("&disc station=14 /", "disc(2)%station = 14: must be 1 to 13"),
    "same station": (
        "&bearing name='x', station=2 /",
        "bearing:x%station = 2: is that of bearing 'left' already",
    ),
    "unknown bearing": (
        "&pivot bearing='lef', law='fang' /",
        "no group &bearing of this name (did you mean left?)",
    ),
    "twice": (
        "&pads bearing='left' /\n&pads bearing='LEFT' /",
        "group &pads of bearing 'left' is given twice",
    ),
    "typing error": ("&disk station=3 /", "unknown group &disk (did you mean disc?)"),
}
SETS = {
    "pads:%arc_deg=60": "unknown group pads:; the name of a bearing",
    "pads(1)%arc_deg=60": "unknown group pads(1); the name of a bearing",
    "operation:left%speed_rpm=3": "unknown group operation:left; the name of a bearing",
    ":left%arc_deg=3": "unknown group :left; the name of a bearing",
    "bearing%station=3": "bearing%station: must be in a group &bearing with a name",
    "disc(2)%mass=1": "disc(2)%mass: must be disc(1)%mass",
    # as the case names it, and not the bearing that is looked at first
    "film%eddies=1": "unknown variable film%eddies; known",
    "film%tolerance=-1": "film%tolerance = -1: must be",
    "film:right%tolerance=-1": "film:right%tolerance = -1: must be",
}


def says(line, pattern):
    return re.search(".*".join(map(re.escape, pattern.split(".*"))), line)


@pytest.mark.parametrize("what", ADDED)
def test_a_group_is_refused(run, what):
    added, message = ADDED[what]
    line = run(CASE + added, more=["--check"], status=1).stderr
    assert says(line, message), line


@pytest.mark.parametrize("override", SETS)
def test_an_override_is_refused(run, override):
    line = run(CASE, override, more=["--check"], status=1).stderr
    assert says(line, "--set: " + SETS[override]), line


@pytest.mark.parametrize("name", ["", "1a", "_", "a b", "a/b", "..", "l\u00fcft", "l" * 31, "l" * 5000])
def test_a_name_of_a_bearing(run, name):
    line = run(CASE.replace("'left'", f"'{name}'"), more=["--check"], status=1).stderr
    assert says(line, "line 7: bearing%name = '.*: must be one name in quotes"), line
    assert len(line) < 300


@pytest.mark.parametrize("name", ["all", "l" * 30, "nan", "station", "shaft", "bearings"])
def test_any_other_name_is_one(run, tmp_path, name):
    """No name is taken for something else: not in the case that --check prints, nor in the result."""
    case = "&case task='equilibrium' /" + CASE.replace("'left'", f"'{name.upper()}'")
    said = run(case, more=["--check"], status=0).stdout
    again = run(said, more=["--check"], status=0, name="again").stdout
    assert uncommented(again) == uncommented(said)
    run(case, f"pads:{name}%arc_deg=60", status=0)
    with h5py.File(tmp_path / "case.h5") as file:
        assert set(file["bearings"]) == {name, "right"}


def uncommented(text):
    return re.sub(" *!.*", "", text)


def test_a_check_reads_back_to_the_same_values(run):
    """Of bearings with different groups."""
    case = (
        CASE
        + """
&support bearing='left', mass=3.7, stiffness=1e9, 1.1e9 /
&pads bearing='left', pivot_angle_deg=-120.1, 0, 120, arc_deg=60.3 /
&pads bearing='right', motion='fixed' /
&oil grade=32, supply_temperature=40.7 /
&load station=3, force=1.23456789012345678, -2e-3 /
&reduction frequency=1234.56789 /
"""
    )
    said = run(case, more=["--check"], status=0).stdout
    assert said.count("\n&support\n") == 1
    again = run(said, more=["--check"], status=0, name="again").stdout
    assert uncommented(again) == uncommented(said)


def test_a_shaft_of_many_sections(run):
    """Its matrices take more memory than the stack of a process has."""
    case = "&operation speed_rpm=100 /\n&shaft length=260*0.008, diameter=0.1 /\n" + (
        "&bearing name='a', station=1 /\n&bearing name='b', station=261 /\n"
    )
    run(case, "case%task=coefficients", status=0)


def test_more_modes_than_a_machine_keeps(run):
    case = CASE.replace("8*0.2", "80*0.02").replace("8*0.34", "80*0.34").replace("=12", "=84")
    line = run(case, "case%task=coefficients", "reduction%frequency=1e7", status=1).stderr
    assert says(line, "reduction%frequency = 1e7: .* modes are below it, .* keeps at most 120"), line


BEARINGS = "&case task='equilibrium' /\n&rotor file='rotor.h5' /\n" + (
    "&bearing name='a', station=1 /\n&bearing name='b', station=5 /\n"
)


def beam(sections=4, length=0.3, diameter=0.1):
    """Matrices of a slender beam: deflection and slope in y, then in z, of each station."""
    stiffness = 2.1e11 * np.pi * diameter**4 / 64 / length**3
    mass = 7850 * np.pi / 4 * diameter**2 * length / 420
    one = length
    bent = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    heavy = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    scale = np.array([1, one, 1, one])
    size = 4 * (sections + 1)
    found = {name: np.zeros((size, size)) for name in ("mass", "damping", "gyroscopic", "stiffness")}
    for first in range(0, 4 * sections, 4):
        for plane in (first, first + 2):
            at = np.ix_(
                [plane, plane + 1, plane + 4, plane + 5],
                [plane, plane + 1, plane + 4, plane + 5],
            )
            found["stiffness"][at] += stiffness * bent * np.outer(scale, scale)
            found["mass"][at] += mass * heavy * np.outer(scale, scale)
    found["station"] = np.eye(size)[::2]
    found["slope"] = np.eye(size)[1::2]
    found["weighed"] = found["mass"][:, ::4].sum(axis=1)
    found["total_mass"] = found["weighed"][::4].sum()
    return found


def changed(name, index, value):
    """A change of one number."""

    def change(matrices):
        matrices[name] = np.array(matrices[name])
        matrices[name][index] = value

    return change


NOT_FINITE = "its numbers must be finite"
TRANSLATION = "weighed: must be mass times a translation"
#: Changes of the matrices, and what the line says.
MATRICES = {
    "not a number": (changed("mass", (0, 0), np.nan), NOT_FINITE),
    "infinite": (changed("stiffness", (3, 4), np.inf), NOT_FINITE),
    "mass not a number": (lambda m: m.update(total_mass=np.nan), NOT_FINITE),
    "unsymmetric": (changed("mass", (0, 5), 3.0), "mass: must be symmetric"),
    "unsymmetric stiffness": (changed("stiffness", (0, 5), 1e9), "stiffness: must be symmetric"),
    "gyroscopic": (changed("gyroscopic", (0, 5), 1.0), "gyroscopic: must change its sign"),
    "negative": (lambda m: m.update(mass=-m["mass"]), "mass: must be positive definite"),
    "a spring to ground": (
        changed("stiffness", (4, 4), 1e10),
        "stiffness: resists a translation along y with",
    ),
    "a zero on the diagonal": (
        changed("stiffness", (0, 0), 0.0),
        "stiffness: resists a translation along y with",
    ),
    "no number in the end": (
        changed("stiffness", (0, 0), 1e308),
        "stiffness: resists a translation along y with",
    ),
    "no stiffness": (lambda m: m.update(stiffness=0 * m["mass"]), "do not hold the shaft"),
    "no weight": (lambda m: m.update(weighed=0 * m["weighed"]), TRANSLATION),
    "weight in N": (lambda m: m.update(weighed=9.81 * m["weighed"]), TRANSLATION),
    "stations in mm": (lambda m: m.update(station=1e3 * m["station"]), TRANSLATION),
    "negative mass": (lambda m: m.update(total_mass=-1.0), "total_mass = -1: must be that of"),
    "mass in t": (lambda m: m.update(total_mass=m["total_mass"] / 1e3), "total_mass = 0.0739"),
    "missing": (lambda m: m.pop("damping"), "could not find damping"),
    "32 bits": (
        lambda m: m.update(mass=np.float32(m["mass"])),
        "right kind in mass; all numbers must be 64-bit floats",
    ),
    "integers": (
        lambda m: m.update(damping=np.zeros((20, 20), int)),
        "in damping; all numbers must be 64-bit floats",
    ),
    "text": (lambda m: m.update(slope="abc"), "in slope; all numbers must be 64-bit floats"),
    "row too few": (lambda m: m.update(mass=m["mass"][1:]), "mass: has 380 numbers: must have 20 x 20"),
    "odd rows": (lambda m: m.update(station=m["station"][1:]), "station: has 180 numbers: must be rows"),
    "bearing between": (changed("station", (0, 3), 0.5), "row 1, of a bearing, must have one element 1"),
    "two mm": (lambda m: m.update(weighed=np.zeros(9999)), "weighed: has 9999 numbers: .*, 1 to 2000"),
}


def write(path, matrices):
    with h5py.File(path, "w") as file:
        for name, values in matrices.items():
            file[name] = values


def test_matrices_of_a_beam_are_a_rotor(run, tmp_path):
    write(tmp_path / "rotor.h5", beam())
    run(BEARINGS, status=0)
    with h5py.File(tmp_path / "case.h5") as file:
        expected = 7850 * np.pi / 4 * 0.1**2 * 4 * 0.3
        assert file["rotor/total_mass"][()] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("what", MATRICES)
def test_matrices_are_refused(run, tmp_path, what):
    change, message = MATRICES[what]
    matrices = beam()
    change(matrices)
    write(tmp_path / "rotor.h5", matrices)
    line = run(BEARINGS, status=1).stderr
    assert says(line, message), line
    assert not (tmp_path / "case.h5").exists() or what == "no stiffness"


def piece(path):
    write(path, beam())
    os.truncate(path, path.stat().st_size // 2)


#: What has the name of the file.
OTHERS = {
    "nothing": (lambda path: None, "there is no such file"),
    "empty": (lambda path: path.touch(), "not an HDF5 file"),
    "text": (lambda path: path.write_text("1 2 3\n" * 100), "not an HDF5 file"),
    "piece": (piece, "not an HDF5 file"),
    "folder": (lambda path: path.mkdir(), "a directory, device or pipe"),
    "pipe": (lambda path: os.mkfifo(path), "a directory, device or pipe"),
}


@pytest.mark.parametrize("what", OTHERS)
def test_what_is_no_file_of_matrices(run, tmp_path, what):
    make, message = OTHERS[what]
    make(tmp_path / "rotor.h5")
    line = run(BEARINGS, status=1).stderr
    assert says(line, "rotor%file = 'rotor.h5': " + message), line


def test_damaged_matrices_are_read_or_refused(run, tiltpad, tmp_path):
    """In any byte of the first ones, where the structure of the file is."""
    path = tmp_path / "rotor.h5"
    write(path, beam())
    (tmp_path / "case.nml").write_text(BEARINGS)
    whole = path.read_bytes()
    dice = np.random.default_rng(1)
    for _ in range(20):
        damaged = bytearray(whole)
        for at in dice.integers(min(len(whole), 6000), size=dice.choice((1, 30))):
            damaged[at] = dice.integers(256)
        path.write_bytes(damaged)
        done = tiltpad("case.nml", "--overwrite", cwd=tmp_path)
        assert done.returncode in (0, 1, 2), done
        assert done.stderr.count("\n") == (done.returncode != 0), done.stderr
