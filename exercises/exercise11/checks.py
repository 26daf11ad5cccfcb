"""Exercise 11: what a team should know about measuring gains, and for which mechanism it pays."""

from functools import partial
from typing import Any

from grader.answers.answer_key import load_answer_key
from grader.answers.submission import StudentAnswers
from grader.checks.check import make_check
from grader.student_data.student_files import Made

FILES = ("answers.toml",)
TIER, SINGLE = 2.0, 1.0  # points of a tier of a knowledge check, of every other question
QUESTIONS = {  # name -> what its check is about, and its points
    "Q0_guess": ("The question of somebody who guesses gains.", SINGLE),
    "Q0_sysid": ("The question of somebody who runs SysId.", SINGLE),
    "Q0_brace": ("The gain that a brace changes.", SINGLE),
    "kA_use": ("What else the kA of a drivetrain shows.", SINGLE),
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


def draw(student: str) -> Any:  # noqa: ANN401 - of a module that a class's package lacks
    """A learner's own numbers and letters.

    Raises:
        NotReachedError: this is a class's package, which has no questions for other names.
    """
    return load_answer_key(__name__).draw(student)


def make_files(student: str) -> dict[str, Made]:
    """The learner's questions."""
    key = load_answer_key(__name__)
    return {"questions.md": key.format_questions(key.draw(student))}


def _judge_question(name: str, points: float, answers: StudentAnswers) -> str | None:
    key = load_answer_key(__name__)
    note: str | None = key.judge_answer(name, answers.given, answers.variant, points=points)
    return note


question_checks = tuple(
    make_check(name, description, partial(_judge_question, name, points), points=points)
    for name, (description, points) in QUESTIONS.items()
)
mechanism_checks = tuple(
    make_check(id_, description, partial(_judge_question, answer, SINGLE), points=SINGLE)
    for name in MECHANISMS
    for id_, answer, description in (
        (f"decision_{name}", name, f"Whether to characterize it: {name}."),
        (f"reason_{name}", f"{name}_reason", f"The reason: {name}."),
    )
)
