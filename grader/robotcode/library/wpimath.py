"""Feedforwards, feedback controllers, motion profiles and filters of WPILib's math library."""

import math
from collections import deque
from dataclasses import dataclass
from enum import Enum
from statistics import median
from typing import Any

from grader.robotcode.library.base import PYTHON, Fake, Unknown, checked, fake
from grader.robotcode.library.units import CONSTANTS, Measure, base_value
from grader.robotcode.library.world import PERIOD, WORLD

NO_INERTIA = 1e-9  # [V/(m/s^2)] below this kA a motor counts as following at once
SENDABLE = "initSendable close struct proto"


def _packages(folder: str) -> str:
    return f"edu.wpi.first.math.{folder} org.wpilib.math.{folder}"


def _sign(value: float) -> float:
    """Java's signum: 0 for 0."""
    return math.copysign(1.0, value) if value else 0.0


def _unknown(*values: Any) -> Any:
    """The first value that nobody knows; None if there is none."""
    return next((one for one in values if isinstance(one, Unknown)), None)


def _add_setting(cls: type, name: str, attribute: str, kind: type = float) -> None:
    """Give a class the two methods that get and set one of its values."""

    def get(self: Any) -> kind:
        return getattr(self, attribute)

    def change(self: Any, value: kind) -> None:
        setattr(self, attribute, value)

    for method, verb in ((get, "get"), (change, "set")):
        method.__qualname__ = f"{cls.__name__}.{verb}{name}"
        setattr(cls, verb + name, checked(method))


class Feedforward(Fake):
    """What all feedforwards share: ``ks``, ``kg``, ``kv``, ``ka`` are its gains at the moment.

    ``_given``: the gains as they were passed. ``_follows``: whether the last number of
    ``calculate`` is the next velocity, as from 2027 on and in RobotPy; else an acceleration.
    """

    _follows = False

    def _register(self, period: Any, **gains: Any) -> None:
        self.kg = 0.0
        self.__dict__.update(gains)
        self._given, self._period, self._line = gains, period, WORLD.where()
        WORLD.singletons.setdefault("feedforwards", []).append(self)

    def _volts(self, velocity: Any, other: Any, angle: Any = 0.0, *, follows: bool = False) -> Any:
        """The voltage for a velocity, and for an acceleration or the velocity a loop later."""
        now, later, turned = base_value(velocity), base_value(other), base_value(angle)
        volts = _unknown(now, later, turned, self.ks, self.kg, self.kv, self.ka)
        if volts is None:
            steady = self.ks * _sign(now) + self.kg * math.cos(turned)
            if later is None or not (follows or self._follows):
                volts = steady + self.kv * now + self.ka * (later or 0.0)
            elif self.ka < NO_INERTIA:
                volts = steady + self.ks * (_sign(later) - _sign(now)) + self.kv * later
            else:  # exact for a motor whose voltage holds for a whole loop
                kept = math.exp(-self.kv / self.ka * self._period)
                gained = (1 - kept) / self.kv if self.kv else self._period / self.ka
                volts = steady + (later - kept * now) / gained
        return CONSTANTS["Volts"].of(volts) if isinstance(velocity, Measure) else volts


@fake()
class _Linear(Feedforward):
    """A feedforward whose gravity does not depend on the position."""

    def calculate(self, velocity: Any, other: Any = None) -> Any:
        return self._volts(velocity, other)

    def calculateWithVelocities(self, currentVelocity: float, nextVelocity: float) -> float:
        return self._volts(currentVelocity, nextVelocity, follows=True)


class SimpleMotorFeedforward(_Linear):
    """Of a flywheel or a drivetrain: allwpilib v2026.2.2, .../SimpleMotorFeedforward.java."""

    def __init__(self, kS: float, kV: float, kA: float = 0.0, dt: float = PERIOD) -> None:
        self._register(dt, ks=kS, kv=kV, ka=kA)


class ElevatorFeedforward(_Linear):
    """Of an elevator: allwpilib v2026.2.2, wpimath/.../ElevatorFeedforward.java."""

    def __init__(
        self, kS: float, kG: float, kV: float, kA: float = 0.0, dt: float = PERIOD
    ) -> None:
        self._register(dt, ks=kS, kg=kG, kv=kV, ka=kA)


class ArmFeedforward(ElevatorFeedforward):
    """Of an arm, whose angle is 0 where it is level: .../ArmFeedforward.java.

    WPILib lets gravity change while the arm turns during a loop; here it does not.
    """

    def calculate(  # type: ignore[override]  # as WPILib has it
        self, angle: Any, velocity: Any, other: Any = None
    ) -> Any:
        return self._volts(velocity, other, angle)

    def calculateWithVelocities(  # type: ignore[override]  # the same
        self, currentAngle: float, currentVelocity: float, nextVelocity: float
    ) -> float:
        return self._volts(currentVelocity, nextVelocity, currentAngle, follows=True)


