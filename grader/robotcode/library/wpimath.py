"""Feedforwards, feedback controllers, motion profiles and filters of WPILib's math library."""

import math
from typing import Any

from grader.robotcode.library.base import PYTHON, TABLES, Fake, Unknown, checked, fake
from grader.robotcode.library.units import CONSTANTS, Measure, base_value
from grader.robotcode.library.world import PERIOD, WORLD

NO_INERTIA = 1e-9  # [V/(m/s^2)] below this kA a motor counts as following at once


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
_others = TABLES["others"]["feedforwards"]
for _cls, _python in (
    (SimpleMotorFeedforward, "SimpleMotorFeedforwardMeters SimpleMotorFeedforwardRadians"),
    (ElevatorFeedforward, "ElevatorFeedforward"),
    (ArmFeedforward, "ArmFeedforward"),
):
    fake("edu.wpi.first.math.controller", complete=True, others=TABLES["others"]["feedforwards"])(
        _cls
    )
    _new = type(_cls.__name__, (_cls,), {"_follows": True, "__doc__": _cls.__doc__})
    fake("org.wpilib.math.controller", complete=True)(_new)
    for _name in _python.split():
        fake("", "wpimath.controller", complete=True, name=_name)(_new)


@fake(_packages("trajectory"), "wpimath.trajectory")
class TrapezoidProfile(Fake):
    """A motion profile, whose course is unknown: wpimath/.../TrapezoidProfile.java."""

    class Constraints(Fake):
        """The largest velocity and acceleration."""

    class State(Fake):
        """A position and a velocity."""


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
        self.reset()
        WORLD.singletons.setdefault("pids", []).append(self)

    def reset(self) -> None:
        self._error = self._rate = self._sum = 0.0

    def _act(self, measurement: Any, setpoint: Any) -> Any:
        unknown = _unknown(measurement, setpoint, self._p, self._i, self._d)
        if unknown is not None:
            return unknown
        error = setpoint - measurement
        self._error, self._rate = error, (error - self._error) / self._period
        self._sum += error * self._period
        return self._p * error + self._i * self._sum + self._d * self._rate

    def setPID(self, Kp: float, Ki: float, Kd: float) -> None:
        self._p, self._i, self._d = Kp, Ki, Kd


@fake(_packages("controller"), "wpimath.controller", complete=True)
class PIDController(Controller):
    """A PID controller: allwpilib v2026.2.2, wpimath/.../PIDController.java."""

    def __init__(self, Kp: float, Ki: float, Kd: float, period: float = PERIOD) -> None:
        self._register((Kp, Ki, Kd), period)
        self._setpoint = 0.0

    def calculate(self, measurement: float, setpoint: float = None) -> float:  # noqa: RUF013
        self._setpoint = self._setpoint if setpoint is None else setpoint
        return self._act(measurement, self._setpoint)


@fake(_packages("controller"), "wpimath.controller")
class ProfiledPIDController(Controller):
    """A PID controller along a profile, whose output is unknown: .../ProfiledPIDController.java."""

    def __init__(
        self, Kp: float, Ki: float, Kd: float, constraints: Any, period: float = PERIOD
    ) -> None:
        self._register((Kp, Ki, Kd), period)

    def reset(self, *_measured: Any) -> None:
        super().reset()


for _name, _attribute in (("P", "_p"), ("I", "_i"), ("D", "_d"), ("IZone", "_i_zone")):
    _add_setting(Controller, _name, _attribute)
_add_setting(PIDController, "Setpoint", "_setpoint")
PYTHON["wpimath.controller"]["ProfiledPIDControllerRadians"] = ProfiledPIDController


UNKNOWN = {  # folder -> classes of which nothing is known here
    "controller": "BangBangController",
    "filter": "LinearFilter MedianFilter SlewRateLimiter Debouncer",
    "linalg": "Vector Matrix VecBuilder",
}
for _folder, _names in UNKNOWN.items():
    for _name in _names.split():
        _class = type(Fake)(_name, (Fake,), {"__doc__": "What it computes is unknown."})
        fake(f"{_packages(_folder)} edu.wpi.first.math", f"wpimath.{_folder}")(_class)


@fake("edu.wpi.first.math org.wpilib.math.util", complete=True)
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


for _name in ("applyDeadband", "inputModulus", "angleModulus"):
    PYTHON.setdefault("wpimath", {})[_name] = getattr(MathUtil, _name)
