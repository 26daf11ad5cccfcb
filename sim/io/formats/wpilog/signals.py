"""Write any signals as a WPILOG file: all at once, or value by value.

When written at once, to be shown in another tool, every signal is an entry of doubles. A text, such
as the name of a test, is an entry of strings that is written when it changes.
"""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.io.entries.entry import SECOND, Numbers
from sim.io.formats.wpilog.control import Start, make_start_payload
from sim.io.formats.wpilog.records import FILE_HEADER, pack_record, pack_records
from sim.support.atomic_file import write_atomically
from sim.support.os_errors import refuse_os_errors

ADVICE = "Choose a folder that exists and that you may write to."
# Type of an entry -> format of a value
PACKING = {"double": "<d", "float": "<f", "int64": "<q", "boolean": "<?"}


@dataclass(frozen=True, eq=False)
class SignalGroup:
    """Signals that share their times.

    Args:
        time: (n,) [s]; negative times are written as 0.
        signals: name of the entry -> (n,) values.
        texts: name of the entry -> (time or times [s], text) in the order of time.
    """

    time: Array
    signals: Mapping[str, Array]
    texts: Mapping[str, Sequence[tuple[float | Array, str]]] = field(default_factory=dict)


def encode_signals(groups: Sequence[SignalGroup], units: Mapping[str, str]) -> bytes:
    """The content of a file with groups of signals, in the order of time.

    Args:
        groups: the groups; entries of the same name are continued.
        units: name of an entry -> its unit, for the entry's metadata.
    """
    kinds: dict[str, str] = {}
    for group in groups:
        kinds |= dict.fromkeys(group.signals, "double") | dict.fromkeys(group.texts, "string")
    ids = {name: number for number, name in enumerate(kinds, start=1)}
    times: list[Numbers] = [np.zeros(0, dtype=np.int64)]  # [µs] of the records
    records: list[bytes] = []
    for group in groups:
        parts: list[tuple[str, float | Array, Array | bytes]] = [
            (name, group.time, values) for name, values in group.signals.items()
        ]
        parts += [
            (name, time, text.encode()) for name, some in group.texts.items() for time, text in some
        ]
        for name, time, values in parts:
            times.append(_convert_to_microseconds(np.atleast_1d(time)))
            records += pack_records(ids[name], times[-1], values)
    every = np.concatenate(times)
    order = np.argsort(every, kind="stable").tolist()
    begin = int(every[order[0]]) if order else 0
    entries = (
        Start(number, name, kinds[name], units.get(name, "")) for name, number in ids.items()
    )
    starts = (pack_record(0, begin, make_start_payload(entry)) for entry in entries)
    return b"".join((FILE_HEADER, *starts, *map(records.__getitem__, order)))


def _convert_to_microseconds(time: Array) -> Numbers:
    return np.maximum(np.rint(SECOND * time), 0.0).astype(np.int64)


def write_signals(groups: Sequence[SignalGroup], path: Path, *, units: Mapping[str, str]) -> None:
    """Write groups of signals as one file, in the order of time.

    If that fails, an existing file stays as it was.

    Args:
        groups: the groups; entries of the same name are continued.
        path: the file, ending in .wpilog.
        units: name of an entry -> its unit, for the entry's metadata.

    Raises:
        BadRequest: the name does not end in .wpilog, or the file cannot be written.
    """
    if path.suffix.lower() != ".wpilog":
        raise BadRequest(
            f"no WPILOG ends in {path.suffix or 'nothing'!r}",
            where=str(path),
            advice="End its name in .wpilog.",
        )
    with refuse_os_errors("cannot be written", path, advice=ADVICE):
        write_atomically(path, encode_signals(groups, units))


class SignalRecorder:
    """A WPILOG file to which values are appended.

    Args:
        path: the file, which must not exist.

    Raises:
        BadRequest: the file exists, or cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._numbers: dict[tuple[str, str], int] = {}
        with refuse_os_errors("cannot be written", path, advice=ADVICE):
            self._stream = path.open("xb")
        self._stream.write(FILE_HEADER)

    def record(
        self, name: str, kind: str, time: int, value: float | str, *, metadata: str = ""
    ) -> None:
        """Add one value of a signal.

        Args:
            name: name of the entry, which starts with its first value.
            kind: type of the entry: ``string``, or one of ``PACKING``.
            time: time of the value [µs].
            value: the value.
            metadata: metadata of the entry.
        """
        if (name, kind) not in self._numbers:
            self._numbers[name, kind] = number = len(self._numbers) + 1
            start = make_start_payload(Start(number, name, kind, metadata))
            self._stream.write(pack_record(0, time, start))
        if isinstance(value, str):
            payload = value.encode("utf-8", "replace")
        else:
            payload = struct.pack(PACKING[kind], value)
        self._stream.write(pack_record(self._numbers[name, kind], time, payload))

    def flush(self) -> None:
        """Write the values so far to the file, so that others can read them."""
        self._stream.flush()

    def close(self) -> None:
        """Write buffered values and close the file."""
        self._stream.close()
