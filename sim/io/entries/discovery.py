"""Find a motor's signals in a log that SysIdRoutine did not write, by what their entries are.

    Phoenix6/TalonFX-14/MotorVoltage          /Drive/ModuleBackLeft/DrivePositionRad
    NT:/URCL/SparkMax-11/MotorVelocityRPM     …

The words of a name and the unit in its metadata say which signal an entry holds; what is left of
the name says of which device. Among devices with all signals, those that are driven while the tests
run are the mechanism's motors.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from sim.core.log import TESTS
from sim.core.vocabulary import DIRECTIONS, KINDS
from sim.io.entries.entry import NEEDED, NUMBERS, Entry, ValuesEntry
from sim.io.entries.names import split_words
from sim.io.entries.state import RunInterval
from sim.io.entries.units import find_unit_in_metadata, parse_signal_unit

ROLES: Mapping[str, frozenset[str]] = {  # signal -> words of which one is in its name
    "bus_voltage": frozenset({"bus", "battery", "supply", "input"}),
    "velocity": frozenset({"velocity", "vel", "speed", "rpm", "rps"}),
    "position": frozenset({"position", "pos", "distance", "angle"}),
    "voltage": frozenset({"voltage", "volts", "volt"}),
    "current": frozenset({"current", "amps"}),
}
DUTY = frozenset({"output", "duty", "percent"})
"""Words for a share of the battery's voltage, where no word says volts."""
FILLERS = frozenset(
    {
        "motor",
        "applied",
        "output",
        "measured",
        "actual",
        "per",
        "value",
        "cycle",
        "stator",
        "sensor",
    }
)
OTHERS = frozenset(
    {"setpoint", "reference", "target", "goal", "desired", "closed", "error", "feedforward"}
    | {"kp", "ki", "kd", "temp", "temperature", "torque", "absolute", "compensation", "limit"}
    | {"offset", "min", "max", "latency", "analog"}
)
"""Words of entries that hold no measurement of the motor."""
DRIVEN = 0.5  # [share of the voltage of the motor that is driven most] of a motor of the mechanism
MOVES = 0.3  # [1] correlation of a velocity with the slope of its position, at least
ZERO = 0.02  # [V] a smaller voltage drives nothing
PAUSE = 500_000  # [µs] without a voltage that ends a test
_SAME = {"backward": "reverse", "backwards": "reverse", "forwards": "forward"}


@dataclass(frozen=True, eq=False)
class Device:
    """One motor as another logger records it.

    Args:
        name: what its entries' names share.
        signals: ``voltage``, ``position``, … -> the entry that holds it.
    """

    name: str
    signals: Mapping[str, Entry]

    @property
    def is_complete(self) -> bool:
        """Whether it has all that a fit needs."""
        return all(signal in self.signals for signal in NEEDED)


def find_devices(entries: Sequence[Entry]) -> list[Device]:
    """The devices of a log, each with the signals that its entries' names and units tell."""
    found: dict[str, dict[str, Entry]] = {}
    for entry in entries:
        if entry.type in NUMBERS and len(entry) and (told := identify_signal(entry)):
            device, signal = told
            own = found.setdefault(device, {})
            if signal not in own or len(entry) > len(own[signal]):
                own[signal] = entry
    return [Device(name, _with_voltage(signals)) for name, signals in found.items()]


def identify_signal(entry: Entry) -> tuple[str, str] | None:
    """Device and signal of an entry; None if it is none of a motor's."""
    path, last = re.fullmatch(r"(.*[/:])?(.*)", entry.name, re.DOTALL).groups("")  # type: ignore[union-attr]
    words = split_words(last)
    if OTHERS.intersection(words):
        return None
    signal = _signal(words, find_unit_in_metadata(entry.metadata))
    if not signal:
        return None
    spent = {
        *FILLERS,
        *DUTY,
        *ROLES.get(signal, ()),
        *ROLES["voltage"],
        *_unit_words(words, signal),
    }
    rest = [word for word in words if word not in spent]
    return (path + "-".join(rest)).rstrip("/:"), signal


