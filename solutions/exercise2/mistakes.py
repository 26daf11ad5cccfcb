"""Wrong answers to exercise 2, and what a learner must be told about each."""

import math
import re
from collections.abc import Callable

from grader.exercise.mistake import Mistake, change_number, make_wrong_answer, scale_numbers

ANSWERS = "answers.toml"


def read_ratio(right: str) -> float:
    """Measured over theory, as the right answers have it."""
    found = re.search(r"^difference = (\S+)", right, re.MULTILINE)
    return 1.0 + float(found[1] if found else "nan") / 100.0


def choose_wrong_verdict(text: str) -> str:
    """A verdict of another bucket: ok, or what a low kV is called."""
    return make_wrong_answer("verdict", '"ok"' if '"ok"' not in text else '"inspect"')(text)


def flag(text: str) -> str:
    """Another word about kS."""
    return make_wrong_answer("ks_flag", '"stop"' if '"stop"' not in text else '"fine"')(text)


def inspect_parts_first(text: str) -> str:
    """Causes in a wrong order: parts to open before numbers to check."""
    sound = 'verdict = "ok"' in text
    found = re.search(r'^inspection = .*?"(.+?)"', text, re.MULTILINE)
    first = found[1] if found else ""
    words = ("dragging-belt", "gear-ratio") if sound else ("velocity-unit", first, "motor-type")
    return write_causes(*words)(text)


def write_causes(*words: str) -> Callable[[str], str]:
    """An edit of an answer file that lists these causes for an inspection."""
    return make_wrong_answer("inspection", "[" + ", ".join(f'"{one}"' for one in words) + "]")


MISTAKES = (
    Mistake("nothing", ANSWERS, make_wrong_answer("kV_theory", '""'), "kv-theory", "nothing yet"),
    Mistake("divided by rpm", ANSWERS, scale_numbers(1 / 60, "kV_theory"), "kv-theory",
        "Did you divide by a speed per minute?", "M-UNITS"),
    Mistake("radians for rotations, or no way around the wheel", ANSWERS,
        scale_numbers(1 / (2 * math.pi), "kV_theory"), "kv-theory", "2π = 6.28", "M-UNITS"),
    Mistake("one volt for twelve", ANSWERS, scale_numbers(1 / 12, "kV_theory"), "kv-theory",
        "12 V is a full battery", "M-DUTY"),
    Mistake("the free speed itself", ANSWERS,
        change_number("kV_theory", lambda right: 12.0 / right["kV_theory"]), "kv-theory",
        "is this the free speed of your mechanism"),
    Mistake("speed for each volt", ANSWERS,
        change_number("kV_theory", lambda right: 1.0 / right["kV_theory"]), "kv-theory",
        "is this upside down"),
    Mistake("the measured kV", ANSWERS,
        lambda text: change_number(
            "kV_theory", lambda right: right["kV_theory"] * read_ratio(text)
        )(text), "kv-theory", "is this the measured kV? Compute the"),
    Mistake("a unit that measures something else", ANSWERS,
        make_wrong_answer("kV_theory", '"2 m/s"'), "kv-theory", "is not a unit of", "M-UNITS"),
    Mistake("a number from nowhere", ANSWERS, scale_numbers(1.37, "kV_theory"), "kv-theory",
        "outside the accepted ±2 %"),
    Mistake("a share", ANSWERS, scale_numbers(0.01, "difference"), "difference",
        "is this a fraction? Write percent, 100"),
    Mistake("above for below", ANSWERS, scale_numbers(-1, "difference"), "difference",
        "the sign is not"),
    Mistake("percent of theory", ANSWERS,
        change_number("difference", lambda right: right["difference"] + 100.0), "difference",
        "subtract 100 %"),
    Mistake("a difference from nowhere", ANSWERS,
        change_number("difference", lambda right: right["difference"] + 41.0), "difference",
        "outside the accepted ±1 %"),
    Mistake("a word that is none", ANSWERS, make_wrong_answer("verdict", '"great"'), "verdict",
        "Choose one of: bookkeeping, ok, watch, inspect"),
    Mistake("mass", ANSWERS, write_causes("gear-ratio", "logged-voltage", "mass"), "inspection",
        "does a heavier robot need more volts", "M-KV-MASS"),
    Mistake("friction that is kS's", ANSWERS, write_causes("gear-ratio", "constant-friction"),
        "inspection", "friction that needs the same voltage at"),
    Mistake("noise", ANSWERS, write_causes("sensor-noise", "gear-ratio", "logged-voltage"),
        "inspection", "noise goes to both sides; it does"),
    Mistake("wires before numbers", ANSWERS, inspect_parts_first, "inspection",
        "Check the easiest first"),
    Mistake("one cause only", ANSWERS, write_causes("motor-type"), "inspection",
        "name at least 2 causes"),
    Mistake("no list", ANSWERS, make_wrong_answer("inspection", "[]"), "inspection",
        "Choose from: constant-friction"),
    Mistake("a cause that there is not", ANSWERS, write_causes("gear-ratio", "gremlins"),
        "inspection", "not one of the choices"),
    Mistake("another verdict", ANSWERS, choose_wrong_verdict, "verdict", "difference"),
    Mistake("another flag", ANSWERS, flag, "ks-flag", "kV times the typical speed"),
)  # fmt: skip
