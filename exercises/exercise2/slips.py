"""Wrong theoretical kV's, and the mistakes that lead to them."""

import math
from itertools import combinations

from grader.wrong_number import Lookalike, WrongNumber

from .team import Variant

UNITS = "M-UNITS"


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
        (parts.theoretical_kv / parts.ratio, gears, UNITS),
        (
            parts.theoretical_kv / parts.ratio**2,
            "is the gear ratio upside down? The output is slower",
            UNITS,
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
            found.append(
                (parts.theoretical_kv / math.prod(times for times, _ in steps), says, UNITS)
            )
    coded = float(variant.told["code"]["ratio"])
    if coded != parts.ratio:
        says = "this uses the ratio in the code. Use the real ratio"
        found.append((parts.theoretical_kv * coded / parts.ratio, says, ""))
    if parts.diameter:
        radius = "a factor of 2: did you mix up diameter and radius?"
        around = "2π = 6.28. One turn of a wheel is how many meters of ground?"
        still = "that is volts for each turn of the wheel in a second. How far does one turn go?"
        found += [(parts.theoretical_kv * times, radius, UNITS) for times in (0.5, 2.0)]
        found += [
            (parts.theoretical_kv * times, around, UNITS) for times in (2 * math.pi, 0.5 / math.pi)
        ]
        found += [(parts.theoretical_kv * math.pi * parts.diameter, still, UNITS)]
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
    return tuple(Lookalike(value, WrongNumber(says, says, code)) for value, says, code in found)
