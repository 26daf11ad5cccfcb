"""Poses, rotations and kinematics of WPILib: what they compute is unknown here.

No test of SysId depends on where a robot is. Their members are those of the base class of all
fakes, which knows none of them.
"""

from grader.robotcode.library.base import Fake, fake

GEOMETRY = "edu.wpi.first.math.geometry org.wpilib.math.geometry"
KINEMATICS = "edu.wpi.first.math.kinematics org.wpilib.math.kinematics"
IN_GEOMETRY = (
    "Rotation2d Translation2d Pose2d Transform2d Twist2d Rotation3d Translation3d Pose3d "
    "Transform3d Twist3d Quaternion"
)
IN_KINEMATICS = (
    "ChassisSpeeds SwerveModuleState SwerveModulePosition DifferentialDriveWheelSpeeds "
    "DifferentialDriveWheelPositions DifferentialDriveKinematics SwerveDriveKinematics "
    "SwerveDrive2Kinematics SwerveDrive3Kinematics SwerveDrive4Kinematics SwerveDrive6Kinematics "
    "DifferentialDriveOdometry DifferentialDriveOdometry3d SwerveDriveOdometry "
    "SwerveDriveOdometry3d MecanumDriveOdometry MecanumDriveOdometry3d"
)

for _packages, _module, _names in (
    (GEOMETRY, "wpimath.geometry", IN_GEOMETRY),
    (KINEMATICS, "wpimath.kinematics", IN_KINEMATICS),
):
    for _name in _names.split():
        _text = {"__doc__": "Where a robot is, or how it moves."}
        fake(_packages, _module)(type(Fake)(_name, (Fake,), _text))
