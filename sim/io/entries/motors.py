"""Find the entries with the signals of each motor of a mechanism.

    <signal>-<motor>-<mechanism>       voltage, position, velocity; optionally current

Names of motors and mechanisms may contain dashes themselves: only the mechanism's state entry tells
where to split.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, MissingSignal
from sim.io.entries.discovery import (
    MotorGroup,
    find_devices,
    group_by_tests,
    identify_signal,
    select_driven_devices,
)
from sim.io.entries.entry import (
    NEEDED,
    NUMBERS,
    OPTIONAL,
    Entry,
    MotorEntries,
    can_be_fitted,
    find_missing_motion,
)
from sim.io.entries.names import (
    explain_unfit_entry,
    find_requested_entry,
    number_names,
    quote_names,
    split_name,
    split_words,
)
from sim.io.entries.state import WORD, RunInterval, StateEntry
from sim.io.entries.units import find_unit_text
from sim.io.format import ReadOptions, warn_of_missing_signal

WHOLE = "int64"  # type of an entry that counts, or that holds flags
FEW = 10  # [values] fewer whole numbers, without a unit, are no voltage
FLAGS = "--voltage ENTRY --position ENTRY --velocity ENTRY"
EXPORT = (
    "Are the signals only in the log of CTRE's or REV's logger? Then first export it as WPILOG, "
    "with Tuner X or AdvantageScope."
)
CALLS = {
    "voltage": "voltage(...)",
    "position": "angularPosition(...) or linearPosition(...), in Python position(...)",
    "velocity": "angularVelocity(...) or linearVelocity(...), in Python velocity(...)",
}


@dataclass(frozen=True, eq=False)
class _Search:
    """The arguments of a search for signals."""

    entries: Sequence[Entry]
    state: StateEntry
    options: ReadOptions
    where: str

    @cached_property
    def rivals(self) -> tuple[str, ...]:
        """Other mechanisms whose names end with a dash and this mechanism's name."""
        named = {name.rest for one in self.entries if (name := split_name(one.name, WORD))}
        return tuple(name for name in named if name.endswith(f"-{self.state.mechanism}"))

    @cached_property
    def given(self) -> dict[str, Entry]:
        """The signals whose entries the user named.

        Raises:
            MissingSignal: an entry is not there, or what was named as the voltage counts something.
        """
        given = {
            signal: find_requested_entry(
                name, role=signal, kinds=NUMBERS, entries=self.entries, where=self.where
            )
            for signal, name in self.options.entries.items()
            if signal in NEEDED + OPTIONAL
        }
        if (voltage := given.get("voltage")) and voltage.type == WHOLE:
            values = np.unique(voltage.numbers())
            if values.size < FEW and not find_unit_text(voltage, "voltage"):
                only = ", ".join(f"{value:.0f}" for value in values)
                raise MissingSignal(
                    f"{voltage.name!r} cannot be a voltage: it holds only the whole numbers {only}",
                    where=self.where,
                    advice="Choose the entry with the voltage at the motor.",
                )
        return given


def find_motors(
    state: StateEntry,
    entries: Sequence[Entry],
    tests: Sequence[RunInterval],
    *,
    options: ReadOptions,
    where: str,
) -> tuple[tuple[MotorEntries, ...], tuple[Doubt, ...], tuple[RunInterval, ...]]:
    """The motors of a mechanism that can be fitted; those with all signals, if there are any.

    Args:
        state: the entry that names its tests.
        entries: all entries of the file.
        tests: the times of its tests.
        options: the user's choices of motor and entries.
        where: the file, for messages.

    Returns:
        At least one motor, doubts about missing signals, and the tests in which they are driven.

    Raises:
        MissingSignal: no motor can be fitted; the message names what is missing.
        BadRequest: the chosen motor is not there, or a name is ambiguous.
    """
    search = _Search(entries, state, options, where)
    by_hand = MotorEntries(options.motor or "", search.given)
    if by_hand.is_complete:
        return _drop_velocity([by_hand], search), (), tuple(tests)
    found = _find_named_motors(search)
    noted: tuple[Doubt, ...] = ()
    if not search.given and not any(can_be_fitted(motor.signals) for motor in found):
        other, tests = _discover_motors(search, tests)
        found, noted = other or found, (_doubt_found_signals(other, where),) if other else ()
    if options.motor is not None:
        found = [_choose_motor(found, search)]
    usable = [motor for motor in (*found, by_hand) if can_be_fitted(motor.signals)]
    if not usable:
        raise _make_missing_error(found, search)
    missing = min(find_missing_motion(motor.signals) or "" for motor in usable)
    chosen = [one for one in usable if (find_missing_motion(one.signals) or "") == missing]
    others = [one for one in found if one not in chosen]
    noted += warn_of_missing_signal(missing or None, options, where=where)
    noted += tuple(_doubt_incomplete_motors(others, where))
    return _drop_velocity(chosen, search), noted, tuple(tests)


