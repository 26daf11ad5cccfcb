from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


class Stored(Subsystem):
    """The callback is a method of the motor, kept in a field."""

    def __init__(self):
        self.motor = Talon(0)
        self.send = self.motor.setVoltage
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(self.send, self.log, self),
        )

    def log(self, log):
        with open("/home/lvuser/extra.txt", "a") as file:
            try:
                motor = log.motor("stored")
                motor.voltage(self.motor.getVoltage())
            finally:
                file.write("logged")
