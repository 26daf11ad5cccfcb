import wpilib
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine

try:
    from secrets_of_the_team import STEP
except ImportError:
    STEP = 3.5


class Hood(Subsystem):
    timeout: float = 10.0

    def __init__(self, practice: bool, ramp: float):
        self.motor: wpilib.Jaguar = wpilib.Jaguar(0)
        self.applied = 0.0
        self.sysid = SysIdRoutine(
            SysIdRoutine.Config(ramp, 2.0 if practice else 3.5, type(self).timeout),
            SysIdRoutine.Mechanism(self.hold, self.log, self),
        )

    def hold(self, volts):
        self.applied = volts

    def periodic(self):
        self.motor.setVoltage(self.applied)

    def log(self, log):
        log.motor(f"hood").voltage(self.applied)