def _discover_motors(
    search: _Search, tests: Sequence[RunInterval]
) -> tuple[list[MotorEntries], Sequence[RunInterval]]:
    """The motors without SysId's names, and the tests in which they are driven.

    Raises:
        BadRequest: several mechanisms are driven one after another, and none was chosen.
    """
    driven = select_driven_devices(find_devices(search.entries), tests)
    words = set(split_words(search.state.mechanism))
    some = [one for one in driven if words & set(split_words(one.name))] or driven
    if search.options.motor is None and some:
        groups = group_by_tests(some, tests)
        some, tests = groups[0] if len(groups) == 1 else _choose_group(groups, search)
    return some, tests


def _choose_group(groups: Sequence[MotorGroup], search: _Search) -> MotorGroup:
    """The mechanism with the chosen number.

    Raises:
        BadRequest: there is none with this number.
    """
    pick = search.options.pick
    if pick is not None and 1 <= pick <= len(groups):
        return groups[pick - 1]
    names = [" and ".join(one.name for one in devices) for devices, _ in groups]
    raise BadRequest(
        f"its tests drive several mechanisms, one after another: {number_names(names)}",
        where=search.where,
        advice=Action("option", "by its number, such as --pick 1"),
    )


def _drop_velocity(motors: Sequence[MotorEntries], search: _Search) -> tuple[MotorEntries, ...]:
    """The motors; without their velocity, if the user wants it ignored and there is a position."""
    if not search.options.ignore_velocity:
        return tuple(motors)
    return tuple(
        MotorEntries(
            one.name,
            {
                signal: entry
                for signal, entry in one.signals.items()
                if signal != "velocity" or "position" not in one.signals
            },
        )
        for one in motors
    )


def _doubt_found_signals(motors: Sequence[MotorEntries], where: str) -> Doubt:
    """The doubt that names the entries found without SysId's names."""
    first = motors[0].signals
    names = ", ".join(
        f"{signal} from {first[signal].name!r}" for signal in NEEDED if signal in first
    )
    more = f", and the like of {len(motors) - 1} more" if len(motors) > 1 else ""
    return Doubt(
        "signals-found",
        f"{where}: the log does not use SysId's names, so signals were chosen by name, unit and "
        f"motion: {names}{more}.",
        action=Action("chosen-entries"),
    )


def _find_named_motors(search: _Search) -> list[MotorEntries]:
    """The motors of the mechanism, with the usable entry of each of their signals.

    Raises:
        BadRequest: several entries could be the same signal.
    """
    same: dict[tuple[str, str], dict[str, list[Entry]]] = {}
    for signal in NEEDED + OPTIONAL:
        for entry in search.entries:
            split = _split_signal_name(entry.name, signal, search)
            if split and entry.type in NUMBERS and len(entry):
                path, motor = split
                same.setdefault((motor, signal), {}).setdefault(path, []).append(entry)
    same_path = {motor for (motor, _), paths in same.items() if search.state.path in paths}
    motors: dict[str, dict[str, Entry]] = {}
    for (motor, signal), paths in same.items():
        if same_path and motor not in same_path:
            continue  # if some motors are logged under the path of the state, others are not motors
        path = search.state.path if search.state.path in paths else next(iter(paths))
        if len(paths) > 1 and path != search.state.path:
            names = [entry.name for several in paths.values() for entry in several]
            raise BadRequest(
                f"several entries could be the {signal}: {quote_names(names)}",
                where=search.where,
                advice=Action("option", f"with --{signal} ENTRY"),
            )
        usable = sorted(paths[path], key=lambda entry: NUMBERS.index(entry.type))
        motors.setdefault(motor, {})[signal] = usable[0]
    return [MotorEntries(name, signals | search.given) for name, signals in motors.items()]


def _split_signal_name(name: str, signal: str, search: _Search) -> tuple[str, str] | None:
    """Path and motor of an entry; None if its name is not that of this signal and mechanism."""
    parts = split_name(name, signal)
    if parts is None or any(parts.rest.endswith(f"-{rival}") for rival in search.rivals):
        return None
    if not search.state.mechanism:
        return parts.path, parts.rest
    motor = parts.rest.removesuffix(f"-{search.state.mechanism}")
    return None if motor == parts.rest else (parts.path, motor)


