from commands2 import Subsystem as Part
from commands2.sysid import SysIdRoutine as Routine
from wpilib import PWMSparkMax as Motor

Config, Mechanism = Routine.Config, Routine.Mechanism


class Renamed(Part):
    def __init__(self):
        self.wheel = Motor(4)
        self.tests = Routine(Config(0.5, 3.5, 10), Mechanism(self.go, self.note, self))

    go = lambda self, volts: self.wheel.setVoltage(volts)

    def note(self, log):
        log.motor("wheel").voltage(self.wheel.getVoltage())
