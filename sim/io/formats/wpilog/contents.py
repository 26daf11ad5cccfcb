"""What the records of a WPILOG file belong to: entries, up to the first record that cannot be.

An id is free for another entry once the first is finished, and an entry may come back under
another id: its samples are joined, in the order of their times.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TypeAlias

import numpy as np

from sim.io.formats.wpilog.control import Metadata, Start, parse_control_record
from sim.io.formats.wpilog.entry import SIZES, FileEntry
from sim.io.formats.wpilog.records import File, Numbers, RecordHeaders, Records

SMALL_IDS = 1 << 16  # ids below fit 16 bits, which NumPy sorts by radix
LIKELY_SIZE = 1 << 16  # [bytes] a text or an array that was being written is hardly larger


@dataclass(frozen=True)
class FileDamage:
    """The place and reason at which reading stopped before the end of the file.

    Args:
        offset: the first byte that was not used.
        unread_bytes: how many bytes there are from it to the end of the file.
        what: what is wrong with the record there, a clause.
        torn: whether the file merely ends too soon, as when a robot loses power.
    """

    offset: int
    unread_bytes: int
    what: str
    torn: bool


@dataclass(frozen=True, eq=False)
class Contents:
    """The entries of a file.

    Args:
        entries: in the order they first appear.
        damage: what kept the rest of the file from being read, if anything did.
        orphans: how many records precede the start of their entry, as in a file that goes on where
            another one ended.
    """

    entries: tuple[FileEntry, ...]
    damage: FileDamage | None
    orphans: int = 0


@dataclass(frozen=True, order=True)
class _Stop:
    """The first record that cannot be, and why."""

    index: int
    what: str


@dataclass
class _EntryLife:
    """An entry from the record that starts it to the one that ends it, by index."""

    start: Start
    metadata: str
    first: int
    last: int


@dataclass(frozen=True, eq=False)
class _Group:
    """The records that carry one id, in order: their indices, and what their headers say."""

    index: Numbers
    size: Numbers
    time: Numbers
    payload: Numbers

    def select_life(self, life: _EntryLife) -> "_Group":
        """Those of them that fall into one life."""
        if life.first < self.index[0] and self.index[-1] < life.last:
            return self
        first, last = self.index.searchsorted((life.first, life.last))
        return self.select(slice(first, last))

    def select(self, which: slice | Numbers) -> "_Group":
        """Some of them."""
        return _Group(self.index[which], self.size[which], self.time[which], self.payload[which])


_Lives: TypeAlias = dict[int, list[_EntryLife]]


def read_contents(records: Records) -> Contents:
    """Sort the records of a file into entries, up to the first record that cannot be."""
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
    """When each entry began and ended, by the control records up to the first senseless one."""
    lives: _Lives = {}
    for index in np.flatnonzero(head.id[:before] == 0).tolist():
        begin = int(head.payload[index])
        said = parse_control_record(
            bytes(records.file.content[begin : begin + int(head.size[index])])
        )
        if said is None:
            return lives, _Stop(index, "a control record that makes no sense")
        known = lives.setdefault(said.id, [])
        current = known[-1] if known and known[-1].last == before else None
        if current and isinstance(said, Metadata):
            current.metadata = said.metadata
        elif current:
            current.last = index
        if isinstance(said, Start):
            known.append(_EntryLife(said, said.metadata, index, before))
    return lives, None


def _find_misfits(number: int, group: _Group, lives: Sequence[_EntryLife]) -> Iterator[_Stop]:
    """The first record of an id that belongs to no entry, and any of a size its type cannot have.

    Records before a start, or between a finish and the next start, are passed over, as WPILib's own
    tools do.
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
    """One entry for all lives of the same name and type, in the order they first appear."""
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
    """What kept the rest of the file from being read, if anything did."""
    offset = int(records.start[stop.index]) if stop else records.end
    left = records.size - offset
    if not left:
        return None
    if records.has_only_zeros_from(offset):
        return FileDamage(offset, left, "nothing but zero bytes", torn=True)
    if stop:
        return FileDamage(offset, left, stop.what, torn=False)
    return _overrun(records, lives, offset, left)


def _overrun(records: Records, lives: _Lives, offset: int, left: int) -> FileDamage:
    """The record at ``offset`` says it is longer than the file: cut off, or nonsense."""
    head = records.read_header_at(offset)
    number, size = int(head.id[0]), int(head.size[0])
    if int(head.payload[0]) > records.size:
        return FileDamage(offset, left, "a record that stops within its header", torn=True)
    open_now = [life for life in lives.get(number, ()) if life.last == records.start.size]
    sizes = [SIZES.get(life.start.type) for life in open_now] or [None] * (number == 0)
    torn = any(size == fixed if fixed else size <= LIKELY_SIZE for fixed in sizes)
    return FileDamage(offset, left, f"a record that claims {size} bytes", torn=torn)
