"""A package that a class issued to one student: numbers that only the class's instructor knows."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from grader.variant import same, student_name
from sim.errors import BadRequest, Refusal

PLACE = Path(".course") / "class.toml"


@dataclass(frozen=True)
class Issued:
    """Whose package this is.

    Args:
        name: of the class.
        student: whose numbers these are.
        sealed: file, seen from the course folder -> the class's seal of it.
    """

    name: str
    student: str
    sealed: dict[str, str]

    def is_for(self, student: str) -> bool:
        """Whether these are this student's own numbers."""
        return same(student) == same(self.student)


def issued(course: Path) -> Issued | None:
    """What a class issued into a course folder; None if it is nobody's but the learner's.

    Raises:
        BadRequest: it is there, and cannot be read.
    """
    path = course / PLACE
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
        return Issued(str(raw["class"]), student_name(str(raw["student"])), dict(raw["sealed"]))
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError, TypeError, LookupError, Refusal):
        raise BadRequest(
            "what your class issued cannot be read",
            where=str(path),
            advice="Unpack your class's zip file once more.",
        ) from None


def only_there(exercise: str, found: Issued) -> BadRequest:
    """Why an exercise cannot be graded here, and how to practice all the same."""
    return BadRequest(
        f"{exercise} is on numbers of {found.name}, which only your instructor can grade",
        advice="Hand it in. To practice on other numbers, with feedback: grade "
        f"{exercise} FILE --student practice",
    )
