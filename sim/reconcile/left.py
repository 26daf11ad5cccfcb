"""What a last model leaves that is not noise: at a moment, at one place, at one speed, in time."""

from dataclasses import dataclass, field

from sim.reconcile.alike import Alike, most_alike
from sim.reconcile.problem import Point, Problem
from sim.reconcile.remainder import CALM, Moment, worst
from sim.reconcile.rhythm import Rhythm, clearest
from sim.reconcile.thresholds import ALIKE, RHYTHM, SHAKEN


@dataclass(frozen=True)
class Left:
    """What is left.

    Args:
        moment: that the model explains least.
        alike: what runs miss of it alike.
        rhythm: what comes back in time.
    """

    moment: Moment = CALM
    alike: Alike = field(default_factory=Alike)
    rhythm: Rhythm = field(default_factory=Rhythm)

    @property
    def shaken(self) -> bool:
        """Whether there is a moment that is not explained."""
        return self.moment.size > SHAKEN

    @property
    def swings(self) -> bool:
        """Whether something comes back in time."""
        return self.rhythm.size > RHYTHM

    @property
    def repeats(self) -> bool:
        """Whether runs miss the same at the same places or speeds."""
        return self.alike.size > ALIKE

    @property
    def something(self) -> bool:
        """Whether any of it is more than noise."""
        return self.shaken or self.swings or self.repeats

    @classmethod
    def by(cls, problem: Problem, point: Point) -> "Left":
        """What a point leaves of its problem."""
        return cls(worst(problem, point), most_alike(problem, point), clearest(problem, point))
