"""Poses, rotations and drivetrain kinematics of WPILib."""

import math
from dataclasses import make_dataclass
from typing import Any

from grader.robotcode.library.base import Fake, Unknown, fake
from grader.robotcode.library.units import base_value

GEOMETRY = "edu.wpi.first.math.geometry org.wpilib.math.geometry"
KINEMATICS = "edu.wpi.first.math.kinematics org.wpilib.math.kinematics"


@fake(GEOMETRY, "wpimath.geometry")
class Rotation2d(Fake):
    """An angle in the plane: allwpilib v2026.2.2, wpimath/.../Rotation2d.java."""

    def __init__(self, first: Any = 0.0, y: Any = None) -> None:
        self._angle: Any = base_value(first) if y is None else math.atan2(y, first)

    @staticmethod
    def fromDegrees(degrees: float) -> "Rotation2d":
        return Rotation2d(degrees * math.pi / 180)

    @staticmethod
    def fromRotations(rotations: float) -> "Rotation2d":
        return Rotation2d(rotations * math.tau)

    def getRadians(self) -> float:
        return self._angle

    def getDegrees(self) -> float:
        return self._angle * 180 / math.pi

    def getRotations(self) -> float:
        return self._angle / math.tau

    def getCos(self) -> float:
        unknown = isinstance(self._angle, Unknown)
        return self._angle if unknown else math.cos(self._angle)

    def getSin(self) -> float:
        unknown = isinstance(self._angle, Unknown)
        return self._angle if unknown else math.sin(self._angle)

    def plus(self, other: "Rotation2d") -> "Rotation2d":
        return Rotation2d(self._angle + other._angle)

    def minus(self, other: "Rotation2d") -> "Rotation2d":
        return Rotation2d(self._angle - other._angle)

    def times(self, scalar: float) -> "Rotation2d":
        return Rotation2d(self._angle * scalar)

    def unaryMinus(self) -> "Rotation2d":
        return Rotation2d(-self._angle)

    radians, degrees, cos, sin = getRadians, getDegrees, getCos, getSin
    __add__, __sub__, __mul__, __neg__ = plus, minus, times, unaryMinus
    rotateBy = plus


Rotation2d.kZero, Rotation2d.kPi = Rotation2d(), Rotation2d(math.pi)
Rotation2d.kCCW_90deg, Rotation2d.kCW_90deg = Rotation2d(math.pi / 2), Rotation2d(-math.pi / 2)


@fake(GEOMETRY, "wpimath.geometry")
class Translation2d(Fake):
    """A place in the plane [m]: allwpilib v2026.2.2, wpimath/.../Translation2d.java."""

    def __init__(self, x: Any = 0.0, y: Any = 0.0) -> None:
        turned = isinstance(y, Rotation2d)
        self._x = x * y.getCos() if turned else base_value(x)
        self._y = x * y.getSin() if turned else base_value(y)

    def getX(self) -> float:
        return self._x

    def getY(self) -> float:
        return self._y

    def getNorm(self) -> float:
        return (self._x**2 + self._y**2) ** 0.5

    def getDistance(self, other: "Translation2d") -> float:
        return self.minus(other).getNorm()

    def getAngle(self) -> Rotation2d:
        return Rotation2d(self._x, self._y)

    def plus(self, other: "Translation2d") -> "Translation2d":
        return Translation2d(self._x + other._x, self._y + other._y)

    def minus(self, other: "Translation2d") -> "Translation2d":
        return Translation2d(self._x - other._x, self._y - other._y)

    def times(self, scalar: float) -> "Translation2d":
        return Translation2d(self._x * scalar, self._y * scalar)

    def rotateBy(self, other: Rotation2d) -> "Translation2d":
        cos, sin = other.getCos(), other.getSin()
        return Translation2d(self._x * cos - self._y * sin, self._x * sin + self._y * cos)

    X, Y, norm, angle, distance = getX, getY, getNorm, getAngle, getDistance
    __add__, __sub__, __mul__ = plus, minus, times


@fake(GEOMETRY, "wpimath.geometry")
class Pose2d(Fake):
    """A place and a heading: allwpilib v2026.2.2, wpimath/.../Pose2d.java."""

    def __init__(self, first: Any = 0.0, second: Any = 0.0, third: Any = Rotation2d.kZero) -> None:
        place = isinstance(first, Translation2d)
        self._place = first if place else Translation2d(first, second)
        self._turned = second if place else third

    def getTranslation(self) -> Translation2d:
        return self._place

    def getRotation(self) -> Rotation2d:
        return self._turned

    def getX(self) -> float:
        return self._place._x

    def getY(self) -> float:
        return self._place._y

    X, Y, translation, rotation = getX, getY, getTranslation, getRotation


@fake(GEOMETRY, "wpimath.geometry")
class Transform2d(Pose2d):
    """How one pose lies from another: allwpilib v2026.2.2, wpimath/.../Transform2d.java."""


for _name in ("Rotation3d", "Translation3d", "Pose3d", "Transform3d", "Twist3d", "Quaternion"):
    fake(GEOMETRY, "wpimath.geometry")(type(Fake)(_name, (Fake,), {"__doc__": "In space."}))


