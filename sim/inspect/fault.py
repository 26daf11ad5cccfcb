"""The contract of a fault: damage to a recording, made on purpose and detected again.

An effect is physics that a model should include; a fault is an error of the recording that a log
should not contain. A module of ``faults/`` defines one fault as ``FAULT``: ``spoil`` makes the
damage, and ``detect`` finds it.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from sim.core.advice import Action
from sim.core.log import Array, Log, Run
from sim.core.vocabulary import KINDS, TYPES
from sim.inspect.log_features import LogFeatures

ABOUT = ("motion", "time")  # what a fault can damage
MOST = 3.0  # [1] largest severity; 1 is ordinary


@dataclass(frozen=True)
class LogInterval:
    """A part of a log: some seconds of one run, one whole run, or the log as a whole.

    Args:
        run: index of the run; None for the whole log, or for a test that is missing.
        test: name of the test; empty for the whole log.
        start: [s] on the log's clock.
        end: [s] on the log's clock.
    """

    run: int | None = None
    test: str = ""
    start: float = 0.0
    end: float = 0.0

    @classmethod
    def of_samples(cls, index: int, run: Run, first: int = 0, last: int = -1) -> Self:
        """The interval from one sample of a run to another; without samples, the whole run."""
        return cls(index, run.test, float(run.time[first]), float(run.time[last]))

    def overlap(self, other: "LogInterval") -> float:
        """Intersection over union of two intervals: 1 if equal, 0 if apart or in other runs."""
        if (self.run, self.test) != (other.run, other.test):
            return 0.0
        shared = min(self.end, other.end) - max(self.start, other.start)
        either = max(self.end, other.end) - min(self.start, other.start)
        return max(shared, 0.0) / either if either > 0.0 else 1.0


@dataclass(frozen=True, eq=False)
class DamagedLog:
    """A damaged log, and where the damage is.

    Args:
        log: the log as a robot with this fault would have recorded it.
        where: the damaged intervals.
    """

    log: Log
    where: tuple[LogInterval, ...]


@dataclass(frozen=True)
class Damage:
    """A fault that was found in a log.

    Args:
        where: the damaged interval.
        confidence: 0 to 1; near 1 no other cause is plausible.
        evidence: one sentence with a number, for the user.
        advice: what to do: run again, trim, filter, or fix the code.
        ordinary: whether many robots record like this, so that there is no need to record again.
        fault: name of the fault, which the inspection writes.
    """

    where: LogInterval
    confidence: float
    evidence: str
    advice: str | Action
    ordinary: bool = False
    fault: str = ""


@dataclass(frozen=True)
class FaultStrike:
    """The place and severity of a fault.

    Args:
        run: index of the run, also for a fault of the whole log.
        start: [s] since the run's first sample.
        severity: above 0, at most ``MOST``; 1 is ordinary.
    """

    run: int
    start: float
    severity: float


@dataclass(frozen=True)
class Fault:
    """One kind of fault.

    Args:
        name: name on the command line: ``encoder-slip``.
        summary: one line for a list of faults.
        ordinary: what severity 1 means, in plain words with a number.
        spoil: damages a log, from the log, a ``FaultStrike`` and a random generator; the same state
            of the generator gives the same log. It is never called with severity 0.
        detect: finds this fault in the features of a log.
        kinds: kinds of test in which it can happen.
        types: types of mechanism to which it can happen; a log without a type is accepted.
        about: what it damages: ``motion``, so that motion and voltage do not agree, or ``time``. Of
            two faults about the same, only one is reported for an interval.
        whole: whether it damages whole runs, so that the start of a ``FaultStrike`` is not used.
        when: (earliest, latest) share of the time in motion, between which a random start lies.
        least_voltage: [V] voltage of a run below which it does not happen.
    """

    name: str
    summary: str
    ordinary: str
    spoil: Callable[[Log, FaultStrike, np.random.Generator], DamagedLog]
    detect: Callable[[LogFeatures], Iterable[Damage]]
    kinds: tuple[str, ...] = ("quasistatic", "dynamic")
    types: tuple[str, ...] = TYPES
    about: str = "motion"
    whole: bool = False
    when: tuple[float, float] = (0.3, 0.6)
    least_voltage: float = 0.0

    def find_contract_breaches(self, caption: str) -> list[str]:
        """Sentences that say how this fault breaks the contract; empty if it does not.

        Args:
            caption: the text at the top of its file.
        """
        earliest, latest = self.when
        rules = {
            "has no line in the module's text that begins with Fingerprint:": (
                "Fingerprint:" in caption
            ),
            "has no summary of one line": len(self.summary) > 0 and "\n" not in self.summary,
            "says what severity 1 means without digits": any(c.isdigit() for c in self.ordinary),
            f"strikes kinds {self.kinds}, which are not all tests": {*self.kinds} <= {*KINDS},
            "strikes no kind of test": bool(self.kinds),
            f"strikes types {self.types}, which are not all types": {*self.types} <= {*TYPES},
            f"is about {self.about!r}, which is neither motion nor time": self.about in ABOUT,
            f"may start at {self.when}, which are not two shares in rising order": 0
            <= earliest
            <= latest
            <= 1,
        }
        return [rule for rule, kept in rules.items() if not kept]


def rescale_motion(run: Run, pace: Array) -> Run:
    """A run with its velocity and position steps multiplied by factors ``pace``.

    Positions are the sum of their multiplied steps, so the resolution of the sensor and its
    repeated readings are kept.

    Args:
        run: the original run.
        pace: (n,) [1] factor of each sample: 1 changes nothing, 0 is standstill.
    """
    renewed = np.concatenate(([True], np.diff(run.velocity) != 0.0))
    latest = np.maximum.accumulate(np.where(renewed, np.arange(len(run)), 0))
    steps = np.diff(run.position) * pace[1:]
    position = run.position[0] + np.concatenate(([0.0], np.cumsum(steps)))
    same = np.cumprod(pace == 1.0) > 0.0  # positions before the change keep every digit
    return replace(
        run,
        velocity=run.velocity * pace[latest],
        position=np.where(same, run.position, position),
    )


def damage_runs(log: Log, damaged: Mapping[int, Run]) -> DamagedLog:
    """The log with damaged runs, by index; each is damaged from its first to its last sample."""
    runs = tuple(damaged.get(index, run) for index, run in enumerate(log.runs))
    where = (LogInterval.of_samples(index, run) for index, run in damaged.items() if len(run))
    return DamagedLog(replace(log, runs=runs), tuple(where))


def replace_run(log: Log, index: int, run: Run) -> Log:
    """The log with another run in the place of that at ``index``."""
    return replace(log, runs=(*log.runs[:index], run, *log.runs[index + 1 :]))
