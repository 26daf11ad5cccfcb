"""Read a WPILOG file window by window, and keep only the records of entries that are wanted.

A match's log has hundreds of entries, of which a fit needs four. Of the others no value is kept,
so that memory does not grow with the file. Whatever makes a file damaged is kept: records of no
entry, and records of a size that their type cannot have.
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

FIRST = 1 << 17  # [bytes] of the first window: no record of it is dropped
LARGEST = 1 << 21  # [bytes] of a window; a longer record gets a window of its own
IDS = 1 << 16  # records with an id above are all kept


def load_wanted_records(path: Path, wanted: Wanted) -> Records:
    """The records of the wanted entries of a file, and those that are malformed.

    Args:
        path: the file.
        wanted: whether the values of an entry are.

    Raises:
        UnreadableFile: it is empty, foreign, of a later version, or ends before its first record.
    """
    kept = _Kept(wanted)
    end, size = _read_windows(path, kept, at=0)
    found = kept.records(path, size=size, end=end)
    kept.clear()
    return found


class GrowingFile:
    """The wanted records of a file that is still being written, read on from where it stopped.

    Args:
        path: the file.
        wanted: whether the values of an entry are.
    """

    def __init__(self, path: Path, wanted: Wanted) -> None:
        self.path = path
        self._kept = _Kept(wanted)
        self._end = 0

    def read_appended_records(self) -> Records:
        """All records so far; a last one that is not whole yet is read the next time.

        Raises:
            UnreadableFile: it is empty, foreign, of a later version, or ends before its first
                record.
        """
        self._end, size = _read_windows(self.path, self._kept, at=self._end)
        return self._kept.records(self.path, size=size, end=self._end)


def _read_windows(path: Path, kept: "_Kept", *, at: int) -> tuple[int, int]:
    """Keep the wanted records from an offset on; 0 begins behind the preface.

    Returns:
        The offset behind the last whole record, and the length of the file.
    """
    with open_log(path) as stream:
        size = stream.seek(0, 2)
        if at == 0:
            stream.seek(0)
            opening = File(bytearray(stream.read(PREFACE)) + bytearray(PAD))
            at = find_first_record(opening, size=size, where=str(path))
        window = FIRST
        while at < size:
            file = _window(stream, at, window)
            start, end = follow_records(file, first=0)
            if not start.size:
                head = read_headers(file.buffer, np.zeros(1, dtype=np.int64))
                length = int(head.payload[0] + head.size[0])
                if length > size - at or length <= file.size:
                    break  # it is longer than the file, or has no header
                window = length
                continue
            kept.add(file, start, base=at)
            at += end
            window = min(2 * window, LARGEST)
    return at, size


def _window(stream: IO[bytes], at: int, length: int) -> File:
    stream.seek(at)
    return File(bytearray(stream.read(length)) + bytearray(PAD))


@dataclass
class _Kept:
    """The records kept so far.

    Args:
        wanted: which entries are.
        drop: (IDS,) whether records of an id are dropped.
        size: (IDS,) the length that their payloads must have; -1 if any will do.
        pieces: of each window: offset, id, size, time and place of the payload.
        payloads: of each window, one behind the other.
        length: of all payloads [bytes].
    """

    wanted: Wanted
    drop: Flags = field(default_factory=lambda: np.zeros(IDS, dtype=np.bool_))
    size: Numbers = field(default_factory=lambda: np.full(IDS, -1))
    pieces: list[Numbers] = field(default_factory=list)
    payloads: list[bytes] = field(default_factory=list)
    length: int = 0

    def add(self, file: File, start: Numbers, *, base: int) -> None:
        """Keep what is wanted of a window's records.

        Args:
            file: the window.
            start: (n,) where its records begin.
            base: where the window begins in the file.
        """
        head = read_headers(file.buffer, start)
        small = np.minimum(head.id, IDS - 1)
        dropped = self.drop[small] & (head.id < IDS)
        if dropped.any():
            sizes = self.size[small]
            dropped &= (sizes < 0) | (sizes == head.size)
        for number in self._follow_controls(file, head):
            dropped &= head.id != number  # which of them come before, and which after, says order
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
        """Learn from a window's control records; the ids that they speak of."""
        spoken = set()
        for index in np.flatnonzero(head.id == 0).tolist():
            begin = int(head.payload[index])
            said = parse_control_record(bytes(file.content[begin : begin + int(head.size[index])]))
            if said is None:
                continue
            spoken.add(said.id)
            if said.id < IDS:
                self.drop[said.id] = isinstance(said, Start) and not self.wanted(said)
                self.size[said.id] = SIZES.get(said.type, -1) if isinstance(said, Start) else -1
        return spoken

    def records(self, path: Path, *, size: int, end: int) -> Records:
        """All that was kept."""
        table = np.concatenate([np.zeros((5, 0), dtype=np.int64), *self.pieces], axis=1)
        self.pieces[:] = [table]
        file = File(bytearray().join([*self.payloads, bytes(PAD)]))
        return Records(path, size, file, table[0], end, RecordHeaders(*table[1:]))

    def clear(self) -> None:
        """Let go of what was kept."""
        self.pieces.clear()
        self.payloads.clear()
