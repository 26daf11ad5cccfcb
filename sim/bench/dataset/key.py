"""The answer key of a dataset, sealed against unnoticed changes.

While logs are being made, what is known of each finished one stands in a journal beside the key,
a sealed line a log, so that a run that was killed can go on. The journal ends as the key.
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
JOURNAL = ".part"  # a journal's name is the key's with this behind it
PRIVATE = 0o600  # for its owner only, where the system recognizes such a thing
SEAL = "seal"

Entry = Mapping[str, Any]


def choose_key_path(folder: Path) -> Path:
    """The default path of a dataset's key: beside its folder, not in it."""
    folder = Path(os.path.abspath(folder))  # noqa: PTH100 - as it is called, not where it leads
    return folder.with_name(f"{folder.name or 'dataset'}{ENDING}")


def index_by_file(entries: Iterable[Entry]) -> dict[str, Entry]:
    """Map of each file to its entry in the key."""
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
        path: of the key.
        journal: what is known of each log.
        dataset: its name.
        secret: what the key is sealed with.

    Returns:
        How many logs the key has.

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
    """What is sealed, in pieces: the one form of the whole content, its keys in order."""
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
    """The file in pieces: JSON that a person can read, the seal at its end."""
    opening = json.dumps(head, ensure_ascii=False, indent=1).removesuffix("\n}")
    yield f'{opening},\n "logs": ['.encode()
    for index, entry in enumerate(entries):
        text = json.dumps(entry, ensure_ascii=False, allow_nan=False, indent=1)
        yield ("," * (index > 0) + "\n" + text).replace("\n", "\n  ").encode()
    yield f'\n ],\n "{SEAL}": {json.dumps(seal)}\n}}\n'.encode()


class Journal:
    """A journal of finished logs, from which the key is written at the end.

    Args:
        key: where the key will be.
        secret: what each line is sealed with.
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
            OSError: it cannot be read, or was changed meanwhile.
        """
        with self.path.open("rb") as stream:
            for begin, length in places:
                stream.seek(begin)
                entry = self._entry(stream.read(length).rstrip(b"\n"))
                if entry is None:
                    raise OSError(errno.EIO, "it was changed while it was read")
                yield entry

    def _entry(self, line: bytes) -> Entry | None:
        """What a line says; None if it is torn or not sealed with this secret."""
        seal, _, content = line.partition(b" ")
        if not hmac.compare_digest(seal, self.secret.seal(content).encode()):
            return None
        entry: Entry = json.loads(content)
        return entry

    def start(self, entries: Iterable[Entry]) -> None:
        """Start the journal anew with entries that are known already.

        Raises:
            OSError: it cannot be written.
        """
        part = self.path.with_name(f".{self.path.name}.new")
        try:
            with os.fdopen(os.open(part, _ANEW, PRIVATE), "wb") as stream:
                stream.writelines(map(self._line, entries))
            part.replace(self.path)
        finally:
            with suppress(OSError):  # it is there only if something went wrong
                part.unlink()
        self._stream = self.path.open("ab")

    def add(self, entry: Entry) -> None:
        """Append the entry of one more log.

        Raises:
            OSError: the disk is full, for example; then nothing of it stays.
        """
        before = self._stream.tell()
        try:
            self._stream.write(self._line(entry))
            self._stream.flush()
        except OSError:
            with suppress(OSError):  # it fails again at what is still to be written
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
        """Delete the journal, whose entries are in the key by now."""
        with suppress(OSError):  # one that stays is passed over, or read again: both are right
            self.path.unlink()

    def _line(self, entry: Entry) -> bytes:
        content = json.dumps(entry, ensure_ascii=False, allow_nan=False).encode()
        return self.secret.seal(content).encode() + b" " + content + b"\n"


_ANEW = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
_ENCODE: Callable[[Any], str] = json.JSONEncoder(
    sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
).encode


def _plain(content: Any) -> bytes:  # noqa: ANN401 - whatever JSON can hold
    """The one form in which a content is sealed."""
    return _ENCODE(content).encode()
