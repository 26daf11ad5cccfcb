import functools

from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


def announced(function):
    @functools.wraps(function)
    def inner(*args):
        print(function.__name__)
        return function(*args)

    return inner


class Dressed(Subsystem):
    """Decorators, a property, a static method."""

    def __init__(self):
        self._motor = Talon(0)
        self.routine = SysIdRoutine(self.config(), self.mechanism)

    @property
    def mechanism(self):
        return SysIdRoutine.Mechanism(self.drive, self.log, self)

    @staticmethod
    def config():
        return SysIdRoutine.Config(0.5, 3.5, 10)

    @property
    def motor(self):
        return self._motor

    @announced
    def drive(self, volts):
        self.motor.setVoltage(volts)

    @announced
    def log(self, log):
        log.motor("dressed").voltage(self.motor.getVoltage())
