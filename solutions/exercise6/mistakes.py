"""Wrong answers to exercise 6, and what a learner must be told about each."""

import re
from collections.abc import Callable

from grader.exercise.mistake import (
    Mistake,
    change_number,
    exchange_numbers,
    make_wrong_answer,
    scale_numbers,
)

ANSWERS = "answers.toml"
BIG, SLOW = "M-BIG-STEP", "M-SLOW-SAFE"


def set_values(**values: str) -> Callable[[str], str]:
    """Give several lines other values, as TOML."""

    def edit_text(text: str) -> str:
        for name, value in values.items():
            text = make_wrong_answer(name, value)(text)
        return text

    return edit_text


def turn_around(item: str) -> Callable[[str], str]:
    """Decide the other way about one thing of the morning."""
    other = {"go": "no-go", "no-go": "go"}

    def edit_text(text: str) -> str:
        found = re.search(rf'^check_{item} = "(.*)"$', text, re.MULTILINE)
        if found is None:
            raise ValueError(f"the solution decides nothing about {item}")
        return make_wrong_answer(f"check_{item}", f'"{other[found[1]]}"')(text)

    return edit_text


MORNING = ("travel", "battery", "encoder", "log", "guard", "driver_station")

MISTAKES = (
    Mistake("nothing for the ramp", ANSWERS, make_wrong_answer("drivetrain_ramp", '""'),
        "drivetrain", "drivetrain_ramp: nothing yet"),
    Mistake("a slow ramp, to be safe", ANSWERS,
        set_values(drivetrain_ramp="0.1", drivetrain_timeout="10"), "drivetrain",
        "To reach that, your ramp needs", SLOW),
    Mistake("the numbers of a lesson, and no thumb", ANSWERS,
        set_values(turret_ramp="0.5", turret_timeout="10", turret_release='"timeout"'), "turret",
        "It hits the end at"),
    Mistake("a mark in degrees", ANSWERS, scale_numbers(360.0, "turret_release"), "turret",
        "Is your number in degrees?", "M-UNITS"),
    Mistake("a step that burns rubber", ANSWERS, make_wrong_answer("drivetrain_step", "11"),
        "drivetrain", "The wheels spin, and the encoder counts", BIG),
    Mistake("a step beyond the current limit", ANSWERS, make_wrong_answer("shooter_step", "9"),
        "shooter", "at standstill your step draws", BIG),
    Mistake("a step that drowns in noise", ANSWERS, make_wrong_answer("turret_step", "0.5"),
        "turret", "times. Use a larger step"),
    Mistake("a step that gravity eats", ANSWERS, make_wrong_answer("elevator_step", "0.3"),
        "elevator", "does not move it"),
    Mistake("a timeout that ends it too soon", ANSWERS, make_wrong_answer("shooter_timeout", "2"),
        "shooter", "s until the timeout; at least 3 s"),
    Mistake("a steep ramp to the same mark", ANSWERS, scale_numbers(3.0, "elevator_ramp"),
        "elevator", "s until your mark; at least 3 s"),
    Mistake("a mark too far away", ANSWERS,
        lambda text: make_wrong_answer("elevator_timeout", "10")(
            scale_numbers(4.0, "elevator_release")(text)
        ), "elevator", "m; you have"),
    Mistake("ramp and step swapped", ANSWERS,
        exchange_numbers("drivetrain_ramp", "drivetrain_step"), "drivetrain", "did you swap them?"),
    Mistake("a timeout without kG", ANSWERS,
        change_number("elevator_timeout", lambda right: right["elevator_timeout"] - 1.5),
        "elevator", "below kS + kG"),
    Mistake("a timeout that saves nobody", ANSWERS, make_wrong_answer("shooter_timeout", "30"),
        "shooter", "no test may be longer"),
    Mistake("more volts than there are", ANSWERS, set_values(shooter_ramp="5", shooter_timeout="9"),
        "shooter", "the battery has 12 V"),
    Mistake("a step turned around", ANSWERS, scale_numbers(-1.0, "turret_step"), "turret",
        "Choose a number above 0"),
    Mistake("a speed for a mark", ANSWERS, make_wrong_answer("drivetrain_release", '"3 m/s"'),
        "drivetrain", "is not a unit of", "M-UNITS"),
    Mistake("a mark that is none", ANSWERS, make_wrong_answer("elevator_release", '"at the top"'),
        "elevator", "if nobody lets go before it"),
    Mistake("everything is a go", ANSWERS,
        set_values(**dict.fromkeys((f"check_{item}" for item in MORNING), '"go"')), "checklist",
        "Read that line of your morning once more"),
    Mistake("nothing is a go", ANSWERS,
        set_values(**dict.fromkeys((f"check_{item}" for item in MORNING), '"no-go"')), "checklist",
        "Read that line of your morning once more"),
    Mistake("room without a look at brake or coast", ANSWERS, turn_around("travel"), "checklist",
        "In coast mode the robot rolls on"),
    Mistake("a decision not on the list", ANSWERS, make_wrong_answer("check_guard", '"perhaps"'),
        "checklist", "Choose one of: go, no-go"),
    Mistake("gains before they are looked at", ANSWERS,
        make_wrong_answer(
            "steps", '["wire-routine", "run-tests", "place-gains", "inspect-and-fit"]'
        ), "steps", "place-gains comes too early"),
    Mistake("three steps", ANSWERS,
        make_wrong_answer("steps", '["wire-routine", "run-tests", "place-gains"]'), "steps",
        "each of the four once"),
    Mistake("where the program lies", ANSWERS,
        make_wrong_answer("log_2026", '"/home/lvuser/deploy"'), "log-2026",
        "your program is there, but not its"),
    Mistake("last year's controller", ANSWERS, make_wrong_answer("log_2027", '"/home/lvuser/logs"'),
        "log-2027", "a Systemcore has another user name than"),
    Mistake("every limit bypassed", ANSWERS, set_values(limit_a='"bypassed"', limit_b='"bypassed"'),
        "limits", "where is this limit set? Does that", "M-LIMITS-BYPASSED"),
    Mistake("in the pit", ANSWERS, make_wrong_answer("schedule", '"first-regional"'), "schedule",
        "there may be only eight minutes between matches, and"),
)  # fmt: skip
