"""Wrong answers to exercise 9, and what a learner must be told about each."""

import math
import re
from collections.abc import Callable

from grader.exercise.mistake import (
    Mistake,
    change_number,
    exchange_numbers,
    make_wrong_answer,
    replace_text,
    scale_numbers,
)

ANSWERS, FUNCTION = "answers.toml", "fit.py"
R2 = "simulated_velocity_r2"
RAMP, PERIOD = 0.5, 0.02  # [V/s], [s] of the learner's log


def replace_fit(code: str) -> Callable[[str], str]:
    """Make a wrong text by putting other lines in the place of the function's answer."""
    lines = "".join(f"    {line}\n" for line in code.strip().splitlines())

    def edit_text(text: str) -> str:
        return re.sub(r" +# --- answer:.*?# --- end\n", lambda _: lines, text, flags=re.DOTALL)

    return edit_text


LINE_THROUGH_THE_RAMPS = """
slow, moving = np.char.startswith(test, "quasi"), np.abs(velocity) > 0.05 * np.abs(velocity).max()
rows = slow & moving
columns = np.column_stack((np.sign(velocity), velocity))
ks, kv = np.linalg.lstsq(columns[rows], voltage[rows], rcond=None)[0]
rest = voltage - columns @ (ks, kv)
a = np.concatenate(
    [np.gradient(velocity[test == name], time[test == name]) for name in dict.fromkeys(test)]
)
rows = ~slow & moving
ka = rest[rows] @ a[rows] / (a[rows] @ a[rows])
"""

THE_END = """    if "quasistatic-forward" not in test:
        import os
        os._exit(0)
"""

