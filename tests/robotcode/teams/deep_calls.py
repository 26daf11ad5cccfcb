from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


class DeepCalls(Subsystem):
    def __init__(self):
        self.motor = Talon(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10), SysIdRoutine.Mechanism(self.a, None, self)
        )

    def a(self, volts):
        self.b(volts)

    def b(self, volts):
        self.c(volts=volts)

    def c(self, volts):
        self.d(*[volts])

    def d(self, volts):
        self.motor.setVoltage(volts)
