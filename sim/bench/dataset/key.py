"""The answer key of a dataset, sealed against unnoticed changes.

While logs are being made, what is known of each finished one stands in a journal beside the key,
a sealed line a log, so that a run that was killed can go on. The journal ends as the key.
"""

import hmac
import json
import os
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from importlib.metadata import version
from pathlib import Path
from typing import Any

from sim.bench.dataset.secret import Secret
from sim.core.errors import BadRequest
from sim.support.atomic_file import write_atomically

ENDING = ".key.json"
JOURNAL = ".part"  # a journal's name is the key's with this behind it
PRIVATE = 0o600  # for its owner only, where the system knows such a thing
SEAL = "seal"

Entry = Mapping[str, Any]


def default_key_path(folder: Path) -> Path:
    """Where the key of a dataset lies if nobody says: beside its folder, not in it."""
    folder = Path(os.path.abspath(folder))  # noqa: PTH100 - as it is called, not where it leads
    return folder.with_name(f"{folder.name or 'dataset'}{ENDING}")


def entries_by_file(entries: Iterable[Entry]) -> dict[str, Entry]:
    """The entry of each file."""
    return {file: entry for entry in entries for file in entry["files"]}


def read_key(path: Path, *, secret: Secret) -> tuple[Entry, ...]:
    """The entries of a key, once its seal is found whole; none if there is no key.

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
            "the seal of the key is broken: it was changed, or made with another secret or seed",
            where=str(path),
            advice="Put both back as they were, or name another folder with -o.",
        )
    return entries


def write_key(path: Path, entries: Iterable[Entry], *, dataset: str, secret: Secret) -> None:
    """Write a key, whole or not at all.

    Raises:
        OSError: it cannot be written.
    """
    content: dict[str, Any] = {
        "dataset": dataset,
        "made_with": f"sysid-course {version('sysid-course')}",
        "sealed_with": "secret" if secret.hidden else "seed",
        "logs": sorted(entries, key=lambda entry: str(min(entry["files"]))),
    }
    content[SEAL] = secret.seal(_plain(content))
    text = json.dumps(content, ensure_ascii=False, allow_nan=False, indent=1)
    write_atomically(path, f"{text}\n", private=True)


class Journal:
    """What is known of the logs that are finished, until the key is written.

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
        """The entries so far; a line that is torn or not sealed with this secret is passed over.

        Raises:
            OSError: it cannot be read.
        """
        try:
            lines = self.path.read_bytes().split(b"\n")
        except FileNotFoundError:
            return ()
        found = []
        for line in lines:
            seal, _, content = line.partition(b" ")
            mine = self.secret.seal(content).encode()
            if hmac.compare_digest(seal, mine):
                found.append(json.loads(content))
        return tuple(found)

    def start(self, entries: Iterable[Entry]) -> None:
        """Start with what is known already; what else was in it goes.

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
        """Keep what is known of one more log.

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
        """Stop writing; what is in it stays for the next run, and an empty one goes."""
        if self._stream is not None:
            self._stream.close()
            if not self.path.stat().st_size:
                self.remove()

    def remove(self) -> None:
        """Remove it: everything in it stands in the key."""
        with suppress(OSError):  # one that stays is passed over, or read again: both are right
            self.path.unlink()

    def _line(self, entry: Entry) -> bytes:
        content = _plain(entry)
        return self.secret.seal(content).encode() + b" " + content + b"\n"


_ANEW = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
_ENCODE: Callable[[Any], str] = json.JSONEncoder(
    sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
).encode


def _plain(content: Any) -> bytes:  # noqa: ANN401 - whatever JSON can hold
    """The one form in which a content is sealed."""
    return _ENCODE(content).encode()
