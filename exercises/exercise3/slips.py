"""The slips of exercise 3, and what each would make of a learner's own numbers."""

import math
from collections.abc import Iterator, Sequence

from grader.answers.number_answer import AnswerKey, diagnose_number
from grader.answers.wrong_number import Lookalike, Scene, WrongNumber

from .holds import Hold, Variant

NEAR = (0.985, 1.0, 1.015)  # [share] a slip is named for who rounds, too

EDGE = WrongNumber(
    "edge",
    "that is an edge of the band in which nothing moves. At an edge, friction is included",
    "M-KG-EDGE",
)
WIDTH = WrongNumber(
    "width",
    "that is the whole width of the band. Draw the band, its middle and its edges",
    "M-KG-EDGE",
)
QUARTER = WrongNumber(
    "quarter",
    "that is a quarter of the width of the band. How far is it from the middle to an edge?",
    "M-KG-EDGE",
)
BOTH = WrongNumber(
    "both", "this is the sum of both edges. What is in the middle between them?", "M-KG-EDGE"
)
SIMPLE = WrongNumber(
    "simple",
    "this is what the analysis type Simple would give: gravity and friction in one number",
    "M-NO-KG-IN-SYSID",
)
NONE = WrongNumber(
    "none",
    "this means that gravity needs no voltage. Would it stay up without a voltage?",
    "M-NO-KG-IN-SYSID",
)
AS_READ = WrongNumber(
    "as-read",
    "that is the middle of the band where the encoder reads 0. Is the arm horizontal there?",
)
LARGEST = WrongNumber(
    "largest",
    "that is the largest middle in your table. Was the arm horizontal in that row?",
)
DEGREES = WrongNumber(
    "degrees",
    "it looks as if you put degrees into a cosine that uses radians",
    "M-UNITS",
)


def key_of(variant: Variant, *, offset: float) -> AnswerKey:
    """What is asked for, with what slips would give who uses this offset [deg]."""
    scene = Scene(lookalikes=dict(_lookalikes(variant, offset)), rarer=_of_the_other(variant))
    return AnswerKey(variant.asked, scene)


def _of_the_other(variant: Variant) -> dict[str, tuple[Lookalike, ...]]:
    """Gain -> the same gain of the other mechanism [V]."""
    says = "this is the number of your {}. Each of the two has its own"
    pairs = (("elevator", "arm"), ("arm", "elevator"))
    return {
        f"{mine}_{gain}": (
            Lookalike(variant.found[f"{other}_{gain}"], WrongNumber("other", says.format(other))),
        )
        for mine, other in pairs
        for gain in ("kG", "kS")
    }


def telling(variant: Variant) -> bool:
    """Whether every slip earns nothing, and points to one misconception only."""
    key = key_of(variant, offset=variant.found["arm_offset"])
    each = [(name, one) for name, likely in key.scene.lookalikes.items() for one in likely]
    return all(_far(name, one, key) for name, one in each) and all(
        {slip.misconception for slip in diagnose_number(name, {name: share * one.value}, key)}
        == {one.slip.misconception}
        for name, one in each
        if one.value
        for share in NEAR
    )


def _far(name: str, likely: Lookalike, key: AnswerKey) -> bool:
    asked = key.asked[name]
    full, partial = asked.band.widths(asked.expected)
    return abs(likely.value - asked.expected) > (full if likely.slip is LARGEST else partial)


def _lookalikes(variant: Variant, offset: float) -> Iterator[tuple[str, tuple[Lookalike, ...]]]:
    """Gain -> what the known slips make of the learner's own numbers [V]."""
    level = next(hold for hold in variant.arm if hold.reading == 0.0)
    found = variant.found
    for name, rows in {"elevator": (variant.elevator,), "arm": variant.arm}.items():
        kg, ks = found[f"{name}_kG"], found[f"{name}_kS"]
        edges = {kg - ks, kg + ks}
        of_kg = [(2.0 * ks, WIDTH), (2.0 * kg, BOTH), (0.0, NONE)]
        if name == "arm":
            edges |= {level.lower, level.upper, max(row.upper for row in rows)}
            of_kg += [(level.middle, AS_READ), (max(row.middle for row in rows), LARGEST)]
            of_kg += [(volts, DEGREES) for volts in _in_degrees(rows, offset)]
        of_kg += [(edge, EDGE) for edge in sorted(edges)]
        halves = _halves(rows, ks)
        of_ks = [(2.0 * half, WIDTH) for half in halves] + [
            (half / 2.0, QUARTER) for half in halves
        ]
        of_ks += [(kg - ks, EDGE), (kg + ks, SIMPLE)]
        yield f"{name}_kG", tuple(Lookalike(*one) for one in of_kg)
        yield f"{name}_kS", tuple(Lookalike(*one) for one in of_ks)


def _halves(rows: Sequence[Hold], mean: float) -> list[float]:
    """Half the width of a band: as each row has it, and their mean [V]."""
    return [mean, *(row.friction for row in rows)]


def _in_degrees(arm: Sequence[Hold], offset: float) -> list[float]:
    """The kG each row gives who puts degrees into the cosine [V]."""
    return [hold.middle / math.cos(hold.reading + offset) for hold in arm]


def offset_slips(value: float, variant: Variant) -> Iterator[tuple[str, str]]:
    """What a wrong offset [deg] may have been: a sentence and its misconception."""
    nearest = max(variant.arm, key=lambda hold: hold.middle)
    slips = (
        (-value, "the size is right, the sign is not. The offset is what you add to a reading", ""),
        (math.degrees(value), "57.3 = 180/π. Is this in radians? Write degrees", "M-UNITS"),
        (360.0 * value, "a rotation is 360°. Is this in rotations?", "M-UNITS"),
        (value + 90.0, "it is 90° off. Is this measured from vertical?", ""),
        (value - 90.0, "it is 90° off. Is this measured from vertical?", ""),
        (90.0 - value, "tan is sine over cosine. Did the two change places?", ""),
        (-90.0 - value, "tan is sine over cosine. Did the two change places?", ""),
    )
    for undone, says, code in slips:
        if variant.offset.is_right(turned(undone)):
            yield says, code
    if abs(value) == abs(nearest.reading):
        yield (
            (
                "you took the row with the most voltage for horizontal. It is only the nearest of "
                "five: compute the offset from two rows"
            ),
            "",
        )


def turned(angle: float) -> float:
    """The same angle between -180 and 180 [deg]."""
    return (angle + 180.0) % 360.0 - 180.0
