from commands2 import Subsystem
from commands2.sysid import SysIdRoutine


class Arm(Subsystem):
    def __init__(self):
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10.0,
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )
