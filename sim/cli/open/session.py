"""The logs that are open on the page, with cached results of reading, inspecting and fitting."""

import re
import shutil
import threading
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.fit.parts import PooledParts, fit_parts
from sim.cli.fit.plausibility import check_against_physics, compare_directions_alone
from sim.cli.log_reader import LogReader, join_parts, mend_parts
from sim.cli.open.reconcile_job import ReconcileJob
from sim.cli.open.view import PageView
from sim.core.errors import BadRequest, Refusal
from sim.core.leave_out import LeftOutPart, leave_out
from sim.core.log import Log
from sim.fit import Fit, fit
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import Inspection, inspect
from sim.io import list_entries, write
from sim.io.entries.entry import NEEDED, Entry
from sim.physics.engine import load_engine

Result = TypeVar("Result")

MOST_LOGS = 64  # open at a time
LONGEST_NAME = 120  # [characters] of a file's name


@dataclass(frozen=True)
class Reading:
    """Options with which a log is read.

    Args:
        units: unit of its positions; None takes the one in the file.
        type: type of the mechanism; None takes the one in the file.
        entries: (signal, entry) for each entry that the user chose; the others are found by name.
        left_out: parts that the fit does not use.
    """

    units: str | None = None
    type: str | None = None
    entries: tuple[tuple[str, str], ...] = ()
    left_out: tuple[LeftOutPart, ...] = ()

    def make_reader(self) -> LogReader:
        """The reader that follows these options."""
        return LogReader(self.units, self.type, entries=dict(self.entries))

    @classmethod
    def from_query(cls, query: Mapping[str, str]) -> "Reading":
        """The options that a request of the page names."""
        chosen = tuple((one, query[one]) for one in (*NEEDED, "state", "time") if query.get(one))
        named = filter(None, query.get("left_out", "").split(","))
        left_out = tuple(map(LeftOutPart.parse, named))
        return cls(query.get("units") or None, query.get("type") or None, chosen, left_out)


@dataclass(frozen=True)
class LiveView:
    """Status and logs of a source that ``sysid watch`` follows on the page.

    Args:
        status: what the command follows, or waits for.
        counts: each of the four tests -> how many runs of it there are.
        advice: what to do next; empty before the first test has ended.
    """

    status: str
    counts: Mapping[str, int]
    advice: str = ""


@dataclass(eq=False)
class OpenLog:
    """One file that is open on the page.

    Each result is computed once, even if several requests need it at the same time.

    Args:
        number: identifies the log in the session, from 1.
        name: name of the file, as the page shows it.
        path: path of the file.
        revision: number of updates of a file that grows; 0 for a file that does not.
        finished: the logs of the tests that have ended in it; None for a file that does not grow.
    """

    number: int
    name: str
    path: Path
    revision: int = 0
    finished: Mapping[str, Log] | None = None
    _results: dict[Hashable, Any] = field(default_factory=dict)
    _locks: dict[Hashable, threading.Lock] = field(default_factory=dict)

    def read_parts(self, reading: Reading) -> dict[str, Log]:
        """The log of each mechanism, side or motor by its name.

        Raises:
            Refusal: the file cannot be read with these options.
        """
        reading = replace(reading, left_out=())
        return self._compute_once(
            ("parts", reading), lambda: mend_parts(self._read_recorded(reading))
        )

    def _read_recorded(self, reading: Reading) -> dict[str, Log]:
        """The log of each mechanism, side or motor as it was recorded."""

        def read() -> dict[str, Log]:
            if self.finished is not None and reading == Reading():
                return dict(self.finished)
            return reading.make_reader().read_motors(self.path)

        reading = replace(reading, left_out=())
        return self._compute_once(("recorded", reading), read)

    def combine_runs(self, reading: Reading) -> Log:
        """All runs of all mechanisms in the file as one log.

        Raises:
            Refusal: as ``read_parts``.
        """
        reading = replace(reading, left_out=())
        return self._compute_once(("log", reading), lambda: join_parts(self.read_parts(reading)))

    def read_mechanism(self, reading: Reading) -> Log:
        """The log of one mechanism; several motors in the file are averaged.

        Raises:
            Refusal: as ``read_parts``.
        """
        if len(self.read_parts(reading)) == 1:
            return self.combine_runs(reading)

        return reading.make_reader().read_joined([self.path])

    def list_entries(self) -> list[Entry]:
        """The entries of the file, for choosing signals.

        Raises:
            Refusal: the file cannot be read, or has no entries with names.
        """
        return self._compute_once("entries", lambda: list_entries(self.path))

    def inspect(self, reading: Reading) -> Inspection:
        """The faults and warnings found in the log.

        Raises:
            Refusal: as ``read_parts``.
        """
        return self._compute_once(
            ("faults", reading), lambda: inspect(join_parts(self._read_recorded(reading)))
        )

    def fit(self, reading: Reading) -> PooledParts:
        """The gains, in the unit of the log.

        Raises:
            Refusal: as ``read_parts``, or the log cannot be fitted.
        """

        def find() -> PooledParts:
            logs = self._read_rest(reading)
            pooled = fit_parts(logs, partial(fit, type=reading.type or ""))
            found, _ = check_against_physics(pooled.found, join_parts(logs), parts=None)
            return replace(pooled, found=found)

        return self._compute_once(("fit", reading), find)

    def compare_directions(self, reading: Reading) -> tuple[Fit, tuple[str, ...]]:
        """The fit, with a doubt if forward and reverse runs disagree when fitted alone; and notes.

        Raises:
            Refusal: as ``fit``.
        """
        return self._compute_once(
            ("directions", reading),
            lambda: compare_directions_alone(
                self.fit(reading).found, join_parts(self._read_rest(reading)), include_long=False
            ),
        )

    def _read_rest(self, reading: Reading) -> dict[str, Log]:
        """The log of each mechanism, side or motor, without the parts that the user left out."""
        return leave_out(self.read_parts(reading), reading.left_out)

    def store_fit(self, reading: Reading, pooled: PooledParts) -> None:
        """Store a fit that was already computed."""
        self._results[self.revision, ("fit", reading)] = pooled

    def reconcile(
        self, reading: Reading, others: Mapping[str, "OpenLog"], effort: float
    ) -> ReconcileJob:
        """The search for missing effects; the first call starts it.

        Args:
            reading: how to read the log.
            others: ``validation`` and ``held_out`` -> another open log, where one is chosen.
            effort: [1] as of ``reconcile``.
        """

        def read_logs() -> dict[str, Log]:
            alike = Reading(reading.units, reading.type)
            more = {role: one.read_mechanism(alike) for role, one in others.items()}
            return {"log": self.read_mechanism(reading), **more}

        numbers = tuple((role, one.number, one.revision) for role, one in others.items())
        begin = partial(ReconcileJob, read_logs, name=self.name, type=reading.type, effort=effort)
        return self._compute_once(
            ("reconcile", reading, numbers, effort), partial(begin, left_out=reading.left_out)
        )

    def renew(self, finished: Mapping[str, Log], path: Path) -> None:
        """Replace the finished tests; results computed from fewer tests are dropped."""
        self.finished, self.path, self.revision = finished, path, self.revision + 1
        self._results = {}

    def _compute_once(self, what: Hashable, make: Callable[[], Result]) -> Result:
        """The cached result of this key, computed if there is none; a refusal is cached, too.

        Raises:
            Refusal: ``make`` raised it, now or before.
        """
        key = (self.revision, what)
        with self._locks.setdefault(key, threading.Lock()):
            if key not in self._results:
                try:
                    self._results[key] = make()
                except Refusal as refusal:
                    self._results[key] = refusal
            found = self._results[key]
        if isinstance(found, Refusal):
            raise found
        kept: Result = found
        return kept


