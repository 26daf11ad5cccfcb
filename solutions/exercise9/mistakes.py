"""Wrong answers to exercise 9, and what a learner must be told about each."""

import math

from grader.mistake import Mistake, exchanged, number, replacing, scaled

ANSWERS = "answers.toml"
RAMP, PERIOD = 0.5, 0.02  # [V/s], [s] of the learner's log

MISTAKES = (
    Mistake("nothing for kV", ANSWERS, replacing(("kV = ", 'kV = "" # ')), "kv", "nothing yet"),
    Mistake(
        "radians for rotations",
        ANSWERS,
        scaled(1 / (2 * math.pi), "kV", "kA"),
        "kv",
        "about 6.28 times too small",
        "M-UNITS",
    ),
    Mistake(
        "radians for rotations, and kA knows it too",
        ANSWERS,
        scaled(2 * math.pi, "kV", "kA"),
        "ka",
        "about 6.28 times too large",
        "M-UNITS",
    ),
    Mistake(
        "velocity in rpm",
        ANSWERS,
        scaled(1 / 60, "kV", "kA"),
        "kv",
        "Is your velocity in rpm",
        "M-UNITS",
    ),
    Mistake(
        "kS and kV swapped",
        ANSWERS,
        exchanged("kS", "kV"),
        "kv",
        "swapped?",
        "M-ARGORDER",
    ),
    Mistake(
        "kS where the line through the slow ramp crosses zero",
        ANSWERS,
        number("kS", lambda right: right["kS"] + max(0.05, RAMP * right["kA"] / right["kV"])),
        "ks",
        "crosses v = 0",
        "M-KS-INTERCEPT",
    ),
    Mistake(
        "velocity turned around",
        ANSWERS,
        scaled(-1, "kS", "kV", "kA"),
        "kv",
        "the sign is not",
    ),
    Mistake(
        "an output between -1 and 1 for the voltage",
        ANSWERS,
        scaled(1 / 12, "kS", "kV", "kA"),
        "ks",
        "in place of volts",
        "M-DUTY",
    ),
    Mistake(
        "a difference of velocities for the acceleration",
        ANSWERS,
        scaled(1 / PERIOD, "kA"),
        "ka",
        "divide the change of velocity",
    ),
    Mistake(
        "a unit that measures something else",
        ANSWERS,
        replacing(("kV = ", 'kV = "2 V/m/s" # ')),
        "kv",
        "does not measure kV",
        "M-UNITS",
    ),
    Mistake("a list for a number", ANSWERS, replacing(("kA = ", "kA = [1, 2] # ")), "ka", "a list"),
    Mistake("not a number", ANSWERS, replacing(("kA = ", "kA = nan # ")), "ka", "nan"),
    Mistake("yes or no for a number", ANSWERS, replacing(("kS = ", "kS = true # ")), "ks", "true"),
    Mistake(
        "R² in percent",
        ANSWERS,
        scaled(100, "acceleration_r2", "simulated_velocity_r2"),
        "metrics",
        "not percent",
        "M-R2",
    ),
    Mistake(
        "a number from nowhere",
        ANSWERS,
        scaled(3.4, "kV"),
        "kv",
        "miss the voltage in the log",
    ),
)
