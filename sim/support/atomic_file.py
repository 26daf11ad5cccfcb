"""Files written whole or not at all, and files that only their owner may read."""

import os
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

OWNER_ONLY, USUAL = 0o600, 0o666  # rights of a new file; the system takes its mask off the second
OWNER_ONLY_FOLDER = 0o700
TRIES, PAUSE = 20, 0.05  # [s] Windows refuses to replace a file while another program reads it


def write_atomically(path: Path, content: str | bytes, *, private: bool = False) -> None:
    """Write a file so that whoever reads it finds the old content or the new, never a part.

    The new content is on the disk before it takes the place of the old.

    Args:
        path: of the file; its folder has to be there.
        content: a text is written in UTF-8, with line ends as they are.
        private: whether only the owner may read it, where a system recognizes owners (POSIX).

    Raises:
        OSError: it cannot be written; nothing is left behind.
    """
    raw = content.encode("utf-8") if isinstance(content, str) else content
    write_pieces_atomically(path, (raw,), private=private)


def write_pieces_atomically(path: Path, pieces: Iterable[bytes], *, private: bool = False) -> None:
    """``write_atomically`` for content that comes in pieces.

    Args:
        path: of the file; its folder has to be there.
        pieces: one behind the other.
        private: whether only the owner may read it, where a system recognizes owners (POSIX).

    Raises:
        OSError: it cannot be written; nothing is left behind.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    rights = OWNER_ONLY if private else USUAL
    with (
        atomic_path(path) as part,
        os.fdopen(os.open(part, flags, rights), "wb") as stream,
    ):
        stream.writelines(pieces)
        stream.flush()
        os.fsync(stream.fileno())


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """A path in the same folder, with the same suffix, for a file's new content.

    The new file takes the old one's place when the block ends, and is removed if the block fails.

    Args:
        path: of the file; its folder has to be there.

    Raises:
        OSError: the old file cannot be replaced.
    """
    part = path.with_name(f".{uuid4().hex}.part{path.suffix}")
    try:
        yield part
        _replace(part, path)
    finally:
        with suppress(OSError):  # nothing is left to remove when all went well
            part.unlink()


def _replace(part: Path, path: Path) -> None:
    for left in reversed(range(TRIES)):
        try:
            part.replace(path)
        except PermissionError:
            if os.name != "nt" or not left:
                raise
            time.sleep(PAUSE)
        else:
            return


def make_private_folder(path: Path) -> None:
    """Make a folder, and those above it, that only its owner may look into (POSIX).

    Folders that are there already keep their rights.

    Raises:
        OSError: it cannot be made.
    """
    for folder in reversed([path, *path.parents]):
        if not folder.is_dir():
            folder.mkdir(mode=OWNER_ONLY_FOLDER, exist_ok=True)
