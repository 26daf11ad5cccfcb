import constants as c
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from constants import Lift as Numbers
from wpilib import PWMSparkMax


class Lift(Subsystem):
    def __init__(self):
        self.motor = PWMSparkMax(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(c.RAMP, Numbers.STEP, c.Lift.TIMEOUT),
            SysIdRoutine.Mechanism(self.motor.setVoltage, lambda log: None, self),
        )
