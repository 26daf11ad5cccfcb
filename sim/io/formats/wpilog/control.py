"""Control records of a WPILOG file: they start an entry, finish it, or change its metadata.

start    = 0, entry id (4), name, type, metadata      each text after its length (4)
finish   = 1, entry id (4)
metadata = 2, entry id (4), metadata
"""

import struct
from typing import NamedTuple

START, FINISH, METADATA = 0, 1, 2
TEXTS = {START: 3, FINISH: 0, METADATA: 1}
_HEAD = struct.Struct("<BI")  # kind of control record, entry id
_LENGTH = struct.Struct("<I")


class Start(NamedTuple):
    """Control record that starts an entry with an id."""

    id: int
    name: str
    type: str
    metadata: str


def parse_control_record(payload: bytes) -> tuple[int, int, list[str]] | None:
    """Kind, entry id and texts of a control record; None if it is malformed."""
    if len(payload) < _HEAD.size:
        return None
    which, number = _HEAD.unpack_from(payload)
    texts, at = [], _HEAD.size
    while at < len(payload):
        length = int.from_bytes(payload[at : at + _LENGTH.size], "little")
        at += _LENGTH.size + length
        if at > len(payload):
            return None
        texts.append(payload[at - length : at].decode("utf-8", "replace"))
    return (which, number, texts) if number and len(texts) == TEXTS.get(which) else None


def make_start_payload(entry: Start) -> bytes:
    """The payload of the control record that starts an entry."""
    texts = (text.encode("utf-8", "replace") for text in (entry.name, entry.type, entry.metadata))
    packed = b"".join(_LENGTH.pack(len(text)) + text for text in texts)
    return _HEAD.pack(START, entry.id) + packed
