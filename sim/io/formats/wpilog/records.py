"""Where the records of a WPILOG file begin: a chain in which only each record tells the next.

    record = bits, entry id, payload size, timestamp [µs], payload
    bits   = 0b0TTTSSII: lengths in bytes, less one, of timestamp, size and id

A record's end is known only from its own header, so following the chain is serial, and in plain
Python slow. Here a whole window is looked at in one go. Every byte that could open a record is a
candidate, its would-be successor is computed, and candidates that do not lead to, or are not led
to by, another one are dropped. What is left is almost only true records, each followed directly
by its successor; the walk touches no more than the places where that is not so. Nothing is
guessed: a record is taken only because the one before it ends where it begins.
"""

import lzma
import struct
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cached_property
from os import SEEK_END
from pathlib import Path
from tempfile import SpooledTemporaryFile
from typing import IO, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import UnreadableFile
from sim.io.format import LARGEST_FILE

Bytes: TypeAlias = NDArray[np.uint8]
Numbers: TypeAlias = NDArray[np.int64]
Flags: TypeAlias = NDArray[np.bool_]
Number = TypeVar("Number", bound=np.generic)

MAGIC = b"WPILOG"
XZ_MAGIC = b"\xfd7zXZ\x00"  # of a file that is packed with xz: .wpilogxz
PIECE = 1 << 20  # [bytes] that are unpacked at a time
IN_MEMORY = 1 << 26  # [bytes] an unpacked log that is larger goes to the disk
PREFACE = 12  # [bytes] magic, version (2), length of the extra header (4)
MAJOR = 1  # the one version there is: 1.0
PAD = 32  # [bytes] of zero behind the file, so that a header cut short can be looked at
FIRST_WINDOW = 1 << 14  # [bytes] small while record headers of a new shape still turn up
MEMORY = 1 << 16  # [bytes] a header's shape is looked for this far behind where it was last seen
LARGEST_WINDOW = 1 << 19  # [bytes] larger ones leave the processor's cache
BLOCK = 1 << 15  # [records] read at a time, for the same reason
FEW = 8  # so many comparisons cost less than one look-up by table

_BITS = np.arange(256, dtype=np.int64)
ID_LENGTH = (_BITS & 3) + 1
SIZE_LENGTH = (_BITS >> 2 & 3) + 1
TIME_LENGTH = (_BITS >> 4 & 7) + 1
HEADER_LENGTH = 1 + ID_LENGTH + SIZE_LENGTH + TIME_LENGTH
_MASK = np.array([(1 << 8 * length) - 1 for length in range(9)], dtype=np.uint64)
ID_MASK = _MASK[ID_LENGTH].astype(np.uint32)
SIZE_MASK = _MASK[SIZE_LENGTH].astype(np.uint32)
TIME_MASK = _MASK[TIME_LENGTH]


@dataclass(frozen=True, eq=False)
class File:
    """A file in memory.

    Args:
        content: its bytes, and PAD zeros behind them.
    """

    content: bytearray

    @property
    def size(self) -> int:
        """Its length [bytes]."""
        return len(self.content) - PAD

    @property
    def buffer(self) -> Bytes:
        """(size + PAD,) its content as an array."""
        return np.frombuffer(self.content, dtype=np.uint8)

    @cached_property
    def latin1_text(self) -> str:
        """Its content as text, one letter a byte."""
        return self.content.decode("latin-1")


@dataclass(frozen=True, eq=False)
class RecordHeaders:
    """The fields of some records' headers.

    Args:
        id: (n,) entry id; 0 for control records.
        size: (n,) length of the payload [bytes].
        time: (n,) timestamp [µs].
        payload: (n,) offset of the payload.
    """

    id: Numbers
    size: Numbers
    time: Numbers
    payload: Numbers


@dataclass(frozen=True, eq=False)
class Records:
    """A file and where its records begin.

    Args:
        path: where the file is.
        size: its length [bytes].
        file: what of it is in memory: all of it, or the payloads of some records.
        start: (n,) offset in the file of each whole record in memory, in order.
        end: offset behind the last whole record; the file's size if the chain reaches its end.
        head: what the headers of these records say; payloads are offsets in ``file``.
    """

    path: Path
    size: int
    file: File
    start: Numbers
    end: int
    head: RecordHeaders

    def read_header_at(self, offset: int) -> RecordHeaders:
        """The header at an offset of the file, complete or not."""
        with open_log(self.path) as stream:
            stream.seek(offset)
            found = bytearray(stream.read(PAD)) + bytearray(PAD)
        header = read_headers(File(found).buffer, np.array([0]))
        return RecordHeaders(header.id, header.size, header.time, header.payload + offset)

    def has_only_zeros_from(self, offset: int) -> bool:
        """Whether the rest of the file is nothing but zero bytes."""
        with open_log(self.path) as stream:
            stream.seek(offset)
            while block := stream.read(LARGEST_WINDOW):
                if block.count(0) < len(block):
                    return False
        return True


