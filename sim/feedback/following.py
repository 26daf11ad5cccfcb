"""Simulate a mechanism that follows a motion profile with feedforward only.

    volts = kS·sgn(v) + kV·v + kA·a + gravity       by the gains somebody believes in, at most 12 V
    kA·v' = volts - kS·sgn(v) - kV·v - gravity      by the gains the mechanism has

Nothing corrects an error here, so every wrong gain shows in the motion, each in its own way.
"""

import math
import re
from dataclasses import dataclass

from sim.feedback.profile import STEP, Profile
from sim.feedback.response import BATTERY, MovingPlant, Plant

SEEN = 0.02  # [share] of a way or a speed: a smaller miss is none worth a word
CLEAR = 0.25  # [share] of a speed: from here on the speed itself says more than the difference
STANDS = 0.05  # [share] of the speed asked for, below which it hardly moves
INFINITE = (-math.inf, math.inf)
BESIDE = {"height": ("above", "below"), "angle": ("above", "below")}


@dataclass(frozen=True, eq=False)
class FollowedProfile:
    """A motion profile, and the motion of the mechanism that followed it.

    Args:
        name: of the mechanism: ``elevator``.
        symbol: of its unit of position.
        target: the profile.
        position: (n,) [unit].
        velocity: (n,) [unit/s].
        place: what its position is called, ``height``; empty where only its speed matters.
        stops: [unit] between which it can move.
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
        """What happens, in short sentences with rounded numbers."""
        parts = [part for part in (self._held(), self._went(), self._stands()) if part]
        told = " ".join(parts) or "Here it does nearly what it should."
        return re.sub(r"\b[Ii]t\b", lambda it: self._named(it[0]), told, count=1)

    def _named(self, it: str) -> str:
        return f"{'The' if it == 'It' else 'the'} {self.name}"

    def _way(self) -> float:
        return max(self.target.position) - min(self.target.position)

    def _held(self) -> str:
        """What it does while it shall stand still, before it moves."""
        end = self.target.rest_end
        drift = self.position[end] - self.position[0]
        if abs(drift) <= SEEN * self._way():
            return ""
        ways = ("sinks", "climbs") if self.place in BESIDE else ("moves back", "moves on")
        way = ways[drift > 0.0]
        told = f"When it should stand still, it {way} {self._size(drift)}"
        if self.position[end] in self.stops:
            return f"{told} and reaches its hard stop."
        return f"{told} in {self.target.time[end]:.1g} s."

    def _went(self) -> str:
        """How fast it is when it should be steady."""
        place = self.target.cruise_end
        wanted, found = self.target.velocity[place], self.velocity[place]
        told = f"When it should move at {wanted:.2g} {self.symbol}/s, it"
        if self.position[place] in self.stops:
            return f"{told} has already reached its hard stop."
        if abs(found) <= STANDS * abs(wanted):
            return f"{told} hardly moves."
        if found * wanted < 0.0:
            return f"{told} goes the other way."
        off = (found - wanted) * math.copysign(1.0, wanted)
        if abs(off) > CLEAR * abs(wanted) and self._size(found) != self._size(wanted):
            return f"{told} reaches {self._size(found)}/s."
        if abs(off) > SEEN * abs(wanted):
            return f"{told} is {self._size(off)}/s too {'fast' if off > 0.0 else 'slow'}."
        return self._gets_there()

    def _gets_there(self) -> str:
        """How far it is off while it gets faster, where it is right once it is."""
        wanted = self.target.velocity
        rising = range(self.target.rest_end, self.target.cruise_end)
        off = max((self.velocity[k] - wanted[k] for k in rising), key=abs, default=0.0)
        if abs(off) <= SEEN * max(map(abs, wanted)):
            return ""
        ahead = off * wanted[self.target.cruise_end] > 0.0
        way = "high" if ahead else "low"
        return f"While it speeds up, its velocity is up to {self._size(off)}/s too {way}."

    def _stands(self) -> str:
        """How far it is off in the end."""
        off = self.position[-1] - self.target.position[-1]
        if not self.place or abs(off) <= SEEN * self._way():
            return ""
        more, less = BESIDE.get(self.place, ("ahead of", "behind"))
        return f"It ends {self._size(off)} {more if off > 0.0 else less} where it should be."

    def _size(self, value: float) -> str:
        """One digit: it is a picture, not a measurement."""
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
        plant: the mechanism as it is.
        believed: as the feedforward's class and gains have it.
        wanted: the desired motion, in the unit of both.
        name: of the mechanism, for people.
        symbol: of the unit of position.
        place: what its position is called; empty where only its speed matters.
        stops: [unit] between which it can move.
    """
    moving = MovingPlant(plant, step=STEP, start=wanted.position[0])
    low, high = stops
    for k, push in enumerate(wanted.acceleration[:-1]):  # for the middle of each step
        at, speed = (
            (values[k] + values[k + 1]) / 2.0 for values in (wanted.position, wanted.velocity)
        )
        asked = _volts(believed, at, speed, push)
        moving.apply_voltage(min(max(asked, -BATTERY), BATTERY))
        if not low < moving.path[-1] < high:
            moving.path[-1], moving.speed[-1] = min(max(moving.path[-1], low), high), 0.0
    return FollowedProfile(
        name, symbol, wanted, tuple(moving.path), tuple(moving.speed), place, stops
    )


def _volts(believed: Plant, at: float, speed: float, push: float) -> float:
    """[V] that WPILib's feedforward classes ask for; none for friction where it shall stand."""
    gains, way = believed.gains, (speed > 0.0) - (speed < 0.0)
    moves = gains["kS"] * way + gains["kV"] * speed + gains["kA"] * push
    return moves + believed.compute_gravity_voltage(at)
