from commands2.sysid import SysIdRoutine


class Arm:
    def __init__(self):
    self.routine = SysIdRoutine(SysIdRoutine.Config(), None)
