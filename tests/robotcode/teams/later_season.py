import typing

from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from phoenix6 import controls
from phoenix6.hardware import TalonFX
from phoenix6.status_signal import StatusSignal
from wpimath import units

VOLTS: typing.Final = 3.5
NOTHING: typing.Optional[()] = None


class LaterSeason(Subsystem):
    _shared: typing.ClassVar[controls.VoltageOut] = controls.VoltageOut(0)

    def __init__(self) -> None:
        self.motor: TalonFX = TalonFX(1)
        self.position: StatusSignal = self.motor.get_position()
        self.routine = SysIdRoutine(
            config=SysIdRoutine.Config(
                rampRate=units.volts(0.5),
                stepVoltage=VOLTS,
                timeout=units.millisecondsToSeconds(10_000),
            ),
            mechanism=SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, voltage: units.volts, /) -> None:
        self._shared.output = voltage
        self.motor.set_control(self._shared)

    def log(self, log, *, name: str = "late") -> None:
        log.motor(name).voltage(self.motor.get_motor_voltage().value).angularPosition(
            self.position.value
        )
