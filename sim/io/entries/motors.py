"""The entries of a WPILOG file that hold a mechanism's signals, motor by motor.

    <signal>-<motor>-<mechanism>       voltage, position, velocity; current may join them

The name of a motor and that of a mechanism may both hold the dash that stands between them: only
the mechanism's state entry tells where to split.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

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
    options: ReadOptions
    where: str

    @cached_property
    def rivals(self) -> tuple[str, ...]:
        """The mechanisms whose name is longer and ends the same."""
        named = {name.rest for one in self.entries if (name := split_name(one.name, WORD))}
        return tuple(name for name in named if name.endswith(f"-{self.state.mechanism}"))

    @cached_property
    def given(self) -> dict[str, Entry]:
        """The signals whose entries a person has named."""
        given = {
            signal: find_requested_entry(
                name, role=signal, kinds=NUMBERS, entries=self.entries, where=self.where
            )
            for signal, name in self.options.entries.items()
            if signal in NEEDED + OPTIONAL
        }
        if self.options.ignore_velocity and "position" in given:
            given["velocity"] = given["position"]  # its slope is taken later
        return given


def find_motors(
    state: StateEntry,
    entries: Sequence[Entry],
    tests: Sequence[RunInterval],
    *,
    options: ReadOptions,
    where: str,
) -> tuple[tuple[MotorEntries, ...], tuple[Doubt, ...], tuple[RunInterval, ...]]:
    """The motors of a mechanism whose signals are used, each of them complete.

    Args:
        state: where its tests are named.
        entries: all entries of the file.
        tests: when its tests ran.
        options: which motor, and which entries, where a person has said so.
        where: the file, for messages.

    Returns:
        At least one motor, doubts about those left out, and the tests that drive them.

    Raises:
        MissingSignal: no motor has all signals; the message names what is missing.
        BadRequest: the chosen motor is not there, or a name is ambiguous.
    """
    search = _Search(entries, state, options, where)
    by_hand = MotorEntries(options.motor or "", search.given)
    if by_hand.is_complete:
        return (by_hand,), (), tuple(tests)
    found = _by_motor(search)
    noted: tuple[Doubt, ...] = ()
    if not search.given and not any(motor.is_complete for motor in found):
        other, tests = _of_other_loggers(search, tests)
        found, noted = other or found, (_taken(other, where),) if other else ()
    if options.motor is not None:
        found = [_chosen(found, search)]
    whole = tuple(motor for motor in found if motor.is_complete)
    if not whole:
        raise _missing(found, search)
    return whole, (*noted, *_left_out(found, where)), tuple(tests)


def _of_other_loggers(
    search: _Search, tests: Sequence[RunInterval]
) -> tuple[list[MotorEntries], Sequence[RunInterval]]:
    """The motors that another logger recorded, and the tests that drove them.

    Raises:
        BadRequest: the tests drove one mechanism after another, and none was chosen.
    """
    devices = find_devices(search.entries)
    if search.options.ignore_velocity:
        devices = [one.use_position_as_velocity() for one in devices]
    driven = select_driven_devices(devices, tests)
    words = set(split_words(search.state.mechanism))
    some = [one for one in driven if words & set(split_words(one.name))] or driven
    if search.options.motor is None and some:
        groups = group_by_tests(some, tests)
        some, tests = groups[0] if len(groups) == 1 else _picked(groups, search)
    return [MotorEntries(one.name, one.signals) for one in some], tests


def _picked(groups: Sequence[DeviceGroup], search: _Search) -> DeviceGroup:
    """The mechanism that a person chose."""
    pick = search.options.pick
    if pick is not None and 1 <= pick <= len(groups):
        return groups[pick - 1]
    names = [" and ".join(one.name for one in devices) for devices, _ in groups]
    raise BadRequest(
        f"its tests drive several mechanisms, one after another: {number_names(names)}",
        where=search.where,
        advice="Choose one by its number, such as --pick 1.",
    )


def _without_velocity(motor: MotorEntries) -> MotorEntries:
    """A motor whose velocity entry is replaced by its position entry."""
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


def _by_motor(search: _Search) -> list[MotorEntries]:
    """The motors of the mechanism, with the usable entry of each signal they have."""
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
    found = [MotorEntries(name, signals | search.given) for name, signals in motors.items()]
    return [_without_velocity(one) if search.options.ignore_velocity else one for one in found]


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
    """The chosen motor, by its name or by an ending that only it has."""
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


def _left_out(found: Sequence[MotorEntries], where: str) -> Iterator[Doubt]:
    for motor in found:
        lacking = [signal for signal in NEEDED if signal not in motor.signals]
        if lacking:
            yield Doubt(
                "incomplete-motor",
                f"{where}: motor {motor.name!r} has no {' and no '.join(lacking)} and was "
                "left out. Log all three signals of every motor that should count.",
            )


def _missing(found: Sequence[MotorEntries], search: _Search) -> MissingSignal:
    """The refusal when no motor is whole: what is missing, and what there is instead."""
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


def make_no_motor_error(
    entries: Sequence[Entry], *, where: str, mechanism: str = ""
) -> MissingSignal:
    """The error for a log in which no device was recorded completely.

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