def _make_record(packages: str, python: str, called: str, **names: str) -> type[Fake]:
    """A class with nothing but fields.

    Args:
        packages: of Java.
        python: module of RobotPy.
        called: the class's name.
        names: a field's name in RobotPy, and the one that it has in Java.
    """

    def convert(self: Any) -> None:
        vars(self).update({name: base_value(value) for name, value in vars(self).items()})

    members: dict[str, Any] = {"__post_init__": convert}
    for name, java in names.items():
        if java != name:
            members[java] = property(
                lambda self, name=name: getattr(self, name),
                lambda self, value, name=name: setattr(self, name, value),
            )
    fields = [(name, Any, Rotation2d() if name == "angle" else 0.0) for name in names]
    return fake(packages, python)(make_dataclass(called, fields, bases=(Fake,), namespace=members))


Twist2d = _make_record(GEOMETRY, "wpimath.geometry", "Twist2d", dx="dx", dy="dy", dtheta="dtheta")
RECORDS = {  # of kinematics: the fields in RobotPy and in Java
    "ChassisSpeeds": {
        "vx": "vxMetersPerSecond",
        "vy": "vyMetersPerSecond",
        "omega": "omegaRadiansPerSecond",
    },
    "SwerveModuleState": {"speed": "speedMetersPerSecond", "angle": "angle"},
    "SwerveModulePosition": {"distance": "distanceMeters", "angle": "angle"},
    "DifferentialDriveWheelSpeeds": {
        "left": "leftMetersPerSecond",
        "right": "rightMetersPerSecond",
    },
    "DifferentialDriveWheelPositions": {"left": "leftMeters", "right": "rightMeters"},
}
(
    ChassisSpeeds,
    SwerveModuleState,
    SwerveModulePosition,
    DifferentialDriveWheelSpeeds,
    DifferentialDriveWheelPositions,
) = (
    _make_record(KINEMATICS, "wpimath.kinematics", called, **names)
    for called, names in RECORDS.items()
)


@fake(KINEMATICS, "wpimath.kinematics")
class DifferentialDriveKinematics(Fake):
    """Wheel speeds of a robot's motion, and back: .../DifferentialDriveKinematics.java."""

    def __init__(self, trackWidth: Any) -> None:
        self.trackWidth = self.trackWidthMeters = base_value(trackWidth)

    def toWheelSpeeds(self, chassisSpeeds: ChassisSpeeds) -> DifferentialDriveWheelSpeeds:
        turn = chassisSpeeds.omega * self.trackWidth / 2
        return DifferentialDriveWheelSpeeds(chassisSpeeds.vx - turn, chassisSpeeds.vx + turn)

    def toChassisSpeeds(self, speeds: DifferentialDriveWheelSpeeds) -> ChassisSpeeds:
        turn = (speeds.right - speeds.left) / self.trackWidth
        return ChassisSpeeds((speeds.left + speeds.right) / 2, 0.0, turn)


for _name in (
    *("SwerveDriveOdometry", "MecanumDriveOdometry", "DifferentialDriveOdometry3d"),
    *("SwerveDriveOdometry3d", "MecanumDriveOdometry3d"),
):
    _text = {"__doc__": "Where the robot is, by its wheels."}
    fake(KINEMATICS, "wpimath.kinematics")(type(Fake)(_name, (Fake,), _text))
ORIGIN = Pose2d()


@fake(KINEMATICS, "wpimath.kinematics")
class DifferentialDriveOdometry(Fake):
    """Where the robot is: allwpilib v2026.2.2, wpimath/.../DifferentialDriveOdometry.java.

    It takes the way of a loop for straight, along the mean of both headings.
    """

    def __init__(
        self, gyroAngle: Rotation2d, leftDistance: Any, rightDistance: Any, pose: Any = ORIGIN
    ) -> None:
        self.resetPosition(gyroAngle, leftDistance, rightDistance, pose)

    def resetPosition(
        self, gyroAngle: Rotation2d, leftDistance: Any, rightDistance: Any, pose: Any
    ) -> None:
        self._last = (base_value(leftDistance) + base_value(rightDistance)) / 2
        self._pose, self._offset = pose, pose._turned.minus(gyroAngle)

    def getPoseMeters(self) -> Pose2d:
        return self._pose

    def update(self, gyroAngle: Rotation2d, leftDistance: Any, rightDistance: Any) -> Pose2d:
        heading = gyroAngle.plus(self._offset)
        driven = (base_value(leftDistance) + base_value(rightDistance)) / 2
        mean = self._pose._turned.plus(heading).times(0.5)
        place = self._pose._place.plus(Translation2d(driven - self._last, mean))
        self._last, self._pose = driven, Pose2d(place, heading)
        return self._pose

    getPose = getPoseMeters


@fake(KINEMATICS, "wpimath.kinematics")
class SwerveDriveKinematics(Fake):
    """Module states of a robot's motion: what it gives here is unknown."""

    def __init__(self, *modules: Any) -> None:
        self._modules = modules


for _count in (2, 3, 4, 6):
    fake("", "wpimath.kinematics", name=f"SwerveDrive{_count}Kinematics")(SwerveDriveKinematics)
