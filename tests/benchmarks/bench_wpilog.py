"""How many WPILOG records a second: this project's reader beside WPILib's own DataLogReader.

    python tests/benchmarks/bench_wpilog.py [RECORDS] [REPETITIONS]

Both read the same file to the same end: for every entry all timestamps and all values, as arrays
here and as lists there. Values of other types (arrays, structs) are passed over by both.
"""

import gc
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from wpiutil.log import DataLogReader

from sim.io.formats.wpilog.contents import SIZES, read_contents
from sim.io.formats.wpilog.control import Start, make_start_payload
from sim.io.formats.wpilog.records import MAGIC

HEADER = MAGIC + bytes((0, 1, 0, 0, 0, 0))
START = 20_000_000  # [µs] when a robot has started up
LOOP = 20_000  # [µs]
WORDS = ["quasistatic-forward", "dynamic-reverse", "none", "Auto", "Teleop", "OK"]


def record(number: int, time: int, payload: bytes) -> bytes:
    """A record as WPILib writes it, every field in as few bytes as it needs."""
    fields = [max(1, (field.bit_length() + 7) // 8) for field in (number, len(payload), time)]
    bits = fields[0] - 1 | fields[1] - 1 << 2 | fields[2] - 1 << 4
    texts = zip((number, len(payload), time), fields, strict=True)
    return bytes([bits]) + b"".join(field.to_bytes(n, "little") for field, n in texts) + payload


def started(kinds: list[str]) -> list[bytes]:
    """The beginning of a file with entries of these types."""
    entries = (Start(i, f"NT:/Robot/entry {i}", kind, "") for i, kind in enumerate(kinds, 1))
    return [HEADER] + [record(0, START, make_start_payload(entry)) for entry in entries]


def doubles(count: int, rng: np.random.Generator) -> bytes:
    """Eight entries of doubles in turn, once a loop."""
    table = np.zeros(
        count, [("bits", "u1"), ("id", "u1"), ("size", "u1"), ("time", "<u4"), ("value", "<f8")]
    )
    table["bits"], table["size"] = 0x30, 8
    table["id"] = np.arange(count) % 8 + 1
    table["time"] = START + np.arange(count) // 8 * LOOP // 20
    table["value"] = rng.normal(size=count)
    return b"".join(started(["double"] * 8)) + table.tobytes()


def strings(count: int, rng: np.random.Generator) -> bytes:
    """Eight entries of strings: states that repeat, and messages that do not."""
    parts = started(["string"] * 8)
    draws = rng.integers(0, 12, count).tolist()
    for index, draw in enumerate(draws):
        text = WORDS[draw] if draw < len(WORDS) else f"loop {index} took {draw * 1.7:.2f} ms"
        parts.append(record(index % 8 + 1, START + index * 2_500, text.encode()))
    return b"".join(parts)


def mixed(count: int, rng: np.random.Generator) -> bytes:
    """Four hundred entries as NetworkTables leaves them: all types, lengths and rates."""
    kinds = ["double"] * 200 + ["boolean", "int64", "float", "string", "double[]"] * 32
    kinds += ["struct:Pose2d"] * 40
    length = {"double": 8, "int64": 8, "float": 4, "boolean": 1, "struct:Pose2d": 24}
    parts = started(kinds)
    numbers = rng.integers(0, len(kinds), count).tolist()
    noise = rng.normal(size=count + 64).tobytes()
    for index, number in enumerate(numbers):
        kind = kinds[number]
        payload = noise[8 * index : 8 * index + length.get(kind, 8 * (index % 5 + 1))]
        if kind == "string":
            payload = WORDS[index % 6].encode() * (1 + index % 3)
        elif kind == "boolean":
            payload = b"\1" if index % 2 else b"\0"
        parts.append(record(number + 1, START + index * 50, payload))
    return b"".join(parts)


def ours(path: Path) -> int:
    """Read everything, in arrays; strings in lists."""
    kept = {
        entry.name: (entry.time, entry.texts() if entry.type == "string" else entry.numbers())
        for entry in read_contents(path).list_entries()
        if entry.type in SIZES or entry.type == "string"
    }
    return sum(len(time) for time, _ in kept.values())


def theirs(path: Path) -> int:
    """Read everything, in lists."""
    getters = {
        "double": "getDouble",
        "float": "getFloat",
        "int64": "getInteger",
        "boolean": "getBoolean",
        "string": "getString",
    }
    kept: dict[int, tuple[list[int], list[object], str]] = {}
    for one in DataLogReader(str(path)):
        if one.isStart():
            entry = one.getStartData()
            if entry.type in getters:
                kept[entry.entry] = ([], [], getters[entry.type])
        elif not one.isControl() and one.getEntry() in kept:
            times, values, getter = kept[one.getEntry()]
            times.append(one.getTimestamp())
            values.append(getattr(one, getter)())
    return sum(len(times) for times, _, _ in kept.values())


def seconds(read: Callable[[Path], int], path: Path) -> tuple[float, int]:
    """How long a reader takes, and how many values it found."""
    gc.collect()
    begin = perf_counter()
    found = read(path)
    return perf_counter() - begin, found


def rows(count: int, repetitions: int) -> Iterator[str]:
    """One line for each kind of file."""
    rng = np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as folder:
        for make in (doubles, strings, mixed):
            path = Path(folder) / f"{make.__name__}.wpilog"
            path.write_bytes(make(count, rng))
            total = count + len(read_contents(path).list_entries())
            pairs = [(seconds(ours, path), seconds(theirs, path)) for _ in range(repetitions)]
            if len({found for pair in pairs for _, found in pair}) != 1:
                yield f"{make.__name__}: the readers disagree: {pairs}"
            here, there = (median(pair[k][0] for pair in pairs) for k in (0, 1))
            yield (
                f"{make.__name__:8} {total:9,} records {path.stat().st_size / 1e6:6.1f} MB   "
                f"ours {total / here / 1e6:5.2f} M/s   DataLogReader {total / there / 1e6:5.2f} M/s"
                f"   ratio {there / here:5.1f}"
            )


def main() -> None:
    """Print the table."""
    given = [int(text) for text in sys.argv[1:]]
    for row in rows(*(given + [2_000_000, 5][len(given) :])):
        print(row, flush=True)


if __name__ == "__main__":
    main()
