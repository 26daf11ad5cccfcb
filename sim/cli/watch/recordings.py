"""Sources of logs that are still being recorded: files that grow, one after another."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from sim.core.errors import UnreadableFile
from sim.io.entries.state import NO_END, RunInterval
from sim.io.formats.wpilog import SUFFIXES
from sim.io.formats.wpilog.growing import GrowingLog

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sim.core.log import Log

SECOND = 1e6  # [µs]


class Recording:
    """One file that grows, from the start of a robot program or of a connection to its end.

    Args:
        path: path of the file.
        state: the entry that names the tests; None finds it by name.
    """

    def __init__(self, path: Path, *, state: str | None = None) -> None:
        self.growing = GrowingLog(path, state=state)
        self.finished: tuple[RunInterval, ...] = ()  # the tests that have ended
        self.logs: Mapping[str, Log] = {}  # the log of each motor with these tests

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
    """A log that grows, or all logs that grow in a folder.

    A WPILib program creates a file when it starts, and renames it once a Driver Station sends the
    time, so a file is identified by its device and inode number. In a folder, only files that
    grow or appear after the start are followed; the others are from an earlier day.

    Args:
        place: a file or a folder.
        state: the entry that names the tests; None finds it by name.

    Raises:
        UnreadableFile: there is no such file or folder.
    """

    def __init__(self, place: Path, *, state: str | None = None) -> None:
        self.place, self._state = place, state
        self._recordings: list[Recording] = []
        self._known: dict[tuple[int, int], Recording] = {}
        self._sizes: dict[tuple[int, int], int] = {}
        if place.is_file():
            self._begin_recording(place, _identify_file(place))
        elif place.is_dir():
            self._sizes = {key: size for _, key, size in self._list_logs()}
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
        for path, key, size in self._list_logs():
            if key in self._known:
                self._known[key].growing.path = path
            elif self._sizes.get(key, -1) != size and self.place in {path, path.parent}:
                self._begin_recording(path, key)
        if self._recordings and self._recordings[-1].path.exists():
            last = self._recordings[-1]
            if last.growing.was_replaced:
                self._begin_recording(last.path, _identify_file(last.path))
        return self._recordings

    def close(self) -> None:
        """Do nothing: no file stays open."""

    def _begin_recording(self, path: Path, key: tuple[int, int]) -> None:
        recording = Recording(path, state=self._state)
        self._recordings.append(recording)
        self._known[key] = recording

    def _list_logs(self) -> list[tuple[Path, tuple[int, int], int]]:
        """Path, identity and size [bytes] of each log in the folder, the oldest first."""
        folder = self.place if self.place.is_dir() else self.place.parent
        found = []
        for path in filter(lambda one: one.suffix.lower() in SUFFIXES, folder.iterdir()):
            try:
                stat = path.stat()
            except OSError:  # it was renamed or removed since
                continue
            found.append((stat.st_mtime_ns, path, (stat.st_dev, stat.st_ino), stat.st_size))
        return [(path, key, size) for _, path, key, size in sorted(found)]


def _identify_file(path: Path) -> tuple[int, int]:
    """The device and inode number of a file, which stay the same when it is renamed."""
    stat = path.stat()
    return stat.st_dev, stat.st_ino


def split_finished_tests(
    tests: Sequence[RunInterval],
) -> tuple[tuple[RunInterval, ...], float]:
    """The tests that have ended, and the start [s] of the running one; infinite if none runs."""
    finished = tuple(one for one in tests if one.end != NO_END)
    running = [one.begin for one in tests if one.end == NO_END]
    return finished, min(running) / SECOND if running else math.inf
