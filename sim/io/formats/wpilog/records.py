"""Find the records of a WPILOG file, a chain in which each record tells where the next begins.

    record = bits, entry id, payload size, timestamp [µs], payload
    bits   = 0b0TTTSSII: lengths in bytes, less one, of timestamp, size and id

A record's end is known only from its own header, so following the chain is serial, and slow in
plain Python. Here, a whole window is processed with NumPy. Every byte that could begin a record is
a candidate, and its successor is computed. Candidates without a successor or a predecessor among
the candidates are dropped. The rest are almost only true records, each followed directly by its
successor, and the serial walk visits only the exceptions. The result is exact: a record is accepted
only if the one before it ends where it begins.
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
XZ_MAGIC = b"\xfd7zXZ\x00"  # magic of a file compressed with xz: .wpilogxz
PIECE = 1 << 20  # [bytes] decompressed at a time
IN_MEMORY = 1 << 26  # [bytes] a larger decompressed log is stored on the disk
PREFACE = 12  # [bytes] magic, version (2), length of the extra header (4)
MAJOR = 1  # the only version is 1.0
PAD = 32  # [bytes] zeros after the file, so that an incomplete header can be read
FIRST_WINDOW = 1 << 14  # [bytes] small while first header bytes that are new still appear
MEMORY = 1 << 16  # [bytes] a first header byte is expected so far after its last occurrence
LARGEST_WINDOW = 1 << 19  # [bytes] larger windows exceed the processor's cache
BLOCK = 1 << 15  # [records] read at a time, for the same reason
FEW = 8  # up to so many comparisons are faster than a lookup table

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
        content: its bytes, followed by PAD zeros.
    """

    content: bytearray

    @property
    def size(self) -> int:
        """The length of the file [bytes]."""
        return len(self.content) - PAD

    @property
    def buffer(self) -> Bytes:
        """The content as an array (size + PAD,)."""
        return np.frombuffer(self.content, dtype=np.uint8)

    @cached_property
    def latin1_text(self) -> str:
        """The content as text, one character per byte."""
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
    """A file and the offsets of its records.

    Args:
        path: path of the file.
        size: length of the file [bytes].
        file: the part of it in memory: all of it, or the payloads of some records.
        start: (n,) offset in the file of each whole record in memory, in order.
        end: offset after the last whole record; the file's size if the chain reaches its end.
        head: the headers of these records; their payloads are offsets in ``file``.
    """

    path: Path
    size: int
    file: File
    start: Numbers
    end: int
    head: RecordHeaders

    def read_header_at(self, offset: int) -> RecordHeaders:
        """The header at an offset of the file, which may be incomplete."""
        with open_log(self.path) as stream:
            stream.seek(offset)
            found = bytearray(stream.read(PAD)) + bytearray(PAD)
        header = read_headers(File(found).buffer, np.array([0]))
        return RecordHeaders(header.id, header.size, header.time, header.payload + offset)

    def has_only_zeros_from(self, offset: int) -> bool:
        """Whether the rest of the file from an offset has only zero bytes."""
        with open_log(self.path) as stream:
            stream.seek(offset)
            while block := stream.read(LARGEST_WINDOW):
                if block.count(0) < len(block):
                    return False
        return True


def open_log(path: Path) -> IO[bytes]:
    """Open a file to read its bytes, decompressed if it is compressed with xz.

    A compressed file that was cut off, as after a power loss, is read up to there.

    Raises:
        UnreadableFile: the file is damaged, or too large when decompressed.
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
        ends.pop_all()  # the caller closes it
        return unpacked


def _unpack(stream: IO[bytes], unpacked: IO[bytes], *, where: str) -> None:
    """Decompress a file that is compressed with xz.

    Raises:
        UnreadableFile: the file is damaged, or too large when decompressed.
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
        pass  # the file was cut off
    except lzma.LZMAError as error:
        raise UnreadableFile(
            f"it is packed with xz, and damaged ({error})",
            where=where,
            advice="Copy it from the robot again. If that does not help, record the tests again.",
        ) from None


def load_records(path: Path) -> Records:
    """Read a whole file and find its records.

    Raises:
        UnreadableFile: the file is not a WPILOG file, of a later version, damaged, too large, or
            ends before its first record.
    """
    with open_log(path) as file:
        content = bytearray(file.seek(0, SEEK_END) + PAD)
        file.seek(0)
        found = file.read(len(content) - PAD)
        size = len(found)
        content[:size] = found
    del content[size + PAD :]  # if the file became shorter while it was read
    whole = File(content)
    start, end = follow_records(whole, first=find_first_record(whole, size=size, where=str(path)))
    return Records(path, size, whole, start, end, read_headers(whole.buffer, start))


def follow_records(file: File, *, first: int) -> tuple[Numbers, int]:
    """Follow the records from ``first`` on as long as they are complete.

    Args:
        file: the file.
        first: offset of the first record.

    Returns:
        The offset of each record, and the offset after the last.
    """
    shapes: dict[int, int] = {}  # first header byte -> offset of its last occurrence
    buffer, size = file.buffer, file.size
    pieces = [np.zeros(0, dtype=np.int64)]
    at, window = first, FIRST_WINDOW
    while at < size:
        shapes = {shape: last for shape, last in shapes.items() if at - last < MEMORY}
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
        UnreadableFile: the file is not a WPILOG file, of a later version, or ends before its first
            record.
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
    """The consecutive records of one window from ``at`` on, and the end of the last one.

    There are none if the record at ``at`` is incomplete. They may end before the window, at a
    record whose first header byte is new.
    """
    width = stop - at
    # The last element stands for all bytes after the window
    open_here = np.ones(width + 1, dtype=bool)
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
    """Whether each byte is one of the known first header bytes."""
    if len(shapes) > FEW:
        known = np.zeros(256, dtype=bool)
        known[list(shapes)] = True
        return np.take(known, window)
    found: Flags = np.equal(window, shapes[0])
    for shape in shapes[1:]:
        found |= window == shape
    return found


def _lengths(buffer: Bytes, start: Numbers, shapes: Sequence[int]) -> Numbers:
    """Length of the records, header and payload, if they began at ``start`` [bytes]."""
    bits = shapes[0] if len(shapes) == 1 else buffer[start].astype(np.intp)
    size = view_numbers(buffer, np.uint32)[start + (1 + ID_LENGTH)[bits]] & SIZE_MASK[bits]
    lengths: Numbers = HEADER_LENGTH[bits] + size
    return lengths


def _shape(bits: Bytes) -> int | NDArray[np.intp]:
    """The first header bytes as an index: one for all if they are the same, else an array."""
    if bits.size and bool((bits == bits[0]).all()):
        return int(bits[0])
    return bits.astype(np.intp)  # other types would be converted at every use


def _walk(begin: Numbers, after: Numbers) -> tuple[Flags | slice, int]:
    """The candidates in the chain from the first one, and the index of its last.

    A sequence of candidates that follow one another directly is passed in one step.
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
