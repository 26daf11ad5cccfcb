"""The gains that a feedforward or a motor controller received, each with its place."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from grader.answers.wrong_number import WrongNumber
from grader.checks.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.gains_run import CLASSES, CLOSED_LOOP, GainFacts, Gains
from grader.robotcode.checks.causes import check_compiles, check_stop
from grader.robotcode.library.world import PERIOD

from .key import FEED_FORWARD, PLACES, SLOT0, Variant, near
from .slips import find_constant_slip, find_feedback_slip, name_slip

GRAVITY = {"kCos": "kG"}  # what a Spark calls an arm's kG
LOOK = ("Check the order of its arguments.", "Give each setting the constant of its own name.")
RATIO = "SensorToMechanismRatio"
LONGEST_STEP = 0.1  # [s] of a loop: a longer one is in milliseconds, or no time at all
SETTINGS = ("kCosRatio", RATIO, "RotorToSensorRatio")  # that are no gains


@dataclass(frozen=True)
class Seen:
    """The object that a check reads: one run of the program, and the learner's mechanism."""

    facts: GainFacts
    drawn: Variant

    @cached_property
    def variant(self) -> Variant:
        """The mechanism, with its gains in the unit of the place where this code puts them."""
        made = self.facts.feedforwards
        inside = made and all(one.kind in PLACES for one in made)
        return self.convert_for_place(made[0]) if inside else self.drawn

    def convert_for_place(self, one: Gains) -> Variant:
        """The mechanism, its gains in the unit that this class or setting expects."""
        return self.drawn.convert_for_class(one.kind)

    @property
    def feedforwards(self) -> list[Gains]:
        """The feedforwards in question: those of the right class, else all.

        Raises:
            WrongAnswer: none is made.
            NotReachedError: there is nothing at all yet.
        """
        made = self.facts.feedforwards
        if not made:
            check_compiles(self.facts)
            check_stop(self.facts, "start", "periodic")
            if not self.facts.constants:
                raise NotReachedError("checked after you write the gains")
            lost = [name for name in self.facts.unknown if re.search(r"[fF]eed[fF]orward", name)]
            raise WrongAnswer(
                f"the grader knows no {lost[0]}" if lost else "no feedforward is made",
                hint="Make one of WPILib's three when the robot starts, and pass your constants to "
                "it. Or put them into the motor controller: "
                f"{SLOT0} (Phoenix 6) or {FEED_FORWARD} (REVLib).",
            )
        return [one for one in made if one.kind in {self.variant.made, *PLACES}] or [*made]

    def find_gain(self, value: float, place: str) -> str:
        """The gain that a number is, first that of its place; empty if it is none.

        A number that is no constant tells its gain only where the place's own constant is right.
        """
        known = {one.gain: one.value for one in self.facts.constants}
        gains = sorted(self.variant.shown, key=lambda gain: gain != place)
        exact = [gain for gain in gains if known.get(gain) == value]
        own = known.get(place)
        sound = own is None or self.variant.accepts(place, own)
        alike = [gain for gain in gains if sound and self.variant.accepts(gain, value)]
        return next(iter(exact + alike), "")

    def get_value(self, value: float | None, what: str) -> float:
        """A number that the program holds.

        Raises:
            WrongAnswer: nobody can know it.
        """
        if value is None:
            check_compiles(self.facts)
            raise WrongAnswer(
                f"the grader cannot know {what}",
                hint="Write it as a number, or as a calculation with numbers and named constants.",
            )
        return value


def explain(seen: str, slip: WrongNumber, earned: float = 0.0) -> WrongAnswer:
    """The wrong answer that a slip explains."""
    return WrongAnswer(seen, hint=slip.says, misconception=slip.misconception, earned=earned)


def check_one_place(facts: GainFacts) -> None:
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
            held = {GRAVITY.get(name, name) for name, value in other.gains.items() if value != 0}
            twice = [gain for gain, value in one.gains.items() if value != 0 and gain in held]
            if twice:
                places = f"in {_describe_place(one)}, and in {_describe_place(other)}"
                raise WrongAnswer(
                    f"{', '.join(twice)} twice: {places}",
                    hint="This is a double feedforward: the motor controller adds its own volts to "
                    "those that your code sends. Choose one place.",
                )


def _describe_place(one: Gains) -> str:
    return f"{one.kind} in line {one.line}"


