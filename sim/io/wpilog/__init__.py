"""WPILOG: the log a robot writes itself, with the entries SysIdRoutine adds to it.

Bytes become records (``records``), records entries (``contents``), and of the entries those that
SysId's loggers name, or a person does, become a Log: ``state`` finds the tests, ``motors`` the
signals, ``units`` what they are measured in, ``clock`` one time base, ``runs`` the rest.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np

from sim.data.doubt import Doubt
from sim.data.errors import BadRequest, MissingSignal, Refusal, UnreadableFile
from sim.data.log import Log
from sim.data.units import UNITS
from sim.io.format import ReadOptions
from sim.io.wpilog.contents import FileDamage, contents_of
from sim.io.wpilog.discovery import driven_interval, find_devices, test_in_name
from sim.io.wpilog.entry import Entry
from sim.io.wpilog.motors import motors_of
from sim.io.wpilog.names import quote_names, type_said
from sim.io.wpilog.records import MAGIC, load_records
from sim.io.wpilog.runs import cut_runs
from sim.io.wpilog.state import FOREVER, RunInterval, StateEntry, run_intervals, state_entries
from sim.io.wpilog.writing import write

__all__ = ["SUFFIXES", "knows", "read", "write"]

SUFFIXES = (".wpilog",)


def knows(head: bytes) -> bool:
    """Whether a file that starts like this is a WPILOG file."""
    return head.startswith(MAGIC)


def read(path: Path, asked: ReadOptions) -> Log:
    """Read the runs of one mechanism from a WPILOG file.

    Args:
        path: the file.
        asked: what its reader knows: units, motor, and the names of entries.

    Raises:
        UnreadableFile: it is foreign, empty, or damaged before the end of the first run.
        MissingSignal: an entry is missing; the message names it and what there is instead.
        BadRequest: what was asked for is not in it, or it holds several mechanisms.
        BadSample: it holds a number that cannot be a measurement.
    """
    where = str(path)
    records = load_records(path)
    found = contents_of(records)
    damage = found.damage
    lost = tuple(_orphaned(found.orphans, where))
    if not found.entries:
        raise _unreadable(damage, records.end, where, "there is no record before it")
    try:
        with np.errstate(all="ignore"):  # what is not finite is refused where a run is made of it
            log, spans = _log(found.entries, asked=asked, where=where)
    except MissingSignal as missing:
        if damage is None:
            raise
        raise _unreadable(damage, records.end, where, missing.what) from None
    if damage is None:
        return log.with_doubts(*lost, *_unfinished(spans[-1], where))
    if not damage.torn and spans[0].end == FOREVER:
        raise _unreadable(damage, records.end, where, "no run is whole before it")
    return log.with_doubts(*lost, _partly(damage, where))


def _log(
    entries: Sequence[Entry], *, asked: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of one mechanism, and the times of its runs."""
    state = _state(entries, asked=asked, where=where)
    if asked.type is None:
        return _typed(entries, state, asked=asked, where=where)
    return _of(state, entries, asked=asked, where=where)


def _typed(
    entries: Sequence[Entry], state: StateEntry, *, asked: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of a mechanism whose type nobody said; its name may."""
    said = type_said(state.mechanism)
    log, spans = _of(state, entries, asked=replace(asked, type=said or None), where=where)
    if said == "arm" and not UNITS[log.units].angular:  # what moves in meters is no arm
        log = replace(log, type="")
    return log, spans


def _of(
    state: StateEntry, entries: Sequence[Entry], *, asked: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of one mechanism, as the tests that are named for it tell it."""
    found, strange = run_intervals(state, where=where)
    motors, doubts = motors_of(state, entries, found, asked=asked, where=where)
    result = cut_runs(motors, found, asked=asked, where=where)
    if not result.runs:
        names = quote_names([entry.name for entry in motors[0].signals.values()])
        raise MissingSignal(
            f"no run holds two samples of {names} while {state.entry.name!r} names its test",
            where=where,
            advice="Log the signals in the routine's own log callback, and run the tests again.",
        )
    log = Log(
        result.runs,
        units=result.units,
        mechanism=state.mechanism,
        type=asked.type or "",
        source=where,
        doubts=(*doubts, *strange, *result.doubts),
    )
    return log, found


def _state(entries: Sequence[Entry], *, asked: ReadOptions, where: str) -> StateEntry:
    """Where the tests are named of the one mechanism that is to be read.

    Raises:
        BadRequest: there are several, and what was asked for does not tell which.
    """
    try:
        found = state_entries(entries, asked=asked, where=where)
    except MissingSignal:
        named = None if asked.entries else _state_of_file_name(Path(where), entries)
        if named is None:
            raise
        return named
    if len(found) > 1 and asked.motor is not None:
        having = tuple(state for state in found if _has_motor(state, entries, asked))
        found = having if len(having) == 1 else found
    if len(found) == 1:
        return found[0]
    names = [state.mechanism for state in found]
    raise BadRequest(
        f"tests of several mechanisms are in it: {quote_names(names)}",
        where=where,
        advice=f"Say which with --state {found[0].entry.name}, and record one routine per log.",
    )


def _state_of_file_name(path: Path, entries: Sequence[Entry]) -> StateEntry | None:
    """The one test of a file whose name tells it: the longest time that something is driven."""
    test = test_in_name(path.stem)
    devices = find_devices(entries)
    interval = driven_interval(test, devices) if test else None
    if interval is None:
        return None
    entry = next(one.signals["voltage"] for one in devices if one.whole)
    return StateEntry("", "", entry, (interval,))


def _has_motor(state: StateEntry, entries: Sequence[Entry], asked: ReadOptions) -> bool:
    """Whether a mechanism has the motor that is asked for."""
    with suppress(Refusal):
        tests, _ = run_intervals(state, where="")
        return bool(motors_of(state, entries, tests, asked=asked, where=""))
    return False


def _unreadable(damage: FileDamage | None, end: int, where: str, what: str) -> UnreadableFile:
    """The refusal of a file in which too little precedes the place where it stops."""
    if damage is None:
        return UnreadableFile(
            "there are no records in it",
            where=f"{where}, byte {end}",
            advice="Run the tests with the robot enabled, and give the log of that.",
        )
    how = "the file is cut off" if damage.torn else "the file is damaged"
    return UnreadableFile(
        f"{how} ({damage.what}), and {what}",
        where=f"{where}, byte {damage.offset}",
        advice="Copy it from the robot again; if it is the same there, record the tests again.",
    )


def _orphaned(count: int, where: str) -> Iterator[Doubt]:
    """A doubt about records that nothing introduces."""
    if count:
        yield Doubt(
            "orphan-records",
            f"{where}: {count} records come before the record that starts their entry and were "
            "left out, as in a file that goes on where another one ended.",
        )


def _partly(damage: FileDamage, where: str) -> Doubt:
    """The doubt about a file that could only be read up to some place."""
    what = "the file ends too soon" if damage.torn else "THE FILE IS DAMAGED"
    return Doubt(
        "truncated" if damage.torn else "damaged",
        f"{where}: {what}: {damage.what} at byte {damage.offset}. The {damage.left} bytes from "
        "there on were left out. Copy the file from the robot again, or check that no run is "
        "missing.",
    )


def _unfinished(last: RunInterval, where: str) -> Iterator[Doubt]:
    """A doubt if the last run has no end."""
    if last.end == FOREVER:
        yield Doubt(
            "unfinished-run",
            f"{where}: the file ends while {last.test} is running, so the end of that run is "
            "missing. Let each test end before the log is closed.",
        )
