"""The user's cache: files that can be computed again."""

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import platformdirs

from sim.support.atomic_file import write_atomically

CACHE = "SYSID_CACHE"  # environment variable with another folder


def find_cache_folder() -> Path:
    """The folder of the user's cache, which may not exist yet."""
    asked = os.environ.get(CACHE)
    return Path(asked or platformdirs.user_cache_dir("sysid-course", appauthor=False))


def read_cached(path: Path) -> bytes | None:
    """The content of a cached file; None if it does not exist or cannot be read."""
    try:
        return path.read_bytes()
    except OSError:
        return None


def write_cached(path: Path, content: bytes) -> None:
    """Write a cached file atomically: a reader sees its old content or all of the new.

    Raises:
        OSError: the file cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, content)


def select_older(paths: Iterable[Path], *, than: int) -> list[Path]:
    """All but the ``than`` newest files, oldest first; files that no longer exist are left out."""
    ages = []
    for path in paths:
        with suppress(OSError):
            ages.append((path.stat().st_mtime_ns, path))
    return [path for _, path in sorted(ages)[: max(len(ages) - than, 0)]]


def remove_files(paths: Iterable[Path]) -> None:
    """Remove files, except those that another process uses."""
    for path in paths:
        with suppress(OSError):
            path.unlink()
