from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkMax


def sender(target):
    """A callback for one motor."""

    def send(volts):
        target.setVoltage(volts)

    return send


class MadeToOrder(Subsystem):
    def __init__(self):
        self.hook = PWMSparkMax(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(sender(self.hook), lambda log: None, self),
        )
