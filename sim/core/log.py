"""Log and Run: the recorded tests of one mechanism, from a robot or from the simulation.

Everything is in SI: seconds, volts, meters or radians. The unit the owner of the log thinks in
travels along as a name (``Log.units``); conversion happens where a file is read and where a
number is shown, nowhere between.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, BadSample
from sim.core.units import find_unit
from sim.core.vocabulary import DIRECTIONS, FOUR_TESTS, KINDS, TESTS, TYPES

__all__ = [  # the words come along, for those who work on logs
    "DIRECTIONS",
    "FOUR_TESTS",
    "KINDS",
    "LARGEST",
    "TESTS",
    "TYPES",
    "Array",
    "Log",
    "Run",
]

Array: TypeAlias = NDArray[np.float64]

LARGEST = 1e9  # [any SI unit] no robot shows a reading this large; squares of it still fit a double
CONSTANT_KINDS = frozenset({"dynamic", "coast", "multistep"})  # whose command stands between steps
LONE_STEP = 2.0  # [1] times the changes beside it, from which a change is a step
LEAST_STEP = 0.25  # [of the largest voltage] that a step of the command changes


@dataclass(frozen=True, eq=False)
class Run:
    """One test, sampled: applied voltage, measured position and velocity.

    Args:
        test: which test, one of ``TESTS``: ``quasistatic-forward``.
        time: (n,) [s], strictly increasing.
        voltage: (n,) [V], applied from this sample until the next.
        position: (n,) [m or rad].
        velocity: (n,) [m/s or rad/s].
        current: (n,) [A], where it was recorded.
        bus_voltage: (n,) [V], where it was recorded.

    Raises:
        BadRequest: ``test`` is not the name of a test.
        BadSample: lengths differ, a value is not finite or is absurd, or time stands still.

    Examples:
        >>> run = Run("dynamic-forward", time=[0.0, 0.02], voltage=[7.0, 7.0],
        ...           position=[0.0, 0.01], velocity=[0.0, 1.0])
        >>> run.kind, run.direction, len(run)
        ('dynamic', 'forward', 2)
    """

    test: str
    time: Array
    voltage: Array
    position: Array
    velocity: Array
    current: Array | None = None
    bus_voltage: Array | None = None

    def __post_init__(self) -> None:
        if self.test not in TESTS:
            raise BadRequest(
                f"{self.test!r} is not the name of a test",
                advice=f"Tests are {'|'.join(KINDS)}, then -{' or -'.join(DIRECTIONS)}.",
            )
        for name in ("time", "voltage", "position", "velocity", "current", "bus_voltage"):
            values = getattr(self, name)
            if values is not None:
                object.__setattr__(self, name, _frozen(values))
                self._check(name, getattr(self, name))
        late = np.flatnonzero(np.diff(self.time) <= 0)
        if late.size:
            raise BadSample(
                f"time does not increase at sample {late[0] + 1} (t = {self.time[late[0]]:.6g} s)",
                where=self.test,
                advice="Every sample of a run needs a later time than the one before it.",
            )

    @cached_property
    def top_speed(self) -> float:
        """[m/s or rad/s] speed that 98 % of the samples do not exceed."""
        return float(np.percentile(np.abs(self.velocity), 98)) if len(self) else 0.0

    @cached_property
    def voltage_slide(self) -> Array:
        """(n,) [V] linear change of the voltage from each sample to the next; 0 if it is held.

        A program sets a voltage once a loop and holds it, so a ramp is a stair. Where the command
        is constant, a voltage that changes from sample to sample follows the speed: a current
        limit or a weak battery acts. A large change that is more than twice as large as those
        before and after it is a step of the command, which is held. Dynamic and coast tests know
        two commands only, the step and nothing, so from one voltage to another it slides.
        """
        change = np.diff(self.voltage)
        if self.kind not in CONSTANT_KINDS or not change.any():
            return _frozen(np.zeros(len(self)))
        sizes = np.abs(np.concatenate(([0.0], change, [0.0])))
        steps = sizes[1:-1] > LONE_STEP * np.maximum(sizes[:-2], sizes[2:])
        least = LEAST_STEP * float(np.max(np.abs(self.voltage)))
        steps &= np.abs(change) > least
        if self.kind != "multistep":
            steps &= np.minimum(np.abs(self.voltage[:-1]), np.abs(self.voltage[1:])) < least
        return _frozen(np.append(np.where(steps, 0.0, change), 0.0))

    @cached_property
    def voltage_error(self) -> Array:
        """(n,) [V] standard deviation of the mean voltage from each sample to the next.

        It is 0 where the voltage is held. A limit that begins or ends to act between two samples
        bends the voltage there. The chord of a path with one bend misses its mean by at most an
        eighth of the change of slope. A slide that is over within one sample may have any slope:
        its mean lies evenly between the two readings.
        """
        slides = np.append(0.0, self.voltage_slide)
        before, here, after = slides[:-2], slides[1:-1], slides[2:]
        bends = np.max(np.abs([after - before, here - before, after - here]), axis=0, initial=0.0)
        alone = (before == 0.0) & (after == 0.0)
        error = np.where(alone, np.abs(here) / math.sqrt(12.0), bends / 8.0)
        return _frozen(np.append(np.where(here == 0.0, 0.0, error), 0.0))

    def _check(self, name: str, values: Array) -> None:
        if values.shape != (self.time.size,):
            raise BadSample(
                f"{name} has shape {values.shape} where time has {self.time.size} samples",
                where=self.test,
                advice="Give every signal one value per sample.",
            )
        bad = np.flatnonzero(~(np.abs(values) < LARGEST))
        if bad.size:
            raise BadSample(
                f"{name} is {values[bad[0]]:.6g} at sample {bad[0]}",
                where=self.test,
                advice="Remove that sample, or record the run again.",
            )

    def __len__(self) -> int:
        return int(self.time.size)

    @property
    def kind(self) -> str:
        """What the voltage does, the first half of the test's name: ``quasistatic``."""
        return self.test.rpartition("-")[0]

    @property
    def direction(self) -> str:
        """``forward`` or ``reverse``."""
        return self.test.rpartition("-")[2]


