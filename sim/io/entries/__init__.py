"""From the entries of a robot's log to the runs of one mechanism.

Of the entries those that SysId's loggers name, or a person does, or that ``discovery`` finds become
a Log: ``state`` finds the tests, ``motors`` the signals, ``units`` what they are measured in,
``clock`` one time base, ``runs`` the rest.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from sim.core.errors import BadRequest, MissingSignal, Refusal
from sim.core.log import Log
from sim.core.units import UNITS
from sim.io.entries.discovery import find_devices, find_driven_interval, find_test_in_name
from sim.io.entries.entry import Entry
from sim.io.entries.motors import find_motors
from sim.io.entries.names import find_type_in_name, quote_names
from sim.io.entries.runs import cut_runs
from sim.io.entries.state import RunInterval, StateEntry, find_run_intervals, find_state_entries
from sim.io.format import ReadOptions


def assemble_log(
    entries: Sequence[Entry], *, asked: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of one mechanism, and the times of its runs.

    Args:
        entries: of the whole log.
        asked: what its reader knows: units, type, motor, and the names of entries.
        where: the file, for messages.

    Raises:
        MissingSignal: an entry is missing; the message names it and what there is instead.
        BadRequest: what was asked for is not in it, or it holds several mechanisms.
        BadSample: it holds a number that cannot be a measurement.
    """
    state = _state(entries, asked=asked, where=where)
    if asked.type is None:
        return _set_type(entries, state, asked=asked, where=where)
    return _assemble_mechanism(state, entries, asked=asked, where=where)


def _set_type(
    entries: Sequence[Entry], state: StateEntry, *, asked: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of a mechanism whose type nobody said; its name may."""
    said = find_type_in_name(state.mechanism)
    log, spans = _assemble_mechanism(
        state, entries, asked=replace(asked, type=said or None), where=where
    )
    if said == "arm" and not UNITS[log.units].angular:  # what moves in meters is no arm
        log = replace(log, type="")
    return log, spans


def _assemble_mechanism(
    state: StateEntry, entries: Sequence[Entry], *, asked: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of one mechanism, as the tests that are named for it tell it."""
    found, strange = find_run_intervals(state, where=where)
    motors, doubts = find_motors(state, entries, found, asked=asked, where=where)
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
        found = find_state_entries(entries, asked=asked, where=where)
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
    test = find_test_in_name(path.stem)
    devices = find_devices(entries)
    interval = find_driven_interval(test, devices) if test else None
    if interval is None:
        return None
    entry = next(one.signals["voltage"] for one in devices if one.is_complete)
    return StateEntry("", "", entry, (interval,))


def _has_motor(state: StateEntry, entries: Sequence[Entry], asked: ReadOptions) -> bool:
    """Whether a mechanism has the motor that is asked for."""
    with suppress(Refusal):
        tests, _ = find_run_intervals(state, where="")
        return bool(find_motors(state, entries, tests, asked=asked, where=""))
    return False
