"""A motion profile made of legs of constant acceleration."""

from collections.abc import Sequence
from dataclasses import dataclass

from sim.feedback.response import Plant

STEP = 0.005  # [s] between two points
BRISK = 0.4  # [share] of the free speed: fast enough to see, with volts to spare
PUSH = 3.0  # [V] that the acceleration takes
QUICKEST, STEADY, STILL = 0.3, 1.0, 0.5  # [s] of getting faster at least, at one speed, at rest


@dataclass(frozen=True)
class Leg:
    """A part of a profile with one acceleration.

    Args:
        seconds: [s] how long.
        acceleration: [unit/s²].
    """

    seconds: float
    acceleration: float = 0.0


@dataclass(frozen=True)
class Profile:
    """A desired motion, in equal steps.

    Args:
        time: (n,) [s].
        position: (n,) [unit].
        velocity: (n,) [unit/s].
        acceleration: (n,) [unit/s²].
        leg_starts: index at which each leg begins; the last is the end.
    """

    time: tuple[float, ...]
    position: tuple[float, ...]
    velocity: tuple[float, ...]
    acceleration: tuple[float, ...]
    leg_starts: tuple[int, ...]

    @property
    def cruise_end(self) -> int:
        """The last point before the first leg that moves steadily ends; 0 if none does."""
        for first, last in zip(self.leg_starts, self.leg_starts[1:], strict=False):
            if self.velocity[first] and not self.acceleration[first]:
                return last - 1
        return 0

    @property
    def rest_end(self) -> int:
        """The last point of standing still before it moves; 0 if it moves at once."""
        return 0 if self.acceleration[0] else self.leg_starts[1] - 1


def join_legs(legs: Sequence[Leg], *, start: float = 0.0) -> Profile:
    """Join legs into a profile that starts at rest.

    Args:
        legs: one after another.
        start: [unit] where it begins.
    """
    place, speed, rows, begins = start, 0.0, [], [0]
    for leg in legs:
        count = round(leg.seconds / STEP)
        for k in range(count):
            t = k * STEP
            rows.append(
                (
                    place + speed * t + leg.acceleration * t * t / 2.0,
                    speed + leg.acceleration * t,
                    leg.acceleration,
                )
            )
        lasts = count * STEP
        place += speed * lasts + leg.acceleration * lasts * lasts / 2.0
        speed += leg.acceleration * lasts
        speed = 0.0 if abs(speed) < STEP * abs(leg.acceleration) else speed  # rest is rest
        begins.append(len(rows))
    time = tuple(STEP * k for k in range(len(rows)))
    position, velocity, acceleration = zip(*rows, strict=True)
    return Profile(time, position, velocity, acceleration, tuple(begins))


def make_return_profile(
    speed: float, *, rising: float, steady: float, still: float, start: float = 0.0
) -> Profile:
    """A profile that rests, moves forward, rests, moves back and rests.

    Args:
        speed: [unit/s] on the way.
        rising: [s] until it is that fast, and from it to rest.
        steady: [s] at that speed.
        still: [s] of standing before, between and after.
        start: [unit] where it begins.
    """
    push = speed / rising
    way = [Leg(still), Leg(rising, push), Leg(steady), Leg(rising, -push), Leg(still)]
    back = [Leg(one.seconds, -one.acceleration) for one in way[1:]]
    return join_legs([*way, *back], start=start)


def make_brisk_profile(plant: Plant) -> Profile:
    """A profile in one direction with round numbers, for a mechanism without gravity."""
    gains = plant.gains
    speed = float(f"{BRISK * (12.0 - gains['kS']) / gains['kV']:.0e}")
    rising = max(QUICKEST, float(f"{speed * gains['kA'] / PUSH:.0e}"))
    push = speed / rising
    return join_legs([Leg(STILL), Leg(rising, push), Leg(STEADY), Leg(rising, -push), Leg(STILL)])