for _gain in ("Ks", "Kv", "Ka"):
    _add_setting(_Linear, _gain, _gain.lower())
_add_setting(ElevatorFeedforward, "Kg", "kg")
ACHIEVABLE = (
    "maxAchievableVelocity minAchievableVelocity maxAchievableAcceleration "
    "minAchievableAcceleration getDt"
)
for _cls, _python in (
    (SimpleMotorFeedforward, "SimpleMotorFeedforwardMeters SimpleMotorFeedforwardRadians"),
    (ElevatorFeedforward, "ElevatorFeedforward"),
    (ArmFeedforward, "ArmFeedforward"),
):
    fake("edu.wpi.first.math.controller", complete=True, others=f"{ACHIEVABLE} {SENDABLE}")(_cls)
    _new = type(_cls.__name__, (_cls,), {"_follows": True, "__doc__": _cls.__doc__})
    fake("org.wpilib.math.controller", complete=True)(_new)
    for _name in _python.split():
        fake("", "wpimath.controller", complete=True, name=_name)(_new)


@fake(_packages("trajectory"), "wpimath.trajectory", complete=True, others="timeLeftUntil")
class TrapezoidProfile(Fake):
    """A motion profile: allwpilib v2026.2.2, wpimath/.../TrapezoidProfile.java."""

    @dataclass
    class Constraints(Fake):
        """The largest velocity and acceleration."""

        maxVelocity: float = 0.0
        maxAcceleration: float = 0.0

    @dataclass
    class State(Fake):
        """A position and a velocity."""

        position: Any = 0.0
        velocity: Any = 0.0

    def __init__(
        self, constraints: Constraints, goal: State | None = None, initial: State | None = None
    ) -> None:
        self._limits, self._total = constraints, 0.0
        self._goal, self._initial = goal, initial or TrapezoidProfile.State()  # until 2024

    def calculate(self, t: float, current: State | None = None, goal: State | None = None) -> State:
        current, goal = current or self._initial, goal or self._goal or TrapezoidProfile.State()
        limit, rate = self._limits.maxVelocity, self._limits.maxAcceleration
        states = (*vars(current).values(), *vars(goal).values())
        unknown = _unknown(t, limit, rate, *states)
        if unknown is not None:
            return TrapezoidProfile.State(unknown, unknown)
        way = -1.0 if current.position > goal.position else 1.0
        start = max(-limit, min(limit, way * current.velocity))
        end = way * goal.velocity
        # As if it started and ended at rest: that adds a time and a distance at both ends.
        before, after = start / rate, end / rate
        distance = way * (goal.position - current.position)
        distance += (start * before + end * after) / 2
        ramp = min(limit / rate, math.sqrt(max(0.0, distance / rate)))
        cruise = (distance - ramp * ramp * rate) / limit if ramp == limit / rate else 0.0
        self._total = max(0.0, 2 * ramp + cruise - before - after)
        since = t + before
        if t >= self._total:
            return goal
        if since < ramp:
            place, speed = rate * since**2 / 2, rate * since
        elif since < ramp + cruise:
            speed = rate * ramp
            place = speed * (since - ramp / 2)
        else:
            speed = rate * (2 * ramp + cruise - since)
            place = distance - speed**2 / rate / 2
        moved = place - start * before / 2
        return TrapezoidProfile.State(current.position + way * moved, way * speed)

    def totalTime(self) -> float:
        return self._total

    def isFinished(self, t: float) -> bool:
        return t >= self._total


PYTHON["wpimath.trajectory"]["TrapezoidProfileRadians"] = TrapezoidProfile


