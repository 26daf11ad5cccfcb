"""Write any signals as a WPILOG file: all at once, or value by value.

When written at once, to be shown in another tool, every signal is an entry of doubles. A text, such
as the name of a test, is an entry of strings that is written when it changes.
"""

import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.io.formats.wpilog.control import Start, make_start_payload
from sim.io.formats.wpilog.records import FILE_HEADER, pack_record
from sim.support.atomic_file import write_atomically

SECOND = 1e6  # [µs]
# Type of an entry -> format of a value
PACKING = {"double": "<d", "float": "<f", "int64": "<q", "boolean": "<?"}


@dataclass(frozen=True, eq=False)
class SignalGroup:
    """Signals that share their times.

    Args:
        time: (n,) [s]; negative times are written as 0.
        signals: name of the entry -> (n,) values.
        texts: name of the entry -> (time [s], text) in the order of time.
    """

    time: Array
    signals: Mapping[str, Array]
    texts: Mapping[str, Sequence[tuple[float, str]]] = field(default_factory=dict)


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
    kinds: dict[str, str] = {}
    for group in groups:
        kinds |= dict.fromkeys(group.signals, "double") | dict.fromkeys(group.texts, "string")
    ids = {name: number for number, name in enumerate(kinds, start=1)}
    starts = [
        (0, 0, make_start_payload(Start(number, name, kinds[name], units.get(name, ""))))
        for name, number in ids.items()
    ]
    records = sorted(
        (record for group in groups for record in _list_records(group, ids)),
        key=lambda record: record[1],
    )
    try:
        write_atomically(
            path, FILE_HEADER + b"".join(pack_record(*one) for one in (*starts, *records))
        )
    except OSError as error:
        raise BadRequest(
            f"cannot be written ({error.strerror or error})",
            where=str(path),
            advice="Choose a folder that exists and that you may write to.",
        ) from None


def _list_records(group: SignalGroup, ids: Mapping[str, int]) -> Iterator[tuple[int, int, bytes]]:
    """Entry id, time [µs] and payload of each record."""
    times = [round(SECOND * time) for time in group.time.tolist()]
    for name, values in group.signals.items():
        for time, value in zip(times, values.tolist(), strict=True):
            yield ids[name], max(time, 0), struct.pack("<d", value)
    for name, changes in group.texts.items():
        for when, text in changes:
            yield ids[name], max(round(SECOND * when), 0), text.encode()


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
        try:
            self._stream = path.open("xb")
        except OSError as error:
            raise BadRequest(
                f"cannot be written ({error.strerror or error})",
                where=str(path),
                advice="Choose a folder that exists and that you may write to.",
            ) from None
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
