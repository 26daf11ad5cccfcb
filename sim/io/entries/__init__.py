"""From the entries of a robot's log to the runs of one mechanism.

A Log is made of the entries with SysId's names, of those that the user names, or of those that
``discovery`` finds: ``state`` finds the tests, ``motors`` the signals, ``units`` their units,
``clock`` a common time base, and ``runs`` cuts the runs.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, MissingSignal, Refusal
from sim.core.log import Log
from sim.core.units import UNITS
from sim.io.entries.discovery import find_devices, find_driven_interval
from sim.io.entries.entry import Entry, MotorEntries, find_missing_motion
from sim.io.entries.mirrored import turn_mirrored_motors
from sim.io.entries.motors import EXPORT, find_motors, make_no_motor_error
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


def assemble_logs(
    entries: Sequence[Entry], *, options: ReadOptions, where: str
) -> tuple[dict[str, Log], tuple[RunInterval, ...]]:
    """The log of one mechanism, or of each of its motors by name, and the times of the runs.

    One log (``""``) has the mean of the motors. In logs of their own, the signs of a motor that is
    mounted the other way round are reversed.

    Args:
        entries: all entries of the file.
        options: the user's choices: units, type, motor, and the names of entries.
        where: the file, for messages.

    Raises:
        MissingSignal: an entry is missing; the message names it and similar ones.
        BadRequest: the file lacks the chosen motor or mechanism, or holds several mechanisms.
        BadSample: the file holds a number that cannot be a measurement.
    """
    found = _find_mechanism(entries, options=options, where=where)
    if not options.each_motor:
        return {"": _make_log(found, found.motors, where=where)}, found.intervals
    logs = {motor.name: _make_log(found, (motor,), where=where) for motor in found.motors}
    return turn_mirrored_motors(logs), found.intervals


@dataclass(frozen=True, eq=False)
class _Mechanism:
    """The entries of one mechanism.

    Args:
        state: the entry that names its tests.
        intervals: the times of its runs.
        motors: its motors.
        options: the user's choices, with the type from the mechanism's name if none was chosen.
        type_by_name: whether the type is from the mechanism's name.
        doubts: warnings about the entries.
    """

    state: StateEntry
    intervals: tuple[RunInterval, ...]
    motors: tuple[MotorEntries, ...]
    options: ReadOptions
    type_by_name: bool
    doubts: tuple[Doubt, ...]


def _find_mechanism(entries: Sequence[Entry], *, options: ReadOptions, where: str) -> _Mechanism:
    """The mechanism to read, with its tests and motors."""
    state = _find_state(entries, options=options, where=where)
    by_name = options.type is None
    if by_name:
        options = replace(options, type=find_type_in_name(state.mechanism) or None)
    intervals, strange = find_run_intervals(state, where=where)
    if options.pick is not None and not _has_choice(entries, options=options, where=where):
        refuse_pick(options.pick, where=where)
    motors, doubts, intervals = find_motors(state, entries, intervals, options=options, where=where)
    return _Mechanism(state, intervals, motors, options, by_name, (*doubts, *strange))


def _has_choice(entries: Sequence[Entry], *, options: ReadOptions, where: str) -> bool:
    """Whether there are several mechanisms to choose from by number."""
    unpicked = replace(options, pick=None)
    try:
        state = _find_state(entries, options=unpicked, where=where)
        intervals, _ = find_run_intervals(state, where=where)
        find_motors(state, entries, intervals, options=unpicked, where=where)
    except BadRequest:
        return True
    return False


def _make_log(found: _Mechanism, motors: tuple[MotorEntries, ...], *, where: str) -> Log:
    """The log of some motors of a mechanism.

    Raises:
        MissingSignal: no run has enough samples.
    """
    runs, units, doubts = cut_runs(motors, found.intervals, options=found.options, where=where)
    if not runs:
        names = quote_names([entry.name for entry in motors[0].signals.values()])
        raise MissingSignal(
            f"no run holds two samples of {names} while {found.state.entry.name!r} names its test",
            where=where,
            advice="Log the signals in the routine's own log callback, and run the tests again.",
        )
    type_ = found.options.type or ""
    if found.type_by_name and type_ == "arm" and not UNITS[units].angular:
        type_ = ""  # a mechanism that moves in meters is not an arm
    return Log(
        tuple(runs),
        units=units,
        mechanism=found.state.mechanism,
        type=type_,
        source=where,
        doubts=(*found.doubts, *doubts),
        computed=find_missing_motion(motors[0].signals) or "",
    )


def _find_state(entries: Sequence[Entry], *, options: ReadOptions, where: str) -> StateEntry:
    """The entry that names the tests of the mechanism to read.

    Raises:
        MissingSignal: no entry names tests.
        BadRequest: there are several mechanisms, and the options do not choose one.
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
        advice = (missing.action or Action("name-entries")).add_before(EXPORT)
        raise MissingSignal(f"{missing.what}; {lacking.what}", where=where, advice=advice) from None
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
        advice=Action(
            "option",
            f"by number, such as --pick 1, or by name, such as --state {found[0].entry.name}",
            before="Next time, record one routine per log.",
        ),
    )


def _state_of_file_name(path: Path, entries: Sequence[Entry]) -> StateEntry | None:
    """The one test of a file with the test in its name: the longest interval with a voltage."""
    test = find_test_name(path.stem)
    devices = find_devices(entries)
    interval = find_driven_interval(test, devices) if test else None
    if interval is None:
        return None
    entry = next(one.signals["voltage"] for one in devices if one.is_complete)
    return StateEntry("", "", entry, (interval,))


def _has_motor(state: StateEntry, entries: Sequence[Entry], options: ReadOptions) -> bool:
    """Whether the mechanism has the chosen motor."""
    with suppress(Refusal):
        tests, _ = find_run_intervals(state, where="")
        return bool(find_motors(state, entries, tests, options=options, where=""))
    return False
