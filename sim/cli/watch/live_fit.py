"""Fits the log of a robot while its tests are still running, again after each test."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from sim.cli.fit.parts import PooledParts, fit_parts
from sim.cli.log_reader import join_parts, list_parts
from sim.cli.watch.recordings import Recording, Source, split_finished_tests
from sim.core.errors import Refusal
from sim.core.log import Log
from sim.fit import fit
from sim.inspect.detect_faults import inspect
from sim.report.gain_verdicts import write_gain_verdict
from sim.report.next_test import advise_next

GROWING = ("truncated", "unfinished-run")  # doubts that only mean that the file still grows

Reader = Callable[[Path], Mapping[str, Log]]


@dataclass(frozen=True, eq=False)
class WatchUpdate:
    """The results after a test: logs, fit and advice.

    Args:
        tests: those that have ended since the last update, in their order.
        parts: the logs of all parts so far, by name; empty where none can be read.
        pooled: their fit, in the unit of the log; None if there is none yet.
        refusal: why there is no fit; None if there is one.
        advice: what to do next.
        paths: the files that the logs come from.
    """

    tests: tuple[str, ...]
    parts: Mapping[str, Log]
    pooled: PooledParts | None
    refusal: Refusal | None
    advice: str
    paths: tuple[Path, ...]

    @property
    def log(self) -> Log | None:
        """All runs of all parts as one log; None if there are none."""
        return join_parts(self.parts) if self.parts else None

    def to_json(self) -> dict[str, Any]:
        """The update as plain data, as ``sysid watch --json`` prints it."""
        log = self.log
        data: dict[str, Any] = {
            "tests": list(self.tests),
            "recorded": [] if log is None else [run.test for run in log.runs],
            "files": [str(path) for path in self.paths],
            "next": self.advice,
            "refusal": None if self.refusal is None else str(self.refusal),
            "verdict": "",
            "fit": None,
        }
        if self.pooled is not None:
            data["fit"] = self.pooled.found.to_json()
            data["verdict"] = write_gain_verdict(self.pooled.found, log)
        return data


class LiveFit:
    """Follows a source of recordings, and fits them whenever a test ends.

    Args:
        source: where the recordings come from.
        read: reads a file; returns a log for each motor.
        type: type of the mechanism; empty takes the one in the log.
    """

    def __init__(self, source: Source, read: Reader, *, type: str = "") -> None:  # noqa: A002 - the field's own word
        self.source = source
        self.last: WatchUpdate | None = None
        self._read, self._type = read, type
        self._renewed: dict[Recording, None] = {}

    def take_changed(self) -> tuple[Recording, ...]:
        """The recordings whose logs were read again since the last call."""
        renewed = tuple(self._renewed)
        self._renewed.clear()
        return renewed

    def poll(self) -> WatchUpdate | None:
        """The update since the last call; None if no test has ended.

        Raises:
            Refusal: a file is not a log, or several entries name the same tests.
        """
        recordings = tuple(self.source.poll())
        refusals: list[Refusal] = []
        ended = [test for one in recordings for test in self._read_ended_tests(one, refusals)]
        if not ended:
            return None
        self.last = self._fit_recordings(recordings, tuple(ended), refusals)
        return self.last

    def _read_ended_tests(self, one: Recording, refusals: list[Refusal]) -> list[str]:
        """Read a recording again if tests in it have ended; the names of these tests."""
        try:
            tests = one.growing.list_tests()
        except FileNotFoundError:  # it is being renamed, or was removed
            return []
        finished, running = split_finished_tests(tests)
        new = [interval.test for interval in finished if interval not in one.finished]
        if new:
            one.finished = finished
            try:
                one.logs = _drop_running(self._read(one.path), since=running)
                self._renewed[one] = None
            except Refusal as refusal:
                refusals.append(refusal)
        return new

    def _fit_recordings(
        self, recordings: Sequence[Recording], ended: tuple[str, ...], refusals: Sequence[Refusal]
    ) -> WatchUpdate:
        """Fit and inspect all recordings, and write the advice."""
        files = [(one.path, one.logs) for one in recordings if one.logs]
        paths = tuple(path for path, _ in files)
        if not files:
            return WatchUpdate(ended, {}, None, refusals[0], refusals[0].advice, paths)
        parts = list_parts(files)
        pooled, refusal, found = None, None, None
        try:
            log = join_parts(parts)
            pooled = fit_parts(parts, partial(fit, type=self._type), files=len(files))
            found = pooled.found
            pooled = replace(pooled, found=found.in_log_units())
        except Refusal as why:
            refusal = why
        advice = (
            refusals[0].advice
            if refusals
            else advise_next(log, found=found, inspection=inspect(log), last=ended)
        )
        return WatchUpdate(ended, parts, pooled, refusal, advice, paths)


def _drop_running(logs: Mapping[str, Log], *, since: float) -> dict[str, Log]:
    """The logs without the test that is still running, and without doubts that only say so.

    Args:
        logs: the log of each motor.
        since: start of that test [s]; infinite if no test is running.
    """
    kept = {
        name: replace(
            log,
            runs=tuple(run for run in log.runs if run.time[0] < since),
            doubts=tuple(doubt for doubt in log.doubts if doubt.code not in GROWING),
        )
        for name, log in logs.items()
    }
    return {name: log for name, log in kept.items() if log.runs}
