"""Write a WPILOG file as SysIdRoutine does: in each loop the data, then the name of the test.

There is one difference: SysIdRoutine gives the test's name a later time than the data of the same
loop, so the first loop of every test is lost. Here, both have the same time.
"""

import lzma
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from sim.core.log import Array, Log, Run
from sim.core.units import UNITS
from sim.io.entries.entry import NEEDED, OPTIONAL, Numbers
from sim.io.entries.state import IDLE, WORD
from sim.io.formats.wpilog.control import Start, make_start_payload
from sim.io.formats.wpilog.records import FILE_HEADER, pack_record

SECOND = 1e6  # [µs]
PACKED = ".wpilogxz"  # suffix of a log compressed with xz
LONG_TIME = 0b0111_0000  # bits of a record with eight bytes for its time, and one for id and size
REST = 1_000_000  # [µs] pause before a run that is moved after the run before it
LOOP = 20_000  # [µs] duration of a run with only one sample
MECHANISM, MOTOR = "Mechanism", "motor"  # names if the log has none
JAVA = {  # unit of ours -> WPILib's name for it
    "meters": "Meter",
    "feet": "Foot",
    "inches": "Inch",
    "radians": "Radian",
    "rotations": "Rotation",
    "degrees": "Degree",
}


def write(log: Log, path: Path) -> None:
    """Write the runs of a log one after another.

    Times are rounded to microseconds. A run that begins before the last one has ended is moved
    after it as a whole.

    Args:
        log: the log to write; positions are written in its ``units``.
        path: the file; one that ends in .wpilogxz is compressed.
    """
    times = _order_runs([_to_microseconds(run.time) for run in log.runs])
    ends = [_end(time, after) for time, after in zip(times, [*times[1:], None], strict=True)]
    names = [*NEEDED, *(one for one in OPTIONAL if _has_signal(log, one))]
    ids = {name: number for number, name in enumerate([*names, "state"], start=1)}
    parts = [FILE_HEADER]
    parts += [
        pack_record(0, int(times[0][0]), make_start_payload(entry)) for entry in _entries(log, ids)
    ]
    for run, time, end in zip(log.runs, times, ends, strict=True):
        parts.append(_pack_loops(run, time, ids, si=UNITS[log.units].si))
        parts.append(pack_record(ids["state"], end, IDLE[0].encode()))
    content = b"".join(parts)
    path.write_bytes(lzma.compress(content) if path.suffix.lower() == PACKED else content)


def _has_signal(log: Log, name: str) -> bool:
    return any(getattr(run, name) is not None for run in log.runs)


def _to_microseconds(time: Array) -> Numbers:
    """Times in whole microseconds, which differ by at least one."""
    steps = np.arange(time.size)
    rounded = np.rint(time * SECOND).astype(np.int64)
    return np.maximum.accumulate(rounded - steps) + steps


def _order_runs(times: Sequence[Numbers]) -> list[Numbers]:
    """The times of all runs, each moved so that it begins after the one before has ended."""
    placed: list[Numbers] = []
    earliest = 0
    for time in times:
        first = int(time[0])
        placed.append(
            time if first >= earliest else time + (earliest + REST * bool(placed) - first)
        )
        earliest = int(placed[-1][-1]) + 1
    return placed


def _end(time: Numbers, after: Numbers | None) -> int:
    """End of a run [µs]: a typical loop after its last sample, or the start of the next run."""
    loop = int(np.median(np.diff(time))) if time.size > 1 else LOOP
    end = int(time[-1]) + max(loop, 1)
    return end if after is None else min(end, int(after[0]))


def _entries(log: Log, ids: dict[str, int]) -> Iterator[Start]:
    """The entries of a mechanism with one motor, with units as WPILib writes them in Java."""
    mechanism = log.mechanism or MECHANISM
    motor = log.mechanism.lower() or MOTOR
    unit = JAVA[log.units]
    metadata = {"position": unit, "velocity": f"{unit} per Second", "current": "Amp"}
    for name, number in ids.items():
        if name == "state":
            yield Start(number, f"{WORD}-{mechanism}", "string", "")
        else:
            metadatum = metadata.get(name, "Volt")
            yield Start(number, f"{name}-{motor}-{mechanism}", "double", metadatum)


def _pack_loops(run: Run, time: Numbers, ids: dict[str, int], *, si: float) -> bytes:
    """All loops of a run: one record for each signal it has, then one for the test's name."""
    signals = {name: getattr(run, name) for name in ids if name != "state"}
    signals |= {"position": run.position / si, "velocity": run.velocity / si}
    values = {name: array.astype("<f8") for name, array in signals.items() if array is not None}
    values["state"] = np.full(time.size, run.test.encode())
    header = [("bits", "u1"), ("id", "u1"), ("size", "u1"), ("time", "<u8")]
    kinds = [(name, [*header, ("value", array.dtype)]) for name, array in values.items()]
    table = np.zeros(time.size, dtype=kinds)
    for name, array in values.items():
        table[name]["bits"] = LONG_TIME
        table[name]["id"] = ids[name]
        table[name]["size"] = array.dtype.itemsize
        table[name]["time"] = time
        table[name]["value"] = array
    return table.tobytes()
