"""An entry of a WPILOG file, whose values are decoded on demand."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from sim.core.log import Array
from sim.io.entries.entry import Entry, Numbers

KINDS = {"double": "<f8", "int64": "<i8", "float": "<f4", "boolean": "?"}
SIZES = {kind: np.dtype(dtype).itemsize for kind, dtype in KINDS.items()}  # [bytes] of one value


@dataclass(frozen=True, eq=False)
class FileEntry(Entry):
    """A named series of values in a file.

    Args:
        size: (n,) length of each value [bytes].
        payloads: the values as they are in the file, one after another.
    """

    size: Numbers
    payloads: bytes

    def numbers(self) -> Array:
        """The values (n,) of an entry with a type in ``KINDS``, in double precision."""
        return np.frombuffer(self.payloads, KINDS[self.type]).astype(np.float64)

    def texts(self) -> list[str]:
        """The values of an entry of type string."""
        ends = [0, *np.cumsum(self.size).tolist()]
        if self.payloads.isascii():  # then letters are bytes, and one decoding is faster
            letters = self.payloads.decode("ascii")
            return [letters[at:end] for at, end in pairwise(ends)]
        return [self.payloads[at:end].decode("utf-8", "replace") for at, end in pairwise(ends)]