@fake()
class Controller(Fake):
    """What PIDController and ProfiledPIDController share: ``_p``, ``_i``, ``_d`` are its gains.

    ``_given``: the gains as they were passed.
    """

    def _register(self, gains: tuple[Any, ...], period: float) -> None:
        self._given, self._period, self._line = gains, period, WORLD.where()
        self._p, self._i, self._d = gains
        self._i_zone = math.inf
        self._range = (-1.0, 1.0)  # of the integral's part of the output
        self._input: tuple[float, float] | None = None
        self._tolerance = (0.05, math.inf)
        self.reset()
        WORLD.singletons.setdefault("pids", []).append(self)

    def reset(self) -> None:
        self._error = self._rate = self._sum = 0.0

    def _wrap(self, error: Any) -> Any:
        """The shorter way round, where the input is continuous."""
        if self._input is None:
            return error
        half = (self._input[1] - self._input[0]) / 2
        return MathUtil.inputModulus(error, -half, half)

    def _act(self, measurement: Any, setpoint: Any) -> Any:
        unknown = _unknown(measurement, setpoint, self._p, self._i, self._d)
        if unknown is not None:
            return unknown
        error = self._wrap(setpoint - measurement)
        self._error, self._rate = error, (error - self._error) / self._period
        if abs(error) > self._i_zone:
            self._sum = 0.0
        elif self._i:
            low, high = sorted(limit / self._i for limit in self._range)
            self._sum = max(low, min(high, self._sum + error * self._period))
        return self._p * error + self._i * self._sum + self._d * self._rate

    def setPID(self, Kp: float, Ki: float, Kd: float) -> None:
        self._p, self._i, self._d = Kp, Ki, Kd

    def setTolerance(self, error: float, rate: float = math.inf) -> None:
        self._tolerance = (error, rate)

    def setIntegratorRange(self, minimumIntegral: float, maximumIntegral: float) -> None:
        self._range = (minimumIntegral, maximumIntegral)

    def enableContinuousInput(self, minimumInput: float, maximumInput: float) -> None:
        self._input = (minimumInput, maximumInput)

    def disableContinuousInput(self) -> None:
        self._input = None

    def atSetpoint(self) -> bool:
        error, rate = self._tolerance
        return abs(self._error) <= error and abs(self._rate) <= rate

    def getPositionError(self) -> float:
        return self._error

    def getVelocityError(self) -> float:
        return self._rate

    getError, getErrorDerivative = getPositionError, getVelocityError


CONTROLLER_OTHERS = (
    f"{SENDABLE} getPeriod getAccumulatedError getPositionTolerance getVelocityTolerance "
    "getErrorTolerance getErrorDerivativeTolerance isContinuousInputEnabled"
)


@fake(_packages("controller"), "wpimath.controller", complete=True, others=CONTROLLER_OTHERS)
class PIDController(Controller):
    """A PID controller: allwpilib v2026.2.2, wpimath/.../PIDController.java."""

    def __init__(self, Kp: float, Ki: float, Kd: float, period: float = PERIOD) -> None:
        self._register((Kp, Ki, Kd), period)
        self._setpoint = 0.0

    def calculate(self, measurement: float, setpoint: float = None) -> float:  # noqa: RUF013
        self._setpoint = self._setpoint if setpoint is None else setpoint
        return self._act(measurement, self._setpoint)


@fake(_packages("controller"), "wpimath.controller", complete=True, others=CONTROLLER_OTHERS)
class ProfiledPIDController(Controller):
    """A PID controller along a profile: .../ProfiledPIDController.java."""

    def __init__(
        self,
        Kp: float,
        Ki: float,
        Kd: float,
        constraints: TrapezoidProfile.Constraints,
        period: float = PERIOD,
    ) -> None:
        self._goal = self._state = TrapezoidProfile.State()
        self._constraints = constraints
        self._register((Kp, Ki, Kd), period)

    def calculate(self, measurement: float, goal: Any = None, constraints: Any = None) -> float:
        if goal is not None:
            self.setGoal(goal)
        self._constraints = self._constraints if constraints is None else constraints
        for one in (self._goal, self._state):
            one.position = measurement + self._wrap(one.position - measurement)
        profile = TrapezoidProfile(self._constraints)
        self._state = profile.calculate(self._period, self._state, self._goal)
        return self._act(measurement, self._state.position)

    def setGoal(self, goal: Any) -> None:
        state = isinstance(goal, TrapezoidProfile.State)
        self._goal = goal if state else TrapezoidProfile.State(goal, 0.0)

    def getGoal(self) -> TrapezoidProfile.State:
        return self._goal

    def getSetpoint(self) -> TrapezoidProfile.State:
        return self._state

    def atGoal(self) -> bool:
        return self.atSetpoint() and self._goal == self._state

    def reset(self, measured: Any = None, velocity: float = 0.0) -> None:
        super().reset()
        if measured is not None:
            state = isinstance(measured, TrapezoidProfile.State)
            self._state = measured if state else TrapezoidProfile.State(measured, velocity)


for _name, _attribute in (("P", "_p"), ("I", "_i"), ("D", "_d"), ("IZone", "_i_zone")):
    _add_setting(Controller, _name, _attribute)
_add_setting(PIDController, "Setpoint", "_setpoint")
_add_setting(ProfiledPIDController, "Constraints", "_constraints", TrapezoidProfile.Constraints)
PYTHON["wpimath.controller"]["ProfiledPIDControllerRadians"] = ProfiledPIDController


@fake(_packages("controller"), "wpimath.controller")
class BangBangController(Fake):
    """Full power below the setpoint: what it gives here is unknown."""


