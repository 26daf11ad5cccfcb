"""Simulate a mechanism that follows a motion profile with feedforward only.

    volts = kS·sgn(v) + kV·v + kA·a + gravity       with the believed gains, at most 12 V
    kA·v' = volts - kS·sgn(v) - kV·v - gravity      with the true gains

Without feedback, every wrong gain causes an error of the motion that is typical of it.
"""

import math
import re
from dataclasses import dataclass

from sim.core.units import BATTERY
from sim.feedback.profile import STEP, Profile
from sim.feedback.response import MovingPlant, Plant

NOTABLE = 0.02  # [share of a distance or speed] smaller errors are not described
CLEAR = 0.25  # [share of the target speed] for larger errors, the speed is described
STANDSTILL = 0.05  # [share of the target speed] below it, the mechanism hardly moves
INFINITE = (-math.inf, math.inf)
MORE_LESS = {"height": ("above", "below"), "angle": ("above", "below")}


@dataclass(frozen=True, eq=False)
class FollowedProfile:
    """A motion profile, and the motion of the mechanism that followed it.

    Args:
        name: name of the mechanism: ``elevator``.
        symbol: symbol of its unit of position.
        target: the profile.
        position: (n,) [unit].
        velocity: (n,) [unit/s].
        place: name of its position: ``height``; empty if only its speed matters.
        stops: positions of its hard stops [unit].
    """

    name: str
    symbol: str
    target: Profile
    position: tuple[float, ...]
    velocity: tuple[float, ...]
    place: str = "way"
    stops: tuple[float, float] = INFINITE

    @property
    def description(self) -> str:
        """The differences from the profile, in short sentences with rounded numbers."""
        parts = [
            part
            for part in (self._describe_rest(), self._describe_cruise(), self._describe_end())
            if part
        ]
        text = " ".join(parts) or "Here it does nearly what it should."
        return re.sub(r"\b[Ii]t\b", lambda it: self._name_mechanism(it[0]), text, count=1)

    def _name_mechanism(self, it: str) -> str:
        return f"{'The' if it == 'It' else 'the'} {self.name}"

    def _measure_distance(self) -> float:
        return max(self.target.position) - min(self.target.position)

    def _describe_rest(self) -> str:
        """A sentence about its motion before the target moves; may be empty."""
        end = self.target.rest_end
        drift = self.position[end] - self.position[0]
        if abs(drift) <= NOTABLE * self._measure_distance():
            return ""
        ways = ("sinks", "climbs") if self.place in MORE_LESS else ("moves back", "moves on")
        way = ways[drift > 0.0]
        text = f"When it should stand still, it {way} {self._format_size(drift)}"
        if self.position[end] in self.stops:
            return f"{text} and reaches its hard stop."
        return f"{text} in {self.target.time[end]:.1g} s."

    def _describe_cruise(self) -> str:
        """A sentence about its speed at the end of the cruise; may be empty."""
        place = self.target.cruise_end
        wanted, found = self.target.velocity[place], self.velocity[place]
        text = f"When it should move at {wanted:.3g} {self.symbol}/s, it"
        if self.position[place] in self.stops:
            return f"{text} has already reached its hard stop."
        if abs(found) <= STANDSTILL * abs(wanted):
            return f"{text} hardly moves."
        if found * wanted < 0.0:
            return f"{text} goes the other way."
        off = (found - wanted) * math.copysign(1.0, wanted)
        if abs(off) > CLEAR * abs(wanted) and self._format_size(found) != self._format_size(wanted):
            return f"{text} reaches {self._format_size(found)}/s."
        if abs(off) > NOTABLE * abs(wanted):
            return f"{text} is {self._format_size(off)}/s too {'fast' if off > 0.0 else 'slow'}."
        return self._describe_rise()

    def _describe_rise(self) -> str:
        """A sentence about the speed error during acceleration; may be empty."""
        wanted = self.target.velocity
        rising = range(self.target.rest_end, self.target.cruise_end)
        off = max((self.velocity[k] - wanted[k] for k in rising), key=abs, default=0.0)
        if abs(off) <= NOTABLE * max(map(abs, wanted)):
            return ""
        ahead = off * wanted[self.target.cruise_end] > 0.0
        way = "high" if ahead else "low"
        return f"While it speeds up, its velocity is up to {self._format_size(off)}/s too {way}."

    def _describe_end(self) -> str:
        """A sentence about the final position error; may be empty."""
        off = self.position[-1] - self.target.position[-1]
        if not self.place or abs(off) <= NOTABLE * self._measure_distance():
            return ""
        more, less = MORE_LESS.get(self.place, ("ahead of", "behind"))
        return f"It ends {self._format_size(off)} {more if off > 0.0 else less} where it should be."

    def _format_size(self, value: float) -> str:
        """An absolute value with one digit and unit."""
        return f"about {float(f'{abs(value):.1g}'):g} {self.symbol}"


def follow_profile(
    plant: Plant,
    believed: Plant,
    wanted: Profile,
    *,
    name: str,
    symbol: str,
    place: str = "way",
    stops: tuple[float, float] = INFINITE,
) -> FollowedProfile:
    """Simulate a mechanism that follows a profile by feedforward alone.

    Args:
        plant: the mechanism with its true gains.
        believed: the mechanism with the gains of the feedforward.
        wanted: the target motion, in the unit of both.
        name: name of the mechanism, for messages.
        symbol: symbol of the unit of position.
        place: name of its position; empty if only its speed matters.
        stops: positions of its hard stops [unit].
    """
    moving = MovingPlant(plant, step=STEP, start=wanted.position[0])
    low, high = stops
    for k, push in enumerate(wanted.acceleration[:-1]):  # feedforward at the middle of each step
        at, speed = (
            (values[k] + values[k + 1]) / 2.0 for values in (wanted.position, wanted.velocity)
        )
        asked = _compute_feedforward(believed, at, speed, push)
        moving.apply_voltage(min(max(asked, -BATTERY), BATTERY))
        if not low < moving.path[-1] < high:
            moving.path[-1], moving.speed[-1] = min(max(moving.path[-1], low), high), 0.0
    return FollowedProfile(
        name, symbol, wanted, tuple(moving.path), tuple(moving.speed), place, stops
    )


def _compute_feedforward(believed: Plant, at: float, speed: float, push: float) -> float:
    """The voltage [V] of WPILib's feedforward classes; without kS at rest."""
    gains, way = believed.gains, (speed > 0.0) - (speed < 0.0)
    moves = gains["kS"] * way + gains["kV"] * speed + gains["kA"] * push
    return moves + believed.compute_gravity_voltage(at)
