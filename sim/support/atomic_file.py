"""Atomic writing of files, and files and folders that only their owner may read."""

import os
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

# Permissions of a new file; the system's umask applies to the second
OWNER_ONLY, USUAL = 0o600, 0o666
OWNER_ONLY_FOLDER = 0o700
# Number and pause [s] of tries: Windows cannot replace a file while a program reads it
TRIES, PAUSE = 20, 0.05
# Pattern of the names of temporary files: a program that is killed can leave one
PARTS = f".{'[0-9a-f]' * 32}.part.*"


def write_atomically(path: Path, content: str | bytes, *, private: bool = False) -> None:
    """Write a file so that a reader finds the old content or all of the new.

    The new content is on the disk before it replaces the old.

    Args:
        path: path of the file; its folder must exist.
        content: the new content; a text is written in UTF-8, with its own line endings.
        private: whether only the owner may read it, where a system recognizes owners (POSIX).

    Raises:
        OSError: the file cannot be written; no partial file remains.
    """
    raw = content.encode("utf-8") if isinstance(content, str) else content
    write_pieces_atomically(path, (raw,), private=private)


def write_pieces_atomically(path: Path, pieces: Iterable[bytes], *, private: bool = False) -> None:
    """``write_atomically`` for content that comes in pieces.

    Args:
        path: path of the file; its folder must exist.
        pieces: the content, in order.
        private: whether only the owner may read it, where a system recognizes owners (POSIX).

    Raises:
        OSError: the file cannot be written; no partial file remains.
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
    """A context with a temporary path in the same folder, for a file's new content.

    When the block ends, the new file replaces the old one; if the block fails, it is removed.

    Args:
        path: path of the file; its folder must exist.

    Raises:
        OSError: the old file cannot be replaced.
    """
    part = path.with_name(f".{uuid4().hex}.part{path.suffix}")
    try:
        yield part
        _replace_file(part, path)
    finally:
        with suppress(OSError):  # after success, there is nothing to remove
            part.unlink()


def _replace_file(part: Path, path: Path) -> None:
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
    """Create a folder, and its parents, that only its owner may read (POSIX).

    Existing folders keep their permissions.

    Raises:
        OSError: the folder cannot be created.
    """
    for folder in reversed([path, *path.parents]):
        if not folder.is_dir():
            folder.mkdir(mode=OWNER_ONLY_FOLDER, exist_ok=True)
