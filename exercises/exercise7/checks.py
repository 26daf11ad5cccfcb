"""Exercise 7: which of twelve logs are damaged, how, where, and what to do about it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from grader.answers.submission import read_answers
from grader.check import Check, WrongAnswer, check
from grader.mystery import Mystery
from grader.student_data.student_files import format_log, write_student_files

from .drawn import LEVELS, LOGS, Case, draw, draw_case
from .line import CLEAN, describe_case, read_claims
from .scoring import score_claims

if TYPE_CHECKING:
    import numpy as np

    from grader.student_data.student_files import Made

FILES = ("answers.toml",)
HERE = Path(__file__).resolve().parent
POINTS = 2.0  # for each log: 1 for what it is, half for where, half for what to do
ANSWER_NAMES = tuple(f"log{number:02}" for number in range(1, LOGS + 1))


@dataclass(frozen=True)
class Answers:
    """What the checks look at."""

    given: Mapping[str, object]
    cases: tuple[Case, ...]


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Make the learner's logs, where they are not there as they were made."""
    made: dict[str, Made] = {
        f"log{number:02}{suffix}": format_log(case.log)
        for suffix in (".wpilog", ".csv")
        for number, case in enumerate(draw(student), start=1)
    }
    write_student_files(made, exercise=HERE, student=student, what="logs", say=say)


def draw_mystery(rng: "np.random.Generator", *, level: int) -> Mystery:
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
        checks=(_of(1),),
        read=lambda text: Answers({"log01": text}, (case,)),
    )


def read(path: Path, *, student: str) -> Answers:
    """The answers, and what they are held against.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    given = {name.lower(): value for name, value in read_answers(path).items()}
    return Answers(given, draw(student))


def _of(number: int) -> Check[Answers]:
    """The check of one log."""

    def look(answers: Answers) -> None:
        claims = read_claims(answers.given.get(f"log{number:02}"))
        result = score_claims(claims, answers.cases[number - 1], points=POINTS)
        if result.hint:
            seen = "; ".join(one.fault for one in claims)
            code = "M-R2" if seen == CLEAN else ""
            raise WrongAnswer(seen, hint=result.hint, misconception=code, earned=result.points)

    look.__name__ = f"log{number:02}"
    look.__doc__ = f"Log {number}: what is wrong with it, where, and what to do."
    return check(points=POINTS)(look)


log01, log02, log03, log04, log05, log06, log07, log08, log09, log10, log11, log12 = (
    _of(number) for number in range(1, LOGS + 1)
)
