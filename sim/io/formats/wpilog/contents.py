"""Group the records of a WPILOG file into entries, up to the first invalid record.

The file is read once, window by window. A match's log has hundreds of entries, of which a fit needs
four, so only the values of wanted entries are kept. After an entry is finished, its id can be used
for another entry, and an entry can be started again with another id. Samples of entries with the
same name and type are joined in the order of time.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from os import SEEK_END
from pathlib import Path
from typing import IO, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from sim.io.entries.entry import Entry, Numbers
from sim.io.formats.wpilog.control import METADATA, START, Start, parse_control_record
from sim.io.formats.wpilog.records import (
    PAD,
    Bytes,
    find_first_record,
    find_records,
    open_log,
    pad,
    read_headers,
    view_as_numbers,
)

Wanted: TypeAlias = Callable[[Start], bool]

NUMBERS = {"double": "<f8", "int64": "<i8", "float": "<f4", "boolean": "?"}
DTYPES = NUMBERS | {"string": "O", "json": "O"}
SIZES = {kind: np.dtype(dtype).itemsize for kind, dtype in NUMBERS.items()}  # [bytes] of a value
WINDOW = 1 << 21  # [bytes] read at a time; a longer record gets a window of its own
SMALL_IDS = 1 << 16  # smaller ids fit 16 bits, which NumPy sorts by radix sort
LIKELY_SIZE = 1 << 16  # [bytes] of a text or array; a larger size is taken for damage


@dataclass(frozen=True)
class FileDamage:
    """The place and reason at which reading stopped before the end of the file.

    Args:
        offset: the first byte that was not used.
        unread_bytes: number of bytes from there to the end of the file.
        what: the problem of the record there, as a clause.
        torn: whether the file only ends too soon, as after a power loss.
    """

    offset: int
    unread_bytes: int
    what: str
    torn: bool


@dataclass
class _Series:
    """The samples of an entry so far, in pieces: one for each window.

    Args:
        type: the entry's type.
        metadata: its last metadata that is not empty.
        is_wanted: whether its values are kept.
        times: their times [µs].
        values: the values; none of types that are not in ``DTYPES``.
    """

    type: str
    metadata: str = ""
    is_wanted: bool = True
    times: list[Numbers] = field(default_factory=list)
    values: list[NDArray[Any]] = field(default_factory=list)

    def add(self, head: Numbers, window: bytes, buffer: Bytes) -> None:
        """Add samples of a window with these headers."""
        _, _, size, time, payload = head
        self.times.append(time.copy())  # of the window, no more is kept
        if self.type in SIZES:
            values = view_as_numbers(buffer, np.dtype(DTYPES[self.type]))
            self.values.append(values[payload])
        elif self.type in DTYPES:
            spans = zip(payload.tolist(), (payload + size).tolist(), strict=True)
            texts = [window[begin:end].decode("utf-8", "replace") for begin, end in spans]
            self.values.append(np.array(texts, dtype=np.object_))

    def make_entry(self, name: str) -> Entry:
        """The samples so far, in the order of time."""
        time = np.concatenate([np.zeros(0, dtype=np.int64), *self.times])
        values = np.concatenate([np.zeros(0, dtype=DTYPES.get(self.type)), *self.values])
        if (time[1:] < time[:-1]).any():
            order = np.argsort(time, kind="stable")
            time = time[order]
            values = values[order] if values.size else values
        return Entry(name, self.type, self.metadata, time, values)


def read_contents(path: Path, wanted: Wanted = bool) -> "Contents":
    """The entries of a file up to its first invalid record, without the values of unwanted ones.

    Args:
        path: the file.
        wanted: tells whether the values of an entry are wanted.

    Raises:
        UnreadableFile: the file is not a WPILOG file, of a later version, damaged, too large, or
            ends before its first record.
    """
    with open_log(path) as stream:
        contents = Contents(wanted)
        contents.read(stream, where=str(path))
        if contents.unknown:
            # The first record of an entry that was not started later either is invalid
            number, (offset, _) = min(contents.unknown.items(), key=lambda item: item[1])
            contents = Contents(wanted)
            contents.read(stream, where=str(path), before=offset)
            contents.problem = f"a record of the unknown entry {number}"
        contents.damage = contents.find_damage(stream)
        return contents


class Contents:
    """The entries in the whole records of a file, and later those that were appended.

    Args:
        wanted: tells whether the values of an entry are wanted.
    """

    def __init__(self, wanted: Wanted) -> None:
        self.end = 0  # the offset up to which the file was read
        self.problem = ""  # of the record there, as a clause
        self.damage: FileDamage | None = None  # why the rest was not read; None if all was read
        self.unknown: dict[int, tuple[int, int]] = {}  # id -> offset of its first record, count
        self.orphans = 0  # records before the start of their entry: another file's continuation
        self._wanted = wanted
        self._series: dict[tuple[str, str], _Series] = {}
        self._open: dict[int, _Series | None] = {}  # id -> its entry; None after it is finished

    def list_entries(self) -> list[Entry]:
        """The entries so far, in the order in which they first appear."""
        return [series.make_entry(name) for (name, _), series in self._series.items()]

    def read(self, stream: IO[bytes], *, where: str, before: int | None = None) -> None:
        """Read on to the first invalid record, the last whole one, or the offset ``before``.

        Raises:
            UnreadableFile: the file is not a WPILOG file, of a later version, or ends before its
                first record.
        """
        size = stream.seek(0, SEEK_END)
        self.end = self.end or find_first_record(stream, size=size, where=where)
        length = WINDOW
        while not self.problem and self.end < (before or size):
            stream.seek(self.end)
            window = stream.read(min(length, (before or size) - self.end))
            starts, end = find_records(window)
            if end:
                self._add_window(window, starts, end)
                length = WINDOW
                continue
            _, _, payload_size, _, payload = self._read_header(stream)
            length = payload + payload_size
            if length > size - self.end or length <= len(window):
                break  # the record is longer than the file, or its header is incomplete

    def find_damage(self, stream: IO[bytes]) -> FileDamage | None:
        """Why the rest of the file was not read; None if all was read."""
        unread_bytes = stream.seek(0, SEEK_END) - self.end
        if not unread_bytes:
            return None
        what, torn = self._explain_end(stream, unread_bytes)
        return FileDamage(self.end, unread_bytes, what, torn)

    def _explain_end(self, stream: IO[bytes], unread_bytes: int) -> tuple[str, bool]:
        """The problem of the record at the end, and whether the file only ends too soon."""
        stream.seek(self.end)
        blocks = iter(partial(stream.read, WINDOW), b"")
        if all(block.count(0) == len(block) for block in blocks):
            return "nothing but zero bytes", True
        if self.problem:
            return self.problem, False
        _, number, size, _, payload = self._read_header(stream)
        if payload > unread_bytes:
            return "a record that stops within its header", True
        entry = self._open.get(number)
        fixed = SIZES.get(entry.type) if entry else None
        known = number == 0 or entry is not None
        torn = known and (size == fixed if fixed else size <= LIKELY_SIZE)
        return f"a record that claims {size} bytes", torn

    def _read_header(self, stream: IO[bytes]) -> list[int]:
        """The header of the record at the end, which may be incomplete."""
        stream.seek(self.end)
        header: list[int] = read_headers(pad(stream.read(PAD)), np.array([0]))[:, 0].tolist()
        return header

    def _add_window(self, window: bytes, starts: Numbers, end: int) -> None:
        """Add the samples of a window's records, and follow its control records."""
        buffer = pad(window)
        head = read_headers(buffer, starts)
        controls = np.flatnonzero(head[1] == 0).tolist()
        for control, following in pairwise([-1, *controls, starts.size]):
            if control >= 0:
                self._follow_control(head[:, control], window)
            if not self.problem:
                self._add_samples(head[:, control + 1 : following], window, buffer)
            if self.problem:
                return
        self.end += end

    def _follow_control(self, head: Numbers, window: bytes) -> None:
        """Start or finish an entry, or change its metadata."""
        start, _, size, _, payload = head.tolist()
        found = parse_control_record(window[payload : payload + size])
        if found is None:
            self._stop_at(start, "a control record that makes no sense")
            return
        which, number, texts = found
        if which == START:
            control = Start(number, *texts)
            _, orphans = self.unknown.pop(control.id, (0, 0))
            self.orphans += orphans
            new = _Series(control.type)
            series = self._series.setdefault((control.name, control.type), new)
            series.is_wanted = self._wanted(control)
            series.metadata = control.metadata or series.metadata
            self._open[control.id] = series
        elif open_now := self._open.get(number):
            if which == METADATA:
                open_now.metadata = texts[0]
            else:
                self._open[number] = None

    def _add_samples(self, head: Numbers, window: bytes, buffer: Bytes) -> None:
        """Add samples, up to the first with a wrong size for its type."""
        groups = [(self._open.get(int(part[1, 0])), part) for part in _split_by_id(head)]
        misfits = [
            (int(part[0, wrong.argmax()]), f"a {series.type} of {part[2, wrong.argmax()]} bytes")
            for series, part in groups
            if series and series.type in SIZES
            if (wrong := part[2] != SIZES[series.type]).any()
        ]
        if misfits:
            start, problem = min(misfits)
            self._add_samples(head[:, head[0] < start], window, buffer)
            self._stop_at(start, problem)
            return
        for series, part in groups:
            number, first = int(part[1, 0]), self.end + int(part[0, 0])
            if number not in self._open:
                first, count = self.unknown.get(number, (first, 0))
                self.unknown[number] = first, count + part.shape[1]
            elif series and series.is_wanted:
                series.add(part, window, buffer)

    def _stop_at(self, start: int, problem: str) -> None:
        """Stop reading at a record of the window, because of a problem."""
        self.end += start
        self.problem = problem


def _split_by_id(head: Numbers) -> list[Numbers]:
    """The headers of each entry id."""
    if not head.size:
        return []
    ids = head[1].astype(np.uint16) if head[1].max() < SMALL_IDS else head[1]
    head = head[:, np.argsort(ids, kind="stable")]
    return np.split(head, np.flatnonzero(np.diff(head[1])) + 1, axis=1)
