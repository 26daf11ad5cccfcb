"""What a learner's gravity and friction would do: an elevator and an arm that go up and come down.

Nobody asks for kV and kA here, so the feedforward has the right ones; both follow from the parts
that the course's own elevator and arm are made of, and kA from kG: the same mass makes both.
"""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.answers.number_answer import AskedNumber, read_answer_number
from grader.check import WrongAnswer
from grader.consequence import Consequence, follow_profiles

from .holds import Variant

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sim.feedback.following import FollowedProfile

FALLS = {"elevator": 9.81, "arm": 19.62}  # [m/s² or rad/s²] what gravity alone would do
KV = {"elevator": 4.5, "arm": 1.2}  # [V·s/m, V·s/rad]
SPEED = {"elevator": 0.5, "arm": 1.0}  # [m/s, rad/s]
RISING, STEADY, STILL = 0.25, 0.75, 1.0  # [s]
HEIGHT = 0.5  # [m] where the elevator begins
ROOM = {"elevator": (0.0, 1.3), "arm": (-math.pi / 4, math.pi / 2)}  # [m, rad from level]


def outcome(given: Mapping[str, object], variant: Variant) -> Consequence | None:
    """What the numbers would do; None where none is wrong, or too few are there."""
    found = [*_elevator(given, variant), *_arm(given, variant)]
    return follow_profiles(found) if found else None


def _numbers(
    given: Mapping[str, object], asked: Mapping[str, AskedNumber]
) -> dict[str, float] | None:
    """The numbers, if all of them are there, and not all of them right."""
    try:
        values = {name: read_answer_number(given.get(name), one) for name, one in asked.items()}
    except WrongAnswer:
        return None
    return None if all(one.is_right(values[name]) for name, one in asked.items()) else values


def _elevator(given: Mapping[str, object], variant: Variant) -> "Iterator[FollowedProfile]":
    names = ("elevator_kG", "elevator_kS")
    if values := _numbers(given, {name: variant.asked[name] for name in names}):
        truth = {name[-2:]: variant.asked[name].expected for name in names}
        theirs = {name[-2:]: values[name] for name in names}
        yield _followed("elevator", truth, theirs, start=HEIGHT, room=ROOM["elevator"])


def _arm(given: Mapping[str, object], variant: Variant) -> "Iterator[FollowedProfile]":
    """From level up and back; an angle is what the encoder reads, as the learner's code has it."""
    names = ("arm_kG", "arm_kS")
    asked = {name: variant.asked[name] for name in names} | {"arm_offset": variant.offset}
    if values := _numbers(given, asked):
        truth = {name[-2:]: variant.asked[name].expected for name in names}
        theirs = {name[-2:]: values[name] for name in names}
        level = -math.radians(variant.offset.expected)
        truth["offset_rad"], theirs["offset_rad"] = -level, math.radians(values["arm_offset"])
        low, high = ROOM["arm"]
        yield _followed("arm", truth, theirs, start=level, room=(level + low, level + high))


def _followed(
    kind: str,
    truth: Mapping[str, float],
    theirs: Mapping[str, float],
    *,
    start: float,
    room: tuple[float, float],
) -> "FollowedProfile":
    from sim.feedback import Plant  # noqa: PLC0415 - numpy only where it is needed
    from sim.feedback.following import follow_profile  # noqa: PLC0415 - the same
    from sim.feedback.profile import make_return_profile  # noqa: PLC0415 - the same

    moves = {"kV": KV[kind], "kA": truth["kG"] / FALLS[kind]}
    symbol, place = ("m", "height") if kind == "elevator" else ("rad", "angle")
    wanted = make_return_profile(
        SPEED[kind], rising=RISING, steady=STEADY, still=STILL, start=start
    )
    plant, believed = (Plant(kind, {**gains, **moves}) for gains in (truth, theirs))
    return follow_profile(
        plant, believed, wanted, name=kind, symbol=symbol, place=place, stops=room
    )
