"""An entry of a log: a named series of values of one type, each with its time."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

Numbers: TypeAlias = NDArray[np.int64]

NUMBERS = ("double", "float", "int64")  # types a signal may have, the likeliest first
STRING = "string"
NEEDED = ("voltage", "position", "velocity")  # the signals of a motor
OPTIONAL = ("current", "bus_voltage")


@dataclass(frozen=True, eq=False)
class Entry:
    """A named series of values.

    Args:
        name: as the log says it.
        type: ``double``, ``string``, …
        metadata: what the log says about it; may be empty.
        time: (n,) [µs], never decreasing.
    """

    name: str
    type: str
    metadata: str
    time: Numbers

    def __len__(self) -> int:
        return int(self.time.size)

    def numbers(self) -> Array:
        """(n,) the values of an entry of a type in ``NUMBERS``."""
        raise NotImplementedError

    def texts(self) -> list[str]:
        """The values of an entry of type string."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class ValuesEntry(Entry):
    """An entry whose values are in memory.

    Args:
        values: (n,) numbers or texts.
    """

    values: Array | tuple[str, ...]

    def numbers(self) -> Array:
        """(n,) the values of an entry of a type in ``NUMBERS``."""
        return np.asarray(self.values, dtype=np.float64)

    def texts(self) -> list[str]:
        """The values of an entry of type string."""
        return list(map(str, self.values))
