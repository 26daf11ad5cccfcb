"""Feedforwards, feedback controllers, motion profiles and filters of WPILib's math library."""

import math
from typing import Any

from grader.robotcode.library.base import PYTHON, TABLES, Fake, Unknown, checked, fake
from grader.robotcode.library.world import PERIOD, WORLD


def _list_packages(folder: str) -> str:
    return f"edu.wpi.first.math.{folder} org.wpilib.math.{folder}"


def _find_unknown(*values: Any) -> Any:
    """The first unknown value; None if there is none."""
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
    """What all feedforwards share: gains ``ks``, ``kg``, ``kv``, ``ka``, and the time step ``dt``.

    What it computes is unknown: no test of SysId depends on it.
    """

    def _register_gains(self, **gains: Any) -> None:
        self.kg = 0.0
        self.__dict__.update(gains)
        self._line = WORLD.where()
        WORLD.feedforwards.append(self)


class SimpleMotorFeedforward(Feedforward):
    """Feedforward without gravity: allwpilib v2026.2.2, .../SimpleMotorFeedforward.java."""

    def __init__(self, kS: float, kV: float, kA: float = 0.0, dt: float = PERIOD) -> None:
        self._register_gains(ks=kS, kv=kV, ka=kA, dt=dt)


class ElevatorFeedforward(Feedforward):
    """Feedforward of an elevator: allwpilib v2026.2.2, wpimath/.../ElevatorFeedforward.java."""

    def __init__(
        self, kS: float, kG: float, kV: float, kA: float = 0.0, dt: float = PERIOD
    ) -> None:
        self._register_gains(ks=kS, kg=kG, kv=kV, ka=kA, dt=dt)


class ArmFeedforward(ElevatorFeedforward):
    """Feedforward of an arm, whose angle is 0 when level: .../ArmFeedforward.java."""


for _gain in ("Ks", "Kv", "Ka"):
    _add_setting(Feedforward, _gain, _gain.lower())
_add_setting(ElevatorFeedforward, "Kg", "kg")
for _cls in (SimpleMotorFeedforward, ElevatorFeedforward, ArmFeedforward):
    fake(
        _list_packages("controller"),
        "wpimath.controller",
        complete=True,
        others=TABLES["others"]["feedforwards"],
    )(_cls)
for _unit in ("Meters", "Radians"):  # RobotPy has it under two names
    PYTHON["wpimath.controller"][f"SimpleMotorFeedforward{_unit}"] = SimpleMotorFeedforward
del PYTHON["wpimath.controller"]["SimpleMotorFeedforward"]


@fake(_list_packages("trajectory"), "wpimath.trajectory")
class TrapezoidProfile(Fake):
    """A motion profile, whose course is unknown: wpimath/.../TrapezoidProfile.java."""

    class Constraints(Fake):
        """The largest velocity and acceleration."""

    class State(Fake):
        """A position and a velocity."""


PYTHON["wpimath.trajectory"]["TrapezoidProfileRadians"] = TrapezoidProfile


class Controller(Fake):
    """What PIDController and ProfiledPIDController share: ``_p``, ``_i``, ``_d`` are its gains.

    What it computes is unknown: no test of SysId depends on it.
    """

    def __init__(self, Kp: float, Ki: float, Kd: float, *_more: Any) -> None:
        self._line = WORLD.where()
        self._i_zone = math.inf
        self.setPID(Kp, Ki, Kd)
        WORLD.pids.append(self)

    def setPID(self, Kp: float, Ki: float, Kd: float) -> None:
        self._p, self._i, self._d = Kp, Ki, Kd


@fake(_list_packages("controller"), "wpimath.controller", complete=True)
class PIDController(Controller):
    """A PID controller: allwpilib v2026.2.2, wpimath/.../PIDController.java."""


@fake(_list_packages("controller"), "wpimath.controller")
class ProfiledPIDController(Controller):
    """A PID controller along a profile: .../ProfiledPIDController.java."""


for _name, _attribute in (("P", "_p"), ("I", "_i"), ("D", "_d"), ("IZone", "_i_zone")):
    _add_setting(Controller, _name, _attribute)
PYTHON["wpimath.controller"]["ProfiledPIDControllerRadians"] = ProfiledPIDController


@fake("edu.wpi.first.math org.wpilib.math.util", complete=True)
class MathUtil(Fake):
    """Small functions: allwpilib v2026.2.2, wpimath/.../MathUtil.java."""

    @staticmethod
    def clamp(value: float, low: float, high: float) -> float:
        unknown = _find_unknown(value, low, high)
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
