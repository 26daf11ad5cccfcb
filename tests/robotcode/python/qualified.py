import commands2
import commands2.sysid
import wpilib
import wpilib.sysid


class Spinner(commands2.Subsystem):
    """Every name with its package in front."""

    def __init__(self) -> None:
        super().__init__()
        self.motor = wpilib.PWMTalonFX(0)
        self.encoder = wpilib.Encoder(0, 1)
        self.routine = commands2.sysid.SysIdRoutine(
            commands2.sysid.SysIdRoutine.Config(0.5, 3.5, 10.0),
            commands2.sysid.SysIdRoutine.Mechanism(self.apply, self.write, self, "spinner"),
        )

    def apply(self, voltage: float) -> None:
        self.motor.setVoltage(voltage)

    def write(self, log: wpilib.sysid.SysIdRoutineLog) -> None:
        motor = log.motor("spinner")
        motor.voltage(self.motor.getVoltage())
        motor.angularPosition(self.encoder.getDistance())
        motor.angularVelocity(self.encoder.getRate())
