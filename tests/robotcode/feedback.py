from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from phoenix6.controls import MotionMagicVoltage
from phoenix6.hardware import TalonFX
from wpimath.controller import PIDController


class Turret(Subsystem):
    def __init__(self):
        self.motor = TalonFX(1)
        self.second = TalonFX(2)
        self.pid = PIDController(1, 0, 0)
        self.pid.setSetpoint(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(self.drive, None, self),
        )

    def drive(self, volts):
        self.motor.setVoltage(self.pid.calculate(self.motor.get_position().value, volts))
        self.second.set_control(MotionMagicVoltage(volts))
