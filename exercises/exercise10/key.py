"""A learner's given gains, and the gains that the robot needs, in the units of its loops.

The gains may go into WPILib's feedforward class in the roboRIO, or into the motor controller. Each
place has its own unit, and its loop has its own output (``Variant.convert_for_class``).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from grader.robotcode.bench.gains_run import CLASSES as ORDER
from grader.robotcode.bench.gains_run import FEED_FORWARD, SLOT0

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
SCALED = ("kV", "kA")  # the feedforward's gains with a velocity in their unit
LENGTHS = ("Meters", "Feet", "Inches")
CLASSES = {
    "Simple": "SimpleMotorFeedforward",
    "Elevator": "ElevatorFeedforward",
    "Arm": "ArmFeedforward",
}

PLACES = (SLOT0, FEED_FORWARD)  # of the gains inside a motor controller


@dataclass(frozen=True)
class Variant:
    """One learner's mechanism.

    Args:
        kind: ``arm``.
        analysis: what the analyzer was told it is: ``Simple``, ``Elevator``, ``Arm``.
        shown: the gains, and kP, as the analyzer shows them.
        shown_in: the unit of position they are made for: ``Rotations``.
        used_in: the one in which the gains are used, in the code or in ``place``.
        duty: whether the velocity loop puts out a duty cycle, and not volts.
        ratio: turns of the motor for one turn of the mechanism.
        radius: [m] of wheel or drum; 0 if the mechanism turns.
        place: the class of the motor controller that holds the gains; empty in the roboRIO.
        coded_in: the unit that the robot's code counts in, whatever the place counts in.
    """

    kind: str
    analysis: str
    shown: Mapping[str, float]
    shown_in: str
    used_in: str
    duty: bool
    ratio: float = 1.0
    radius: float = 0.0
    place: str = ""
    coded_in: str = ""

    def convert_for_class(self, kind: str) -> "Variant":
        """The mechanism with its gains in the unit in which a class takes them.

        Phoenix 6 counts rotations of the mechanism and puts out volts. A Spark counts in the unit
        of its conversion factors, here the code's, and its kP gives a duty cycle.

        Args:
            kind: ``Slot0Configs``, ``FeedForwardConfig``, or a class of WPILib.
        """
        if kind == SLOT0 and (self.radius or self.shown_in not in LENGTHS):
            return replace(self, place=kind, coded_in=self.used_in, used_in="Rotations", duty=False)
        if kind == FEED_FORWARD:
            return replace(self, place=kind, coded_in=self.used_in, duty=True)
        return self

    @property
    def gains(self) -> tuple[str, ...]:
        """The feedforward's gains, in its order."""
        return ORDER[CLASSES[self.analysis]]

    @property
    def made(self) -> str:
        """The class that takes the gains."""
        return self.place or CLASSES[self.analysis]

    @property
    def times(self) -> float:
        """The factor from a gain per velocity to the unit of its place."""
        return self.get_factor_to(self.used_in)

    def get_factor_to(self, unit: str) -> float:
        """The factor from a gain per velocity to a gain per another unit.

        Args:
            unit: as SysId has it: ``Meters``.
        """
        turns = self.radius if unit == "Rotations" and self.shown_in in LENGTHS else 1.0
        return turns * UNITS[unit][1] / UNITS[self.shown_in][1]

    def needed(self, gain: str) -> float:
        """A gain as the robot needs it."""
        value = self.shown[gain]
        if gain in SCALED or gain == "kP":
            value *= self.times
        return value / FULL if gain == "kP" and self.duty else value

    @property
    def turns_per_unit(self) -> float:
        """[rot] of the mechanism in one of the units that a Spark's encoder counts."""
        return UNITS[self.used_in][1] / UNITS["Rotations"][1]

    def accepts(self, gain: str, value: float) -> bool:
        """Whether a constant is the analyzer's number, or one in a unit of this robot."""
        if near(value, self.shown[gain]) or near(value, self.needed(gain)):
            return True
        return gain in SCALED and near(value, self.convert_to_code_unit(gain))

    def list_units_of(self, gain: str, value: float) -> list[str]:
        """The units in which a number is this gain, of all in which its velocity may be given."""
        if gain not in SCALED:
            return []
        turns = [one for one in UNITS if one not in LENGTHS]
        lengths = [*LENGTHS, *(["Rotations"] if self.radius else [])]
        fitting = (
            one
            for one in (lengths if self.shown_in in LENGTHS else turns)
            if near(value, self.shown[gain] * self.get_factor_to(one))
        )
        return [self._format_unit(gain, one) for one in fitting]

    def convert_to_code_unit(self, gain: str) -> float:
        """The gain kV or kA in the unit that the robot's code uses."""
        return self.shown[gain] * self.get_factor_to(self.coded_in or self.used_in)

    @property
    def coded_symbol(self) -> str:
        """The unit of position that the robot's code counts in."""
        return UNITS[self.coded_in or self.used_in][0]

    @property
    def counting(self) -> str:
        """What counts, and in which unit: a clause to begin a sentence with."""
        if self.place == SLOT0:
            return f"{SLOT0} counts rotations of the mechanism"
        who = "Your encoder counts in" if self.place else "Your code uses"
        return f"{who} {self.symbol(used=True)}"

    def symbol(self, *, used: bool) -> str:
        """The unit of position: the robot's, or the analyzer's."""
        return UNITS[self.used_in if used else self.shown_in][0]

    def list_matching_units(self, gain: str, value: float | None) -> list[str]:
        """The units that a gain of this value may have; if it fits none, all units of this robot.

        Args:
            gain: ``kV``.
            value: what a learner wrote.
        """
        sizes = dict.fromkeys((self.used_in, self.coded_in or self.used_in, self.shown_in))
        fitting = [
            self._format_unit(gain, one)
            for one in sizes
            if value is not None
            and near(value, self.shown[gain] * (self.get_factor_to(one) if gain in SCALED else 1.0))
        ]
        return fitting or [self._format_unit(gain, one) for one in sizes]

    def _format_unit(self, gain: str, position: str) -> str:
        return {"kV": "V·s/{}", "kA": "V·s²/{}"}.get(gain, "V").format(UNITS[position][0])


def near(value: float, wanted: float, *, share: float = NEAR) -> bool:
    """Whether a number equals the wanted one, except for rounding."""
    return abs(value - wanted) <= share * abs(wanted)
