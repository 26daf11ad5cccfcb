"""Wrong answers to exercise 3, and what a learner must be told about each."""

import math

from grader.exercise.mistake import Mistake, Numbers, change_number, exchange_numbers, replace_text

ANSWERS = "answers.toml"


def convert_to_degrees(right: Numbers) -> float:
    """The arm's kG from the row where the encoder reads 0, by a cosine that counts in radians."""
    offset = right["arm_offset"]
    return right["arm_kG"] * math.cos(math.radians(offset)) / math.cos(offset)


EDGE, SIMPLE, UNITS = "M-KG-EDGE", "M-NO-KG-IN-SYSID", "M-UNITS"

MISTAKES = (
    Mistake("where it begins to rise for the elevator's kG", ANSWERS,
        change_number("elevator_kG", lambda right: right["elevator_kG"] + right["elevator_kS"]),
        "elevator-kg", "an edge of the window", EDGE),
    Mistake("where it does not fall for the elevator's kG", ANSWERS,
        change_number("elevator_kG", lambda right: right["elevator_kG"] - right["elevator_kS"]),
        "elevator-kg", "an edge of the window", EDGE),
    Mistake("is this the sum of both edges", ANSWERS,
        change_number("elevator_kG", lambda right: 2.0 * right["elevator_kG"]), "elevator-kg",
        "is this the sum of both edges", EDGE),
    Mistake("the whole window for the elevator's kS", ANSWERS,
        change_number("elevator_kS", lambda right: 2.0 * right["elevator_kS"]), "elevator-ks",
        "the whole width", EDGE),
    Mistake("a quarter of the window for the arm's kS", ANSWERS,
        change_number("arm_kS", lambda right: right["arm_kS"] / 2.0), "arm-ks",
        "a quarter of the width", EDGE),
    Mistake("the middle of the window for the elevator's kS", ANSWERS,
        change_number("elevator_kS", lambda right: right["elevator_kG"]), "elevator-ks",
        "the middle of the window, the voltage against gravity"),
    Mistake("gravity and friction in one", ANSWERS,
        change_number("elevator_kS", lambda right: right["elevator_kG"] + right["elevator_kS"]),
        "elevator-ks", "in one", SIMPLE),
    Mistake("no gravity at all", ANSWERS, change_number("elevator_kG", lambda _: 0.0),
        "elevator-kg", "then gravity would need no voltage", SIMPLE),
    Mistake("kG and kS swapped", ANSWERS, exchange_numbers("elevator_kG", "elevator_kS"),
        "elevator-kg", "did you swap them?"),
    Mistake("the arm's kG for the elevator", ANSWERS,
        change_number("elevator_kG", lambda right: right["arm_kG"]), "elevator-kg",
        "is this the number of your arm"),
    Mistake("an edge for the arm's kG", ANSWERS,
        change_number("arm_kG", lambda right: right["arm_kG"] + right["arm_kS"]), "arm-kg",
        "an edge of the window", EDGE),
    Mistake("the reading taken for the angle", ANSWERS,
        change_number(
            "arm_kG",
            lambda right: right["arm_kG"] * math.cos(math.radians(right["arm_offset"])),
        ), "arm-kg", "where the encoder reads 0"),
    Mistake("degrees in the cosine", ANSWERS, change_number("arm_kG", convert_to_degrees), "arm-kg",
        "did you put degrees", UNITS),
    Mistake("the offset turned around", ANSWERS,
        change_number("arm_offset", lambda right: -right["arm_offset"]), "arm-offset",
        "the sign is not"),
    Mistake("the offset in radians", ANSWERS,
        change_number("arm_offset", lambda right: math.radians(right["arm_offset"])), "arm-offset",
        "in radians?", UNITS),
    Mistake("the tangent for the offset", ANSWERS,
        change_number("arm_offset", lambda right: math.tan(math.radians(right["arm_offset"]))),
        "arm-offset", "Which angle has this tangent?"),
    Mistake("the offset from vertical", ANSWERS,
        change_number("arm_offset", lambda right: right["arm_offset"] - 90.0), "arm-offset",
        "from vertical?"),
    Mistake("the offset half a turn off", ANSWERS,
        change_number("arm_offset", lambda right: right["arm_offset"] + 180.0), "arm-offset",
        "where is an arm with this offset"),
    Mistake("one sign wrong in the offset", ANSWERS,
        change_number("arm_offset", lambda right: 180.0 - right["arm_offset"]), "arm-offset",
        "where is an arm with this offset"),
    Mistake("cosine over sine for the tangent", ANSWERS,
        change_number(
            "arm_offset",
            lambda right: math.copysign(90.0, right["arm_offset"]) - right["arm_offset"],
        ), "arm-offset", "change places?"),
    Mistake("an offset in volts", ANSWERS, replace_text(("arm_offset = ", 'arm_offset = "3 V" # ')),
        "arm-offset", "is not a unit of", UNITS),
    Mistake("Simple for the elevator", ANSWERS,
        replace_text(('elevator_type = "Elevator"', 'elevator_type = "Simple"')), "elevator-type",
        "Simple has no gravity term. Does yours", SIMPLE),
    Mistake("a motor's class for the arm", ANSWERS,
        replace_text(('"ArmFeedforward"', '"SimpleMotorFeedforward"')), "arm-class",
        "Simple has no gravity term. Does yours", SIMPLE),
    Mistake("the elevator's type for the arm", ANSWERS,
        replace_text(('arm_type = "Arm"', 'arm_type = "elevator"')), "arm-type",
        "change with an angle"),
    Mistake("a class that there is not", ANSWERS,
        replace_text(('"ElevatorFeedforward"', '"LiftFeedforward"')), "elevator-class",
        "Choose one of: SimpleMotorFeedforward, ArmFeedforward, ElevatorFeedforward"),
    Mistake("a number for a word", ANSWERS, replace_text(('arm_type = "Arm"', "arm_type = 2")),
        "arm-type", "not a word"),
)  # fmt: skip
