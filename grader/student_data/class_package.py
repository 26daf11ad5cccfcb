"""A package that a class issued to one student: numbers that only the class's instructor knows."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from sim.core.errors import BadRequest, Refusal
from sim.support.student_names import check_student_name, normalize_name

PLACE = Path(".course") / "class.toml"


@dataclass(frozen=True)
class ClassPackage:
    """The student and the class that a package was issued to.

    Args:
        name: of the class.
        student: whose numbers these are.
        seal: the class's seal of the two names.
    """

    name: str
    student: str
    seal: str

    def is_for(self, student: str) -> bool:
        """Whether these are this student's own numbers."""
        return normalize_name(student) == normalize_name(self.student)


def read_class_package(course: Path) -> ClassPackage | None:
    """The class package in a course folder; None if no class issued one.

    Raises:
        BadRequest: it is there, and cannot be read.
    """
    path = course / PLACE
    try:
        return parse_class_package(path.read_bytes())
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError):
        raise BadRequest(
            "what your class issued cannot be read",
            where=str(path),
            advice="Unpack your class's zip file once more.",
        ) from None


def parse_class_package(content: bytes) -> ClassPackage:
    """Read the content of a ``class.toml``.

    Raises:
        ValueError: it is not one.
    """
    try:
        raw = tomllib.loads(content.decode("utf-8"))
        name, student = str(raw["class"]), check_student_name(str(raw["student"]))
        return ClassPackage(name, student, str(raw.get("seal", "")))
    except (TypeError, LookupError, RecursionError, Refusal) as error:
        raise ValueError(str(error)) from None


def explain_no_grading(exercise: str, found: ClassPackage) -> BadRequest:
    """Why an exercise cannot be graded here, and how to practice all the same."""
    return BadRequest(
        f"{exercise} has numbers of {found.name}, which only your instructor can grade",
        advice="Hand it in. To practice on other numbers, with feedback about what you compute: "
        f"grade {exercise} FILE --student practice",
    )
