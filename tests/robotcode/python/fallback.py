try:
    from commands2.sysid import SysIdRoutine
except ImportError:
    SysIdRoutine = None

from commands2 import Subsystem
from wpilib import MotorControllerGroup, PWMSparkMax


class Fallback(Subsystem):
    def __init__(self):
        self.left = PWMSparkMax(0)
        self.right = PWMSparkMax(1)
        self.both = MotorControllerGroup(self.left, self.right)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(
                lambda volts: self.both.setVoltage(volts), lambda log: self.log(log), self
            ),
        )

    def log(self, log):
        log.motor("both").voltage(self.left.getVoltage()).current(self.amps)
