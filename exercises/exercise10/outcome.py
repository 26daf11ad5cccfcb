"""What a learner's feedforward would do: their mechanism follows a profile by it alone."""

import math
from typing import TYPE_CHECKING

from grader.check import NotReachedError, WrongAnswer
from grader.consequence import Consequence, follow_profiles
from grader.robotcode.gain_constants import DeployFacts, Feedforward

from .handed import RATIOS, feedforward_of
from .key import CLASSES, PLACES, SCALED, Variant, near

if TYPE_CHECKING:
    from sim.feedback import Plant
    from sim.feedback.profile import Profile

TYPES = {made: analysis.lower() for analysis, made in CLASSES.items()}
POSITIONS = {"arm": "angle", "elevator": "height", "shooter": ""}  # what a position is called
ROOM = {"arm": (-0.8, 1.6), "elevator": (0.0, 1.3)}  # [rad from level, m]
START = {"arm": 0.0, "elevator": 0.5}
SPEED = {"arm": 1.0, "elevator": 0.5}  # [rad/s, m/s]
RISING, STEADY, STILL = 0.25, 0.75, 0.5  # [s]


def outcome(facts: DeployFacts, variant: Variant) -> Consequence | None:
    """What the feedforward would do; None where it is as it should be, or cannot be told."""
    from sim.feedback import Plant  # noqa: PLC0415 - numpy only where it is needed
    from sim.feedback.following import INFINITE, follow_profile  # noqa: PLC0415 - the same

    try:
        one = feedforward_of(facts, variant)
    except (WrongAnswer, NotReachedError):
        return None
    gains = _gains(one, variant)
    if gains is None or _right(one, gains, variant):
        return None
    truth = {name: _in_code(name, variant.needed(name), variant) for name in variant.gains}
    plant, believed = Plant(variant.analysis.lower(), truth), Plant(_type(one), gains)
    followed = follow_profile(
        plant,
        believed,
        _profile(plant, variant.kind),
        name=variant.kind,
        symbol=variant.coded_symbol,
        place=POSITIONS.get(variant.kind, "way"),
        stops=ROOM.get(variant.kind, INFINITE),
    )
    return follow_profiles([followed])


def _type(one: Feedforward) -> str:
    """How it takes gravity: ``simple``, ``elevator`` or ``arm``."""
    if one.kind in TYPES:
        return TYPES[one.kind]
    if "kCos" in one.arguments or one.choices.get("GravityType") == "armcosine":
        return "arm"
    return "elevator" if "kG" in one.arguments else "simple"


def _in_code(name: str, value: float, variant: Variant) -> float:
    """A gain of the place in the unit that the robot's code uses."""
    return value * variant.coded(name) / variant.needed(name) if name in SCALED else value


def _gains(one: Feedforward, variant: Variant) -> dict[str, float] | None:
    """Place -> number; what is left out counts as 0. None where a number cannot be told."""
    values = [argument.value for argument in one.arguments.values()]
    known = one.kind in TYPES or one.kind in PLACES
    if one.spread or not known or not all(v is not None for v in values):
        return None
    given = {
        "kG" if name == "kCos" else name: _in_code(name, argument.value or 0.0, variant)
        for name, argument in one.arguments.items()
        if name not in RATIOS
    }
    gains = {"kS": 0.0, "kV": 0.0, "kA": 0.0} | given
    return gains if given and all(map(math.isfinite, gains.values())) else None


def _right(one: Feedforward, gains: dict[str, float], variant: Variant) -> bool:
    """Whether it is the feedforward that the mechanism needs."""
    return _type(one) == variant.analysis.lower() and all(
        near(gains.get(name, 0.0), _in_code(name, variant.needed(name), variant))
        for name in variant.gains
    )


def _profile(plant: "Plant", kind: str) -> "Profile":
    from sim.feedback.profile import make_brisk_profile, make_return_profile  # noqa: PLC0415 - numpy, when needed

    if kind in SPEED:
        return make_return_profile(
            SPEED[kind], rising=RISING, steady=STEADY, still=STILL, start=START[kind]
        )
    return make_brisk_profile(plant)
