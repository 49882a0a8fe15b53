"""The check of floors (make lint) finds what it is to find, and nothing else."""

import floors
import pytest


@pytest.fixture
def house(tmp_path):
    """house({"base/kinds.f90": text, ...}) writes files and gives their folder."""

    def build(files):
        for name, text in files.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return tmp_path

    return build


def procedure(lines, name="f", comment=""):
    """A function of this many lines."""
    return (
        "\n".join(
            [f"   pure function {name}(x)", *[comment or "      x = 1"] * (lines - 2), "   end function"]
        )
        + "\n"
    )


@pytest.mark.parametrize(
    "use",
    ["use cvode, only: march", "   USE, non_intrinsic :: cvode", "use::cvode", "      use cvode"],
)
def test_a_use_of_a_floor_above(house, use):
    root = house(
        {"base/kinds.f90": f"module kinds\n{use}\n", "integrate/cvode.f90": "   use kinds, only: wp\n"}
    )
    (found,) = floors.fortran_floors(root)
    assert found == f"{root}/base/kinds.f90:2: base uses cvode of integrate, a floor above it"


def test_uses_that_may_be(house):
    beside = (
        "   use hdf5, only: x\n   ! use cvode\n   use, intrinsic :: iso_c_binding\n   use text, only: y\n"
    )
    root = house(
        {"base/kinds.f90": beside, "base/text.F90": "", "film/inner/a.f90": "use b\n", "film/b.f90": ""}
    )
    assert not list(floors.fortran_floors(root))


def test_a_floor_in_a_folder(house, monkeypatch):
    monkeypatch.setattr(floors, "FORTRAN", ("film/common", "film/table", "film"))
    root = house(
        {
            "film/table/a.f90": "use b\nuse c\nuse d\n",
            "film/common/b.f90": "use e",
            "film/c.f90": "use a\nuse b\n",
            "film/table/inner/d.f90": "",
            "film/common/e.f90": "",
        }
    )
    (found,) = floors.fortran_floors(root)
    assert found == f"{root}/film/table/a.f90:2: film/table uses c of film, a floor above it"


def test_a_folder_that_is_no_floor(house):
    (found,) = floors.fortran_floors(house({"cellar/a.f90": ""}))
    assert "cellar: is no floor" in found


def test_long_modules(house):
    root = house({"base/a.f90": 600 * "!\n", "base/b.f90": 601 * "!\n"})
    (found,) = floors.fortran_lengths(root)
    assert found.startswith(f"{root}/base/b.f90:601: 601 lines")


def test_long_procedures(house):
    inner = procedure(62).replace("   end function", "   contains\n" + procedure(61, "g") + "   end function")
    root = house(
        {
            "base/a.f90": procedure(60),
            "base/b.f90": procedure(61),
            "base/c.f90": procedure(61, comment="      ! long: a kernel"),
            "base/d.f90": inner,
        }
    )
    found = list(floors.fortran_lengths(root))
    assert [line.removeprefix(f"{root}/base/").split(" lines")[0] for line in found] == [
        "b.f90:1: f has 61",
        "d.f90:63: g has 61",
        "d.f90:1: f has 63",
    ]


def test_python_imports(house):
    root = house(
        {
            "__init__.py": "from tiltpad.draw import plots\n",
            "files/read.py": "def f():\n    from tiltpad.draw import plots\n",
            "files/archive.py": "import tiltpad.files.read, numpy\nfrom tiltpad import _library\n",
            "calculate/signals.py": "from tiltpad import files\nfrom tiltpad import collect\n",
            "collect/a.py": "from tiltpad.draw import plots\n",
            "cellar/__init__.py": "from ..draw import plots\n",
            "draw/plots.py": "import tiltpad.command\n",
        }
    )
    assert [line.removeprefix(f"{root}/") for line in floors.python_floors(root)] == [
        "cellar: is no floor; tests/floors.py lists them",
        "calculate/signals.py:2: calculate imports tiltpad.collect, which is not below it",
        "collect/a.py:1: collect imports tiltpad.draw.plots, which is not below it",
        "draw/plots.py:1: draw imports tiltpad.command, which is not below it",
        "files/read.py:2: files imports tiltpad.draw.plots, which is not below it",
    ]
