"""The reader that follows the options about how logs are read.

Files that hold one test each are joined. A file with a whole recording is a part of its own, and so
is every motor.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from pathlib import Path
from typing import TypeAlias

from sim.cli.options import is_same_file
from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.inspect.log_units import check_units
from sim.io import read_motors, read_with
from sim.io.format import ReadOptions
from sim.io.motion import leave_out_falls, mend_motion, scale_velocity

Parts: TypeAlias = Mapping[str, Log]  # name of a side, module or repetition -> its log


@dataclass(frozen=True)
class LogReader(ReadOptions):
    """Reads the logs of a mechanism, as the options of the command line say.

    Args:
        velocity_scale: factor of the velocity.
    """

    velocity_scale: float = 1.0

    def read_recorded(self, file: Path) -> Log:
        """The log in one file as it was recorded; several motors count as their mean.

        Raises:
            Refusal: the file cannot be read.
        """
        return self._scale_velocity(read_with(file, self))

    def read_joined(self, files: Sequence[Path]) -> Log:
        """The logs in all files as one, repaired where that is possible.

        Raises:
            Refusal: a file cannot be read or is given twice, or one measures a length and another
                an angle.
        """
        refuse_duplicates(files)
        return reduce(
            lambda log, other: log.join(other),
            (_check_signals(self.read_recorded(file)) for file in files),
        )

    def read_parts(self, files: Sequence[Path]) -> Mapping[str, Log]:
        """The logs in all files, by the name of the mechanism, side or motor.

        Raises:
            Refusal: as ``read_joined``.
        """
        refuse_duplicates(files)
        return list_parts([(file, self.read_file(file)) for file in files])

    def read_file(self, file: Path) -> dict[str, Log]:
        """The logs in one file, by the name of the mechanism, side or motor.

        Raises:
            Refusal: the file cannot be read.
        """
        return mend_parts(self.read_motors(file))

    def read_motors(self, file: Path) -> dict[str, Log]:
        """The logs in one file as they were recorded, by the name of the mechanism, side or motor.

        Raises:
            Refusal: the file cannot be read.
        """
        return {name: self._scale_velocity(log) for name, log in read_motors(file, self).items()}

    def _scale_velocity(self, log: Log) -> Log:
        """The log with the velocity times the factor that the user gave."""
        return log if self.velocity_scale == 1.0 else scale_velocity(log, self.velocity_scale)


def _check_signals(log: Log) -> Log:
    """The log, repaired where that is possible, with doubts about wrong units."""
    mended = leave_out_falls(mend_motion(log))
    return mended.add_doubts(*check_units(mended))


def mend_parts(parts: Parts) -> dict[str, Log]:
    """The log of each part, repaired where that is possible, with doubts about wrong units."""
    return {name: _check_signals(log) for name, log in parts.items()}


def list_parts(logs: Sequence[tuple[Path, Parts]]) -> Parts:
    """The parts of a robot that some files hold, in the order of the files.

    Args:
        logs: each file, and the logs of its motors by name.
    """
    if len(logs) == 1:
        return logs[0][1]
    if all(log.has_ramps_and_steps for _, motors in logs for log in motors.values()):
        stems = [path.stem for path, _ in logs]
        unique = len(set(stems)) == len(stems)
        return {
            f"{path.stem if unique else path} {name}".strip(): log
            for path, motors in logs
            for name, log in motors.items()
        }
    joined: dict[str, Log] = {}
    for _, motors in logs:
        for name, log in motors.items():
            joined[name] = _join_logs(joined[name], log) if name in joined else log
    return joined


def join_parts(parts: Parts) -> Log:
    """All runs of all parts as one log for display; a doubt about several parts appears once.

    Args:
        parts: the logs by the name of each part; at least one.
    """
    first, *others = parts.values()
    for log in others:
        first = _join_logs(first, log)
    return first


def _join_logs(first: Log, other: Log) -> Log:
    """The runs of two logs; doubts that differ only in the name of the file appear once."""
    said = {(one.code, one.message.replace(first.source, "")) for one in first.doubts}
    new = tuple(
        one for one in other.doubts if (one.code, one.message.replace(other.source, "")) not in said
    )
    return first.join(replace(other, doubts=new))


def refuse_duplicates(files: Sequence[Path]) -> None:
    """Refuse a file that was named twice: its samples would count twice.

    Raises:
        BadRequest: two of them are the same file.
    """
    for index, file in enumerate(files):
        if any(is_same_file(file, other) for other in files[:index]):
            raise BadRequest(
                "this file is given twice", where=str(file), advice="Name each file once."
            )
