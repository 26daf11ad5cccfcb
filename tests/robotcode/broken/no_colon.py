from commands2 import Subsystem
from commands2.sysid import SysIdRoutine


class NoColon(Subsystem):
    def __init__(self)
        self.routine = SysIdRoutine(SysIdRoutine.Config(), None)
