"""Writing files: what has a name keeps it until the new content is whole and on the disk."""

import csv
import fcntl
import io
import os
import secrets
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path
from typing import Any, BinaryIO

import h5py

#: Digits behind ".part" in the name of a part, which nothing else has by accident.
DIGITS = 16
#: Signals that are to stop the work of a command; only the command's handler adds one.
came: list[int] = []


def look() -> None:
    """Raises KeyboardInterrupt where a signal came.

    That of the handler is lost where Python lets nothing out, as in the end of an object: so it is looked for
    before a file gets its name, and before a command says that it is done.
    """
    if came:
        raise KeyboardInterrupt(came[0])


def write(path: str | os.PathLike, content: str | bytes | memoryview) -> None:
    """Writes a file; a text as UTF-8."""
    with replacing(path) as file:
        file.write(content.encode() if isinstance(content, str) else content)


def write_csv(path: str | os.PathLike, rows: Iterable[Iterable[Any]]) -> None:
    """Writes a table, .csv."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    write(path, text.getvalue())


@contextmanager
def hdf5(path: Path, mode: str = "w") -> Iterator[h5py.File]:
    """An HDF5 file that is made in memory, or with "r+" changed there, and written at the end of the block.

    The HDF5 library can crash where a write is refused. It looks for a file of the name also where it makes
    one in memory, which gets a name that there is not.
    """
    name = path if mode == "r+" else f"{path}.{secrets.token_hex()}"
    with h5py.File(name, mode, driver="core", backing_store=False) as file:
        yield file
        file.flush()
        content = file.id.get_file_image()
    write(path, content)


@contextmanager
def replacing(path: str | os.PathLike) -> Iterator[BinaryIO]:
    """A part beside the file, open for writing, which takes its name at the end of the block.

    Where that fails, the part is removed and what was there stays. The target of a link is replaced, the link
    stays. Devices and pipes are written as they are.
    """
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as file:
            yield file
        return
    target = Path(os.path.realpath(path))
    remove_left_parts(target)
    with new_part(target) as file:
        try:
            if target.exists():
                if not os.access(target, os.W_OK):
                    raise PermissionError(f"{path}: no permission to write it")
                os.fchmod(file.fileno(), stat.S_IMODE(target.stat().st_mode))
            yield file
            file.flush()
            os.fsync(file.fileno())
            look()
            os.replace(file.name, target)
        except BaseException:
            with suppress(OSError):
                os.unlink(file.name)
            raise


def new_part(target: Path) -> BinaryIO:
    """A new file beside the target, locked as long as it is open; its name ends as that of the target."""
    while True:
        name = f"{target}.part{secrets.token_hex(DIGITS // 2)}{target.suffix}"
        file = open(name, "xb")  # noqa: SIM115
        # there are file systems without locks
        with suppress(OSError):
            fcntl.flock(file, fcntl.LOCK_EX)
        if os.fstat(file.fileno()).st_nlink:
            return file
        # another writer has taken it for a part that is left
        file.close()


def remove_left_parts(target: Path) -> None:
    """Removes the parts of this target whose writers have ended: nobody holds their locks."""
    digits = "[0-9a-f]" * DIGITS
    for path in target.parent.glob(f"{escape(target.name)}.part{digits}{escape(target.suffix)}"):
        with suppress(OSError):
            left = os.open(path, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                fcntl.flock(left, fcntl.LOCK_EX | fcntl.LOCK_NB)
                path.unlink()
            finally:
                os.close(left)
