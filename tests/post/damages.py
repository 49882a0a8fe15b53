"""How a result or a study is damaged at random: its bytes, its structure, or what it says of itself.

Bits are flipped; blocks are zeros, noise, or exchanged; numbers of the structure become very large ones;
files are cut short or get a tail; objects and attributes become others, of another kind or size. Most of the
damages to bytes are in the structure of the file, some in its samples.
"""

import random
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

#: Shares of flipped bits, blocks, numbers, exchanged blocks, other lengths; the rest are other objects.
BITS, BLOCKS, NUMBERS, EXCHANGES, LENGTHS = 0.45, 0.1, 0.12, 0.05, 0.05
#: Share of damages to bytes that are in samples; length of a block, bytes.
SAMPLES, LONGEST = 0.15, 600
#: Numbers that a structure does not expect: sizes, addresses, counts.
LARGE = (0, 1, 2**15, 2**31 - 1, 2**31, 2**32 - 1, 2**40, 2**63 - 1, 2**63, 2**64 - 1)
#: Texts in place of others.
TEXTS = ("", " ", "\n\n", "&case /", "&", "/", "'", "\u00e4\u0663", "-1", "tiltpad", "study", "x" * 1_000_000)


class Source:
    """A sound file, its bytes, and where its arrays are: first byte and length of each piece."""

    def __init__(self, path: Path):
        self.path = path
        self.content = path.read_bytes()
        self.inside: list[tuple[int, int]] = []
        with h5py.File(path, "r") as file:
            file.visititems(self.note)

    def note(self, _: str, item: h5py.HLObject) -> None:
        """Notes the pieces of a dataset."""
        if isinstance(item, h5py.Dataset):
            if item.chunks is not None:
                infos = (item.id.get_chunk_info(k) for k in range(item.id.get_num_chunks()))
                self.inside.extend((info.byte_offset, info.size) for info in infos)
            elif item.id.get_offset() is not None:
                self.inside.append((item.id.get_offset(), item.id.get_storage_size()))

    def place(self, dice: random.Random) -> int:
        """A byte of a sample, or another byte that is not in a block of zeros, which is unused."""
        if self.inside and dice.random() < SAMPLES:
            start, length = dice.choice(self.inside)
            return start + dice.randrange(length)
        while True:
            byte = dice.randrange(len(self.content))
            if any(self.content[max(0, byte - 8) : byte + 8]) and not any(
                start <= byte < start + length for start, length in self.inside
            ):
                return byte


def damaged_copy(dice: random.Random, source: Source, target: Path) -> str:
    """Writes a damaged copy; says in words what was done."""
    kind, place, changed = dice.random(), source.place(dice), bytearray(source.content)
    if kind < (most := BITS):
        bit = dice.randrange(8)
        changed[place] ^= 1 << bit
        what = f"bit {bit} of byte {place}"
    elif kind < (most := most + BLOCKS):
        length = min(dice.randrange(1, LONGEST), len(changed) - place)
        changed[place : place + length] = dice.choice(
            (bytes(length), b"\xff" * length, dice.randbytes(length))
        )
        what = f"{length} bytes from {place}"
    elif kind < (most := most + NUMBERS):
        # structures are aligned to 4 bytes at least
        place, length, value = place // 4 * 4, dice.choice((2, 4, 8)), dice.choice((*LARGE, len(changed)))
        changed[place : place + length] = struct.pack("<Q", value)[:length]
        what = f"{value} in {length} bytes from {place}"
    elif kind < (most := most + EXCHANGES):
        length, other = dice.choice((8, 64, 512)), source.place(dice)
        one, two = changed[place : place + length], changed[other : other + length]
        if len(one) == len(two):
            changed[other : other + length], changed[place : place + length] = one, two
        what = f"{length} bytes from {place} and {other} exchanged"
    elif kind < most + LENGTHS:
        length = dice.randrange(len(changed))
        changed = changed[:length] if dice.random() < 0.8 else changed + dice.randbytes(length)
        what = f"length {len(changed)}"
    else:
        target.write_bytes(changed)
        return other_object(dice, target)
    target.write_bytes(changed)
    return what


def other_object(dice: random.Random, path: Path) -> str:
    """Other things in place of one to three things of the file."""
    said = []
    with h5py.File(path, "r+") as file:
        names: list[str] = []
        file.visit(names.append)
        for _ in range(dice.choice((1, 1, 2, 3))):
            try:
                if dice.random() < 0.35:
                    name, make = dice.choice(list(file.attrs)), dice.choice(ATTRIBUTES)
                    value = make(dice, file.attrs[name])
                    said.append(f"attribute {name}: {make.__name__}")
                    if value is None:
                        del file.attrs[name]
                    else:
                        file.attrs[name] = value
                else:
                    name, make = dice.choice(names), dice.choice(OBJECTS)
                    said.append(f"{name}: {make.__name__}")
                    make(dice, file, name)
            except Exception:
                # what was damaged before, or cannot be made of this
                said[-1:] = []
    return ", ".join(said)


# ---- attributes --------------------------------------------------------------------------------


def no_attribute(dice: random.Random, old: Any) -> Any:
    return None


def text(dice: random.Random, old: Any) -> Any:
    return dice.choice(TEXTS)


def text_of_one_size(dice: random.Random, old: Any) -> Any:
    return np.bytes_(dice.choice((b"\xff\xfe", b"tiltpad", b"x" * 60000, b"\x00")))


def changed_text(dice: random.Random, old: Any) -> Any:
    if not isinstance(old, str) or not old:
        return None
    place = dice.randrange(len(old))
    return old[:place] + dice.choice("0123456789=&/',\n\u00e4\x01") + old[place + dice.randrange(2) :]


