"""WPILOG: WPILib's log format, with the entries that SysIdRoutine adds.

Bytes are parsed into records (``records``), records into entries (``contents``), and
entries into a Log (``sim/io/entries``).
"""

from collections.abc import Collection, Iterator
from functools import partial
from pathlib import Path

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import MissingSignal, UnreadableFile
from sim.core.log import Log
from sim.io.entries import assemble_logs
from sim.io.entries.discovery import may_be_signal
from sim.io.entries.entry import NUMBERS, STRING, Entry
from sim.io.entries.state import NO_END, RunInterval
from sim.io.format import ReadOptions
from sim.io.formats.wpilog.contents import FileDamage, read_contents
from sim.io.formats.wpilog.control import Start
from sim.io.formats.wpilog.records import MAGIC, XZ_MAGIC
from sim.io.formats.wpilog.writing import write

__all__ = ["SUFFIXES", "entries", "read", "recognizes", "write"]

SUFFIXES = (".wpilog", ".wpilogxz")


def recognizes(head: bytes) -> bool:
    """Whether a file that starts with ``head`` is a WPILOG file, or compressed with xz."""
    return head.startswith((MAGIC, XZ_MAGIC))


def entries(path: Path) -> list[Entry]:
    """All entries of a file.

    Raises:
        UnreadableFile: the file is empty, or not a WPILOG file.
    """
    return read_contents(path).list_entries()


def read(path: Path, options: ReadOptions) -> dict[str, Log]:
    """Read the runs of one mechanism, or of each of its motors, from a WPILOG file.

    Args:
        path: the file.
        options: the user's choices: units, motor, and the names of entries.

    Raises:
        UnreadableFile: the file is empty, not a WPILOG file, or damaged before the end of the first
            run.
        MissingSignal: an entry is missing; the message names it and similar ones.
        BadRequest: the file lacks the chosen motor or mechanism, or holds several mechanisms.
        BadSample: the file holds a number that cannot be a measurement.
    """
    where = str(path)
    named = set(options.entries.values())
    found = read_contents(path, partial(_may_be_needed, named=named))
    damage, every = found.damage, found.list_entries()
    if not every:
        raise _make_unreadable_error(damage, found.end, where, "there is no record before it")
    try:
        with np.errstate(all="ignore"):  # values that are not finite are refused later
            logs, spans = assemble_logs(every, options=options, where=where)
    except MissingSignal as missing:
        if damage is None:
            raise
        raise _make_unreadable_error(damage, found.end, where, missing.what) from None
    if damage and not damage.torn and spans[0].end == NO_END:
        raise _make_unreadable_error(damage, found.end, where, "no run is whole before it")
    doubts = [*_doubt_records_before_start(found.orphans, where)]
    doubts += [_doubt_damage(damage, where)] if damage else _doubt_unfinished_run(spans[-1], where)
    return {name: log.add_doubts(*doubts) for name, log in logs.items()}


def _may_be_needed(entry: Start, *, named: Collection[str]) -> bool:
    """Whether to read the values of an entry: signals, and all texts, which may name tests."""
    if entry.name in named or entry.type == STRING:
        return True
    return entry.type in NUMBERS and may_be_signal(entry.name, entry.metadata)


def _make_unreadable_error(
    damage: FileDamage | None, end: int, where: str, what: str
) -> UnreadableFile:
    """The error that a file is damaged or cut off too early, or empty."""
    if damage is None:
        return UnreadableFile(
            "there are no records in it",
            where=f"{where}, byte {end}",
            advice="Run the tests with the robot enabled, and use the log of these tests.",
        )
    how = "the file is cut off" if damage.torn else "the file is damaged"
    return UnreadableFile(
        f"{how} ({damage.what}), and {what}",
        where=f"{where}, byte {damage.offset}",
        advice="Copy it from the robot again. If that does not help, record the tests again.",
    )


def _doubt_records_before_start(count: int, where: str) -> Iterator[Doubt]:
    """A doubt about records before the start of their entry."""
    if count:
        yield Doubt(
            "orphan-records",
            f"{where}: {count} records come before the record that starts their entry and were "
            "left out, as in a file that continues another file.",
        )


def _doubt_damage(damage: FileDamage, where: str) -> Doubt:
    """The doubt about a file that could only be read up to some offset."""
    what = "the file ends too soon" if damage.torn else "THE FILE IS DAMAGED"
    return Doubt(
        "truncated" if damage.torn else "damaged",
        f"{where}: {what}: {damage.what} at byte {damage.offset}. The {damage.unread_bytes} bytes "
        "after that were not read. Copy the file from the robot again, or check that no run is "
        "missing.",
    )


def _doubt_unfinished_run(last: RunInterval, where: str) -> Iterator[Doubt]:
    """A doubt if the last run has no end."""
    if last.end == NO_END:
        yield Doubt(
            "unfinished-run",
            f"{where}: the file ends while {last.test} is running, so the end of that run is "
            "missing. End each test before you close the log.",
        )
