"""A voltage budget: which term takes how many volts, at four moments of one mechanism."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from grader.answers.asked_number import AskedNumber, Band

NEAR = Band(0.02, 0.02)  # arithmetic: within 2 % or not
SHOWN = {  # kind -> the unit a dashboard shows, and how many of it are one of kV's
    "drivetrain": ("ft/s", 1 / 0.3048),
    "intake": ("rpm", 60.0),
    "shooter": ("rpm", 60.0),
    "turret": ("deg/s", 180 / math.pi),
}
MOMENTS = {
    "forward": "it moves forward at a steady speed",
    "accelerating": "it moves forward and gets faster",
    "braking": "it still moves forward, but gets slower",
    "backward": "it moves backward at a steady speed",
}


@dataclass(frozen=True)
class Moment:
    """One row of the table: velocity and acceleration in the units of kV and kA."""

    name: str
    velocity: float
    acceleration: float
    shown: float
    shown_unit: str


@dataclass(frozen=True)
class Variant:
    """One learner's mechanism and its four moments."""

    kind: str
    symbol: str
    gains: Mapping[str, float]
    moments: Mapping[str, Moment]
    largest_at: str

    def terms(self, name: str) -> tuple[float, float, float]:
        """The volts of kS, kV and kA at a moment."""
        at = self.moments[name]
        friction = math.copysign(self.gains["kS"], at.velocity)
        return friction, self.gains["kV"] * at.velocity, self.gains["kA"] * at.acceleration

    def asked(self, name: str) -> AskedNumber:
        """The requested voltage at a moment."""
        return AskedNumber(name, sum(self.terms(name)), "V", NEAR)

    @property
    def largest(self) -> str:
        """The gain whose term is the largest in the requested phase."""
        sizes = zip(self.terms(self.largest_at), ("kS", "kV", "kA"), strict=True)
        return max((abs(volts), gain) for volts, gain in sizes)[1]
