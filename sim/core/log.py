"""Log and Run: the recorded tests of one mechanism, from a robot or from the simulation.

Everything is in SI: seconds, volts, meters or radians. ``Log.units`` is the name of the unit of the
log's owner. Numbers are converted only when a file is read, and when they are shown.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, BadSample, refuse_unknown
from sim.core.units import find_unit
from sim.core.vocabulary import DIRECTIONS, FOUR_TESTS, KINDS, TESTS, TYPES

__all__ = [  # with the fixed names, which code that works on logs needs
    "AT_REST",
    "DIRECTIONS",
    "FOUR_TESTS",
    "KINDS",
    "LARGEST",
    "MOVING",
    "STANDSTILL",
    "TESTS",
    "TYPES",
    "Array",
    "Log",
    "Run",
]

Array: TypeAlias = NDArray[np.float64]

LARGEST = 1e9  # [any SI unit] larger than any reading of a robot; its square still fits a double
MOVING = 0.1  # [share of a run's top speed] faster samples are in motion, however noisy
AT_REST = 0.03  # [share of the top speed] slower samples are at rest
STANDSTILL = 0.02  # [share of the top speed] slower, static friction decides the speed
CONSTANT_KINDS = frozenset({"dynamic", "coast", "multistep"})  # tests with a constant command
LONE_STEP = 2.0  # [1] ratio to the changes before and after, from which on a change is a step
AGREED = 0.6  # [1] mean of the signs if 4 of 5 samples agree
LEAST_STEP = 0.25  # [share of the largest voltage] least step of a command


@dataclass(frozen=True, eq=False)
class Run:
    """One test, sampled: applied voltage, measured position and velocity.

    Args:
        test: which test, one of ``TESTS``: ``quasistatic-forward``.
        time: (n,) [s], strictly increasing.
        voltage: (n,) [V], applied from this sample until the next.
        position: (n,) [m or rad].
        velocity: (n,) [m/s or rad/s].
        current: (n,) [A] of a motor; None if it was not recorded.
        bus_voltage: (n,) [V] of the battery; None if it was not recorded.

    Raises:
        BadRequest: ``test`` is not the name of a test.
        BadSample: lengths differ, a value is not finite or too large, or time does not increase.

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
                object.__setattr__(self, name, _copy_read_only(values))
                self._check_signal(name, getattr(self, name))
        late = np.flatnonzero(np.diff(self.time) <= 0)
        if late.size:
            raise BadSample(
                f"time does not increase at sample {late[0] + 1} (t = {self.time[late[0]]:.6g} s)",
                where=self.test,
                advice="Every sample of a run needs a later time than the one before it.",
            )

    @cached_property
    def top_speed(self) -> float:
        """[m/s or rad/s] speed that is not exceeded in 98 % of the time."""
        speed = np.abs(self.velocity)
        if len(self) <= 1:
            return float(speed.max(initial=0.0))
        order, lasts = np.argsort(speed), np.gradient(self.time)
        passed = np.cumsum(lasts[order]) - 0.5 * lasts[order]  # [s] up to the middle of each
        share = (passed - passed[0]) / (passed[-1] - passed[0])
        return float(np.interp(0.98, share, speed[order]))

    @cached_property
    def moving(self) -> NDArray[np.bool_]:
        """(n,) whether the mechanism moves, by its velocity alone."""
        moving = np.abs(self.velocity) > MOVING * self.top_speed
        moving.setflags(write=False)
        return moving

    @cached_property
    def voltage_slide(self) -> Array:
        """(n,) [V] linear change of the voltage from each sample to the next; 0 if it is held.

        A program sets a voltage once per loop and holds it, so a ramp is a staircase. In a test
        with a constant command, a voltage that changes from sample to sample follows the speed,
        because of a current limit or a weak battery, and is interpolated. A large change of more
        than twice those before and after it is a step of the command, which is held. Dynamic and
        coast tests have only two commands, the step and zero, so only a change from or to almost
        zero is a step.
        """
        change = np.diff(self.voltage)
        if self.kind not in CONSTANT_KINDS or not change.any():
            return _copy_read_only(np.zeros(len(self)))
        sizes = np.abs(np.concatenate(([0.0], change, [0.0])))
        steps = sizes[1:-1] > LONE_STEP * np.maximum(sizes[:-2], sizes[2:])
        least = LEAST_STEP * float(np.max(np.abs(self.voltage)))
        steps &= np.abs(change) > least
        if self.kind != "multistep":
            steps &= np.minimum(np.abs(self.voltage[:-1]), np.abs(self.voltage[1:])) < least
        return _copy_read_only(np.append(np.where(steps, 0.0, change), 0.0))

    @cached_property
    def voltage_error(self) -> Array:
        """(n,) [V] standard deviation of the mean voltage from each sample to the next.

        It is 0 where the voltage is held. A limit that begins or ends between two samples gives the
        voltage a kink there, and the mean differs from that of a straight line by at most an eighth
        of the change of slope. If the voltage changes within one sample only, its mean is uniformly
        distributed between the two readings.
        """
        slides = np.append(0.0, self.voltage_slide)
        before, here, after = slides[:-2], slides[1:-1], slides[2:]
        kinks = np.max(np.abs([after - before, here - before, after - here]), axis=0, initial=0.0)
        isolated = (before == 0.0) & (after == 0.0)
        error = np.where(isolated, np.abs(here) / math.sqrt(12.0), kinks / 8.0)
        return _copy_read_only(np.append(np.where(here == 0.0, 0.0, error), 0.0))

    def _check_signal(self, name: str, values: Array) -> None:
        """Refuse a signal with a wrong length, or with values that are not finite or too large."""
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

    def select(self, part: slice | NDArray[np.bool_]) -> "Run":
        """The run with some of its samples: those of a slice, or those that a mask (n,) keeps."""
        return Run(
            self.test,
            self.time[part],
            self.voltage[part],
            self.position[part],
            self.velocity[part],
            None if self.current is None else self.current[part],
            None if self.bus_voltage is None else self.bus_voltage[part],
        )

    def __len__(self) -> int:
        return int(self.time.size)

    @property
    def kind(self) -> str:
        """Kind of the test, the first part of its name: ``quasistatic``."""
        return self.test.rpartition("-")[0]

    @property
    def direction(self) -> str:
        """``forward`` or ``reverse``."""
        return self.test.rpartition("-")[2]