def whole_number(dice: random.Random, old: Any) -> Any:
    kind = dice.choice((np.int8, np.uint8, np.int32, np.int64, np.uint64, ">i4"))
    return np.array(dice.choice((0, 1, 2, 3, 4, 99, 127)), kind) if dice.random() < 0.5 else dice.choice(
        (np.int64(-1), np.int64(2**31), np.uint64(2**64 - 1), np.int64(-(2**63)))
    )  # fmt: skip


def real_number(dice: random.Random, old: Any) -> Any:
    return dice.choice((np.nan, np.inf, 1e300, -1.0, np.float32(2), np.float16(1)))


def list_attribute(dice: random.Random, old: Any) -> Any:
    lists = [np.zeros(shape) for shape in (3000, 0, (2, 2))]
    texts = np.array(["&case /"] * 50, h5py.string_dtype())
    return dice.choice((*lists, texts, h5py.Empty("f8"), h5py.Empty("S3"), np.zeros(2, "i4,f8")))


ATTRIBUTES = (no_attribute, text, text_of_one_size, changed_text, whole_number, real_number, list_attribute)

# ---- datasets and groups -----------------------------------------------------------------------


def nothing(dice: random.Random, file: h5py.File, name: str) -> None:
    del file[name]


def group(dice: random.Random, file: h5py.File, name: str) -> None:
    del file[name]
    file.create_group(name)


def itself(dice: random.Random, file: h5py.File, name: str) -> None:
    del file[name]
    file[name] = file["/"]


def link(dice: random.Random, file: h5py.File, name: str) -> None:
    del file[name]
    file[name] = dice.choice(
        (h5py.SoftLink("/nowhere"), h5py.SoftLink(f"/{name}"), h5py.SoftLink("/time"), h5py.SoftLink("/"),
         h5py.ExternalLink("/dev/zero", "/x"), h5py.ExternalLink("sound.h5", "/time"))
    )  # fmt: skip


def another(dice: random.Random, file: h5py.File, name: str) -> None:
    others: list[str] = []
    file.visit(others.append)
    other = dice.choice(others)
    file.move(name, "kept")
    file[name] = file["kept" if other == name else other]


def other_kind(dice: random.Random, file: h5py.File, name: str) -> None:
    shape = getattr(file[name], "shape", ())
    del file[name]
    kind = dice.choice(("f4", ">f8", "i4", "u8", "S3", "O", "V5", "i4,f8", "c16", "?", "(3,)f8", "f2"))
    file.create_dataset(name, shape, h5py.string_dtype() if kind == "O" else kind)


def other_shape(dice: random.Random, file: h5py.File, name: str) -> None:
    shape = dice.choice(
        ((), (0,), (1,), (7,), (4096,), (3, 0), (2, 2), (1000, 1), (1, 2000), (2,) * 9, (0,) * 32)
    )
    del file[name]
    file.create_dataset(name, shape, "f8")


def no_space(dice: random.Random, file: h5py.File, name: str) -> None:
    del file[name]
    file[name] = h5py.Empty("f8")


def large(dice: random.Random, file: h5py.File, name: str) -> None:
    """Claims up to 2**60 values and chunks of up to 4 GB, which are not there."""
    grown = dice.choice((10**6, 400_000_000, 2**40, 2**57))
    shape = (grown,) if dice.random() < 0.6 else (grown, 2)
    chunk = (dice.choice((1, 4096, 10**6, 2**28, 2**29 - 1)), *shape[1:])
    filters = dice.choice(({}, {"compression": "gzip"}, {"compression": "lzf"}, {"fletcher32": True}))
    if 8 * np.prod(chunk, dtype=float) >= 2**32:
        chunk = (2**28, *shape[1:])
    chunk = tuple(map(min, chunk, shape))
    del file[name]
    # deflated zeros of a small chunk alone: this is to take no time
    made = file.create_dataset(name, shape, "f8", chunks=chunk, maxshape=(None, *shape[1:]), **filters)
    if np.prod(chunk) <= 10**6:
        made[:1] = 1.0
        made[-1:] = 1.0


def other_length(dice: random.Random, file: h5py.File, name: str) -> None:
    file[name].resize(max(0, len(file[name]) + dice.choice((-1, 1, -5, 4096, 10**6, -(10**9)))), axis=0)


def other_value(dice: random.Random, file: h5py.File, name: str) -> None:
    value = dice.choice((np.nan, np.inf, -1.0, 0.0, 1e300, 1e-300, 2.0, 1e9))
    values = file[name]
    place = tuple(dice.randrange(size) for size in values.shape)
    values[place if dice.random() < 0.5 else ...] = value


def long_name(dice: random.Random, file: h5py.File, name: str) -> None:
    file[f"{name}{dice.choice(('x' * 5000, ' ', chr(10), 'ä' * 150, '..', '.' * 300))}"] = 1.0


def deep(dice: random.Random, file: h5py.File, name: str) -> None:
    place = file.require_group("statistics")
    for _ in range(200):
        place = place.create_group("a")


def many(dice: random.Random, file: h5py.File, name: str) -> None:
    place = file.create_group("more")
    for k in range(3000):
        place[f"a{k}"] = h5py.SoftLink("/time")


OBJECTS: tuple[Callable[[random.Random, h5py.File, str], None], ...] = (
    *(nothing, group, itself, link, link, another, another, other_kind, other_kind, other_shape, other_shape),
    *(no_space, large, large, other_length, other_length, other_value, other_value, other_value, other_value),
    *(long_name, deep, many),
)
