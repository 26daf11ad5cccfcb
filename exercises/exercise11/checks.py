"""Exercise 11: what a team should know about measuring gains, and for which mechanism it pays."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.answers.answer_key import load_answer_key
from grader.answers.submission import read_answers
from grader.check import Check, check
from grader.student_data.student_files import write_student_files

FILES = ("answers.toml",)
HERE = Path(__file__).resolve().parent
GIVEN = "questions.md"
TIER, SINGLE = 2.0, 1.0  # points of a tier of a knowledge check, of every other question
QUESTIONS = {  # name -> what its check is about, and its points
    "Q0_guess": ("The question of somebody who guesses gains.", SINGLE),
    "Q0_sysid": ("The question of somebody who runs SysId.", SINGLE),
    "Q0_brace": ("The gain that a brace changes.", SINGLE),
    "kA_use": ("What else a drivetrain's kA tells.", SINGLE),
    "kS_flag": ("What to do when kS has grown.", SINGLE),
    "step_shape": ("What a long steady acceleration means.", SINGLE),
    "step_length": ("What a longer dynamic test gives.", SINGLE),
    "null_consumer": ("Where null sends the test's name.", SINGLE),
    "status_frames": ("What repeated readings do to kA.", SINGLE),
    "three_logs": ("What the spread of three recordings says.", SINGLE),
    "match_heat": ("Which gains a match's heat changes.", SINGLE),
    "schedule": ("When a team characterizes.", SINGLE),
    "KC1_answer": ("KC1: what happened when the mechanism jumped.", TIER),
    "KC1_reason": ("KC1: what that does to the gains.", TIER),
    "KC2_volts": ("KC2: the voltage that the feedforward gives.", SINGLE),
    "KC2_answer": ("KC2: what to do about the missing speed.", TIER),
    "KC2_reason": ("KC2: why it is missing.", TIER),
    "KC3_answer": ("KC3: what to do when the loaded arm sinks.", TIER),
    "KC3_reason": ("KC3: why the arm sinks.", TIER),
}
MECHANISMS = ("drivetrain", "shooter", "arm", "elevator", "intake", "climber", "conveyor")
ANSWER_NAMES = (
    *QUESTIONS,
    *(f"{name}{part}" for name in MECHANISMS for part in ("", "_reason")),
)


@dataclass(frozen=True)
class Answers:
    """What the checks look at.

    Args:
        given: name in lower case -> answer.
        variant: the learner's own numbers and letters.
        key: the module ``answer_key``.
    """

    given: Mapping[str, object]
    variant: Any
    key: Any


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Write down the learner's questions, where they are not there as they were made.

    Raises:
        NotReachedError: this is a class's package, which has no questions for other names.
    """
    key = load_answer_key(__name__)
    made = {GIVEN: key.tell_questions(key.draw(student))}
    write_student_files(made, exercise=HERE, student=student, what="questions", say=say)


def read(path: Path, *, student: str) -> Answers:
    """The answers, and what they are held against.

    Raises:
        UnreadableFile: the file cannot be read.
        NotReachedError: this is a class's package.
    """
    given = {name.lower(): value for name, value in read_answers(path).items()}
    key = load_answer_key(__name__)
    return Answers(given, key.draw(student), key)


def _check(name: str, describes: str, points: float, *, function: str) -> Check[Answers]:
    """The check of one answer."""

    def look(answers: Answers) -> str | None:
        said: str | None = answers.key.judge_answer(
            name, answers.given, answers.variant, points=points
        )
        return said

    look.__name__, look.__doc__ = function, describes
    return check(points=points)(look)


# The loader finds checks by the names of this module, in the order they are written.
for _name, (_describes, _points) in QUESTIONS.items():
    globals()[_name.lower()] = _check(_name, _describes, _points, function=_name.lower())
for _name in MECHANISMS:
    for _answer, _id, _describes in (
        (_name, f"decision_{_name}", f"Whether to characterize it: {_name}."),
        (f"{_name}_reason", f"reason_{_name}", f"The reason: {_name}."),
    ):
        globals()[_id] = _check(_answer, _describes, SINGLE, function=_id)
