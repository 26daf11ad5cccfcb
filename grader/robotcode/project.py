"""The files of a learner's program: those in the folders that its packages name, and below."""

import os
from collections.abc import Iterator
from pathlib import Path

MOST_FILES = 200  # neighbours looked at; a robot program has about fifty
MOST_FOLDERS = 500  # folders walked through on the way
_BUILT = frozenset({"build", "bin", "out", "node_modules", "__pycache__", "venv", "ctre_sim"})


def list_sources(path: Path, package: str, suffix: str) -> list[Path]:
    """The sources of a program, from the top folder of a file's package down.

    Args:
        path: the file in hand, which comes first.
        package: its package; folders above it that have other names are left alone.
        suffix: ``.java``.
    """
    top = path.parent
    for part in reversed(package.split(".")):
        if not part or top.name != part:
            break
        top = top.parent
    found = [one for one in _walk(top, suffix) if one != path]
    return [path, *found[:MOST_FILES]]


def _walk(top: Path, suffix: str) -> Iterator[Path]:
    """Source files under a folder; links and built or hidden folders are left alone."""
    for visited, (folder, folders, files) in enumerate(os.walk(top)):
        folders[:] = sorted(f for f in folders if f not in _BUILT and not f.startswith("."))
        paths = (Path(folder, name) for name in sorted(files) if name.endswith(suffix))
        yield from (path for path in paths if not path.is_symlink())
        if visited == MOST_FOLDERS:
            return
