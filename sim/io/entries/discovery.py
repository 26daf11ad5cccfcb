"""Find the signals of motors in a log without SysId's names, by the names and units of entries.

    Phoenix6/TalonFX-14/MotorVoltage          /Drive/ModuleBackLeft/DrivePositionRad
    NT:/URCL/SparkMax-11/MotorVelocityRPM     …

The words of a name and the unit in its metadata tell which signal an entry holds; the rest of the
name tells the device. Of the devices with all signals, those with a voltage during the tests are
the mechanism's motors.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from sim.core.log import Array
from sim.io.entries.entry import (
    NEEDED,
    NUMBERS,
    OPTIONAL,
    Entry,
    MotorEntries,
    can_be_fitted,
)
from sim.io.entries.names import split_unit, split_words
from sim.io.entries.state import RunInterval
from sim.io.entries.units import find_unit_in_metadata, parse_signal_unit

ROLES: Mapping[str, frozenset[str]] = {  # signal -> words; an entry's name holds one of them
    "bus_voltage": frozenset({"bus", "battery", "supply", "input"}),
    "velocity": frozenset({"velocity", "vel", "speed", "rpm", "rps"}),
    "position": frozenset({"position", "pos", "distance", "angle"}),
    "voltage": frozenset({"voltage", "volts", "volt"}),
    "current": frozenset({"current", "amps"}),
}
DUTY = frozenset({"output", "duty", "percent"})
"""Words for a duty cycle, if no word in the name means volts."""
FILLERS = frozenset(
    {"motor", "applied", "output", "measured", "actual", "per", "value", "cycle"}
    | {"stator", "sensor", "encoder", "primary"}
)
OTHERS = frozenset(
    {"setpoint", "reference", "target", "goal", "desired", "closed", "error", "feedforward"}
    | {"kp", "ki", "kd", "temp", "temperature", "torque", "absolute", "compensation", "limit"}
    | {"offset", "min", "max", "latency", "analog"}
)
"""Words of entries that hold no measurement of the motor."""
SENSORS = frozenset({"analog", "absolute"})
"""Words in the folder names of sensors that are not the motor's own."""
DRIVEN = 0.5  # [share of the largest RMS voltage of a device] of the mechanism's motors at least
MOVES = 0.3  # [1] least correlation of a velocity with the slope of its position
ALIKE = 0.9999  # [1] least correlation of two signals that are the same
ZERO = 0.02  # [V] smaller voltages count as zero
PAUSE = 500_000  # [µs] a longer time without voltage ends a test


MotorGroup: TypeAlias = tuple[
    list[MotorEntries], list[RunInterval]
]  # motors of a mechanism, its tests


def find_devices(entries: Sequence[Entry]) -> list[MotorEntries]:
    """The devices of a log, with the signals found by the names and units of their entries."""
    found: dict[str, dict[str, Entry]] = {}
    for entry in entries:
        if (
            entry.type in NUMBERS
            and len(entry)
            and (identified := identify_signal(entry.name, entry.metadata))
        ):
            device, signal = identified
            own = found.setdefault(device, {})
            if signal not in own or len(entry) > len(own[signal]):
                own[signal] = entry
    return _add_shared_motion(
        [MotorEntries(name, _compute_voltage(signals)) for name, signals in found.items()]
    )


def _add_shared_motion(devices: Sequence[MotorEntries]) -> list[MotorEntries]:
    """The devices; one with only a voltage gets the position and velocity logged near it.

    Two motors of an elevator have a voltage each, and one position: ``Lift/LeftVolts``,
    ``Lift/RightVolts``, ``Lift/PositionMeters``.
    """
    motions = [
        one
        for one in devices
        if "voltage" not in one.signals and {"position", "velocity"} <= one.signals.keys()
    ]
    completed = []
    for device in devices:
        if "voltage" in device.signals and not {"position", "velocity"} & device.signals.keys():
            folder = re.split(r"[/:](?!.*[/:])", device.name)[0]
            near = (
                [one for one in motions if one.name == folder]
                or [one for one in motions if one.name.startswith(f"{device.name}/")]
                or [one for one in motions if re.split(r"[/:](?!.*[/:])", one.name)[0] == folder]
            )
            if len(near) == 1:
                completed.append(MotorEntries(device.name, {**near[0].signals, **device.signals}))
                continue
        completed.append(device)
    return completed


