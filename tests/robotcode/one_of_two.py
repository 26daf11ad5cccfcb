from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import VictorSP


class Intake(Subsystem):
    def __init__(self):
        self.left, self.right = VictorSP(0), VictorSP(1)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10.0),
            SysIdRoutine.Mechanism(lambda v: self.left.setVoltage(-v), lambda log: None, self),
        )
