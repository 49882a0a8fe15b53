"""A guard before the HDF5 library: it never ends on a global heap in which an object has no length.

The heaps hold the texts and lists of attributes, and are walked here as the library walks them. Up to 2.0 it
checks that the objects' lengths stay inside a heap, not that they lead on.
"""

import os
from collections.abc import Iterator

#: Of a greater file only so much is searched at its beginning and its end, where attributes are.
SEARCHED = 1 << 22
#: A heap begins with its signature, version 1 and three zeros; then its length, 8 bytes.
SIGNATURE = b"GCOL\x01\x00\x00\x00"
HEAD = 16
#: Lengths of objects are multiples of this, and are calculated in so many bits.
ALIGNED, BITS = 8, 64


def endless(path: str) -> bool:
    """True where the library would walk a heap of the file without end."""
    size = os.path.getsize(path)
    parts = [(0, size)] if size <= 2 * SEARCHED else [(0, SEARCHED), (size - SEARCHED, SEARCHED)]
    with open(path, "rb", buffering=0) as stream:
        for start, length in parts:
            stream.seek(start)
            content = stream.read(length)
            if any(stands_still(content, heap) for heap in heaps(content)):
                return True
    return False


def heaps(content: bytes) -> Iterator[int]:
    """Where heaps begin."""
    start = content.find(SIGNATURE)
    while start >= 0:
        yield start
        start = content.find(SIGNATURE, start + len(SIGNATURE))


def stands_still(content: bytes, start: int) -> bool:
    """True where an object of the heap has no length, so that the next one is itself."""
    stop = min(len(content), start + number(content, start + len(SIGNATURE), 8))
    place = start + HEAD
    while place + HEAD <= stop:
        length = number(content, place + 8, 8)
        # object 0 is the space that is free, its own head included
        if number(content, place, 2) != 0:
            length = (HEAD + -(-length // ALIGNED) * ALIGNED) % (1 << BITS)
        if length == 0:
            return True
        place += length
    return False


def number(content: bytes, place: int, length: int) -> int:
    return int.from_bytes(content[place : place + length], "little")
