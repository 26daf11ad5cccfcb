from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from rev import SparkLowLevel, SparkMax


class SwerveModules(Subsystem):
    """Two drive motors, each logged in meters."""

    def __init__(self) -> None:
        super().__init__()
        self.left = SparkMax(1, SparkLowLevel.MotorType.kBrushless)
        self.right = SparkMax(3, SparkLowLevel.MotorType.kBrushless)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.0, 8.0),
            SysIdRoutine.Mechanism(self.drive, self.log, self, "swerve"),
        )

    def drive(self, volts: float) -> None:
        self.left.setVoltage(volts)
        self.right.setVoltage(volts)

    def log(self, log) -> None:
        for name, motor in (("left", self.left), ("right", self.right)):
            log.motor(name).voltage(motor.getAppliedOutput() * motor.getBusVoltage()).position(
                motor.getEncoder().getPosition()
            ).velocity(motor.getEncoder().getVelocity())
