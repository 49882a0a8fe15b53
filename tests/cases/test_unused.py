"""The check of imports and public names (make lint) finds what nothing uses, and nothing else."""

import pytest
import unused


def sources(folder, files):
    """The sources of some texts, by their names."""
    for name, text in files.items():
        (folder / name).write_text(text)
    return [unused.Source(folder / name) for name in files]


@pytest.mark.parametrize(
    "use",
    [
        "   y = wanted(3)",
        "   y = 1 + &\n      & wanted",
        "   X = WANTED",
        "   procedure :: f => wanted",
        "   public :: wanted",
        "   call f(wanted=wanted)",
        "   y = a.and.wanted.or.b",
        "   y = 1.0e-3_wanted + 2",
        "   write (*, '(a)') 'it''s', wanted ! said",
    ],
)
def test_what_uses_an_import(tmp_path, use):
    imports = "   use b, only: other, &\n      & wanted, sum_of => f, operator(+)\n"
    assert not list(unused.unused_imports(sources(tmp_path, {"a.f90": f"{imports}{use}\nsum_of other\n"})))


@pytest.mark.parametrize(
    "line",
    [
        "   ! wanted",
        "   y = 'wanted'",
        "   y = a%wanted",
        "   call f(x, wanted=3)",
        "   use c, only: wanted_too",
    ],
)
def test_what_does_not(tmp_path, line):
    files = {"a.f90": f"module a\n   use, intrinsic :: b, only: wanted\n{line}\n   used = wanted_too\n"}
    (found,) = unused.unused_imports(sources(tmp_path, files))
    assert found == f"{tmp_path}/a.f90:2: imports wanted of b and does not use it"


def test_public_names(tmp_path):
    files = {
        "a.f90": "public :: taken, &\n   & renamed, alone\n",
        "b.f90": "use a, only: taken, here => renamed\n",
        "c.f90": "public :: whole, other\n",
        "d.f90": "use c\ncall whole(alone)\n",
    }
    assert list(unused.unused_publics(sources(tmp_path, files), tmp_path)) == [
        f"{tmp_path}/a.f90:1: alone is public and no other file uses it",
        f"{tmp_path}/c.f90:1: other is public and no other file uses it",
    ]