def identify_signal(name: str, metadata: str) -> tuple[str, str] | None:
    """Device and signal of an entry; None if it is not a signal of a motor."""
    name, unit = split_unit(name)
    path, last = re.fullmatch(r"(.*[/:])?(.*)", name, re.DOTALL).groups("")  # type: ignore[union-attr]
    words = split_words(last)
    folder = split_words(re.split(r"[/:]", path.rstrip("/:"))[-1])
    if OTHERS.intersection(words) or SENSORS.intersection(folder):
        return None
    signal = _find_signal(words, find_unit_in_metadata(metadata) or unit)
    if folder[:1] == ["spark"] and words == ["voltage"]:
        signal = "bus_voltage"  # REV/Spark-3/VOLTAGE of REV's converter is the battery voltage
    if not signal:
        return None
    spent = {
        *FILLERS,
        *DUTY,
        *ROLES.get(signal, ()),
        *ROLES["voltage"],
        *_find_unit_words(words, signal),
    }
    rest = [word for word in words if word not in spent]
    return (path + "-".join(rest)).rstrip("/:"), signal


def may_be_signal(name: str, metadata: str) -> bool:
    """Whether an entry of numbers may be a signal of a motor, or has a similar name."""
    alike = any(word[:4] in name.lower() for word in NEEDED + OPTIONAL)
    return alike or identify_signal(name, metadata) is not None


def select_driven_devices(
    devices: Sequence[MotorEntries], tests: Sequence[RunInterval]
) -> list[MotorEntries]:
    """The devices with a voltage during the tests whose velocity matches their position.

    Devices without a position or without a velocity count only if no device has both.
    """
    usable = [device for device in devices if can_be_fitted(device.signals)]
    usable = [device for device in usable if device.is_complete] or usable
    levels = [(device, _measure_rms_voltage(device, tests)) for device in usable]
    most = max((level for _, level in levels), default=0.0)
    return [
        device
        for device, level in levels
        if most > ZERO and level >= DRIVEN * most and _follows_position(device, tests)
    ]


def group_by_tests(
    devices: Sequence[MotorEntries], tests: Sequence[RunInterval]
) -> list[MotorGroup]:
    """Groups of devices that are driven in the same tests, with these tests: the mechanisms.

    Some robot programs name the tests of all mechanisms in one entry and test one mechanism after
    another.
    """
    levels = np.array([[_measure_rms_voltage(one, [test]) for test in tests] for one in devices])
    driven = (levels >= DRIVEN * levels.max(axis=0)) & (levels > ZERO)
    groups: list[tuple[list[MotorEntries], set[int]]] = []
    for device, own in zip(devices, driven, strict=True):
        mine = ([device], set(np.flatnonzero(own).tolist()))
        for group in [one for one in groups if one[1] & mine[1]]:
            groups.remove(group)
            mine = ([*group[0], *mine[0]], group[1] | mine[1])
        groups.append(mine)
    return [(some, [tests[n] for n in sorted(own)]) for some, own in groups]


def find_driven_interval(test: str, devices: Sequence[MotorEntries]) -> RunInterval | None:
    """The longest interval in which a device is driven, as the interval of a test; None if none."""
    intervals = [
        interval
        for device in devices
        if device.is_complete
        for interval in _find_driven_intervals(device.signals["voltage"])
    ]
    if not intervals:
        return None
    begin, end = max(intervals, key=lambda one: one[1] - one[0])
    return RunInterval(test, begin, end)


def _find_signal(words: Sequence[str], unit: str) -> str:
    """The signal by the words of a name, or else by the unit; empty if neither tells it."""
    own = set(words)
    for signal, telling in ROLES.items():
        if signal == "bus_voltage":
            if own & telling and own & ROLES["voltage"]:
                return signal
        elif own & telling:
            return signal
    if own & DUTY and not unit:
        return "duty_cycle"
    for signal in NEEDED:
        if unit and parse_signal_unit(unit, signal):
            return signal
    return ""


