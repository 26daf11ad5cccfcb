"""Exercise 7: which of twelve logs are damaged, how, where, and what to do about it."""

from functools import partial

import numpy as np

from grader.answers.submission import StudentAnswers
from grader.checks.check import Check, WrongAnswer, make_check
from grader.exercise.mystery import Mystery
from grader.student_data.student_files import Made, format_log

from .drawn import LEVELS, LOGS, draw, draw_case
from .line import CLEAN, describe_case, read_claims
from .scoring import score_claims

FILES = ("answers.toml",)
POINTS = 2.0  # for each log: 1 for what it is, half for where, half for what to do
ANSWER_NAMES = tuple(f"log{number:02}" for number in range(1, LOGS + 1))


def make_files(student: str) -> dict[str, Made]:
    """The learner's logs."""
    return {
        f"log{number:02}{suffix}": format_log(case.log)
        for suffix in (".wpilog", ".csv")
        for number, case in enumerate(draw(student), start=1)
    }


def draw_mystery(rng: np.random.Generator, *, level: int) -> Mystery:
    """A log that is damaged, or none; weaker and rarer faults at higher levels.

    Args:
        rng: the source of chance.
        level: from 1.
    """
    faults, severity = LEVELS[min(level, len(LEVELS)) - 1]
    case = draw_case(faults[int(rng.integers(len(faults)))], rng, severity=severity)
    sound = any(not one for one in faults)
    return Mystery(
        logs={"log": case.log},
        task=(
            f"{'This log may be damaged' if sound else 'This log is damaged'}. What is wrong, "
            "where, and what should you do? Exercise 7 explains the words."
        ),
        tool="python exercises/exercise7/look.py {folder}/log.wpilog --page",
        example="hard-stop, dynamic-forward, 1.20 to 1.66, trim",
        solution=describe_case(case),
        checks=(_make_log_check(1),),
        read=lambda text: StudentAnswers({"log01": text}, (case,), ""),
    )


def _make_log_check(number: int) -> Check[StudentAnswers]:
    """The check of one log."""
    says = f"Log {number}: what is wrong with it, where, and what to do."
    return make_check(f"log{number:02}", says, partial(_judge_log, number), points=POINTS)


def _judge_log(number: int, answers: StudentAnswers) -> None:
    claims = read_claims(answers.given.get(f"log{number:02}"))
    result = score_claims(claims, answers.variant[number - 1], points=POINTS)
    if result.hint:
        seen = "; ".join(one.fault for one in claims)
        code = "M-R2" if seen == CLEAN else ""
        raise WrongAnswer(seen, hint=result.hint, misconception=code, earned=result.points)


log_checks = tuple(_make_log_check(number) for number in range(1, LOGS + 1))
