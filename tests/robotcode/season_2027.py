from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkMax


class Wrist(Subsystem):
    def __init__(self):
        self.motor = PWMSparkMax(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(ramp_rate=0.5, step_voltage=3.5, timeout=10.0),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, voltage):
        self.motor.set_voltage(voltage)

    def log(self, log):
        log.motor("wrist").voltage(self.motor.get_voltage()).angular_position(
            self.encoder.get_position()
        ).angular_velocity(self.encoder.get_rate())

    def forward(self):
        return self.routine.dynamic(SysIdRoutine.Direction.FORWARD)
