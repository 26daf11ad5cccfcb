"""The parts of a mechanism, and the kV and kA that they imply."""

import math
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.core.units import find_unit
from sim.fit.result import Fit
from sim.physics.motors import Motor, compute_theoretical_kv

SURELY = 3.0  # [standard errors] a larger difference is significant
BELOW = 0.97  # [of theory] 12 V over the free speed is at most 2.1 % above the exact back-EMF
HEAVY = 1.15  # [of theory] kA: rotors and wheels add 3 to 10 %


@dataclass(frozen=True)
class Parts:
    """Motor, gearing and load of a mechanism.

    Args:
        motor: the motor.
        count: number of motors.
        ratio: motor turns per turn of the output; below 1 for an overdrive.
        radius: [m] of wheel or drum; 1 if the position is an angle.
        load: [kg] moved mass, or [kg·m²] inertia at the output if the position is an angle; None if
            unknown.

    Raises:
        BadRequest: a number that is not positive.
    """

    motor: Motor
    count: int
    ratio: float
    radius: float = 1.0
    load: float | None = None

    def __post_init__(self) -> None:
        for name in ("count", "ratio", "radius", "load"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise BadRequest(
                    f"a {name} of {value:g}", advice="Give a number above zero, in SI units."
                )

    @property
    def kv(self) -> float:
        """[V·s/m or V·s/rad] the theoretical kV, 12 V over the free speed."""
        return compute_theoretical_kv(self.motor, ratio=self.ratio, radius=self.radius)

    @property
    def ka(self) -> float | None:
        """[V·s²/m or V·s²/rad] the theoretical kA, without rotors; None without a load."""
        if self.load is None:
            return None
        torque_per_volt = self.count * self.motor.torque_constant * self.ratio
        return self.motor.resistance * self.radius / (torque_per_volt / self.load)


def fit_in_si(found: Fit) -> Fit:
    """The fit converted to meters or radians."""
    return found.in_units("radians" if find_unit(found.units).angular else "meters")


def check_radius_unit(parts: Parts, found: Fit) -> None:
    """Refuse parts whose radius does not match the unit of position.

    Raises:
        BadRequest: a radius although the position is an angle, or none although it is a length.
    """
    angular = find_unit(found.units).angular
    if angular and parts.radius != 1.0:
        raise BadRequest(
            f"there is a radius of {parts.radius:g} m, but the position is an angle",
            advice="Leave out the radius, and give the moment of inertia as the load.",
        )
    if not angular and parts.radius == 1.0:
        raise BadRequest(
            "the position is a length, but the radius is missing",
            advice="Give the radius of the wheel or the drum, in meters.",
        )
