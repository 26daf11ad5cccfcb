"""From the entries of a robot's log to the runs of one mechanism.

Of the entries those that SysId's loggers name, or a person does, or that ``discovery`` finds become
a Log: ``state`` finds the tests, ``motors`` the signals, ``units`` what they are measured in,
``clock`` one time base, ``runs`` the rest.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, MissingSignal, Refusal
from sim.core.log import Log
from sim.core.units import UNITS
from sim.io.entries.discovery import find_devices, find_driven_interval
from sim.io.entries.entry import Entry
from sim.io.entries.mirrored import turn_mirrored_motors
from sim.io.entries.motors import EXPORT, MotorEntries, find_motors, make_no_motor_error
from sim.io.entries.names import (
    find_test_name,
    find_type_in_name,
    number_names,
    quote_names,
    split_name,
)
from sim.io.entries.runs import cut_runs
from sim.io.entries.state import (
    WORD,
    RunInterval,
    StateEntry,
    find_run_intervals,
    find_state_entries,
)
from sim.io.format import ReadOptions, refuse_pick


def assemble_log(
    entries: Sequence[Entry], *, options: ReadOptions, where: str
) -> tuple[Log, tuple[RunInterval, ...]]:
    """The log of one mechanism, several motors as their mean, and the times of its runs.

    Args:
        entries: of the whole log.
        options: the user's choices: units, type, motor, and the names of entries.
        where: the file, for messages.

    Raises:
        MissingSignal: an entry is missing; the message names it and what there is instead.
        BadRequest: it lacks the chosen motor or mechanism, or holds several mechanisms.
        BadSample: it holds a number that cannot be a measurement.
    """
    found = _found(entries, options=options, where=where)
    return _log(found, found.motors, where=where), found.intervals


def assemble_motor_logs(
    entries: Sequence[Entry], *, options: ReadOptions, where: str
) -> tuple[dict[str, Log], tuple[RunInterval, ...]]:
    """The log of each motor of one mechanism by its name, and the times of the runs.

    A motor that is mounted the other way round is turned, so that all run alike.

    Args:
        entries: of the whole log.
        options: the user's choices: units, type, motor, and the names of entries.
        where: the file, for messages.

    Raises:
        MissingSignal, BadRequest, BadSample: as ``assemble_log``.
    """
    found = _found(entries, options=options, where=where)
    logs = {motor.name: _log(found, (motor,), where=where) for motor in found.motors}
    return turn_mirrored_motors(logs), found.intervals


@dataclass(frozen=True, eq=False)
class _Mechanism:
    """What was found of one mechanism.

    Args:
        state: where its tests are named.
        intervals: when they ran.
        motors: its motors.
        options: the user's choices, the type its name says included.
        type_by_name: whether only the name says the type.
        doubts: what was odd.
    """

    state: StateEntry
    intervals: tuple[RunInterval, ...]
    motors: tuple[MotorEntries, ...]
    options: ReadOptions
    type_by_name: bool
    doubts: tuple[Doubt, ...]


def _found(entries: Sequence[Entry], *, options: ReadOptions, where: str) -> _Mechanism:
    """The mechanism that is to be read: its tests and its motors."""
    state = _state(entries, options=options, where=where)
    by_name = options.type is None
    if by_name:
        options = replace(options, type=find_type_in_name(state.mechanism) or None)
    intervals, strange = find_run_intervals(state, where=where)
    if options.pick is not None and not _has_choice(entries, options=options, where=where):
        refuse_pick(options.pick, where=where)
    motors, doubts, intervals = find_motors(state, entries, intervals, options=options, where=where)
    return _Mechanism(state, intervals, motors, options, by_name, (*doubts, *strange))


def _has_choice(entries: Sequence[Entry], *, options: ReadOptions, where: str) -> bool:
    """Whether there are several mechanisms, of which a number chooses one."""
    unpicked = replace(options, pick=None)
    try:
        state = _state(entries, options=unpicked, where=where)
        intervals, _ = find_run_intervals(state, where=where)
        find_motors(state, entries, intervals, options=unpicked, where=where)
    except BadRequest:
        return True
    return False


def _log(found: _Mechanism, motors: tuple[MotorEntries, ...], *, where: str) -> Log:
    """The log of some motors of a mechanism, as the tests that are named for it tell it."""
    result = cut_runs(motors, found.intervals, options=found.options, where=where)
    if not result.runs:
        names = quote_names([entry.name for entry in motors[0].signals.values()])
        raise MissingSignal(
            f"no run holds two samples of {names} while {found.state.entry.name!r} names its test",
            where=where,
            advice="Log the signals in the routine's own log callback, and run the tests again.",
        )
    said = found.options.type or ""
    if found.type_by_name and said == "arm" and not UNITS[result.units].angular:
        said = ""  # what moves in meters is no arm
    return Log(
        result.runs,
        units=result.units,
        mechanism=found.state.mechanism,
        type=said,
        source=where,
        doubts=(*found.doubts, *result.doubts),
    )


def _state(entries: Sequence[Entry], *, options: ReadOptions, where: str) -> StateEntry:
    """Where the tests are named of the one mechanism that is to be read.

    Raises:
        BadRequest: there are several, and the options do not choose one.
    """
    try:
        found = find_state_entries(entries, options=options, where=where)
    except MissingSignal as missing:
        named = None if options.entries else _state_of_file_name(Path(where), entries)
        if named is not None:
            return named
        if options.entries or any(split_name(entry.name, WORD) for entry in entries):
            raise
        if any(device.is_complete for device in find_devices(entries)):
            raise
        lacking = make_no_motor_error(entries, where=where)
        raise MissingSignal(
            f"{missing.what}; {lacking.what}", where=where, advice=f"{missing.advice} {EXPORT}"
        ) from None
    if len(found) > 1 and options.motor is not None:
        having = tuple(state for state in found if _has_motor(state, entries, options))
        found = having if len(having) == 1 else found
    if len(found) == 1:
        return found[0]
    if options.pick is not None and 1 <= options.pick <= len(found):
        return found[options.pick - 1]
    names = [state.mechanism or state.entry.name for state in found]
    raise BadRequest(
        f"it contains the tests of several mechanisms: {number_names(names)}",
        where=where,
        advice="Choose one by its number, such as --pick 1, or by its name, such as --state "
        f"{found[0].entry.name}. Next time, record one routine per log.",
    )


def _state_of_file_name(path: Path, entries: Sequence[Entry]) -> StateEntry | None:
    """The one test of a file whose name tells it: the longest time that something is driven."""
    test = find_test_name(path.stem)
    devices = find_devices(entries)
    interval = find_driven_interval(test, devices) if test else None
    if interval is None:
        return None
    entry = next(one.signals["voltage"] for one in devices if one.is_complete)
    return StateEntry("", "", entry, (interval,))


def _has_motor(state: StateEntry, entries: Sequence[Entry], options: ReadOptions) -> bool:
    """Whether a mechanism has the chosen motor."""
    with suppress(Refusal):
        tests, _ = find_run_intervals(state, where="")
        return bool(find_motors(state, entries, tests, options=options, where=""))
    return False
