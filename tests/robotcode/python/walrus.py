from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMVictorSPX


class Walrus(Subsystem):
    def __init__(self):
        self.motor = PWMVictorSPX(2)
        self.routine = SysIdRoutine(
            config := SysIdRoutine.Config(rampRate=(ramp := 0.5), stepVoltage=ramp * 7, timeout=10),
            SysIdRoutine.Mechanism(self.drive, lambda log: None, self),
        )
        self.slow = config

    def drive(self, volts):
        if (limited := max(-8.0, min(volts, 8.0))) is not None:
            self.motor.setVoltage(limited)
