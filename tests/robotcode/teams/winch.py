from commands2.sysid import SysIdRoutine
from winch_base import WinchBase


class Winch(WinchBase):
    """Motor, callbacks and step come from the class above."""

    def __init__(self):
        super().__init__(3)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, self.STEP, 10),
            SysIdRoutine.Mechanism(self.push, self.record, self),
        )

    def record(self, log):
        super().note(log)
