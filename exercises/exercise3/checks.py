"""Exercise 3: gravity and friction from the voltages that hold, and what to do with them."""

import math
from functools import cached_property, partial

from grader.answers.answer_key import load_answer_key
from grader.answers.number_answer import HALF, make_number_check, read_answer_number
from grader.answers.submission import StudentAnswers
from grader.answers.wrong_number import AnswerKey
from grader.checks.check import Check, WrongAnswer, check, make_check
from grader.checks.consequence import Consequence
from grader.student_data.student_files import Made

from .drawn import draw
from .holds import Variant
from .outcome import find_outcome
from .slips import find_offset_slip, make_key, wrap_angle

FILES = ("answers.toml",)
ANSWER_NAMES = (
    "elevator_kG", "elevator_kS", "elevator_type", "elevator_class",
    "arm_kG", "arm_kS", "arm_type", "arm_class", "arm_offset",
)  # fmt: skip


class Answers(StudentAnswers):
    """The object that the checks read: the answers, and the learner's mechanisms."""

    @cached_property
    def key(self) -> AnswerKey:
        """The right numbers; after a right offset, computed from the learner's rounded offset."""
        offset = self.variant.found["arm_offset"]
        try:
            theirs = read_answer_number(self.given.get("arm_offset"), self.variant.offset)
        except WrongAnswer:
            theirs = math.inf
        theirs = wrap_angle(theirs)
        right = self.variant.offset.is_right(theirs)
        return make_key(self.variant, offset=theirs if right else offset)


def make_files(student: str) -> dict[str, Made]:
    """The learner's numbers."""
    return {"given.toml": _describe(draw(student))}


def _describe(variant: Variant) -> str:
    """The facts that a learner reads: the voltages."""
    rows = "".join(
        f"  [{hold.reading:5.0f}, {hold.lower:5.2f}, {hold.upper:5.2f}],\n" for hold in variant.arm
    )
    return f"""\
# Your own numbers for exercise 3. Somebody turned the voltage up and down, slowly, and watched.

[elevator]
just_does_not_fall = {variant.elevator.lower:.2f}  # [V] with a little less, it sinks
just_begins_to_rise = {variant.elevator.upper:.2f}  # [V] with a little more, it rises

[arm]
# A negative voltage pushes the arm down. The reading is the encoder's; it has an offset.
# reading [deg], no longer falls [V], begins to rise [V]
hold = [
{rows}]
"""


def consequence(answers: Answers) -> Consequence | None:
    """The motion of elevator and arm under the learner's numbers."""
    return find_outcome(answers.given, answers.variant)


elevator_kg = make_number_check(
    "elevator_kG", "The elevator's kG, the voltage that gravity takes.", points=1
)
elevator_ks = make_number_check(
    "elevator_kS", "The elevator's kS, the voltage that friction takes.", points=1
)


def _judge_word(name: str, answers: Answers) -> None:
    load_answer_key(__name__).judge_word(name, answers.given.get(name))


def _make_word_checks(kind: str) -> tuple[Check[Answers], ...]:
    """The checks of an analysis type and of a class."""
    return tuple(
        make_check(name, f"{says} for the {kind}.", partial(_judge_word, name), points=1)
        for name, says in (
            (f"{kind}_type", "SysId's analysis type"),
            (f"{kind}_class", "WPILib's feedforward class"),
        )
    )


elevator_words = _make_word_checks("elevator")
arm_kg = make_number_check(
    "arm_kG", "The arm's kG, the voltage that gravity takes while the arm is horizontal.", points=1
)
arm_ks = make_number_check("arm_kS", "The arm's kS, the voltage that friction takes.", points=1)


arm_words = _make_word_checks("arm")


@check(points=2)
def arm_offset(answers: Answers) -> str | None:
    """The arm's offset, which is added to the encoder's reading."""
    raw, asked = answers.given.get("arm_offset"), answers.variant.offset
    value = read_answer_number(raw, asked)
    shown = f"{value:.4g} deg"
    away = abs(wrap_angle(value - asked.expected))
    full, partial = asked.band.widths(asked.expected)
    if away <= full:
        return f"{raw} is {shown}" if isinstance(raw, str) and f"{value:.4g}" not in raw else None
    slip = find_offset_slip(value, answers.variant)
    close = f"close: within {partial:g}°, not yet within {full:g}°" if away <= partial else ""
    hint = "; ".join(part for part in (slip.says if slip else "", close) if part)
    raise WrongAnswer(
        shown,
        hint=hint
        or f"outside the accepted {full:g}°. Use the rows with a reading of 0° and of ±90°",
        misconception=slip.misconception if slip else "",
        earned=2 * HALF if close else 0.0,
    )
