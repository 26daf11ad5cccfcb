from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkMax


class ByName(Subsystem):
    """The method's name is a string: what is called cannot be read off."""

    def __init__(self):
        self.motor = PWMSparkMax(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(getattr(self.motor, "setVoltage"), lambda log: None, self),
        )
