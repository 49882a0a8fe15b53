"""The floors of the package: a module uses its own floor and those below it."""

import ast
from pathlib import Path

import pytest
import tiltpad

PACKAGE = Path(tiltpad.__file__).parent
#: Floors and how high they are; the modules of the package itself, the commands, are above them all.
FLOORS = {"files": 0, "calculate": 1, "draw": 2, "collect": 2}


def floor(module: str) -> tuple[str, int]:
    """Floor of a module by its full name, and its height."""
    name = module.split(".")[1] if module.count(".") else ""
    return (name, FLOORS[name]) if name in FLOORS else ("the package itself", len(FLOORS))


def imported(path: Path) -> set[str]:
    """Modules of tiltpad that a file imports anywhere in it, by their full names."""
    found = set()
    for each in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(each, ast.ImportFrom):
            assert each.level == 0, f"{path}: imports by full names"
            found |= {f"{each.module}.{name.name}" for name in each.names}
        elif isinstance(each, ast.Import):
            found |= {name.name for name in each.names}
    # the compiled part is below all floors
    return {name for name in found if name.split(".")[0] == "tiltpad" and "_library" not in name}


@pytest.mark.parametrize(
    "path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE))
)
def test_a_module_uses_no_floor_above_it(path):
    own, height = floor(".".join(("tiltpad", *path.relative_to(PACKAGE).with_suffix("").parts)))
    for module in imported(path):
        other, above = floor(module)
        assert above < height or other == own, f"{path.name} is in {own} and imports {module}"


def test_every_folder_is_a_floor():
    assert {each.parent.name for each in PACKAGE.glob("*/__init__.py")} == set(FLOORS)


def test_modules_by_their_public_names():
    """As docs/api.md has them; most load matplotlib, and only when they are used."""
    for name, floor_of_it in tiltpad.MODULES.items():
        assert getattr(tiltpad, name).__name__ == f"tiltpad.{floor_of_it}.{name}"
    with pytest.raises(AttributeError, match="no attribute 'plot'"):
        tiltpad.plot  # noqa: B018
