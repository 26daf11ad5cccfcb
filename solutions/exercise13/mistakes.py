"""Wrong answers to exercise 13, and what a learner must be told about each."""

import math

from grader.exercise.mistake import (
    Mistake,
    Numbers,
    change_number,
    exchange_numbers,
    make_wrong_answer,
    scale_numbers,
)

ANSWERS = "answers.toml"
MODULES = ("front-left", "front-right", "back-left", "back-right")


def name_another_module(text: str) -> str:
    """The module after the right one."""
    right = next(name for name in MODULES if f'worn = "{name}"' in text)
    return make_wrong_answer("worn", f'"{MODULES[MODULES.index(right) - 1]}"')(text)


def find_sound_radius(right: Numbers) -> float:
    """The radius [m] of the three sound wheels: the next size above the worn one."""
    return min(radius for radius in (0.0476, 0.0508) if radius > right["worn_radius"])


MISTAKES = (
    Mistake("velocity per minute", ANSWERS, scale_numbers(1 / 60, "kV", "kA"), "kv",
        "one minute has 60 seconds", "M-UNITS"),
    Mistake("the motor's own velocity", ANSWERS,
        change_number("kS", lambda right: right["kS"] / 12.0), "ks", "12 V is a full battery",
        "M-DUTY"),
    Mistake("kS and kV swapped", ANSWERS, exchange_numbers("kS", "kV"), "kv", "did you swap them?"),
    Mistake("another module", ANSWERS, name_another_module, "worn",
        "turns more often over the same"),
    Mistake("a module there is not", ANSWERS, make_wrong_answer("worn", '"middle"'), "worn",
        "not one of the choices"),
    Mistake("a diameter", ANSWERS, scale_numbers(2.0, "worn_radius"), "worn-radius", "a diameter",
        "M-GEARING"),
    Mistake("the gyro's degrees", ANSWERS, scale_numbers(180.0 / math.pi, "worn_radius"),
        "worn-radius", "as the gyro counts", "M-UNITS"),
    Mistake("the lever of a tank", ANSWERS, scale_numbers(1.0 / math.sqrt(2.0), "lever"), "lever",
        "That is the lever of a tank drive", "M-LEVER"),
    Mistake("the trackwidth for the lever", ANSWERS, scale_numbers(math.sqrt(2.0), "lever"),
        "lever", "is this the trackwidth", "M-LEVER"),
    Mistake("a rate called volts", ANSWERS, make_wrong_answer("rate_unit", '"volts"'), "rate-unit",
        "SysId knows only volts", "M-UNITS"),
    Mistake("a rate in degrees", ANSWERS, make_wrong_answer("rate_unit", '"degrees-per-second"'),
        "rate-unit", "compare it with the gyro", "M-UNITS"),
    Mistake("kA per degree", ANSWERS, scale_numbers(math.pi / 180.0, "kA_turning"), "ka-turning",
        "as the gyro logs", "M-UNITS"),
    Mistake("the moment of inertia with a tank's lever", ANSWERS,
        scale_numbers(1.0 / math.sqrt(2.0), "inertia"), "inertia",
        "That is the lever of a tank drive", "M-LEVER"),
    Mistake("the quotient upside down", ANSWERS,
        change_number(
            "inertia",
            lambda right: right["inertia"] * (right["kA"] / right["kA_turning"]) ** 2,
        ), "inertia", "upside down"),
    Mistake("a unit that measures something else", ANSWERS,
        make_wrong_answer("inertia", '"5 kg·m"'), "inertia", "is not a unit of", "M-UNITS"),
    Mistake("four motors at once", ANSWERS, scale_numbers(4.0, "slip_current"), "slip-current",
        "for all four motors together"),
    Mistake("turning for going", ANSWERS,
        change_number("top_speed", lambda right: right["top_speed"] / right["lever"]), "top-speed",
        "is this a rate of turning?", "M-UNITS"),
    Mistake("a radius in millimeters", ANSWERS, scale_numbers(1000.0, "worn_radius"), "worn-radius",
        "1 m is 1000 mm", "M-UNITS"),
    Mistake("the trackwidth in the spin", ANSWERS, scale_numbers(math.sqrt(2.0), "worn_radius"),
        "worn-radius", "the trackwidth for the lever?", "M-LEVER"),
    Mistake("speed for each volt", ANSWERS, change_number("kV", lambda right: 1.0 / right["kV"]),
        "kv", "is this upside down"),
    Mistake("a quarter of a motor's current", ANSWERS, scale_numbers(0.25, "slip_current"),
        "slip-current", "did you divide by four?"),
    Mistake("the current after the slip", ANSWERS, scale_numbers(0.9, "slip_current"),
        "slip-current", "the current just after the slip begins?"),
    Mistake("a speed in km/h", ANSWERS, scale_numbers(3.6, "top_speed"), "top-speed",
        "Is this in km/h?", "M-UNITS"),
    Mistake("12 V times kV", ANSWERS, change_number("top_speed", lambda right: 12 * right["kV"]),
        "top-speed", "divide by it"),
    Mistake("a torque from a wrong current", ANSWERS,
        scale_numbers(1.31, "slip_current", "max_torque"), "max-torque",
        "it fits your slip_current"),
    Mistake("the lever twice", ANSWERS,
        change_number("inertia", lambda right: right["inertia"] * right["lever"]), "inertia",
        "by the lever twice?", "M-LEVER"),
    Mistake("the ratio of turns upside down", ANSWERS,
        change_number(
            "worn_radius", lambda right: find_sound_radius(right) ** 2 / right["worn_radius"]
        ),
        "worn-radius", "ratio of turns upside down"),
    Mistake("kV typed for kA", ANSWERS, change_number("kA", lambda right: right["kV"]), "ka",
        "is this the kV of the same fit"),
)  # fmt: skip
