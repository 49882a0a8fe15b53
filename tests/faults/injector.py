"""The library that lets a call fail: how it is built, told what to do, and asked what was called."""

import errno
import os
import shutil
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path
from random import Random

SOURCE = Path(__file__).with_suffix(".c")
#: Kinds of calls, as injector.c counts them.
KINDS = (
    *("open", "read", "write", "truncate", "sync", "close"),
    *("rename", "delete", "stat", "lock", "fork", "memory"),
)
#: What each kind may fail with; how a process is killed.
ERRORS = {
    "open": ("ENOSPC", "EIO", "EMFILE", "ESTALE", "EINTR", "EACCES"),
    "read": ("EIO", "ESTALE"),
    "write": ("ENOSPC", "EIO", "EDQUOT", "EINTR", "short", "torn"),
    "truncate": ("ENOSPC", "EIO"),
    "sync": ("ENOSPC", "EIO", "EDQUOT"),
    "close": ("ENOSPC", "EIO", "EDQUOT", "EINTR"),
    "rename": ("ENOSPC", "EIO", "ESTALE", "EINVAL"),
    "delete": ("EIO", "EBUSY", "ESTALE"),
    "stat": ("ESTALE", "EIO", "EPERM"),
    "lock": ("ENOLCK", "EIO"),
    "fork": ("EAGAIN", "ENOMEM"),
    "memory": ("ENOMEM", "ENOMEM", "ENOMEM"),
}
KILLS = ("kill", "killall")
#: What stays so once it is.
LASTING = ("ENOSPC", "EDQUOT", "EMFILE", "EACCES", "EAGAIN", "ENOMEM", "ENOLCK", "EIO", "short")


@dataclass(frozen=True)
class Fault:
    """The call number `call` of a kind fails with an error or kills; `always`: and all after it."""

    kind: str
    call: int
    action: str
    always: bool = False

    @property
    def kills(self) -> bool:
        return self.action in (*KILLS, "torn")

    def __str__(self) -> str:
        return f"{self.kind} {self.call}{' and all after it' * self.always}: {self.action}"

    def words(self) -> str:
        """As injector.c reads it."""
        action = getattr(errno, self.action, self.action)
        return f"{self.kind} {self.call} {action} {'always' if self.always else 'once'}"


class Injector:
    """The built library."""

    def __init__(self, folder: Path):
        self.library = folder / "injector.so"
        compiler = shutil.which("cc") or shutil.which("gcc")
        if not compiler:
            raise FileNotFoundError("no C compiler")
        words = [compiler, "-shared", "-fPIC", "-O1", SOURCE, "-o", self.library, "-ldl"]
        subprocess.run(words, check=True)

    def environment(self, counts: Path, fault: Fault | None, folder: Path | None = None) -> dict[str, str]:
        """In which a fault waits and calls are counted: for files in a folder, from the first one on."""
        counts.write_bytes(bytes(8 * (len(KINDS) + 2)))
        found = {"LD_PRELOAD": str(self.library), "FAULT_COUNTS": str(counts)}
        found |= {"FAULT_FOLDER": str(folder)} if folder else {}
        return {**os.environ, **found, "FAULT": fault.words() if fault else ""}


def counted(counts: Path) -> tuple[dict[str, int], int]:
    """The calls of each kind, and how many of them had the fault."""
    *calls, _, faults = struct.unpack(f"{len(KINDS) + 2}q", counts.read_bytes())
    return dict(zip(KINDS, calls, strict=True)), faults


def draw(dice: Random, calls: dict[str, int], number: int) -> list[Fault]:
    """Different faults, as even as may be over the kinds of calls: anywhere, or close to an end."""
    found: dict[Fault, None] = {}
    kinds = [kind for kind in KINDS if calls[kind]]
    while kinds and len(found) < number:
        for kind in list(kinds):
            tried = (one_fault(dice, kind, calls[kind]) for _ in range(50))
            new = next((one for one in tried if one not in found), None)
            if new is None:
                kinds.remove(kind)
            elif len(found) < number:
                found[new] = None
    return list(found)


def one_fault(dice: Random, kind: str, calls: int) -> Fault:
    """A fault of a kind of which there is this number of calls."""
    near = min(calls, 12)
    call = dice.choice((dice.randint(1, calls), dice.randint(1, near), calls + 1 - dice.randint(1, near)))
    action = dice.choice((*ERRORS[kind], *KILLS))
    return Fault(kind, call, action, action in LASTING and dice.random() < 0.5)