def _find_unit_words(words: Sequence[str], signal: str) -> Iterator[str]:
    """The words at the end of a name that are its unit."""
    for first in range(len(words)):
        if parse_signal_unit(" ".join(words[first:]), signal):
            yield from words[first:]
            return


def _compute_voltage(signals: Mapping[str, Entry]) -> dict[str, Entry]:
    """The signals; a missing voltage is the duty cycle times the battery voltage."""
    found = dict(signals)
    duty, bus = found.pop("duty_cycle", None), found.get("bus_voltage")
    if duty is not None and bus is not None and "voltage" not in found:
        volts = bus.numbers()[np.maximum(np.searchsorted(bus.time, duty.time, side="right") - 1, 0)]
        name = f"{duty.name} × {bus.name}"
        found["voltage"] = Entry(name, duty.type, "Volt", duty.time, duty.numbers() * volts)
    return found


def _select_samples(entry: Entry, tests: Sequence[RunInterval]) -> list[slice]:
    return [slice(*np.searchsorted(entry.time, (test.begin, test.end))) for test in tests]


def _measure_rms_voltage(device: MotorEntries, tests: Sequence[RunInterval]) -> float:
    """The RMS voltage [V] of a device during tests.

    If only changes were logged, a test may have no sample: then the last value before it holds.
    """
    entry = device.signals["voltage"]
    values = entry.numbers()
    parts = [
        values[part] if part.start < part.stop else values[max(part.start - 1, 0) : part.start]
        for part in _select_samples(entry, tests)
    ]
    every = np.concatenate(parts) if parts else np.empty(0)
    return float(np.sqrt(np.mean(np.square(every)))) if every.size else 0.0


def _follows_position(device: MotorEntries, tests: Sequence[RunInterval]) -> bool:
    """Whether the velocity of a device correlates with the slope of its position during tests.

    A position that was logged as the velocity passes, too: a fit uses its slope. Of a device with
    only one of them, it has to change.
    """
    position, velocity = (device.signals.get(name) for name in ("position", "velocity"))
    if position is None or velocity is None:
        return _has_changes(next(one for one in (position, velocity) if one is not None), tests)
    x, v = position.numbers(), velocity.numbers()
    parts = _select_samples(velocity, tests)
    if any(
        _have_same_motion(v[part], np.interp(velocity.time[part], position.time, x))
        for part in parts
    ):
        return True
    slopes, speeds = [], []
    for part in parts:
        time = velocity.time[part]
        if time.size > 2:  # noqa: PLR2004 - a slope needs three
            slopes.append(np.gradient(np.interp(time, position.time, x), np.arange(time.size)))
            speeds.append(v[part])
    if not slopes:
        return False
    slope, speed = np.concatenate(slopes), np.concatenate(speeds)
    size = float(np.linalg.norm(slope) * np.linalg.norm(speed))
    return size > 0.0 and float(slope @ speed) > MOVES * size


def _has_changes(entry: Entry, tests: Sequence[RunInterval]) -> bool:
    """Whether the values of an entry change during tests."""
    values = entry.numbers()
    return any(np.any(np.diff(values[part])) for part in _select_samples(entry, tests))


def _have_same_motion(one: Array, other: Array) -> bool:
    """Whether two signals differ only by a factor and an offset, and are not constant."""
    if not one.size:
        return False
    one, other = one - np.mean(one), other - np.mean(other)
    size = float(np.linalg.norm(one) * np.linalg.norm(other))
    return size > 0.0 and float(one @ other) > ALIKE * size


def _find_driven_intervals(voltage: Entry) -> Iterator[tuple[int, int]]:
    """Begin and end [µs] of each interval with a voltage; short pauses do not end it."""
    values = voltage.numbers()
    on = np.flatnonzero(np.abs(values) > ZERO)
    if not on.size:
        return
    ends = np.flatnonzero(np.diff(voltage.time[on]) > PAUSE)
    firsts, lasts = on[np.append(0, ends + 1)], on[np.append(ends, on.size - 1)]
    for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True):
        yield int(voltage.time[first]), int(voltage.time[min(last + 1, values.size - 1)])
