"""What exercise 3 gives and asks: the voltages that hold, and what lies behind them."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from grader.answers.asked_number import AskedNumber


@dataclass(frozen=True)
class Hold:
    """Two voltages: it no longer falls, it begins to rise.

    Args:
        lower, upper: [V], as read.
        reading: [deg] of the encoder.
    """

    lower: float
    upper: float
    reading: float = 0.0

    @property
    def friction(self) -> float:
        """Half the width of the window [V]."""
        return (self.upper - self.lower) / 2.0

    @property
    def middle(self) -> float:
        """Halfway between the edges [V]."""
        return (self.lower + self.upper) / 2.0


@dataclass(frozen=True)
class Variant:
    """One learner's elevator and arm: the readings, and the true gains."""

    elevator: Hold
    arm: tuple[Hold, ...]
    asked: Mapping[str, AskedNumber]
    offset: AskedNumber

    @property
    def found(self) -> dict[str, float]:
        """The numbers that the method of the last hint gives [V, and deg]."""
        by_reading = {hold.reading: hold for hold in self.arm}
        level, (side,) = by_reading[0.0], {-90.0, 90.0} & by_reading.keys()
        sine = -by_reading[side].middle * math.copysign(1.0, side)
        return {
            "elevator_kG": self.elevator.middle,
            "elevator_kS": self.elevator.friction,
            "arm_kG": math.hypot(sine, level.middle),
            "arm_kS": sum(hold.friction for hold in self.arm) / len(self.arm),
            "arm_offset": math.degrees(math.atan2(sine, level.middle)),
        }
