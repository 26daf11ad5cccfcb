"""A numeric answer: a value with a unit, bands for full and half credit, and what went wrong.

Feedback to a wrong number names the known mistake that would explain it, or how far off it is:
never the distance, and never the key.
"""

import re
from collections.abc import Mapping
from typing import Any

from grader.answers.asked_number import AskedNumber
from grader.answers.quantity import NotAUnitError, read_number, read_unit
from grader.answers.wrong_number import (
    MANY,
    AnswerKey,
    WrongNumber,
    explain_wrong_number,
)
from grader.checks.check import Check, WrongAnswer, make_check, shorten

LARGEST = 1e300  # beyond it a number is infinite, or soon will be
HALF = 0.5  # [share] of the points inside the wider band
LITTLE = 2.0  # [wider bands] a number that is off by more is far outside
ROUNDED = "Did you round too early?"
KA_ALONE = (
    "Your kV is right. kA comes from the first moments of a dynamic test: check that your fit uses "
    "all of them, and that no filter changes the velocity"
)
START_AGAIN = "Check the numbers you started from, and their units"
CALCULATION = re.compile(r"^[-+*/·^]+\s*[\d(]|[±√=]|\+|sqrt")  # in the rest of a number: no unit
NO_UNIT = "It has no unit, and it is not in percent: write the number alone."
UNIT_ASSUMED = " (no unit given, so I assumed "
OF_BOTH = {"M-GEARING"}  # slips that make kV and kA wrong, never kA alone


def read_answer_number(raw: object, asked: AskedNumber) -> float:
    """An answer as a number in the exercise's unit.

    Raises:
        WrongAnswer: it is not a number, or not of that unit; the message says what it is instead.
    """
    unit = f" (then it is in {asked.unit})" if asked.unit else ""
    ask = f"Write a number, such as {asked.name} = 0.5{unit}."
    if raw is None or raw == "":
        raise WrongAnswer("nothing yet", hint=ask)
    if isinstance(raw, bool):
        raise WrongAnswer(f"{str(raw).lower()}, which is not a number", hint=ask)
    if isinstance(raw, int | float):
        return _require_finite(raw, asked)
    if not isinstance(raw, str):
        kind = "list" if isinstance(raw, list) else type(raw).__name__
        raise WrongAnswer(f"a {kind}, not one number", hint=ask)
    found = read_number(raw)
    if found is None:
        raise WrongAnswer(f'"{shorten(raw)}", which is not one number', hint=ask)
    value, unit = found
    if CALCULATION.search(unit):
        raise WrongAnswer(
            f'"{shorten(raw)}", which is more than a number and its unit',
            hint="Write one number: no calculation, no range and no error.",
        )
    return _require_finite(value * _find_scale(unit, asked) if unit else value, asked)


def _require_finite(value: float, asked: AskedNumber) -> float:
    if not -LARGEST < value < LARGEST:
        raise WrongAnswer(
            f"{'nan' if value != value else 'infinity'}, which no gain can be",  # noqa: PLR0124 - only nan differs from itself
            hint=f"{asked.name} came out of a division by zero, or of an empty column. Look at "
            "the data you fitted.",
        )
    return float(value)


def _find_scale(unit: str, asked: AskedNumber) -> float:
    """The factor from the unit of the answer to the requested unit."""
    wanted = read_unit(asked.unit or "1")
    try:
        given = read_unit(unit)
    except NotAUnitError as part:
        raise WrongAnswer(
            f"the unit {unit!r}: {str(part)!r} is not known",
            hint=f"Write {asked.unit}, or leave the unit out." if asked.unit else NO_UNIT,
        ) from None
    if given.powers != wanted.powers:
        hint = f"Write it in {asked.unit}." if asked.unit else NO_UNIT
        if unit.count("/") > 1:
            hint += " Mind the parentheses: V/(m/s) is V·s/m, V/m/s is not."
        raise WrongAnswer(
            f"the unit {unit!r}, which is not a unit of {asked.name} here",
            hint=hint,
            misconception="M-UNITS",
        )
    return given.factor / wanted.factor


def read_wrong_numbers(
    given: Mapping[str, object], asked: Mapping[str, AskedNumber]
) -> dict[str, float] | None:
    """The numbers of an answer, if all of them are there, and not all of them right."""
    try:
        values = {name: read_answer_number(given.get(name), one) for name, one in asked.items()}
    except WrongAnswer:
        return None
    return None if all(one.is_right(values[name]) for name, one in asked.items()) else values


