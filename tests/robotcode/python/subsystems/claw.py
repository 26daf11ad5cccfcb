from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from phoenix6.controls import VelocityVoltage
from phoenix6.hardware import TalonFX

from ..constants import *


class Claw(Subsystem):
    def __init__(self):
        self.motor = TalonFX(7)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(RAMP, Lift.STEP, Lift.MISSING),
            SysIdRoutine.Mechanism(
                lambda volts: self.motor.set_control(VelocityVoltage(volts)), self.log, self
            ),
        )

    def log(self, log):
        log.motor("claw").voltage(self.motor.get_motor_voltage().value).angularPosition(
            self.motor.get_position().value
        ).angularVelocity(self.motor.get_velocity().value)
