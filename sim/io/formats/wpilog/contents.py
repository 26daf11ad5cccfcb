"""Group the records of a WPILOG file into entries, up to the first invalid record.

After an entry is finished, its id can be used for another entry, and an entry can be started again
with another id. Samples of entries with the same name and type are joined in the order of time.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TypeAlias

import numpy as np

from sim.io.formats.wpilog.control import Metadata, Start, parse_control_record
from sim.io.formats.wpilog.entry import SIZES, FileEntry
from sim.io.formats.wpilog.records import File, Numbers, RecordHeaders, Records

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


@dataclass(frozen=True, eq=False)
class Contents:
    """The entries of a file.

    Args:
        entries: the entries in the order in which they first appear.
        damage: why the rest of the file was not read; None if all was read.
        orphans: number of records before the start of their entry, as in the continuation of
            another file.
    """

    entries: tuple[FileEntry, ...]
    damage: FileDamage | None
    orphans: int = 0


@dataclass(frozen=True, order=True)
class _Stop:
    """The index of an invalid record, and the reason."""

    index: int
    what: str


@dataclass
class _EntryLife:
    """An entry from its start record to its finish record, by index."""

    start: Start
    metadata: str
    first: int
    last: int


@dataclass(frozen=True, eq=False)
class _Group:
    """The records with one id, in order: their indices and header fields."""

    index: Numbers
    size: Numbers
    time: Numbers
    payload: Numbers

    def select_life(self, life: _EntryLife) -> "_Group":
        """The records within one life of an entry."""
        if life.first < self.index[0] and self.index[-1] < life.last:
            return self
        first, last = self.index.searchsorted((life.first, life.last))
        return self.select(slice(first, last))

    def select(self, which: slice | Numbers) -> "_Group":
        """The records at some positions."""
        return _Group(self.index[which], self.size[which], self.time[which], self.payload[which])


_Lives: TypeAlias = dict[int, list[_EntryLife]]


def read_contents(records: Records) -> Contents:
    """Group the records of a file into entries, up to the first invalid record."""
    head = records.head
    groups = _groups(head)
    lives, stop = _find_lives(records, head, before=head.id.size)
    stops = [stop] if stop else []
    for number, group in groups.items():
        stops += _find_misfits(number, group, lives.get(number, ()))
    if stops:
        stop = min(stops)
        lives, _ = _find_lives(records, head, before=stop.index)
    orphans = sum(
        int(np.count_nonzero(groups[number].index < several[0].first))
        for number, several in lives.items()
        if several and number in groups
    )
    entries = tuple(_join_lives(lives, groups, records.file))
    return Contents(entries, _damage(records, lives, stop), orphans)


def _groups(head: RecordHeaders) -> dict[int, _Group]:
    """The records of each entry id, control records left out."""
    if not head.id.size:
        return {}
    keys = head.id.astype(np.uint16) if int(head.id.max()) < SMALL_IDS else head.id
    order = np.argsort(keys, kind="stable")
    whole = _Group(order, head.size[order], head.time[order], head.payload[order])
    ids = head.id[order]
    first = np.flatnonzero(np.diff(ids, prepend=-1)).tolist()
    bounds = zip(first, [*first[1:], ids.size], strict=True)
    return {int(ids[a]): whole.select(slice(a, b)) for a, b in bounds if ids[a]}


def _find_lives(
    records: Records, head: RecordHeaders, *, before: int
) -> tuple[_Lives, _Stop | None]:
    """The lives of the entries, by the control records up to the first malformed one."""
    lives: _Lives = {}
    for index in np.flatnonzero(head.id[:before] == 0).tolist():
        begin = int(head.payload[index])
        control = parse_control_record(
            bytes(records.file.content[begin : begin + int(head.size[index])])
        )
        if control is None:
            return lives, _Stop(index, "a control record that makes no sense")
        known = lives.setdefault(control.id, [])
        current = known[-1] if known and known[-1].last == before else None
        if current and isinstance(control, Metadata):
            current.metadata = control.metadata
        elif current:
            current.last = index
        if isinstance(control, Start):
            known.append(_EntryLife(control, control.metadata, index, before))
    return lives, None


def _find_misfits(number: int, group: _Group, lives: Sequence[_EntryLife]) -> Iterator[_Stop]:
    """The first record of an id without an entry, and the first with a wrong size for its type.

    Records before a start, or between a finish and the next start, are ignored, as in WPILib's
    tools.
    """
    if not lives:
        yield _Stop(int(group.index[0]), f"a record of the unknown entry {number}")
    for life in lives:
        if life.start.type in SIZES:
            part = group.select_life(life)
            wrong = part.size != SIZES[life.start.type]
            if wrong.any():
                at = int(wrong.argmax())
                what = f"a {life.start.type} of {part.size[at]} bytes"
                yield _Stop(int(part.index[at]), what)


def _join_lives(lives: _Lives, groups: Mapping[int, _Group], file: File) -> Iterator[FileEntry]:
    """One entry for all lives with the same name and type, in the order of appearance."""
    named: dict[tuple[str, str], list[_EntryLife]] = {}
    for life in sorted(chain.from_iterable(lives.values()), key=lambda life: life.first):
        named.setdefault((life.start.name, life.start.type), []).append(life)
    none = np.zeros(0, dtype=np.int64)
    for (name, kind), several in named.items():
        parts = [
            groups[life.start.id].select_life(life) for life in several if life.start.id in groups
        ] or [_Group(none, none, none, none)]
        whole = parts[0] if len(parts) == 1 else _concatenate_groups(parts)
        if (whole.time[1:] < whole.time[:-1]).any():
            whole = whole.select(np.argsort(whole.time, kind="stable"))
        metadata = next((life.metadata for life in reversed(several) if life.metadata), "")
        yield FileEntry(name, kind, metadata, whole.time, whole.payload, whole.size, file)


def _concatenate_groups(parts: Sequence[_Group]) -> _Group:
    """Several groups as one."""
    columns = ("index", "size", "time", "payload")
    return _Group(*(np.concatenate([getattr(part, one) for part in parts]) for one in columns))


def _damage(records: Records, lives: _Lives, stop: _Stop | None) -> FileDamage | None:
    """Why the rest of the file was not read; None if all was read."""
    offset = int(records.start[stop.index]) if stop else records.end
    unread_bytes = records.size - offset
    if not unread_bytes:
        return None
    if records.has_only_zeros_from(offset):
        return FileDamage(offset, unread_bytes, "nothing but zero bytes", torn=True)
    if stop:
        return FileDamage(offset, unread_bytes, stop.what, torn=False)
    return _overrun(records, lives, offset, unread_bytes)


def _overrun(records: Records, lives: _Lives, offset: int, unread_bytes: int) -> FileDamage:
    """The damage by a record that is longer than the rest of the file: cut off, or invalid."""
    head = records.read_header_at(offset)
    number, size = int(head.id[0]), int(head.size[0])
    if int(head.payload[0]) > records.size:
        return FileDamage(offset, unread_bytes, "a record that stops within its header", torn=True)
    open_now = [life for life in lives.get(number, ()) if life.last == records.start.size]
    sizes = [SIZES.get(life.start.type) for life in open_now] or [None] * (number == 0)
    torn = any(size == fixed if fixed else size <= LIKELY_SIZE for fixed in sizes)
    return FileDamage(offset, unread_bytes, f"a record that claims {size} bytes", torn=torn)
