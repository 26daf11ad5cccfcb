"""What a feedforward is handed: which gain stands in which place."""

import re

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.gain_constants import Argument, DeployFacts, Feedforward

from .key import FEED_FORWARD, PLACES, SLOT0, Variant, near


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
            hint="Make one of WPILib's three, and pass your constants to it. Or put them into the "
            f"motor controller: {SLOT0} (Phoenix 6) or {FEED_FORWARD} (REVLib).",
        )
    right = [one for one in facts.feedforwards if one.kind in {variant.made, *PLACES}]
    return (right or [*facts.feedforwards])[0]


def place_of(facts: DeployFacts) -> str:
    """The class of the motor controller that holds the gains; empty if WPILib's class does."""
    kinds = [one.kind for one in facts.feedforwards]
    inside = [kind for kind in kinds if kind in PLACES]
    return inside[0] if inside and len(inside) == len(kinds) else ""


def check_one_place(facts: DeployFacts) -> None:
    """Whether each gain works in one place: volts of the roboRIO and of a motor controller add up.

    Phoenix 6 and REVLib add what the code sends as a feedforward to what their own gains make of
    the target. A slot that holds kP alone is no second feedforward.

    Raises:
        WrongAnswer: a gain is in both places.
    """
    code = [one for one in facts.feedforwards if one.kind not in PLACES]
    inside = [one for one in facts.feedforwards if one.kind in PLACES]
    for one in code:
        for other in inside:
            held = {
                GRAVITY.get(name, name) for name, arg in other.arguments.items() if arg.value != 0
            }
            twice = [gain for gain in one.arguments if gain in held]
            if twice:
                raise WrongAnswer(
                    f"{', '.join(twice)} twice: in {one.kind}, line {one.line}, and in "
                    f"{other.kind}, line {other.line}",
                    hint="This is a double feedforward: the motor controller adds its own volts to "
                    "those that your code sends. Choose one place.",
                )


def check_choices(one: Feedforward, variant: Variant) -> None:
    """Whether gravity and the sign of kS are set for this mechanism in its motor controller.

    Raises:
        WrongAnswer: one is not.
    """
    arm = variant.analysis == "Arm"
    if one.kind == FEED_FORWARD:
        _check_spark(one, arm=arm, variant=variant)
        return
    ratio = one.arguments.get("SensorToMechanismRatio")
    if ratio is not None and ratio.value is not None and not near(ratio.value, variant.ratio):
        raise WrongAnswer(
            f"SensorToMechanismRatio is {ratio.text}",
            hint="The right value is the number of turns of the motor for one turn of the "
            "mechanism: the gear_ratio of given.toml, not 1 and not its inverse.",
            misconception="M-UNITS",
        )
    gravity = one.choices.get("GravityType", "elevatorstatic")  # Phoenix 6's default
    if arm and gravity != "armcosine":
        given = one.choices.get("GravityType")
        raise WrongAnswer(
            f"GravityType is {'Elevator_Static' if given else 'not set'} in {SLOT0}, "
            f"line {one.line}",
            hint="Without Arm_Cosine the motor controller adds kG at every angle as if the arm "
            "were level. (Elevator_Static is the default.)",
        )
    if variant.analysis == "Elevator" and gravity == "armcosine":
        raise WrongAnswer(
            f"GravityType is Arm_Cosine in {SLOT0}, line {one.line}",
            hint="An elevator weighs the same at every height: use Elevator_Static.",
        )
    if one.choices.get("StaticFeedforwardSign", "usevelocitysign") != "usevelocitysign":
        raise WrongAnswer(
            f"StaticFeedforwardSign is UseClosedLoopSign in {SLOT0}, line {one.line}",
            hint="Then kS follows the sign of the error, and the mechanism may shake around the "
            "target. Your mechanism follows a velocity: use UseVelocitySign, which is the default.",
        )


def _check_spark(one: Feedforward, *, arm: bool, variant: Variant) -> None:
    """Whether a Spark gets gravity in the way that fits the mechanism."""
    at = f"{FEED_FORWARD} in line {one.line}"
    if arm and "kG" in one.arguments:
        raise WrongAnswer(
            f"{at} gets kG",
            hint="A Spark adds kG at every angle. An arm's kG goes into kCos.",
        )
    if variant.analysis == "Elevator" and "kCos" in one.arguments:
        raise WrongAnswer(
            f"{at} gets kCos",
            hint="kCos is for arms. An elevator weighs the same at every height: use kG.",
        )
    if not arm:
        return
    ratio = one.arguments.get("kCosRatio")
    wanted = variant.turns_per_unit
    if ratio is None or ratio.value is None or not near(ratio.value, wanted):
        raise WrongAnswer(
            f"{at} has {'no kCosRatio' if ratio is None else f'kCosRatio = {ratio.text}'}",
            hint="kCosRatio converts the encoder's position into rotations of the arm, and the "
            "Spark takes the cosine of this angle. How many rotations is one of your units?",
            misconception="" if ratio is None else "M-UNITS",
        )


def check_order(one: Feedforward, facts: DeployFacts, variant: Variant, *, points: float) -> None:
    """Whether each gain stands in its place.

    Raises:
        WrongAnswer: one does not, or is left out, or cannot be told.
    """
    places = _places(one, variant)
    found = {
        GRAVITY.get(place, place): _gain(arg, facts, variant)
        for place, arg in one.arguments.items()
        if place not in RATIOS
    }
    at = f"{re.sub(r'[A-Za-z_.]+[.](?=k)', '', one.text)} in line {one.line}"
    for place, gain in found.items():
        if gain and gain != place:
            raise WrongAnswer(
                at,
                hint=f"{gain} is where {one.kind} expects {place}. {_look(one)}",
                misconception="M-ARGORDER",
            )
    for place, gain in found.items():
        if not gain:
            raise WrongAnswer(
                f"the grader cannot see which gain {_given(one, place).text} is, "
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


RATIOS = ("kCosRatio", "SensorToMechanismRatio")  # settings that are no gains
GRAVITY = {"kCos": "kG"}  # what a Spark calls an arm's kG


def _places(one: Feedforward, variant: Variant) -> tuple[str, ...]:
    if one.kind in PLACES:
        return variant.gains
    simple = one.kind == "SimpleMotorFeedforward"
    return ("kS", "kV", "kA") if simple else ("kS", "kG", "kV", "kA")


def _given(one: Feedforward, place: str) -> Argument:
    """What a place is given, by the name that its class has for it."""
    return one.arguments.get(place) or one.arguments["kCos"]


def _look(one: Feedforward) -> str:
    if one.kind in PLACES:
        return "Give each setting the constant of its own name."
    return "Check the order of its arguments."


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
