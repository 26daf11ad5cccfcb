"""Wrong answers to exercise 3, and what a learner must be told about each."""

import math

from grader.mistake import Mistake, Numbers, exchanged, number, replacing

ANSWERS = "answers.toml"


def in_degrees(right: Numbers) -> float:
    """The arm's kG from the row where the encoder reads 0, by a cosine that counts in radians."""
    offset = right["arm_offset"]
    return right["arm_kG"] * math.cos(math.radians(offset)) / math.cos(offset)


EDGE, SIMPLE, UNITS = "M-KG-EDGE", "M-NO-KG-IN-SYSID", "M-UNITS"

MISTAKES = (
    Mistake(
        "nothing for kG",
        ANSWERS,
        replacing(("elevator_kG = ", 'elevator_kG = "" # ')),
        "elevator-kg",
        "nothing yet",
    ),
    Mistake(
        "where it begins to rise for the elevator's kG",
        ANSWERS,
        number("elevator_kG", lambda right: right["elevator_kG"] + right["elevator_kS"]),
        "elevator-kg",
        "an edge of the band",
        EDGE,
    ),
    Mistake(
        "where it does not fall for the elevator's kG",
        ANSWERS,
        number("elevator_kG", lambda right: right["elevator_kG"] - right["elevator_kS"]),
        "elevator-kg",
        "an edge of the band",
        EDGE,
    ),
    Mistake(
        "both edges added up",
        ANSWERS,
        number("elevator_kG", lambda right: 2.0 * right["elevator_kG"]),
        "elevator-kg",
        "added up",
        EDGE,
    ),
    Mistake(
        "the whole band for the elevator's kS",
        ANSWERS,
        number("elevator_kS", lambda right: 2.0 * right["elevator_kS"]),
        "elevator-ks",
        "the whole width",
        EDGE,
    ),
    Mistake(
        "a quarter of the band for the arm's kS",
        ANSWERS,
        number("arm_kS", lambda right: right["arm_kS"] / 2.0),
        "arm-ks",
        "a quarter of the width",
        EDGE,
    ),
    Mistake(
        "gravity and friction in one",
        ANSWERS,
        number("elevator_kS", lambda right: right["elevator_kG"] + right["elevator_kS"]),
        "elevator-ks",
        "in one",
        SIMPLE,
    ),
    Mistake(
        "no gravity at all",
        ANSWERS,
        number("elevator_kG", lambda _: 0.0),
        "elevator-kg",
        "takes nothing",
        SIMPLE,
    ),
    Mistake(
        "kG and kS swapped",
        ANSWERS,
        exchanged("elevator_kG", "elevator_kS"),
        "elevator-kg",
        "swapped?",
        "M-ARGORDER",
    ),
    Mistake(
        "an edge for the arm's kG",
        ANSWERS,
        number("arm_kG", lambda right: right["arm_kG"] + right["arm_kS"]),
        "arm-kg",
        "an edge of the band",
        EDGE,
    ),
    Mistake(
        "the reading taken for the angle",
        ANSWERS,
        number(
            "arm_kG",
            lambda right: right["arm_kG"] * math.cos(math.radians(right["arm_offset"])),
        ),
        "arm-kg",
        "where the encoder reads 0",
    ),
    Mistake(
        "degrees in the cosine",
        ANSWERS,
        number("arm_kG", in_degrees),
        "arm-kg",
        "counts in radians",
        UNITS,
    ),
    Mistake(
        "the offset turned around",
        ANSWERS,
        number("arm_offset", lambda right: -right["arm_offset"]),
        "arm-offset",
        "the sign is not",
    ),
    Mistake(
        "the offset in radians",
        ANSWERS,
        number("arm_offset", lambda right: math.radians(right["arm_offset"])),
        "arm-offset",
        "in radians?",
        UNITS,
    ),
    Mistake(
        "the offset from vertical",
        ANSWERS,
        number("arm_offset", lambda right: right["arm_offset"] - 90.0),
        "arm-offset",
        "from vertical?",
    ),
    Mistake(
        "cosine over sine for the tangent",
        ANSWERS,
        number(
            "arm_offset",
            lambda right: math.copysign(90.0, right["arm_offset"]) - right["arm_offset"],
        ),
        "arm-offset",
        "change places?",
    ),
    Mistake(
        "an offset in volts",
        ANSWERS,
        replacing(("arm_offset = ", 'arm_offset = "3 V" # ')),
        "arm-offset",
        "does not measure",
        UNITS,
    ),
    Mistake(
        "Simple for the elevator",
        ANSWERS,
        replacing(('elevator_type = "Elevator"', 'elevator_type = "Simple"')),
        "elevator-type",
        "knows no gravity",
        SIMPLE,
    ),
    Mistake(
        "a motor's class for the arm",
        ANSWERS,
        replacing(('"ArmFeedforward"', '"SimpleMotorFeedforward"')),
        "arm-class",
        "knows no gravity",
        SIMPLE,
    ),
    Mistake(
        "the elevator's type for the arm",
        ANSWERS,
        replacing(('arm_type = "Arm"', 'arm_type = "elevator"')),
        "arm-type",
        "change with an angle",
    ),
    Mistake(
        "a class that there is not",
        ANSWERS,
        replacing(('"ElevatorFeedforward"', '"LiftFeedforward"')),
        "elevator-class",
        "Choose one of: SimpleMotorFeedforward, ArmFeedforward, ElevatorFeedforward",
    ),
    Mistake(
        "a number for a word",
        ANSWERS,
        replacing(('arm_type = "Arm"', "arm_type = 2")),
        "arm-type",
        "not a word",
    ),
)