def _choose_motor(found: Sequence[MotorEntries], search: _Search) -> MotorEntries:
    """The chosen motor, by its name or by a unique ending of it.

    Raises:
        BadRequest: no motor matches, or several do.
    """
    wanted = (search.options.motor or "").lower()
    same = [motor for motor in found if motor.name.lower() == wanted]
    same = same or [motor for motor in found if motor.name.lower().endswith(wanted)]
    if len(same) == 1:
        return same[0]
    name, mechanism = search.options.motor, search.state.mechanism or search.state.entry.name
    names = [motor.name for motor in same or found]
    raise BadRequest(
        f"{name!r} matches several motors of {mechanism!r}"
        if same
        else f"{mechanism!r} has no motor {name!r}",
        where=search.where,
        advice=f"Choose one with --motor: {', '.join(names)}." if names else f"Name {FLAGS}.",
    )


def _doubt_incomplete_motors(others: Sequence[MotorEntries], where: str) -> Iterator[Doubt]:
    for motor in others:
        lacking = [signal for signal in NEEDED if signal not in motor.signals]
        yield Doubt(
            "incomplete-motor",
            f"{where}: motor {motor.name!r} has no {' and no '.join(lacking)} and was "
            "left out. Log all three signals of every motor that should count.",
        )


def _make_missing_error(found: Sequence[MotorEntries], search: _Search) -> MissingSignal:
    """The error that no motor has all signals: what is missing, and similar entries."""
    none = MotorEntries("", search.given)
    if not (search.given or found or split_name(search.state.entry.name, WORD)):
        return make_no_motor_error(
            search.entries, where=search.where, mechanism=search.state.mechanism
        )
    motor = max(found, key=lambda one: len(one.signals), default=none)
    lacking = [signal for signal in NEEDED if signal not in motor.signals]
    signal = lacking[0]
    mechanism = search.state.mechanism or "<mechanism>"
    name = f"{signal}-{motor.name or '<motor>'}-{mechanism}"
    details = [f"no {signal} entry"]
    if len(lacking) > 1:
        details.append(f"{' and '.join(lacking[1:])} missing too")
    details += [
        f"{entry.name!r} {explain_unfit_entry(entry, kinds=NUMBERS)}"
        for entry in search.entries
        if _split_signal_name(entry.name, signal, search)
    ]
    near = _find_similar_names(signal, search.entries, search.state.mechanism)
    if near:
        details.append(f"entries with similar names: {quote_names(near)}")
    return MissingSignal(
        "; ".join(details),
        where=search.where,
        advice=Action(
            "name-entries",
            before=f"{_advise_logging(signal)}. It writes {name!r} (double). {EXPORT}",
        ),
    )


def make_no_motor_error(
    entries: Sequence[Entry], *, where: str, mechanism: str = ""
) -> MissingSignal:
    """The error for a log in which no device was recorded completely.

    Args:
        entries: all entries of the file.
        where: the file, for messages.
        mechanism: name of the mechanism, if known; entries with it are listed first.
    """
    devices = find_devices(entries)
    lacking = [s for s in NEEDED if not any(s in device.signals for device in devices)]
    what = (
        f"no {' or '.join(filter(None, (', '.join(lacking[:-1]), lacking[-1])))} changes"
        if lacking
        else "no motor has a voltage, a position and a velocity that all change"
    )
    near = [name for signal in NEEDED for name in _find_similar_names(signal, entries, mechanism)]
    details = (
        f". Entries with similar names: {quote_names(list(dict.fromkeys(near)))}" if near else ""
    )
    arrays = [
        one.name
        for one in entries
        if one.type.endswith("[]") and identify_signal(one.name, one.metadata)
    ]
    details += f". Arrays cannot be used: {quote_names(arrays)}" if arrays else ""
    return MissingSignal(
        f"{what} during the tests. Each motor needs three entries: voltage, position and "
        f"velocity{details}",
        where=where,
        advice=Action("name-entries", before=f"Log all three of each motor. {EXPORT}"),
    )


def _advise_logging(signal: str) -> str:
    what = "the applied voltage" if signal == "voltage" else f"the {signal}"
    return f"Log {what} in the routine's log callback: call log.motor(NAME).{CALLS[signal]}"


def _find_similar_names(signal: str, entries: Sequence[Entry], mechanism: str) -> list[str]:
    """Names of entries that are similar to signals; those of this mechanism and signal first."""

    def rank_entry(entry: Entry) -> tuple[bool, bool, int]:
        name = entry.name.lower()
        return mechanism.lower() not in name, signal[:4] not in name, -len(entry)

    words = [word[:4] for word in NEEDED]  # "volt" is enough
    similar = [
        entry
        for entry in entries
        if entry.type in NUMBERS and any(word in entry.name.lower() for word in words)
    ]
    return [entry.name for entry in sorted(similar, key=rank_entry)]
