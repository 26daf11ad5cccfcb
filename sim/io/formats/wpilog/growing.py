"""The tests so far of a WPILOG file that is still being written."""

from contextlib import suppress
from pathlib import Path

from sim.core.errors import MissingSignal
from sim.io.entries.entry import STRING
from sim.io.entries.state import RunInterval, find_run_intervals, find_state_entries
from sim.io.format import ReadOptions
from sim.io.formats.wpilog.contents import Contents
from sim.io.formats.wpilog.records import PREFACE, open_log


class GrowingLog:
    """The tests of a file that grows.

    Only texts are read, because they name the tests, and only those appended since the last call.

    Args:
        path: the file; it may be empty.
        state: the entry that names the tests; None finds it by name.
    """

    def __init__(self, path: Path, *, state: str | None = None) -> None:
        self._options = ReadOptions(entries={"state": state} if state else {})
        self._size = 0  # [bytes] at the last call
        self._contents = Contents(lambda entry: entry.type == STRING)
        self.path = path  # the file may be renamed while it grows

    def list_tests(self) -> tuple[RunInterval, ...]:
        """The tests so far, sorted by start; one that is still running ends at ``NO_END``.

        Raises:
            FileNotFoundError: the file does not exist.
            UnreadableFile: the file is not a WPILOG file.
            BadRequest: several entries name the tests of one mechanism.
        """
        self._size = self.path.stat().st_size
        if self._size <= PREFACE:
            return ()
        where = str(self.path)
        with open_log(self.path) as stream:
            self._contents.read(stream, where=where)
        entries = self._contents.list_entries()
        with suppress(MissingSignal):
            states = find_state_entries(entries, options=self._options, where=where)
            found = [one for state in states for one in find_run_intervals(state, where=where)[0]]
            return tuple(sorted(found, key=lambda one: one.begin))
        return ()

    @property
    def was_replaced(self) -> bool:
        """Whether the file is shorter than what was read of it, so it is another file."""
        return self.path.stat().st_size < self._size
