"""Wrong theoretical kV's, and the mistakes that lead to them."""

import math
from itertools import combinations

from grader.answers.wrong_number import Lookalike, WrongNumber

from .team import Variant

UNITS, GEARING = "M-UNITS", "M-GEARING"


def lookalikes(variant: Variant) -> tuple[Lookalike, ...]:
    """What the known slips make of a learner's own parts; the measured kV comes first."""
    parts = variant.parts
    gears = "the free speed is that of the motor. How fast is the output then? Use the gear ratio"
    found = [
        (variant.measured, "this is the measured kV. Compute the theoretical one", ""),
        (parts.theoretical_kv / 60.0, "60 seconds are a minute. Did you divide by rpm?", UNITS),
        (
            parts.theoretical_kv * 60.0,
            "60 seconds are a minute. Did you multiply by 60 once too often?",
            UNITS,
        ),
        (parts.theoretical_kv / parts.ratio, gears, GEARING),
        (
            parts.theoretical_kv / parts.ratio**2,
            "is the gear ratio upside down? The output is slower",
            GEARING,
        ),
    ]
    skipped = [(60.0, "60 seconds are a minute"), (parts.ratio, "the gear ratio")]
    if parts.diameter:
        skipped.append((1.0 / (math.pi * parts.diameter), "how far one turn of the wheel goes"))
    for count in range(2, len(skipped) + 1):
        for steps in combinations(skipped, count):
            missing = " and ".join(name for _, name in steps)
            says = (
                "12 V divided by a free speed that is not in your unit yet. Still missing: "
                f"{missing}"
            )
            code = UNITS if skipped[0] in steps else GEARING
            found.append(
                (parts.theoretical_kv / math.prod(times for times, _ in steps), says, code)
            )
    coded = float(variant.told["code"]["ratio"])
    if coded != parts.ratio:
        says = "this uses the ratio in the code. Use the real ratio"
        found.append((parts.theoretical_kv * coded / parts.ratio, says, ""))
    if parts.diameter:
        found += _slips_of_a_wheel(variant)
    else:
        turn = "2π = 6.28. Is this per radian? Write it per rotation"
        found += [
            (parts.theoretical_kv * times, turn, UNITS) for times in (2 * math.pi, 0.5 / math.pi)
        ]
        found += [
            (parts.theoretical_kv / 360.0, "a rotation is 360°. Is your speed in degrees?", UNITS)
        ]
    if parts.motors == 4:
        many = "four motors share the work, but none of them turns faster for it"
        found += [(parts.theoretical_kv * times, many, "") for times in (0.25, 4.0)]
    return _named(found)


def _slips_of_a_wheel(variant: Variant) -> list[Lookalike]:
    """What slips between a wheel's turns and its way make of kV_theory."""
    kv, diameter = variant.parts.theoretical_kv, variant.parts.diameter
    radius = "a factor of 2: did you mix up diameter and radius?"
    if variant.parts.motors == 2:
        radius += " Or did you count the motors? Two motors do not turn faster than one"
    around = "2π = 6.28. One turn of a wheel is how many meters of ground?"
    turn = "that is volts for each turn of the wheel in a second. How far does one turn go?"
    angle = "that is volts for each rad/s of the wheel. How far does it go in one radian?"
    return [
        *((kv * times, radius, GEARING) for times in (0.5, 2.0)),
        *((kv * times, around, UNITS) for times in (2 * math.pi, 0.5 / math.pi)),
        (kv * math.pi * diameter, turn, GEARING),
        (kv * diameter / 2.0, angle, GEARING),
    ]


def rarer(variant: Variant) -> tuple[Lookalike, ...]:
    """What rarer slips make of the parts."""
    parts = variant.parts
    found = [
        (
            12.0 / parts.theoretical_kv,
            "this is the free speed of your mechanism. kV_theory is 12 V divided by it",
            "",
        ),
        (
            1.0 / parts.theoretical_kv,
            "this is upside down: speed for each volt. kV is volts for each unit of speed",
            "",
        ),
    ]
    if parts.diameter:
        around = "π = 3.14 is missing: one turn of a wheel or drum goes π times its diameter"
        found += [
            (parts.theoretical_kv * times, around, GEARING) for times in (math.pi, 1 / math.pi)
        ]
    return _named(found)


def _named(found: list[tuple[float, str, str]]) -> tuple[Lookalike, ...]:
    return tuple(Lookalike(value, WrongNumber(says, says, code)) for value, says, code in found)
