"""What a feedforward is handed: which gain stands in which place."""

import re

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.gain_constants import Argument, DeployFacts, Feedforward

from .key import Variant, near


def feedforward_of(facts: DeployFacts, variant: Variant) -> Feedforward:
    """The feedforward in question: one of the right class before others.

    Raises:
        WrongAnswer: none is made.
        NotReachedError: there is nothing at all yet.
    """
    if not facts.feedforwards and not facts.constants:
        raise NotReachedError("checked after you write the gains")
    if not facts.feedforwards:
        raise WrongAnswer(
            "no feedforward is made",
            hint="Make one of WPILib's three, and pass your constants to it.",
        )
    right = [one for one in facts.feedforwards if one.kind == variant.made]
    return (right or [*facts.feedforwards])[0]


def check_order(one: Feedforward, facts: DeployFacts, variant: Variant, *, points: float) -> None:
    """Whether each gain stands in its place.

    Raises:
        WrongAnswer: one does not, or is left out, or cannot be told.
    """
    places = _places(one)
    found = {place: _gain(arg, facts, variant) for place, arg in one.arguments.items()}
    at = f"{re.sub(r'[A-Za-z_.]+[.](?=k)', '', one.text)} in line {one.line}"
    for place, gain in found.items():
        if gain and gain != place:
            raise WrongAnswer(
                at,
                hint=f"{gain} is where {one.kind} expects {place}. Check the order of its "
                "arguments.",
                misconception="M-ARGORDER",
            )
    for place, gain in found.items():
        if not gain:
            raise WrongAnswer(
                f"the grader cannot see which gain {one.arguments[place].text} is, "
                f"in line {one.line}",
                hint="Pass the constants by their names.",
            )
    if one.spread:
        hint = "Write the arguments one by one."
        raise WrongAnswer(f"the grader cannot see by reading which gains {at} gets", hint=hint)
    lacking = [place for place in places if place not in found]
    if lacking:
        raise WrongAnswer(
            f"{at} has no {' and no '.join(lacking)}",
            hint="A missing argument counts as 0.",
            earned=points / 2 if lacking == ["kA"] else 0.0,
        )


def _places(one: Feedforward) -> tuple[str, ...]:
    simple = one.kind == "SimpleMotorFeedforward"
    return ("kS", "kV", "kA") if simple else ("kS", "kG", "kV", "kA")


def _gain(arg: Argument, facts: DeployFacts, variant: Variant) -> str:
    """The gain an argument is, by its name or else by its number."""
    if arg.gain or arg.value is None:
        return arg.gain
    for one in facts.constants:
        if one.value == arg.value:
            return one.gain
    for gain in variant.gains:
        if near(arg.value, variant.shown[gain]) or near(arg.value, variant.needed(gain)):
            return gain
    return ""
