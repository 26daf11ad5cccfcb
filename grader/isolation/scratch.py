"""A temporary folder that can be removed whatever a learner's code put into it."""

import contextlib
import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """A temporary folder, removed at the end without recursion.

    Python's own removal calls itself once for each level, and stops in a folder 1,500 deep.
    """
    made = Path(tempfile.mkdtemp()).resolve()
    try:
        yield made
    finally:
        remove_tree(made)


def remove_tree(top: Path) -> None:
    """Remove a folder: each folder in it is first moved to the top, so that no path gets long.

    What cannot be removed stays; nothing is raised.
    """
    waiting, moved = [top], 0
    while waiting:
        folder = waiting.pop()
        for entry in _list_entries(folder):
            with contextlib.suppress(OSError):
                if not entry.is_dir(follow_symlinks=False):
                    os.unlink(entry.path)  # noqa: PTH108 - an entry, not a Path
                    continue
                os.chmod(entry.path, stat.S_IRWXU)  # noqa: PTH101 - the same
                moved += 1
                place = top / f".removed-{os.getpid()}-{moved}"
                os.rename(entry.path, place)  # noqa: PTH104 - the same
                waiting.append(place)
        if folder != top:
            with contextlib.suppress(OSError):
                folder.rmdir()
    with contextlib.suppress(OSError):
        top.rmdir()


def _list_entries(folder: Path) -> list["os.DirEntry[str]"]:
    try:
        with os.scandir(folder) as found:
            return list(found)
    except OSError:
        return []
