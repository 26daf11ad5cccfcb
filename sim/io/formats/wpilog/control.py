"""Control records of a WPILOG file: they start an entry, finish it, or change its metadata.

start    = 0, entry id (4), name, type, metadata      each text after its length (4)
finish   = 1, entry id (4)
metadata = 2, entry id (4), metadata
"""

import struct
from dataclasses import dataclass
from typing import TypeAlias

START, FINISH, METADATA = 0, 1, 2
_HEAD = struct.Struct("<BI")  # type of control record, entry id
_LENGTH = struct.Struct("<I")
_TEXTS = {START: 3, FINISH: 0, METADATA: 1}


@dataclass(frozen=True)
class Start:
    """Control record that starts an entry with an id."""

    id: int
    name: str
    type: str
    metadata: str


@dataclass(frozen=True)
class Finish:
    """Control record that finishes an entry, so that its id can be used again."""

    id: int


@dataclass(frozen=True)
class Metadata:
    """Control record that changes the metadata of an entry."""

    id: int
    metadata: str


Control: TypeAlias = Start | Finish | Metadata


def parse_control_record(payload: bytes) -> Control | None:
    """Parse a control record; None if it is malformed."""
    if len(payload) < _HEAD.size:
        return None
    which, number = _HEAD.unpack_from(payload)
    texts = _texts(payload[_HEAD.size :])
    if number == 0 or texts is None or len(texts) != _TEXTS.get(which):
        return None
    if which == START:
        return Start(number, *texts)
    return Metadata(number, *texts) if which == METADATA else Finish(number)


def make_start_payload(entry: Start) -> bytes:
    """The payload of the control record that starts an entry."""
    texts = (text.encode("utf-8", "replace") for text in (entry.name, entry.type, entry.metadata))
    packed = b"".join(_LENGTH.pack(len(text)) + text for text in texts)
    return _HEAD.pack(START, entry.id) + packed


def _texts(rest: bytes) -> list[str] | None:
    """The texts that fill the rest of a record exactly; None if they do not."""
    found = []
    at = 0
    while at < len(rest):
        if at + _LENGTH.size > len(rest):
            return None
        (length,) = _LENGTH.unpack_from(rest, at)
        at += _LENGTH.size + length
        if at > len(rest):
            return None
        found.append(rest[at - length : at].decode("utf-8", "replace"))
    return found
