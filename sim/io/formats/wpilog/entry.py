"""An entry of a WPILOG file, whose values are decoded on demand."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.io.entries.entry import Entry, Numbers
from sim.io.formats.wpilog.records import view_as_numbers

KINDS: dict[str, type[np.generic]] = {
    "double": np.float64,
    "int64": np.int64,
    "float": np.float32,
    "boolean": np.bool_,
}
SIZES = {kind: np.dtype(dtype).itemsize for kind, dtype in KINDS.items()}  # [bytes] of one value


@dataclass(frozen=True, eq=False)
class FileEntry(Entry):
    """A named series of values in a file.

    Args:
        begin: (n,) offset of each value in ``payloads``.
        size: (n,) length of each value [bytes].
        payloads: the values as they are in the file.
    """

    begin: Numbers
    size: Numbers
    payloads: bytes

    def values(self) -> NDArray[np.generic]:
        """The values (n,) of an entry with a type in ``KINDS``."""
        if not len(self):
            return np.zeros(0, dtype=KINDS[self.type])
        buffer = np.frombuffer(self.payloads, dtype=np.uint8)
        if self.type == "boolean":
            return np.not_equal(buffer[self.begin], 0)
        return view_as_numbers(buffer, KINDS[self.type])[self.begin]

    def numbers(self) -> Array:
        """The values (n,) of an entry with a type in ``KINDS``, in double precision."""
        return self.values().astype(np.float64)

    def texts(self) -> list[str]:
        """The values of an entry of type string."""
        spans = list(zip(self.begin.tolist(), (self.begin + self.size).tolist(), strict=True))
        if self.payloads.isascii():
            letters = self.payloads.decode("ascii")
            return [letters[begin:end] for begin, end in spans]
        return [self.payloads[begin:end].decode("utf-8", "replace") for begin, end in spans]
