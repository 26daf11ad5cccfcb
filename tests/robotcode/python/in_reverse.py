from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkMax


class InReverse(Subsystem):
    """First the Mechanism, then the Config; timeout before ramp; no self."""

    def __init__(self):
        self.motor = PWMSparkMax(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Mechanism(self.drive, self.log), SysIdRoutine.Config(10, 3.5, 0.5)
        )

    def drive(self, volts):
        self.motor.setVoltage(volts)

    def log(self, log):
        pass