@dataclass(frozen=True, eq=False)
class Log:
    """The runs of one mechanism, with unit, type and origin.

    Args:
        runs: in the order they were recorded.
        units: the unit of position its owner thinks in, a name in ``sim.core.units.UNITS``.
        mechanism: its name, where the source says it.
        type: ``simple``, ``elevator`` or ``arm`` where the source says it, else empty.
        source: the file it was read from, for messages; empty if none.
        doubts: what was odd about the source.

    Examples:
        >>> run = Run("quasistatic-reverse", [0.0], [0.0], [0.0], [0.0])
        >>> log = Log((run,), units="rotations", type="simple")
        >>> log.units, len(log.list_runs_of_test("quasistatic-reverse"))
        ('rotations', 1)
    """

    runs: tuple[Run, ...]
    units: str = "meters"
    mechanism: str = ""
    type: str = ""
    source: str = ""
    doubts: tuple[Doubt, ...] = field(default=())

    def __post_init__(self) -> None:
        object.__setattr__(self, "runs", tuple(self.runs))
        object.__setattr__(self, "units", find_unit(self.units).name)
        if self.type and self.type not in TYPES:
            raise BadRequest(
                f"unknown type {self.type!r}", advice=f"Choose one of: {', '.join(TYPES)}."
            )

    @cached_property
    def top_speed(self) -> float:
        """[m/s or rad/s] top speed of its fastest run; 0 without runs."""
        return max((run.top_speed for run in self.runs), default=0.0)

    @property
    def has_ramps_and_steps(self) -> bool:
        """Whether it holds quasistatic and dynamic tests, so that it can be fitted alone."""
        return {run.kind for run in self.runs} >= {"quasistatic", "dynamic"}

    def list_runs_of_test(self, test: str) -> tuple[Run, ...]:
        """All runs of one test, in order; empty if it was not recorded."""
        return tuple(run for run in self.runs if run.test == test)

    def join(self, other: "Log") -> "Log":
        """The runs of two logs of one mechanism together.

        Raises:
            BadRequest: one measures a length, the other an angle.
        """
        if find_unit(self.units).angular != find_unit(other.units).angular:
            raise BadRequest(
                f"{self.source} is in {self.units}, {other.source} in {other.units}",
                advice="Fit one mechanism at a time, or add --units if a file is mislabeled.",
            )
        return replace(self, runs=self.runs + other.runs, doubts=self.doubts + other.doubts)

    def add_doubts(self, *doubts: Doubt) -> "Log":
        """A copy with more doubts."""
        return replace(self, doubts=self.doubts + doubts)


def _frozen(values: ArrayLike) -> Array:
    """A read-only copy in double precision."""
    copy = np.array(values, dtype=np.float64)
    copy.setflags(write=False)
    return copy