def check_settings(one: Gains, variant: Variant) -> None:
    """Whether a motor controller's settings beside the gains fit the mechanism.

    Raises:
        WrongAnswer: one does not.
    """
    arm, elevator = variant.analysis == "Arm", variant.analysis == "Elevator"
    turns, ratio, rotor = (one.gains.get(name) for name in SETTINGS)
    gravity, spark = f"GravityType {one.choices.get('GravityType')}", one.kind == FEED_FORWARD
    sign = f"StaticFeedforwardSign {one.choices.get('StaticFeedforwardSign')}"
    cosine = gravity if gravity.endswith("Arm_Cosine") else "kCos" if "kCos" in one.gains else ""
    slip = seen = ""
    if ratio is not None and not near(ratio, variant.ratio):
        slip, seen = "ratio", f"{RATIO} = {ratio:g}"
    elif ratio is None and rotor and near(rotor, variant.ratio):
        slip, seen = "no-ratio", f"RotorToSensorRatio = {rotor:g} and no {RATIO}"
    elif arm and gravity.endswith("Elevator_Static"):
        slip, seen = "level", gravity
    elif elevator and cosine:
        slip, seen = "cosine", cosine
    elif sign.endswith("UseClosedLoopSign"):
        slip, seen = "closed-loop", sign
    elif spark and arm and "kG" in one.gains:
        slip, seen = "arm", "kG"
    elif spark and arm and not (turns and near(turns, variant.turns_per_unit)):
        slip, seen = "arm-turns", f"kCosRatio = {turns:g}" if turns else "no kCosRatio"
    if slip:
        raise explain(f"{_describe_place(one)} has {seen}", name_slip(slip, "kG", variant))


def check_order(one: Gains, seen: Seen, *, points: float) -> None:
    """Whether each gain is in its place.

    Raises:
        WrongAnswer: one is not, or is left out, or cannot be known.
    """
    given = {GRAVITY.get(n, n): value for n, value in one.gains.items() if n not in SETTINGS}
    places = seen.variant.gains if one.kind in PLACES else CLASSES[one.kind]
    needed = (place for place in places if place in seen.variant.gains)
    lacking = [place for place in needed if given.get(place, 0.0) == 0.0]
    for place, number in given.items():
        value = seen.get_value(number, f"{place} of {_describe_place(one)}")
        gain = seen.find_gain(value, place)
        if value and gain and gain != place:
            raise WrongAnswer(
                f"{_describe_place(one)} gets {place} = {value:.4g}",
                hint=f"{gain} is where {one.kind} expects {place}. {LOOK[one.kind in PLACES]}",
                misconception="M-ARGORDER",
            )
        if value and not gain and place in seen.variant.gains and place in {"kS", "kG"}:
            slip = find_constant_slip(value, place, seen.variant, text="")
            raise explain(
                f"{_describe_place(one)} gets {place} = {value:.4g}, not your {place}", slip
            )
    _check_time_step(one, seen)
    constants = [seen.facts.find_constant(place) for place in lacking]
    if lacking and not any(constant and constant.value == 0 for constant in constants):
        raise WrongAnswer(
            f"{_describe_place(one)} has no {' and no '.join(lacking)}",
            hint="Is it 0, or left out? A missing argument counts as 0.",
            earned=points / 2 if lacking == ["kA"] else 0.0,
        )


def _check_time_step(one: Gains, seen: Seen) -> None:
    """Refuse a time step of a feedforward that is one of the gains, or too long.

    Raises:
        WrongAnswer: it is a gain, or longer than any loop.
    """
    step = one.step or PERIOD
    held = [gain.name for gain in seen.facts.constants if gain.value == step != PERIOD]
    if held or step > LONGEST_STEP:
        gain = f"{held[0]} does not belong here. " if held else ""
        raise WrongAnswer(
            f"{_describe_place(one)} gets the time step dt = {step:.4g} s",
            hint=f"{gain}The last argument is the time from loop to loop in seconds: leave it out.",
            misconception="M-ARGORDER",
        )


def list_feedback_loops(seen: Seen) -> Iterator[tuple[str, float, Variant]]:
    """The loops with a gain near the suggested kP: text, kP, and unit of the loop.

    Raises:
        WrongAnswer: one got kP in the place of another gain.
    """
    for loop in seen.facts.loops:
        kind = FEED_FORWARD if loop.kind == CLOSED_LOOP else loop.kind
        variant = seen.drawn.convert_for_class(kind)
        at = f"{loop.kind} in line {loop.line} gets"
        value, *others = loop.gains.values()
        for name, other in zip(("kI", "kD"), others, strict=True):
            if other and not value and seen.find_gain(other, "kP") == "kP":
                raise WrongAnswer(
                    f"{at} {name} = {other:.4g}",
                    hint=f"kP is where {loop.kind} expects {name}. {LOOK[False]}",
                    misconception="M-ARGORDER",
                )
        if value and (near(value, variant.needed("kP")) or is_known(value, variant)):
            yield f"{at} kP = {value:.4g}", value, variant


def is_known(kp: float, variant: Variant) -> bool:
    """Whether a kP comes from the suggested one, rightly or by a known slip."""
    return find_feedback_slip(kp, variant).code != "kP-other"
