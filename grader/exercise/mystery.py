"""A mystery: a fresh log with a hidden trouble, harder after each one that is solved.

An exercise takes part if its checks.py offers ``draw_mystery(rng, *, level) -> Mystery``, which
draws a trouble as the exercise does; its own checks grade the answer. No secret of a class is used,
so that everybody can grade it.
"""

import secrets
import tomllib
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from grader.checks.check import Check, run_checks
from grader.exercise.exercise import Exercise, Grade, list_exercises, sum_points
from sim.core.errors import BadRequest
from sim.support.atomic_file import write_atomically
from sim.support.os_errors import refuse_os_errors
from sim.support.student_names import make_folder_name

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sim.core.log import Log

FOLDER = "mystery"  # in the course folder
STATE = "mystery.toml"
HIGHEST = 5  # level
SEEDS = 2**32  # so many mysteries of each level
WRITE = "Free some space on this disk, or give yourself permission to write into this folder."


@dataclass(frozen=True, eq=False)
class Mystery:
    """A log with a hidden fault or effect, and how an answer about it is graded.

    Args:
        logs: name of a file without its ending -> the log in it.
        task: what is to be found, for the learner.
        tool: the command that helps to look at it; ``{folder}`` stands for the folder of the logs.
        example: an answer, which is right for another mystery.
        solution: the answer to this one.
        checks: of the exercise.
        read: the learner's answer -> what the checks look at.
    """

    logs: "Mapping[str, Log]"
    task: str
    tool: str
    example: str
    solution: str
    checks: tuple[Check[Any], ...]
    read: Callable[[str], object]


@dataclass(frozen=True)
class MysteryState:
    """How far a learner is with mysteries.

    Args:
        number: of the mystery at hand, from 1.
        level: of it, from 1 to ``HIGHEST``.
        seed: it is drawn from; None while none is at hand.
    """

    number: int = 1
    level: int = 1
    seed: int | None = None

    def __post_init__(self) -> None:
        numbers = (self.number, self.level, self.seed or 0)
        if min(numbers) < 0 or not (
            all(isinstance(one, int) for one in numbers) and 0 < self.level <= HIGHEST
        ):
            raise ValueError

    def close(self, *, solved: bool) -> "MysteryState":
        """The state after a mystery: one level up if it was solved, one down if not."""
        level = min(max(self.level + (1 if solved else -1), 1), HIGHEST)
        return MysteryState(self.number + 1, level)


def find_mystery_folder(course: Path, student: str) -> Path:
    """The folder of a learner's mystery."""
    return course / FOLDER / make_folder_name(student)


def load_state(folder: Path) -> MysteryState:
    """How far a learner is; a file that is damaged begins anew."""
    try:
        return MysteryState(**tomllib.loads((folder / STATE).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError, RecursionError):
        return MysteryState()


def save_state(folder: Path, state: MysteryState) -> None:
    """Keep how far a learner is.

    Raises:
        BadRequest: it cannot be written.
    """
    told = ((name, value) for name, value in asdict(state).items() if value is not None)
    with refuse_os_errors("the mystery cannot be written", folder, advice=WRITE):
        folder.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / STATE, "".join(f"{name} = {value}\n" for name, value in told))


def draw_mystery(course: Path, state: MysteryState) -> Mystery:
    """The mystery of a state, always the same one; the exercises take turns.

    Raises:
        BadRequest: no exercise of this course has mysteries.
    """
    import numpy as np  # noqa: PLC0415 - --help has to start at once

    able = _list_able(course)
    if not able:
        raise BadRequest(
            "no exercise of this course can draw a mystery",
            advice="Get the whole course: grade start FOLDER",
        )
    draw = able[(state.number - 1) % len(able)].module.draw_mystery
    found: Mystery = draw(np.random.default_rng(state.seed), level=state.level)
    return found


def _list_able(course: Path) -> list[Exercise]:
    """The exercises that can draw a mystery; others are not even loaded."""
    return [
        one
        for one in list_exercises(course)
        if "def draw_mystery(" in (one.folder / "checks.py").read_text(encoding="utf-8")
    ]


def open_mystery(course: Path, folder: Path, state: MysteryState) -> tuple[MysteryState, Mystery]:
    """Draw a fresh mystery and write its logs.

    Raises:
        BadRequest: there is none to draw, or it cannot be written.
    """
    from sim.io import write  # noqa: PLC0415 - numpy only where it is needed

    state = replace(state, seed=secrets.randbelow(SEEDS))
    mystery = draw_mystery(course, state)
    with refuse_os_errors("the mystery cannot be written", folder, advice=WRITE):
        folder.mkdir(parents=True, exist_ok=True)
        for old in (*folder.glob("*.wpilog"), *folder.glob("*.csv"), *folder.glob("*.svg")):
            old.unlink()
    for name, log in mystery.logs.items():
        for suffix in (".wpilog", ".csv"):
            write(log, folder / f"{name}{suffix}")
    save_state(folder, state)
    return state, mystery


def grade_mystery_answer(mystery: Mystery, answer: str, *, student: str) -> Grade:
    """Grade an answer about a mystery log by the checks of its exercise."""
    results = run_checks(mystery.checks, mystery.read(answer))
    score, most = sum_points(results)
    status = "passed" if score == most else "failed"
    return Grade(FOLDER, student, score, most, status, results)
