"""The reader of cases behind a pipe: case in, what came of it out; a crash or a hang belongs to its case."""

import os
import select
import struct
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

# what the harness can do, and what it says of a resolved case that does not read back to itself
READ, READ_BACK, REFERENCE, TABLE = range(4)
NOT_ITSELF = 99
# faster than the defaults: what is freed is kept for a short while, and known by where it was made alone
SANITIZER = "quarantine_size_mb=1:malloc_context_size=1:max_malloc_fill_size=0:detect_leaks="


@dataclass(frozen=True)
class Case:
    """Text of a case file and the arguments of --set."""

    text: bytes
    sets: tuple[bytes, ...] = ()

    def request(self, task: int) -> bytes:
        parts = (self.text, *self.sets)
        return struct.pack("=2i", task, len(parts)) + b"".join(struct.pack("=i", len(p)) + p for p in parts)


@dataclass(frozen=True)
class Reply:
    """Exit status, what the case was first to reach, and resolved case or message."""

    status: int
    news: int
    text: bytes


class Crash(Exception):
    """The harness ended; the words are what it said last."""


class Hang(Exception):
    """No answer within the limit."""


class Harness:
    """A process of tests/fuzz/fuzz_input.f90, started again whenever it ends."""

    def __init__(self, program: Path, limit: float = 10.0):
        self.program, self.limit = program, limit
        self.process = None
        # what was never freed in a process that ended by itself, where that is looked for
        self.leaks = ""
        # closed with the harness
        self.errors = tempfile.TemporaryFile()  # noqa: SIM115

    def __enter__(self) -> "Harness":
        return self

    def __exit__(self, *_) -> None:
        self.close()
        self.errors.close()

    def reference(self) -> str:
        """The input reference of the program, Markdown."""
        return self._exchange(struct.pack("=2i", REFERENCE, 0)).text.decode()

    def read(self, case: Case, back: bool = True) -> Reply:
        """What the program makes of a case, and whether that reads back to itself; raises Crash or Hang."""
        return self._exchange(case.request(READ_BACK if back else READ))

    def table(self, case: Case) -> Reply:
        """What the program makes of a table of values; raises Crash or Hang."""
        return self._exchange(case.request(TABLE))

    def close(self) -> None:
        """Ends the process as it ends by itself, so that it can count what it reached."""
        if self.process:
            self.process.stdin.close()
            try:
                self.process.wait(self.limit)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
            self.process.stdout.close()
            self.process = None
            said = self._said()
            if "detected memory leaks" in said:
                self.leaks = said

    def _said(self) -> str:
        """What the process wrote to its standard error."""
        self.errors.seek(0)
        return self.errors.read().decode(errors="replace").strip()

    def _exchange(self, request: bytes) -> Reply:
        if self.process is None:
            self.errors.seek(0)
            self.errors.truncate()
            self.process = subprocess.Popen(
                [self.program],
                bufsize=0,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self.errors,
                env={**os.environ, "ASAN_OPTIONS": SANITIZER + "1"},
            )
        try:
            sent = 0
            while sent < len(request):
                sent += self.process.stdin.write(request[sent:])
            (length,) = struct.unpack("=i", self._got(4))
            status, news = struct.unpack("=2i", self._got(8))
            return Reply(status, news, self._got(length - 8))
        except (Crash, BrokenPipeError):
            self.process.stdout.close()
            self.process.wait()
            self.process = None
            raise Crash(self._said()) from None

    def _got(self, length: int) -> bytes:
        found = b""
        while len(found) < length:
            if not select.select([self.process.stdout], [], [], self.limit)[0]:
                self.process.kill()
                self.process.wait()
                self.process = None
                raise Hang(f"no answer within {self.limit:g} s")
            new = os.read(self.process.stdout.fileno(), length - len(found))
            if not new:
                raise Crash
            found += new
        return found
