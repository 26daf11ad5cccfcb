import rev
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib.sysid import SysIdRoutineLog


class Module:
    def __init__(self, name: str, channel: int) -> None:
        self.name = name
        self.motor = rev.SparkMax(channel, rev.SparkMax.MotorType.kBrushless)
        self.encoder = self.motor.getEncoder()

    def drive_at(self, volts: float) -> None:
        self.motor.setVoltage(volts)


class Swerve(Subsystem):
    def __init__(self) -> None:
        super().__init__()
        self.left = Module("left", 1)
        self.right = Module("right", 2)
        self.modules = (self.left, self.right)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(), SysIdRoutine.Mechanism(self.run_all, self.log_left, self)
        )

    def run_all(self, volts: float) -> None:
        for module in self.modules:
            module.drive_at(volts)

    def log_left(self, log: SysIdRoutineLog) -> None:
        log.motor("left").voltage(
            self.left.motor.getAppliedOutput() * self.left.motor.getBusVoltage()
        ).position(self.left.encoder.getPosition()).velocity(self.left.encoder.getVelocity())
