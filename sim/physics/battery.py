"""The battery under load, and the roboRIO's brownout protection.

A brownout ends when the battery is back above a second threshold, which it is as soon as no motor
draws from it.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from sim.core.errors import BadRequest

LOWEST, HIGHEST = 9.0, 14.0  # [V] at rest: the range in which a test is started
LARGEST_RESISTANCE = 0.1  # [Ω] of a battery that still turns a motor


@dataclass(frozen=True)
class RobotController:
    """Brownout thresholds of a robot controller.

    Args:
        name: name on the command line.
        brownout: [V] battery voltage below which it disables the motors.
        source: source of the figures.
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
        rest: [V] voltage without current.
        resistance: [Ω] of battery and wires together.

    Raises:
        BadRequest: a voltage or resistance outside of what a robot starts a test with.
    """

    rest: float = 12.6
    resistance: float = 0.020

    def __post_init__(self) -> None:
        if not (LOWEST <= self.rest <= HIGHEST and 0.0 <= self.resistance <= LARGEST_RESISTANCE):
            raise BadRequest(
                f"no robot has a battery of {self.rest:g} V with {self.resistance:g} Ω",
                advice=f"Choose {LOWEST:g} to {HIGHEST:g} V, and 0 to {LARGEST_RESISTANCE:g} Ω. "
                "A good one has 12.6 V and 0.02 Ω.",
            )
