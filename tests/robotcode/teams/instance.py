from dataclasses import dataclass

from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon

NUMBERS = {"timeout": 10}


@dataclass
class Tests:
    ramp: float = 0.5
    step: float = 3.5


SLOW = Tests()
FAST = Tests(step=7.0)


class Instance(Subsystem):
    """Numbers in objects and dictionaries: an object may be made with others than the class's."""

    def __init__(self):
        self.motor = Talon(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(SLOW.ramp, FAST.step, NUMBERS["timeout"]),
            SysIdRoutine.Mechanism(lambda v, motor=self.motor: motor.setVoltage(v), None, self),
        )