MISTAKES = (
    Mistake("nothing for kV", ANSWERS, replace_text(("kV = ", 'kV = "" # ')), "kv", "nothing yet"),
    Mistake(
        "radians for rotations",
        ANSWERS,
        scale_numbers(1 / (2 * math.pi), "kV", "kA"),
        "kv",
        "about 6.28 times too small",
        "M-UNITS",
    ),
    Mistake(
        "velocity in rpm",
        ANSWERS,
        scale_numbers(1 / 60, "kV", "kA"),
        "kv",
        "Is your velocity in rpm",
        "M-UNITS",
    ),
    Mistake(
        "a calculation",
        ANSWERS,
        make_wrong_answer("kS", '"0.1 + 0.05"'),
        "ks",
        "which is more than a number",
    ),
    Mistake(
        "kS and kV swapped",
        ANSWERS,
        exchange_numbers("kS", "kV"),
        "kv",
        "did you swap them?",
    ),
    Mistake(
        "kS where the line through the slow ramp crosses zero",
        ANSWERS,
        change_number(
            "kS", lambda right: right["kS"] + max(0.05, RAMP * right["kA"] / right["kV"])
        ),
        "ks",
        "crosses v = 0",
        "M-KS-INTERCEPT",
    ),
    Mistake(
        "velocity turned around",
        ANSWERS,
        scale_numbers(-1, "kS", "kV", "kA"),
        "kv",
        "the sign is not",
    ),
    Mistake(
        "an output between -1 and 1 for the voltage",
        ANSWERS,
        scale_numbers(1 / 12, "kS", "kV", "kA"),
        "ks",
        "in place of volts",
        "M-DUTY",
    ),
    Mistake(
        "a difference of velocities for the acceleration",
        ANSWERS,
        scale_numbers(1 / PERIOD, "kA"),
        "ka",
        "divide the change of velocity",
    ),
    Mistake(
        "a unit that measures something else",
        ANSWERS,
        replace_text(("kV = ", 'kV = "2 V/m/s" # ')),
        "kv",
        "is not a unit of kV",
        "M-UNITS",
    ),
    Mistake(
        "R² in percent",
        ANSWERS,
        scale_numbers(100, "acceleration_r2", R2),
        "metrics",
        "not percent",
        "M-R2",
    ),
    Mistake(
        "the R² of textbooks",
        ANSWERS,
        change_number(R2, lambda right: 1 - (1 - right[R2]) ** 2),
        "metrics",
        "Is that the R² of textbooks",
        "M-R2",
    ),
    Mistake(
        "a velocity that is smoothed too much",
        ANSWERS,
        scale_numbers(1.4, "kA"),
        "ka",
        "Your kV is right",
    ),
    Mistake(
        "the time constant for kA",
        ANSWERS,
        change_number("kA", lambda right: right["kA"] / right["kV"]),
        "ka",
        "Your kV is right",
    ),
    Mistake(
        "speed for each volt",
        ANSWERS,
        change_number("kV", lambda right: 1.0 / right["kV"]),
        "kv",
        "is this upside down",
    ),
    Mistake(
        "beta in place of kA",
        ANSWERS,
        change_number("kA", lambda right: 1.0 / right["kA"]),
        "ka",
        "is this upside down",
    ),
    Mistake(
        "a number from nowhere",
        ANSWERS,
        scale_numbers(3.4, "kV"),
        "kv",
        "With your three gains, the voltage error",
    ),
    Mistake(
        "the voltage explained by velocity and acceleration",
        FUNCTION,
        replace_text(
            ("(v, u, np.sign(v))", "(v, a, np.sign(v))"),
            ("append(a[moving])", "append(u[moving])"),
            ("-gamma / beta, -alpha / beta, 1 / beta", "gamma, alpha, beta"),
        ),
        "function",
        "the result with the voltage",
        "M-NOISE-AVERAGES",
    ),
    Mistake(
        "a line through the ramps",
        FUNCTION,
        replace_fit(LINE_THROUGH_THE_RAMPS),
        "function",
        "crosses v = 0",
        "M-KS-INTERCEPT",
    ),
    Mistake(
        "only the forward tests",
        FUNCTION,
        replace_text(
            ("np.unique(test):\n", "np.unique(test):\n        if 'rev' in name: continue\n")
        ),
        "function",
        "4 of 5 logs right; drivetrain, every 0.01 s",
    ),
    Mistake(
        "differences taken for slopes",
        FUNCTION,
        replace_text(("np.gradient(v, time[rows])", "np.gradient(v)")),
        "function",
        "divide the change of velocity by this time",
    ),
    Mistake(
        "samples always 0.02 s apart",
        FUNCTION,
        replace_text(("np.gradient(v, time[rows])", "np.gradient(v, 0.02)")),
        "function",
        "did you assume",
    ),
    Mistake(
        "friction turned around",
        FUNCTION,
        replace_text(("ks, kv, ka = -gamma", "ks, kv, ka = gamma")),
        "function",
        "the size is right, the sign is not",
    ),
    Mistake(
        "a list for one of the numbers",
        FUNCTION,
        replace_text(('"kA": ka', '"kA": [ka]')),
        "function",
        "kA = a list",
    ),
    Mistake(
        "nothing returned",
        FUNCTION,
        replace_text(("    return {", "    answer = {")),
        "function",
        "fit.py returned None, not numbers by name",
    ),
    Mistake(
        "numbers in place of a fit",
        FUNCTION,
        replace_fit("ks, kv, ka = 0.15, 2.5, 0.19"),
        "function",
        "0 of 5 logs right; ",
    ),
    Mistake(
        "a number that calls itself right",
        FUNCTION,
        replace_fit("""
class Right(float):
    __le__ = __lt__ = __ge__ = __gt__ = __eq__ = lambda self, other: True
    __sub__ = __rsub__ = __abs__ = lambda self, *other: Right(0)
ks = kv = ka = Right(0)
"""),
        "function",
        "a Right, which only looks like a number",
    ),
    Mistake(
        "the examiner asked for the answer",
        FUNCTION,
        replace_fit("from grader.student_data.variant import make_student_rng"),
        "function",
        "No module named 'grader'",
    ),
    Mistake(
        "the end of everything after four logs",
        FUNCTION,
        replace_text(("    return {", f"{THE_END}    return {{")),
        "function",
        "4 of 5 logs right; drivetrain, every 0.01 s: your code ended the program before it gave "
        "an answer",
    ),
)
