"""Read a WPILOG file window by window, and keep only the records of wanted entries.

A match's log has hundreds of entries, of which a fit needs four. Values of the others are dropped
to save memory. Records that show damage are kept: those without an entry, and those with a wrong
size for their type.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TypeAlias

import numpy as np

from sim.io.formats.wpilog.control import Start, parse_control_record
from sim.io.formats.wpilog.entry import SIZES
from sim.io.formats.wpilog.records import (
    PAD,
    PREFACE,
    File,
    Flags,
    Numbers,
    RecordHeaders,
    Records,
    find_first_record,
    follow_records,
    open_log,
    read_headers,
)

Wanted: TypeAlias = Callable[[Start], bool]

FIRST = 1 << 17  # [bytes] of the first window
LARGEST = 1 << 21  # [bytes] of a window at most; a longer record gets a window of its own
IDS = 1 << 16  # records with larger ids are all kept


def load_wanted_records(path: Path, wanted: Wanted) -> Records:
    """The records of the wanted entries of a file, and those that are malformed.

    Args:
        path: the file.
        wanted: tells whether the values of an entry are wanted.

    Raises:
        UnreadableFile: the file is not a WPILOG file, of a later version, damaged, too large, or
            ends before its first record.
    """
    kept = _KeptRecords(wanted)
    end, size = _read_windows(path, kept, at=0)
    found = kept.records(path, size=size, end=end)
    kept.clear()
    return found


class GrowingFile:
    """The wanted records of a file that is still being written.

    Args:
        path: the file.
        wanted: tells whether the values of an entry are wanted.
    """

    def __init__(self, path: Path, wanted: Wanted) -> None:
        self.path = path
        self._kept = _KeptRecords(wanted)
        self._end = 0

    def read_appended_records(self) -> Records:
        """Read the appended records; returns all so far. An incomplete last one is read later.

        Raises:
            UnreadableFile: as ``load_wanted_records``.
        """
        self._end, size = _read_windows(self.path, self._kept, at=self._end)
        return self._kept.records(self.path, size=size, end=self._end)


def _read_windows(path: Path, kept: "_KeptRecords", *, at: int) -> tuple[int, int]:
    """Keep the wanted records from an offset on; 0 begins after the file header.

    Returns:
        The offset after the last whole record, and the length of the file [bytes].
    """
    with open_log(path) as stream:
        size = stream.seek(0, 2)
        if at == 0:
            stream.seek(0)
            opening = File(bytearray(stream.read(PREFACE)) + bytearray(PAD))
            at = find_first_record(opening, size=size, where=str(path))
        window = FIRST
        while at < size:
            file = _read_window(stream, at, window)
            start, end = follow_records(file, first=0)
            if not start.size:
                head = read_headers(file.buffer, np.zeros(1, dtype=np.int64))
                length = int(head.payload[0] + head.size[0])
                if length > size - at or length <= file.size:
                    break  # the record is longer than the file, or its header is incomplete
                window = length
                continue
            kept.add(file, start, base=at)
            at += end
            window = min(2 * window, LARGEST)
    return at, size


def _read_window(stream: IO[bytes], at: int, length: int) -> File:
    stream.seek(at)
    return File(bytearray(stream.read(length)) + bytearray(PAD))


@dataclass
class _KeptRecords:
    """The records kept so far.

    Args:
        wanted: tells whether the values of an entry are wanted.
        drop: (IDS,) whether records of an id are dropped.
        size: (IDS,) length of their payloads [bytes]; -1 if it can vary.
        pieces: for each window, (5, n) offset, id, size, time and payload offset of each record.
        payloads: for each window, the payloads joined.
        length: length of all payloads [bytes].
    """

    wanted: Wanted
    drop: Flags = field(default_factory=lambda: np.zeros(IDS, dtype=np.bool_))
    size: Numbers = field(default_factory=lambda: np.full(IDS, -1))
    pieces: list[Numbers] = field(default_factory=list)
    payloads: list[bytes] = field(default_factory=list)
    length: int = 0

    def add(self, file: File, start: Numbers, *, base: int) -> None:
        """Keep the wanted records of a window.

        Args:
            file: the window.
            start: (n,) offsets of its records.
            base: offset of the window in the file.
        """
        head = read_headers(file.buffer, start)
        small = np.minimum(head.id, IDS - 1)
        dropped = self.drop[small] & (head.id < IDS)
        if dropped.any():
            sizes = self.size[small]
            dropped &= (sizes < 0) | (sizes == head.size)
        for number in self._follow_controls(file, head):
            # Keep all of them: whether they are before or after the control record matters
            dropped &= head.id != number
        keep = np.flatnonzero(~dropped)
        payload, sizes = head.payload[keep], head.size[keep]
        place = self.length + np.cumsum(sizes) - sizes
        self.pieces.append(
            np.stack([start[keep] + base, head.id[keep], sizes, head.time[keep], place])
        )
        index = np.repeat(payload - place + self.length, sizes) + np.arange(int(sizes.sum()))
        self.payloads.append(file.buffer[index].tobytes())
        self.length += int(sizes.sum())

    def _follow_controls(self, file: File, head: RecordHeaders) -> set[int]:
        """Update ``drop`` and ``size`` by a window's control records; the ids in these records."""
        ids = set()
        for index in np.flatnonzero(head.id == 0).tolist():
            begin = int(head.payload[index])
            control = parse_control_record(
                bytes(file.content[begin : begin + int(head.size[index])])
            )
            if control is None:
                continue
            ids.add(control.id)
            if control.id < IDS:
                self.drop[control.id] = isinstance(control, Start) and not self.wanted(control)
                self.size[control.id] = (
                    SIZES.get(control.type, -1) if isinstance(control, Start) else -1
                )
        return ids

    def records(self, path: Path, *, size: int, end: int) -> Records:
        """All records kept so far."""
        table = np.concatenate([np.zeros((5, 0), dtype=np.int64), *self.pieces], axis=1)
        self.pieces[:] = [table]
        file = File(bytearray().join([*self.payloads, bytes(PAD)]))
        return Records(path, size, file, table[0], end, RecordHeaders(*table[1:]))

    def clear(self) -> None:
        """Release the memory of the kept records."""
        self.pieces.clear()
        self.payloads.clear()
