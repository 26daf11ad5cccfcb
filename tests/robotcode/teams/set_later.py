from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


class SetLater(Subsystem):
    """The config is changed after it was made."""

    def __init__(self):
        self.motor = Talon(0)
        config = SysIdRoutine.Config(0.5, 3.5, 10)
        config.stepVoltage = 7.0
        self.routine = SysIdRoutine(config, SysIdRoutine.Mechanism(self.drive, None, self))

    def drive(self, volts):
        self.motor.setVoltage(volts)