class Session:
    """All files that are open, those named on the command line first.

    Args:
        folder: folder of this session, where dropped files are written.
        files: the files named on the command line.
        view: what the page shows of them.
    """

    def __init__(
        self, folder: Path, files: Sequence[Path] = (), *, view: PageView | None = None
    ) -> None:
        self.folder = folder
        self.view = view or PageView()
        self._numbers = count(1)
        self._logs: dict[int, OpenLog] = {}
        self._lock = threading.Lock()
        self._growing: dict[Hashable, int] = {}
        self.live: LiveView | None = None
        for file in files:
            self.add(file.name, file)

    @property
    def logs(self) -> tuple[OpenLog, ...]:
        """The open logs, in the order in which they were opened."""
        with self._lock:
            return tuple(self._logs.values())

    def add(self, name: str, path: Path) -> OpenLog:
        """Open a file in this session.

        Args:
            name: name that the page shows.
            path: path of the file.

        Raises:
            BadRequest: too many logs are open.
        """
        with self._lock:
            if len(self._logs) >= MOST_LOGS:
                raise BadRequest(f"{MOST_LOGS} logs are open", advice="Close some of them.")
            one = OpenLog(next(self._numbers), name, path)
            self._logs[one.number] = one
            return one

    def renew(self, key: Hashable, path: Path, finished: Mapping[str, Log]) -> None:
        """Show the finished tests of a log that grows; a log that was closed stays closed.

        Args:
            key: identifies the log, also when its file is renamed.
            path: path of the file now.
            finished: the logs of the tests that have ended in it.

        Raises:
            BadRequest: too many logs are open.
        """
        if key not in self._growing:
            self._growing[key] = self.add(path.name, path).number
        with self._lock:
            one = self._logs.get(self._growing[key])
            if one is not None:
                one.renew(finished, path)

    def choose_place(self, name: str) -> tuple[str, Path]:
        """A name valid on every system, and an unused path for an uploaded file of that name."""
        plain = re.sub(r"[^\w. ()+-]", "_", Path(name.replace("\\", "/")).name).strip(". ")
        plain = plain[-LONGEST_NAME:] or "log"
        folder = self.folder / str(next(self._numbers))
        folder.mkdir()
        return plain, folder / plain

    def find(self, number: int) -> OpenLog:
        """Look up an open log by its number.

        Raises:
            BadRequest: no log of this number is open.
        """
        with self._lock:
            found = self._logs.get(number)
        if found is None:
            raise BadRequest("this log is not open any more", advice="Drop its file again.")
        return found

    def close(self, number: int) -> None:
        """Close a log, and remove its file if it was dropped on the page."""
        with self._lock:
            one = self._logs.pop(number, None)
        if one is not None and one.path.is_relative_to(self.folder):
            shutil.rmtree(one.path.parent, ignore_errors=True)

    def add_example(self) -> OpenLog:
        """Open a simulated drivetrain's log in which the encoder slipped."""
        rng = np.random.default_rng(4)
        log = simulate(MECHANISMS["drivetrain"], Routine(), rng=rng)
        contaminated = contaminate(
            log, "encoder-slip", severity=1.0, test="quasistatic-forward", at=5.5, rng=rng
        )
        name, path = self.choose_place("example drivetrain.wpilog")
        write(contaminated.log, path)
        return self.add(name, path)

    def warm_up(self) -> None:
        """Load the engine in advance, so that the first log opens fast."""
        if not self.view.raw:
            load_engine()
