"""The course on this machine: where it is, who is learning, and how far they are."""

import math
import os
import tomllib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from grader.fingerprint import PACKAGES, fingerprint, fingerprint_packages
from grader.issued import PLACE as ISSUED
from grader.variant import student_name
from sim.errors import BadRequest, Refusal

NOBODY = "me"  # who is learning, until they say otherwise
PLACE = Path(".course") / "progress.toml"


def find_course(start: Path) -> Path:
    """The course folder that ``start`` lies in, else the one this package lies in.

    Raises:
        BadRequest: there is none, or only a student's own numbers are there; the message says what
            to do.
    """
    here = Path(__file__).resolve().parent.parent
    for folder in (start, *start.parents, here):
        if (folder / "exercises").is_dir() and (folder / "lessons").is_dir():
            return folder
        if (folder / ISSUED).is_file():
            raise BadRequest(
                "your numbers are here, and the course is not",
                where=str(folder),
                advice="Unpack your class's course.zip where you unpacked your own zip file.",
            )
    raise BadRequest(
        f"{start} is not in a course folder",
        advice="Run this inside the course folder: the one that holds exercises and lessons.",
    )


def other_code(course: Path) -> str:
    """What is to be said where a course folder holds other code than the one that is running.

    The folder one stands in decides about exercises and lessons; grader and sim are those of the
    installation that runs. Empty where the two are the same, or the folder holds no code.
    """
    own = [course / one.name for one in PACKAGES]
    if not all((one / "__init__.py").is_file() for one in own) or own[0].samefile(PACKAGES[0]):
        return ""
    if fingerprint_packages(own) == fingerprint():
        return ""
    return (
        f"the grader and sim that run are those in {PACKAGES[0].parent}, and {course} holds other "
        "ones. To run those of the folder: python -m grader"
    )


@dataclass(frozen=True)
class Standing:
    """How far one learner is with one exercise: the best score so far, and hints shown."""

    score: float = 0.0
    max_score: float = 0.0
    hints: int = 0

    @property
    def done(self) -> bool:
        """Whether it has earned full marks."""
        return 0 < self.max_score <= self.score


@dataclass(frozen=True)
class Progress:
    """Everybody's progress on this machine.

    Args:
        student: who is learning, unless a command says otherwise.
        standings: student -> exercise -> standing.
    """

    student: str = NOBODY
    standings: Mapping[str, Mapping[str, Standing]] = field(default_factory=dict)

    def of(self, student: str, exercise: str) -> Standing:
        """How far a learner is with an exercise."""
        return self.standings.get(student, {}).get(exercise, Standing())

    def with_standing(self, student: str, exercise: str, standing: Standing) -> "Progress":
        """The same, with one standing changed."""
        mine = {**self.standings.get(student, {}), exercise: standing}
        return replace(self, standings={**self.standings, student: mine})

    def with_score(
        self, student: str, exercise: str, *, score: float, max_score: float
    ) -> "Progress":
        """The same, with a score noted; a better one from before is kept."""
        old = self.of(student, exercise)
        best = score if old.max_score != max_score else max(score, old.score)
        new = replace(old, score=best, max_score=max_score)
        return self.with_standing(student, exercise, new)


def load(course: Path) -> tuple[Progress, str]:
    """Read the progress kept in a course folder.

    Returns:
        The progress, and what is to be said about it: a damaged file is set aside as ``.bak``.
    """
    path = course / PLACE
    try:
        return _parsed(tomllib.loads(path.read_text(encoding="utf-8"))), ""
    except FileNotFoundError:
        return Progress(), ""
    except (OSError, ValueError, TypeError, LookupError, AttributeError, Refusal):
        aside = path.with_suffix(".toml.bak")
        said = f"your progress in {path} could not be read; it starts anew"
        try:
            path.replace(aside)
        except OSError:
            return Progress(), said + "."
        return Progress(), f"{said}, and the damaged file is now {aside.name}."


def _parsed(raw: dict[str, object]) -> Progress:
    """Progress from its file's content; whatever does not fit raises."""
    standings: dict[str, dict[str, Standing]] = {}
    tables = raw.get("progress", {})
    if not isinstance(tables, dict):
        raise TypeError
    for student, exercises in tables.items():
        standings[student] = {name: _standing(one) for name, one in exercises.items()}
    return Progress(student_name(str(raw.get("student", NOBODY))), standings)


def _standing(one: Mapping[str, object]) -> Standing:
    score, most, hints = one["score"], one["max_score"], one["hints"]
    if not (isinstance(score, int | float) and isinstance(most, int | float)):
        raise TypeError
    if not (isinstance(hints, int) and hints >= 0 and 0 <= score <= most < math.inf):
        raise ValueError
    return Standing(float(score), float(most), hints)


def save(progress: Progress, course: Path) -> str:
    """Write the progress; what is to be said if that fails, else nothing."""
    import tomlkit  # noqa: PLC0415 - reading needs no writer

    tables = {
        student: {
            name: {"score": one.score, "max_score": one.max_score, "hints": one.hints}
            for name, one in exercises.items()
        }
        for student, exercises in progress.standings.items()
    }
    path = course / PLACE
    part = path.with_suffix(f".{os.getpid()}.part")
    try:
        path.parent.mkdir(exist_ok=True)
        text = tomlkit.dumps({"student": progress.student, "progress": tables})
        part.write_text(text, encoding="utf-8", newline="")
        part.replace(path)
    except OSError as error:
        with suppress(OSError):
            part.unlink(missing_ok=True)
        return f"your progress could not be saved to {path}: {error.strerror or error}."
    return ""