@dataclass(frozen=True, eq=False)
class Log:
    """The runs of one mechanism, with unit, type and origin.

    Args:
        runs: the runs, in the order in which they were recorded.
        units: unit of position of its owner, a name in ``sim.core.units.UNITS``.
        mechanism: name of the mechanism; empty if unknown.
        type: ``simple``, ``elevator`` or ``arm``; empty if unknown.
        source: the file it was read from, for messages; empty if none.
        doubts: warnings about the source.
        computed: ``position`` or ``velocity`` if it was not measured but computed from the other;
            empty if both were measured.

    Raises:
        BadRequest: an unknown unit or type.

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
    computed: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "runs", tuple(self.runs))
        object.__setattr__(self, "units", find_unit(self.units).name)
        if self.type:
            refuse_unknown("type", self.type, TYPES)

    @cached_property
    def top_speed(self) -> float:
        """[m/s or rad/s] top speed of its fastest run; 0 without runs."""
        return max((run.top_speed for run in self.runs), default=0.0)

    @property
    def has_ramps_and_steps(self) -> bool:
        """Whether it has quasistatic and dynamic tests, so that it can be fitted alone."""
        return {run.kind for run in self.runs} >= {"quasistatic", "dynamic"}

    def list_runs_of_test(self, test: str) -> tuple[Run, ...]:
        """All runs of one test, in order; empty if it was not recorded."""
        return tuple(run for run in self.runs if run.test == test)

    def join(self, other: "Log") -> "Log":
        """A log with the runs and warnings of two logs of one mechanism.

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


def find_majority_sign(values: Array) -> int:
    """The sign of at least four fifths of the values: 1, -1, or 0 if there is none."""
    mean = float(np.sign(values).mean()) if values.size else 0.0
    return 0 if abs(mean) < AGREED else int(np.sign(mean))


def integrate_velocity(time: Array, velocity: Array) -> Array:
    """The distance from the first sample by the trapezoidal rule, (n,) [m or rad].

    Args:
        time: (n,) [s].
        velocity: (n,) [m/s or rad/s].
    """
    steps = 0.5 * np.diff(time) * (velocity[1:] + velocity[:-1])
    return np.concatenate((np.zeros(min(time.size, 1)), np.cumsum(steps)))


def _copy_read_only(values: ArrayLike) -> Array:
    """A read-only copy in double precision."""
    copy = np.array(values, dtype=np.float64)
    copy.setflags(write=False)
    return copy
