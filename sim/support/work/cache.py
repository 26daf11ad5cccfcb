"""The user's cache: files that can be made again."""

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import platformdirs

from sim.support.atomic_file import write_atomically

CACHE = "SYSID_CACHE"  # environment variable: another folder


def find_cache_folder() -> Path:
    """The folder of the user's cache, which may not be there yet."""
    asked = os.environ.get(CACHE)
    return Path(asked or platformdirs.user_cache_dir("sysid-course", appauthor=False))


def read_cached(path: Path) -> bytes | None:
    """Read a cached file; None where there is none, or it cannot be read."""
    try:
        return path.read_bytes()
    except OSError:
        return None


def write_cached(path: Path, content: bytes) -> None:
    """Write a cached file atomically: a reader sees its old content or all of the new.

    Raises:
        OSError: there is no place for it.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, content)


def select_older(paths: Iterable[Path], *, than: int) -> list[Path]:
    """All but the ``than`` newest files, without those that another process removed."""
    ages = []
    for path in paths:
        with suppress(OSError):
            ages.append((path.stat().st_mtime_ns, path))
    return [path for _, path in sorted(ages)[: max(len(ages) - than, 0)]]


def remove_files(paths: Iterable[Path]) -> None:
    """Remove files, but for those that another process uses."""
    for path in paths:
        with suppress(OSError):
            path.unlink()
