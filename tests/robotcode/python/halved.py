import wpilib
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpimath.controller import PIDController, SimpleMotorFeedforwardMeters


class Halved(Subsystem):
    """Four motors, four changes on the way."""

    def __init__(self):
        self.one = wpilib.PWMSparkMax(0)
        self.two = wpilib.PWMSparkMax(1)
        self.three = wpilib.PWMSparkMax(2)
        self.four = wpilib.PWMSparkMax(3)
        self.pid = PIDController(1, 0, 0)
        self.feedforward = SimpleMotorFeedforwardMeters(0.1, 2.0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(stepVoltage=3.5, rampRate=0.5, timeout=10),
            SysIdRoutine.Mechanism(log=lambda log: None, drive=self.drive, subsystem=self),
        )

    def drive(self, volts):
        half = volts / 2
        self.one.setVoltage(half)
        self.two.setVoltage(half * 2)
        self.three.setVoltage(self.pid.calculate(self.three.get(), volts))
        self.four.set(volts / wpilib.RobotController.getBatteryVoltage())
