"""What a learner is given, and what the robot needs: gains in two units, and a loop's output."""

from collections.abc import Mapping
from dataclasses import dataclass

NEAR = 0.02  # [share] arithmetic, three digits: within 2 % or not
FULL = 12.0  # [V] what a duty cycle of 1 stands for
UNITS = {  # name as SysId has it -> symbol, and how many meters or radians one of it is
    "Meters": ("m", 1.0),
    "Feet": ("ft", 0.3048),
    "Inches": ("in", 0.0254),
    "Radians": ("rad", 1.0),
    "Rotations": ("rot", 6.283185307179586),
    "Degrees": ("deg", 0.017453292519943295),
}
CLASSES = {
    "Simple": "SimpleMotorFeedforward",
    "Elevator": "ElevatorFeedforward",
    "Arm": "ArmFeedforward",
}
ORDER = {  # class -> what it takes, in order
    "SimpleMotorFeedforward": ("kS", "kV", "kA"),
    "ElevatorFeedforward": ("kS", "kG", "kV", "kA"),
    "ArmFeedforward": ("kS", "kG", "kV", "kA"),
}


@dataclass(frozen=True)
class Variant:
    """One learner's mechanism.

    Args:
        kind: ``arm``.
        analysis: what the analyzer was told it is: ``Simple``, ``Elevator``, ``Arm``.
        shown: the gains, and kP, as the analyzer shows them.
        shown_in: the unit of position they are made for: ``Rotations``.
        used_in: the one that the robot's code counts in.
        duty: whether the velocity loop puts out a duty cycle, and not volts.
    """

    kind: str
    analysis: str
    shown: Mapping[str, float]
    shown_in: str
    used_in: str
    duty: bool

    @property
    def gains(self) -> tuple[str, ...]:
        """The feedforward's gains, in its order."""
        return ORDER[self.made]

    @property
    def made(self) -> str:
        """The feedforward's class."""
        return CLASSES[self.analysis]

    @property
    def times(self) -> float:
        """What a gain per velocity is multiplied with to fit the robot's unit."""
        return UNITS[self.used_in][1] / UNITS[self.shown_in][1]

    def needed(self, gain: str) -> float:
        """A gain as the robot needs it."""
        value = self.shown[gain]
        if gain in {"kV", "kA", "kP"}:
            value *= self.times
        return value / FULL if gain == "kP" and self.duty else value

    def symbol(self, *, used: bool) -> str:
        """The unit of position: the robot's, or the analyzer's."""
        return UNITS[self.used_in if used else self.shown_in][0]

    def unit(self, gain: str, *, used: bool) -> str:
        """The unit of a gain, of the robot's kind or as the analyzer shows it."""
        return {"kV": "V·s/{}", "kA": "V·s²/{}"}.get(gain, "V").format(self.symbol(used=used))


def near(value: float, wanted: float, *, share: float = NEAR) -> bool:
    """Whether a number is what is wanted, rounding apart."""
    return abs(value - wanted) <= share * abs(wanted)
