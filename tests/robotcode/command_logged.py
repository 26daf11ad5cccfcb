from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Encoder, Spark


class Conveyor(Subsystem):
    def __init__(self):
        self.motor = Spark(0)
        self.encoder = Encoder(0, 1)
        self.volts = 0.0
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10.0),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, volts: float) -> None:
        if volts > 10:
            volts = 10
        self.volts = volts
        self.motor.setVoltage(self.volts)

    def log(self, log) -> None:
        log.motor("conveyor").voltage(self.volts).position(self.encoder.getDistance()).velocity(
            self.encoder.getRate()
        ).value("temperature", 20.0, "celsius")
