"""One bin in which simulation and measurement disagree, in words and numbers."""

from dataclasses import dataclass

RUN, SPEED, POSITION = "run", "direction-speed", "direction-position"
STEPS, REST = "after-steps", "at-rest"
MANY = 99.5  # [noises] from which on all digits before the point are given


@dataclass(frozen=True)
class Place:
    """A bin in which simulation and measurement disagree, in words and numbers.

    Args:
        what: ``run``, ``direction-speed``, ``direction-position``, ``after-steps`` or ``at-rest``.
        where: the bin in words: ``dynamic-forward, 0.2 to 0.4 s``.
        error: [noises of a velocity] mean residual in the direction of motion: above 0 the robot is
            faster than the model.
        sure: [standard errors] absolute value of this mean.
    """

    what: str
    where: str
    error: float
    sure: float

    @property
    def sentence(self) -> str:
        """The disagreement in a sentence: where, in which direction, by how much."""
        way = "faster" if self.error > 0.0 else "slower"
        return (
            f"{self.where}: {way} than in the model, by "
            f"{format_noises(abs(self.error))} times the noise of its velocity"
        )


def format_noises(value: float) -> str:
    """A multiple of the noise with two significant digits; from 99.5 on, a whole number."""
    return f"{value:.0f}" if abs(value) >= MANY else f"{value:.2g}"
