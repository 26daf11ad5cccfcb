"""Everything at the top of the file, no class at all."""

from commands2.sysid import SysIdRoutine
from wpilib import Spark

motor = Spark(0)


def drive(volts):
    motor.setVoltage(volts)


routine = SysIdRoutine(SysIdRoutine.Config(0.5), SysIdRoutine.Mechanism(drive, None, None))