def select_driven_devices(devices: Sequence[Device], tests: Sequence[RunInterval]) -> list[Device]:
    """The devices that are driven while tests run, and whose velocity goes with their position."""
    levels = [(device, _voltage_in(device, tests)) for device in devices if device.is_complete]
    most = max((level for _, level in levels), default=0.0)
    return [
        device
        for device, level in levels
        if most > ZERO and level >= DRIVEN * most and _velocity_matches_position(device, tests)
    ]


def find_test_in_name(stem: str) -> str:
    """The test that a file's name tells; empty if it tells none, or several."""
    words = [_SAME.get(word, word) for word in split_words(stem)]
    kinds, ways = set(KINDS).intersection(words), set(DIRECTIONS).intersection(words)
    if len(kinds) != 1 or len(ways) != 1:
        return ""
    test = f"{kinds.pop()}-{ways.pop()}"
    return test if test in TESTS else ""


def find_driven_interval(test: str, devices: Sequence[Device]) -> RunInterval | None:
    """The longest time for which some device is driven, as the time of a test."""
    stretches = [
        stretch
        for device in devices
        if device.is_complete
        for stretch in _driven_intervals(device.signals["voltage"])
    ]
    if not stretches:
        return None
    begin, end = max(stretches, key=lambda one: one[1] - one[0])
    return RunInterval(test, begin, end)


def _signal(words: Sequence[str], unit: str) -> str:
    """The signal that words tell, or else the unit; empty if neither does."""
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


def _unit_words(words: Sequence[str], signal: str) -> Iterator[str]:
    """Those words at the end of a name that are its unit."""
    for first in range(len(words)):
        if parse_signal_unit(" ".join(words[first:]), signal):
            yield from words[first:]
            return


def _with_voltage(signals: Mapping[str, Entry]) -> dict[str, Entry]:
    """The signals; a share of the battery's voltage, times that, is a voltage."""
    found = dict(signals)
    duty, bus = found.pop("duty_cycle", None), found.get("bus_voltage")
    if duty is not None and bus is not None and "voltage" not in found:
        volts = bus.numbers()[np.maximum(np.searchsorted(bus.time, duty.time, side="right") - 1, 0)]
        name = f"{duty.name} × {bus.name}"
        found["voltage"] = ValuesEntry(name, duty.type, "Volt", duty.time, duty.numbers() * volts)
    return found


def _samples_between(entry: Entry, tests: Sequence[RunInterval]) -> list[slice]:
    return [slice(*np.searchsorted(entry.time, (test.begin, test.end))) for test in tests]


def _voltage_in(device: Device, tests: Sequence[RunInterval]) -> float:
    """[V] root mean square of a device's voltage while tests run."""
    entry = device.signals["voltage"]
    values = entry.numbers()
    parts = [values[part] for part in _samples_between(entry, tests)]
    every = np.concatenate(parts) if parts else np.empty(0)
    return float(np.sqrt(np.mean(np.square(every)))) if every.size else 0.0


def _velocity_matches_position(device: Device, tests: Sequence[RunInterval]) -> bool:
    """Whether its velocity goes with the slope of its position while tests run."""
    position, velocity = device.signals["position"], device.signals["velocity"]
    x, v = position.numbers(), velocity.numbers()
    slopes, speeds = [], []
    for part in _samples_between(velocity, tests):
        time = velocity.time[part]
        if time.size > 2:  # noqa: PLR2004 - a slope needs three
            slopes.append(np.gradient(np.interp(time, position.time, x), np.arange(time.size)))
            speeds.append(v[part])
    if not slopes:
        return False
    slope, speed = np.concatenate(slopes), np.concatenate(speeds)
    size = float(np.linalg.norm(slope) * np.linalg.norm(speed))
    return size > 0.0 and float(slope @ speed) > MOVES * size


def _driven_intervals(voltage: Entry) -> Iterator[tuple[int, int]]:
    """Begin and end [µs] of each time for which a voltage drives, short pauses included."""
    values = voltage.numbers()
    on = np.flatnonzero(np.abs(values) > ZERO)
    if not on.size:
        return
    ends = np.flatnonzero(np.diff(voltage.time[on]) > PAUSE)
    firsts, lasts = on[np.append(0, ends + 1)], on[np.append(ends, on.size - 1)]
    for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True):
        yield int(voltage.time[first]), int(voltage.time[min(last + 1, values.size - 1)])
