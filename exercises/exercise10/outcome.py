"""The motion of a learner's mechanism that follows a profile by its feedforward alone."""

import math

from grader.checks.check import NotReachedError, WrongAnswer
from grader.checks.consequence import Consequence, follow_profiles
from grader.robotcode.bench.gains_run import Gains
from sim.feedback import Plant
from sim.feedback.following import INFINITE, follow_profile
from sim.feedback.profile import Profile, make_brisk_profile, make_return_profile

from .feedforwards import GRAVITY, SETTINGS, Seen
from .key import CLASSES, SCALED, Variant, near

TYPES = {made: analysis.lower() for analysis, made in CLASSES.items()}
POSITIONS = {"arm": "angle", "elevator": "height", "shooter": ""}  # what a position is called
ROOM = {"arm": (-0.8, 1.6), "elevator": (0.0, 1.3)}  # [rad from level, m]
START = {"arm": 0.0, "elevator": 0.5}
SPEED = {"arm": 1.0, "elevator": 0.5}  # [rad/s, m/s]
RISING, STEADY, STILL = 0.25, 0.75, 0.5  # [s]


def find_outcome(seen: Seen) -> Consequence | None:
    """The motion under the feedforward; None if it is right or unknown."""
    variant = seen.variant
    try:
        one = seen.feedforwards[0]
    except (WrongAnswer, NotReachedError):
        return None
    given = {GRAVITY.get(n, n): value for n, value in one.gains.items() if n not in SETTINGS}
    if not all(value is not None and math.isfinite(value) for value in given.values()):
        return None
    gains = {"kS": 0.0, "kV": 0.0, "kA": 0.0} | {
        name: _convert_to_code(name, value or 0.0, variant) for name, value in given.items()
    }
    truth = {name: _convert_to_code(name, variant.needed(name), variant) for name in variant.gains}
    kind = _find_type(one)
    if kind == variant.analysis.lower() and all(
        near(gains.get(name, 0.0), value) for name, value in truth.items()
    ):
        return None
    plant, believed = Plant(variant.analysis.lower(), truth), Plant(kind, gains)
    followed = follow_profile(
        plant,
        believed,
        _make_profile(plant, variant.kind),
        name=variant.kind,
        symbol=variant.coded_symbol,
        place=POSITIONS.get(variant.kind, "way"),
        stops=ROOM.get(variant.kind, INFINITE),
    )
    return follow_profiles([followed])


def _find_type(one: Gains) -> str:
    """The type of the mechanism: ``simple``, ``elevator`` or ``arm``."""
    if one.kind in TYPES:
        return TYPES[one.kind]
    if "kCos" in one.gains or one.choices.get("GravityType") == "Arm_Cosine":
        return "arm"
    return "elevator" if one.gains.get("kG") else "simple"


def _convert_to_code(name: str, value: float, variant: Variant) -> float:
    """A gain of the place in the unit that the robot's code uses."""
    return (
        value * variant.convert_to_code_unit(name) / variant.needed(name)
        if name in SCALED
        else value
    )


def _make_profile(plant: Plant, kind: str) -> Profile:
    if kind in SPEED:
        return make_return_profile(
            SPEED[kind], rising=RISING, steady=STEADY, still=STILL, start=START[kind]
        )
    return make_brisk_profile(plant)