def open_log(path: Path) -> IO[bytes]:
    """Open a file to read its bytes, unpacked if it is packed with xz.

    What was packed before the file was cut off is there: a robot may lose power while it writes.

    Raises:
        UnreadableFile: it is damaged, or too large once it is unpacked.
    """
    stream = path.open("rb")
    if stream.read(len(XZ_MAGIC)) != XZ_MAGIC:
        stream.seek(0)
        return stream
    stream.seek(0)
    with stream, ExitStack() as ends:
        unpacked = ends.enter_context(SpooledTemporaryFile(max_size=IN_MEMORY))
        _unpack(stream, unpacked, where=str(path))
        unpacked.seek(0)
        ends.pop_all()  # whoever asked closes it
        return unpacked


def _unpack(stream: IO[bytes], unpacked: IO[bytes], *, where: str) -> None:
    """Unpack a file that is packed with xz.

    Raises:
        UnreadableFile: it is damaged, or too large once it is unpacked.
    """
    try:
        with lzma.open(stream) as packed:
            while piece := packed.read1(PIECE):
                unpacked.write(piece)
                if unpacked.tell() > LARGEST_FILE:
                    raise UnreadableFile(
                        f"unpacked it has more than {LARGEST_FILE / 2**30:.0f} GiB, the most that "
                        "is read",
                        where=where,
                        advice="Export only the four tests from it, with AdvantageScope for "
                        "example.",
                    )
    except EOFError:
        pass  # it was cut off, and so is its last record
    except lzma.LZMAError as error:
        raise UnreadableFile(
            f"it is packed with xz, and damaged ({error})",
            where=where,
            advice="Copy it from the robot again. If that does not help, record the tests again.",
        ) from None


def load_records(path: Path) -> Records:
    """Read a whole file and find its records.

    Raises:
        UnreadableFile: it is empty, foreign, of a later version, or ends before its first record.
    """
    with open_log(path) as file:
        content = bytearray(file.seek(0, SEEK_END) + PAD)
        file.seek(0)
        found = file.read(len(content) - PAD)
        size = len(found)
        content[:size] = found
    del content[size + PAD :]  # of a file that became shorter while it was read
    whole = File(content)
    start, end = follow_records(whole, first=find_first_record(whole, size=size, where=str(path)))
    return Records(path, size, whole, start, end, read_headers(whole.buffer, start))


def follow_records(file: File, *, first: int) -> tuple[Numbers, int]:
    """Follow the records from ``first`` for as long as they are whole.

    Args:
        file: the file.
        first: offset of the first record.

    Returns:
        The offset of each record, and the offset behind the last.
    """
    shapes: dict[int, int] = {}  # header bytes met lately, and where the last of them was seen
    buffer, size = file.buffer, file.size
    pieces = [np.zeros(0, dtype=np.int64)]
    at, window = first, FIRST_WINDOW
    while at < size:
        shapes = {shape: seen for shape, seen in shapes.items() if at - seen < MEMORY}
        shapes[int(buffer[at])] = at
        stop = min(at + window, size)
        found, after = _follow(buffer, tuple(shapes), at=at, stop=stop, size=size)
        pieces.append(found)
        if not found.size:
            break
        shapes |= dict.fromkeys(np.flatnonzero(np.bincount(buffer[found])).tolist(), after)
        window = min(2 * window, LARGEST_WINDOW) if after >= stop else FIRST_WINDOW
        at = after
    return np.concatenate(pieces), at


def read_headers(buffer: Bytes, start: Numbers) -> RecordHeaders:
    """Read the headers of the records that begin at ``start``."""
    table = np.empty((4, start.size), dtype=np.int64)
    for first in range(0, start.size, BLOCK):
        block = slice(first, first + BLOCK)
        at = start[block]
        bits = _shape(buffer[at])
        at = at + 1
        table[0, block] = view_numbers(buffer, np.uint32)[at] & ID_MASK[bits]
        at += ID_LENGTH[bits]
        table[1, block] = view_numbers(buffer, np.uint32)[at] & SIZE_MASK[bits]
        at += SIZE_LENGTH[bits]
        table[2, block] = (view_numbers(buffer, np.uint64)[at] & TIME_MASK[bits]).view(np.int64)
        table[3, block] = at + TIME_LENGTH[bits]
    return RecordHeaders(*table)


def view_numbers(buffer: Bytes, kind: type[Number]) -> NDArray[Number]:
    """The buffer as little-endian numbers that begin at every byte: element i, at offset i."""
    dtype = np.dtype(kind).newbyteorder("<")
    return np.ndarray((buffer.size - dtype.itemsize + 1,), dtype, buffer, strides=(1,))


