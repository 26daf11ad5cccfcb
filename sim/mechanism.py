"""The contract of a mechanism: what moves, what drives it, what reads it, and how far it may go.

Its gains follow from its parts:

    kV = Ke·G/r · (1 + drag)        kA = R·r/(n·Kt·G) · m · (1 + spin)

with ratio G, radius r (1 for what turns), n motors and the moved mass m, or inertia J. A module in
``sim/mechanisms`` offers one as ``MECHANISM``.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from sim.motors import Motor


@dataclass(frozen=True)
class Sensor:
    """What reads the mechanism.

    Args:
        resolution: [m or rad] smallest step of the position.
        velocity_noise: [m/s or rad/s] standard deviation while moving; an encoder at rest is quiet.
        noise_speed: [m/s or rad/s] speed at which the noise has reached about two thirds of that.
        jitter: [s] standard deviation of the sample times about the loop's period.
    """

    resolution: float
    velocity_noise: float
    noise_speed: float
    jitter: float


@dataclass(frozen=True)
class Mechanism:
    """A robot mechanism, as built.

    Args:
        name: as on the command line.
        summary: one line for a list.
        type: ``simple``, ``elevator`` or ``arm``.
        units: the unit of position a team would log it in.
        motor: which one drives it.
        motor_count: how many of them.
        ratio: motor turns per turn of the output.
        radius: [m] of wheel or drum; 1 where the output's own angle is the position.
        load: [kg] moved mass, or [kg·m²] inertia at the output where ``radius`` is 1.
        friction: [V] kS.
        drag: share by which kV exceeds the motor's own.
        spin: share by which rotors and wheels add to the load.
        travel: [m or rad] how far from its start a test may go; None is without end.
        sensor: what reads it.
        spread: field -> (least, most) from which ``draw`` takes a realistic other one.
    """

    name: str
    summary: str
    type: str
    units: str
    motor: Motor
    motor_count: int
    ratio: float
    radius: float
    load: float
    friction: float
    drag: float
    spin: float
    travel: float | None
    sensor: Sensor
    spread: Mapping[str, tuple[float, float]]

    @property
    def gains(self) -> dict[str, float]:
        """The true kS [V], kV [V·s/m or V·s/rad] and kA [V·s²/m or V·s²/rad]."""
        volts_per_newton = (
            self.motor.resistance
            * self.radius
            / (self.motor_count * self.motor.torque_constant * self.ratio)
        )
        inertia = self.load * (1.0 + self.spin)
        return {
            "kS": self.friction,
            "kV": self.motor.back_emf * self.ratio / self.radius * (1.0 + self.drag),
            "kA": volts_per_newton * inertia,
        }

    def draw(self, rng: np.random.Generator) -> "Mechanism":
        """Another one like it: every field in ``spread`` drawn evenly between its bounds."""
        drawn = {name: float(rng.uniform(*bounds)) for name, bounds in self.spread.items()}
        return replace(self, **drawn)  # type: ignore[arg-type]  # spread names float fields only
