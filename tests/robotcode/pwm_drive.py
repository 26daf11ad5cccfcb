import typing

from commands2 import Command, Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Encoder, PWMSparkMax, RobotController
from wpilib.drive import DifferentialDrive
from wpilib.sysid import SysIdRoutineLog
from wpimath.units import volts


class Drive(Subsystem):
    """Tank drive with PWM controllers; the second motor of each side follows."""

    def __init__(self) -> None:
        self.left = PWMSparkMax(0)
        self.right = PWMSparkMax(1)
        left_back = PWMSparkMax(2)
        self.right_back = PWMSparkMax(3)
        self.left.addFollower(left_back)
        self.right.addFollower(self.right_back)
        self.right.setInverted(True)
        self.drive = DifferentialDrive(self.left, self.right)
        self.left_encoder = Encoder(0, 1)
        self.right_encoder = Encoder(2, 3)

        # Ask for a voltage, whatever the battery gives.
        def apply(voltage: volts) -> None:
            self.left.setVoltage(voltage)
            self.right.setVoltage(voltage)

        def log(sys_id: SysIdRoutineLog) -> None:
            sys_id.motor("left").voltage(
                self.left.get() * RobotController.getBatteryVoltage()
            ).position(self.left_encoder.getDistance()).velocity(self.left_encoder.getRate())
            sys_id.motor("right").voltage(
                self.right.get() * RobotController.getBatteryVoltage()
            ).position(self.right_encoder.getDistance()).velocity(self.right_encoder.getRate())

        self.routine = SysIdRoutine(
            SysIdRoutine.Config(), SysIdRoutine.Mechanism(apply, log, self)
        )

    def quasistatic(self, direction: SysIdRoutine.Direction) -> Command:
        return self.routine.quasistatic(direction)
