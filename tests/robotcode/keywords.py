from commands2 import SubsystemBase
from commands2.sysid import SysIdRoutine as Routine
from wpilib import Talon
from wpimath.units import millisecondsToSeconds, seconds, volts

RAMP = 1 / 2


class Roller(SubsystemBase):
    def __init__(self):
        self.motor = Talon(0)
        config = Routine.Config(
            timeout=millisecondsToSeconds(10_000), stepVoltage=volts(3.5), rampRate=RAMP
        )
        self.routine = Routine(
            mechanism=Routine.Mechanism(
                subsystem=self,
                log=lambda log: log.motor("roller").voltage(self.motor.getVoltage()),
                drive=self.motor.setVoltage,
                name="roller",
            ),
            config=config,
        )
