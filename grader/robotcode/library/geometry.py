"""Poses, rotations and kinematics of WPILib: what most of them compute is unknown here.

No test of SysId depends on where a robot is, so most members are those of the base class of all
fakes, which knows none of them. But what a mechanism measures goes through the classes below.
"""

import math
from typing import Any

from grader.robotcode.library.base import Fake, fake
from grader.robotcode.library.units import CONSTANTS, Measure

GEOMETRY = "edu.wpi.first.math.geometry org.wpilib.math.geometry"
KINEMATICS = "edu.wpi.first.math.kinematics org.wpilib.math.kinematics"


def _to_number(value: Any, unit: str) -> Any:
    """A number, or a measure in a unit."""
    return value.in_(CONSTANTS[unit]) if isinstance(value, Measure) else value


@fake(GEOMETRY, "wpimath.geometry")
class Rotation2d(Fake):
    """An angle (allwpilib v2026.2.2, wpimath/.../geometry/Rotation2d.java)."""

    def __init__(self, first: Any = 0.0, second: Any = None) -> None:
        radians = _to_number(first, "Radians")
        self._radians = radians if second is None else math.atan2(second, first)

    @staticmethod
    def fromRadians(value: float) -> "Rotation2d":
        return Rotation2d(value)

    @staticmethod
    def fromDegrees(value: float) -> "Rotation2d":
        return Rotation2d(value * (math.pi / 180))

    @staticmethod
    def fromRotations(value: float) -> "Rotation2d":
        return Rotation2d(value * math.tau)

    def getRadians(self) -> float:
        return self._radians

    def getDegrees(self) -> float:
        return self._radians * (180 / math.pi)

    def getRotations(self) -> float:
        return self._radians / math.tau

    def getMeasure(self) -> Measure:
        return CONSTANTS["Radians"].of(self._radians)

    radians, degrees = getRadians, getDegrees


@fake(KINEMATICS, "wpimath.kinematics")
class SwerveModulePosition(Fake):
    """The driven distance of a module (.../kinematics/SwerveModulePosition.java)."""

    def __init__(self, distance: Any = 0.0, angle: Any = None) -> None:
        self.distance = self.distanceMeters = _to_number(distance, "Meters")
        self.angle = Rotation2d() if angle is None else angle


@fake(KINEMATICS, "wpimath.kinematics")
class SwerveModuleState(Fake):
    """The speed and angle of a module (.../kinematics/SwerveModuleState.java)."""

    def __init__(self, speed: Any = 0.0, angle: Any = None) -> None:
        self.speed = self.speedMetersPerSecond = _to_number(speed, "MetersPerSecond")
        self.angle = Rotation2d() if angle is None else angle
