"""Find the records of a WPILOG file, a chain in which each record tells where the next begins.

    record = bits, entry id, payload size, timestamp [µs], payload
    bits   = 0b0TTTSSII: lengths in bytes, less one, of timestamp, size and id

A record's end is known only from its own header, so a plain loop follows the chain. It reads
nothing but the lengths. NumPy reads the other fields, for all records of a window at once.
"""

import lzma
import struct
from contextlib import ExitStack
from pathlib import Path
from tempfile import SpooledTemporaryFile
from typing import IO, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import UnreadableFile
from sim.core.log import Array
from sim.io.entries.entry import Numbers
from sim.io.format import LARGEST_FILE

Bytes: TypeAlias = NDArray[np.uint8]
Number = TypeVar("Number", bound=np.generic)

MAGIC = b"WPILOG"
XZ_MAGIC = b"\xfd7zXZ\x00"  # magic of a file compressed with xz: .wpilogxz
PIECE = 1 << 20  # [bytes] decompressed at a time
IN_MEMORY = 1 << 26  # [bytes] a larger decompressed log is stored on the disk
PREFACE = 12  # [bytes] magic, version (2), length of the extra header (4)
MAJOR = 1  # the only version is 1.0
FILE_HEADER = MAGIC + struct.pack("<HI", MAJOR << 8, 0)
PAD = 32  # [bytes] zeros after a window, so that an incomplete header can be read
SHORT, LONG = struct.Struct("<BBBQ"), struct.Struct("<BIIQ")  # headers of the records written here
SHORT_BITS, LONG_BITS = 0b0111_0000, 0b0111_1111  # their first bytes
BYTE = 255  # largest number of one byte
LONG_SIZE = 0b1100  # bits of a record whose payload size takes more than one byte

# Offsets in a record by its first byte
SIZE_AT = [2 + (bits & 3) for bits in range(256)]
TIME_AT = [SIZE_AT[bits] + 1 + (bits >> 2 & 3) for bits in range(256)]
PAYLOAD_AT = [TIME_AT[bits] + 1 + (bits >> 4 & 7) for bits in range(256)]
MASK = np.array([(1 << 8 * length) - 1 for length in range(9)], dtype=np.uint64)


def pack_record(number: int, time: int, payload: bytes) -> bytes:
    """A record, whose time has eight bytes, and its id and size one each, or four if needed."""
    if number <= BYTE and len(payload) <= BYTE:
        return SHORT.pack(SHORT_BITS, number, len(payload), time) + payload
    return LONG.pack(LONG_BITS, number, len(payload), time) + payload


def pack_records(number: int, time: Numbers, values: Array | bytes) -> list[bytes]:
    """The records of one entry at several times [µs]: of doubles, or of the same text."""
    dtype = f"S{len(values)}" if isinstance(values, bytes) else "<f8"
    length = np.dtype(dtype).itemsize
    kind, bits = ("u1", SHORT_BITS) if max(number, length) <= BYTE else ("<u4", LONG_BITS)
    table = np.empty(
        time.size,
        [("bits", "u1"), ("id", kind), ("size", kind), ("time", "<u8"), ("value", dtype)],
    )
    table["bits"], table["id"], table["size"] = bits, number, length
    table["time"], table["value"] = time, values
    whole, size = table.tobytes(), table.itemsize
    return [whole[at : at + size] for at in range(0, len(whole), size)]


def find_records(window: bytes) -> tuple[Numbers, int]:
    """Offsets of the whole records of a window that begins with one, and the end of the last."""
    starts: list[int] = []
    size_at, payload_at = SIZE_AT, PAYLOAD_AT  # local names are faster
    at = 0
    try:
        while True:
            bits = window[at]
            size = window[at + size_at[bits]]
            if bits & LONG_SIZE:
                size = int.from_bytes(window[at + size_at[bits] : at + TIME_AT[bits]], "little")
            starts.append(at)
            at += payload_at[bits] + size
    except IndexError:  # the end of the window
        while at > len(window):
            at = starts.pop()
    return np.array(starts, dtype=np.int64), at


def read_headers(buffer: Bytes, start: Numbers) -> Numbers:
    """The headers of the records that begin at ``start``.

    Args:
        buffer: the window, followed by at least ``PAD`` bytes.
        start: (n,) offset of each record.

    Returns:
        (5, n) offset, entry id (0 for control records), payload size [bytes], timestamp [µs] and
        offset of the payload.
    """
    bits = buffer[start].astype(np.intp)
    size_at, time_at, payload = (
        start + np.array(table)[bits] for table in (SIZE_AT, TIME_AT, PAYLOAD_AT)
    )
    numbers = view_as_numbers(buffer, np.dtype("<u8"))
    fields = [
        (numbers[at] & MASK[end - at]).view(np.int64)
        for at, end in ((start + 1, size_at), (size_at, time_at), (time_at, payload))
    ]
    return np.stack([start, *fields, payload])


def pad(window: bytes) -> Bytes:
    """The window as an array, followed by ``PAD`` zeros."""
    return np.frombuffer(window + bytes(PAD), dtype=np.uint8)


def view_as_numbers(buffer: Bytes, dtype: np.dtype[Number]) -> NDArray[Number]:
    """The buffer as numbers that begin at every byte: element i, at offset i."""
    return np.ndarray((buffer.size - dtype.itemsize + 1,), dtype, buffer, strides=(1,))


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
        _decompress(stream, unpacked, where=str(path))
        unpacked.seek(0)
        ends.pop_all()  # the caller closes it
        return unpacked


def _decompress(stream: IO[bytes], unpacked: IO[bytes], *, where: str) -> None:
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


def find_first_record(stream: IO[bytes], *, size: int, where: str) -> int:
    """Offset of the first record, after the file header has been checked.

    Args:
        stream: the file.
        size: its length [bytes].
        where: its path, for messages.

    Raises:
        UnreadableFile: the file is not a WPILOG file, of a later version, or ends before its first
            record.
    """
    stream.seek(0)
    opening = stream.read(PREFACE)
    if not opening.startswith(MAGIC[: len(opening)]):
        raise UnreadableFile(
            f"it does not begin with {MAGIC.decode()}, so it is not a WPILOG file",
            where=f"{where}, byte 0",
            advice="Give the .wpilog file itself; export a .hoot file to WPILOG first.",
        )
    if len(opening) < PREFACE:
        raise _cut_short(where, size)
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
