"""A team's mechanism: the gains of its parts, its log, and the cause of their difference."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from grader.answers.asked_number import AskedNumber, Band

NEAR = Band(0.02, 0.02)  # arithmetic: within 2 % or not
OK, WATCH = 8.0, 20.0  # [%] above theory
FRICTION = 0.5  # [V] of kS that deserves a look: 4 % of 12 V
FULL = 12.0  # [V] the voltage the data sheets are for

VERDICTS = ("bookkeeping", "ok", "watch", "inspect")
FLAGS = ("fine", "watch", "stop")


@dataclass(frozen=True)
class Parts:
    """The motors, gearing and wheel of a mechanism.

    Args:
        motor: as on its label.
        free_rpm: [rpm] of the motor itself at 12 V.
        back_emf: [V·s/rad] of the motor.
        motors: how many.
        ratio: turns of the motor for one of the output.
        diameter: [m] of wheel or drum; 0 for what turns.
    """

    motor: str
    free_rpm: float
    back_emf: float
    motors: int
    ratio: float
    diameter: float

    @property
    def _output_per_radian(self) -> float:
        """Output units for one radian of the motor: meters, or rotations."""
        return (self.diameter / 2.0 if self.diameter else 0.5 / math.pi) / self.ratio

    @property
    def theoretical_kv(self) -> float:
        """KV as 12 V over the free speed promises it."""
        return FULL / (self.free_rpm * math.pi / 30.0) / self._output_per_radian

    @property
    def exact(self) -> float:
        """KV as the back-EMF gives it: free current has its own small drop."""
        return self.back_emf / self._output_per_radian


@dataclass(frozen=True)
class Variant:
    """One learner's team.

    Args:
        kind: ``drivetrain``, ``elevator`` or ``turret``.
        parts: what is built in.
        measured: kV from the log.
        friction: [V] kS from the log.
        speed: a typical speed.
        planted: the words that name what went wrong; empty if nothing did.
        told: what the code says, and what was noticed, line by line.
    """

    kind: str
    parts: Parts
    measured: float
    friction: float
    speed: float
    planted: tuple[str, ...]
    told: Mapping[str, Mapping[str, str]]

    @property
    def symbol(self) -> str:
        """The symbol of its unit of position."""
        return "m" if self.parts.diameter else "rot"

    @property
    def asked(self) -> AskedNumber:
        """The requested theoretical kV."""
        return AskedNumber("kV_theory", self.parts.theoretical_kv, f"V·s/{self.symbol}", NEAR)

    def right(self, value: float) -> bool:
        """Whether this is a kV that theory gives, by either formula."""
        return any(abs(value - one) <= NEAR.full * one for one in self.theories)

    @property
    def theories(self) -> tuple[float, float]:
        """Both ways to compute it."""
        return self.parts.theoretical_kv, self.parts.exact

    def compute_percent_above(self, theory: float) -> float:
        """[%] difference between the measured kV and a theoretical one."""
        return 100.0 * (self.measured / theory - 1.0)

    @property
    def verdict(self) -> str:
        """The verdict on the difference between measured and theoretical kV."""
        return find_verdict(self.compute_percent_above(self.parts.theoretical_kv))

    @property
    def flag(self) -> str:
        """The verdict on kS: fine, watch or stop."""
        if self.friction > self.measured * self.speed:
            return "stop"
        return "watch" if self.friction > FRICTION else "fine"


def find_verdict(percent: float) -> str:
    """The verdict on a measured kV by its difference from theory [%]."""
    if percent < 0.0:
        return "bookkeeping"
    return "ok" if percent <= OK else "watch" if percent <= WATCH else "inspect"