def judge_number(
    name: str, given: Mapping[str, object], key: AnswerKey, *, points: float
) -> str | None:
    """Judge one of the numbers.

    Args:
        name: which one.
        given: all the answers, by name, as they were read from the file.
        key: the right numbers.
        points: what the check is worth, for half credit.

    Returns:
        A note, if the answer was converted from another unit.

    Raises:
        WrongAnswer: it is not right; with what it may have been.
    """
    asked, raw = key.asked[name], given.get(name)
    value = read_answer_number(raw, asked)
    shown = f"{value:.4g} {asked.unit}"
    converted = isinstance(raw, str) and bool((read_number(raw) or (0, ""))[1])
    if asked.is_right(value):
        return f"{raw} is {shown}" if converted and f"{value:.4g}" not in str(raw) else None
    full, partial = asked.band.widths(asked.expected)
    away = abs(value - asked.expected)
    near = asked.describe_tolerance(full, asked.band.full)
    far = "far " if away > LITTLE * partial else ""
    by_hand = not key.scene.computed
    earned, verdict = 0.0, f"{far}outside the accepted {near}"
    if away <= partial:
        wider = asked.describe_tolerance(partial, asked.band.partial)
        earned = HALF * points
        verdict = f"close: within {wider}, not yet within {near}"
    slips = diagnose_number(name, given, key)
    codes = {slip.misconception for slip in slips}
    said = _describe_wrong_number(name, value, slips)
    if by_hand and not said:
        again = ROUNDED if earned else START_AGAIN
        verdict += f". {KA_ALONE if is_ka_alone(name, given, key) else again}"
    assumed = f"{UNIT_ASSUMED}{asked.unit})" if asked.unit and not converted else ""
    raise WrongAnswer(
        f"{shown}{assumed}",
        hint="; ".join(part for part in (said, "" if said and not earned else verdict) if part),
        misconception=codes.pop() if len(codes) == 1 else "",
        earned=earned,
    )


def make_number_check(name: str, description: str, *, points: float) -> Check[Any]:
    """Make a check of one number, of answers that have a ``key``.

    Args:
        name: the number's name; in lower case it names the check.
        description: the line that the learner reads.
        points: for full marks.
    """

    def judge(answers: Any) -> str | None:  # noqa: ANN401 - each exercise has its own
        return judge_number(name, answers.given, answers.key, points=points)

    return make_check(name, description, judge, points=points)


def diagnose_number(
    name: str, given: Mapping[str, object], key: AnswerKey
) -> tuple[WrongNumber, ...]:
    """The mistakes that would explain a wrong number; those that another number shares alone."""
    found = _find_wrong_numbers(name, given, key)
    if is_ka_alone(name, given, key):
        found = tuple(slip for slip in found if slip.misconception not in OF_BOTH)
    for other in key.asked:
        if other != name and other in given:
            shared = {slip.code for slip in _find_wrong_numbers(other, given, key)}
            found = tuple(slip for slip in found if slip.code in shared) or found
    return found if len(found) <= MANY else ()


def is_ka_alone(name: str, given: Mapping[str, object], key: AnswerKey) -> bool:
    """Whether this is the kA of a fit, and kV of the same fit is right."""
    kv = _read_value("kV", given, key) if "kV" in key.asked else None
    return name == "kA" and kv is not None and key.asked["kV"].is_right(kv)


def _find_wrong_numbers(
    name: str, given: Mapping[str, object], key: AnswerKey
) -> tuple[WrongNumber, ...]:
    value = _read_value(name, given, key)
    asked = key.asked[name]
    if value is None or asked.is_right(value):
        return ()
    found = explain_wrong_number(name, value, key)
    for other, one in key.asked.items():
        theirs = _read_value(other, given, key)
        if other == name or theirs is None or one.is_right(theirs):  # theirs stands where it should
            continue
        if one.is_right(value) and asked.is_right(theirs):
            says = f"it would be right for {other}, and your {other} for {name}: did you swap them?"
            found += (WrongNumber("swapped", says),)
    return found


def _read_value(name: str, given: Mapping[str, object], key: AnswerKey) -> float | None:
    try:
        return read_answer_number(given.get(name), key.asked[name])
    except WrongAnswer:
        return None


def _describe_wrong_number(name: str, value: float, slips: tuple[WrongNumber, ...]) -> str:
    if slips:
        return (
            "; or ".join(slip.says for slip in slips)
            .replace("?; or about", "? Or it is about")
            .replace("?; or ", "? Or: ")
        )
    if value < 0:
        return (
            f"{name} cannot be negative. Check the signs in your calculation. If every gain of a "
            "fit is negative, velocity or voltage has the wrong sign in the log"
        )
    return ""
