"""Where tests come from while they are recorded: files that grow, one after another."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from sim.core.errors import UnreadableFile
from sim.io.entries.state import FOREVER, RunInterval
from sim.io.formats.wpilog import SUFFIXES
from sim.io.formats.wpilog.growing import GrowingLog

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sim.core.log import Log

SECOND = 1e6  # [µs]


class Recording:
    """One file, from the start of a robot program or of a connection to its end.

    Args:
        path: of the file.
        state: the entry that names the tests; None looks for it.
    """

    def __init__(self, path: Path, *, state: str | None = None) -> None:
        self.growing = GrowingLog(path, state=state)
        self.finished: tuple[RunInterval, ...] = ()  # its tests that have ended ...
        self.logs: Mapping[str, Log] = {}  # ... and what was read of them, motor by motor

    @property
    def path(self) -> Path:
        """The path of the file."""
        return self.growing.path


class Source(Protocol):
    """A source of recordings that are still growing."""

    def poll(self) -> Sequence[Recording]:
        """All recordings so far, the last of which may still grow."""

    @property
    def status(self) -> str:
        """The status in a few words: what it waits for or follows."""

    def close(self) -> None:
        """Stop following."""


class FileSource:
    """A log that grows, or those that grow in a folder.

    A program of WPILib begins a file when it starts, and renames it once a Driver Station tells it
    the time, so a file is known by its number on the disk. In a folder only files count that grow
    or appear after the first look: what lies there already is of another day.

    Args:
        place: a file or a folder.
        state: the entry that names the tests; None looks for it.

    Raises:
        UnreadableFile: there is neither.
    """

    def __init__(self, place: Path, *, state: str | None = None) -> None:
        self.place, self._state = place, state
        self._recordings: list[Recording] = []
        self._known: dict[tuple[int, int], Recording] = {}
        self._sizes: dict[tuple[int, int], int] = {}
        if place.is_file():
            self._begin(place, _identify(place))
        elif place.is_dir():
            self._sizes = {key: size for _, key, size in self._list()}
        else:
            raise UnreadableFile(
                "there is no such file or folder",
                where=str(place),
                advice="Give the .wpilog that the robot is writing, or the folder it appears in.",
            )

    @property
    def status(self) -> str:
        """The status: what it waits for or follows."""
        if self._recordings:
            return f"following {self._recordings[-1].path}"
        return f"waiting for a log that grows in the folder {self.place}"

    def poll(self) -> Sequence[Recording]:
        """All recordings so far."""
        for path, key, size in self._list():
            if key in self._known:
                self._known[key].growing.path = path
            elif self._sizes.get(key, -1) != size and self._counts(path):
                self._begin(path, key)
        if self._recordings and self._recordings[-1].path.exists():
            last = self._recordings[-1]
            if last.growing.was_replaced:
                self._begin(last.path, _identify(last.path))
        return self._recordings

    def close(self) -> None:
        """Do nothing: no file is kept open."""

    def _counts(self, path: Path) -> bool:
        """Whether a file that is new to us goes on where the one before it ended."""
        return self.place.is_dir() or path == self.place

    def _begin(self, path: Path, key: tuple[int, int]) -> None:
        recording = Recording(path, state=self._state)
        self._recordings.append(recording)
        self._known[key] = recording

    def _list(self) -> list[tuple[Path, tuple[int, int], int]]:
        """The logs beside one another: path, number on the disk, and size, the oldest first."""
        folder = self.place if self.place.is_dir() else self.place.parent
        found = []
        for path in filter(_is_log, folder.iterdir()):
            try:
                told = path.stat()
            except OSError:  # it was renamed or removed since
                continue
            found.append((told.st_mtime_ns, path, (told.st_dev, told.st_ino), told.st_size))
        return [(path, key, size) for _, path, key, size in sorted(found)]


def _is_log(path: Path) -> bool:
    return path.suffix.lower() in SUFFIXES


def _identify(path: Path) -> tuple[int, int]:
    """The number of a file on its disk, which a new name does not change."""
    told = path.stat()
    return told.st_dev, told.st_ino


def split_finished_tests(
    tests: Sequence[RunInterval],
) -> tuple[tuple[RunInterval, ...], float]:
    """The tests that have ended, and when the one that runs began [s]; infinite if none runs."""
    finished = tuple(one for one in tests if one.end != FOREVER)
    running = [one.begin for one in tests if one.end == FOREVER]
    return finished, min(running) / SECOND if running else math.inf
