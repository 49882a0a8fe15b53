"""A station of the shaft of a machine as the run of a journal."""

from functools import cached_property
from typing import Any

import h5py

from tiltpad.files.archive import not_in_run
from tiltpad.files.read import Bearing, Run

#: How names begin in the file, and here.
OF_STATIONS, OF_JOURNAL = "station_", "journal_"


class Station(Bearing):
    """A station of a machine (1, 2, ...) as the run of one journal without pads: pictures of motions take it.

    The displacement of the shaft there is journal_y and journal_z, in series, branches and equilibrium; the
    machine has the rest.
    """

    def __init__(self, machine: Run, number: int):
        there = machine.length("station") if "station" in machine else 0
        if not 1 <= number <= there:
            why = f"stations are 1 to {there}" if there else "it is of one bearing and not of a machine"
            raise not_in_run(machine, f"station {number}", why)
        self.machine, self.name, self.group = machine, f"{number}", ""
        self.path, self.file, self.size = machine.path, machine.file, machine.size
        self.found, self.listed, self.over, self.former = {}, {}, {}, machine.former
        title = f"{machine.attributes['title']}, station {number}".removeprefix(", ")
        self.attributes = machine.attributes | {"title": title}

    @property
    def label(self) -> str:
        """What it is called beside others of the same machine."""
        return f"station {self.name}"

    @property
    def pads(self) -> int:
        """It has none."""
        return 0

    @cached_property
    def input(self) -> dict[str, dict[str, Any]]:
        """The resolved namelist of the machine."""
        return self.machine.input

    @property
    def remarks(self) -> list[str]:
        """Those on the machine."""
        return self.machine.remarks

    def names(self, group: str = "") -> list[str]:
        """Names of the datasets and groups of the machine, or in a group, with those of a journal."""
        own = {name.replace(OF_STATIONS, OF_JOURNAL, 1) for name in self.machine.names(group)}
        return sorted(own)

    def own(self, path: str) -> h5py.Dataset | h5py.Group:
        """The object of this path."""
        return Run.own(self.machine, path.replace(OF_JOURNAL, OF_STATIONS, 1))

    def values(self, name: str, part: slice | int = slice(None)) -> Any:
        found = super().values(name, part)
        if not name.rpartition("/")[2].startswith(OF_JOURNAL):
            return found
        return found[..., int(self.name) - 1]

    def dimensions(self, name: str) -> int:
        """Number of dimensions of a dataset: a journal has one place."""
        return super().dimensions(name) - name.startswith(OF_JOURNAL)
