"""The answer key of a dataset, sealed against unnoticed changes.

While logs are being made, the entry of each finished log is a sealed line of a journal beside the
key, so that an interrupted run can be continued. At the end the journal becomes the key.
"""

import errno
import hmac
import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from importlib.metadata import version
from pathlib import Path
from typing import Any

from sim.bench.dataset.secret import Secret
from sim.core.errors import BadRequest
from sim.support.atomic_file import write_pieces_atomically

ENDING = ".key.json"
JOURNAL = ".part"  # suffix of a journal's name, after the key's
PRIVATE = 0o600  # for its owner only, if the system supports it
SEAL = "seal"

Entry = Mapping[str, Any]


def choose_key_path(folder: Path) -> Path:
    """The default path of a dataset's key: beside its folder, not in it."""
    folder = Path(os.path.abspath(folder))  # noqa: PTH100 - without following links
    return folder.with_name(f"{folder.name or 'dataset'}{ENDING}")


def index_by_file(entries: Iterable[Entry]) -> dict[str, Entry]:
    """File -> its entry in the key."""
    return {file: entry for entry in entries for file in entry["files"]}


def read_key(path: Path, *, secret: Secret) -> tuple[Entry, ...]:
    """The entries of a key, after its seal was verified; none if there is no key.

    Raises:
        BadRequest: it cannot be read, or its seal is not of this secret and content.
    """
    try:
        content = json.loads(path.read_bytes())
        sealed = {name: value for name, value in content.items() if name != SEAL}
        whole = hmac.compare_digest(str(content.get(SEAL)), secret.seal(_plain(sealed)))
        entries = tuple(content["logs"]) if whole else ()
    except FileNotFoundError:
        return ()
    except OSError as error:
        raise BadRequest(
            f"the key cannot be read ({error.strerror})",
            where=str(path),
            advice="Allow reading it, or name another with --key.",
        ) from None
    except (ValueError, AttributeError, KeyError, TypeError):
        whole, entries = False, ()
    if not whole:
        raise BadRequest(
            "the seal does not fit this key. Somebody changed the key, or it was made with another "
            "secret or seed",
            where=str(path),
            advice="Put both back as they were, or name another folder with -o.",
        )
    return entries


def write_key(path: Path, journal: "Journal", *, dataset: str, secret: Secret) -> int:
    """Write a key atomically from a journal that holds all its logs.

    One entry at a time is in memory, so a dataset may have any number of logs.

    Args:
        path: path of the key.
        journal: journal with the entry of each log.
        dataset: name of the dataset.
        secret: secret with which the key is sealed.

    Returns:
        Number of logs in the key.

    Raises:
        OSError: it cannot be written.
    """
    places = journal.locate_entries()
    head = {
        "dataset": dataset,
        "made_with": f"sysid-course {version('sysid-course')}",
        "sealed_with": "secret" if secret.hidden else "seed",
    }
    seal = secret.seal_pieces(_plain_pieces(head, journal.read_entries_at(places)))
    write_pieces_atomically(
        path, _text_pieces(head, journal.read_entries_at(places), seal), private=True
    )
    return len(places)


def _plain_pieces(head: Mapping[str, str], entries: Iterable[Entry]) -> Iterator[bytes]:
    """The content that is sealed, in pieces: canonical JSON with sorted keys."""
    names = sorted((*head, "logs"))
    for number, name in enumerate(names):
        yield b"{" if number == 0 else b","
        yield _plain(name) + b":"
        if name != "logs":
            yield _plain(head[name])
            continue
        for index, entry in enumerate(entries):
            yield (b"," if index else b"[") + _plain(entry)
        yield b"]"
    yield b"}"


def _text_pieces(head: Mapping[str, str], entries: Iterable[Entry], seal: str) -> Iterator[bytes]:
    """The file in pieces: indented JSON with the seal at its end."""
    opening = json.dumps(head, ensure_ascii=False, indent=1).removesuffix("\n}")
    yield f'{opening},\n "logs": ['.encode()
    for index, entry in enumerate(entries):
        text = json.dumps(entry, ensure_ascii=False, allow_nan=False, indent=1)
        yield ("," * (index > 0) + "\n" + text).replace("\n", "\n  ").encode()
    yield f'\n ],\n "{SEAL}": {json.dumps(seal)}\n}}\n'.encode()


