"""Writes docs/api.md: the Python package's functions from their docstrings (make docs)."""

import inspect
import re
import sys
import types

import tiltpad
from tiltpad import (
    bearing,
    behaviour,
    diagrams,
    figures,
    machines,
    plots,
    report,
    stations,
    study_report,
    summary,
)
from tiltpad.files import read

HEAD = """# Python package

`make docs` writes this page from the docstrings; `help(tiltpad.orbit)` prints the same text.

    import tiltpad
    run = tiltpad.read("case.h5")                 # opens the file, loads nothing
    run.journal_y                                 # a dataset, as an array in SI units
    machine.bearings["left"].journal_y            # of a machine: a bearing is as a run of one bearing
    y, z = tiltpad.orbit(run, last=2)             # the functions below take a run and return arrays
    ax = tiltpad.plots.orbit(run)                 # draws one run on one pair of axes
    fig = tiltpad.figures.orbit([run, other])     # draws the picture that tiltpad-plot makes
    tiltpad.collect("folder", "study.h5")         # puts many runs into one file
    study = tiltpad.read_study("study.h5")
    study.speed_rpm, study.orbit_y                # arrays over its runs
    ax = tiltpad.diagrams.diagram(study)

[results.md](results.md) lists the names, dimensions and units of the datasets. `(time,)`, `(pad,)` and
`(time, pad)` are shapes of arrays. If a run does not have a dataset, `NotInRunError` gives the reason.
"""


#: Functions of the plots that are no plots.
HELPERS = (
    *("on_axes", "draw_amplitude", "direction_arrow", "polar", "marks_equilibrium", "pad_marks"),
    *("all_tilt", "label_films", "mark_orders", "of_slopes", "tells_contact"),
)


#: The same of what tells of the stations of a machine.
OF_STATIONS = ("column", "positions", "attached", "named", "needs_machine")


def main() -> None:
    public = [getattr(tiltpad, name) for name in tiltpad.__all__]
    # reading first, then in the order of the alphabet, whatever the floor
    modules = sorted(
        {each.__module__ for each in public},
        key=lambda name: (name != read.__name__, name.rpartition(".")[2]),
    )
    print(HEAD)
    for name in modules:
        section("tiltpad", sys.modules[name], [each for each in public if each.__module__ == name])
    section("tiltpad.plots", plots, own_functions(plots, *HELPERS))
    section("tiltpad.figures", figures, [])
    for name, each in figures.FIGURES.items():
        names, *optional = inspect.signature(each).parameters
        call = ", ".join([names, *(f"{option}=None" for option in optional)])
        print(f"- `tiltpad.figures.{name}({call})`: {inspect.getdoc(each)}")
    print()
    entry("tiltpad.figures", figures.study)
    section("tiltpad.diagrams", diagrams, [diagrams.diagram])
    section("tiltpad.behaviour", behaviour, [behaviour.marks])
    section(
        "tiltpad.summary",
        summary,
        [summary.journal, summary.pads, summary.peaks, summary.Figure, summary.Peak],
    )
    section("tiltpad.report", report, [report.report])
    section("tiltpad.study_report", study_report, [study_report.study_report])
    section("tiltpad.bearing", bearing, [bearing.bearing, bearing.movie])
    section("tiltpad.machines", machines, [machines.machine])
    section("tiltpad.stations", stations, own_functions(stations, *OF_STATIONS))


def own_functions(module: types.ModuleType, *helpers: str) -> list[types.FunctionType]:
    """Functions that a module defines, in its order, without its helpers."""
    found = inspect.getmembers(module, inspect.isfunction)
    own = [each for name, each in found if each.__module__ == module.__name__ and name not in helpers]
    return sorted(own, key=lambda each: inspect.unwrap(each).__code__.co_firstlineno)


def section(prefix: str, module: types.ModuleType, runs: list) -> None:
    """A module: what it is about, and its runs."""
    first, _, more = inspect.getdoc(module).partition("\n")
    print(f"## {first.rstrip('.')}\n")
    if more.strip() and module is not plots:
        print(more.strip() + "\n")
    for each in runs:
        entry(prefix, each)


def entry(prefix: str, run: type | types.FunctionType) -> None:
    """A function with its signature and docstring, or a class with its public methods and properties."""
    print(f"### `{prefix}.{run.__name__}`\n")
    if inspect.isfunction(run):
        print(f"```python\n{signature(run)}\n```\n")
    print(inspect.getdoc(run) + "\n")
    if run in (tiltpad.Run, tiltpad.Study):
        for name, each in methods(run).items():
            call = signature(each) if inspect.isfunction(each) else name
            call = call.replace("(self, ", "(").replace("(self)", "()")
            print(f"- `{run.__name__.lower()}.{call}`: {inspect.getdoc(each)}")
        print()


def methods(kind: type) -> dict[str, types.FunctionType | property]:
    """What a class and those that it extends offer by name, the first ones first."""
    found = {name: each for base in reversed(kind.__mro__[:-1]) for name, each in vars(base).items()}
    return {
        name: each for name, each in found.items() if not name.startswith("_") and name not in kind.INTERNAL
    }


def signature(function: types.FunctionType) -> str:
    """Name and parameters with their types, without the modules that these are from."""
    return function.__name__ + re.sub(
        r"\b(?:[a-z_]+\.)+(?=[A-Za-z])", "", re.sub(r"'(Run|Study)'", r"\1", str(inspect.signature(function)))
    )


if __name__ == "__main__":
    main()
