"""An entry of a log: a named series of values of one type, each with its time."""

from collections.abc import Container, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

Numbers: TypeAlias = NDArray[np.int64]

NUMBERS = ("double", "float", "int64")  # types that a signal may have, preferred ones first
STRING = "string"
SECOND = 1e6  # [µs]
NEEDED = ("voltage", "position", "velocity")  # signals of a motor for a fit
OPTIONAL = ("current", "bus_voltage")


def find_missing_motion(signals: Container[str]) -> str | None:
    """``position`` or ``velocity`` if a motor's signals lack it; None if they have both."""
    return next((name for name in ("position", "velocity") if name not in signals), None)


def can_be_fitted(signals: Container[str]) -> bool:
    """Whether a motor has a voltage, and a position or a velocity."""
    return "voltage" in signals and ("position" in signals or "velocity" in signals)


@dataclass(frozen=True, eq=False)
class Entry:
    """A named series of values.

    Args:
        name: its name in the log.
        type: ``double``, ``string``, …
        metadata: its metadata in the log; may be empty.
        time: (n,) time of each value [µs], never decreasing.
        values: (n,) numbers, or texts of type string; empty for other types.
    """

    name: str
    type: str
    metadata: str
    time: Numbers
    values: NDArray[Any]

    def __len__(self) -> int:
        return int(self.time.size)

    def numbers(self) -> Array:
        """The values (n,) of an entry with a type in ``NUMBERS``, in double precision."""
        return self.values.astype(np.float64)

    def texts(self) -> list[str]:
        """The values of an entry of type string."""
        return list(map(str, self.values))


@dataclass(frozen=True, eq=False)
class MotorEntries:
    """The entries of one motor's signals.

    Args:
        name: its name, or the common part of its entries' names; empty if the user named them.
        signals: ``voltage``, ``position``, … -> the entry that holds it.
    """

    name: str
    signals: Mapping[str, Entry]

    @property
    def is_complete(self) -> bool:
        """Whether it has voltage, position and velocity."""
        return all(signal in self.signals for signal in NEEDED)