class Journal:
    """A journal of finished logs, from which the key is written at the end.

    Args:
        key: path of the key.
        secret: secret with which each line is sealed.
    """

    def __init__(self, key: Path, *, secret: Secret) -> None:
        self.path = key.with_name(key.name + JOURNAL)
        self.secret = secret
        self._end = 0
        self._stream: Any = None

    def read(self) -> tuple[Entry, ...]:
        """The entries so far, without lines that are incomplete or not sealed with this secret.

        Raises:
            OSError: it cannot be read.
        """
        try:
            lines = self.path.read_bytes().split(b"\n")
        except FileNotFoundError:
            return ()
        return tuple(entry for line in lines if (entry := self._entry(line)) is not None)

    def locate_entries(self) -> list[tuple[int, int]]:
        """Offset and length of each sealed line in the journal, in the order of their files.

        Raises:
            OSError: it cannot be read.
        """
        found = []
        with self.path.open("rb") as stream:
            begin = 0
            for line in stream:
                entry = self._entry(line.rstrip(b"\n"))
                if entry is not None:
                    found.append((str(min(entry["files"])), begin, len(line)))
                begin += len(line)
        return [(begin, length) for _, begin, length in sorted(found)]

    def read_entries_at(self, places: Iterable[tuple[int, int]]) -> Iterator[Entry]:
        """Read the entries at some offsets, one after another.

        Raises:
            OSError: it cannot be read, or was changed in the meantime.
        """
        with self.path.open("rb") as stream:
            for begin, length in places:
                stream.seek(begin)
                entry = self._entry(stream.read(length).rstrip(b"\n"))
                if entry is None:
                    raise OSError(errno.EIO, "it was changed while it was read")
                yield entry

    def _entry(self, line: bytes) -> Entry | None:
        """The entry in a line; None if it is incomplete or not sealed with this secret."""
        seal, _, content = line.partition(b" ")
        if not hmac.compare_digest(seal, self.secret.seal(content).encode()):
            return None
        entry: Entry = json.loads(content)
        return entry

    def start(self, entries: Iterable[Entry]) -> None:
        """Start a new journal with entries that are known already.

        Raises:
            OSError: it cannot be written.
        """
        part = self.path.with_name(f".{self.path.name}.new")
        try:
            with os.fdopen(os.open(part, _ANEW, PRIVATE), "wb") as stream:
                stream.writelines(map(self._line, entries))
            part.replace(self.path)
        finally:
            with suppress(OSError):  # it exists only after an error
                part.unlink()
        self._stream = self.path.open("ab")

    def add(self, entry: Entry) -> None:
        """Append the entry of one more log.

        Raises:
            OSError: the disk is full, for example; then the journal is as before.
        """
        before = self._stream.tell()
        try:
            self._stream.write(self._line(entry))
            self._stream.flush()
        except OSError:
            with suppress(OSError):  # it fails again with the rest of the buffer
                self._stream.close()
            os.truncate(self.path, before)
            raise

    def close(self) -> None:
        """Close the journal; it stays for the next run unless it is empty."""
        if self._stream is not None:
            self._stream.close()
            if not self.path.stat().st_size:
                self.remove()

    def remove(self) -> None:
        """Delete the journal, whose entries are in the key now."""
        with suppress(OSError):  # a journal that remains does no harm
            self.path.unlink()

    def _line(self, entry: Entry) -> bytes:
        """The sealed line of an entry."""
        content = json.dumps(entry, ensure_ascii=False, allow_nan=False).encode()
        return self.secret.seal(content).encode() + b" " + content + b"\n"


_ANEW = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
_ENCODE: Callable[[Any], str] = json.JSONEncoder(
    sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
).encode


def _plain(content: Any) -> bytes:  # noqa: ANN401 - any JSON value
    """A content as canonical JSON, which is sealed."""
    return _ENCODE(content).encode()