def find_first_record(file: File, *, size: int, where: str) -> int:
    """Offset of the first record, after the file header has been checked.

    Args:
        file: the beginning of the file.
        size: the length of all of it [bytes].
        where: its path, for messages.

    Raises:
        UnreadableFile: it is foreign, of a later version, or ends before its first record.
    """
    opening = file.content[: min(PREFACE, file.size)]
    if not opening.startswith(MAGIC[: len(opening)]):
        raise UnreadableFile(
            f"it does not begin with {MAGIC.decode()}, so it is not a WPILOG file",
            where=f"{where}, byte 0",
            advice="Give the .wpilog file itself; export a .hoot file to WPILOG first.",
        )
    if len(opening) < PREFACE:
        raise _cut_short(where, file.size)
    version, extra = struct.unpack("<HI", opening[len(MAGIC) :])
    if version >> 8 != MAJOR:
        raise UnreadableFile(
            f"it is WPILOG version {version >> 8}.{version & 255}, and only {MAJOR}.x is known",
            where=f"{where}, byte {len(MAGIC)}",
            advice="Record or export it as WPILOG 1.0.",
        )
    first = PREFACE + int(extra)
    if first > size:
        raise _cut_short(where, size)
    return first


def _cut_short(where: str, size: int) -> UnreadableFile:
    return UnreadableFile(
        f"the file ends after {size} bytes, before its first record",
        where=f"{where}, byte {size}",
        advice="Copy it from the robot again, or record it again.",
    )


def _follow(
    buffer: Bytes, shapes: Sequence[int], *, at: int, stop: int, size: int
) -> tuple[Numbers, int]:
    """The records of one window that follow one another from ``at``, and where the last one ends.

    There are none if the record at ``at`` itself is not whole. The walk may end before the window
    does, where a record has a header of a shape not met yet.
    """
    width = stop - at
    open_here = np.ones(width + 1, dtype=bool)  # the last stands for all that lies behind
    open_here[:width] = _any_of(buffer[at:stop], shapes)
    begin = np.flatnonzero(open_here[:width])
    after = begin + _lengths(buffer, begin + at, shapes)
    leads_on = open_here[np.minimum(after, width)] & (after <= size - at)
    leads_on[0] = after[0] <= size - at  # the first is a record, whatever follows it
    if not leads_on[0]:
        return begin[:0], at
    begin, after = begin[leads_on], after[leads_on]
    led_to = np.zeros(width + 1, dtype=bool)
    led_to[np.minimum(after, width)] = True
    led_to[0] = True
    begin, after = begin[led_to[begin]], after[led_to[begin]]
    taken, last = _walk(begin, after)
    return begin[taken] + at, int(after[last]) + at


def _any_of(window: Bytes, shapes: Sequence[int]) -> Flags:
    """Which bytes are one of the header bytes met so far."""
    if len(shapes) > FEW:
        known = np.zeros(256, dtype=bool)
        known[list(shapes)] = True
        return np.take(known, window)
    found: Flags = np.equal(window, shapes[0])
    for shape in shapes[1:]:
        found |= window == shape
    return found


def _lengths(buffer: Bytes, start: Numbers, shapes: Sequence[int]) -> Numbers:
    """Length of the records that would begin at ``start``, header and payload."""
    bits = shapes[0] if len(shapes) == 1 else buffer[start].astype(np.intp)
    size = view_numbers(buffer, np.uint32)[start + (1 + ID_LENGTH)[bits]] & SIZE_MASK[bits]
    lengths: Numbers = HEADER_LENGTH[bits] + size
    return lengths


def _shape(bits: Bytes) -> int | NDArray[np.intp]:
    """The first bytes of some records as an index: one for all of them if they are the same."""
    if bits.size and bool((bits == bits[0]).all()):
        return int(bits[0])
    return bits.astype(np.intp)  # of any other type it would be converted at every use


def _walk(begin: Numbers, after: Numbers) -> tuple[Flags | slice, int]:
    """Which candidates the chain from the first one visits, and which is its last.

    A stretch of candidates that follow one another directly is crossed in one step.
    """
    broken = np.flatnonzero(after[:-1] != begin[1:])
    broken = np.append(broken, begin.size - 1)
    if broken.size == 1:
        return slice(None), begin.size - 1
    onto = np.searchsorted(begin, after[broken])
    lost = (onto == begin.size) | (begin[np.minimum(onto, begin.size - 1)] != after[broken])
    hop = np.where(lost, -1, np.searchsorted(broken, onto)).tolist()
    visited = [0]
    while hop[visited[-1]] >= 0:
        visited.append(hop[visited[-1]])
    ends = broken[visited]
    edge = np.zeros(begin.size + 1, dtype=np.int8)
    edge[0] = 1
    edge[onto[visited[:-1]]] += 1
    edge[ends + 1] -= 1
    return np.cumsum(edge[:-1], dtype=np.int8).astype(bool), int(ends[-1])
