"""WPILOG files for tests, written value by value as a robot does, and read byte by byte.

Nothing here is shared with the project's own reader and writer, so that tests compare two texts of
the same specification.
"""

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from sim.core.log import Log

HEADER = b"WPILOG\x00\x01" + struct.pack("<I", 0)
LOOP = 20_000  # [µs]
FOUR = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
PACKED = {"double": "<d", "float": "<f", "int64": "<q", "boolean": "<?"}


def record(
    number: int, time: int, payload: bytes, widths: tuple[int, int, int] = (0, 0, 0)
) -> bytes:
    """One record; each field of its header in as many bytes as it needs, or more if ``widths`` say.

    Args:
        number: the entry id; 0 for control records.
        time: [µs].
        payload: the rest.
        widths: least number of bytes for id, size and time.
    """
    fields = (number, len(payload), time)
    used = [
        max(1, wide, (value.bit_length() + 7) // 8)
        for value, wide in zip(fields, widths, strict=True)
    ]
    bits = used[0] - 1 | used[1] - 1 << 2 | used[2] - 1 << 4
    texts = [value.to_bytes(n, "little") for value, n in zip(fields, used, strict=True)]
    return bytes([bits]) + b"".join(texts) + payload


def text(said: str) -> bytes:
    """A text led by its length."""
    return struct.pack("<I", len(said.encode())) + said.encode()


def start(number: int, name: str, kind: str, metadata: str = "") -> bytes:
    """The payload of a record that starts an entry."""
    return struct.pack("<BI", 0, number) + text(name) + text(kind) + text(metadata)


def finish(number: int) -> bytes:
    """The payload of a record that finishes an entry."""
    return struct.pack("<BI", 1, number)


def metadata(number: int, said: str) -> bytes:
    """The payload of a record that changes an entry's metadata."""
    return struct.pack("<BI", 2, number) + text(said)


def records(content: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Entry id, time and payload of each record of a sound file, the slow and plain way."""
    at = 12 + int.from_bytes(content[8:12], "little")
    while at < len(content):
        bits = content[at]
        widths = (bits & 3) + 1, (bits >> 2 & 3) + 1, (bits >> 4 & 7) + 1
        at += 1
        fields = []
        for width in widths:
            fields.append(int.from_bytes(content[at : at + width], "little"))
            at += width
        number, size, time = fields
        yield number, time, content[at : at + size]
        at += size


@dataclass
class Logger:
    """Writes values as they come.

    Args:
        changes_only: whether a value that repeats is left out.
        parts: what was written so far.
        ids: entry -> its id.
        kinds: entry -> its type.
        last: entry -> the value it had last.
    """

    changes_only: bool = False
    parts: list[bytes] = field(default_factory=lambda: [HEADER])
    ids: dict[str, int] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    last: dict[str, float | str] = field(default_factory=dict)

    def start(self, name: str, kind: str = "double", metadata: str = "", time: int = 0) -> None:
        """Start an entry."""
        self.ids[name] = len(self.ids) + 1
        self.kinds[name] = kind
        self.parts.append(record(0, time, start(self.ids[name], name, kind, metadata)))

    def put(self, name: str, time: int, value: float | str) -> None:
        """Write one value."""
        if self.changes_only and self.last.get(name) == value:
            return
        self.last[name] = value
        if isinstance(value, str):
            payload = value.encode()
        else:
            payload = struct.pack(PACKED[self.kinds[name]], value)
        self.parts.append(record(self.ids[name], time, payload))

    def save(self, path: Path) -> Path:
        """Write the file."""
        path.write_bytes(b"".join(self.parts))
        return path


@dataclass(frozen=True)
class Motor:
    """A motor of the little robot below.

    Args:
        name: as in its entries.
        sign: 1, or -1 for one that turns the other way.
        units: metadata of voltage, position and velocity.
        late: [µs] how long after the loop begins each of the three is logged.
        leave_out: signals that are not logged.
        every: loops between two values of voltage, position and velocity.
    """

    name: str
    sign: float = 1.0
    units: tuple[str, str, str] = ("volt", "turn", "turns_per_second")
    late: tuple[int, int, int] = (0, 0, 0)
    leave_out: tuple[str, ...] = ()
    every: tuple[int, int, int] = (1, 1, 1)


SIGNALS = ("voltage", "position", "velocity")


def voltage(test: str, loop: int) -> float:
    """What the little robot applies."""
    sign = 1.0 if test.endswith("forward") else -1.0
    return sign * (0.02 * loop if test.startswith("quasistatic") else 7.0)


def motion(test: str, loop: int) -> tuple[float, float]:
    """Position and velocity of the little robot: never the same twice, and plain to recompute."""
    sign = 1.0 if test.endswith("forward") else -1.0
    return sign * (loop + 0.5) ** 2 / 100, sign * (loop + 0.5) / 10 * (1 + loop % 3 / 100)


def routine(
    logger: Logger,
    *motors: Motor,
    mechanism: str = "Arm",
    path: str = "",
    tests: tuple[str, ...] = FOUR,
    loops: int = 40,
    begin: int = 1_000_000,
    state_late: int = 0,
) -> int:
    """Run tests as SysIdRoutine does: each loop data, then state; ``none`` at the end.

    Args:
        logger: where to.
        motors: of this mechanism.
        mechanism: its name.
        path: what stands before every name.
        tests: which, in order.
        loops: how many each takes.
        begin: [µs] time of the first.
        state_late: [µs] how long after the loop begins the state is logged.

    Returns:
        The time [µs] when the last is over.
    """
    state = f"{path}sysid-test-state-{mechanism}"
    for motor in motors:
        for signal, unit in zip(SIGNALS, motor.units, strict=True):
            if signal not in motor.leave_out:
                logger.start(f"{path}{signal}-{motor.name}-{mechanism}", "double", unit, begin)
    logger.start(state, "string", "", begin)
    now = begin
    for test in tests:
        for loop in range(loops):
            for motor in motors:
                for signal, time, value in logged(motor, test, loop):
                    logger.put(f"{path}{signal}-{motor.name}-{mechanism}", now + time, value)
            logger.put(state, now + state_late, test)
            now += LOOP
        logger.put(state, now - LOOP + state_late, "none")
        now += 50 * LOOP
    return now


def logged(motor: Motor, test: str, loop: int) -> Iterator[tuple[str, int, float]]:
    """What a motor logs in a loop: signal, time after the loop begins [µs], value."""
    values = (voltage(test, loop), *motion(test, loop))
    for signal, value, late, every in zip(SIGNALS, values, motor.late, motor.every, strict=True):
        if signal not in motor.leave_out and loop % every == 0:
            yield signal, late, motor.sign * value


def saved(folder: Path, *motors: Motor, changes_only: bool = False, **how: object) -> Path:
    """The log of one routine, of one motor if none is given."""
    logger = Logger(changes_only)
    routine(logger, *(motors or (Motor("main"),)), **how)
    return logger.save(folder / "log.wpilog")


def codes(log: Log) -> list[str]:
    """What is doubted about a log."""
    return [doubt.code for doubt in log.doubts]
