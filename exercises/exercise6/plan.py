"""The motion of a mechanism in a test, in closed form, from rest to rest.

    kA·v' = c + r·t - kV·v        from the moment it moves; c volts of push, r of ramp
    v(t) = (c·e + r·(t - τ·e))/kV                with e = 1 - exp(-t/τ), τ = kA/kV
    x(t) = (c·(t - τ·e) + r·(t²/2 - τ·t + τ²·e))/kV

A ramp moves from kS + kG on, with c = 0; a step has r = 0 and c = step - kS - kG. Left alone, with
0 V in brake mode, it stands after τ·v - w·τ·ln(1 + v/w), with w = (kS + kG)/kV.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

BATTERY = 12.0  # [V]
GRAVITY = 9.81  # [m/s²]
PERIOD = 0.02  # [s] between two samples
HALVINGS = 60  # of an interval: as exact as a number gets


@dataclass(frozen=True)
class Machine:
    """The facts about one mechanism that a learner knows.

    Args:
        kind: ``drivetrain``.
        symbol: of its unit of position.
        ks, kv, ka, kg: estimates [V, and V·s, V·s² for the unit].
        travel: how far it may go; None is without end.
        stall: [A] one motor draws at standstill at 12 V.
        limit: [A] the motor controller lets through.
        noise: scatter of the velocity, in units a second.
        grip: friction of wheels on carpet; 0 where nothing can slip.
        reaction: [s] from a mark to the thumb off the button.
    """

    kind: str
    symbol: str
    ks: float
    kv: float
    ka: float
    kg: float
    travel: float | None
    stall: float
    limit: float
    noise: float
    grip: float
    reaction: float

    @property
    def tau(self) -> float:
        """[s] time constant of the velocity, kA over kV."""
        return self.ka / self.kv

    @property
    def start_voltage(self) -> float:
        """[V] voltage at which it begins to move, kS + kG."""
        return self.ks + self.kg

    @property
    def free_speed(self) -> float:
        """The speed that a full battery reaches."""
        return (BATTERY - self.start_voltage) / self.kv

    @property
    def slip_voltage(self) -> float:
        """[V] voltage at which the wheels spin from standstill."""
        return self.ks + self.ka * self.grip * GRAVITY if self.grip else math.inf

    @property
    def acceleration_noise(self) -> float:
        """The noise of an acceleration that is computed from the samples before and after."""
        return self.noise / (math.sqrt(2.0) * PERIOD)

    def compute_speed(self, push: float, ramp: float, time: float) -> float:
        """The speed after a time of moving [s]."""
        e = -math.expm1(-time / self.tau)
        return (push * e + ramp * (time - self.tau * e)) / self.kv

    def compute_position(self, push: float, ramp: float, time: float) -> float:
        """The distance from the start after a time of moving [s]."""
        e, tau = -math.expm1(-time / self.tau), self.tau
        risen = time * time / 2.0 - tau * time + tau * tau * e
        return (push * (time - tau * e) + ramp * risen) / self.kv

    def compute_braking_distance(self, speed: float) -> float:
        """The braking distance with 0 V in brake mode."""
        wall = self.start_voltage / self.kv
        return self.tau * (speed - wall * math.log1p(speed / wall))


@dataclass(frozen=True)
class Plan:
    """A learner's choices: V/s, V, s, and the position at which the button is released."""

    ramp: float
    step: float
    timeout: float
    release: float  # infinite where nobody lets go before the timeout


@dataclass(frozen=True)
class Test:
    """The forward motion that a plan gives in one test.

    Args:
        machine: what moves.
        push: [V] of a step beyond kS + kG; 0 in a ramp.
        ramp: [V/s] 0 in a step.
        still: [s] from the start of the test until it moves.
        timeout: [s] after which the test ends.
        release: how far from the start the button is let go.
    """

    __test__ = False  # no test of pytest's

    machine: Machine
    push: float
    ramp: float
    still: float
    timeout: float
    release: float

    @cached_property
    def driven_time(self) -> float:
        """[s] duration of the driven motion."""
        longest = max(self.timeout - self.still, 0.0)
        if self.compute_position(longest) <= self.release:
            return longest
        released = self.find_time(self.compute_position, self.release) + self.machine.reaction
        return min(longest, released)

    @property
    def ends_at_mark(self) -> bool:
        """Whether the button is released at the mark, before the timeout."""
        return self.driven_time < self.timeout - self.still

    @property
    def end_speed(self) -> float:
        """The speed at the end of the driven motion."""
        return self.compute_speed(self.driven_time)

    @property
    def stop_position(self) -> float:
        """The distance from the start at which it stands again."""
        braking = self.machine.compute_braking_distance(self.end_speed)
        return self.compute_position(self.driven_time) + braking

    def compute_speed(self, time: float) -> float:
        """The speed after a time of moving [s]."""
        return self.machine.compute_speed(self.push, self.ramp, time)

    def compute_position(self, time: float) -> float:
        """The distance from the start after a time of moving [s]."""
        return self.machine.compute_position(self.push, self.ramp, time)

    def find_time(self, what: Callable[[float], float], value: float) -> float:
        """[s] time of motion after which an increasing quantity reaches a value."""
        low, high = 0.0, 1.0
        while what(high) < value:
            high *= 2.0
        for _ in range(HALVINGS):
            middle = (low + high) / 2.0
            low, high = (low, middle) if what(middle) >= value else (middle, high)
        return high


def quasistatic(machine: Machine, plan: Plan) -> Test:
    """The slow test of a plan."""
    still = machine.start_voltage / plan.ramp
    return Test(machine, 0.0, plan.ramp, still, plan.timeout, plan.release)


def dynamic(machine: Machine, plan: Plan) -> Test:
    """The step test of a plan."""
    push = max(plan.step - machine.start_voltage, 0.0)
    return Test(machine, push, 0.0, 0.0, plan.timeout, plan.release)
