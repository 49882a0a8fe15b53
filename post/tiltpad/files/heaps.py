"""Finds global heaps over which the HDF5 library, up to version 2.0 at least, would loop for ever.

The heaps hold the texts and lists of attributes. An object of length 0 in a damaged heap is followed by
itself; the library checks only that an object ends inside its heap. The program tries a damaged file in a
child process instead. Here the search costs less, and it does not fork a process that may have threads.
"""

import os
from collections.abc import Iterator

#: Bytes that are searched at the beginning and at the end of a larger file, where attributes are.
SEARCHED = 1 << 22
#: A heap begins with its signature, version 1 and three zeros; then its length, 8 bytes.
SIGNATURE = b"GCOL\x01\x00\x00\x00"
HEAD = 16
#: Lengths of objects are multiples of this, and are calculated with this number of bits.
ALIGNED, BITS = 8, 64


def endless(path: str) -> bool:
    """True where the library would loop over a heap of the file for ever."""
    size = os.path.getsize(path)
    parts = [(0, size)] if size <= 2 * SEARCHED else [(0, SEARCHED), (size - SEARCHED, SEARCHED)]
    with open(path, "rb", buffering=0) as stream:
        for start, length in parts:
            stream.seek(start)
            content = stream.read(length)
            # the heap that ends last comes first: what it shares with another is then known to its end
            known: set[int] = set()
            for stop, first in sorted(heaps(content), reverse=True):
                if stands_still(content, first, stop, known):
                    return True
    return False


def heaps(content: bytes) -> Iterator[tuple[int, int]]:
    """End of each heap, and the first byte of its first object."""
    start = content.find(SIGNATURE)
    while start >= 0:
        yield min(len(content), start + number(content, start + len(SIGNATURE), 8)), start + HEAD
        start = content.find(SIGNATURE, start + len(SIGNATURE))


def stands_still(content: bytes, first: int, stop: int, known: set[int]) -> bool:
    """True where an object of the heap has the length 0, so that the next object is the same one.

    Adds the objects to those that are known to have another length.
    """
    while first + HEAD <= stop and first not in known:
        known.add(first)
        length = number(content, first + 8, 8)
        # object 0 is the free space, whose length includes its own head
        if number(content, first, 2) != 0:
            length = (HEAD + -(-length // ALIGNED) * ALIGNED) % (1 << BITS)
        if length == 0:
            return True
        first += length
    return False


def number(content: bytes, first: int, length: int) -> int:
    return int.from_bytes(content[first : first + length], "little")
