"""Leave a part of a test, or a whole test, out of a log."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import MOVING, Log, Run
from sim.core.vocabulary import TESTS

MIN_SAMPLES = 5  # [samples] shorter pieces of a run are left out, too
MIN_SHARE_LEFT = 0.5  # [share of samples] a test of which less is left has a warning
MOST_OF_IT = 0.9  # [share] of an interval that counts as all of it: nobody marks the ends exactly
SPELLING = re.compile(r"(?P<test>[\w-]+?)(:(?P<start>[\d.]+)-(?P<end>[\d.]+))?")


@dataclass(frozen=True)
class LeftOutPart:
    """A part of a log that is not used.

    Args:
        test: name of the test.
        start: [s] time in the log at which the part begins.
        end: [s] at which it ends.
    """

    test: str
    start: float = -math.inf
    end: float = math.inf

    @classmethod
    def parse(cls, text: str) -> "LeftOutPart":
        """The part that a text such as ``dynamic-forward:5.5-6`` names; a test alone is a whole.

        Raises:
            BadRequest: it names no test, or its times are not two numbers in order.
        """
        found = SPELLING.fullmatch(text.strip())
        if found is None or found["test"] not in TESTS:
            raise BadRequest(
                f"{text!r} names no part of a log",
                advice=Action("name-part"),
            )
        if found["start"] is None:
            return cls(found["test"])
        try:
            start, end = float(found["start"]), float(found["end"])
        except ValueError:
            start, end = 1.0, 0.0
        if not start < end:
            raise BadRequest(
                f"{text!r} does not begin before it ends",
                advice="Write two times in seconds, the earlier one first: dynamic-forward:5.5-6.",
            )
        return cls(found["test"], start, end)

    def __str__(self) -> str:
        """The part in words."""
        if math.isinf(self.start):
            return self.test
        return f"{self.test}, {self.start:.2f} to {self.end:.2f} s"

    def covers(self, test: str, start: float, end: float) -> bool:
        """Whether nearly all of an interval of a test [s] lies within the part."""
        shared = min(self.end, end) - max(self.start, start)
        return self.test == test and shared >= MOST_OF_IT * (end - start)

    def find(self, run: Run) -> NDArray[np.bool_]:
        """(n,) which samples of a run belong to the part."""
        return (run.time >= self.start) & (run.time <= self.end) & (run.test == self.test)


def leave_out(logs: Mapping[str, Log], parts: Iterable[LeftOutPart]) -> dict[str, Log]:
    """The logs without some parts; a run is split where a part of its middle is missing.

    Args:
        logs: name -> log.
        parts: what to leave out.

    Raises:
        BadRequest: no log has such a part, or nothing would remain of a log.
    """
    parts = tuple(parts)
    for part in parts:
        if not any(part.find(run).any() for log in logs.values() for run in log.runs):
            raise BadRequest(
                f"the log has no samples of {part}, so they cannot be left out",
                advice=Action("no-such-part"),
            )
    left = {
        name: replace(log, runs=tuple(piece for run in log.runs for piece in cut_run(run, parts)))
        for name, log in logs.items()
    }
    if not all(log.runs for log in left.values()):
        raise BadRequest("nothing of the log is left", advice="Leave out less of it.")
    return {name: log.add_doubts(*_doubt_rest(logs[name], log)) for name, log in left.items()}


def cut_run(run: Run, parts: Iterable[LeftOutPart]) -> list[Run]:
    """The pieces of a run that some parts leave of it."""
    pieces = [run]
    for part in parts:
        pieces = [rest for piece in pieces for rest in _cut_out(piece, part)]
    return pieces


def _doubt_rest(log: Log, left: Log) -> Iterator[Doubt]:
    """A warning about each test of which little is left."""
    for test in dict.fromkeys(run.test for run in log.runs):
        before, after = (
            sum(len(run) for run in one.runs if run.test == test) for one in (log, left)
        )
        if after < MIN_SHARE_LEFT * before:
            used = f"only {after / before:.0%}" if after else "nothing"
            yield Doubt(
                "little-left",
                f"The fit uses {used} of {test}. What this test shows is "
                "missing in the gains. Leave out less of it, or record it again.",
            )


def _cut_out(run: Run, part: LeftOutPart) -> list[Run]:
    """The run without the part: itself, or the pieces before and after it that move."""
    gone = part.find(run).nonzero()[0]
    if not gone.size:
        return [run]
    pieces = (slice(0, gone[0]), slice(gone[-1] + 1, len(run)))
    rest = [one for one in (run.select(piece) for piece in pieces) if len(one) >= MIN_SAMPLES]
    return [one for one in rest if one.top_speed > MOVING * run.top_speed]
