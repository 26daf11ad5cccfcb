"""Exercise 3: gravity and friction from the voltages that hold, and what to do with them."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.answers.answer_key import load_answer_key
from grader.answers.number_answer import HALF, AnswerKey, make_number_check, read_answer_number
from grader.answers.submission import read_answers
from grader.check import WrongAnswer, check
from grader.consequence import Consequence
from grader.student_data.student_files import write_student_files

from .drawn import draw
from .holds import Variant
from .outcome import outcome
from .slips import key_of, offset_slips, turned

FILES = ("answers.toml",)
ANSWER_NAMES = (
    "elevator_kG", "elevator_kS", "elevator_type", "elevator_class",
    "arm_kG", "arm_kS", "arm_type", "arm_class", "arm_offset",
)  # fmt: skip
HERE = Path(__file__).resolve().parent
GIVEN = "given.toml"


@dataclass(frozen=True)
class Answers:
    """What the checks look at."""

    given: Mapping[str, object]
    key: AnswerKey
    variant: Variant


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Write down the learner's numbers, where they are not there as they were made."""
    made = {GIVEN: _told(draw(student))}
    write_student_files(made, exercise=HERE, student=student, what="numbers", say=say)


def _told(variant: Variant) -> str:
    """What a learner gets to know: the voltages, nothing else."""
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


def read(path: Path, *, student: str) -> Answers:
    """The answers, and what they are held against.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    given = {name.lower(): value for name, value in read_answers(path).items()}
    variant = draw(student)
    named = {name: given.get(name.lower()) for name in variant.asked}
    offset = variant.found["arm_offset"]
    try:  # who has the offset right goes on with it as they rounded it
        theirs = turned(read_answer_number(given.get("arm_offset"), variant.offset))
    except WrongAnswer:
        theirs = math.inf
    key = key_of(variant, offset=theirs if variant.offset.is_right(theirs) else offset)
    return Answers({**given, **named}, key, variant)


def consequence(answers: Answers) -> Consequence | None:
    """What the learner's numbers would do on their elevator and their arm."""
    return outcome(answers.given, answers.variant)


elevator_kg = make_number_check(
    "elevator_kG", "The elevator's kG, the voltage that gravity takes.", points=1
)
elevator_ks = make_number_check(
    "elevator_kS", "The elevator's kS, the voltage that friction takes.", points=1
)


def _judge_word(name: str, answers: Answers) -> None:
    load_answer_key(__name__).judge_word(name, answers.given.get(name))


@check(points=1)
def elevator_type(answers: Answers) -> None:
    """SysId's analysis type for the elevator."""
    _judge_word("elevator_type", answers)


@check(points=1)
def elevator_class(answers: Answers) -> None:
    """WPILib's feedforward class for the elevator."""
    _judge_word("elevator_class", answers)


arm_kg = make_number_check(
    "arm_kG", "The arm's kG, the voltage that gravity takes while the arm is horizontal.", points=1
)
arm_ks = make_number_check("arm_kS", "The arm's kS, the voltage that friction takes.", points=1)


@check(points=1)
def arm_type(answers: Answers) -> None:
    """SysId's analysis type for the arm."""
    _judge_word("arm_type", answers)


@check(points=1)
def arm_class(answers: Answers) -> None:
    """WPILib's feedforward class for the arm."""
    _judge_word("arm_class", answers)


@check(points=2)
def arm_offset(answers: Answers) -> str | None:
    """The arm's offset, which is added to the encoder's reading."""
    raw, asked = answers.given.get("arm_offset"), answers.variant.offset
    value = read_answer_number(raw, asked)
    shown = f"{value:.4g} deg"
    away = abs(turned(value - asked.expected))
    full, partial = asked.band.widths(asked.expected)
    if away <= full:
        return f"{raw} is {shown}" if isinstance(raw, str) and f"{value:.4g}" not in raw else None
    hint, code = next(offset_slips(value, answers.variant), ("", ""))
    close = f"close: within {partial:g}°, not yet within {full:g}°" if away <= partial else ""
    hint = "; ".join(part for part in (hint, close) if part)
    raise WrongAnswer(
        shown,
        hint=hint
        or f"outside the accepted {full:g}°. Use the rows with a reading of 0° and of ±90°",
        misconception=code,
        earned=2 * HALF if close else 0.0,
    )
