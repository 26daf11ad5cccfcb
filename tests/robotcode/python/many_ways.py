from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Jaguar


class ManyWays(Subsystem):
    """Loops with names, with numbers, over a dictionary."""

    def __init__(self):
        self.a = Jaguar(0)
        self.b = Jaguar(1)
        self.c = Jaguar(2)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(1 / 2, 7 // 2, 10**1),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, volts):
        for number, motor in enumerate([self.a, self.b]):
            motor.setVoltage(volts)
        match volts:
            case 0:
                self.c.stopMotor()
            case _:
                self.c.setVoltage(volts * -1)

    def log(self, log):
        for name, motor in {"a": self.a, "b": self.b}.items():
            log.motor(name).voltage(motor.getVoltage())
