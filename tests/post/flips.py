"""Flips single bits of a result or a study and uses what comes of it, each time in a process of its own.

usage: flips.py FILE COUNT SEED

Prints a line for each flip that crashed, hung, left the bounds of memory, or ended otherwise than by success
or by one line that names the file; at last how many were read, refused and faulty. The bits are flipped in
what describes the file (most of the times) or in the samples, and what is done with the file takes turns:
all that calculates each time, one of the pictures and pages now and then.
"""

import io
import os
import random
import resource
import signal
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import h5py
import matplotlib as mpl

mpl.use("agg")

import tiltpad  # noqa: E402
from tiltpad import command, figures, plots, summary  # noqa: E402, F401

#: Share of the flips in samples, every how many flips there is a picture, seconds and bytes for one flip.
SAMPLES, PICTURE_EVERY, SECONDS, MEMORY = 0.15, 6, 30, 1 << 30


def main() -> None:
    source, count, seed = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    content, inside = source.read_bytes(), sample_bytes(source)
    dice = random.Random(seed)
    outcomes = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            place = drawn(dice, content, inside)
            bit = dice.randrange(8)
            path = Path(folder) / f"{source.stem}.h5"
            path.write_bytes(flipped(content, place, bit))
            outcome, said = in_child(lambda k=number, path=path: use(path, k))
            outcomes[outcome] += 1
            if outcome not in ("read", "refused"):
                print(f"seed {seed}, flip {number} (byte {place}, bit {bit}): {outcome}: {said}")
    print(f"{outcomes.pop('read', 0)} read, {outcomes.pop('refused', 0)} refused, {outcomes.total()} faulty")


def sample_bytes(path: Path) -> list[tuple[int, int]]:
    """Where the file keeps its arrays: first byte and length of each piece."""
    found = []

    def pieces(_: str, item: h5py.HLObject) -> None:
        if isinstance(item, h5py.Dataset):
            if item.chunks is not None:
                infos = (item.id.get_chunk_info(k) for k in range(item.id.get_num_chunks()))
                found.extend((info.byte_offset, info.size) for info in infos)
            elif item.id.get_offset() is not None:
                found.append((item.id.get_offset(), item.id.get_storage_size()))

    with h5py.File(path, "r") as file:
        file.visititems(pieces)
    return found


def drawn(dice: random.Random, content: bytes, inside: list[tuple[int, int]]) -> int:
    """A byte of the file: of a sample, or of what is none and is not a stretch of zeros, where nothing is."""
    if dice.random() < SAMPLES:
        start, length = dice.choice(inside)
        return start + dice.randrange(length)
    while True:
        byte = dice.randrange(len(content))
        if any(content[max(0, byte - 8) : byte + 8]) and not any(
            start <= byte < start + length for start, length in inside
        ):
            return byte


def flipped(content: bytes, place: int, bit: int) -> bytes:
    changed = bytearray(content)
    changed[place] ^= 1 << bit
    return bytes(changed)


def in_child(work: Callable[[], tuple[str, str]]) -> tuple[str, str]:
    """What a process of its own makes of the work: its outcome and words, or how it died."""
    receive, send = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.write(send, "\n".join(work()).encode()[:4000])
        os._exit(0)
    os.close(send)
    status = os.waitpid(child, 0)[1]
    with os.fdopen(receive, "rb") as stream:
        told = stream.read().decode(errors="replace")
    if os.WIFSIGNALED(status):
        return "died", signal.Signals(os.WTERMSIG(status)).name
    outcome, _, said = told.partition("\n")
    return outcome or "ended", said


def use(path: Path, number: int) -> tuple[str, str]:
    """Does everything that calculates, and now and then draws; gives the outcome and what was said."""
    work = [calculate]
    if number % PICTURE_EVERY == 0:
        kinds = sorted(ENTRIES)
        work.append(ENTRIES[kinds[number // PICTURE_EVERY % len(kinds)]])
    outcome, words = "read", ""
    for each in work:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                each(path)
        except (tiltpad.RunError, tiltpad.LibraryError) as error:
            outcome, words = "refused", f"{error}"
            if not words.startswith(str(path)) or "\n" in words:
                return "unclear", words
        except BaseException as error:
            frame = error.__traceback__
            while frame.tb_next:
                frame = frame.tb_next
            where = f"{Path(frame.tb_frame.f_code.co_filename).name}:{frame.tb_lineno}"
            return "fault", f"{each.__name__}: {where} {type(error).__name__}: {error}"
    return outcome, words


def calculate(path: Path) -> None:
    """Every array of a result, its key figures and its film."""
    with tiltpad.read(path) as run:
        repr(run), dir(run), run.input, run.clearance, run.pads
        for name in run.file:
            run[name]
        summary.journal(run)
        summary.pads(run)
        tiltpad.poincare(run, 50)
        tiltpad.pressure(run)
        tiltpad.pressure(run, float(run.values("time", -1)))


def by_command(entry: Callable[[list[str]], int], *words: str) -> Callable[[Path], None]:
    """A command; what it says must be lines of its own, and its last word the reason of its status."""

    def run(path: Path) -> None:
        said = io.StringIO()
        with redirect_stderr(said), redirect_stdout(said):
            status = entry([*words, str(path), "-o", str(path.with_suffix(".html" if not words else ".png"))])
        lines = said.getvalue().splitlines()
        errors = [line for line in lines if ": error: " in line]
        if any(": error: " not in line and ": warning: " not in line for line in lines):
            raise AssertionError(f"{words}: {lines}")
        if (status == 0) != (not errors) or len(errors) > 1 or status not in (0, 1, 3):
            raise AssertionError(f"{words}: status {status}: {lines}")
        if errors:
            raise tiltpad.RunError(errors[0].partition(": error: ")[2])

    run.__name__ = " ".join(words) or "report"
    return run


ENTRIES = {"report": by_command(command.report)} | {
    plot: by_command(command.main, plot) for plot in command.PLOTS
}

if __name__ == "__main__":
    main()
