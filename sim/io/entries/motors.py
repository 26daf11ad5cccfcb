"""The entries of a WPILOG file that hold a mechanism's signals, motor by motor.

    <signal>-<motor>-<mechanism>       voltage, position, velocity; current may join them

The name of a motor and that of a mechanism may both hold the dash that stands between them: only
the mechanism's state entry tells where to split.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, MissingSignal
from sim.io.entries.discovery import (
    DeviceGroup,
    find_devices,
    group_by_tests,
    identify_signal,
    select_driven_devices,
)
from sim.io.entries.entry import NEEDED, NUMBERS, OPTIONAL, Entry
from sim.io.entries.names import (
    explain_unfit_entry,
    find_requested_entry,
    number_names,
    quote_names,
    split_name,
    split_words,
)
from sim.io.entries.state import WORD, RunInterval, StateEntry
from sim.io.format import ReadOptions

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
class MotorEntries:
    """The entries of one motor's signals.

    Args:
        name: as in its entries; empty if they were named one by one.
        signals: ``voltage``, ``position``, … -> the entry that holds it.
    """

    name: str
    signals: Mapping[str, Entry]

    @property
    def is_complete(self) -> bool:
        """Whether it has all that a fit needs."""
        return all(signal in self.signals for signal in NEEDED)


@dataclass(frozen=True, eq=False)
class _Search:
    """What every search for signals needs to know."""

    entries: Sequence[Entry]
    state: StateEntry
    rivals: tuple[str, ...]  # mechanisms whose name is longer and ends the same
    asked: ReadOptions
    where: str


def find_motors(
    state: StateEntry,
    entries: Sequence[Entry],
    tests: Sequence[RunInterval],
    *,
    asked: ReadOptions,
    where: str,
) -> tuple[tuple[MotorEntries, ...], tuple[Doubt, ...], tuple[RunInterval, ...]]:
    """The motors of a mechanism whose signals are to be used, all of them whole.

    Args:
        state: where its tests are named.
        entries: all entries of the file.
        tests: when its tests ran.
        asked: which motor, and which entries, where a person has said so.
        where: the file, for messages.

    Returns:
        At least one motor, doubts about those left out, and the tests that drive them.

    Raises:
        MissingSignal: no motor has all signals; the message names what is missing.
        BadRequest: the motor asked for is not there, or a name is ambiguous.
    """
    named = {name.rest for entry in entries if (name := split_name(entry.name, WORD))}
    rivals = tuple(name for name in named if name.endswith(f"-{state.mechanism}"))
    search = _Search(entries, state, rivals, asked, where)
    given = {
        signal: find_requested_entry(name, role=signal, kinds=NUMBERS, entries=entries, where=where)
        for signal, name in asked.entries.items()
        if signal in NEEDED + OPTIONAL
    }
    if asked.ignore_velocity and "position" in given:
        given["velocity"] = given["position"]  # its slope is taken later
    if all(signal in given for signal in NEEDED):
        return (MotorEntries(asked.motor or "", given),), (), tuple(tests)
    found = [MotorEntries(name, signals | given) for name, signals in _by_motor(search).items()]
    if asked.ignore_velocity:
        found = [_without_velocity(motor) for motor in found]
    noted: tuple[Doubt, ...] = ()
    if not given and not any(motor.is_complete for motor in found):
        other, tests = _of_other_loggers(search, tests)
        found, noted = other or found, (_taken(other, where),) if other else ()
    if asked.motor is not None:
        found = [_chosen(found, search)]
    whole = tuple(motor for motor in found if motor.is_complete)
    if not (whole or given or found or split_name(state.entry.name, WORD)):
        raise no_motor(entries, where=where, mechanism=state.mechanism)
    if not whole:
        best = max(found, key=lambda motor: len(motor.signals), default=MotorEntries("", given))
        raise _missing(best, search)
    return whole, (*noted, *_left_out(found, where)), tuple(tests)


def _of_other_loggers(
    search: _Search, tests: Sequence[RunInterval]
) -> tuple[list[MotorEntries], Sequence[RunInterval]]:
    """The motors that another logger recorded, and the tests that drove them.

    Raises:
        BadRequest: the tests drove one mechanism after another, and none was chosen.
    """
    devices = find_devices(search.entries)
    if search.asked.ignore_velocity:
        devices = [one.without_velocity() for one in devices]
    driven = select_driven_devices(devices, tests)
    words = set(split_words(search.state.mechanism))
    some = [one for one in driven if words & set(split_words(one.name))] or driven
    if search.asked.motor is None and some:
        groups = group_by_tests(some, tests)
        some, tests = groups[0] if len(groups) == 1 else _picked(groups, search)
    return [MotorEntries(one.name, one.signals) for one in some], tests


def _picked(groups: Sequence[DeviceGroup], search: _Search) -> DeviceGroup:
    """The mechanism that a person chose."""
    pick = search.asked.pick
    if pick is not None and 1 <= pick <= len(groups):
        return groups[pick - 1]
    names = [" and ".join(one.name for one in devices) for devices, _ in groups]
    raise BadRequest(
        f"its tests drive several mechanisms, one after another: {number_names(names)}",
        where=search.where,
        advice="Choose one by its number, such as --pick 1.",
    )


def _without_velocity(motor: MotorEntries) -> MotorEntries:
    """A motor whose position stands where its velocity would, so that none is asked for."""
    if "position" not in motor.signals:
        return motor
    return MotorEntries(motor.name, {**motor.signals, "velocity": motor.signals["position"]})


def _taken(motors: Sequence[MotorEntries], where: str) -> Doubt:
    """What was taken for the signals of which motor."""
    first = motors[0].signals
    names = ", ".join(f"{signal} from {first[signal].name!r}" for signal in NEEDED)
    more = f", and the like of {len(motors) - 1} more" if len(motors) > 1 else ""
    return Doubt(
        "signals-found",
        f"{where}: the log does not use SysId's names, so signals were chosen by name, unit and "
        f"motion: {names}{more}. If that is wrong, name them with {FLAGS}.",
    )


def _by_motor(search: _Search) -> dict[str, dict[str, Entry]]:
    """For each motor of the mechanism the usable entry of each signal it has."""
    same: dict[tuple[str, str], dict[str, list[Entry]]] = {}
    for signal in NEEDED + OPTIONAL:
        for entry in search.entries:
            placed = _placed(entry.name, signal, search)
            if placed and entry.type in NUMBERS and len(entry):
                path, motor = placed
                same.setdefault((motor, signal), {}).setdefault(path, []).append(entry)
    beside = {motor for (motor, _), paths in same.items() if search.state.path in paths}
    motors: dict[str, dict[str, Entry]] = {}
    for (motor, signal), paths in same.items():
        if beside and motor not in beside:
            continue  # what lies elsewhere, where motors are logged beside the state, is no motor
        path = search.state.path if search.state.path in paths else next(iter(paths))
        if len(paths) > 1 and path != search.state.path:
            names = [entry.name for several in paths.values() for entry in several]
            raise BadRequest(
                f"several entries could be the {signal}: {quote_names(names)}",
                where=search.where,
                advice=f"Choose one with --{signal} ENTRY.",
            )
        usable = sorted(paths[path], key=lambda entry: NUMBERS.index(entry.type))
        motors.setdefault(motor, {})[signal] = usable[0]
    return motors


def _placed(name: str, signal: str, search: _Search) -> tuple[str, str] | None:
    """Path and motor of an entry, if its name makes it this signal of the mechanism."""
    parts = split_name(name, signal)
    if parts is None or any(parts.rest.endswith(f"-{rival}") for rival in search.rivals):
        return None
    if not search.state.mechanism:
        return parts.path, parts.rest
    motor = parts.rest.removesuffix(f"-{search.state.mechanism}")
    return None if motor == parts.rest else (parts.path, motor)


def _chosen(found: Sequence[MotorEntries], search: _Search) -> MotorEntries:
    """The motor that was asked for, by its name or by an ending that only it has."""
    wanted = (search.asked.motor or "").lower()
    same = [motor for motor in found if motor.name.lower() == wanted]
    same = same or [motor for motor in found if motor.name.lower().endswith(wanted)]
    if len(same) == 1:
        return same[0]
    name, mechanism = search.asked.motor, search.state.mechanism or search.state.entry.name
    names = [motor.name for motor in same or found]
    raise BadRequest(
        f"{name!r} matches several motors of {mechanism!r}"
        if same
        else f"{mechanism!r} has no motor {name!r}",
        where=search.where,
        advice=f"Choose one with --motor: {', '.join(names)}." if names else f"Name {FLAGS}.",
    )


def _left_out(found: Sequence[MotorEntries], where: str) -> Iterator[Doubt]:
    for motor in found:
        lacking = [signal for signal in NEEDED if signal not in motor.signals]
        if lacking:
            yield Doubt(
                "incomplete-motor",
                f"{where}: motor {motor.name!r} has no {' and no '.join(lacking)} and was "
                "left out. Log all three signals of every motor that should count.",
            )


def _missing(motor: MotorEntries, search: _Search) -> MissingSignal:
    """The refusal when no motor is whole: what is missing, and what there is instead."""
    lacking = [signal for signal in NEEDED if signal not in motor.signals]
    signal = lacking[0]
    mechanism = search.state.mechanism or "<mechanism>"
    name = f"{signal}-{motor.name or '<motor>'}-{mechanism}"
    said = [f"no {signal} entry: expected {name!r} (double)"]
    if len(lacking) > 1:
        said.append(f"{' and '.join(lacking[1:])} missing too")
    said += [
        f"{entry.name!r} {explain_unfit_entry(entry, kinds=NUMBERS)}"
        for entry in search.entries
        if _placed(entry.name, signal, search)
    ]
    near = _near(signal, search.entries, search.state.mechanism)
    if near:
        said.append(f"entries with similar names: {quote_names(near)}")
    return MissingSignal(
        "; ".join(said),
        where=search.where,
        advice=f"{_advice(signal)}. Or name another logger's entries: {FLAGS}. {EXPORT}",
    )


def no_motor(entries: Sequence[Entry], *, where: str, mechanism: str = "") -> MissingSignal:
    """The refusal of a log in which no device was recorded whole.

    Args:
        entries: all of the log.
        where: the file.
        mechanism: its name, if known: entries that name it are shown first.
    """
    devices = find_devices(entries)
    lacking = [s for s in NEEDED if not any(s in device.signals for device in devices)]
    what = (
        f"no {' or '.join(filter(None, (', '.join(lacking[:-1]), lacking[-1])))} changes"
        if lacking
        else "no motor has a voltage, a position and a velocity that all change"
    )
    near = [name for signal in NEEDED for name in _near(signal, entries, mechanism)]
    said = f". Entries with similar names: {quote_names(list(dict.fromkeys(near)))}" if near else ""
    arrays = [one.name for one in entries if one.type.endswith("[]") and identify_signal(one)]
    said += f". Arrays cannot be used: {quote_names(arrays)}" if arrays else ""
    return MissingSignal(
        f"{what} during the tests. Each motor needs three entries: voltage, position and "
        f"velocity{said}",
        where=where,
        advice=f"Log all three of each motor, or name the entries: {FLAGS}. {EXPORT}",
    )


def _advice(signal: str) -> str:
    what = "the applied voltage" if signal == "voltage" else f"the {signal}"
    return f"Log {what} in the routine's log callback: call log.motor(NAME).{CALLS[signal]}"


def _near(signal: str, entries: Sequence[Entry], mechanism: str) -> list[str]:
    """Entries whose names speak of a signal, those of this mechanism and this signal first."""

    def distance(entry: Entry) -> tuple[bool, bool, int]:
        name = entry.name.lower()
        return mechanism.lower() not in name, signal[:4] not in name, -len(entry)

    words = [word[:4] for word in NEEDED]  # "volt" says it too
    speaking = [
        entry
        for entry in entries
        if entry.type in NUMBERS and any(word in entry.name.lower() for word in words)
    ]
    return [entry.name for entry in sorted(speaking, key=distance)]
