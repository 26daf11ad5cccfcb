import functools
from functools import partial

from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkMax


class BoundEarly(Subsystem):
    """The motor is bound before the test brings the voltage."""

    def __init__(self):
        self.front = PWMSparkMax(0)
        self.back = PWMSparkMax(1)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(
                partial(self.push, self.front, self.back),
                functools.partial(self.note, name="both"),
                self,
            ),
        )

    def push(self, one, other, volts):
        one.setVoltage(volts)
        other.setVoltage(volts)

    def note(self, log, name):
        log.motor(name).voltage(self.front.getVoltage())
