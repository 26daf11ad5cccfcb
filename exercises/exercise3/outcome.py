"""The motion of an elevator and an arm under a learner's gravity and friction.

Nobody asks for kV and kA here, so the feedforward has the right ones; both follow from the parts
that the course's own elevator and arm are made of, and kA from kG: the same mass makes both.
"""

import math
from collections.abc import Iterator, Mapping

from grader.answers.number_answer import read_wrong_numbers
from grader.checks.consequence import Consequence, follow_profiles
from sim.feedback import Plant
from sim.feedback.following import FollowedProfile, follow_profile
from sim.feedback.profile import make_return_profile

from .holds import Variant

FALLS = {"elevator": 9.81, "arm": 19.62}  # [m/s² or rad/s²] what gravity alone would do
KV = {"elevator": 4.5, "arm": 1.2}  # [V·s/m, V·s/rad]
SPEED = {"elevator": 0.5, "arm": 1.0}  # [m/s, rad/s]
RISING, STEADY, STILL = 0.25, 0.75, 1.0  # [s]
HEIGHT = 0.5  # [m] where the elevator begins
ROOM = {"elevator": (0.0, 1.3), "arm": (-math.pi / 4, math.pi / 2)}  # [m, rad from level]


def find_outcome(given: Mapping[str, object], variant: Variant) -> Consequence | None:
    """The motion with the learner's kG, kS and offset; None if all are right, or too few given."""
    found = list(_follow_profiles(given, variant))
    return follow_profiles(found) if found else None


def _follow_profiles(given: Mapping[str, object], variant: Variant) -> Iterator[FollowedProfile]:
    """Up and back. The arm begins level; its angle is the encoder's, as in the learner's code."""
    for kind in ("elevator", "arm"):
        names = (f"{kind}_kG", f"{kind}_kS")
        asked = {name: variant.asked[name] for name in names}
        if kind == "arm":
            asked["arm_offset"] = variant.offset
        values = read_wrong_numbers(given, asked)
        if not values:
            continue
        truth = {name[-2:]: asked[name].expected for name in names}
        theirs = {name[-2:]: values[name] for name in names}
        start, (low, high) = HEIGHT, ROOM[kind]
        if kind == "arm":
            truth["offset_rad"] = math.radians(variant.offset.expected)
            theirs["offset_rad"] = math.radians(values["arm_offset"])
            start = -truth["offset_rad"]
            low, high = start + low, start + high
        moves = {"kV": KV[kind], "kA": truth["kG"] / FALLS[kind]}
        symbol, place = ("m", "height") if kind == "elevator" else ("rad", "angle")
        plant, believed = (Plant(kind, {**gains, **moves}) for gains in (truth, theirs))
        wanted = make_return_profile(
            SPEED[kind], rising=RISING, steady=STEADY, still=STILL, start=start
        )
        yield follow_profile(
            plant, believed, wanted, name=kind, symbol=symbol, place=place, stops=(low, high)
        )
