"""A mechanism and four moments for each learner, drawn until every slip can be told apart."""

from itertools import combinations

import numpy as np

from grader.student_data.variant import choose, draw_until, make_student_rng, round_digits
from sim.bench.mechanisms import MECHANISMS
from sim.core.units import convert_gains, find_unit

from .budget import MOMENTS, NEAR, SHOWN, Moment, Variant
from .slips import ALIKE, ROUNDED, list_guesses

UNITS = {"drivetrain": "meters", "intake": "rotations", "shooter": "rotations", "turret": "radians"}
SPEED = {  # [V] that the speed takes at each moment: few enough for kS to be noticed
    "forward": (2.2, 5.0),
    "accelerating": (1.2, 3.0),
    "braking": (1.8, 4.0),
    "backward": (2.0, 5.0),
}
RATIOS = ((0.4, 0.75), (1.35, 1.9))  # kA·a over kV·v where the speed, or the acceleration, leads
GRIP = 9.0  # [m/s²] a drivetrain's wheels on carpet: 0.9·g, below a friction of 1.0 to 1.2
LEAST = 0.8  # [V] below, 2 % are less than a learner's rounding
APART = 1.3  # [bands] no slip may come nearer to the key than this
DIGITS = 3


def draw(student: str) -> Variant:
    """A learner's mechanism, always the same one; drawn until every slip can be told apart."""
    rng = make_student_rng(student, "exercise1")
    kind = choose(tuple(SHOWN), rng)
    return draw_until(
        lambda _: _draw_variant(kind, rng),
        lambda variant: _has_grip(variant) and all(_is_clear(variant, name) for name in MOMENTS),
    )


def _draw_variant(kind: str, rng: np.random.Generator) -> Variant:
    unit = find_unit(UNITS[kind])
    found = convert_gains(MECHANISMS[kind].draw(rng).gains, factor=unit.si)
    gains = {name: round_digits(found[name], DIGITS) for name in ("kS", "kV", "kA")}
    moments = {}
    for name, volts in SPEED.items():
        speed = rng.uniform(*volts)
        push = speed * rng.uniform(*choose(RATIOS, rng))
        push *= {"accelerating": 1.0, "braking": -1.0}.get(name, 0.0)
        velocity = round_digits(speed / gains["kV"], DIGITS)
        velocity *= -1.0 if name == "backward" else 1.0
        shown, shown_unit = velocity, f"{unit.symbol}/s"
        if name == "forward":
            shown_unit, times = SHOWN[kind]
            shown = round_digits(velocity * times, DIGITS)
            velocity = shown / times
        acceleration = round_digits(push / gains["kA"], DIGITS)
        moments[name] = Moment(name, velocity, acceleration, shown, shown_unit)
    largest_at = choose(("accelerating", "braking"), rng)
    return Variant(kind, unit.symbol, gains, moments, largest_at)


def _has_grip(variant: Variant) -> bool:
    """Whether a drivetrain's wheels can give these accelerations without slipping."""
    pushes = (abs(at.acceleration) for at in variant.moments.values())
    return variant.kind != "drivetrain" or max(pushes) <= GRIP


def _is_clear(variant: Variant, name: str) -> bool:
    """Whether no slip passes for the answer, and no slip for another one."""
    asked = variant.asked(name)
    if abs(asked.expected) < LEAST:
        return False
    band = APART * NEAR.full * abs(asked.expected)
    alone = [guess for guess in list_guesses(variant, name) if len(guess.slips) == 1]
    return all(abs(guess.volts - asked.expected) > band for guess in alone) and all(
        abs(first.volts - second.volts) > 2 * max(ROUNDED, ALIKE * abs(first.volts))
        for first, second in combinations(alone, 2)
        if first.slips[0].code != second.slips[0].code
    )
