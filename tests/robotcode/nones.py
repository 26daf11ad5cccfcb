from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkFlex


class Climber:
    def __init__(self, subsystem):
        self.motor = PWMSparkFlex(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(None, 3.5),
            SysIdRoutine.Mechanism(self.motor.setVoltage, None, subsystem),
        )
