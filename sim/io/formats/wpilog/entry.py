"""An entry of a WPILOG file, whose values are decoded on demand."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.io.entries.entry import Entry, Numbers
from sim.io.formats.wpilog.records import File, view_numbers

KINDS: dict[str, type[np.generic]] = {
    "double": np.float64,
    "int64": np.int64,
    "float": np.float32,
    "boolean": np.bool_,
}
SIZES = {kind: np.dtype(dtype).itemsize for kind, dtype in KINDS.items()}  # [bytes] of one value
SCATTERED = 4096  # [bytes of the file per string] strings that are rarer are decoded one by one


@dataclass(frozen=True, eq=False)
class FileEntry(Entry):
    """A named series of values in a file.

    Args:
        payload: (n,) offset of each value in the file.
        size: (n,) length of each value [bytes].
        file: the file that holds them.
    """

    payload: Numbers
    size: Numbers
    file: File

    def values(self) -> NDArray[np.generic]:
        """The values (n,) of an entry with a type in ``KINDS``."""
        buffer = self.file.buffer
        if self.type == "boolean":
            return np.not_equal(buffer[self.payload], 0)
        return view_numbers(buffer, KINDS[self.type])[self.payload]

    def numbers(self) -> Array:
        """The values (n,) of an entry with a type in ``KINDS``, in double precision."""
        return self.values().astype(np.float64)

    def texts(self) -> list[str]:
        """The values of an entry of type string."""
        spans = zip(self.payload.tolist(), (self.payload + self.size).tolist(), strict=True)
        if len(self) * SCATTERED < self.file.size:
            content = self.file.content
            return [content[begin:end].decode("utf-8", "replace") for begin, end in spans]
        letters = self.file.latin1_text
        texts = [letters[begin:end] for begin, end in spans]
        if all(map(str.isascii, texts)):
            return texts
        return [text.encode("latin-1").decode("utf-8", "replace") for text in texts]
