"""A mechanism for each learner, and what the analyzer showed of it; a conversion is always due."""

from dataclasses import replace
from itertools import combinations

import numpy as np

from grader.student_data.variant import choose, draw_until, make_student_rng, round_digits
from sim.bench.mechanisms import MECHANISMS
from sim.core.units import convert_gains

from .key import FULL, LENGTHS, PLACES, SLOT0, UNITS, Variant, near

# kind -> analysis, and pairs of what the analyzer counted in and what the robot's code counts in.
# An ArmFeedforward takes radians, whatever the rest of a program does.
KINDS = {
    "arm": ("Arm", (("Rotations", "Radians"), ("Degrees", "Radians"))),
    "drivetrain": ("Simple", (("Feet", "Meters"), ("Inches", "Meters"))),
    "elevator": ("Elevator", (("Inches", "Meters"), ("Feet", "Meters"))),
    "shooter": ("Simple", (("Rotations", "Radians"), ("Radians", "Rotations"))),
    "turret": ("Simple", (("Rotations", "Radians"), ("Degrees", "Radians"))),
}
KP = (0.4, 1.6)  # times kV: what the analyzer suggests for the mechanisms of the course
APART = 0.15  # [share] any two numbers differ by more, so that each is known by its size
SLIPS = (FULL, 60.0)  # no gain may pass for another that is off by one of these
ALIKE = 0.05
DIGITS = 4
GEARED = 1.5  # our shooter's wheel turns once for so many turns of the motor, not one to one


def draw(student: str) -> Variant:
    """A learner's mechanism, always the same; drawn until its numbers can be told apart."""
    rng = make_student_rng(student, "exercise10")
    kind = choose(tuple(KINDS), rng)
    return draw_until(lambda _: _draw_variant(kind, rng), _is_clear)


def _is_clear(variant: Variant) -> bool:
    """Whether the value of a gain tells which gain it is, in every class that may get it."""
    places = [variant.convert_for_class(place) for place in ("", *PLACES)]
    return all(map(_are_numbers_distinguishable, places)) and _is_gearing_distinguishable(
        variant.convert_for_class(SLOT0)
    )


def _draw_variant(kind: str, rng: np.random.Generator) -> Variant:
    analysis, pairs = KINDS[kind]
    shown_in, used_in = choose(pairs, rng)
    made = MECHANISMS[kind].draw(rng)
    if kind == "shooter":
        made = replace(made, ratio=made.ratio * GEARED)
    found = convert_gains(made.gains, factor=UNITS[shown_in][1])
    found["kP"] = found["kV"] * rng.uniform(*KP)
    names = ("kS", *(("kG",) if "kG" in found else ()), "kV", "kA", "kP")
    shown = {name: round_digits(found[name], DIGITS) for name in names}
    return Variant(
        kind,
        analysis,
        shown,
        shown_in,
        used_in,
        bool(rng.integers(2)),
        ratio=round_digits(made.ratio, 3),
        radius=round_digits(made.radius, 3) if shown_in in LENGTHS else 0.0,
    )


def _is_gearing_distinguishable(variant: Variant) -> bool:
    """Whether the gear ratio differs from every factor between two units of position."""
    others = (UNITS["Rotations"][1], variant.times, 1.0 / variant.times, 1.0)
    return not any(near(variant.ratio, one, share=APART) for one in others)


def _are_numbers_distinguishable(variant: Variant) -> bool:
    """Whether all numbers, given and needed ones, differ in size."""
    times = variant.times
    volts = [variant.shown[name] for name in ("kS", "kG") if name in variant.shown]
    others = [
        {value, variant.shown[name] * times}
        for name, value in variant.shown.items()
        if name in {"kV", "kA", "kP"}
    ]
    others[-1] |= {value / FULL for value in others[-1]}
    ratio = variant.shown["kV"] / variant.shown["kA"]
    if any(
        near(ratio * size, slip, share=ALIKE) for size in (1, times, 1 / times) for slip in SLIPS
    ):
        return False
    for gain in ("kV", "kA"):  # converted twice or the wrong way round, or a duty cycle
        others_ = [name for name in variant.gains if name != gain]
        known = [value for name in others_ for value in (variant.shown[name], variant.needed(name))]
        wrong = (times * times, 1.0 / times, 1.0 / FULL, times / FULL)
        slips = [variant.shown[gain] * size for size in wrong]
        if any(near(slip, value, share=ALIKE) for slip in slips for value in known):
            return False
    groups = [*({value} for value in volts), *others]
    return all(
        abs(one - other) > APART * max(one, other)
        for mine, theirs in combinations(groups, 2)
        for one in mine
        for other in theirs
    )
