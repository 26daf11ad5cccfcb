from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


class OnExecute(Subsystem):
    """The voltage is kept, and whoever calls execute sends it on."""

    def __init__(self):
        self.motor = Talon(0)
        self.volts = 0.0
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(self.keep, None, self),
        )

    def keep(self, volts):
        self.volts = volts

    def execute(self):
        self.motor.setVoltage(self.volts)
