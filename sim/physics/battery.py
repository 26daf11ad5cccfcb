"""The battery under load, and the roboRIO's brownout protection.

A brownout ends when the battery is back above a second threshold, which it is as soon as no motor
draws from it.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from sim.core.errors import BadRequest

FLATTEST, FULLEST = 9.0, 14.0  # [V] at rest: outside of this a robot does not start a test
WORST = 0.1  # [Ω] of a battery that still turns a motor


@dataclass(frozen=True)
class RobotController:
    """Brownout thresholds of a robot controller.

    Args:
        name: as on the command line.
        brownout: [V] below which it disables the motors.
        source: where the figures are from.
    """

    name: str
    brownout: float
    source: str


CONTROLLERS: Mapping[str, RobotController] = {
    found.name: found
    for found in (
        RobotController("roborio1", 6.3, "frc-docs, roboRIO brownouts: fixed"),
        RobotController("roborio2", 6.75, "frc-docs: default of RobotController's setting"),
        RobotController("systemcore", 6.75, "WPILib 2027's simulation: default of its setting"),
    )
}


@dataclass(frozen=True)
class Battery:
    """A battery under load.

    Args:
        rest: [V] with nothing drawn from it.
        resistance: [Ω] of battery and wires together.

    Raises:
        BadRequest: no battery a robot would start with.
    """

    rest: float = 12.6
    resistance: float = 0.020

    def __post_init__(self) -> None:
        if not (FLATTEST <= self.rest <= FULLEST and 0.0 <= self.resistance <= WORST):
            raise BadRequest(
                f"a battery of {self.rest:g} V with {self.resistance:g} Ω",
                advice=f"Choose {FLATTEST:g} to {FULLEST:g} V, and 0 to {WORST:g} Ω. "
                "A good one has 12.6 V and 0.02 Ω.",
            )
