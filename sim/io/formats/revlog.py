"""REVLOG: the format of REV's StatusLogger, with periodic CAN frames of SPARK motor controllers.

A file is a sequence of records: a byte with the lengths of the next two numbers, the kind of the
record, the length of its payload, the payload. A periodic frame has 16 bytes: time [ms], CAN id,
data. Sources: github.com/REVrobotics/node-revlog-converter (records) and
github.com/REVrobotics/can-specs (frames ``STATUS_0`` and ``STATUS_2``, version 2.0.2).

The format does not name tests, so a file is one test, named by the file name.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import UnreadableFile
from sim.core.log import Log
from sim.io.entries import assemble_logs
from sim.io.entries.entry import Entry
from sim.io.format import ReadOptions

SUFFIXES = (".revlog",)
FIRMWARE, PERIODIC = 1, 2  # kinds of records
SIZES = {FIRMWARE: 10, PERIODIC: 16}  # [bytes] of one frame in a payload
REV, SPARK = 5, 2  # manufacturer and kind of device in a CAN id
DEVICES = (SPARK, 7, 12)  # kinds of devices that REV logs: SPARK, encoder, servo hub
STATUS_CLASS = 46  # API class of the periodic frames of a SPARK
STATUS_0, STATUS_2 = 0, 2  # API indices: voltage and current; the motor's own encoder
DUTY_STEP, VOLT_STEP, AMPERE_STEP = 3.082369457075716e-5, 7.3260073260073e-3, 3.66300366300366e-2
FRAME = np.dtype([("time", "<u4"), ("id", "<u4"), ("data", "<u8")])
LOW_12 = np.uint64(0xFFF)


class _Frames(NamedTuple):
    """The periodic frames of a file, and the number of bytes after the last whole record."""

    frames: NDArray[np.void]
    unread: int


def recognizes(head: bytes) -> bool:
    """Whether a file starts with a record of a REV device."""
    try:
        kind, payload, _ = next(_follow_records(head, whole=False))
    except StopIteration:
        return False
    at = {FIRMWARE: 0, PERIODIC: 4}.get(kind)
    if at is None or len(payload) < at + 4:
        return False
    number = int.from_bytes(payload[at : at + 4], "little")
    return number >> 29 == 0 and number >> 16 & 0xFF == REV and number >> 24 & 0x1F in DEVICES


def entries(path: Path) -> list[Entry]:
    """The signals of all SPARKs of a file.

    Raises:
        UnreadableFile: the file holds no periodic frame.
    """
    return _make_entries(_load_frames(path).frames, default_units=True)


def read(path: Path, options: ReadOptions) -> dict[str, Log]:
    """Read the test of a file, for each motor if asked; the file name names the test.

    Args:
        path: the file.
        options: the user's choices: units, motor, and the names of entries.

    Raises:
        Refusal: the file holds no periodic frame, or its name names no test; or as
            ``assemble_logs``.
    """
    found = _load_frames(path)
    made = _make_entries(found.frames, default_units=options.units is None)
    logs, _ = assemble_logs(made, options=options, where=str(path))
    return {name: log.add_doubts(*_make_doubts(found, options, path)) for name, log in logs.items()}


def _follow_records(content: bytes, *, whole: bool = True) -> Iterator[tuple[int, bytes, int]]:
    """Kind, payload and end of each record; without ``whole`` the last payload may be cut off."""
    at = 0
    while at < len(content) and content[at] < 16:  # the upper four bits are unused  # noqa: PLR2004 - 2**4
        lengths = (content[at] & 3) + 1, (content[at] >> 2 & 3) + 1
        begin = at + 1 + sum(lengths)
        if begin > len(content):
            return
        kind = int.from_bytes(content[at + 1 : at + 1 + lengths[0]], "little")
        end = begin + int.from_bytes(content[at + 1 + lengths[0] : begin], "little")
        if whole and end > len(content):
            return
        yield kind, content[begin:end], end
        at = end


def _load_frames(path: Path) -> _Frames:
    """The periodic frames of a file.

    Raises:
        UnreadableFile: there are no periodic frames.
    """
    content = path.read_bytes()
    pieces, end = [], 0
    for kind, payload, after in _follow_records(content):
        end = after
        if kind == PERIODIC:
            pieces.append(payload[: len(payload) // FRAME.itemsize * FRAME.itemsize])
    frames = np.frombuffer(b"".join(pieces), dtype=FRAME)
    if not frames.size:
        raise UnreadableFile(
            "no periodic frame of a SPARK is in it",
            where=str(path),
            advice="Copy it from the robot again, or open it with REV's revlog-converter to see "
            "what it holds.",
        )
    return _Frames(frames, len(content) - end)


def _make_entries(frames: NDArray[np.void], *, default_units: bool) -> list[Entry]:
    """Voltage, current, position and velocity of each SPARK.

    Args:
        frames: the frames of all devices.
        default_units: whether they are in rotations and RPM, without conversion factors.
    """
    number = frames["id"]
    ours = (number >> 16 & 0xFF == REV) & (number >> 24 & 0x1F == SPARK)
    ours &= number >> 10 & 0x3F == STATUS_CLASS
    made: list[Entry] = []
    for device in np.unique(number[ours] & 0x3F).tolist():
        own = frames[ours & (number & 0x3F == device)]
        own = own[np.argsort(own["time"], kind="stable")]
        index = own["id"] >> 6 & 0xF
        made += _decode_frames(
            device, own[index == STATUS_0], own[index == STATUS_2], default_units=default_units
        )
    return made


def _decode_frames(
    device: int, general: NDArray[np.void], motion: NDArray[np.void], *, default_units: bool
) -> Iterator[Entry]:
    """The signals in the frames ``STATUS_0`` and ``STATUS_2`` of a SPARK."""

    def make_entry(name: str, metadata: str, of: NDArray[np.void], values: ArrayLike) -> Entry:
        time = of["time"].astype(np.int64) * 1000
        numbers = np.asarray(values, dtype=np.float64)
        return Entry(f"REV/Spark-{device}/{name}", "double", metadata, time, numbers)

    data = general["data"]
    duty = (data & np.uint64(0xFFFF)).astype(np.uint16).view(np.int16) * DUTY_STEP
    yield make_entry("APPLIED_OUTPUT", "", general, duty)
    yield make_entry("VOLTAGE", "V", general, (data >> np.uint64(16) & LOW_12) * VOLT_STEP)
    yield make_entry("CURRENT", "A", general, (data >> np.uint64(28) & LOW_12) * AMPERE_STEP)
    floats = motion["data"].copy().view("<f4").reshape(-1, 2)
    units = ("rpm", "rotations") if default_units else ("", "")
    yield make_entry("PRIMARY_ENCODER_VELOCITY", units[0], motion, floats[:, 0])
    yield make_entry("PRIMARY_ENCODER_POSITION", units[1], motion, floats[:, 1])


def _make_doubts(found: _Frames, options: ReadOptions, path: Path) -> Iterator[Doubt]:
    """Doubts about assumed units, and about bytes that were not read."""
    if options.units is None:
        yield Doubt(
            "conversion-factor",
            f"{path}: REV's log does not contain its units, so rotations and RPM were assumed. "
            "Conversion factors in your program change them, and the velocity is then per second.",
            action=Action("units"),
        )
    if found.unread:
        yield Doubt(
            "truncated",
            f"{path}: the file ends too soon: its last {found.unread} bytes are not a whole "
            "record, so they were left out. Copy the file from the robot again.",
        )