@fake(_packages("filter"), "wpimath.filter", complete=True, others="finiteDifference highPass")
class LinearFilter(Fake):
    """A digital filter: allwpilib v2026.2.2, wpimath/.../LinearFilter.java."""

    def __init__(self, ffGains: Any, fbGains: Any) -> None:
        self._gains = (list(ffGains), list(fbGains))
        self.reset()

    @staticmethod
    def movingAverage(taps: int) -> "LinearFilter":
        return LinearFilter([1 / taps] * taps, [])

    @staticmethod
    def singlePoleIIR(timeConstant: float, period: float) -> "LinearFilter":
        kept = math.exp(-period / timeConstant)
        return LinearFilter([1 - kept], [-kept])

    def reset(self) -> None:
        self._inputs, self._outputs = (deque([0.0] * len(one), len(one)) for one in self._gains)
        self._last = 0.0

    def calculate(self, input: float) -> float:
        forward, back = self._gains
        self._inputs.appendleft(input)
        self._last = sum(a * b for a, b in zip(forward, self._inputs, strict=True))
        self._last -= sum(a * b for a, b in zip(back, self._outputs, strict=True))
        self._outputs.appendleft(self._last)
        return self._last

    def lastValue(self) -> float:
        return self._last


@fake(_packages("filter"), "wpimath.filter", complete=True, others="lastValue")
class MedianFilter(Fake):
    """The middle of the last values: allwpilib v2026.2.2, wpimath/.../MedianFilter.java."""

    def __init__(self, size: int) -> None:
        self._values: deque[Any] = deque(maxlen=size)

    def calculate(self, next: float) -> float:
        self._values.append(next)
        unknown = _unknown(*self._values)
        return median(self._values) if unknown is None else unknown

    def reset(self) -> None:
        self._values.clear()


@fake(_packages("filter"), "wpimath.filter", complete=True, others="setLimit")
class SlewRateLimiter(Fake):
    """Limits how fast a value changes: allwpilib v2026.2.2, wpimath/.../SlewRateLimiter.java."""

    def __init__(self, rate: float, negative: float = None, initialValue: float = 0.0) -> None:  # noqa: RUF013
        self._rates = (-rate if negative is None else negative, rate)
        self.reset(initialValue)

    def calculate(self, input: float) -> float:
        low, high = (rate * (WORLD.time - self._time) for rate in self._rates)
        change = input - self._value
        known = _unknown(change, low, high) is None
        self.reset(self._value + max(low, min(high, change)) if known else input)
        return self._value

    def lastValue(self) -> float:
        return self._value

    def reset(self, value: float) -> None:
        self._value, self._time = value, WORLD.time


@fake(_packages("filter"), "wpimath.filter")
class Debouncer(Fake):
    """Waits until a change lasts: allwpilib v2026.2.2, wpimath/.../Debouncer.java."""

    class DebounceType(Enum):
        """Which change has to last."""

        kRising = RISING = 0
        kFalling = FALLING = 1
        kBoth = BOTH = 2

    def __init__(self, debounceTime: float, type: Enum = DebounceType.kRising) -> None:
        self._needed, self._type = debounceTime, type
        self._value = type is self.DebounceType.kFalling
        self._since = WORLD.time

    def calculate(self, input: bool) -> bool:
        waits = self._type.value in (2, 1 - int(input))
        if input == self._value:
            self._since = WORLD.time
        elif not waits or WORLD.time - self._since >= self._needed:
            self._value = input
        return self._value


@fake("edu.wpi.first.math org.wpilib.math.linalg")
class Vector(Fake):
    """A matrix of one column: allwpilib v2026.2.2, wpimath/.../math/Vector.java."""


@fake("edu.wpi.first.math org.wpilib.math.util", complete=True, others="isNear copyDirectionPow")
class MathUtil(Fake):
    """Small functions: allwpilib v2026.2.2, wpimath/.../MathUtil.java."""

    @staticmethod
    def clamp(value: float, low: float, high: float) -> float:
        unknown = _unknown(value, low, high)
        return max(low, min(high, value)) if unknown is None else unknown

    @staticmethod
    def applyDeadband(value: float, deadband: float, maxMagnitude: float = 1.0) -> float:
        if isinstance(value, Unknown):
            return value
        if abs(value) <= deadband:
            return 0.0
        share = (abs(value) - deadband) / (maxMagnitude - deadband)
        return math.copysign(share * maxMagnitude, value)

    @staticmethod
    def inputModulus(input: float, minimumInput: float, maximumInput: float) -> float:
        return (input - minimumInput) % (maximumInput - minimumInput) + minimumInput

    @staticmethod
    def angleModulus(angleRadians: float) -> float:
        return MathUtil.inputModulus(angleRadians, -math.pi, math.pi)

    @staticmethod
    def interpolate(startValue: float, endValue: float, t: float) -> float:
        return startValue + (endValue - startValue) * MathUtil.clamp(t, 0.0, 1.0)


for _name in ("applyDeadband", "inputModulus", "angleModulus"):
    PYTHON.setdefault("wpimath", {})[_name] = getattr(MathUtil, _name)
