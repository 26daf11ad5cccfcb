"""The contract of a mechanism: motor, gearing, load, sensor and travel.

Its gains follow from its parts:

    kV = Ke·G/r · (1 + drag)        kA = R·r/(n·Kt·G) · m · (1 + spin)
    kG = R·r/(n·Kt·G) · m · lift    where there is gravity

with ratio G, radius r (1 if the position is an angle), n motors and the moved mass m, or inertia J.
A module in ``sim/bench/mechanisms`` defines one mechanism as ``MECHANISM``.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from sim.core.errors import BadRequest
from sim.core.units import find_unit
from sim.physics.battery import CONTROLLERS, Battery
from sim.physics.effect import Scale
from sim.physics.effects import find_effect
from sim.physics.model import Model, Part
from sim.physics.motors import Motor

if TYPE_CHECKING:
    import numpy as np

LARGEST = 5.0  # [1] largest size of a hidden effect, with which a robot still moves
ORDINARY_STEP = 3.5  # [V] step of a dynamic test, by which effects are sized


@dataclass(frozen=True)
class Sensor:
    """The sensor that measures position and velocity of a mechanism.

    Args:
        resolution: [m or rad] smallest step of the position.
        velocity_noise: [m/s or rad/s] standard deviation in motion; at rest there is none.
        noise_speed: [m/s or rad/s] speed at which the noise is about two thirds of that.
        jitter: [s] standard deviation of the sample times about multiples of the period.
        filter: [s] time over which the motor controller averages the velocity.
        latency: [s] delay from motion to the value that the robot program reads.
        frame: [s] time between two status frames on the bus; a reading repeats until the next one.
            0 has no frames.
    """

    resolution: float
    velocity_noise: float
    noise_speed: float
    jitter: float
    filter: float = 0.0
    latency: float = 0.0
    frame: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Mechanism:
    """A robot mechanism.

    Args:
        name: name on the command line.
        summary: one line for a list.
        type: ``simple``, ``elevator`` or ``arm``.
        units: unit of position of its logs.
        motor: the motor.
        motor_count: number of motors.
        ratio: [1] motor turns per turn of the output.
        radius: [m] of wheel or drum; 1 if the angle of the output is the position. For a robot that
            turns on the spot: [1] the wheels' radius over their distance from its center.
        load: [kg] moved mass, or [kg·m²] inertia if the position is an angle.
        friction: [V] kS.
        drag: [1] share by which kV exceeds that of the motor.
        spin: [1] share of the load by which rotors and wheels add to it.
        travel: [m or rad] length of the travel; None is unlimited.
        sensor: the sensor.
        spread: field -> (least, most) between which ``draw`` chooses a value.
        lift: [m/s² or rad/s²] acceleration of the load by gravity alone, of an arm when level.
        lowest: [m or rad] position of the lower stop; None has no stops, and a test ends after
            ``travel`` from its start.
        battery: the battery.
        stator: [A] limit of a motor's current.
        supply: [A] limit of the supply current of a motor controller.
        brownout: [V] battery voltage below which the motors are disabled.
        grip: [m/s² or rad/s²] acceleration of the load at which its wheels begin to slip; None if
            nothing can slip.
        hidden: effects that are not in the gains.
    """

    name: str
    summary: str
    type: str
    units: str
    motor: Motor
    motor_count: int
    ratio: float
    radius: float = 1.0
    load: float
    friction: float
    drag: float = 0.0
    spin: float = 0.0
    travel: float | None
    sensor: Sensor
    spread: Mapping[str, tuple[float, float]]
    lift: float = 0.0
    lowest: float | None = None
    battery: Battery = field(default=Battery())
    stator: float = 120.0  # Phoenix 6's default
    supply: float = 70.0  # the same
    brownout: float = CONTROLLERS["roborio2"].brownout
    grip: float | None = None
    hidden: tuple[Part, ...] = field(default=())

    def __post_init__(self) -> None:
        if self.type != "simple" and not self.lift:
            raise BadRequest(
                f"{self.name} is of the type {self.type}, and has no lift: gravity would not pull",
                advice="Set lift=9.81 for an elevator. For an arm, divide 9.81 by the distance [m] "
                "from the axis to the center of mass.",
            )

    @property
    def gains(self) -> dict[str, float]:
        """The true kS [V], kV, kA [per m or rad], and kG [V] where there is gravity."""
        volts_per_newton = (
            self.motor.resistance
            * self.radius
            / (self.motor_count * self.motor.torque_constant * self.ratio)
        )
        gains = {
            "kS": self.friction,
            "kV": self.motor.back_emf * self.ratio / self.radius * (1.0 + self.drag),
            "kA": volts_per_newton * self.load * (1.0 + self.spin),
        }
        if self.lift:
            gains["kG"] = volts_per_newton * self.load * self.lift
        return gains

    @property
    def stops(self) -> tuple[float, float] | None:
        """[m or rad] the lower and the upper stop; None where there are none."""
        if self.lowest is None or self.travel is None:
            return None
        return self.lowest, self.lowest + self.travel

    @property
    def model(self) -> Model:
        """The true model of the mechanism: gains, stops and hidden effects."""
        return Model(self.type, self.gains, self.hidden, self.stops)

    @property
    def scale(self) -> Scale:
        """Typical voltage, travel and gains of the mechanism, by which effects are sized."""
        gains = self.gains
        speed = max(ORDINARY_STEP - gains["kS"], 0.1 * ORDINARY_STEP) / gains["kV"]
        return Scale(
            gains["kS"],
            gains["kV"],
            gains["kA"],
            ORDINARY_STEP,
            self.travel or 10.0 * speed,
            angular=find_unit(self.units).angular,
            bounded=self.travel is not None,
            lowest=self.lowest,
            type=self.type,
        )

    def draw(self, rng: "np.random.Generator") -> "Mechanism":
        """A random variant: every field in ``spread`` drawn uniformly between its bounds."""
        drawn = {name: float(rng.uniform(*bounds)) for name, bounds in self.spread.items()}
        return replace(self, **drawn)  # type: ignore[arg-type]  # spread names float fields only

    def hide(self, effect: str, size: float = 1.0) -> "Mechanism":
        """A copy of the mechanism with a hidden effect.

        Args:
            effect: name of the effect.
            size: [1] 1 is ordinary, a third is subtle, 0 hides nothing.

        Raises:
            BadRequest: no such effect, it is hidden already, the mechanism cannot have it, or the
                size is out of range.
        """
        known = find_effect(effect)
        if not (math.isfinite(size) and 0.0 <= size <= LARGEST):
            raise BadRequest(
                f"{effect} cannot have size {size:g}",
                advice=f"Choose 0 to {LARGEST:g}; 1 is what an ordinary robot has.",
            )
        if any(part.effect == effect for part in self.hidden):
            raise BadRequest(f"{effect} is hidden twice", advice="Name each effect once.")
        if why := known.reason_against(self.scale):
            raise BadRequest(f"a {self.name} cannot have {effect}: {why}", advice=OTHER)
        if size == 0.0:
            return self
        hidden = (*self.hidden, Part(effect, dict(known.example(self.scale, size))))
        Model(self.type, self.gains, hidden)  # refuses incompatible effects
        return replace(self, hidden=hidden)


OTHER = "Choose another effect (sysid effects lists them) or another mechanism."
