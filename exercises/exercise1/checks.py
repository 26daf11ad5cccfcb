"""Exercise 1: where the volts go, at four moments of a mechanism of the learner's own."""

import math
import re
from functools import partial

from grader.answers.number_answer import read_answer_number
from grader.answers.quantity import NotAUnitError, read_unit
from grader.answers.submission import StudentAnswers
from grader.checks.check import WrongAnswer, check, make_check
from grader.checks.consequence import Consequence
from grader.student_data.student_files import Made

from .budget import MOMENTS, Variant
from .drawn import draw
from .outcome import find_outcome
from .slips import find_suspects

FILES = ("answers.toml",)
ANSWER_NAMES = (*MOMENTS, "kV_unit", "largest")

BATTERY = 13.5  # [V] of a battery that was just charged
LITTLE = 0.10  # [share] up to here a voltage is outside by a little
WORDS = {
    "ks": "kS",
    "kv": "kV",
    "ka": "kA",
    "friction": "kS",
    "velocity": "kV",
    "speed": "kV",
    "acceleration": "kA",
}


def make_files(student: str) -> dict[str, Made]:
    """The learner's numbers."""
    return {"given.toml": _describe(draw(student))}


def _describe(variant: Variant) -> str:
    """The learner's numbers, with their units in words; the signs are left to the learner."""
    unit, gains = variant.symbol, variant.gains
    lines = [
        "# Exercise 1: your own mechanism. Only read here; your answers go into answers.toml.",
        "",
        f'mechanism = "{variant.kind}"',
        f'velocity_unit = "{unit}/s"  # of the velocity that kV is made for',
        f"kS = {gains['kS']:g}  # volts",
        f"kV = {gains['kV']:g}  # volts for a velocity of 1 {unit}/s",
        f"kA = {gains['kA']:g}  # volts for an acceleration of 1 {unit}/s every second",
        "",
        f'largest_at = "{variant.largest_at}"  # at which moment to look for the largest term',
    ]
    for name, at in variant.moments.items():
        speed = f"speed = {abs(at.shown):g}  # {at.shown_unit}"
        lines += ["", f"[{name}]  # {MOMENTS[name]}", speed]
        if at.acceleration:
            way = "faster_by" if at.acceleration > 0 else "slower_by"
            lines.append(f"{way} = {abs(at.acceleration):g}  # {unit}/s, every second")
    return "\n".join(lines) + "\n"


def consequence(answers: StudentAnswers) -> Consequence | None:
    """The motion that the learner's volts would cause."""
    return find_outcome(answers.given, answers.variant)


def _judge_voltage(name: str, answers: StudentAnswers) -> None:
    asked = answers.variant.asked(name)
    value = read_answer_number(answers.given.get(name), asked)
    if asked.is_right(value):
        return
    found = find_suspects(value, answers.variant, name)
    codes = {slip.misconception for slips in found for slip in slips}
    hint = "; or ".join("; and ".join(slip.says for slip in slips) for slips in found)
    hint = hint.replace("?; ", "? ")
    if found and len(found[0]) > 1:
        hint = f"maybe there are two mistakes: {hint}"
    if not hint:
        far = "" if abs(value - asked.expected) <= LITTLE * abs(asked.expected) else "far "
        hint = f"{far}outside the accepted ±2 %. Write down the three terms one by one"
    if abs(value) > BATTERY:
        hint = f"no battery of a robot has more than {BATTERY:g} V: {hint}"
    raise WrongAnswer(
        f"{value:.4g} V", hint=hint, misconception=codes.pop() if len(codes) == 1 else ""
    )


voltages = tuple(
    make_check(name, description, partial(_judge_voltage, name), points=2)
    for name, description in (
        ("forward", "The voltage at a steady speed forward."),
        ("accelerating", "The voltage while it speeds up."),
        ("braking", "The voltage while it brakes, and still moves forward."),
        ("backward", "The voltage at a steady speed backward."),
    )
)


@check(points=2)
def kv_unit(answers: StudentAnswers) -> None:
    """The unit of kV."""
    raw, symbol = answers.given.get("kv_unit"), answers.variant.symbol
    letters = (
        f"Write the unit with V, s and {symbol}. Use · or * for times, / for per, and parentheses."
    )
    if not isinstance(raw, str) or not raw.strip():
        empty = raw is None or isinstance(raw, str)
        seen = "nothing yet" if empty else f"{raw}, which is not a unit"
        raise WrongAnswer(seen, hint=letters)
    try:
        given = read_unit(raw)
    except NotAUnitError as part:
        raise WrongAnswer(f"{raw!r}: {str(part)!r} is not known", hint=letters) from None
    right = read_unit(f"V*s/{symbol}")
    if given.powers == right.powers and math.isclose(given.factor, right.factor):
        return
    volts, length, rest = given.powers[:2], given.powers[2:4], given.powers[4:]
    if volts == right.powers[:2] and sum(length) == -1 and max(length) == 0 and not any(rest):
        hint = f"this is the right kind of unit, but your velocities are in {symbol}/s"
        raise WrongAnswer(raw, hint=hint, misconception="M-UNITS", earned=1.0)
    raise WrongAnswer(raw, hint=_explain_unit(given.powers), misconception="M-UNITS")


def _explain_unit(given: tuple[int, ...]) -> str:
    volt, second, *length = given
    if any(given[4:]):
        return "multiply your unit by that of your velocity: the result must be volts"
    if (volt, second, sum(length)) == (-1, -1, 1):
        return "this is velocity for each volt. kV is the reverse: volts for each unit of velocity"
    if (volt, second) == (1, 2) and sum(length) == -1:
        return "that belongs to kA, which is multiplied by an acceleration"
    if (volt, second) == (1, -1) and sum(length) == -1:
        return "mind the parentheses: dividing by (a/b) is not the same as dividing by a, then by b"
    if (volt, second) == (1, 0) and not any(length):
        return "that belongs to kS, which is multiplied by sgn(v), and sgn(v) has no unit"
    return "multiply your unit by that of your velocity: the result must be volts"


@check(points=2)
def largest(answers: StudentAnswers) -> None:
    """The largest term at the moment that largest_at names."""
    raw, variant = answers.given.get("largest"), answers.variant
    listed = "Choose one of: kS, kV, kA."
    if raw is None or raw == "":
        raise WrongAnswer("nothing yet", hint=listed)
    text = re.sub(r"[\s·⋅*()]", "", str(raw)).lower()
    word = WORDS.get(re.sub(r"^(ks|kv|ka)(sgnv|v|a)$", r"\1", text))
    if word is None:
        raise WrongAnswer(f'"{raw}", which is not one of the terms', hint=listed)
    if word == variant.largest:
        return
    hint = f"compute all three terms at {variant.largest_at}, in volts, and compare their sizes"
    if variant.gains[word] == max(variant.gains.values()):
        hint = f"{word} is the largest gain, but a gain is not a voltage yet. So {hint}"
    elif variant.largest == "kA" and variant.largest_at == "braking":
        hint = f"a negative term may be large, too. So {hint}"
    raise WrongAnswer(f"{word}, at {variant.largest_at}", hint=hint)
