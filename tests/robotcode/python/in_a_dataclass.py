from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkFlex

LIMIT: Final[float] = 10.0


@dataclass(frozen=True)
class Tests:
    ramp: float = 0.5
    step: float = 7 / 2
    timeout: float = LIMIT


class InADataclass(Subsystem):
    motor: PWMSparkFlex

    def __init__(self) -> None:
        self.motor = PWMSparkFlex(1)
        self.routine: SysIdRoutine = SysIdRoutine(
            SysIdRoutine.Config(Tests.ramp, Tests.step, Tests.timeout),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, voltage: float) -> None:
        self.motor.setVoltage(voltage)

    def log(self, log) -> None:
        (
            log.motor("roller")
            .voltage(self.motor.getVoltage())
            .value("temperature", 21.0, "celsius")
        )
