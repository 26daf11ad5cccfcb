from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Encoder, PWMSparkMax, RobotController


class NextSeason(Subsystem):
    """Snake case, as of 2027."""

    def __init__(self) -> None:
        self.motor = PWMSparkMax(0)
        self.encoder = Encoder(0, 1)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(ramp_rate=0.5, step_voltage=3.5, timeout=10.0),
            SysIdRoutine.Mechanism(self.drive, self.record, self),
        )

    def drive(self, voltage: float) -> None:
        self.motor.set_voltage(voltage)

    def record(self, log) -> None:
        log.motor("lift").voltage(
            self.motor.get_duty_cycle() * RobotController.get_battery_voltage()
        ).position(self.encoder.get_distance()).velocity(self.encoder.get_rate())

    def forward(self):
        return self.routine.dynamic(SysIdRoutine.Direction.FORWARD)
