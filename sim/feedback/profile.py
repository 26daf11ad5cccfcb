"""Motion profiles of legs with constant acceleration."""

from collections.abc import Sequence
from dataclasses import dataclass

from sim.core.units import BATTERY
from sim.feedback.response import Plant

STEP = 0.005  # [s] time step
BRISK = 0.4  # [share of the free speed] cruise speed, with voltage in reserve
PUSH = 3.0  # [V] voltage for the acceleration
QUICKEST, STEADY, STILL = 0.3, 1.0, 0.5  # [s] acceleration at least, cruise, rest


@dataclass(frozen=True)
class Leg:
    """A part of a profile with constant acceleration.

    Args:
        seconds: duration [s].
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
        leg_starts: index at which each leg begins, and the number of points.
    """

    time: tuple[float, ...]
    position: tuple[float, ...]
    velocity: tuple[float, ...]
    acceleration: tuple[float, ...]
    leg_starts: tuple[int, ...]

    @property
    def cruise_end(self) -> int:
        """Index of the last point of the first leg with constant speed; 0 if there is none."""
        for first, last in zip(self.leg_starts, self.leg_starts[1:], strict=False):
            if self.velocity[first] and not self.acceleration[first]:
                return last - 1
        return 0

    @property
    def rest_end(self) -> int:
        """Index of the last point at rest before the motion; 0 if it moves at once."""
        return 0 if self.acceleration[0] else self.leg_starts[1] - 1


def join_legs(legs: Sequence[Leg], *, start: float = 0.0) -> Profile:
    """Join legs into a profile that starts at rest.

    Args:
        legs: the legs in order.
        start: initial position [unit].
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
        # Remove rounding errors at rest
        speed = 0.0 if abs(speed) < STEP * abs(leg.acceleration) else speed
        begins.append(len(rows))
    time = tuple(STEP * k for k in range(len(rows)))
    position, velocity, acceleration = zip(*rows, strict=True)
    return Profile(time, position, velocity, acceleration, tuple(begins))


def make_return_profile(
    speed: float, *, rising: float, steady: float, still: float, start: float = 0.0
) -> Profile:
    """A profile that rests, moves forward, rests, moves back and rests.

    Args:
        speed: cruise speed [unit/s].
        rising: duration of acceleration, and of deceleration [s].
        steady: duration of the cruise [s].
        still: duration of rest before, between and after the motions [s].
        start: initial position [unit].
    """
    push = speed / rising
    way = [Leg(still), Leg(rising, push), Leg(steady), Leg(rising, -push), Leg(still)]
    back = [Leg(one.seconds, -one.acceleration) for one in way[1:]]
    return join_legs([*way, *back], start=start)


def make_brisk_profile(plant: Plant) -> Profile:
    """A profile in one direction with rounded numbers, for a mechanism without gravity."""
    gains = plant.gains
    speed = float(f"{BRISK * (BATTERY - gains['kS']) / gains['kV']:.0e}")
    rising = max(QUICKEST, float(f"{speed * gains['kA'] / PUSH:.0e}"))
    push = speed / rising
    return join_legs([Leg(STILL), Leg(rising, push), Leg(STEADY), Leg(rising, -push), Leg(STILL)])
