"""Write the logs of a mechanism's motors as SysIdRoutine does.

In each loop the data come first, and then the name of the test. There is one difference:
SysIdRoutine gives the test's name a later time than the data of the same loop, so the first loop of
every test is lost. Here, both have the same time.
"""

import lzma
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from sim.core.log import Array, Log
from sim.core.units import UNITS
from sim.io.entries.entry import NEEDED, OPTIONAL, SECOND, Numbers
from sim.io.entries.state import IDLE, WORD
from sim.io.formats.wpilog.signals import SignalGroup, encode_signals

PACKED = ".wpilogxz"  # suffix of a log compressed with xz
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
    """Write the runs of a log one after another, as those of a mechanism with one motor.

    Args:
        log: the log to write; positions are written in its ``units``.
        path: the file; one that ends in .wpilogxz is compressed.
    """
    content = encode_signals(*make_motor_groups({log.mechanism.lower() or MOTOR: log}))
    path.write_bytes(lzma.compress(content) if path.suffix.lower() == PACKED else content)


def make_motor_groups(logs: Mapping[str, Log]) -> tuple[list[SignalGroup], dict[str, str]]:
    """The entries of a mechanism's motors run by run, and the units as WPILib writes them in Java.

    Times are rounded to microseconds. A run that begins before the last one has ended is moved
    after it as a whole.

    Args:
        logs: motor -> its log; all have the same tests at the same times.
    """
    first = next(iter(logs.values()))
    mechanism, unit = first.mechanism or MECHANISM, JAVA[first.units]
    metadata = {"position": unit, "velocity": f"{unit} per Second", "current": "Amp"}
    si = dict.fromkeys(("position", "velocity"), UNITS[first.units].si)
    times = _order_runs([_convert_to_microseconds(run.time) for run in first.runs])
    groups: list[SignalGroup] = []
    units: dict[str, str] = {}
    for number, (time, after) in enumerate(zip(times, [*times[1:], None], strict=True)):
        signals: dict[str, Array] = {}
        for motor, log in logs.items():
            for name in NEEDED + OPTIONAL:
                values = getattr(log.runs[number], name)
                if values is not None:
                    entry = f"{name}-{motor}-{mechanism}"
                    signals[entry] = values / si.get(name, 1.0)
                    units[entry] = metadata.get(name, "Volt")
        end = _find_run_end(time, after) / SECOND
        states = ((time / SECOND, first.runs[number].test), (end, IDLE[0]))
        groups.append(SignalGroup(time / SECOND, signals, {f"{WORD}-{mechanism}": states}))
    return groups, units


def _convert_to_microseconds(time: Array) -> Numbers:
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


def _find_run_end(time: Numbers, after: Numbers | None) -> int:
    """End of a run [µs]: a typical loop after its last sample, or the start of the next run."""
    loop = int(np.median(np.diff(time))) if time.size > 1 else LOOP
    end = int(time[-1]) + max(loop, 1)
    return end if after is None else min(end, int(after[0]))
